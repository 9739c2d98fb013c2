"""The serpent's wet scales: cube maps, what is around, and how much of it is mirrored."""

import numpy as np
import pytest
from animals import LIT, made
from stage import Stage, close, pixel, small, write_ply

from framelens.gl import extensions
from framelens.gl.seam import gl
from framelens.gl.state import attrib, matrix
from framelens.gl.texture import Texture
from landscape.elements.best.animals import wet_sheen
from landscape.elements.best.animals.wet_sheen import HEAD_ON, mirrored_part
from landscape.elements.best.sky.surroundings import face_of, sea_colour, surroundings
from landscape.elements.settings import Sun
from landscape.elements.sky_box import FACES, face_corners
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Pose
from landscape.geometry.mesh import Mesh
from landscape.gl.cube_map import face_directions
from landscape.gl.draw import picture_quad

# A plate across the line of sight.
PLATE = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], float)
SOUTH = Pose(20.0, 0.6, 40.0, 0.0, 0.0)


def test_directions_of_a_cube_map_are_the_specification_s() -> None:
    found = face_directions(64)
    axes = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    assert np.allclose(found[:, 31:33, 31:33].mean(axis=(1, 2)), axes, atol=1e-3)
    # Table 3.17 of OpenGL 1.3: s grows along -z, z, x, x, x, -x; t along -y, -y, z, -z, -y, -y.
    along_s = [(0, 0, -1), (0, 0, 1), (1, 0, 0), (1, 0, 0), (1, 0, 0), (-1, 0, 0)]
    along_t = [(0, -1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (0, -1, 0), (0, -1, 0)]
    for face, s, t in zip(found, along_s, along_t, strict=True):
        assert (np.diff(face @ s, axis=1) > 0).all() and (np.diff(face @ t, axis=0) > 0).all()


def test_a_direction_meets_the_sky_where_the_box_has_it() -> None:
    corners = face_corners(8.0, 5.0)
    middles = {name: points.mean(axis=0) for name, points in corners.items()}
    for number, name in enumerate(FACES):
        # Points of the face a third of the way from its middle to its corners: s, t = 1/3 or 2/3.
        points = middles[name] + (corners[name] - middles[name]) / 3
        face, s, t = face_of(points / np.linalg.norm(points, axis=1, keepdims=True), 5 / 8)
        assert (face == number).all()
        assert np.allclose(s, [1 / 3, 1 / 3, 2 / 3, 2 / 3], atol=1e-5)
        assert np.allclose(t, [1 / 3, 2 / 3, 2 / 3, 1 / 3], atol=1e-5)


def test_around_is_the_sky_above_and_the_sea_below(plain: Assets) -> None:
    settings = small()
    faces = surroundings(settings, plain).astype(float)
    top = np.asarray(plain_colour(plain, "sky_top.png"), float)
    assert np.abs(faces[2, 20:44, 20:44] - top).max() <= 1
    assert np.abs(faces[3, 31:33, 31:33] - sea_colour(settings)).max() <= 2
    assert np.abs(faces[5, 31] - plain_colour(plain, "sky_north.png")).max() <= 1
    # Just below the horizon the sea mirrors the sky.
    assert np.abs(faces[5, 32] - faces[5, 31]).max() <= 12


def plain_colour(assets: Assets, name: str) -> np.ndarray:
    return read_image(assets.path(name), "RGB")[0, 0].astype(float)


def test_grazing_surfaces_mirror_all_and_facing_ones_little() -> None:
    found = mirrored_part(np.array([-0.5, 0.0, 0.5, 1.0]))
    assert found[0] == found[1] == 1.0 and found[3] == pytest.approx(HEAD_ON)
    assert found[3] < found[2] < 0.5


def drawn(stage: Stage, folder, sheen: float, **more: float) -> np.ndarray:
    write_ply(folder / "dragon.ply", PLATE, np.array([(0, 1, 2, 3)]))
    dragon = made("dragon", small({**LIT, "dragon.sheen": sheen, **more}), Assets(folder))
    with stage.frame(dragon.settings, SOUTH) as frame:
        dragon.draw(frame)
        got = pixel(stage.read(), (80.5, 60.5))
    dragon.release()
    return np.asarray(got, float)


@pytest.mark.parametrize("strength", [0.5, 1.0])
def test_a_wet_plate_mixes_its_lit_colour_with_the_sky_behind_the_viewer(
    stage: Stage, plain_folder, strength: float
) -> None:
    dry, wet = (drawn(stage, plain_folder, sheen) for sheen in (0.0, strength))
    # It faces south, so it mirrors what is at the horizon there.
    south = plain_colour(Assets(plain_folder), "sky_south.png")
    part = HEAD_ON * strength
    assert close(wet, dry * (1 - part) + south * part, 3)


def test_without_cube_maps_scales_are_dry_and_one_line_says_why(
    stage: Stage, plain_folder, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    dry = drawn(stage, plain_folder, 0.0)
    monkeypatch.setattr(extensions, "version", lambda: (1, 2))
    monkeypatch.setattr(extensions, "extensions", frozenset)
    monkeypatch.setattr(extensions, "_told", set())
    assert (drawn(stage, plain_folder, 1.0) == dry).all()
    assert (drawn(stage, plain_folder, 1.0) == dry).all()
    told = capsys.readouterr().err
    assert told.startswith("landscape: dragon.sheen: off, for this OpenGL has no ")
    assert told.count("\n") == 1


def test_the_waterline_s_band_is_darker_and_what_is_higher_keeps_its_colour() -> None:
    x = np.linspace(-1, 1, 50)
    y = np.linspace(-0.5, 0.9, 50)
    vertices = np.stack([x, y, 0 * x], axis=1).astype(np.float32)
    mesh = Mesh(
        vertices, vertices, np.zeros((0, 3), np.uint32), (), np.full((50, 4), 200, np.uint8)
    )
    found = wet_sheen.wet_band(mesh, -0.15, 1.0).colors
    assert found is not None and (found[:, 3] == 200).all()
    assert (found[y < -0.15, 0] < 110).all() and (found[y > 0.1, :3] == 200).all()
    assert (wet_sheen.wet_band(mesh, -0.15, 0.0).colors == mesh.colors).all()
    half = wet_sheen.wet_band(mesh, -0.15, 0.5).colors
    assert half is not None and (half[y < -0.15, 0] > 120).all()


def masked_plate(stage: Stage, plain: Assets, alpha: int, wet: float) -> np.ndarray:
    """Return the colour of a plate that faces the viewer, and whose texture has that alpha."""
    values = {"dragon.sheen": 1.0, "dragon.wet": wet, "sun.azimuth": 180.0, "sun.elevation": 1.0}
    settings = small({**LIT, **values})
    sheen = wet_sheen.WetSheen(settings, plain, masked=True)
    texture = Texture(np.full((4, 4, 4), (200, 100, 50, alpha), np.uint8))
    with stage.frame(settings, SOUTH) as frame:
        with matrix(), sheen.shining(frame, 1.0, wet), attrib(gl.GL_ENABLE_BIT):
            gl.glLoadIdentity()
            gl.glEnable(gl.GL_TEXTURE_2D)
            texture.bind()
            gl.glNormal3f(0.0, 0.0, 1.0)
            picture_quad()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
        got = pixel(stage.read(), (80.5, 60.5)).astype(float)
    sheen.release()
    texture.release()
    return np.asarray(got)


@pytest.mark.parametrize("alpha", [0, 128, 255])
def test_with_a_mask_a_surface_mirrors_by_the_alpha_of_its_texture(
    stage: Stage, plain: Assets, alpha: int
) -> None:
    own = np.array([200.0, 100.0, 50.0])
    south = plain_colour(plain, "sky_south.png")
    part = HEAD_ON * alpha / 255
    assert close(masked_plate(stage, plain, alpha, 0.0), own + part * (south - own), 2)


def test_with_a_mask_the_sun_is_mirrored_by_that_alpha_too(stage: Stage, plain: Assets) -> None:
    own = np.array([200.0, 100.0, 50.0])
    dull, half, shiny = (masked_plate(stage, plain, alpha, 1.0) for alpha in (0, 128, 255))
    assert close(dull, own, 2)
    assert (shiny[1:] > half[1:] + 30).all() and (half[1:] > dull[1:] + 30).all()


def test_the_map_of_the_sun_is_dark_away_from_it_and_white_at_it() -> None:
    sun = Sun(azimuth=90.0, elevation=0.0, diffuse=(1.0, 1.0, 1.0))
    faces = wet_sheen.glints(sun).astype(int)
    assert faces[0, 31:33, 31:33].min() > 240 and faces[1].max() == 0


@pytest.mark.parametrize(("azimuth", "more"), [(180.0, True), (0.0, False)])
def test_a_wet_plate_shows_the_sun_where_it_mirrors_it(
    stage: Stage, plain_folder, azimuth: float, more: bool
) -> None:
    # The plate faces south, so it mirrors what is behind the viewer.
    sun = {"sun.azimuth": azimuth, "sun.elevation": 1.0}
    dry, wet = (drawn(stage, plain_folder, 0.5, **sun, **{"dragon.wet": wet}) for wet in (0.0, 1.0))
    assert ((wet > dry + 25).all() and more) or (close(wet, dry, 2) and not more)
