"""A copy of this process, for work that may end it. Not on Windows, which has no fork."""

import os
import signal
import sys
import warnings

from framelens.system import limits

assert sys.platform != "win32"


class Copy:
    """A copy of this process, seen by its parent, with some of the methods of Popen."""

    def __init__(self, number: int) -> None:
        self.pid = number

    def poll(self) -> int | None:
        """Return the exit status, or minus the signal that ended it; None while it runs."""
        done, status = os.waitpid(self.pid, os.WNOHANG)
        return os.waitstatus_to_exitcode(status) if done else None

    def kill(self) -> None:
        """End it at once."""
        os.kill(self.pid, signal.SIGKILL)

    def terminate(self) -> None:
        """Ask it to end."""
        os.kill(self.pid, signal.SIGTERM)


def copy() -> Copy | None:
    """Copy this process; return None in the copy, which ends with its parent."""
    parent = os.getpid()
    with warnings.catch_warnings():
        # Python warns if there are threads, as a copy has none of them. Here they are those of
        # numpy's library, which wait for work, and which the library starts again in a copy.
        warnings.simplefilter("ignore", DeprecationWarning)
        number = os.fork()
    if number:
        return Copy(number)
    limits.end_with(parent)
    return None
