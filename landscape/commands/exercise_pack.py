"""`landscape exercise pack`: what students get of exercises, and what their teacher keeps."""

import argparse
import os
from collections.abc import Sequence

from framelens.base.errors import InputError
from framelens.base.output import check_output_folder, write_all
from framelens.base.progress import Progress
from framelens.base.texts import choose, translator
from framelens.base.texts import marked as _
from framelens.commands import option_values
from framelens.commands.parser import language_option
from landscape.commands.shelves import own_option, own_shelf
from landscape.course.exercise import Grader
from landscape.course.handout import for_students, for_teachers
from landscape.course.rehearsal import Rehearsal, count
from landscape.course.roster.archive import zipped
from landscape.course.shelf import Exercise, Shelf

EXAMPLE = "clock_hand --out handout"
STUDENTS, TEACHER = "students.zip", "teacher.zip"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("names", metavar="NAME", nargs="+", help=_("the exercises"))
    own_option(parser)

    parser.add_argument(
        "--out",
        type=option_values.pathname,
        required=True,
        metavar="DIR",
        help=_("the folder for students.zip, which has no solutions, and teacher.zip"),
    )

    parser.add_argument(
        "--without-checks",
        action="store_true",
        help=_("give students the programs alone: they cannot check your own exercises"),
    )
    parser.add_argument(
        "--untested",
        action="store_true",
        help=_("pack your own exercises without trying them first"),
    )

    parser.add_argument("-q", "--quiet", action="store_true", help=_("print nothing"))
    language_option(parser, "language of the texts")


def run(options: argparse.Namespace) -> int:
    """Write the two zips; return the exit status."""
    language = options.lang or choose(os.environ)
    shelf = own_shelf(options.exercises)
    found = [shelf.exercise(name) for name in dict.fromkeys(options.names)]
    check_output_folder(options.out)
    if not options.untested:
        _check([each for each in found if each.name in shelf.own], shelf, options, language)

    files = {
        options.out / STUDENTS: zipped(
            for_students(found, shelf, language, checks=not options.without_checks)
        ),
        options.out / TEACHER: zipped(for_teachers(found)),
    }
    write_all(files)
    _ = translator(language, "course")
    if not options.quiet:
        print(_("{file}: for students").format(file=options.out / STUDENTS))
        print(
            _("{file}: yours, with solutions and hidden tests").format(file=options.out / TEACHER)
        )
    return 0


def _check(
    own: Sequence[Exercise], shelf: Shelf, options: argparse.Namespace, language: str
) -> None:
    """Raise InputError for the first thing that is wrong with exercises."""
    total = sum(map(count, own))
    with Grader(shelf=shelf) as grader, Progress(total, options.quiet) as progress:
        for each in own:
            for finding in Rehearsal(each, grader, each.translate.to(language)).all():
                progress.step(each.name)
                if finding.wrong is not None:
                    raise InputError(
                        "{folder}: expected that {tried}, but: {wrong} (`landscape exercise test "
                        "{name}` says all; --untested packs it as it is)",
                        folder=each.folder,
                        tried=finding.tried,
                        wrong=finding.wrong,
                        name=each.name,
                    )
