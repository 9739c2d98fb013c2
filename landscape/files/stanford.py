"""Fetch the real rabbit and dragon: two scans of the Stanford 3D Scanning Repository.

The island has its own rabbit and dragon; the report of 2006 showed Stanford's. This module
downloads those, takes the two meshes out of their archives and checks them, so that they can be
used instead: ``rabbit.mesh`` and ``dragon.mesh``.

Stanford's terms (https://graphics.stanford.edu/data/3Dscanrep/): acknowledge the Stanford Computer
Graphics Laboratory as the source wherever the models or pictures of them appear; no commercial use
without Stanford's permission. That is why the scans are fetched and not shipped.

Copies of the scans differ in the spelling of their headers, never in their numbers: what is checked
is the number of vertices and faces, and a hash of the coordinates and faces themselves.
"""

import hashlib
import http.client
import tarfile
import urllib.error
import urllib.parse
import urllib.request
import zlib
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

import numpy as np

from framelens.base.errors import InputError
from framelens.base.output import check_output_folder, check_writable, write_all
from framelens.base.progress import Progress
from landscape.files.meshes import parse_ply

BASE_URL = "https://graphics.stanford.edu/pub/3Dscanrep"
TIMEOUT_S = 30.0  # chosen: a server that sends no byte for this long is not going to answer
MAX_MEMBER_BYTES = 64 << 20  # chosen: forty times the larger scan, and still fits any memory


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


def fetch(destination: Path, base_url: str = BASE_URL, quiet: bool = False) -> list[Path]:
    """Download the scans into the folder ``destination`` and return the paths of the two files.

    Files that exist and hold the right numbers are kept, and not fetched again. Nothing is written
    before all are present and correct. On a terminal a bar shows the progress, unless ``quiet``.
    InputError says what failed.
    """
    destination = Path(destination)
    if urllib.parse.urlsplit(base_url).scheme not in ("http", "https"):
        raise InputError(
            "{base_url}: expected an address that begins with http:// or https://",
            base_url=base_url,
        )
    check_output_folder(destination)
    paths = [destination / scan.file for scan in SCANS]
    for path in paths:
        check_writable(path)
    write_all(
        {
            path: download(scan, f"{base_url.rstrip('/')}/{scan.archive}", quiet)
            for scan, path in zip(SCANS, paths, strict=True)
            if not _is_right(path, scan)
        }
    )
    return paths


def fingerprint(vertices: np.ndarray, faces: np.ndarray) -> str:
    """Return the SHA-256 of the vertices as little-endian float32, then the faces as int32."""
    digest = hashlib.sha256(np.ascontiguousarray(vertices, dtype="<f4").tobytes())
    digest.update(np.ascontiguousarray(faces, dtype="<i4").tobytes())
    return digest.hexdigest()


def check(data: bytes, scan: Scan) -> None:
    """Raise ValueError, saying what differs, unless ``data`` is the PLY file of that scan."""
    vertices, faces = parse_ply(data)[:2]
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


def download(scan: Scan, url: str, quiet: bool = False) -> bytes:
    """Return the scan's PLY file out of the archive at ``url``, checked; InputError if it fails."""
    request = urllib.request.Request(url, headers={"User-Agent": "landscape"})
    try:
        with urllib.request.urlopen(request, timeout=TIMEOUT_S) as response:
            length = response.headers.get("Content-Length", "")
            total = int(length) if length.isdecimal() else None
            with Progress(total, quiet, scan.name, "B") as progress:
                data = _member(_Body(response, url, total, progress), url, scan.member)
                progress.reach(total or 0)  # what follows the member is not read
        check(data, scan)
    except InputError:
        raise
    except urllib.error.HTTPError as error:
        error.close()
        raise InputError(
            "{url}: the server answered {code} {reason}",
            url=url,
            code=error.code,
            reason=error.reason,
        ) from None
    except urllib.error.URLError as error:
        raise InputError("{url}: no connection ({reason})", url=url, reason=error.reason) from error
    except TimeoutError as error:
        raise InputError(
            "{url}: no data for {timeout_s:g} s", url=url, timeout_s=TIMEOUT_S
        ) from error
    except (OSError, http.client.HTTPException) as error:
        raise InputError("{url}: the connection broke ({error!r})", url=url, error=error) from error
    except (tarfile.TarError, EOFError, zlib.error) as error:
        raise InputError(
            "{url}: not a whole .tar.gz archive ({error})", url=url, error=error
        ) from error
    except ValueError as error:
        raise InputError(
            "{url}: {member}: {error}", url=url, member=scan.member, error=error
        ) from error

    return data


class _Body:
    """The server's answer as a file for tarfile: shows progress and detects a cut-off end."""

    def __init__(
        self,
        response: http.client.HTTPResponse,
        url: str,
        total: int | None,
        progress: Progress,
    ) -> None:
        self._response, self._url = response, url
        self._total, self._progress = total, progress
        self._received = 0

    def read(self, size: int) -> bytes:
        """Return up to ``size`` bytes; none at the end."""
        try:
            chunk = self._response.read(size)
        except http.client.IncompleteRead as error:
            chunk = error.partial
        self._received += len(chunk)
        if not chunk and self._total is not None and self._received < self._total:
            raise InputError(
                "{url}: cut off after {received} of {total} bytes",
                url=self._url,
                received=self._received,
                total=self._total,
            )
        self._progress.reach(self._received)
        return chunk


def _member(body: _Body, url: str, wanted: str) -> bytes:
    """Return the contents of the file ``wanted`` in a .tar.gz stream; nothing else is unpacked."""
    with tarfile.open(fileobj=body, mode="r|gz") as archive:  # type: ignore[call-overload]
        for info in archive:
            path = PurePosixPath(info.name)
            if path.is_absolute() or ".." in path.parts or "\\" in info.name:
                raise InputError(
                    "{url}: refused, it holds the path {name!r}", url=url, name=info.name
                )
            if path != PurePosixPath(wanted):
                continue
            if not info.isreg() or info.size > MAX_MEMBER_BYTES:
                raise InputError(
                    "{url}: {wanted} is not a file of a sensible size", url=url, wanted=wanted
                )
            stream = archive.extractfile(info)
            assert stream is not None  # because it is a regular file
            return stream.read()
    raise InputError("{url}: holds no {wanted}", url=url, wanted=wanted)
