"""The page of a lesson: Markdown in sections, translated block by block.

A block is a heading, a paragraph, an item of a list, or code between fences. Each but code is one
text of the lesson's catalogue, written on one line.
"""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from landscape.course.ladder import Lesson

_MARK = re.compile(r"(#+ |[-*] |\d+\. )?(.*)", re.DOTALL)


@dataclass(frozen=True)
class Block:
    """A block of a page: ``mark`` is what Markdown begins it with, as "## ", "- " or "1. "."""

    mark: str
    text: str

    @property
    def is_code(self) -> bool:
        """Whether the block is code between fences."""
        return self.mark == "```"

    @property
    def is_heading(self) -> bool:
        """Whether the block is a heading."""
        return self.mark.startswith("#")


def blocks(markdown: str) -> list[Block]:
    """Return the blocks of a page."""
    found = []
    for part in re.split(r"^(```.*?^```)$", markdown, flags=re.DOTALL | re.MULTILINE):
        if part.startswith("```"):
            found.append(Block("```", part))
            continue
        # An item of a list may follow the one before it without an empty line.
        for lines in re.split(r"\n\s*\n|\n(?=[-*] |\d+\. )", part.strip()):
            match = _MARK.fullmatch(" ".join(lines.split()))
            if match and match[2]:
                found.append(Block(match[1] or "", match[2]))
    return found


def page(lesson: Lesson, translate: Callable[[str], str] = str) -> list[Block]:
    """Return the blocks of a lesson's page, in the language of ``translate``."""
    return [
        block if block.is_code else replace(block, text=translate(block.text))
        for block in blocks(lesson.page.read_text(encoding="utf-8"))
    ]


def as_markdown(page: Iterable[Block]) -> str:
    """Return blocks as Markdown again."""
    return "\n\n".join(b.text if b.is_code else b.mark + b.text for b in page) + "\n"
