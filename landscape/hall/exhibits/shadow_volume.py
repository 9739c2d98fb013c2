"""A knot of bronze whose shadow is counted in the stencil buffer (SIGGRAPH 1997, shadow volumes).

Technique: the knot's silhouette, seen from the torch, is drawn away from it; that encloses all that
is in the shadow (Crow 1977; geometry/silhouette.py). The alcove is drawn in the hall's light alone.
Then the volume's faces that lie in front of what has been drawn are counted in the stencil buffer:
+1 for each that faces the viewer, -1 for each that is turned away (Heidmann 1991). Where the count
is 0, the torch's light is added. The volume is made anew for each frame, as the torch flickers.
What is wrong without its safeguards: this count (z-pass) assumes that the eye is outside of the
volume. Inside, or where the near plane cuts it open, all counts are short by one: look from the
wall behind the knot. ``exhibits.volume_count=zfail`` counts the faces behind what has been drawn
instead, wherever the eye is; but then ``exhibits.volume_caps`` must close the volume at both ends.
``exhibits.volume_shown`` draws the volume.
State used: the stencil buffer with GL_INCR_WRAP and GL_DECR_WRAP (OpenGL 1.4), scissor test, colour
and depth masks, culling, GL_LIGHT2, blending.
"""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, matrix
from framelens.gl.texture import Texture
from landscape.elements.castle_fire import flame_frame
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh, revolve, vertex_normals
from landscape.geometry.silhouette import shadow_volume
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.features import possible
from landscape.hall import plan
from landscape.hall.exhibits import niche
from landscape.hall.exhibits.exhibit import Exhibit
from landscape.hall.exhibits.niche import MIDDLE, TOP, VOLUME, Stone, lit_by, pedestal_boxes, shiny
from landscape.hall.exhibits.picture import draw_within, part_of
from landscape.hall.settings import Settings

BRONZE = (0.80, 0.52, 0.22)  # chosen
ALONG, AROUND = 72, 9  # chosen: vertices of the knot along it and around it
SIZE, TUBE = 0.0165, 0.0075  # chosen: units: scale of the trefoil, and radius of its tube
HEIGHT = TOP + 0.058  # height of the knot's middle
TURN = 0.5  # chosen: degrees that the knot turns in a kt
BIAS = 4.0  # chosen: steps of depth that the volume lies behind the surfaces it begins at
TIMES = 9.0  # chosen: how far the volume reaches, in distances from the torch
FLICKER = 0.0022  # chosen: units that the flame's light moves
FLAME = (0.022, 0.062)  # chosen: half the width of the flame, and its height
LOW = 0.4  # chosen: how far the flame begins below its light, in its heights
IRON = (0.46, 0.39, 0.34)  # chosen
BOWL = (  # radius, height
    (0.0015, -0.024),
    (0.0045, -0.019),
    (0.0072, -0.011),
    (0.0085, -0.004),
    (0.0098, -0.002),
    (0.0098, 0.0),
    (0.0084, 0.001),
)
VEIL = (1.0, 0.75, 0.25, 0.16)  # chosen: RGBA of the volume where it is shown

Volume = tuple[np.ndarray, np.ndarray]  # vertices (n, 3), triangles (m, 3)


def trefoil() -> Mesh:
    """Return a knot in a tube, closed, upright in the plane x = 0 around the origin, in units."""
    t = np.arange(ALONG) / ALONG * 2 * np.pi

    # The trefoil on a torus: three loops, interlaced.
    line = np.stack(
        [-np.sin(3 * t), np.cos(t) - 2 * np.cos(2 * t), np.sin(t) + 2 * np.sin(2 * t)], axis=1
    )
    ahead = np.roll(line, -1, axis=0) - np.roll(line, 1, axis=0)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    out = np.cross(ahead, line)
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    side = np.cross(ahead, out)
    angle = (np.arange(AROUND) / AROUND * 2 * np.pi)[None, :, None]
    ring = np.cos(angle) * out[:, None] + np.sin(angle) * side[:, None]
    vertices = (SIZE * line[:, None] + TUBE * ring).reshape(-1, 3).astype(np.float32)
    k, j = (each.ravel() for each in np.mgrid[:ALONG, :AROUND])
    after, beside = (k + 1) % ALONG, (j + 1) % AROUND
    a, b = k * AROUND + j, after * AROUND + j
    c, d = after * AROUND + beside, k * AROUND + beside
    quads = np.stack([a, c, b, a, d, c], axis=1).reshape(-1, 3)
    triangles = np.ascontiguousarray(quads, np.uint32)
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles)


def torch(kt: float) -> tuple[float, float, float]:
    """Return the place of the torch's light, which flickers."""
    x, y, z = niche.lamp(VOLUME)
    sway = math.sin(0.31 * kt) + 0.6 * math.sin(0.83 * kt + 1.0)
    return x, y + FLICKER * math.sin(0.53 * kt), z + FLICKER * sway


class ShadowVolume(Exhibit):
    """The knot, its torch and its shadow."""

    def __init__(self, settings: Settings, assets: Assets, stone: Stone) -> None:
        """Compile the knot; ``stone`` draws the alcove."""
        self.settings, self._stone = settings, stone
        self._fire = Texture(read_image(assets.path("fire.png"), "RGBA"), repeat=False)
        self.place = MIDDLE, HEIGHT, plan.ALCOVES[VOLUME]
        self.knot = knot = trefoil()
        self.pedestal = pedestal_boxes(plan.ALCOVES[VOLUME])
        self._list = DisplayList(lambda: draw_mesh(knot))
        self._holder = DisplayList(send_holder)
        self._wrap = possible("exhibits.volume")

    def draw_plain(self, frame: Frame) -> None:
        """Draw the knot without its shadow; the alcove is drawn already."""
        light = torch(frame.kt)
        with lit_by(light):
            self._send_knot(frame.kt)
        self._draw_torch(frame, light)

    def draw(self, frame: Frame) -> None:
        """Draw alcove, knot, shadow and torch."""
        z, half = plan.ALCOVES[VOLUME], plan.ALCOVE_HALF
        west, east = plan.INSIDE.west - plan.ALCOVE_DEPTH, plan.INSIDE.west
        part = part_of(frame, (west, 0.0, z - half), (east, plan.ALCOVE_TOP, z + half))
        if part is None:
            return
        light = torch(frame.kt)
        self._stone.draw([VOLUME], "day")
        with lit_by(light, power=0.0):
            self._send_knot(frame.kt)
        groups = gl.GL_SCISSOR_BIT | gl.GL_STENCIL_BUFFER_BIT
        with attrib(groups):
            draw_within(frame, *part[:4])
            self.count(frame.kt)
            self._add_light(frame.kt)
            # The floor's mirror, too, finds the stencil buffer empty.
            gl.glClear(gl.GL_STENCIL_BUFFER_BIT)

        self._draw_torch(frame, light)
        if self.settings.exhibits.volume_shown:
            self._show_volume(frame.kt)

    def _send_knot(self, kt: float) -> None:
        gl.glColor3f(*BRONZE)
        shiny(0.9, 40.0)
        with self._turned(kt):
            self._list.call()

    @contextmanager
    def _turned(self, kt: float) -> Iterator[None]:
        """Draw the block's models where the knot is, which turns."""
        with matrix():
            gl.glTranslatef(*self.place)
            gl.glRotatef(TURN * kt, 0.0, 1.0, 0.0)
            yield

    def volumes(self, kt: float, caps: bool) -> tuple[Volume, Volume]:
        """Return the shadow volumes of the knot, in its own space, and of the pedestal.

        The light is turned the other way instead of the knot.
        """
        light, angle = np.array(torch(kt)), math.radians(TURN * kt)
        x, y, z = light - self.place
        c, s = math.cos(angle), math.sin(angle)
        own = np.array([c * x - s * z, y, s * x + c * z])
        knot = shadow_volume(self.knot.vertices, self.knot.triangles, own, TIMES, caps)
        return knot, shadow_volume(*self.pedestal, light, TIMES, caps)

    def _send_volumes(self, kt: float, volumes: tuple[Volume, Volume]) -> None:
        with self._turned(kt):
            send(*volumes[0])
        send(*volumes[1])

    def count(self, kt: float) -> None:
        """Count in the stencil buffer, from 0, how often each pixel's surface is in the shadow."""
        values = self.settings.exhibits
        behind = values.volume_count == "zfail"
        caps = behind and values.volume_caps
        volumes = self.volumes(kt, caps)
        more = gl.GL_INCR_WRAP if self._wrap else gl.GL_INCR
        less = gl.GL_DECR_WRAP if self._wrap else gl.GL_DECR
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups | gl.GL_POLYGON_BIT | gl.GL_STENCIL_BUFFER_BIT):
            gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glDepthFunc(gl.GL_LESS)
            gl.glEnable(gl.GL_STENCIL_TEST)
            gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
            gl.glEnable(gl.GL_CULL_FACE)

            # The near cap must lie behind the surface that it equals.
            gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glPolygonOffset(0.0, BIAS)

            # Counted up before down: without wrapping, a count stops at 0.
            for culled, change in (
                (gl.GL_FRONT if behind else gl.GL_BACK, more),
                (gl.GL_BACK if behind else gl.GL_FRONT, less),
            ):
                gl.glCullFace(culled)
                if behind:
                    gl.glStencilOp(gl.GL_KEEP, change, gl.GL_KEEP)
                else:
                    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, change)
                self._send_volumes(kt, volumes)

    def _add_light(self, kt: float) -> None:
        """Add the torch's light where the count is 0."""
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups | gl.GL_STENCIL_BUFFER_BIT):
            gl.glEnable(gl.GL_STENCIL_TEST)
            gl.glStencilFunc(gl.GL_EQUAL, 0, 0xFF)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glDepthFunc(gl.GL_EQUAL)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
            self._stone.draw([VOLUME], "lamp")
            with lit_by(torch(kt), (0.0, 0.0, 0.0)):
                self._send_knot(kt)

    def _draw_torch(self, frame: Frame, light: tuple[float, float, float]) -> None:
        """Draw the torch's bowl, and its flame, turned to the viewer."""
        with lit_by(light):
            gl.glColor3f(*IRON)
            self._holder.call()
        half, height = FLAME
        x, y, z = light
        right = frame.right[[0, 2]] / max(float(np.hypot(*frame.right[[0, 2]])), 1e-6) * half
        column, row = flame_frame(frame.kt)
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups):
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._fire.bind()
            gl.glBegin(gl.GL_QUADS)
            for s, t in ((0, 1), (1, 1), (1, 0), (0, 0)):
                gl.glTexCoord2f(0.25 * (column + s), 0.25 * (row + t))
                side = 2 * s - 1
                low = y - LOW * height
                gl.glVertex3f(x + side * right[0], low + (1 - t) * height, z + side * right[1])

            gl.glEnd()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def _show_volume(self, kt: float) -> None:
        """Draw the volumes' sides, transparent."""
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups | gl.GL_CURRENT_BIT):
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glColor4f(*VEIL)
            self._send_volumes(kt, self.volumes(kt, False))
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    def release(self) -> None:
        """Delete list and texture; may be called twice."""
        self._list.release()
        self._holder.release()
        self._fire.release()


def send_holder() -> None:
    """Send the torch's bowl and the bar that holds it."""
    x, y, z = niche.lamp(VOLUME)
    y -= LOW * FLAME[1]
    wall = plan.ALCOVES[VOLUME] + plan.ALCOVE_HALF
    draw_mesh(niche.block(x, (z + wall) / 2, (0.0016, (wall - z) / 2), y - 0.017, y - 0.013))
    bowl = revolve(BOWL, 24, (1.0, 1.0))
    draw_mesh(replace(bowl, vertices=bowl.vertices + np.array([x, y + 0.004, z], np.float32)))


def send(vertices: np.ndarray, triangles: np.ndarray) -> None:
    """Send triangles (m, 3) of vertices (n, 3)."""
    with client_arrays(vertices):
        gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)
