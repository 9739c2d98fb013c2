"""A function of ours done in a process of its own, for what may crash, hang or take all memory.

A library that reads a damaged file may do so, and an OpenGL driver. The limits stop mistakes, not
attacks. For a whole program of a user there is guard.py, for many of them the course's sandbox;
where the guard cannot copy its process (system/copying.py), it starts one here, too.
"""

import os
import pickle
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any, BinaryIO, NoReturn, TypeVar

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


def started(
    words: Sequence[str],
    changes: Mapping[str, str],
    known: Mapping[str, str] = os.environ,
    /,
    **options: Any,
) -> "subprocess.Popen[bytes]":
    """Start Python with these words, in the environment ``known`` with changes.

    ``options`` are Popen's.

    Who starts it ends it. What it does is to end with its parent, too (``limits.end_with``).
    """
    return subprocess.Popen([sys.executable, *words], env={**known, **changes}, **options)


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
    pipes = {name: subprocess.PIPE for name in ("stdin", "stdout", "stderr")}
    with one_core():
        process = started(["-P", "-m", __name__], {"PYTHONPATH": path}, **pipes)
    with process:
        try:
            answer, errors = process.communicate(task, seconds)
        except subprocess.TimeoutExpired:
            raise Ended(None) from None
        finally:
            process.kill()  # if it still runs

    if process.returncode or not answer:
        lines = errors.decode(errors="replace").strip().splitlines() or [""]
        raise Ended(process.returncode, lines[-1])
    result, error = pickle.loads(answer)
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
    # Threads or handlers that a library left behind must not keep the process alive.
    os._exit(0)


def _answers() -> BinaryIO:
    """Return standard output for the answer alone; what a library prints goes to standard error."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return answers


if __name__ == "__main__":
    main()
