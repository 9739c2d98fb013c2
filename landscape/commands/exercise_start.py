"""`landscape exercise start`: the program of an exercise, with its task and a hole to fill."""

import argparse
import os
from pathlib import Path

from framelens.base.errors import InputError
from framelens.base.output import check_folder, write_whole
from framelens.base.texts import choose, translator
from framelens.base.texts import marked as _
from framelens.commands import option_values
from framelens.commands.parser import language_option
from framelens.system import quoted
from landscape.commands.shelves import exercises_option, shelf
from landscape.course.shelf import start

EXAMPLE = "winding --out mine.py"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("name", metavar="NAME", help=_("see `landscape exercise list`"))
    parser.add_argument(
        "--out",
        type=option_values.pathname,
        metavar="FILE|DIR",
        help=_("a file that is not there yet; default: NAME.py"),
    )
    parser.add_argument("-q", "--quiet", action="store_true", help=_("print nothing"))
    exercises_option(parser)
    language_option(parser, "language of the texts")


def run(options: argparse.Namespace) -> int:
    """Write the program, in a file that is not there yet; return the exit status."""
    language = options.lang or choose(os.environ)
    found = shelf(options.exercises).exercise(options.name)
    path = options.out or Path(f"{found.name}.py")
    if path.is_dir():
        path = path / f"{found.name}.py"
    if os.path.lexists(path):
        raise InputError(
            "{path}: is there already; expected --out with the name of a new file", path=path
        )
    check_folder(path.parent, f"--out {path}" if options.out else str(path))
    write_whole(path, start(found, language).encode())
    _ = translator(language, "course")
    if not options.quiet:
        print(path)
        file = quoted(str(path))
        print(_("The task stands at the top of it. Run it: python {file}").format(file=file))
        print(_("Check it: landscape exercise check {file}").format(file=file))
    return 0
