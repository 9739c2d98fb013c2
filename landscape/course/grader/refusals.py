"""What Python refuses a program in the sandbox: other programs, the network, most writing.

Solutions are not read, either.

It is an audit hook (see sys.addaudithook): Python tells it before it opens a file, and the like. A
few functions tell it nothing, and are replaced. It refuses from the moment when the program's own
code begins. Where the system contains the program (confinement.py), this only says sooner what is
wrong; elsewhere it is all there is, and ctypes gets around it.
"""

import contextlib
import os
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from types import CodeType
from typing import Any, NoReturn

WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
# Events of Python that name what is changed as their first argument: how many paths they name, with
# how many numbers of open folders they end, from which these paths lead, and whether a path that is
# a link stands for what it leads to.
CHANGING = {
    **dict.fromkeys(("os.remove", "os.mkdir", "os.rmdir"), (1, 1, False)),
    **dict.fromkeys(("os.rename", "os.link"), (2, 2, False)),
    **dict.fromkeys(("os.chmod", "os.chown", "os.utime"), (1, 1, True)),
    **dict.fromkeys(("os.truncate", "os.setxattr", "os.removexattr"), (1, 0, True)),
    **dict.fromkeys(("os.chflags", "shutil.chown", "sqlite3.connect"), (1, 0, True)),
    **{"shutil.rmtree": (1, 0, False), "shutil.move": (2, 0, False)},
}
STARTING = {
    *("subprocess.Popen", "os.system", "os.fork", "os.forkpty", "os.posix_spawn", "os.exec"),
    *("os.spawn", "os.startfile", "os.startfile/2", "pty.spawn", "os.killpg"),
}
CONNECTING = {"socket.__new__", "socket.connect", "socket.bind", "socket.getaddrinfo"}
# Functions that tell nothing: the module, the name, what they would do.
UNTOLD = (
    *(("os", name, "write") for name in ("mkfifo", "mknod", "chroot")),
    *(("readline", name, "write") for name in ("write_history_file", "append_history_file")),
    *(("os", name, "start") for name in ("pidfd_open", "setpgid", "setsid", "setpriority")),
    ("signal", "pidfd_send_signal", "start"),
    ("_posixsubprocess", "fork_exec", "start"),
)
NAMES = {
    "write": "writing files",
    "start": "starting or ending other programs",
    "network": "using the network",
    "read": "reading files of the course",
}


HIDDEN = Path(__file__).resolve().parents[1] / "exercises"


def _begin(folder: str) -> str:
    """Return how the paths of what is in a folder begin."""
    return os.path.join(os.path.realpath(folder), "")


class Refusals:
    """The hook; ``refused`` is the last thing it refused: a word of NAMES, or ""."""

    def __init__(self, path: str, folder: str, private: Sequence[str] = ()) -> None:
        self._path, self._folder = path, os.path.realpath(folder) + os.sep
        self._private = list(map(_begin, (str(HIDDEN), *private)))
        # Python itself may lie in a folder of the user's.
        self._needed = list(map(_begin, (sys.prefix, sys.base_prefix, *sys.path, folder)))
        self._armed = False
        self.refused = ""

    def __call__(self, event: str, args: Sequence[Any]) -> None:
        """Raise PermissionError for what is refused."""
        if not self._armed:
            if event == "exec" and isinstance(args[0], CodeType):
                self._armed = args[0].co_filename == self._path
                if self._armed:
                    self._replace_untold()
            return

        if event == "open":
            path, _, flags = args
            if isinstance(flags, int) and flags & WRITING and not isinstance(path, int):
                self._write(path, opens=True)
            elif not isinstance(path, int) and self._hides(os.fsdecode(path)):
                self._refuse("read")
        elif event in CHANGING:
            self._change(args, *CHANGING[event])
        elif event == "os.symlink":  # what it leads to is not changed
            self._change(args[1:], 1, 1, False)
        elif event in STARTING or (event == "os.kill" and args[0] != os.getpid()):
            self._refuse("start")
        elif event in CONNECTING:
            self._refuse("network")

    def _hides(self, path: str) -> bool:
        """Return whether a file is private, other than the program itself."""
        place = os.path.realpath(path)
        inside = max(
            (len(each) for each in self._private if f"{place}{os.sep}".startswith(each)), default=0
        )
        needed = max((len(each) for each in self._needed if place.startswith(each)), default=0)
        return inside > needed and place != os.path.realpath(self._path)

    def _change(self, args: Sequence[Any], paths: int, folders: int, follows: bool) -> None:
        """Refuse to change what is named, unless it is in the folder."""
        begins = args[len(args) - folders :] if folders else ()
        for number, path in enumerate(args[:paths]):
            self._write(path, begins[number] if begins else -1, follows)

    def _write(self, path: Any, begin: int = -1, follows: bool = True, opens: bool = False) -> None:
        """Refuse to write a path outside the folder; it may lead from an open folder, ``begin``.

        The folder itself may be opened: so a temporary file is made that has no name.
        """
        if path is None:
            return
        name = f"/proc/self/fd/{path}" if isinstance(path, int) else os.fsdecode(path)
        if begin != -1 and not os.path.isabs(name):
            name = f"/proc/self/fd/{begin}/{name}"
        parent, last = os.path.split(os.path.abspath(name))
        place = os.path.realpath(name) if follows else os.path.join(os.path.realpath(parent), last)
        allowed = place.startswith(self._folder) or place == os.devnull
        if not allowed and not (opens and place + os.sep == self._folder):
            self._refuse("write")

    def _refuse(self, word: str) -> NoReturn:
        self.refused = word
        raise PermissionError(f"{NAMES[word]} is not possible while a program is checked")

    def _replace_untold(self) -> None:
        """Replace the functions that tell nothing."""
        system = sys.modules[os.name]  # os has its functions from there
        for module, name, word in UNTOLD:
            with contextlib.suppress(ImportError):
                for owner in (system, os) if module == "os" else (import_module(module),):
                    if hasattr(owner, name):
                        setattr(owner, name, self._refusing(word))
        if os.open in os.supports_dir_fd:
            os.open = system.open = self._opening(os.open)  # type: ignore[attr-defined]

    def _refusing(self, word: str) -> Callable[..., NoReturn]:
        def refuse(*_: object, **__: object) -> NoReturn:
            self._refuse(word)

        return refuse

    def _opening(self, original: Callable[..., int]) -> Callable[..., int]:
        """Return os.open, which does not tell from which folder a path leads."""

        def opened(
            path: object, flags: int, mode: int = 0o777, *, dir_fd: int | None = None
        ) -> int:
            if flags & WRITING and dir_fd is not None:
                self._write(path, dir_fd, opens=True)
            return original(path, flags, mode, dir_fd=dir_fd)

        return opened
