"""Caustics on the bed of shallow water: the net of light that waves cast (``water.caustics``).

Technique: the triangles that lie under shallow water are drawn with three texture units more than
the rest of the ground, in the same pass. Two hold frames of a film of caustics, laid over the bed
by generated coordinates; the third holds how strong the net is at a depth, and its coordinate is
generated from the height: so it fades out exactly at the water's edge, wherever that crosses a
triangle. Alpha carries the net through the units: the ground's own last unit mixes the two frames,
the next moves the mix towards mid grey where the net is weak, the third does so on rock, whose
share is the alpha of the vertices, as a net laid over a steep bed would be drawn out into streaks;
the last multiplies the colour by twice that.
The film (elements/caustic_film.py) is a pool's: all its meshes are of one size. On the sea waves of
all lengths focus the light; so the net is the product of the film with itself, once finer and once
coarser, half the film apart in time, and both bent.
Not in the report. Where OpenGL has fewer units, the bed is drawn without the net.
State used: texture units 4 to 6, GL_COMBINE (OpenGL 1.3) and crossbar (1.4), generated coordinates.
"""

import math

import numpy as np

from framelens.gl.named import texture_unit
from framelens.gl.seam import gl
from framelens.gl.state import combine
from framelens.gl.texture import Texture
from landscape.elements.caustic_film import CausticFilm, shipped
from landscape.elements.settings import Settings, Sun
from landscape.files.assets import Assets
from landscape.files.cache import recall
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh
from landscape.gl.display_list import DisplayList
from landscape.gl.features import possible
from landscape.gl.generated import generate_by_planes

LAST = 3  # the last texture unit of the ground itself (materials.py)
DEEPEST = 0.15  # chosen: units of depth at which the net has faded out
EDGE = 0.03  # chosen: units of depth over which it appears at the water's edge
FADING = 1.4  # chosen: exponent of its fading with the depth
REPEAT = 2.1  # chosen: nets per unit
FINER, COARSER = 2, 1  # films across a net, of which the net is the product
BENT = 0.045  # chosen: nets by which both are bent, so that meshes differ in size
FAINTEST = 0.3  # chosen: what the coarser film leaves of the finer one where it is dark
SLANT = 0.4  # chosen: of the height in both coordinates, so that steep beds have no stripes
PERIOD = 260.0  # chosen: kt, length of the film
HIGH = 0.72  # chosen: sine of the sun's elevation from which the net has its full strength
TEXELS = 128  # depths of the texture that fades the net


def wanted(settings: Settings) -> bool:
    """Return whether the settings ask for caustics, on a ground that can show them."""
    water, ground = settings.water, settings.ground
    mixed = ground.materials and ground.units == "both" and ground.tiles > 1
    return water.caustics and water.shallow and mixed


def strength(depth: np.ndarray, sun: Sun) -> np.ndarray:
    """Return how strong the net is at depths (n,) in units, 0..1: 0 on land and in the deep."""
    t = np.clip(depth / EDGE, 0.0, 1.0)
    shallow = np.clip(1.0 - depth / DEEPEST, 0.0, 1.0) ** FADING
    height = min(math.sin(math.radians(sun.elevation)) / HIGH, 1.0)
    return np.asarray(t * t * (3 - 2 * t) * shallow * height)


def fade_picture(sun: Sun) -> np.ndarray:
    """Return the strengths from depth 0 to DEEPEST as a texture, uint8 (1, TEXELS, 1)."""
    depth = np.linspace(0.0, DEEPEST, TEXELS)
    return np.rint(strength(depth, sun) * 255).astype(np.uint8)[None, :, None]


def under_net(mesh: Mesh, level: float) -> np.ndarray:
    """Return which triangles of a mesh, bool (m,), lie under shallow water, where the net is."""
    heights = mesh.vertices[mesh.triangles, 1]
    return np.asarray((heights.min(axis=1) < level) & (heights.max(axis=1) > level - DEEPEST))


def sampled(frames: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return periodic frames (n, h, w) at places in frames, (m, m), bilinear: float32 (n, m, m)."""
    height, width = frames.shape[1:]
    across, down = x * width - 0.5, y * height - 0.5
    column, row = np.floor(across).astype(int), np.floor(down).astype(int)
    u, v = (across - column).astype(np.float32), (down - row).astype(np.float32)
    out = np.zeros((len(frames), *x.shape), np.float32)
    for below, by_row in ((0, 1 - v), (1, v)):
        for aside, by_column in ((0, 1 - u), (1, u)):
            texel = (row + below) % height * width + (column + aside) % width
            out += by_row * by_column * frames.reshape(len(frames), -1)[:, texel]
    return out


def varied(frames: np.ndarray) -> np.ndarray:
    """Return a film, uint8 (n, 2 h, 2 w), of meshes of many sizes from one, uint8 (n, h, w).

    Its frames are as bright on the average.
    """
    turn = 2 * np.pi * (np.arange(2 * frames.shape[1]) + 0.5) / (2 * frames.shape[1])
    x, y = np.meshgrid(turn, turn)
    bent_x = np.sin(y + 0.7 * np.sin(x)) + 0.6 * np.sin(2 * x - y + 1.0)
    bent_y = np.sin(x + 1.9 + 0.7 * np.sin(y)) + 0.6 * np.sin(2 * y + x)
    x, y = x / (2 * np.pi) + BENT * bent_x, y / (2 * np.pi) + BENT * bent_y
    fine = sampled(frames, FINER * x, FINER * y)
    later = np.roll(frames, len(frames) // 2, axis=0)
    coarse = sampled(later, COARSER * y, COARSER * x) / np.float32(later.mean())
    net = fine * (FAINTEST + (1.0 - FAINTEST) * coarse)
    net *= np.float32(frames.mean() / net.mean())
    return np.rint(np.minimum(net, 255.0)).astype(np.uint8)


def sea_film(assets: Assets) -> np.ndarray:
    """Return the film of the sea's net, uint8 (n, h, w), from the cache if it was made before."""
    frames = shipped(assets)
    return recall(("net of light", frames.tobytes()), lambda: (varied(frames),))[0]


class BedLight:
    """Owner of the film and of the texture that fades it."""

    def __init__(self, assets: Assets, level: float, sun: Sun) -> None:
        """Upload the textures, for water at height ``level``."""
        self._film = CausticFilm(sea_film(assets), trilinear=False)
        self._fade = Texture(fade_picture(sun), repeat=False, mipmaps=False)
        self._list = DisplayList(lambda: self._set_units(level))

    @classmethod
    def made(cls, settings: Settings, assets: Assets) -> "BedLight | None":
        """Return the light if it is wanted and there are enough texture units for it."""
        if not wanted(settings) or not possible("water.caustics"):
            return None
        return cls(assets, settings.water.level, settings.sun)

    def _set_units(self, level: float) -> None:
        """Set what is the same in each frame, from the ground's last unit on."""
        env = gl.GL_TEXTURE_ENV
        film = LAST + 1
        fade = LAST + 3
        grey = np.array([0.0, 0.0, 0.0, 0.5], np.float32)

        gl.glActiveTexture(texture_unit(LAST))
        combine({"COMBINE_ALPHA": "INTERPOLATE", "SRC0_ALPHA": f"TEXTURE{film + 1}"})
        combine({"SRC1_ALPHA": f"TEXTURE{film}", "SRC2_ALPHA": "CONSTANT"})

        gl.glActiveTexture(texture_unit(film))
        self._lay_net()
        combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "PREVIOUS"})
        combine({"COMBINE_ALPHA": "INTERPOLATE", "SRC0_ALPHA": "PREVIOUS"})
        combine({"SRC1_ALPHA": "CONSTANT", "SRC2_ALPHA": f"TEXTURE{fade}"})
        gl.glTexEnvfv(env, gl.GL_TEXTURE_ENV_COLOR, grey)

        gl.glActiveTexture(texture_unit(film + 1))
        self._lay_net()
        combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "PREVIOUS"})
        combine({"COMBINE_ALPHA": "INTERPOLATE", "SRC0_ALPHA": "CONSTANT"})
        combine({"SRC1_ALPHA": "PREVIOUS", "SRC2_ALPHA": "PRIMARY_COLOR"})
        gl.glTexEnvfv(env, gl.GL_TEXTURE_ENV_COLOR, grey)

        gl.glActiveTexture(texture_unit(fade))
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._fade.bind()
        combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "PREVIOUS"})
        combine({"OPERAND1_RGB": "SRC_ALPHA"})
        gl.glTexEnvf(env, gl.GL_RGB_SCALE, 2.0)
        combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"})
        self._look_up_depth(level)

    @staticmethod
    def _look_up_depth(level: float) -> None:
        """Let the active unit look up its texture by the depth under the water."""
        # Depth 0 and DEEPEST are at the centres of the first and last texels.
        along, half = (TEXELS - 1) / TEXELS / DEEPEST, 0.5 / TEXELS
        generate_by_planes((0.0, -along, 0.0, level * along + half), (0.0, 0.0, 0.0, 0.5))

    @staticmethod
    def _lay_net() -> None:
        """Let the active unit lay its texture over the ground."""
        gl.glEnable(gl.GL_TEXTURE_2D)
        slant = SLANT * REPEAT
        generate_by_planes((REPEAT, slant, 0.0, 0.0), (0.0, slant, REPEAT, 0.0))

    def lay(self, frame: Frame) -> None:
        """Set the units for what is drawn next, beside those of the ground."""
        self._list.call()
        mix = self._film.bind(frame.kt / PERIOD, True, LAST + 1)
        gl.glActiveTexture(texture_unit(LAST))
        colour = np.array([0.0, 0.0, 0.0, mix], np.float32)
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, colour)

    def release(self) -> None:
        """Delete list and textures; may be called twice."""
        self._list.release()
        self._film.release()
        self._fade.release()
