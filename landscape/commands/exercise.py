"""The commands `landscape exercise list`, `start` and `check`."""

import argparse
import json
import os
import shutil
import sys
import textwrap
from pathlib import Path
from typing import Any

from framelens.base.errors import InputError
from framelens.base.output import check_folder, check_writable, save_png, write_whole
from framelens.base.texts import Translator, choose, translator
from framelens.system import quoted
from landscape.course.exercise import LEAD, NAMES, Exercise, Grader, Report, exercise, start
from landscape.course.grader.grading import MOST, _
from landscape.course.grader.troubles import sentence
from landscape.course.language import told_in

WIDTHS = 72, 100  # chosen: least and most columns of a report
SHOWN = _("Where the picture differs: landscape exercise check {file} --heat-map difference.png")
WRITTEN = _("{file}: your picture, where it differs, and the solution's")


def _json(value: Any) -> str:
    """Return a value as JSON, with letters as they are where the output has all of them."""
    encoding = (sys.stdout.encoding or "").lower()
    return json.dumps(value, indent=1, ensure_ascii=encoding != "utf-8")


def list_(options: argparse.Namespace) -> int:
    """Print the exercises in their order."""
    language = _language(options)
    lead = translator(language, "course")(LEAD)
    rows = []
    for name in NAMES:
        found = exercise(name)
        own = found.translate.to(language)
        task = [own(text) for text in found.task]
        lessons = list(found.lessons)
        rows.append({"name": name, "title": own(found.title), "task": task, "lessons": lessons})
    if options.json:
        print(_json(rows))
    else:
        for row in rows:
            print(f"{row['name']:20} {row['title']}")
            print(" " * 20, lead.format(lessons=", ".join(row["lessons"])))
    return 0


def start_(options: argparse.Namespace) -> int:
    """Write the program of an exercise, in a file that is not there yet."""
    language = _language(options)
    with told_in(language):
        _start(options, language)
    return 0


def _start(options: argparse.Namespace, language: str) -> None:
    found = exercise(options.name)
    path = options.out or Path(f"{found.name}.py")
    if path.is_dir():
        path = path / f"{found.name}.py"
    if os.path.lexists(path):
        raise InputError(f"{path}: is there already; expected --out with the name of a new file")
    check_folder(path.parent, f"--out {path}" if options.out else str(path))
    write_whole(path, start(found, language).encode())
    _ = translator(language, "course")
    if not options.quiet:
        print(path)
        file = quoted(str(path))
        print(_("The task stands at the top of it. Run it: python {file}").format(file=file))
        print(_("Check it: landscape exercise check {file}").format(file=file))


def check(options: argparse.Namespace) -> int:
    """Check a program and print what was found: 0 passed, 1 not, 2 could not be run."""
    language = _language(options)
    with told_in(language):
        return _check(options, language)


def _check(options: argparse.Namespace, language: str) -> int:
    if options.heat_map is not None:
        if options.heat_map.suffix.lower() != ".png":
            raise InputError(f"--heat-map {options.heat_map}: expected a name ending in .png")
        check_writable(options.heat_map, "--heat-map ")
    with Grader(options.seconds) as grader:
        report = grader.check(options.file)
        _ = report.exercise.translate.to(language)
        if options.heat_map is not None and report.work is not None and report.solution is not None:
            from landscape.course.grader.heat_map import heat_map

            save_png(heat_map(report.work, report.solution), options.heat_map)
        if options.json:
            print(_json(as_json(report, _)))
        elif report.error is None and not options.quiet:
            columns = shutil.get_terminal_size((WIDTHS[1], 24)).columns
            columns = min(max(columns, WIDTHS[0]), WIDTHS[1])
            print("\n".join(as_text(report, _, columns)))
            if options.heat_map is not None:
                print(_(WRITTEN).format(file=options.heat_map))
            elif (report.difference or 0) > MOST:
                print(_(SHOWN).format(file=quoted(str(options.file))))
        if report.error is not None:
            raise InputError(f"{options.file}: {sentence(report.error, _)}")
        return 0 if report.passed else 1


def _language(options: argparse.Namespace) -> str:
    return options.lang or choose(os.environ)


def as_json(report: Report, _: Translator) -> dict[str, Any]:
    """Return a report as JSON; "passed" of a test is null if it was not made."""
    made = {result.test.key: result for result in report.results}
    tests = []
    for test in report.tests:
        result = made.get(test.key)
        told = result.hint if result is not None else None
        tests.append(
            {
                "name": _(test.name),
                "passed": result.passed if result is not None else None,
                "rationale": _(test.rationale),
                "hint": told.written(_) if told is not None else "",
            }
        )

    found: dict[str, Any] = {
        "exercise": report.exercise.name,
        "passed": report.passed,
        "tests": tests,
        "picture_difference": report.difference,
    }
    if report.error is not None:
        found["error"] = sentence(report.error, _)
    return found


def as_text(report: Report, _: Translator, columns: int = WIDTHS[1]) -> list[str]:
    """Return the lines of a report: one for each test, and its hint below one that failed."""
    words = {True: _("passed"), False: _("failed"), None: _("not checked")}
    width = max(map(len, words.values()))
    indent = " " * (width + 2)
    lines = [_title(report.exercise, _)]
    for result in report.results:
        told = [_(result.test.name)]
        if result.hint is not None:
            told.append(result.hint.written(_))
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


def _title(found: Exercise, _: Translator) -> str:
    return _("{name}: {title}").format(name=found.name, title=_(found.title))
