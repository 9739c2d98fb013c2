"""Switches of the voxel island's water and of what one may look at besides the picture."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest
from test_voxel_water import PLAIN, SEA_POSE, SIZE, SMALL, read_target

from framelens.gl.seam import recording
from landscape.offscreen import Offscreen
from landscape.settings.declare import with_settings
from landscape.voxel.fresnel import fresnel_faces
from landscape.voxel.settings import PICTURES

SHORE = (4.8, 0.95, 9.3, 0.0, -2.0)  # land behind water
BEHIND_LAND = (4.69, 0.95, 7.76, 336.26, -23.9)  # hills hide the sea


@contextmanager
def opened(pose: tuple[float, ...] = SHORE, **given: Any) -> Iterator[Offscreen]:
    settings = SMALL | PLAIN | {key.replace("__", "."): value for key, value in given.items()}
    only = ("land", "sky", "water")
    with Offscreen(SIZE, samples=0, place="voxel", settings=settings, only=only) as view:
        view.look(pose)
        yield view


def read(view: Offscreen, name: str) -> np.ndarray:
    view.draw()
    with view._current():
        return read_target(getattr(view.scene.water.images, name))


@pytest.mark.seldom(13, first=2)
def test_without_reflection_the_water_mirrors_the_sky_alone() -> None:
    with opened() as view:
        whole = read(view, "reflection")
        view.scene.shown = {"sky", "water"}
        sky = read(view, "reflection")
    with opened(water__reflection=False) as view:
        without = read(view, "reflection")
    assert (without == sky).all() and (whole != sky).any(axis=-1).mean() > 0.02


@pytest.mark.seldom(13)
@pytest.mark.parametrize("height", [0.9, 1.6, 4.0])
def test_the_sky_in_the_water_is_the_sky_upside_down(height: float) -> None:
    pose = (4.8, height, 4.8, 30.0, 0.0)
    with opened(pose, water__reflection=False) as view:
        view.scene.shown = {"sky", "water"}
        mirrored = read(view, "reflection")
        view.scene.shown = {"sky"}
        sky = view.draw().astype(float)
    assert len(np.unique(sky.reshape(-1, 3), axis=0)) > 500
    assert np.abs(mirrored[::-1] - sky).max() <= 2


@pytest.mark.seldom(13, first=2)
def test_without_refraction_the_water_has_its_own_colour_all_over() -> None:
    with opened(SEA_POSE, water__color=(0.2, 0.4, 0.6)) as view:
        assert len(np.unique(read(view, "refraction").reshape(-1, 3), axis=0)) > 20
    with opened(SEA_POSE, water__color=(0.2, 0.4, 0.6), water__refraction=False) as view:
        assert np.unique(read(view, "refraction").reshape(-1, 3), axis=0).tolist() == [
            [51, 102, 153]
        ]


def test_water_that_does_not_mirror_by_angle_mirrors_as_much_in_all_directions() -> None:
    assert len(np.unique(fresnel_faces(1.0, by_angle=False))) == 1
    assert fresnel_faces(0.5, by_angle=False)[0, 0, 0, 0] == pytest.approx(
        fresnel_faces(1.0, by_angle=False)[0, 0, 0, 0] / 2, abs=1
    )


@pytest.mark.seldom(13, first=2)
@pytest.mark.parametrize("name", PICTURES)
def test_a_pass_s_texture_can_be_seen_alone(name: str) -> None:
    with opened(shadow__enabled=True, shadow__size=128, debug__picture=name) as view:
        picture = view.draw().astype(float)
        if name in ("reflection", "refraction"):
            with view._current():
                texture = read_target(getattr(view.scene.water.images, name))
            assert np.abs(picture - texture).max() <= 1
        else:  # depths are grey; beside the sun's, which is square, nothing is shown
            square = picture[:, 16:112] if name == "shadow" else picture
            assert (np.ptp(square, axis=-1) == 0).all()
            assert len(np.unique(square[..., 0])) > 5
            if name == "shadow":
                assert len(np.unique(picture[:, :16].reshape(-1, 3), axis=0)) == 1


def test_a_picture_that_is_not_drawn_is_not_shown() -> None:
    no_water = (4.8, 1.5, 4.8, 0.0, 60.0)
    with opened(no_water, debug__picture="reflection") as view:
        assert len(np.unique(view.draw().reshape(-1, 3), axis=0)) == 1


@pytest.mark.parametrize("end", [BEHIND_LAND, (4.8, 1.5, 4.8, 0.0, 60.0)])
@pytest.mark.sweep(4)
def test_textures_that_are_shown_are_those_of_the_frame_whatever_was_seen_before(
    end: tuple[float, ...],
) -> None:
    with opened(end, debug__textures=True) as view:
        alone = view.draw()
        view.look(SHORE)
        shore = view.draw()
        view.look(end)
        after = [view.draw() for _ in range(2)]
    assert (shore != alone).any()
    assert (after[0] == alone).all() and (after[1] == alone).all()


@pytest.mark.seldom(14, first=2)
@pytest.mark.parametrize("objects", [False, True])
@pytest.mark.parametrize("buffers", ["one", "regions"])
def test_the_picture_is_the_same_from_one_buffer_or_from_one_a_region(
    buffers: str, objects: bool
) -> None:
    names: dict[str, int] = {}
    with opened(SEA_POSE) as view:
        whole = view.draw()
    with opened(SEA_POSE, voxel__buffers=buffers, voxel__vertex_arrays=objects) as view:
        view.draw()  # makes the vertex array objects
        with view._current(), recording() as recorder:
            drawn = view.draw()
            for call in recorder.calls:
                names[call.name] = names.get(call.name, 0) + 1
        regions = len(view.scene.land.low)
    assert (drawn == whole).all()
    assert ("glInterleavedArrays" in names) == (not objects)
    assert ("glBindVertexArray" in names) == objects
    sent = names["glMultiDrawArrays"]
    assert (sent <= 6) if buffers == "one" else (6 < sent <= 6 * regions)


@pytest.mark.seldom(13, first=2)
def test_edges_are_drawn_in_black_and_merging_leaves_fewer_of_them() -> None:
    black, plain = {}, {"voxel__occlusion": False, "voxel__trees": False}
    for merge in ("none", "rectangles"):
        counts = []
        for edges in (False, True):
            with opened(debug__edges=edges, voxel__merge=merge, **plain) as view:
                view.look((4.8, 3.0, 4.8, 0.0, -60.0))
                counts.append((view.draw().max(axis=-1) == 0).sum())
        assert counts[0] == 0
        black[merge] = counts[1]
    assert black["none"] > 1.3 * black["rectangles"] > 100


@pytest.mark.seldom(3, first=1)
def test_a_setting_that_meshes_do_not_depend_on_builds_nothing_again() -> None:
    with opened(shadow__enabled=True, shadow__size=128) as view:
        view.draw()
        now = view.scene.settings
        with view._current(), recording() as recorder:
            assert view.scene.apply(with_settings(now, {"shadow.offset": False, "voxel.near": 3}))
            assert view.scene.apply(with_settings(now, {"shadow.size": 64}))
            assert not view.scene.apply(with_settings(now, {"voxel.mipmaps": False}))
        assert not [call for call in recorder.calls if call.name == "glBufferData"]
