"""Three trials of `landscape why`; the first two have a seed:

    python scripts/why_trials.py control [--count 200] [--seed 1]    draws that are seen
    python scripts/why_trials.py sow [--seed 1]                      mistakes sown into programs
    python scripts/why_trials.py corpus FOLDER                       broken programs and mended ones

``control`` takes lessons, views, mended programs of ``tests/student_programs`` and random programs
(why/scenes.py), chooses draws that are seen at random, and asks why at a pixel of each: nothing may
be blamed. ``sow`` puts each mistake of why/mistakes.py into a lesson, or a solution of an exercise,
whose picture it changes, and asks at a pixel that differs: the first cause must be one of those
named beside the mistake. ``corpus`` asks about each program NAME.py of a folder's ``cases.csv``,
which has a line for each: name, frame, XY (a pixel or nothing), line, and call (a call or a
variable, or several with / between them). The first cause must have that line, within two, or one
of those; and of NAME.fixed.py nothing may be blamed.

All print a line for each failure and the counts, and end with status 1 if more than one in ten
fails, or more than one in a hundred is blamed without reason (corpus: one in forty).

``--only NAME ...`` takes these lessons, mistakes or programs alone; ``--part 2/5`` the second of
five parts. Each program is looked into by a process of its own.
"""

import argparse
import contextlib
import csv
import json
import random
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from why import asking, scenes
from why.mistakes import MISTAKES, Mistake

from framelens.base.errors import InputError, NoOpenGLError
from framelens.base.isolated import Ended, isolated
from landscape.course.ladder import lessons
from landscape.course.shelf import NAMES, exercise
from landscape.course.solutions import runnable
from landscape.scene.scene import listed_views

ROOT = Path(__file__).resolve().parents[1]
SECONDS = 120.0  # for a program; chosen
SLOW = 100  # the frame from which on a lesson takes too long; chosen
IGNORED = shutil.ignore_patterns("__pycache__", "pages")
SHARE = 4  # kinds of targets: as many random programs as lessons, and so on

Case = TypeVar("Case")


@dataclass(frozen=True)
class Asked:
    """A program's path, or a view's name, and the frame that is looked at."""

    name: str
    path: str
    frame: int


def targets(folder: Path, seed: int, count: int) -> Iterator[Asked]:
    """Yield what is asked about: in turn a lesson, a random program, a mended one and a view."""
    dice = random.Random(seed)
    known = [Asked(each.name, str(each.file), each.frame) for each in lessons()]
    shown = [Asked(view["name"], view["name"], 0) for view in listed_views()]
    kinds = [known, list(_scenes(folder, seed, count)), list(_mended(folder)), shown]
    for kind in kinds:
        dice.shuffle(kind)
    while any(kinds):
        for kind in kinds:
            if kind:
                yield kind.pop()


def _scenes(folder: Path, seed: int, count: int) -> Iterator[Asked]:
    """Yield random programs, written into a folder."""
    for number in range(count // SHARE):
        program = folder / f"scene_{seed}_{number}.py"
        program.write_text(scenes.program(random.Random(f"{seed} {number}")))
        yield Asked(program.stem, str(program), number % 3)


def _mended(folder: Path) -> Iterator[Asked]:
    """Yield the mended programs of students, written into a folder."""
    for path in sorted((ROOT / "tests" / "student_programs").glob("*.txt")):
        first, *lines = path.read_text(encoding="utf-8").splitlines()
        kept = [line.removesuffix("#+").rstrip() for line in lines if not line.endswith("#-")]
        program = folder / f"{path.stem}.py"
        program.write_text("\n".join(kept) + "\n", encoding="utf-8")
        yield Asked(path.stem, str(program), json.loads(first)["frame"])


def control(options: argparse.Namespace) -> int:
    """Ask about draws that are seen; return the status."""
    done = blamed = 0
    with tempfile.TemporaryDirectory() as folder:
        chosen = list(targets(Path(folder), options.seed, options.count))
        chosen = _some(chosen[: options.count // asking.EACH], options)
        for asked in chosen:
            seed = f"{options.seed} {asked.name}"
            try:
                answers = isolated(asking.seen, asked.path, asked.frame, seed, seconds=SECONDS)
            except (InputError, NoOpenGLError, Ended) as error:
                print(f"- {asked.name}: {error}", flush=True)
                continue
            for place, causes in answers:
                done += 1
                if causes:
                    blamed += 1
                    print(f"! {asked.name} {place}: {_written(causes)}", flush=True)
    print(f"{done} draws that are seen, {blamed} blamed")
    return int(blamed * 100 > done)


def _written(causes: Sequence[tuple[str, str]]) -> str:
    return ", ".join(f"{cause} ({source})" for cause, source in causes)


def _some(cases: list[Case], options: argparse.Namespace) -> list[Case]:
    """Return the cases that the options choose."""
    if options.only:
        return [case for case in cases if getattr(case, "name", "") in options.only]
    part, parts = (int(number) for number in options.part.split("/"))
    return cases[part - 1 :: parts]


def sow(options: argparse.Namespace) -> int:
    """Sow each mistake into a program; return the status."""
    mistakes = _some(list(MISTAKES), options)
    named = 0
    for mistake in mistakes:
        dice = random.Random(f"{options.seed} {mistake.name}")
        answer = _sown(mistake, dice)
        if answer is None:
            print(f"! {mistake.name}: no program for it", flush=True)
            continue
        place, causes = answer
        good = bool(causes) and causes[0][0] in mistake.causes
        named += good
        print(f"{' ' if good else '!'} {mistake.name}: {place}: {_written(causes)}", flush=True)
    print(f"{named} of {len(mistakes)} mistakes named")
    return int(named * 10 < 9 * len(mistakes))


def _sown(mistake: Mistake, dice: random.Random) -> asking.Answer | None:
    """Sow a mistake into a program that it changes; return what is said of it."""
    known = [Asked(each.name, str(each.file), each.frame) for each in lessons()]
    with contextlib.ExitStack() as programs:
        for name in sorted(NAMES):
            folder = exercise(name).folder
            program = programs.enter_context(runnable(folder / "solution.py", folder))
            known.append(Asked(f"{name} (solution)", str(program), 0))
        dice.shuffle(known)
        return _first_sown(mistake, known)


def _first_sown(mistake: Mistake, known: Sequence["Asked"]) -> asking.Answer | None:
    for asked in known:
        source = Path(asked.path).read_text(encoding="utf-8")
        if asked.frame >= SLOW or not re.search(mistake.pattern, source):
            continue
        with tempfile.TemporaryDirectory() as folder:
            beside = Path(folder) / "beside"
            shutil.copytree(Path(asked.path).parent, beside, ignore=IGNORED)
            program = beside / Path(asked.path).name
            program.write_text(re.sub(mistake.pattern, mistake.replacement, source, count=1))
            paths = asked.path, str(program)
            everywhere = mistake.everywhere
            try:
                answer = isolated(asking.mistaken, *paths, asked.frame, everywhere, seconds=SECONDS)
            except (Ended, NoOpenGLError):
                continue
        if answer is not None:
            return answer
    return None


def corpus(options: argparse.Namespace) -> int:
    """Ask about broken programs and mended ones; return the status."""
    with (options.folder / "cases.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    if options.only:
        rows = [row for row in rows if row["name"] in options.only]
    part, parts = (int(number) for number in options.part.split("/"))
    rows = rows[part - 1 :: parts]
    named = blamed = 0
    for row in rows:
        answer = _why(options.folder / f"{row['name']}.py", row)
        good = _right(answer, row)
        named += good
        if not good:
            print(f"! {row['name']}: {_short(answer)}, not {row['line']} {row['call']}", flush=True)
        answer = _why(options.folder / f"{row['name']}.fixed.py", row)
        if answer["causes"]:
            blamed += 1
            print(f"! {row['name']}.fixed: {_short(answer)}", flush=True)
    print(f"{named} of {len(rows)} causes named, {blamed} mended programs blamed")
    return int(named * 10 < 9 * len(rows) or blamed * 40 > len(rows))


def _why(path: Path, row: dict[str, str]) -> dict:
    """Return what `framelens why --json` prints of a program of the corpus."""
    pixel = [row["XY"]] if row["XY"] else []
    command = ["-m", "framelens", "why", str(path), *pixel, "--frame", row["frame"], "--json"]
    done = subprocess.run(
        [sys.executable, *command], capture_output=True, text=True, timeout=SECONDS
    )
    if done.returncode:
        return {"verdict": done.stderr.strip()[-200:], "causes": []}
    return json.loads(done.stdout)


def _right(answer: dict, row: dict[str, str]) -> bool:
    """Return whether the first cause is that of a row: by its line, its state or its call."""
    if not answer["causes"]:
        return False
    first = answer["causes"][0]
    line = int(first["source"].rpartition(":")[2] or 0)
    calls = [call for call in row["call"].split("/") if call]
    told = first["text"] + first["mend"]
    return (
        abs(line - int(row["line"])) <= 2
        or first["state"] in calls
        or any(call in told for call in calls)
    )


def _short(answer: dict) -> str:
    causes = [(cause["cause"], cause["source"]) for cause in answer["causes"]]
    return _written(causes) or answer["verdict"]


def main() -> int:
    """Make one of the trials; return the status."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("trial", choices=("control", "sow", "corpus"))
    parser.add_argument("folder", nargs="?", type=Path, help="of the corpus")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs="*", default=())
    parser.add_argument("--part", default="1/1")
    options = parser.parse_args()
    if options.trial == "corpus" and options.folder is None:
        parser.error("corpus: expected the folder of the programs")
    trials = {"control": control, "sow": sow, "corpus": corpus}
    return trials[options.trial](options)


if __name__ == "__main__":
    sys.exit(main())
