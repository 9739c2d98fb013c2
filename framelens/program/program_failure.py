"""How a program has failed, as one line: what it raised, and where; or what it did not reach."""

import os
import traceback
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Any

from framelens.base import guard
from framelens.base.errors import Message
from framelens.base.packages import FRAMELENS, speaker
from framelens.program.program_run import Run
from framelens.program.program_source import ProgramError

OURS = f"{FRAMELENS.folder}{os.sep}"
# What OpenGL's errors say of a call, by PyOpenGL's words for them.
MEANINGS = {
    "invalid enumerant": "a name is not one that it accepts",
    "invalid value": "a number is not one that it accepts",
    "invalid operation": "it is not allowed at this moment",
    "stack overflow": "more is pushed than popped",
    "stack underflow": "less was pushed than is popped",
}
NO_INPUT = "it asks for input; it gets what the command does, as in `echo 5 | {speaker} trace ...`"
# On Windows, ctypes makes an exception of a crash in a function of C.
CAUGHT = "OSError: exception: "
SAYS = 1.0  # seconds, chosen: that an exception may take to say what it is
LONGEST = 2000  # characters, chosen: of what it says
MOST_SHOWN = 20_000  # characters, chosen: of its traceback


def raised(path: Path, error: BaseException) -> ProgramError:
    """Return the error to show for what a program raised, with its own part of the traceback.

    An exception is the program's own code, too: it may raise others when it is asked what it is, go
    on for ever, or say gigabytes. Then its name stands for it.
    """
    calls = [at for at in _traceback(error) if at.tb_frame.f_code.co_filename == str(path)]
    first = calls[0] if calls else None
    reason = _name(error)
    missing = details = ""
    guard.go_on(SAYS)  # within the program's memory
    try:
        missing = _missing(path, error)
        reason = _reason(error)
        details = _details(error, first)
    except BaseException:  # not only Exception: what it raises may be anything
        pass
    guard.stand_by()
    details = details or f"{''.join(traceback.format_tb(first))}{reason}\n"
    if missing:
        return ProgramError(
            "{path}: needs the Python package {name}, not installed",
            details,
            path=path,
            name=missing,
        )
    if issubclass(type(error), MemoryError):
        reason += guard.memory()

    # The last of the program's own lines, which calls what is not its own.
    line = f", line {calls[-1].tb_lineno}" if calls else ""
    return ProgramError(
        "{path}{line}: the program raised {reason}", details, path=path, line=line, reason=reason
    )


def _missing(path: Path, error: BaseException) -> str:
    """Return the name of the package that the program needs and does not find; "" for none."""
    if not isinstance(error, ModuleNotFoundError) or not error.name:
        return ""
    name = _start(error.name).split(".")[0]
    return "" if name in ("OpenGL", path.stem) else name


def _reason(error: BaseException) -> str:
    """Return on one line what an exception says."""
    text = _start(str(error)).strip().splitlines()
    if hasattr(error, "baseOperation"):  # PyOpenGL's text has a line for each of its parts
        return _of_opengl(error)  # the text has looked up what the error's number means
    reason = f"{_name(error)}: {text[0]}" if text else _name(error)
    if reason.startswith(CAUGHT):
        reason += f", as OpenGL does {guard.SHORT_ARRAY}"
    if isinstance(error, EOFError):
        reason += f" ({NO_INPUT.format(speaker=speaker())})"
    return reason


def _name(error: BaseException) -> str:
    """Return the name of an exception's class, whatever the class says of it."""
    return _start(type.__dict__["__name__"].__get__(type(error)))


def _start(text: str) -> str:
    """Return how a text begins, of a class of the program's or not."""
    return str.__getitem__(text, slice(LONGEST))


def _details(error: BaseException, first: TracebackType | None) -> str:
    """Return an exception's traceback from a call on, as Python shows it, or its two ends."""
    shown = BaseException.with_traceback(error, first)
    text = "".join(_without_ours(traceback.TracebackException.from_exception(shown)).format())
    if len(text) > MOST_SHOWN:
        text = f"{text[: MOST_SHOWN // 2]}\n...\n{text[-MOST_SHOWN // 2 :]}"
    return text


def _without_ours(
    shown: traceback.TracebackException,
) -> traceback.TracebackException:
    """Leave the functions out that stand in for a toolkit's: the program called the toolkit."""
    kept = [call for call in shown.stack if not call.filename.startswith(OURS)]
    shown.stack = traceback.StackSummary.from_list(kept)
    for other in (shown.__cause__, shown.__context__):
        if other is not None:
            _without_ours(other)
    return shown


def _traceback(error: BaseException) -> Iterator[TracebackType]:
    """Yield the calls that led to an exception, from the outermost."""
    at: TracebackType | None = BaseException.__dict__["__traceback__"].__get__(error)
    while at is not None:
        yield at
        at = at.tb_next


def _of_opengl(error: Any) -> str:
    said = bytes(error.description or b"").decode(errors="replace")
    meaning = f": {MEANINGS[said]}" if said in MEANINGS else ""
    function = getattr(error.baseOperation, "__name__", "")
    return f"{type(error).__name__}: {said} ({function}){meaning}"


def late(state: Run, wanted: int | None, limit: float) -> ProgramError:
    """Return the error of a program that did not reach the wanted frame within ``limit`` s."""
    if state.window is None:
        done = Message("opened no window for OpenGL within {limit:g} s", limit=limit)
    elif state.frames == 0:
        done = Message("completed no frame within {limit:g} s: it never shows one", limit=limit)
    else:
        done = Message(
            "completed {count} within {limit:g} s; frame {wanted} was not reached",
            count=count(state.frames),
            limit=limit,
            wanted=wanted,
        )
    return ProgramError(
        "{path}: {done}, or needs a longer --limit", path=state.source.path, done=done
    )


def count(frames: int) -> Message:
    """Return a number of frames in words."""
    if frames == 0:
        return Message("no frames")
    return Message("1 frame") if frames == 1 else Message("{count} frames", count=frames)
