"""The folder in which programs may write: one for a sandbox, and in it one for each program.

A sandbox that was killed cannot delete its folder. So the next one does: a folder whose lock nobody
holds is nobody's.
"""

import contextlib
import os
import stat
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

if sys.platform != "win32":
    import fcntl

PREFIX = "landscape-check-"
LOCK = "lock"
MOST_BYTES = 256 << 20  # chosen: of all files of one program
MOST_FILES = 1000  # chosen: more take seconds to delete


class Workplace:
    """A temporary folder, until it is closed."""

    def __init__(self) -> None:
        _delete_abandoned()
        while True:
            self.folder = Path(tempfile.mkdtemp(prefix=PREFIX)).resolve()
            self._lock = os.open(self.folder / LOCK, os.O_RDWR | os.O_CREAT)
            # Another sandbox that begins may have found the lock before it was taken.
            if _take(self._lock) and (self.folder / LOCK).exists():
                break
            os.close(self._lock)
        self._count = 0

    @contextlib.contextmanager
    def parts(self, count: int) -> Iterator[list[Path]]:
        """Have so many new folders for the block; they are deleted with what is in them."""
        made = []
        try:
            for _ in range(count):
                self._count += 1
                made.append(self.folder / str(self._count))
                made[-1].mkdir()
            yield made
        finally:
            for folder in made:
                delete(folder)

    def close(self) -> None:
        """Delete it; may be called twice."""
        with contextlib.suppress(OSError):
            os.close(self._lock)
        delete(self.folder)


def _take(lock: int) -> bool:
    """Return whether the lock was free; then it is ours until we close the file, or end."""
    if sys.platform != "win32":
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            return False
    return True


def _delete_abandoned() -> None:
    """Delete the folders of sandboxes of this user that were killed."""
    if sys.platform == "win32":  # which locks no such files
        return
    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
        # One without a lock may be about to get it.
        with contextlib.suppress(OSError):
            if folder.lstat().st_uid != os.getuid() or folder.is_symlink():
                continue
            lock = os.open(folder / LOCK, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK)
            try:
                if _take(lock):
                    delete(folder)
            finally:
                os.close(lock)


def delete(folder: Path) -> None:
    """Delete a folder, however deep the folders in it are; what cannot be deleted stays.

    Folders inside others are moved up before they are emptied, so that no path is too long, and
    nothing here calls itself.
    """
    moved = 0
    with contextlib.suppress(OSError):
        while folders := [each for each in _entries(folder) if not _deleted(each)]:
            for inner in folders:
                for each in _entries(inner):
                    if not _deleted(each):
                        moved += 1
                        each.rename(folder / f"moved-{moved}")
                inner.rmdir()
        folder.rmdir()


def _entries(folder: Path) -> list[Path]:
    if sys.platform != "win32":
        folder.chmod(stat.S_IRWXU)  # its program may have taken our right to look
    return list(folder.iterdir())


def _deleted(path: Path) -> bool:
    """Delete a file or a link; return False for a folder."""
    if stat.S_ISDIR(path.lstat().st_mode):
        return False
    path.unlink()
    return True


def deleted_bytes(pid: int, folder: Path, largest: int) -> int:
    """Return how many bytes of files in a folder a process has deleted and still holds.

    They take room until it closes them. One that is mapped alone, and closed, counts as the
    ``largest`` that it may be: the mapping may be shorter. 0 where there is no /proc.
    """
    if sys.platform == "win32":
        return 0
    sizes: dict[tuple[int, int], int] = {}
    ours = f"{folder}/"
    with contextlib.suppress(OSError):
        for number in os.listdir(f"/proc/{pid}/fd"):
            with contextlib.suppress(OSError):
                path = f"/proc/{pid}/fd/{number}"
                found = os.stat(path)
                if found.st_nlink == 0 and os.readlink(path).startswith(ours):
                    sizes[found.st_dev, found.st_ino] = found.st_size

    with contextlib.suppress(OSError):
        for line in Path(f"/proc/{pid}/maps").read_text(errors="replace").splitlines():
            words = line.split(maxsplit=5)
            if len(words) == 6 and words[5].startswith(ours) and words[5].endswith(" (deleted)"):
                major, minor = (int(number, 16) for number in words[3].split(":"))
                sizes.setdefault((os.makedev(major, minor), int(words[4])), largest)

    return sum(sizes.values())


def overfull(folder: Path, deleted: int = 0) -> bool:
    """Return whether there is more in a folder than a program may write.

    ``deleted`` are bytes of files that it holds and that have no name there any more.
    """
    count, size = 0, deleted
    if size > MOST_BYTES:
        return True
    waiting = [str(folder)]
    while waiting:
        with contextlib.suppress(OSError), os.scandir(waiting.pop()) as entries:
            for entry in entries:
                count += 1
                found = entry.stat(follow_symlinks=False)
                size += found.st_size
                if stat.S_ISDIR(found.st_mode):
                    waiting.append(entry.path)
                if size > MOST_BYTES or count > MOST_FILES:
                    return True
    return False
