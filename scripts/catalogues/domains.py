"""The domains: which texts each catalogue translates.

A domain is a name and a function that yields its texts. The name is the catalogue's path below
landscape/locale/LANGUAGE, without .po.
"""

import ast
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path

from babel.messages import extract
from catalogue import Message

from landscape.course.ladder import SECTIONS, Lesson, lessons
from landscape.course.pages import page
from landscape.scene import SCENES, scene
from landscape.window.settings_list import rows

ROOT = Path(__file__).resolve().parents[2]

CALLS = {"_": {None: (1,), 2: (1, (2, "c"))}}
"""What is extracted from calls: the text, and the context where it is a second argument."""

TABLES = ("Texts", "Phrases")
"""The annotations of tables of texts, in landscape/languages.py."""


def in_code(*patterns: str) -> Iterator[Message]:
    """Yield the texts of the modules that match these patterns, below the root of the project."""
    for path in sorted({path for pattern in patterns for path in ROOT.glob(pattern)}):
        source = path.relative_to(ROOT).as_posix()
        with path.open("rb") as file:
            for _, text, _, context in extract.extract("python", file, CALLS):
                yield Message(text, source, context or "")
        for text, context in _tables(path.read_text(encoding="utf-8")):
            yield Message(text, source, context)


def _tables(code: str) -> Iterator[tuple[str, str]]:
    """Yield the texts of a module's tables, each with its key if it has one."""
    for node in ast.parse(code).body:
        if not isinstance(node, ast.AnnAssign) or not isinstance(node.annotation, ast.Name):
            continue
        if node.annotation.id not in TABLES or node.value is None:
            continue
        table = ast.literal_eval(node.value)
        keyed = table.items() if isinstance(table, dict) else (("", text) for text in table)
        yield from ((text, key) for key, text in keyed)


def in_lesson(lesson: Lesson) -> Iterator[Message]:
    """Yield the texts of a lesson: its docstring, what it writes on the screen, and its page."""
    source = lesson.file.relative_to(ROOT).as_posix()
    for text in (lesson.title, *lesson.about):
        yield Message(text, source)
    for node in ast.walk(ast.parse(lesson.file.read_text(encoding="utf-8"))):
        for text in _written(node):
            yield Message(text, source)
    for block in page(lesson):
        if not block.is_code and block.text not in SECTIONS:
            yield Message(block.text, lesson.page.relative_to(ROOT).as_posix())


def _written(node: ast.AST) -> Iterator[str]:
    """Yield the texts of a lesson's call of write(x, y, text) or _(text), or its table LABELS."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        at = {"write": 2, "_": 0}.get(node.func.id, len(node.args))
        yield from _strings(node.args[at : at + 1])
    elif isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "LABELS":
        yield from _strings([node.value])


def _strings(nodes: Iterable[ast.AST]) -> Iterator[str]:
    """Yield the strings that these expressions may be, or that tables hold as elements."""
    for node in nodes:
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value
        elif isinstance(node, ast.IfExp):
            yield from _strings((node.body, node.orelse))
        elif isinstance(node, ast.Tuple | ast.List):
            yield from _strings(node.elts)
        elif isinstance(node, ast.Dict):
            yield from _strings(node.values)
        elif isinstance(node, ast.Subscript):
            yield from _strings([node.value])


def settings() -> Iterator[Message]:
    """Yield what the list of settings says of each scene's: groups, what they do, units."""
    for kind in map(scene, SCENES):
        for row in rows(type(kind.settings)):
            value = getattr(kind.settings, row.group)
            owner = type(value if "." in row.key else kind.settings)
            source = owner.__module__.replace(".", "/") + ".py"
            yield Message(row.group, source)
            yield Message(row.item.metadata["does"], source, row.key)
            if row.item.metadata["unit"]:
                yield Message(row.item.metadata["unit"], source)


def fixes() -> Iterator[Message]:
    """Yield the titles of each scene's fixes."""
    for kind in map(scene, SCENES):
        for fix in kind.fixes:
            source = type(fix).__module__.rpartition(".")[0].replace(".", "/")
            yield Message(fix.title, source, fix.name)


DOMAINS: dict[str, Callable[[], Iterable[Message]]] = {
    "calls": lambda: in_code("landscape/capture/*.py"),
    "fixes": fixes,
    "settings": settings,
    "strip": lambda: in_code("landscape/tools/*.py"),
    "window": lambda: in_code("landscape/window/*.py"),
    "course": lambda: in_code("landscape/course/*.py"),
    **{f"lessons/{lesson.name}": partial(in_lesson, lesson) for lesson in lessons()},
}
