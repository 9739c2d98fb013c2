"""Writing results: whole files or none.

Every file that the program writes goes through :func:`write_all`, except the recording of a walk,
which grows frame by frame (window/recording.py).
"""

import contextlib
import io
import itertools
import os
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from landscape.errors import InputError

# Only PNG is written: a folder to be made with one of these endings would be a mistake.
OTHER_PICTURES = {".jpg", ".jpeg", ".gif", ".bmp", ".tif", ".tiff", ".webp", ".ppm", ".avif"}


def write_whole(path: Path, data: bytes | Sequence[bytes]) -> None:
    """Write one file; see :func:`write_all`."""
    write_all({path: data})


def write_all(files: Mapping[Path, bytes | Sequence[bytes]]) -> None:
    """Write files, each from bytes or from several parts: all of them whole, or none.

    Each is written under another name; when all are ready, they are renamed. So a reader sees the
    old file or the whole new one. Folders are made where needed, and symbolic links are followed.
    InputError names the file that cannot be written; then no part of a file or new folder is left.
    """
    ready: list[tuple[str, str]] = []  # the temporary file and the one it becomes
    new_folders: list[Path] = []
    path = Path()
    try:
        for path, data in files.items():
            if path.is_dir():
                raise InputError(f"{path}: cannot be written (is a folder)")
            new_folders += [p for p in path.parents if not p.exists() and p not in new_folders]
            path.parent.mkdir(parents=True, exist_ok=True)
            target = os.path.realpath(path)
            handle, temporary = tempfile.mkstemp(dir=os.path.dirname(target), prefix=".landscape.")
            ready.append((temporary, target))
            with os.fdopen(handle, "wb") as file:
                for part in [data] if isinstance(data, bytes) else data:
                    file.write(part)
            umask = os.umask(0)
            os.umask(umask)
            os.chmod(temporary, 0o666 & ~umask)
        for path, (temporary, target) in zip(files, ready, strict=True):  # noqa: B007
            os.replace(temporary, target)
    except BaseException as error:  # an interrupt, too, leaves nothing behind
        for temporary, _ in ready:
            with contextlib.suppress(OSError):
                os.unlink(temporary)
        for folder in sorted(new_folders, key=lambda p: -len(p.parts)):
            with contextlib.suppress(OSError):
                folder.rmdir()
        if isinstance(error, OSError):
            raise InputError(f"{path}: cannot be written ({error.strerror})") from None
        raise


def save_png(pixels: np.ndarray, path: Path, small: bool = False) -> None:
    """Write uint8 pixels (h, w, 3 or 4) as a PNG, quickly or ``small``."""
    buffer = io.BytesIO()
    # Level 1 is 15 times as fast as level 9, for a quarter more bytes.
    Image.fromarray(pixels).save(buffer, "PNG", compress_level=9 if small else 1)
    write_whole(path, buffer.getvalue())


def output_paths(out: Path | None, names: list[str]) -> list[Path]:
    """Return a path per name: FILE.png for one, a folder for several. Nothing is made yet.

    InputError where it is clear, before anything is drawn, that this cannot be written.
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
    check_folder(folder)
    return paths


def next_free(stem: str, suffix: str, folder: Path | None = None) -> Path:
    """Create an empty file STEM-0001SUFFIX, or the next free number; OSError if impossible."""
    for number in itertools.count(1):
        path = (folder or Path()) / f"{stem}-{number:04}{suffix}"
        with contextlib.suppress(FileExistsError):
            path.open("x").close()
            return path
    raise AssertionError("count() does not end")


def check_folder(folder: Path) -> None:
    """Raise InputError unless files can be written in ``--out`` ``folder``, which may not exist."""
    standing = next((p for p in (folder, *folder.parents) if os.path.exists(p)), folder)
    if not os.path.isdir(standing) or not os.access(standing, os.W_OK | os.X_OK):
        raise InputError(f"--out {folder}: expected a folder that can be written")
