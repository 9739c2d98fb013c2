"""The tests of the exercise normals."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test

FRAMES = (0, 3)
RING, TUBE = 1.5, 0.6
NEAR = 0.01  # chosen: by which a part of a normal may be off


def surface(work):
    """Return the ring's vertices and normals, (n, 3) each."""
    lit = [draw for draw in work.frame(0).draws if draw.state["GL_LIGHTING"]]
    return (
        np.concatenate([draw.vertices[:, :3] for draw in lit]),
        np.concatenate([draw.normals for draw in lit]),
    )


def wanted(points):
    """Return the normals of the ring at points of it."""
    middle = points * (1, 1, 0)
    middle *= RING / np.linalg.norm(middle, axis=1, keepdims=True)
    return (points - middle) / TUBE


def like(found, direction):
    """Return whether most normals have a direction (n, 3), whatever their length."""
    lengths = np.linalg.norm(found, axis=1, keepdims=True) * np.linalg.norm(
        direction, axis=1, keepdims=True
    )
    cosines = (found * direction).sum(axis=1, keepdims=True) / np.maximum(lengths, 1e-9)
    return np.mean(cosines > 0.995) > 0.9


@test(
    _("The ring is drawn, and lit"),
    _("Fix the normals, not the light."),
)
def lit(work, solution):
    draws = work.frame(0).draws
    if not any(draw.state["GL_LIGHTING"] and len(draw.vertices) for draw in draws):
        return hint(_("Nothing is drawn with GL_LIGHTING any more."))
    points = surface(work)[0]
    ours = surface(solution)[0]
    if len(points) != len(ours) or np.abs(points - ours).max() > NEAR:
        return hint(_("The points of the ring are others than before: change only `normal`."))
    return None


@test(
    _("The normals point straight out of the surface"),
    _("Their direction decides how much light a vertex gets."),
    needs=lit,
)
def direction(work, solution):
    points, found = surface(work)
    right = wanted(points)
    if like(found, right):
        return None
    if np.ptp(found, axis=0).max() < NEAR:
        return hint(_("All normals are the same: they must depend on u and v."))
    if like(found, -right):
        return hint(_("All normals point inward: their sign."))
    if like(found, points):
        return hint(
            _(
                "The normals point away from the centre of the ring, as a ball's would; they "
                "must point away from the middle of the tube."
            )
        )

    if like(found, points * (1, 1, 0)):
        return hint(
            _(
                "The normals depend on u only, and lie in the plane of the ring: v turns them "
                "round "
                "the tube."
            )
        )

    before = np.vstack([found[1:], found[-1:]])
    if like(before, right) or like(before[:-2], right[:-2]):
        return hint(
            _(
                "Each vertex has the normal of the vertex before it: glNormal must be called "
                "before "
                "glVertex, which takes the current normal."
            )
        )

    if like(found[:, [1, 0, 2]], right):
        return hint(_("x and y of the normals are swapped: sine and cosine of u."))
    u = np.arctan2(points[:, 1], points[:, 0])
    across = np.hypot(points[:, 0], points[:, 1]) - RING
    sine, cosine = points[:, 2] / TUBE, across / TUBE
    if like(found, np.stack([sine * np.cos(u), sine * np.sin(u), cosine], axis=1)):
        return hint(
            _(
                "The normals are perpendicular to what they should be at the top of the tube: sine "
                "and cosine of v are swapped."
            )
        )

    return hint(
        _(
            "At the point ({x:.2f}, {y:.2f}, {z:.2f}) the normal is ({a:.2f}, {b:.2f}, {c:.2f}), "
            "and should be ({right_a:.2f}, {right_b:.2f}, {right_c:.2f})."
        ),
        **_worst(points, found, right),
    )


def _worst(points, found, right):
    """Return the values of the vertex whose normal is farthest off."""
    at = np.argmax(np.abs(found - right).max(axis=1))
    names = ("x", "y", "z", "a", "b", "c", "right_a", "right_b", "right_c")
    values = np.concatenate((points[at], found[at], right[at])).round(2) + 0.0  # no -0.00
    return dict(zip(names, values.tolist(), strict=True))


@test(
    _("The normals have the length 1"),
    _("OpenGL takes the length into account: a normal twice as long gives twice as much light."),
    needs=direction,
)
def length(work, solution):
    if all(draw.state["GL_NORMALIZE"] for draw in work.frame(0).draws):
        return None
    lengths = np.linalg.norm(surface(work)[1], axis=1)
    if np.abs(lengths - 1).max() < NEAR:
        return None
    if np.ptp(lengths) < NEAR:
        return hint(_("All normals have the length {length:.2f}: divide by it."), length=lengths[0])
    return hint(
        _("The normals have lengths from {least:.2f} to {most:.2f}: divide each by its own."),
        least=lengths.min(),
        most=lengths.max(),
    )


@test(
    _("The picture is right"),
    _("The light runs smoothly over the ring."),
    needs=length,
)
def picture(work, solution):
    return compare(work, solution)
