"""An animal: a triangle mesh in display lists, lit and textured (section 7).

What the rabbit and the dragon share: mapping by the axis a face looks at (R12, section 11.2.5),
vertex colours that the mesh file brings, a glint, and levels of detail: a mesh of fewer triangles
is drawn while what it leaves out is smaller than ``camera.lod_pixels`` pixels.
State used: GL_TEXTURE_2D, GL_LIGHTING, GL_COLOR_MATERIAL.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from landscape.elements.terrain.shadows import SKY_HIDDEN, ShadowMap, cast_points
from landscape.files.assets import Assets
from landscape.files.cache import recall
from landscape.files.meshes import read_colours, read_mesh
from landscape.frame import Frame
from landscape.geometry.camera import ball_in_view
from landscape.geometry.mesh import Mesh, centred, clustered, gathered, is_closed, vertex_normals
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.state import attrib, front_faces, matrix
from landscape.gl.texture import Texture
from landscape.settings import Settings

COLOR = (0.6, 0.6, 0.7, 1.0)  # section 7.2
SHININESS = 40.0  # chosen: wet scales
# Chosen: sides of the cubes whose vertices are drawn together, on a mesh of -1..1; 0 draws all.
CUBES = (0.0, 0.01, 0.014, 0.02, 0.03, 0.04, 0.06, 0.08)
SPARED = 0.85  # chosen: a level of detail has at most this part of the finer one's triangles
Levels = dict[float, Mesh]


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
        None if mesh.colors is None else np.ascontiguousarray(mesh.colors[own]),
    )


def read_animal(assets: Assets, name: str, key: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a PLY mesh as vertices in -1..1, normals and triangles."""
    vertices, triangles = read_mesh(assets.path(name, key))
    vertices = centred(vertices)
    return vertices, vertex_normals(vertices, triangles), triangles


def read_painted(assets: Assets, name: str, key: str, colours: bool) -> Mesh:
    """Return a PLY mesh in -1..1 without texture coordinates, its own ``colours`` if it has any."""
    vertices, normals, triangles = read_animal(assets, name, key)
    mesh = Mesh(vertices, normals, triangles)
    found = read_colours(assets.path(name, key)) if colours else None
    if found is None:
        return mesh
    opaque = np.full((len(found), 1), 255, np.uint8)
    return replace(mesh, colors=np.ascontiguousarray(np.hstack([found, opaque])))


def levels_of_detail(mesh: Mesh, lay: Callable[[Mesh], Mesh], cubes: Sequence[float]) -> Levels:
    """Return a mesh as it is to be drawn, by the side of the cubes it was coarsened with.

    ``lay`` gives a mesh its texture coordinates. A level that spares too little is left out.
    """
    levels: Levels = {}
    most = math.inf
    for cube in cubes:
        level = clustered(mesh, cube) if cube else mesh
        if len(level.triangles) <= most:
            levels[cube] = gathered(lay(level))
            most = SPARED * len(level.triangles)
    return levels


def packed(levels: Levels) -> tuple[np.ndarray, ...]:
    """Return levels of detail, of one texture unit, as arrays for the cache: see unpacked."""
    arrays = [np.array(list(levels))]
    for mesh in levels.values():
        colors = np.empty((0, 4), np.uint8) if mesh.colors is None else mesh.colors
        arrays += [mesh.vertices, mesh.normals, mesh.triangles, *mesh.coordinates, colors]
    return tuple(arrays)


def unpacked(arrays: Sequence[np.ndarray]) -> Levels:
    """Return the levels of detail that were packed: their cubes, then five arrays of each."""
    cubes, *rest = arrays
    levels: Levels = {}
    for cube, place in zip(cubes.tolist(), range(0, len(rest), 5), strict=True):
        vertices, normals, triangles, coordinates, colors = rest[place : place + 5]
        levels[cube] = Mesh(
            vertices, normals, triangles, (coordinates,), colors if len(colors) else None
        )
    return levels


def scaled(mesh: Mesh, scale: float) -> Mesh:
    """Return a mesh ``scale`` times as large."""
    return replace(mesh, vertices=mesh.vertices * np.float32(scale))


class Animal:
    """A lit, textured mesh, standing somewhere; ``elements`` names it in a trace."""

    elements: tuple[str, ...] = ()

    def __init__(
        self,
        mesh: Mesh,
        lay: Callable[[Mesh], Mesh],
        source: Iterable[bytes | str],
        texture: Texture,
        scale: float,
        place: tuple[float, float, float],
        yaw: float,
        settings: Settings,
        gloss: float = 0.0,
    ) -> None:
        """Scale a mesh of -1..1 to ``scale`` units and stand it at ``place``, ``yaw`` in degrees.

        ``lay`` gives a mesh its texture coordinates; ``source`` tells mesh and layout from any
        others, for the cache. ``gloss``, 0 to 1, is the strength of the sun's glint. Scaled here
        rather than by glScalef, which would scale the normals too and need GL_NORMALIZE.
        """
        self._place, self._yaw, self._texture = place, yaw, texture
        self._mesh, self._scale = mesh, scale
        self._reach = scale * float(np.linalg.norm(mesh.vertices, axis=1).max(initial=0.0))
        self._settings, self._gloss = settings, gloss
        self._closed = is_closed(mesh.triangles)
        cubes = CUBES if settings.camera.lod_pixels > 0.0 else CUBES[:1]
        levels = recall(
            ["levels of detail", repr(cubes), *source],
            lambda: packed(levels_of_detail(mesh, lay, cubes)),
        )
        # All at once: a list that comes and goes leaves holes in the memory it lay in.
        self._lists = {
            cube: DisplayList(partial(draw_mesh, scaled(level, scale)))
            for cube, level in unpacked(levels).items()
        }

    def level(self, frame: Frame | None) -> float:
        """Return the cube of the coarsest mesh that leaves out nothing larger than is allowed."""
        allowed = self._settings.camera.lod_pixels
        if frame is None or allowed <= 0.0:
            return CUBES[0]
        if frame.mirrored:
            allowed *= self._settings.reflection.lod_scale
        away = math.dist(frame.eye, self._middle(frame)) - self._reach
        unit = frame.pixels / max(away, self._settings.camera.near)
        return max(cube for cube in self._lists if cube * self._scale * unit <= allowed)

    def _middle(self, frame: Frame) -> tuple[float, float, float]:
        """Return the animal's middle, or its mirror image if the frame is mirrored."""
        x, y, z = self._place
        return x, 2.0 * self._settings.water.level - y if frame.mirrored else y, z

    def cast(self, shadows: ShadowMap) -> None:
        """Throw the mesh's shadow, and darken the ground under it."""
        yaw = math.radians(self._yaw)
        x, y, z = self._scale * self._mesh.vertices.T
        points = np.stack(
            [x * math.cos(yaw) + z * math.sin(yaw), y, z * math.cos(yaw) - x * math.sin(yaw)],
            axis=1,
        )
        cast_points(shadows, points + np.array(self._place))
        shadows.hide_sky(np.array([self._place]), np.array([self._reach]), SKY_HIDDEN)

    def visible(self, frame: Frame) -> bool:
        """Tell whether the ball round the mesh, mirrored if the frame is, meets the view."""
        return ball_in_view(frame, self._middle(frame), self._reach)

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
            if self._gloss:
                self._shine()
            with front_faces(self._closed and self._settings.camera.cull):
                self._lists[self.level(frame)].call()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def _shine(self) -> None:
        """Let the sun glint on it, added after the texture instead of multiplied by it.

        GL_SEPARATE_SPECULAR_COLOR is of OpenGL 1.2; GL_LIGHTING_BIT holds all of this.
        """
        gl.glLightModeli(gl.GL_LIGHT_MODEL_COLOR_CONTROL, gl.GL_SEPARATE_SPECULAR_COLOR)
        glint = np.array([self._gloss] * 3 + [1.0], np.float32)
        gl.glMaterialfv(gl.GL_FRONT, gl.GL_SPECULAR, glint)
        gl.glMaterialf(gl.GL_FRONT, gl.GL_SHININESS, SHININESS)

    def release(self) -> None:
        """Delete the list and the texture; may be called twice."""
        for compiled in self._lists.values():
            compiled.release()
        self._texture.release()
