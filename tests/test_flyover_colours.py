"""Colours of the fly-over's wireframe."""

import math

import numpy as np

from landscape.flyover import colours, frame
from landscape.flyover.camera import Camera, Frustum
from landscape.flyover.clipping import Lines
from landscape.flyover.height_field import HeightField, height_field
from landscape.flyover.settings import Settings
from landscape.settings.declare import with_settings

SIZE = (160, 120)
VOLUME = Frustum(-4 / 3, 4 / 3, 1, -1, 1.5, 4096)


def ridge() -> HeightField:
    """Return a ramp along x, from 0 to 60 units and, mirrored, down again."""
    return height_field(np.tile(np.linspace(255, 15, 64), (64, 1)))


def look(camera: Camera, **changes: object) -> np.ndarray:
    keys = {f"flyover.{key}": value for key, value in changes.items()}
    return frame.draw(ridge(), camera, with_settings(Settings(), keys), SIZE).picture


def test_plain_lines_are_black_on_white_as_in_the_document() -> None:
    picture = look(Camera(5, 30, 80, 0, 0.5, 0), colours="plain").reshape(-1, 3)
    found = {tuple(colour) for colour in picture.tolist()}
    assert found == {(0, 0, 0), (255, 255, 255)}


def channels(packed: np.ndarray) -> np.ndarray:
    return np.stack([packed >> shift & 255 for shift in (0, 8, 16)], axis=-1).astype(int)


def drawn(palette: colours.Palette, height: list[float], away: list[float]) -> np.ndarray:
    """Return the colours of some lines side by side, (n, 3)."""
    n = len(height)
    at, depth = np.arange(n), np.array(away)
    ink = colours.Ink(palette, ridge(), 1000.0, np.full(n, colours.NOTHING))
    lines = Lines(at, at, at, at, at, at, depth, depth)
    ink.draw(at, ink.of(lines, np.array(height)))
    picture = np.zeros(n, np.uint32)
    ink.on(picture)
    return channels(picture)


def test_lines_far_away_fade_into_the_background() -> None:
    palette = colours.PALETTES["distance"]
    red = drawn(palette, [30.0] * 50, np.linspace(1, 999, 50).tolist())[:, 0]
    assert red[0] == palette.ramp[0][0] and (np.diff(red) >= 0).all()
    assert abs(red[-1] - palette.paper[0]) < 8 and red[25] > red[0] + 100


def test_lines_are_coloured_by_height_from_the_lowest_to_the_highest_ground() -> None:
    palette, field = colours.PALETTES["height"], ridge()
    heights = np.linspace(field.lowest, field.highest, len(palette.ramp)).tolist()
    found = drawn(palette, heights, [1.0] * len(heights))
    assert np.abs(found - np.array(palette.ramp)).max() <= 5


def test_high_ground_in_a_picture_has_the_colours_of_heights() -> None:
    picture = look(Camera(-20, 30, 60, 0, 0.7, 0), colours="height").astype(int)
    lines = (picture.sum(axis=2) < 450) & (picture.max(axis=2) - picture.min(axis=2) > 30)
    greenish = picture[..., 1] > picture[..., 0]
    near, far = lines[90:], lines[20:45]
    assert near.sum() > 100 and far.sum() > 100
    assert greenish[90:][near].mean() > 0.9 and greenish[20:45][far].mean() < 0.1


def test_where_lines_cross_the_nearer_one_is_on_top_whichever_comes_first() -> None:
    palette = colours.PALETTES["height"]
    at = np.zeros(1, np.int64)
    for away in ((5.0, 4.99), (4.99, 5.0), (3000.0, 2998.0), (0.11, 0.1)):
        ink = colours.Ink(palette, ridge(), 1e5, np.full(1, colours.NOTHING))
        for height, depth in zip((0.0, 60.0), away, strict=True):
            lines = Lines(at, at, at, at, at, at, np.array([depth]), np.array([depth]))
            ink.draw(at, ink.of(lines, np.array([height])))
        nearer = palette.ramp[-1] if away[1] < away[0] else palette.ramp[0]
        picture = np.zeros(1, np.uint32)
        ink.on(picture)
        assert np.abs(channels(picture)[0] - np.array(nearer)).max() <= 12  # it is in some haze


def test_the_sky_begins_at_the_horizon_wherever_the_camera_looks() -> None:
    palette = colours.PALETTES["height"]
    paper = colours.packed(np.array(palette.paper))
    for roll, pitch in ((0.0, 0.0), (0.0, 0.2), (0.0, -0.3), (0.4, 0.1), (-1.0, -0.2)):
        sky = np.zeros(SIZE[::-1], np.uint32)
        camera = Camera(0, 0, 0, roll, pitch, 1.0)
        colours.background(sky, palette, camera, VOLUME, range(SIZE[0]))
        column, row = np.meshgrid(np.arange(160) - 0.5, np.arange(120) - 0.5)
        y, z = (column / 80 - 1) * 4 / 3 / 1.5, (1 - row / 60) / 1.5
        up = math.cos(roll) * z + math.sin(roll) * y
        rise = math.cos(pitch) * up - math.sin(pitch)
        assert (sky[rise < 0] == paper).all() and (sky[rise > 0.02] != paper).all()
        assert np.unique(sky).size > 20


def test_hidden_lines_are_drawn_if_the_switch_is_off() -> None:
    camera = Camera(20, 30, 25)
    on, off = (look(camera, hidden_lines=value) for value in (True, False))
    assert (off == 0).all(axis=2).sum() > 1.2 * (on == 0).all(axis=2).sum()
