"""A solution of which only the parts are written that differ from the start of its exercise.

    \"\"\"The depth test, turned on once.\"\"\"
    # exercise: missing_enable
    # the rest: start.py
    # without: draw_box

    def main():
        ...

The tag `# the rest` makes a file one of parts. Each statement of its top level takes the place of
the one of start.py that gives the same name. A new one stands below the function that it follows,
or, if none with a place is above it, above the part that has one; tables and numbers then stand
with those of start.py, and imports always in their order. `# without` names what start.py gives and
the solution has not. Comments above a statement belong to it. The lessons that start.py recommends
are no part of a solution.
"""

import ast
import re
import sys
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from framelens.base.errors import InputError, short
from landscape.course.not_python import not_python

REST = re.compile(r"^# the rest: start\.py\s*$", re.MULTILINE)
WITHOUT = re.compile(r"^# without:[ \t]*(.*)$", re.MULTILINE)
LESSONS = re.compile(r"^# lessons:.*\n", re.MULTILINE)
IMPORTS = ast.Import | ast.ImportFrom
DEFINITIONS = ast.FunctionDef | ast.ClassDef


@dataclass(frozen=True)
class Statement:
    """A statement of a program's top level: its tree, and its lines with the comments above it.

    ``blank`` lines stand above these. ``name`` is what it gives; "" if that is nothing.
    """

    tree: ast.stmt
    lines: Sequence[str]
    blank: int
    name: str

    @property
    def is_import(self) -> bool:
        """Whether it imports something."""
        return isinstance(self.tree, IMPORTS)

    @property
    def is_definition(self) -> bool:
        """Whether it defines a function or a class."""
        return isinstance(self.tree, DEFINITIONS)


def is_parts(code: str) -> bool:
    """Return whether a program's text is one of parts."""
    return REST.search(code) is not None


def _left_out(parts: str, names: Collection[str], file: Path) -> list[str]:
    """Return what of start.py, of its ``names``, the parts leave out; InputError for another."""
    gone = [name.strip() for found in WITHOUT.findall(parts) for name in found.split(",")]
    for name in gone:
        if name not in names:
            raise InputError(
                "{file}: # without: {name}: expected a function or a name of start.py",
                file=file,
                name=short(name),
            )
    return gone


def assembled(parts: str, start: str, file: Path) -> str:
    """Return the whole program; InputError names ``file`` and what in it has no place in start.py.

    ``start`` is Python.
    """
    head, statements = _read(start)
    try:
        _head, own = _read(parts)
    except (SyntaxError, ValueError) as error:
        raise not_python(file, error) from None
    gone = _left_out(parts, {each.name for each in statements}, file)
    whole = [each for each in statements if each.name not in gone]
    at = None  # where the last part stands
    waiting: list[Statement] = []  # new ones, until the part that follows them has its place
    for part in own:
        names = [each.name for each in whole]
        if part.name and part.name in names:
            at = names.index(part.name)
            whole[at] = replace(part, blank=whole[at].blank)
            at = _insert(waiting, whole, at)
            waiting = []
        elif part.is_import:
            place = _place_of_import(part, whole)
            whole.insert(place, part)
            at = at + 1 if at is not None and place <= at else at
        elif at is not None and whole[at].is_definition:
            at += 1
            whole.insert(at, part)
        else:
            waiting.append(part)
    if waiting and at is None:
        raise InputError(
            "{file}: expected a function or a name of start.py, as it is not a whole program",
            file=file,
        )
    if at is not None:
        whole[at + 1 : at + 1] = waiting
    return LESSONS.sub("", head) + "".join(_joined(whole))


def _insert(new: Sequence[Statement], whole: list[Statement], at: int) -> int:
    """Insert new statements above the one at an index; return its index then.

    Tables and numbers that come first stand with the others, behind the last of these.
    """
    first = next((n for n, each in enumerate(new) if each.is_definition), len(new))
    tables = [n for n, each in enumerate(whole[:at]) if isinstance(each.tree, ast.Assign)]
    behind = tables[-1] + 1 if tables else at
    whole[at:at] = new[first:]
    whole[behind:behind] = new[:first]
    return at + len(new)


def _end_of_head(trees: Sequence[ast.stmt], lines: Sequence[str]) -> int:
    """Return how many lines a program's docstring and tags take."""
    end = 0
    if trees and _is_docstring(trees[0]):
        end = trees[0].end_lineno or 0
    while end < len(lines) and lines[end].startswith("#"):
        end += 1
    return end


def _read(code: str) -> tuple[str, list[Statement]]:
    """Return the lines above a program's first statement, docstring and tags, and its statements.

    A comment above the first statement is one of the tags, unless an empty line parts them.
    """
    code = code.replace("\r\n", "\n").rstrip()
    lines = [f"{line}\n" for line in code.split("\n")]
    trees = ast.parse(code).body
    end = _end_of_head(trees, lines)
    head = "".join(lines[:end])
    if trees and _is_docstring(trees[0]):
        trees.pop(0)

    found: list[Statement] = []
    for tree in trees:
        decorators = [each.lineno for each in getattr(tree, "decorator_list", ())]
        first = min([tree.lineno, *decorators])
        above = lines[end : first - 1]
        # What is indented still belongs to the statement before it.
        inside = max((n + 1 for n, line in enumerate(above) if line[:1] in " \t"), default=0)
        if found and inside:
            found[-1] = replace(found[-1], lines=[*found[-1].lines, *above[:inside]])
            above = above[inside:]
        blank = next((n for n, line in enumerate(above) if line.strip()), len(above))
        end = tree.end_lineno or tree.lineno
        found.append(Statement(tree, [*above[blank:], *lines[first - 1 : end]], blank, _name(tree)))
    if found:
        found[-1] = replace(found[-1], lines=[*found[-1].lines, *lines[end:]])
    return head, found


def _is_docstring(tree: ast.stmt) -> bool:
    return isinstance(tree, ast.Expr) and isinstance(tree.value, ast.Constant)


def _name(tree: ast.stmt) -> str:
    """Return the name that a statement gives, as it is written; "" if it gives none."""
    match tree:
        case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
            return name
        case ast.Assign(targets=[target, *_]) | ast.AnnAssign(target=target):
            return ast.unparse(target)
        case ast.Import() | ast.ImportFrom():
            return ast.unparse(tree)
        case ast.If():
            return "__main__"
    return ""


def _place_of_import(part: Statement, whole: Sequence[Statement]) -> int:
    """Return where an import stands among the others: by section, form and name."""
    imports = [n for n, each in enumerate(whole) if each.is_import]
    key = _order(part.tree)
    return next((n for n in imports if _order(whole[n].tree) > key), imports[-1] + 1)


def _order(tree: ast.stmt) -> tuple[bool, bool, str]:
    match tree:
        case ast.ImportFrom(module=module):
            name, some_of_it = module or "", True
        case ast.Import(names=[alias, *_]):
            name, some_of_it = alias.name, False
        case _:
            raise TypeError(f"{tree}: expected an import")
    installed = name.split(".")[0] not in sys.stdlib_module_names
    return installed, some_of_it, name.lower()


def _joined(whole: Sequence[Statement]) -> Iterator[str]:
    """Yield the lines of statements, with blank lines as the project has them."""
    before: Statement | None = None
    for each in whole:
        yield "\n" * _blank(before, each)
        yield from each.lines
        before = each


def _blank(before: Statement | None, after: Statement) -> int:
    if before is None:
        return 1
    if before.is_import and after.is_import:
        return int(_order(before.tree)[0] != _order(after.tree)[0])
    if before.is_definition or after.is_definition:
        return 2
    if before.is_import:
        return max(after.blank, 1)
    return after.blank
