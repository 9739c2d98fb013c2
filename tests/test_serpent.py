"""The dragon of the preset best: a mesh with a skin of its own, and membranes."""

from pathlib import Path

import numpy as np
import pytest
from animals import LIT
from stage import Stage, small, write_ply

from framelens.gl.seam import gl
from framelens.gl.state import attrib
from landscape.elements.best.animals.fine_dragon import FineDragon
from landscape.elements.best.animals.membranes import lit_through
from landscape.elements.best.animals.serpent_skin import (
    HEIGHT,
    SPAN,
    WIDTH,
    Strip,
    laid,
    scattered,
    serpent_skin,
    strip_of,
)
from landscape.elements.best.animals.skinned import read_skinned, sewn
from landscape.files.assets import Assets
from landscape.files.meshes import read_looks
from landscape.frame import Pose
from landscape.geometry.clustering import clustered
from landscape.geometry.mesh import Mesh, grid_triangles

SKY = (0.4, 0.6, 0.7)
SKIN = {"dragon.painted": True, "dragon.scaly": True}


@pytest.fixture(scope="module")
def skin() -> np.ndarray:
    return serpent_skin()


# ---- the mesh ---------------------------------------------------------------------------------


def test_the_shipped_serpent_is_closed_but_for_the_cuts_of_its_charts(shipped: Assets) -> None:
    found = read_skinned(shipped, "serpent.ply", "key")
    assert found is not None and found.closed
    assert len(found.flesh.triangles) > 20 * len(found.membranes.triangles) > 20_000
    # Cut: some vertices are there twice. What is there twice has one normal.
    places, own, count = np.unique(
        found.flesh.vertices, axis=0, return_inverse=True, return_counts=True
    )
    assert 100 < (count > 1).sum() < len(places) / 4
    spread = np.ptp(found.flesh.normals[np.argsort(own.reshape(-1), kind="stable")], axis=0)
    assert (spread > 1.9).all()
    first = np.zeros(len(places), int)
    first[own.reshape(-1)[::-1]] = np.arange(len(own))[::-1]
    assert np.allclose(found.flesh.normals, found.flesh.normals[first[own.reshape(-1)]])


def test_a_cut_sheet_has_the_normals_of_a_whole_one_and_its_open_edge_is_found() -> None:
    # A tent of two faces, cut along the ridge.
    tent = np.array([(0, 1, 0), (0, 1, 1), (-1, 0, 0), (0, 1, 0), (0, 1, 1), (1, 0, 0)], np.float32)
    normals, closed = sewn(tent, np.array([(0, 2, 1), (3, 4, 5)]))
    assert np.allclose(normals[0], normals[3]) and not closed
    assert abs(normals[0][0]) < 0.2 < abs(normals[2][0])


def test_a_mesh_without_looks_has_no_skin_of_its_own(tmp_path: Path) -> None:
    corners = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], float)
    path = write_ply(tmp_path / "plain.ply", corners, np.array([(0, 1, 2)]))
    assert read_looks(path) is None
    assert read_looks(tmp_path / "other.obj") is None
    assert read_skinned(Assets(tmp_path), "plain.ply", "key") is None


def test_vertices_of_two_charts_in_a_cube_keep_their_own_coordinates_at_one_place() -> None:
    x, z = np.meshgrid(np.arange(6) / 5, np.arange(6) / 5)
    places = np.stack([x, 0 * x, z], axis=-1).reshape(-1, 3).astype(np.float32)
    places += np.float32(1e-3)
    left = grid_triangles(6, 6)
    two = np.concatenate([places, places])
    charts = np.repeat([0, 1], 36)
    coordinates = np.stack([np.repeat([0.1, 0.9], 36), np.zeros(72)], axis=1).astype(np.float32)
    up = np.tile(np.array([0, 1, 0], np.float32), (72, 1))
    triangles = np.concatenate([left, left + 36]).astype(np.uint32)
    found = clustered(Mesh(two, up, triangles, (coordinates,)), 0.5, charts)
    s = found.coordinates[0][:, 0]
    assert set(np.round(s, 3)) == {np.float32(0.1), np.float32(0.9)}, "no mean of two charts"
    one, other = (found.vertices[np.isclose(s, value)] for value in (0.1, 0.9))
    assert len(one) == len(other) < 36 and np.allclose(np.sort(one, 0), np.sort(other, 0))
    assert clustered(Mesh(two, up, triangles, (coordinates,)), 0.5).coordinates == ()


# ---- the texture ------------------------------------------------------------------------------


def test_places_in_a_strip_are_found_in_it_again() -> None:
    across = np.linspace(0.0, 1.0, 50)
    for strip in (Strip.BODY, Strip.HEAD, Strip.FIN):
        at = laid(np.full(50, strip), np.stack([across, across], axis=1))
        assert (strip_of(at) == strip).all()
    for strip in (Strip.EYE, Strip.PLAIN):
        at = laid(np.full(50, strip), np.stack([2 * across - 1, across], axis=1))
        assert (strip_of(at) == strip).all()


def test_the_skin_goes_on_at_its_end_as_it_begins(skin: np.ndarray) -> None:
    assert skin.shape == (HEIGHT, WIDTH, 4) and skin.dtype == np.uint8
    rows = slice(*SPAN[Strip.BODY])
    body = skin[rows].astype(float)
    steps = np.abs(np.diff(body, axis=1)).mean(axis=(0, 2))
    assert np.abs(body[:, 0] - body[:, -1]).mean() < steps.max()


def test_scales_mirror_more_than_what_is_between_them() -> None:
    relief, number = scattered(np.random.default_rng(1), 120, 512, 24, 8)
    assert relief.min() >= 0.0 and relief.max() <= 1.1
    assert len(np.unique(number)) > 150
    # It rises towards the tail: brighter columns come before darker ones within a scale.
    middle = relief[30:90]
    steps = np.diff(middle, axis=1)
    assert (steps < 0).mean() > (steps > 0).mean()


def test_shiny_texels_of_the_body_are_the_bright_ones(skin: np.ndarray) -> None:
    body = skin[slice(*SPAN[Strip.BODY])].astype(float)
    bright, mirrors = body[..., :3].mean(axis=2), body[..., 3]
    dark = bright < np.quantile(bright, 0.1)
    assert mirrors[dark].mean() < 0.6 * mirrors[~dark].mean()
    assert mirrors.max() > 200 > 110 > np.median(mirrors), "few texels mirror much"


def test_a_fin_is_solid_at_its_root_thinner_farther_out_and_ragged_at_its_edge(
    skin: np.ndarray,
) -> None:
    first, last = SPAN[Strip.FIN]
    fin = skin[first:last].astype(float)
    height = last - first
    part = [fin[int(share * height), :, 3].mean() for share in (0.05, 0.45, 0.7, 0.995)]
    assert part[0] > 250 > part[1] > part[2] > part[3] and part[3] < 60
    light = fin[..., :3].mean(axis=2)
    assert light[: height // 5].mean() < 0.6 * light[height // 2 : 3 * height // 4].mean()
    ends = (fin[..., 3] > 64).sum(axis=0)
    assert np.ptp(ends) > 0.2 * height


# ---- what is drawn ----------------------------------------------------------------------------


def test_light_comes_through_a_membrane_from_either_side() -> None:
    towards = np.array([0.6, 0.8, 0.0])
    one = np.array([(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0)])
    found = lit_through(one, towards)
    assert np.allclose(found[0], found[1]) and (found @ towards > 0.2).all()
    assert np.allclose(np.linalg.norm(found, axis=1), 1.0)


def drawn(
    stage: Stage, assets: Assets, behind: tuple[float, float, float] = SKY, **more: object
) -> tuple[np.ndarray, np.ndarray]:
    """Return pictures of the dragon before a colour, without its membranes, and with them."""
    settings = small({**LIT, **SKIN, **more})
    dragon = FineDragon(settings, assets)
    with stage.frame(settings, Pose(20.0, 0.7, 21.3, 0.0, 0.0)) as frame:
        with attrib(gl.GL_COLOR_BUFFER_BIT):
            gl.glClearColor(*behind, 1.0)
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        dragon.draw(frame)
        bare = stage.read()
        dragon.draw_membranes(frame)
        whole = stage.read()
    dragon.release()
    return bare, whole


def test_membranes_are_blended_over_what_is_behind_the_fins(stage: Stage, shipped: Assets) -> None:
    bare, whole = drawn(stage, shipped, **{"dragon.mesh": "serpent.ply"})
    changed = (bare != whole).any(axis=2)
    assert 200 < changed.sum() < 0.3 * changed.size
    before = np.abs(bare[changed] - 255 * np.array(SKY)).max(axis=1) < 4
    assert before.mean() > 0.3, "most of a fin stands before the sky"
    assert whole[changed][before].mean() < bare[changed][before].mean() - 20

    black = (0.0, 0.0, 0.0)
    _, night = drawn(stage, shipped, black, **{"dragon.mesh": "serpent.ply"})
    through = (whole - night)[changed][before]
    assert 5 < np.median(through) < 100, "some of what is behind shows"


def test_another_mesh_has_no_membranes(stage: Stage, shipped: Assets) -> None:
    bare, whole = drawn(stage, shipped, **{"dragon.mesh": "dragon.ply"})
    assert (bare == whole).all()


@pytest.mark.parametrize("key", ["dragon.scaly", "dragon.painted"])
def test_the_serpent_without_its_skin_is_a_mesh_like_any_other(
    stage: Stage, shipped: Assets, key: str
) -> None:
    bare, whole = drawn(stage, shipped, **{"dragon.mesh": "serpent.ply", key: False})
    assert (bare == whole).all() and len(np.unique(bare.reshape(-1, 3), axis=0)) > 50
