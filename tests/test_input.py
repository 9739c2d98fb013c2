"""Input without an end, or made to fill the memory, is refused in one line and soon."""

import json
import os
import struct
import threading
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from commands import Shell, refused
from PIL import Image

from framelens.base import input as module
from framelens.base.errors import InputError
from framelens.base.input import read_bounded
from landscape.files.images import read_heights, read_image
from landscape.files.meshes import read_mesh
from landscape.settings.declare import read_toml


@pytest.fixture(scope="module")
def shell(the_shell: Shell, tmp_path_factory: pytest.TempPathFactory) -> Shell:
    the_shell.cwd = tmp_path_factory.mktemp("input")
    return the_shell


@pytest.mark.seldom(12, first=7)
@pytest.mark.posix_only("it has no device such as /dev/zero")
@pytest.mark.parametrize(
    "words",
    [
        ["settings", "--settings=/dev/zero"],
        ["walk", "--replay=/dev/zero", "--backend=osmesa", "--frames=1"],
        ["render", "fig35e", "--only=ground", "--set=ground.height_image=/dev/zero"],
        ["render", "fig35e", "--only=ground", "--set=ground.large_texture=/dev/zero"],
        ["render", "fig35e", "--only=rabbit", "--set=rabbit.mesh=/dev/zero"],
    ],
    ids=["settings", "recording", "heights", "picture", "mesh"],
)
def test_a_device_that_never_ends_is_refused(words: list[str], shell: Shell) -> None:
    refused(shell(*words), "/dev/zero")


@pytest.mark.posix_only("its pipes have no names in folders")
def test_settings_may_come_through_a_pipe(tmp_path: Path) -> None:
    path = tmp_path / "pipe"
    os.mkfifo(path)
    writer = threading.Thread(target=lambda: path.write_bytes(b"[fog]\ndensity = 0.5\n"))
    writer.start()
    assert read_toml(path) == {"fog.density": 0.5}
    writer.join()


@pytest.mark.posix_only("its pipes have no names in folders")
def test_a_pipe_through_which_nothing_comes_is_not_waited_for_long(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "WAIT_S", 0.05)
    path = tmp_path / "pipe"
    os.mkfifo(path)
    with pytest.raises(InputError, match=r"pipe: expected all of it within 0\.05 seconds"):
        read_bounded(path, 100)
    # One that somebody has opened, and keeps open without a word.
    kept = os.open(path, os.O_RDWR)
    with pytest.raises(InputError, match="within"):
        read_bounded(path, 100)
    os.close(kept)


def test_a_file_may_have_as_many_bytes_as_allowed_and_no_more(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"x" * 1024)
    assert read_bounded(path, 1024) == b"x" * 1024
    with pytest.raises(InputError, match=r"--settings a: too large, expected at most 0 kB"):
        read_bounded(path, 1023, "--settings a")


@pytest.mark.seldom(3, first=1)
@pytest.mark.posix_only("its pipes have no names in folders")
def test_an_image_or_mesh_is_not_read_from_a_pipe(shell: Shell) -> None:
    os.mkfifo(shell.cwd / "pipe.png")
    for key in ("ground.height_image", "rabbit.mesh"):
        view = ("render", "fig35e", "--only=rabbit", "--set", f"{key}=pipe.png")
        refused(shell(*view), "pipe.png: expected a file, found a pipe or a device")


@pytest.mark.parametrize(
    "text",
    ["a" + ".a" * 30_000 + " = 1\n", "\n".join(f"{'a.' * 499}k{n} = 1" for n in range(60))],
    ids=["one line", "many lines"],
)
def test_settings_of_many_dots_take_little_memory(text: str, tmp_path: Path) -> None:
    path = tmp_path / "dots.toml"
    path.write_text(text)
    tracemalloc.start()
    try:
        read_toml(path)
    except InputError as error:
        assert "dots.toml: expected a TOML file of settings" in str(error)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 500e6


def test_an_image_of_too_many_pixels_is_refused_before_it_is_decoded(tmp_path: Path) -> None:
    path = tmp_path / "bomb.png"
    Image.new("1", (13300, 13300)).save(path)
    for read in (read_image, read_heights):
        with pytest.raises(InputError, match=r"bomb\.png: .*too large; expected at most 100 meg"):
            read(path)


def test_a_picture_of_floats_is_clipped_without_a_warning(tmp_path: Path) -> None:
    path = tmp_path / "a.tif"
    values = np.array([[0.0, 0.5, 1.0, 3e38, -3e38, np.inf, -np.inf, np.nan]], np.float32)
    Image.fromarray(values).save(path)
    with np.errstate(all="raise"):
        found = read_image(path, "RGB")[0, :, 0]
        heights = read_heights(path)[0]
    assert found.tolist() == [0, 128, 255, 255, 0, 255, 0, 0]
    assert heights.tolist() == [0.0, 127.5, 255.0, 255.0, 0.0, 255.0, 0.0, 0.0]


def ply(counter: str, faces: int, lists: bytes) -> bytes:
    """Return a binary PLY of three vertices and lists of faces as given."""
    head = ["ply", "format binary_little_endian 1.0", "element vertex 3"]
    head += [f"property float {axis}" for axis in "xyz"]
    head += [f"element face {faces}", f"property list {counter} int vertex_indices", "end_header"]
    return "\n".join([*head, ""]).encode() + bytes(36) + lists


def glb(count: int, nodes: int = 1) -> bytes:
    """Return a GLB whose mesh has ``count`` vertices without data, drawn ``nodes`` times."""
    scene = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": list(range(nodes))}],
        "nodes": [{"mesh": 0}] * nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"componentType": 5126, "count": count, "type": "VEC3", "bufferView": 0}],
        "bufferViews": [{"buffer": 0, "byteLength": 12 * count}],
        "buffers": [{"byteLength": 12 * count}],
    }
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<II", len(text), 0x4E4F534A) + text
    body += struct.pack("<II", 12 * count, 0x004E4942) + bytes(12 * count)
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


HOSTILE = {
    "a polygon of two million corners": (
        "a.ply",
        lambda: ply("uint", 1, struct.pack("<I", 2_000_000) + bytes(8_000_000)),
        "its faces make 1999998 triangles, expected at most 1000000",
    ),
    "two million faces without corners": (
        "a.ply",
        lambda: ply("uchar", 2_000_000, bytes(2_000_000)),
        "2000000 rows of face, expected at most 1000000",
    ),
    "polygons of a thousand different lengths": (
        "a.ply",
        lambda: ply(
            "ushort",
            20_000,
            b"".join(struct.pack("<H", k) + bytes(4 * k) for k in range(1000))
            + bytes([1, 0, 0, 0, 0, 0]) * 19_000,
        ),
        "",
    ),
    "a header without an end": (
        "a.ply",
        lambda: b"ply\nformat ascii 1.0\n" + b"property float a\n" * 500_000,
        "its header does not end",
    ),
    "a mesh drawn three thousand times": ("a.glb", lambda: glb(90_000, 3000), "1024 MB of memory"),
}


@pytest.mark.seldom(14, first=10)
@pytest.mark.parametrize("name", HOSTILE)
def test_a_mesh_made_to_fill_the_memory_takes_little(name: str, tmp_path: Path) -> None:
    file, data, reason = HOSTILE[name]
    path = tmp_path / file
    path.write_bytes(data())
    tracemalloc.start()
    try:
        read_mesh(path)
        assert not reason
    except InputError as error:
        assert reason and f"{path}: expected a" in str(error) and reason in str(error)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 300e6


@pytest.mark.seldom(13, first=2)
def test_a_damaged_stl_gives_one_line(shell: Shell) -> None:
    (shell.cwd / "bad.stl").write_bytes(b"solid x\nfacet normal 0 0 0\n garbage")
    view = ("render", "fig35e", "--only=rabbit", "--set=rabbit.mesh=bad.stl")
    refused(shell(*view), "bad.stl")
