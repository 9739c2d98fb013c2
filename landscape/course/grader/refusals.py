"""What Python refuses a program in the sandbox: other programs, the network, most writing.

It is an audit hook (see sys.addaudithook): Python tells it before it opens a file, and the like. It
refuses from the moment when the program's own code begins.
"""

import os
from collections.abc import Sequence
from types import CodeType
from typing import Any

WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
# Events of Python that name what is changed as their first argument.
CHANGING = {
    *("os.remove", "os.rename", "os.mkdir", "os.rmdir", "os.link", "os.symlink", "os.truncate"),
    *("os.chmod", "os.chown", "os.utime", "shutil.rmtree", "shutil.move", "sqlite3.connect"),
}
STARTING = {
    *("subprocess.Popen", "os.system", "os.fork", "os.forkpty", "os.posix_spawn", "os.exec"),
    *("os.spawn", "pty.spawn", "os.killpg"),
}
CONNECTING = {"socket.__new__", "socket.connect", "socket.bind", "socket.getaddrinfo"}


class Refusals:
    """The hook; ``refused`` is the last thing it refused: network, start, write, or ""."""

    def __init__(self, path: str, folder: str) -> None:
        self._path, self._folder = path, os.path.realpath(folder) + os.sep
        self._armed = False
        self.refused = ""

    def __call__(self, event: str, args: Sequence[Any]) -> None:
        """Raise PermissionError for what is refused."""
        if not self._armed:
            if event == "exec" and isinstance(args[0], CodeType):
                self._armed = args[0].co_filename == self._path
            return
        if event == "open":
            path, _, flags = args
            if isinstance(flags, int) and flags & WRITING:
                self._write(path)
        elif event in CHANGING:
            self._write(args[0])
        elif event in STARTING or (event == "os.kill" and args[0] != os.getpid()):
            self._refuse("start", "starting or ending other programs")
        elif event in CONNECTING:
            self._refuse("network", "using the network")

    def _write(self, path: Any) -> None:
        if isinstance(path, int) or path is None:
            return  # a file that is open already
        place = os.path.realpath(os.fsdecode(path))
        if not place.startswith(self._folder) and place != os.devnull:
            self._refuse("write", "writing files")

    def _refuse(self, word: str, what: str) -> None:
        self.refused = word
        raise PermissionError(f"{what} is not possible while a program is checked")
