"""The pages that GitHub shows, in the other languages: README.LANGUAGE.md, galleries, notebooks.

The first is written from README.md and its catalogue, docs/README, a notebook from the English one
and notebook_cells; the others by the gallery.
"""

from collections.abc import Iterator
from pathlib import Path

import notebooks

from framelens.base.texts import translator
from landscape.course.pages import as_markdown, blocks
from landscape.gallery.flyover_page import NAME as FLYOVER
from landscape.gallery.flyover_page import page as flyover_page
from landscape.gallery.page import page
from landscape.gallery.scene_captions import VIEW_TEXTS
from landscape.gallery.scene_page import page as scene_page

ROOT = Path(__file__).resolve().parents[2]
WIDTH = 100  # chosen: columns of its prose, as in README.md


def write(language: str) -> None:
    """Write those that are not what they should be."""
    for path, text in translated(language).items():
        if not _is(path, text):
            path.write_text(text, encoding="utf-8")


def stale(language: str) -> Iterator[str]:
    """Yield a line for each that is not what its source and the catalogues say."""
    for path, text in translated(language).items():
        if not _is(path, text):
            yield f"{path}: stale: scripts/catalogues update writes it"


def translated(language: str) -> dict[Path, str]:
    """Return the pages in a language."""
    _ = translator(language, "docs/README")
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    name = f"README.{language}.md"
    kept = ROOT / "screenshots"
    return {
        ROOT / name: as_markdown(blocks(readme, _), WIDTH),
        kept / name: page(language),
        **{kept / scene / name: scene_page(scene, language) for scene in VIEW_TEXTS},
        kept / FLYOVER / name: flyover_page(language),
        **notebooks.translated(ROOT, language, translator(language, "notebook_cells")),
    }


def _is(path: Path, text: str) -> bool:
    return path.exists() and path.read_text(encoding="utf-8") == text
