"""The option --exercises, of all actions of `landscape exercise`."""

import argparse
from pathlib import Path

from framelens.base.errors import InputError
from framelens.base.texts import marked as _
from landscape.course.shelf import Shelf


def exercises_option(parser: argparse.ArgumentParser) -> None:
    """Add --exercises."""
    parser.add_argument(
        "--exercises",
        type=Path,
        metavar="DIR",
        help=_("a folder with exercises of your own: a folder each"),
    )


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
