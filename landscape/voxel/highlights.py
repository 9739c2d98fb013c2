"""Highlights of the sun on blocks, as strong as their material is glossy.

Technique: Blinn and Phong's term needs a normal and an eye at each pixel. Faces of cubes have six
normals, so that the line of sight mirrored by one of them (GL_REFLECTION_MAP, at the vertices) may
be interpolated over a face without error, and a cube map looked up with it gives Phong's term at
each pixel: the sun, blurred by a power. A second pass adds it to the land that is drawn already,
one direction at a time, each with its normal as the current one:
- unit 0 has the tiles once more, each as bright as its material is glossy (GLOSS);
- unit 1 multiplies by the cube map of the sun, turned to the world's axes by the texture matrix;
- unit 2 multiplies by the answer of the shadow map: no highlight in shadow.
Only regions nearby are drawn again; from afar a block is too small for a highlight. It costs about
as much as the land nearby, so that the default is 0.
State used: GL_BLEND, GL_DEPTH_TEST with GL_EQUAL, the current normal, GL_NORMALIZE, units 0 to 2.
What is wrong without: switch ``voxel.highlights``.
"""

from contextlib import ExitStack

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, combine, matrix
from framelens.gl.texture import Texture, mip_levels
from landscape.elements import sun
from landscape.elements.element import Element
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.gl.cube_map import CubeMap, face_directions, generate, texture_matrix
from landscape.voxel.blocks import TILES
from landscape.voxel.faces import DIRECTIONS
from landscape.voxel.land import Choice, Land
from landscape.voxel.mesh import X_Z_Y
from landscape.voxel.settings import Settings
from landscape.voxel.shadow_map import ShadowMap
from landscape.voxel.tile_column import column
from landscape.voxel.tiles import SIDE, tiles

# How much light the materials mirror like a polished one, of 1: others not at all. All chosen.
GLOSS = {
    **{"slate": 0.9, "lamp": 0.8, "hide": 0.6, "snow": 0.45, "snow_side": 0.45},
    **{"planks": 0.35, "brick": 0.25, "rock": 0.2, "sand": 0.15, "gravel": 0.2, "leaves": 0.12},
}
SHARP = 24  # chosen: the power of the cosine; wide enough to fall on some face of a building
TEXELS = 64  # chosen: side of a face of the cube map
LUMA = np.array([0.299, 0.587, 0.114])  # how bright red, green and blue look (Rec. 601)
NORMALS = np.zeros((len(DIRECTIONS), 3))
for _k, _direction in enumerate(DIRECTIONS):
    NORMALS[_k, X_Z_Y[_direction.axis]] = _direction.sign


def glossy(picture: np.ndarray, gloss: float) -> np.ndarray:
    """Return a tile, uint8 (n, n, 3 or 4), in grey, as bright as it is and as its gloss."""
    grey = np.rint(gloss * (picture[..., :3] @ LUMA))[..., None]
    holes = picture[..., 3:] if picture.shape[-1] == 4 else np.full_like(grey, 255)
    return np.concatenate([grey, grey, grey, holes], axis=-1).astype(np.uint8)


def sun_faces(towards: np.ndarray, colour: np.ndarray, strength: float) -> np.ndarray:
    """Return the cube map, uint8 (6, n, n, 3), of a sun in the direction ``towards`` (3,)."""
    cosine = np.maximum(face_directions(TEXELS) @ towards, 0.0)
    light = strength * cosine[..., None] ** SHARP * colour
    return np.rint(255.0 * np.clip(light, 0.0, 1.0)).astype(np.uint8)


class Highlights(Element[Settings]):
    """Owner of the glossy tiles and of the cube map."""

    @classmethod
    def serves(cls, settings: Settings) -> bool:
        """Return whether there are highlights."""
        return settings.voxel.highlights > 0.0

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Upload both."""
        self.settings = settings
        pictures = tiles(assets)
        levels = mip_levels(
            column([glossy(pictures[name], GLOSS.get(name, 0.0)) for name in TILES])
        )[: SIDE.bit_length()]
        largest = int(gl.glGetIntegerv(gl.GL_MAX_TEXTURE_SIZE))
        self._tiles = Texture([level for level in levels if len(level) <= largest])
        self._sun = self._made(settings)

    def _made(self, settings: Settings) -> CubeMap:
        """Return the cube map of the sun of these settings."""
        towards = sun.direction(settings.sun).astype(np.float64)
        colour = np.array(settings.sun.diffuse)
        return CubeMap(sun_faces(towards, colour, settings.voxel.highlights), mipmaps=False)

    def draw(  # type: ignore[override]  # over what of the land the scene has drawn
        self, frame: Frame, land: Land, choice: Choice, shadow: ShadowMap | None
    ) -> None:
        """Add the highlights of the nearby regions of a choice, which have just been drawn."""
        choice = choice.only(choice.shares < len(land.low))
        lit = NORMALS @ sun.direction(self.settings.sun) > 0.0
        if not len(choice.regions):
            return
        groups = gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT
        with ExitStack() as scope:
            scope.enter_context(attrib(groups | gl.GL_FOG_BIT | gl.GL_DEPTH_BUFFER_BIT))
            self._set_units(shadow)
            gl.glActiveTexture(gl.GL_TEXTURE1)
            scope.enter_context(texture_matrix(frame.to_world))
            gl.glActiveTexture(gl.GL_TEXTURE0)
            scope.enter_context(matrix())
            scope.enter_context(land.buffer.bound())
            gl.glScalef(land.scale, land.scale, land.scale)
            gl.glEnable(gl.GL_CULL_FACE)
            gl.glEnable(gl.GL_NORMALIZE)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
            gl.glDepthFunc(gl.GL_EQUAL)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glFogfv(gl.GL_FOG_COLOR, np.zeros(4, np.float32))
            for k in np.flatnonzero(lit).tolist():
                facing = np.zeros_like(choice.facing)
                facing[:, k] = choice.facing[:, k]
                gl.glNormal3f(*NORMALS[k].tolist())
                land.buffer.draw(choice.shares, facing, choice.part, choice.last)
            gl.glActiveTexture(gl.GL_TEXTURE1)  # whose matrix is put back

        gl.glActiveTexture(gl.GL_TEXTURE0)

    def _set_units(self, shadow: ShadowMap | None) -> None:
        """Bind the textures and set the equations of the three units."""
        product = {"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE"}
        if shadow is not None:
            gl.glActiveTexture(gl.GL_TEXTURE2)
            shadow.look_up()
            combine(product | {"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"})
        gl.glActiveTexture(gl.GL_TEXTURE1)
        gl.glEnable(gl.GL_TEXTURE_CUBE_MAP)
        self._sun.bind()
        generate("REFLECTION_MAP")
        combine(product | {"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"})
        gl.glActiveTexture(gl.GL_TEXTURE0)
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._tiles.bind()
        combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "TEXTURE"})
        combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "TEXTURE"})

    def take(self, settings: Settings) -> None:
        """Take other settings, with another cube map for another sun."""
        now = self.settings
        if (now.sun, now.voxel.highlights) != (settings.sun, settings.voxel.highlights):
            other = self._made(settings)
            self._sun.release()
            self._sun = other
        self.settings = settings

    def release(self) -> None:
        """Delete the textures; may be called twice."""
        self._tiles.release()
        self._sun.release()
