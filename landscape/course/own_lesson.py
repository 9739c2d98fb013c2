"""A lecturer's own lesson: a program that is run, drawn and inspected as those of the course.

What its file says of it is said as in a lesson of the course (ladder.py), and all of it may be left
out. Its French, if it has some, is in fr.po beside it.
"""

import ast
from pathlib import Path

from landscape.course.ladder import TAG, Lesson, described, paragraphs
from landscape.course.not_python import not_python
from landscape.course.shelf import source

LEFT_OUT = {"topic": "", "needs": "none", "picture": "frame 0", "keys": "none"}


def own_lesson(file: Path) -> Lesson:
    """Return a lesson by its file; InputError if it is no program, or a tag is wrong."""
    code = source(file)
    try:
        docstring = ast.get_docstring(ast.parse(code)) or file.stem
    except (SyntaxError, ValueError) as error:
        raise not_python(file, error) from None
    return described(file, code, paragraphs(docstring), LEFT_OUT | dict(TAG.findall(code)))
