"""The parts of a process that a program borrows while it runs, and their return."""

import gc
import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any

from framelens.program.program_source import Source


class Unwind(BaseException):
    """Ends the program: it has reached its frame, or cannot go on."""


@contextmanager
def as_main(source: Source, arguments: list[str], given: Any) -> Iterator[None]:
    """Give the process what a program finds that is started by itself, and put all back.

    ``given`` is its standard input.
    """
    before = sys.argv, sys.path, os.getcwd(), dict(os.environ), sys.modules["__main__"]
    modules = set(sys.modules)
    folder = str(source.path.resolve().parent)
    thread: Any = threading.current_thread()
    end = os._exit
    stdin, stderr = sys.stdin, sys.stderr
    us = os.getpid()
    tell = threading.excepthook

    # What was there before is no garbage of the program: forget() need not look through all of it.
    gc.freeze()
    try:
        sys.stdin = given  # exit() closes it
        sys.argv = arguments
        sys.path = [folder, *sys.path]
        os._exit = lambda status: sys.exit(status) if os.getpid() == us else end(status)
        # Threads inherit this: one that the program leaves behind must not keep the process alive.
        thread._daemonic = True
        threading.excepthook = lambda args: (
            None if issubclass(args.exc_type, Unwind) else tell(args)
        )
        yield
    finally:
        if os.getpid() != us:
            end(0)  # a copy of the program, which it has made itself
        gc.unfreeze()
        thread._daemonic = False
        threading.excepthook = tell
        os._exit = end
        sys.stdin, sys.stderr = stdin, stderr
        sys.argv, sys.path = before[:2]
        os.chdir(before[2])
        os.environ.clear()
        os.environ.update(before[3])
        sys.modules["__main__"] = before[4]
        for name in set(sys.modules) - modules:
            file = getattr(sys.modules[name], "__file__", None) or ""
            ours = (
                name.split(".")[0] in ("landscape", "OpenGL")
                or "site-packages" in file[len(folder) :]
            )
            if file.startswith(folder + os.sep) and not ours:
                del sys.modules[name]


def forget(module: ModuleType, threads: set[threading.Thread]) -> None:
    """Drop the program's objects: some delete OpenGL's in the context, which still is current.

    ``threads`` ran before: one that the program has left behind needs its objects.
    """
    if set(threading.enumerate()) <= threads:
        module.__dict__.clear()
    gc.collect()
