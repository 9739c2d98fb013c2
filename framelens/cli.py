"""The command line of framelens: the commands that look into a frame of a program.

Each command is a module of :mod:`framelens.commands`, imported when it is asked for.
"""

import argparse
import sys
from collections.abc import Sequence

from framelens import __version__
from framelens.commands.parser import Parser, add_commands, parted
from framelens.commands.reporting import run_command

COMMANDS = {
    "trace": "print the OpenGL calls of a frame",
    "pixel": "print what happened to a pixel: every draw that covered it",
    "state": "print OpenGL's state at a call of a frame",
    "strip": "show how a frame grows, step by step: a sheet, an animation or a page",
    "why": "find out why a picture is black, or wrong, and name the cause",
    "inspect": "open the inspector over a program's window (F12)",
}
"""The commands by name, with what their help says that they do."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; return its exit status."""
    return run_command(argv, parse)


def parse(argv: Sequence[str] | None) -> argparse.Namespace:
    """Parse the command line; without a command it prints the help."""
    words, arguments = parted(list(sys.argv[1:] if argv is None else argv), COMMANDS)
    options = build_parser(words[:1]).parse_args(words)
    options.arguments = arguments
    return options


def build_parser(asked: Sequence[str] | None = None) -> argparse.ArgumentParser:
    """Return the parser; with ``asked``, only the command of that name has its options."""
    parser = Parser(
        prog="framelens",
        description="Looks into one frame of any PyOpenGL program.",
        epilog="example: framelens pixel program.py 400,300",
    )
    parser.add_argument("--version", action="version", version=f"framelens {__version__}")
    add_commands(parser, COMMANDS, "framelens.commands", asked)
    return parser
