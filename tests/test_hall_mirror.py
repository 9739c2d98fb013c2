"""The polished floor: a mirrored camera sees the same, and each safeguard prevents its artefact."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from hall_pictures import HallPictures
from stage import SIZE, Stage

from framelens.gl.seam import gl, recording
from framelens.tape.buffers import Buffers
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.hall import plan
from landscape.hall.hall import SCENE, Hall
from landscape.hall.mirror import FADES, FLOOR, GRAZING, UNDERSIDE, fading, reflectance
from landscape.scene.scene import Moment
from landscape.settings.declare import with_settings

PERFECT: dict[str, Any] = {"mirror.strength": 1.0, "mirror.fades": False}
NAVE = Pose(1.52, 0.17, 1.78, 12.0, -14.0)  # the floor before the statue
OVER_POOL = Pose(1.6, 0.3, 2.62, 0.0, -35.0)
OUTSIDE = Pose(-0.4, 0.9, 1.6, 90.0, -25.0)
BELOW = Pose(1.6, -0.3, 1.6, 0.0, 40.0)
STONE = ("room", "floor", "mirror")


@pytest.fixture(scope="module")
def halls(the_stage: Stage) -> Iterator[dict[Any, Hall]]:
    """The halls opened so far, by their settings and elements."""
    kept: dict[Any, Hall] = {}
    yield kept
    the_stage.enter()
    for hall in kept.values():
        hall.release()


def drawn(
    stage: Stage,
    halls: dict[Any, Hall],
    pose: Pose,
    changed: dict[str, Any] | None = None,
    only: tuple[str, ...] = (*STONE, "statue"),
) -> tuple[np.ndarray, np.ndarray]:
    """Return the picture, int64 (h, w, 3), and where the floor is marked, bool (h, w)."""
    settings = with_settings(SCENE.settings, {**PERFECT, **(changed or {})})
    hall = halls.get(only)
    with stage.borrowed():
        if hall is None or not hall.apply(settings):
            hall = halls[only] = Hall(settings, Assets(), 0, only)
        hall.draw(Moment(pose, SIZE))
        stencil = Buffers.read(SIZE).stencil
        assert stencil is not None
        return stage.read(), stencil[::-1] & FLOOR == FLOOR


def floor_seen(pose: Pose, fov: float) -> np.ndarray:
    """Return where a line of sight meets the floor's plane on the floor itself, bool (h, w)."""
    width, height = SIZE
    focal = height / 2 / math.tan(math.radians(fov) / 2)
    column, row = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    across, up = (column - width / 2) / focal, (height / 2 - row) / focal
    yaw, pitch = math.radians(pose.yaw), math.radians(pose.pitch)
    ahead = math.cos(pitch) - up * math.sin(pitch)
    rise = math.sin(pitch) + up * math.cos(pitch)
    x = across * math.cos(yaw) + ahead * math.sin(yaw)
    z = across * math.sin(yaw) - ahead * math.cos(yaw)
    assert pose.y is not None
    reach = np.where(rise < 0, -pose.y / np.minimum(rise, -1e-9), np.nan)
    x, z = pose.x + reach * x, pose.z + reach * z

    def inside(area: plan.Rectangle) -> np.ndarray:
        return np.asarray((x > area.west) & (x < area.east) & (z > area.north) & (z < area.south))

    return inside(plan.INSIDE) & ~inside(plan.POOL)


def smooth(picture: np.ndarray, most: int = 12) -> np.ndarray:
    """Return the pixels, bool (h, w), that differ from their neighbours by at most ``most``."""
    height, width = picture.shape[:2]
    around = np.pad(picture, ((1, 1), (1, 1), (0, 0)), mode="edge")
    shifted = [around[r : r + height, c : c + width] for r in range(3) for c in range(3)]
    span = np.max(shifted, axis=0) - np.min(shifted, axis=0)
    return np.asarray(span.max(axis=2) <= most)


def difference(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return by how many levels two pictures differ, (h, w)."""
    return np.asarray(np.abs(one - other).max(axis=2))


@pytest.mark.seldom(7, first=3)
def test_the_mirror_image_is_what_a_camera_mirrored_at_the_floor_sees(stage, halls) -> None:
    assert NAVE.y is not None
    image, floor = drawn(stage, halls, NAVE, only=STONE)
    below = Pose(NAVE.x, -NAVE.y, NAVE.z, NAVE.yaw, -NAVE.pitch)
    mirrored, _ = drawn(stage, halls, below, only=("room",))
    mirrored = mirrored[::-1]
    inner = floor & smooth(mirrored)
    assert inner.sum() > 2000
    levels = difference(image, mirrored)[inner]
    # Where a texture's mip level changes, a rounding decides which of two is sampled.
    assert (levels > 1).mean() < 0.001 and levels.max() <= 4


@pytest.mark.seldom(13, first=6)
def test_the_statue_s_image_differs_from_its_mirrored_view_only_by_its_coarser_mesh(
    stage, halls
) -> None:
    assert NAVE.y is not None
    bronze = {"statue.environment": "none"}  # a sphere map is made for one line of sight
    image, floor = drawn(stage, halls, NAVE, bronze)
    below = Pose(NAVE.x, -NAVE.y, NAVE.z, NAVE.yaw, -NAVE.pitch)
    mirrored, _ = drawn(stage, halls, below, bronze, ("room", "statue"))
    assert np.percentile(difference(image, mirrored[::-1])[floor], 97) <= 12


def test_the_floor_is_marked_where_lines_of_sight_meet_it(stage, halls) -> None:
    fov = SCENE.settings.camera.fov
    for pose in (NAVE, OVER_POOL):
        _, floor = drawn(stage, halls, pose, only=("floor", "mirror", "room"))
        expected = floor_seen(pose, fov)
        assert not (floor & ~expected).sum() > 8, "marked beyond the floor"
        assert (floor & expected).sum() > 0.7 * expected.sum(), "pillars and plinth hide the rest"


def test_the_reflectance_grows_from_the_strength_to_that_along_the_floor() -> None:
    found = reflectance(0.3, np.array([0.0, 1.0, 10.0, 1e9]))
    assert found[0] == pytest.approx(0.3) and found[-1] == pytest.approx(GRAZING)
    assert (np.diff(found) > 0).all()
    assert reflectance(1.0, np.array([0.0, 5.0])).tolist() == [1.0, 1.0]


@pytest.mark.parametrize("fresnel", [False, True])
def test_the_floor_is_blended_over_its_image_by_the_reflectance(stage, halls, fresnel) -> None:
    strength = 0.4
    image, floor = drawn(stage, halls, NAVE, {"mirror.fresnel": False}, STONE)
    changed = {"mirror.strength": strength, "mirror.fresnel": fresnel}
    plain, _ = drawn(stage, halls, NAVE, {"mirror.enabled": False}, STONE)
    mixed, _ = drawn(stage, halls, NAVE, changed, STONE)
    for column, row in ((80, 90), (20, 105), (80, 115)):
        assert floor[row, column]
        across, up = np.array([column + 0.5 - SIZE[0] / 2, SIZE[1] / 2 - row - 0.5]) / (
            SIZE[1] / 2 / math.tan(math.radians(SCENE.settings.camera.fov / 2))
        )
        pitch = math.radians(NAVE.pitch)
        down = -(math.sin(pitch) + up * math.cos(pitch))
        level = math.hypot(across, math.cos(pitch) - up * math.sin(pitch))
        share = float(reflectance(strength, level / down)) if fresnel else strength
        expected = plain[row, column] * (1 - share) + image[row, column] * share
        assert np.abs(mixed[row, column] - expected).max() <= 2, (column, row)


@pytest.mark.seldom(3, first=2)
def test_without_the_stencil_the_image_hangs_out_beyond_the_floor(stage, halls) -> None:
    on, _ = drawn(stage, halls, OUTSIDE)
    off, _ = drawn(stage, halls, OUTSIDE, {"mirror.stencil": False})
    beyond = ~floor_seen(OUTSIDE, SCENE.settings.camera.fov)
    assert (difference(on, off) > 20)[beyond].sum() > 500


def test_without_swapped_winding_the_near_sides_are_missing_in_the_image(stage, halls) -> None:
    on, floor = drawn(stage, halls, NAVE)
    off, _ = drawn(stage, halls, NAVE, {"mirror.winding": False})
    assert (difference(on, off) > 20)[floor].mean() > 0.4
    assert difference(on, off)[~floor].max() == 0


def test_without_normalized_normals_the_statue_s_image_is_too_bright(stage, halls) -> None:
    bronze = {"statue.environment": "none"}  # a sphere map would mirror something else
    on, floor = drawn(stage, halls, NAVE, bronze)
    off, _ = drawn(stage, halls, NAVE, {**bronze, "mirror.normals": False})
    changed = difference(on, off) > 20
    assert changed.sum() > 100 and not changed[~floor].any()
    assert (off - on)[changed].min() >= -1


def test_without_mirrored_lights_the_image_is_lit_from_below(stage, halls) -> None:
    on, floor = drawn(stage, halls, NAVE)
    off, _ = drawn(stage, halls, NAVE, {"mirror.lights": False})
    assert (difference(on, off) > 20)[floor].sum() > 100
    assert difference(on, off)[~floor].max() == 0


def test_without_the_clip_plane_the_basin_stands_above_the_floor_in_the_image(stage, halls) -> None:
    on, floor = drawn(stage, halls, OVER_POOL)
    off, _ = drawn(stage, halls, OVER_POOL, {"mirror.clip": False})
    assert (difference(on, off) > 20)[floor].sum() > 100


def test_from_below_the_floor_has_a_colour_of_its_own_and_no_image(stage, halls) -> None:
    picture, floor = drawn(stage, halls, BELOW)
    assert not floor.any()
    assert np.abs(picture[60, 80] - np.array(UNDERSIDE) * 255).max() <= 1
    without, _ = drawn(stage, halls, BELOW, {"mirror.underside": False})
    assert difference(picture, without).max() > 20, "nothing hides the hall"


def test_the_image_is_a_pass_of_its_own_that_a_trace_names(stage, halls) -> None:
    drawn(stage, halls, NAVE)
    with stage.borrowed(), recording() as recorder:
        halls[*STONE, "statue"].draw(Moment(NAVE, SIZE))
    inside = {call.element for call in recorder.calls if call.pass_ == "reflection"}
    assert inside == {"mirror", "frame", "room", "statue"}, "frame: the lights"
    assert int(gl.glGetError()) == 0


def test_the_image_of_the_room_fades_with_its_height(stage, halls) -> None:
    assert fading(np.array([0.0, FADES])) == pytest.approx([1.0, math.exp(-1.0)])
    # From near the floor one sees the wall's whole height in it.
    along = Pose(1.6, 0.06, 2.75, 0.0, -4.0)
    image, floor = drawn(stage, halls, along, only=STONE)
    faded, _ = drawn(stage, halls, along, {"mirror.fades": True}, STONE)
    assert (faded == image)[~floor].all() and (faded <= image + 2)[floor].mean() > 0.95
    assert faded[floor].mean() < 0.9 * image[floor].mean()


@pytest.mark.seldom(10, first=3)
def test_in_wireframe_one_looks_through_the_stone(hall_pictures: HallPictures) -> None:
    background = np.round(255 * np.array(SCENE.settings.fog.color))
    shares = []
    for wireframe in (False, True):
        picture = hall_pictures("hall_mirror", wireframe=wireframe)
        shares.append((abs(picture - background).max(-1) <= 2).mean())
    assert shares[0] < 0.02 and shares[1] > 0.3
