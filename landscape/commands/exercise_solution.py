"""`landscape exercise solution`: how an exercise is solved, for teachers."""

import argparse
import sys

from framelens.base.errors import InputError
from framelens.base.texts import marked as _
from framelens.commands import option_values
from framelens.commands.parser import language_option
from landscape.commands.shelves import exercises_option, shelf
from landscape.course.solutions import found, ways, whole

EXAMPLE = "winding"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("name", metavar="NAME", help=_("see `landscape exercise list`"))
    parser.add_argument(
        "--way",
        type=option_values.count,
        default=1,
        metavar="N",
        help=_("which way to solve it, as there are several (default: 1)"),
    )
    exercises_option(parser)
    language_option(parser, "language of the texts")


def run(options: argparse.Namespace) -> int:
    """Print the program that solves an exercise; return the exit status."""
    exercise = shelf(options.exercises).exercise(options.name)
    found(exercise.folder)  # or it says where they are
    files = ways(exercise.folder)
    if not 1 <= options.way <= len(files):
        raise InputError("--way {way}: expected 1 to {last}", way=options.way, last=len(files))
    sys.stdout.write(whole(files[options.way - 1], exercise.folder))
    return 0
