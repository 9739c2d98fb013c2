"""The meadow: blades turned to the viewer, in tufts and layers, tinted, thinned out far away."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from flat_land import flat, grass_settings
from sprite_stage import looking
from stage import Stage, small, taken

from framelens.gl.seam import gl
from landscape.elements.best.meadow import growth as growth_module
from landscape.elements.best.meadow.facing import facing, facing_plain
from landscape.elements.best.meadow.growth import Growth
from landscape.elements.best.meadow.meadow import Meadow
from landscape.elements.best.meadow.refined_blades import (
    ARRAYS,
    DENSE,
    NEAR,
    NOTHING,
    Patch,
    arched,
    blade_tints,
    count_at,
    nearness,
    packed,
    showing,
)
from landscape.elements.best.meadow.rows import Rows, spans
from landscape.elements.grass import Blades, Grass, bent, blade_corners, blade_vertices, blade_wind
from landscape.elements.grass_cells import CELL
from landscape.elements.ground import Ground
from landscape.files.assets import Assets
from landscape.frame import Detail, Pose

NORTH = Pose(20.0, 3.1, 20.0)
LUSH: dict[str, Any] = {"fade": True, "tufts": 7, "variety": 1.0, "count": 200_000}


def growth(**changes: Any) -> Growth:
    """Return how a meadow grows on the flat land."""
    grey = np.full(3, 0.4)
    return Growth(grass_settings(**changes), flat(), 7, (grey, grey))


def patch_of(grown: Growth, cell: int, wanted: int | None = None) -> Patch:
    """Return at least the first ``wanted`` blades of a cell, or all."""
    least = int(grown.counts[cell]) if wanted is None else wanted
    return grown.blades(grown.sown([cell], [least]))


def same(one: Patch, other: Patch) -> bool:
    """Return whether two patches hold the same blades."""
    return all(np.array_equal(getattr(one, name), getattr(other, name)) for name in ARRAYS)


@pytest.fixture
def sow(stage: Stage, plain: Assets):
    """A function that returns the meadow of a flat island, released after the test."""
    made = []

    def grown(**changes: Any) -> Meadow:
        made.append(Meadow(grass_settings(**changes), plain, flat(), 7))
        return made[-1]

    yield grown
    stage.enter()
    for each in made:
        each.release()


# ---- blades


def test_arch_multiplies_the_bend_of_the_tip_and_moves_the_shoulders_a_third_as_far() -> None:
    plain = blade_corners(np.array([0.3, 2.0]))
    assert (arched(plain, 1.0) == plain).all()
    far = arched(plain, 4.0)
    assert np.allclose(far[:, 4, ::2], 4 * plain[:, 4, ::2])
    assert np.allclose(far[:, 2:4] - plain[:, 2:4], (far[:, 4:] - plain[:, 4:]) / 3)
    assert (far[:, :2] == plain[:, :2]).all() and np.allclose(far[..., 1], plain[..., 1])


def test_a_blade_is_darker_at_its_foot() -> None:
    foot, above = blade_tints(np.array([(0.2, 0.4, 0.1)]), np.ones(1))
    assert (foot < 0.9 * above).all()
    assert above[0, 1] / above[0, 0] == pytest.approx(2.0)
    tints = np.stack([packed(colours.T) for colours in (foot, above)], axis=1)
    (drawn,) = replace(NOTHING, tints=tints).colours()
    assert (drawn[:2, :3] == np.uint8(255 * foot)).all() and (drawn[..., 3] == 255).all()
    assert (drawn[2:, :3] == np.uint8(255 * above)).all()


def test_rows_grow_and_keep_what_is_in_them() -> None:
    rows = Rows(place=np.empty((0, 2)), number=np.empty(0, int))
    for k in range(5):
        rows.add(3, number=np.arange(3) + 10 * k)
        rows["place"][3 * k :] = k
    assert rows.count == 15 and rows["number"].tolist()[3:6] == [10, 11, 12]
    assert rows.take("place", np.array([2, 14])).tolist() == [[0, 0], [4, 4]]
    rows.keep(np.array([14, 3]))
    assert rows["number"].tolist() == [42, 10] and rows["place"].shape == (2, 2)
    rows.add(1, number=np.array([7]))
    assert rows.count == 3 and rows["number"].tolist() == [42, 10, 7]
    assert spans(np.array([7, 20, 9]), np.array([3, 0, 2])).tolist() == [7, 8, 9, 9, 10]


def test_a_sparse_meadow_is_thinned_out_farther_away_and_still_shows_fewer_blades() -> None:
    assert nearness(DENSE) == nearness(10 * DENSE) == NEAR
    near = [nearness(density) for density in (DENSE / 64, DENSE / 8, DENSE)]
    assert near == sorted(near, reverse=True) and near[0] > 2 * NEAR
    # Of as many square units: blades drawn up to 2 units away, at 1 and at 8 times the density.
    few, many = (count_at(count, near_, 2.0) for count, near_ in ((1000, near[0]), (8000, near[1])))
    assert few < many < 3 * few


def seen_widths(blades: np.ndarray, eye: np.ndarray) -> np.ndarray:
    """Return the feet's width at right angles to the line of sight, as a fraction of the whole."""
    across = (blades[:, 1] - blades[:, 0])[:, ::2]
    away = blades[:, 0, ::2] / 2 + blades[:, 1, ::2] / 2 - eye
    sight = np.stack([-away[:, 1], away[:, 0]], axis=1)
    seen = (across * sight).sum(axis=1) / np.linalg.norm(sight, axis=1)
    return np.abs(seen) / np.linalg.norm(across, axis=1)


def test_r7_no_blade_is_seen_edge_on() -> None:
    angles = np.linspace(0, 2 * np.pi, 721)
    spots = np.random.default_rng(5).random((721, 3)) * 6
    eye = np.array([3.0, 9.0])
    plain = blade_vertices(spots, blade_corners(angles))
    turned = facing_plain(plain, (spots[:, ::2] - eye).astype(np.float32), 0.6)
    assert seen_widths(plain, eye).min() < 0.05
    # sqrt(1 - (0.4 / 0.6)^2)
    assert seen_widths(turned, eye).min() > 0.74
    width = np.linalg.norm(turned[:, 1] - turned[:, 0], axis=1)
    assert np.allclose(width, 0.006, rtol=1e-3)
    assert (turned[:, 4] == plain[:, 4]).all()
    middle = (turned[:, 0] + turned[:, 1]) / 2
    assert np.allclose(middle, spots, atol=1e-5)


@pytest.mark.parametrize("fraction", [0.3, 0.6, 1.0])
def test_r7_complex_numbers_turn_blades_as_the_plain_form_does(fraction: float) -> None:
    rng = np.random.default_rng(6)
    spots = rng.random((500, 3)) * 6
    plain = blade_vertices(spots, blade_corners(rng.random(500) * 7), (0.4, 1.1))
    away = (spots[:, ::2] - (3.0, 9.0)).astype(np.float32)
    columns = np.ascontiguousarray(plain.transpose(1, 2, 0))
    facing(columns, np.ascontiguousarray(away.T), fraction)
    turned = facing_plain(plain, away, fraction)
    assert np.abs(turned - plain).max() > 4e-4
    assert np.allclose(columns.transpose(2, 0, 1), turned, rtol=0, atol=2e-6)


def test_r7_blades_turn_smoothly_as_the_walker_passes() -> None:
    blades = blade_vertices(np.zeros((400, 3)), blade_corners(np.full(400, 0.3)))
    around = np.linspace(0, 2 * np.pi, 400)
    away = np.stack([np.cos(around), np.sin(around)], axis=1).astype(np.float32)
    turned = facing_plain(blades, away, 0.6)
    side = (turned[:, 1] - turned[:, 0])[:, ::2] / 0.006
    assert np.linalg.norm(np.diff(side, axis=0), axis=1).max() < 0.1


@pytest.mark.parametrize("fraction", [0.0, 0.6])
def test_r7_the_setting_turns_the_blades_that_are_drawn(sow, fraction: float) -> None:
    meadow, frame = sow(facing=fraction), looking(NORTH)
    widths = seen_widths(meadow.bend(frame, meadow.select(frame)), np.array([20.0, 20.0]))
    assert widths.min() > 0.7 if fraction else widths.min() < 0.05


# ---- growth


def test_tinted_grass_keeps_to_green_ground_and_takes_its_colour() -> None:
    grown = growth(tinted=True, count=20_000)
    counts = grown.counts.reshape(80, 80)
    assert counts[:, 40:].sum() == 0 and counts[:, :40].sum() == 20_000
    tints = patch_of(grown, 805).colours()
    assert (tints[..., 1] > tints[..., 0]).all() and (tints[..., 3] == 255).all()


def test_tinted_blades_in_the_shadow_are_darker() -> None:
    grown = growth(tinted=True)
    north, south = (patch_of(grown, row * 80 + 20).colours() for row in (20, 60))
    assert south[..., 1].mean() == pytest.approx(0.5 * north[..., 1].mean(), rel=0.1)


def test_blades_grow_in_tufts_that_lean_apart() -> None:
    patch = patch_of(growth(**LUSH), 3210)
    spread = patch.positions[:7, ::2] - patch.positions[:7, ::2].mean(axis=0)
    assert np.abs(spread).max() < 0.02
    loose = patch_of(growth(**{**LUSH, "tufts": 0}), 3210)
    spread = loose.positions[:7, ::2] - loose.positions[:7, ::2].mean(axis=0)
    assert np.abs(spread).max() > 0.05
    tips = patch.vertices[:, 4, ::2] - patch.positions[:, ::2]
    assert np.linalg.norm(tips, axis=1).min() > 0.003


def test_a_cell_grows_the_same_blades_far_away_as_close_up() -> None:
    far, near = growth(**{**LUSH, "count": 2_000_000}), growth(**{**LUSH, "count": 2_000_000})
    whole = patch_of(near, 3210)
    first = patch_of(far, 3210, 40)
    count = len(first.ranges)
    assert 40 <= count < len(whole.ranges) == near.counts[3210]
    assert (first.vertices == whole.vertices[:count]).all()
    assert same(patch_of(far, 3210), whole)


def test_a_cell_with_few_places_to_grow_uses_the_places_found(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(growth_module, "places_in_cells", lambda *a: [np.full((3, 2), 20.1)])
    grown = growth(**LUSH)
    assert len(patch_of(grown, 3240).ranges) == grown.counts[3240] == 21


def test_variety_makes_heights_and_colours_differ() -> None:
    def spread(variety: float) -> tuple[float, float]:
        patch = patch_of(growth(tinted=True, **{**LUSH, "variety": variety}), 3210)
        red, green, _, _ = patch.colours()[:, 4].T
        heights = patch.vertices[:, 4, 1] - patch.positions[:, 1]
        return float(heights.std()), float((red / green).std())

    plain, varied = spread(0.0), spread(1.0)
    assert varied[0] > 1.3 * plain[0] and varied[1] > 5 * plain[1]


@pytest.mark.seldom(14, first=3)
def test_cells_long_unused_are_dropped_and_regrow_identically(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    grown = growth(fade=True)
    first, counts = [patch_of(grown, cell) for cell in range(6400)], grown.counts.copy()
    assert grown.grown == 50_000
    monkeypatch.setattr(growth_module, "LEAST", 1000)
    grown.forget(in_view=0)
    assert 400 < grown.grown <= 500
    assert list(grown._cells)[-1] == 6399 and 0 not in grown._cells, "the last used stay"
    for cell in range(0, 6400, 8):
        assert same(first[cell], patch_of(grown, cell))
    assert same(first[6399], patch_of(grown, 6399))
    assert np.array_equal(grown.counts, counts)


def test_a_dropped_cell_with_fewer_blades_than_its_share_regrows_identically(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    places_in_cells = growth_module.places_in_cells
    monkeypatch.setattr(
        growth_module, "places_in_cells", lambda *a: [p[:30] for p in places_in_cells(*a)]
    )
    monkeypatch.setattr(growth_module, "LEAST", 0)
    grown = growth(fade=True, count=500_000)
    share = grown.counts[3240]
    first = patch_of(grown, 3240)
    assert len(first.ranges) == grown.counts[3240] == 30 < share
    grown.forget(in_view=0)
    assert grown.grown == 0
    assert same(patch_of(grown, 3240), first)


@pytest.mark.parametrize("fade", [True, False])
def test_cells_that_grow_together_grow_as_they_do_one_by_one(fade: bool) -> None:
    together, alone = (growth(**{**LUSH, "fade": fade, "count": 2_000_000}) for _ in range(2))
    cells = [3210, 3211, 3290, 3291]
    for wanted in ([40, 300, 0, 130], [40, 5000, 70, 200]):
        both = together.blades(together.sown(cells, wanted))
        singly = [patch_of(alone, *each) for each in zip(cells, wanted, strict=True)]
        for least, cell, one in zip(wanted, cells, singly, strict=True):
            assert len(one.ranges) >= min(least, together.counts[cell])
        for name in ARRAYS:
            joined = np.concatenate([getattr(one, name) for one in singly])
            assert np.array_equal(getattr(both, name), joined)
    assert together.grown == alone.grown and (together.counts == alone.counts).all()


# ---- what is drawn


def test_with_no_refinement_the_meadow_is_the_plain_grass(sow, stage: Stage, plain: Assets) -> None:
    meadow, settings = sow(), grass_settings()
    grass = Grass(settings, plain, flat(), 7)
    patch, blades = meadow.select(looking(NORTH)), grass.select(looking(NORTH))
    assert (patch.positions == blades.positions).all()
    assert (patch.vertices == blades.vertices).all() and len(blades.positions) > 100
    frame = looking(NORTH, kt=17.0)
    assert (meadow.bend(frame, patch) == bent(blades, 17.0, 1.0)).all()
    pictures = []
    for element in (meadow, grass):
        with stage.frame(settings, NORTH, kt=17.0) as frame:
            element.draw(frame)
            pictures.append(stage.read())
    grass.release()
    assert (pictures[0] == pictures[1]).all() and pictures[0].std() > 1


def test_the_wind_bends_the_meadow_like_the_plain_grass(sow) -> None:
    meadow, frame = sow(facing=0.6), looking(NORTH, kt=17.0)
    patch = meadow.select(frame)
    moved = meadow.bend(frame, patch) - meadow.bend(looking(NORTH, kt=0.0), patch)
    wind = blade_wind(17.0, patch.positions, 1.0) - blade_wind(0.0, patch.positions, 1.0)
    assert np.allclose(moved[:, 4, ::2], wind, atol=1e-5)
    plain = Blades(patch.positions, patch.vertices)
    assert np.allclose(moved, bent(plain, 17.0, 1.0) - bent(plain, 0.0, 1.0), atol=1e-5)


def test_with_fade_far_cells_are_thinned_and_far_blades_shrink(sow) -> None:
    meadow, frame = sow(fade=True, count=2_000_000), looking(NORTH)
    patch = meadow.select(frame)
    vertices, places = meadow.bend(frame, patch), patch.positions
    away = np.hypot(places[:, 0] - 20, places[:, 2] - 20)
    ranges, tall = np.minimum(patch.ranges, 4.0), patch.vertices[:, 4, 1] - 3.0
    left = (vertices[:, 4, 1] - 3.0) / tall
    # Whole up to three quarters of its range, then down to nothing at its end.
    assert np.allclose(left, np.clip((ranges - away) / (ranges / 4), 0.0, 1.0), atol=1e-3)
    assert (left[away < 0.2] > 0.99).all() and left.min() < 0.2
    assert (away > 2.0).any() and tall.min() > 0.005
    cell = 34 * 80 + 40
    whole = growth(fade=True, count=2_000_000).counts[cell]
    middle = np.array([(cell % 80 + 0.5) * CELL, (cell // 80 + 0.5) * CELL])
    drawn = (np.abs(places[:, ::2] - middle) < CELL / 2).all(axis=1).sum()
    assert 0 < drawn < whole


def shown(meadow: Meadow, frame: Any, patch: Patch) -> set[bytes]:
    """Return the blades of a patch that show, bent."""
    return {blade.tobytes() for blade in meadow.bend(frame, patch) if np.ptp(blade[:, 1]) > 0}


@pytest.mark.seldom(10, first=3)
@pytest.mark.parametrize("fade", [True, False])
def test_a_reused_selection_shows_what_a_new_one_would(sow, fade: bool) -> None:
    meadow, other = (sow(fade=fade, count=200_000) for _ in range(2))
    start = Pose(20.0, 3.1, 20.0, 10.0, -5.0)
    kept = meadow.choice(looking(start))
    for step in range(1, 6):
        pose = Pose(20.0 + 0.01 * step, 3.1, 20.0 - 0.01 * step, 10.0 + 0.5 * step, -5.0)
        frame = looking(pose, kt=3.0 * step)
        assert (meadow.choice(frame) is kept) == (fade and step <= 4)
        drawn = meadow._growth.blades(meadow.choice(frame))
        assert shown(other, frame, other.select(frame)) <= shown(meadow, frame, drawn)
        if fade:
            away = np.hypot(drawn.positions[:, 0] - pose.x, drawn.positions[:, 2] - pose.z)
            flat = np.ptp(meadow.bend(frame, drawn)[..., 1], axis=1) == 0
            assert flat[away > np.minimum(drawn.ranges, 4.0)].all()
    assert meadow.choice(looking(Pose(20.3, 3.1, 20.0, 10.0, -5.0))) is not kept


def test_what_is_drawn_does_not_depend_on_what_has_grown_before(
    sow, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Cells with few suitable places: that they have fewer blades than their share shows only when
    # these have grown.
    found = growth_module.places_in_cells
    monkeypatch.setattr(
        growth_module, "places_in_cells", lambda *a: [places[:40] for places in found(*a)]
    )
    meadow = sow(fade=True, count=500_000)
    first, again = (meadow.select(looking(NORTH)) for _ in range(2))
    assert np.array_equal(first.positions, again.positions)


DENSE_MEADOW: dict[str, Any] = {"fade": True, "tufts": 6, "sward": True, "count": 24_000_000}


@pytest.mark.seldom(13, first=7)
def test_only_tufts_that_are_seen_take_shape(sow) -> None:
    """They show the same blades as if all that is sown had grown."""
    seen, whole = (sow(**DENSE_MEADOW) for _ in range(2))
    poses = [Pose(20.0, 3.1, 20.0), Pose(20.15, 3.1, 20.02, 40.0), Pose(20.3, 3.1, 20.2, 130.0)]
    for pose in poses:
        frame = looking(pose)
        patch = seen.seen(frame, seen.choice(frame))
        whole.choice(frame)
        grown = whole._growth.blades(np.arange(whole._growth.tufts.count))
        ranges = whole._shortened(frame, grown.ranges)
        kept = showing(frame, grown.places, ranges, grown.sizes, whole._widening)
        assert len(patch.positions) > 2_000
        drawn = {blade.tobytes() for blade in whole.bend(frame, grown)[kept]}
        assert {blade.tobytes() for blade in seen.bend(frame, patch)} == drawn

    shaped, sown = seen._growth.tufts["shaped"], seen._growth.tufts["blades"]
    assert 0 < sown[shaped].sum() < sown.sum() / 2


@pytest.mark.parametrize("changes", [LUSH, {"fade": True, "arch": 4.0, "tufts": 5}, {"tufts": 3}])
@pytest.mark.parametrize("sward", [True, False])
def test_no_blade_is_larger_than_its_tuft_is_said_to_be(
    changes: dict[str, Any], sward: bool
) -> None:
    grown = growth(**{**changes, "sward": sward, "count": 2_000_000})
    tufts = grown.sown([3210, 3211], [200, 300])
    patch = grown.blades(tufts)
    counts, tops = grown.tufts.take("blades", tufts), grown.tufts.take("sizes", tufts)
    assert (patch.sizes <= np.repeat(tops, counts) * 1.0001).all()
    assert patch.sizes.max() > 0.3 * tops.max()
    apart = np.linalg.norm(patch.vertices - patch.positions[:, None], axis=2).max(axis=1)
    assert np.allclose(apart, patch.sizes, rtol=0, atol=1e-5)
    roots = np.repeat(grown.tufts.take("places", tufts), counts, axis=0)
    aside = np.hypot(*(patch.positions - roots)[:, ::2].T)
    assert (aside <= grown.tuft_radius + 1e-5).all()
    assert (patch.ranges <= np.repeat(grown.tufts.take("ranges", tufts), counts)).all()


def test_dropped_tufts_grow_again_as_they_were(sow, monkeypatch: pytest.MonkeyPatch) -> None:
    meadow, frame = sow(**DENSE_MEADOW), looking(NORTH)
    first = meadow.select(frame)
    monkeypatch.setattr(growth_module, "LEAST", 0)
    monkeypatch.setattr(growth_module, "KEPT", 0)
    meadow._growth.forget(in_view=0)
    assert meadow._growth.grown == 0
    assert same(meadow.select(frame), first)


def test_what_is_not_sent_does_not_show(sow) -> None:
    """Of a choice with a margin, what has sunk or is beside the picture is left out."""
    meadow, frame = sow(**DENSE_MEADOW), looking(NORTH)
    tufts = meadow.choose(frame, 0.09, 0.1)
    chosen, sent = meadow._growth.blades(tufts), meadow.seen(frame, tufts)
    assert 1_000 < len(sent.ranges) < 0.8 * len(chosen.ranges)
    others = shown(meadow, frame, chosen) - shown(meadow, frame, sent)
    corners = np.array([np.frombuffer(blade, np.float32).reshape(5, 3) for blade in others])
    away = corners - frame.eye
    depth = -(away @ frame.back)
    top = np.tan(np.radians(frame.fov / 2))
    side = top * frame.size[0] / frame.size[1]
    beside = [(sign * (away @ frame.right) > depth * side).all(axis=1) for sign in (1, -1)]
    beside += [(sign * (away @ frame.up) > depth * top).all(axis=1) for sign in (1, -1)]
    assert (np.any(beside, axis=0) | (depth < 0).all(axis=1)).all()


def test_what_is_sent_and_its_order_do_not_depend_on_the_frame_before(sow) -> None:
    fresh, used = sow(**DENSE_MEADOW), sow(**DENSE_MEADOW)
    first = looking(replace(NORTH, x=20.04, yaw=2.0))
    used.choice(first)
    frame = looking(NORTH)
    chosen = used.choice(frame)
    assert chosen is used.choice(first), "the choice serves both"
    one, other = used.seen(frame, chosen), fresh.seen(frame, fresh.choice(frame))
    assert len(one.positions) > 1_000
    assert same(one, other)


def test_a_coarser_frame_has_all_near_blades_and_no_farther_ones_than_one_sees(sow) -> None:
    meadow = sow(fade=True, count=2_000_000, scale=(1.0, 1.0), radius=6.0)
    whole, walked = looking(NORTH, size=(640, 360)), looking(NORTH, size=(640, 360))
    coarser = replace(walked, detail=Detail(scale=0.5, coarser=2.0))
    assert meadow.reach(whole) == 6.0
    # A blade of 0.02 units is 4 pixels high there, each of which is two of the window.
    pixels = 180 / np.tan(np.radians(whole.fov / 2)) * 0.02 / meadow.reach(coarser)
    assert pixels == pytest.approx(8.0)
    near, all_of = meadow.select(coarser), meadow.select(whole)
    away = np.hypot(near.positions[:, 0] - 20, near.positions[:, 2] - 20)
    every = np.hypot(all_of.positions[:, 0] - 20, all_of.positions[:, 2] - 20)
    reach = meadow.reach(coarser)
    assert away.max() <= reach < every.max()
    assert (away < reach / 2).sum() == (every < reach / 2).sum()


def test_a_coarser_frame_chooses_the_mip_levels_of_a_whole_one_and_leaves_nothing(
    sow, stage: Stage
) -> None:
    meadow, settings = sow(**DENSE_MEADOW), grass_settings(**DENSE_MEADOW)
    biases: list[float] = []

    def noted(target: int, name: int, value: float) -> None:
        if target == gl.GL_TEXTURE_FILTER_CONTROL:
            biases.append(value)

    with stage.frame(settings, NORTH, kt=9.0) as frame:
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(gl, "glTexEnvf", noted)
            meadow.draw(frame)
            assert biases == []
            meadow.draw(replace(frame, detail=Detail(scale=0.5, coarser=2.0)))
        assert biases == [-1.0, 0.0]


def test_new_settings_or_a_new_window_size_cause_a_new_selection(sow) -> None:
    meadow = sow(fade=True, count=200_000)
    kept = meadow.choice(looking(NORTH))
    assert meadow.choice(looking(NORTH)) is kept
    wide = looking(NORTH, size=(320, 120))
    assert meadow.choice(wide) is not kept
    kept = meadow.choice(wide)
    assert taken(meadow, grass_settings(fade=True, count=200_000, facing=0.5))
    assert meadow.choice(wide) is not kept


def test_settings_read_each_frame_can_be_applied_and_built_in_ones_cannot(sow) -> None:
    meadow, frame = sow(facing=0.6), looking(NORTH)

    def drawn() -> np.ndarray:
        return meadow.bend(frame, meadow.seen(frame, meadow.choice(frame)))

    before = drawn()
    for key, value in (
        ("count", 50_001),
        ("scale", (2.0, 1.0)),
        ("tufts", 6),
        ("arch", 2.0),
        ("fade", True),
        ("variety", 0.5),
        ("tinted", True),
    ):
        assert not taken(meadow, grass_settings(**{key: value})), key
        assert (drawn() == before).all(), "refused settings change nothing"
    assert not taken(meadow, small({"grass.count": 50_000, "castle.x": 3.0}))
    assert taken(meadow, grass_settings(facing=0.6, radius=2.0))
    assert len(drawn()) < len(before)
    assert taken(meadow, grass_settings(facing=0.3)) and (drawn() != before).any()
    fading = sow(fade=True)
    assert not taken(fading, grass_settings(fade=True, radius=3.0))


def test_the_meadow_takes_the_colours_of_the_ground(stage: Stage, plain: Assets) -> None:
    settings = small({"grass.count": 400_000, "grass.tinted": True, "grass.scale": (3.0, 3.0)})
    ground = Ground(settings, plain, np.array([0.0, 1.0, 0.0], np.float32))
    ground.large = np.full((4, 4, 3), (60, 120, 40), np.uint8)
    meadow = Meadow(settings, plain, ground, 7)
    with stage.frame(settings, NORTH, kt=9.0) as frame:
        meadow.draw(frame)
        picture = stage.read()
    meadow.release()
    ground.release()
    blades = picture[(np.abs(picture - np.array([102, 153, 178])) > 20).any(axis=2)]
    assert len(blades) > 500
    red, green, blue = np.median(blades, axis=0)
    assert green / red == pytest.approx(2.0, abs=0.2) and green / blue == pytest.approx(3, abs=0.3)


def test_a_cell_without_a_suitable_place_has_no_tufts(monkeypatch: pytest.MonkeyPatch) -> None:
    grown = growth(sward=True, tufts=6, fade=True, tinted=True)
    monkeypatch.setattr(grown, "suits", lambda x, z: np.zeros(len(x)))
    tufts = grown.sown([3210], [200])
    assert len(tufts) == 0 and len(grown.blades(tufts).positions) == 0
