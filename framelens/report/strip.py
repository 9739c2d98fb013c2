"""`landscape strip`: one frame growing, as a sheet, an animation or a page."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from framelens.base.errors import InputError
from framelens.base.output import check_writable, write_whole
from framelens.base.progress import Progress
from framelens.report import strip_animation, strip_html, strip_screen, strip_sheet
from framelens.report.strip_page import Cell, Page
from framelens.report.strip_pictures import Tones
from framelens.report.strip_words import counted, number, text
from framelens.tape.edits import as_code
from framelens.tape.names import element, pass_name
from framelens.tape.strip import (
    BUFFERS,
    GROUPINGS,
    Group,
    SharedValues,
    groups,
    shared_values,
    shots,
)
from framelens.tape.tape import Tape
from framelens.tape.target import Target

__all__ = [
    "BUFFERS",
    "FORMATS",
    "GROUPINGS",
    "Request",
    "checked_out",
    "fragment",
    "make",
    "on_screen",
]

WRITERS: dict[str, Callable[[Page, Iterable[Cell]], bytes | list[bytes]]] = {
    ".png": strip_sheet.as_png,
    ".gif": strip_animation.as_gif,
    ".html": strip_html.as_html,
}
FORMATS = tuple(WRITERS)
# Pictures that an output holds, chosen: a sheet that can be read, and what memory can hold.
MOST = {".png": 160, ".gif": 400, ".html": 2000}


@dataclass(frozen=True)
class Request:
    """What to make of a frame: ``by`` pass, element or draw, which buffers, in which language."""

    by: str = "element"
    buffers: tuple[str, ...] = ("color",)
    language: str = "en"
    quiet: bool = True


def checked_out(out: Path | None, target: str) -> Path:
    """Return the file to write, by default named after the target.

    InputError if its ending is none of FORMATS, or if it is clear that it cannot be written.
    """
    path = Path(f"{Path(target).stem}-strip.png") if out is None else out
    check_writable(path, "--out ")
    if path.suffix.lower() not in FORMATS:
        raise InputError(
            "--out {path}: expected a name that ends in .png, .gif or .html", path=path
        )
    return path


def make(target: Target, request: Request, out: Path) -> None:
    """Draw the target's frame, and write its strip to ``out``; InputError as in Target.look."""
    suffix = out.suffix.lower()
    data = target.look(lambda tape: _made(tape, target, request, suffix))
    write_whole(out, data)


def on_screen(tape: Tape, name: str, request: Request, size: tuple[int, int]) -> Image.Image:
    """Return the strip of a frame as a picture of ``size`` pixels.

    InputError if the frame draws nothing. It is drawn again, and its context is left as it is then.
    """
    parts = groups(tape, request.by)
    if not parts:
        raise InputError("{name}: its frame draws nothing", name=name)
    page, found = _page(tape, parts, name, request)
    return strip_screen.as_image(page, _cells(tape, parts, request, found, page.tones), size)


def fragment(tape: Tape, name: str, request: Request) -> str:
    """Return the strip of a frame as HTML for a cell of a notebook; InputError as of make."""
    parts = groups(tape, request.by)
    _check(parts, name, request, ".html")
    page, found = _page(tape, parts, name, request)
    return strip_html.as_fragment(page, _cells(tape, parts, request, found, page.tones))


def _made(tape: Tape, target: Target, request: Request, suffix: str) -> bytes | list[bytes]:
    parts = groups(tape, request.by)
    _check(parts, target.name, request, suffix)
    page, found = _page(tape, parts, target.name, request)
    with Progress(len(parts), request.quiet) as progress:

        def cells() -> Iterator[Cell]:
            for cell in _cells(tape, parts, request, found, page.tones):
                yield cell
                progress.step(cell.title)

        return WRITERS[suffix](page, cells())


def _page(
    tape: Tape, parts: Sequence[Group], name: str, request: Request
) -> tuple[Page, SharedValues]:
    found = shared_values(tape, parts, request.buffers)
    page = Page(
        text(request.language, "title", name=Path(name).name),
        _intro(tape, parts, request),
        request.buffers,
        request.language,
        len(parts),
        tape.size,
        Tones(found, request.language),
    )
    return page, found


def _picture(
    request: Request, tones: Tones, name: str, buffer: np.ndarray | None
) -> Image.Image | str:
    """Return the picture of a buffer, or why there is none."""
    if buffer is None:
        return text(request.language, "uncounted" if name == "overdraw" else "lacking")
    return tones.picture(name, buffer)


def _cells(
    tape: Tape, parts: Sequence[Group], request: Request, found: SharedValues, tones: Tones
) -> Iterator[Cell]:
    before: np.ndarray | None = None
    for index, shot in enumerate(shots(tape, parts, request.buffers, found)):
        title, lines = _title(shot.group, request), _lines(shot.group, request)
        color = shot.buffers.get("color")
        if not shot.group.aside:
            if before is not None and color is not None:
                lines.append(_changed(request.language, before, color))
            before = color

        if layers := tones.layers(shot):
            lines.append(layers)
        calls = _calls(shot.group, request)
        pictures = [_picture(request, tones, name, shot.buffers[name]) for name in request.buffers]
        label = str(index + 1)
        if request.by == "draw":
            label = shot.group.draws[0].first.place
        yield Cell(index + 1, label, title, lines, calls, pictures, shot.group)


def _changed(language: str, before: np.ndarray, after: np.ndarray) -> str:
    """Return how much of the picture a step changes, as text."""
    share = 100.0 * float((before != after).any(axis=2).mean())
    if not share:
        return text(language, "unchanged")
    digits = 0 if share >= 9.95 else 1
    percent = number(language, max(share, 0.1), digits)
    return text(language, "changed" if share >= 0.1 else "hardly", percent=percent)


def _check(parts: Sequence[Group], name: str, request: Request, suffix: str) -> None:
    """Raise InputError unless a file of this format can hold all pictures."""
    if not parts:
        raise InputError("{name}: its frame draws nothing", name=name)
    pictures = len(parts) * len(request.buffers)
    if pictures <= MOST[suffix]:
        return
    other = [f"--out FILE{name}" for name in FORMATS if pictures <= MOST[name]]
    if not other:
        other = ["--by element" if request.by == "draw" else "fewer --buffers"]
    raise InputError(
        "strip: {pictures} pictures are too many for one {suffix} (at most {most}): "
        "expected {names}",
        pictures=pictures,
        suffix=suffix,
        most=MOST[suffix],
        names=" or ".join(other),
    )


def _intro(tape: Tape, parts: Sequence[Group], request: Request) -> str:
    language = request.language
    width, height = tape.size
    return text(
        language,
        "intro",
        width=width,
        height=height,
        calls=counted(language, "calls", len(tape.frame)),
        draws=counted(language, "draws", sum(map(_drawn, parts))),
        steps=text(language, f"steps.{request.by}"),
    )


def _drawn(group: Group) -> int:
    """Return how many draws a group has, without those that only clear."""
    return sum(draw.first.call.name != "glClear" for draw in group.draws)


def _title(group: Group, request: Request) -> str:
    language = request.language
    if request.by == "draw":
        first = group.draws[0].first
        return ", ".join(element(language, name) for name in first.elements)
    if group.clears:
        return text(language, "clear")
    named = pass_name(language, group.pass_)
    if request.by == "pass" or group.aside:
        return named
    what = ", ".join(element(language, name) for name in group.elements)
    if group.pass_ == "main":
        return what
    return text(language, "in_pass", element=what, pass_=named)


def _lines(group: Group, request: Request) -> list[str]:
    """Return the lines that say what was drawn, beside the title."""
    language = request.language
    if request.by == "draw":
        draw = group.draws[0]
        what = as_code(draw.first.call)
        if vertices := sum(step.call.name.startswith("glVertex") for step in draw.steps):
            what += f", {counted(language, 'vertices', vertices)}"
    elif group.clears or not (request.by == "pass" or group.aside):
        what = ""
    else:
        what = ", ".join(element(language, name) for name in group.elements)
    lines = [what] if what else []
    if group.aside:
        lines.append(text(language, "aside", target=group.target))
    return lines


def _calls(group: Group, request: Request) -> str:
    """Return how many calls and draws a group has."""
    language = request.language
    steps = list(group.steps)
    counts = [counted(language, "calls", len({step.number for step in steps}))]
    if inside := sum("." in step.place for step in steps):
        counts.append(text(language, "listed", n=number(language, inside)))
    if request.by != "draw" and (drawn := _drawn(group)):
        counts.append(counted(language, "draws", drawn))
    return ", ".join(counts)
