"""Writing: whole files or none, on a full disk as well."""

import errno
import io
import os
import stat
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from framelens.base import output
from framelens.base.errors import InputError
from framelens.base.output import (
    Output,
    check_output_folder,
    check_writable,
    output_paths,
    save_png,
    write_all,
    write_whole,
)


def full_disk(*_: object, **__: object) -> None:
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


class FullFile(io.BytesIO):
    """A file on a disk with room for three bytes."""

    def __init__(self, handle: int, mode: str) -> None:
        super().__init__()
        self._handle = handle

    def write(self, data: object) -> int:
        os.write(self._handle, bytes(data)[:3])  # type: ignore[call-overload]
        full_disk()
        return 0

    def close(self) -> None:
        if not self.closed:
            os.close(self._handle)
        super().close()


@pytest.mark.posix_only("files have no such rights")
def test_a_file_is_written_whole_with_a_new_folder_and_the_usual_rights(tmp_path: Path) -> None:
    path = tmp_path / "new" / "folder" / "é.bin"
    write_whole(path, b"abc")
    assert path.read_bytes() == b"abc"
    umask = os.umask(0)
    os.umask(umask)
    assert stat.S_IMODE(path.stat().st_mode) == 0o666 & ~umask
    assert list(path.parent.iterdir()) == [path]


@pytest.mark.posix_only("nothing replaces a file that somebody reads")
def test_an_earlier_file_is_replaced_and_whoever_has_it_open_still_reads_it(
    tmp_path: Path,
) -> None:
    path = tmp_path / "a.bin"
    path.write_bytes(b"old")
    with path.open("rb") as reader:
        write_whole(path, b"new and longer")
        assert reader.read() == b"old"
    assert path.read_bytes() == b"new and longer"


@pytest.mark.parametrize("where", ["write", "rename"])
def test_a_full_disk_keeps_the_earlier_file_and_leaves_no_other(
    where: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.png"
    path.write_bytes(b"old")
    if where == "write":
        monkeypatch.setattr(output.os, "fdopen", FullFile)
    else:
        monkeypatch.setattr(output.os, "replace", full_disk)
    with pytest.raises(InputError, match=r"a\.png: cannot be written \(No space left on device\)"):
        save_png(np.zeros((4, 4, 3), np.uint8), path)
    monkeypatch.undo()
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_several_files_are_written_all_or_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    old, new = tmp_path / "old.bin", tmp_path / "deep" / "folder" / "new.bin"
    old.write_bytes(b"old")
    monkeypatch.setattr(output.tempfile, "mkstemp", full_disk_at(2, output.tempfile.mkstemp))
    with pytest.raises(InputError, match=r"new\.bin: cannot be written"):
        write_all({old: b"newer", new: b"new"})
    monkeypatch.undo()
    assert list(tmp_path.iterdir()) == [old] and old.read_bytes() == b"old"
    write_all({old: b"newer", new: [b"in ", b"parts"]})
    assert (old.read_bytes(), new.read_bytes()) == (b"newer", b"in parts")


def full_disk_at(time: int, function: Callable[..., Any]) -> Callable[..., Any]:
    """Return ``function``, on a disk that is full when it is called for the n-th time."""
    times = iter(range(1, 99))

    def limited(*args: Any, **options: Any) -> Any:
        if next(times) == time:
            full_disk()
        return function(*args, **options)

    return limited


def test_an_interrupted_write_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(output.os, "replace", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_whole(tmp_path / "a.bin", b"abc")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.posix_only("symbolic links need a right that few users have")
def test_a_symbolic_link_is_followed_and_not_replaced(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "real" / "a.bin").write_bytes(b"old")
    link = tmp_path / "link.bin"
    link.symlink_to(tmp_path / "real" / "a.bin")
    write_whole(link, b"new")
    assert link.is_symlink()
    assert (tmp_path / "real" / "a.bin").read_bytes() == b"new"
    assert len(list((tmp_path / "real").iterdir())) == 1


@pytest.mark.posix_only("symbolic links need a right that few users have")
def test_a_link_to_nothing_makes_what_it_points_to(tmp_path: Path) -> None:
    link = tmp_path / "link.bin"
    link.symlink_to("deep/a.bin")
    write_whole(link, b"new")
    assert link.is_symlink() and (tmp_path / "deep" / "a.bin").read_bytes() == b"new"


@pytest.mark.posix_only("symbolic links need a right that few users have")
def test_a_link_that_leads_to_itself_is_refused_and_kept(tmp_path: Path) -> None:
    link = tmp_path / "link.bin"
    link.symlink_to(link)
    with pytest.raises(InputError, match=r"link\.bin: cannot be written \(Too many levels"):
        write_whole(link, b"new")
    assert link.is_symlink()


@pytest.mark.posix_only("its pipes have no names in folders")
def test_a_pipe_is_written_into_and_not_replaced(tmp_path: Path) -> None:
    path = tmp_path / "pipe.png"
    os.mkfifo(path)
    # Open for reading and writing: neither end waits for the other.
    pipe = os.open(path, os.O_RDWR | os.O_NONBLOCK)
    write_whole(path, [b"abc", b"def"])
    assert os.read(pipe, 100) == b"abcdef"
    os.close(pipe)
    assert path.is_fifo() and list(tmp_path.iterdir()) == [path]


@pytest.mark.posix_only("terminals are no files")
def test_a_device_is_written_into_and_not_replaced() -> None:
    # A terminal, because its place cannot be taken even by a program that tries to.
    terminal, device = os.openpty()
    path = Path(os.ttyname(device))
    write_whole(path, b"abc")
    assert os.read(terminal, 100) == b"abc" and path.is_char_device()
    os.close(terminal)
    os.close(device)


@pytest.mark.posix_only("its pipes have no names in folders")
def test_a_pipe_whose_reader_has_gone_is_named(tmp_path: Path) -> None:
    path = tmp_path / "pipe"
    os.mkfifo(path)
    pipe = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    output = Output(path)
    os.close(pipe)
    with pytest.raises(InputError, match=r"pipe: cannot be written \(Broken pipe\)"):
        output.write(b"abc")


@pytest.mark.posix_only("files have no such rights")
def test_a_replaced_file_keeps_its_rights(tmp_path: Path) -> None:
    path = tmp_path / "a.bin"
    path.write_bytes(b"old")
    path.chmod(0o640)
    write_whole(path, b"new")
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


def test_a_file_that_may_not_be_written_is_refused_and_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.bin"
    path.write_bytes(b"old")
    # Rights do not bind root: this is what the system answers to anybody else.
    monkeypatch.setattr(output.os, "access", lambda *_: False)
    with pytest.raises(InputError, match=r"a\.bin: cannot be written \(Permission denied\)"):
        write_whole(path, b"new")
    with pytest.raises(InputError, match=r"--json .*a\.bin: expected a folder that can be"):
        check_writable(path, "--json ")
    assert path.read_bytes() == b"old"


def test_a_file_name_of_the_greatest_length_is_written(tmp_path: Path) -> None:
    path = tmp_path / ("x" * 251 + ".png")
    write_whole(path, b"abc")
    assert path.read_bytes() == b"abc"


def test_a_folder_in_the_file_s_place_is_refused_and_kept(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    with pytest.raises(InputError, match="folder: cannot be written"):
        write_whole(tmp_path / "folder", b"abc")
    assert [p.name for p in tmp_path.iterdir()] == ["folder"]


def test_a_png_holds_the_pixels_given(tmp_path: Path) -> None:
    pixels = np.random.default_rng(3).integers(0, 256, (5, 7, 3), dtype=np.uint8)
    save_png(pixels, tmp_path / "a.png")
    with Image.open(tmp_path / "a.png") as image:
        assert image.format == "PNG" and image.size == (7, 5)
        assert (np.asarray(image) == pixels).all()


def test_one_view_goes_to_a_file_and_any_number_to_a_folder(tmp_path: Path) -> None:
    folder, picture = tmp_path / "folder", tmp_path / "x.PNG"
    assert output_paths(None, ["a"]) == [Path("a.png")]
    assert output_paths(picture, ["a"]) == [picture]
    assert output_paths(folder, ["a"]) == [folder / "a.png"]
    assert output_paths(folder, ["a", "b"]) == [folder / "a.png", folder / "b.png"]
    assert list(tmp_path.iterdir()) == [], "asking for paths makes nothing"


def test_a_folder_that_has_the_name_of_a_picture_is_a_folder(tmp_path: Path) -> None:
    for name in ("album.png", "album.jpg"):
        (tmp_path / name).mkdir()
        assert output_paths(tmp_path / name, ["a"]) == [tmp_path / name / "a.png"]


@pytest.mark.parametrize("name", ["a.jpg", "a.JPEG", "a.pdf", "a.svg", "a.png.gz", "standing.txt"])
def test_a_file_of_another_format_is_refused(name: str, tmp_path: Path) -> None:
    (tmp_path / "standing.txt").write_text("kept")
    for names in (["a"], ["a", "b"]):
        with pytest.raises(InputError, match=r"expected a name that ends in \.png, or a folder"):
            output_paths(tmp_path / name, names)
    with pytest.raises(InputError, match=rf"--out .*{name}: expected a folder"):
        check_output_folder(tmp_path / name)
    assert [p.name for p in tmp_path.iterdir()] == ["standing.txt"]


def test_a_folder_to_be_made_may_have_a_number_after_a_dot(tmp_path: Path) -> None:
    assert output_paths(tmp_path / "run-1.5", ["a"]) == [tmp_path / "run-1.5" / "a.png"]
    check_output_folder(tmp_path / "run-1.5")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.posix_only("its pipes have no names in folders")
def test_one_picture_may_go_into_a_pipe_or_a_device_of_any_name(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    assert output_paths(tmp_path / "pipe", ["a"]) == [tmp_path / "pipe"]
    assert output_paths(Path("/dev/null"), ["a"]) == [Path("/dev/null")]
    with pytest.raises(InputError, match="expected a folder for 2 views"):
        output_paths(tmp_path / "pipe", ["a", "b"])


@pytest.mark.posix_only("a link to itself is made by administrators alone there")
def test_what_clearly_cannot_be_written_is_told_before_anything_is_drawn(tmp_path: Path) -> None:
    loop = tmp_path / "loop"
    loop.symlink_to("loop")
    for path, said in ((tmp_path, "found a folder"), (loop / "a.png", "cannot be written")):
        with pytest.raises(InputError, match=said):
            check_writable(path)
