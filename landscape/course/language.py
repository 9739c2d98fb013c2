"""The language of the course's texts: that of the environment, as gettext finds it."""

import os
from collections.abc import Iterator
from contextlib import contextmanager

from landscape.errors import InputError
from landscape.languages import Phrases, choose, reworded, translator

# Of the course's messages, and of those on files that its commands pass on.
MESSAGES: Phrases = (
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
    """Let an InputError of the block say what is wrong in a language."""
    try:
        yield
    except InputError as error:
        raise InputError(reworded(str(error), MESSAGES, translator(language, "course"))) from None


def translated(text: str) -> str:
    """Return an English text of the course or of a lesson in the user's language."""
    return translator(choose(os.environ), "course", "lessons")(text)
