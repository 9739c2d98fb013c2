"""Unusual and bad input from a user either works or ends with one clear error line.

Every case is a complete command line. A clear error is exit status 2 and a single line on standard
error that begins with "landscape: " and names the file or the key. No files are left behind.
"""

import json
import struct
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from commands import Done, Shell, refused
from PIL import Image

from landscape.elements import settings
from landscape.settings import declare

GREY = np.random.default_rng(1).integers(0, 255, (48, 48), dtype=np.uint8)
SMALL = ("render", "--preset", "2006", "--size", "40x30", "--samples", "0")
POSE = ("--pose", "20,3,24,0,-20")


@pytest.fixture
def shell(the_shell: Shell, tmp_path: Path) -> Shell:
    the_shell.cwd = tmp_path
    return the_shell


def succeeded(done: Done, path: Path) -> np.ndarray:
    """Assert that a command succeeded without errors or warnings; return its image."""
    assert (done.status, done.err) == (0, ""), done
    with Image.open(path) as image:
        return np.array(image)


def files(folder: Path) -> dict[str, bytes]:
    return {p.name: p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


# --- height images -----------------------------------------------------------------------------


def draw_heights(shell: Shell, image: str) -> Done:
    """Render the ground from a height image instead of the default island."""
    change = f"ground.height_image={image}"
    drawn = (*SMALL, *POSE, *shell.small, "--only", "ground", "--set", change)
    return shell(*drawn, "--out", "out.png")


def save(values: np.ndarray, path: Path, mode: str = "") -> None:
    image = Image.fromarray(values)
    (image.convert(mode) if mode else image).save(path, compress_level=1)


@pytest.fixture(scope="module")
def plain_heights(the_shell: Shell, tmp_path_factory: pytest.TempPathFactory) -> np.ndarray:
    """The image rendered from the 8-bit grey height image."""
    the_shell.cwd = tmp_path_factory.mktemp("plain")
    save(GREY, the_shell.cwd / "grey.png")
    picture = succeeded(draw_heights(the_shell, "grey.png"), the_shell.cwd / "out.png")
    assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 50, "the pose shows no ground"
    return picture


@pytest.mark.sweep(8)
@pytest.mark.parametrize("kind", ["16 bits", "palette", "alpha", "grey and alpha", "RGB", "TIFF"])
def test_a_height_image_in_any_format_gives_the_same_island_as_8_bit_grey(
    kind: str, shell: Shell, plain_heights: np.ndarray
) -> None:
    path = shell.cwd / ("heights.tif" if kind == "TIFF" else "heights.png")
    colours = np.dstack([GREY, 255 - GREY, GREY // 2])
    match kind:
        case "16 bits":
            save(GREY.astype(np.uint16) * 257, path)
        case "palette":
            image = Image.fromarray(GREY, "L").convert("P")
            image.putpalette([v for grey in range(256) for v in (grey, 255 - grey, 7)])
            image.save(path)
        case "alpha":
            save(np.dstack([colours, np.full_like(GREY, 128)]), path)
        case "grey and alpha":
            save(GREY, path, "LA")
        case "RGB":
            save(colours, path)
        case "TIFF":
            Image.fromarray(GREY.astype(np.float32) / 255).save(path)

    picture = succeeded(draw_heights(shell, path.name), shell.cwd / "out.png")
    far = np.abs(picture.astype(int) - plain_heights.astype(int)).max()
    assert far <= (2 if kind == "TIFF" else 0)


def test_a_height_image_of_one_pixel_is_a_plain(shell: Shell) -> None:
    save(np.full((1, 1), 128, np.uint8), shell.cwd / "one.png")
    save(np.full((9, 9), 128, np.uint8), shell.cwd / "nine.png")
    one = succeeded(draw_heights(shell, "one.png"), shell.cwd / "out.png")
    nine = succeeded(draw_heights(shell, "nine.png"), shell.cwd / "out.png")
    assert (one == nine).all()


def test_a_height_image_that_is_not_square_is_stretched_over_the_map(
    shell: Shell, plain_heights: np.ndarray
) -> None:
    save(np.repeat(GREY, 3, axis=1), shell.cwd / "wide.png")
    picture = succeeded(draw_heights(shell, "wide.png"), shell.cwd / "out.png")
    assert picture.shape == plain_heights.shape and (picture != picture[0, 0]).any()


@pytest.mark.parametrize("deep", [False, True], ids=["8 bits", "16 bits"])
def test_a_height_image_8000_pixels_wide_is_accepted(deep: bool, shell: Shell) -> None:
    wide = np.repeat(np.repeat(GREY, 4, axis=0), 167, axis=1)[:, :8000]
    save(wide.astype(np.uint16) * 257 if deep else wide, shell.cwd / "wide.png")
    succeeded(draw_heights(shell, "wide.png"), shell.cwd / "out.png")


@pytest.mark.seldom(14, first=6)
def test_a_very_large_height_image_is_accepted_without_a_warning(shell: Shell) -> None:
    # At 96 megapixels Pillow would warn of a "decompression bomb".
    Image.new("1", (12000, 8000), 1).save(shell.cwd / "large.png")
    succeeded(draw_heights(shell, "large.png"), shell.cwd / "out.png")


@pytest.mark.seldom(13, first=4)
def test_an_excessively_large_image_is_refused(shell: Shell) -> None:
    Image.new("1", (20000, 10000)).save(shell.cwd / "bomb.png")
    refused(draw_heights(shell, "bomb.png"), "bomb.png", "too large")


@pytest.mark.parametrize("name", ["é ü.png", " leading.png", "-.png", "n\u0303 山.png"])
def test_a_file_name_may_contain_spaces_and_any_letters(
    name: str, shell: Shell, plain_heights: np.ndarray
) -> None:
    save(GREY, shell.cwd / name)
    change = f"ground.height_image={shell.cwd}/{name}"
    drawn = (*SMALL, *POSE, *shell.small, "--only", "ground", "--set", change)
    done = shell(*drawn, "--out", f"o {name}")
    assert (succeeded(done, shell.cwd / f"o {name}") == plain_heights).all()
    assert done.out == f"o {name}\n"


def broken_images(folder: Path) -> None:
    """Write files that are not complete images."""
    save(GREY, folder / "whole.png")
    whole = (folder / "whole.png").read_bytes()
    Image.fromarray(np.dstack([GREY] * 3)).save(folder / "whole.jpg")
    (folder / "truncated.png").write_bytes(whole[: len(whole) // 2])
    (folder / "header.png").write_bytes(whole[:20])
    (folder / "empty.png").write_bytes(b"")
    (folder / "text.png").write_text("not an image\n")
    (folder / "mesh.png").write_bytes(ply())
    (folder / "folder.png").mkdir()
    jpeg = (folder / "whole.jpg").read_bytes()
    (folder / "truncated.jpg").write_bytes(jpeg[: len(jpeg) // 2])


@pytest.mark.parametrize(
    "name",
    ["truncated.png", "header.png", "empty.png", "text.png", "mesh.png", "folder.png"]
    + ["truncated.jpg", "missing.png", "~nosuchuser/x.png", "x" * 300 + ".png", "two\nlines.png"],
)
def test_a_file_that_is_not_an_image_is_refused_by_name(name: str, shell: Shell) -> None:
    broken_images(shell.cwd)
    before = files(shell.cwd)
    refused(draw_heights(shell, name), name.replace("\n", " "))
    assert files(shell.cwd) == before


def test_an_image_damaged_anywhere_never_ends_in_a_traceback(shell: Shell) -> None:
    save(GREY, shell.cwd / "whole.png")
    whole = bytearray((shell.cwd / "whole.png").read_bytes())
    rng = np.random.default_rng(5)
    for _ in range(25):
        damaged = whole.copy()
        for at in rng.integers(8, 120, 3):
            damaged[at] = rng.integers(256)
        (shell.cwd / "damaged.png").write_bytes(damaged)
        done = draw_heights(shell, "damaged.png")
        if done.status != 0:
            refused(done, "damaged.png")
        assert done.status == 2 or done.err == ""


# --- meshes ------------------------------------------------------------------------------------

CORNERS = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1.5)]
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TRIANGLES = [(a, *two) for a, b, c, d in QUADS for two in ((b, c), (c, d))]
MIXED = [*QUADS[:3], *TRIANGLES[6:]]
ASCII = "ascii"
LITTLE = "binary_little_endian"
BIG = "binary_big_endian"
NUMBERS = {"float": "f", "double": "d", "uchar": "B", "int": "i", "uint": "I", "ushort": "H"}


def ply(
    form: str = ASCII,
    vertices: Sequence[Sequence[float]] = CORNERS,
    faces: Sequence[Sequence[int]] = TRIANGLES,
    counts: tuple[object, object] | None = None,
    extra: Sequence[str] = (),
    face_extra: Sequence[str] = (),
    name: str = "vertex_indices",
    index: str = "int",
    kind: str = "float",
    line_end: str = "\n",
) -> bytes:
    """Return a PLY file.

    ``extra`` and ``face_extra`` are the types of further properties, all of value 1. ``counts``
    replaces the element counts in the header.
    """
    promised = counts or (len(vertices), len(faces))
    head = ["ply", f"format {form} 1.0", "comment by hand", f"element vertex {promised[0]}"]
    head += [f"property {kind} {axis}" for axis in "xyz"]
    head += [f"property {type_} extra{k}" for k, type_ in enumerate(extra)]
    head += [f"element face {promised[1]}", f"property list uchar {index} {name}"]
    head += [f"property {type_} extra{k}" for k, type_ in enumerate(face_extra)]
    out = (line_end.join([*head, "end_header"]) + line_end).encode()
    rows = [([kind] * 3 + [*extra], [*v, *[1] * len(extra)]) for v in vertices]
    rows += [
        (["uchar"] + [index] * len(f) + [*face_extra], [len(f), *f, *[1] * len(face_extra)])
        for f in faces
    ]
    for types, values in rows:
        if form == ASCII:
            out += (" ".join(map(str, values)) + line_end).encode()
        else:
            order = "<" if form == LITTLE else ">"
            out += struct.pack(order + "".join(NUMBERS[t] for t in types), *values)

    return out


def draw_mesh(shell: Shell, data: bytes) -> Done:
    """Render a mesh, enlarged, in place of the rabbit."""
    (shell.cwd / "mesh.ply").write_bytes(data)
    place = {"mesh": "mesh.ply", "x": "20", "z": "20", "scale": "0.5", "yaw": "30"}
    changes = [f"--set=rabbit.{key}={value}" for key, value in place.items()]
    view = (*shell.small, "--pose", "20,ground,22,0,5", "--only=rabbit", "--out=out.png")
    return shell(*SMALL, *view, *changes)


@pytest.fixture(scope="module")
def plain_mesh(the_shell: Shell, tmp_path_factory: pytest.TempPathFactory) -> np.ndarray:
    """The image of the box as ASCII triangles."""
    the_shell.cwd = tmp_path_factory.mktemp("plain")
    picture = succeeded(draw_mesh(the_shell, ply()), the_shell.cwd / "out.png")
    assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 20, "the pose shows no mesh"
    return picture


GOOD_MESHES = {
    "little endian": ply(LITTLE),
    "big endian": ply(BIG),
    "quads": ply(faces=QUADS),
    "quads, little endian": ply(LITTLE, faces=QUADS),
    "quads and triangles": ply(faces=MIXED),
    "quads and triangles, little endian": ply(LITTLE, faces=MIXED),
    "quads and triangles, big endian": ply(BIG, faces=MIXED),
    "colours": ply(extra=["uchar"] * 3),
    "colours, little endian": ply(LITTLE, extra=["uchar"] * 4),
    "normals, big endian": ply(BIG, extra=["float"] * 3),
    "colours of faces": ply(LITTLE, face_extra=["uchar"] * 3),
    "colours of faces, mixed": ply(BIG, faces=MIXED, face_extra=["uchar"] * 3),
    "texture coordinates": ply(extra=["float"] * 2)
    .replace(b"extra0", b"s")
    .replace(b"extra1", b"t"),
    "vertex_index": ply(name="vertex_index"),
    "vertex_index, little endian": ply(LITTLE, name="vertex_index"),
    "unsigned indices": ply(BIG, index="uint"),
    "short indices": ply(LITTLE, index="ushort"),
    "doubles": ply(LITTLE, kind="double"),
    "Windows' line ends": ply(line_end="\r\n"),
    "blank lines": ply().replace(b"end_header\n", b"end_header\n\n") + b"\n\n",
    "a byte too many": ply(LITTLE) + b"\n",
    "a face of two corners": ply(faces=[*TRIANGLES, (0, 1)]),
    "edges": ply().replace(b"end_header", b"element edge 1\nproperty int a\nend_header") + b"0\n",
}


@pytest.mark.sweep(3)
@pytest.mark.parametrize("kind", GOOD_MESHES)
def test_a_mesh_in_any_variant_of_ply_looks_the_same(
    kind: str, shell: Shell, plain_mesh: np.ndarray
) -> None:
    picture = succeeded(draw_mesh(shell, GOOD_MESHES[kind]), shell.cwd / "out.png")
    # Flat quads may be split along the other diagonal, which changes the last bits of normals.
    assert np.abs(picture.astype(int) - plain_mesh.astype(int)).max() <= 2


NAN, INF = float("nan"), float("inf")
BAD_MESHES = {
    "empty": (b"", "PLY"),
    "a text": (b"o cube\nv 0 0 0\n", "PLY"),
    "the first line alone": (b"ply\n", "header"),
    "a header cut off": (ply()[:80], "header"),
    "a format of its own": (ply().replace(b"ascii", b"utf-16"), "format"),
    "no format": (ply().replace(b"format ascii 1.0\n", b"format\n"), "format"),
    "a type of its own": (ply().replace(b"float z", b"half z"), "half z"),
    "no z": (ply().replace(b"float z", b"float q"), "lack x, y or z"),
    "no list": (ply().replace(b"list uchar int vertex_indices", b"int a"), "vertex_indices"),
    "truncated vertices": (ply()[: ply().index(b"end_header") + 40], "truncated"),
    "truncated faces": (ply()[:-12], "truncated"),
    "truncated quads": (ply(faces=QUADS)[:-12], "truncated"),
    "truncated, little endian": (ply(LITTLE)[:-3], "truncated"),
    "truncated, big endian": (ply(BIG)[:-70], "truncated"),
    "truncated, mixed": (ply(LITTLE, faces=MIXED)[:-3], "truncated"),
    "no body, little endian": (ply(LITTLE, vertices=[], faces=[], counts=(8, 12)), "truncated"),
    "words for numbers": (ply().replace(b"1.5", b"one"), "one"),
    "no faces": (ply(faces=[]), "faces"),
    "no faces, little endian": (ply(LITTLE, faces=[]), "faces"),
    "nothing at all": (ply(vertices=[], faces=[]), "faces"),
    "NaN": (ply(vertices=[(NAN, 0, 0), *CORNERS[1:]]), "NaN"),
    "NaN, big endian": (ply(BIG, vertices=[(NAN, 0, 0), *CORNERS[1:]]), "NaN"),
    "infinity": (ply(LITTLE, vertices=[(0, INF, 0), *CORNERS[1:]]), "NaN or infinity"),
    "a number beyond floats": (ply().replace(b"1.5", b"1e300"), "NaN or infinity"),
    "an index too high": (ply(faces=[(0, 1, 8)]), "a face names a vertex"),
    "an index below 0": (ply(LITTLE, faces=[(0, 1, -1)]), "a face names a vertex"),
    "NaN for an index": (ply().replace(b"3 0 1 3", b"3 0 1 nan"), "a face names a vertex"),
    "NaN for a length": (ply().replace(b"3 0 1 3", b"nan 0 1 3"), "mesh.ply"),
    "a length below 0": (ply().replace(b"3 0 1 3", b"-3 0 1 3"), "a list of -3"),
    "10^11 vertices": (ply(counts=(10**11, 12)), "truncated"),
    "10^11 vertices, little endian": (ply(LITTLE, counts=(10**11, 12)), "truncated"),
    "10^17 faces": (ply(counts=(8, 10**17)), "truncated"),
    "10^17 faces, big endian": (ply(BIG, counts=(8, 10**17)), "truncated"),
    "5000 digits": (ply(counts=("9" * 5000, 12)), "element vertex 999"),
    "a count below 0": (ply(counts=(-8, 12)), "element vertex -8"),
    "a superscript count": (ply(counts=("²", 12)), "element vertex"),
}


@pytest.mark.parametrize("kind", BAD_MESHES)
def test_a_damaged_mesh_is_refused_by_name(kind: str, shell: Shell) -> None:
    data, word = BAD_MESHES[kind]
    refused(draw_mesh(shell, data), "mesh.ply", word)
    assert list(files(shell.cwd)) == ["mesh.ply"]


def test_a_mesh_that_is_missing_or_a_folder_is_refused_by_key_or_name(shell: Shell) -> None:
    (shell.cwd / "folder.ply").mkdir()
    for key in ("rabbit.mesh", "dragon.mesh"):
        draw = (*SMALL, *POSE, *shell.small, "--only", key.split(".")[0], "--set")
        refused(shell(*draw, f"{key}=none.ply"), key, "none.ply")
        refused(shell(*draw, f"{key}=folder.ply"), "folder.ply", "cannot be read")


def test_coordinates_at_the_limit_of_float32_give_no_warning(shell: Shell) -> None:
    corners = [(x * 3e38, y, z) for x, y, z in CORNERS]
    succeeded(draw_mesh(shell, ply(LITTLE, vertices=corners)), shell.cwd / "out.png")


# --- textures ----------------------------------------------------------------------------------

TEXTURES = {
    "water": ["water.png"],
    "ground": ["ground_detail.png", "ground_large.png"],
    "sky": ["sky_north.png", "sky_top.png"],
    "castle": ["castle_brick.png", "castle_light.png", "fire.png"],
    "rabbit": ["animal.png"],
    "trees": ["tree_broadleaf.png"],
    "grass": ["blade.png"],
    "sword": ["sword_rest.png"],
    "map": ["map.png"],
}


@pytest.mark.sweep(8, first=2)
@pytest.mark.parametrize("element", TEXTURES)
def test_a_broken_texture_of_the_user_is_refused_by_name(element: str, shell: Shell) -> None:
    mine = shell.cwd / "mine"
    mine.mkdir()
    for name in TEXTURES[element]:
        (mine / name).write_bytes(b"not an image")
        refused(shell(*SMALL, *POSE, "--only", element, "--assets", "mine"), name)
        (mine / name).unlink()
    assert files(shell.cwd) == {}


@pytest.mark.seldom(14, first=6)
@pytest.mark.parametrize("kind", ["37 x 53", "1 x 1", "grey", "palette", "16 bits"])
def test_textures_of_any_size_and_format_are_accepted(kind: str, shell: Shell) -> None:
    mine = shell.cwd / "mine"
    mine.mkdir()
    height, width = {"37 x 53": (53, 37), "1 x 1": (1, 1)}.get(kind, (64, 64))
    grey = np.resize(GREY, (height, width))
    for name in [name for names in TEXTURES.values() for name in names]:
        if kind == "16 bits":
            save(grey.astype(np.uint16) * 257, mine / name)
        else:
            modes = {"grey": "L", "palette": "P"}
            save(np.dstack([grey] * 4), mine / name, modes.get(kind, "RGBA"))
    counts = [f"--set={group}.count=40" for group in ("trees", "plants", "deer", "grass")]
    view = ("--pose", "20,3,24,0,-20", "--assets", "mine", *counts, "--out", "out.png")
    succeeded(shell(*SMALL, *view), shell.cwd / "out.png")


def test_a_missing_texture_named_in_the_settings_is_refused_by_key(shell: Shell) -> None:
    for key in ("ground.large_texture", "ground.detail_texture"):
        refused(shell(*SMALL, *POSE, "--only=ground", f"--set={key}=none.png"), key, "none.png")


# --- settings ----------------------------------------------------------------------------------


def test_a_setting_without_a_value_is_refused(shell: Shell) -> None:
    refused(shell("settings", "--set", "fog.density"), "fog.density", "KEY=VALUE")


@pytest.mark.parametrize(
    ("toml", "word"),
    [
        ("fog = 1", "fog"),
        ("[fog]\ndensity = 'x'", "fog.density"),
        ("[fog]\ndensity = nan", "fog.density"),
        ("[fog]\ndensity = inf", "fog.density"),
        ("[fog]\ndensity = -1", "fog.density"),
        ("[fog]\ndensity = true", "fog.density"),
        ("[fog]\ndensity = []", "fog.density"),
        ("[fog]\ndensity = {}", "fog.density"),
        ("[fog]\ndensity = 1979-05-27", "fog.density"),
        ("[fog]\nenabled = 1", "fog.enabled"),
        ("[fog]\ncolor = [1, 2]", "fog.color"),
        ("[fog]\ncolor = ['a', 0, 0]", "fog.color"),
        ("[fog]\ncolor = [0, true, 0]", "fog.color"),
        ("[fog]\ncolor = [[0], 0, 0]", "fog.color"),
        ("[grass]\ncount = 2.5", "grass.count"),
        ("[grass]\ncount = " + "9" * 400, "grass.count"),
        ("[grass]\ncount = " + "9" * 5000, "bad.toml"),
        ("[ground]\nheight_image = 1", "ground.height_image"),
        ('[ground]\nheight_image = "a\\u0000b"', "ground.height_image"),
        ("[ground]\nnothing = 1", "ground.nothing"),
        ("[nothing]\nx = 1", "nothing.x"),
        ("[fog.deep]\nx = 1", "fog.deep"),
        ("[[fog]]\ndensity = 1", "fog"),
        ("[fog", "bad.toml"),
        ("density: 1", "bad.toml"),
        ("a = " + "[" * 3000, "bad.toml"),
        ("[fog]\ndensity = 1\ndensity = 2", "bad.toml"),
    ],
)
def test_a_wrong_settings_file_is_refused_by_its_name_or_the_key(
    toml: str, word: str, shell: Shell
) -> None:
    (shell.cwd / "bad.toml").write_text(toml)
    refused(shell("settings", "--settings", "bad.toml"), word)


def test_a_settings_file_that_cannot_be_read_is_refused(shell: Shell) -> None:
    (shell.cwd / "bytes.toml").write_bytes(b"\xff\xfe\0")
    for name in ("bytes.toml", "missing.toml", ".", "x" * 300):
        refused(shell("settings", "--settings", name), name)


@pytest.mark.seldom(14, first=6)
def test_the_largest_allowed_values_are_rendered(shell: Shell) -> None:
    # One at a time, because each is slow.
    for change in (
        "grass.count=10000000",
        "grass.radius=1000",
        "ground.size=200",
        "trees.size_max=100",
    ):
        done = shell(*SMALL, *POSE, "--only=ground,grass,trees", "--set", change, "--out=out.png")
        succeeded(done, shell.cwd / "out.png")


def test_every_number_has_a_largest_and_a_smallest_value() -> None:
    for key, item in declare.fields(settings.Settings).items():
        sample = item.default[0] if isinstance(item.default, tuple) else item.default
        if not isinstance(sample, bool | str):
            assert item.low < item.high, key
    assert declare.with_settings(settings.Settings(), {"grass.count": 10_000_000})


# --- the other arguments -----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (["fig35a", "--size", "800"], "WxH"),
        (["fig35a", "--size", "8e2x600"], "WxH"),
        (["fig35a", "--size", "²x²"], "WxH"),
        (["fig35a", "--size", "9" * 40 + "x1"], "16384x16384"),
        (["fig35a", "--size", "8000x8000", "--samples", "4"], "34 megapixels with antialiasing"),
        (["--pose", "1,2,3"], "X,Y,Z,YAW,PITCH"),
        (["--pose", ""], "X,Y,Z,YAW,PITCH"),
        (["fig99z"], "fig99z"),
        (["fig35a", "--kt", "1", "fig99z"], "fig99z"),
        (["two\nlines"], "two"),
        ([], "VIEW"),
        (["fig35a", "--assets", "file"], "file"),
        (["fig35a", "--no-such-option"], "--no-such-option"),
        (["fig35a", "--size"], "--size"),
    ],
)
def test_a_wrong_argument_of_render_is_refused(
    arguments: list[str], word: str, shell: Shell
) -> None:
    (shell.cwd / "file").write_text("kept")
    refused(shell("render", *arguments), word)
    assert files(shell.cwd) == {"file": b"kept"}


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (["trace", "fig99z"], "fig99z"),
        (["trace"], "TARGET"),
        (["trace", "fig35a", "--element", "cows"], "cows"),
        (["trace", "fig35a", "--pass", "mirror"], "reflection"),
        (["bench", "fig99z"], "fig99z"),
        (["figures", "fig99z"], "fig99z"),
        (["assets", "check", "--assets", "nowhere"], "nowhere"),
        (["dance"], "dance"),
        (["assets", "sheet", "--assets", "nowhere"], "nowhere"),
        (["views", "fig35a"], "fig35a"),
    ],
)
def test_a_wrong_argument_of_another_command_is_refused(
    arguments: list[str], word: str, shell: Shell
) -> None:
    refused(shell(*arguments), word)


@pytest.mark.seldom(13, first=8)
@pytest.mark.parametrize("more", [(), ("more",)])
def test_an_asset_that_nothing_makes_is_refused(more: tuple[str, ...], shell: Shell) -> None:
    pytest.importorskip("numba", reason="the extra `studio` is not installed")
    refused(shell("assets", "build", "nothing.png", *more), "nothing.png")


# --- output files ------------------------------------------------------------------------------


NO_SUCH_FOLDER = pytest.mark.posix_only("it has no folder /dev or /proc")


@pytest.mark.parametrize(
    ("out", "views", "word"),
    [
        ("file/deep", 1, "file/deep"),
        ("file/deep.png", 1, "file"),
        ("file/a/b/c", 2, "file"),
        ("file", 1, "file"),
        ("both.png", 2, "expected a folder for 2 views"),
        ("picture.jpg", 1, "ends in .png"),
        ("picture.pdf", 1, "ends in .png"),
        ("pictures.zip", 2, "ends in .png"),
        pytest.param("/proc/nowhere", 1, "/proc/nowhere", marks=NO_SUCH_FOLDER),
        pytest.param("/proc/nowhere/x.png", 1, "/proc/nowhere", marks=NO_SUCH_FOLDER),
        pytest.param("/dev/null", 2, "/dev/null", marks=NO_SUCH_FOLDER),
        ("x" * 300 + ".png", 1, "xxx"),
        ("x" * 300, 1, "xxx"),
    ],
)
def test_an_output_that_cannot_be_written_is_refused(
    out: str, views: int, word: str, shell: Shell
) -> None:
    (shell.cwd / "file").write_text("kept")
    names = ["fig35a", "fig35b"][:views]
    refused(shell(*SMALL, *names, *shell.small, "--only=ground", "--out", out), word)
    assert [p.name for p in shell.cwd.iterdir()] == ["file"]
    assert (shell.cwd / "file").read_text() == "kept"


@NO_SUCH_FOLDER
def test_a_picture_can_be_written_into_a_device(shell: Shell) -> None:
    drawn = (*SMALL, *POSE, *shell.small, "--only=ground")
    done = shell(*drawn, "--out", "/dev/null")
    assert (done.status, done.err) == (0, "") and Path("/dev/null").is_char_device()
    refused(shell(*drawn, "--out", "/dev/full"), "/dev/full", "No space left on device")


def test_a_file_of_another_format_is_no_folder_of_figures(shell: Shell) -> None:
    for out in ("q.pdf", "q.png"):
        refused(shell("figures", "fig35a", "--out", out), out, "a folder")
        refused(shell("figures", "fig35a", "--check", "--out", out), out, "a folder")
        refused(shell("assets", "fetch-stanford", "--out", out), out, "a folder")
    refused(shell("bench", "fig35a", "--json", "."), "--json .", "found a folder")
    assert files(shell.cwd) == {}


def test_a_failed_run_keeps_the_earlier_file_and_leaves_no_folder(shell: Shell) -> None:
    (shell.cwd / "old.png").write_bytes(b"earlier")
    (shell.cwd / "bad.ply").write_bytes(b"ply\n")
    bad = ("--only=rabbit", "--set=rabbit.mesh=bad.ply")
    refused(shell(*SMALL, "fig35a", *bad, "--out=old.png"), "bad.ply")
    refused(shell(*SMALL, "fig35a", "fig35b", *bad, "--out=new/folder"), "bad.ply")
    assert files(shell.cwd) == {"bad.ply": b"ply\n", "old.png": b"earlier"}
    assert not (shell.cwd / "new").exists()


@pytest.mark.seldom(13)
def test_the_contact_sheet_of_broken_assets_is_not_written(shell: Shell) -> None:
    (shell.cwd / "mine").mkdir()
    (shell.cwd / "mine" / "water.png").write_bytes(b"")
    refused(shell("assets", "sheet", "--assets", "mine", "--out", "sheet.png"), "water.png")
    refused(shell("assets", "sheet", "--out", "sheet.jpg"), "sheet.jpg", "ends in .png")
    assert list(files(shell.cwd)) == ["water.png"]


def test_the_settings_command_still_works_after_all_these_errors(shell: Shell) -> None:
    rows = json.loads(shell("settings", "--json").out)
    assert {row["key"] for row in rows} >= declare.fields(settings.Settings).keys()
