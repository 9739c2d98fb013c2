"""How a command begins, before it has imported what can handle anything: it is imported first."""

from __future__ import annotations

import os
import signal
import sys

from framelens.base.packages import speaker

# Until the handler is there, Ctrl-C prints a traceback: typing would take a quarter of that time.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import NoReturn

INTERRUPTED = 128 + signal.SIGINT  # the exit status, by the shell's rule


def run(load: Callable[[], Callable[[], int]]) -> int:
    """Return the exit status of the command line that ``load`` imports.

    Ctrl-C in the meantime ends the process at once, in one line: there is nothing to tidy up yet.
    """
    open_streams()
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:  # as with `nohup`
        return load()()
    signal.signal(signal.SIGINT, _end)
    main = load()
    signal.signal(signal.SIGINT, signal.default_int_handler)
    return main()


def _end(number: int, _: object) -> NoReturn:
    os.write(2, f"{speaker()}: interrupted\n".encode())
    os._exit(INTERRUPTED)


def open_streams() -> None:
    """Open on nothing what the shell has closed of standard input, output and error.

    Otherwise the next file would get the number of the closed one, and whatever a library of C
    prints there would go into that file.
    """
    number = 0
    while (number := os.open(os.devnull, os.O_RDWR)) <= 2:
        os.set_inheritable(number, True)
    os.close(number)
    if sys.stdin is None:
        sys.stdin = open(0, closefd=False)  # noqa: SIM115  # open as long as the process
    if sys.stdout is None:
        sys.stdout = open(1, "w", closefd=False)  # noqa: SIM115
    if sys.stderr is None:
        sys.stderr = open(2, "w", closefd=False)  # noqa: SIM115
