"""The statue's shadows on floor and north wall, cast by the torch in front of it and by the sun.

Technique: planar projected shadows ("glSkel, cast shadows"; Blinn 1988; Kilgard's dinoshade). The
statue is drawn a second time under the matrix M = (p . l) I - l p^T, which flattens it onto the
plane p along the rays of the light l; geometry/planar.py derives it. The plane's visible surface,
the receiver, is first marked in the stencil buffer by drawing it again, without colour, where its
depth is the one already there. The flattened statue then darkens marked pixels by blending black
over them, and clears each mark as it does.
State used: modelview, stencil bit RECEIVER, blending, polygon offset, depth function and mask.
What is wrong without its safeguards: without ``shadow.stencil`` each layer of the flattened statue
darkens again what another has darkened, and the shadow hangs in the air where the plane has no
surface, as in the rose window until the sky covers it. Without ``shadow.offset`` surface and shadow
have nearly the same depth and fight pixel by pixel; glPolygonOffset brings the shadow a little
nearer. Without ``shadow.behind`` the matrix is drawn with both signs, as by a program that divides
by w' itself and forgets its sign: what is higher than the torch then has an anti-shadow on the
floor, on the torch's other side, and a sun behind the wall casts shadows onto its inside.
A planar shadow has hard edges and falls on planes alone: pillars and vault receive none.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from landscape.effects import plan
from landscape.effects.mirror import FLOOR
from landscape.effects.settings import Settings
from landscape.elements import sun
from landscape.frame import Frame
from landscape.geometry.planar import shadow_matrix
from landscape.gl.calls import gl
from landscape.gl.state import attrib, matrix

RECEIVER = 2  # the stencil bit of the surface that receives a shadow
FLOOR_PLANE = np.array([0.0, 1.0, 0.0, 0.0])
NORTH_PLANE = np.array([0.0, 0.0, 1.0, -plan.INSIDE.north])
FLAME = 0.022  # chosen: height of the flame's brightest part above the torch
OFFSET = -2.0, -4.0  # the document has -2, -1; more units, as the shadow's triangles are long
WAVER = ((0.61, 0.9), (0.37, 0.7), (0.83, 1.0))  # chosen: turns per kt; strength along x, y, z


def flame(kt: float, flicker: float) -> np.ndarray:
    """Return where the torch shines from at ``kt``, (4,); it wavers by up to ``flicker`` units."""
    x, y, z = plan.TORCH
    moved = [
        amplitude * (math.sin(turn * kt + 2.0 * k) + math.sin(0.43 * turn * kt + k)) / 2
        for k, (turn, amplitude) in enumerate(WAVER)
    ]
    return np.array([x, y + FLAME, z, 1.0]) + flicker * np.array([*moved, 0.0])


class Receiver(NamedTuple):
    """A surface that receives shadows: its plane, and a function that sends its triangles."""

    plane: np.ndarray
    send: Callable[[], None]


class PlanarShadow:
    """The shadows of what ``cast`` sends."""

    def __init__(self, settings: Settings, cast: Callable[[], None]) -> None:
        """Take the function that sends what casts the shadows."""
        self._settings, self._cast = settings, cast

    def apply(self, settings: Settings) -> bool:
        """Apply new settings; nothing is built from them."""
        self._settings = settings
        return True

    def lights(self, kt: float) -> list[np.ndarray]:
        """Return the lights that cast shadows, each (4,)."""
        wanted, values = self._settings.shadow, self._settings
        found = []
        if wanted.light in ("torch", "both"):
            found.append(flame(kt, wanted.flicker))
        if wanted.light in ("sun", "both"):
            found.append(np.append(sun.direction(values.sun), 0.0))
        return found

    def draw(self, frame: Frame, receiver: Receiver) -> None:
        """Darken a receiver that has been drawn where the lights' rays do not reach it."""
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        groups |= gl.GL_STENCIL_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT
        with attrib(groups):
            gl.glDepthMask(gl.GL_FALSE)
            gl.glDepthFunc(gl.GL_LEQUAL)
            for light in self.lights(frame.kt):
                if self._settings.shadow.stencil:
                    self._mark(frame, receiver)
                self._darken(receiver, light)

    def _mark(self, frame: Frame, receiver: Receiver) -> None:
        """Mark where the receiver is visible; in a mirror image, where the floor is, too."""
        inside = FLOOR if frame.mirrored and self._settings.mirror.stencil else 0
        with attrib(gl.GL_COLOR_BUFFER_BIT):
            gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
            gl.glEnable(gl.GL_STENCIL_TEST)
            gl.glStencilMask(RECEIVER)
            gl.glStencilFunc(gl.GL_EQUAL, inside | RECEIVER, inside)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
            receiver.send()
        gl.glStencilFunc(gl.GL_EQUAL, inside | RECEIVER, inside | RECEIVER)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_ZERO)

    def _darken(self, receiver: Receiver, light: np.ndarray) -> None:
        """Blend black over the receiver where the flattened statue covers it."""
        values = self._settings.shadow
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glColor4f(0.0, 0.0, 0.0, values.strength)
        if values.offset:
            gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glPolygonOffset(*OFFSET)
        flattened = shadow_matrix(receiver.plane, light)
        for signed in (flattened,) if values.behind else (flattened, -flattened):
            with matrix():
                gl.glMultMatrixf(np.ascontiguousarray(signed.T, np.float32))
                self._cast()

    def release(self) -> None:
        """Nothing was made in OpenGL."""
