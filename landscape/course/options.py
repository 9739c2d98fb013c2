"""The options of the course's commands."""

import argparse
from collections.abc import Callable
from pathlib import Path

LESSON = "a lesson; without one, the lessons are listed"
COPY = "copy it, with what it reads, into a folder to be changed there; default: the current one"


def add_lesson(
    command: Callable[[str, str, str], argparse.ArgumentParser],
    language: Callable[[argparse.ArgumentParser, str], None],
    backend: Callable[[argparse.ArgumentParser], None],
) -> None:
    """Add `landscape lesson`; ``language`` adds --lang, ``backend`` --backend."""
    lesson = command(
        "lesson", "list the lessons of the course; run one, draw it or copy it", "matrix_stack"
    )
    lesson.add_argument("name", nargs="?", default="", metavar="NAME", help=LESSON)
    what = lesson.add_mutually_exclusive_group()
    what.add_argument(
        "--out", type=Path, metavar="FILE.png", help="draw it to a file, without a screen"
    )
    what.add_argument("--copy", type=Path, nargs="?", const=Path(), metavar="DIR", help=COPY)
    what.add_argument("--inspect", action="store_true", help="run it under the inspector (F12)")
    what.add_argument("--json", action="store_true", help="print what is known of it as JSON")
    language(lesson, "language of the texts")
    backend(lesson)
