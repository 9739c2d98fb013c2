"""The documents of docs/ as pages, translated block by block."""

import re
from collections.abc import Iterator
from pathlib import Path

from framelens.base.texts import translator
from landscape.course.pages import BY_CELL, as_markdown, blocks, by_cell

ROOT = Path(__file__).resolve().parents[2]
TEACHING = (
    "course",
    "lecture",
    "exercises",
    "notebooks",
    "glut",
    "sheet",
)  # for who gives the course
TOOLS = ("frame", "gate", "programs", "black", "why", "films")  # how the frame is laid open
BUILT = (
    *("reading", "documents", "errata", "performance"),
    *("voxels", "sound", "flyover", "environments", "assets"),
)
ALL = (*TEACHING, *TOOLS, *BUILT)


def pictures() -> Iterator[Path]:
    """Yield the pictures that the documents show."""
    for path in sorted((ROOT / "docs").iterdir()):
        if path.suffix in (".png", ".jpg", ".webp"):
            yield path


def pages(language: str) -> dict[str, str]:
    """Return the documents by their pages' names, and the lists of them."""
    _ = translator(language, "site")
    found = {}
    for name in ALL:
        translate = translator(language, f"docs/{name}")
        translate = by_cell(translate) if name in BY_CELL else translate
        text = (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")
        page = as_markdown(blocks(text, translate))
        found[f"documents/{name}"] = _without_outside(_with_pictures(page))

    lists = {
        "teaching": (
            _("Teaching with it"),
            TEACHING,
            _("A lecture whose pictures run, and exercises that are graded by a program."),
        ),
        "tools": (
            _("The tools"),
            TOOLS,
            _(
                "They look into a frame of a view, of a lesson, or of "
                "any program that draws with PyOpenGL."
            ),
        ),
        "built": (
            _("How it is built"),
            BUILT,
            _("How fast the island is and why, and how its images and meshes are made from code."),
        ),
    }
    for name, (heading, documents, text) in lists.items():
        tree = "\n".join(documents)
        found[f"documents/{name}"] = (
            f"# {heading}\n\n{text}\n\n```{{toctree}}\n:maxdepth: 2\n\n{tree}\n```\n"
        )

    return found


def _with_pictures(text: str) -> str:
    """Return Markdown in which pictures of the gallery are those that the site has of them."""
    return re.sub(r"\]\(\.\./screenshots/(?:\w+/)*(\w+)\.\w+\)", r"](../pictures/\1.webp)", text)


def _without_outside(text: str) -> str:
    """Return Markdown in which links to files that are no pages are plain code."""

    def link(match: re.Match[str]) -> str:
        label, target = match[1], match[2].partition("#")[0]
        known = target.removesuffix(".md") in ALL or re.match(r"\w+\.(png|jpg)$", target)
        return match[0] if known or target.startswith("http") or not target else f"`{label}`"

    return re.sub(r"(?<!!)\[([^\]]+)\]\(([^)]+)\)", link, text)
