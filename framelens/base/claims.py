"""Claims: several processes, on several machines, share work by nothing but a folder.

Whoever creates the file NAME.claim does the work of that name. The file says who that is, and its
time of change is kept new while its process lives. A claim whose process is gone, or that has not
been touched for STALE seconds, may be taken over. Times are those of the folder's own machine, so
that no clocks are compared. Work that is done twice after all must do no harm.
"""

import contextlib
import json
import os
import socket
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from framelens.base.errors import InputError, reason
from framelens.system import is_running
from framelens.system.beside import beside

ENDING = ".claim"
BEAT = 20.0  # chosen: seconds between two touches of a claim
STALE = 300.0  # chosen: seconds without a touch after which a claim may be taken over
LARGEST = 4096  # bytes, far more than a claim has


@dataclass(frozen=True)
class Holder:
    """Who holds a claim: process ``pid`` of ``host``.

    It is ``held`` seconds since that took it, and ``silent`` seconds since it last touched it.
    """

    host: str
    pid: int
    held: float
    silent: float

    @property
    def gone(self) -> bool:
        """Whether the work must be taken over."""
        here = self.host == socket.gethostname()
        return self.silent > STALE or (here and not is_running(self.pid))

    def __str__(self) -> str:
        return f"{self.host}:{self.pid}"


class Claims:
    """The claims in a folder, and those among them of this process."""

    def __init__(self, folder: Path) -> None:
        """Claim nothing yet."""
        self._folder = folder
        self._ours: set[str] = set()

    def path(self, name: str) -> Path:
        """Return the file that claims the work of this name."""
        return self._folder / f"{name}{ENDING}"

    def take(self, name: str) -> bool:
        """Claim work; return False if another process does it. InputError if nobody can write."""
        for _ in range(2):
            try:
                handle = os.open(self.path(name), os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666)
            except FileExistsError:
                if not self._cleared(name):
                    return False
                continue
            except OSError as error:
                raise InputError(
                    "{path}: cannot be written ({reason})",
                    path=self.path(name),
                    reason=reason(error),
                ) from None
            self._ours.add(name)
            with os.fdopen(handle, "w", encoding="utf-8") as file:
                since = os.fstat(handle).st_mtime
                json.dump({"host": socket.gethostname(), "pid": os.getpid(), "since": since}, file)
            return True
        return False

    def release(self, name: str) -> None:
        """Give up a claim of this process; may be called twice."""
        if name in self._ours:
            self._ours.discard(name)
            with contextlib.suppress(OSError):
                self.path(name).unlink()

    def holder(self, name: str) -> Holder | None:
        """Return who holds a claim, None if nobody does."""
        return _holder(self.path(name), self._now())

    def holders(self) -> dict[str, Holder]:
        """Return who holds which claim of the folder."""
        now, found = self._now(), {}
        for path in sorted(self._folder.glob(f"*{ENDING}")):
            holder = _holder(path, now)
            if holder is not None:
                found[path.name.removesuffix(ENDING)] = holder
        return found

    def _cleared(self, name: str) -> bool:
        """Remove a claim whose holder is gone; return whether there is none any more."""
        holder = self.holder(name)
        if holder is None:
            return True
        if not holder.gone or name in self._ours:
            return False
        # Renamed first: of two processes that find it, only one takes it away.
        aside = self.path(name).with_suffix(f"{ENDING}.{socket.gethostname()}-{os.getpid()}")
        try:
            os.rename(self.path(name), aside)
        except OSError:
            return False
        taken = _holder(aside, self._now())
        if taken is not None and not taken.gone:
            # Another process has taken it over in between: this is its claim.
            with contextlib.suppress(OSError):
                os.link(aside, self.path(name))
        aside.unlink(missing_ok=True)
        return taken is None or taken.gone

    def _now(self) -> float:
        """Return the time of the folder's machine, in seconds."""
        try:
            with tempfile.NamedTemporaryFile(dir=self._folder, prefix=".now.") as file:
                return os.fstat(file.fileno()).st_mtime
        except OSError:  # a folder that one can only read
            return max((path.stat().st_mtime for path in self._folder.iterdir()), default=0.0)

    @contextmanager
    def kept(self) -> Iterator[None]:
        """Touch the claims of this process for the block, and release them at its end."""
        done = threading.Event()
        beat = beside(self._touch, done)
        try:
            yield
        finally:
            done.set()
            beat.join()
            for name in list(self._ours):
                self.release(name)

    def _touch(self, done: threading.Event) -> None:
        while not done.wait(BEAT):
            for name in list(self._ours):
                with contextlib.suppress(OSError):
                    os.utime(self.path(name))


def _holder(path: Path, now: float) -> Holder | None:
    """Return who holds a claim; of one that is being written, or is damaged, nobody known."""
    try:
        with open(path, "rb") as file:
            data = file.read(LARGEST)
            times = os.fstat(file.fileno())
    except OSError:
        return None
    try:
        found = json.loads(data)
        host, pid, since = str(found["host"]), int(found["pid"]), float(found["since"])
    except (ValueError, TypeError, KeyError, RecursionError):
        host, pid = "?", 0
        since = times.st_mtime
    # A time to come is that of a clock which has been put back: one who lives soon touches it anew.
    return Holder(host, pid, max(now - since, 0.0), abs(now - times.st_mtime))
