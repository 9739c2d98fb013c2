"""A lecture: a text file that a teacher writes, and its steps. docs/lecture.md describes the file.

    title: Mirrors

    clip_plane
    The plane keeps what is above the water.
    code: glClipPlane, 40-48, "glDisable(GL_CLIP"
    keys: SPACE
    note: Ask what happens if it is called before the viewing transform.

Blocks are separated by empty lines. The first line of a block names what the step shows; that of a
step of text is the word "slide".
"""

import ast
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from framelens.base.errors import InputError, short
from framelens.base.input import read_bounded
from framelens.program.program_events import KEYS as KEY_NAMES
from landscape.course.ladder import NAMES, lesson
from landscape.scene.scene import find_view

COURSE = Path(__file__).resolve().parents[1] / "lectures" / "course.txt"
MOST_BYTES = 1 << 20  # chosen: of a lecture's file
# Kinds of steps.
LESSON = "lesson"
VIEW = "view"
PROGRAM = "program"
PICTURE = "picture"
TEXT = "slide"  # "text" is a lesson

PICTURES = (".png", ".jpg", ".jpeg", ".webp")
PAPERS = ("16:9", "a4")  # of a PDF: slides, or a handout with notes
KEYS = ("title", "code", "note", "keys", "frame")
LATEST = 100_000  # chosen: the highest number of a frame
KINDS = "a lesson, a view, a fix, the path of a .py program or of a picture, or slide"


@dataclass
class Step:
    """A step as the file has it: ``name`` of a lesson or a view, or what it calls a program.

    ``file`` is a lesson's, a program's or a picture's, ``code`` the numbers of the lines that
    matter of the first two, None where the lecture names none. ``caption``, ``title`` and ``notes``
    are empty where it does not say. ``text`` has the lines of a step of text. ``frame`` is the one
    whose picture stands for a program on paper, None where the lecture names none. The words of a
    lecture that is ``shipped`` with the program are translated, those of a user never.
    """

    name: str
    kind: str
    line: int
    file: Path | None = None
    title: str = ""
    caption: str = ""
    code: frozenset[int] | None = None
    notes: list[str] = field(default_factory=list)
    keys: tuple[str, ...] = ()
    text: list[str] = field(default_factory=list)
    frame: int | None = None
    shipped: bool = False

    @property
    def runs(self) -> bool:
        """Whether it shows a program, which has code."""
        return self.kind in (LESSON, PROGRAM)

    @property
    def called(self) -> str:
        """The name of its file, "" without one."""
        return self.file.name if self.file is not None else ""

    def source(self) -> list[str]:
        """Return the lines of its program; none without one."""
        if not self.runs or self.file is None:
            return []
        return self.file.read_text("utf-8", "replace").splitlines()


@dataclass(frozen=True)
class Lecture:
    """A lecture: its title, and its steps in their order; whether it comes with the program."""

    title: str
    steps: Sequence[Step]
    shipped: bool = False


def read(path: Path) -> Lecture:
    """Read a lecture; InputError, in one line with the file and its line, if something is wrong."""
    text = read_bounded(path, MOST_BYTES).decode("utf-8-sig", "surrogateescape")
    if re.search("[\ud800-\udfff\x00]", text):
        raise InputError("{path}: is not text in UTF-8; expected a lecture", path=path)
    title, steps = "", []
    shipped = path.resolve().parent == COURSE.parent
    for number, block in enumerate(blocks(text)):
        if number == 0 and key_of(block[0][1])[0] == "title":
            title = key_of(block[0][1])[1]
            block = block[1:]
        if block:
            step = _step(path, block)
            step.shipped = shipped
            steps.append(step)
    if not steps:
        raise InputError(
            "{path}: has no steps; expected blocks that begin with {kinds}", path=path, kinds=KINDS
        )
    return Lecture(title or path.stem, steps, shipped)


def course() -> Lecture:
    """Return the lecture that comes with the program, of the whole course."""
    return read(COURSE)


def texts(lecture: Lecture) -> Iterator[str]:
    """Yield the texts of a lecture that can be translated."""
    yield lecture.title
    for step in lecture.steps:
        yield from (text for text in (step.title, step.caption, *step.text, *step.notes) if text)


Lines = list[tuple[int, str]]
"""Lines with their numbers, from 1, continued ones as one."""


def blocks(text: str) -> Iterator[Lines]:
    """Yield the blocks; an indented line continues the one before it, # begins a comment."""
    block: Lines = []
    for number, line in enumerate((*text.splitlines(), ""), 1):
        if line.startswith("#"):
            continue
        if line[:1].isspace() and line.strip() and block:
            block[-1] = block[-1][0], f"{block[-1][1]} {line.strip()}"
        elif line.strip():
            block.append((number, line.strip()))
        elif block:
            yield block
            block = []


def key_of(line: str) -> tuple[str, str]:
    """Return the key that a line of a block begins with, and its value; without one "", line."""
    found = re.match(r"([A-Za-z]+):\s*(.*)", line)
    if found and (found[1].islower() or found[1].lower() in KEYS):
        return found[1].lower(), found[2]
    return "", line


def _check_key(where: str, key: str, value: str) -> None:
    """Raise InputError for a line's key that there is not, or that has no value."""
    if key not in KEYS:
        raise InputError(
            "{where}: {key}: expected one of {names}, or text",
            where=where,
            key=short(key),
            names=", ".join(KEYS),
        )
    if not value:
        raise InputError("{where}: {key}: expected something after the colon", where=where, key=key)


def _step(path: Path, block: Lines) -> Step:
    number, name = block[0]
    step = _named(path, number, name)
    captions = []
    for number, line in block[1:]:
        where = f"{path}, line {number}"
        key, value = key_of(line)
        if not key:
            captions.append(line)
            continue
        _check_key(where, key, value)
        if key == "title":
            step.title = value
        elif key == "note":
            step.notes.append(value)
        elif key == "keys" and step.kind not in (PICTURE, TEXT):
            step.keys += tuple(_pressed(where, value))
        elif not step.runs or step.file is None:
            raise InputError(
                "{where}: {key}: expected it at a lesson or program; {name} is none",
                where=where,
                key=key,
                name=short(name),
            )
        elif key == "frame":
            step.frame = _frame(where, value)
        else:
            step.code = (step.code or frozenset()) | _lines(where, step.file, value)

    if step.kind == TEXT:
        step.text = captions
    else:
        step.caption = " ".join(captions)
    return step


def _named(path: Path, line: int, name: str) -> Step:
    """Return the step that a block's first line names."""
    if name in NAMES:
        return Step(name, LESSON, line, lesson(name).file)

    if name == TEXT:
        return Step(name, TEXT, line)

    if name.endswith((".py", *PICTURES)):
        file = path.parent / name
        if not file.is_file():
            raise InputError(
                "{path}, line {line}: {name}: there is no such file",
                path=path,
                line=line,
                name=short(name),
            )
        return Step(name, PROGRAM if name.endswith(".py") else PICTURE, line, file)

    try:
        find_view(name)
    except InputError:
        raise InputError(
            "{path}, line {line}: {name}: expected {kinds}",
            path=path,
            line=line,
            name=short(name),
            kinds=KINDS,
        ) from None
    return Step(name, VIEW, line)


def _frame(where: str, value: str) -> int:
    if not (value.isascii() and value.isdigit()) or int(value[:9]) > LATEST:
        raise InputError(
            "{where}: frame: {value}: expected a whole number from 0 to {latest}",
            where=where,
            value=short(value),
            latest=LATEST,
        )
    return int(value)


def _pressed(where: str, value: str) -> Iterator[str]:
    for key in re.split(r"[\s,]+", value):
        if key.upper() not in KEY_NAMES:
            raise InputError(
                "{where}: keys: {key}: expected names such as SPACE, LEFT or 1",
                where=where,
                key=short(key),
            )
        yield key.upper()


def _lines(where: str, file: Path, value: str) -> frozenset[int]:
    """Return the lines that ``code:`` names: ranges, quoted fragments, names in the file."""
    source = file.read_text(encoding="utf-8", errors="replace")
    lines = source.splitlines()
    found: set[int] = set()
    for item in re.findall(r'"[^"]*"|[^,\s][^,]*', value):
        item = item.strip()
        span = re.fullmatch(r"(\d{1,6})(?:\s*-\s*(\d{1,6}))?", item)
        if span:
            first, last = int(span[1]), int(span[2] or span[1])
            if not 1 <= first <= last <= len(lines):
                raise InputError(
                    "{where}: code: {item}: expected lines from 1 to {count} of {name}",
                    where=where,
                    item=item,
                    count=len(lines),
                    name=file.name,
                )
            found.update(range(first, last + 1))
            continue
        fragment = item.strip('"')
        mine = _function(source, fragment) or {
            number
            for number, line in enumerate(lines, 1)
            if (fragment in line if item[0] == '"' else re.search(_word(fragment), line))
        }
        if not fragment or not mine:
            raise InputError(
                "{where}: code: {item}: is not in {name}",
                where=where,
                item=short(item),
                name=file.name,
            )
        found |= mine

    return frozenset(found)


def _word(name: str) -> str:
    return rf"(?<!\w){re.escape(name)}(?!\w)"


def _function(source: str, name: str) -> set[int]:
    """Return the lines of the function of this name."""
    try:
        tree = ast.parse(source)
    except (SyntaxError, ValueError):
        return set()
    return {
        number
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef) and node.name == name
        for number in range(node.lineno, (node.end_lineno or node.lineno) + 1)
    }


CALLS = re.compile(r"\b(?:gl[A-Z]\w*|GL_\w+|glfw\.\w+)")


def new_lines(name: str) -> frozenset[int]:
    """Return the lines of a lesson with names of OpenGL or GLFW that no lesson before it has."""
    before: set[str] = set()
    for each in NAMES[: NAMES.index(name)]:
        before.update(CALLS.findall(lesson(each).file.read_text(encoding="utf-8")))
    lines = lesson(name).file.read_text(encoding="utf-8").splitlines()
    texts = in_texts(lines)
    return frozenset(
        number
        for number, line in enumerate(lines, 1)
        if set(CALLS.findall(line)) - before and number not in texts
    )


def in_texts(lines: Sequence[str]) -> set[int]:
    """Return the numbers of the lines that are comments, or in a docstring."""
    found, inside = set(), False
    for number, line in enumerate(lines, 1):
        quotes = line.count('"""')
        if inside or quotes or line.lstrip().startswith("#"):
            found.add(number)
        inside ^= quotes % 2 == 1
    return found
