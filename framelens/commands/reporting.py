"""How a command ends: its exit status, and the one line that says why it failed.

Exit status: 0 done, 1 a check failed, 2 bad input, 3 no usable OpenGL, 70 a defect of this program.
"""

import argparse
import atexit
import contextlib
import gc
import io
import os
import signal
import sys
import threading
from collections.abc import Callable, Sequence
from functools import partial
from typing import TextIO

from framelens.base.errors import InputError, NoOpenGLError, say_unexpected, visible
from framelens.base.guard import guarded
from framelens.base.packages import speaker
from framelens.base.starting import INTERRUPTED
from framelens.base.texts import choose, said, speaking
from framelens.commands.parser import argparse_speaking, language_asked
from framelens.system import is_closed_pipe
from framelens.system.processes import Ending, ending_tidily


def run_command(
    argv: Sequence[str] | None, parse: Callable[[Sequence[str] | None], argparse.Namespace]
) -> int:
    """Parse a command line, run its command, and return the exit status.

    ``argv`` is None for the command line of this process. ``options.run`` is the command;
    ``options.own_process`` tells it whether the process is its own.
    """
    if isinstance(sys.stdout, io.TextIOWrapper):
        # A file name may have characters that the terminal's encoding lacks.
        sys.stdout.reconfigure(errors="backslashreplace")

    def run(ending: Ending) -> int:
        with argparse_speaking(choose(os.environ)):
            options = parse(argv)
        options.own_process = argv is None
        options.ending = ending
        status: int = options.run(options)
        return status

    try:
        words = sys.argv[1:] if argv is None else argv
        with ending_tidily() as ending, speaking(language_asked(words)):
            status = reported(partial(run, ending), ending)
        if argv is None and status == INTERRUPTED:
            _leave_threads()
        return status
    finally:
        if argv is None:
            # Python ends by looking for garbage among all that was imported, which is none.
            gc.freeze()
            _end_at_once_on_ctrl_c()


def _leave_threads() -> None:
    """End this process if threads of it still work: Python would wait for them."""
    if threading.active_count() > 1:
        atexit._run_exitfuncs()
        sys.stdout.flush()
        os._exit(INTERRUPTED)


def _end_at_once_on_ctrl_c() -> None:
    """Leave Ctrl-C to the system from now on: Python's own end would print a traceback."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)


def on_program(path: str, work: Callable[[], int], options: argparse.Namespace) -> int:
    """Do the work on a program in a process of its own, unless this one is somebody else's."""
    if not options.own_process:
        return work()
    return guarded(path, lambda: reported(work, options.ending))


def own_input(options: argparse.Namespace) -> TextIO | None:
    """Return standard input, for a program that reads it; None if it is somebody else's."""
    return sys.stdin if options.own_process else None


def notify(options: argparse.Namespace, lines: Sequence[str]) -> None:
    """Print each line once on standard error, unless the user wants quiet."""
    told: set[str] = vars(options).setdefault("told", set())
    for line in dict.fromkeys(lines):
        if line not in told and not options.quiet and sys.stderr is not None:
            print(f"{speaker()}: {visible(line)}", file=sys.stderr)
        told.add(line)


def reported(work: Callable[[], int], ending: Ending) -> int:
    """Return the exit status of ``work``, or of the error that it raises, once that is printed.

    A signal may interrupt OpenGL anywhere, as between glBegin and glEnd: what is then put back on
    the way out may fail, and its error hides what the signal raised. That is no defect.
    """
    try:
        status = work()
        print(end="", flush=True)
        return status
    except InputError as error:
        # A program that was looked into and raised an error has a traceback of its own.
        return _fail(said(error, choose(os.environ)), 2, getattr(error, "details", ""))
    except NoOpenGLError as error:
        return _fail(said(error, choose(os.environ)), 3)
    except OSError as error:
        if is_closed_pipe(error):
            # The reader (head, less) closed the pipe, so there is nothing more to print.
            _silence_output()
            return 0
        # Errors in writing files have their own messages; this is standard output on a full disk.
        _silence_output()
        return _fail(f"{error.filename or 'standard output'}: {error.strerror}", 2)
    except MemoryError:
        return _fail("not enough memory: expected a smaller --size or smaller settings", 2)
    except KeyboardInterrupt:
        return _fail("interrupted", INTERRUPTED)
    except Exception as error:
        if ending.status == INTERRUPTED:
            return _fail("interrupted", INTERRUPTED)
        return ending.status or say_unexpected(error)


def _fail(reason: object, status: int, details: str = "") -> int:
    if sys.stderr is not None:
        # A program's own exception may say anything.
        print(f"{speaker()}:", visible(" ".join(str(reason).splitlines())), file=sys.stderr)
        print(end=visible(details), file=sys.stderr)
    return status


def _silence_output() -> None:
    """Discard what is left of standard output, or the interpreter reports an error at exit."""
    with contextlib.suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
