"""The sward: cards with several blades, seed heads and flowers; and gusts that cross the meadow."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flat_land import flat, grass_settings
from PIL import Image
from sprite_stage import looking
from stage import Stage, taken

from framelens.gl.framebuffer import Framebuffer
from framelens.gl.seam import gl
from landscape.elements.best.meadow.gusts import BEND, LENGTH, SPEED, WAY, gusts
from landscape.elements.best.meadow.meadow import Meadow
from landscape.elements.best.meadow.sward import (
    CARD_SIDES,
    CLOSE,
    FLAT,
    FLOOR,
    GREEN_KINDS,
    LOOKS,
    STANDING,
    TALLEST,
    WIDEST,
    card_corners,
    card_scale,
    cells_of,
    covered,
    kinds_at,
    mean_colours,
    off_trail,
    places_at,
    raised,
    slimmed,
    sward_levels,
    texture_coordinates,
)
from landscape.elements.settings import preset
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Pose
from landscape.gl.cut_out import cut_out

NORTH = Pose(10.0, 3.1, 10.0)
SWARD: dict[str, Any] = {
    "sward": True,
    "fade": True,
    "tufts": 6,
    "variety": 1.0,
    "arch": 4.0,
    "tinted": True,
    "scale": (0.22, 1.1),
    "facing": 0.6,
    "count": 2_000_000,
    "flowers": 0.1,
}


@pytest.fixture
def sow(stage: Stage, shipped: Assets):
    """A function that returns the meadow of a flat island, released after the test."""
    made = []

    def grown(assets: Assets = shipped, **changes: Any) -> Meadow:
        made.append(Meadow(grass_settings(**{**SWARD, **changes}), assets, flat(), 7))
        return made[-1]

    yield grown
    stage.enter()
    for each in made:
        each.release()


def places(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return random x, z (n,) on an island 40 units wide."""
    return tuple(np.random.default_rng(3).random((2, count)) * 40)  # type: ignore[return-value]


# ---- cards


def test_a_cards_picture_is_not_bent_at_its_diagonals() -> None:
    kinds = np.arange(len(LOOKS))
    cards = card_corners(np.zeros(len(kinds)), kinds, np.zeros(len(kinds))).transpose(2, 0, 1)
    for card, coordinates in zip(cards, texture_coordinates(), strict=True):
        # One affine function of width and height gives all five coordinates.
        terms = np.column_stack([card[:, :2], np.ones(5)])
        fitted = terms @ np.linalg.lstsq(terms, coordinates, rcond=None)[0]
        assert np.abs(fitted - coordinates).max() < 2e-3
    assert np.allclose(cards[:, :4, 0] / cards[:, 1:2, 0], CARD_SIDES)


def test_each_kind_is_drawn_from_its_own_cell() -> None:
    coordinates = texture_coordinates()
    low, high = coordinates.min(axis=1), coordinates.max(axis=1)
    cell = np.stack([np.arange(16) % 8 / 8, np.arange(16) // 8 / 2], axis=1)
    assert (low >= cell).all() and (high <= cell + (1 / 8, 1 / 2)).all()


def test_mip_levels_keep_the_cells_apart_and_the_cover_of_each(shipped: Assets) -> None:
    levels = sward_levels(shipped.path("sward.png"))
    assert [level.shape[:2] for level in levels] == [(512 >> k, 1024 >> k) for k in range(6)]
    for level in levels[:4]:
        solid = (level[..., 3] > 127).reshape(2, level.shape[0] // 2, 8, level.shape[1] // 8)
        covered = solid.mean(axis=(1, 3))
        if level is levels[0]:
            first = covered
        assert np.allclose(covered, first, atol=0.03) and (covered > 0.05).all()


def test_the_picture_of_another_size_is_resized(shipped: Assets, tmp_path: Path) -> None:
    image = Image.fromarray(read_image(shipped.path("sward.png"))).resize((300, 200))
    image.save(tmp_path / "sward.png")
    levels = sward_levels(tmp_path / "sward.png")
    assert levels[0].shape == (512, 1024, 4)
    whole = mean_colours(read_image(shipped.path("sward.png")))
    assert np.abs(mean_colours(levels[0])[0] - whole[0]).max() < 0.05


# ---- what grows where


def test_the_blades_of_a_sheaf_are_fine_and_have_gaps_between_them(shipped: Assets) -> None:
    for cell in cells_of(read_image(shipped.path("sward.png")))[:3]:
        solid = cell[100:200, :, 3] > 127
        runs = (np.diff(solid.astype(int), axis=1, prepend=0) > 0).sum(axis=1)
        assert runs.max() >= 10 and solid.sum() / runs.sum() < 4.5, "texels of a blade, or several"


def test_without_flowers_none_grow_and_with_them_they_stand_in_drifts() -> None:
    x, z = places(60_000)
    draw, bold = np.random.default_rng(4).random(60_000), np.ones(60_000)
    weights, tuft = places_at(x, z).weights, np.arange(60_000)
    assert kinds_at(weights, tuft, draw, bold, 0.0).max() < STANDING
    flowers = kinds_at(weights, tuft, draw, bold, 0.1) >= STANDING
    assert 0.005 < flowers.mean() < 0.1
    squares = (x // 1).astype(int) * 40 + (z // 1).astype(int)
    share = np.bincount(squares, flowers) / np.maximum(np.bincount(squares), 1)
    assert np.quantile(share, 0.95) > 3 * np.median(share) and (share == 0).mean() > 0.2


def test_of_the_cards_seen_from_far_away_more_are_flowers() -> None:
    x, z = places(60_000)
    draw, weights = np.random.default_rng(4).random(60_000), places_at(x, z).weights
    near, far = (
        (kinds_at(weights, np.arange(60_000), draw, np.full(60_000, bold), 0.05) >= STANDING).mean()
        for bold in (1, 3)
    )
    assert far > 1.8 * near


def test_several_kinds_grow_everywhere_and_the_grass_is_low_on_the_trails() -> None:
    x, z = places(60_000)
    places_there = places_at(x, z)
    draw, tuft = np.random.default_rng(4).random(60_000), np.arange(60_000)
    kinds = kinds_at(places_there.weights, tuft, draw, np.ones(60_000), 0.1)
    assert np.bincount(kinds, minlength=16).min() > 20
    trail, tall = off_trail(x, z), places_there.tall
    assert tall.max() <= TALLEST
    beside, on = tall[trail == 1], tall[trail == 0]
    assert 100 < len(on) < len(beside) / 5 and on.mean() < 0.6 * beside.mean()


def test_the_sward_covers_dry_ground_and_leaves_bare_ground_free() -> None:
    bare, dry, lush = covered(np.array([0.05, 0.5, 1.0]))
    assert bare < 0.05 and dry > 0.6 and lush == 1.0


# ---- what is drawn


def test_green_cards_widen_far_away_and_flowers_keep_their_shape(sow) -> None:
    meadow, frame = sow(count=24_000_000), looking(NORTH)
    patch = meadow.select(frame)
    bent = meadow.bend(frame, patch)
    away = np.hypot(patch.positions[:, 0] - 10, patch.positions[:, 2] - 10)
    width, still = (
        np.linalg.norm((v[:, 1] - v[:, 0])[:, ::2], axis=1) for v in (bent, patch.vertices)
    )
    wider, green = width / still, patch.kinds < GREEN_KINDS
    seen = width > 0
    near = away < 0.15
    slim = slimmed(away, patch.kinds)
    assert np.allclose(wider[near], slim[near], atol=1e-2) and slim[near].min() < 0.9
    far = seen & (away > 2.0) & (away < 3.0)
    assert wider[far & green].min() > 3.0
    assert 1.0 < wider[far & ~green].max() < 2.5


def test_no_card_is_seen_edge_on(sow) -> None:
    meadow, frame = sow(), looking(NORTH)
    patch = meadow.select(frame)
    bent = meadow.bend(frame, patch)
    across = (bent[:, 3] - bent[:, 2])[:, ::2]
    away = patch.positions[:, ::2] - 10.0
    sight = np.stack([-away[:, 1], away[:, 0]], axis=1) / np.hypot(*away.T)[:, None]
    width = np.linalg.norm(across, axis=1)
    shown = width > 1e-4
    assert shown.sum() > 500
    assert (np.abs((across * sight).sum(axis=1)) / np.maximum(width, 1e-9))[shown].min() > 0.7


def test_flowers_keep_their_own_colour_and_green_cards_take_the_grounds(sow) -> None:
    patch = sow().select(looking(NORTH))
    tints = patch.colours()[:, 4, :3].astype(float)
    own = patch.kinds >= GREEN_KINDS
    assert np.ptp(tints[own], axis=1).max() <= 1
    green = tints[patch.kinds == 0] * mean_colours(np.zeros((512, 1024, 4), np.uint8)).mean()
    assert (green[:, 1] > green[:, 0]).mean() > 0.8


@pytest.mark.seldom(3, first=1)
def test_what_is_transparent_in_a_cards_picture_is_not_drawn(
    sow, stage: Stage, plain_folder: Path
) -> None:
    settings = grass_settings(**SWARD)
    pictures = []
    for alpha in (255, 0):
        image = np.full((512, 1024, 4), (200, 40, 40, alpha), np.uint8)
        Image.fromarray(image).save(plain_folder / "sward.png")
        meadow = sow(Assets(plain_folder))
        with stage.frame(settings, NORTH, kt=9.0) as frame:
            empty = stage.read()
            meadow.draw(frame)
            pictures.append(stage.read())
    assert (pictures[0] != empty).any(axis=2).mean() > 0.1
    assert (pictures[1] == empty).all()


def test_the_sward_and_its_flowers_cannot_be_applied_to_a_meadow_that_has_grown(sow) -> None:
    meadow = sow()
    assert taken(meadow, grass_settings(**{**SWARD, "gusts": 1.0}))
    for change in ({"sward": False}, {"flowers": 0.2}):
        assert not taken(meadow, grass_settings(**{**SWARD, **change}))


# ---- gusts


def test_a_gust_travels_with_the_wind() -> None:
    along = np.linspace(0.0, 3.0 * LENGTH, 3000)
    x, z = (along * WAY[0]).astype(np.float32), (along * WAY[1]).astype(np.float32)
    before, after = (gusts(kt, x, z, 1.0)[0] for kt in (40.0, 50.0))
    step = along[1] - along[0]
    first = along[np.argmax(before[500:1500]) + 500]
    later = np.flatnonzero(np.abs(along - first - 10 * SPEED) < 0.15)
    moved = along[later[np.argmax(after[later])]] - first
    assert moved == pytest.approx(10 * SPEED, abs=0.04 + step)
    everywhere = np.hypot(*gusts(40.0, *np.float32(places(2000)), 2.0))
    assert 1.6 * BEND < everywhere.max() < 2.6 * BEND


def test_gusts_bend_tips_and_leave_feet_where_they_are(sow) -> None:
    meadow, calm = sow(gusts=1.0), sow(gusts=0.0)
    frame = looking(NORTH, kt=33.0)
    patch = calm.select(frame)
    moved = meadow.bend(frame, patch) - calm.bend(frame, patch)
    assert np.abs(moved[:, :2]).max() == 0 and np.abs(moved[..., 1]).max() == 0
    tips, shoulders = moved[:, 4, ::2], moved[:, 2, ::2]
    assert np.allclose(shoulders, tips / 2, atol=1e-5) and np.abs(tips).max() > 0.5 * BEND


def test_what_is_half_transparent_covers_half_of_each_pixel_without_a_pattern(stage: Stage) -> None:
    """Mesa 26 chequers it, if it is not told not to."""
    with stage.borrowed():
        target = Framebuffer((16, 16), 4)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        for mode in (gl.GL_PROJECTION, gl.GL_MODELVIEW):
            gl.glMatrixMode(mode)
            gl.glLoadIdentity()
        with cut_out():
            gl.glColor4f(1.0, 1.0, 1.0, 0.4)
            gl.glRectf(-1.0, -1.0, 1.0, 1.0)
        assert not gl.glIsEnabled(gl.GL_SAMPLE_ALPHA_TO_COVERAGE)
        picture = target.read()
        target.release()
        stage.target.bind()
    assert (picture == picture[0, 0]).all()
    assert 60 < picture.max() < 200


def test_a_card_is_never_wider_than_its_picture_though_a_blade_may_be() -> None:
    scale = preset("best").grass.scale
    assert card_scale(scale) == scale
    assert card_scale((2.4, 1.0)) == (WIDEST, 1.0)


def test_grass_before_the_eye_is_narrower_and_what_the_near_plane_would_cut_lies_flat() -> None:
    far = np.linspace(0.0, 2 * CLOSE, 50, dtype=np.float32)
    for kind in range(len(LOOKS)):
        width = slimmed(far, np.full(50, kind))
        assert (width[far >= CLOSE] == 1.0).all() and (np.diff(width * far) >= 0.0).all()
        if kind == FLOOR or kind >= STANDING:
            assert (width == 1.0).all()
    broad, fine = (slimmed(far[:1], np.array([kind]))[0] for kind in (3, 0))
    assert broad < 0.5 < fine < 0.85
    near_plane = preset("best").camera.near
    assert near_plane <= FLAT and (raised(far[far <= near_plane]) == 0.0).all()
    assert (raised(far[far > CLOSE / 2]) == 1.0).all()
