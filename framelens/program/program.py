"""Any PyOpenGL program, run unchanged to a chosen frame with its clock held still.

``run("program.py", 5, observer=observer)`` executes the program as ``python program.py`` would: as
``__main__``, with its arguments, its folder importable, in the user's folder. Its window is hidden.
A frame ends where the program shows it: glfw.swap_buffers, glutSwapBuffers, pygame.display.flip;
frame 0 begins when the context becomes current, so what is set up belongs to it. The observer is
called inside the program, in its context. After the chosen frame the program is unwound by an
exception that it cannot mistake for one of its own, and whatever was replaced is put back.

Time, random numbers and events are the same in each run: see program_clock.py, program_events.py.
"""

import contextlib
import io
import sys
import threading
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any, TextIO

from framelens.base import guard
from framelens.base.errors import InputError, Message, NoOpenGLError
from framelens.gl.foreign import Make, beside, patched
from framelens.gl.notes import files_beside
from framelens.gl.seam import unrecorded
from framelens.program.program_events import Events, read_events
from framelens.program.program_failure import count, late, raised
from framelens.program.program_input import Input
from framelens.program.program_prints import Prints
from framelens.program.program_process import Unwind, as_main, forget
from framelens.program.program_run import Host, Live, Observer, Run
from framelens.program.program_source import ProgramError, Source, read_source
from framelens.program.watchdog import Watchdog
from framelens.spec import spec

SHADERS = ("Shader", "Program")  # parts of the names of all functions for shaders
LIMIT = 15.0  # seconds that a program may take to its frame, chosen


_prepared = False
_runs: list[Run] = []  # the program that runs with functions that were prepared


@contextmanager
def prepared(make: Make) -> Iterator[None]:
    """Replace OpenGL's functions for all programs that run inside the block.

    That takes longer than most programs, and a process that was forked need not do it again.
    ``make`` is that of their observers. The platform of PyOpenGL must have been chosen.
    """
    global _prepared
    with _functions(make, lambda: _runs[-1] if _runs else None):
        _prepared = True
        try:
            yield
        finally:
            _prepared = False


def _functions(make: Make, running: Callable[[], Run | None]) -> AbstractContextManager[None]:
    """Replace OpenGL's functions; some of their calls also concern the program that runs."""

    def tell(method: Callable[[Run], None]) -> Callable[[], None]:
        def told() -> None:
            if (state := running()) is not None:
                method(state)

        return told

    def made(name: str, function: Callable[..., object]) -> Callable[..., object]:
        new = make(name, function)
        if any(word in name for word in SHADERS):
            return beside(new, before=tell(Run.uses_shaders))
        if spec.draws(name) or name in ("glCallList", "glCallLists"):
            return beside(new, before=tell(Run.draws))
        if name in ("glFlush", "glFinish"):
            return beside(new, after=tell(Run.flushed))
        return new

    return patched(made)


def run(
    path: str | Path,
    frame: int | None = 0,
    events: Events = None,
    arguments: Sequence[str] = (),
    backend: str = "auto",
    limit: float | None = None,
    *,
    stdin: TextIO | None = None,
    observer: Observer,
    live: Live | None = None,
    host: Host | None = None,
) -> Any:
    """Run a program to the end of a frame and return what the observer made of it.

    ``frame``: from 0; None runs the program until it ends. ``events``: a file or a list (see
    program_events.py). ``backend``: as for our own drawing; GLUT needs a screen. ``limit``: seconds
    that the program itself may take, LIMIT by default (see watchdog.py). ``stdin``: what it reads
    as standard input; there is none by default. ``live``: who uses the window meanwhile.
    ``host``: a window to run it in, where it has none of its own; then its clock is not held.
    Raises NoOpenGLError, and ProgramError, whose ``details`` hold the program's own traceback.
    """
    if frame is not None and (type(frame) is not int or frame < 0):
        raise InputError("frame {frame}: expected a whole number from 0", frame=frame)
    limit = LIMIT if limit is None else limit
    source = read_source(Path(path))
    state = Run(source, frame, read_events(events), backend, observer, live, host)
    if host is not None and source.toolkit in ("glut", "pygame", "qt"):
        raise ProgramError("{path}: a lecture shows GLFW programs only", path=source.path)
    toolkit = _toolkit(source)
    with ExitStack() as stack:
        stack.callback(guard.stand_by)
        waiting = lambda: state.watchdog.paused() if state.watchdog else ExitStack()  # noqa: E731
        given = Input(stdin, waiting) if stdin is not None else io.StringIO()
        stack.enter_context(files_beside(source.path))
        stack.enter_context(as_main(source, [str(path), *arguments], given))
        prints = Prints()
        stack.callback(prints.end)
        stack.enter_context(contextlib.redirect_stdout(prints))
        stack.enter_context(toolkit(state))
        if source.toolkit != "pygame" and "pygame" in source.modules:
            stack.enter_context(_pygame_beside(state))
        if _prepared:
            stack.callback(_runs.remove, state)
            _runs.append(state)
        else:
            stack.enter_context(_functions(observer.make, lambda: state))
        module = ModuleType("__main__")
        module.__dict__.update(__file__=str(path), __builtins__=__builtins__)
        stack.callback(forget, module, set(threading.enumerate()))
        sys.modules["__main__"] = module
        stack.enter_context(state.clock.holding())
        stack.callback(unrecorded.clear)
        unrecorded.append(state.called_early)
        state.watchdog = Watchdog(limit, lambda: state.stop(late(state, frame, limit)))
        with state.watchdog:
            _execute(state, module)
        guard.go_on(1.0)  # its objects may do anything when they are deleted

    if state.failure is not None:
        raise state.failure
    if not state.over and state.window is None:
        reason = f" ({state.reason})" if state.reason else ""
        raise ProgramError(
            "{path}: ended without opening a window for OpenGL{reason}", path=path, reason=reason
        )
    if not state.over and frame is not None and not state.frames:
        raise ProgramError(
            "{path}: ended after no frames; frame {frame} was asked: its loop is never entered, or "
            "it has none",
            path=path,
            frame=frame,
        )
    if not state.over and frame is not None:
        raise ProgramError(
            "{path}: ended after {count}; frame {frame} was asked",
            path=path,
            count=count(state.frames),
            frame=frame,
        )
    return state.result


def _toolkit(source: Source) -> Callable[[Run], AbstractContextManager[None]]:
    """Return what prepares the toolkit of a program, for the time that it runs."""
    if source.toolkit == "glfw":
        from framelens.program.program_glfw import glfw_program

        return glfw_program
    if source.toolkit == "pygame":
        from framelens.program.program_pygame import pygame_program

        return pygame_program
    if source.toolkit == "glut":
        from framelens.program.program_glut import glut_program

        return glut_program
    if source.toolkit == "qt":
        from framelens.program.program_qt import qt_program

        return qt_program
    raise ProgramError(
        "{path}: {without_toolkit}", path=source.path, without_toolkit=_without_toolkit(source)
    )


def _pygame_beside(state: Run) -> AbstractContextManager[None]:
    from framelens.program.program_pygame import pygame_beside

    return pygame_beside(state)


def _without_toolkit(source: Source) -> Message:
    """Return why a program cannot be run to a frame that uses none of our toolkits."""
    if not source.other:
        return Message(
            "imports neither glfw, pygame nor OpenGL.GLUT, so it opens no window that we know"
        )
    why = Message(
        "opens its window with {other}; programs can be looked into that open it with GLFW, GLUT "
        "or pygame, or draw in a QOpenGLWidget",
        other=source.other,
    )
    if not source.past:
        return why
    return Message(
        "{why}; it may also call OpenGL by {past}, past PyOpenGL", why=why, past=source.past
    )


def _execute(state: Run, module: ModuleType) -> None:
    """Run the program's code; what ends it goes into ``state``."""
    try:
        try:
            exec(state.source.code, module.__dict__)
        except SystemExit as end:
            if isinstance(end.code, str):
                print(end.code, file=sys.stderr)
    except Unwind:
        pass
    except (KeyboardInterrupt, NoOpenGLError) as error:
        state.stop(error)
    except BaseException as error:
        first = sys.exc_info()[2]  # the exception itself may say anything
        if not state.failed(error):
            state.stop(raised(state.source.path, error))
        # The frames hold the program's objects, which must go while its context is there.
        traceback.clear_frames(first)
