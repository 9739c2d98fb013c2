"""The voxel island's shadow map: against rays through the blocks, and edges that do not crawl."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from landscape.elements import sun
from landscape.offscreen import Offscreen
from landscape.voxel.blocks import SOLID
from landscape.voxel.shadow_map import FRAMES
from landscape.voxel.sun_view import light_axes, light_matrix
from landscape.voxel.voxel import clip_matrix

SIZE = (160, 120)
SMALL = {"voxel.regions": 6, "voxel.region_size": 20, "fog.enabled": False}
ABOVE = (5.2, 7.0, 4.6, 20.0, -85.0)


@contextmanager
def opened(size: tuple[int, int] = SIZE, **given: Any) -> Iterator[Offscreen]:
    settings = SMALL | {key.replace("__", "."): value for key, value in given.items()}
    with Offscreen(size, samples=0, place="voxel", settings=settings, only=("land",)) as view:
        view.look(ABOVE)
        yield view


def test_the_axes_of_the_sun_are_at_right_angles_even_at_the_zenith() -> None:
    for towards in ((0.0, 1.0, 0.0), (0.6, 0.8, 0.0), (0.48, 0.6, -0.64)):
        axes = light_axes(np.array(towards))
        assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)
        assert axes[2] == pytest.approx(towards) and np.linalg.det(axes) == pytest.approx(1.0)


def test_the_snapped_square_moves_by_whole_texels_and_always_holds_the_eye() -> None:
    rng = np.random.default_rng(0)
    towards = np.array([0.48, 0.6, -0.64])
    reach, side = 8.0, 512
    texel = 2 * reach / side
    point = np.array([3.0, 1.0, 2.0, 1.0])
    places = []
    for eye in rng.uniform(0, 40, (50, 3)):
        matrix = light_matrix(towards, eye, reach, 40.0, 16 * texel)
        assert (np.abs(matrix @ (*eye, 1.0))[:2] < 16 * texel / reach).all()
        places.append((matrix @ point)[:2] / 2 * side)
    fractions = np.array(places) - places[0]
    assert fractions == pytest.approx(np.round(fractions), abs=1e-6)


def moved_by(step: np.ndarray, update: Any) -> Any:
    """Return an update of the shadow map for an eye that is elsewhere by ``step``."""
    return lambda eye, *rest: update(eye + step, *rest)


@pytest.mark.seldom(13, first=9)
def test_edges_of_shadows_stay_where_they_are_while_the_eye_moves() -> None:
    pictures = {}
    for snapped in (True, False):
        with opened(shadow__snapped=snapped, shadow__size=512, shadow__distance=6.0) as view:
            update = view.scene.shadow.update
            shown = []
            for step in (0.0, 0.4, 1.0, 3.1):  # texels
                moved = step * 2 * 6.0 / 512 * np.array([1.0, 0.0, 0.6])
                view.scene.shadow.update = moved_by(moved, update)
                shown.append(view.draw().astype(int))
            pictures[snapped] = shown
    first, *others = pictures[True]
    assert all((first == other).all() for other in others)
    first, *others = pictures[False]
    assert all((first != other).any() for other in others)


def in_light(solid: np.ndarray, point: np.ndarray, towards: np.ndarray) -> bool:
    """Return whether nothing solid [x, z, y] lies between a point x, y, z in blocks and the sun."""
    at = point + np.arange(0.05, 120.0, 0.05)[:, None] * towards
    cells = np.floor(at[:, [0, 2, 1]]).astype(int)
    within = ((cells >= 0) & (cells < solid.shape)).all(axis=1)
    return not solid[tuple(cells[within].T)].any()


@pytest.mark.seldom(13, first=9)
def test_shadows_lie_where_rays_to_the_sun_meet_blocks() -> None:
    """Overlap of the shadow seen from above with that of rays: over 0.97 of both together."""
    given = {"shadow__size": 4096, "shadow__distance": 7.0, "voxel__levels": 30}
    given |= {"voxel__trees": False, "voxel__buildings": False}
    rng = np.random.default_rng(1)
    width, height = 640, 480
    with opened((width, height), shadow__color=(0.0, 0.0, 0.0), **given) as view:
        for x, z in rng.integers(40, 90, (60, 2)):
            top = view.scene.land.world.ground[x, z]
            view.scene.land.world.blocks[x, z, top : top + 3] = 1
        for region in range(36):
            view.scene.land.rebuild(region)
        picture = view.draw().astype(int).max(axis=-1)
        with view._current():
            clip = clip_matrix()
        world = view.scene.land.world
        towards = sun.direction(view.scene.settings.sun).astype(float)

    solid = SOLID[world.blocks]
    wanted, found = [], []
    for x, z in rng.uniform(45, 85, (4000, 2)):
        if not 0.3 < x % 1 < 0.7 or not 0.3 < z % 1 < 0.7:
            continue
        column = solid[int(x), int(z)]
        top = len(column) - int(column[::-1].argmax())
        near = [
            in_light(solid, np.array([x + dx, top, z + dz]), towards)
            for dx, dz in ((0, 0), (0.25, 0), (-0.25, 0), (0, 0.25), (0, -0.25))
        ]
        if len(set(near)) > 1:
            continue  # at an edge
        place = clip @ (*(np.array([x, top, z]) * world.block), 1.0)
        column, row = place[:2] / place[3]
        if abs(column) < 0.95 and abs(row) < 0.95:
            pixel = int((1 - row) / 2 * height), int((column + 1) / 2 * width)
            wanted.append(near[0])
            found.append(picture[pixel] > 20)

    dark, shown = ~np.array(wanted), ~np.array(found)
    assert len(dark) > 150 and 0.05 < dark.mean() < 0.8
    assert (dark & shown).sum() / (dark | shown).sum() > 0.97


@pytest.mark.seldom(10, first=2)
def test_without_the_offset_faces_shade_themselves() -> None:
    share = {}
    for offset in (True, False):
        with opened(shadow__color=(0.0, 0.0, 0.0), shadow__offset=offset, shadow__size=512) as view:
            share[offset] = (view.draw().max(axis=-1) < 20).mean()
    assert share[False] > share[True] + 0.08


@pytest.mark.seldom(10, first=2)
@pytest.mark.parametrize("far", [False, True])
def test_shadows_are_drawn_again_only_when_the_eye_has_left_or_a_block_has_changed(
    far: bool,
) -> None:
    with opened(shadow__far=far) as view:
        shadow = view.scene.shadow
        land = view.scene.land
        sent = []
        draw_shapes = land.draw_shapes
        land.draw_shapes = lambda choice: (sent.append(1), draw_shapes(choice))
        view.draw()
        assert sent == [1] * (1 + far)
        view.look((ABOVE[0] + 0.02, *ABOVE[1:]))
        view.draw()
        assert sent == [1] * (1 + far) and shadow.settings.shadow.snapped
        land.rebuild(0)
        view.draw()
        assert sent == [1] * 2 * (1 + far)


@pytest.mark.seldom(13)
def test_far_from_the_eye_land_is_shaded_by_the_coarser_picture_near_it_by_the_fine_one() -> None:
    near_only = {"shadow__distance": 5.0, "shadow__size": 1024, "shadow__color": (0.0, 0.0, 0.0)}
    with opened(**near_only, shadow__far=False) as view:
        without = view.draw().astype(int)
        low, high = view.scene.land.low, view.scene.land.high
        covered = view.scene.shadow.covers(low, high)
        assert 0 < covered.sum() < len(low)
        corners = np.stack([low, high])[[[0, 0, 0], [1, 1, 1]], :, [0, 1, 2]]
        ends = np.einsum("ij,kjn->kin", view.scene.shadow.matrix[:2, :3], corners)
        ends += view.scene.shadow.matrix[:2, 3][:, None]
        assert (np.abs(ends[:, :, covered]) <= 1.0).all()
    with opened(**near_only) as view:
        found = view.draw().astype(int)
    with opened(shadow__distance=9.0, shadow__size=4096, shadow__color=(0.0, 0.0, 0.0)) as view:
        fine = view.draw().astype(int)
    dark = [picture.max(axis=-1) < 30 for picture in (without, found, fine)]
    assert (dark[0] ^ dark[2]).sum() > 3 * (dark[1] ^ dark[2]).sum() > 0


COARSE = {"shadow__size": 512, "shadow__distance": 6.0}  # the square moves by 1.5 units


def frame_at(view: Offscreen, x: float, walking: bool) -> np.ndarray:
    """Draw a frame from x units east of ABOVE, as the next of a walk or as a still."""
    pose = replace(view.moment.pose, x=ABOVE[0] + x)
    view.moment = replace(view.moment, pose=pose, walking=walking)
    return view.draw().astype(int)


def counted(view: Offscreen) -> list[int]:
    """Return a list that grows by the number of regions sent each time the sun's are."""
    land, sent = view.scene.land, []
    draw_shapes = land.draw_shapes
    land.draw_shapes = lambda choice: (sent.append(len(choice.regions)), draw_shapes(choice))
    return sent


@pytest.mark.seldom(3, first=2)
def test_in_a_walk_another_squares_depths_are_drawn_over_several_frames_and_then_shown() -> None:
    with opened(**COARSE) as view:
        still = frame_at(view, 1.6, walking=False)
        frame_at(view, 0.0, walking=False)
        sent = counted(view)
        former = view.scene.shadow.matrix
        frames = [frame_at(view, 1.6, walking=True) for _ in range(FRAMES)]
        assert (view.scene.shadow.matrix != former).any()
        # The frame that ends the picture still shows it; all that is near lies in both.
        assert (frames[-1] == still).all()
        assert all((frame == still).mean() > 0.999 for frame in frames)
        assert len(sent) == FRAMES and max(sent) < sum(sent) / 4 and sum(sent) <= 36
        frame_at(view, 1.6, walking=True)
        assert len(sent) == FRAMES


def test_a_walk_that_jumps_far_has_its_shadows_at_once() -> None:
    with opened(**COARSE) as view:
        still = frame_at(view, 0.0, walking=False)
        frame_at(view, 12.0, walking=False)
        sent = counted(view)
        assert (frame_at(view, 0.0, walking=True) == still).all()
        assert len(sent) == 1


@pytest.mark.seldom(3, first=2)
def test_a_block_that_changes_while_the_next_depths_are_drawn_has_its_shadow_before_and_after() -> (
    None
):
    with opened(**COARSE) as view:
        frame_at(view, 0.0, walking=False)
        for k in range(FRAMES):
            frame_at(view, 1.6, walking=True)
            if k == FRAMES // 2:
                world = view.scene.land.world
                x, z = (int(at / world.block) for at in (ABOVE[0] + 1.4, ABOVE[2]))
                top = int(world.ground[x, z])
                view.scene.land.change({(x, z, top + up): 3 for up in range(6)})
        frame = frame_at(view, 1.6, walking=True)
        frame_at(view, 30.0, walking=False)
        assert (frame == frame_at(view, 1.6, walking=False)).all()
