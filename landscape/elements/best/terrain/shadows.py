"""Shadows baked into the ground's colours once, before the first frame (a light map).

Not in the report, whose trees and castle cast none. Technique: what casts a shadow is sampled as
points. Each point is projected along the sun's direction onto the ground and darkens the texel it
lands on. The samples of a sprite are the texels of its own picture, so that a birch casts the
shadow of a birch. Around the foot of objects, which block part of the sky, the ground is a little
darker as well. None of this costs time while walking: neither the sun nor what casts a shadow
moves. No OpenGL here.
"""

from collections.abc import Iterator

import numpy as np
from PIL import Image, ImageFilter

from landscape.elements.best import stones
from landscape.elements.best.sprites.refined_planting import planted_from
from landscape.elements.best.terrain import ASKED_BY
from landscape.elements.planting import Sprites
from landscape.elements.settings import Settings, Sun
from landscape.geometry.height_field import HeightField
from landscape.settings.declare import differs

LIGHT_LEFT = np.array(Sun().shade, np.float32)  # fraction of the colour in full shadow, at noon
# All chosen.
SKY_HIDDEN = 0.50  # fraction of the light lost right at the foot of an object
SKY_TEXELS = 4  # shadow texels per texel of the shade from the blocked sky, which is soft
SAMPLES_PER_TEXEL = 1.3  # along each side, so that there are no gaps between points
MOST_SAMPLES = 48  # along a sprite's side
MOST_POINTS = 32e6  # samples of all sprites of a picture: with very many, each casts fewer
SOFTNESS = 0.7  # texels: radius of the blur that makes a penumbra
FINEST = (
    0.01  # units: least side of a texel; on a tiny map the castle would need millions of points
)
MOST_REACH = 12  # texels of the blocked sky around a foot; a larger shade has a coarser map
AT_ONCE = 1 << 21  # points of shadow in memory at a time
FLATTEST = 0.35  # least rise over run of the sunlight along the ground; limits long shadows
LOWEST = 0.22  # the same for a sun that is lower than that


def light_is_baked(settings: Settings) -> bool:
    """Return whether the large texture is multiplied by a light map; the plain ground's never."""
    sun = settings.sun
    terrain = any(differs(settings, key) for key in ASKED_BY)
    relit = (sun.relit or sun.tint != Sun().tint) and terrain
    return settings.ground.shadows or relit


def cast_from(settings: Settings) -> tuple[object, ...]:
    """Return the settings that the light map depends on: land, sun, and what casts shadows."""
    castle, rabbit = settings.castle, settings.rabbit
    if not settings.ground.shadows:
        return (settings.sun,) if light_is_baked(settings) else ()
    stands = castle.yaw, castle.brick_repeat, castle.ornate, rabbit.mesh, rabbit.yaw
    lying = settings.ground.stones if stones.wanted(settings) else 0
    return settings.sun, settings.ground.clouds, *stands, lying, *planted_from(settings)


class ShadowMap:
    """A map of the land, ``side`` texels square, in which shadows add up.

    On a small map it is coarser than the picture that it is for.
    """

    def __init__(self, field: HeightField, sun: np.ndarray, side: int) -> None:
        """Start with no shadow, for a picture of ``side`` texels.

        ``sun`` (3,) is the unit vector towards the light.
        """
        self.field, self._picture = field, side
        self.side = max(min(side, int(field.size / FINEST)), 1)
        self._sun = np.asarray(sun, np.float64)
        rise = self._sun[1] / max(float(np.hypot(self._sun[0], self._sun[2])), 1e-6)
        self._flattest = min(FLATTEST, max(float(rise), LOWEST))
        self.longer = FLATTEST / self._flattest  # shadows, than the longest at noon
        self.stretch = 1.0 / max(float(rise), self._flattest)  # length over height, on level ground
        self._shadow = np.zeros((self.side, self.side))
        self._sky = np.zeros((max(self.side // SKY_TEXELS, 1),) * 2)

    @property
    def texel(self) -> float:
        """Return the side of a texel in units."""
        return self.field.size / self.side

    def offset(self, feet: np.ndarray) -> np.ndarray:
        """Return the shadow offset x, z (n, 2) of a point one unit above each foot (n, 3).

        The ground around a foot is approximated by a plane.
        """
        level = np.hypot(self._sun[0], self._sun[2])
        if level < 1e-6:
            return np.zeros((len(feet), 2))
        away = -self._sun[[0, 2]] / level
        x = feet[:, 0]
        z = feet[:, 2]
        step = 2.0 * self.texel
        ahead = self.field.terrain_height(x + step * away[0], z + step * away[1])
        behind = self.field.terrain_height(x - step * away[0], z - step * away[1])
        steep = np.maximum(self._sun[1] / level + (ahead - behind) / (2 * step), self._flattest)
        return np.asarray(away / steep[:, None])

    def darken(self, x: np.ndarray, z: np.ndarray, amount: np.ndarray) -> None:
        """Add ``amount`` (n,) of shadow at places x, z (n,); 1 covers a texel."""
        self._add(self._shadow, x / self.texel, z / self.texel, amount)

    def hide_sky(self, feet: np.ndarray, radii: np.ndarray, amount: float) -> None:
        """Darken softly around each foot (n, 3), by ``amount`` at the foot and 0 at its radius.

        At distance d from a foot of radius r the light is multiplied by
        1 - amount * (1 - d/r)^2. The map sums the logarithms, so that the factors of many
        feet multiply. ``radii`` (n,) in units.
        """
        radii = np.maximum(radii, 1e-6)  # a mesh of a single point has none
        radius = float(np.max(radii, initial=0.0))
        coarser = max(int(np.ceil(radius / (MOST_REACH * SKY_TEXELS * self.texel))), 1)
        side = max(len(self._sky) // coarser, 1)
        sky = self._sky if coarser == 1 else np.zeros((side, side))
        texel = SKY_TEXELS * self.texel if coarser == 1 else self.field.size / side
        reach = max(min(int(np.ceil(radius / texel)), side), 1)
        span = np.arange(-reach, reach + 1)
        dx, dz = (d.ravel() for d in np.meshgrid(span, span))
        for some in batches(len(feet), len(dx)):
            middle = (feet[some][:, [0, 2]] / texel).astype(np.float32)
            column, row = np.floor(middle[:, :1]) + dx, np.floor(middle[:, 1:]) + dz
            away = np.hypot(column + 0.5 - middle[:, :1], row + 0.5 - middle[:, 1:]) * texel
            hidden = amount * np.clip(1.0 - away / radii[some][:, None], 0.0, 1.0) ** 2
            kept = hidden > 0
            self._add(sky, column[kept], row[kept], -np.log1p(-hidden[kept]))

        if coarser > 1:
            image = Image.fromarray(sky.astype(np.float32))
            self._sky += np.asarray(image.resize(self._sky.shape, Image.Resampling.BILINEAR))

    @staticmethod
    def _add(image: np.ndarray, column: np.ndarray, row: np.ndarray, amount: np.ndarray) -> None:
        """Add amounts (n,) to the texels of a square image that contain the points."""
        side = len(image)
        c, r = np.floor(column).astype(np.int32), np.floor(row).astype(np.int32)
        inside = (c >= 0) & (c < side) & (r >= 0) & (r < side)
        at = (r * side + c)[inside]
        if len(at) < image.size // 8:
            np.add.at(image.ravel(), at, amount[inside])
        else:  # the same sums, several times as fast for many points
            image += np.bincount(at, amount[inside], image.size).reshape(side, side)

    def light(self, lit: np.ndarray | float = 1.0, left: np.ndarray = LIGHT_LEFT) -> np.ndarray:
        """Return the factor for the picture's colours, uint8 (n, n, 3), 255 in full light.

        ``lit`` is its value in the sun, (side, side, 3) or less, and ``left`` (3,) in full shadow.
        """
        covered = Image.fromarray((np.clip(self._shadow, 0, 1) * 255).astype(np.uint8))
        soft = np.asarray(covered.filter(ImageFilter.GaussianBlur(SOFTNESS)), np.float32) / 255
        sky = Image.fromarray(np.exp(-self._sky).astype(np.float32))
        sky = sky.resize((self.side, self.side), Image.Resampling.BILINEAR)
        lit = np.asarray(lit, np.float32)
        light = soft[..., None] * (left - lit)
        light += lit
        light *= np.asarray(sky)[..., None] * np.float32(255)
        light += 0.5
        found = light.astype(np.uint8)
        if self.side == self._picture:
            return found
        whole = Image.fromarray(found).resize((self._picture,) * 2, Image.Resampling.BILINEAR)
        return np.array(whole)


def batches(count: int, each: int) -> Iterator[slice]:
    """Yield slices of ``count`` things that have ``each`` points, AT_ONCE points or one thing."""
    step = max(AT_ONCE // max(each, 1), 1)
    return (slice(first, first + step) for first in range(0, count, step))


def cast_sprites(shadows: ShadowMap, sprites: Sprites, pictures: list[np.ndarray]) -> None:
    """Cast the shadows of sprites, ``pictures`` (h, w) of alpha uint8 by atlas cell, foot last.

    Each is treated as a board that faces the sun. The samples of many sprites of a picture are
    computed at once; :func:`on_board` says where a single one lands.
    """
    for cell, picture in enumerate(pictures):
        mine = np.flatnonzero(sprites.cells == cell)
        if not len(mine):
            continue
        sizes, feet = sprites.sizes[mine].astype(np.float32), sprites.positions[mine]
        offset = shadows.offset(feet).astype(np.float32)
        across = offset[:, ::-1] * (1, -1) / np.maximum(np.hypot(*offset.T), 1e-6)[:, None]
        wanted = sizes.max(axis=0) / shadows.texel * (SAMPLES_PER_TEXEL, 1.6 * SAMPLES_PER_TEXEL)
        wanted[1] *= shadows.longer
        most = np.array([1.0, shadows.longer])
        most *= min(MOST_SAMPLES, max((MOST_POINTS / len(mine)) ** 0.5, 2))
        columns, rows = np.clip(np.ceil(wanted), 2, most).astype(int)
        small = Image.fromarray(picture).resize((columns, rows), Image.Resampling.BOX)
        alpha = np.asarray(small, np.float32) / 255
        row, column = np.nonzero(alpha > 0.1)

        # Samples run along the second axis: u, v is the place on the board, as in on_board.
        u = ((column + 0.5) / columns - 0.5).astype(np.float32)
        v = (1.0 - (row + 0.5) / rows).astype(np.float32)
        wide = sizes[:, :1] * np.where(sprites.flipped[mine], -1, 1)[:, None] * across
        high = sizes[:, 1:] * offset

        # The area of shadow of a sample: its fraction of the board, times the length of the offset.
        area = sizes.prod(axis=1) * np.hypot(*offset.T) / (columns * rows * shadows.texel**2)
        for some in batches(len(mine), len(u)):
            x, z = (
                feet[some, k, None].astype(np.float32)
                + wide[some, j, None] * u
                + high[some, j, None] * v
                for j, k in ((0, 0), (1, 2))
            )
            amount = area[some, None].astype(np.float32) * alpha[row, column]
            shadows.darken(x.ravel(), z.ravel(), amount.ravel())


def on_board(
    foot: np.ndarray, size: np.ndarray, flipped: bool, offset: np.ndarray, u: float, v: float
) -> np.ndarray:
    """Return the ground's x, z (2,) on which a place of a sprite's board casts its shadow.

    ``u`` is -0.5 to 0.5 across the board and ``v`` 0 at the foot to 1 at the top; ``foot`` (3,),
    ``size`` (2,) and ``offset`` (2,) are the sprite's. The plain form of what cast_sprites does for
    many at once.
    """
    across = np.array([offset[1], -offset[0]]) / np.hypot(*offset)
    wide = -size[0] * across if flipped else size[0] * across
    return np.asarray(foot[[0, 2]] + u * wide + v * size[1] * offset)


def cast_points(shadows: ShadowMap, points: np.ndarray) -> None:
    """Cast the shadow of points (n, 3) that are no farther apart than a texel."""
    feet = points.copy()
    feet[:, 1] = shadows.field.terrain_height(points[:, 0], points[:, 2])
    up = np.maximum(points[:, 1] - feet[:, 1], 0.0)
    x, z = (feet[:, [0, 2]] + shadows.offset(feet) * up[:, None]).T
    shadows.darken(x, z, np.ones(len(points), np.float32))


def cast_outlines(
    shadows: ShadowMap, places: np.ndarray, low: float, high: float, step: float
) -> None:
    """Cast the shadow of an upright wall along places x, z (n, 2), from ``low`` to ``high``.

    Heights in units above the ground at each place; samples at most ``step`` units apart, in the
    shadow as well.
    """
    heights = np.arange(low, high, step / max(shadows.stretch, 1.0))
    points = np.repeat(on_ground(shadows, places), len(heights), axis=0)
    points[:, 1] += np.tile(heights, len(places))
    cast_points(shadows, points)


def shade_foot(shadows: ShadowMap, places: np.ndarray, radius: float) -> None:
    """Darken the ground along the foot of a wall, places x, z (n, 2) half a ``radius`` apart."""
    shadows.hide_sky(on_ground(shadows, places), np.full(len(places), radius), 0.5 * SKY_HIDDEN)


def on_ground(shadows: ShadowMap, places: np.ndarray) -> np.ndarray:
    """Return points (n, 3) of the terrain at places x, z (n, 2)."""
    return np.insert(places, 1, shadows.field.terrain_height(*places.T), axis=1)
