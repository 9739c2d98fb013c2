"""What wet scales mirror: the sky and the sea, most at grazing angles (``dragon.sheen``).

Technique: two cube maps (OpenGL 1.3) beside the animal's own texture. Unit 1 looks up the normal
(GL_NORMAL_MAP, in eye space): its alpha is how much a surface that is tilted so far from the viewer
mirrors, Fresnel's law baked into a map. Unit 2 looks up the mirrored line of sight
(GL_REFLECTION_MAP), which the texture matrix turns to the world's axes, in a map of what is around
(best/sky/surroundings.py). GL_COMBINE mixes that with the lit colour by the alpha of unit 1
(GL_INTERPOLATE). With ``dragon.wet`` the alpha of that map is the sun alone, and unit 3 brightens
towards the sun's colour by it: as Fresnel's law lets a scale mirror little, a sun within the map's
colours would hardly show. Unit 3 looks nothing up; its texture is on so that it takes part.
Not in the report. Where OpenGL has no cube maps or fewer units, scales stay dry.
What is wrong with it: the map takes the viewer to be far away straight ahead, so at the picture's
side the mirroring is a little off; and no part of the animal mirrors another.
State used: texture units 1 to 3, two with generated coordinates, GL_COMBINE, the texture matrix.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, combine
from landscape.elements.best.sky import surroundings
from landscape.elements.settings import Settings, Sun
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh
from landscape.gl.cube_map import CubeMap, face_directions, generate, texture_matrix
from landscape.gl.features import possible

SIDE = 32  # chosen: texels per side of a face of the map of Fresnel's law
SUN_SIZE = 0.15  # chosen: radians, of the sun as wet scales mirror it
HALO = 0.16  # chosen: brightness of the halo about it
SPREAD = 0.55  # chosen: the same, on scales of which each lies in a slightly different way
BAND = 0.085  # chosen: height of the wetted band on a mesh of -1..1
SOAKED = (0.40, 0.44, 0.48)  # chosen: what water in the pores leaves of the colour
HEAD_ON = 0.10  # chosen: what is mirrored by a surface that faces the viewer; water's is 0.02
POWER = 3.0  # chosen: how fast mirroring grows towards grazing; 5 is Schlick's


def mirrored_part(facing: np.ndarray) -> np.ndarray:
    """Return how much of the light is mirrored, 0..1, for cosines between normal and viewer.

    Schlick's approximation of Fresnel's law; a surface that faces away mirrors nothing.
    """
    grazing = (1.0 - np.clip(facing, 0.0, 1.0)) ** POWER
    return np.asarray(np.where(facing < 0, 1.0, HEAD_ON + (1 - HEAD_ON) * grazing))


def glints(sun: Sun, halo: float = HALO) -> np.ndarray:
    """Return the faces of a cube map of the sun alone, uint8 (6, n, n, 1), with a halo."""
    away = np.arccos(np.clip(face_directions(surroundings.SIDE) @ direction(sun), -1.0, 1.0))
    disc = np.exp(-((away / SUN_SIZE) ** 2)) + halo * np.exp(-((away / (4 * SUN_SIZE)) ** 2))
    shown = 255.0 * disc[..., None] * max(sun.diffuse)
    return np.rint(np.clip(shown, 0.0, 255.0)).astype(np.uint8)


def wet_band(mesh: Mesh, level: float, wet: float) -> Mesh:
    """Return the mesh, of vertices in -1..1, darkened where waves have just wetted it.

    ``level`` is the height of the water on the mesh. Without colours of its own it is unchanged.
    """
    if mesh.colors is None or wet <= 0.0:
        return mesh
    x, y, z = mesh.vertices.T
    splashed = BAND * (1.0 + 0.35 * np.sin(23.0 * x + 9.0 * z) + 0.25 * np.sin(41.0 * z - 17.0 * x))
    part = np.clip((level + splashed - y) / (0.5 * splashed), 0.0, 1.0)
    factor = 1.0 - wet * (1.0 - np.array(SOAKED)) * part[:, None]
    colors = mesh.colors.copy()
    colors[:, :3] = np.rint(mesh.colors[:, :3] * factor)
    return replace(mesh, colors=colors)


def built_from(settings: Settings) -> tuple[object, ...]:
    """Return the settings that the maps depend on: none if nothing is mirrored."""
    if settings.dragon.sheen <= 0.0:
        return ()
    sun, wet = settings.sun, settings.dragon.wet
    lit = (wet, sun.azimuth, sun.elevation, sun.diffuse) if wet > 0.0 else ()
    return surroundings.built_from(settings), lit


class WetSheen:
    """The maps and their use."""

    def __init__(self, settings: Settings, assets: Assets, masked: bool = False) -> None:
        """Upload the maps.

        With ``masked`` the alpha of the surface's own texture is how much it mirrors, of the sun,
        too.
        """
        self._masked = masked
        self._wet = settings.dragon.wet > 0.0 and possible("dragon.wet")
        self._one_by_one = possible("dragon.wet on scales alone")
        around = surroundings.surroundings(settings, assets)
        if self._wet:
            around = np.concatenate(
                [around, glints(settings.sun, SPREAD if masked else HALO)], axis=-1
            )
        diffuse = np.array(settings.sun.diffuse, np.float32)
        self._sun_colour = diffuse / max(float(diffuse.max()), 1e-6)
        self._around = CubeMap(around, trilinear=False)
        part = np.rint(mirrored_part(face_directions(SIDE)[..., 2]) * 255).astype(np.uint8)
        self._part = CubeMap(np.repeat(part[..., None], 4, axis=-1), mipmaps=False)

    @classmethod
    def made(cls, settings: Settings, assets: Assets, masked: bool = False) -> "WetSheen | None":
        """Return the sheen if it is wanted and this OpenGL can show it; ``masked`` as above."""
        if settings.dragon.sheen <= 0.0 or not possible("dragon.sheen"):
            return None
        return cls(settings, assets, masked)

    @contextmanager
    def shining(self, frame: Frame, strength: float, wet: float = 0.0) -> Iterator[None]:
        """Let the block's textured surfaces mirror what is around, times ``strength`` in 0..1.

        ``wet`` in 0..1 is how much of the sun is added.
        """
        kind = gl.GL_TEXTURE_CUBE_MAP
        with attrib(gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT):
            gl.glActiveTexture(gl.GL_TEXTURE1)
            gl.glEnable(kind)
            self._part.bind()
            generate("NORMAL_MAP")
            combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "PREVIOUS", "COMBINE_ALPHA": "MODULATE"})
            combine({"SRC0_ALPHA": "TEXTURE", "SRC1_ALPHA": "CONSTANT"})
            constant = np.array([0.0, 0.0, 0.0, strength], np.float32)
            gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, constant)
            if self._masked:
                self._mask(constant)

            gl.glActiveTexture(gl.GL_TEXTURE2)
            gl.glEnable(kind)
            self._around.bind()
            generate("REFLECTION_MAP")
            combine({"COMBINE_RGB": "INTERPOLATE", "SRC0_RGB": "TEXTURE", "SRC1_RGB": "PREVIOUS"})
            combine({"SRC2_RGB": "PREVIOUS", "OPERAND2_RGB": "SRC_ALPHA"})
            found = "TEXTURE" if self._wet else "PREVIOUS"
            combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": found})
            if self._masked and self._wet and self._one_by_one:
                combine({"COMBINE_ALPHA": "MODULATE", "SRC1_ALPHA": "TEXTURE0"})

            with texture_matrix(frame.to_world):
                if self._wet:
                    self._add_sun(wet)
                gl.glActiveTexture(gl.GL_TEXTURE0)
                try:
                    yield
                finally:
                    gl.glActiveTexture(gl.GL_TEXTURE2)

    def _mask(self, constant: np.ndarray) -> None:
        """Let unit 0 leave the texture's alpha times that of ``constant``, and unit 1 use it."""
        combine({"SRC1_ALPHA": "PREVIOUS"})
        gl.glActiveTexture(gl.GL_TEXTURE0)
        combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "TEXTURE", "SRC1_RGB": "PREVIOUS"})
        combine({"COMBINE_ALPHA": "MODULATE", "SRC0_ALPHA": "TEXTURE", "SRC1_ALPHA": "CONSTANT"})
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, constant)

    def _add_sun(self, wet: float) -> None:
        """Set unit 3: the sun's colour by the alpha of unit 2."""
        gl.glActiveTexture(gl.GL_TEXTURE3)
        gl.glEnable(gl.GL_TEXTURE_CUBE_MAP)
        self._around.bind()
        combine({"COMBINE_RGB": "INTERPOLATE", "SRC0_RGB": "CONSTANT", "SRC1_RGB": "PREVIOUS"})
        combine({"SRC2_RGB": "PREVIOUS", "OPERAND2_RGB": "SRC_ALPHA"})
        combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"})
        constant = np.array([*(wet * self._sun_colour), 1.0], np.float32)
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, constant)

    def release(self) -> None:
        """Delete the maps; may be called twice."""
        self._around.release()
        self._part.release()
