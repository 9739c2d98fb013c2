"""`landscape exercise check`: a student's program, run and graded."""

import argparse
import os
import shutil
import textwrap
from collections.abc import Mapping
from typing import Any

import numpy as np

from framelens.base.errors import InputError, visible
from framelens.base.output import check_writable, save_png
from framelens.base.texts import Translator, choose
from framelens.commands.option_values import pathname, refusal
from framelens.commands.parser import language_option
from framelens.system import quoted
from landscape.commands import exercise_class
from landscape.commands.exercise_list import json_text
from landscape.commands.shelves import exercises_option, shelf
from landscape.course.exercise import Grader, Report, verdicts
from landscape.course.grader.budget import MOST_SECONDS, SECONDS
from landscape.course.grader.confinement import AUTO, CHOICES, LANDLOCK, PYTHON
from landscape.course.grader.grading import MOST, _
from landscape.course.grader.troubles import sentence
from landscape.course.shelf import Exercise

EXAMPLE = "winding.py --heat-map difference.png"
WIDTHS = 72, 100  # chosen: least and most columns of a report
SHOWN = _("Where the picture differs: landscape exercise check {file} --heat-map difference.png")
WHY = _("The picture is all of one colour: line {line}. {text} Mend: {mend}.")
OTHERWISE = _("Your program does this in another way; its picture is right.")
UNSEEN = _("{test} (not shown to students)")
CONTAINED = {
    LANDLOCK: _("The system contained the program: by Landlock and a filter of its calls."),
    PYTHON: _("Only Python contained the program."),
}
WRITTEN = _("{file}: your picture, where it differs, and the solution's")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "files",
        nargs="+",
        type=pathname,
        metavar="FILE|FOLDER|ZIP",
        help=_("the program; or a folder, a zip or several files: a class"),
    )

    what = parser.add_mutually_exclusive_group()
    what.add_argument("--json", action="store_true", help=_("print JSON"))
    what.add_argument(
        "-q", "--quiet", action="store_true", help=_("print nothing: the exit status says it")
    )

    parser.add_argument(
        "--heat-map",
        type=pathname,
        metavar="FILE.png",
        help=_("write your picture, where it differs, and the solution's, side by side"),
    )
    parser.add_argument(
        "--seconds",
        type=_seconds,
        default=SECONDS,
        metavar="N",
        help=_("how long the program may take; default: %(default)g"),
    )
    parser.add_argument(
        "--contain",
        choices=CHOICES,
        help=_(
            "whether the system contains the program: where it can, in any case, or not at all, "
            "so that only Python does; default: auto"
        ),
    )

    exercises_option(parser)
    language_option(parser, "language of the texts")
    exercise_class.add_arguments(parser)


def _seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = 0.0
    if not 0.1 <= seconds <= MOST_SECONDS:
        raise refusal(
            "{text!r}: expected a number from 0.1 to {most_seconds:g}",
            text=text,
            most_seconds=MOST_SECONDS,
        )
    return seconds


def run(options: argparse.Namespace) -> int:
    """Check a program and print what was found: 0 passed, 1 not, 2 could not be run."""
    language = options.lang or choose(os.environ)
    if exercise_class.is_class(options):
        return exercise_class.run(options, language)
    (file,) = options.files
    if options.heat_map is not None:
        if options.heat_map.suffix.lower() != ".png":
            raise InputError(
                "--heat-map {heat_map}: expected a name ending in .png", heat_map=options.heat_map
            )
        check_writable(options.heat_map, "--heat-map ")
    exercises = shelf(options.exercises)
    with Grader(options.seconds, options.contain or AUTO, shelf=exercises) as grader:
        report = grader.check(file)
        cause = first_cause(report, grader, language)

    _ = report.exercise.translate.to(language)
    if options.heat_map is not None and report.work is not None and report.solution is not None:
        from landscape.course.grader.heat_map import heat_map

        save_png(heat_map(report.work, report.solution), options.heat_map)
    if options.json:
        print(json_text(as_json(report, _) | {"cause": cause}))
    elif report.error is None and not options.quiet:
        _print(report, cause, options, _)
    if report.error is not None:
        raise InputError("{file}: {sentence}", file=file, sentence=sentence(report.error, _))
    return 0 if report.passed else 1


def _print(
    report: Report,
    cause: Mapping[str, Any] | None,
    options: argparse.Namespace,
    _: Translator,
) -> None:
    """Print a report, why the picture is of one colour, and where the heat map is or how to ask."""
    columns = shutil.get_terminal_size((WIDTHS[1], 24)).columns
    columns = min(max(columns, WIDTHS[0]), WIDTHS[1])
    print(visible("\n".join(as_text(report, _, columns))))
    if cause is not None:
        line = cause["source"].rpartition(":")[2]
        told = _(WHY).format(line=line, text=cause["text"], mend=cause["mend"])
        print(visible("\n".join(textwrap.wrap(told, columns, break_on_hyphens=False))))
    if options.contain:
        print(_(CONTAINED[report.contained]))

    if options.heat_map is not None:
        print(_(WRITTEN).format(file=options.heat_map))
    elif (report.difference or 0) > MOST:
        asked = quoted(str(options.files[0]))
        if options.exercises is not None:
            asked += f" --exercises {quoted(str(options.exercises))}"
        print(_(SHOWN).format(file=asked))


def first_cause(report: Report, grader: Grader, language: str) -> dict[str, Any] | None:
    """Return why the picture of a program that has not passed is all of one colour.

    It is a cause as `landscape why --json` prints it; None where the picture has more colours, as
    has every one of the solution's that is asked about, or no cause is found.
    """
    if report.passed or report.work is None or report.solution is None:
        return None
    work, solution = report.work.frames, report.solution.frames
    for number in sorted(work):
        if _plain(work[number].picture) and not _plain(solution[number].picture):
            return grader.cause(report.work.path, number, language)
    return None


def _plain(picture: np.ndarray) -> bool:
    return not (picture != picture[:1, :1]).any()


def as_json(report: Report, _: Translator) -> dict[str, object]:
    """Return a report as JSON; "passed" of a test is null if it was not made."""
    found: dict[str, object] = {
        "exercise": report.exercise.name,
        "passed": report.passed,
        "tests": verdicts(report, _),
        "picture_difference": report.difference,
        "contained": report.contained,
    }
    if report.error is not None:
        found["error"] = sentence(report.error, _)
    return found


def as_text(report: Report, _: Translator, columns: int = WIDTHS[1]) -> list[str]:
    """Return the lines of a report: one for each test, and its hint below one that failed."""
    words = {True: _("passed"), False: _("failed"), None: _("not checked")}
    width = max(map(len, words.values()))
    indent = " " * (width + 2)
    lines = [title_of(report.exercise, _)]
    for result in report.results:
        name = _(result.test.name)
        told = [_(UNSEEN).format(test=name) if result.test.hidden else name]
        if result.hint is not None:
            told.append(result.hint.written(_))
        elif result.otherwise:
            told.append(_(OTHERWISE))
        for first, text in zip((f"{words[result.passed]:{width}}  ", indent), told, strict=False):
            lines += textwrap.wrap(
                text,
                columns,
                initial_indent=first,
                subsequent_indent=indent,
                break_long_words=False,
                break_on_hyphens=False,
            )

    count = sum(result.passed is True for result in report.results)
    total = _("{passed} of {tests} tests passed")
    if count < 2:  # a singular in French
        total = (_("0 of {tests} tests passed"), _("1 of {tests} tests passed"))[count]
    lines.append(total.format(passed=count, tests=len(report.results)))
    return lines


def title_of(found: Exercise, _: Translator) -> str:
    return _("{name}: {title}").format(name=found.name, title=_(found.title))
