"""Billboards beyond 2006: facing the eye's place, cut where they cross, on slopes, seen from above;
their pictures' white; and places read from a file."""

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from commands import landscape, refused
from sprite_stage import (
    BLUE,
    CONIFER,
    NORTH,
    PLANT_GREEN,
    RED,
    TREE,
    covered,
    element,
    looking,
    pictures,
    put,
    seen,
)
from stage import SMALL_BEST, Stage, close, pixel, project

from framelens.base.errors import InputError
from landscape.elements.atlas import on_white, read_picture, white_to_alpha
from landscape.elements.best.sprites.backs import back_from_above
from landscape.elements.best.sprites.crossings import cut, cuts, neighbours
from landscape.elements.best.sprites.refined_quads import on_slope
from landscape.elements.best.sprites.refined_sprites import RefinedSprites
from landscape.elements.best.sprites.slope_billboards import place_axes
from landscape.elements.places_file import as_csv, read_places
from landscape.elements.planting import DEER, PLANT, Sprites
from landscape.elements.transparent_elements import TransparentElements, billboards
from landscape.files.assets import shipped
from landscape.files.images import read_image
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField

EAST_OF_NORTH = replace(NORTH, yaw=25.0)


@pytest.fixture(scope="module")
def sprites(the_stage: Stage, tmp_path_factory) -> Iterator[RefinedSprites]:
    """The element, its cells of one colour each."""
    assets = pictures(tmp_path_factory.mktemp("billboards"))
    with element(the_stage, RefinedSprites, assets) as made:
        yield made


def corners(stage: Stage, sprites: RefinedSprites, pose: Pose, faces: str) -> np.ndarray:
    """Return the corners of the first sprite's rectangle."""
    seen(stage, sprites, pose, transparent__faces=faces)
    vertices, *_, indices = sprites.prepare(looking(pose))
    return vertices[np.unique(indices)[:4]]


def test_a_billboard_that_faces_the_place_stays_while_the_camera_turns(
    stage: Stage, sprites: RefinedSprites
) -> None:
    put(sprites, [(20.6, 3.0, 18.0)], [TREE])
    turned = {
        faces: [corners(stage, sprites, pose, faces) for pose in (NORTH, EAST_OF_NORTH)]
        for faces in ("plane", "place")
    }
    assert np.allclose(*turned["place"], atol=1e-6)
    # Parallel to the picture, it turns with the camera: by 25 degrees, half a unit out.
    moved = np.abs(np.subtract(*turned["plane"])).max()
    assert moved == pytest.approx(0.5 * math.sin(math.radians(25.0)), abs=0.01)


@pytest.mark.parametrize("upright", [False, True])
def test_the_axes_are_at_right_angles_to_the_line_of_sight_and_to_each_other(upright) -> None:
    frame = looking(NORTH)
    points = np.array([[22.0, 3.2, 17.0], [15.0, 5.0, 19.0], [20.0, 1.0, 20.0], [20.0, 3.0, 26.0]])
    right, up = place_axes(frame, points, upright)
    up = np.broadcast_to(up, right.shape)
    assert np.allclose(np.linalg.norm(right, axis=1), 1) and np.allclose((right * up).sum(1), 0)
    assert np.allclose(right[:, 1], 0)
    line = points - frame.eye
    assert np.allclose((right * line).sum(1)[[0, 1, 3]], 0)
    # One seen in front has its right on the right: left is west when the eye looks north.
    assert right[0, 0] > 0 and right[3, 0] < 0
    if upright:
        assert (up == (0, 1, 0)).all()
    else:
        assert np.allclose((up * line).sum(1)[[0, 1, 3]], 0) and (up[[0, 1, 3], 1] > 0).all()


def test_neighbours_are_all_pairs_nearer_than_their_half_widths_together() -> None:
    rng = np.random.default_rng(5)
    places = np.insert(rng.uniform(0, 9, (400, 2)), 1, rng.uniform(0, 9, 400), axis=1)
    widths = rng.uniform(0.1, 0.8, 400)
    away = np.hypot(*(places[:, None, a] - places[None, :, a] for a in (0, 2)))
    near = np.triu(away < 0.5 * (widths[:, None] + widths[None]), 1)
    found = {tuple(sorted(pair)) for pair in neighbours(places, widths).tolist()}
    assert found == set(map(tuple, np.argwhere(near).tolist())) and len(found) > 100
    assert neighbours(places[:1], widths[:1]).shape == (0, 2)


def test_two_that_cross_are_cut_along_the_line_in_which_they_meet() -> None:
    places = np.array([[0.0, 0.0, 0.0], [0.1, 0.0, 0.1]])
    right = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    quads = billboards(places, np.ones((2, 2)), right, np.array([0.0, 1.0, 0.0]))
    owner, at_s, at = cuts(quads, np.array([[0, 1]]))
    # They meet at x 0.1, z 0.
    assert owner.tolist() == [0, 1] and at_s.all() and at == pytest.approx([0.6, 0.4])
    pieces = cut(owner, at_s, at)
    boxes = {
        (o, *b) for o, b in zip(pieces.owner.tolist(), pieces.boxes.round(6).tolist(), strict=True)
    }
    assert boxes == {(0, 0, 0, 0.6, 1), (0, 0.6, 0, 1, 1), (1, 0, 0, 0.4, 1), (1, 0.4, 0, 1, 1)}
    parallel = quads[:1] + np.array([[[0.1, 0.0, 0.01]]])
    assert not len(cuts(np.concatenate([quads[:1], parallel]), np.array([[0, 1]]))[0])
    beside = quads[1:] + np.array([[[0.0, 0.0, 0.9]]])
    assert not len(cuts(np.concatenate([quads[:1], beside]), np.array([[0, 1]]))[0])


def test_a_leaning_one_is_cut_across_where_it_goes_through_an_upright_one() -> None:
    up = np.array([[0.0, 1.0, 0.0], [0.0, 0.8, -0.6]])
    places = np.array([[0.0, 0.0, 0.0], [0.05, 0.0, 0.2]])
    quads = billboards(places, np.ones((2, 2)), np.array([1.0, 0.0, 0.0]), up)
    owner, at_s, at = cuts(quads, np.array([[0, 1]]))
    # It reaches z 0 a third of the way up; there the other is 0.2667 units high.
    assert owner.tolist() == [0, 1] and not at_s.any()
    assert at == pytest.approx([1 - 0.8 / 3, 2 / 3])


def test_several_cuts_of_one_make_pieces_without_gap_or_overlap() -> None:
    owner, at = np.array([3, 3, 3, 8]), np.array([0.7, 0.2, 0.5, 0.5])
    pieces = cut(owner, np.array([True, True, False, True]), at)
    areas = (pieces.boxes[:, 2] - pieces.boxes[:, 0]) * (pieces.boxes[:, 3] - pieces.boxes[:, 1])
    for one, count in ((3, 6), (8, 2)):
        mine = pieces.owner == one
        assert mine.sum() == count and areas[mine].sum() == pytest.approx(1.0)


@pytest.mark.parametrize("fixed", [False, True])
def test_of_two_that_cross_each_is_in_front_on_its_own_side(
    stage: Stage, sprites: RefinedSprites, fixed: bool
) -> None:
    # Equally far from the eye, 0.3 units apart: they meet halfway.
    put(sprites, [(19.85, 3.0, 18.5), (20.15, 3.0, 18.5)], [TREE, CONIFER])
    shown = {"transparent__faces": "place", "transparent__upright": True}
    picture = seen(stage, sprites, transparent__split=fixed, **shown)
    left, right = (pixel(picture, project(NORTH, (x, 3.5, 18.5))) for x in (19.8, 20.2))
    if fixed:
        assert close(left, RED[:3], 12) and close(right, BLUE[:3], 12)
    else:
        assert close(left, right, 12), "one covers the other on both sides"


def test_the_parts_of_cut_ones_show_the_whole_pictures(
    stage: Stage, sprites: RefinedSprites
) -> None:
    rng = np.random.default_rng(2)
    places = np.stack([rng.uniform(19, 21, 12), np.full(12, 3.0), rng.uniform(16, 18, 12)], axis=1)
    put(sprites, places, np.full(12, TREE), (0.6, 0.7))
    shown = {"transparent__faces": "place", "transparent__upright": True}
    whole = seen(stage, sprites, **shown)
    parts = seen(stage, sprites, transparent__split=True, **shown)
    assert np.abs(whole - parts).max() <= 3 and covered(whole).sum() > 1000


def test_on_a_slope_feet_stay_and_what_was_upright_is_perpendicular_to_it() -> None:
    places, slopes = np.array([[5.0, 2.0, 5.0]]), np.array([[0.75, 0.0]])
    quads = places[:, None] + np.array([[[0, 0, 0], [0, 1, 0], [1, 0, 0], [0, 0, 1.0]]])
    foot, top, east, south = (on_slope(quads, places, slopes) - places[:, None])[0]
    assert np.allclose(foot, 0) and np.allclose(top, (-0.6, 0.8, 0.0))
    assert np.allclose(east, (0.8, 0.6, 0.0)) and np.allclose(south, (0, 0, 1))


@pytest.mark.parametrize("cell", [TREE, PLANT])
@pytest.mark.parametrize("tilted", [False, True])
def test_trees_and_plants_lean_with_the_slope(
    stage: Stage, sprites: RefinedSprites, cell: int, tilted: bool
) -> None:
    put(sprites, [(20.0, 3.0, 17.0)], [cell], slope=(0.5, 0.0))
    picture = seen(stage, sprites, transparent__follow_slope=tilted, plants__sway=0.0)
    # Right of the foot the ground is higher: there is nothing of an inclined one below it.
    column, row = project(NORTH, (20.42, 3.1, 17.0))
    assert covered(picture)[int(row), int(column)] != tilted
    assert close(
        pixel(picture, project(NORTH, (19.9, 3.5, 17.0))),
        (RED if cell == TREE else PLANT_GREEN)[:3],
    )


def test_a_deer_from_above_is_long_symmetric_and_has_no_legs() -> None:
    for name, antlers in (("deer_stag.png", True), ("deer_doe.png", False)):
        picture = back_from_above(read_image(shipped() / name), 96)
        solid = picture[..., 3] > 127
        rows, columns = (np.flatnonzero(solid.any(axis=axis)) for axis in (1, 0))
        assert np.ptp(columns) > 55, "as long as in the side view"
        assert np.ptp(rows) < (45 if antlers else 24)
        assert (solid != solid[::-1]).mean() < 0.03, "both sides alike"
        # The rear half is the trunk: one run of opaque texels in each column.
        for column in range(60, int(columns[-1]) - 3):
            run = np.flatnonzero(solid[:, column])
            assert 8 < len(run) == np.ptp(run) + 1
    assert not back_from_above(np.zeros((40, 40, 4), np.uint8), 16)[..., 3].any()


@pytest.mark.seldom(14, first=1)
@pytest.mark.parametrize("back", [False, True])
def test_a_deer_from_above_is_a_back_and_not_a_line(
    stage: Stage, tmp_path: Path, back: bool
) -> None:
    body = np.zeros((480, 512, 4), np.uint8)
    body[200:330, 60:450] = (250, 0, 0, 255)
    names = {name: body for name in ("stag.png", "stag_walking.png", "doe.png", "doe_grazing.png")}
    others = {name: RED for name in OTHER_PICTURES}
    assets = pictures(tmp_path, {**others, **names})
    above = Pose(20.0, 7.0, 16.0, 0.0, -90.0)
    kinds = {"deer.variety": True}
    with element(stage, RefinedSprites, assets, kinds) as sprites:
        put(sprites, [(20.0, 3.0, 16.0)], [DEER])
        changes = {"deer__variety": True, "deer__back": back, "transparent__upright": True}
        picture = covered(seen(stage, sprites, above, **changes))
    assert (picture.sum() > 60) == back


OTHER_PICTURES = (
    "fern.png",
    "oxeye.png",
    "willowherb.png",
    "marram.png",
    "heather.png",
    "oak_leaning.png",
    "oak_tall.png",
    "oak_young.png",
    "hazel.png",
    "birch_tall.png",
    "birch_young.png",
    "pine.png",
    "spruce_young.png",
    "bramble.png",
)


def test_white_becomes_transparent_and_other_colours_stay() -> None:
    image = np.array([[(255, 255, 255, 255), (250, 30, 20, 255), (254, 254, 254, 255)]], np.uint8)
    keyed = white_to_alpha(image)
    assert keyed[0, :, 3].tolist()[:2] == [0, 255] and keyed[0, 2, 3] <= 3
    assert keyed[0, 1].tolist() == [250, 30, 20, 255]
    # A soft edge on white keeps colour and opacity.
    edge = np.array([[(10, 60, 20, 128)]], np.uint8)
    back = white_to_alpha(on_white(edge))[0, 0].astype(int)
    painted = on_white(edge)[0, 0, :3]
    assert np.allclose(on_white(back[None, None].astype(np.uint8))[0, 0, :3], painted, atol=2)


def test_a_picture_without_alpha_is_keyed_and_one_with_alpha_is_kept(tmp_path: Path) -> None:
    from PIL import Image

    square = np.full((8, 8, 3), 255, np.uint8)
    square[2:6, 2:6] = (20, 90, 30)
    Image.fromarray(square).save(tmp_path / "rgb.png")
    found = read_picture(tmp_path / "rgb.png", "alpha")
    assert found[0, 0, 3] == 0 and found[4, 4].tolist() == [20, 90, 30, 255]
    Image.fromarray(np.dstack([square, np.full((8, 8), 255, np.uint8)])).save(tmp_path / "rgba.png")
    assert (read_picture(tmp_path / "rgba.png", "alpha")[..., 3] == 255).all()
    assert (read_picture(tmp_path / "rgba.png", "keyed")[0, 0, 3]) == 0
    assert (read_picture(tmp_path / "rgb.png", "white")[..., 3] == 255).all()


def plain(n: int = 40) -> Sprites:
    rng = np.random.default_rng(3)
    places = np.stack([rng.uniform(1, 39, n), np.full(n, 2.0), rng.uniform(1, 39, n)], axis=1)
    return Sprites(
        places, rng.uniform(0.1, 0.6, (n, 2)), rng.integers(0, 7, n), rng.random(n) < 0.5
    )


LEVEL = HeightField(np.full((3, 3), 2.0, np.float32), 40.0, 0.6)


def test_what_is_written_is_read_again(tmp_path: Path) -> None:
    path, wrote = tmp_path / "p.csv", plain()
    path.write_text(as_csv(wrote))
    read, read_pictures, tints = read_places(path, LEVEL, {"trees", "deer", "plants"})
    for one, other in zip(vars(wrote).values(), vars(read).values(), strict=True):
        assert (one == other).all()
    assert (read_pictures == wrote.cells).all() and (tints == 255).all()
    trees, *_ = read_places(path, LEVEL, {"trees"})
    assert (trees.cells == wrote.cells[wrote.cells < DEER]).all()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "expected a first line with kind, x, z, width, height, mirrored"),
        ("kind,x,z\n", "expected a first line with kind, x, z, width, height, mirrored"),
        ("yew,1,2,1,1,0", "line 2: kind: expected one of broadleaf"),
        ("birch,1,2,1,1,yes", "line 2: mirrored: expected one of 0, 1, not 'yes'"),
        ("birch,1,two,1,1,0", "line 2: z: expected a number from -10000 to 10000, not 'two'"),
        ("birch,1,nan,1,1,0", "line 2: z: expected a number from -10000 to 10000, not 'nan'"),
        ("birch,1,2,0,1,0", "line 2: width: expected a number from 0.001 to 10000, not '0'"),
        ("birch,1,2,1,1", "line 2: mirrored: expected one of 0, 1"),
        ("birch,1,2,1,1,0,7", "line 2: expected 6 values"),
    ],
)
def test_a_bad_file_is_refused_with_its_line(tmp_path: Path, text: str, message: str) -> None:
    header = "kind,x,z,width,height,mirrored\n" if "," in text and "\n" not in text else ""
    (tmp_path / "bad.csv").write_text(header + text)
    with pytest.raises(InputError, match=r"bad\.csv") as caught:
        read_places(tmp_path / "bad.csv", LEVEL, {"trees"})
    assert message in str(caught.value)


@pytest.mark.parametrize("preset", ["2006", "best"])
@pytest.mark.sweep(8, first=2)
def test_an_island_with_saved_places_looks_as_before(tmp_path: Path, preset: str) -> None:
    # The island of other tests, so that the cache has what takes long.
    few = [f"--set={key}={value}" for key, value in SMALL_BEST.items()] + ["--preset", preset]
    path, only = tmp_path / "saved.csv", ["--only", "trees,deer,plants", "--samples", "0"]
    assert "130 sprites" in landscape("places", str(path), *few).out
    look = ["render", "fig17b", *only, "--size", "120x90", "--quiet", *few]
    again = ["--set", f"transparent.places={path}", "--set", "trees.count=7"]
    for name, more in (("a", []), ("b", again)):
        landscape(*look, *more, "--set", "transparent.radius=20", "--out", f"{tmp_path}/{name}.png")
    one, other = (read_image(tmp_path / f"{name}.png") for name in "ab")
    assert (one == other).all() and len(np.unique(one.reshape(-1, 4), axis=0)) > 50


@pytest.mark.seldom(3, first=2)
def test_a_missing_file_of_places_is_named() -> None:
    done = landscape("render", "fig17a", "--set", "transparent.places=nowhere.csv")
    refused(done, "setting transparent.places", "nowhere.csv: no such file")


def test_without_sway_by_size_all_plants_move_as_the_report_says(stage: Stage, tmp_path) -> None:
    with element(stage, TransparentElements, pictures(tmp_path)) as sprites:
        put(sprites, [(20.0, 3.0, 17.0)], [PLANT], (0.05, 0.05))
        for by_size, share in ((False, 1.0), (True, 0.05 / 0.14)):
            seen(stage, sprites, plants__sway_by_size=by_size)
            vertices, *_ = sprites.prepare(looking(NORTH, kt=0.0))
            # Section 5.2.2: dx of the top middle at kt 0.
            dx = 0.05 * math.cos(-1.2 * 20.0 - 0.744 * 17.0)
            assert vertices[4, 0] - 20.0 == pytest.approx(share * dx, abs=1e-5)
