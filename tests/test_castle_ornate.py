"""The ornate castle: its meshes face outwards, its gate wall matches, its pennants wave."""

import numpy as np
import pytest
from stage import Stage, pixel, project, small

from landscape.assets import Assets
from landscape.elements.castle import Castle
from landscape.elements.castle_meshes import (
    BAND,
    GATE,
    KEEP,
    KEEP_ROOF,
    PLINTH,
    TOWER_RADIUS,
    TOWER_TOP,
    belt,
    grid_quads,
    loopholes,
    merged,
    ornate_masonry,
    ornate_tower,
    pennant,
    quads_mesh,
    rings,
    roofs,
    wall_light,
)
from landscape.elements.ground import HeightField
from landscape.elements.shadows import ShadowMap
from landscape.frame import Pose
from landscape.gl.mesh_tool import Mesh, vertex_normals

FLAT = HeightField(np.full((4, 4), 2.0, np.float32), 40.0, 0.6)


def faces(mesh: Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return middles (m, 3), area vectors by the corners' turn, and the corners' mean normals."""
    corners = mesh.vertices[mesh.triangles].astype(float)
    turn = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    return corners.mean(axis=1), turn, mesh.normals[mesh.triangles].mean(axis=1)


@pytest.mark.parametrize(
    "mesh", [ornate_masonry(4.0, True), roofs(4.0), quads_mesh(loopholes(), 1.0)]
)
def test_every_face_turns_the_way_its_normal_points(mesh: Mesh) -> None:
    _, turn, normal = faces(mesh)
    assert ((turn * normal).sum(axis=1) > -1e-9).all()
    assert np.isfinite(mesh.vertices).all() and mesh.triangles.max() < len(mesh.vertices)


def test_bands_loopholes_and_towers_look_away_from_what_they_stand_on() -> None:
    for low, high, out in (BAND, PLINTH):
        quads = belt(low, high, out, GATE)
        middle, turn, _ = faces(quads_mesh(quads, 1.0))
        level = np.abs(turn[:, 1]) < 1e-9
        outwards = (middle - 0.5) * (1, 0, 1)
        assert level.any() and ((turn * outwards).sum(axis=1)[level] > 0).all()
        assert np.abs(quads[..., [0, 2]] - 0.5).max() == pytest.approx(0.5 + out)
    middle, turn, _ = faces(ornate_tower(4.0))
    round_ = (np.hypot(middle[:, 0], middle[:, 2]) > TOWER_RADIUS - 0.005) & (
        np.abs(turn[:, 1]) < 1e-9
    )
    side = (turn * middle * (1, 0, 1)).sum(axis=1)
    assert round_.sum() > 400 and (side[round_ & (middle[:, 1] < TOWER_TOP - 0.1)] > 0).all()


def test_the_plinth_leaves_the_gate_free_and_the_gate_wall_may_be_left_out() -> None:
    quads = belt(*PLINTH, GATE)
    middle = quads.mean(axis=1)
    before_door = (middle[:, 2] < 0.01) & (middle[:, 0] > GATE[0]) & (middle[:, 0] < GATE[1])
    assert not before_door.any()

    def gate_area(mesh: Mesh) -> float:
        middle, turn, _ = faces(mesh)
        front = (np.abs(middle[:, 2]) < 1e-6) & (middle[:, 1] > 0) & (turn[:, 2] < 0)
        return float(-turn[front, 2].sum())

    with_gate, without = (gate_area(ornate_masonry(4.0, gate)) for gate in (True, False))
    assert with_gate - without == pytest.approx(1.0, abs=1e-5)


def test_walls_are_darkest_at_the_foot_and_darker_under_the_band() -> None:
    heights = np.array([0.0, 0.05, 0.2, 0.5, 0.8, 0.88, 0.95])
    light = wall_light(np.insert(np.zeros((7, 2)), 1, heights, axis=1))
    assert light[0] < light[1] < light[2] < light[3] and light[3] > 0.99
    assert light[5] < light[4] < light[3] and light[6] == pytest.approx(1.0, abs=1e-3)


def test_cutting_a_quad_into_rows_keeps_its_shape() -> None:
    quads = np.array([[(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]], float)
    cut = grid_quads(quads, 0.3)
    assert len(cut) == 4 and np.allclose(cut[0][:2], quads[0][:2])
    assert np.allclose(cut[-1][2:], quads[0][2:]) and np.allclose(cut[0][2:], cut[1][[1, 0]])


def test_merging_moves_triangles_behind_the_vertices_before() -> None:
    vertices = np.eye(3, dtype=np.float32)
    triangle = np.array([(0, 1, 2)], np.uint32)
    one = Mesh(vertices, vertex_normals(vertices, triangle), triangle, (vertices[:, :2],))
    both = merged([one, one])
    assert both.triangles.tolist() == [[0, 1, 2], [3, 4, 5]] and len(both.vertices) == 6
    assert both.colors is None


def test_a_pennant_hangs_on_its_mast_and_waves_with_kt() -> None:
    before, behind = pennant(0.0, 0.2), pennant(4.0, 0.2)
    assert np.allclose(before[:2, [0, 2]], 0.0) and np.allclose(behind[:2, [0, 2]], 0.0)
    assert np.allclose(before[:, :2], behind[:, :2])
    assert np.abs(before - behind)[2:, 2].max() > 0.005


def test_the_keep_and_its_roof_throw_a_longer_shadow_than_the_walls() -> None:
    plain, ornate = (max(high for _, _, high in rings(0.02, k)) for k in (False, True))
    assert plain == pytest.approx(TOWER_TOP)
    assert ornate == pytest.approx(KEEP[4] + KEEP_ROOF, abs=0.05)


SETTINGS = {
    "castle.x": 20.0,
    "castle.z": 20.0,
    "castle.yaw": 0.0,
    "sun.azimuth": 180.0,
    "sun.elevation": 45.0,
}


def test_the_gate_drawn_in_one_pass_darkens_towards_its_foot_as_the_walls_do(
    stage: Stage, plain: Assets
) -> None:
    pose = Pose(20.0, 2.4, 17.9, 180.0, 0.0)
    heights, got = np.array([0.02, 0.5]), []
    for ornate in (False, True):
        changed = {"castle.ornate": ornate, "castle.multitexture": True}
        settings = small({**SETTINGS, **changed})
        castle = Castle(settings, plain, FLAT)
        with stage.frame(settings, pose) as frame:
            castle.draw(frame)
            picture = stage.read()
        castle.release()
        points = [project(pose, (20.0, 2.0 + y, 19.5)) for y in heights]
        got.append([pixel(picture, point).mean() for point in points])
    light = wall_light(np.insert(np.zeros((2, 2)), 1, heights, axis=1))
    assert np.allclose(np.divide(*got[::-1]), light, atol=0.03) and light[0] < 0.75


def test_a_pennant_shows_red_over_the_keep(stage: Stage, plain: Assets) -> None:
    settings = small({**SETTINGS, "castle.ornate": True})
    castle = Castle(settings, plain, FLAT)
    with stage.frame(settings, Pose(20.0, 3.4, 17.0, 180.0, 14.0)) as frame:
        castle.draw(frame)
        picture = stage.read()
    castle.release()
    red = (picture[..., 0] > 2 * picture[..., 1]) & (picture[..., 0] > 80)
    assert 3 < red.sum() < 500


def test_the_castle_shades_the_ground_behind_it(stage: Stage, plain: Assets) -> None:
    settings = small({**SETTINGS, "castle.ornate": True})
    castle = Castle(settings, plain, FLAT)
    shadows = ShadowMap(FLAT, np.array([0.0, 0.7071, 0.7071]), 800)
    castle.cast(shadows)
    castle.release()
    light = shadows.light()[..., 1] / 255

    def at(x: float, z: float) -> float:
        return float(light[int(z * 20), int(x * 20)])

    assert at(20.0, 19.0) < 0.6 and at(20.0, 18.6) < 0.6 and at(20.0, 17.0) > 0.99
    assert at(20.0, 21.5) > 0.95
