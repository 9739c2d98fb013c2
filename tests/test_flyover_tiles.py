"""The fly-over's tiles: the quad-tree, levels of detail, back faces, and each edge once."""

import math
from collections import defaultdict
from dataclasses import replace

import numpy as np
import pytest

from framelens.base.errors import InputError
from landscape.flyover import clipping, culling, detail, edges, frame, quad_tree
from landscape.flyover.bounds import bounds
from landscape.flyover.camera import Camera, Frustum, frustum
from landscape.flyover.height_field import HeightField, height_field
from landscape.flyover.levels import levels
from landscape.flyover.quad_tree import Tiles, View
from landscape.flyover.settings import Flyover, Settings, check

SIZE = (160, 120)
NEAR = Flyover(far=600.0, density=24.0, patch="4")


def rough(side: int = 64, relief: float = 30.0) -> HeightField:
    """Return terrain without any smoothness."""
    image = np.random.default_rng(8).integers(0, 256, (side, side))
    return height_field(image, Flyover(relief=relief))


def view_of(field: HeightField, camera: Camera, settings: Flyover) -> View:
    volume = frustum(settings, SIZE)
    around = levels(field, camera, volume, settings)
    return View(field, bounds(field, around.patch), camera, volume, SIZE, settings, around)


def flight(count: int) -> list[Camera]:
    """Return cameras along a curve over two mirror images, rising and sinking."""
    along = np.linspace(0, 1, count).tolist()
    return [
        Camera(
            -70 + 190 * t, 90 * math.sin(5 * t), 34 + 60 * t * math.sin(9 * t), 0.1 * t, 0.3, 6 * t
        )
        for t in along
    ]


def random_cameras(count: int) -> list[Camera]:
    random = np.random.default_rng(4)
    return [
        Camera(*random.uniform(-150, 150, 2), *random.uniform((5, -0.5, -1, -4), (90, 0.5, 1.5, 4)))
        for _ in range(count)
    ]


def borders(field: HeightField, camera: Camera, settings: Flyover) -> tuple[int, list[int]]:
    """Return at how many points two tiles meet, and where their borders differ.

    All tiles around the camera are looked at. Each line between tiles has the points of the borders
    on its one side and those on its other; they must be the same to the last bit.
    """
    view = view_of(field, camera, replace(settings, bounding_volumes=False))
    tiles, _tested = quad_tree.select(view)
    points = np.stack(detail.vertices(field, tiles, camera, view.levels)[0], axis=-1)
    side = view.levels.patch << tiles.level
    met, differing = 0, []
    for start, grid in ((tiles.column, points), (tiles.row, points.transpose(0, 2, 1, 3))):
        before: dict[int, set[bytes]] = defaultdict(set)
        after: dict[int, set[bytes]] = defaultdict(set)
        for at, length, first, last in zip(
            (start * side).tolist(), side.tolist(), grid[:, :, 0], grid[:, :, -1], strict=True
        ):
            after[at] |= {each.tobytes() for each in first}
            before[at + length] |= {each.tobytes() for each in last}
        for at in sorted(before.keys() & after.keys()):
            met += len(before[at])
            differing += [at] * (before[at] != after[at])

    return met, differing


@pytest.mark.seldom(3, first=2)
def test_no_crack_opens_between_tiles_for_a_whole_flight() -> None:
    field = rough()
    met = 0
    for camera in flight(24):
        count, differing = borders(field, camera, NEAR)
        assert differing == [], camera
        met += count
    assert met > 100_000


def test_without_morphing_there_are_cracks() -> None:
    assert borders(rough(), flight(3)[1], replace(NEAR, morph=False))[1] != []


@pytest.mark.parametrize("patch", ("4", "8", "16"))
def test_no_crack_opens_at_the_least_density_either(patch: str) -> None:
    settings = replace(NEAR, patch=patch, density=3.0 * int(patch), morph_part=0.5)
    for camera in flight(4):
        assert borders(rough(), camera, settings)[1] == []


def camera_at(x: float) -> Camera:
    return Camera(x, 7.3, 50.0, 0, 0.4, 0.3)


def tile_set(field: HeightField, camera: Camera) -> set[tuple[int, int, int]]:
    tiles, _tested = quad_tree.select(view_of(field, camera, NEAR))
    return set(zip(tiles.level.tolist(), tiles.column.tolist(), tiles.row.tolist(), strict=True))


@pytest.mark.seldom(13, first=12)
def test_no_pixel_changes_at_the_moment_when_a_tile_changes_its_level() -> None:
    field = rough()
    changes = []
    for step in range(26):
        low, high = 0.1 * step, 0.1 * step + 0.1
        if tile_set(field, camera_at(low)) == tile_set(field, camera_at(high)):
            continue
        before = tile_set(field, camera_at(low))
        while high - low > 1e-9:
            middle = (low + high) / 2
            if tile_set(field, camera_at(middle)) == before:
                low = middle
            else:
                high = middle
        if {level for level, _c, _r in before ^ tile_set(field, camera_at(high))} == {0}:
            continue  # a tile came onto the screen
        changes.append(
            [
                int(
                    (
                        pictures(field, camera_at(low), morph=morph)[0]
                        != pictures(field, camera_at(high), morph=morph)[0]
                    ).sum()
                )
                for morph in (True, False)
            ]
        )

    gliding, popping = np.sum(changes, axis=0).tolist()
    assert len(changes) > 4 and gliding < 0.02 * popping


def test_the_quad_tree_drops_no_tile_with_an_edge_on_the_screen() -> None:
    field = rough()
    for camera in random_cameras(30):
        chosen = {}
        for name in ("bounding_volumes", "quad_tree", ""):
            settings = replace(NEAR, **({name: False} if name else {}))
            tiles, tested = quad_tree.select(view_of(field, camera, settings))
            chosen[name] = (
                tested,
                set(
                    zip(
                        tiles.level.tolist(), tiles.column.tolist(), tiles.row.tolist(), strict=True
                    )
                ),
            )
        assert chosen[""][1] == chosen["quad_tree"][1] < chosen["bounding_volumes"][1]
        assert chosen["bounding_volumes"][0] == 0 < chosen[""][0] < chosen["quad_tree"][0]


def pictures(field: HeightField, camera: Camera, **changes: object) -> tuple[np.ndarray, dict]:
    settings = Settings(flyover=replace(NEAR, **changes))  # type: ignore[arg-type]
    drawn = frame.draw(field, camera, settings, SIZE)
    return (drawn.picture == 0).all(axis=2), drawn.counts


@pytest.mark.seldom(13, first=10)
def test_volumes_tree_and_strips_save_work_and_change_no_pixel() -> None:
    field = rough()
    for camera in random_cameras(12):
        fast, counts = pictures(field, camera, fade=False)
        for name, saved in (
            ("bounding_volumes", "considered"),
            ("quad_tree", "boxes"),
            ("strips", "considered"),
        ):
            slow, more = pictures(field, camera, fade=False, **{name: False})
            assert np.array_equal(slow, fast), (name, camera)
            assert more[saved] > counts[saved]
        front, counts = pictures(field, camera, fade=False, hidden_lines=False)
        seen_through, more = pictures(
            field, camera, fade=False, hidden_lines=False, back_faces=False
        )
        assert (seen_through >= front).all() and more["lines"] >= counts["lines"]


def test_detail_changes_nothing_where_its_finest_level_reaches_to_the_far_plane() -> None:
    field = rough()
    for camera in random_cameras(6):
        fine, _counts = pictures(field, camera, far=60.0, density=300.0)
        whole, _counts = pictures(field, camera, far=60.0, detail=False)
        assert np.array_equal(fine, whole)


def test_fewer_lines_are_drawn_with_detail_and_more_with_a_higher_density() -> None:
    lines = [
        pictures(rough(), Camera(3, 5, 60, 0, 0.3, 1), far=250.0, back_faces=False, **changes)[1]
        for changes in ({"detail": False}, {"density": 80.0}, {"density": 40.0}, {"density": 20.0})
    ]
    assert lines == sorted(lines, key=lambda counts: -counts["lines"])
    assert lines[0]["lines"] > 4 * lines[2]["lines"]


def test_the_terrain_repeats_every_two_images_without_a_seam() -> None:
    field = rough()
    for camera in random_cameras(4):
        here, _counts = pictures(field, camera)
        moved = replace(camera, x=camera.x + 2 * field.size, y=camera.y - 4 * field.size)
        there, _counts = pictures(field, moved)
        # Positions are rounded otherwise there, which may move an end by a pixel.
        assert (here != there).mean() < 1e-3


def test_without_mirror_images_the_terrain_ends_at_the_image_s_border() -> None:
    field = rough(16)
    for settings in (NEAR, replace(NEAR, detail=False)):
        view = view_of(field, Camera(8, 8, 100, 0, 1.5), replace(settings, mirror=False))
        tiles, _tested = quad_tree.select(view)
        x, y, _z = detail.vertices(field, tiles, view.camera, view.levels, mirror=False)[0]
        assert (x.min(), x.max(), y.min(), y.max()) == (-8, 8, -8, 8)


def test_a_triangle_faces_the_camera_if_the_camera_is_above_its_plane() -> None:
    random = np.random.default_rng(6)
    points = random.uniform(-9, 9, (3, 40, 3, 3))
    points[0] += np.arange(3) * 30
    points[1] += np.arange(3)[:, None] * 30
    points[:2] -= 30
    first, second = culling.facing(tuple(points), np.full(40, 900.0))
    for n, row, column in np.ndindex(first.shape):
        corner, right, below, across = (
            points[:, n, row + i, column + j] for i, j in ((0, 0), (0, 1), (1, 0), (1, 1))
        )
        for found, (a, b, c) in (
            (first, (corner, right, across)),
            (second, (corner, across, below)),
        ):
            normal = np.cross(b - a, c - a)
            up = normal * np.sign(normal[2])
            assert found[n, row, column] == (np.dot(-a, up) > 0)


def test_strips_have_each_edge_of_the_triangles_once() -> None:
    random = np.random.default_rng(2)
    code = np.zeros((5, 6, 6), np.uint8)
    facing = random.random((2, 5, 5, 5)) < 0.4
    found = edges.of_strips(code, (facing[0], facing[1]))
    strips = list(zip(found.a.tolist(), found.b.tolist(), strict=True))
    assert len(set(strips)) == len(strips) and found.on_screen == 5 * 3 * 4 * 4
    found = edges.of_triangles(code, (facing[0], facing[1]))
    assert found.on_screen == 5 * 6 * 5 * 5
    pairs = zip(found.a.tolist(), found.b.tolist(), strict=True)
    triangles = {(min(pair), max(pair)) for pair in pairs}
    # Without the first row and column, which are not the tile's own, and without the last edges.
    own = {(a, b) for a, b in triangles if 1 <= a % 6 < 5 and 1 <= a // 6 % 6 < 5}
    assert set(strips) == own


def test_edges_that_the_next_level_does_not_have_vanish_on_the_way_to_it() -> None:
    code = np.zeros((1, 5, 5), np.uint8)
    whole = edges.of_strips(code, None, np.zeros((1, 5, 5)))
    assert whole.fading is not None and len(whole.a) == 48 and not whole.fading.any()
    half = edges.of_strips(code, None, np.full((1, 5, 5), 0.5))
    assert half.fading is not None and np.unique(half.fading).tolist() == [-0.5, 0.0, 0.5]
    # An end that stays is on a row or a column that the next level has.
    stays = np.where(half.fading < 0, half.b, half.a)[half.fading != 0]
    assert ((stays // 5 % 2 == 0) | (stays % 5 % 2 == 0)).all()
    gone = edges.of_strips(code, None, np.ones((1, 5, 5)))
    glided = [
        tuple((each // 5 // 2 * 2, each % 5 // 2 * 2) for each in pair)
        for pair in zip(gone.a.tolist(), gone.b.tolist(), strict=True)
    ]
    left = [(a, b) for a, b in glided if a != b]
    assert len(left) == len(set(left)) == 12  # three for each of the next level's four quads


def test_outlines_do_not_vanish() -> None:
    code, part = np.zeros((1, 6, 6), np.uint8), np.ones((1, 6, 6))
    first, second = np.zeros((2, 1, 5, 5), bool)
    first[0, 2, 1] = True  # the triangle on the far side of the tile's second row
    found = edges.of_strips(code, (first, second), part)
    assert (2 * 6 + 1, 2 * 6 + 2) in zip(found.a.tolist(), found.b.tolist(), strict=True)


def test_lines_that_fade_are_shorter_at_the_end_that_goes() -> None:
    points = (np.full(2, 2.0), np.array([0.0, 1.0]), np.zeros(2))
    a, b = np.array([0, 0, 0]), np.array([1, 1, 1])
    lines = clipping.projected(
        points, edges.Edges(a, b, np.array([0.0, 0.25, -0.25]), 3), Frustum(), (400, 400)
    )
    assert lines.x0.tolist() == [200, 200, 238]
    assert lines.x1.tolist() == [350, 312, 350]


def test_boxes_hold_all_vertices_of_their_tiles_and_of_their_children() -> None:
    field = rough()
    for camera in flight(5):
        view = view_of(field, camera, replace(NEAR, bounding_volumes=False))
        tiles, _tested = quad_tree.select(view)
        z = detail.vertices(field, tiles, camera, view.levels)[0][2] + camera.z
        while len(tiles):
            low, high = view.bounds.at(tiles.level, tiles.row, tiles.column).T
            assert (z.min(axis=(1, 2)) >= low - 1e-4).all()
            assert (z.max(axis=(1, 2)) <= high + 1e-4).all()
            below = tiles.level < view.levels.coarsest
            z = z[below]
            tiles = Tiles(tiles.level[below] + 1, tiles.column[below] // 2, tiles.row[below] // 2)


@pytest.mark.parametrize("side", (2, 4, 1024))
def test_images_from_the_smallest_on_are_drawn(side: int) -> None:
    field = height_field(np.zeros((side, side), np.uint8))
    for mirror in (True, False):
        drawn, counts = pictures(field, Camera(1, 1, 70, 0, 1.4), mirror=mirror)
        assert drawn.any() and counts["lines"] > 0


def test_a_larger_image_takes_no_more_work() -> None:
    camera = Camera(40, 30, 45, 0, 0.2, 0.4)
    counts = [
        pictures(height_field(np.tile(hill, (n, n))), camera, far=4096.0)[1]
        for n in (1, 8)
        for hill in [np.random.default_rng(3).integers(0, 256, (64, 64))]
    ]
    assert counts[1]["vertices"] < 1.3 * counts[0]["vertices"]


def test_densities_too_low_for_the_tiles_are_refused() -> None:
    with pytest.raises(InputError) as caught:
        check(Settings(flyover=Flyover(patch="16")))
    assert str(caught.value) == (
        "setting flyover.density: expected at least 48, three times flyover.patch, not 40"
    )


def test_more_terrain_than_can_be_drawn_without_detail_is_refused() -> None:
    settings = Settings(flyover=Flyover(detail=False, far_undetailed=2000.0, unit=0.01))
    with pytest.raises(InputError, match=r"^setting flyover.far_undetailed: expected at most 7 "):
        frame.draw(
            height_field(np.zeros((2, 2)), settings.flyover), Camera(0, 0, 9), settings, SIZE
        )
