"""Lessons and exercises in French: their comments, docstrings and texts, and nothing else."""

import ast
import re

import pytest

from landscape.course.ladder import NAMES, lesson
from landscape.course.language import described
from landscape.course.program_texts import lines, texts, translated
from landscape.course.shelf import NAMES as EXERCISES
from landscape.course.shelf import exercise, start

PROGRAM = '''\
# topic: window
# Two lines,
# one text.
size = 3  # degrees


def draw():
    """Draw it."""
    # Your code goes here.
    write(16, 16, "it's on" if size else "é", at="no")
    # Before a tag.
    glEnd()


window = glfw.create_window(640, 480, "A title", None, None)
LABELS = {"no": ("a", "b")}
'''
LOUD = '''\
# topic: window
# TWO LINES, ONE TEXT.
size = 3  # DEGREES


def draw():
    """DRAW IT."""
    # Your code goes here.
    write(16, 16, "IT'S ON" if size else "É", at="no")
    # BEFORE A TAG.
    glEnd()


window = glfw.create_window(640, 480, "A TITLE", None, None)
LABELS = {"no": ("A", "B")}
'''


def test_the_texts_of_a_program_are_found_and_translated_and_nothing_else() -> None:
    assert sorted(texts(PROGRAM)) == sorted(
        [
            "Two lines, one text.",
            "degrees",
            "Draw it.",
            "Before a tag.",
            "it's on",
            "é",
            "A title",
            "a",
            "b",
        ]
    )
    assert translated(PROGRAM, str.upper) == LOUD
    assert translated(PROGRAM, str) == PROGRAM


def test_what_becomes_too_long_is_wrapped_or_moves_above_its_line() -> None:
    def longer(text: str) -> str:
        return " ".join([text] * 18) if text != "one" else '"one"\\'

    code = 'def f():\n    """A docstring."""\n    x = 1  # beside it\n    # below\n'
    code += '    _("twos", x)\n    _("one")\n'
    written = translated(code, longer)
    rows = written.splitlines()
    assert max(map(len, rows)) <= 100
    assert "    x = 1" in rows and rows[rows.index("    x = 1") - 1].endswith("beside it")
    body = ast.parse(written).body[0]
    assert isinstance(body, ast.FunctionDef)
    assert (ast.get_docstring(body) or "").split() == longer("A docstring.").split()
    assert f'    _(\n        "{longer("twos")}",\n        x,\n    )\n' in written
    assert ast.unparse(body.body[-1]) == "_('\"one\"\\\\')"


class _Blank(ast.NodeTransformer):
    """Leaves out what strings say."""

    def visit_Constant(self, node: ast.Constant) -> ast.Constant:
        return ast.Constant("") if isinstance(node.value, str) else node


def same_program(one: str, other: str) -> bool:
    first, second = (ast.dump(_Blank().visit(ast.parse(code))) for code in (one, other))
    return first == second


def untranslated(english: str, french: str) -> list[str]:
    """Return the sentences that are in both; formulas and names may be."""
    both = set(texts(english)) & set(texts(french))
    return [text for text in both if len(re.findall("[a-z]{2,}", text)) > 4]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.sweep(9, first=8)
def test_a_lesson_in_french_is_the_same_program(name: str) -> None:
    source = lesson(name).file.read_text(encoding="utf-8")
    french = described(lesson(name), "fr")
    assert same_program(french, source) and described(lesson(name), "en") == source
    # A table of texts is not broken.
    assert [row for row in french.splitlines() if len(row) > 100 and "LABELS" not in row] == []
    assert untranslated(source, french) == []
    rows, written = source.splitlines(), french.splitlines()
    for line, same in lines(source, french).items():
        if "gl" in rows[line - 1] and '"' not in rows[line - 1]:
            assert written[same - 1].split("#")[0].split() == rows[line - 1].split("#")[0].split()


@pytest.mark.parametrize("name", EXERCISES)
@pytest.mark.sweep(6, first=1)
def test_an_exercise_in_french_is_the_same_program(name: str) -> None:
    english, french = (start(exercise(name), language) for language in ("en", "fr"))
    assert same_program(french, english)
    assert untranslated(english, french) == []
