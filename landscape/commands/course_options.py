"""The options of the course's commands."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

from landscape.course.grader.budget import MOST_SECONDS, SECONDS


def _(text: str) -> str:
    """Mark a text for the catalogue; help.py translates it."""
    return text


LESSON = _("a lesson; without one, the lessons are listed")
LECTURE = _(
    "a text file, see docs/lecture.md, or first_course, see docs/course.md; "
    "default: the whole course"
)
COPY = _(
    "copy it, with what it reads and its plain programs, into a folder; default: the current one"
)


def add(
    command: Callable[..., argparse.ArgumentParser],
    group: Callable[[str, str, str], Any],
    language: Callable[..., None],
    backend: Callable[[argparse.ArgumentParser], None],
    size: Callable[[str], Any],
    count: Callable[[str], Any],
) -> None:
    """Add the commands of the course; each argument adds an option, or reads its value."""
    add_lesson(command, language, backend)
    add_exercise(command, group, language)
    add_lecture(command, language, size, count)


def add_lesson(
    command: Callable[[str, str, str], argparse.ArgumentParser],
    language: Callable[[argparse.ArgumentParser, str], None],
    backend: Callable[[argparse.ArgumentParser], None],
) -> None:
    """Add `landscape lesson`; ``language`` adds --lang, ``backend`` --backend."""
    lesson = command(
        "lesson", _("list the lessons of the course; run one, draw it or copy it"), "matrix_stack"
    )
    lesson.add_argument("name", nargs="?", default="", metavar="NAME", help=LESSON)
    what = lesson.add_mutually_exclusive_group()
    what.add_argument(
        "--out", type=Path, metavar="FILE.png", help=_("draw it to a file, without a screen")
    )
    what.add_argument("--copy", type=Path, nargs="?", const=Path(), metavar="DIR", help=COPY)
    what.add_argument("--inspect", action="store_true", help=_("run it under the inspector (F12)"))
    what.add_argument("--json", action="store_true", help=_("print what is known of it as JSON"))
    language(lesson, "language of the texts")
    backend(lesson)


def add_exercise(
    command: Callable[[str, str, str, Any], argparse.ArgumentParser],
    group: Callable[[str, str, str], Any],
    language: Callable[[argparse.ArgumentParser, str], None],
) -> None:
    """Add `landscape exercise` and its actions; ``group`` adds a command that has actions."""
    help_ = _("exercises for students: list them, start one, check what was written")
    actions = group("exercise", help_, "exercise start winding")
    listed = command("exercise list", _("list the exercises, the easiest first"), "--json", actions)
    listed.add_argument("--json", action="store_true", help=_("print JSON, with the tasks"))
    begun = command(
        "exercise start",
        _("write the program of an exercise, with its task and a hole to fill"),
        "winding --out mine.py",
        actions,
    )
    begun.add_argument("name", metavar="NAME", help=_("see `landscape exercise list`"))
    begun.add_argument(
        "--out",
        type=Path,
        metavar="FILE|DIR",
        help=_("a file that is not there yet; default: NAME.py"),
    )
    begun.add_argument("-q", "--quiet", action="store_true", help=_("print nothing"))
    checked = command(
        "exercise check",
        _(
            "run a program that was written for an exercise, and grade it: exit status 0 if it "
            "passes, 1 if not, 2 if it cannot be run"
        ),
        "winding.py --heat-map difference.png",
        actions,
    )
    checked.add_argument("file", type=Path, metavar="FILE", help=_("the program"))
    what = checked.add_mutually_exclusive_group()
    what.add_argument("--json", action="store_true", help=_("print JSON"))
    what.add_argument(
        "-q", "--quiet", action="store_true", help=_("print nothing: the exit status says it")
    )
    checked.add_argument(
        "--heat-map",
        type=Path,
        metavar="FILE.png",
        help=_("write your picture, where it differs, and the solution's, side by side"),
    )
    checked.add_argument(
        "--seconds",
        type=_seconds,
        default=SECONDS,
        metavar="N",
        help=_("how long the program may take; default: %(default)g"),
    )
    for sub in (listed, begun, checked):
        language(sub, "language of the texts")


def _seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = 0.0
    if not 0.1 <= seconds <= MOST_SECONDS:
        raise argparse.ArgumentTypeError(
            f"{text!r}: expected a number from 0.1 to {MOST_SECONDS:g}"
        )
    return seconds


def add_lecture(
    command: Callable[[str, str, str], argparse.ArgumentParser],
    language: Callable[[argparse.ArgumentParser, str], None],
    size: Callable[[str], Any],
    count: Callable[[str], Any],
) -> None:
    """Add `landscape lecture`; ``language`` adds --lang, ``size`` and ``count`` read values."""
    lecture = command(
        "lecture", _("show lessons and views one after another, full screen"), "a.txt"
    )
    lecture.add_argument("file", nargs="?", type=Path, metavar="FILE", help=LECTURE)
    lecture.add_argument(
        "--from", dest="begin", default="", metavar="NAME", help=_("begin at this step, or number")
    )
    lecture.add_argument("--list", action="store_true", help=_("only print the steps"))
    lecture.add_argument(
        "--size",
        type=size,
        metavar="WxH",
        help=_("in a window of this size, not on the whole screen"),
    )
    lecture.add_argument(
        "--screen",
        type=count,
        default=1,
        metavar="N",
        help=_("which screen, if there are several; default: 1, the primary one"),
    )
    language(lecture, "language of the texts")
