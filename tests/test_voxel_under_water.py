"""The voxel island from under water: the bed, the surface from beneath, and the block aimed at."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest
from test_voxel_water import PLAIN, SIZE, SMALL, cube_of, fill, rays, read_target

from framelens.gl.seam import recording
from landscape.files.assets import Assets
from landscape.offscreen import Offscreen
from landscape.scene.scene import find_view, raised
from landscape.settings.declare import with_settings
from landscape.voxel.fresnel import reflectance, reflectance_beneath
from landscape.voxel.under_water import murk, sight
from landscape.voxel.voxel import SCENE, Ground

BED = (0.4, 0.55, 0.4, 135.0, -5.0)
UPWARDS = (0.4, 0.55, 0.4, 135.0, 60.0)


@contextmanager
def opened(pose: tuple[float, ...], *more: str, **given: Any) -> Iterator[Offscreen]:
    settings = SMALL | PLAIN | {key.replace("__", "."): value for key, value in given.items()}
    only = ("land", "sky", "water", *more)
    with Offscreen(SIZE, samples=0, place="voxel", settings=settings, only=only) as view:
        view.look(pose)
        yield view


def test_light_from_below_is_mirrored_wholly_beyond_the_critical_angle() -> None:
    critical = np.sqrt(1.0 - 1.0 / 1.33**2)
    cosines = np.array([0.0, 0.5, critical - 1e-6, critical + 0.05, 1.0])
    found = reflectance_beneath(cosines)
    assert found[:3] == pytest.approx(1.0, abs=0.02)
    assert found[3] < 0.5 and found[4] == pytest.approx(0.02)
    # In the window it is what the air's side mirrors at the angle of the same ray.
    inside = np.array([0.8, 0.9])
    outside = np.sqrt(1.0 - 1.33**2 * (1.0 - inside**2))
    assert reflectance_beneath(inside) == pytest.approx(reflectance(outside))


def test_the_surface_from_beneath_mixes_both_pictures_at_every_pixel() -> None:
    mirrored, over = (0.9, 0.3, 0.1), (0.05, 0.4, 0.8)
    with opened(UPWARDS, water__sight=1000.0) as view:
        images = view.scene.water.images
        images.draw_reflection = fill_any(images, "reflection", mirrored)
        images.draw_window = fill_any(images, "refraction", over)
        view.scene.shown = {"water"}
        picture, sight_lines = view.draw().astype(float), rays(view)
        haze = 255 * np.array(murk(view.scene.settings).color)
    up = sight_lines[..., 1] / np.linalg.norm(sight_lines, axis=-1)
    edge = np.abs(up - np.sqrt(1.0 - 1.0 / 1.33**2)) < 0.06  # the cube map's texels are coarser
    part = reflectance_beneath(up)[..., None]
    expected = 255 * (part * np.array(mirrored) + (1 - part) * np.array(over))
    far = 0.3 / np.maximum(up, 1e-3) / 80.0  # of the fog
    expected = expected * (1 - far[..., None]) + haze * far[..., None]
    wanted = (up > 0.3) & ~edge
    assert wanted.mean() > 0.5
    assert np.abs(picture - expected)[wanted].max() <= 4.0


def fill_any(images: Any, name: str, colour: tuple[float, float, float]) -> Any:
    drawn = fill(images, name, colour)
    return lambda viewport, *_rest, **_named: drawn(viewport)


def test_the_bed_fades_into_the_water_and_nothing_beyond_its_bound_is_sent() -> None:
    with opened(BED, water__sight=16.0) as view:
        with view._current(), recording() as recorder:
            picture = view.draw().astype(float)
        haze = 255 * np.array(murk(view.scene.settings).color)
        reach, land = sight(view.scene.settings), view.scene.land
        near = land.around(np.array(BED[:3])).away < reach
    assert np.abs(picture[40] - haze).max() <= 2  # level: there is no bed as near
    assert np.abs(picture[-1] - haze).max() > 15
    sent = [call for call in recorder.calls if call.name == "glMultiDrawArrays"]
    main = [call for call in sent if call.pass_ == "main"]
    assert len(main) == 1 and 0 < len(main[0].args[1]) <= 6 * near.sum()
    assert near.sum() < len(near) / 2


def test_the_surface_mirrors_the_bed_upside_down() -> None:
    with opened((0.4, 0.6, 0.4, 135.0, 0.0), water__sight=1000.0) as view:
        water = view.scene.water
        water._fresnel.release()
        water._fresnel = cube_of(255)  # all of it mirrors
        picture = view.draw()
        with view._current():
            mirrored = read_target(water.images.reflection)
    top = picture[:30].astype(float)
    assert np.abs(top - mirrored[:30]).max(axis=-1).mean() < 3.0
    assert len(np.unique(picture[:30].reshape(-1, 3), axis=0)) > 50


@pytest.mark.seldom(10, first=5)
def test_without_the_setting_an_eye_under_water_sees_the_surface_as_from_above() -> None:
    with opened(BED, water__below=False) as view:
        off = view.draw()
        assert not view.scene._under
    with opened(BED) as view:
        assert (view.draw() != off).any(axis=-1).mean() > 0.9
        assert view.scene._under
        view.look((0.4, 1.3, 0.4, 135.0, -25.0))
        view.draw()
        assert not view.scene._under


@pytest.mark.seldom(13, first=11)
@pytest.mark.parametrize("pose", [(0.5, 0.45, 0.5, 135.0, -70.0), (0.5, 0.25, 0.5, 135.0, -50.0)])
def test_the_block_aimed_at_under_water_is_framed(pose: tuple[float, ...]) -> None:
    with opened(pose, "highlight", voxel__sea=4) as view:  # shallow
        scene = view.scene
        hit = scene.aimed_at(view.moment.pose)
        assert hit is not None and hit.block[2] + 1 <= scene.land.world.water
        framed = view.draw().astype(int)
        scene.shown.discard("highlight")
        changed = np.abs(view.draw().astype(int) - framed).max(axis=-1) > 8
    rows, columns = np.nonzero(changed)
    assert len(rows) > 20
    # The frame surrounds the middle of the picture, where the cross-hair is.
    assert rows.min() < SIZE[1] / 2 < rows.max() and columns.min() < SIZE[0] / 2 < columns.max()


def test_the_view_from_below_stays_below_unless_nothing_is_to_be_seen_there() -> None:
    _, view = find_view("voxel_below")
    assets = Assets()
    for below, stays in ((True, True), (False, False)):
        ground = Ground(with_settings(SCENE.settings, {"water.below": below}), assets)
        pose = raised(view.pose, ground, ground.settings.walk.eye)
        surface = ground.settings.voxel.sea * ground.settings.voxel.block
        assert (pose == view.pose) == stays
        assert (pose.y < surface) == stays
    assert ground.bed(20.0, 24.0) == ground.height(20.0, 24.0) > surface, "on land they are equal"
