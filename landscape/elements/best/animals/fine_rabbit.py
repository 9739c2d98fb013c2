"""The rabbit of the preset `best`: mapped along axes (R12), painted, with levels of detail."""

from dataclasses import replace

from landscape.elements.best.animals.axis_mapping import by_axis
from landscape.elements.best.animals.fine_animal import FineAnimal, read_painted
from landscape.elements.rabbit import Rabbit, cylindrical, rabbit_obstacles, standing
from landscape.files.assets import Assets
from landscape.files.cache import content
from landscape.geometry.height_field import HeightField
from landscape.geometry.mesh import Mesh
from landscape.geometry.obstacles import Obstacle
from landscape.settings import Settings


def rabbit_class(settings: Settings) -> type[Rabbit] | type["FineRabbit"]:
    """Return the class whose rabbit these settings describe."""
    rabbit = settings.rabbit
    fine = rabbit.mapping == "axis" or rabbit.painted or settings.camera.lod_pixels > 0.0
    return FineRabbit if fine else Rabbit


class FineRabbit(FineAnimal):
    """The rabbit, on the ground."""

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Read the mesh and its colours, make its levels and place it on the ground."""
        rabbit = settings.rabbit
        mesh = read_painted(assets, rabbit.mesh, "rabbit.mesh", rabbit.painted)

        def lay(mesh: Mesh) -> Mesh:
            if rabbit.mapping == "axis":
                return by_axis(mesh, rabbit.l2)
            return replace(mesh, coordinates=(cylindrical(mesh.vertices, rabbit.l1, rabbit.l2),))

        source = content(assets.path(rabbit.mesh)), repr(rabbit)
        place = standing(rabbit, mesh, field)
        super().__init__(settings, assets, mesh, lay, source, place, rabbit.yaw, rabbit.scale)
        self._obstacles = rabbit_obstacles(rabbit, field)

    @staticmethod
    def built_from(settings: Settings) -> tuple[object, ...]:
        """Return the settings that the lists were made from."""
        return settings.rabbit, settings.camera.lod_pixels > 0.0

    def obstacles(self) -> tuple[Obstacle, ...]:
        """Return what the walker cannot pass."""
        return self._obstacles
