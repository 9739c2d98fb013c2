"""The sword's blade of geometry: where it is, its section, its smooth edge, what it mirrors."""

import numpy as np
import pytest
from stage import Stage, kind_in, small, taken

from framelens.gl import extensions
from landscape.elements.best.sword.shining_sword import TAN, blade, steel
from landscape.elements.best.sword.steel_blade import (
    BARE,
    FULLER,
    ROOT,
    TIP,
    SteelBlade,
    face,
    finer,
    half_width,
    mirrored_light,
    on_square,
    pose,
    relief,
    scratches,
    steel_mesh,
    without_blade,
)
from landscape.elements.sword import ASPECT, pictures
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Pose
from landscape.island.slots import SWORD
from landscape.settings.declare import with_settings

BEST = small({"overlay.sheen": 0.5, "overlay.blade": True})


def test_the_blade_lies_where_the_picture_shows_it(shipped: Assets) -> None:
    found = blade(steel(read_image(pictures(shipped)[0])))
    assert found is not None
    axes, grip = pose()
    middle, tip = on_square(np.array([(0, (ROOT + TIP) / 2, 0), (0, TIP, 0)]) @ axes + grip)
    way = (tip - middle) * (ASPECT, 1.0)
    way /= np.linalg.norm(way)
    assert abs(way @ found.axis) > 0.995
    ends = found.middle + np.outer((-1, 1), found.axis) * found.length
    assert np.linalg.norm(ends - tip * (ASPECT, 1.0), axis=1).min() < 0.05


def test_the_section_is_a_flattened_rhomb_with_a_fuller_that_ends() -> None:
    across = np.linspace(-1.0, 1.0, 41)
    low, high = (relief(across, np.full(41, share)) for share in (0.3, FULLER + 0.15))
    assert np.allclose(low, low[::-1]) and low[0] == pytest.approx(0.0)
    assert low[20] < low[28] - 0.0005, "a groove along the middle"
    assert high.argmax() == 20 and (np.diff(high[:21]) > 0).all(), "none towards the point"
    width = half_width(np.linspace(0.0, 1.0, 50))
    assert (np.diff(width) < 0).all() and width[-1] == 0.0


def test_the_mesh_faces_the_viewer_and_its_normals_lean_outwards() -> None:
    mesh = steel_mesh()
    normals = mesh.normals / (ASPECT, 1.0, 1.0 / TAN)
    lengths = np.linalg.norm(normals, axis=1)
    assert np.allclose(lengths, 1.0, atol=1e-3) and (normals[:, 2] > 0.2).mean() > 0.85
    own = face()
    edge = np.abs(own.vertices[:, 0]) > 0.85 * half_width(0.5)
    middle = np.abs(own.vertices[:, 1] - (ROOT + TIP) / 2) < 0.1
    outer = own.normals[edge & middle]
    assert (outer[:, 0] * np.sign(own.vertices[edge & middle][:, 0]) > 0.3).all()


def test_the_outline_is_soft_for_about_a_pixel() -> None:
    mesh = steel_mesh()
    alpha = mesh.colors[:, 3]
    assert set(np.unique(alpha)) == {0.0, 1.0}
    flat = mesh.vertices[:, :2] * (ASPECT, 1.0)
    outside = flat[alpha == 0.0]
    inside = flat[alpha == 1.0]
    gap = [np.linalg.norm(inside - place, axis=1).min() for place in outside]
    assert 0.001 < np.median(gap) < 0.004


def test_the_picture_keeps_hand_and_hilt_and_loses_its_blade(shipped: Assets) -> None:
    picture = read_image(pictures(shipped)[0])
    rest = without_blade(picture)
    assert (rest[..., :3] == picture[..., :3]).all() and (rest[..., 3] <= picture[..., 3]).all()
    lost = picture[..., 3].astype(int) - rest[..., 3]
    before = steel(picture)[..., 0] > 127
    assert (lost[before] > 200).mean() > 0.8
    axes, grip = pose()
    column, row = ((on_square(grip[None]) * (1, -1) + 1) / 2 * 512).astype(int)[0]
    assert not lost[row : row + 100, column - 40 : column + 60].any(), "the hand stays"
    above = on_square(np.array([(0.0, BARE + 0.1, 0.0)]) @ axes + grip)[0]
    column, row = ((above * (1, -1) + 1) / 2 * 512).astype(int)
    assert rest[row - 5 : row + 5, column - 5 : column + 5, 3].max() == 0


def test_a_finer_picture_keeps_flat_parts_and_ramps() -> None:
    flat = np.full((6, 8, 4), (90, 60, 30, 255), np.uint8)
    assert (finer(flat) == np.full((12, 16, 4), (90, 60, 30, 255))).all()
    ramp = flat.copy()
    ramp[..., 0] = 20 * np.arange(8)
    fine = finer(ramp)[6, :, 0].astype(float)
    assert np.allclose(fine[5:11], 20 * (np.arange(16)[5:11] - 0.5) / 2, atol=1.0)
    clear = flat.copy()
    clear[..., 3] = 0
    assert (finer(clear) == np.repeat(np.repeat(clear, 2, 0), 2, 1)).all()


def test_scratches_are_thin_and_leave_most_of_the_steel_bright() -> None:
    picture = scratches().astype(float)
    assert np.median(picture) > 235 and 100 < picture.min() < 220


def drawn(stage: Stage, assets: Assets, yaw: float, stroke: int = 0, **more) -> np.ndarray:
    settings = with_settings(BEST, {key.replace("__", "."): value for key, value in more.items()})
    sword = kind_in(SWORD, settings)(settings, assets)
    with stage.frame(settings, Pose(20.0, 1.0, 20.0, yaw), stroke=stroke) as frame:
        sword.draw(frame)
        picture = stage.read()
    sword.release()
    sword.release()
    return picture.astype(float)


def on_blade(stage: Stage) -> tuple[slice, slice]:
    """Return rows and columns of a part of the blade in a picture 160 wide and 120 high."""
    axes, grip = pose()
    x, y = on_square(np.array([(0.0, 0.45, 0.0)]) @ axes + grip)[0]
    # The picture's square is at the right: its middle is 1.5 half heights from the edge.
    row, column = round(60 - 60 * y), round(160 - 60 * ASPECT * (1 - x))
    return slice(row - 2, row + 3), slice(column - 2, column + 3)


@pytest.mark.seldom(13, first=7)
def test_the_steel_mirrors_what_is_around_as_the_walker_turns(
    stage: Stage, shipped: Assets
) -> None:
    at = on_blade(stage)
    colours = [drawn(stage, shipped, yaw)[at].mean() for yaw in (0.0, 90.0, 180.0, 270.0)]
    assert min(colours) > 40 and max(colours) - min(colours) > 8


def test_a_stroke_shows_the_pictures(stage: Stage, shipped: Assets) -> None:
    geometry, painted = (
        drawn(stage, shipped, 20.0, stroke=3, overlay__blade=on) for on in (True, False)
    )
    assert (geometry == painted).all()


def test_without_cube_maps_the_blade_is_painted(
    stage: Stage, shipped: Assets, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    monkeypatch.setattr(extensions, "version", lambda: (1, 2))
    monkeypatch.setattr(extensions, "extensions", frozenset)
    monkeypatch.setattr(extensions, "_told", set())
    plain = drawn(stage, shipped, 33.0, overlay__blade=False, overlay__sheen=0.0)
    assert (drawn(stage, shipped, 33.0) == plain).all()
    assert capsys.readouterr().err.count("landscape: overlay.") == 1


def test_steel_mirrors_the_sun_brightest_and_less_colour_than_the_sky(shipped: Assets) -> None:
    settings = small({"sun.azimuth": 90.0, "sun.elevation": 0.0, "sun.diffuse": (1.0, 1.0, 1.0)})
    faces = mirrored_light(settings, shipped).astype(int)
    assert faces[0, 31:33, 31:33].min() == 255
    zenith = faces[2, 28:36, 28:36].mean(axis=(0, 1))
    assert zenith[2] - zenith[0] < 70


def test_only_another_light_needs_another_sword(stage: Stage, shipped: Assets) -> None:
    sword = SteelBlade(BEST, shipped)
    assert taken(sword, with_settings(BEST, {"fog.density": 0.3}))
    assert not taken(sword, with_settings(BEST, {"sun.azimuth": 10.0}))
    sword.release()
