"""Markdown in blocks, translated block by block: the pages of the lessons, and the documents.

A block is a heading, a paragraph, an item of a list, a row of a table, or code: between fences, or
indented. Each but code, and rows of nothing but figures, is one text of a catalogue, written on one
line.
"""

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

from landscape.course.ladder import Lesson

CODE, ROW = "```", "| "
BY_CELL = ("course", "documents", "glut", "sheet")
"""The documents whose rows are translated cell by cell: long tables, mostly of paths and commands.

A path or a command may then change, and no translation is lost with it.
"""
_MARK = re.compile(r"(#+ |[-*] |\d+\. )?(.*)", re.DOTALL)
_NO_WORDS = re.compile(r"\|( *(:?-+:?|-?[\d.]+|fig\d+[a-i]?|) *\|)+")  # a row of a table
_BAR = re.compile(r"(?<!\\)\|")  # between two cells of a row
_CODE = re.compile(r"`[^`]*`")
_LETTER = re.compile(r"[^\W\d_]")
_WORD = re.compile(r"(?:!?\[[^\]]*\]\([^)]*\)|`[^`]*`|[^ ])+")  # with its links and code whole
_BEGINS_BLOCK = re.compile(r"[-+*#=]+$|\d+[.)]$|[>|]")


@dataclass(frozen=True)
class Block:
    """A block: ``mark`` is what Markdown begins it with, as "## ", "- " or "1. ", CODE or ROW."""

    mark: str
    text: str

    @property
    def is_code(self) -> bool:
        """Whether the block is code, or a row of a table without words: not to be translated."""
        return self.mark == CODE

    @property
    def is_row(self) -> bool:
        """Whether the block is a row of a table, or the line under its head."""
        return self.text.startswith("|")

    @property
    def is_item(self) -> bool:
        """Whether the block is an item of a list."""
        return bool(self.mark) and self.mark[0] in "-*0123456789"

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
                    yield Block(CODE if _NO_WORDS.fullmatch(line) else ROW, line)
            else:
                # An item of a list may follow the one before it without an empty line.
                for item in re.split(r"\n(?=[-*] |\d+\. )", lines):
                    match = _MARK.fullmatch(" ".join(item.split()))
                    if match:
                        yield Block(match[1] or "", match[2])


def cells(row: str) -> list[str]:
    """Return the cells of a row of a table."""
    return [cell.strip() for cell in _BAR.split(row)[1:-1]]


def has_words(cell: str) -> bool:
    """Return whether a cell has letters outside its code: it is then to be translated."""
    return bool(_LETTER.search(_CODE.sub("", cell)))


def by_cell(translate: Callable[[str], str]) -> Callable[[str], str]:
    """Return a translation of blocks that takes rows cell by cell, and leaves cells of code."""

    def translated(text: str) -> str:
        if not text.startswith("|"):
            return translate(text)
        row = (translate(cell) if has_words(cell) else cell for cell in cells(text))
        return f"| {' | '.join(row)} |"

    return translated


def page(lesson: Lesson, translate: Callable[[str], str] = str) -> list[Block]:
    """Return the blocks of a lesson's page, in the language of ``translate``."""
    return blocks(lesson.page.read_text(encoding="utf-8"), translate)


def as_markdown(page: Iterable[Block], width: int = 0) -> str:
    """Return blocks as Markdown again, with prose wrapped at ``width`` columns, if it is not 0."""
    text = ""
    before = None
    for block in page:
        if before:
            rows = before.is_row and block.is_row
            items = before.is_item and block.is_item
            text += "\n" if rows or items else "\n\n"
        if block.is_code or block.is_row:
            text += block.text
        elif block.is_heading:
            text += block.mark + block.text
        else:
            text += wrapped(block.mark, block.text, width)
        before = block
    return text + "\n"


def wrapped(mark: str, text: str, width: int) -> str:
    """Return prose in lines of at most ``width`` columns, or in one if it is 0.

    Links and code are not broken, and no line but the first begins as a block would.
    """
    if not width:
        return mark + text
    first, *words = _WORD.findall(text)
    lines = [mark + first]
    for word in words:
        if len(lines[-1]) + 1 + len(word) <= width or _BEGINS_BLOCK.match(word):
            lines[-1] += f" {word}"
        else:
            lines.append(" " * len(mark) + word)
    return "\n".join(lines)
