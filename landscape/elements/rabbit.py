"""The rabbit: a triangle mesh on land (Rabit, section 7).

Technique: a PLY mesh sent once into a display list (animal.py), textured by cylindrical coordinates
of its own vertices. The absolute value of the angle makes both ends of the turn meet in the same
texture coordinate: without it the whole texture would run backwards through one narrow strip. Near
the axis the angle turns fast, and the texture is pinched; with ``rabbit.mapping`` = axis each face
is mapped along the axis it looks at most, and a vertex between two such charts is doubled (section
11.2.5). With ``rabbit.painted`` the vertices have colours of their own, which the mesh file brings.
State used: GL_TEXTURE_2D, GL_LIGHTING, GL_COLOR_MATERIAL.
"""

from dataclasses import replace

import numpy as np

from landscape.elements.animal import Animal, by_axis, read_painted
from landscape.files.assets import Assets
from landscape.files.cache import content
from landscape.files.images import read_image
from landscape.geometry.height_field import HeightField
from landscape.geometry.mesh import Mesh
from landscape.gl.texture import Texture
from landscape.settings import Settings

ELEMENT = "rabbit"


def cylindrical(vertices: np.ndarray, l1: float, l2: float) -> np.ndarray:
    """Return texture coordinates, float32 (n, 2), of vertices (n, 3) in -1..1 (section 7.2)."""
    x, y, z = vertices.T
    s = l1 * np.abs(np.arctan2(z, x)) / (2 * np.pi)
    return np.ascontiguousarray(np.stack([s, l2 * (y + 1) / 2], axis=1), np.float32)


class Rabbit(Animal):
    """The rabbit, on the ground."""

    elements = (ELEMENT,)

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Read the mesh and stand it on the ground."""
        rabbit = settings.rabbit
        mesh = read_painted(assets, rabbit.mesh, "rabbit.mesh", rabbit.painted)

        def lay(mesh: Mesh) -> Mesh:
            if rabbit.mapping == "axis":
                return by_axis(mesh, rabbit.l2)
            return replace(mesh, coordinates=(cylindrical(mesh.vertices, rabbit.l1, rabbit.l2),))

        low = float(mesh.vertices[:, 1].min()) * rabbit.scale
        y = float(field.height(rabbit.x, rabbit.z)) - low - 0.02 * rabbit.scale
        super().__init__(
            mesh,
            lay,
            (content(assets.path(rabbit.mesh)), repr(rabbit)),
            Texture(read_image(assets.path("animal.png"), "RGB")),
            rabbit.scale,
            (rabbit.x, y, rabbit.z),
            rabbit.yaw,
            settings,
        )
