"""The tests of the exercise texture_coordinates."""

import numpy as np

from landscape.course.grading import _, compare, hint, test

FRAMES = (0,)
NEAR = 0.02  # chosen: by which a coordinate may be off


def quads(work):
    """Return for each textured quad of the wall: s and t at its left, right, bottom and top.

    As (n, 4, 2), in the order left, right, bottom, top; each the mean of two corners.
    """
    found = []
    for draw in work.frame(0).draws:
        if not draw.state["GL_TEXTURE0.GL_TEXTURE_2D"] or draw.mode != "GL_QUADS":
            continue
        matrix = np.array(draw.state["GL_TEXTURE0.GL_TEXTURE_MATRIX"]).reshape(4, 4).T
        coordinates = (draw.texture @ matrix.T)[:, :2].reshape(-1, 4, 2)
        for places, st in zip(draw.vertices[:, :2].reshape(-1, 4, 2), coordinates, strict=True):
            (x, y), (middle_x, middle_y) = places.T, places.mean(axis=0)
            sides = (x < middle_x, x > middle_x, y < middle_y, y > middle_y)
            found.append([st[side].mean(axis=0) for side in sides])
    return np.array(found).reshape(-1, 4, 2)


def wrap(work, axis):
    """Return how the texture goes on beyond 1; ``axis`` is S or T."""
    calls = work.find("glTexParameter", "GL_TEXTURE_2D", f"GL_TEXTURE_WRAP_{axis}")
    return calls[-1].args[2] if calls else "GL_REPEAT"


@test(
    _("The wall has a texture"),
    _("GL_TEXTURE_2D is on while the wall is drawn, and each corner has a texture coordinate."),
)
def textured(work, solution):
    if len(quads(work)) == 0:
        return hint(_("No quad is drawn with GL_TEXTURE_2D."))
    if all(np.ptp(quad, axis=0).max() < NEAR for quad in quads(work)):
        return hint(
            _("All corners have the same texture coordinate: glTexCoord must be called before each "
              "glVertex.")
        )  # fmt: skip
    return None


@test(
    _("The boats are upright"),
    _("The first row of the image, t = 0, is the top of the picture."),
    needs=textured,
)
def upright(work, solution):
    bottom, top = quads(work).sum(axis=0)[2:]
    if abs(top[1] - bottom[1]) < NEAR:
        if abs(top[0] - bottom[0]) > NEAR:
            return hint(
                _("The picture lies on its side: s and t are swapped. s belongs to the width, t to "
                  "the height.")
            )  # fmt: skip
        return hint(_("t is the same above and below: it must go from 0 above to 1 below."))
    if top[1] > bottom[1]:
        return hint(
            _("The boats are upside down: t grows from the lower edge to the upper one, but the "
              "first row of the image is the top.")
        )  # fmt: skip
    return None


@test(
    _("The boats sail to the left"),
    _("As in IMAGE, s must grow from the left to the right."),
    needs=upright,
)
def direction(work, solution):
    left, right = quads(work)[:, 0, 0], quads(work)[:, 1, 0]
    if np.all(right > left):
        return None
    return hint(_("The picture is mirrored: s must grow from the left corner to the right one."))


@test(
    _("There are three boats in a row"),
    _("Along the wall s runs over three pictures, and t over one."),
    needs=direction,
)
def three(work, solution):
    found = quads(work)
    along = (found[:, 1, 0] - found[:, 0, 0]).sum()
    up = np.abs(found[:, 3, 1] - found[:, 2, 1]).max()
    if abs(up - 3) < NEAR:
        return hint(_("The picture is repeated upwards, too: t goes from 0 to 1 only."))
    if abs(up - 1) > NEAR:
        return hint(
            _("From the lower to the upper edge t changes by {up:.2f}, and not by 1."), up=up
        )
    if abs(along - 1 / 3) < NEAR:
        return hint(
            _("Only a third of the picture is to be seen: to repeat it three times, s goes to 3, "
              "and not to 1/3.")
        )  # fmt: skip
    if abs(along - 3) > NEAR:
        return hint(
            _("Along the wall s changes by {along:.2f}, so the picture is there {along:.2f} times, "
              "and not three times."),
            along=along,
        )  # fmt: skip
    return None


@test(
    _("The texture is repeated"),
    _("Beyond 1, GL_TEXTURE_WRAP_S decides what is drawn."),
    needs=three,
)
def repeated(work, solution):
    found = quads(work)
    beyond = found[:, :, 0].max() > 1 + NEAR or found[:, :, 0].min() < -NEAR
    way = wrap(work, "S")
    if not beyond or way == "GL_REPEAT":
        return None
    if way == "GL_MIRRORED_REPEAT":
        return hint(_("GL_MIRRORED_REPEAT mirrors every second boat: use GL_REPEAT."))
    if wrap(work, "T") == "GL_REPEAT":
        return hint(
            _(
                "GL_TEXTURE_WRAP_T is GL_REPEAT now, which concerns t; but it is s that goes "
                "beyond 1, and GL_TEXTURE_WRAP_S still is {way}."
            ),
            way=way,
        )
    return hint(
        _(
            "Beyond the first boat the edge of the picture is drawn out: GL_TEXTURE_WRAP_S is "
            "{way}."
        ),
        way=way,
    )


@test(
    _("The picture is right"),
    _("Each boat begins where the one before it ends."),
    needs=repeated,
)
def picture(work, solution):
    start = quads(work)[:, 0, 0].min()
    if abs(start - round(start)) > NEAR:
        return hint(
            _("The frieze begins in the middle of a boat: at the left edge s is {start:.2f}."),
            start=start,
        )
    return compare(work, solution)
