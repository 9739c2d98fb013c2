"""docs/documents.md as rows, and its commands as ones that a test can run."""

import hashlib
import re
import shlex
from dataclasses import dataclass
from pathlib import Path

from commands import TESTS
from stage import SMALL, SMALL_BEST

from landscape.course.pages import blocks, cells

ROOT = TESTS.parent
PAGE = ROOT / "docs" / "documents.md"
STATES = ("whole", "built otherwise", "not built")
SIZE = "96x72"  # of the pictures of a test
_SECTION = re.compile(r"(\d)\. ")
_CODE = re.compile(r"`([^`]+)`")
_PATH = re.compile(r"[\w./-]+(/|\.\w+)(:[\w.]+)?$")


@dataclass(frozen=True)
class Row:
    """An item of a document: ``document`` is the number of its section of the page."""

    document: int
    number: str
    section: str
    stated: str
    state: str
    where: str
    command: str

    @property
    def places(self) -> list[tuple[str, str]]:
        """The paths in the column Where, and the names after their colons, or ""."""
        found = [code for code in _CODE.findall(self.where) if _PATH.match(code)]
        return [(path, name) for path, _, name in (code.partition(":") for code in found)]

    @property
    def reason(self) -> str:
        """What the column Where says beside the paths."""
        return _CODE.sub("", self.where).strip(" ,;.")

    @property
    def words(self) -> list[str]:
        """The command without `landscape`, [] if there is none."""
        code = _CODE.fullmatch(self.command)
        return shlex.split(code[1])[1:] if code else []


def rows(text: str | None = None) -> list[Row]:
    """Return the rows of the page's tables, or of a text like it, in its order."""
    found, document = [], 0
    for block in blocks(text or PAGE.read_text(encoding="utf-8")):
        if block.is_heading:
            match = _SECTION.match(block.text)
            document = int(match[1]) if match else 0
        elif document and block.is_row and not block.is_code:
            row = cells(block.text)
            assert len(row) == 6, block.text
            found.append(Row(document, *row))
    return [row for row in found if row.number != "#"]


def distinct_commands() -> list[str]:
    """Return each command once, in an order that every change of the page shuffles."""
    page = PAGE.read_bytes()
    found = {shlex.join(row.words) for row in rows() if row.words}
    return sorted(found, key=lambda command: hashlib.sha256(page + command.encode()).digest())


def quick(words: list[str], island: bool, folder: Path) -> list[str]:
    """Return the words of a command that draws small, to a folder; [] if it needs a screen.

    ``island``: it draws the island, of which few objects are enough here.
    """
    name, *rest = words
    program = any(word.endswith(".py") for word in rest)  # it has the size of its window
    size = [] if "--size" in rest or program else ["--size", SIZE]
    few = SMALL if "2006" in rest else SMALL_BEST
    fewer = [f"--set={key}={value}" for key, value in few.items()] if island else []
    match name:
        case "render":
            return [name, *fewer, *rest, *size, "--samples", "0", *out(rest, folder)]
        case "trace" | "state" | "bench":
            return [name, *fewer, *rest, *size]
        case "pixel":
            return [name, *fewer, *nearby(rest), *size]
        case "strip":
            return [name, *fewer, *rest, *size, *out(rest, folder / "strip.png")]
        case "walk":
            return [name, *fewer, *rest, *size, "--backend", "osmesa", "--frames", "2"]
        case "lesson":
            what = {"--copy", "--json", "--out"} & {*rest}
            kept = [word for word in rest if word != "--inspect"]
            drawn = out(rest, folder / "lesson.png") if rest and not what else []
            return [name, *kept, *drawn]
        case "lecture" | "inspect":
            return words if "--list" in rest or "--out" in rest else []
        case "flyover":
            return flyover(rest, size, folder)
        case "film":
            return [name, *rest, *size, "--fps", "1", "--seconds", "1"]
        case "figures":
            return [name, *rest, *out(rest, folder)]
        case "assets":
            return words if rest[0] == "check" else []

    return words


def out(rest: list[str], path: Path) -> list[str]:
    """Return where a command writes to, if it does not say so itself."""
    return [] if "--out" in rest else ["--out", str(path)]


def nearby(rest: list[str]) -> list[str]:
    """Return the words with the pixel of a picture of 800 x 600 as one of a small picture."""
    small = int(SIZE.partition("x")[0])
    return [
        ",".join(str(int(side) * small // 800) for side in word.split(","))
        if re.fullmatch(r"\d+,\d+", word) and "--size" not in rest
        else word
        for word in rest
    ]


def flyover(rest: list[str], size: list[str], folder: Path) -> list[str]:
    """Return a flight as a single picture; a benchmark of one frame; other actions as they are."""
    if "--bench" in rest:
        near = ("--set", "flyover.far=100")  # without any technique all terrain is drawn
        return ["flyover", *rest, *size, *near, *(() if "--frames" in rest else ("--frames", "1"))]
    if rest[:1] == ["export"]:
        return ["flyover", *rest]
    return ["flyover", *rest, *size, *out(rest, folder / "flyover.png")]
