"""The option --exercises, of all actions of `landscape exercise`.

Actions for students take the course's exercises without it, those for lecturers the ones in the
current folder.
"""

import argparse
from pathlib import Path

from framelens.base.errors import InputError
from framelens.base.texts import marked as _
from framelens.commands import option_values
from landscape.course.shelf import Shelf


def exercises_option(parser: argparse.ArgumentParser) -> None:
    """Add --exercises."""
    parser.add_argument(
        "--exercises",
        type=option_values.pathname,
        metavar="DIR",
        help=_("a folder with exercises of your own: a folder each"),
    )


def own_option(parser: argparse.ArgumentParser) -> None:
    """Add --exercises, for a lecturer."""
    parser.add_argument(
        "--exercises",
        type=option_values.pathname,
        metavar="DIR",
        help=_("where your own exercises lie, a folder each; default: the current folder"),
    )


def own_shelf(folder: Path | None) -> Shelf:
    """Return the exercises of a folder, by default the current one, and of the course."""
    return Shelf(Path()) if folder is None else shelf(folder)


def shelf(folder: Path | None) -> Shelf:
    """Return the exercises of a folder and of the course; InputError if the folder has none."""
    found = Shelf(folder)
    if folder is not None and not found.own:
        raise InputError(
            "--exercises {folder}: expected a folder with exercises, a folder each; "
            "`landscape exercise new NAME` begins one",
            folder=folder,
        )
    return found
