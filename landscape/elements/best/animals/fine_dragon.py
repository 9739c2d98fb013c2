"""The dragon of the preset `best`: mapped along axes, painted, glossy, with levels of detail.

A mesh with texture coordinates, as serpent.ply, has a skin of its own (serpent_skin.py) and
membranes between the spines of its fins (membranes.py). On any other the skin is a tile of scales
(scales.py). With ``dragon.gloss`` the sun glints by GL_SPECULAR, which is added after the texture
instead of multiplied by it: GL_SEPARATE_SPECULAR_COLOR (OpenGL 1.2). What else scales mirror is in
wet_sheen.py.
State used: as the fine animal; specular material and the light model's colour control.
"""

from collections.abc import Hashable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import glint_after_texture
from landscape.elements.best.animals import wet_sheen
from landscape.elements.best.animals.axis_mapping import by_axis
from landscape.elements.best.animals.fine_animal import FineAnimal, read_painted
from landscape.elements.best.animals.membranes import Membranes
from landscape.elements.best.animals.scales import brightest, muted, scaled_skin, scales
from landscape.elements.best.animals.serpent_skin import serpent_skin, strip_of
from landscape.elements.best.animals.skinned import Skinned, read_skinned
from landscape.elements.best.animals.wet_sheen import WetSheen
from landscape.elements.dragon import dragon_obstacles, planar, swimming
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.files.cache import content, recall
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh
from landscape.geometry.obstacles import Obstacle

SHININESS = 40.0  # chosen: wet scales


def remembered() -> np.ndarray:
    """Return the tile of scales, from the cache if it was made before."""
    return recall(["scales"], lambda: (scales(),))[0]


class FineDragon(FineAnimal):
    """The dragon, its water line at the water's level."""

    asked_by = (
        "dragon.mapping",
        "dragon.painted",
        "dragon.scaly",
        "dragon.gloss",
        "dragon.sheen",
        "camera.lod_pixels",
    )

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the mesh and its colours, make its levels and lower it to its water line."""
        dragon = settings.dragon
        skinned = self._skinned(settings, assets)
        mesh = skinned.flesh if skinned else self._tiled(settings, assets)
        mesh = wet_sheen.wet_band(mesh, dragon.sink, dragon.wet)

        def lay(mesh: Mesh) -> Mesh:
            if skinned:
                return mesh
            if dragon.mapping == "axis":
                laid = by_axis(mesh, dragon.repeat)
            else:
                laid = replace(mesh, coordinates=(planar(mesh.vertices),))
            return scaled_skin(laid, brightest(remembered())) if dragon.scaly else laid

        source = (
            content(assets.path(dragon.mesh)),
            repr(replace(dragon, gloss=0.0, sheen=0.0)),
            "muted",
        )
        place = swimming(dragon, settings.water.level)
        self._sheen = WetSheen.made(settings, assets, skinned is not None)
        self._skin = skinned is not None
        charts = strip_of(mesh.coordinates[0]) if skinned else None
        super().__init__(
            settings, assets, mesh, lay, source, place, dragon.yaw, dragon.scale, charts
        )
        self._membranes = None
        if skinned:
            self._closed = skinned.closed
            self._membranes = Membranes(skinned.membranes, settings)
            self.reach = max(self.reach, self._membranes.reach)

    @staticmethod
    def _skinned(settings: Settings, assets: Assets) -> Skinned | None:
        """Return the mesh with its own skin, if it has one and it is wanted."""
        dragon = settings.dragon
        if not (dragon.scaly and dragon.painted):
            return None
        return read_skinned(assets, dragon.mesh, "dragon.mesh")

    @staticmethod
    def _tiled(settings: Settings, assets: Assets) -> Mesh:
        """Return a mesh on which a tile can be laid."""
        dragon = settings.dragon
        mesh = read_painted(assets, dragon.mesh, "dragon.mesh", dragon.painted)
        return muted(mesh) if dragon.scaly else mesh

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that the lists were made from."""
        dragon = settings.dragon
        dragon = replace(dragon, gloss=float(dragon.gloss > 0.0), sheen=float(dragon.sheen > 0.0))
        mirrored = wet_sheen.built_from(settings)
        sun = settings.sun.azimuth, settings.sun.elevation
        return dragon, settings.camera.lod_pixels > 0.0, settings.water.level, mirrored, sun

    def _picture(self, assets: Assets) -> np.ndarray:
        """Return its own skin, scales, or the skin of 2006."""
        if self._skin:
            return recall(["serpent skin"], lambda: (serpent_skin(),))[0]
        if not self.settings.dragon.scaly:
            return super()._picture(assets)
        return remembered()

    def obstacles(self) -> tuple[Obstacle, ...]:
        """Return what the walker cannot pass."""
        return dragon_obstacles(self.settings.dragon, self.settings.water.level)

    def draw(self, frame: Frame) -> None:
        """Draw the dragon; where it is out of view, not even the state of its sheen is set."""
        if self.settings.camera.cull and not self.visible(frame):
            return
        dragon = self.settings.dragon
        shining: AbstractContextManager[None] = nullcontext()
        if self._sheen:
            shining = self._sheen.shining(frame, dragon.sheen, dragon.wet)
        with shining:
            super().draw(frame)

    def draw_membranes(self, frame: Frame) -> None:
        """Blend the membranes over what is drawn; nothing without them or out of view."""
        if self._membranes is None or (self.settings.camera.cull and not self.visible(frame)):
            return
        with self._lit_in_place(material=False):
            self._texture.bind()
            self._membranes.draw()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete lists, texture and maps; may be called twice."""
        super().release()
        if self._membranes:
            self._membranes.release()
        if self._sheen:
            self._sheen.release()

    def _set_material(self) -> None:
        """Add the specular highlight; popping GL_LIGHTING_BIT restores all of this."""
        super()._set_material()
        gloss = self.settings.dragon.gloss
        if not gloss:
            return
        glint_after_texture()
        glint = np.array([gloss] * 3 + [1.0], np.float32)
        gl.glMaterialfv(gl.GL_FRONT, gl.GL_SPECULAR, glint)
        gl.glMaterialf(gl.GL_FRONT, gl.GL_SHININESS, SHININESS)
