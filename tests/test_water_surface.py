"""The water: waves by the report's formulas, patches that match, blending over a known colour."""

import math

import numpy as np
import pytest
from stage import WHITE_LIGHT, Stage, close, pixel, project, small, taken

from landscape.elements.water_surface import (
    PATCHES,
    WaterSurface,
    patch_plane,
    wave_coordinates,
    wave_normals,
)
from landscape.files.assets import Assets
from landscape.frame import Pose

BACKGROUND = np.array([0.4, 0.6, 0.7]) * 255
DOWN = Pose(20.0, 6.0, 20.0, 0.0, -90.0)
TIMES = (0.0, 0.37, 2.0, 91.3)


def test_a_patch_has_px_running_fastest_from_0_to_1() -> None:
    plane = patch_plane(40)
    assert plane.shape == (2, 1600)
    assert plane[:, 0].tolist() == [0.0, 0.0]
    assert plane[:, 39].tolist() == [1.0, 0.0]
    assert plane[:, 40].tolist() == pytest.approx([0.0, 1 / 39])
    assert plane[:, -1].tolist() == [1.0, 1.0]


def test_the_normals_at_time_0_are_those_computed_by_hand() -> None:
    # sin(-pi/2)^2 = 1 at a quarter of the patch, 0 at its corner and middle.
    plane = np.array([[0.0, 0.25, 0.25, 0.5], [0.0, 0.0, 0.25, 0.25]])
    length = math.sqrt(0.25**2 + 1 + 0.5**2)
    wanted = [
        (0.0, 1.0, 0.0),
        (0.0, 1 / math.sqrt(1.25), 0.5 / math.sqrt(1.25)),
        (0.25 / length, 1 / length, 0.5 / length),
        (0.25 / math.sqrt(1.0625), 1 / math.sqrt(1.0625), 0.0),
    ]
    assert np.allclose(wave_normals(plane, 0.0), wanted, atol=1e-6)


def test_normals_and_coordinates_follow_the_report_at_any_time() -> None:
    px = 0.3
    py = 0.7
    t = 1.9
    repeat = 4.0
    x = 0.25 * math.sin(2 * t - 2 * math.pi * py) ** 2
    z = 0.5 * math.sin(3 * t - 2 * math.pi * px) ** 2
    length = math.sqrt(x * x + 1 + z * z)
    plane = np.array([[px], [py]])
    assert wave_normals(plane, t)[0] == pytest.approx([x / length, 1 / length, z / length])
    a = 10 * t - 6 * math.pi * px
    b = 10 * t - 6 * math.pi * py
    s = px + 0.01 * math.cos(a) + 0.1 * math.cos(2 * t - 2 * math.pi * py)
    r = py + 0.01 * math.cos(b) + 0.05 * math.cos(8 * t - 2 * math.pi * py)
    assert wave_coordinates(plane, t, repeat)[0] == pytest.approx([repeat * s, repeat * r])


@pytest.mark.parametrize("t", TIMES)
def test_normals_have_length_one(t: float) -> None:
    normals = wave_normals(patch_plane(40), t)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-6)
    assert normals.dtype == np.float32 and (normals[:, 1] > 0.8).all()


@pytest.mark.parametrize("t", TIMES)
def test_a_patch_matches_its_neighbours_on_both_sides(t: float) -> None:
    normals = wave_normals(patch_plane(40), t).reshape(40, 40, 3)
    assert np.allclose(normals[:, 0], normals[:, -1], atol=1e-5)
    assert np.allclose(normals[0], normals[-1], atol=1e-5)
    coordinates = wave_coordinates(patch_plane(40), t, 4.0).reshape(40, 40, 2)
    # A whole number of textures farther: the same texel.
    assert np.allclose(coordinates[:, -1] - coordinates[:, 0], (4.0, 0.0), atol=1e-4)
    assert np.allclose(coordinates[-1] - coordinates[0], (0.0, 4.0), atol=1e-4)


@pytest.fixture
def blended(stage: Stage, plain: Assets):
    """Return a function: settings to the picture of the water from above."""

    def draw(changes, pose: Pose = DOWN, kt: float = 0.0) -> np.ndarray:
        settings = small(changes)
        water = WaterSurface(settings, plain)
        with stage.frame(settings, pose, kt) as frame:
            water.draw(frame)
            picture = stage.read()
        water.release()
        return picture

    return draw


def test_bare_water_is_seven_tenths_its_colour_and_three_tenths_what_lies_under(blended) -> None:
    picture = blended({**WHITE_LIGHT, "water.textured": False})
    wanted = 0.7 * np.array([0.2, 0.2, 0.4]) * 255 + 0.3 * BACKGROUND
    assert close(picture[10:110, 10:150], wanted)


def test_the_texture_multiplies_the_colour(blended) -> None:
    picture = blended(WHITE_LIGHT)
    texture = np.array([128, 64, 255])
    wanted = 0.7 * np.array([0.2, 0.2, 0.4]) * texture + 0.3 * BACKGROUND
    assert close(picture[10:110, 10:150], wanted)


def test_the_sun_overhead_lights_each_wave_by_its_normal(blended) -> None:
    changes = {
        "sun.elevation": 90.0,
        "sun.ambient": (0.0, 0.0, 0.0),
        "sun.diffuse": (1.0, 1.0, 1.0),
        "water.textured": False,
        "water.animated": False,
        "water.color": (0.8, 0.8, 0.8, 1.0),
        "water.points": 41,
    }
    picture = blended(changes, kt=77.0)
    steep = 1 / math.sqrt(1 + 0.25**2 + 0.5**2)
    for x, z, cosine in ((20.0, 20.0, 1.0), (22.5, 22.5, steep), (17.5, 18.75, None)):
        if cosine is None:
            across = 0.25 * math.sin(2 * math.pi * 0.875) ** 2
            cosine = 1 / math.sqrt(1 + across**2 + 0.5**2)
        got = pixel(picture, project(DOWN, (x, 0.6, z)))
        assert close(got, 0.8 * 255 * cosine, 1.5), (x, z)


def test_the_surface_spans_five_by_five_patches_at_the_water_level(blended) -> None:
    pose = Pose(15.0, 70.6, 15.0, 0.0, -90.0)
    picture = blended({**WHITE_LIGHT, "water.color": (1.0, 0.0, 0.0, 1.0)}, pose)
    low, high = PATCHES[0] * 10.0, (PATCHES[-1] + 1) * 10.0
    assert (low, high) == (-10.0, 40.0)
    red = close_mask(picture, (128, 0, 0))
    left, top = project(pose, (low, 0.6, low))
    right, bottom = project(pose, (high, 0.6, high))
    assert np.flatnonzero(red.any(axis=0))[[0, -1]] == pytest.approx([left, right - 1], abs=1)
    assert np.flatnonzero(red.any(axis=1))[[0, -1]] == pytest.approx([top, bottom - 1], abs=1)


def close_mask(picture: np.ndarray, colour: tuple[int, ...]) -> np.ndarray:
    return (np.abs(picture - np.array(colour)) <= 2).all(axis=2)


def test_the_picture_moves_with_kt_only_when_animated(blended, stage: Stage) -> None:
    still = {"water.animated": False}
    assert (blended(still, kt=0) == blended(still, kt=50)).all()
    assert (blended({}, kt=0) != blended({}, kt=50)).any()


def test_new_settings_are_drawn_as_if_built_from_them(stage: Stage, plain: Assets, blended) -> None:
    changes = {**WHITE_LIGHT, "water.color": (0.9, 0.5, 0.1, 0.6), "water.repeat": 2.0}
    changes |= {"water.time_step": 0.05, "water.textured": False}
    water = WaterSurface(small(), plain)
    assert taken(water, small(changes))
    with stage.frame(small(changes), DOWN, 30.0) as frame:
        water.draw(frame)
        picture = stage.read()
    water.release()
    assert (picture == blended(changes, kt=30.0)).all()
    assert (picture != blended({}, kt=30.0)).any()


@pytest.mark.parametrize(
    "change",
    [
        {"water.points": 20},
        {"water.patch": 5.0},
        {"water.level": 0.7},
        {"water.trilinear": False},
        {"water.lod_bias": -1.0},
    ],
    ids=lambda change: next(iter(change)),
)
def test_settings_of_the_patch_itself_are_refused_and_change_nothing(
    stage: Stage, plain: Assets, blended, change: dict
) -> None:
    water = WaterSurface(small(), plain)
    assert not taken(water, small({**change, "water.color": (1.0, 0.0, 0.0, 1.0)}))
    with stage.frame(small(), DOWN) as frame:
        water.draw(frame)
        picture = stage.read()
    water.release()
    assert (picture == blended({})).all()
