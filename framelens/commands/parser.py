"""The parser of the command line, and the options that many commands share."""

import argparse
import re
from collections.abc import Callable
from typing import Any

from framelens.base import arguments
from framelens.base.errors import InputError
from framelens.base.texts import LANGUAGES
from framelens.commands import option_values


class Parser(argparse.ArgumentParser):
    """A parser whose errors are an InputError of one line."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        # Text that begins like this is a value, never an option: a pose may be -1,2,3,0,0.
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def error(self, message: str) -> Any:
        """Report the error in one line, as for all bad input."""
        raise InputError(f"{message} (see `{self.prog} --help`)")


def print_help(parser: argparse.ArgumentParser) -> Callable[[argparse.Namespace], int]:
    """Return what a command does that is given without its own command: print the help."""

    def show(_: argparse.Namespace) -> int:
        parser.print_help()
        return 0

    return show


def language_option(
    parser: argparse.ArgumentParser, what: str = "language of the captions"
) -> None:
    parser.add_argument(
        "--lang",
        choices=LANGUAGES,
        default="",
        help=f"{what}; default: by LANGUAGE, LC_ALL, LC_MESSAGES or LANG",
    )


def backend_option(parser: Any) -> None:
    """Add --backend."""
    parser.add_argument(
        "--backend",
        type=option_values.backend,
        default="auto",
        metavar="|".join(arguments.BACKENDS),
        help="how OpenGL is opened; default: %(default)s, the first that works",
    )
