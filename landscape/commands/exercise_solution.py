"""`landscape exercise solution`: how an exercise is solved, for teachers."""

import argparse
import sys

from framelens.base.texts import marked as _
from framelens.commands.parser import language_option
from landscape.commands.shelves import exercises_option, shelf
from landscape.course.shelf import source
from landscape.course.solutions import found

EXAMPLE = "winding"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("name", metavar="NAME", help=_("see `landscape exercise list`"))
    exercises_option(parser)
    language_option(parser, "language of the texts")


def run(options: argparse.Namespace) -> int:
    """Print the program that solves an exercise; return the exit status."""
    exercise = shelf(options.exercises).exercise(options.name)
    sys.stdout.write(source(found(exercise.folder)))
    return 0
