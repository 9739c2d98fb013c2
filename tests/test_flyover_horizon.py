"""Hidden lines of the fly-over: the floating horizon against a z buffer and its own loop."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from landscape.flyover import bresenham, clipping, floating_horizon, frame
from landscape.flyover.camera import Camera, Frustum, camera_transform
from landscape.flyover.clipping import Lines
from landscape.flyover.edges import Edges
from landscape.flyover.height_field import HeightField, height_field
from landscape.flyover.levelled import Levelled
from landscape.flyover.noise import noise
from landscape.flyover.settings import Flyover, Settings

SIZE = (120, 90)
# The near plane is close to the eye: no triangle that is cut there reaches into the picture.
VOLUME = Frustum(-0.133, 0.133, 0.1, -0.1, 0.15, 200.0)


@dataclass
class Stage:
    """A terrain from a camera: its vertices in the camera's frame, and all lines and pixels."""

    points: tuple[np.ndarray, np.ndarray, np.ndarray]
    triangles: np.ndarray
    camera: Camera
    lines: Lines
    at: np.ndarray
    owner: np.ndarray

    @property
    def shown(self) -> np.ndarray:
        return shown(self.lines, self.at, self.owner, self.camera)


def horizon_of(lines: Lines, camera: Camera) -> floating_horizon.Horizon:
    levelled = Levelled(camera, VOLUME, SIZE, floating_horizon.SLACK)
    return floating_horizon.Horizon(lines, levelled, VOLUME)


def shown(lines: Lines, at: np.ndarray, owner: np.ndarray, camera: Camera) -> np.ndarray:
    return horizon_of(lines, camera).shows(at, owner)


def terrain(seed: int) -> HeightField:
    image = noise(32, seed, 1.6)
    return height_field((image - image.min()) / np.ptp(image) * 255, Flyover(relief=16.0))


def stage(field: HeightField, camera: Camera, reach: int = 24) -> Stage:
    """Return what a camera sees of the squares up to ``reach`` units away."""
    spans = [int(at) + np.arange(-reach, reach + 1) for at in (camera.x, camera.y)]
    x, y = (each.ravel() for each in np.meshgrid(*spans))
    points = camera_transform(x - camera.x, y - camera.y, field.height(x, y) - camera.z, camera)
    place = np.arange(x.size).reshape(2 * reach + 1, -1)
    corner = place[:-1, :-1].ravel()
    right = place[:-1, 1:].ravel()
    below = place[1:, :-1].ravel()
    across = place[1:, 1:].ravel()
    triangles = np.concatenate(
        [np.stack([corner, right, across], 1), np.stack([corner, across, below], 1)]
    )
    pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    a, b = pairs[(points[0][pairs] > VOLUME.near).all(axis=1)].T
    lines = clipping.projected(points, Edges(a, b), VOLUME, SIZE)
    at, owner = bresenham.pixels(lines.x0, lines.y0, lines.x1, lines.y1, SIZE)
    return Stage(points, triangles, camera, lines, at, owner)


def z_buffer(scene: Stage) -> np.ndarray:
    """Return the inverse distance of the nearest triangle at each pixel's centre, 0 for none."""
    width, height = SIZE
    nearest = np.zeros((height, width))
    x, y, z = scene.points
    for triangle in scene.triangles[(x[scene.triangles] > VOLUME.near).all(axis=1)]:
        depth = x[triangle]
        u = width * (y[triangle] * VOLUME.near / depth - VOLUME.left)
        u /= VOLUME.right - VOLUME.left
        v = height * (VOLUME.top - z[triangle] * VOLUME.near / depth)
        v /= VOLUME.top - VOLUME.bottom
        # Pixel p holds what is rounded up to it; its centre is at p - 1/2.
        columns = slice(max(math.ceil(u.min() + 0.5), 0), max(math.floor(u.max() + 1.5), 0))
        rows = slice(max(math.ceil(v.min() + 0.5), 0), max(math.floor(v.max() + 1.5), 0))
        part = nearest[rows, columns]
        area = (u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0])
        if not part.size or abs(area) < 1e-12:
            continue
        across = columns.start + np.arange(part.shape[1]) - 0.5 - u[0]
        down = (rows.start + np.arange(part.shape[0]) - 0.5 - v[0])[:, None]
        one = (across * (v[2] - v[0]) - (u[2] - u[0]) * down) / area
        two = ((u[1] - u[0]) * down - across * (v[1] - v[0])) / area
        inside = (one >= -1e-9) & (two >= -1e-9) & (one + two <= 1 + 1e-9)
        here = (1 - one - two) / depth[0] + one / depth[1] + two / depth[2]
        np.maximum(part, np.where(inside, here, 0), out=part)

    return nearest


def drawn(at: np.ndarray) -> np.ndarray:
    picture = np.zeros((SIZE[1], SIZE[0]), bool)
    picture.ravel()[at] = True
    return picture


def around(picture: np.ndarray, sideways: bool) -> np.ndarray:
    """Return a picture with each pixel spread to the rows above and below, and to its sides."""
    wide = np.pad(picture, 1)
    found = wide[:-2, 1:-1] | wide[1:-1, 1:-1] | wide[2:, 1:-1]
    if sideways:
        wide = np.pad(found, 1)
        found = wide[1:-1, :-2] | wide[1:-1, 1:-1] | wide[1:-1, 2:]
    return found


CAMERAS = {
    "level": (3.0, 0.0, 0.0, 0.3),
    "level, low": (1.5, 0.0, 0.0, 2.0),
    "down": (7.0, 15.0, 0.0, 4.0),
    "steeply down": (20.0, 60.0, 0.0, 1.0),
    "up": (2.0, -12.0, 0.0, 5.0),
    "rolled": (4.0, 0.0, 25.0, 3.0),
    "all at once": (9.0, 20.0, -30.0, 0.7),
}


@pytest.mark.sweep(5)
@pytest.mark.parametrize("name", CAMERAS)
def test_hidden_lines_equal_a_z_buffer_but_for_pixels_beside_silhouettes(name: str) -> None:
    up, pitch, roll, yaw = CAMERAS[name]
    field = terrain(len(name))
    x, y = 10.3, 17.6
    angles = math.radians(roll), math.radians(pitch), yaw
    scene = stage(field, Camera(x, y, float(field.height(x, y)) + up, *angles))
    row, column = np.divmod(scene.at, SIZE[0])
    near = floating_horizon.Nearness(scene.lines)(scene.owner, column, row)

    # A line's pixel is up to half a pixel beside the line: where it is followed at a slant, the
    # triangles there are somewhat nearer.
    expected = drawn(scene.at[near >= z_buffer(scene)[row, column] * 0.96])
    ours = drawn(scene.at[scene.shown])
    hidden = drawn(scene.at) & ~ours
    assert expected.sum() > 800 and hidden.sum() > (50 if "steep" in name else 200)
    differ = ours != expected

    # Pixels that may differ: those one row away from one that the other picture has, ...
    beside = around(expected, False) & ours | around(ours, False) & expected
    assert differ.sum() < 0.05 * expected.sum(), differ.sum()

    # ... and, beside steep silhouettes, a few one column away. Nothing else shines through.
    assert (differ & ~beside).sum() <= 10, (differ & ~beside).sum()
    assert not (ours & ~around(expected, True)).any()
    assert not (expected & ~around(ours, True)).any()


@pytest.mark.seldom(5, first=1)
@pytest.mark.parametrize("name", CAMERAS)
def test_lines_that_are_hidden_as_a_whole_have_no_pixel_that_is_seen(name: str) -> None:
    up, pitch, roll, yaw = CAMERAS[name]
    hidden = 0
    for seed in range(4):
        field = terrain(seed)
        angles = math.radians(roll), math.radians(pitch), yaw + seed
        scene = stage(field, Camera(9.3, 20.6, float(field.height(9.3, 20.6)) + up, *angles))
        horizon = horizon_of(scene.lines, scene.camera)
        hides = horizon.hides(scene.lines)
        assert not (hides[scene.owner] & horizon.shows(scene.at, scene.owner)).any()
        hidden += int(hides[np.unique(scene.owner)].sum())
    assert hidden > 40 or "steep" in name


@pytest.mark.parametrize("name", CAMERAS)
def test_lines_that_are_not_entered_because_nearer_ones_hide_them_raise_nothing(name: str) -> None:
    up, pitch, roll, yaw = CAMERAS[name]
    field = terrain(1)
    angles = math.radians(roll), math.radians(pitch), yaw
    scene = stage(field, Camera(9.3, 20.6, float(field.height(9.3, 20.6)) + up, *angles))
    horizon = horizon_of(scene.lines, scene.camera)
    table = horizon.table
    everything = floating_horizon.rows_by_ring(horizon.marks(scene.lines), *table.shape)
    assert (table == everything).all()
    hidden = np.setdiff1d(np.arange(len(scene.lines.a)), horizon.kept)
    assert horizon.hides(scene.lines)[hidden].all()
    assert not horizon.hides(scene.lines[horizon.kept]).any()


def test_the_table_of_rings_gives_what_one_horizon_raised_from_front_to_back_gives() -> None:
    random = np.random.default_rng(3)
    columns, rings = 30, 40

    def marks(n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return (
            random.integers(0, columns, n),
            random.uniform(0, 50, n).astype(np.float32),
            random.integers(0, rings, n),
        )

    edges, (column, row, ring) = marks(300), marks(2000)
    pixels = column, row, ring - 3
    table = floating_horizon.rows_by_ring([tuple(map(np.copy, edges))], rings, columns)
    found = floating_horizon.above(pixels, table)
    assert 0.1 < found.mean() < 0.9
    assert (found == floating_horizon.above_one_by_one(pixels, edges, rings, columns)).all()


def test_a_slope_close_by_whose_edges_are_all_above_the_screen_hides_what_is_behind_it() -> None:
    # A wall over the whole picture: both of its long edges are off it, one above and one below.
    wall = (np.array([-900]), np.array([-500]), np.array([900]), np.array([-500]), 10.0)
    behind = (np.array([5]), np.array([40]), np.array([100]), np.array([44]), 50.0)
    ends = (np.concatenate([w, b]) for w, b in zip(wall[:4], behind[:4], strict=True))
    depth = np.array([wall[4], behind[4]])
    none = np.zeros(2, np.int64)
    lines = Lines(none, none, *ends, depth, depth)
    at, owner = bresenham.pixels(lines.x0, lines.y0, lines.x1, lines.y1, SIZE)
    assert len(at) == 96
    seen = shown(lines, at, owner, Camera(0, 0, 0))
    assert not seen.any()
    in_front = Lines(
        none, none, *(getattr(lines, k) for k in ("x0", "y0", "x1", "y1")), *([depth[::-1]] * 2)
    )
    assert shown(in_front, at, owner, Camera(0, 0, 0)).all()


def test_lines_of_one_triangle_do_not_hide_each_other() -> None:
    x0, y0 = np.array([20, 90, 55]), np.array([80, 70, 20])
    depth = np.array([10.0, 11.0, 14.0])
    lines = Lines(
        *[np.arange(3)] * 2, x0, y0, np.roll(x0, -1), np.roll(y0, -1), depth, np.roll(depth, -1)
    )
    at, owner = bresenham.pixels(lines.x0, lines.y0, lines.x1, lines.y1, SIZE)
    assert shown(lines, at, owner, Camera(0, 0, 0)).all()


def test_a_frame_without_lines_has_no_pixels() -> None:
    none = np.zeros(0, np.int64)
    lines = Lines(none, none, none, none, none, none, none + 1.0, none + 1.0)
    assert not len(shown(lines, none, none, Camera(0, 0, 0)))


@pytest.mark.parametrize("seed", range(4))
def test_what_lies_beside_the_screen_hides_what_is_on_it_when_one_looks_down(seed: int) -> None:
    """The middle of a picture twice as wide is the same picture."""
    rough = height_field(np.random.default_rng(seed).integers(0, 256, (128, 128)), Flyover())
    settings = Settings()
    camera = Camera(40.0, 50.0, 90.0, theta_y=math.radians(40.0), theta_z=0.3 + seed)
    narrow = frame.draw(rough, camera, settings, (96, 72)).picture
    wide = frame.draw(rough, camera, settings, (192, 72)).picture
    assert np.array_equal(narrow, wide[:, 48:144])
