"""The rabbit: a triangle mesh on land (Rabit, section 7).

Technique: a PLY mesh sent once into a display list, textured by cylindrical coordinates of its own
vertices. The absolute value of the angle makes both ends of the turn meet in the same texture
coordinate: without it the whole texture would run backwards through one narrow strip. Near the axis
the angle turns fast, and the texture is pinched; with ``rabbit.mapping`` = axis each face is mapped
along the axis it looks at most, and a vertex between two such charts is doubled (section 11.2.5).
State used: GL_TEXTURE_2D, GL_LIGHTING, GL_COLOR_MATERIAL.
"""

from dataclasses import replace

import numpy as np

from landscape.assets import Assets
from landscape.elements.ground import HeightField
from landscape.frame import Frame, in_view
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.mesh_tool import Mesh, centred, vertex_normals
from landscape.gl.state import attrib, matrix
from landscape.gl.texture import Texture, read_image
from landscape.meshes import read_mesh
from landscape.settings import Settings

ELEMENT = "rabbit"

COLOR = (0.6, 0.6, 0.7, 1.0)  # section 7.2


def cylindrical(vertices: np.ndarray, l1: float, l2: float) -> np.ndarray:
    """Return texture coordinates, float32 (n, 2), of vertices (n, 3) in -1..1 (section 7.2)."""
    x, y, z = vertices.T
    s = l1 * np.abs(np.arctan2(z, x)) / (2 * np.pi)
    return np.ascontiguousarray(np.stack([s, l2 * (y + 1) / 2], axis=1), np.float32)


def by_axis(mesh: Mesh, repeat: float) -> Mesh:
    """Return a mesh of vertices in -1..1 mapped by charts, ``repeat`` textures over 2 units.

    A face whose normal points along x most lies in the chart of (z, y), along y in that of (x, z),
    along z in that of (x, y). The corners' smooth normals are asked, not the face's own, which
    would speckle a rough skin with charts of one face.
    """
    facing = np.abs(mesh.normals[mesh.triangles].sum(axis=1)).argmax(axis=1)
    count = len(mesh.vertices)
    # A vertex of a chart is one number: the chart's, and its own.
    corners, triangles = np.unique(mesh.triangles + facing[:, None] * count, return_inverse=True)
    chart, own = np.divmod(corners, count)
    vertices = np.ascontiguousarray(mesh.vertices[own])
    plane = np.array([(2, 1), (0, 2), (0, 1)])[chart]
    coordinates = repeat * (np.take_along_axis(vertices, plane, axis=1) + 1) / 2
    return Mesh(
        vertices,
        np.ascontiguousarray(mesh.normals[own]),
        np.ascontiguousarray(triangles.reshape(-1, 3), np.uint32),
        (np.ascontiguousarray(coordinates, np.float32),),
    )


def read_animal(assets: Assets, name: str, key: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a PLY mesh as vertices in -1..1, normals and triangles."""
    vertices, triangles = read_mesh(assets.path(name, key))
    vertices = centred(vertices)
    return vertices, vertex_normals(vertices, triangles), triangles


class Animal:
    """A lit, textured mesh in a display list, standing somewhere."""

    def __init__(
        self,
        mesh: Mesh,
        texture: Texture,
        scale: float,
        place: tuple[float, float, float],
        yaw: float,
        settings: Settings,
    ) -> None:
        """Scale a mesh of -1..1 to ``scale`` units and stand it at ``place``, ``yaw`` in degrees.

        Scaled here rather than by glScalef, which would scale the normals too and need
        GL_NORMALIZE.
        """
        self._place, self._yaw, self._texture = place, yaw, texture
        scaled = replace(mesh, vertices=mesh.vertices * np.float32(scale))
        self._reach = float(np.linalg.norm(scaled.vertices, axis=1).max(initial=0.0))
        self._settings = settings
        self._list = DisplayList(scaled.draw)

    def visible(self, frame: Frame) -> bool:
        """Tell whether the ball round the mesh, mirrored if the frame is, meets the view."""
        x, y, z = self._place
        if frame.mirrored:
            y = 2.0 * self._settings.water.level - y
        return bool(in_view(frame, np.array([(x, y, z)]), np.array([self._reach]))[0])

    def draw(self, frame: Frame | None = None) -> None:
        """Draw the mesh where it stands; with ``camera.cull``, only if ``frame`` may show it."""
        if frame is not None and self._settings.camera.cull and not self.visible(frame):
            return
        # GL_LIGHTING_BIT holds the material that glColor sets: Mesa would keep the rabbit's grey
        # for what is lit next, as the popped colour does not reach the material.
        with matrix(), attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT):
            gl.glTranslatef(*self._place)
            gl.glRotatef(self._yaw, 0.0, 1.0, 0.0)
            gl.glEnable(gl.GL_LIGHTING)
            gl.glColor4f(*COLOR)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._texture.bind()
            self._list.call()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the list and the texture; may be called twice."""
        self._list.release()
        self._texture.release()


class Rabbit(Animal):
    """The rabbit, on the ground."""

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Read the mesh and stand it on the ground."""
        rabbit = settings.rabbit
        vertices, normals, triangles = read_animal(assets, rabbit.mesh, "rabbit.mesh")
        mesh = Mesh(vertices, normals, triangles, (cylindrical(vertices, rabbit.l1, rabbit.l2),))
        if rabbit.mapping == "axis":
            mesh = by_axis(mesh, rabbit.l2)
        low = float(vertices[:, 1].min()) * rabbit.scale
        y = float(field.height(rabbit.x, rabbit.z)) - low - 0.02 * rabbit.scale
        super().__init__(
            mesh,
            Texture(read_image(assets.path("animal.png"), "RGB")),
            rabbit.scale,
            (rabbit.x, y, rabbit.z),
            rabbit.yaw,
            settings,
        )
