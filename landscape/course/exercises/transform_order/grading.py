"""The tests of the exercise transform_order."""

import numpy as np

from landscape.course.grader.grading import _, between, compare, hint, test
from landscape.course.grader.triangles import covered

FRAMES = (0, 4)
YEARS = {number: 200 + 90 * number / 60 for number in FRAMES}  # degrees
MONTHS = {number: 50 + 300 * number / 60 for number in FRAMES}
NEAR = 0.05  # chosen: units by which a ball may be elsewhere
TILT = np.radians(35)


def drawn(work, number):
    """Return the draws of the balls."""
    return [draw for draw in work.frame(number).draws if draw.mode == "GL_QUADS"]


def balls(work, number):
    """Return where the balls are in the scene, (n, 3): the eye's transformation taken back."""
    found = []
    for draw in drawn(work, number):
        x, y, z = (draw.eye.min(axis=0) + draw.eye.max(axis=0)) / 2 + (0, 0, 17)
        cos, sin = np.cos(TILT), np.sin(TILT)
        found.append((x, cos * y + sin * z, cos * z - sin * y))
    return np.array(found).reshape(-1, 3)


def around(distance, angle):
    """Return the point at a distance and an angle in degrees around the y axis."""
    return np.array(
        [distance * np.cos(np.radians(angle)), 0, -distance * np.sin(np.radians(angle))]
    )


def close(a, b):
    return np.abs(np.subtract(a, b)).max() < NEAR


def last_move(work, ball):
    """Return the last call before a ball that moves it; None without one."""
    draws = drawn(work, 0)
    calls = work.frame(0).calls
    before = calls[: calls.index(draws[ball].call)] if draws[ball].call in calls else calls
    moves = [call for call in before if call.base in ("glTranslate", "glRotate", "glMultMatrix")]
    return moves[-1] if moves else None


def line_of(work, ball):
    last = last_move(work, ball)
    return last.line if last is not None else 0


def on_the_spot(work, number, ball, angle):
    """Return whether a ball itself is turned round the y axis by an angle in degrees."""
    cos, sin = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    tilt = np.array([(1, 0, 0), (0, np.cos(TILT), -np.sin(TILT)), (0, np.sin(TILT), np.cos(TILT))])
    turned = tilt.T @ drawn(work, number)[ball].modelview[:3, :3]
    return close(turned, [(cos, 0, sin), (0, 1, 0), (-sin, 0, cos)])


@test(
    _("The sun stays in the middle"),
    _(
        "The transforms that move the planet and the moon must not move the sun, not even "
        "in later frames."
    ),
)
def sun(work, solution):
    for number in FRAMES:
        found = balls(work, number)
        if len(found) != 3:
            return hint(
                _("{count} balls are drawn, and not three: sun, planet, moon."), count=len(found)
            )
        if not close(found[0], (0, 0, 0)):
            return hint(
                _("The sun is drawn away from the middle: draw it before any transformation.")
            )
    return None


@test(
    _("The planet goes round the sun"),
    _(
        "First the planet is moved away from the origin, then all is rotated round it; in the "
        "program the calls stand the other way round."
    ),
    needs=sun,
)
def planet(work, solution):
    wanted = {number: around(4.2, YEARS[number]) for number in FRAMES}
    found = {number: balls(work, number)[1] for number in FRAMES}
    if all(close(found[number], wanted[number]) for number in FRAMES):
        return None
    first = found[0]
    if close(first, (0, 0, 0)):
        return hint(
            _(
                "The planet is still at the origin, inside the sun: a rotation and a "
                "translation are "
                "missing {place}."
            ),
            place=between(*drawn(work, 0)[:2]),
        )

    if all(close(each, (4.2, 0, 0)) for each in found.values()):
        last = last_move(work, 1)
        spot = all(on_the_spot(work, number, 1, YEARS[number]) for number in FRAMES)
        if spot and last is not None and last.base == "glRotate":
            return hint(
                _(
                    "The planet stays at the right and turns on the spot: the rotation is applied "
                    "to it first, and then the translation. The call of the rotation must come "
                    "first; now it comes last, in line {line}."
                ),
                line=last.line,
            )
        return hint(
            _(
                "The planet stays at the right and does not go round: it must be rotated by `year`,"
                " round the y axis."
            )
        )

    if all(close(found[n], around(4.2, -YEARS[n])) for n in FRAMES):
        return hint(_("The planet goes round clockwise as seen from above: the sign of the angle."))
    if all(close(found[n], around(4.2, MONTHS[n])) for n in FRAMES):
        return hint(_("The planet goes round by the angle of the month."))
    if all(close(found[n], around(4.2, np.degrees(YEARS[n]))) for n in FRAMES) or all(
        close(found[n], around(4.2, np.radians(YEARS[n]))) for n in FRAMES
    ):
        return hint(_("glRotatef wants degrees: `year` needs no conversion."))

    if abs(np.linalg.norm(first) - 4.2) < NEAR and abs(first[1]) > NEAR:
        return hint(
            _(
                "The planet leaves the plane of its orbit: glRotatef must rotate round the y axis, "
                "0, 1, 0."
            )
        )

    return hint(
        _(
            "In frame {frame} the planet is at ({x:.2f}, {y:.2f}, {z:.2f}), and not at "
            "({wanted_x:.2f}, 0, {wanted_z:.2f})."
        ),
        frame=0,
        **dict(zip("xyz", np.round(first, 2) + 0.0, strict=True)),
        wanted_x=wanted[0][0],
        wanted_z=wanted[0][2],
    )


@test(
    _("The moon goes round the planet"),
    _("The planet's transformations go on holding for the moon, which adds its own."),
    needs=planet,
)
def moon(work, solution):
    planets = {number: balls(work, number)[1] for number in FRAMES}
    found = {number: balls(work, number)[2] for number in FRAMES}
    turned = {n: planets[n] + around(1.3, YEARS[n] + MONTHS[n]) for n in FRAMES}
    if all(close(found[n], turned[n]) for n in FRAMES):
        return None
    first, line = found[0], line_of(work, 2)
    if close(first, planets[0]):
        return hint(
            _("The moon is inside the planet: a rotation and a translation are missing before it.")
        )

    if all(close(found[n], planets[n] + around(1.3, YEARS[n])) for n in FRAMES):
        if all(on_the_spot(work, n, 2, YEARS[n] + MONTHS[n]) for n in FRAMES):
            return hint(
                _(
                    "The moon stays on the line from the sun to the planet: line {line} rotates it "
                    "on the spot. Rotate by `month` first, then translate."
                ),
                line=line,
            )
        return hint(
            _(
                "The moon stays on the line from the sun to the planet: it must be rotated by "
                "`month`, round the y axis."
            )
        )

    if all(close(found[n], around(1.3, MONTHS[n])) for n in FRAMES):
        return hint(
            _(
                "The moon goes round the sun: the planet's transformations no longer hold for it. "
                "Does glPopMatrix or glLoadIdentity come too early?"
            )
        )

    if all(close(found[n], planets[n] + around(1.3, MONTHS[n])) for n in FRAMES):
        return hint(
            _(
                "The moon's angle counts from the x axis; it should count from the line "
                "through sun "
                "and planet, so the rotation by `year` must hold for the moon, too."
            )
        )

    if all(close(found[n], planets[n] + around(1.3, YEARS[n] - MONTHS[n])) for n in FRAMES):
        return hint(_("The moon goes round clockwise as seen from above: the sign of the angle."))
    calls = work.frame(0).calls
    before, own = (calls.index(draw.call) for draw in drawn(work, 0)[1:3])
    loads = [call for call in calls[before:own] if call.name == "glLoadIdentity"]
    if loads:
        return hint(
            _(
                "glLoadIdentity in line {line} goes back to the eye: for the moon, it forgets "
                "where "
                "the planet is and how the system is tilted."
            ),
            line=loads[0].line,
        )

    distance = np.linalg.norm(first - planets[0])
    if abs(distance - 1.3) > NEAR:
        return hint(
            _(
                "The moon is {distance:.1f} away from the planet, and not 1.3. Its translation "
                "begins at the planet, and not at the sun."
            ),
            distance=distance,
        )

    return hint(
        _(
            "The moon is at the right distance from the planet, and at the wrong angle: it "
            "should be "
            "year + month, round the y axis."
        )
    )


def regions(solution, number):
    """Return the parts of a frame's picture."""
    height, width = solution.frame(number).picture.shape[:2]
    names = (_("the sun"), _("the planet"), _("the moon"))
    draws = drawn(solution, number)
    found = {name: covered([draw], height, width) for name, draw in zip(names, draws, strict=True)}
    return {**found, _("beside sun, planet and moon"): ~covered(draws, height, width)}


@test(
    _("The picture is right"),
    _("At the beginning and 10 frames later."),
    needs=moon,
)
def picture(work, solution):
    return compare(work, solution, regions=lambda number: regions(solution, number))
