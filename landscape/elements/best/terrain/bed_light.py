"""Caustics on the bed of shallow water: the net of light that waves cast (``water.caustics``).

Technique: the triangles that lie under shallow water are drawn with three texture units more than
the rest of the ground, in the same pass. Two hold frames of the film of caustics
(elements/caustic_film.py), laid over the bed by generated coordinates; the third holds how strong
the net is at a depth, and its coordinate is generated from the height: so it fades out exactly at
the water's edge, wherever that crosses a triangle. Alpha carries the net through the units: the
ground's own last unit mixes the two frames, the next moves the mix towards mid grey where the net
is weak, and the last multiplies the colour by twice that.
Not in the report. Where OpenGL has fewer units, the bed is drawn without the net.
State used: texture units 4 to 6, GL_COMBINE (OpenGL 1.3) and crossbar (1.4), generated coordinates.
"""

import math

import numpy as np

from framelens.gl.named import texture_unit
from framelens.gl.seam import gl
from framelens.gl.state import combine
from framelens.gl.texture import Texture
from landscape.elements.caustic_film import CausticFilm
from landscape.elements.settings import Settings, Sun
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh
from landscape.gl.display_list import DisplayList
from landscape.gl.features import possible
from landscape.gl.generated import generate_by_planes

LAST = 3  # the last texture unit of the ground itself (materials.py)
DEEPEST = 0.15  # chosen: units of depth at which the net has faded out
EDGE = 0.03  # chosen: units of depth over which it appears at the water's edge
REPEAT = 3.0  # chosen: nets per unit; the waves are larger than a pool's
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
    shallow = np.clip(1.0 - (depth / DEEPEST) ** 2, 0.0, 1.0)
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


class BedLight:
    """Owner of the film and of the texture that fades it."""

    def __init__(self, assets: Assets, level: float, sun: Sun) -> None:
        """Upload the textures, for water at height ``level``."""
        self._film = CausticFilm.shipped(assets, trilinear=False)
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
        combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "PREVIOUS"})
        combine({"OPERAND1_RGB": "SRC_ALPHA"})
        gl.glTexEnvf(env, gl.GL_RGB_SCALE, 2.0)
        combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"})

        gl.glActiveTexture(texture_unit(fade))
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._fade.bind()
        combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "PREVIOUS"})
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
