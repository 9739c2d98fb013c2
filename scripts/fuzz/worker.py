"""Runs inputs one after another, as a user would, and says what is wrong with each outcome.

One JSON line on standard input per input; the answer is its exit status and a list of complaints,
empty if there are none. See __main__.py for what counts as wrong.
"""

import contextlib
import io
import json
import os
import stat
import sys
import tempfile
import threading
import traceback
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from case import IMPORTS, Case
from PIL import Image

import landscape
from landscape.cli import main

HALF_WRITTEN = (".landscape", ".tmp", ".part")  # names of files that are not finished


def run(case: Case, folder: Path) -> tuple[int, list[str]]:
    """Run an input in its folder; return its exit status and the complaints."""
    os.chdir(folder)
    before = contents(folder)
    drains = [Drain(folder / name) for name in case.pipes]
    text = tempfile.TemporaryFile()  # noqa: SIM115
    status = 0
    value = None
    wrong = []
    saved = os.dup(2)
    os.dup2(text.fileno(), 2)
    out = io.StringIO()
    try:
        # As Python's own: a name that the encoding lacks is no error.
        shown = os.fdopen(os.dup(2), "w", encoding="utf-8", errors="backslashreplace")
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(shown):
            if case.expression:
                status, value, wrong = evaluate(case.expression)
            else:
                status, wrong = command(case.args)
            sys.stderr.close()
    finally:
        os.dup2(saved, 2)
        os.close(saved)
        for drain in drains:
            drain.close()

    text.seek(0)
    errors = text.read().decode(errors="replace")
    wrong += complaints(status, errors, case)
    if isinstance(value, (Image.Image, np.ndarray)):
        wrong += wrong_picture(np.asarray(value), case.size)
    wrong += wrong_files(case, folder, before, status)
    return status, wrong


def command(args: list[str]) -> tuple[int, list[str]]:
    """Run a command line; return its status and complaints."""
    try:
        return main(args), []
    except SystemExit as end:  # --help
        return int(end.code or 0), []
    except BaseException:
        return 0, ["traceback: " + last_lines()]


def evaluate(expression: str) -> tuple[int, Any, list[str]]:
    """Evaluate an expression of Python; return a status as of a command, the value, complaints."""
    names: dict[str, Any] = {}
    exec(IMPORTS, names)
    try:
        return 0, eval(expression, names), []
    except (landscape.InputError, landscape.NoOpenGLError) as error:
        status = 2 if isinstance(error, landscape.InputError) else 3
        long = "\n" in str(error) or len(str(error)) > 600
        return status, None, [f"not one line: {error}"] if long else []
    except MemoryError:
        return 2, None, []
    except BaseException:
        return 0, None, ["untyped error: " + last_lines()]


def last_lines() -> str:
    """Return the error that is being handled, and where it was raised."""
    lines = traceback.format_exc().strip().splitlines()
    return " | ".join(line.strip() for line in [lines[-1], *lines[-7:-1]])


def complaints(status: int, errors: str, case: Case) -> list[str]:
    """Judge the exit status and what was printed on standard error."""
    wrong = [] if status in (0, 1, 2, 3) else [f"exit status {status}"]
    lines = errors.splitlines()
    if case.expression:
        # The logger's notices of settings that change nothing are meant to be seen.
        return wrong + [f"printed: {line}" for line in lines[:5] if not line.startswith("setting ")]
    if status in (2, 3) and len(lines) != 1:
        wrong.append(f"status {status} with {len(lines)} lines on standard error")
    wrong += [f"printed: {line}" for line in lines if not line.startswith("landscape: ")][:8]
    wrong += [f"printed: {line}" for line in lines if "Traceback" in line or "Warning" in line]
    return wrong


def wrong_picture(pixels: np.ndarray, size: tuple[int, int] | None) -> list[str]:
    """Return a complaint if a picture is not uint8 RGB of the size that was asked for."""
    good = pixels.dtype == np.uint8 and pixels.ndim == 3 and pixels.shape[2] == 3
    if size is not None:
        good = good and pixels.shape[:2] == (size[1], size[0])
    return [] if good else [f"a picture {pixels.shape} {pixels.dtype}, asked for {size}"]


def contents(folder: Path) -> dict[str, bytes]:
    """Return what each file of a folder holds, by its path; other things by their kind."""
    found = {}
    for path in sorted(folder.rglob("*")):
        kind = path.lstat().st_mode
        regular = stat.S_ISREG(kind)
        found[str(path.relative_to(folder))] = path.read_bytes() if regular else bytes([kind >> 12])
    return found


def wrong_files(case: Case, folder: Path, before: dict[str, bytes], status: int) -> list[str]:
    """Compare a folder with what it held before, and look into the new files."""
    wrong, after = [], contents(folder)
    for name, data in before.items():
        if name not in after:
            wrong.append(f"{name}: gone")
        elif after[name] != data and (status in (2, 3) or name not in case.outputs):
            wrong.append(f"{name}: changed, with status {status}")

    for name in after.keys() - before.keys():
        if any(part in name for part in HALF_WRITTEN):
            wrong.append(f"{name}: left behind")
        elif name.endswith(".png") and len(after[name]) > 1:
            try:
                with Image.open(folder / name) as image:
                    pixels = np.asarray(image)
            except OSError as error:
                wrong.append(f"{name}: half-written ({error})")
            else:
                wrong += wrong_picture(pixels, case.size if status == 0 else None)

    return wrong


class Drain:
    """Reads a pipe until it is closed, so that its writer does not wait for ever."""

    def __init__(self, path: Path) -> None:
        self._handle = os.open(path, os.O_RDWR)
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def _read(self) -> None:
        with contextlib.suppress(OSError):
            while os.read(self._handle, 1 << 16)[-3:] != b"end":
                pass

    def close(self) -> None:
        """Stop reading."""
        os.write(self._handle, b"end")
        self._thread.join(5)
        os.close(self._handle)


if __name__ == "__main__":
    if sys.platform != "win32":  # which writes no core files
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    for kind in (RuntimeWarning, UserWarning, FutureWarning):
        warnings.simplefilter("always", kind)
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    for line in sys.stdin:
        asked = json.loads(line)
        outcome = run(Case(**asked["case"]), Path(asked["folder"]))
        print(json.dumps(outcome), file=answers, flush=True)
