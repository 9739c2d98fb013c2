"""Progress of a long job: one bar, on a terminal only."""

import os
import sys
from typing import Any

BAR = "{bar:30} {n_fmt}/{total_fmt} {desc} [{elapsed}<{remaining}]"


class Progress:
    """A bar on standard error where that is a terminal; nothing elsewhere, or when quiet.

    ``with Progress(3) as progress:``, then :meth:`step` for each thing done; or, with the ``unit``
    "B", :meth:`reach` for the bytes done so far.
    """

    def __init__(
        self, total: int | None, quiet: bool = False, title: str = "", unit: str = ""
    ) -> None:
        """Begin a bar of ``total`` steps, None where that is not known. One step needs no bar."""
        self.shown = total != 1 and not quiet and _on_terminal()
        self._bar: Any = None
        if self.shown:
            from tqdm import tqdm

            # A single line, drawn at each step; bytes come too often for that.
            self._bar = tqdm(
                total=total,
                bar_format=BAR,
                file=sys.stderr,
                ncols=_columns(),
                nrows=24,  # tqdm hides a bar where a terminal gives its height as 0
                unit=unit,
                unit_scale=bool(unit),
                mininterval=0.1 if unit else 0.0,
            )
            self._bar.set_description_str(title, refresh=False)

    def __enter__(self) -> "Progress":
        return self

    def step(self, name: str, count: int = 1) -> None:
        """Count one more thing done, or several, and show the name."""
        if self._bar is not None:
            self._bar.set_description_str(name, refresh=False)
            self._bar.update(count)

    def reach(self, done: int) -> None:
        """Show that ``done`` of the total are done."""
        if self._bar is not None and done > self._bar.n:
            self._bar.update(done - self._bar.n)

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()


def _on_terminal() -> bool:
    """Return whether standard error is a terminal."""
    # Standard error is None if it was closed at the start, a closed file if it was closed later.
    return sys.stderr is not None and not sys.stderr.closed and sys.stderr.isatty()


def _columns() -> int:
    """Return the width of the terminal; 80 where it is not known, or given as 0."""
    try:
        return os.get_terminal_size(sys.stderr.fileno()).columns or 80
    except (OSError, ValueError):
        return 80
