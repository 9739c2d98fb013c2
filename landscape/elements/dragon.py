"""The sea dragon: a triangle mesh half in the water (Dragon, section 7).

Technique: as the rabbit, with the vertices' own (x, z) as texture coordinates, which gives vertical
lines; the mirrored scene draws it a second time. In ``best`` it is mapped, and painted, as the
rabbit is, and the sun glints on its wet scales by GL_SPECULAR.
State used: as the rabbit.
"""

from dataclasses import replace

import numpy as np

from landscape.elements.animal import Animal, by_axis, read_painted
from landscape.files.assets import Assets
from landscape.files.cache import content
from landscape.files.images import read_image
from landscape.geometry.mesh import Mesh
from landscape.gl.texture import Texture
from landscape.settings import Settings

ELEMENT = "dragon"


def planar(vertices: np.ndarray) -> np.ndarray:
    """Return texture coordinates (s, t) = (x, z), float32 (n, 2) (section 7.2)."""
    return np.ascontiguousarray(vertices[:, [0, 2]], np.float32)


class Dragon(Animal):
    """The dragon, its water line at the water's level."""

    elements = (ELEMENT,)

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the mesh and sink it to its water line."""
        dragon = settings.dragon
        mesh = read_painted(assets, dragon.mesh, "dragon.mesh", dragon.painted)

        def lay(mesh: Mesh) -> Mesh:
            if dragon.mapping == "axis":
                return by_axis(mesh, dragon.repeat)
            return replace(mesh, coordinates=(planar(mesh.vertices),))

        y = settings.water.level - dragon.sink * dragon.scale
        super().__init__(
            mesh,
            lay,
            (content(assets.path(dragon.mesh)), repr(dragon)),
            Texture(read_image(assets.path("animal.png"), "RGB")),
            dragon.scale,
            (dragon.x, y, dragon.z),
            dragon.yaw,
            settings,
            dragon.gloss,
        )
