"""The cache returns what was made; damage, many processes, full or forbidden folders do no harm."""

import functools
import importlib.util
import multiprocessing
import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import SECONDS
from PIL import Image

from landscape.files import cache
from landscape.files.assets import Assets
from landscape.files.images import read_image

ARRAYS = (
    np.arange(30, dtype=np.uint8).reshape(2, 5, 3),
    np.linspace(0, 1, 7),
    np.array([[1, -2], [3, 4]], np.int32),
    np.empty((0, 2), np.float32),
)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache of its own."""
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


class Maker:
    """Makes arrays, and counts how often."""

    def __init__(self, *arrays: np.ndarray) -> None:
        self.arrays, self.times = arrays or ARRAYS, 0

    def __call__(self) -> tuple[np.ndarray, ...]:
        self.times += 1
        return self.arrays


def same(one: tuple[np.ndarray, ...], two: tuple[np.ndarray, ...]) -> bool:
    return len(one) == len(two) and all(
        a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()
        for a, b in zip(one, two, strict=True)
    )


def test_a_second_call_gives_the_same_arrays_without_making_them(folder: Path) -> None:
    maker = Maker()
    first, second = (cache.recall(["what", b"of"], maker) for _ in range(2))
    assert same(first, ARRAYS) and same(second, ARRAYS) and maker.times == 1
    second[0][0, 0, 0] = 77  # the caller's own
    assert same(cache.recall(["what", b"of"], maker), ARRAYS)
    assert len(list(folder.iterdir())) == 1


def test_other_parts_make_other_arrays(folder: Path) -> None:
    maker = Maker()
    for parts in (["ab", "c"], ["a", "bc"], ["abc"], [b"abc", ""]):
        cache.recall(parts, maker)
    assert maker.times == 4


def test_changed_code_makes_the_arrays_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    maker = Maker()
    cache.recall(["x"], maker)
    assert cache.code() == cache.code()
    monkeypatch.setattr(cache, "code", lambda: b"other code")
    cache.recall(["x"], maker)
    assert maker.times == 2


SCENE = """
import numpy as np

VALUE = {value}


class Scene:
    def heights(self):
        return (np.full(3, VALUE),)

    def __call__(self):
        return self.heights()


def heights(times=1):
    return (np.full(3, VALUE * times),)
"""


def scene(path: Path, value: float) -> Any:
    """Write a module outside the package and run it, as a user's own scene is."""
    path.parent.mkdir(exist_ok=True)
    path.write_text(SCENE.format(value=value))
    os.utime(path, (1e9 + value, 1e9 + value))
    spec = importlib.util.spec_from_file_location("scene", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    "maker",
    [
        lambda module: module.heights,
        lambda module: module.Scene().heights,
        lambda module: module.Scene(),
        lambda module: functools.partial(module.heights, times=1),
        lambda module: functools.lru_cache(module.heights),
    ],
    ids=["function", "method", "object", "partial", "wrapped"],
)
def test_a_changed_file_outside_the_package_makes_its_arrays_again(
    folder: Path, tmp_path: Path, maker: Callable[[Any], Any]
) -> None:
    path = tmp_path / "my scenes" / "scene.py"
    for value in (1.0, 2.0, 1.0):
        for _ in range(2):
            (found,) = cache.recall(["heights"], maker(scene(path, value)))
            assert (found == value).all()
    assert len(list(folder.iterdir())) == 2, "the arrays of the first text were found again"


def test_results_of_code_that_is_in_no_file_are_never_cached(folder: Path) -> None:
    typed: dict[str, Any] = {}
    for value in (1.0, 2.0):
        exec(compile(SCENE.format(value=value), "<typed>", "exec"), typed)
        assert (cache.recall(["heights"], typed["heights"])[0] == value).all()


def test_the_hash_depends_on_code_anywhere_in_the_package_and_on_its_path(tmp_path: Path) -> None:
    package = tmp_path / "landscape"
    shutil.copytree(cache.PACKAGE / "files", package / "files")
    found = [cache.code_below(package)]
    assert cache.code_below(package) == found[0]
    (package / "voxel" / "deep").mkdir(parents=True)
    for path, text in (
        (package / "files" / "images.py", "LARGEST = 1\n"),
        (package / "voxel" / "deep" / "terrain.py", "SIZE = 1\n"),
        (package / "voxel" / "deep" / "terrain.py", "SIZE = 2\n"),
    ):
        path.write_text(text)
        found.append(cache.code_below(package))
    (package / "voxel" / "deep" / "terrain.py").rename(package / "voxel" / "terrain.py")
    found.append(cache.code_below(package))
    assert len(set(found)) == 5


def test_all_of_the_packages_own_code_is_hashed() -> None:
    assert cache.code_below(cache.PACKAGE) in cache.code()
    assert cache.code_outside(read_image) == b""


def cut(data: bytes) -> bytes:
    return data[: len(data) // 2]


def flip(data: bytes) -> bytes:
    return data[:-20] + bytes([data[-20] ^ 1]) + data[-19:]


def flip_header(data: bytes) -> bytes:
    return data.replace(b"[2, 5, 3]", b"[2, 5, 4]")


DAMAGES: list[Callable[[bytes], bytes]] = [
    cut,
    flip,
    flip_header,
    lambda data: b"",
    lambda data: b"landscape cache 1\n" + data[18:],
    lambda data: data + b"x",
]


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_file_is_replaced(folder: Path, damage: Callable[[bytes], bytes]) -> None:
    maker = Maker()
    cache.recall(["x"], maker)
    (path,) = folder.iterdir()
    whole = path.read_bytes()
    assert damage(whole) != whole
    path.write_bytes(damage(whole))
    assert same(cache.recall(["x"], maker), ARRAYS) and maker.times == 2
    assert path.read_bytes() == whole


@pytest.mark.seldom(13, first=10)
def test_every_single_bit_of_a_file_that_flips_is_noticed(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "fsync", lambda _: None)  # a thousand times would take long
    maker = Maker(np.arange(12, dtype=np.uint8).reshape(3, 4), np.zeros(0, np.float32))
    cache.recall(["x"], maker)
    (path,) = folder.iterdir()
    whole = path.read_bytes()
    bits = 8 * len(whole)
    for bit in range(bits):
        damaged = bytearray(whole)
        damaged[bit // 8] ^= 1 << bit % 8
        path.write_bytes(damaged)
        assert same(cache.recall(["x"], maker), maker.arrays), bit
    assert maker.times == 1 + bits


def test_a_file_that_has_taken_another_s_name_is_replaced(folder: Path) -> None:
    makers = {name: Maker(np.full((2, 2), ord(name), np.uint8)) for name in "ab"}
    for name, maker in makers.items():
        cache.recall([name], maker)
    one, other = folder.iterdir()
    one.write_bytes(other.read_bytes())
    for name, maker in makers.items():
        assert same(cache.recall([name], maker), maker.arrays)
    assert sum(maker.times for maker in makers.values()) == 3


def crowd(folder: str, gate: "multiprocessing.synchronize.Barrier", number: int) -> None:
    """One of several processes that start at once."""
    os.environ["LANDSCAPE_CACHE"] = folder
    gate.wait(SECONDS)
    for turn in range(20):
        made = np.full((64, 64, 3), turn, np.uint8)
        (got,) = cache.recall(["crowd", str(turn)], lambda made=made: (made,))
        assert (got == turn).all()


@pytest.mark.seldom(10, first=7)
def test_processes_that_start_together_all_get_complete_arrays(folder: Path) -> None:
    spawn = multiprocessing.get_context("spawn")
    gate = spawn.Barrier(2)
    crew = [spawn.Process(target=crowd, args=(str(folder), gate, n)) for n in range(2)]
    for process in crew:
        process.start()
    for process in crew:
        process.join(SECONDS)
    assert [process.exitcode for process in crew] == [0, 0]
    assert len(list(folder.glob("*.arrays"))) == 20 and not list(folder.glob(".*"))


def test_an_unusable_folder_means_no_cache_and_no_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path / "file"))
    maker = Maker()
    assert same(cache.recall(["x"], maker), ARRAYS) and same(cache.recall(["x"], maker), ARRAYS)
    assert maker.times == 2


def test_a_disk_that_fills_up_leaves_no_broken_file(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    assert same(cache.recall(["x"], Maker()), ARRAYS)
    assert not folder.exists() or list(folder.iterdir()) == []


def test_an_empty_variable_turns_the_cache_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LANDSCAPE_CACHE", "")
    maker = Maker()
    cache.recall(["x"], maker)
    cache.recall(["x"], maker)
    assert maker.times == 2 and cache.folder() is None


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have other folders")
def test_without_the_variable_the_system_chooses_the_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("LANDSCAPE_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache.folder() == tmp_path / "landscape"
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert cache.folder() == tmp_path / ".cache" / "landscape"
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path / "mine"))
    assert cache.folder() == tmp_path / "mine"


def test_the_least_recently_used_file_is_deleted_first(folder: Path, monkeypatch) -> None:
    big = Maker(np.zeros((100, 100), np.uint8))
    for name in "abc":
        cache.recall([name], big)
    age = {path: n for n, path in enumerate(sorted(folder.iterdir()))}
    for path, n in age.items():
        os.utime(path, (n, n))
    monkeypatch.setattr(cache, "MOST_BYTES", 35_000)
    cache.recall(["d"], big)
    left = set(folder.iterdir())
    assert len(left) == 3 and min(age, key=lambda path: age[path]) not in left


def test_an_image_is_decoded_once_and_again_when_it_changes(folder: Path, tmp_path: Path) -> None:
    path = tmp_path / "picture.png"
    for colour in ((10, 20, 30), (40, 50, 60)):
        Image.new("RGB", (3, 2), colour).save(path)
        os.utime(path, (1e9 + colour[0], 1e9 + colour[0]))
        for _ in range(2):
            image = read_image(path, "RGBA")
            assert image.shape == (2, 3, 4) and (image == (*colour, 255)).all()
    assert len(list(folder.iterdir())) == 2
    assert read_image(path, "RGB").shape == (2, 3, 3)
    assert read_image(path, "RGB", largest=2).shape[1] == 2


def test_the_hash_of_the_assets_changes_with_any_that_may_be_used(tmp_path: Path) -> None:
    (tmp_path / "height.png").write_bytes(b"one")
    assets = Assets(tmp_path)
    found = [assets.contents("mine.png")]
    assert assets.contents("mine.png") == found[0]
    (tmp_path / "another.png").write_bytes(b"one")
    assert assets.contents("mine.png") == found[0], "it is never used"
    for name in ("height.png", "mine.png"):
        (tmp_path / name).write_bytes(b"other")
        found.append(assets.contents("mine.png"))
    assert found[0] != found[1] != found[2]


def test_what_is_wrong_with_the_folder_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("in the way")
    # The systems have words of their own for what is in the way.
    for place in ("file", "file/deep"):
        monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path / place))
        with pytest.raises(OSError) as caught:
            (tmp_path / place).mkdir(parents=True)
        assert f"{tmp_path / place} cannot be used ({caught.value.strerror})" in cache.trouble()
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path / "new"))
    assert cache.trouble() == ""
    monkeypatch.setenv("LANDSCAPE_CACHE", "")
    assert cache.trouble() == ""
