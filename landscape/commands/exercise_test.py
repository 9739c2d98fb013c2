"""`landscape exercise test`: an exercise, tried before students get it."""

import argparse
import os

from framelens.base.errors import visible
from framelens.base.output import write_whole
from framelens.base.progress import Progress
from framelens.base.texts import choose, said, translator
from framelens.base.texts import marked as _
from framelens.commands.parser import language_option
from landscape.commands.exercise_list import json_text
from landscape.commands.shelves import own_option, own_shelf
from landscape.course.exercise import Grader
from landscape.course.own_exercise import FRENCH, with_new_texts
from landscape.course.rehearsal import Finding, Rehearsal, count

EXAMPLE = "clock_hand"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("name", metavar="NAME", help=_("the exercise, a folder of this name"))
    own_option(parser)
    parser.add_argument(
        "--french",
        action="store_true",
        help=_("add to its fr.po the texts that it lacks, for you to translate"),
    )
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--json", action="store_true", help=_("print JSON"))
    what.add_argument(
        "-q", "--quiet", action="store_true", help=_("print nothing: the exit status says it")
    )
    language_option(parser, "language of the texts")


def run(options: argparse.Namespace) -> int:
    """Try an exercise: 0 if all is well, 1 if not."""
    language = options.lang or choose(os.environ)
    shelf = own_shelf(options.exercises)
    found = shelf.exercise(options.name)
    _ = translator(language, "course")
    if options.french:
        data, added = with_new_texts(found)
        write_whole(found.folder / FRENCH, data)
        if not options.quiet and not options.json:
            print(_("{file}: texts added: {count}").format(file=found.folder / FRENCH, count=added))

    findings: list[Finding] = []
    with (
        Grader(shelf=shelf) as grader,
        Progress(count(found), options.quiet or options.json) as progress,
    ):
        for finding in Rehearsal(found, grader, found.translate.to(language)).all():
            findings.append(finding)
            progress.step(options.name)

    holds = all(finding.wrong is None for finding in findings)
    if options.json:
        whole = {"exercise": found.name, "holds": holds, "tried": _as_json(findings)}
        print(json_text(whole))
    elif not options.quiet:
        print(visible("\n".join(_as_text(findings, language))))
    return 0 if holds else 1


def _as_json(findings: list[Finding]) -> list[dict[str, str | None]]:
    return [
        {"tried": str(each.tried), "wrong": None if each.wrong is None else str(each.wrong)}
        for each in findings
    ]


def _as_text(findings: list[Finding], language: str) -> list[str]:
    """Return a line for each that was tried, and one for all."""
    _ = translator(language, "course")
    good, bad = _("right"), _("wrong")
    width = max(len(good), len(bad))
    lines = []
    for each in findings:
        word = good if each.wrong is None else bad
        lines.append(f"{word:{width}}  {said(each.tried, language)}")
        if each.wrong is not None:
            lines.append(f"{'':{width}}  {said(each.wrong, language)}")
    if all(each.wrong is None for each in findings):
        lines.append(_("The exercise holds."))
    else:
        lines.append(_("The exercise does not hold yet."))
    return lines
