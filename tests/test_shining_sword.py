"""The light on the sword's steel: where the steel is, how its normals are bent, what it mirrors."""

import numpy as np
import pytest
from drivers import KNOWN
from PIL import Image
from stage import Stage, kind_in, small, taken

from framelens.gl import extensions
from landscape.elements.best.sword.shining_sword import (
    BEND,
    TAN,
    ShiningSword,
    blade,
    light_around,
    steel,
    strip,
)
from landscape.elements.sword import ASPECT, Sword, pictures
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Pose
from landscape.island.slots import SWORD
from landscape.settings.declare import with_settings

STEEL = (150, 155, 170, 255)
BRASS = (200, 160, 70, 255)
LEATHER = (90, 70, 60, 255)
BEST = small({"overlay.sheen": 0.5})


def sword_picture() -> np.ndarray:
    """Return an upright blade, 0.3 wide and 1 high in halves of the picture, a guard and a hand."""
    picture = np.zeros((300, 300, 4), np.uint8)
    picture[30:180, 135:165] = STEEL
    picture[180:190, 100:200] = BRASS
    picture[190:280, 130:170] = LEATHER
    return picture


def test_steel_is_found_and_brass_leather_and_what_is_transparent_are_not() -> None:
    mask = steel(sword_picture())[..., 0]
    assert (mask[30:180, 135:165] == 255).all() and mask.sum() == 255 * 150 * 30


def test_steel_at_the_picture_s_edge_does_not_go_on_beyond_it() -> None:
    assert steel(np.full((8, 8, 4), STEEL, np.uint8))[..., 0].sum() == 255 * 36


def test_a_blade_has_the_axis_and_the_size_of_its_steel() -> None:
    found = blade(steel(sword_picture()))
    assert found is not None and abs(found.axis[1]) == pytest.approx(1.0)
    assert np.allclose(found.middle, (0.0, 0.3), atol=0.01)
    assert (found.length, found.width) == pytest.approx((0.5, 0.15), abs=0.01)
    assert blade(steel(np.zeros((20, 20, 4), np.uint8))) is None


def test_each_shipped_picture_shows_a_blade_and_specks_do_not_widen_it(shipped: Assets) -> None:
    for path in pictures(shipped):
        found = blade(steel(read_image(path)))
        assert found is not None and found.width < 0.35 * found.length, path.name


def test_the_strip_faces_the_viewer_and_bends_away_from_ridge_and_middle() -> None:
    found = blade(steel(sword_picture()))
    assert found is not None
    vertices, normals, coordinates, triangles = strip(found)
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    facing = np.cross(b - a, c - a)[:, 2]
    assert (facing > 0).all() or (facing < 0).all()
    assert np.allclose(coordinates, (vertices[:, :2] * (1, -1) + 1) / 2, atol=1e-6)
    eye = normals / (ASPECT, 1.0, 1 / TAN)
    assert np.allclose(np.linalg.norm(eye, axis=1), 1.0, atol=1e-5)
    up = vertices[:, 1] - found.middle[1]
    assert np.allclose(eye[:, 1], np.sin(BEND * up / found.length), atol=1e-5)
    outer = np.abs(vertices[:, 0] - found.middle[0] / ASPECT) > 0.05
    assert (eye[outer, 0] * (vertices[outer, 0] - found.middle[0] / ASPECT) > 0).all()


def test_the_brightest_light_comes_from_the_sun(shipped: Assets) -> None:
    settings = small({"sun.azimuth": 90.0, "sun.elevation": 0.0, "sun.diffuse": (1.0, 1.0, 1.0)})
    faces = light_around(settings, shipped).sum(axis=-1)
    assert faces[0, 31:33, 31:33].min() == faces.max() == 3 * 255


def drawn(stage: Stage, assets: Assets, sheen: float, yaw: float, stroke: int = 1) -> np.ndarray:
    settings = with_settings(BEST, {"overlay.sheen": sheen})
    sword = kind_in(SWORD, settings)(settings, assets)
    with stage.frame(settings, Pose(20.0, 1.0, 20.0, yaw), stroke=stroke) as frame:
        sword.draw(frame)
        picture = stage.read()
    sword.release()
    return picture.astype(float)


@pytest.fixture
def one_sword(plain_folder) -> Assets:
    Image.fromarray(sword_picture()).save(plain_folder / "sword_1.png")
    return Assets(plain_folder)


def test_light_is_added_to_steel_alone_in_proportion_to_the_setting(
    stage: Stage, one_sword: Assets
) -> None:
    plain, half, all_ = (drawn(stage, one_sword, sheen, 33.0) for sheen in (0.0, 0.3, 0.6))
    added = all_ - plain
    assert added.min() >= 0 and added[15:65, 75:85].max() > 10
    assert np.abs((half - plain) * 2 - added).max() <= 3
    assert not added[78:].any() and not added[:, :60].any() and not added[:, 100:].any()


def test_the_light_on_the_blade_moves_as_the_walker_turns(stage: Stage, one_sword: Assets) -> None:
    here, there = (drawn(stage, one_sword, 0.6, yaw) for yaw in (0.0, 180.0))
    assert np.abs(here - there)[15:65, 75:85].max() > 20


def test_without_cube_maps_the_sword_is_the_plain_one_and_one_line_says_why(
    stage: Stage, one_sword: Assets, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    plain = drawn(stage, one_sword, 0.0, 33.0)
    monkeypatch.setattr(extensions, "version", lambda: (1, 2))
    monkeypatch.setattr(extensions, "extensions", lambda: KNOWN - {"GL_ARB_texture_cube_map"})
    monkeypatch.setattr(extensions, "_told", set())
    for _ in range(2):
        assert (drawn(stage, one_sword, 0.6, 33.0) == plain).all()
    assert capsys.readouterr().err.count("landscape: overlay.sheen: off, ") == 1


def test_only_another_light_around_needs_another_sword(stage: Stage, one_sword: Assets) -> None:
    assert kind_in(SWORD, small()) is Sword
    sword = ShiningSword(BEST, one_sword)
    assert taken(sword, with_settings(BEST, {"overlay.sheen": 0.9, "fog.density": 0.3}))
    assert not taken(sword, with_settings(BEST, {"sun.azimuth": 10.0}))
    sword.release()
