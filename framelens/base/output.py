"""Writing results: whole files or none.

Everything that the program writes to a path goes through :class:`Output`.
"""

import contextlib
import errno
import functools
import io
import itertools
import os
import stat
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from framelens.base.errors import InputError, reason
from framelens.system import claimed, clear, replace, still_claimed

BEGIN, END = ".landscape.", ".part"  # of the name of a temporary file
WRITABLE = "a folder that can be written"


class Output:
    """A file being written: it appears, or replaces an earlier one, whole, by :meth:`finish`.

    Until then the data are in a temporary file beside it; one that a killed process has left there
    is deleted. Folders are made where needed, and symbolic links are followed. A device or a pipe
    is never replaced: the data go straight into it, and cannot be taken back.
    """

    def __init__(self, path: Path, name: str = "") -> None:
        """Begin to write; ``name`` stands for the file in messages.

        InputError if it is a folder or cannot be written; then nothing is left behind.
        """
        self._path, self._name = path, name or str(path)
        self._target = self._temporary = ""
        self._folders: list[Path] = []  # made for this file
        with self._undone_on_error():
            self._file = self._opened()
            if self._temporary:
                os.chmod(self._temporary, _rights(path))

    def _opened(self) -> io.BufferedWriter:
        present = _mode(self._path)
        if present is not None and stat.S_ISDIR(present):
            raise IsADirectoryError(errno.EISDIR, "is a folder")
        if present is not None and not os.access(self._path, os.W_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        if present is not None and not stat.S_ISREG(present):
            return open(self._path, "wb")
        self._target = os.path.realpath(self._path)
        folder = Path(self._target).parent
        self._folders = [p for p in (folder, *folder.parents) if not p.exists()]
        folder.mkdir(parents=True, exist_ok=True)
        _clear(folder)
        while True:
            handle, self._temporary = tempfile.mkstemp(END, BEGIN, folder)
            if claimed(handle):
                return os.fdopen(handle, "wb")
            os.close(handle)  # another process has taken it for one that was left behind

    def write(self, data: bytes) -> None:
        """Hand data to the system: should the program be killed, they are in the temporary file."""
        try:
            self._file.write(data)
            self._file.flush()
        except OSError as error:
            self.discard()
            raise _cannot_be_written(self._name, error) from None

    @property
    def place(self) -> str:
        """The path of the temporary file, for a library that writes it by itself; "" if none."""
        return self._temporary

    @property
    def closed(self) -> bool:
        """Whether the file is complete or discarded."""
        return self._file.closed

    def finish(self) -> None:
        """Complete the file; InputError where the disk is full."""
        with self._undone_on_error():
            if not self._temporary:
                return self._file.close()
            os.fsync(self._file.fileno())
            with still_claimed(self._file.fileno()):
                self._file.close()
                replace(self._temporary, self._target)
                self._temporary, self._folders = "", []

    def discard(self) -> None:
        """Delete what is not complete, and folders made for it; may be called at any time."""
        if hasattr(self, "_file"):
            # Closing fails on a full disk, but the file is being discarded anyway.
            with contextlib.suppress(OSError):
                self._file.close()
        if self._temporary:
            with contextlib.suppress(OSError):
                os.unlink(self._temporary)
        for folder in self._folders:
            with contextlib.suppress(OSError):
                folder.rmdir()
        self._temporary, self._folders = "", []

    @contextlib.contextmanager
    def _undone_on_error(self) -> Iterator[None]:
        try:
            yield
        except BaseException as error:  # an interrupt, too, leaves nothing behind
            self.discard()
            if isinstance(error, OSError):
                raise _cannot_be_written(self._name, error) from None
            raise


@functools.cache
def _clear(folder: Path) -> None:
    """Delete the temporary files of processes that were killed; once for each folder."""
    with contextlib.suppress(OSError):
        with os.scandir(folder) as entries:
            left = [each.path for each in entries if each.name.startswith(BEGIN)]
        for path in left:
            if path.endswith(END):
                with contextlib.suppress(OSError):
                    clear(path)


def _cannot_be_written(name: str, error: OSError) -> InputError:
    return InputError("{name}: cannot be written ({reason})", name=name, reason=reason(error))


def _mode(path: Path) -> int | None:
    """Return the type and rights of what a path leads to; None if nothing is there."""
    try:
        return os.stat(path).st_mode
    except FileNotFoundError:
        return None


def _rights(path: Path) -> int:
    """Return the rights of the file that a path leads to, or those that a new file gets there."""
    present = _mode(path)
    if present is not None:
        return stat.S_IMODE(present)
    umask = os.umask(0)
    os.umask(umask)
    return 0o666 & ~umask


def write_whole(path: Path, data: bytes | Sequence[bytes]) -> None:
    """Write one file; see :func:`write_all`."""
    write_all({path: data})


def write_all(files: Mapping[Path, bytes | Sequence[bytes]]) -> None:
    """Write files, each from bytes or from several parts: all of them whole, or none.

    A reader sees the old file or the whole new one. InputError names the file that cannot be
    written; then no part of a file or new folder is left.
    """
    outputs: list[Output] = []
    try:
        for path, data in files.items():
            outputs.append(Output(path))
            for part in [data] if isinstance(data, bytes) else data:
                outputs[-1].write(part)
        for output in outputs:
            output.finish()
    finally:
        for output in reversed(outputs):
            output.discard()


def png(pixels: np.ndarray, small: bool = False) -> bytes:
    """Encode uint8 pixels (h, w, 3 or 4) as a PNG, quickly or ``small``."""
    buffer = io.BytesIO()
    # Level 1 is 15 times as fast as level 9, for a quarter more bytes.
    Image.fromarray(pixels).save(buffer, "PNG", compress_level=9 if small else 1)
    return buffer.getvalue()


def save_png(pixels: np.ndarray, path: Path, small: bool = False) -> None:
    """Write uint8 pixels (h, w, 3 or 4) as a PNG, quickly or ``small``."""
    write_whole(path, png(pixels, small))


def output_paths(out: Path | None, names: list[str]) -> list[Path]:
    """Return a path per name: FILE.png for one, a folder for several. Nothing is made yet.

    One picture may go into a device or a pipe, too. InputError where it is clear, before anything
    is drawn, that this cannot be written.
    """
    if out is None or _is_folder(out, "a name that ends in .png, or a folder"):
        check_folder(out or Path())
        return [(out or Path()) / f"{name}.png" for name in names]
    if len(names) != 1:
        raise InputError(
            "--out {out}: expected a folder for {count} views", out=out, count=len(names)
        )
    check_writable(out, "--out ")
    return [out]


def check_output_folder(out: Path, option: str = "--out ") -> None:
    """Raise InputError unless ``out`` is a folder, or the name of one that can be made."""
    if not _is_folder(out, WRITABLE, option):
        raise InputError(
            "{option}{out}: expected {writable}", option=option, out=out, writable=WRITABLE
        )
    check_folder(out, f"{option}{out}")


def _is_folder(out: Path, expected: str, option: str = "--out ") -> bool:
    """Return whether ``out`` is a folder, or the name of one that is to be made.

    InputError, with what is ``expected``, for the name of a file that is not a PNG.
    """
    mode, suffix = _found(out, option), out.suffix.lower()
    if mode is not None and stat.S_ISDIR(mode):
        return True
    if suffix == ".png" or (mode is not None and not stat.S_ISREG(mode)):
        return False
    # To make a folder named like a file of another format would be a mistake, but a name such as
    # "run-1.5" has no ending.
    if mode is not None or suffix[1:2].isalpha():
        raise InputError(
            "{option}{out}: expected {expected}", option=option, out=out, expected=expected
        )
    return True


def _found(path: Path, option: str) -> int | None:
    """Return what :func:`_mode` does; InputError where the path cannot be followed."""
    try:
        return _mode(path)
    except OSError as error:
        raise _cannot_be_written(f"{option}{path}", error) from None


def next_free(stem: str, suffix: str, folder: Path | None = None) -> Path:
    """Create an empty file STEM-0001SUFFIX, or the next free number; OSError if impossible."""
    for number in itertools.count(1):
        path = (folder or Path()) / f"{stem}-{number:04}{suffix}"
        with contextlib.suppress(FileExistsError):
            path.open("x").close()
            return path
    raise AssertionError("count() does not end")


def check_writable(path: Path, option: str = "") -> None:
    """Raise InputError if it is clear that :class:`Output` could not write ``path``."""
    mode = _found(path, option)
    if mode is not None and stat.S_ISDIR(mode):
        raise InputError(
            "{option}{path}: expected a file, found a folder", option=option, path=path
        )
    if mode is None or stat.S_ISREG(mode):
        check_folder(Path(os.path.realpath(path)).parent, f"{option}{path}")
    if mode is not None and not os.access(path, os.W_OK):
        raise InputError(
            "{option}{path}: cannot be written (Permission denied)", option=option, path=path
        )


def check_folder(folder: Path, name: str = "") -> None:
    """Raise InputError unless files can be written in a folder, which may not exist yet.

    ``name`` says in the message where the folder comes from; the default is ``--out`` itself.
    """
    standing = next((p for p in (folder, *folder.parents) if os.path.lexists(p)), folder)
    if not os.path.isdir(standing) or not os.access(standing, os.W_OK | os.X_OK):
        raise InputError(
            "{name}: expected {writable}", name=name or f"--out {folder}", writable=WRITABLE
        )
