"""What makes the voxel island look like a place: paths, leaves, towers from afar, the horizon."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from stage import Stage

from framelens.gl.seam import recording
from landscape.elements.settings import Sun
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.offscreen import Offscreen
from landscape.scene.scene import Moment
from landscape.settings.declare import with_settings
from landscape.voxel.blocks import block
from landscape.voxel.build import look, meshed, slope_light
from landscape.voxel.heights import Heights
from landscape.voxel.landmarks import Site, lay_paths
from landscape.voxel.models import castle as castles
from landscape.voxel.models.castle_keep import HALL, KEEP
from landscape.voxel.models.paths import UNEVEN, WIDE, ways, worn
from landscape.voxel.sky import sky_colours
from landscape.voxel.voxel import SCENE, Voxel
from landscape.voxel.water import finer, glint_colour
from landscape.voxel.water_images import MIRRORED_BELOW
from landscape.voxel.world import World

SEA = 5


def test_a_way_goes_around_a_lake_and_not_over_a_steep_hill() -> None:
    x, z = np.ogrid[:120, :120]
    tops = np.full((120, 120), 10, np.int16)
    tops[40:60, 20:100] = 2  # a lake across the straight way
    tops += np.maximum(40 - 2 * np.hypot(x - 85, z - 60), 0).astype(np.int16)
    (way,) = ways(tops, SEA, (10, 60), [(110, 60)])
    assert way[0].tolist() == [10, 60] and way[-1].tolist() == [110, 60]
    assert np.hypot(*np.diff(way, axis=0).T).max() < 1.0
    along = tops[tuple(np.rint(way).astype(int).T)]
    assert (along >= SEA).mean() > 0.97 and along.max() < 25  # it may cut a corner


def test_ways_that_begin_alike_share_their_first_part() -> None:
    tops = np.full((120, 120), 10, np.int16)
    tops[30:, 40:80] = 60  # a ridge that both have to go around
    one, other = ways(tops, SEA, (100, 10), [(100, 110), (70, 110)])
    shared = sum(np.hypot(*(other - point).T).min() < 1.0 for point in one)
    assert shared > 100


def test_a_path_is_worn_a_few_blocks_wide_into_grass_alone() -> None:
    line = np.stack([np.arange(10.0, 90.0, 0.5), np.full(160, 50.0)], axis=1)
    on = worn(100, [line], np.random.default_rng(1))
    wide = on[20:80].sum(axis=1)
    assert wide.min() >= 1 and wide.max() <= 2 * (WIDE + 2 * UNEVEN) + 1
    blocks = np.zeros((100, 100, 20), np.uint8)
    blocks[..., :10] = block("grass")
    blocks[60:, :, 9] = block("rock")
    tops, kinds = np.full((100, 100), 10, np.int16), blocks[..., 9].copy()
    sites = [Site(30, 20, 5), Site(90, 70, 0)]
    left = lay_paths(blocks, tops, kinds, SEA, sites, np.random.default_rng(2))
    path = blocks[..., 9] == block("path")
    assert path[:60].sum() > 60 and not path[60:].any()
    assert not (left[path] == block("grass")).any()
    assert (left == block("path")).sum() > path.sum()  # nor beside it


def test_the_hall_adjoins_the_keep() -> None:
    model = castles.castle()
    x, z, wide, deep = HALL
    assert x + wide == KEEP[0]
    assert (model[x + wide - 1, z + 1 : z + deep - 1, castles.FLOOR : castles.FLOOR + 5] > 0).all()


def test_the_sea_has_an_edge_at_the_horizon() -> None:
    pictures = {
        name: np.full((8, 8, 3), 90.0) for name in ("west", "north", "east", "south", "top")
    }
    rise = np.array([0.5, 0.001, -0.001, -0.5])
    directions = np.stack([np.sqrt(1 - rise**2), rise, 0 * rise], axis=1)
    haze, sea = np.full(3, 200.0), np.array([20.0, 60.0, 90.0])
    up, above, below, down = sky_colours(pictures, directions, haze, sea)
    assert up == pytest.approx(90.0) and above == pytest.approx(200.0, abs=5.0)
    assert (below == sea).all() and (down == sea).all()


def test_the_map_of_ripples_gains_shorter_waves() -> None:
    x, y = np.meshgrid(*2 * [np.arange(64) * 2 * np.pi / 64])
    slope = 0.2 * np.stack([np.sin(5 * x), np.sin(4 * y)], axis=2)
    normal = np.concatenate([slope, np.ones((64, 64, 1))], axis=2)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    found = finer(np.rint((normal + 1) * 127.5).astype(np.uint8)) / 127.5 - 1
    assert found.shape == (128, 128, 3)
    assert np.linalg.norm(found, axis=2) == pytest.approx(1.0, abs=0.02)
    power = np.abs(np.fft.fft(found[..., 0] / found[..., 2], axis=1)).sum(axis=0)[:64]
    assert set(np.argsort(power)[-3:]) == {5, 8, 24}  # long ones, and turned ones, twice


def test_a_slope_that_faces_the_sun_is_lighter_and_one_turned_away_darker() -> None:
    east = Sun(azimuth=90.0, elevation=45.0)
    x = np.arange(30, dtype=np.float32)[:, None] + np.zeros(30, np.float32)
    level, facing, away = (
        slope_light(Heights(rise * x), east, 1.0)[5:25, 5:25] for rise in (0.0, -1.0, 1.0)
    )
    assert level == pytest.approx(1.0) and facing.min() > 1.05 and away.max() < 0.7
    # Turned away by 90 degrees it has the light of the sky alone.
    steep = slope_light(Heights(3.0 * x), east, 1.0)[5:25, 5:25]
    assert steep == pytest.approx(away, abs=1e-5)
    half = slope_light(Heights(x), east, 0.5)[5:25, 5:25]
    assert half == pytest.approx((1.0 + away) / 2, abs=1e-6)
    assert slope_light(Heights(x), east, 0.0) == pytest.approx(1.0)


def test_glints_have_the_colour_of_the_sun_as_bright_as_can_be() -> None:
    assert glint_colour((1.0, 0.72, 0.42)) == pytest.approx((1.0, 0.72, 0.42))
    assert glint_colour((0.5, 0.25, 0.0)) == pytest.approx((1.0, 0.5, 0.0))
    assert glint_colour((0.0, 0.0, 0.0)) == (0.0, 0.0, 0.0)


@pytest.mark.seldom(14, first=4)
@pytest.mark.parametrize("diffuse", [(1.0, 0.6, 0.2), (0.3, 0.5, 1.0)])
def test_the_water_glitters_in_the_colour_of_the_sun(diffuse: tuple[float, ...]) -> None:
    given = {"voxel.regions": 6, "voxel.region_size": 20, "shadow.enabled": False}
    given |= {"sun.azimuth": 315.0, "sun.elevation": 20.0, "fog.enabled": False}
    pictures = []
    for sparkle in (0.0, 4.0):
        settings = given | {"sun.diffuse": diffuse, "water.sparkle": sparkle}
        with Offscreen((160, 120), samples=0, place="voxel", settings=settings) as view:
            view.look((9.0, 1.4, 9.0, 315.0, -8.0))
            pictures.append(view.draw().astype(float))
    changed = np.abs(pictures[1] - pictures[0]).max(axis=-1) > 60
    assert changed.sum() > 10
    brightest = pictures[1][changed]
    brightest = brightest[brightest.sum(axis=1).argsort()[-5:]].mean(axis=0) / 255
    assert brightest == pytest.approx(glint_colour(diffuse), abs=0.2)


def towers() -> World:
    blocks = np.zeros((40, 40, 30), np.uint8)
    blocks[..., :8] = block("rock")
    blocks[5:8, 5:8, 8:19] = block("brick")
    blocks[25:28, 5:8, 8:19] = block("oak log")
    return World(blocks, np.full((40, 40), 8, np.int16), 20, SEA, 0.08)


def test_a_region_with_a_building_is_not_drawn_in_larger_blocks() -> None:
    settings = replace(SCENE.settings, voxel=replace(SCENE.settings.voxel, regions=2))
    place, colours = towers(), look(settings, Heights(np.full((40, 40), 8.0)), 1)
    found = [meshed(place, region, colours, settings.voxel) for region in (0, 2)]
    (_, (castle,), (from_afar,)), (_, (wood,), (larger,)) = found
    assert np.array_equal(castle.vertices, from_afar.vertices)
    even = [(np.rint(each.vertices["position"]) % 2 == 0).all() for each in (castle, wood, larger)]
    assert even == [False, False, True]


@pytest.fixture
def shore() -> Iterator[Offscreen]:
    settings = {"voxel.regions": 6, "voxel.region_size": 20, "shadow.enabled": False}
    with Offscreen((64, 48), samples=0, place="voxel", settings=settings) as view:
        view.look((0.4, 1.3, 0.4, 135.0, -25.0))
        yield view


@pytest.mark.seldom(3)
def test_what_is_mirrored_goes_on_a_little_below_the_water(shore: Offscreen) -> None:
    with shore._current(), recording() as recorder:
        shore.draw()
    planes = [call.args[1] for call in recorder.calls if call.name == "glClipPlane"]
    level, block_size = shore.scene.water.level, shore.scene.settings.voxel.block
    heights = [-float(plane[3]) for plane in planes if plane[1] > 0]
    assert heights == pytest.approx([level, level - MIRRORED_BELOW * block_size])


@pytest.mark.seldom(3)
def test_land_is_drawn_with_the_alpha_test_only_where_leaves_have_holes(shore: Offscreen) -> None:
    def tested() -> bool:
        with shore._current(), recording() as recorder:
            shore.draw()
        names = [call.name for call in recorder.calls]
        return "glAlphaFunc" in names[: names.index("glMultiDrawArrays")]

    assert tested()
    shore.scene.apply(
        replace(shore.scene.settings, voxel=replace(shore.scene.settings.voxel, holes=False))
    )
    assert not tested()


@pytest.mark.seldom(14, first=3)
def test_another_time_of_day_is_applied_to_the_open_island_and_looks_as_if_opened_in_it(
    stage: Stage,
) -> None:
    few = {"voxel.regions": 6, "voxel.region_size": 20, "shadow.size": 128}
    noon, sunset = (with_settings(SCENE.settings, {**few, "time": t}) for t in ("noon", "sunset"))
    shore = Moment(Pose(4.8, 1.3, 9.3, 0.0, -12.0), stage.size, 12.0, 3.0, 2)
    pictures = []
    with stage.borrowed():

        def drawn(island: Voxel) -> None:
            island.draw(shore)
            pictures.append(stage.read())

        island = Voxel(noon, Assets(), 0, SCENE.elements)
        drawn(island)
        for values in (sunset, noon):
            assert island.apply(values)
            drawn(island)
        island.release()
        island = Voxel(sunset, Assets(), 0, SCENE.elements)
        drawn(island)
        island.release()
    at_noon, applied, again, fresh = pictures
    assert (at_noon == again).all()
    # The light of slopes is multiplied into colours that are rounded, twice.
    assert (np.abs(applied - fresh).max(axis=-1) > 4).mean() < 0.02
    assert (np.abs(applied - at_noon).max(axis=-1) > 20).mean() > 0.3
