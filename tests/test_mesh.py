"""Meshes: grids, normals, surfaces of revolution, PLY files, one glDrawElements."""

import math
from pathlib import Path

import numpy as np
import pytest
from stage import Stage, close, small, write_ply

from framelens.base.errors import InputError
from framelens.gl.seam import recording
from landscape.files.meshes import read_colours, read_mesh, read_ply
from landscape.frame import Pose
from landscape.geometry.clustering import clustered
from landscape.geometry.mesh import (
    Mesh,
    centred,
    gathered,
    grid_triangles,
    is_closed,
    merged,
    moved,
    revolve,
    scaled,
    vertex_normals,
)
from landscape.gl.draw import draw_mesh


def test_a_grid_cuts_each_cell_along_its_diagonal() -> None:
    assert grid_triangles(2, 2).tolist() == [[0, 2, 3], [0, 3, 1]]
    triangles = grid_triangles(4, 3)
    assert len(triangles) == 2 * 3 * 2
    assert set(np.unique(triangles)) == set(range(12))
    assert triangles.dtype == np.uint32 and triangles.flags.c_contiguous


def test_a_normal_is_the_mean_of_its_triangles_weighted_by_area() -> None:
    # One triangle of area 2 facing up and one of area 1/2 facing south share vertex 0.
    vertices = np.array([(0, 0, 0), (0, 0, 2), (2, 0, 0), (1, 0, 0), (0, 1, 0)], np.float32)
    triangles = np.array([(0, 1, 2), (0, 3, 4)], np.uint32)
    normals = vertex_normals(vertices, triangles)
    assert normals[1].tolist() == [0, 1, 0]
    assert normals[4].tolist() == [0, 0, 1]
    assert normals[0] == pytest.approx(np.array([0, 4, 1]) / math.sqrt(17))


def test_a_vertex_without_triangles_points_up_and_degenerate_ones_do_no_harm() -> None:
    vertices = np.array([(0, 0, 0), (1, 0, 0), (2, 0, 0), (5, 5, 5)], np.float32)
    normals = vertex_normals(vertices, np.array([(0, 1, 2)], np.uint32))
    assert normals.tolist() == [[0, 1, 0]] * 4


def test_a_cone_has_the_normals_of_a_cone() -> None:
    mesh = revolve([(1.0, 0.0), (0.0, 2.0)], 64, (3, 1))
    lower = mesh.vertices[:, 1] == 0
    angle = np.arctan2(mesh.vertices[lower, 2], mesh.vertices[lower, 0])
    slant = np.array([2.0, 1.0]) / math.sqrt(5)
    wanted = np.stack([slant[0] * np.cos(angle), 0 * angle + slant[1], slant[0] * np.sin(angle)], 1)
    assert np.allclose(mesh.normals[lower], wanted, atol=0.03)
    assert np.allclose(np.linalg.norm(mesh.normals, axis=1), 1.0, atol=1e-5)


def test_a_surface_of_revolution_closes_without_a_seam_in_its_lighting() -> None:
    mesh = revolve([(0.5, 0.0), (0.5, 1.0), (0.7, 1.2)], 10, (4, 2))
    for start in range(0, len(mesh.vertices), 11):
        assert np.allclose(mesh.vertices[start], mesh.vertices[start + 10], atol=1e-6)
        assert (mesh.normals[start] == mesh.normals[start + 10]).all()
    s = mesh.coordinates[0][:, 0]
    assert s.min() == 0.0 and s.max() == 4.0
    assert len(mesh.vertices) == 2 * 2 * 11 and mesh.triangles.max() == 43


def test_a_surface_of_revolution_faces_away_from_its_axis() -> None:
    mesh = revolve([(0.5, 0.0), (0.5, 1.0)], 12, (1, 1))
    outward = mesh.vertices[:, [0, 2]] / 0.5
    # Two triangles lie on one side of a vertex and one on the other: a few degrees to the side.
    assert ((mesh.normals[:, [0, 2]] * outward).sum(axis=1) > math.cos(math.radians(6))).all()
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    face = np.cross(b - a, c - a)
    assert ((face * (a + b + c) * (1, 0, 1)).sum(axis=1) > 0).all()


def test_sorting_keeps_every_triangle_and_brings_neighbours_together() -> None:
    rng = np.random.default_rng(5)
    along = np.linspace(0.0, 1.0, 30)
    x, z = (a.ravel() for a in np.meshgrid(along, along))
    vertices = np.stack([x, np.sin(5 * x) * z, z], axis=1).astype(np.float32)
    shuffled = rng.permutation(len(vertices))
    place = np.argsort(shuffled).astype(np.uint32)
    triangles = rng.permutation(place[grid_triangles(30, 30)])
    colors = (vertices * 200).astype(np.uint8)
    mesh = Mesh(
        vertices[shuffled],
        vertices[shuffled] + 1,
        triangles,
        (vertices[shuffled, :2],),
        np.insert(colors[shuffled], 3, 255, axis=1),
    )
    tidy = gathered(mesh)

    def corners(m: Mesh) -> set[bytes]:
        assert m.colors is not None
        return {
            b"".join(
                part[t].tobytes() for part in (m.vertices, m.normals, *m.coordinates, m.colors)
            )
            for t in m.triangles
        }

    assert corners(tidy) == corners(mesh) and len(tidy.triangles) == len(mesh.triangles)

    def apart(m: Mesh) -> float:
        return float(np.ptp(m.triangles.astype(int), axis=1).mean())

    assert apart(tidy) < 0.2 * apart(mesh)
    assert tidy.triangles.dtype == np.uint32


def test_centring_fills_minus_1_to_1_along_the_largest_side() -> None:
    vertices = centred(np.array([(2, 10, 5), (4, 16, 5), (3, 12, 5)], np.float32))
    assert vertices[0] == pytest.approx([-1 / 3, -1.0, 0.0])
    assert vertices[1] == pytest.approx([1 / 3, 1.0, 0.0])
    assert centred(np.ones((3, 3), np.float32)).tolist() == [[0, 0, 0]] * 3


def test_a_ply_keeps_its_vertices_order_and_cuts_quads_in_two(tmp_path) -> None:
    vertices = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0.5)])
    path = write_ply(tmp_path / "quad.ply", vertices, np.array([(0, 1, 2, 3)]))
    read, triangles = read_ply(path)
    assert np.allclose(read, vertices) and read.dtype == np.float32
    assert sorted(sorted(t) for t in triangles.tolist()) in (
        [[0, 1, 2], [0, 2, 3]],
        [[0, 1, 3], [1, 2, 3]],
    )


def test_a_mesh_is_sent_by_one_draw_call_where_its_vertices_are(stage: Stage) -> None:
    vertices = np.array([(-1, -1, -2), (1, -1, -2), (1, 1, -2), (-1, 1, -2)], np.float32)
    normals = np.tile(np.array([0, 0, 1], np.float32), (4, 1))
    mesh = Mesh(vertices, normals, np.array([(0, 1, 2), (0, 2, 3)], np.uint32))
    with stage.frame(small(), Pose(0.0, 0.0, 0.0)):
        with recording() as recorder:
            draw_mesh(mesh)
        picture = stage.read()
    draws = [call for call in recorder.calls if call.name.startswith("glDraw")]
    assert [call.name for call in draws] == ["glDrawElements"]
    # 1 unit at distance 2 is 60 / (2 tan 30) = 51.96 pixels.
    white = (picture == 255).all(axis=2)
    assert white.any(axis=0).sum() == 104 and white.any(axis=1).sum() == 104
    assert close(picture[2, 2], np.array([0.4, 0.6, 0.7]) * 255)


@pytest.mark.parametrize("ending", ["obj", "stl", "off", "glb"])
@pytest.mark.sweep(12, first=5)
def test_other_formats_are_read_through_trimesh(tmp_path: Path, ending: str) -> None:
    import trimesh

    box = trimesh.creation.box((2.0, 4.0, 6.0))
    path = tmp_path / f"box.{ending}"
    box.export(path)
    vertices, triangles = read_mesh(path)
    assert len(triangles) == 12 and triangles.dtype == np.uint32
    assert vertices.dtype == np.float32
    assert np.allclose(vertices.max(axis=0), (1, 2, 3)) and triangles.max() < len(vertices)


@pytest.mark.seldom(13, first=8)
def test_a_damaged_mesh_of_another_format_names_its_file(tmp_path: Path) -> None:
    path = tmp_path / "bad.glb"
    path.write_bytes(b"no mesh at all")
    with pytest.raises(InputError, match=r"bad\.glb: expected a"):
        read_mesh(path)


COLOURED = """ply
format ascii 1.0
element vertex 3
property float x
property uchar red
property float y
property uchar green
property uchar blue
property float z
element face 1
property list uchar int vertex_indices
end_header
0 255 0 0 10 0
1 0 0 128 20 0
0 7 1 8 9 0
3 0 1 2
"""


def test_colours_of_vertices_are_read_from_a_ply_that_has_them(tmp_path: Path) -> None:
    path = tmp_path / "coloured.ply"
    path.write_text(COLOURED)
    colours = read_colours(path)
    assert colours is not None and colours.dtype == np.uint8
    assert colours.tolist() == [[255, 0, 10], [0, 128, 20], [7, 8, 9]]
    assert read_mesh(path)[0][1].tolist() == [1, 0, 0]
    bare = COLOURED.replace("property uchar blue", "property uchar alpha")
    path.write_text(bare)
    assert read_colours(path) is None
    assert read_colours(tmp_path / "other.obj") is None


def test_damaged_vertex_colours_are_refused_by_file_name(tmp_path: Path) -> None:
    path = tmp_path / "cut.ply"
    path.write_text(COLOURED[:-20])
    with pytest.raises(InputError, match=r"cut\.ply: expected a whole PLY"):
        read_colours(path)


def sphere(rings: int = 40) -> Mesh:
    """A closed ball of radius 1."""
    import trimesh

    ball = trimesh.creation.uv_sphere(count=(rings, rings))
    vertices = np.ascontiguousarray(ball.vertices, np.float32)
    triangles = np.ascontiguousarray(ball.faces, np.uint32)
    colors = np.full((len(vertices), 4), (10, 200, 30, 255), np.uint8)
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles, (), colors)


@pytest.mark.parametrize("cube", [0.05, 0.2])
@pytest.mark.sweep(4)
def test_vertex_clustering_moves_the_surface_by_less_than_a_cube(cube: float) -> None:
    fine = sphere()
    coarse = clustered(fine, cube)
    assert len(coarse.vertices) < len(fine.vertices)
    assert coarse.triangles.max() < len(coarse.vertices)
    assert (np.abs(np.linalg.norm(coarse.vertices, axis=1) - 1) < cube).all()
    assert np.allclose(np.linalg.norm(coarse.normals, axis=1), 1.0, atol=1e-5)
    assert coarse.colors is not None and (coarse.colors == (10, 200, 30, 255)).all()
    a, b, c = coarse.triangles.T
    assert (a != b).all() and (b != c).all() and (c != a).all()
    # Every vertex of the fine mesh lies near one of the coarse.
    apart = np.linalg.norm(fine.vertices[:, None] - coarse.vertices[None], axis=2).min(axis=1)
    assert apart.max() <= cube * np.sqrt(3)


def test_a_mesh_is_closed_if_each_edge_has_its_opposite() -> None:
    faces = sphere(12).triangles
    assert is_closed(faces)
    assert not is_closed(faces[1:])
    turned = faces.copy()
    turned[0] = turned[0, ::-1]
    assert not is_closed(turned)
    assert not is_closed(np.concatenate([faces, faces[:1]]))


def test_merging_appends_vertices_and_moves_the_indices() -> None:
    vertices = np.eye(3, dtype=np.float32)
    triangle = np.array([(0, 1, 2)], np.uint32)
    one = Mesh(vertices, vertex_normals(vertices, triangle), triangle, (vertices[:, :2],))
    both = merged([one, one])
    assert both.triangles.tolist() == [[0, 1, 2], [3, 4, 5]] and len(both.vertices) == 6
    assert both.colors is None


def test_a_mesh_is_moved_and_scaled_by_its_vertices_alone() -> None:
    ball = sphere(8)
    there, twice = moved(ball, 3.0, -2.0), scaled(ball, 2.0)
    assert np.allclose(there.vertices - ball.vertices, (3.0, 0.0, -2.0), atol=1e-6)
    assert np.array_equal(twice.vertices, 2 * ball.vertices)
    for mesh in (there, twice):
        assert mesh.normals is ball.normals and mesh.triangles is ball.triangles
        assert mesh.vertices.dtype == np.float32
