"""The torches' flames, and the glow around them.

Technique: one texture holds 4 x 4 pictures of a flame (elements/castle_fire.py); a quad at each
torch turns about y to face the eye and shows one of them, each torch another. Around each lies a
second quad, parallel to the screen, whose radial gradient is added to the picture: the halo that
bright things have in air and eye. It swells and shrinks a little, as the flame does. Both are
blended and write no depth. The light on the stone around is in the light map, which does not move.
Where the flame of the torch beside the pool has been taken from its stand (``shadow.flame``), it
burns in a bowl that hangs from the vault: a mesh and a line in plain colours.
State used: GL_TEXTURE_2D, GL_BLEND, the depth mask, the line width.
What is wrong without it: with ``torches.faces`` off the quads keep to one plane, and a flame
vanishes when it is seen from the side; with ``torches.glow`` 0 the flames look painted.
"""

import math

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, line_width, matrix
from framelens.gl.texture import Texture
from landscape.elements.castle_fire import flame_frame
from landscape.elements.element import Element
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh, merged
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.hall import plan
from landscape.hall.ornaments import torch
from landscape.hall.settings import Settings, Shadow
from landscape.hall.surfaces import mesh

WIDTH, HEIGHT = 0.026, 0.062  # chosen: of a flame
SUNK = 0.008  # chosen: so deep within the bowl it begins
HALO = 0.12  # chosen: radius of the glow, in units
COLOUR = (1.0, 0.56, 0.22)  # chosen
FLICKER = 0.12  # chosen: the glow's change, as a fraction
SIDE = 64  # of the glow's texture
IRON = (0.30, 0.22, 0.17)  # chosen: RGB of a bowl that hangs, in the light of its flame


def hanging(shadow: Shadow) -> bool:
    """Return whether the first torch's flame is elsewhere than on its stand."""
    x, y, z = plan.TORCH
    return math.dist(shadow.flame, (x, y + plan.TORCH_FLAME, z)) > 1e-3


def bowl() -> Mesh:
    """Return an iron bowl whose flame begins at height 0, darker where it faces downwards."""
    whole = merged([mesh(each, 1.0, each.on_material) for each in torch(0.0, 0.0, 0.0)])
    shade = 0.55 + 0.45 * whole.normals[:, 1:2]
    colors = np.rint(255.0 * shade * np.array(IRON)).astype(np.uint8)
    return Mesh(whole.vertices, whole.normals, whole.triangles, (), np.ascontiguousarray(colors))


def halo_image() -> np.ndarray:
    """Return the glow, uint8 (SIDE, SIDE, 3): bright in the middle, black at the edge."""
    axis = (np.arange(SIDE) + 0.5) / SIDE * 2 - 1
    radius = np.minimum(np.hypot(axis[:, None], axis[None, :]), 1.0)
    light = 0.38 * (1 - radius) ** 2 + 0.65 * np.maximum(1 - radius / 0.56, 0.0) ** 2
    return np.asarray(255 * light[..., None] * np.array(COLOUR) + 0.5, np.uint8)


def torches(shadow: Shadow) -> np.ndarray:
    """Return where the torches are, (n, 3); the first casts the statue's shadow."""
    x, y, z = shadow.flame
    return np.array([(x, y - plan.TORCH_FLAME, z), *plan.PILLAR_TORCHES])


def flames(places: np.ndarray, eye: np.ndarray, kt: float, faces: bool = True) -> np.ndarray:
    """Return the flames' corners, float32 (4 n, 5): s, t, x, y, z, counter-clockwise to the eye.

    ``places`` (n, 3) are the torches'. Row 0 of a picture is the flame's top.
    """
    away = places[:, [0, 2]] - eye[[0, 2]] if faces else np.tile([0.0, -1.0], (len(places), 1))
    away = away / np.maximum(np.linalg.norm(away, axis=1, keepdims=True), 1e-6)
    across = np.stack([-away[:, 1], np.zeros(len(away)), away[:, 0]], axis=1)
    found = np.empty((len(places), 4, 5), np.float32)
    for number in range(len(places)):
        column, row = flame_frame(kt + 10.0 * number)
        found[number, :, 0] = 0.25 * (column + np.array([0, 1, 1, 0]))
        found[number, :, 1] = 0.25 * (row + np.array([1, 1, 0, 0]))
    for k, (aside, up) in enumerate(((-1, 0), (1, 0), (1, 1), (-1, 1))):
        found[:, k, 2:] = places + aside * WIDTH * across
        found[:, k, 3] += up * HEIGHT - SUNK
    return found.reshape(-1, 5)


def halos(
    places: np.ndarray, right: np.ndarray, up: np.ndarray, kt: float, strength: float
) -> np.ndarray:
    """Return the glows' corners, float32 (4 n, 8): s, t, red, green, blue, x, y, z."""
    found = np.empty((len(places), 4, 8), np.float32)
    for number in range(len(places)):
        beat = math.sin(0.61 * kt + 2.1 * number) + math.sin(0.23 * kt + 1.3 * number)
        found[number, :, 2:5] = strength * (1 + FLICKER * beat / 2)
    middles = places + (0.0, plan.TORCH_FLAME, 0.0)
    for k, (a, b) in enumerate(((-1, -1), (1, -1), (1, 1), (-1, 1))):
        found[:, k, :2] = (a + 1) / 2, (b + 1) / 2
        found[:, k, 5:] = middles + HALO * (a * right + b * up)
    return found.reshape(-1, 8)


class Torches(Element[Settings]):
    """The flames."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the pictures of the flame and make that of the glow."""
        self.settings = settings
        self._fire = Texture(read_image(assets.path("fire.png")), repeat=False)
        self._halo = Texture(halo_image(), repeat=False)
        lamp = bowl()
        self._bowl = DisplayList(lambda: draw_mesh(lamp))

    def draw(self, frame: Frame) -> None:
        """Blend the flames, then add their glow; before them, the bowl that hangs, if one does."""
        values, places = self.settings.torches, torches(self.settings.shadow)
        if hanging(self.settings.shadow):
            self._draw_bowl(frame, *places[0].tolist())
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT):
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glEnable(gl.GL_BLEND)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glColor3f(1.0, 1.0, 1.0)
            self._fire.bind()
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            send(gl.GL_T2F_V3F, flames(places, frame.eye, frame.kt, values.faces))
            if values.glow > 0.0:
                self._halo.bind()
                gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
                send(gl.GL_T2F_C3F_V3F, halos(places, frame.right, frame.up, frame.kt, values.glow))

    def _draw_bowl(self, frame: Frame, x: float, y: float, z: float) -> None:
        """Draw the bowl at a place, and its chain up into the vault."""
        with attrib(gl.GL_CURRENT_BIT | gl.GL_LINE_BIT):
            with matrix():
                gl.glTranslatef(x, y, z)
                self._bowl.call()
            gl.glColor3f(*IRON)
            line_width(frame.size[1] / 400)
            gl.glBegin(gl.GL_LINES)
            gl.glVertex3f(x, y + 0.002, z)
            gl.glVertex3f(x, plan.CROWN, z)
            gl.glEnd()
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    def release(self) -> None:
        """Delete the list and the textures; may be called twice."""
        self._bowl.release()
        self._fire.release()
        self._halo.release()


def send(layout: int, corners: np.ndarray) -> None:
    """Send quads from an interleaved array."""
    gl.glPushClientAttrib(gl.GL_CLIENT_VERTEX_ARRAY_BIT)
    gl.glInterleavedArrays(layout, 0, corners)
    gl.glDrawArrays(gl.GL_QUADS, 0, len(corners))
    gl.glPopClientAttrib()
