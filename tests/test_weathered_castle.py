"""The weathered castle: its stones, roofs and ivy, the hall behind its door, the torches' glow."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from castles import FLAT, GATE, PLACED, at, drawn
from stage import Stage, kind_in, pixel, project, small

from framelens.gl.seam import gl, recording
from framelens.gl.texture import Texture, mip_levels
from landscape.elements.best.castle import ornate_castle, weathering
from landscape.elements.best.castle.blocks import Blocks, add_frames, add_quoins, add_steps
from landscape.elements.best.castle.doorway import THICK, hall, passage, threshold
from landscape.elements.best.castle.footing import ground_marks, outside_of_walls, ring, rubble
from landscape.elements.best.castle.grain import grain
from landscape.elements.best.castle.growth import leaves
from landscape.elements.best.castle.loopholes import openings
from landscape.elements.best.castle.ornate_masonry import GATE as FREE
from landscape.elements.best.castle.ornate_masonry import KEEP, PLINTH, ornate_masonry
from landscape.elements.best.castle.slates import slate_roofs
from landscape.elements.best.castle.torch_glow import FINEST, disc, flicker, lit_patch, softer
from landscape.elements.best.castle.weathered_castle import (
    WeatheredCastle,
    opening_colours,
)
from landscape.elements.castle_fire import FLAME_Z, TORCHES
from landscape.elements.settings import Sun
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField
from landscape.geometry.masonry import CORNERS, TOWER_RADIUS, TOWER_TOP
from landscape.geometry.mesh import Mesh
from landscape.hall import plan
from landscape.island.slots import CASTLE

SUN = Sun(azimuth=0.0, elevation=40.0)  # from the north, where the gate looks with yaw 0


def level(places: np.ndarray) -> np.ndarray:
    """Return the height of a ground that rises to the east."""
    return 0.05 * places[:, 0]


def faces(mesh: Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return middles (m, 3), area vectors and the corners' mean normals of a mesh's triangles."""
    corners = mesh.vertices[mesh.triangles].astype(float)
    turn = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    return corners.mean(axis=1), turn, mesh.normals[mesh.triangles].mean(axis=1)


def of_blocks(*makers) -> Mesh:
    blocks = Blocks(1)
    for make in makers:
        make(blocks)
    return blocks.mesh(3.0)[0]


@pytest.mark.parametrize(
    "mesh",
    [of_blocks(add_frames, add_quoins), rubble(level)[0], slate_roofs(), passage(), threshold()],
    ids=["blocks", "rubble", "roofs", "passage", "threshold"],
)
def test_the_winding_of_every_face_agrees_with_its_normal(mesh: Mesh) -> None:
    _, turn, normal = faces(mesh)
    agrees = (turn * normal).sum(axis=1) > -1e-9
    assert agrees.mean() > 0.995 and mesh.triangles.max() < len(mesh.vertices)


def test_a_box_stands_on_its_foot_and_faces_its_direction() -> None:
    blocks = Blocks(1)
    blocks.add((2.0, 3.0, 4.0), np.pi / 2, (-1.0, 2.0), (0.0, 5.0), (0.0, 7.0), uneven=0.0)
    mesh, tints = blocks.mesh(1.0)
    assert np.allclose(mesh.vertices.min(axis=0), (1.0, 3.0, 4.0))
    assert np.allclose(mesh.vertices.max(axis=0), (4.0, 8.0, 11.0))
    middle, turn, _ = faces(mesh)
    assert ((turn * (middle - (2.5, 5.5, 7.5))).sum(axis=1) > 0).all()
    assert tints.shape == mesh.vertices.shape


def test_every_opening_has_a_frame_that_stands_out_and_leaves_it_free() -> None:
    mesh = of_blocks(add_frames)
    assert len(mesh.vertices) < 6000, "frames are few enough to be drawn each frame"
    for opening in openings():
        middle = np.array([opening.x, opening.y + opening.tall / 2, opening.z])
        out = np.array([np.cos(opening.facing), 0.0, np.sin(opening.facing)])
        offset = mesh.vertices - middle
        offset = offset[np.linalg.norm(offset, axis=1) < 0.09]
        assert (offset @ out).max() > 0.006
        if opening.half < 0.012:  # windows have a cross within
            across = np.abs(offset @ np.array([-out[2], 0.0, out[0]]))
            level_with = (np.abs(offset[:, 1]) < opening.tall / 3) & (offset @ out > -0.02)
            assert across[level_with].min() > opening.half - 0.002


def test_the_steps_are_low_and_lie_before_the_gate() -> None:
    blocks = Blocks(1)
    add_steps(blocks, 0.02)
    vertices = blocks.mesh(3.0)[0].vertices
    assert vertices[:, 1].max() < 0.02 + 0.02, "lower than a walker's eye by far"
    before = vertices[vertices[:, 2] < 0]
    assert before[:, 2].min() > -0.16
    assert np.abs(before[:, 0] - sum(FREE) / 2).max() < 0.17


def test_rubble_lies_on_the_ground_outside_the_walls_and_not_before_the_door() -> None:
    rng = np.random.default_rng(3)
    places = outside_of_walls(300, 0.2, rng)
    beside = np.abs(places - 0.5).max(axis=1) > 0.5 + PLINTH[2] / 2
    near = np.array([np.hypot(*(places - corner).T) for corner in CORNERS]).min(axis=0)
    assert (beside | (near > TOWER_RADIUS)).all() and (near > TOWER_RADIUS).all()
    gate = (places[:, 0] > FREE[0]) & (places[:, 0] < FREE[1]) & (places[:, 1] < 0.0)
    assert not gate.any()
    mesh, tints = rubble(level)
    above = mesh.vertices[:, 1] - level(mesh.vertices[:, [0, 2]])
    assert above.min() < 0 < above.max() < 0.05 and (tints > 0).all()


def test_the_dirt_goes_once_around_the_castle_and_fades_out() -> None:
    line = ring(0.05)
    assert np.allclose(line[0], line[-1])
    outer = ring(0.10)
    assert (np.abs(outer - 0.5).max(axis=1) > np.abs(line - 0.5).max(axis=1) - 1e-6).all()
    x, z = (line - 0.5).T
    turned = np.unwrap(np.arctan2(z, x))
    assert abs(turned[-1] - turned[0]) == pytest.approx(2 * np.pi, abs=1e-6)
    vertices, colours, triangles = ground_marks(level)
    assert np.allclose(vertices[:, 1] - level(vertices[:, [0, 2]]), 0.0025, atol=1e-6)
    assert colours.min() >= 0 and colours.max() <= 1 and triangles.max() < len(vertices)
    far = (vertices[:, 2] < -0.9) | (np.abs(vertices[:, 0] - 0.5) > 0.72)
    assert colours[far, 3].max() < 0.5


def test_slates_cover_keep_and_rear_towers_and_have_about_one_size() -> None:
    mesh = slate_roofs()
    _, turn, _ = faces(mesh)
    assert mesh.vertices[:, 1].max() == pytest.approx(KEEP[4] + 0.34, abs=0.03)
    out = mesh.vertices[mesh.vertices[:, 1] < TOWER_TOP + 0.2]
    assert (out[:, 2] > 0.7).all(), "the front towers have battlements"
    (uv,) = mesh.coordinates
    corners = uv[mesh.triangles].astype(float)
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    texels = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    area = np.linalg.norm(turn, axis=1)
    large = (area > 2e-4) & (texels > 1e-4)
    density = np.sqrt(texels[large] / area[large])
    assert np.quantile(density, 0.9) < 2.2 * np.quantile(density, 0.1)


def test_ivy_grows_from_the_ground_along_a_tower_and_not_inside_the_walls() -> None:
    mesh, tints = leaves(level)
    quads = mesh.vertices.reshape(-1, 4, 3).mean(axis=1)
    assert len(tints) == len(mesh.vertices)
    inside = (np.abs(quads[:, [0, 2]] - 0.5) < 0.5 - 0.02).all(axis=1)
    assert not inside.any()
    low, high = quads[:, 1].min(), quads[:, 1].max()
    assert low < 0.06 and 0.4 < high < 1.1
    (uv,) = mesh.coordinates
    assert uv.min() >= 0 and uv.max() <= 1
    cells = np.floor(uv.reshape(-1, 4, 2) * 2 - 1e-9)
    assert (cells == cells[:, :1]).all(), "a quad shows one of the sheet's four pictures"


# The light map.


def test_the_finer_light_map_has_the_coarse_one_s_light_at_every_second_texel() -> None:
    coarse = np.random.default_rng(2).random((3, 4, 3))
    fine = weathering.between(coarse)
    assert fine.shape == (5, 7, 3) and np.allclose(fine[::2, ::2], coarse)
    assert np.allclose(fine[0, 1], (coarse[0, 0] + coarse[0, 1]) / 2)
    assert np.allclose(fine[1, 1], coarse[:2, :2].mean(axis=(0, 1)))


@pytest.mark.seldom(14)
def test_every_vertex_finds_its_own_weathered_light() -> None:
    mesh, strips = ornate_masonry(3.0)
    picture, coordinates = weathering.worn_light_map(mesh, strips, Sun(), -160.0, 0.0)
    some = np.concatenate([strip.ravel() for strip in strips[:40]])
    column, row = np.round(coordinates[some] * weathering.SIDE - 0.5).astype(int).T
    places, normals = mesh.vertices[some].astype(float), mesh.normals[some].astype(float)
    own = weathering.worn_light(places, normals, Sun(), -160.0, 0.0)
    assert np.abs(picture[row, column] / 127.5 - np.clip(own, 0.0, 2.0)).max() < 0.03


def test_dirt_runs_down_below_a_loophole_and_moss_is_green_at_the_foot() -> None:
    holes = [o for o in openings() if o.z < 0]
    ends = [(o.x + side * o.half, o.y, 0.0) for o in holes for side in (-1, 1)]
    north = np.tile([0.0, 0.0, -1.0], (len(ends), 1))
    below, above = (weathering.streaks(np.array(ends) + (0, dy, 0), north) for dy in (-0.02, 0.12))
    assert below.mean() < above.mean() - 0.05
    foot = np.array([(s, 0.01, 0.0) for s in np.linspace(0.2, 0.8, 30)])
    facing = np.tile([0.0, 0.0, -1.0], (30, 1))
    low = weathering.stains(foot, facing).mean(axis=0)
    high = weathering.stains(foot + (0.0, 0.6, 0.0), facing).mean(axis=0)
    assert low.mean() < 0.9 * high.mean() and low[1] / low[2] > high[1] / high[2] + 0.05


def test_the_sunny_side_is_warmer_than_the_shaded_side() -> None:
    places = np.array([(0.5, 0.5, 0.0), (0.5, 0.5, 1.0)])
    normals = np.array([(0.0, 0.0, -1.0), (0.0, 0.0, 1.0)])
    sunny, shaded = weathering.worn_light(places, normals, SUN, 0.0, 0.0)
    assert sunny[0] / sunny[2] > shaded[0] / shaded[2] + 0.05


# The hall behind the door, and the glow.


def test_what_is_seen_through_the_door_is_the_hall_that_one_enters(shipped: Assets) -> None:
    mesh = hall(shipped)
    inside = plan.INSIDE
    places = np.array([plan.AXIS + 0.5, 0.0, plan.INSIDE.south + THICK]) - mesh.vertices * (
        1,
        -1,
        1,
    )
    low, high = places.min(axis=0), places.max(axis=0)
    reach = plan.WALL + plan.ALCOVE_DEPTH + 1e-3
    assert low[0] > inside.west - reach and high[0] < inside.east + reach
    assert low[2] > inside.north - reach and high[2] <= inside.south + plan.WALL
    assert 0.0 > low[1] > plan.POOL_BED - 0.01 and plan.CROWN - 0.02 < high[1] < plan.CROWN + 0.05
    # A point of the statue, of the pool and of a pillar of each row are among its vertices.
    x, z = plan.STATUE
    for place, radius in (((x, 0.2, z), 0.1), ((plan.POOL.west, 0.0, plan.POOL.north), 0.05)):
        assert np.linalg.norm(places - place, axis=1).min() < radius
    for row in plan.ROWS:
        beside = np.hypot(places[:, 0] - row, places[:, 2] - plan.BAYS[5])
        assert (beside[np.abs(places[:, 1] - 0.2) < 0.15] < 3 * plan.PILLAR).any()


def test_of_the_hall_only_what_faces_the_opening_is_kept(shipped: Assets) -> None:
    mesh = hall(shipped)
    middle, turn, _ = faces(mesh)
    opening = np.array([(x, y, 0.0) for x in (0.425, 0.5, 0.575) for y in (0.01, 0.11, 0.21)])
    towards = opening[:, None] - middle
    assert ((towards * turn).sum(axis=2) > 0).any(axis=0).mean() > 0.999
    assert len(mesh.triangles) < 12_000, "few enough to be drawn each frame"
    (coordinates,) = mesh.coordinates
    assert coordinates.min() >= 0.0 and coordinates.max() <= 1.0


@pytest.fixture
def hall_from_afar(monkeypatch: pytest.MonkeyPatch) -> None:
    """Show the hall in pictures as small as those of the tests, too."""
    monkeypatch.setattr(ornate_castle, "HALL_PIXELS", 0.0)


@pytest.mark.seldom(10, first=5)
@pytest.mark.usefixtures("hall_from_afar")
def test_through_the_door_one_sees_deeper_parts_move_less(stage: Stage, shipped: Assets) -> None:
    """Of the rose window, which is white and far away, as the eye goes aside."""
    keys = {"castle__ornate": True, "castle__open": True, "castle__depth": True}
    column = []
    for dx in (0.0, 0.06):
        pose = replace(GATE, x=20.0 + dx)
        picture = drawn(stage, shipped, pose, **keys).astype(int).min(axis=2)
        left, top = (int(v) for v in project(pose, at(0.5 + 0.07, 0.21)))
        right, low = (int(v) for v in project(pose, at(0.5 - 0.07, 0.09)))
        opening = picture[min(top, low) : max(top, low), min(left, right) : max(left, right)]
        bright = np.argwhere(opening > 0.9 * opening.max())
        column.append(bright[:, 1].mean() / opening.shape[1])
    assert column[0] == pytest.approx(0.5, abs=0.12)
    assert abs(column[1] - column[0]) > 0.1, "the window at the end is seen elsewhere"


@pytest.mark.seldom(7)
@pytest.mark.usefixtures("hall_from_afar")
def test_depth_and_stencil_are_as_if_the_door_were_a_wall(stage: Stage, plain: Assets) -> None:
    found = []
    for deep in (False, True):
        settings = small(
            {**PLACED, "castle.ornate": True, "castle.open": True, "castle.depth": deep}
        )
        castle = kind_in(CASTLE, settings)(settings, plain, FLAT)
        with stage.frame(settings, GATE) as frame:
            castle.draw(frame)
            width, height = frame.size
            depth = gl.glReadPixels(0, 0, width, height, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
            marks = gl.glReadPixels(0, 0, width, height, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
        castle.release()
        assert not np.frombuffer(bytes(marks), np.uint8).any()
        found.append(np.array(depth))
    assert np.abs(found[0] - found[1]).max() < 1e-4


def test_flames_flicker_about_one_and_each_in_its_own_time() -> None:
    times = np.arange(0.0, 400.0)
    one, other = (np.array([flicker(float(kt), torch) for kt in times]) for torch in (0, 1))
    assert one.mean() == pytest.approx(1.0, abs=0.02) and 0.7 < one.min() < one.max() < 1.3
    assert abs(np.corrcoef(one, other)[0, 1]) < 0.8


def test_the_disc_is_dark_at_its_edge_and_the_patch_where_it_ends() -> None:
    picture = disc()[..., 0]
    assert picture[0].max() == picture[:, -1].max() == 0 and picture[31:33, 31:33].min() > 200
    for x in TORCHES:
        vertices, strength, _ = lit_patch(level, x)
        away = np.hypot(vertices[:, 0] - x, vertices[:, 2] - FLAME_Z)
        assert strength[away > 0.5].max(initial=0.0) < 0.12 < strength.max()
        assert np.allclose(vertices[:, 1] - level(vertices[:, [0, 2]]), 0.004, atol=1e-6)
        assert (vertices[:, 2] < 0.01).all()


@pytest.mark.seldom(13, first=7)
def test_the_glow_brightens_what_is_round_a_flame(stage: Stage, plain: Assets) -> None:
    keys = {"castle__ornate": True, "castle__torches": 1.0}
    dull, bright = (drawn(stage, plain, castle__glow=glow, **keys) for glow in (0.01, 0.8))
    beside = project(GATE, at(TORCHES[0] + 0.08, 0.30, FLAME_Z))
    assert pixel(bright, beside)[0] > pixel(dull, beside)[0] + 8


def test_a_flame_is_blurred_up_close_and_its_texture_is_then_as_before(stage: Stage) -> None:
    fine = np.zeros((64, 64, 4), np.uint8)
    fine[::2] = 255  # rows, which the third mip level has averaged away
    sheet = Texture(fine)
    gl.glBindTexture(gl.GL_TEXTURE_2D, sheet.name)

    def finest() -> float:
        return float(gl.glGetTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_LOD))

    assert finest() == FINEST
    with softer(2.0):
        assert finest() == 2.0
    assert finest() == FINEST
    gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
    sheet.release()


def test_the_weeds_at_the_walls_have_shaded_roots(shipped: Assets) -> None:
    picture = read_image(shipped.path("castle_leaves.png")).astype(float)
    for tuft in (picture[128:, :128], picture[128:, 128:]):
        light, solid = tuft[..., :3].mean(axis=2), tuft[..., 3] > 127
        roots, middle = (light[rows][solid[rows]].mean() for rows in (np.s_[112:126], np.s_[50:70]))
        assert roots < 0.8 * middle


def test_the_grain_is_mid_grey_on_average_at_every_mip_level_and_repeats() -> None:
    tile = grain()
    levels = mip_levels(tile)
    assert all(abs(float(level.mean()) - 127.5) < 4 for level in levels)
    assert levels[4].std() < 0.4 * tile.std(), "it fades out with the distance"
    image = tile[..., 0].astype(float)
    seam = np.abs(image[0] - image[-1]).mean()
    assert seam < 1.3 * np.abs(np.diff(image, axis=0)).mean()


@pytest.mark.seldom(14)
def test_the_grain_changes_the_walls_close_by_and_not_their_mean(
    stage: Stage, plain: Assets
) -> None:
    settings = small({**PLACED, "castle.ornate": True, "castle.weathered": True})
    castle = WeatheredCastle(settings, plain, FLAT)
    pose = Pose(19.85, 2.55, 19.5 - 0.25, 180.0, 0.0)
    found = []
    with stage.frame(settings, pose) as frame:
        castle.draw(frame)
        found.append(stage.read().astype(float))
    with stage.frame(settings, pose) as frame:
        castle._grain_list = castle._marks_list
        castle.draw(frame)
        found.append(stage.read().astype(float))
    castle.release()
    grained, plain_wall = (picture[40:80, 60:100] for picture in found)
    assert np.abs(grained - plain_wall).max() >= 3
    assert grained.mean() == pytest.approx(plain_wall.mean(), rel=0.05)


# The castle itself.


@pytest.mark.seldom(10, first=5)
def test_details_are_left_out_from_afar_and_in_the_mirror(stage: Stage, plain: Assets) -> None:
    settings = small({**PLACED, "castle.ornate": True, "castle.weathered": True})
    castle = WeatheredCastle(settings, plain, FLAT)
    counts = []
    for away, mirrored in ((0.8, False), (1.6, False), (7.0, False), (20.0, False), (0.8, True)):
        pose = Pose(20.0, 2.4, 19.5 - away, 180.0, 0.0)
        with stage.frame(settings, pose) as frame, recording() as recorder:
            castle.draw(replace(frame, mirrored=mirrored))
        counts.append(sum(call.name == "glCallList" for call in recorder.calls))
    castle.release()
    close, near, middle, far, in_mirror = counts
    assert close == near + 2 == middle + 3 == far + 5 and in_mirror == far


def test_a_few_windows_are_lit_brighter_at_dusk_and_no_loophole() -> None:
    day, dusk = (opening_colours(torches).reshape(-1, 4, 3) for torches in (0.0, 1.0))
    lit = (day != dusk).any(axis=(1, 2))
    assert 3 < lit.sum() < len(lit) / 4
    assert (dusk[lit].mean(axis=(1, 2)) > day[lit].mean(axis=(1, 2)) + 0.2).all()
    assert all(opening.half > 0.012 for opening, on in zip(openings(), lit, strict=True) if on)
    assert day[~lit].max() < 0.1


@pytest.mark.seldom(3, first=2)
def test_what_lies_on_the_ground_is_the_same_from_the_cache(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path))
    castle = object.__new__(WeatheredCastle)
    castle.base, castle._yaw = (20.0, 1.0, 20.0), 30.0
    castle._field = HeightField(np.linspace(0, 2, 64).reshape(8, 8), 48.0, 0.5)
    for name, make in (("rubble", rubble), ("leaves", leaves)):
        wanted, tints = make(castle._ground_at)
        for _ in range(2):
            mesh, kept = castle._kept(name, make)
            np.testing.assert_array_equal(kept, tints)
            np.testing.assert_array_equal(mesh.vertices, wanted.vertices)
            np.testing.assert_array_equal(mesh.triangles, wanted.triangles)
            assert len(mesh.coordinates) == len(wanted.coordinates)
            np.testing.assert_array_equal(mesh.coordinates[0], wanted.coordinates[0])
        castle._yaw += 1.0  # on other ground it is another mesh
        assert not np.array_equal(castle._kept(name, make)[0].vertices, mesh.vertices)
