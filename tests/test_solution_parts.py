"""Solutions of which only the parts are written that differ from the start."""

import ast
from pathlib import Path

import pytest
from folded import each
from solved import solved

from framelens.base.errors import InputError
from landscape.course.parts import _read, assembled, is_parts
from landscape.course.shelf import NAMES, exercise, source
from landscape.course.solutions import is_in_parts, runnable, ways

START = '''"""A task

What it says.
"""
# exercise: task
# lessons: window

import sys

import glfw

SIZE = 4
# Where it stands.
PLACE = (1, 2)


@once
def helper():
    pass
    # Your code goes here.


def draw():
    helper()


def main():
    draw()


if __name__ == "__main__":
    main()
'''
TAGS = "# exercise: task\n# the rest: start.py\n"


def whole(parts: str, tags: str = "") -> str:
    return assembled(f'"""What is new."""\n{TAGS}{tags}\n{parts}', START, Path("solution.py"))


WITHOUT_LESSONS = START.replace("# lessons: window\n", "")
# What the parts are, and how the whole differs from the start: (old, new).
CASES = {
    "nothing": ("", ("", "")),
    "a function": (
        "\ndef draw():\n    return 1\n",
        ("def draw():\n    helper()\n", "def draw():\n    return 1\n"),
    ),
    "a comment inside, at the end, and a decorator": (
        "\n@twice\ndef helper():\n    pass\n    # Done.\n",
        ("@once\ndef helper():\n    pass\n    # Your code goes here.\n",)
        + ("@twice\ndef helper():\n    pass\n    # Done.\n",),
    ),
    "a table with its comment": (
        "# Elsewhere.\nPLACE = (3, 4)\n",
        ("# Where it stands.\nPLACE = (1, 2)\n", "# Elsewhere.\nPLACE = (3, 4)\n"),
    ),
    "a new function below the one that it follows": (
        "\ndef draw():\n    other()\n\n\ndef other():\n    pass\n",
        ("def draw():\n    helper()\n",)
        + ("def draw():\n    other()\n\n\ndef other():\n    pass\n",),
    ),
    "a new function above the first part": (
        "\ndef other():\n    pass\n\n\ndef main():\n    other()\n",
        ("def main():\n    draw()\n",)
        + ("def other():\n    pass\n\n\ndef main():\n    other()\n",),
    ),
    "a new table with the others, and imports in their order": (
        "import math\n\nimport numpy as np\n\nTURN = math.pi\n\n\ndef main():\n    np\n",
        ("import sys\n", "import math\nimport sys\n"),
        ("import glfw\n", "import glfw\nimport numpy as np\n"),
        ("PLACE = (1, 2)\n", "PLACE = (1, 2)\n\nTURN = math.pi\n"),
        ("def main():\n    draw()\n", "def main():\n    np\n"),
    ),
    "a table that a new function makes stays below it": (
        "\ndef made():\n    pass\n\n\nMADE = made()\n\n\ndef main():\n    MADE\n",
        ("def main():\n    draw()\n",)
        + ("def made():\n    pass\n\n\nMADE = made()\n\n\ndef main():\n    MADE\n",),
    ),
    "a statement without a name": (
        "SIZE = 5\nSIZE += 1\n",
        ("SIZE = 4\n", "SIZE = 5\nSIZE += 1\n"),
    ),
}


@each("name", CASES)
def test_parts_are_put_into_the_start(name: str) -> None:
    parts, *changes = CASES[name]
    expected = WITHOUT_LESSONS
    for old, new in changes:
        expected = expected.replace(old, new)
    assert whole(parts) == whole(parts.replace("\n", "\r\n")) == expected


def test_what_the_solution_has_not_is_left_out() -> None:
    code = whole("\ndef draw():\n    pass\n", "# without: helper, import glfw\n")
    assert "helper" not in code and "glfw" not in code and "PLACE" in code


@pytest.mark.parametrize(
    ("parts", "tags", "expected"),
    [
        ("x = (", "", "solution.py, line 5: is not Python"),
        ("", "# without: helpr\n", "solution.py: # without: 'helpr': expected a function"),
        ("other = 1\n", "", "solution.py: expected a function or a name of start.py"),
    ],
)
def test_parts_that_fit_nowhere_end_in_one_line(parts: str, tags: str, expected: str) -> None:
    with pytest.raises(InputError) as told:
        whole(parts, tags)
    assert str(told.value).startswith(expected)


@pytest.mark.seldom(3)
def test_the_solutions_of_the_course_keep_only_what_differs() -> None:
    for name in NAMES:
        folder = exercise(name).folder
        start = [each.lines for each in _read(source(folder / "start.py"))[1]]
        for file in ways(folder):
            code = source(file)
            compile(solved(name, file.name), str(file), "exec")
            assert ast.get_docstring(ast.parse(code)), f"{file}: says what it shows"
            if is_parts(code):
                again = [each.name for each in _read(code)[1] if each.lines in start]
                assert not again, f"{file}: {again} stands in start.py, too"


def test_only_solutions_beside_a_start_are_put_together(tmp_path: Path) -> None:
    folder = exercise("winding").folder
    assert is_in_parts(folder / "solution.py", folder)
    assert not is_in_parts(folder / "start.py", folder)
    students = tmp_path / "solution.py"
    students.write_text(source(folder / "solution.py"), encoding="utf-8")
    assert not is_in_parts(students, folder)
    with runnable(students, folder) as file:
        assert file == students
    with runnable(folder / "solution.py", folder) as file:
        assert file.read_text(encoding="utf-8") == solved("winding")
    assert not file.exists()
