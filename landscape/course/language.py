"""The language of the course's texts: that of the environment, as gettext finds it."""

import os
from collections.abc import Iterator
from contextlib import contextmanager

from framelens.base.errors import InputError, NoOpenGLError
from framelens.base.texts import Phrases, choose, reworded, translator

# Of the course's messages, and of those on files and options that its commands pass on.
MESSAGES: Phrases = (
    "the following arguments are required",
    "unrecognized arguments",
    "invalid choice",
    "choose from",
    "not allowed with argument",
    "expected one argument",
    "expected one of",
    "expected at most one argument",
    "expected a number from 0.1 to 600",
    "expected a whole number from",
    "expected WxH such as 800x600",
    "expected a file, found a folder",
    "expected the name of a step, or a number from 1 to",
    "--list lists them",
    "see `",
    "cannot be written",
    "is not text in UTF-8; expected a lecture",
    "has no steps; expected blocks that begin with",
    "expected something after the colon",
    "is a view; expected it at a lesson or program",
    "there is no such file",
    "expected names such as SPACE, LEFT or 1",
    "expected a lesson, a view, a fix, or the path of a .py program",
    "a lesson, a view, a fix, or the path of a .py program",
    "there is no screen to open a window on",
    "use --out FILE.png, or xvfb-run",
    "use --list, or xvfb-run",
    "and XDG_RUNTIME_DIR, where Wayland has its socket, is not set",
    "is not set",
    "is there already; expected --out with the name of a new file",
    "is there already, changed; expected a folder without it",
    "is a folder, expected a program written for an exercise",
    "is not text, expected a Python program",
    "expected a line such as",
    "which says of which exercise it is; `landscape exercise start` writes it",
    "names two exercises",
    "expected a name ending in .png",
    "expected a lesson; `landscape lesson` lists them",
    "expected an exercise, one of",
    "expected one",
    "cannot be read",
    "No such file or directory",
    "Permission denied",
)


@contextmanager
def told_in(language: str) -> Iterator[None]:
    """Let an InputError or a NoOpenGLError of the block say what is wrong in a language."""
    try:
        yield
    except (InputError, NoOpenGLError) as error:
        error.args = (reworded(str(error), MESSAGES, translator(language, "course")),)
        raise


def translated(text: str) -> str:
    """Return an English text of the course or of a lesson in the user's language."""
    return translator(choose(os.environ), "course", "lessons")(text)
