"""The statue's shadows on floor and north wall, cast by the torch beside the pool and by the sun.

Technique: planar projected shadows ("glSkel, cast shadows"; Blinn 1988; Kilgard's dinoshade). The
statue is drawn a second time under the matrix M = (p . l) I - l p^T, which flattens it onto the
plane p along the rays of the light l; geometry/planar.py derives it. The plane's visible surface,
the receiver, is first marked in the stencil buffer (RECEIVER): drawn without colour where its depth
passes. Then, by ``shadow.method``:
- darken: the flattened statue blends black over marked pixels, and clears each mark as it does. It
  takes away a fraction of all light, and of what a polished floor mirrors.
- relight: the flattened statue only sets a bit of its light in the stencil buffer. Each part of the
  receiver, by its bits, is then drawn with the light map that lacks just these lights.
State used: modelview, stencil bits RECEIVER and SHADED, blending, polygon offset, depth function
and mask.
What is wrong without its safeguards: without ``shadow.stencil`` each layer of the flattened statue
darkens again what another has darkened, and the shadow hangs in the air where the plane has no
surface, as in the rose window until the sky covers it. Without ``shadow.offset`` surface and shadow
have nearly the same depth and fight pixel by pixel; glPolygonOffset brings the shadow a little
nearer. Without ``shadow.behind`` the matrix is drawn with both signs, as by a program that divides
by w' itself and forgets its sign: what is higher than the torch then has an anti-shadow on the
floor, on the torch's other side; a torch between statue and wall (``shadow.flame``) throws it onto
the wall upside down; and a sun behind the wall casts shadows onto its inside.
A planar shadow has hard edges and falls on planes alone: pillars and vault receive none.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from itertools import combinations
from typing import NamedTuple

import numpy as np

from landscape.effects import plan
from landscape.effects.exhibits.picture import Part, part_of_polygon
from landscape.effects.mirror import FLOOR
from landscape.effects.settings import Settings, Shadow
from landscape.elements import sun
from landscape.frame import Frame
from landscape.geometry.planar import shadow_matrix, shadows_of
from landscape.gl.calls import drawing, gl
from landscape.gl.state import attrib, front_faces, matrix

RECEIVER = 2  # the stencil bit of the surface that receives a shadow
SHADED = {"sun": 4, "torch": 8}  # those of what a light does not reach
ALL = RECEIVER | sum(SHADED.values())
FLOOR_PLANE = np.array([0.0, 1.0, 0.0, 0.0])
NORTH_PLANE = np.array([0.0, 0.0, 1.0, -plan.INSIDE.north])
OFFSET = -2.0, -4.0  # the document has -2, -1; more units, as the shadow's triangles are long
MARGIN = 1e-6  # units: shadows lie on the plane but for rounding
FAR_AWAY = 1e3  # chosen: units, beyond any receiver
WAVER = ((0.61, 0.9), (0.37, 0.7), (0.83, 1.0))  # chosen: turns per kt; strength along x, y, z


def flame(kt: float, shadow: Shadow) -> np.ndarray:
    """Return where the torch shines from at ``kt``, (4,): its flame, which wavers."""
    moved = [
        amplitude * (math.sin(turn * kt + 2.0 * k) + math.sin(0.43 * turn * kt + k)) / 2
        for k, (turn, amplitude) in enumerate(WAVER)
    ]
    return np.array([*shadow.flame, 1.0]) + shadow.flicker * np.array([*moved, 0.0])


class Receiver(NamedTuple):
    """A surface that receives shadows: its plane, two corners of a box around it, its triangles.

    ``send`` sends the triangles that face the viewer.
    """

    plane: np.ndarray
    corners: np.ndarray
    send: Callable[[], None]


def on_floor(send: Callable[[], None]) -> Receiver:
    """Return the floor as a receiver."""
    inside = plan.INSIDE
    corners = [[inside.west, 0.0, inside.north], [inside.east, 0.0, inside.south]]
    return Receiver(FLOOR_PLANE, np.array(corners), send)


def on_north(send: Callable[[], None]) -> Receiver:
    """Return the north wall as a receiver."""
    inside = plan.INSIDE
    corners = [[inside.west, 0.0, inside.north], [inside.east, plan.CROWN, inside.north]]
    return Receiver(NORTH_PLANE, np.array(corners), send)


def reached(points: np.ndarray, receiver: Receiver, light: np.ndarray) -> np.ndarray | None:
    """Return two corners (2, 3) of the part of a receiver that shadows of a box may reach.

    ``points`` (n, 3) are the box's corners. None if the shadows miss the receiver.
    """
    shadows = shadows_of(points, receiver.plane, light)
    endless = np.isnan(shadows).any(axis=1)
    if endless.all():
        return None
    if endless.any():
        # What is as far from the plane as the light has its shadow infinitely far away from it.
        normal = receiver.plane[:3]
        away = points[endless] - light[:3]
        away -= np.outer(away @ normal, normal)
        shadows[endless] = points[endless] + FAR_AWAY * away
    low = np.maximum(shadows.min(axis=0), receiver.corners[0] - MARGIN)
    high = np.minimum(shadows.max(axis=0), receiver.corners[1] + MARGIN)
    return np.stack([low, high]) if (low <= high).all() else None


def rectangle(ends: np.ndarray, plane: np.ndarray) -> np.ndarray:
    """Return the corners (4, 3), one after the other, of a rectangle on FLOOR or NORTH_PLANE.

    ``ends`` (2, 3) are two that face each other.
    """
    (low, high), (across, up) = ends, (0, 2) if plane[1] else (0, 1)
    found = np.tile((low + high) / 2, (4, 1))
    found[:, across] = np.array([low, high, high, low])[:, across]
    found[:, up] = np.array([low, low, high, high])[:, up]
    return found


class PlanarShadow:
    """The shadows of what ``cast`` sends."""

    def __init__(self, settings: Settings, cast: Callable[[Frame], None], box: np.ndarray) -> None:
        """Take the function that sends what casts the shadows, and two corners of its box."""
        self._settings, self._cast = settings, cast
        self._box = np.array([[box[i][0], box[j][1], box[k][2]]
                              for i in (0, 1) for j in (0, 1) for k in (0, 1)])  # fmt: skip

    def apply(self, settings: Settings) -> bool:
        """Apply new settings; nothing is built from them."""
        self._settings = settings
        return True

    @property
    def relights(self) -> bool:
        """Whether receivers are drawn again without a light; only a stencil makes that possible."""
        return self._settings.shadow.method == "relight" and self._settings.shadow.stencil

    def lights(self, frame: Frame, receiver: Receiver) -> dict[str, tuple[np.ndarray, Part | None]]:
        """Return the lights, each (4,), that may cast shadows on a receiver in view, by name.

        Beside each is the part of the picture that its shadow is in, None for all of it.
        """
        wanted = self._settings.shadow
        found = {}
        if wanted.light in ("sun", "both"):
            found["sun"] = np.append(sun.direction(self._settings.sun), 0.0)
        if wanted.light in ("torch", "both"):
            found["torch"] = flame(frame.kt, wanted)
        if not wanted.behind:
            return {name: (light, None) for name, light in found.items()}
        seen: dict[str, tuple[np.ndarray, Part | None]] = {}
        for name, light in found.items():
            if (corners := reached(self._box, receiver, light)) is not None:
                outline = rectangle(corners, receiver.plane)
                if part := part_of_polygon(frame, outline):
                    seen[name] = light, part
        return seen

    def darken(self, frame: Frame, receiver: Receiver) -> None:
        """Darken a receiver that has been drawn where the lights' rays do not reach it."""
        inside = self._inside(frame)
        with self._shadowing():
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glColor4f(0.0, 0.0, 0.0, self._settings.shadow.strength)
            for light, _ in self.lights(frame, receiver).values():
                if self._settings.shadow.stencil:
                    self._mark(inside, receiver)
                    gl.glStencilFunc(gl.GL_EQUAL, inside | RECEIVER, inside | RECEIVER)
                    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_ZERO)
                    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
                self._flatten(frame, receiver, light)
        # In Mesa glPopAttrib does not restore a colour that nothing was drawn with.
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    def parts(self, frame: Frame, receiver: Receiver) -> Iterator[tuple[str, ...]]:
        """Divide a receiver by its shadows; yield the names of the lights that each part lacks.

        What is drawn until the next step shows in that part alone. The first lacks none.
        """
        inside, lights = self._inside(frame), self.lights(frame, receiver)
        if not lights:
            yield ()
            return
        with self._shadowing():
            self._mark(inside, receiver)
            for name, (light, _) in lights.items():
                bit = SHADED[name]
                gl.glStencilMask(bit)
                gl.glStencilFunc(gl.GL_EQUAL, inside | RECEIVER | bit, inside | RECEIVER)
                self._flatten(frame, receiver, light)
        groups = gl.GL_ENABLE_BIT | gl.GL_STENCIL_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups | gl.GL_SCISSOR_BIT):
            gl.glEnable(gl.GL_STENCIL_TEST)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
            gl.glDepthFunc(gl.GL_LEQUAL)
            for count in range(len(lights) + 1):
                for without in combinations(lights, count):
                    if not restrict([lights[name][1] for name in without]):
                        continue
                    bits = inside | RECEIVER | sum(SHADED[name] for name in without)
                    gl.glStencilFunc(gl.GL_EQUAL, bits, inside | ALL)
                    yield without

    def _inside(self, frame: Frame) -> int:
        """Return the bit that pixels must have: in a mirror image, where the floor is visible."""
        return FLOOR if frame.mirrored and self._settings.mirror.stencil else 0

    @contextmanager
    def _shadowing(self) -> Iterator[None]:
        """Let shadows be drawn without a depth of their own."""
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        groups |= gl.GL_STENCIL_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT
        with drawing("shadow"), attrib(groups):
            gl.glDepthMask(gl.GL_FALSE)
            gl.glDepthFunc(gl.GL_LEQUAL)
            yield

    @staticmethod
    def _mark(inside: int, receiver: Receiver) -> None:
        """Mark where the receiver is visible, and forget former shadows on it.

        Only inside _shadowing(); colour stays masked.
        """
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilMask(ALL)
        gl.glStencilFunc(gl.GL_EQUAL, inside | RECEIVER, inside)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
        receiver.send()

    def _flatten(self, frame: Frame, receiver: Receiver, light: np.ndarray) -> None:
        """Send the statue, flattened onto the receiver's plane along the light's rays."""
        values = self._settings.shadow
        if values.offset:
            gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glPolygonOffset(*OFFSET)
        flattened = shadow_matrix(receiver.plane, light)
        for signed in (flattened,) if values.behind else (flattened, -flattened):
            # What faces the light has the same shadow as the whole, of half the triangles.
            with matrix(), front_faces():
                gl.glMultMatrixf(np.ascontiguousarray(signed.T, np.float32))
                self._cast(frame)

    def release(self) -> None:
        """Nothing was made in OpenGL."""


def restrict(parts: Sequence[Part | None]) -> bool:
    """Draw only where all of these parts of the picture are; False if they have none in common."""
    known = [each for each in parts if each]
    if not known:
        return True
    x, y = max(each.x for each in known), max(each.y for each in known)
    width = min(each.x + each.width for each in known) - x
    height = min(each.y + each.height for each in known) - y
    if width <= 0 or height <= 0:
        return False
    gl.glEnable(gl.GL_SCISSOR_TEST)
    gl.glScissor(x, y, width, height)
    return True
