"""A function of ours done in a process of its own, for what may crash, hang or take all memory.

A library that reads a damaged file may do so, and an OpenGL driver. The limits stop mistakes, not
attacks. For a whole program of a user there is guard.py, for many of them the course's sandbox.
"""

import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from typing import BinaryIO, NoReturn, TypeVar

from framelens.system import limits
from framelens.system.processes import one_core

Result = TypeVar("Result")


class Ended(Exception):
    """The process ended before its work was done.

    ``status`` is as of a Popen, None if it was late; ``message`` the last line that it wrote on
    standard error, or "".
    """

    def __init__(self, status: int | None, message: str = "") -> None:
        super().__init__(status, message)
        self.status = status
        self.message = message


def isolated(
    function: Callable[..., Result],
    *arguments: object,
    seconds: float,
    worked: int | None = None,
    megabytes: int | None = None,
) -> Result:
    """Return ``function(*arguments)``, called in a new process.

    The function is one of a module. It may take so many ``seconds`` of the clock, seconds of the
    processor (``worked``) and ``megabytes`` in all; what it raises is raised here, MemoryError too.
    Ended if its process was ended.
    """
    task = pickle.dumps((os.getpid(), worked, megabytes, function, arguments))
    path = os.pathsep.join([*filter(None, [os.environ.get("PYTHONPATH")]), *sys.path])
    with one_core():
        environment = {**os.environ, "PYTHONPATH": path}
    try:
        done = subprocess.run(
            [sys.executable, "-P", "-m", __name__],
            input=task,
            capture_output=True,
            env=environment,
            timeout=seconds,
        )
    except subprocess.TimeoutExpired:
        raise Ended(None) from None

    if done.returncode or not done.stdout:
        lines = done.stderr.decode(errors="replace").strip().splitlines() or [""]
        raise Ended(done.returncode, lines[-1])
    result, error = pickle.loads(done.stdout)
    if error is not None:
        raise error
    return result  # type: ignore[no-any-return]


def main() -> NoReturn:
    """Do the task of standard input in this process, and end it."""
    answers = _answers()
    parent, worked, megabytes, function, arguments = pickle.load(sys.stdin.buffer)
    limits.end_with(parent)
    if worked is not None:
        limits.limit_work(worked)
    if megabytes is not None:
        limits.limit_memory(megabytes << 20)

    result, error = None, None
    try:
        result = function(*arguments)
    except Exception as raised:
        error = raised
    limits.limit_memory(None)
    with answers:
        pickle.dump((result, error), answers, pickle.HIGHEST_PROTOCOL)
    # What a library has left behind must not keep the process from its end.
    os._exit(0)


def _answers() -> BinaryIO:
    """Return standard output for the answer alone; what a library prints goes to standard error."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return answers


if __name__ == "__main__":
    main()
