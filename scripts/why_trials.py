"""Two trials of `landscape why`, each with a seed:

    python scripts/why_trials.py control [--count 200] [--seed 1]    draws that are seen
    python scripts/why_trials.py sow [--seed 1]                      mistakes sown into lessons

``control`` takes lessons, mended programs of ``tests/student_programs`` and views, chooses draws
that are seen at random, and asks why at a pixel of each: nothing may be blamed. ``sow`` puts each
of its mistakes into a lesson whose picture it changes, and asks at a pixel that differs: the first
cause must be one of those named beside the mistake. Both print a line for each failure and the
counts, and end with status 1 if more than one in ten fails (control: more than one in a hundred).
"""

import argparse
import json
import random
import re
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from framelens.base.errors import InputError, NoOpenGLError
from framelens.program.program_frame import ProgramFrame
from framelens.tape.tape import Tape
from framelens.why.diagnosis import Diagnosis, diagnose
from framelens.why.trial import Item, Trial, changed
from landscape.commands.lesson import copy
from landscape.commands.target import ViewFrame
from landscape.course.ladder import lessons

ROOT = Path(__file__).resolve().parents[1]
VIEWS = ("fig35e", "fig35a", "fig25d", "hall_one_floor")
EACH = 2  # draws of a program or view that are asked about; chosen
SECONDS = 30.0  # for a search


@dataclass(frozen=True)
class Mistake:
    """Text that is replaced, once, and the causes that may be named for it."""

    name: str
    pattern: str
    replacement: str
    causes: tuple[str, ...]


OUTSIDE = ("behind", "beyond-near", "beyond-far", "beside", "no-projection")
MISTAKES = (
    Mistake("no swap", r"glfw\.swap_buffers\(window\)", "pass", ("no-swap",)),
    Mistake("no depth test", r"glEnable\(GL_DEPTH_TEST\)", "pass", ("no-depth-test",)),
    Mistake(
        "depth func",
        r"glEnable\(GL_DEPTH_TEST\)",
        r"\g<0>; glDepthFunc(GL_GREATER)",
        ("depth-func",),
    ),
    Mistake(
        "clear depth",
        r"glEnable\(GL_DEPTH_TEST\)",
        r"\g<0>; glClearDepth(0)",
        ("clear-depth", "depth-func"),
    ),
    Mistake(
        "viewport", r"glViewport\(0, 0, width, height\)", "glViewport(0, 0, 0, 0)", ("viewport",)
    ),
    Mistake(
        "behind",
        r"glTranslatef\((\S+), (\S+), -(\d+\.?\d*)\)",
        r"glTranslatef(\1, \2, \3)",
        OUTSIDE,
    ),
    Mistake(
        "near",
        r"gluPerspective\(([^,]+), ([^,]+), [^,]+, ([^,]+)\)\n",
        r"gluPerspective(\1, \2, 20, 300)\n",
        ("beyond-near",),
    ),
    Mistake(
        "far",
        r"gluPerspective\(([^,]+), ([^,]+), [^,]+, ([^,]+)\)\n",
        r"gluPerspective(\1, \2, 0.1, 0.5)\n",
        ("beyond-far",),
    ),
    Mistake(
        "near 0",
        r"gluPerspective\(([^,]+), ([^,]+), [^,]+, ([^,]+)\)\n",
        r"gluPerspective(\1, \2, 0, \3)\n",
        ("near-zero",),
    ),
    Mistake(
        "aspect 0", r"gluPerspective\(([^,]+), ([^,]+),", r"gluPerspective(\1, 0,", ("aspect-zero",)
    ),
    Mistake(
        "radians",
        r"gluPerspective\(([^,]+),",
        r"gluPerspective(\1 * 3.14159 / 180,",
        ("fovy-radians",),
    ),
    Mistake(
        "matrix mode",
        r"(gluPerspective\([^\n]*\n\s*)glMatrixMode\(GL_MODELVIEW\)",
        r"\1pass",
        ("projection-wiped", *OUTSIDE),
    ),
    Mistake("light off", r"glEnable\(GL_LIGHT0\)", "pass", ("light-off",)),
    Mistake("lighting off", r"glEnable\(GL_LIGHTING\)", "pass", ("lighting-off",)),
    Mistake("no material", r"glEnable\(GL_COLOR_MATERIAL\)", "pass", ("no-color-material",)),
    Mistake(
        "far side",
        r"glLightfv\(GL_LIGHT0, GL_POSITION, [^\n]*\)",
        "glLightfv(GL_LIGHT0, GL_POSITION, (0, 0, -1, 0))",
        ("light-far-side", "light-before-camera"),
    ),
    Mistake(
        "cull front",
        r"glEnable\(GL_DEPTH_TEST\)",
        r"\g<0>; glEnable(GL_CULL_FACE); glCullFace(GL_FRONT)",
        ("cull-front",),
    ),
    Mistake(
        "winding",
        r"glEnable\(GL_DEPTH_TEST\)",
        r"\g<0>; glEnable(GL_CULL_FACE); glFrontFace(GL_CW)",
        ("front-face", "inside-out", "culled"),
    ),
    Mistake(
        "incomplete",
        r"glTexParameteri\(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, [^\n]*\)",
        "pass",
        ("texture-incomplete",),
    ),
    Mistake("texture off", r"glEnable\(GL_TEXTURE_2D\)", "pass", ("texture-off",)),
    Mistake(
        "black times",
        r"glEnable\(GL_TEXTURE_2D\)",
        r"\g<0>; glColor3f(0, 0, 0)",
        ("texture-times-black",),
    ),
    Mistake("no blend", r"glEnable\(GL_BLEND\)", "pass", ("no-blend",)),
    Mistake(
        "no clear",
        r"glClear\((GL_COLOR_BUFFER_BIT \| )?GL_DEPTH_BUFFER_BIT\)",
        "glClear(GL_COLOR_BUFFER_BIT)",
        ("no-depth-clear",),
    ),
    Mistake(
        "late clear",
        r"( +)glfw\.swap_buffers\(window\)",
        r"\1glClear(GL_COLOR_BUFFER_BIT)\n\g<0>",
        ("late-clear",),
    ),
    Mistake("array", r"glEnableClientState\(GL_VERTEX_ARRAY\)", "pass", ("array-not-enabled",)),
    Mistake(
        "color mask",
        r"glClear\([^\n]*\)",
        r"\g<0>; glColorMask(False, False, False, True)",
        ("color-mask", "clear-masked", "leak"),
    ),
    Mistake("no end", r"glEnd\(\)", "pass", ("no-end", "inside-begin")),
)


def candidates() -> Iterator[tuple[str, Any, str]]:
    """Yield programs and views: a name, what looks at its frame, and its folder for programs."""
    for lesson in lessons():
        yield lesson.name, ProgramFrame(str(lesson.file), frame=lesson.frame), ""
    for name in VIEWS:
        yield name, ViewFrame(name), ""


def mended(folder: Path) -> Iterator[tuple[str, Any, str]]:
    """Yield the mended programs of students that need no screen, written into a folder."""
    for path in sorted((ROOT / "tests" / "student_programs").glob("*.txt")):
        if path.stem.startswith("glut"):
            continue
        first, *lines = path.read_text(encoding="utf-8").splitlines()
        kept = [line.removesuffix("#+").rstrip() for line in lines if not line.endswith("#-")]
        program = folder / f"{path.stem}.py"
        program.write_text("\n".join(kept) + "\n", encoding="utf-8")
        yield path.stem, ProgramFrame(str(program), frame=json.loads(first)["frame"]), ""


def owners(tape: Tape) -> tuple[np.ndarray, list[Item]]:
    """Return for each pixel which draw has coloured it last, -1 for none, and the draws."""
    trial = Trial(tape)
    owner = np.full(tape.size[::-1], -1)
    draws: list[Item] = []
    state: dict[str, Any] = {}

    def make(item: Item, draw: Any) -> None:
        before = state.get("picture")
        if before is None:
            before = trial.read()
        draw()
        state["picture"] = after = trial.read()
        if before is not None and after is not None and not item.call.name.startswith("glClear"):
            owner[changed(before, after, 1)] = len(draws)
        draws.append(item)

    try:
        trial.run(draw=make)
    finally:
        trial.release()
    return owner, draws


def asked(tape: Tape, dice: random.Random) -> list[tuple[str, Diagnosis]]:
    """Ask at a pixel of some draws that are seen; return their code and the answers."""
    owner, draws = owners(tape)
    seen = [k for k in range(len(draws)) if (owner == k).sum() >= 30]
    answers = []
    for index in dice.sample(seen, min(EACH, len(seen))):
        rows, columns = np.nonzero(owner == index)
        at = dice.randrange(len(rows))
        pixel = int(columns[at]), int(rows[at])
        found = diagnose(tape, pixel, SECONDS)
        answers.append((f"{pixel[0]},{pixel[1]} {draws[index].call.source}", found))
    return answers


def control(count: int, seed: int) -> int:
    """Ask about draws that are seen; return the status."""
    dice = random.Random(seed)
    done = blamed = 0
    with tempfile.TemporaryDirectory() as folder:
        targets = [*candidates(), *mended(Path(folder))]
        dice.shuffle(targets)
        while done < count and targets:
            name, target, _ = targets.pop()
            try:
                answers = target.look(lambda tape: asked(tape, dice), past=True)
            except (InputError, NoOpenGLError) as error:
                print(f"{name}: {error}", flush=True)
                continue
            for place, found in answers:
                done += 1
                if found.causes:
                    blamed += 1
                    cause = found.causes[0]
                    print(f"{name} {place}: {cause.cause} {cause.source}", flush=True)
    print(f"{done} draws that are seen, {blamed} blamed")
    return int(blamed * 100 > done)


def picture_of(path: Path, frame: int) -> np.ndarray | None:
    """Return what a program draws in a frame."""

    def look(tape: Tape) -> np.ndarray | None:
        trial = Trial(tape)
        try:
            return trial.picture()
        finally:
            trial.release()

    try:
        return ProgramFrame(str(path), frame=frame).look(look, past=True)
    except InputError:
        return None


def sow(seed: int, only: Sequence[str]) -> int:
    """Sow each mistake into a lesson; return the status."""
    dice = random.Random(seed)
    named = 0
    mistakes = [each for each in MISTAKES if not only or each.name in only]
    for mistake in mistakes:
        answer = sown(mistake, dice)
        good = answer.endswith("+")
        named += good
        print(f"{'  ' if good else '! '}{mistake.name}: {answer.rstrip('+')}", flush=True)
    print(f"{named} of {len(mistakes)} mistakes named")
    return int(named * 10 < 9 * len(mistakes))


def sown(mistake: Mistake, dice: random.Random) -> str:
    """Sow a mistake into a lesson that it changes; return what is said, with a + if it is right."""
    known = [lesson for lesson in lessons() if lesson.frame < 100]
    dice.shuffle(known)
    for lesson in known:
        source = lesson.file.read_text(encoding="utf-8")
        if len(re.findall(mistake.pattern, source)) < 1:
            continue
        with tempfile.TemporaryDirectory() as folder:
            copy(lesson, Path(folder))
            program = Path(folder) / lesson.file.name
            program.write_text(re.sub(mistake.pattern, mistake.replacement, source, count=1))
            before = picture_of(lesson.file, lesson.frame)
            after = picture_of(program, lesson.frame)
            pixel = differing(before, after, whole=mistake.name in ("no swap", "no end"))
            if pixel is None:
                continue
            found = diagnosed(program, lesson.frame, pixel or None)
            if found is None:
                continue
        causes = [cause.cause for cause in found.causes]
        right = bool(causes) and causes[0] in mistake.causes
        return f"{lesson.name} {pixel}: {', '.join(causes) or found.verdict}{'+' if right else ''}"
    return "no lesson for it"


def differing(
    before: np.ndarray | None, after: np.ndarray | None, whole: bool
) -> tuple[int, ...] | None:
    """Return a pixel in which two pictures differ, () where the whole one is asked about."""
    if whole:
        return ()
    if before is None or after is None or before.shape != after.shape:
        return None
    rows, columns = np.nonzero(changed(before, after, 30))
    if len(rows) < 400:
        return None
    middle = len(rows) // 2
    return int(columns[middle]), int(rows[middle])


def diagnosed(program: Path, frame: int, pixel: tuple[int, ...] | None) -> Diagnosis | None:
    """Return why a program's pixel looks as it does, None where it takes too long to its frame."""
    at = (pixel[0], pixel[1]) if pixel else None
    target = ProgramFrame(str(program), frame=frame)
    try:
        return target.look(lambda tape: diagnose(tape, at, SECONDS), past=True)
    except InputError:
        return None


def main() -> int:
    """Make one of the trials; return the status."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("trial", choices=("control", "sow"))
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs="*", default=())
    options = parser.parse_args()
    if options.trial == "control":
        return control(options.count, options.seed)
    return sow(options.seed, options.only)


if __name__ == "__main__":
    sys.exit(main())
