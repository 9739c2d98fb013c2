"""Posters in tiles, passes for compositing, and rigs of several cameras."""

import math
from pathlib import Path

import numpy as np
import pytest
from commands import Shell, need_library, refused
from PIL import Image
from stage import SMALL

from framelens.base.errors import InputError
from landscape import poster
from landscape.files.png_strips import PngStrips
from landscape.film.rig import AROUND, FACE, SIDES, STEREO, around, drawn_size, picture
from landscape.film.sources import Wanted, film_of
from landscape.film.stage import Drawing
from landscape.frame import Pose
from landscape.offscreen import Offscreen
from landscape.passes import FARTHEST, passes
from landscape.scene.scene import Moment, scene

SIZE = (200, 120)
ASKED = {"preset": "2006", "settings": SMALL, "samples": 0}


# ---- posters


def drawn_in_tiles(view: str, out: Path, tile: tuple[int, int] = (64, 48), **more) -> np.ndarray:
    need_library("OSMesa")
    poster.draw(view, SIZE, out, {**ASKED, **more}, tile=tile)
    with Image.open(out) as image:
        return np.asarray(image)


def drawn_whole(view: str, only: tuple[str, ...] | None = None, **more) -> np.ndarray:
    with Offscreen(SIZE, **{**ASKED, **more}, only=only) as offscreen:
        offscreen.look(view)
        return offscreen.draw()


@pytest.mark.seldom(10, first=4)
@pytest.mark.parametrize("view", ["fig2a", "fig35e"])
def test_a_poster_is_the_picture_drawn_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, view: str
) -> None:
    """OpenGL interpolates from the framebuffer's corner: a tile has other roundings, of a level.

    The ground alone is the same byte for byte.
    """
    tiled = drawn_in_tiles(view, tmp_path / "a.png")
    shown = poster.found(view)[0].elements
    shown = tuple(name for name in shown if name not in poster.found(view)[0].overlay)
    whole = drawn_whole(view, shown if view == "fig35e" else None)
    assert tiled.shape == whole.shape
    differ = np.abs(tiled.astype(int) - whole).max(axis=2)
    if view == "fig2a":
        assert not differ.any()
    assert (differ > 1).mean() < 0.01 and (differ > 8).mean() < 0.002
    # What is larger than a viewport is cut into blocks, with a frustum each: across, and down, too.
    for most, tile in ((128, (64, 48)), (96, (32, 32))):
        monkeypatch.setattr(poster, "BLOCK", most)
        blocks = drawn_in_tiles(view, tmp_path / "b.png", tile)
        assert (np.abs(blocks.astype(int) - whole).max(axis=2) > 8).mean() < 0.02


def test_what_is_clipped_by_pixels_is_clipped_in_tiles_too(tmp_path: Path) -> None:
    """The hall's sky is drawn in a rectangle of the picture, and its tone copies all of it."""
    asked = {"only": ("sky", "tone"), "preset": None}
    asked["settings"] = {"tone.contrast": 1.5, "tone.method": "pixels"}
    tiled = drawn_in_tiles("hall", tmp_path / "a.png", **asked)
    whole = drawn_whole("hall", **asked)
    assert len(np.unique(whole)) > 50
    assert (np.abs(tiled.astype(int) - whole).max(axis=2) > 2).mean() < 0.001


@pytest.mark.seldom(14)
@pytest.mark.slow
def test_what_is_laid_over_the_blocks_is_drawn_in_tiles_and_refused_in_blocks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The regions' inset is one picture's corner, and would be in each block's."""
    need_library("OSMesa")
    asked = {"samples": 0, "settings": {"voxel.regions": 4}}
    poster.draw("voxel_regions", SIZE, tmp_path / "a.png", asked, tile=(64, 48))
    with Image.open(tmp_path / "a.png") as image:
        tiled = np.asarray(image).astype(int)
    shown = tuple(name for name in scene("voxel").elements if name not in scene("voxel").overlay)
    with Offscreen(SIZE, **asked, only=shown) as offscreen:
        offscreen.look("voxel_regions")
        whole = offscreen.draw()
    assert (np.abs(tiled - whole).max(axis=2) > 8).mean() < 0.01
    monkeypatch.setattr(poster, "BLOCK", 128)
    with pytest.raises(InputError, match=r"--poster: expected at most 16384 .* debug\.regions"):
        poster.draw("voxel_regions", SIZE, tmp_path / "b.png", asked, tile=(64, 48))
    assert not (tmp_path / "b.png").exists()


def test_a_poster_is_refused_where_it_cannot_be_drawn(shell: Shell, tmp_path: Path) -> None:
    refused(shell("render", "fig2a", "--poster", "70000x10"), "from 1 to 65536")
    refused(shell("render", "fig2a", "--poster", "64x48", "--passes"), "not with --passes")


def test_strips_make_one_png(tmp_path: Path) -> None:
    rng = np.random.default_rng(1)
    pixels = rng.integers(0, 256, (37, 23, 3), np.uint8)
    levels = rng.integers(0, 65536, (37, 23), np.uint16)
    for array, grey in ((pixels, False), (levels, True)):
        data: list[bytes] = []
        png = PngStrips(data.append, (23, 37), grey)
        for top in range(0, 37, 10):
            png.add(array[top : top + 10])
        png.finish()
        (tmp_path / "a.png").write_bytes(b"".join(data))
        with Image.open(tmp_path / "a.png") as image:
            assert np.array_equal(np.asarray(image), array)


# ---- passes


def test_passes_say_how_far_away_each_pixel_is_and_whose_it_is() -> None:
    need_library("OSMesa")
    asked = {"size": SIZE, "preset": "2006", "settings": SMALL, "only": ("ground", "sky")}
    with Offscreen(**asked, samples=0) as offscreen:
        offscreen.look("fig35e")
        shown = offscreen.draw()
        assert offscreen.scene is not None
        camera = offscreen.scene.settings.camera
        pose = offscreen.moment.pose
        height = offscreen.scene.height

        depth, masks = passes("fig35e", asked, None, False)
        assert set(masks) == {"ground", "sky"}
        assert not (masks["ground"] & masks["sky"]).any()
        ground = masks["ground"] > 0
        assert 0.2 < ground.mean() < 0.8

        # In the lowest row's middle the ray goes down half the field of view: where it meets the
        # ground, its distance along the line of sight is the depth.
        row, column = SIZE[1] - 1, SIZE[0] // 2
        assert ground[row, column]
        units = depth[row, column] / FARTHEST * camera.far
        top = math.tan(math.radians(camera.fov) / 2)
        y = (0.5 - (row + 0.5) / SIZE[1]) * 2 * top
        yaw, pitch = math.radians(pose.yaw), math.radians(pose.pitch)
        ahead = math.cos(pitch) - y * math.sin(pitch)
        place = pose.x + units * ahead * math.sin(yaw), pose.z - units * ahead * math.cos(yaw)
        under = float(pose.y or 0.0) + units * (math.sin(pitch) + y * math.cos(pitch))
        assert under == pytest.approx(float(height(*place)), abs=0.02)
        assert len(shown) == SIZE[1]


# ---- rigs


def test_an_equirectangular_picture_has_each_direction_in_its_place() -> None:
    """Each face shows its own directions as colours; the picture must show those of its pixels."""
    side, size = 64, (96, 48)
    reach = FACE * (2 * (np.arange(side) + 0.5) / side - 1)
    faces = []
    for yaw, pitch in SIDES:
        a, b = math.radians(yaw), math.radians(pitch)
        right = np.array([math.cos(a), 0, math.sin(a)])
        ahead = np.array([math.cos(b) * math.sin(a), math.sin(b), -math.cos(b) * math.cos(a)])
        up = np.cross(right, ahead)
        ray = ahead + reach[None, :, None] * right - reach[:, None, None] * up
        ray /= np.linalg.norm(ray, axis=2, keepdims=True)
        faces.append(np.rint(127.5 + 127.5 * ray).astype(np.uint8))
    found = around(np.stack(faces), size).astype(float)
    up = math.pi * (0.5 - (np.arange(48) + 0.5) / 48)[:, None]
    turn = 2 * math.pi * ((np.arange(96) + 0.5) / 96 - 0.5)[None]
    ray = np.stack(
        [np.cos(up) * np.sin(turn), np.sin(up) + 0 * turn, -np.cos(up) * np.cos(turn)], axis=2
    )
    assert np.abs(found - (127.5 + 127.5 * ray)).max() < 2.5


def test_two_eyes_stand_side_by_side_and_look_the_same_way() -> None:
    moment = Moment(Pose(1.0, 2.0, 3.0, 90.0, -10.0), drawn_size(STEREO, (8, 2)))
    seen: list[Pose] = []

    def draw(each: Moment) -> np.ndarray:
        seen.append(each.pose)
        return np.full((2, 4, 3), len(seen), np.uint8)

    found = picture(STEREO, (8, 2), moment, 0.1, draw)
    assert found.shape == (2, 8, 3) and found[0, :, 0].tolist() == [1] * 4 + [2] * 4
    left, right = seen
    assert right.z - left.z == pytest.approx(0.0038) and left.x == pytest.approx(right.x)
    assert (left.y, left.yaw, left.pitch) == (2.0, 90.0, -10.0) == (right.y, right.yaw, right.pitch)


def test_a_film_all_around_looks_at_faces_of_a_cube_and_a_recording_has_one_camera(
    shell: Shell, tmp_path: Path
) -> None:
    asked = Wanted(Drawing((64, 32), rig=AROUND))
    look = film_of(["fig2a"], asked).parts[0].clip.look  # type: ignore[attr-defined]
    assert math.tan(math.radians(look.values.camera.fov / 2)) == pytest.approx(FACE)
    assert not set(look.shown) & {"map", "sword"}
    with pytest.raises(InputError, match="--camera 360: expected views or a path"):
        film_of(["tour"], asked)
    words = ["--size", "64x32", "--samples", "0", "--fps", "10", "--seconds", "0.1", "--jobs", "1"]
    out = tmp_path / "a.gif"
    assert shell("film", "fig2a", *words, "--camera", "360", "--out", out).status == 0
    with Image.open(out) as image:
        assert image.size == (64, 32)
