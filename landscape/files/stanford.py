"""Fetch the real rabbit and dragon: two scans of the Stanford 3D Scanning Repository.

The island shows a rabbit and a dragon of its own; the report of 2006 showed Stanford's. This module
downloads those, takes the two meshes out of their archives and checks them, so that they can stand
in: ``rabbit.mesh`` and ``dragon.mesh``.

Stanford's terms (https://graphics.stanford.edu/data/3Dscanrep/): acknowledge the Stanford Computer
Graphics Laboratory as the source wherever the models or pictures of them appear; no commercial use
without Stanford's permission. That is why the scans are fetched and not shipped.

Copies of the scans differ in the spelling of their headers, never in their numbers: what is checked
is the number of vertices and faces and a hash of the coordinates and faces themselves.
"""

import hashlib
import http.client
import os
import sys
import tarfile
import time
import urllib.error
import urllib.parse
import urllib.request
import zlib
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

import numpy as np

BASE_URL = "https://graphics.stanford.edu/pub/3Dscanrep"
TIMEOUT_S = 30.0  # chosen: without a byte for so long, the server is not going to answer
MAX_MEMBER_BYTES = 64 << 20  # chosen: forty times the larger scan, far from filling a memory

Progress = Callable[[str, int, int | None], None]
"""Called with a name, the bytes received so far, and how many there will be (None: not known)."""


class StanfordError(OSError):
    """The scans could not be fetched; the message is one line that names what failed."""


@dataclass(frozen=True)
class Scan:
    """One scan: where it is, what it must hold, and the file it becomes."""

    name: str
    archive: str  # below the base address
    member: str  # inside the archive
    file: str
    vertices: int
    faces: int
    sha256: str  # of the numbers, see fingerprint()


SCANS = (
    Scan(
        name="bunny",
        archive="bunny.tar.gz",
        member="bunny/reconstruction/bun_zipper_res2.ply",
        file="rabbit_stanford.ply",
        vertices=8171,
        faces=16301,
        sha256="7ab085981c1aea7dd875fc6f2af9557ae6b952783c0bae4e5528a1bd0bed9093",
    ),
    Scan(
        name="dragon",
        archive="dragon/dragon_recon.tar.gz",
        member="dragon_recon/dragon_vrip_res3.ply",
        file="dragon_stanford.ply",
        vertices=22998,
        faces=47794,
        sha256="ced56edc60e3a1b936b0b04291aa65d4062bce4dae0612e5c9d3389acd069961",
    ),
)


def fetch(
    destination: Path, base_url: str = BASE_URL, progress: Progress | None = None
) -> list[Path]:
    """Download the scans into the folder `destination` and return the paths of the two files.

    Files that are there already and hold the right numbers are kept, and not fetched again. The new
    ones appear only when all are right: if anything fails, the folder is as it was. Without
    `progress` a bar is drawn on stderr, if that is a terminal. Raises StanfordError.
    """
    destination = Path(destination)
    if urllib.parse.urlsplit(base_url).scheme not in ("http", "https"):
        raise StanfordError(f"{base_url}: expected an address that begins with http:// or https://")
    bar = _Bar() if progress is None and sys.stderr.isatty() else None
    report = progress or bar or _silent
    new_folders = [p for p in (destination, *destination.parents) if not p.exists()]
    ready: list[tuple[Path, Path]] = []
    try:
        _make_folder(destination)
        for scan in SCANS:
            target = destination / scan.file
            if target.is_dir():
                raise StanfordError(f"{target}: is a folder, expected a file or nothing")
            if _is_right(target, scan):
                continue
            data = _download(scan, f"{base_url.rstrip('/')}/{scan.archive}", report)
            part = target.with_name(f".{target.name}.{os.getpid()}.part")
            ready.append((part, target))
            _write(part, data)
        for part, target in ready:
            _replace(part, target)
    except BaseException:  # an interrupt, too, leaves nothing behind
        for part, _ in ready:
            part.unlink(missing_ok=True)
        for folder in new_folders:
            with suppress(OSError):
                folder.rmdir()
        raise
    finally:
        if bar is not None:
            bar.close()
    return [destination / scan.file for scan in SCANS]


def parse_ply(data: bytes) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertices, float32 (n, 3), and the triangles, int32 (m, 3), of an ASCII PLY file.

    Only as much of the format as Stanford's scans use: vertices with x, y, z first, then triangles;
    other properties of a vertex are dropped. Raises ValueError.
    """
    header, mark, body = data.partition(b"end_header")
    lines = [line.split() for line in header.decode("ascii").splitlines()]
    if not mark or not lines or lines[0] != ["ply"] or ["format", "ascii", "1.0"] not in lines:
        raise ValueError("not an ASCII PLY file")
    elements = [
        (line[1], int(line[2])) for line in lines if len(line) == 3 and line[0] == "element"
    ]
    scalars = [line[2] for line in lines if len(line) == 3 and line[0] == "property"]
    if [name for name, _ in elements] != ["vertex", "face"] or scalars[:3] != ["x", "y", "z"]:
        raise ValueError("not a mesh of vertices x, y, z and faces")
    vertices, faces = elements[0][1], elements[1][1]
    tokens = np.array(body.split())
    split = vertices * len(scalars)
    if len(tokens) != split + 4 * faces:
        raise ValueError(f"{len(tokens)} numbers, expected {split + 4 * faces}")
    coordinates = tokens[:split].astype(np.float64).reshape(vertices, len(scalars))
    corners = tokens[split:].astype(np.int64).reshape(faces, 4)
    if np.any(corners[:, 0] != 3):
        raise ValueError("a face is not a triangle")
    return coordinates[:, :3].astype(np.float32), corners[:, 1:].astype(np.int32)


def fingerprint(vertices: np.ndarray, faces: np.ndarray) -> str:
    """Return the SHA-256 of the vertices as little-endian float32, then the faces as int32."""
    digest = hashlib.sha256(np.ascontiguousarray(vertices, dtype="<f4").tobytes())
    digest.update(np.ascontiguousarray(faces, dtype="<i4").tobytes())
    return digest.hexdigest()


def check(data: bytes, scan: Scan) -> None:
    """Raise ValueError, saying what differs, unless `data` is the PLY file of that scan."""
    vertices, faces = parse_ply(data)
    if (len(vertices), len(faces)) != (scan.vertices, scan.faces):
        raise ValueError(
            f"{len(vertices)} vertices and {len(faces)} faces, "
            f"expected {scan.vertices} and {scan.faces}"
        )
    found = fingerprint(vertices, faces)
    if found != scan.sha256:
        raise ValueError(
            f"other coordinates or faces than the scan's (SHA-256 {found[:12]}..., "
            f"expected {scan.sha256[:12]}...)"
        )


def _is_right(path: Path, scan: Scan) -> bool:
    try:
        check(path.read_bytes(), scan)
    except (OSError, ValueError):
        return False
    return True


def _download(scan: Scan, url: str, report: Progress) -> bytes:
    """Return the bytes of the scan's member in the archive at `url`, checked."""
    request = urllib.request.Request(url, headers={"User-Agent": "landscape"})
    try:
        with urllib.request.urlopen(request, timeout=TIMEOUT_S) as response:
            body = _Body(response, url, lambda got, total: report(scan.name, got, total))
            data = _member(body, url, scan.member)
            body.finish()
        check(data, scan)
    except StanfordError:
        raise
    except urllib.error.HTTPError as error:
        error.close()
        raise StanfordError(f"{url}: the server answered {error.code} {error.reason}") from None
    except urllib.error.URLError as error:
        raise StanfordError(f"{url}: no connection ({error.reason})") from error
    except TimeoutError as error:
        raise StanfordError(f"{url}: no data for {TIMEOUT_S:g} s") from error
    except (OSError, http.client.HTTPException) as error:
        raise StanfordError(f"{url}: the connection broke ({error!r})") from error
    except (tarfile.TarError, EOFError, zlib.error) as error:
        raise StanfordError(f"{url}: not a whole .tar.gz archive ({error})") from error
    except ValueError as error:
        raise StanfordError(f"{url}: {scan.member}: {error}") from error
    return data


class _Body:
    """What the server sends, as tarfile reads it: reports progress and notices a cut-off end."""

    def __init__(
        self,
        response: http.client.HTTPResponse,
        url: str,
        report: Callable[[int, int | None], None],
    ) -> None:
        length = response.headers.get("Content-Length", "")
        self._total = int(length) if length.isdecimal() else None
        self._received = 0
        self._response = response
        self._url = url
        self._report = report

    def read(self, size: int) -> bytes:
        """Return up to `size` bytes; none at the end."""
        try:
            chunk = self._response.read(size)
        except http.client.IncompleteRead as error:
            chunk = error.partial
        self._received += len(chunk)
        if not chunk and self._total is not None and self._received < self._total:
            raise StanfordError(
                f"{self._url}: cut off after {self._received} of {self._total} bytes"
            )
        self._report(self._received, self._total)
        return chunk

    def finish(self) -> None:
        """Report the end: what lies behind the member is not read."""
        self._report(self._total or self._received, self._total)


def _member(body: _Body, url: str, wanted: str) -> bytes:
    """Return the contents of the file `wanted` in a .tar.gz stream. Nothing is unpacked to disk."""
    with tarfile.open(fileobj=body, mode="r|gz") as archive:  # type: ignore[call-overload]
        for info in archive:
            path = PurePosixPath(info.name)
            if path.is_absolute() or ".." in path.parts or "\\" in info.name:
                raise StanfordError(f"{url}: refused, it holds the path {info.name!r}")
            if path != PurePosixPath(wanted):
                continue
            if not info.isreg() or info.size > MAX_MEMBER_BYTES:
                raise StanfordError(f"{url}: {wanted} is not a file of a sensible size")
            stream = archive.extractfile(info)
            assert stream is not None  # because it is a regular file
            return stream.read()
    raise StanfordError(f"{url}: holds no {wanted}")


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StanfordError(f"{folder}: cannot be made a folder ({error.strerror})") from error


def _write(path: Path, data: bytes) -> None:
    try:
        path.write_bytes(data)
    except OSError as error:
        raise StanfordError(f"{path.parent}: cannot be written to ({error.strerror})") from error


def _replace(part: Path, target: Path) -> None:
    try:
        os.replace(part, target)
    except OSError as error:
        raise StanfordError(f"{target}: cannot be written ({error.strerror})") from error


def _silent(name: str, received: int, total: int | None) -> None:
    """Report nothing."""


class _Bar:
    """A progress bar on stderr, one line for each name."""

    WIDTH = 30  # chosen, in characters
    EVERY_S = 0.1  # chosen: often enough to move, seldom enough to cost nothing

    def __init__(self) -> None:
        self._name = ""
        self._drawn_at = 0.0

    def __call__(self, name: str, received: int, total: int | None) -> None:
        done = total is not None and received >= total
        if name == self._name and not done and time.monotonic() < self._drawn_at + self.EVERY_S:
            return
        if name != self._name:
            self.close()
        self._name, self._drawn_at = name, time.monotonic()
        amount = f"{received / 1e6:.1f} MB"
        if total:
            filled = self.WIDTH * min(received, total) // total
            amount = f"[{'#' * filled:{self.WIDTH}}] {received / 1e6:.1f} of {total / 1e6:.1f} MB"
        sys.stderr.write(f"\r{name:8}{amount}")
        sys.stderr.flush()

    def close(self) -> None:
        """End the line that is being drawn."""
        if self._name:
            sys.stderr.write("\n")
            self._name = ""
