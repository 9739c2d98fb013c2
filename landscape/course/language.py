"""The language of the course's texts, which the environment names, as gettext finds it.

And its programs in a language: lessons and the plain programs beside them.
"""

import os
from pathlib import Path

from framelens.base.texts import choose, translator
from landscape.course import program_texts
from landscape.course.ladder import Lesson
from landscape.course.pages import wrapped

WIDTH = 96  # chosen: columns of a docstring, at most


def translated(text: str) -> str:
    """Return an English text of the course or of a lesson in the user's language."""
    return translator(choose(os.environ), "course", "lessons")(text)


def described(chosen: Lesson, language: str) -> str:
    """Return a lesson's program with all of its texts in a language."""
    source = chosen.file.read_text(encoding="utf-8")
    if language == "en":
        return source
    own = translator(language, f"lessons/{chosen.name}")
    about = [wrapped("", own(text), WIDTH) for text in (chosen.title, *chosen.about)]
    _before, _docstring, program = source.split('"""', 2)
    return '"""' + "\n\n".join(about) + '\n"""' + program_texts.translated(program, own)


def program_described(file: Path, language: str) -> str:
    """Return a plain program with all of its texts in a language."""
    source = file.read_text(encoding="utf-8")
    if language == "en":
        return source
    own = translator(language, "programs")
    _before, docstring, program = source.split('"""', 2)
    return f'"""{wrapped("", own(docstring), WIDTH)}"""' + program_texts.translated(program, own)
