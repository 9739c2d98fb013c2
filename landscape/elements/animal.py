"""Shared by both animals: a lit, textured triangle mesh in a display list (section 7).

The mesh is read from a file, centred, and scaled to the size it has on the island. Its vertex
arrays are sent once, into a display list; each frame moves to its place and calls the list.
State used: GL_TEXTURE_2D, GL_LIGHTING, GL_COLOR_MATERIAL, GL_CULL_FACE.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Hashable, Iterator
from contextlib import contextmanager

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, front_faces, matrix
from framelens.gl.texture import Texture
from landscape.elements.element import Element
from landscape.elements.settings import Settings
from landscape.elements.sun import lit
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.files.meshes import read_mesh
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh, centred, gathered, is_closed, scaled, vertex_normals
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh

COLOR = (0.6, 0.6, 0.7, 1.0)  # section 7.2


def read_animal(assets: Assets, name: str, key: str) -> Mesh:
    """Return the mesh of a file, its vertices in -1..1; ``key`` names the setting in an error."""
    vertices, triangles = read_mesh(assets.path(name, key))
    vertices = centred(vertices)
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles)


class Animal(Element[Settings], ABC):
    """A lit, textured mesh at a fixed place; which settings it is built from, each animal says."""

    def __init__(
        self,
        settings: Settings,
        assets: Assets,
        mesh: Mesh,
        place: tuple[float, float, float],
        yaw_deg: float,
        scale: float,
    ) -> None:
        """Scale a mesh of -1..1 to ``scale`` units and place it at ``place``.

        ``reach`` is the radius of its bounding sphere, in units.
        """
        self.settings = settings
        self.place = place
        self._yaw = yaw_deg
        self._scale = scale
        self._vertices = mesh.vertices
        self.reach = scale * float(np.linalg.norm(mesh.vertices, axis=1).max(initial=0.0))
        self._closed = is_closed(mesh.triangles)
        self._texture = Texture(self._picture(assets))
        self._lists = self._compile(mesh)

    @classmethod
    @abstractmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that the list was made from."""

    def _picture(self, assets: Assets) -> np.ndarray:
        """Return its texture, uint8 (h, w, 3)."""
        return read_image(assets.path("animal.png"), "RGB")

    def _compile(self, mesh: Mesh) -> dict[float, DisplayList]:
        """Return the display list of a mesh with texture coordinates."""
        sent = scaled(gathered(mesh), self._scale)
        return {0.0: DisplayList(lambda: draw_mesh(sent))}

    def _list(self, frame: Frame) -> DisplayList:
        """Return the list to call in a frame: here there is only one."""
        return self._lists[0.0]

    def draw(self, frame: Frame) -> None:
        """Draw the mesh at its place; with ``camera.cull``, without its back faces."""
        with self._lit_in_place():
            self._texture.bind()
            # A mesh with a hole shows its inside: it keeps its back faces.
            with front_faces(self._closed and self.settings.camera.cull):
                self._list(frame).call()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    @contextmanager
    def _lit_in_place(self, material: bool = True) -> Iterator[None]:
        """Let the block draw at the animal's place, lit, in its material, and with textures.

        What has a colour at each vertex, and does not glint, needs no ``material``.
        """
        with matrix(), attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT):
            gl.glTranslatef(*self.place)
            gl.glRotatef(self._yaw, 0.0, 1.0, 0.0)
            lit(self.settings.shading)
            if material:
                self._set_material()
            gl.glEnable(gl.GL_TEXTURE_2D)
            yield

    def send(self, frame: Frame) -> None:
        """Send the mesh at its place, whatever the state; back faces are left out as by draw."""
        with matrix(), front_faces(self._closed and self.settings.camera.cull):
            gl.glTranslatef(*self.place)
            gl.glRotatef(self._yaw, 0.0, 1.0, 0.0)
            self._list(frame).call()

    def _set_material(self) -> None:
        """Set the material: in 2006 only its colour, by GL_COLOR_MATERIAL."""
        gl.glColor4f(*COLOR)

    def vertices(self) -> np.ndarray:
        """Return where the mesh's vertices (n, 3) are on the island, in units."""
        yaw = math.radians(self._yaw)
        x, y, z = self._scale * self._vertices.T
        turned = np.stack(
            [x * math.cos(yaw) + z * math.sin(yaw), y, z * math.cos(yaw) - x * math.sin(yaw)],
            axis=1,
        )
        return turned + np.array(self.place)

    def release(self) -> None:
        """Delete the lists and the texture; may be called twice."""
        for compiled in self._lists.values():
            compiled.release()
        self._texture.release()
