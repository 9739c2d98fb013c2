"""Shared memory for processes that draw together, and a bell that wakes one of them.

Both go to a process with the arguments that it is started with. They have no name by which
another program could find them by chance.
"""

import mmap
import os
import sys
import tempfile
import uuid
from typing import Any

if sys.platform == "win32":
    from multiprocessing.connection import PipeConnection as Pipe
else:
    from multiprocessing.connection import Connection as Pipe
    from multiprocessing.reduction import DupFd

__all__ = ["Bell", "Pipe", "SharedMemory"]

if sys.platform == "win32":

    class SharedMemory:
        """Some bytes of ``memory``, zero at first. It stays until no process uses it.

        Whoever starts processes with it keeps it until they run: they open it by its name.
        """

        def __init__(self, size: int) -> None:
            """OSError where the system has none."""
            self.__setstate__((size, f"landscape-{uuid.uuid4()}"))

        def __getstate__(self) -> tuple[int, str]:
            return self._size, self._name

        def __setstate__(self, state: tuple[int, str]) -> None:
            self._size, self._name = state
            self.memory = mmap.mmap(-1, self._size, self._name)

        def close(self) -> None:
            """Say that no further process is started with it; ``memory`` can still be used."""

else:

    class SharedMemory:
        """Some bytes of ``memory``, zero at first. It stays until no process uses it."""

        def __init__(self, size: int) -> None:
            """OSError where the system has none."""
            if hasattr(os, "memfd_create"):
                self._file = os.memfd_create("landscape")
            else:
                with tempfile.TemporaryFile() as file:
                    self._file = os.dup(file.fileno())
            os.ftruncate(self._file, size)
            self.memory = mmap.mmap(self._file, 0)

        def __getstate__(self) -> dict[str, object]:
            return {"file": DupFd(self._file)}

        def __setstate__(self, state: dict[str, Any]) -> None:
            self._file = state["file"].detach()
            self.memory = mmap.mmap(self._file, 0)

        def close(self) -> None:
            """Say that no further process is started with it; ``memory`` can still be used."""
            os.close(self._file)


if sys.platform == "linux":

    class Bell:
        """Wakes a process, on a core that is free.

        A process that reads from a pipe is woken on the core of the one that writes, which is
        expected to wait from then on. Where both work, one waits for a bell before it reads.
        """

        def __init__(self) -> None:
            self._file = os.eventfd(0)

        def __getstate__(self) -> dict[str, object]:
            return {"file": DupFd(self._file)}

        def __setstate__(self, state: dict[str, Any]) -> None:
            self._file = state["file"].detach()

        def ring(self) -> None:
            """Wake the process that waits, or that will."""
            os.eventfd_write(self._file, 1)

        def wait(self) -> None:
            """Wait until somebody rings."""
            os.eventfd_read(self._file)

        def close(self) -> None:
            """Give it back to the system."""
            os.close(self._file)

else:

    class Bell:
        """Wakes nobody: a process that waits goes on at once, and waits for its pipe instead."""

        def ring(self) -> None:
            """Wake the process that waits, or that will."""

        def wait(self) -> None:
            """Wait until somebody rings."""

        def close(self) -> None:
            """Give it back to the system."""
