"""The notebooks of docs/notebooks: their texts, and NAME.LANGUAGE.ipynb in the other languages."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from framelens.base.texts import LANGUAGES, Translator
from landscape.course.pages import as_markdown, blocks
from landscape.course.shelf import MARKER, exercise, start

FOLDER = "docs/notebooks"  # below the root of the project
NAMES = ("island", "lessons", "exercises")


def texts(root: Path) -> Iterator[tuple[str, str]]:
    """Yield the texts of all notebooks, each with its file's name: blocks of cells of Markdown."""
    for name in NAMES:
        path = f"{FOLDER}/{name}.ipynb"
        for cell in _read(root / path)["cells"]:
            if cell["cell_type"] == "markdown":
                for block in blocks("".join(cell["source"])):
                    if not block.is_code:
                        yield block.text, path


def translated(root: Path, language: str, translate: Translator) -> dict[Path, str]:
    """Return the notebooks in a language by their files.

    A cell that is the program of an exercise, as students begin with it, is that in the language.
    """
    found = {}
    for name in NAMES:
        book = _read(root / FOLDER / f"{name}.ipynb")
        for cell in book["cells"]:
            if cell["cell_type"] == "markdown":
                text = as_markdown(blocks("".join(cell["source"]), translate)).rstrip("\n")
                cell["source"] = text.splitlines(keepends=True)
                continue
            code = "".join(cell["source"])
            for task in MARKER.findall(code):
                begun = {each: start(exercise(task), each).rstrip("\n") for each in LANGUAGES}
                code = code.replace(begun[LANGUAGES[0]], begun[language])
                cell["source"] = code.splitlines(keepends=True)
        written = json.dumps(book, indent=1, ensure_ascii=False) + "\n"
        found[root / FOLDER / f"{name}.{language}.ipynb"] = written
    return found


def _read(path: Path) -> dict[str, Any]:
    book: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return book
