"""Fetching the Stanford scans: served from 127.0.0.1, with a mesh of four vertices."""

import errno
import gzip
import http.server
import io
import os
import re
import socket
import sys
import tarfile
import threading
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import pytest

from framelens.base import output
from framelens.base.errors import InputError
from landscape.files import stanford
from landscape.files.meshes import parse_ply

VERTICES = [(0, 0, 0), (1, 0, 0), (0, 1.5, 0), (0, 0, -0.25)]
FACES = [(0, 1, 2), (0, 2, 3)]
SCANS = (
    stanford.Scan("bunny", "bunny.tar.gz", "bunny/mesh.ply", "rabbit_stanford.ply", 4, 2, ""),
    stanford.Scan("dragon", "dragon/d.tar.gz", "d/mesh.ply", "dragon_stanford.ply", 4, 2, ""),
)
RABBIT, DRAGON = SCANS
MESHES = Path(__file__).resolve().parents[2] / "shared" / "meshes"


def ply(list_name: str = "vertex_indices", extra: str = "", height: float = 1.5) -> bytes:
    """Return the small mesh as a PLY file, with one more property of a vertex if `extra`."""
    head = ["ply", "format ascii 1.0", "comment made by hand", "element vertex 4"]
    head += [f"property float {axis}" for axis in "xyz"]
    head += [f"property float {extra}"] if extra else []
    head += ["element face 2", f"property list uchar int {list_name}", "end_header"]
    rows = [f"{x} {y and height} {z} {'0.5' if extra else ''}" for x, y, z in VERTICES]
    rows += [f"3 {a} {b} {c}" for a, b, c in FACES]
    return ("\n".join(head + rows) + "\n").encode()


def compressed(tar: io.BytesIO) -> bytes:
    """Return the archive as .tar.gz without the time of day, which would be part of a test's id."""
    return gzip.compress(tar.getvalue(), mtime=0)


def archive(**members: bytes) -> bytes:
    """Return a .tar.gz of the members, whose names have / written as __, and a decoy."""
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w") as tar:
        named = {name.replace("__", "/") + ".ply": data for name, data in members.items()}
        for name, data in {"README": b"a decoy", **named}.items():
            info = tarfile.TarInfo(name)
            info.size = len(data)
            tar.addfile(info, io.BytesIO(data))
    return compressed(buffer)


@dataclass
class Server:
    """What the test's server answers: for each path, a body; what it has been asked for."""

    url: str = ""
    bodies: dict[str, bytes] = field(default_factory=dict)
    cut: set[str] = field(default_factory=set)  # paths whose body ends half-way
    asked: list[str] = field(default_factory=list)


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[Server]:
    answers = Server()
    answers.bodies = {
        "/bunny.tar.gz": archive(bunny__mesh=ply("vertex_index", extra="confidence")),
        "/dragon/d.tar.gz": archive(d__mesh=ply("vertex_indices")),
    }

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            answers.asked.append(self.path)
            body = answers.bodies.get(self.path)
            if body is None:
                self.send_error(404)
                return
            self.send_response(200)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body[: len(body) // 2] if self.path in answers.cut else body)

        def log_message(self, *args: object) -> None:
            pass

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler) as httpd:
        thread = threading.Thread(target=httpd.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        answers.url = f"http://127.0.0.1:{httpd.server_address[1]}"
        monkeypatch.setenv("no_proxy", "127.0.0.1")
        yield answers
        httpd.shutdown()
        thread.join()


@pytest.fixture(autouse=True)
def small_scans(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Expect the small mesh instead of Stanford's, except in the test of the real scans."""
    if "meshes" not in request.keywords:
        right = stanford.fingerprint(np.array(VERTICES, "f4"), np.array(FACES, "i4"))
        monkeypatch.setattr(stanford, "SCANS", tuple(replace(s, sha256=right) for s in SCANS))


def files(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.rglob("*"))


def test_both_scans_arrive_under_their_new_names(server: Server, tmp_path: Path) -> None:
    paths = stanford.fetch(tmp_path / "new" / "folder", server.url + "/")
    assert [path.name for path in paths] == ["rabbit_stanford.ply", "dragon_stanford.ply"]
    assert files(tmp_path / "new" / "folder") == ["dragon_stanford.ply", "rabbit_stanford.ply"]
    assert paths[0].read_bytes() == ply("vertex_index", extra="confidence")
    assert paths[0].stat().st_mode & 0o777 == 0o666 & ~_umask()


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def test_headers_of_either_spelling_have_the_same_fingerprint() -> None:
    dialects = [
        ply("vertex_index", extra="confidence"),
        ply("vertex_indices"),
        ply().replace(b"\n", b"\r\n"),
    ]
    found = {stanford.fingerprint(*parse_ply(data)[:2]) for data in dialects}
    assert found == {stanford.SCANS[0].sha256}


def test_valid_files_are_not_fetched_again(server: Server, tmp_path: Path) -> None:
    stanford.fetch(tmp_path, server.url)
    (tmp_path / DRAGON.file).write_bytes(ply(height=2))
    server.asked.clear()
    stanford.fetch(tmp_path, server.url)
    assert server.asked == ["/dragon/d.tar.gz"]
    assert (tmp_path / DRAGON.file).read_bytes() == ply("vertex_indices")


def link_archive(kind: bytes) -> bytes:
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w") as tar:
        info = tarfile.TarInfo(DRAGON.member)
        info.type, info.linkname = kind, "/etc/passwd"
        tar.addfile(info)
    return compressed(buffer)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (archive(d__mesh=ply(height=2)), "other coordinates or faces"),
        (archive(d__mesh=ply().replace(b"3 0 2 3", b"3 0 3 2")), "other coordinates or faces"),
        (
            archive(d__mesh=ply().replace(b"3 0 2 3\n", b"")),
            "truncated: the header promises 2 rows of face",
        ),
        (archive(d__mesh=ply().replace(b"3 0 2 3", b"4 0 2 3")), "truncated"),
        (
            archive(d__mesh=ply().replace(b"3 0 2 3", b"4 0 2 3 1")),
            "4 vertices and 3 faces, expected 4 and 2",
        ),
        (
            archive(d__mesh=ply().replace(b"face 2", b"face 1").replace(b"3 0 2 3\n", b"")),
            "4 vertices and 1 faces, expected 4 and 2",
        ),
        (archive(d__mesh=ply().replace(b"ascii", b"binary_little_endian")), "a list of 51"),
        (archive(d__mesh=ply().replace(b"element vertex 4", b"element vertex")), "its header has"),
        (archive(d__mesh=ply().replace(b"1.5", b"one")), "could not convert"),
        (archive(d__mesh=b"\xff\xfe"), "its first line is not 'ply'"),
        (archive(d__mesh=b""), "its first line is not 'ply'"),
        (archive(d__other=ply()), "holds no d/mesh.ply"),
        (archive(**{"..__..__mesh": ply()}), "refused, it holds the path '../../mesh.ply'"),
        (archive(**{"__etc__mesh": ply()}), "refused, it holds the path '/etc/mesh.ply'"),
        (link_archive(tarfile.SYMTYPE), "not a file of a sensible size"),
        (link_archive(tarfile.LNKTYPE), "not a file of a sensible size"),
        (archive(d__mesh=ply())[:60], "not a whole .tar.gz"),
        (b"<html>We have moved</html>", "not a whole .tar.gz"),
        (b"", "not a whole .tar.gz"),
        (None, "404 Not Found"),
    ],
)
def test_a_bad_dragon_leaves_no_rabbit_behind_either(
    server: Server, tmp_path: Path, body: bytes | None, message: str
) -> None:
    del server.bodies["/dragon/d.tar.gz"]
    if body is not None:
        server.bodies["/dragon/d.tar.gz"] = body
    with pytest.raises(InputError) as caught:
        stanford.fetch(tmp_path / "new" / "folder", server.url)
    assert message in str(caught.value)
    assert f"{server.url}/dragon/d.tar.gz" in str(caught.value)
    assert "\n" not in str(caught.value)
    assert files(tmp_path) == []


def test_an_archive_that_is_cut_off_is_noticed(server: Server, tmp_path: Path) -> None:
    server.cut.add("/dragon/d.tar.gz")
    size = len(server.bodies["/dragon/d.tar.gz"])
    with pytest.raises(InputError, match=f"cut off after {size // 2} of {size} bytes"):
        stanford.fetch(tmp_path, server.url)
    assert files(tmp_path) == []


def test_earlier_files_survive_a_failure(server: Server, tmp_path: Path) -> None:
    for scan in SCANS:
        (tmp_path / scan.file).write_bytes(b"mine")
    server.bodies["/dragon/d.tar.gz"] = archive(d__mesh=ply(height=2))
    with pytest.raises(InputError):
        stanford.fetch(tmp_path, server.url)
    assert {path.read_bytes() for path in tmp_path.iterdir()} == {b"mine"}
    assert files(tmp_path) == ["dragon_stanford.ply", "rabbit_stanford.ply"]


def test_an_interrupt_leaves_nothing_behind(
    server: Server, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(data: bytes, scan: stanford.Scan) -> None:
        if scan.name == "dragon":
            raise KeyboardInterrupt

    monkeypatch.setattr(stanford, "check", interrupt)
    with pytest.raises(KeyboardInterrupt):
        stanford.fetch(tmp_path / "new", server.url)
    assert files(tmp_path) == []


def test_a_disk_that_fills_up_at_the_second_file_leaves_nothing_behind(
    server: Server, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written: list[int] = []
    chmod = os.chmod

    def full(path: str, mode: int) -> None:
        written.append(mode)
        if len(written) == 2:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        chmod(path, mode)

    monkeypatch.setattr(output.os, "chmod", full)
    with pytest.raises(InputError, match=r"dragon_stanford\.ply: .*No space left on device"):
        stanford.fetch(tmp_path / "new" / "folder", server.url)
    monkeypatch.undo()
    assert files(tmp_path) == []


def test_a_destination_that_is_a_file_is_named(server: Server, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine")
    with pytest.raises(InputError, match=r"file: expected a folder that can be written"):
        stanford.fetch(tmp_path / "file", server.url)
    (tmp_path / DRAGON.file).mkdir()
    with pytest.raises(InputError, match=r"dragon_stanford\.ply: .* found a folder"):
        stanford.fetch(tmp_path, server.url)
    assert files(tmp_path) == ["dragon_stanford.ply", "file"]


def test_a_server_that_is_not_there_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("no_proxy", "127.0.0.1")
    with socket.socket() as held:
        held.bind(("127.0.0.1", 0))  # taken, so that nobody answers there
        url = f"http://127.0.0.1:{held.getsockname()[1]}"
        with pytest.raises(InputError, match=r"bunny\.tar\.gz: no connection"):
            stanford.fetch(tmp_path, url)
    with pytest.raises(InputError, match="expected an address"):
        stanford.fetch(tmp_path, "file:///etc")
    assert files(tmp_path) == []


def test_a_silent_server_times_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("no_proxy", "127.0.0.1")
    monkeypatch.setattr(stanford, "TIMEOUT_S", 0.1)
    with socket.create_server(("127.0.0.1", 0)) as mute:
        url = f"http://127.0.0.1:{mute.getsockname()[1]}"
        with pytest.raises(InputError, match=r"no data for 0\.1 s|timed out"):
            stanford.fetch(tmp_path, url)
    assert files(tmp_path) == []


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize(
    ("stream", "quiet", "bars"),
    [(Terminal(), False, 2), (Terminal(), True, 0), (io.StringIO(), False, 0), (None, False, 0)],
)
def test_a_bar_for_each_scan_is_drawn_on_a_terminal_and_only_there(
    server: Server,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    stream: io.StringIO | None,
    quiet: bool,
    bars: int,
) -> None:
    for scan in SCANS:
        # More follows the mesh than is read at once: the bar ends full nevertheless.
        name = scan.member.removesuffix(".ply").replace("/", "__")
        server.bodies[f"/{scan.archive}"] = archive(**{name: ply(), "rest": os.urandom(100_000)})
    monkeypatch.setattr(sys, "stderr", stream)
    stanford.fetch(tmp_path, server.url, quiet=quiet)
    drawn = stream.getvalue() if stream is not None else ""
    assert drawn.count("\n") == bars, drawn
    for line, scan in zip(drawn.split("\n")[:bars], SCANS[:bars], strict=True):
        assert re.search(rf" (\d+k)/\1 {scan.name} ", line.split("\r")[-1]), line


@pytest.mark.meshes
@pytest.mark.skipif(not MESHES.is_dir(), reason="the real scans are not in ../shared/meshes")
@pytest.mark.parametrize("scan", stanford.SCANS, ids=lambda scan: scan.name)
def test_the_real_scans_are_what_is_expected(scan: stanford.Scan) -> None:
    stanford.check((MESHES / Path(scan.member).name).read_bytes(), scan)
