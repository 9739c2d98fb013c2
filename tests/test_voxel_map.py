"""The voxel island's map in a corner of the window, and its land as wires."""

from dataclasses import replace

import numpy as np
import pytest

from landscape.files.assets import Assets
from landscape.offscreen import Offscreen
from landscape.settings.declare import with_settings
from landscape.voxel import map
from landscape.voxel.blocks import block
from landscape.voxel.map import DEPTHS, GAP, PART, map_picture

SIZE = (400, 300)
SMALL = {"voxel.region_size": 20, "fog.enabled": False}
ABOVE = (5.2, 7.0, 4.6, 20.0, -85.0)
SIDE, EDGE = round(PART * SIZE[1]), round(GAP * SIZE[1])


def opened(only: tuple[str, ...] = ("map",), regions: int = 6) -> Offscreen:
    settings = SMALL | {"voxel.regions": regions, "shadow.enabled": False}
    return Offscreen(SIZE, samples=0, place="voxel", settings=settings, only=only)


@pytest.mark.seldom(3, first=1)
def test_each_column_has_its_top_blocks_colour_and_water_that_of_its_depth() -> None:
    with opened() as view:
        view.look(ABOVE)
        world = view.scene.land.world
        world.blocks[10:20, 30:40] = 0
        world.blocks[10:20, 30:40, : world.sea + 5] = block("red cloth")
        world.blocks[40:50, 30:40] = 0
        world.blocks[40:50, 30:40, 0] = block("sand")
        picture = map_picture(world, Assets()).astype(int)
    assert picture.shape == (world.side, world.side, 3)
    red, _, blue = picture[32:38, 12:18].reshape(-1, 3).T  # rows are z
    assert (red > 2 * blue).all()
    deep = np.clip(world.sea - 1, 0, 12)
    assert deep == 9 and (np.abs(picture[32:38, 42:48] - DEPTHS[-1]) < 20).all()


def test_of_a_large_world_the_map_has_every_second_column(monkeypatch: pytest.MonkeyPatch) -> None:
    with opened() as view:
        view.look(ABOVE)
        world = view.scene.land.world
        world.blocks[:] = 0
        world.blocks[:, :, : world.sea + 5] = block("sand")
        world.blocks[80:, :30, : world.sea + 5] = block("red cloth")
        whole = map_picture(world, Assets())
        monkeypatch.setattr(map, "MOST", world.side // 2)
        np.testing.assert_array_equal(map_picture(world, Assets()), whole[::2, ::2])


def corner(view: Offscreen) -> np.ndarray:
    """Return the part of a frame where the map is."""
    return view.draw()[EDGE : EDGE + SIDE, EDGE : EDGE + SIDE].astype(int)


@pytest.mark.seldom(3, first=1)
def test_an_arrow_is_where_the_walker_is_and_turns_with_the_view() -> None:
    with opened() as view:
        found = []
        for x, z, yaw in ((2.4, 2.4, 0.0), (7.2, 2.4, 0.0), (7.2, 7.2, 0.0), (7.2, 7.2, 90.0)):
            view.look((x, 5.0, z, yaw, 0.0))
            found.append((np.abs(corner(view) - (255, 242, 217)) < 3).all(axis=-1))
        places = [np.argwhere(each).mean(axis=0) / SIDE for each in found]
        wanted = [(0.25, 0.25), (0.25, 0.75), (0.75, 0.75)]
        assert np.allclose(places[:3], wanted, atol=0.05)
        assert (found[2] != found[3]).any()


@pytest.mark.seldom(3)
def test_beyond_the_border_the_arrow_waits_at_the_maps_edge() -> None:
    with opened() as view:
        view.look(ABOVE)
        size, y = view.scene.land.world.size, 20.0
        pictures = []
        for x in (size - 0.01, size + 0.5, size + 9.0):
            view.look((x, y, size / 2, 90.0, -85.0))
            pictures.append(corner(view))
        white = (pictures[0] > 200).all(axis=2)
        assert white.sum() > 4
        for picture in pictures[1:]:
            np.testing.assert_array_equal((picture > 200).all(axis=2), white)


def test_the_map_switches_off_and_has_changed_blocks_when_it_is_on_again() -> None:
    with opened() as view:
        view.look(ABOVE)
        scene, on = view.scene, corner(view)
        off = with_settings(scene.settings, {"overlay.map": False})
        x, z = 20, 20
        top = int(scene.land.world.ground[x, z])
        cells = {(x + i, z + k, top + 3): block("red cloth") for i in range(9) for k in range(9)}
        with view._current():
            scene.land.change(cells)
        for _ in range(3):
            assert (corner(view) == on).all()
        again = scene.settings
        assert scene.apply(off)
        assert (corner(view) != on).any()
        assert scene.apply(again)
        changed = (corner(view) != on).any(axis=-1)
        rows, columns = np.argwhere(changed).T / SIDE * scene.land.world.side
        assert changed.any() and rows.min() > 15 and columns.min() > 15
        assert rows.max() < 35 and columns.max() < 35


@pytest.mark.seldom(3, first=2)
def test_with_wireframe_the_sky_shows_through_the_land() -> None:
    with opened(("land", "sky"), regions=3) as view:
        view.look((0.6, 2.2, 4.2, 45.0, -20.0))
        filled = view.draw()
        view.moment = replace(view.moment, wireframe=True)
        wires = view.draw()
        assert 0.3 < (filled != wires).any(axis=-1).mean() < 1.0
        view.moment = replace(view.moment, wireframe=False)
        assert (view.draw() == filled).all()
