"""The torches' fire, fuller, with a halo, and its light on the ground (``castle.glow``).

Technique: two flames of the sheet for each torch, both added, so that fire is white where it is
thick, and one blended beneath, weakly, so that its rim has a colour before a bright wall; no finer
mip level than the third (GL_TEXTURE_MIN_LOD, OpenGL 1.2), so that they have no edge up close; a
soft disc that is added over them; and a patch on the ground and on the wall, drawn with
glBlendFunc(GL_DST_COLOR, GL_ONE), which brightens what is there in proportion to its colour. All
flicker with kt. What is added must not be fogged to the fog's colour but fade: the fog's colour is
black meanwhile.
Own frame: that of the castle. State used: as castle_fire.py; fog colour.
"""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays
from framelens.gl.texture import Texture
from landscape.elements.castle_fire import FLAME_Z, TORCHES, flame_across, flame_frame
from landscape.frame import Frame
from landscape.geometry.mesh import grid_triangles
from landscape.gl.features import possible

# All chosen.
SIDE = 64  # texels of the disc
FLAMES = ((0.052, 0.206, 0.350, 0, False), (0.040, 0.206, 0.315, 7, True))
"""Half width, height from and to, frames ahead, whether mirrored, of a torch's flames."""
BODY = 0.35  # opacity of a flame, which is light and hardly hides the wall
SOFTER = 2.0  # the finest mip level of a flame: up close it has no edge
FINEST = -1000.0  # the finest mip level of a texture as OpenGL begins with it
HALO, HALO_Y = 0.19, 0.265  # radius and middle of the disc
COLOUR = np.array([1.0, 0.52, 0.18])
BY_DAY = 0.22  # how much of the glow is seen by day
GROUND = 0.55  # radius of the patch on the ground
RINGS, SECTORS = 5, 16


def disc() -> np.ndarray:
    """Return a soft disc, uint8 (SIDE, SIDE, 1)."""
    axis = (np.arange(SIDE) + 0.5) / SIDE * 2 - 1
    far = np.hypot(axis[:, None], axis[None, :])
    soft = 0.75 * np.clip(1 - far, 0, 1) ** 2.2 + 0.25 * np.exp(-((far / 0.16) ** 2))
    return np.asarray(np.clip(soft, 0, 1) * 255 + 0.5, np.uint8)[..., None]


def flicker(kt: float, torch: int) -> float:
    """Return the strength of a torch's light at ``kt``, about 1."""
    t = kt + 17.0 * torch
    return (
        1.0 + 0.09 * math.sin(0.61 * t) + 0.06 * math.sin(1.37 * t + 1) + 0.05 * math.sin(0.23 * t)
    )


def lit_patch(ground: Callable[[np.ndarray], np.ndarray], x: float) -> tuple[np.ndarray, ...]:
    """Return a torch's patch on the ground: vertices (n, 3), strength (n, 1), triangles (m, 3)."""
    share = np.linspace(0.0, 1.0, RINGS)[:, None]
    turn = np.linspace(math.pi, 2 * math.pi, SECTORS)
    at_x, at_z = x + GROUND * share * np.cos(turn), GROUND * share * np.sin(turn) - 0.002
    flat = np.stack([at_x.ravel(), at_z.ravel()], axis=1)
    y = ground(flat) + 0.004
    far = np.hypot(flat[:, 0] - x, flat[:, 1] - FLAME_Z)
    strength = 1.0 / (1.0 + (far / 0.17) ** 2) * np.clip(4.0 * (1.0 - far / GROUND), 0.0, 1.0)
    strength = strength * (1.0 - np.repeat(share[:, 0], SECTORS) ** 6)
    vertices = np.stack([flat[:, 0], y, flat[:, 1]], axis=1).astype(np.float32)
    return vertices, strength[:, None].astype(np.float32), grid_triangles(SECTORS, RINGS)


@contextmanager
def softer(level: float) -> Iterator[None]:
    """Let the texture that is bound be looked up in no finer mip level in the block."""
    if not possible("a number of mip levels"):
        yield
        return

    gl.glTexParameterf(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_LOD, level)
    try:
        yield
    finally:
        gl.glTexParameterf(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_LOD, FINEST)


class TorchGlow:
    """Flames and their light."""

    def __init__(self, ground: Callable[[np.ndarray], np.ndarray]) -> None:
        """Make the disc and the patches on the ground, whose height at places is ``ground``."""
        self._disc = Texture(disc(), repeat=False)
        self._patches = [lit_patch(ground, x) for x in TORCHES]

    def draw(
        self,
        frame: Frame,
        sheet: Texture,
        eye: tuple[float, float] | None,
        glow: float,
        torches: float,
    ) -> None:
        """Draw all of it; flames face the ``eye`` (x, z) if it is given."""
        strength = glow * (BY_DAY + (1.0 - BY_DAY) * torches)
        groups = gl.GL_FOG_BIT | gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT
        groups |= gl.GL_DEPTH_BUFFER_BIT | gl.GL_POLYGON_BIT | gl.GL_TEXTURE_BIT
        with attrib(groups):
            gl.glDisable(gl.GL_LIGHTING)
            gl.glEnable(gl.GL_BLEND)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glEnable(gl.GL_TEXTURE_2D)
            sheet.bind()
            with softer(SOFTER):
                gl.glColor4f(1.0, 1.0, 1.0, BODY)
                gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
                self._send(self._flames(frame.kt, eye, 0))
                gl.glFogfv(gl.GL_FOG_COLOR, np.zeros(4, np.float32))
                gl.glColor4f(1.0, 1.0, 1.0, 1.0)
                gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE)
                self._send(self._flames(frame.kt, eye, 0))
                self._send(self._flames(frame.kt, eye, 1))
            gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
            self._disc.bind()
            for number, x in enumerate(TORCHES):
                part = strength * flicker(frame.kt, number)
                gl.glColor3f(*(part * COLOUR).tolist())
                self._send(self._halo(x, eye))

            if torches > 0.0:
                self._light_ground(frame.kt, glow * torches)

    def _light_ground(self, kt: float, strength: float) -> None:
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glBlendFunc(gl.GL_DST_COLOR, gl.GL_ONE)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(-3.0, -6.0)
        for number, (vertices, share, triangles) in enumerate(self._patches):
            colours = np.float32(1.8 * strength * flicker(kt, number)) * share * np.float32(COLOUR)
            with client_arrays(vertices, None, np.ascontiguousarray(colours, np.float32)):
                gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)

    @staticmethod
    def _send(corners: np.ndarray) -> None:
        gl.glPushClientAttrib(gl.GL_CLIENT_VERTEX_ARRAY_BIT)
        gl.glInterleavedArrays(gl.GL_T2F_V3F, 0, corners)
        gl.glDrawArrays(gl.GL_QUADS, 0, len(corners))
        gl.glPopClientAttrib()

    @staticmethod
    def _flames(kt: float, eye: tuple[float, float] | None, which: int) -> np.ndarray:
        half, low, high, ahead, turned = FLAMES[which]
        corners = []
        for number, x in enumerate(TORCHES):
            column, row = flame_frame(kt + 2 * (ahead + 5 * number))
            s0, t0 = 0.25 * column, 0.25 * row
            s1 = s0 + 0.25
            if turned:
                s0, s1 = s1, s0
            dx, dz = flame_across(eye or (x, -1.0), x, eye is not None)
            for s, t, along, y in (
                (s0, t0 + 0.25, -half, low),
                (s0, t0, -half, high),
                (s1, t0, half, high),
                (s1, t0 + 0.25, half, low),
            ):
                corners.append((s, t, x + along * dx, y, FLAME_Z + along * dz))
        return np.array(corners, np.float32)

    @staticmethod
    def _halo(x: float, eye: tuple[float, float] | None) -> np.ndarray:
        dx, dz = flame_across(eye or (x, -1.0), x, eye is not None)
        return np.array(
            [
                (
                    s,
                    t,
                    x + (2 * s - 1) * HALO * dx,
                    HALO_Y + (1 - 2 * t) * HALO,
                    FLAME_Z + (2 * s - 1) * HALO * dz,
                )
                for s, t in ((0, 1), (1, 1), (1, 0), (0, 0))
            ],
            np.float32,
        )

    def release(self) -> None:
        """Delete the disc; may be called twice."""
        self._disc.release()
