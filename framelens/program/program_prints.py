"""A program's output goes to standard error, cut where nobody would read on."""

import io
import sys

MOST = 1 << 20  # chosen: characters


class Prints(io.TextIOBase):
    """Takes the place of a program's standard output."""

    def __init__(self) -> None:
        self._left = MOST
        self._amid_line = False

    def writable(self) -> bool:
        """Return True."""
        return True

    def write(self, text: str) -> int:
        """Print the text, or as much of it as is left to be printed."""
        if self._left > 0 and sys.stderr is not None:
            sys.stderr.write(text[: self._left])
            self._left -= len(text)
            self._amid_line = not text.endswith("\n") if text else self._amid_line
            if self._left <= 0:
                sys.stderr.write("\n... (the program prints more)\n")
                self._amid_line = False
        return len(text)

    def end(self) -> None:
        """End the line, if the program has not: what follows it is not the program's."""
        if self._amid_line and sys.stderr is not None:
            sys.stderr.write("\n")
            self._amid_line = False

    def reconfigure(self, **options: object) -> None:
        """Do nothing, unlike a file: standard error writes in an encoding of its own."""

    def flush(self) -> None:
        """Do nothing: standard error is written at once."""

    def close(self) -> None:
        """Stay open: standard error is not the program's own."""
