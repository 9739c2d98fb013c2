"""The rabbit of the preset `best`: mapped along axes (R12), painted, furry, in levels of detail."""

import math
from collections.abc import Hashable
from dataclasses import replace
from typing import Self

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import front_faces
from landscape.elements.best.animals.axis_mapping import by_axis
from landscape.elements.best.animals.fine_animal import FineAnimal, read_painted
from landscape.elements.best.animals.fur import Fur
from landscape.elements.element import Site
from landscape.elements.ground import Ground
from landscape.elements.rabbit import cylindrical, rabbit_obstacles, standing
from landscape.elements.settings import Settings
from landscape.elements.sun import direction, painted
from landscape.files.assets import Assets
from landscape.files.cache import content
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField
from landscape.geometry.mesh import Mesh
from landscape.geometry.obstacles import Obstacle
from landscape.gl.features import possible

SHADED = 0.3  # chosen: fraction of the sun that is left to what rises out of a shadow


class FineRabbit(FineAnimal):
    """The rabbit, on the ground."""

    _sunny = 1.0
    _fur: Fur | None = None

    asked_by = (
        "rabbit.mapping",
        "rabbit.painted",
        "rabbit.fur",
        "camera.lod_pixels",
    )

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Place it on the ground."""
        return cls(site.settings, site.assets, site.elements[Ground].field)

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Read the mesh and its colours, make its levels and place it on the ground."""
        rabbit = settings.rabbit
        mesh = read_painted(assets, rabbit.mesh, "rabbit.mesh", rabbit.painted)

        def lay(mesh: Mesh) -> Mesh:
            if rabbit.mapping == "axis":
                return by_axis(mesh, rabbit.l2)
            return replace(mesh, coordinates=(cylindrical(mesh.vertices, rabbit.l1, rabbit.l2),))

        source = content(assets.path(rabbit.mesh)), repr(replace(rabbit, fur=0))
        place = standing(rabbit, mesh, field)
        super().__init__(settings, assets, mesh, lay, source, place, rabbit.yaw, rabbit.scale)
        self._obstacles = rabbit_obstacles(rabbit, field)
        if rabbit.fur and possible("rabbit.fur"):
            self._fur = Fur(mesh, repr(source), rabbit.scale, rabbit.fur)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that the lists were made from."""
        return settings.rabbit, settings.camera.lod_pixels > 0.0

    def stand_in(self, ground: Ground) -> None:
        """Take the light of the ground: in a shadow that is painted there, the sun is dimmed."""
        sun, (x, _, z) = self.settings.sun, self.place
        found = ground.light(np.array([x]), np.array([z]))[0]
        shade, full = np.array(sun.shade), painted(sun, float(direction(sun)[1]))
        if sun.relit:
            self._sunny = float(np.clip(((found - shade) / (full - shade)).min(), 0.0, 1.0))

    def draw(self, frame: Frame) -> None:
        """Draw the skin, and then the fur in the same place and light."""
        super().draw(frame)
        if self._fur is None or (self.settings.camera.cull and not self.visible(frame)):
            return
        away = max(math.dist(frame.eye, self._middle(frame)), self.settings.camera.near)
        seen = self._fur.seen(frame.pixels / away)
        if not seen:
            return
        with self._lit_in_place():
            with front_faces(self._closed and self.settings.camera.cull):
                self._fur.draw(seen)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete lists and textures; may be called twice."""
        super().release()
        if self._fur:
            self._fur.release()

    def _set_material(self) -> None:
        """Dim the sun as well, where the rabbit is in a shadow; GL_LIGHTING_BIT restores it."""
        super()._set_material()
        if self._sunny < 1.0:
            left = SHADED + (1.0 - SHADED) * self._sunny
            colour = np.append(left * np.array(self.settings.sun.diffuse), 1.0)
            gl.glLightfv(gl.GL_LIGHT0, gl.GL_DIFFUSE, colour.astype(np.float32))

    def obstacles(self) -> tuple[Obstacle, ...]:
        """Return what the walker cannot pass."""
        return self._obstacles
