"""The domains: which texts each catalogue translates.

A domain is a name and a function that yields its texts. The name is the catalogue's path below
landscape/locale/LANGUAGE, without .po.
"""

import ast
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from babel.messages import extract
from catalogue import Message

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


DOMAINS: dict[str, Callable[[], Iterable[Message]]] = {
    "window": lambda: in_code("landscape/window/*.py"),
}
