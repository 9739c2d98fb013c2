"""Shadows laid into the ground's colours once, before the first frame (a light map).

Not in the report, whose trees and castle cast none. Technique: what casts a shadow is taken as
points, each of which falls along the sun's direction on the ground and darkens the texel it falls
on; a sprite's points are the texels of its own picture, so that a birch throws a birch's shadow.
Round the foot of things, where they hide the sky, the ground darkens a little as well. Nothing of
this costs anything while walking: the sun and what casts stand still. No OpenGL here.
"""

from collections.abc import Iterable

import numpy as np
from PIL import Image, ImageFilter

from landscape.elements.planting import Sprites
from landscape.geometry.height_field import HeightField

# All chosen.
LIGHT_LEFT = np.array([0.50, 0.53, 0.58], np.float32)  # of the ground's colour in full shadow
SKY_HIDDEN = 0.38  # part of the light lost right at the foot of what stands
SKY_TEXELS = 4  # texels a side for one of what hides the sky, which is soft
SAMPLES_PER_TEXEL = 1.3  # along each side, so that no gap is left between points
MOST_SAMPLES = 48  # along a sprite's side
SOFTNESS = 0.7  # texels: a penumbra
FLATTEST = 0.35  # rise over run of sunlight along the ground: what is flatter throws no farther


class ShadowMap:
    """A picture of the land, ``side`` texels square, that darkens with each thing put on it."""

    def __init__(self, field: HeightField, sun: np.ndarray, side: int) -> None:
        """Start with no shadow; ``sun`` (3,) is the unit vector towards the light."""
        self.field, self.side = field, side
        self._sun = np.asarray(sun, np.float64)
        self._shadow = np.zeros((side, side))
        self._sky = np.zeros((max(side // SKY_TEXELS, 1),) * 2)

    @property
    def texel(self) -> float:
        """The side of a texel in units."""
        return self.field.size / self.side

    def throw(self, feet: np.ndarray) -> np.ndarray:
        """Return x, z (n, 2) by which the shadow of a point one unit over a foot (n, 3) is off it.

        The ground is taken as a plane through the foot.
        """
        level = np.hypot(self._sun[0], self._sun[2])
        if level < 1e-6:
            return np.zeros((len(feet), 2))
        flees = -self._sun[[0, 2]] / level
        x, z, step = feet[:, 0], feet[:, 2], 2.0 * self.texel
        ahead = self.field.terrain_height(x + step * flees[0], z + step * flees[1])
        behind = self.field.terrain_height(x - step * flees[0], z - step * flees[1])
        steep = np.maximum(self._sun[1] / level + (ahead - behind) / (2 * step), FLATTEST)
        return np.asarray(flees / steep[:, None])

    def darken(self, x: np.ndarray, z: np.ndarray, amount: np.ndarray) -> None:
        """Add ``amount`` (n,) of shadow, in texels fully covered, at places x, z (n,)."""
        self._add(self._shadow, x / self.texel, z / self.texel, amount)

    def hide_sky(self, feet: np.ndarray, radii: np.ndarray, amount: float) -> None:
        """Darken softly round each foot (n, 3), by ``amount`` at it and by nothing at its radius.

        Under many things the light left of each is multiplied. ``radii`` (n,) in units.
        """
        texel = SKY_TEXELS * self.texel
        reach = max(int(np.ceil(float(np.max(radii, initial=0.0)) / texel)), 1)
        span = np.arange(-reach, reach + 1)
        dx, dz = (d.ravel() for d in np.meshgrid(span, span))
        middle = (feet[:, [0, 2]] / texel).astype(np.float32)
        column, row = np.floor(middle[:, :1]) + dx, np.floor(middle[:, 1:]) + dz
        away = np.hypot(column + 0.5 - middle[:, :1], row + 0.5 - middle[:, 1:]) * texel
        hidden = amount * np.clip(1.0 - away / radii[:, None], 0.0, 1.0) ** 2
        kept = hidden > 0
        self._add(self._sky, column[kept], row[kept], -np.log1p(-hidden[kept]))

    @staticmethod
    def _add(image: np.ndarray, column: np.ndarray, row: np.ndarray, amount: np.ndarray) -> None:
        """Add amounts (n,) to the texels of a square image in which the places lie."""
        side = len(image)
        c, r = np.floor(column).astype(np.int32), np.floor(row).astype(np.int32)
        inside = (c >= 0) & (c < side) & (r >= 0) & (r < side)
        at = (r * side + c)[inside]
        np.add.at(image.ravel(), at, amount[inside])

    def light(self) -> np.ndarray:
        """Return the factor on the ground's colours, uint8 (side, side, 3), 255 in full light."""
        covered = Image.fromarray((np.clip(self._shadow, 0, 1) * 255).astype(np.uint8))
        soft = np.asarray(covered.filter(ImageFilter.GaussianBlur(SOFTNESS)), np.float32) / 255
        sky = Image.fromarray(np.exp(-self._sky).astype(np.float32))
        sky = sky.resize((self.side, self.side), Image.Resampling.BILINEAR)
        light = soft[..., None] * (LIGHT_LEFT - 1)
        light += 1
        light *= np.asarray(sky)[..., None] * np.float32(255)
        light += 0.5
        return light.astype(np.uint8)


def cast_sprites(shadows: ShadowMap, sprites: Sprites, pictures: list[np.ndarray]) -> None:
    """Throw the shadows of sprites, ``pictures`` (h, w) of alpha uint8 by atlas cell, foot last.

    Each is taken as a board that faces the sun.
    """
    for cell, picture in enumerate(pictures):
        mine = np.flatnonzero(sprites.cells == cell)
        if not len(mine):
            continue
        sizes, feet = sprites.sizes[mine].astype(np.float32), sprites.positions[mine]
        throw = shadows.throw(feet).astype(np.float32)
        across = throw[:, ::-1] * (1, -1) / np.maximum(np.hypot(*throw.T), 1e-6)[:, None]
        wanted = sizes.max(axis=0) / shadows.texel * (SAMPLES_PER_TEXEL, 1.6 * SAMPLES_PER_TEXEL)
        columns, rows = np.clip(np.ceil(wanted), 2, MOST_SAMPLES).astype(int)
        small = Image.fromarray(picture).resize((columns, rows), Image.Resampling.BOX)
        alpha = np.asarray(small, np.float32) / 255
        row, column = np.nonzero(alpha > 0.1)
        # Samples run along the second axis: where each lies on its board, in parts of its sides.
        u = ((column + 0.5) / columns - 0.5).astype(np.float32)
        v = (1.0 - (row + 0.5) / rows).astype(np.float32)
        wide = sizes[:, :1] * np.where(sprites.flipped[mine], -1, 1)[:, None] * across
        high = sizes[:, 1:] * throw
        x, z = (
            feet[:, k, None].astype(np.float32) + wide[:, j, None] * u + high[:, j, None] * v
            for j, k in ((0, 0), (1, 2))
        )
        # A sample stands for a part of the board, thrown longer or shorter than it is high.
        parts = sizes.prod(axis=1) * np.hypot(*throw.T) / (columns * rows * shadows.texel**2)
        amount = parts[:, None].astype(np.float32) * alpha[row, column]
        shadows.darken(x.ravel(), z.ravel(), amount.ravel())


def cast_points(shadows: ShadowMap, points: np.ndarray) -> None:
    """Throw the shadow of a thing given by points (n, 3) that lie no farther apart than a texel."""
    feet = points.copy()
    feet[:, 1] = shadows.field.terrain_height(points[:, 0], points[:, 2])
    up = np.maximum(points[:, 1] - feet[:, 1], 0.0)
    x, z = (feet[:, [0, 2]] + shadows.throw(feet) * up[:, None]).T
    shadows.darken(x, z, np.ones(len(points), np.float32))


def on_edges(corners: Iterable[tuple[float, float]], spacing: float) -> np.ndarray:
    """Return x, z (n, 2) of points along a closed line through ``corners``."""
    ring = np.array([*corners])
    out = []
    for a, b in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        count = max(int(np.ceil(np.hypot(*(b - a)) / spacing)), 1)
        out.append(a + (b - a) * (np.arange(count) / count)[:, None])
    return np.concatenate(out)
