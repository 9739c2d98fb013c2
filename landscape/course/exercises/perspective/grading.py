"""The tests of the exercise perspective."""

import math

import numpy as np

from landscape.course.grader.grading import _, between, compare, hint, test

FRAMES = (0, 2)
EVENTS = [{"frame": 2, "resize": [760, 360]}]
NEAR, FAR = 0.5, 60
SLOPE = math.tan(math.radians(20))  # of the picture's upper edge, as seen from the eye
CLOSE = 0.002  # chosen: the relative error of a matrix element that single precision may cause


def matrices(work, number):
    """Return the projection and the modelview matrix with which a frame's last part is drawn."""
    last = work.frame(number).draws[-1]
    return last.projection, last.modelview


def aspect(work, number):
    """Return width / height of a frame."""
    height, width = work.frame(number).picture.shape[:2]
    return width / height


def near(a, b):
    return abs(a - b) <= CLOSE * max(abs(a), abs(b))


@test(
    _("There is a perspective projection"),
    _("Its matrix divides by the distance: its last row is 0 0 -1 0."),
)
def projected(work, solution):
    projection, modelview = matrices(work, 0)
    if near(projection[3, 2], -1) and near(modelview[3, 3], 1):
        return None
    calls = work.find("glFrustum") or work.find("glMultMatrix")
    if modelview[3, 2] != 0:
        return hint(
            _(
                "Line {line} multiplies the modelview matrix: glMatrixMode(GL_PROJECTION) is "
                "missing before it."
            ),
            line=calls[-1].line if calls else 0,
        )

    if calls and np.allclose(projection, np.eye(4)):
        return hint(
            _(
                "glFrustum in line {line} multiplies the modelview matrix, which glLoadIdentity "
                "sets anew later. glMatrixMode says which matrix is meant: GL_PROJECTION."
            ),
            line=calls[-1].line,
        )

    if found := work.find("glOrtho"):
        return hint(
            _("glOrtho in line {line} is the projection without perspective: use glFrustum."),
            line=found[-1].line,
        )

    return hint(_("set_projection sets no perspective projection yet: glFrustum makes one."))


@test(
    _("The matrix is set anew in each frame"),
    _("glFrustum multiplies the current matrix, so that must be the identity before."),
    needs=projected,
)
def fresh(work, solution):
    projection = matrices(work, 2)[0]
    if near(projection[3, 2], -1) and abs(projection[3, 3]) < CLOSE:
        return None
    made = (work.last.find("glFrustum") or work.last.find("glMultMatrix"))[-1]
    chosen = next(iter(work.last.find("glMatrixMode", "GL_PROJECTION")), None)
    return hint(
        _(
            "glFrustum multiplies the current matrix, which in the second frame is still the "
            "first frame's. glLoadIdentity() is missing {place}."
        ),
        place=between(chosen, made),
    )


@test(
    _("The opening angle is 40 degrees"),
    _("top / near is the tangent of half the opening angle."),
    needs=fresh,
)
def opening(work, solution):
    slope = 1 / matrices(work, 0)[0][1, 1]
    if near(slope, SLOPE):
        return None
    if slope < 0:
        return hint(
            _(
                "bottom and top are swapped: the third argument of glFrustum is the lower "
                "edge, and "
                "the smaller number."
            )
        )

    if slope * NEAR >= 100:
        return hint(
            _(
                "The edges are as far apart as the window has pixels. glFrustum wants them in "
                "units "
                "of the scene, on the near plane, {near} away from the eye."
            ),
            near=NEAR,
        )

    wrong = {
        math.tan(math.radians(40)): _(
            "The angle from edge to edge is now 80 degrees: above the middle there is only half "
            "of the opening angle."
        ),
        SLOPE / NEAR: _(
            "The edges are at the distance 1, but glFrustum wants them on the near plane: "
            "multiply by NEAR."
        ),
        math.tan(20): _("math.tan expects radians: math.radians(20), and not 20."),
        NEAR * math.tan(40): _(
            "math.tan expects radians; and above the middle there is only half of the angle."
        ),
        math.radians(20): _("The edge is near * tan(angle), and not near * angle."),
    }
    for value, text in wrong.items():
        if near(abs(slope), abs(value)):
            return hint(text)
    if near(slope * aspect(work, 0), SLOPE) or near(slope, SLOPE / aspect(work, 0)):
        return hint(
            _(
                "The 40 degrees go from the left to the right edge; they should go from the lower "
                "to the upper one."
            )
        )

    return hint(
        _("The angle from the lower to the upper edge is {angle:.1f} degrees, and not 40."),
        angle=2 * math.degrees(math.atan(slope)),
    )


@test(
    _("Nothing is stretched, whatever the window's size"),
    _("right / top must be width / height; the window is 640 x 480 at first, then 760 x 360."),
    needs=opening,
)
def proportions(work, solution):
    ratios = [matrices(work, each)[0] for each in FRAMES]
    ratios = [matrix[1, 1] / matrix[0, 0] for matrix in ratios]
    wanted = [aspect(work, each) for each in FRAMES]
    if all(near(a, b) for a, b in zip(ratios, wanted, strict=True)):
        return None
    if ratios[0] < 0:
        return hint(
            _(
                "left and right are swapped: the first argument of glFrustum is the left edge, and "
                "the smaller number."
            )
        )

    if near(ratios[0], 1) and near(ratios[1], 1):
        return hint(
            _(
                "right and top are equal, so that everything is stretched to the window's width: "
                "right is top * width / height."
            )
        )

    if near(ratios[0], 1 / wanted[0]):
        return hint(_("Width and height are swapped: the wider the window, the greater is right."))
    if near(ratios[0], wanted[0]):
        return hint(
            _(
                "It is right for 640 x 480 only: compute the proportions from width and height, "
                "which change with the window."
            )
        )

    return hint(
        _("In a window of 640 x 480 right / top is {ratio:.3f}, and not {wanted:.3f}."),
        ratio=ratios[0],
        wanted=wanted[0],
    )


@test(
    _("Everything between 0.5 and 60 units away is drawn"),
    _("The near and the far plane are the last two arguments."),
    needs=proportions,
)
def depths(work, solution):
    matrix = matrices(work, 0)[0]
    a, b = matrix[2, 2], matrix[2, 3]
    near_plane, far_plane = b / (a - 1), b / (a + 1)
    if near(near_plane, NEAR) and abs(far_plane / FAR - 1) < 0.02:
        return None
    return hint(
        _("Everything from {near:.2f} to {far:.1f} units away is drawn, not from 0.5 to 60."),
        near=near_plane,
        far=far_plane,
    )


@test(
    _("The picture is right"),
    _("In two sizes of the window."),
    needs=depths,
)
def picture(work, solution):
    return compare(work, solution)
