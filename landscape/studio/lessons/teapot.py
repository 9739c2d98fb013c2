"""The teapot of computer graphics, as 32 bicubic Bezier patches.

The control points are those that Martin Newell measured on his own teapot in 1975, which every GLUT
has: the profile of the body, of the lid and of the bottom, and half of the handle and of the spout.
What is symmetric is made here.
"""

import numpy as np

# Radius and height of the profiles, four control points for each curve from rim to bottom.
RIM = ((1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4))
UPPER = ((1.5, 2.4), (1.75, 1.875), (2, 1.35), (2, 0.9))
LOWER = ((2, 0.9), (2, 0.45), (1.5, 0.225), (1.5, 0.15))
KNOB = ((0, 3.15), (0.8, 3.15), (0, 2.85), (0.2, 2.7))
LID = ((0.2, 2.7), (0.4, 2.55), (1.3, 2.55), (1.3, 2.4))
BOTTOM = ((1.5, 0.15), (1.5, 0.075), (1.425, 0), (0, 0))
QUARTER = ((1, 0), (1, 0.56), (0.56, 1), (0, 1))  # of a circle, nearly

# Rows of control points across one half: x, width and height.
HANDLE = (
    (
        ((-1.6, 0, 2.025), (-1.6, 0.3, 2.025), (-1.5, 0.3, 2.25), (-1.5, 0, 2.25)),
        ((-2.3, 0, 2.025), (-2.3, 0.3, 2.025), (-2.5, 0.3, 2.25), (-2.5, 0, 2.25)),
        ((-2.7, 0, 2.025), (-2.7, 0.3, 2.025), (-3, 0.3, 2.25), (-3, 0, 2.25)),
        ((-2.7, 0, 1.8), (-2.7, 0.3, 1.8), (-3, 0.3, 1.8), (-3, 0, 1.8)),
    ),
    (
        ((-2.7, 0, 1.8), (-2.7, 0.3, 1.8), (-3, 0.3, 1.8), (-3, 0, 1.8)),
        ((-2.7, 0, 1.575), (-2.7, 0.3, 1.575), (-3, 0.3, 1.35), (-3, 0, 1.35)),
        ((-2.5, 0, 1.125), (-2.5, 0.3, 1.125), (-2.65, 0.3, 0.9375), (-2.65, 0, 0.9375)),
        ((-2, 0, 0.9), (-2, 0.3, 0.9), (-1.9, 0.3, 0.6), (-1.9, 0, 0.6)),
    ),
)
SPOUT = (
    (
        ((1.7, 0, 1.425), (1.7, 0.66, 1.425), (1.7, 0.66, 0.6), (1.7, 0, 0.6)),
        ((2.6, 0, 1.425), (2.6, 0.66, 1.425), (3.1, 0.66, 0.825), (3.1, 0, 0.825)),
        ((2.3, 0, 2.1), (2.3, 0.25, 2.1), (2.4, 0.25, 2.025), (2.4, 0, 2.025)),
        ((2.7, 0, 2.4), (2.7, 0.25, 2.4), (3.3, 0.25, 2.4), (3.3, 0, 2.4)),
    ),
    (
        ((2.7, 0, 2.4), (2.7, 0.25, 2.4), (3.3, 0.25, 2.4), (3.3, 0, 2.4)),
        ((2.8, 0, 2.475), (2.8, 0.25, 2.475), (3.525, 0.25, 2.49375), (3.525, 0, 2.49375)),
        ((2.9, 0, 2.475), (2.9, 0.15, 2.475), (3.45, 0.15, 2.5125), (3.45, 0, 2.5125)),
        ((2.8, 0, 2.4), (2.8, 0.15, 2.4), (3.2, 0.15, 2.4), (3.2, 0, 2.4)),
    ),
)
MIDDLE, SIZE = 1.575, 2  # as GLUT draws it: this height is 0, and the size is halved


def patches() -> np.ndarray:
    """Return the control points (32, 4, 4, 3) of a teapot of GLUT's size 1, y upwards.

    As PyOpenGL's glMap2f reads them, by u and then v, the normals that OpenGL derives from the
    patches (GL_AUTO_NORMAL) point outwards.
    """
    found = []
    for profile in (RIM, UPPER, LOWER, KNOB, LID, BOTTOM):
        for turn in range(4):
            cosine, sine = (1, 0, -1, 0)[turn], (0, 1, 0, -1)[turn]
            found.append(
                [
                    [
                        (radius * (cosine * a - sine * b), radius * (sine * a + cosine * b), height)
                        for a, b in QUARTER[::-1]
                    ]
                    for radius, height in profile
                ]
            )

    for half in (*HANDLE, *SPOUT):
        found.append([[(x, -width, height) for x, width, height in row] for row in half])
        found.append([[(x, width, height) for x, width, height in row[::-1]] for row in half])
    x, y, z = np.moveaxis(np.array(found, float).swapaxes(1, 2), -1, 0)
    return np.stack((x, z - MIDDLE, -y), -1) / SIZE


def text() -> bytes:
    """Return the control points as text: a patch a line, its 16 points one after the other."""
    rows = np.round(patches().reshape(32, 48), 5) + 0  # + 0 makes 0 of -0
    return "".join(" ".join(f"{value:g}" for value in row) + "\n" for row in rows).encode()
