"""Why a student's picture is all of one colour, asked in the sandbox."""

import contextlib
import json
from typing import Any

from framelens.base.errors import InputError, NoOpenGLError
from framelens.program.program_frame import ProgramFrame
from framelens.report.why_report import find

LONGEST = 2000  # chosen: characters of a text


def of(path: str, frame: int, language: str) -> dict[str, Any] | None:
    """Return the first cause, as `landscape why --json` prints it; None if none is found."""
    with contextlib.suppress(InputError, NoOpenGLError):
        for cause in find(ProgramFrame(path, frame=frame), language=language).causes[:1]:
            # By way of JSON, as it is sent: a value may be of numpy.
            found: dict[str, object] = json.loads(json.dumps(cause.as_json(language), default=str))
            return found
    return None


def told(answer: object) -> dict[str, Any] | None:
    """Return a cause that a program's process has sent; None unless it has the form of one."""
    if not isinstance(answer, dict):
        return None
    texts = [answer.get(key) for key in ("cause", "source", "text", "mend")]
    fits = all(isinstance(text, str) and len(text) < LONGEST for text in texts)
    return answer if fits else None
