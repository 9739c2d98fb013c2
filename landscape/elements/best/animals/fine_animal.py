"""Shared by the rabbit and the dragon of the preset `best`: levels of detail, colours, culling.

A mesh of fewer triangles is drawn while its error is below ``camera.lod_pixels`` pixels
(levels_of_detail.py), and none while the animal is out of view. A mesh file may contain a colour
for each vertex. Not in the report.
State used: as animal.py, and the current colour.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from landscape.elements.animal import Animal, read_animal
from landscape.elements.best.animals.levels_of_detail import (
    CUBES,
    levels_of_detail,
    packed,
    unpacked,
)
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.files.cache import recall
from landscape.files.meshes import read_colours
from landscape.frame import Frame
from landscape.geometry.culling import ball_in_view
from landscape.geometry.height_field import mirrored_height
from landscape.geometry.mesh import Mesh, scaled
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh

# Chosen: times the allowed error, in the frames of a walk that have fewer pixels than the window.
IN_MOTION = 4.0


def read_painted(assets: Assets, name: str, key: str, painted: bool) -> Mesh:
    """Return the mesh of a file, its vertices in -1..1; ``key`` names the setting in an error.

    With ``painted`` it has the colours of the file, if there are any.
    """
    mesh = read_animal(assets, name, key)
    found = read_colours(assets.path(name, key)) if painted else None
    if found is None:
        return mesh
    opaque = np.full((len(found), 1), 255, np.uint8)
    return replace(mesh, colors=np.ascontiguousarray(np.hstack([found, opaque])))


class FineAnimal(Animal):
    """An animal with levels of detail."""

    def __init__(
        self,
        settings: Settings,
        assets: Assets,
        mesh: Mesh,
        lay: Callable[[Mesh], Mesh],
        source: tuple[bytes | str, ...],
        place: tuple[float, float, float],
        yaw_deg: float,
        scale: float,
        charts: np.ndarray | None = None,
    ) -> None:
        """Scale a mesh of -1..1 to ``scale`` units and place it at ``place``.

        ``lay`` gives a mesh its texture coordinates, unless it has them, in ``charts`` (n,).
        ``source`` is the cache key of the mesh and its coordinates.
        """
        self._lay, self._source, self._charts = lay, source, charts
        super().__init__(settings, assets, mesh, place, yaw_deg, scale)

    def _compile(self, mesh: Mesh) -> dict[float, DisplayList]:
        """Return a display list for each level of detail, by the side of its cubes."""
        cubes = CUBES if self.settings.camera.lod_pixels > 0.0 else CUBES[:1]
        levels = recall(
            ["levels of detail", repr(cubes), *self._source],
            lambda: packed(levels_of_detail(mesh, self._lay, cubes, self._charts)),
        )
        # All at once: lists that are made and deleted later would fragment memory.
        return {
            cube: DisplayList(partial(draw_mesh, scaled(level, self._scale)))
            for cube, level in unpacked(levels).items()
        }

    def level(self, frame: Frame) -> float:
        """Return the cube side of the coarsest level whose error is no larger than allowed."""
        allowed = self.settings.camera.lod_pixels
        if allowed <= 0.0:
            return CUBES[0]
        if frame.mirrored:
            allowed *= self.settings.reflection.lod_scale
        elif frame.detail.coarser > 1.0:
            allowed *= IN_MOTION
        away = math.dist(frame.eye, self._middle(frame)) - self.reach
        unit = frame.pixels / max(away, self.settings.camera.near)
        return max(cube for cube in self._lists if cube * self._scale * unit <= allowed)

    def _list(self, frame: Frame) -> DisplayList:
        return self._lists[self.level(frame)]

    def _middle(self, frame: Frame) -> tuple[float, float, float]:
        """Return the animal's centre, or its mirror image if the frame is mirrored."""
        x, y, z = self.place
        return x, mirrored_height(y, self.settings.water.level) if frame.mirrored else y, z

    def visible(self, frame: Frame) -> bool:
        """Return whether the bounding sphere, mirrored if the frame is, meets the view frustum."""
        return ball_in_view(frame, self._middle(frame), self.reach)

    def draw(self, frame: Frame) -> None:
        """Draw the mesh at its place; with ``camera.cull``, only if it is in view."""
        if not self.settings.camera.cull or self.visible(frame):
            super().draw(frame)
