"""The tests of the exercise mirror."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, state_in_lists, test
from landscape.course.grader.triangles import covered

FRAMES = (0, 2)
EVENTS = [{"frame": 2, "key": "LEFT"} for _press in range(4)]
LEVEL = 0.5
SUN = np.array((-2, 2, 1.5, 0))
MIRROR = np.array(((1, 0, 0, 0), (0, -1, 0, 2 * LEVEL), (0, 0, 1, 0), (0, 0, 0, 1)))
KEPT = np.array((0, 1, 0, -LEVEL))  # the plane that keeps what is above the water
FOOT = ((-0.7, 0, -0.7), (0.7, 0.7, 0.7))  # the lowest part of the lighthouse
NEAR = 0.01  # chosen: by which a number may be off


def line_of_sun(work, drawn):
    """Return the line of the last position that is set before a call of the last frame."""
    found = 0
    for call in work.last.calls:
        if call.is_("glLight", "GL_LIGHT0", "GL_POSITION"):
            found = call.line
        if call is drawn:
            break
    return found


def near(a, b):
    return np.abs(np.asarray(a) - b).max() < NEAR


def feet(work, number):
    """Return the draws of the lighthouse's foot: of the image, and of the thing itself."""
    found = []
    for draw in work.frame(number).draws:
        points = draw.vertices[:, :3]
        if len(points) and near(points.min(axis=0), FOOT[0]) and near(points.max(axis=0), FOOT[1]):
            found.append(draw)
    return found


def view(solution, number):
    """Return the modelview matrix of the scene."""
    return feet(solution, number)[-1].modelview


def placed(work, solution, number):
    """Return where the image is, as a matrix in the coordinates of the scene."""
    return np.linalg.inv(view(solution, number)) @ feet(work, number)[0].modelview


def images(work, number):
    """Return the draws of the image: those up to the shore."""
    found = []
    for draw in work.frame(number).draws:
        if len(draw.vertices) and np.abs(draw.vertices[:, :3]).max() > 4:
            break
        found.append(draw)
    return found


def later(work, number):
    """Return the draws after the image."""
    return work.frame(number).draws[len(images(work, number)) :]


def planes(draw):
    """Return the enabled planes in eye coordinates, with a normal of length 1."""
    found = []
    for index in range(6):
        if draw.state[f"GL_CLIP_PLANE{index}"]:
            equation = np.array(draw.state[f"GL_CLIP_PLANE{index}.equation"])
            found.append(equation / (np.linalg.norm(equation[:3]) or 1))
    return found


def line(work, name, *first):
    """Return the line of the last call of a function; 0 without one."""
    found = work.find(name, *first)
    return found[-1].line if found else 0


@test(
    _("The things are drawn twice, first their image"),
    _("The water is blended over the image: so that must be there before."),
)
def twice(work, solution):
    for number in FRAMES:
        count = len(feet(work, number))
        if count < 2 or not images(work, number):
            return hint(_("draw_image does not draw the things yet: draw_things does that."))
        if count > 2:
            return hint(
                _("In frame {frame} the things are drawn {count} times, and not twice."),
                frame=number,
                count=count,
            )
    return None


@test(
    _("The image is mirrored in the plane y = LEVEL"),
    _("What is at the height y has its image at 2 * LEVEL - y."),
    needs=twice,
)
def mirrored(work, solution):
    for number in FRAMES:
        found = placed(work, solution, number)
        if near(found, MIRROR):
            continue
        at = line(work, "glScale")
        if np.linalg.det(found[:3, :3]) > 0:
            if at:
                return hint(
                    _(
                        "The factors of glScalef in line {line} do not mirror: exactly one of "
                        "them, "
                        "that of y, is -1."
                    ),
                    line=at,
                )
            return hint(
                _(
                    "The image is not mirrored: a rotation cannot do that. glScalef with the "
                    "factor "
                    "-1 for y can."
                )
            )
        if not near(found[:3, :3], MIRROR[:3, :3]):
            return hint(
                _(
                    "The image is mirrored in another direction: only the sign of y changes (line "
                    "{line})."
                ),
                line=at,
            )
        told = {
            0: _(
                "The image is mirrored in the plane y = 0, but the water is at LEVEL: the image "
                "hangs too low."
            ),
            LEVEL: _(
                "The image is moved up by LEVEL, and should be by 2 * LEVEL: the image of the "
                "water itself must be at LEVEL."
            ),
            -LEVEL: _(
                "The image is moved down by LEVEL. After glScalef, up is down: look at the "
                "order of glScalef and glTranslatef."
            ),
            -2 * LEVEL: _(
                "The image is moved down by 2 * LEVEL. After glScalef, up is down: look "
                "at the order of glScalef and glTranslatef."
            ),
        }
        for height, text in told.items():
            if near(found[1, 3], height):
                return hint(text)
        return hint(
            _(
                "The image of what is at the height 0 is at {x:.2f}, {y:.2f}, {z:.2f}, and not at "
                "2 * LEVEL."
            ),
            x=found[0, 3],
            y=found[1, 3],
            z=found[2, 3],
        )

    return None


@test(
    _("The image shows the outsides"),
    _("A mirrored triangle winds the other way round."),
    needs=mirrored,
    demanded=True,
)
def front(work, solution):
    if state_in_lists(work) and compare(work, solution) is None:
        return None
    for number in FRAMES:
        for draw in images(work, number):
            state = draw.state
            if not state["GL_CULL_FACE"]:
                return hint(
                    _(
                        "GL_CULL_FACE is off for the image: it is to stay on. Another call "
                        "says which faces are the front."
                    )
                )
            if state["GL_CULL_FACE_MODE"] != "GL_BACK":
                return hint(
                    _(
                        "The task asks that GL_CULL_FACE culls the back faces, and glCullFace in "
                        "line {line} has it cull others. Say instead which winding is the front."
                    ),
                    line=line(work, "glCullFace"),
                )
            if state["GL_FRONT_FACE"] != "GL_CW":
                return hint(
                    _(
                        "The image shows the insides: its counter-clockwise triangles have become "
                        "clockwise, and are culled."
                    )
                )

    return None


@test(
    _("The image is lit by the mirrored sun"),
    _("The sun's position is transformed when it is set, and then stays as it is."),
    needs=front,
)
def sun(work, solution):
    for number in FRAMES:
        draws = images(work, number)
        position = np.array(draws[-1].state["GL_LIGHT0.GL_POSITION"])
        matrix = feet(work, number)[0].modelview
        if near(position, matrix @ SUN):
            continue
        if near(position, view(solution, number) @ SUN):
            return hint(
                _(
                    "The image is lit from above, by the sun itself: set_sun() has not been called "
                    "while the mirrored matrix holds."
                )
            )
        return hint(
            _(
                "In frame {frame} the image is lit from another direction than that of the "
                "mirrored "
                "sun: with which matrix is the position of line {line} set?"
            ),
            frame=number,
            line=line_of_sun(work, images(work, FRAMES[-1])[-1].call),
        )

    return None


@test(
    _("The image has nothing of what is under the water"),
    _("A clip plane keeps what is above it: mirrored, foot and keel would rise from the water."),
    needs=sun,
)
def cut(work, solution):
    given = line(work, "glClipPlane")
    for number in FRAMES:
        matrix = feet(work, number)[0].modelview
        found = [planes(draw) for draw in images(work, number)]
        if not all(found):
            if not given:
                return hint(
                    _(
                        "The foot of the lighthouse and the keel are in the image, above the "
                        "water: "
                        "a clip plane is missing."
                    )
                )
            if any(found):
                return hint(_("The plane is enabled for a part of the image only."))
            return hint(
                _("The plane of line {line} is not enabled while the image is drawn."), line=given
            )
        plane = found[0][0] @ matrix
        if near(plane, KEPT):
            continue
        told = {
            (0, -1, 0, LEVEL): _(
                "The plane of line {line} keeps what is under the water, and so the image is gone. "
                "It is given in the coordinates that hold at the call: are they mirrored or not?"
            ),
            (0, 1, 0, 0): _("The plane of line {line} is at y = 0, and the water is at LEVEL."),
            (0, 1, 0, LEVEL): _(
                "The plane of line {line} is at y = -LEVEL: what is kept has "
                "a x + b y + c z + d >= 0."
            ),
        }
        for numbers, text in told.items():
            if near(plane, numbers):
                return hint(text, line=given)
        a, b, c, d = plane + 0.0
        return hint(
            _(
                "In the coordinates of the things, the plane of line {line} keeps what has "
                "{a:.2f} x + {b:.2f} y + {c:.2f} z + {d:.2f} >= 0, and not what has y >= LEVEL."
            ),
            line=given,
            a=a,
            b=b,
            c=c,
            d=d,
        )

    return None


@test(
    _("After the image all is as before"),
    _("The shore, the water and the things themselves are not mirrored."),
    needs=cut,
)
def restored(work, solution):
    for number in FRAMES:
        draws = later(work, number)
        matrix = view(solution, number)
        if not near(draws[0].modelview, matrix):
            return hint(
                _(
                    "The shore, the water and the things are mirrored as well: the modelview "
                    "matrix "
                    "is not as it was before draw_image."
                )
            )
        if any(draw.state["GL_FRONT_FACE"] != "GL_CCW" for draw in draws):
            return hint(
                _(
                    "After the image the front is still the clockwise side, since line {line}: now "
                    "the things themselves show their insides."
                ),
                line=line(work, "glFrontFace"),
            )
        if any(planes(draw) for draw in draws):
            return hint(
                _("The plane is still enabled after the image: it cuts the things themselves.")
            )
        if any(not draw.state["GL_CULL_FACE"] for draw in draws):
            return hint(_("GL_CULL_FACE is off after the image."))
        if not near(draws[-1].state["GL_LIGHT0.GL_POSITION"], matrix @ SUN):
            return hint(
                _(
                    "The things themselves are lit from below: the sun is still the mirrored one. "
                    "Neither glPopMatrix nor glLoadMatrix moves a light back."
                )
            )

    return None


def regions(solution, number):
    """Return the parts of a frame's picture."""
    height, width = solution.frame(number).picture.shape[:2]
    water = [draw for draw in later(solution, number) if draw.mode == "GL_TRIANGLE_FAN"]
    drawn = later(solution, number)
    things = covered(drawn[drawn.index(water[-1]) + 1 :], height, width)
    surface = covered(water, height, width) & ~things
    return {
        _("in the water"): surface,
        _("the lighthouse and the boat"): things,
        _("the shore"): ~surface & ~things,
    }


@test(
    _("The picture is right"),
    _("From two sides."),
    needs=restored,
)
def picture(work, solution):
    return compare(work, solution, regions=lambda number: regions(solution, number))
