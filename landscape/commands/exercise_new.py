"""`landscape exercise new`: an exercise of a lecturer's own, to begin with."""

import argparse
import os
from pathlib import Path

from framelens.base.errors import InputError
from framelens.base.output import check_folder, write_all
from framelens.base.texts import choose, translator
from framelens.base.texts import marked as _
from framelens.commands.parser import language_option
from landscape.commands.shelves import own_option
from landscape.course.own_exercise import new

EXAMPLE = "clock_hand"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "name", metavar="NAME", help=_("its name: letters, digits and _, such as clock_hand")
    )
    own_option(parser)
    parser.add_argument("-q", "--quiet", action="store_true", help=_("print nothing"))
    language_option(parser, "language of the texts")


def run(options: argparse.Namespace) -> int:
    """Write the exercise into a folder that is not there yet; return the exit status."""
    language = options.lang or choose(os.environ)
    files = new(options.name, language)
    folder = (options.exercises or Path()) / options.name
    if os.path.lexists(folder):
        raise InputError("{path}: is there already; expected the name of a new one", path=folder)
    check_folder(folder, str(folder))
    write_all({folder / name: text.encode() for name, text in files.items()})
    _ = translator(language, "course")
    if not options.quiet:
        print(folder / "README.md")
        print(_("It says what each file of the exercise is. Try it as it is:"))
        print(f"landscape exercise test {options.name}{within(options.exercises)}")
    return 0


def within(exercises: Path | None) -> str:
    """Return the option by which a command finds the exercise again; "" without one."""
    return f" --exercises {exercises}" if exercises is not None else ""
