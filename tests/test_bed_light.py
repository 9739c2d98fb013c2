"""Caustics on the bed of the island's shallow water: where they are, and what they need."""

import numpy as np
import pytest
from stage import Stage

from framelens.gl import extensions
from landscape.elements.best.terrain.bed_light import (
    DEEPEST,
    fade_picture,
    strength,
    under_net,
    varied,
)
from landscape.elements.caustic_film import shipped
from landscape.elements.ground import Ground
from landscape.elements.settings import preset
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.mesh import Mesh, grid_triangles, vertex_normals
from landscape.island.island import Island
from landscape.scene.scene import Moment
from landscape.settings.declare import with_settings

SIZE = (160, 120)
BARE = {"ground.stones": 0, "ground.texture_size": 512, "fog.enabled": False, "camera.fov": 60.0}
BEST = with_settings(preset("best"), BARE)
NOON = BEST.sun
EYE = Pose(5.5, 3.1, 28.75, 0.0, -90.0)  # straight above a sand bank
CLIFF = Pose(33.0, 1.8, 19.0, 0.0, -90.0)  # straight above an islet's rock


def ground(
    stage: Stage, caustics: bool, kt: float = 40.0, eye: Pose = EYE
) -> tuple[np.ndarray, Ground]:
    """Return the picture of the bare ground from above, int64 (h, w, 3), and its height field."""
    settings = with_settings(BEST, {"water.caustics": caustics, "ground.clip": False})
    island = Island(settings, Assets(), only=("ground",))
    with stage.borrowed():
        island.draw(Moment(eye, SIZE, kt))
        picture = stage.read()
        surface = island.ground
    island.release()
    return picture, surface


def depths(surface: Ground, eye: Pose = EYE) -> np.ndarray:
    """Return how deep the ground is under each pixel, float (h, w); below 0 on land."""
    width, height = SIZE
    column, row = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    assert eye.y is not None
    scale = (eye.y - BEST.water.level) * np.tan(np.radians(30.0)) / (height / 2)
    x, z = eye.x + (column - width / 2) * scale, eye.z + (row - height / 2) * scale
    return np.asarray(BEST.water.level - surface.terrain_height(x, z))


@pytest.mark.seldom(3)
def test_the_net_lies_on_the_bed_of_shallow_water_and_nowhere_else(stage: Stage) -> None:
    plain, surface = ground(stage, False)
    lit, _ = ground(stage, True)
    depth, changed = depths(surface), np.abs(lit - plain).max(axis=2)
    assert (depth < -0.02).mean() > 0.02 and (depth > DEEPEST + 0.05).mean() > 0.02
    assert changed[depth < -0.02].max() <= 1, "land"
    assert changed[depth > DEEPEST + 0.05].max() <= 1, "deep water"
    shallow = (depth > 0.03) & (depth < 0.1)
    assert (changed[shallow] > 5).mean() > 0.3
    assert lit[shallow].mean() == pytest.approx(plain[shallow].mean(), rel=0.15)


@pytest.mark.seldom(3)
def test_the_net_moves(stage: Stage) -> None:
    first, surface = ground(stage, True)
    later, _ = ground(stage, True, kt=60.0)
    moved = np.abs(later - first).max(axis=2)
    assert moved.max() > 30 and moved[depths(surface) < -0.02].max() <= 1


@pytest.mark.seldom(10, first=9)
def test_with_too_few_texture_units_the_bed_is_drawn_without_the_net(
    stage: Stage, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    plain, _ = ground(stage, False)
    monkeypatch.setattr(extensions, "texture_units", lambda: 6)
    monkeypatch.setattr(extensions, "_told", set())
    without, _ = ground(stage, True)
    assert (without == plain).all()
    line = "landscape: water.caustics: off, for it needs 7 texture units of 6\n"
    assert capsys.readouterr().err == line


@pytest.mark.seldom(3)
def test_a_steep_bed_has_no_net_that_would_be_drawn_out(stage: Stage) -> None:
    plain, surface = ground(stage, False, eye=CLIFF)
    lit, _ = ground(stage, True, eye=CLIFF)
    depth, changed = depths(surface, CLIFF), np.abs(lit - plain).max(axis=2)
    pixel = (1.8 - BEST.water.level) * np.tan(np.radians(30.0)) / (SIZE[1] / 2)
    steep = np.hypot(*np.gradient(depth, pixel)) > 0.8
    steep &= (depth > 0.02) & (depth < 0.1)
    assert steep.mean() > 0.005
    assert changed[steep].mean() < 5.0


def test_meshes_of_the_net_are_of_many_sizes_and_as_bright_as_those_of_the_film() -> None:
    frames = shipped(Assets())[::8]
    net = varied(frames).astype(float)
    assert net.mean() == pytest.approx(frames.mean(), rel=0.05)
    side = net.shape[1] // 2
    alike = np.corrcoef(net[0].ravel(), np.roll(net[0], side, axis=1).ravel())[0, 1]
    assert abs(alike) < 0.3, "the film, twice along the net's side, would be the same"
    seam, inside = (np.abs(np.diff(net, axis=2)).mean(), np.abs(net[..., 0] - net[..., -1]).mean())
    assert inside < 2 * seam, "no seam"


def test_the_net_is_strongest_just_below_the_edge_and_weak_under_a_low_sun() -> None:
    depth = np.array([-0.5, 0.0, 0.04, 0.1, DEEPEST, 3.0])
    noon = strength(depth, NOON)
    assert (noon[[0, 1, 4, 5]] == 0).all() and noon[2] > noon[3] > 0
    low = with_settings(BEST, {"sun.elevation": 4.0}).sun
    assert (strength(depth, low)[2:4] < 0.2 * noon[2:4]).all()
    setting = with_settings(BEST, {"sun.elevation": 0.0}).sun
    assert not strength(depth, setting).any()


def test_the_texture_that_fades_the_net_ends_in_nothing_on_both_sides() -> None:
    picture = fade_picture(NOON)
    assert picture[0, 0] == picture[0, -1] == 0 and picture.max() > 150


def test_the_net_is_on_the_triangles_under_shallow_water_and_on_no_others() -> None:
    x, z = np.meshgrid(np.linspace(0, 1, 11), np.linspace(0, 1, 3))
    vertices = np.stack([x, 1.0 - x, z], axis=-1).reshape(-1, 3).astype(np.float32)
    triangles = grid_triangles(11, 3)
    mesh = Mesh(vertices, vertex_normals(vertices, triangles), triangles)
    wet = under_net(mesh, 0.6)
    heights = mesh.vertices[triangles, 1]
    low, high = heights[wet].min(axis=1), heights[wet].max(axis=1)
    assert (low < 0.6).all() and (high > 0.6 - DEEPEST).all() and len(low)
    for triangle in heights[~wet]:
        assert triangle.min() >= 0.6 or triangle.max() <= 0.6 - DEEPEST
