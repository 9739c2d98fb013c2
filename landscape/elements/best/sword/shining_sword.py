"""The sword of the preset `best`: its steel mirrors the light around (``overlay.sheen``).

Technique: the plain sprite (sword.py), and over its blade a strip of quads, which is blended once
more, by addition. Unit 0 has the mask: where the picture shows steel. Unit 1 has a cube map of what
is around (best/sky/surroundings.py) with more contrast, and the sun in it. OpenGL generates the
coordinates from the strip's normals (GL_REFLECTION_MAP), and the texture matrix turns them with the
walker. The blade is flat, but the normals are bent, along it and away from its ridge: so light runs
along the steel as the walker turns, and in a stroke.
Not in the report. Where OpenGL has no cube maps or one texture unit, the steel stays as painted.
State used: as the sword; texture unit 1 with generated coordinates, GL_NORMALIZE, the texture
matrix.
"""

from collections.abc import Hashable
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, matrix
from framelens.gl.texture import Texture
from landscape.elements.best.sky import surroundings
from landscape.elements.settings import Settings
from landscape.elements.sun import direction
from landscape.elements.sword import ASPECT, Sword, pictures
from landscape.files.assets import Assets
from landscape.files.cache import content, recall
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.mesh import grid_triangles
from landscape.gl.cube_map import CubeMap, face_directions, generate, texture_matrix
from landscape.gl.display_list import DisplayList
from landscape.gl.features import possible

COLD, WARM = 0.02, -0.04  # chosen: blue less red, of the brightest, of steel and of leather
DARK, BRIGHT = 50, 90  # chosen: levels from and above which grey is steel and not shadow
FAR = 4.0  # chosen: what is this many times the median distance from the axis is no blade
ALONG = 24  # chosen: quads along each side of the ridge
BEND = 0.30  # chosen: radians by which the normals are bent at the blade's ends
BEVEL = 0.16  # chosen: radians by which its two sides are tilted
CONTRAST = 3.0  # chosen: exponent of what is around
PALE = 0.65  # chosen: how much of the colour of what is around steel loses
GLARE = 0.22  # chosen: radians, the size of the sun as the steel shows it
TAN = 0.577  # of half the field of view that the normals are bent for, 60 degrees


class Blade(NamedTuple):
    """A blade in a picture: middle (2,), direction to an end (2,), half length, half width.

    In units of half the picture's height, y upwards.
    """

    middle: np.ndarray
    axis: np.ndarray
    length: float
    width: float


def steel(picture: np.ndarray) -> np.ndarray:
    """Return how much of each texel is steel, uint8 (h, w, 1), for a picture (h, w, 4).

    Steel is bright and a little blue, unlike brass and leather. The border is not: its
    texels go on beyond the picture.
    """
    colours, alpha = picture[..., :3].astype(np.float32), picture[..., 3] / np.float32(255)
    most = colours.max(axis=2)
    blue = (colours[..., 2] - colours[..., 0]) / np.maximum(most, 1.0)
    part = np.clip((blue - WARM) / (COLD - WARM), 0.0, 1.0) * alpha
    part = part * np.clip((most - DARK) / (BRIGHT - DARK), 0.0, 1.0)
    found = np.rint(part * 255).astype(np.uint8)[..., None]
    found[[0, -1]] = 0
    found[:, [0, -1]] = 0
    return found


def _steel_in(path: Path) -> tuple[np.ndarray]:
    return (steel(read_image(path)),)


def blade(mask: np.ndarray) -> Blade | None:
    """Return the blade that a mask (h, w, 1) shows, along its principal axis; None without any."""
    height, width = mask.shape[:2]
    row, column = np.nonzero(mask[..., 0] > 127)
    if len(row) < 8:
        return None
    x = ((column + 0.5) / width * 2 - 1) * ASPECT
    points = np.stack([x, 1 - (row + 0.5) / height * 2], axis=1)
    for _ in range(2):  # the second time without specks far from the axis
        _, axes = np.linalg.eigh(np.cov(points.T))
        away = np.abs(points @ axes[:, 0] - np.median(points @ axes[:, 0]))
        points = points[away <= FAR * np.median(away)]
    places = points @ axes
    low, high = places.min(axis=0), places.max(axis=0)
    half = (high - low) / 2
    return Blade(axes @ ((low + high) / 2), axes[:, 1], float(half[1]), float(half[0]))


def strip(found: Blade) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return a blade's quads: vertices and normals (n, 3), coordinates (n, 2), triangles (m, 3).

    The vertices are on the square -1..1 of the sprite, the normals such that they are unit vectors
    in eye space, apart from their length, where that square is stretched over the window. The two
    sides of the ridge share no vertex.
    """
    side = np.array([-found.axis[1], found.axis[0]])
    u = np.linspace(-1, 1, ALONG + 1)
    vertices, normals = [], []
    triangles: list[np.ndarray] = []
    for way in (-1.0, 1.0):
        across = (0.0, 1.0) if way > 0 else (-1.0, 0.0)
        v, along = (grid.ravel() for grid in np.meshgrid(across, u, indexing="ij"))
        flat = found.middle + np.outer(along * found.length, found.axis)
        flat = flat + np.outer(v * found.width, side)
        tilt = np.outer(np.sin(BEND * along), found.axis) + np.sin(BEVEL * way) * side
        vertices.append(flat)
        normals.append(tilt)
        triangles.append(grid_triangles(ALONG + 1, 2) + 2 * (ALONG + 1) * len(triangles))

    flat, tilt = np.concatenate(vertices), np.concatenate(normals)
    towards = np.sqrt(1 - (tilt**2).sum(axis=1))
    square = np.column_stack([flat[:, 0] / ASPECT, flat[:, 1], np.full(len(flat), -1.0)])
    stretched = np.column_stack([tilt[:, 0] * ASPECT, tilt[:, 1], towards / TAN])
    coordinates = (square[:, :2] * (1, -1) + 1) / 2
    return (
        np.ascontiguousarray(square, np.float32),
        np.ascontiguousarray(stretched, np.float32),
        np.ascontiguousarray(coordinates, np.float32),
        np.concatenate(triangles).astype(np.uint32),
    )


def light_around(settings: Settings, assets: Assets) -> np.ndarray:
    """Return the faces of a cube map of the light that steel mirrors, uint8 (6, n, n, 3)."""
    around = (surroundings.surroundings(settings, assets) / np.float32(255)) ** CONTRAST
    around += (around.mean(axis=-1, keepdims=True) - around) * PALE
    towards = face_directions(around.shape[1])
    away = np.arccos(np.clip(towards @ direction(settings.sun), -1.0, 1.0))
    glare = np.exp(-((away / GLARE) ** 2))[..., None] * np.array(settings.sun.diffuse)
    return np.rint(np.clip(around + glare, 0.0, 1.0) * 255).astype(np.uint8)


class ShiningSword(Sword[Settings]):
    """The sword with light on its steel."""

    asked_by = ("overlay.sheen",)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that the map of the light around depends on."""
        sun = settings.sun
        return surroundings.built_from(settings), sun.azimuth, sun.elevation, sun.diffuse

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Find the blade in each picture, and compile its strip."""
        super().__init__(settings, assets)
        self._masks: list[Texture] = []
        self._strips: list[DisplayList | None] = []
        self._around: CubeMap | None = None
        if not possible("overlay.sheen"):
            return
        self._around = CubeMap(light_around(settings, assets))
        for path in pictures(assets):
            (mask,) = recall(["steel", content(path)], partial(_steel_in, path))
            found = blade(mask)
            self._masks.append(Texture(mask, repeat=False))
            self._strips.append(DisplayList(partial(self._send, found)) if found else None)

    @staticmethod
    def _send(found: Blade) -> None:
        vertices, normals, coordinates, triangles = strip(found)
        with client_arrays(vertices, normals, None, [coordinates]):
            gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)

    def draw(self, frame: Frame) -> None:
        """Draw the sword over the picture, and the light on its steel."""
        super().draw(frame)
        compiled = self._strips[frame.stroke] if self._around else None
        if compiled is None or self._around is None:
            return
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT

        with attrib(groups), matrix():
            self._place(frame)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
            gl.glEnable(gl.GL_NORMALIZE)
            gl.glColor3f(*(self.settings.overlay.sheen,) * 3)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._masks[frame.stroke].bind()
            gl.glActiveTexture(gl.GL_TEXTURE1)
            gl.glEnable(gl.GL_TEXTURE_CUBE_MAP)
            self._around.bind()
            generate("REFLECTION_MAP")
            with texture_matrix(frame.to_world):
                compiled.call()

    def release(self) -> None:
        """Delete lists, textures and the map; may be called twice."""
        super().release()
        for each in (*self._masks, *self._strips, self._around):
            if each is not None:
                each.release()
