"""A lecture that comes with the program, copied in the user's language, to be changed.

In a lecture of one's own nothing is translated: it is shown as it stands in its file.
"""

import textwrap
from collections.abc import Iterator
from pathlib import Path

from framelens.base.texts import Translator
from landscape.course.lecture.plan import PICTURE, PROGRAM, TEXT, Lines, blocks, key_of, read

WORDS = ("title", "note")  # keys whose values are texts
WIDTH = 100  # columns, chosen


def copied(file: Path, translate: Translator | None) -> dict[str, bytes]:
    """Return the files of a lecture by their names: its own, and those that its steps name.

    ``translate`` gives its texts in another language; None leaves the file as it is. Its comments
    are in English, and only in that copy.
    """
    text = file.read_text(encoding="utf-8")
    if translate is not None:
        text = "\n\n".join("\n".join(_block(block, translate)) for block in blocks(text)) + "\n"
    steps = [step for step in read(file).steps if step.kind in (PICTURE, PROGRAM) and step.file]
    return {
        file.name: text.encode(),
        **{step.name: step.file.read_bytes() for step in steps if step.file is not None},
    }


def _block(block: Lines, translate: Translator) -> Iterator[str]:
    """Yield the lines of a block in another language; a caption is one, after the title."""
    lines = [line for _, line in block]
    if key_of(lines[0])[0]:  # the lecture's title
        yield from _keyed(lines.pop(0), translate)
    if not lines:
        return

    name, *others = lines
    yield name
    keyed = [line for line in others if key_of(line)[0]]
    plain = [line for line in others if not key_of(line)[0]]
    titles = [line for line in keyed if key_of(line)[0] == "title"]
    for line in titles:
        yield from _keyed(line, translate)
    for line in plain if name == TEXT else filter(None, [" ".join(plain)]):
        yield from _wrapped(translate(line))
    for line in keyed:
        if line not in titles:
            yield from _keyed(line, translate)


def _keyed(line: str, translate: Translator) -> list[str]:
    key, value = key_of(line)
    return _wrapped(f"{key}: {translate(value)}") if key in WORDS else [line]


def _wrapped(line: str) -> list[str]:
    return textwrap.wrap(
        line, WIDTH, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
    )
