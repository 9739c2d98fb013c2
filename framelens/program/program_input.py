"""A program's standard input: the user's own, for as long as the user takes to answer."""

import io
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import TextIO


class Input(io.TextIOBase):
    """Takes the place of a program's standard input; ``waiting`` lets it wait without a limit.

    The program may close it: the user's own stays open.
    """

    def __init__(
        self, stdin: TextIO, waiting: Callable[[], AbstractContextManager[object]]
    ) -> None:
        self._stdin = stdin
        self._waiting = waiting

    def readable(self) -> bool:
        """Return True."""
        return True

    def readline(self, size: int | None = -1, /) -> str:  # type: ignore[override]
        """Return a line; "" at the end."""
        with self._waiting():
            return self._stdin.readline(-1 if size is None else size)

    def read(self, size: int | None = -1, /) -> str:
        """Return all that is left, or so many characters of it."""
        with self._waiting():
            return self._stdin.read(-1 if size is None else size)

    def fileno(self) -> int:
        """Return the number of the file that is read."""
        return self._stdin.fileno()

    def isatty(self) -> bool:
        """Return whether a user types it."""
        return self._stdin.isatty()

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """The encoding of what is read."""
        return self._stdin.encoding

    @property
    def buffer(self) -> object:
        """The bytes that are read."""
        return self._stdin.buffer

    def close(self) -> None:
        """Stay open."""
