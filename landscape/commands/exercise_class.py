"""`landscape exercise check` of a folder, a zip or several files: a class, graded side by side."""

import argparse
import os
import shutil
import sys
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from framelens.base import packages
from framelens.base.errors import InputError
from framelens.base.input import read_bounded
from framelens.base.output import check_folder, check_writable, write_whole
from framelens.base.progress import Progress
from framelens.base.texts import Translator, translator
from framelens.commands.option_values import pathname, refusal
from landscape.commands.shelves import shelf
from landscape.commands.work import work
from landscape.course.grader.confinement import AUTO
from landscape.course.grader.grading import _
from landscape.course.roster import moodle, tables
from landscape.course.roster.copies_page import Likeness, as_json, as_lines, as_section, likenesses
from landscape.course.roster.grades import Graded, Rules, grade_class
from landscape.course.roster.page import as_page, inside, told
from landscape.course.roster.submissions import submissions

KINDS = ".csv", ".json", ".xml", ".html"
NARROWEST = 20  # chosen: columns of a hint
MOST_WORKSHEET = 1 << 24  # bytes, chosen
LATE = _("late")
ALL = _("Programs that pass: {passed} of {all}")
ABSENT = _("{file}: has no participant {numbers}")
HIGHEST = _(
    "{file}: the assignment's maximum grade is {highest}, and a whole program gets {points} by "
    "--points"
)

BY_SCALE = _(
    "{file}: the assignment is graded by a scale: Moodle passes over points, and takes the comments"
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options that a class has and a single program has not."""
    own = parser.add_argument_group(_("a class: a folder, a zip or several files"))
    own.add_argument(
        "--out",
        type=pathname,
        action="append",
        default=[],
        metavar="FILE|DIR",
        help=_(
            "write a table, .csv, .json, .xml (JUnit) or .html (with pictures), or into a folder a "
            "results.json for each submission, as Gradescope reads it; may be given several times"
        ),
    )

    # For Moodle.
    own.add_argument(
        "--worksheet",
        type=pathname,
        metavar="FILE.csv",
        help=_("fill in a grading worksheet of Moodle: its grades and comments, nothing else"),
    )
    own.add_argument(
        "--feedback",
        type=pathname,
        metavar="FILE.zip",
        help=_("write a zip of feedback files for Moodle, a page for each student"),
    )

    own.add_argument(
        "--copies",
        action="store_true",
        help=_("also list pairs of programs that share what is rare, for you to look at"),
    )

    # How it is graded.
    own.add_argument(
        "--points",
        type=_points,
        metavar="N",
        help=_(
            "what a program gets that passes all tests; default: the worksheet's maximum grade, "
            "else a point for each test"
        ),
    )
    own.add_argument(
        "--due",
        type=_date,
        metavar="DATE",
        help=_("when it was due, as 2026-11-27T18:00: what was changed later is marked late"),
    )
    own.add_argument(
        "--jobs",
        type=_jobs,
        metavar="N",
        help=_("how many processes grade; default: as many as there are processors"),
    )
    own.add_argument(
        "--engine",
        metavar="ADDRESS|FILE.json",
        help=_(
            "a cluster of Dask that grades, in place of --jobs: its scheduler's address or its "
            "scheduler file"
        ),
    )
    own.add_argument(
        "--again",
        action="store_true",
        help=_("run what has not changed since it was graded, too"),
    )


def _points(text: str) -> float:
    try:
        points = float(text)
    except ValueError:
        points = 0.0
    if not 0 < points <= 1e6:
        raise refusal("{text!r}: expected a number above 0", text=text)
    return points


def _date(text: str) -> datetime:
    try:
        date = datetime.fromisoformat(text)
    except ValueError:
        raise refusal("{text!r}: expected a date such as 2026-11-27T18:00", text=text) from None
    return date.astimezone().replace(tzinfo=None) if date.tzinfo is not None else date


def _jobs(text: str) -> int:
    if not text.isdecimal() or not 1 <= int(text) <= 256:
        raise refusal("{text!r}: expected a whole number from 1 to 256", text=text)
    return int(text)


def is_class(options: argparse.Namespace) -> bool:
    """Return whether more is asked about than one program."""
    many = len(options.files) > 1 or options.files[0].is_dir()
    wanted = options.out or options.worksheet or options.feedback or options.copies
    return bool(many or options.files[0].suffix.lower() == ".zip" or wanted)


def run(options: argparse.Namespace, language: str) -> int:
    """Grade a class and write what is asked for: 0 all passed, 1 not."""
    if options.heat_map is not None:
        raise InputError("--heat-map: expected a single program; --out FILE.html has all pictures")
    _check_outputs(options)
    worksheet, points = b"", options.points
    if options.worksheet is not None:
        worksheet, highest = _worksheet(options, language)
        points = highest if points is None else points

    found = submissions(options.files)
    exercises = shelf(options.exercises)
    rules = _rules(options, language, points, exercises.folder)
    with Progress(len(found), options.quiet or options.json) as progress:
        with work(options) as (workers, count):
            jobs = count if workers is not None else options.jobs or 0
            graded = grade_class(found, rules, options.due, progress.step, workers, jobs)

    translate = translator(language, "course")
    alike = likenesses(graded, exercises) if options.copies else None
    _write(options, graded, worksheet, language, translate, alike)
    _print(options, graded, translate, alike)
    return 0 if all(each.row.passed for each in graded) else 1


def _rules(
    options: argparse.Namespace, language: str, points: float | None, exercises: Path | None
) -> Rules:
    """Return by which rules the class is graded."""
    return Rules(
        language=language,
        seconds=options.seconds,
        points=points,
        version=packages.PACKAGES[-1].version,
        again=options.again,
        contain=options.contain or AUTO,
        exercises=exercises,
        private=_private(options),
    )


def _print(
    options: argparse.Namespace,
    graded: Sequence[Graded],
    translate: Translator,
    alike: Sequence[Likeness] | None,
) -> None:
    """Print the class as JSON or as a table, unless nothing is to be printed."""
    if options.json:
        rows = [each.row for each in graded]
        sys.stdout.write(tables.as_json(rows, _as_json(alike)).decode())
    elif not options.quiet:
        pairs = as_lines(alike, translate) if alike is not None else []
        print("\n".join([*_table(graded, translate), *pairs]))


def _worksheet(options: argparse.Namespace, language: str) -> tuple[bytes, float | None]:
    """Return Moodle's worksheet and its highest grade; print what Moodle will not say of it."""
    worksheet = read_bounded(options.worksheet, MOST_WORKSHEET)
    highest = moodle.highest(worksheet, str(options.worksheet))
    said = _of_worksheet(options, worksheet, highest, language)
    if said and not options.quiet:
        print(f"landscape: {said}", file=sys.stderr)
    return worksheet, highest


def _as_json(alike: Sequence[Likeness] | None) -> list[dict[str, object]] | None:
    return as_json(alike) if alike is not None else None


def _private(options: argparse.Namespace) -> list[str]:
    """Return the files and folders of the class, of which its programs must read nothing."""
    named = [*options.files, *options.out, options.worksheet, options.feedback]
    places = {os.path.realpath(each) for each in named if each is not None}
    around = {os.path.dirname(each) for each in places if not os.path.isdir(each)}
    return sorted(places | around)


def _of_worksheet(
    options: argparse.Namespace, worksheet: bytes, highest: float | None, language: str
) -> str:
    """Return what Moodle will not say of its worksheet and of ``--points``; "" if all is well."""
    translate = translator(language, "course")
    if moodle.by_scale(worksheet, str(options.worksheet)):
        return translate(BY_SCALE).format(file=options.worksheet)
    if highest is None or options.points in (None, highest):
        return ""
    values = {"highest": f"{highest:g}", "points": f"{options.points:g}"}
    return translate(HIGHEST).format(file=options.worksheet, **values)


def _check_outputs(options: argparse.Namespace) -> None:
    """Raise InputError for what could not be written in the end."""
    for path in options.out:
        if path.suffix.lower() in KINDS:
            check_writable(path, "--out ")
        elif path.suffix:
            raise InputError(
                "--out {path}: expected a folder, or a name ending in {kinds}",
                path=path,
                kinds=", ".join(KINDS),
            )
        else:
            check_folder(path, f"--out {path}")
    if options.feedback is not None:
        check_writable(options.feedback, "--feedback ")


def _fill(
    options: argparse.Namespace, graded: Sequence[Graded], worksheet: bytes, _: Translator
) -> None:
    """Write the grades into Moodle's worksheet; say who is not in it."""
    marks = _marks(graded, _)
    filled, absent = moodle.filled(worksheet, marks, str(options.worksheet))
    write_whole(options.worksheet, filled)
    if absent and not options.quiet:
        text = _(ABSENT).format(file=options.worksheet, numbers=", ".join(absent))
        print(f"landscape: {text}", file=sys.stderr)


def _write(
    options: argparse.Namespace,
    graded: Sequence[Graded],
    worksheet: bytes,
    language: str,
    _: Translator,
    alike: Sequence[Likeness] | None,
) -> None:
    rows = [each.row for each in graded]
    for path in options.out:
        kind = path.suffix.lower()
        if kind == ".csv":
            write_whole(path, tables.as_csv(rows))
        elif kind == ".json":
            write_whole(path, tables.as_json(rows, _as_json(alike)))
        elif kind == ".xml":
            write_whole(path, tables.as_junit(rows))
        elif kind == ".html":
            more = as_section(alike, _) if alike is not None else ""
            write_whole(path, as_page(graded, language, _, hidden=True, more=more))
        else:
            for number, row in enumerate(rows, 1):
                name = f"{number:04}-{_file_name(row.student)}"
                write_whole(path / name / "results.json", tables.as_gradescope(row))

    if options.worksheet is not None:
        _fill(options, graded, worksheet, _)
    if options.feedback is not None:
        write_whole(options.feedback, _feedback(graded, language, _))


def _feedback(graded: Sequence[Graded], language: str, _: Translator) -> bytes:
    """Return the zip of pages that Moodle hands back to the students."""
    return moodle.feedback(
        [
            (each.submission.folder, _page_name(each), as_page([each], language, _))
            for each in graded
            if each.submission.folder
        ]
    )


def _marks(graded: Sequence[Graded], _: Translator) -> dict[str, moodle.Mark]:
    """Return the marks by participants' numbers: the best of several programs of one student."""
    marks: dict[str, moodle.Mark] = {}
    best: dict[str, float] = {}
    for each in graded:
        row = each.row
        if row.id and row.points >= best.get(row.id, 0.0):
            best[row.id] = row.points
            marks[row.id] = moodle.Mark(f"{row.points:g}", tables.printable(told(row, _)))
    return marks


def _page_name(each: Graded) -> str:
    """Return the name of a feedback page: the program's, with its folders."""
    return f"{_file_name(inside(each).removesuffix('.py'))}.html"


def _file_name(student: str) -> str:
    """Return a name as a file may have it on every system."""
    kept = "".join(each if each.isalnum() or each in "-_" else "_" for each in student)
    return kept[:60] or "_"


def _table(graded: Sequence[Graded], _: Translator) -> list[str]:
    """Return the lines of the table on a terminal."""
    columns = shutil.get_terminal_size((100, 24)).columns
    lines = []
    for each in graded:
        row = each.row
        student = tables.printable(row.student)[:24]
        points = f"{row.points:g}/{row.of:g}" if row.of else "-"
        late = f" {_(LATE)}" if row.late else ""
        start = f"{student:24} {row.exercise:20} {points:>8}{late}  "
        room = max(columns - len(start), NARROWEST)
        hint = tables.printable(told(row, _))
        cut = hint if len(hint) <= room else hint[: room - 1] + "\u2026"
        lines.append((start + cut).rstrip())
    passed = sum(each.row.passed for each in graded)
    return [*lines, _(ALL).format(passed=passed, all=len(graded))]
