"""The voxel island's highlights: what they add, where, and in which direction."""

from typing import Any

import numpy as np
import pytest

from landscape.gl.cube_map import face_directions
from landscape.offscreen import Offscreen
from landscape.voxel.faces import DIRECTIONS
from landscape.voxel.highlights import GLOSS, NORMALS, SHARP, TEXELS, glossy, sun_faces

SMALL = {"voxel.regions": 4, "voxel.region_size": 20, "fog.enabled": False, "voxel.near": 30.0}
SMALL |= {"sun.azimuth": 180.0, "sun.elevation": 40.0}
SUNWARDS = (3.2, 2.4, 2.0, 180.0, -40.0)


def drawn(strength: float, pose: tuple[float, ...] = SUNWARDS, **more: Any) -> np.ndarray:
    given = (
        SMALL | {"voxel.highlights": strength} | {k.replace("__", "."): v for k, v in more.items()}
    )
    with Offscreen((96, 72), samples=0, place="voxel", settings=given, only=("land",)) as view:
        view.look(pose)
        return view.draw().astype(int)


def test_the_cube_map_holds_a_sun_that_falls_off_by_a_power() -> None:
    towards = np.array([0.0, 0.6, 0.8])
    faces = sun_faces(towards, np.array([1.0, 0.5, 0.25]), 1.0)
    cosine = np.maximum(face_directions(TEXELS) @ towards, 0.0)
    assert faces[..., 0] == pytest.approx(255 * cosine**SHARP, abs=0.6)
    assert faces[..., 1].max() == pytest.approx(127, abs=2)
    assert not faces[cosine == 0.0].any()


def test_normals_look_as_the_directions_are_called() -> None:
    names = {each.name: NORMALS[k].tolist() for k, each in enumerate(DIRECTIONS)}
    assert names["up"] == [0, 1, 0] and names["east"] == [1, 0, 0] and names["south"] == [0, 0, 1]
    assert names["north"] == [0, 0, -1]


def test_a_glossy_tile_is_grey_and_as_bright_as_its_gloss() -> None:
    white = np.full((4, 4, 3), 255, np.uint8)
    assert (glossy(white, 0.5)[..., :3] == 128).all() and (glossy(white, 0.5)[..., 3] == 255).all()
    assert not glossy(white, 0.0)[..., :3].any()
    holed = np.dstack([white, np.zeros((4, 4), np.uint8)])
    assert not glossy(holed, 1.0)[..., 3].any()
    assert max(GLOSS.values()) <= 1.0


@pytest.mark.seldom(13, first=9)
def test_highlights_only_add_light_and_only_where_the_sun_is_mirrored() -> None:
    off, on, twice = (drawn(strength) for strength in (0.0, 1.0, 2.0))
    assert (on >= off).all() and (on - off).max() > 4
    assert (twice - off).sum() > 1.5 * (on - off).sum()
    away = (3.2, 2.4, 4.0, 0.0, -40.0)
    assert (drawn(2.0, away) - drawn(0.0, away)).sum() < 0.2 * (twice - off).sum()


@pytest.mark.seldom(14, first=9)
def test_there_are_no_highlights_in_shadow() -> None:
    size = {"shadow__size": 1024, "shadow__distance": 8.0}
    lit = drawn(2.0, shadow__enabled=False) - drawn(0.0, shadow__enabled=False)
    shaded = drawn(2.0, shadow__color=(0.0, 0.0, 0.0), **size)
    dark = drawn(0.0, shadow__color=(0.0, 0.0, 0.0), **size).max(axis=-1) == 0
    assert lit[dark].sum() > 0
    assert shaded[dark].max() <= 2
