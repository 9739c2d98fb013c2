"""README.md in the other languages: README.LANGUAGE.md, written from its catalogue, docs/README."""

from collections.abc import Iterator
from pathlib import Path

from landscape.course.pages import as_markdown, blocks
from landscape.languages import translator

README = Path(__file__).resolve().parents[2] / "README.md"
WIDTH = 100  # chosen: columns of its prose, as in README.md


def write(language: str) -> None:
    """Write it, if it is not what it should be."""
    if any(stale(language)):
        _path(language).write_text(translated(language), encoding="utf-8")


def stale(language: str) -> Iterator[str]:
    """Yield a line if it is not what README.md and the catalogue say."""
    path = _path(language)
    if not path.exists() or path.read_text(encoding="utf-8") != translated(language):
        yield f"{path}: stale: scripts/catalogues update writes it"


def translated(language: str) -> str:
    """Return README.md in a language."""
    _ = translator(language, "docs/README")
    return as_markdown(blocks(README.read_text(encoding="utf-8"), _), WIDTH)


def _path(language: str) -> Path:
    return README.with_name(f"README.{language}.md")
