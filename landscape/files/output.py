"""Writing results: whole files or none, and progress on a terminal."""

import io
import itertools
import os
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

import numpy as np
from PIL import Image

from landscape.errors import InputError

# Written as a folder's name, these would be a mistake: only PNG is written.
OTHER_PICTURES = {".jpg", ".jpeg", ".gif", ".bmp", ".tif", ".tiff", ".webp", ".ppm", ".avif"}


def write_whole(path: Path, data: bytes) -> None:
    """Write a file under another name and rename it: readers see the old one or the whole new one.

    Makes the folder if need be, and follows a symbolic link. InputError where the folder or the
    file cannot be written.
    """
    temporary: str | None = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        target = os.path.realpath(path)
        handle, temporary = tempfile.mkstemp(dir=os.path.dirname(target), prefix=".landscape.")
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(temporary, 0o666 & ~umask)
        os.replace(temporary, target)
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror})") from None
    finally:
        if temporary is not None and os.path.exists(temporary):
            os.unlink(temporary)


def save_png(pixels: np.ndarray, path: Path, small: bool = False) -> None:
    """Write uint8 pixels (h, w, 3 or 4) as a PNG, quickly or ``small``."""
    buffer = io.BytesIO()
    # Level 1 is 15 times faster than 9 for a quarter more bytes.
    Image.fromarray(pixels).save(buffer, "PNG", compress_level=9 if small else 1)
    write_whole(path, buffer.getvalue())


def output_paths(out: Path | None, names: list[str]) -> list[Path]:
    """Return a path per name: FILE.png for one, a folder for several. Nothing is made yet.

    InputError where it is plain, before anything is drawn, that this cannot be written.
    """
    suffix = "" if out is None or os.path.isdir(out) else out.suffix.lower()
    if suffix in OTHER_PICTURES:
        raise InputError(f"--out {out}: expected FILE.png or a folder")
    if out is not None and suffix == ".png":
        if len(names) != 1:
            raise InputError(f"--out {out}: expected a folder for {len(names)} views")
        folder, paths = out.parent, [out]
    else:
        folder = out if out is not None else Path()
        paths = [folder / f"{name}.png" for name in names]
    standing = next((p for p in (folder, *folder.parents) if os.path.exists(p)), folder)
    if not os.path.isdir(standing) or not os.access(standing, os.W_OK | os.X_OK):
        raise InputError(f"--out {folder}: expected a folder that can be written")
    return paths


def next_free(stem: str, suffix: str, folder: Path | None = None) -> Path:
    """Create an empty file STEM-0001SUFFIX, or the next free number; OSError if impossible."""
    for number in itertools.count(1):
        path = (folder or Path()) / f"{stem}-{number:04}{suffix}"
        with suppress(FileExistsError):
            path.open("x").close()
            return path
    raise AssertionError("count() does not end")


class Progress:
    """A bar on a terminal's standard error; nothing where that is no terminal, or when quiet."""

    WIDTH = 30

    def __init__(self, total: int, quiet: bool = False) -> None:
        self._total, self._done = total, 0
        # A program started with standard error closed has none at all.
        terminal = sys.stderr is not None and sys.stderr.isatty()
        self.shown = total > 1 and not quiet and terminal

    def __enter__(self) -> "Progress":
        return self

    def step(self, name: str) -> None:
        """Count one more thing done."""
        self._done += 1
        if self.shown:
            filled = self.WIDTH * self._done // self._total
            bar = "#" * filled + "." * (self.WIDTH - filled)
            print(f"\r{bar} {self._done}/{self._total} {name:20}", end="", file=sys.stderr)

    def __exit__(self, *_: object) -> None:
        if self.shown:
            print(file=sys.stderr)
