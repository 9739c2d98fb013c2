"""What runs in the sandbox's processes: a program within its limits (see sandbox.py).

As a module of its own, ``python -m landscape.course.grader.sandboxed PARENT CONTAIN`` runs one
program: its order is its standard input, and what it sends its standard output; the process ends
when the process PARENT does.
"""

import contextlib
import faulthandler
import gc
import json
import os
import sys
import tempfile
import traceback
from importlib import import_module
from pathlib import Path

from framelens.system import containment, limits
from landscape.course.grader import confinement, shader_cache
from landscape.course.grader.confinement import LANDLOCK, NONE, PYTHON, REQUIRE
from landscape.course.grader.order import Order
from landscape.course.grader.sandbox import (
    FILE_BYTES,
    GRACE,
    MOST_OPEN,
    NEEDS_SCREEN,
    NO_SYSTEM,
)
from landscape.course.grader.stream import send

# What each program needs, imported once.
PRELOADED = (
    *("OpenGL.GL", "OpenGL.GLU", "OpenGL.arrays.ctypespointers", "OpenGL.arrays.numpymodule"),
    *("OpenGL.arrays.nones", "OpenGL.arrays.lists", "OpenGL.arrays.strings"),
    "OpenGL.arrays.ctypesarrays",
    *("PIL.Image", "numpy.random", "landscape.course.grader.witness", "framelens.gl.glfw_library"),
    "framelens.program.program_glfw",
)


# The kinds of OpenGL that are opened by files alone: a window of GLFW needs the screen's socket.
OPENED_BY_FILES = ("osmesa", "egl")


class Prepared:
    """What all programs of a process have: ``no_opengl`` says why there is none, or "".

    ``contained`` is what will contain them, and ``reason`` why it is not the system.
    """

    def __init__(self, contain: str) -> None:
        self.no_opengl = self.reason = ""
        self.contained = PYTHON
        self.backend = ""
        self._contain = contain
        self.shaders: Path | None = None

    def choose(self) -> None:
        """Decide what contains the programs."""
        if self._contain == NONE:
            return
        if not containment.possible():
            self.reason = NO_SYSTEM
        elif self.backend not in OPENED_BY_FILES:
            self.reason = NEEDS_SCREEN
        else:
            self.contained = LANDLOCK
            self.shaders = shader_cache.folder()

    def give_up(self, reason: str) -> None:
        """Let Python alone contain the programs."""
        self.contained, self.reason = PYTHON, reason
        self.shaders = None

    @property
    def uncontained(self) -> str:
        """Why programs cannot be contained although they must be, or ""."""
        return self.reason if self._contain == REQUIRE else ""


def prepare(stack: contextlib.ExitStack, contain: str) -> Prepared:
    """Import what programs need, replace OpenGL's functions, and leave the network."""
    from framelens.base.errors import NoOpenGLError
    from framelens.program.program_context import bind
    from framelens.program.program_source import Source

    limits.leave_network()  # if it cannot, Python's refusal of sockets remains
    found = Prepared(contain)
    try:
        source = Source(Path(), compile("", "", "exec"), frozenset(), True)
        found.backend = backend = bind(source, "auto")
    except NoOpenGLError as error:
        found.no_opengl = str(error)
        return found
    for name in (*PRELOADED, *(["OpenGL.osmesa"] if backend == "osmesa" else [])):
        import_module(name)
    from framelens.program.program import prepared
    from framelens.state import state_reading
    from landscape.course.grader.witness import make

    if limits.FORKS:
        state_reading.prepare()  # once for all programs; on Windows it would need a context
    stack.enter_context(prepared(make))
    found.choose()
    if found.contained == LANDLOCK:
        confinement.prepare()
    sys.dont_write_bytecode = True
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 100)  # calls are kept to the end: looking for garbage is in vain
    return found


def run_program(order: Order, parent: int, ours: Prepared, answers: int, errors: int) -> None:
    """Run one program within its limits, and end the process.

    ``answers`` is the pipe for what it sends, ``errors`` the file for what faulthandler writes.
    """
    leave = os._exit  # a program is given another one
    try:
        limits.end_with(parent)
        discard = os.open(os.devnull, os.O_RDWR)
        for number in range(3):
            os.dup2(discard, number)
        os.chdir(order["cwd"])
        folder = Path(order["folder"])
        tempfile.tempdir = str(folder)
        os.environ.update(dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder)))
        limits.limit_work(int(order["seconds"] + GRACE) + 1, FILE_BYTES)
        limits.limit_open_files(MOST_OPEN)
        limits.limit_memory(limits.used() + (order["megabytes"] << 20))
        if ours.backend == "osmesa":
            # Drivers of cards take them by terabytes.
            limits.limit_addresses(order["megabytes"] << 20)
        from landscape.course.grader import witness

        if order["why"]:
            from landscape.course.grader import cause  # before its file can no more be read
        if order["recorded"]:
            from landscape.course.grader import recorded

            recorded.play(Path(order["recorded"]), order["take"])
        if ours.contained == LANDLOCK:
            _confine(order, folder, ours)
        # Where the program is when it crashes, for the grader.
        faulthandler.enable(errors, all_threads=False)
        if order["why"]:
            send(answers, {"cause": cause.of(order["path"], max(order["frames"]), order["why"])})
        else:
            witness.run(order, answers, leave)
        leave(0)
    except BaseException:
        try:
            with contextlib.suppress(OSError, ValueError):
                limits.limit_memory(None)
            send(answers, {"trouble": traceback.format_exc()})
        finally:
            leave(1)


def _confine(order: Order, folder: Path, ours: Prepared) -> None:
    """Leave this process to what its program may have; its home is its own folder."""
    written = shader_cache.use(ours.shaders, folder, order["trusted"])
    os.environ["HOME"] = str(folder)
    readable = [ours.shaders] if ours.shaders is not None else []
    confinement.confine(Path(order["path"]), readable, [folder, *written], order["hidden"])


def main(parent: int, contain: str) -> None:
    """Run the program of the order that standard input holds, in this process."""
    limits.end_with(parent)
    order = json.load(sys.stdin)
    answers, errors = os.dup(1), os.dup(2)
    with contextlib.ExitStack() as stack:
        ours = prepare(stack, contain)
        ready = {
            "no_opengl": ours.no_opengl,
            "contained": ours.contained,
            "uncontained": ours.uncontained,
        }
        os.write(answers, json.dumps(ready).encode() + b"\n")
        if not (ours.no_opengl or ours.uncontained):
            run_program(order, parent, ours, answers, errors)


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
