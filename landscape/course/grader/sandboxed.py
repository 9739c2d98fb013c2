"""What runs in the sandbox's processes: a program within its limits (see sandbox.py).

As a module of its own, ``python -m landscape.course.grader.sandboxed FOLDER PARENT`` runs one
program: the job is in the folder, and the process ends when the process PARENT does.
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
from typing import Any

from framelens.system import limits
from landscape.course.grader.sandbox import ANSWER, CRASH, FILE_BYTES, GRACE, JOB, READY, TROUBLE

# What each program needs, imported once.
PRELOADED = (
    *("OpenGL.GL", "OpenGL.GLU", "OpenGL.arrays.ctypespointers", "OpenGL.arrays.numpymodule"),
    *("OpenGL.arrays.nones", "OpenGL.arrays.lists", "OpenGL.arrays.strings"),
    "OpenGL.arrays.ctypesarrays",
    *("PIL.Image", "numpy.random", "landscape.course.grader.witness", "framelens.gl.glfw_library"),
)


def prepare(stack: contextlib.ExitStack) -> str:
    """Import what programs need, replace OpenGL's functions, and leave the network.

    Returns why there is no OpenGL, or "".
    """
    from framelens.base.errors import NoOpenGLError
    from framelens.program.program_context import bind
    from framelens.program.program_source import Source

    limits.leave_network()  # if it cannot, Python's refusal of sockets remains
    try:
        backend = bind(Source(Path(), compile("", "", "exec"), frozenset(), True), "auto")
    except NoOpenGLError as error:
        return str(error)
    for name in (*PRELOADED, *(["OpenGL.osmesa"] if backend == "osmesa" else [])):
        import_module(name)
    from framelens.program.program import prepared
    from framelens.state import state_reading
    from landscape.course.grader.witness import make

    if limits.FORKS:
        state_reading.prepare()  # once for all programs; on Windows it would need a context
    stack.enter_context(prepared(make))
    sys.dont_write_bytecode = True
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 100)  # calls are kept to the end: looking for garbage is in vain
    return ""


def run_program(job: dict[str, Any], parent: int) -> None:
    """Run one program within its limits, and end the process."""
    leave = os._exit  # a program is given another one
    folder = Path(job["folder"])
    try:
        limits.end_with(parent)
        discard = os.open(os.devnull, os.O_RDWR)
        for number in range(3):
            os.dup2(discard, number)
        os.chdir(job["cwd"])
        tempfile.tempdir = str(folder)
        os.environ.update(dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder)))
        limits.limit_work(int(job["seconds"] + GRACE) + 1, FILE_BYTES)
        limits.limit_memory(limits.used() + (job["megabytes"] << 20))
        from landscape.course.grader.witness import run

        # Where the program is when it crashes, for the grader.
        crash = os.open(folder / CRASH, os.O_WRONLY | os.O_CREAT)
        faulthandler.enable(crash, all_threads=False)
        run(job, folder / ANSWER, leave)
        leave(0)
    except BaseException:
        try:
            limits.limit_memory(None)
            (folder / TROUBLE).write_text(traceback.format_exc(), encoding="utf-8")
        finally:
            leave(1)


def main(folder: Path, parent: int) -> None:
    """Run the program of a folder's job, in this process."""
    limits.end_with(parent)
    with contextlib.ExitStack() as stack:
        no_opengl = prepare(stack)
        # Written whole at once: whoever waits for it looks whether it is there.
        (folder / f"{READY}.part").write_text(json.dumps({"no_opengl": no_opengl}))
        os.replace(folder / f"{READY}.part", folder / READY)
        if not no_opengl:
            run_program(json.loads((folder / JOB).read_bytes()), parent)


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]))
