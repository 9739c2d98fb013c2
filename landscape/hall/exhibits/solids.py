"""Solids from solids: a sphere and a beam, combined by the stencil buffer (SIGGRAPH 1997, CSG).

Technique: constructive solid geometry of two convex solids, pixel by pixel (Goldfeather 1989,
Wiegand 1996). A surface of the one belongs to the result where it lies inside the other, or
outside: its depth is drawn, and each face of the other in front of it inverts a bit of the stencil
buffer, which is then set where the surface is inside. There it is drawn in colour, and elsewhere
its depth is taken back.
- difference: the sphere's front outside of the beam, and the beam's back inside the sphere;
- intersection: the front of each inside the other;
- union: both fronts, which needs the depth buffer alone.
The depth that is taken back is the farthest: the exhibit is drawn first of all, into an empty depth
buffer.
What is wrong without its safeguard: without ``exhibits.solids_stencil`` all these surfaces are
drawn whole, and the sphere hides the hole in it.
State used: the stencil bits PARITY and DONE, depth test and range, culling, masks, GL_LIGHT2.
"""

from collections.abc import Callable

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, matrix
from landscape.elements.element import Element
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh, revolve, vertex_normals
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.hall import plan
from landscape.hall.exhibits import niche
from landscape.hall.exhibits.niche import MIDDLE, SOLIDS, TOP, lit_by, shiny
from landscape.hall.exhibits.picture import draw_within, part_of
from landscape.hall.mirror import FLOOR
from landscape.hall.settings import Settings

PARITY, DONE = 2, 4  # stencil bits; the floor's mirror has bit 1
RADIUS = 0.040  # chosen: of the sphere, units
BEAM = (0.060, 0.0215, 0.0215)  # chosen: half its sides, units
HEIGHT = TOP + 0.050  # of the middle
TILT, TURN = 24.0, 0.8  # chosen: degrees, and degrees in a kt
FINE = 5  # chosen: squares along each side of a face of the beam
ENAMEL, GOLD = (0.17, 0.36, 0.80), (0.95, 0.68, 0.24)  # chosen

Send = Callable[[], None]


def sphere() -> Mesh:
    """Return the sphere, with its own normals."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, 19)
    profile = [(RADIUS * float(np.cos(a)), RADIUS * float(np.sin(a))) for a in angle]
    profile[0], profile[-1] = (0.0, -RADIUS), (0.0, RADIUS)
    ball = revolve(profile, 32, (1.0, 1.0))
    normals = ball.vertices / np.linalg.norm(ball.vertices, axis=1, keepdims=True)
    return Mesh(ball.vertices, np.ascontiguousarray(normals, np.float32), ball.triangles)


def beam(inside_out: bool) -> Mesh:
    """Return the beam, finely divided for the light; or the same seen from within."""
    row = FINE + 1
    faces: list[np.ndarray] = []
    t = np.linspace(-1.0, 1.0, FINE + 1)
    u, v = (each.ravel() for each in np.meshgrid(t, t))
    corner = (np.arange(FINE)[:, None] * row + np.arange(FINE)).ravel()
    right = corner + 1
    above = corner + row
    across = corner + row + 1
    quads = np.stack([corner, right, across, corner, across, above], axis=1)
    triangles = []
    for axis in range(3):
        for side in (-1.0, 1.0):
            points = np.empty((row * row, 3))
            points[:, axis], points[:, (axis + 1) % 3], points[:, (axis + 2) % 3] = side, u, v
            flip = (side < 0) != inside_out
            triangles.append(quads.reshape(-1, 3)[:, :: -1 if flip else 1] + row * row * len(faces))
            faces.append(points * BEAM)

    vertices = np.ascontiguousarray(np.concatenate(faces), np.float32)
    joined = np.ascontiguousarray(np.concatenate(triangles), np.uint32)
    return Mesh(vertices, vertex_normals(vertices, joined), joined)


class Solids(Element[Settings]):
    """The sphere, the beam and what is made of them."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Compile the solids."""
        self.settings = settings
        ball = sphere()
        bar = beam(False)
        hole = beam(True)
        self._ball = DisplayList(lambda: draw_mesh(ball))
        self._bar = DisplayList(lambda: draw_mesh(bar))
        self._hole = DisplayList(lambda: draw_mesh(hole))

    def draw(self, frame: Frame) -> None:
        """Draw the result, while the depth buffer is empty."""
        values, z = self.settings.exhibits, plan.ALCOVES[SOLIDS]
        reach = max(BEAM) + RADIUS
        sign = -1.0 if frame.mirrored else 1.0
        heights = sorted((sign * (HEIGHT - reach), sign * (HEIGHT + reach)))
        low, high = (MIDDLE - reach, heights[0], z - reach), (MIDDLE + reach, heights[1], z + reach)
        part = part_of(frame, low, high)
        if part is None:
            return
        ball = self._painted(self._ball, ENAMEL)
        bar, hole = self._painted(self._bar, GOLD), self._painted(self._hole, GOLD)
        parts: tuple[tuple[Send, Send, bool], ...] = {
            "difference": ((ball, bar, False), (hole, ball, True)),
            "intersection": ((ball, bar, True), (bar, ball, True)),
            "union": ((ball, bar, False), (bar, ball, False)),
        }[values.solids_operation]
        groups = gl.GL_STENCIL_BUFFER_BIT | gl.GL_SCISSOR_BIT
        with lit_by(niche.lamp(SOLIDS)), attrib(groups), matrix():
            gl.glTranslatef(MIDDLE, HEIGHT, z)
            gl.glRotatef(TURN * frame.kt, 0.0, 1.0, 0.0)
            gl.glRotatef(TILT, 0.0, 0.0, 1.0)
            shiny(0.8, 50.0)
            draw_within(frame, *part[:4])
            if values.solids_operation == "union" or not values.solids_stencil:
                for surface, _, _ in parts:
                    surface()
                return

            # In the floor's mirror, only where the floor is visible.
            kept = FLOOR if gl.glIsEnabled(gl.GL_STENCIL_TEST) else 0
            gl.glEnable(gl.GL_STENCIL_TEST)
            for surface, other, inside in parts:
                self._draw_part(surface, other, inside, kept)
            gl.glStencilMask(DONE)
            gl.glClear(gl.GL_STENCIL_BUFFER_BIT)

    @staticmethod
    def _painted(solid: DisplayList, colour: tuple[float, float, float]) -> Send:
        """Return the function that sends a solid in its colour."""

        def send() -> None:
            gl.glColor3f(*colour)
            solid.call()

        return send

    @staticmethod
    def _draw_part(surface: Send, other: Send, inside: bool, kept: int) -> None:
        """Draw the part of a surface that is inside another solid, or outside."""
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups | gl.GL_VIEWPORT_BIT | gl.GL_STENCIL_BUFFER_BIT):
            _only_depth(kept)
            surface()
            # Each face of the other solid in front of the surface inverts the bit.
            gl.glDisable(gl.GL_CULL_FACE)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glStencilMask(PARITY)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INVERT)
            other()
            gl.glEnable(gl.GL_CULL_FACE)

            gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
            gl.glDepthFunc(gl.GL_EQUAL)
            gl.glStencilMask(DONE)
            wanted = kept | DONE | (PARITY if inside else 0)
            gl.glStencilFunc(gl.GL_EQUAL, wanted, kept | PARITY)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
            surface()

            # Where it was not drawn in colour, its depth goes back to the farthest.
            _only_depth(kept)
            gl.glDepthMask(gl.GL_TRUE)
            gl.glDepthFunc(gl.GL_ALWAYS)
            gl.glDepthRange(1.0, 1.0)
            surface()
            gl.glStencilMask(PARITY)
            gl.glClear(gl.GL_STENCIL_BUFFER_BIT)

    def release(self) -> None:
        """Delete the lists; may be called twice."""
        for each in (self._ball, self._bar, self._hole):
            each.release()


def _only_depth(kept: int) -> None:
    """Let what is sent change the depth alone, where no part has been drawn yet."""
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glStencilFunc(gl.GL_EQUAL, kept, kept | DONE)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
