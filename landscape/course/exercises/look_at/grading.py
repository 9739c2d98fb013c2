"""The tests of the exercise look_at."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import balanced, close, known

FRAMES = (0, 1, 2, 3, 4)
PRESSED = {1: ("RIGHT",) * 4, 2: ("UP",) * 3, 3: ("SPACE", "DOWN"), 4: ("LEFT",) * 9}
EVENTS = [
    {"frame": frame, "key": key, "action": action}
    for frame, keys in PRESSED.items()
    for key in keys
    for action in ("press", "release")
] + [{"frame": 4, "resize": [240, 300]}]
TURNED = {0: 30, 1: 110, 2: 110, 3: 110, 4: -70}
LIFTED = {0: 2.5, 1: 2.5, 2: 4, 3: 3.5, 4: 3.5}
TARGET = np.array((0.4, 0.8, -0.3))


def eye_of(number):
    angle = np.radians(TURNED[number])
    return TARGET + (4.5 * np.sin(angle), LIFTED[number], 4.5 * np.cos(angle))


def up_of(number):
    return np.array((0.5 if number >= 3 else 0, 1, 0))


def unit(vector):
    return vector / np.linalg.norm(vector)


def moved(by):
    """Return the matrix of a translation."""
    matrix = np.identity(4)
    matrix[:3, 3] = by
    return matrix


def turned(axes):
    """Return the matrix with these axes as its rows."""
    matrix = np.identity(4)
    matrix[:3, :3] = axes
    return matrix


def axes_of(number, up=None, target=TARGET, units=(unit, unit)):
    """Return the axes of the camera's frame, to the right, upwards and backward, as (3, 3)."""
    back = units[0](eye_of(number) - target)
    right = units[1](np.cross(up_of(number) if up is None else up, back))
    return np.array((right, np.cross(back, right), back))


def right(number):
    return turned(axes_of(number)) @ moved(-eye_of(number))


def with_axes(change):
    """Return what makes the matrix of a frame with other axes."""
    return lambda number: turned(change(number)) @ moved(-eye_of(number))


def same(vector):
    return vector


def long_back(number):
    found = axes_of(number, units=(same, unit))
    return found[0], unit(found[1]), found[2]


OF_PLACE = (
    (
        lambda number: np.identity(4),
        _("The camera is still at the origin and looks along -z: look changes nothing yet."),
    ),
    (
        lambda number: moved(-eye_of(number)),
        _(
            "The world is moved to the right place, but not turned: the camera looks along -z of "
            "the world, and not at the target."
        ),
    ),
    (
        lambda number: turned(axes_of(number)),
        _(
            "The camera looks in the right direction, but from the origin: the world has to be "
            "moved as well, so that the eye comes to the origin."
        ),
    ),
    (
        lambda number: turned(axes_of(number)) @ moved(eye_of(number)),
        _(
            "The world is moved by the eye, and should be moved by the opposite: what is at the "
            "eye comes to the origin."
        ),
    ),
    (
        lambda number: moved(-eye_of(number)) @ turned(axes_of(number)),
        _(
            "The world is turned around its own origin, and only then moved. OpenGL applies what "
            "is called last to the vertices first."
        ),
    ),
    (
        lambda number: moved(eye_of(number)) @ turned(axes_of(number).T),
        _(
            "This is the matrix that would carry a camera through the world, from the origin to "
            "the eye. The world must move the other way: by its inverse."
        ),
    ),
    (
        lambda number: turned(axes_of(number)) @ moved(-TARGET),
        _(
            "The camera is inside the target: the world has to be moved by the eye's place, and "
            "not by the target's."
        ),
    ),
)
OF_AXES = (
    (
        lambda number: turned(axes_of(number).T) @ moved(-eye_of(number)),
        _(
            "The axes have become columns: glMultMatrix and glLoadMatrix read a matrix column by "
            "column, and an array of numpy lies in memory row by row."
        ),
    ),
    (
        lambda number: right(number).T,
        _(
            "The whole matrix is transposed, with the translation in its last row: OpenGL reads it "
            "column by column."
        ),
    ),
    (
        with_axes(lambda number: axes_of(number) * [[-1], [1], [-1]]),
        _(
            "The camera looks away from the target: the third axis leads from the target to the "
            "eye, as OpenGL looks along -z."
        ),
    ),
    (
        with_axes(lambda number: axes_of(number) * [[-1], [-1], [1]]),
        _(
            "The picture is upside down: the first axis leads to the left. A vector product "
            "changes its sign if its factors change places."
        ),
    ),
    (
        with_axes(lambda number: axes_of(number) * [[1], [-1], [1]]),
        _(
            "The ground is above, and the picture is mirrored: the second axis leads downwards, as "
            "the factors of its vector product have changed places."
        ),
    ),
    (
        with_axes(lambda number: axes_of(number) * [[-1], [1], [1]]),
        _(
            "The picture is mirrored, left and right have changed places: the first axis leads to "
            "the left."
        ),
    ),
    (
        with_axes(lambda number: (axes_of(number)[0], up_of(number), axes_of(number)[2])),
        _(
            "The picture is distorted, the more so the higher the camera is: `up` itself is not "
            "perpendicular to the line of sight. Which product of two axes is?"
        ),
    ),
    (
        with_axes(lambda number: axes_of(number, units=(unit, same))),
        _(
            "What is seen becomes smaller as the camera is lifted: the vector product of `up` and "
            "the third axis is shorter than 1, and must be normalized."
        ),
    ),
    (
        with_axes(long_back),
        _(
            "All is seen from too far away: the third axis is as long as the way from the target "
            "to the eye. It must have length 1."
        ),
    ),
    (
        with_axes(lambda number: axes_of(number, units=(same, same))),
        _("The axes have other lengths than 1: none is normalized."),
    ),
    (
        with_axes(lambda number: axes_of(number, target=0)),
        _(
            "The middle of the picture is the origin of the world: the third axis has to depend on "
            "the target, too."
        ),
    ),
    (
        with_axes(lambda number: axes_of(number, up=(0, 1, 0))),
        _("When Space leans the camera, the picture stays upright: `up` has no effect."),
    ),
    (
        with_axes(lambda number: axes_of(number, up=(0, 0, 1))),
        _(
            "The picture leans over, as z is taken for the direction upwards: `up` says "
            "which it is."
        ),
    ),
    (
        with_axes(lambda number: axes_of(number)[[0, 2, 1]]),
        _(
            "The camera does not look at the target: the axes are those of x, y and z in "
            "this order, to the right, upwards, backward."
        ),
    ),
)


def view(work):
    """Return what gives the matrix by which the boxes of a frame are moved."""

    def matrix(number):
        draws = work.frame(number).draws
        return draws[0].modelview if draws else np.zeros((4, 4))

    return matrix


@test(
    _("The world is moved so that the eye is at the origin"),
    _("What is at the eye comes to the origin first; then all is turned."),
)
def place(work, solution):
    if compare(work, solution) is None:
        return None
    told = known(OF_PLACE, view(work), FRAMES, close(0.01))
    if told or known(OF_AXES, view(work), FRAMES, close(0.01)):
        return told

    number = next(
        (n for n in FRAMES if not close(0.02)(view(work)(n) @ (*eye_of(n), 1), (0, 0, 0, 1))), None
    )
    if number is None or not work.frame(number).draws:
        return None

    x, y, z = (view(work)(number) @ (*eye_of(number), 1))[:3]
    return hint(
        _(
            "In frame {frame} what is at the eye comes to ({x:.2f}, {y:.2f}, {z:.2f}), and not to "
            "the origin."
        ),
        frame=number,
        x=x,
        y=y,
        z=z,
    )


@test(
    _("The axes of the camera are right"),
    _("To the right, upwards and backward, perpendicular to each other, of length 1."),
    needs=place,
)
def axes(work, solution):
    if compare(work, solution) is None:
        return None
    if told := known(OF_AXES, view(work), FRAMES, close(0.01)):
        return told
    for number in FRAMES:
        found, wanted = view(work)(number)[:3, :3], axes_of(number)
        for row, name in enumerate((_("to the right"), _("upwards"), _("backward"))):
            if np.abs(found[row] - wanted[row]).max() > 0.02 and work.frame(number).draws:
                return hint(
                    _(
                        "In frame {frame} the axis {name} is ({x:.2f}, {y:.2f}, {z:.2f}), and "
                        "should be ({right_x:.2f}, {right_y:.2f}, {right_z:.2f})."
                    ),
                    frame=number,
                    name=name,
                    **dict(zip(("x", "y", "z"), found[row])),
                    **dict(zip(("right_x", "right_y", "right_z"), wanted[row])),
                )

    return None


@test(
    _("The picture is right"),
    _("From several places, leaning, and in a window that is higher than wide."),
    needs=axes,
)
def picture(work, solution):
    return compare(work, solution)


stacks = balanced(needs=picture)
