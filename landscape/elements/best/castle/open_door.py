"""The castle's open door: two leaves turned outwards, and the light of the hall between them.

Technique: a dark fan in front of the gate's picture, its colours interpolated between torchlight on
the floor and the dark above; leaves from the two halves of the same picture. Places are in the
castle's own frame, see geometry/masonry.py.
State used: as castle_gate.py, and GL_CULL_FACE.
What is wrong with it: behind the door there is a wall with light painted on it; what one sees
there does not move as the viewer does (switch ``castle.depth``, doorway.py). Switch
``castle.open``.
"""

import math

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.texture import Texture

# The opening in the picture of the gate (studio/castle/gate.py): half its width, the height where
# the arch begins, and how far the centre of each arc is on the other side.
HALF = 0.094
SPRING = 0.238
CENTRE = 0.038
ARC = 9  # chosen: points of each side of the arch
TURNED = math.radians(112.0)  # chosen: how far the leaves are open
GLOW, DARK = (0.62, 0.40, 0.19), (0.045, 0.034, 0.028)  # chosen: torchlight on the floor; above it
FALL = 0.09  # chosen: units above the floor within which the glow falls to a third


def half_arch() -> np.ndarray:
    """Return the outline of half the opening, from the floor at its side to its top, (n, 2).

    The first number is the distance from the middle, the second the height.
    """
    turns = np.linspace(0.0, math.acos(CENTRE / (HALF + CENTRE)), ARC)
    arc = (HALF + CENTRE) * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    low = [(HALF, height) for height in np.linspace(0.0, SPRING, 13)[:-1]]
    return np.concatenate([low, arc + (-CENTRE, SPRING)])


def glow(height: np.ndarray) -> np.ndarray:
    """Return the colours (n, 3) behind the door at heights (n,)."""
    part = 3.0 ** (-np.asarray(height) / FALL)[:, None]
    return np.asarray(np.array(DARK) + part * (np.array(GLOW) - DARK))


def turned(points: np.ndarray, side: int) -> np.ndarray:
    """Return points (n, 2) of a leaf in the castle's frame (n, 3); ``side`` -1 or 1 has its hinge.

    The first number of a point is its distance from the middle of the shut door.
    """
    from_hinge = HALF - points[:, 0]
    x = 0.5 + side * (HALF - from_hinge * math.cos(TURNED))
    return np.stack([x, points[:, 1], -0.002 - from_hinge * math.sin(TURNED)], axis=1)


def send_opening() -> None:
    """Send what fills the opening, unlit, with the glow of the hall behind it."""
    outline = half_arch()
    gl.glDisable(gl.GL_LIGHTING)
    gl.glDisable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    gl.glPolygonOffset(-2.0, -4.0)
    gl.glBegin(gl.GL_QUAD_STRIP)
    for (across, height), colour in zip(outline, glow(outline[:, 1]), strict=True):
        for side in (1, -1):
            gl.glColor3f(*colour.tolist())
            gl.glVertex3f(0.5 + side * across, height, -0.001)
    gl.glEnd()
    gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)


def send_open_door(door: Texture) -> None:
    """Send the two leaves, lit."""
    outline = half_arch()
    gl.glEnable(gl.GL_LIGHTING)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glColor3f(1.0, 1.0, 1.0)
    door.bind()
    inner = outline * (0.0, 1.0)  # the edge that meets the other leaf
    for side in (1, -1):
        near, far = turned(outline, side), turned(inner, side)
        # The face that was inside is seen: it looks towards the passage.
        gl.glNormal3f(-side * math.sin(TURNED), 0.0, math.cos(TURNED))
        gl.glBegin(gl.GL_QUAD_STRIP)
        for k, (across, height) in enumerate(outline.tolist()):
            gl.glTexCoord2f(0.5 + side * across, 1.0 - height)
            gl.glVertex3f(*near[k].tolist())
            gl.glTexCoord2f(0.5, 1.0 - height)
            gl.glVertex3f(*far[k].tolist())
        gl.glEnd()

    gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
