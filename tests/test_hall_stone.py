"""The hall's stone: no gaps, charts apart, normals inwards, and where its light falls."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from stage import SIZE, Stage

from landscape.elements.sun import direction
from landscape.files.assets import Assets, shipped
from landscape.files.images import read_image
from landscape.frame import Pose
from landscape.geometry.mesh import grid_triangles
from landscape.hall import plan
from landscape.hall.architecture import hall, shell
from landscape.hall.hall import SCENE, Hall
from landscape.hall.levels import ALONG, LEVELS, SIMPLIFIED
from landscape.hall.light import FILE, SIDE, SIZES, light_map, of_plane, on_plane, placed
from landscape.hall.materials import MATERIALS
from landscape.hall.ornaments import pillar
from landscape.hall.room import meshes
from landscape.hall.settings import Settings
from landscape.hall.shafts import sheets
from landscape.hall.shapes import turned
from landscape.hall.surfaces import Surface, cells, charts, fractions, needed, normals
from landscape.hall.torches import flames, halos, torches
from landscape.scene.scene import Moment
from landscape.settings.declare import with_settings

SUN = direction(Settings().sun).astype(float)
PLACES = torches(Settings().shadow)


def triangles(surfaces: list[Surface]) -> np.ndarray:
    """Return the corners (n, 3, 3) of all triangles."""
    found = []
    for surface in surfaces:
        rows, columns = surface.points.shape[:2]
        found.append(surface.points.reshape(-1, 3)[grid_triangles(columns, rows)])
    return np.concatenate(found)


def first_hits(corners: np.ndarray, start: np.ndarray, rays: np.ndarray) -> np.ndarray:
    """Return the triangle each ray (m, 3) from ``start`` meets first, -1 for none."""
    one, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    offset = start - corners[:, 0]
    found = []
    for ray in rays:
        p = np.cross(ray, other)
        scale = (one * p).sum(axis=1)
        scale = np.where(scale == 0.0, np.inf, scale)  # parallel to the ray
        u = (offset * p).sum(axis=1) / scale
        q = np.cross(offset, one)
        v, far = (q @ ray) / scale, (other * q).sum(axis=1) / scale
        # A line along an edge meets one of the two triangles, whatever rounding does.
        inside = (u > -1e-7) & (v > -1e-7) & (u + v < 1 + 1e-7) & (far > 1e-6)
        nearest = np.where(inside, far, np.inf)
        found.append(int(nearest.argmin()) if inside.any() else -1)
    return np.array(found)


def all_around(count: int) -> np.ndarray:
    """Return ``count`` unit vectors, evenly spread."""
    k = np.arange(count) + 0.5
    up, turn = 1 - 2 * k / count, np.pi * (1 + 5**0.5) * k
    level = np.sqrt(1 - up**2)
    return np.stack([level * np.cos(turn), up, level * np.sin(turn)], axis=1)


def leaves_by_an_opening(start: np.ndarray, rays: np.ndarray) -> np.ndarray:
    """Return whether each ray passes a window, the rose or the door on the walls' outside."""
    inside, found = plan.INSIDE, np.zeros(len(rays), bool)
    with np.errstate(divide="ignore", invalid="ignore"):
        for axis, at in ((0, inside.east), (2, inside.north), (2, inside.south)):
            far = (at - start[axis]) / rays[:, axis]
            x, y, z = (start + far[:, None] * rays).T
            if axis == 0:
                middle = np.abs(z[:, None] - np.array(plan.ALCOVES)).min(axis=1)
                here = (middle < plan.WINDOW_HALF) & (y > plan.WINDOW_SILL) & (y < plan.WINDOW_TOP)
            elif at == inside.north:
                here = np.hypot(x - plan.AXIS, y - plan.ROSE[0]) < plan.ROSE[1]
            else:
                here = (np.abs(x - plan.AXIS) < plan.DOOR_HALF) & (y < plan.DOOR_TOP)
            found |= here & (far > 0)
    return found


@pytest.mark.seldom(14, first=12)
@pytest.mark.parametrize("start", [(1.6, 0.3, 1.6), (1.12, 0.1, 0.61), (2.05, 0.5, 2.43)])
def test_every_line_of_sight_ends_on_the_front_of_stone_or_leaves_by_an_opening(start) -> None:
    corners = triangles(shell())
    eye = np.array(start)
    rays = all_around(900)
    hit = first_hits(corners, eye, rays)
    opening = leaves_by_an_opening(eye, rays)
    assert (hit < 0).sum() > 5, "the windows are open"
    assert opening[hit < 0].all()
    met = corners[hit[hit >= 0]]
    facing = np.cross(met[:, 1] - met[:, 0], met[:, 2] - met[:, 0])
    assert ((facing * rays[hit >= 0]).sum(axis=1) < 0).all()


@pytest.mark.parametrize("height", [0.06, 0.20, 0.50])
@pytest.mark.seldom(13)
def test_a_pillar_shows_no_inside_from_any_side(height: float) -> None:
    corners = triangles(pillar(0.0, 0.0))
    for turn in np.radians([3.0, 25.0, 48.0]):
        eye = np.array([0.12 * np.cos(turn), height, 0.12 * np.sin(turn)])
        rays = all_around(4000)
        hit = first_hits(corners, eye, rays)
        met = corners[hit[hit >= 0]]
        facing = np.cross(met[:, 1] - met[:, 0], met[:, 2] - met[:, 0])
        assert len(met) > 100
        assert ((facing * rays[hit >= 0]).sum(axis=1) < 0).all()


def test_what_closes_a_joint_is_as_bright_as_the_edge_that_it_begins_at() -> None:
    lit = {id(each.surface): each for each in placed(hall())}
    joints = [each for each in lit.values() if each.surface.edge is not None]
    assert len(joints) == 3 * len(plan.ROWS) * len(plan.BAYS[1:-1])
    for each in joints:
        edge = each.surface.edge
        assert edge is not None
        row = lit[id(edge.surface)].light[edge.row]
        np.testing.assert_array_equal(each.light, np.broadcast_to(row, each.light.shape))


def test_walls_and_vault_share_their_edges() -> None:
    # A vault's point on a wall is one of the wall's points, or on one of its straight edges.
    surfaces = shell()
    walls = [s for s in surfaces if s.material == "wall"]
    inside = plan.INSIDE
    for axis, at in ((0, inside.east), (0, inside.west), (2, inside.north), (2, inside.south)):
        rims = [s.points[0] for s in walls if (s.points[..., axis] == at).all()]
        along = 2 - axis
        for web in (s for s in surfaces if s.material == "vault"):
            edge = web.points[0] if np.ptp(web.points[0][:, axis]) == 0 else web.points[1]
            if not np.allclose(edge[:, axis], at):
                continue
            for point in edge[1:-1]:
                heights = [
                    np.interp(point[along], *rim[np.argsort(rim[:, along])][:, [along, 1]].T)
                    for rim in rims
                    if rim[:, along].min() <= point[along] <= rim[:, along].max()
                ]
                assert np.abs(np.array(heights) - point[1]).min() < 1e-9


def test_charts_lie_in_the_map_and_apart() -> None:
    taken = np.zeros((SIDE, SIDE), int)
    for lit in placed(hall()):
        if lit.chart is None:
            assert (lit.light >= -1e-6).all() and (lit.light <= SIZES[lit.surface.sheet]).all()
            continue
        x = lit.chart.x
        y = lit.chart.y
        width = lit.chart.width
        height = lit.chart.height
        taken[y - 1 : y + height + 1, x - 1 : x + width + 1] += 1
        assert min(x, y) >= 1 and max(x + width, y + height) < SIDE
        assert lit.light[..., 0].min() >= x + 0.5 and lit.light[..., 1].max() <= y + height - 0.5
    assert taken.max() == 1 and (taken > 0).mean() > 0.6


def test_charts_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ValueError, match="do not fit"):
        charts([each for each in hall() if each.sheet == "hall"], 512, 200.0)


def test_normals_are_unit_vectors_and_face_the_nave() -> None:
    for surface in hall():
        length = np.linalg.norm(normals(surface.points), axis=2)
        assert np.abs(length - 1).max() < 1e-6, surface.material
    for surface in shell():
        p = surface.points
        within = (p[..., 0] > 0.999) & (p[..., 0] < 2.201) & (p[..., 2] > 0.399)
        within &= p[..., 2] < 2.801
        if surface.material in ("wall", "vault", "floor", "band", "medallion") and within.all():
            middle = p.mean(axis=(0, 1))
            towards = np.array([plan.AXIS, 0.3, np.clip(middle[2], 0.6, 2.6)]) - p
            assert (normals(p) * towards).sum() > 0


def test_a_texel_s_place_is_where_the_triangles_have_it() -> None:
    for lit in placed(hall())[::17]:
        if lit.chart is None:
            continue
        place, _ = cells(lit.surface, lit.chart)
        corner = lit.light[0, 0] - (lit.chart.x + 0.5, lit.chart.y + 0.5)
        assert np.abs(corner).max() < 1e-6
        for row, column in ((0, 0), (0, -1), (-1, 0), (-1, -1)):
            gap = place[row, column] - lit.surface.points[row, column]
            assert np.abs(gap).max() < 1e-6


def test_a_texel_of_the_floor_is_where_its_place_leads_back_to() -> None:
    for sheet in ("floor", "north"):
        width, height = SIZES[sheet]
        back = on_plane(sheet, of_plane(sheet))
        columns, rows = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
        np.testing.assert_allclose(back, np.stack([columns, rows], axis=-1), atol=1e-6)


def test_a_course_of_the_wall_is_as_high_as_a_mason_lifts() -> None:
    courses = 8  # of the texture
    assert 0.02 <= 1 / MATERIALS["wall"].repeats / courses <= 0.03
    for surface in (each for each in hall() if each.material == "wall"):
        risen = surface.on_material[..., 1]
        if np.ptp(surface.points[..., 1]) > 0.1 and np.allclose(np.ptp(surface.points[..., 0]), 0):
            np.testing.assert_allclose(risen, -surface.points[..., 1], atol=1e-9)


@pytest.mark.seldom(13)
def test_all_meshes_together_hold_all_surfaces() -> None:
    expected = sum(2 * (s.points.shape[0] - 1) * (s.points.shape[1] - 1) for s in hall())
    found = meshes()
    finest = [each for (*_, level), each in found.items() if level == "0"]
    count = sum(len(each.triangles) for each in finest)
    assert 0.95 * expected < count <= expected, "only points within straight lines may be missing"
    for each in found.values():
        assert np.isfinite(each.normals).all()
        assert each.coordinates[1].min() >= -1e-6 and each.coordinates[1].max() <= 1 + 1e-6


@pytest.fixture(scope="module")
def picture() -> np.ndarray:
    return read_image(shipped() / FILE, "RGB")


def test_the_sun_lies_on_the_floor_where_its_rays_come_through_the_windows(picture) -> None:
    lit, unlit = (light_map(picture, "floor", sun).astype(int) for sun in (1.0, 0.0))
    gained = (lit - unlit).max(axis=2)
    place = of_plane("floor")
    far = (plan.INSIDE.east + plan.WALL - place[..., 0]) / SUN[0]
    y, z = far * SUN[1], place[..., 2] + far * SUN[2]
    aside = np.abs(z[..., None] - np.array(plan.ALCOVES)).min(axis=-1)
    low, high = plan.WINDOW_SILL, plan.WINDOW_SPRINGING - 0.05
    half = plan.WINDOW_HALF - plan.WINDOW_SPLAY
    light = (aside > 0.015) & (aside < half - 0.018) & (y > low + 0.05) & (y < high)
    stone = (aside > half + 0.02) | (y > plan.WINDOW_TOP + 0.02) | (y < low - 0.02)
    clear = np.abs(place[..., 0] - plan.ROWS[1]) > 0.05  # of the pillars' feet
    west_of_the_pool = place[..., 0] < 1.43
    assert (gained[light & clear] > 40).mean() > 0.85
    assert (gained[stone] > 12).mean() < 0.002
    assert west_of_the_pool.any()


@pytest.mark.seldom(3, first=1)
def test_a_light_left_out_never_brightens(picture) -> None:
    for sheet in ("floor", "north"):
        everything = light_map(picture, sheet).astype(int)
        for sun, torch in ((0.0, 1.0), (1.0, 0.0), (0.0, 0.0)):
            assert (light_map(picture, sheet, sun, torch) <= everything).all()
        assert (light_map(picture, sheet, 1.0, 0.0) < everything - 2).mean() > 0.2


def test_flames_face_the_eye_and_stand_on_their_torches() -> None:
    eye = np.array([1.6, 0.1, 2.7])
    corners = flames(PLACES, eye, 20.0).reshape(len(PLACES), 4, 5)
    for place, quad in zip(PLACES, corners[..., 2:].astype(float), strict=True):
        across, up = quad[1] - quad[0], quad[3] - quad[0]
        facing = np.cross(across, up)
        assert abs(across @ (place - eye)) < 1e-6 and facing @ (eye - place) > 0
        np.testing.assert_allclose(quad[:2].mean(axis=0)[[0, 2]], place[[0, 2]], atol=1e-6)
        assert quad[0][1] < place[1] < quad[3][1]
    fixed = flames(PLACES, eye, 20.0, faces=False).reshape(len(PLACES), 4, 5)
    assert np.ptp(fixed[0, :, 4]) == 0.0


def test_a_glow_is_parallel_to_the_screen_and_as_strong_as_asked() -> None:
    right, up = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
    found = halos(PLACES, right, up, 20.0, 0.5).reshape(len(PLACES), 4, 8)
    assert (np.ptp(found[:, :, 7], axis=1) == 0).all()
    assert np.abs(found[..., 2:5] / 0.5 - 1).max() <= 0.12 + 1e-6


def test_sheets_of_light_end_on_the_floor_and_have_no_light_at_their_edges() -> None:
    vertices, bright, index = sheets(SUN)
    assert vertices[:, 1].min() == pytest.approx(0.0, abs=1e-6)
    assert (vertices[:, 1] < plan.WINDOW_TOP).all() and index.max() < len(vertices)
    assert bright.min() >= 0.0 and bright.max() <= 1.0
    rows = bright.reshape(-1, 7, 6)
    assert rows[:, [0, -1]].max() < 1e-6 and rows[:, 3].max() > 0.5
    steps = np.diff(vertices.reshape(-1, 7, 6, 3).astype(float), axis=2)
    unit = steps / np.linalg.norm(steps, axis=-1, keepdims=True)
    np.testing.assert_allclose(unit, np.broadcast_to(-SUN, unit.shape), atol=1e-4)
    assert len(sheets(np.array([-0.8, 0.6, 0.0]))[0]) == 0


# ---- in OpenGL --------------------------------------------------------------------------------

FROM_DOOR = Pose(1.6, 0.12, 2.6, 0.0, 4.0)
SHOWN = ("room", "floor", "torches", "shafts")


@pytest.fixture(scope="module")
def opened(the_stage: Stage) -> Iterator[Hall]:
    the_stage.enter()
    with the_stage.borrowed():
        found = Hall(SCENE.settings, Assets(), 0, SHOWN)
    yield found
    the_stage.enter()
    found.release()
    found.release()


def drawn(stage: Stage, opened: Hall, *shown: str, **changed: Any) -> np.ndarray:
    """Return the picture, int64 (h, w, 3), of some elements, with settings changed."""
    values = {name.replace("_", ".", 1): value for name, value in changed.items()}
    assert opened.apply(with_settings(SCENE.settings, values))
    opened.shown = set(shown)
    with stage.borrowed():
        opened.draw(Moment(FROM_DOOR, SIZE, 20.0))
        return stage.read()


@pytest.mark.seldom(7)
def test_flames_and_shafts_add_light_and_their_settings_take_it_away(stage, opened) -> None:
    plain = drawn(stage, opened, "room", "floor")
    air = drawn(stage, opened, "room", "floor", "shafts")
    assert (air >= plain).all() and (air > plain).mean() > 0.1
    off = drawn(stage, opened, "room", "floor", "shafts", shafts_enabled=False)
    np.testing.assert_array_equal(off, plain)
    bare = drawn(stage, opened, "room", "floor", "torches", torches_glow=0.0)
    glowing = drawn(stage, opened, "room", "floor", "torches", torches_glow=0.6)
    assert 0 < (bare != plain).any(axis=2).mean() < (glowing != plain).any(axis=2).mean()
    turned = drawn(stage, opened, "room", "floor", "torches", torches_glow=0.0, torches_faces=False)
    assert (turned != bare).any()


@pytest.mark.seldom(13)
@pytest.mark.parametrize("tolerance", LEVELS)
def test_a_coarser_grid_is_as_near_to_the_finer_one_as_it_should_be(tolerance: float) -> None:
    most = 0.0
    for surface in (each for each in hall() if each.material in SIMPLIFIED):
        for axis in (0, 1):
            kept = needed(surface.points, axis, tolerance)
            assert len(kept) >= 2 and kept[0] == 0 and kept[-1] == surface.points.shape[axis] - 1
            lines, at = np.moveaxis(surface.points, axis, 0), fractions(surface.points, axis)
            for column in lines.reshape(len(lines), -1).T:
                most = max(most, np.abs(np.interp(at, at[kept], column[kept]) - column).max())
    assert most <= tolerance * 1.001


@pytest.mark.seldom(13)
def test_each_level_has_fewer_triangles_than_the_one_before_and_no_ring_becomes_a_line() -> None:
    counts = [0] * len(LEVELS)
    for (_, material, _, level), found in meshes().items():
        if material in SIMPLIFIED:
            counts[int(level)] += len(found.triangles)
    assert all(fewer < 0.85 * more for more, fewer in zip(counts, counts[1:], strict=False))
    ring = turned(0.0, 0.0, [(0.004, 0.1), (0.004, 0.0)], "iron", 10)
    assert 4 <= len(needed(ring.points, 1, LEVELS[-1])) < 10


@pytest.mark.seldom(13)
def test_what_is_longer_than_a_bay_is_in_none_and_each_bay_stays_within_its_ends() -> None:
    for (sheet, _, bay, _), part in meshes().items():
        if sheet == "hall" and bay and int(bay) != ALONG:
            north, south = plan.BAYS[int(bay)], plan.BAYS[int(bay) + 1]
            assert part.vertices[:, 2].min() > north - 0.25, (bay, part.vertices[:, 2].min())
            assert part.vertices[:, 2].max() < south + 0.25, (bay, part.vertices[:, 2].max())
