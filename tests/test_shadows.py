"""Shadows on the ground: where they fall, how dark they are, and that the ground shows them."""

from dataclasses import replace

import numpy as np
import pytest

from landscape.elements.best.terrain import shadows as module
from landscape.elements.best.terrain.shadows import (
    LIGHT_LEFT,
    ShadowMap,
    cast_outlines,
    cast_points,
    cast_sprites,
    on_board,
)
from landscape.elements.planting import Sprites
from landscape.geometry.height_field import HeightField
from landscape.geometry.masonry import on_edges

SIDE = 400
FLAT = HeightField(np.full((4, 4), 2.0, np.float32), 40.0, 0.6)
TEXEL = 40.0 / SIDE
SOUTH = np.array([0.0, np.sin(np.radians(45)), np.cos(np.radians(45))])  # 45 degrees high


def shadow_map(field: HeightField = FLAT, sun: np.ndarray = SOUTH) -> ShadowMap:
    return ShadowMap(field, sun, SIDE)


def light_of(shadows: ShadowMap) -> np.ndarray:
    """Return the light map in 0..1."""
    return shadows.light() / 255.0


def dark_box(light: np.ndarray, below: float = 0.9) -> tuple[float, ...]:
    """Return the ranges of x and of z, in units, of what is darker than ``below``."""
    rows, columns = np.nonzero(light[..., 1] < below)
    edges = columns.min(), columns.max() + 1, rows.min(), rows.max() + 1
    return tuple(float(edge) * TEXEL for edge in edges)


def board(height: float = 2.0, width: float = 1.0) -> Sprites:
    """One sprite at (20, 20)."""
    place, size = np.array([(20.0, 2.0, 20.0)]), np.array([(width, height)])
    return Sprites(place, size, np.array([0]), np.array([False]))


def test_a_shadow_points_away_from_the_sun_as_far_as_a_thing_is_high() -> None:
    shadows = shadow_map()
    cast_points(shadows, np.array([(20.05, 2.0 + h, 20.05) for h in np.arange(0, 3, 0.05)]))
    x0, x1, z0, z1 = dark_box(light_of(shadows))
    assert x1 - x0 == pytest.approx(0.1, abs=0.21)  # the penumbra adds a texel to each side
    assert z0 == pytest.approx(17.05, abs=0.15) and z1 == pytest.approx(20.1, abs=0.15)


@pytest.mark.parametrize("elevation", [48.0, 20.0, 4.0])
def test_a_wall_s_shadow_has_no_gaps_however_low_the_sun(elevation: float) -> None:
    high = np.radians(elevation)
    shadows = shadow_map(sun=np.array([0.0, np.sin(high), np.cos(high)]))
    step = 0.7 * TEXEL
    places = np.stack([np.arange(15.0, 25.0, step), np.full(143, 30.0)], axis=1)
    cast_outlines(shadows, places, 0.0, 3.0, step)
    _, _, z0, z1 = dark_box(light_of(shadows))
    assert z1 == pytest.approx(30.0, abs=0.3)
    assert z1 - z0 == pytest.approx(min(3.0 / np.tan(high), 3.0 / module.LOWEST), abs=0.5)
    inside = light_of(shadows)[int(z0 / TEXEL) + 3 : int(z1 / TEXEL) - 3, 155:245]
    assert inside.max() < LIGHT_LEFT.max() + 0.01


def test_up_a_slope_a_shadow_is_shorter_and_down_it_longer() -> None:
    slope = np.repeat(np.linspace(0, 20, 41, dtype=np.float32)[:, None], 41, axis=1)
    up = HeightField(np.ascontiguousarray(slope[::-1]), 40.0, 0.0)  # rises to the north
    down = HeightField(slope * np.float32(0.5), 40.0, 0.0)
    feet = np.array([(20.0, 10.0, 20.0)])
    level, rising, falling = (-shadow_map(field).offset(feet)[0, 1] for field in (FLAT, up, down))
    assert level == pytest.approx(1.0)
    assert rising == pytest.approx(1.0 / 1.5) and falling == pytest.approx(1.0 / 0.75)


def test_under_a_zenith_sun_no_shadow_is_cast() -> None:
    overhead = shadow_map(sun=np.array([0.0, 1.0, 0.0]))
    assert np.allclose(overhead.offset(np.array([(20.0, 2.0, 20.0)])), 0.0)


def test_a_sprite_casts_a_shadow_of_its_own_shape() -> None:
    # The upper half is opaque: the shadow begins one unit off the foot, and is one unit long.
    alpha = np.zeros((64, 64), np.uint8)
    alpha[:32] = 255
    shadows = shadow_map()
    cast_sprites(shadows, board(), [alpha])
    light = light_of(shadows)
    x0, x1, z0, z1 = dark_box(light)
    assert (x0, x1) == pytest.approx((19.5, 20.5), abs=0.15)
    assert (z0, z1) == pytest.approx((18.0, 19.0), abs=0.15)
    assert np.allclose(light[185, 200], LIGHT_LEFT, atol=0.03)
    assert np.allclose(light[195, 200], 1.0)


def test_a_translucent_picture_casts_a_faint_shadow() -> None:
    shadows = shadow_map()
    cast_sprites(shadows, board(), [np.full((64, 64), 77, np.uint8)])
    darkest = 1.0 - light_of(shadows)[190, 200]
    assert np.allclose(darkest, (1.0 - LIGHT_LEFT) * 77 / 255, atol=0.04)


def test_what_falls_off_the_map_is_lost_and_nothing_wraps() -> None:
    shadows = shadow_map()
    cast_points(shadows, np.array([(0.05, 2.0 + h, 0.5) for h in np.arange(0, 3, 0.05)]))
    light = light_of(shadows)
    assert (light[:6, 0] < 0.9).all()
    assert (light[20:] == 1.0).all() and (light[:, 20:] == 1.0).all()


def test_ambient_occlusion_is_strongest_at_the_foot_and_zero_at_the_radius() -> None:
    shadows = shadow_map()
    shadows.hide_sky(np.array([(20.2, 2.0, 20.2)]), np.array([3.0]), 0.4)
    light = light_of(shadows)[202, 202:240, 1]
    assert light[0] == pytest.approx(0.6, abs=0.06)
    assert (np.diff(light) >= -1e-6).all()
    assert light[34] == pytest.approx(1.0, abs=1e-3)


def test_points_along_a_line_lie_no_farther_apart_than_asked() -> None:
    points = on_edges([(0, 0), (1, 0), (1, 1), (0, 1)], 0.03)
    apart = np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1)
    assert apart.max() <= 0.03 and apart.sum() == pytest.approx(4.0)


class Noted(ShadowMap):
    """A shadow map that keeps where it was darkened."""

    def darken(self, x: np.ndarray, z: np.ndarray, amount: np.ndarray) -> None:
        self.at, self.amount = np.stack([x, z], axis=1), amount


@pytest.mark.parametrize("flipped", [False, True])
def test_a_sprites_samples_land_where_each_would_by_itself(flipped: bool) -> None:
    shadows = Noted(FLAT, np.array([0.5, 0.6, 0.3]), SIDE)
    sprites = replace(board(), flipped=np.array([flipped]))
    cast_sprites(shadows, sprites, [np.full((64, 64), 255, np.uint8)])
    foot, size = sprites.positions[0], sprites.sizes[0]
    offset = shadows.offset(foot[None])[0]
    columns, rows = np.ceil(size / TEXEL * (1.3, 1.6 * 1.3)).astype(int)
    wanted = [
        on_board(foot, size, flipped, offset, (c + 0.5) / columns - 0.5, 1 - (r + 0.5) / rows)
        for r in range(rows)
        for c in range(columns)
    ]
    assert np.allclose(shadows.at, wanted, atol=1e-4)
    # Together they cover the board's shadow: its width times the length of its offset.
    covered = shadows.amount.sum() * TEXEL**2
    assert covered == pytest.approx(size.prod() * np.hypot(*offset), rel=1e-4)


def forest(count: int, width: float) -> Sprites:
    """Sprites at random places."""
    rng = np.random.default_rng(2)
    places = np.insert(rng.uniform(0, 40, (count, 2)), 1, 2.0, axis=1)
    sizes = rng.uniform(0.5, 1.0, (count, 2)) * width
    return Sprites(places, sizes, np.zeros(count, int), rng.random(count) < 0.5)


def test_shadows_cast_a_few_at_a_time_are_those_cast_all_at_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    maps = []
    for at_once in (module.AT_ONCE, 5000):
        monkeypatch.setattr(module, "AT_ONCE", at_once)
        maps.append(shadow_map())
        cast_sprites(maps[-1], forest(60, 1.0), [np.full((20, 20), 255, np.uint8)])
        maps[-1].hide_sky(forest(60, 1.0).positions, np.full(60, 1.5), 0.3)
    assert (maps[0].light() == maps[1].light()).all() and (maps[0].light() < 255).any()


def test_a_shade_much_wider_than_a_texel_looks_the_same_on_its_coarser_map(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    lights = []
    for most in (1000, module.MOST_REACH):
        monkeypatch.setattr(module, "MOST_REACH", most)
        shadows = shadow_map()
        shadows.hide_sky(np.array([(20.0, 2.0, 20.0)]), np.array([18.0]), 0.4)
        lights.append(light_of(shadows))
    assert np.abs(lights[0] - lights[1]).max() < 0.03 and lights[0].min() < 0.65


@pytest.mark.seldom(10, first=7)
def test_very_many_or_very_large_sprites_are_cast_within_little_memory() -> None:
    import tracemalloc

    small = HeightField(np.zeros((4, 4), np.float32), 1.0, -1.0)
    tracemalloc.start()
    for field, sprites in ((FLAT, forest(3000, 100.0)), (small, forest(3000, 1.0))):
        shadows = ShadowMap(field, SOUTH, 512)
        cast_sprites(shadows, sprites, [np.full((9, 9), 255, np.uint8)])
        shadows.hide_sky(sprites.positions, sprites.sizes[:, 0], 0.3)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 300e6


def test_the_light_of_a_small_map_has_the_size_of_its_picture() -> None:
    shadows = ShadowMap(HeightField(np.zeros((4, 4), np.float32), 1.0, -1.0), SOUTH, 512)
    assert shadows.side < 512 and shadows.light().shape == (512, 512, 3)
    shadows.darken(*np.full((2, 1), 0.5), np.ones(1))
    rows, columns = np.nonzero(shadows.light()[..., 0] < 250)
    assert abs(rows.mean() - 256) < 3 and abs(columns.mean() - 256) < 3


def test_a_foot_without_width_hides_no_sky_and_gives_no_warning() -> None:
    shadows = shadow_map()
    with np.errstate(all="raise"):
        shadows.hide_sky(np.array([(20.1, 2.0, 20.1)]), np.zeros(1), 0.4)
    assert (shadows.light() == 255).all()
