"""The ornate castle: its meshes face outwards, light and shadow lie right, its pennants wave."""

from dataclasses import replace

import numpy as np
import pytest
from castles import FLAT, PLACED, at, drawn
from stage import Stage, pixel, project, small, write_plain

from framelens.gl.seam import gl, recording
from landscape.elements.best.castle.baked_light import (
    SIDE,
    in_yard,
    light,
    light_map,
    open_to,
    shelves,
    stopped,
    turned_sun,
)
from landscape.elements.best.castle.gate import GATE_CORNERS
from landscape.elements.best.castle.loopholes import loopholes
from landscape.elements.best.castle.ornate_castle import OrnateCastle
from landscape.elements.best.castle.ornate_masonry import (
    BAND,
    GATE,
    KEEP,
    PLINTH,
    belt,
    ornate_masonry,
    ornate_tower,
)
from landscape.elements.best.castle.pennants import (
    interleaved,
    packed_by_hand,
    pennant,
    pennant_vertices,
)
from landscape.elements.best.castle.roofs import KEEP_ROOF, MASTS, ornate_outlines, roofs
from landscape.elements.best.terrain.casts import cast_castle
from landscape.elements.best.terrain.shadows import ShadowMap
from landscape.elements.castle import Castle
from landscape.elements.settings import TIMES, Sun, preset
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.masonry import CORNERS, TOWER_RADIUS, TOWER_TOP, WALL, outlines, quads_mesh
from landscape.geometry.mesh import Mesh
from landscape.settings.declare import with_settings

SETTINGS = {**PLACED, "sun.azimuth": 180.0, "sun.elevation": 45.0}


def faces(mesh: Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return middles (m, 3), area vectors by the corners' turn, and the corners' mean normals."""
    corners = mesh.vertices[mesh.triangles].astype(float)
    turn = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    return corners.mean(axis=1), turn, mesh.normals[mesh.triangles].mean(axis=1)


@pytest.mark.parametrize("mesh", [ornate_masonry(4.0)[0], roofs(4.0), quads_mesh(loopholes(), 1.0)])
def test_the_winding_of_every_face_agrees_with_its_normal(mesh: Mesh) -> None:
    _, turn, normal = faces(mesh)
    assert ((turn * normal).sum(axis=1) > -1e-9).all()
    assert np.isfinite(mesh.vertices).all() and mesh.triangles.max() < len(mesh.vertices)


def test_bands_loopholes_and_towers_face_away_from_what_they_stand_on() -> None:
    for low, high, out in (BAND, PLINTH):
        quads = belt(low, high, out, GATE)
        middle, turn, _ = faces(quads_mesh(quads, 1.0))
        level = np.abs(turn[:, 1]) < 1e-9
        outwards = (middle - 0.5) * (1, 0, 1)
        assert level.any() and ((turn * outwards).sum(axis=1)[level] > 0).all()
        assert np.abs(quads[..., [0, 2]] - 0.5).max() == pytest.approx(0.5 + out)
    middle, turn, _ = faces(ornate_tower(4.0, True)[0])
    round_ = (np.hypot(middle[:, 0], middle[:, 2]) > TOWER_RADIUS - 0.005) & (
        np.abs(turn[:, 1]) < 1e-9
    )
    side = (turn * middle * (1, 0, 1)).sum(axis=1)
    assert round_.sum() > 200 and (side[round_ & (middle[:, 1] < TOWER_TOP - 0.1)] > 0).all()


def test_the_plinth_leaves_the_gate_free_and_the_gate_wall_may_be_left_out() -> None:
    quads = belt(*PLINTH, GATE)
    middle = quads.mean(axis=1)
    in_front_of_door = (middle[:, 2] < 0.01) & (middle[:, 0] > GATE[0]) & (middle[:, 0] < GATE[1])
    assert not in_front_of_door.any()

    mesh, _ = ornate_masonry(4.0)
    gate = mesh.vertices[:4]
    assert gate[:, :2].tolist() == [list(corner) for corner in GATE_CORNERS]
    assert (gate[:, 2] == 0.0).all() and mesh.triangles[:2].max() == 3
    middle, turn, _ = faces(mesh)
    wall = (middle[:, 1] > 0) & (middle[:, 1] < 1)
    front = (np.abs(middle[:, 2]) < 1e-6) & wall & (turn[:, 2] < 0)
    assert np.flatnonzero(front).tolist() == [0, 1]


def test_a_pennant_hangs_on_its_mast_and_waves_with_kt() -> None:
    before, behind = pennant(0.0, 0.2), pennant(4.0, 0.2)
    assert np.allclose(before[:2, [0, 2]], 0.0) and np.allclose(behind[:2, [0, 2]], 0.0)
    assert np.allclose(before[:, :2], behind[:, :2])
    assert np.abs(before - behind)[2:, 2].max() > 0.005


def test_the_keep_and_its_roof_cast_a_longer_shadow_than_the_walls() -> None:
    plain, ornate = (max(high for *_, high in lines(0.02)) for lines in (outlines, ornate_outlines))
    assert plain == pytest.approx(TOWER_TOP)
    assert ornate == pytest.approx(KEEP[4] + KEEP_ROOF, abs=0.05)


def test_the_interleaved_array_holds_what_a_loop_over_the_vertices_sends() -> None:
    colours, places = pennant_vertices(33.0)
    assert len(colours) == len(places) == 20 * len(MASTS)
    packed = interleaved(colours, places)
    assert packed.tobytes() == packed_by_hand(colours, places)
    assert packed.size == 16 * len(places) and (colours[:, 3] == 255).all()


def test_pennants_hang_under_the_tips_of_their_masts_and_are_shaded_by_their_slope() -> None:
    colours, places = pennant_vertices(5.0)
    for k, (x, z, foot, length) in enumerate(MASTS):
        mine = places[20 * k : 20 * k + 20]
        assert mine[:, 0].min() == pytest.approx(x) and mine[:, 0].max() <= x + length + 1e-6
        assert np.abs(mine[:, 2] - z).max() < 0.1 * length
        assert abs(mine[0, 1] - (foot + 1.15 * length)) < 0.2 * length
    assert len(np.unique(colours[:, 0])) > 4 and (colours[:, 0] > 2 * colours[:, 1]).all()


@pytest.mark.seldom(13, first=6)
@pytest.mark.parametrize(("mirrored", "rippled", "burns"), [(0, 1, 1), (1, 0, 1), (1, 1, 0)])
def test_flames_and_pennants_are_not_drawn_into_a_rippled_mirror_image(
    stage: Stage, plain: Assets, mirrored: int, rippled: int, burns: int
) -> None:
    settings = small({**SETTINGS, "castle.ornate": True, "reflection.rippled": bool(rippled)})
    castle = OrnateCastle(settings, plain, FLAT)
    with stage.frame(settings, Pose(20.0, 2.4, 17.9, 180.0, 0.0)) as frame:
        with recording() as recorder:
            castle.draw(replace(frame, mirrored=bool(mirrored)))
    castle.release()
    sent = [call for call in recorder.calls if call.name == "glInterleavedArrays"]
    assert len(sent) == 2 * burns


@pytest.mark.seldom(7, first=4)
def test_an_ornate_castle_out_of_view_is_not_drawn_and_its_mirror_image_is_lower(
    stage: Stage, plain: Assets
) -> None:
    settings = small({**SETTINGS, "castle.ornate": True, "camera.cull": True})
    castle = OrnateCastle(settings, plain, FLAT)
    counts = []
    for yaw in (180.0, 0.0):
        with stage.frame(settings, Pose(20.0, 2.4, 17.0, yaw, 0.0)) as frame:
            with recording() as recorder:
                castle.draw(frame)
        counts.append(len(recorder.calls))
    assert counts[0] > 10 and counts[1] == 0
    with stage.frame(settings, Pose(20.0, 6.0, 17.0, 180.0, -15.0)) as frame:
        assert castle.visible(frame) and not castle.visible(replace(frame, mirrored=True))
    castle.release()


def rotation(yaw: float) -> np.ndarray:
    """Return the matrix by which glRotatef about y multiplies rows (n, 3); needs a context."""
    gl.glPushMatrix()
    gl.glLoadIdentity()
    gl.glRotatef(yaw, 0.0, 1.0, 0.0)
    matrix = np.array(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)).reshape(4, 4)
    gl.glPopMatrix()
    return matrix[:3, :3]


@pytest.mark.seldom(10, first=1)
def test_the_gate_drawn_in_one_pass_is_multiplied_by_the_light_map(
    stage: Stage, plain: Assets
) -> None:
    pose = Pose(20.0, 2.4, 17.9, 180.0, 0.0)
    places = np.array([(0.2, 0.1, 0.0), (0.3, 0.5, 0.0), (0.5, 0.8, 0.0), (0.16, 0.7, 0.0)])
    settings = small({**SETTINGS, "castle.ornate": True, "castle.multitexture": True})
    castle = OrnateCastle(settings, plain, FLAT)
    with stage.frame(settings, pose) as frame:
        castle.draw(frame)
        picture = stage.read()
    castle.release()
    got = [pixel(picture, project(pose, tuple(at + (19.5, 2.0, 19.5)))).mean() for at in places]
    expected = light(places, np.tile([0.0, 0.0, -1.0], (4, 1)), settings.sun, 0.0).mean(axis=1)
    assert np.allclose(got / np.max(got), expected / expected.max(), atol=0.05)
    assert expected.min() < 0.85 * expected.max()


def test_a_pennant_shows_red_over_the_keep(stage: Stage, plain: Assets) -> None:
    settings = small({**SETTINGS, "castle.ornate": True})
    castle = OrnateCastle(settings, plain, FLAT)
    with stage.frame(settings, Pose(20.0, 3.4, 17.0, 180.0, 14.0)) as frame:
        castle.draw(frame)
        picture = stage.read()
    castle.release()
    red = (picture[..., 0] > 2 * picture[..., 1]) & (picture[..., 0] > 80)
    assert 3 < red.sum() < 500


def test_the_castle_shades_the_ground_behind_it(stage: Stage, plain: Assets) -> None:
    settings = small({**SETTINGS, "castle.ornate": True})
    castle = OrnateCastle(settings, plain, FLAT)
    shadows = ShadowMap(FLAT, np.array([0.0, 0.7071, 0.7071]), 800)
    cast_castle(castle, shadows)
    castle.release()
    light = shadows.light()[..., 1] / 255

    def at(x: float, z: float) -> float:
        return float(light[int(z * 20), int(x * 20)])

    assert at(20.0, 19.0) < 0.6 and at(20.0, 18.6) < 0.6 and at(20.0, 17.0) > 0.99
    assert at(20.0, 21.5) > 0.95


def test_the_shadow_turns_with_the_castle(stage: Stage, plain: Assets) -> None:
    settings = small({**SETTINGS, "castle.yaw": 30.0})
    castle = Castle(settings, plain, FLAT)
    shadows = ShadowMap(FLAT, np.array([0.0, 1.0, 0.0]), 800)
    cast_castle(castle, shadows)
    castle.release()
    light = shadows.light()[..., 1] / 255
    corners = (np.insert(np.array(CORNERS), 1, 0.5, axis=1) - 0.5) @ rotation(30.0)
    for corner in corners:
        x, z = ((corner[[0, 2]] + 20.0) * 20).astype(int)
        assert light[z, x] < 0.75
        x, z = ((corner[[0, 2]] * (1.0, -1.0) + 20.0) * 20).astype(int)  # turned the other way
        assert light[z, x] > 0.8


# The light map.


def test_the_sun_is_turned_as_opengl_turns_the_castle(stage: Stage) -> None:
    sun = Sun(azimuth=70.0, elevation=20.0)
    with stage.frame(small({}), Pose(20.0, 2.0, 20.0)):
        assert np.allclose(turned_sun(sun, 130.0) @ rotation(130.0), direction(sun), atol=1e-6)


def test_towers_walls_and_keep_stop_light() -> None:
    east = np.array([1.0, 0.2, 0.0]) / np.hypot(1.0, 0.2)
    places = np.array(
        [(-0.5, 0.1, 0.5), (1.5, 0.1, 0.5), (-0.5, 2.5, 0.5), (-0.3, 0.5, 0.0), (-0.3, 0.5, -0.2)]
    )
    # In front of a wall, behind the castle, above it, in front of a tower, beside that tower.
    assert stopped(places, east).tolist() == [True, False, False, True, False]
    keep = stopped(np.array([(0.43, 1.0, 0.3), (0.43, 2.0, 0.3)]), np.array([0.0, 0.6, 0.8]))
    assert keep.tolist() == [True, False]


def test_a_corner_sees_less_of_the_sky_than_the_middle_of_a_wall() -> None:
    up = [np.array([x, 0.7, -0.5]) / np.linalg.norm([x, 0.7, -0.5]) for x in (-0.5, 0.0, 0.5)]
    places = np.array([(0.5, 0.5, 0.0), (0.15, 0.5, 0.0), (0.5, 0.5, 1.0)])
    normals = np.array([(0, 0, -1.0), (0, 0, -1.0), (0, 0, 1.0)])
    seen = open_to(places, normals, up)
    assert seen[0] == pytest.approx(1.0) and 0.1 < seen[1] < 0.9 and seen[2] == 0.0


def test_light_is_least_in_shadow_and_at_the_damp_foot() -> None:
    sun = Sun(azimuth=0.0, elevation=40.0)  # from the north, where the gate looks with yaw 0
    column = np.array([(0.5, y, 0.0) for y in (0.02, 0.4, 0.7)])
    behind = np.array([(0.5, 1.1, 0.56), (0.40, 1.3, 0.56)])
    facing = np.tile([0.0, 0.0, -1.0], (3, 1))
    lit = light(column, facing, sun, 0.0).mean(axis=1)
    assert lit[0] < 0.8 * lit[1] and lit[1:].min() > 0.5
    assert light(column, facing, sun, 180.0).mean() > 0.5  # turned away: no sun to lose
    keep = light(behind, np.tile([0.0, 0.0, -1.0], (2, 1)), sun, 0.0).mean(axis=1)
    assert (keep > 0.4).all()
    # The tower at (0, 0) stands between the western sun and the wall's first part.
    west = Sun(azimuth=-60.0, elevation=15.0)
    shaded, free = light(np.array([(0.16, 0.5, 0.0), (0.8, 0.5, 0.0)]), facing[:2], west, 0.0)
    assert shaded.mean() < 0.75 * free.mean()


def test_boxes_packed_on_shelves_do_not_overlap() -> None:
    rng = np.random.default_rng(4)
    sizes = [(int(w), int(h)) for w, h in rng.integers(2, 60, (150, 2))]
    used = np.zeros((SIDE, SIDE), int)
    for (x, y), (wide, high) in zip(shelves(sizes), sizes, strict=True):
        used[y : y + high, x : x + wide] += 1
    assert used.max() == 1 and used.sum() == sum(w * h for w, h in sizes)
    with pytest.raises(ValueError, match="light map"):
        shelves([(SIDE, SIDE), (2, 2)])


@pytest.mark.seldom(13, first=9)
def test_every_vertex_looks_up_the_light_at_its_own_position() -> None:
    mesh, strips = ornate_masonry(4.0)
    named = np.concatenate([strip.ravel() for strip in strips])
    assert sorted(named.tolist()) == list(range(len(mesh.vertices)))
    sun = Sun()
    picture, coordinates = light_map(mesh, strips, sun, -160.0)
    texels = coordinates * SIDE - 0.5
    some = np.concatenate([strip.ravel() for strip in strips[:40]])  # quads: texels at corners
    column, row = np.round(texels[some]).astype(int).T
    assert np.allclose(texels[some], np.stack([column, row], axis=1), atol=1e-3)
    own = light(mesh.vertices[some].astype(float), mesh.normals[some].astype(float), sun, -160.0)
    assert np.abs(picture[row, column] / 127.5 - np.minimum(own, 2.0)).max() < 0.01


@pytest.mark.parametrize("time", TIMES)
def test_the_walls_of_the_yard_light_each_other(time: str) -> None:
    sun = with_settings(preset("best"), {"time": time, **TIMES[time]}).sun
    within = np.array([(x, y, WALL) for x in (0.15, 0.5, 0.85) for y in (0.1, 0.3, 0.6)])
    south = np.tile((0.0, 0.0, 1.0), (len(within), 1))
    yaw = preset("best").castle.yaw
    assert light(within, south, sun, yaw).mean(axis=1).min() > 0.33
    without = within * (1.0, 1.0, 0.0)
    assert in_yard(within).min() > 0.9 and in_yard(without).max() == 0.0
    shaded = light(without, -south, replace(sun, diffuse=(0.0, 0.0, 0.0)), yaw).mean()
    assert light(within, south, sun, yaw).mean() < shaded, "the yard is darker than a wall outside"


@pytest.mark.seldom(10, first=8)
def test_the_door_is_seen_from_the_yard_where_it_opens(stage: Stage, plain_folder) -> None:
    within = Pose(20.0, 2.2, 19.9, 0.0, 0.0)
    pictures = []
    for colour in ((250, 0, 0, 255), (0, 0, 250, 255)):
        assets = Assets(write_plain(plain_folder, {"castle_door.png": colour}))
        picture = drawn(stage, assets, within, castle__ornate=True, camera__cull=True)
        pictures.append(pixel(picture, project(within, at(0.5, 0.2, WALL))))
    red, blue = pictures
    assert red[0] > red[2] + 30 and blue[2] > blue[0] + 30
