"""Markdown in blocks, translated block by block: the pages of the lessons, and the documents.

A block is a heading, a paragraph, an item of a list, a row of a table, or code: between fences, or
indented. Each but code is one text of a catalogue, written on one line.
"""

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

from landscape.course.ladder import Lesson

CODE, ROW = "```", "| "
_MARK = re.compile(r"(#+ |[-*] |\d+\. )?(.*)", re.DOTALL)


@dataclass(frozen=True)
class Block:
    """A block: ``mark`` is what Markdown begins it with, as "## ", "- " or "1. ", CODE or ROW."""

    mark: str
    text: str

    @property
    def is_code(self) -> bool:
        """Whether the block is code, or the line under a table's head: not to be translated."""
        return self.mark == CODE

    @property
    def is_heading(self) -> bool:
        """Whether the block is a heading."""
        return self.mark.startswith("#")


def blocks(markdown: str, translate: Callable[[str], str] = str) -> list[Block]:
    """Return the blocks of a text, in the language of ``translate``."""
    return [
        block if block.is_code else replace(block, text=translate(block.text))
        for block in _blocks(markdown)
    ]


def _blocks(markdown: str) -> Iterator[Block]:
    for part in re.split(r"^(```.*?^```)$", markdown, flags=re.DOTALL | re.MULTILINE):
        if part.startswith("```"):
            yield Block(CODE, part)
            continue
        for lines in re.split(r"\n\s*\n", part.strip("\n")):
            if not lines.strip():
                continue
            if all(line.startswith("    ") for line in lines.splitlines()):
                yield Block(CODE, lines)
            elif lines.startswith("|"):
                for line in lines.splitlines():
                    yield Block(CODE if re.fullmatch(r"[|:\- ]+", line) else ROW, line)
            else:
                # An item of a list may follow the one before it without an empty line.
                for item in re.split(r"\n(?=[-*] |\d+\. )", lines):
                    match = _MARK.fullmatch(" ".join(item.split()))
                    if match:
                        yield Block(match[1] or "", match[2])


def page(lesson: Lesson, translate: Callable[[str], str] = str) -> list[Block]:
    """Return the blocks of a lesson's page, in the language of ``translate``."""
    return blocks(lesson.page.read_text(encoding="utf-8"), translate)


def as_markdown(page: Iterable[Block]) -> str:
    """Return blocks as Markdown again."""
    text = ""
    before = ""
    for block in page:
        row = block.text.startswith("|")
        between = "\n" if row and before.startswith("|") else "\n\n"
        text += (between if text else "") + (block.text if block.is_code or row
                                             else block.mark + block.text)  # fmt: skip
        before = block.text
    return text + "\n"
