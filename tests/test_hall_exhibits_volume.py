"""The exhibit of the shadow volume: closed volumes, a mask as rays give it, z-pass and z-fail."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from framelens.gl.seam import gl
from landscape.frame import Pose
from landscape.geometry.mesh import is_closed
from landscape.geometry.silhouette import boundary, faces_light, shadow_volume
from landscape.hall import plan
from landscape.hall.exhibits.cabinet import Cabinet
from landscape.hall.exhibits.niche import INSET, VOLUME, pedestal_boxes
from landscape.hall.exhibits.shadow_volume import TURN, ShadowVolume, torch, trefoil
from landscape.offscreen import Offscreen

SIZE = (160, 120)
Z = plan.ALCOVES[VOLUME]
IN_FRONT = Pose(1.16, 0.15, Z, 270.0, 0.0)
BEHIND = Pose(0.826, 0.13, Z - 0.052, 338.0, -10.0)  # within the knot's shadow
KT = 20.0


@pytest.fixture(scope="module")
def view() -> Iterator[Offscreen]:
    with Offscreen(SIZE, samples=0, place="hall", only=("room", "exhibits")) as opened:
        yield opened


def stencil(
    view: Offscreen, monkeypatch: pytest.MonkeyPatch, pose: Pose, **settings: Any
) -> np.ndarray:
    """Return the counts (h, w) that the light is added by, top row first."""
    found = []

    def kept(self: ShadowVolume, kt: float) -> None:
        counts = gl.glReadPixels(0, 0, *SIZE, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
        found.append(np.frombuffer(bytes(counts), np.uint8).reshape(SIZE[::-1])[::-1])

    monkeypatch.setattr(ShadowVolume, "_add_light", kept)
    view.look(pose, KT)
    values = view.scene.settings
    changed = type(values)(exhibits=type(values.exhibits)(**settings))
    view.scene.elements[Cabinet].take(changed)
    view.draw()
    view.scene.elements[Cabinet].take(values)
    return found[0]


def rays(pose: Pose) -> np.ndarray:
    """Return the direction of the line of sight through each pixel, (h, w, 3)."""
    width, height = SIZE
    half = np.tan(np.radians(66.0 / 2))
    y, x = np.mgrid[:height, :width] + 0.5
    yaw = np.radians(pose.yaw)
    ahead = np.array([np.sin(yaw), 0.0, -np.cos(yaw)])
    right = np.array([np.cos(yaw), 0.0, np.sin(yaw)])
    up = np.array([0.0, 1.0, 0.0])
    u = (2 * x / width - 1) * half * width / height
    v = (1 - 2 * y / height) * half
    return ahead + u[..., None] * right + v[..., None] * up


def hidden(points: np.ndarray, light: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return which points (n, 3) triangles (m, 3, 3) hide from a light (Möller-Trumbore)."""
    found = np.zeros(len(points), bool)
    way = light - points
    for a, b, c in corners:
        p = np.cross(way, c - a)
        t = points - a
        q = np.cross(t, b - a)
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = 1.0 / (p @ (b - a))
            u, v = (t * p).sum(axis=1) * scale, (way * q).sum(axis=1) * scale
            along = (q @ (c - a)) * scale
            found |= (u >= 0) & (v >= 0) & (u + v <= 1) & (along > 1e-4) & (along < 1)
    return found


def casters() -> np.ndarray:
    """Return the triangles (m, 3, 3) of knot and pedestal in the hall at KT."""
    knot, angle = trefoil(), np.radians(TURN * KT)
    x, y, z = knot.vertices.T.astype(float)
    c, s = np.cos(angle), np.sin(angle)
    place = np.array([0.895, 0.082 + 0.058, Z])
    turned = np.stack([c * x + s * z, y, c * z - s * x], axis=1) + place
    vertices, triangles = pedestal_boxes(Z)
    return np.concatenate([turned[knot.triangles], vertices.astype(float)[triangles]])


def test_the_knot_is_closed_and_faces_outwards() -> None:
    knot = trefoil()
    assert is_closed(knot.triangles) and len(knot.triangles) < 2000
    a, b, c = (knot.vertices[knot.triangles[:, k]].astype(float) for k in range(3))
    assert (np.cross(b, c) * a).sum() > 0  # six times the volume
    for vertices, triangles in (pedestal_boxes(0.0),):
        a, b, c = (vertices[triangles[:, k]].astype(float) for k in range(3))
        assert is_closed(triangles) and (np.cross(b, c) * a).sum() > 0


@pytest.mark.parametrize("light", [(1.0, 0.5, 0.2), (0.0, 0.3, 0.1), (-0.2, -0.4, 0.0)])
def test_a_silhouette_is_made_of_closed_lines(light: tuple[float, ...]) -> None:
    knot = trefoil()
    lit = knot.triangles[faces_light(knot.vertices, knot.triangles, np.array(light))]
    edges = boundary(lit)
    assert 0 < len(edges) < len(lit)
    assert np.array_equal(np.sort(edges[:, 0]), np.sort(edges[:, 1]))


def test_a_volume_with_caps_is_closed_and_one_without_is_not() -> None:
    knot, light = trefoil(), np.array([0.2, 0.3, 0.1])
    vertices, triangles = shadow_volume(knot.vertices, knot.triangles, light, 5.0, True)
    assert len(boundary(triangles)) == 0
    a, b, c = (vertices[triangles[:, k]].astype(float) for k in range(3))
    assert (np.cross(b, c) * a).sum() > 0
    assert len(boundary(shadow_volume(knot.vertices, knot.triangles, light, 5.0, False)[1])) > 0


def test_edges_of_a_mesh_that_is_not_a_surface_make_closed_lines_too() -> None:
    three_at_one_edge = np.array([(0, 1, 2), (0, 1, 3), (0, 1, 4)])
    edges = boundary(three_at_one_edge)
    assert len(edges) == 9 and (edges == (0, 1)).all(axis=1).sum() == 3


@pytest.mark.seldom(14, first=6)
@pytest.mark.parametrize("count", ["zpass", "zfail"])
def test_the_counts_on_the_back_wall_are_those_of_rays_to_the_torch(
    view: Offscreen, monkeypatch: pytest.MonkeyPatch, count: str
) -> None:
    counts = stencil(view, monkeypatch, IN_FRONT, volume_count=count)
    ways = rays(IN_FRONT)
    eye = np.array([IN_FRONT.x, IN_FRONT.y, IN_FRONT.z])
    wall = plan.INSIDE.west - plan.ALCOVE_DEPTH + INSET
    points = eye + ways * ((wall - eye[0]) / ways[..., :1])
    on_wall = (np.abs(points[..., 2] - Z) < plan.ALCOVE_HALF - 0.004) & (points[..., 1] > 0.004)
    on_wall &= points[..., 1] < plan.ALCOVE_SPRINGING
    triangles = casters()
    seen = np.zeros(on_wall.shape, bool)
    seen[on_wall] = ~hidden(points[on_wall], eye, triangles)
    expected = hidden(points[seen], np.array(torch(KT)), triangles)
    found = counts[seen] != 0
    assert expected.sum() > 300 and (~expected).sum() > 300
    assert (expected & found).sum() / (expected | found).sum() > 0.98


@pytest.mark.seldom(7)
def test_inside_the_volume_z_pass_is_wrong_and_z_fail_is_right(
    view: Offscreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    eye = np.array([[BEHIND.x, BEHIND.y, BEHIND.z]])
    assert hidden(eye, np.array(torch(KT)), casters()).all()
    right = stencil(view, monkeypatch, BEHIND, volume_count="zfail") != 0
    wrong = stencil(view, monkeypatch, BEHIND, volume_count="zpass") != 0
    open_ = stencil(view, monkeypatch, BEHIND, volume_count="zfail", volume_caps=False) != 0
    assert (wrong != right).mean() > 0.2
    assert (open_ != right).mean() > 0.02


@pytest.mark.seldom(5)
def test_the_stencil_buffer_is_left_empty(view: Offscreen) -> None:
    view.look(IN_FRONT, KT)
    view.draw()
    with view.targeted():
        counts = gl.glReadPixels(0, 0, *SIZE, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
    assert not np.frombuffer(bytes(counts), np.uint8).any()
