"""The pictures of the site, and the calls seen while they were drawn; each runs in a worker.

Each language has a folder of pictures, as the lessons write on theirs.
"""

import json
import shutil
from collections.abc import Iterable
from dataclasses import astuple, dataclass, field
from pathlib import Path

from PIL import Image, features

from framelens.base.errors import InputError
from framelens.base.texts import LANGUAGES, speaking
from framelens.gl.seam import Call
from framelens.program.program_events import presses
from framelens.program.program_frame import ProgramFrame
from framelens.report import strip as strips
from framelens.tape.tape import Tape
from landscape.commands.target import ViewFrame
from landscape.course.exercise import gradings
from landscape.course.grader.picture import pictures
from landscape.course.ladder import lesson
from landscape.course.shelf import exercise
from landscape.course.solutions import runnable
from landscape.scene.scene import find_view

QUALITY = 82  # chosen, of WebP: no visible difference in these pictures
# Chosen: a strip as AVIF is as close to what was drawn as WebP of QUALITY in half of the bytes, and
# with its colours at full size its letters are sharper.
SHEET = {"quality": 65, "speed": 7, "subsampling": "4:4:4"}
EVERY = 4  # chosen: frames of the program for one of its animation
# Chosen: the formats of an animation and their qualities, the best first. AVIF takes a tenth to a
# quarter of WebP, in which some lessons have 2.5 MB; an older Pillow may lack it. From speed 7 on
# libaom encodes for live pictures: in a tenth of the time, with up to four times the bytes.
LOOPS = {"avif": {"quality": 50, "speed": 6}, "webp": {"quality": 30, "method": 2}}
LIMIT = 300.0  # chosen, in seconds: a busy machine draws a loop slowly, and that is no fault
EXERCISE = "exercise"
SEEN = "seen.json"
STRIP_STEPS = 40  # chosen: draw calls that a strip shows one by one; with more, by function


@dataclass(frozen=True)
class Seen:
    """A function's call: the function's name, who made the call, and where in its code."""

    name: str
    # A lesson's name, that of an element as "island/castle", or of an exercise as "exercise/fog".
    user: str
    source: str  # as "castle.py:31"


@dataclass
class Drawn:
    """What was drawn: the folder of each language's pictures, and who calls what, once a place."""

    folder: Path
    seen: dict[Seen, None] = field(default_factory=dict)

    def add(self, calls: Iterable[Seen]) -> None:
        """Note calls."""
        self.seen.update(dict.fromkeys(calls))

    def keep(self) -> None:
        """Write the calls beside the pictures, for the next build that draws nothing."""
        (self.folder / SEEN).write_text(json.dumps([astuple(call) for call in self.seen]))

    @classmethod
    def kept(cls, folder: Path) -> "Drawn":
        """Return what an earlier build has drawn into a folder.

        Raise InputError where none has.
        """
        if not (folder / SEEN).is_file():
            raise InputError("{folder}: expected the pictures of an earlier build", folder=folder)
        drawn = cls(folder)
        drawn.add(Seen(*call) for call in json.loads((folder / SEEN).read_text()))
        return drawn

    def pictures(self, language: str) -> Path:
        """Return the folder of a language's pictures."""
        return self.folder / language

    def lesson_picture(self, name: str, language: str) -> str:
        """Return the file of a lesson's loop, or of its picture where it has none."""
        return self._found(f"{name}-loop", language) or f"{name}.webp"

    def strip(self, name: str, language: str) -> str:
        """Return the file of the strip of a lesson's frame."""
        return self._found(f"{name}-strip", language) or f"{name}-strip.webp"

    def _found(self, stem: str, language: str) -> str:
        """Return the file of this name in the first format that it has; "" without one."""
        files = (f"{stem}.{kind}" for kind in LOOPS)
        return next((file for file in files if (self.pictures(language) / file).exists()), "")


def draw_lesson(name: str, language: str, folder: Path) -> list[Seen]:
    """Draw a lesson's picture, loop and strip in a language; return its calls."""
    with speaking(language):
        return _draw_lesson(name, language, folder / language)


def _draw_lesson(name: str, language: str, folder: Path) -> list[Seen]:
    found = lesson(name)
    (picture,) = pictures(found.file, [found.frame], presses(found.pressed), limit=LIMIT)
    Image.fromarray(picture).save(folder / f"{name}.webp", quality=QUALITY, method=6)
    if found.loop:
        frames = range(0, found.loop, EVERY)
        first, *others = (Image.fromarray(p) for p in pictures(found.file, frames, limit=LIMIT))
        kind = next(each for each in LOOPS if features.check(each))
        first.save(
            folder / f"{name}-loop.{kind}",
            save_all=True,
            append_images=others,
            duration=EVERY * 1000 // 60,
            loop=0,
            **LOOPS[kind],
        )

    target = ProgramFrame(str(found.file), frame=found.frame, limit=LIMIT)
    calls = target.look(all_calls)
    draws = sum(call.name in ("glBegin", "glEnd") or "Draw" in call.name for call in calls)
    sheet = folder / f"{name}-strip.png"
    _draw_strip(target, language, sheet, draws // 2)
    _save_sheet(sheet)
    return [
        Seen(call.name, name, call.source) for call in calls if call.site.path == str(found.file)
    ]


def _save_sheet(sheet: Path) -> None:
    """Make a PNG an AVIF, or a WebP where that is smaller without loss or Pillow lacks AVIF."""
    picture = Image.open(sheet).convert("RGB")
    small, plain = sheet.with_suffix(".avif"), sheet.with_suffix(".webp")
    sheet.unlink()
    if not features.check("avif"):
        picture.save(plain, quality=QUALITY)
        return
    picture.save(small, **SHEET)
    picture.save(plain, lossless=True)
    larger = max(small, plain, key=lambda path: path.stat().st_size)
    larger.unlink()


def _draw_strip(target: ProgramFrame, language: str, sheet: Path, draws: int) -> None:
    """Draw a frame's strip as finely as a sheet has room for: by draws, functions or passes."""
    finest = ("draw",) if draws <= STRIP_STEPS else ()
    for by in (*finest, "element"):
        try:
            strips.make(target, strips.Request(by, language=language), sheet)
            return
        except InputError:
            continue  # too many pictures for one sheet
    strips.make(target, strips.Request("pass", language=language), sheet)


def draw_exercise(name: str, folder: Path) -> list[Seen]:
    """Draw the last frame that the grader looks at, of an exercise's start and of its solution.

    Return the functions that the solution calls, without the lines: they are not told.
    """
    shown, _hidden = gradings(exercise(name))
    place = exercise(name).folder
    with runnable(place / "solution.py", place) as solution:
        for kind, program in (("start", place / "start.py"), ("wanted", solution)):
            (picture,) = pictures(program, [max(shown.frames)], shown.events or None, limit=LIMIT)
            for language in LANGUAGES:
                path = folder / language / f"exercise-{name}-{kind}.webp"
                Image.fromarray(picture).save(path, quality=QUALITY, method=6)
        calls = ProgramFrame(str(solution), limit=LIMIT).look(all_calls)
    return [Seen(call.name, f"{EXERCISE}/{name}", "") for call in calls]


def read_scene(view: str, preset: str | None = None) -> list[Seen]:
    """Return the calls of a view's frame."""
    kind, _named = find_view(view)
    calls = ViewFrame(view, (320, 240), preset=preset).look(all_calls)
    return [Seen(call.name, f"{kind.name}/{call.element}", call.source) for call in calls]


def all_calls(tape: Tape) -> list[Call]:
    """Return the calls of a tape, and those of the lists that they execute."""
    found = list(tape.calls)
    for call in found:  # grows meanwhile
        found += call.listed
    return found


def shrink(source: Path, folder: Path) -> list[Seen]:
    """Write a committed picture as WebP, for each language; one that is WebP stays as it is."""
    first, *others = (folder / language / f"{source.stem}.webp" for language in LANGUAGES)
    if source.suffix == ".webp":
        shutil.copy(source, first)
    else:
        Image.open(source).convert("RGB").save(first, quality=QUALITY)
    for other in others:
        shutil.copy(first, other)
    return []
