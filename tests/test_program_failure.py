"""What is said of a program's exception, which is code of the program's, too."""

from pathlib import Path

import pytest

from framelens.program import program_failure
from framelens.program.program_source import ProgramError

# What the program does, and what is said of it.
EXCEPTIONS = {
    "is plain": ("raise ValueError('a\\nb')", "ValueError: a"),
    "is SystemExit when asked": (
        "class E(Exception):\n def __str__(self): raise SystemExit(3)\nraise E",
        "E",
    ),
    "is Ctrl-C when asked": (
        "class E(Exception):\n def __str__(self): raise KeyboardInterrupt\nraise E",
        "E",
    ),
    "says what is no text of Python's": (
        "class S(str):\n def strip(self): 1 / 0\n __getitem__ = splitlines = __format__ = strip\n"
        "class E(Exception):\n def __str__(self): return S('x')\nraise E",
        "E: x",
    ),
    "has no traceback": (
        "class E(Exception):\n __traceback__ = with_traceback = property(lambda self: 1 / 0)\n"
        "raise E('x')",
        "E: x",
    ),
    "has nothing": (
        "class E(Exception):\n def __getattribute__(self, name): raise SystemExit(4)\nraise E",
        "E",
    ),
    "lacks a module without a name": (
        "class E(ModuleNotFoundError):\n name = property(lambda self: 1 / 0)\nraise E",
        "E",
    ),
    "lacks a module of an odd name": (
        "class E(ModuleNotFoundError):\n name = 5\nraise E",
        "E",
    ),
    "seems to be OpenGL's": (
        "class E(Exception):\n baseOperation, description = 5, 'text'\nraise E",
        "E",
    ),
    "is an odd error of syntax": ("e = SyntaxError('x')\ne.lineno = e.text = 5\nraise e", None),
    "has a class whose name is none": (
        "class M(type):\n __name__ = property(lambda kind: 1 / 0)\n"
        "class E(Exception, metaclass=M): pass\nraise E('x')",
        "E: x",
    ),
    "has a long chain of causes": (
        "e = ValueError('x')\nfor _ in range(20000):\n n = ValueError('y')\n n.__cause__ = e\n"
        " e = n\nraise e",
        "ValueError: y",
    ),
    "lacks memory": ("raise MemoryError", "MemoryError"),
}


def said(code: str) -> ProgramError:
    path = Path("program.py")
    try:
        exec(compile(code, str(path), "exec"), {"__name__": "__main__"})
    except BaseException as error:
        return program_failure.raised(path, error)
    raise AssertionError("it raises nothing")


@pytest.mark.parametrize("name", EXCEPTIONS)
@pytest.mark.sweep(3)
def test_whatever_an_exception_does_it_is_named_with_its_line(name: str) -> None:
    code, reason = EXCEPTIONS[name]
    error = said(code)
    line = code.count("\n") + 1
    start = f"program.py, line {line}: the program raised "
    assert str(error) == start + reason if reason else str(error).startswith(start)
    assert str(error.values["reason"]).split(":")[0] in error.details


@pytest.mark.parametrize(
    "text", ["'x' * (1 << 22)", "'x\\n' * (1 << 20)", "'x' * (1 << 22) + '\\n'"]
)
def test_of_what_an_exception_says_only_so_much_is_kept(text: str) -> None:
    error = said(f"raise ValueError({text})")
    assert len(str(error)) < program_failure.LONGEST + 100
    assert len(error.details) < program_failure.MOST_SHOWN + 100
    assert error.details.startswith("Traceback")
