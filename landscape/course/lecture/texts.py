"""A lecture's texts about its steps, in the user's language: on screen and for the speaker."""

import os
import re
import shutil
import textwrap
from collections.abc import Sequence
from pathlib import Path

from framelens.base.texts import LANGUAGES, Texts, choose, translator
from landscape.course import program_texts
from landscape.course.ladder import lesson
from landscape.course.language import described, translated
from landscape.course.lecture.plan import LESSON, PICTURE, VIEW, Lecture, Step, new_lines
from landscape.course.pages import page
from landscape.gallery.view_captions import VIEW_PANELS
from landscape.island.fixes import FIXES
from landscape.scene.scene import find_view

WIDEST = 96  # chosen: columns of the notes

TEXTS: Texts = {
    "keys": "PageDown, PageUp: next step, previous one. Home, End: first, last. F1: list. "
    "F2: code. F3: strip. F5: this step again. F12: inspector. Escape: close.",
    "list": "Up, Down: choose. Enter: go there. Type a number or letters to jump. Escape: close",
    "ended": "The program has ended. PageDown: next step. F5: this step again.",
    "pressed": "Pressed already: {keys}",
    "next": "Next: {title}",
    "last": "This is the last step.",
}


def word(key: str, **values: object) -> str:
    """Return one of the lecture's own texts."""
    return translator(choose(os.environ), "course")(TEXTS[key], key).format(**values)


def heading(lecture: Lecture) -> str:
    """Return a lecture's title."""
    return translated(lecture.title) if lecture.shipped else lecture.title


def title(step: Step) -> str:
    """Return a step's title."""
    if step.title:
        return _own(step, step.title)
    if step.kind == LESSON:
        return translated(lesson(step.name).title)
    if step.kind == PICTURE:
        return Path(step.name).stem
    if step.kind != VIEW:
        return step.name if step.runs else ""
    shows = find_view(step.name)[1].shows
    title = translator(choose(os.environ), "gallery", "fixes")(shows, step.name)
    return title[:1].upper() + title[1:]


def caption(step: Step) -> str:
    """Return what stands beside the title: the lecture's words, the lesson's or the gallery's."""
    if step.caption or step.kind not in (LESSON, VIEW):
        return _own(step, step.caption)
    if step.kind == LESSON:
        return translated(lesson(step.name).about[0])
    # A step shows a fix on. Its `look` compares that with the picture before, which is not shown.
    fixes = {fix.name: fix.how for fix in FIXES}
    text = VIEW_PANELS[step.name][1] if step.name in VIEW_PANELS else fixes.get(step.name, "")
    return translator(choose(os.environ), "gallery")(text)


def captions(step: Step) -> list[str]:
    """Return the captions that a step may have, the best first.

    Of a text that was not written for a screen, a part may be left out: the last sentences.
    """
    whole = caption(step)
    if step.caption or step.kind != LESSON:
        return [whole]
    sentences = re.split(r"(?<=[.?!]) +", whole)
    return [" ".join(sentences[:count]) for count in range(len(sentences), 0, -1)]


def paragraphs(step: Step) -> list[str]:
    """Return the lines of a step of text."""
    return [_own(step, line) for line in step.text]


def _own(step: Step, text: str) -> str:
    """Return a text that stands in the lecture itself."""
    return translated(text) if step.shipped else text


def marked(step: Step) -> frozenset[int]:
    """Return the numbers of the lines that matter."""
    if step.code is None and step.kind == LESSON:
        return new_lines(step.name)
    return step.code or frozenset()


def program(step: Step) -> tuple[Sequence[str], frozenset[int]]:
    """Return the lines of a step's program, and the numbers of those that matter.

    A lesson's are those of its copy in the user's language.
    """
    lines, matter = step.source(), marked(step)
    language = choose(os.environ)
    if step.kind != LESSON or language == LANGUAGES[0]:
        return lines, matter
    code = described(lesson(step.name), language)
    return code.splitlines(), program_texts.moved(matter, "\n".join(lines), code)


def notes(step: Step) -> list[str]:
    """Return the paragraphs for the speaker: the lecture's, or what the page asks the class."""
    if step.notes or step.kind != LESSON:
        return [_own(step, note) for note in step.notes]
    blocks = page(lesson(step.name), translated)
    headings = [index for index, block in enumerate(blocks) if block.is_heading]
    return [block.text for block in blocks[headings[-1] + 1 :]]


def for_speaker(lecture: Lecture, index: int) -> str:
    """Return what the terminal says at a step: number, title, notes, and what comes next."""
    step = lecture.steps[index]
    lines = [f"[{index + 1}/{len(lecture.steps)}] {title(step)}  ({step.name})"]
    lines += [wrapped(note, "    ") for note in notes(step)]
    if step.kind == LESSON:
        lines.append(wrapped(translated(lesson(step.name).about[-1]), "    "))
    if step.keys:
        lines.append(f"    {word('pressed', keys=' '.join(step.keys))}")
    if index + 1 < len(lecture.steps):
        lines.append(f"    {word('next', title=title(lecture.steps[index + 1]))}")
    else:
        lines.append(f"    {word('last')}")
    return "\n".join(lines) + "\n"


def wrapped(text: str, indent: str) -> str:
    """Return a paragraph in lines that suit the terminal."""
    width = min(shutil.get_terminal_size().columns, WIDEST)
    return textwrap.fill(text, max(width, 20), initial_indent=indent, subsequent_indent=indent)


def listed(lecture: Lecture) -> Sequence[tuple[str, str, str]]:
    """Return the number, the title and the name of each step."""
    width = len(str(len(lecture.steps)))
    return [
        (f"{number:{width}}", title(step), step.name)
        for number, step in enumerate(lecture.steps, 1)
    ]
