"""Options shared by the commands that look into a frame, and how these commands end."""

import argparse
import json
import os
from collections.abc import Callable, Iterable
from functools import partial
from typing import TYPE_CHECKING, TypeAlias

from framelens.base.errors import InputError, short
from framelens.base.texts import choose
from framelens.commands import option_values
from framelens.commands.option_values import refusal
from framelens.commands.parser import backend_option
from framelens.commands.reporting import notify, on_program, own_input

if TYPE_CHECKING:
    from framelens.program.program_frame import ProgramFrame
    from framelens.tape.target import Target

PROGRAM = (
    "the path of a .py program that uses PyOpenGL; what follows `--` are the program's own "
    "arguments"
)
FRAME = "for a program: the frame to look into, from 0; default: %(default)s"
EVENTS = "for a program: timed keys and mouse moves (see docs/frame.md)"
LIMIT = (
    "for a program: seconds of the processor that it may take to its frame; default: 15 (see "
    "docs/programs.md)"
)
EDITS = "change single OpenGL calls as this file says"

Show: TypeAlias = "Callable[[Target, argparse.Namespace], int]"
"""Looks into a frame as the options say, prints what it sees, and returns the exit status."""


def target_argument(parser: argparse.ArgumentParser, target: str) -> None:
    """Add what is looked into, which ``target`` explains, and --edits."""
    parser.add_argument("target", metavar="TARGET", help=target)
    edits_option(parser)


def edits_option(parser: argparse.ArgumentParser) -> None:
    """Add --edits."""
    parser.add_argument("--edits", type=option_values.pathname, metavar="FILE", help=EDITS)


def json_option(parser: argparse.ArgumentParser) -> None:
    """Add --json."""
    parser.add_argument("--json", action="store_true", help="print JSON")


def frame_options(parser: argparse.ArgumentParser) -> None:
    """Add which frame of a program it is, and how the program gets there."""
    parser.add_argument("--frame", type=option_values.count, default=0, metavar="N", help=FRAME)
    parser.add_argument("--events", type=option_values.pathname, metavar="FILE", help=EVENTS)
    parser.add_argument("--limit", type=option_values.seconds, metavar="SECONDS", help=LIMIT)


def drawing_options(parser: argparse.ArgumentParser) -> None:
    """Add how a program is drawn, where nothing but programs is looked into."""
    backend_option(parser)
    quiet_option(parser, "print neither progress nor notices")


def quiet_option(parser: argparse.ArgumentParser, what: str) -> None:
    """Add --quiet."""
    parser.add_argument("-q", "--quiet", action="store_true", help=what)


def pixel(text: str) -> tuple[int, int]:
    """Return the pixel that the text of an option names."""
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 2 or not all(part.isascii() and part.isdigit() for part in parts):
        raise refusal("{text!r}: expected X,Y such as 400,300", text=text)
    return int(parts[0][:9]), int(parts[1][:9])


def settle_language(options: argparse.Namespace) -> None:
    """Take the language from the environment where a command has --lang and none was given."""
    if "lang" in options:
        options.lang = options.lang or choose(os.environ)


def on_one_program(show: Show, options: argparse.Namespace) -> int:
    """Look into the frame of the program that the options name."""
    check_program(options.target)
    settle_language(options)
    frame = program_frame(options)
    return on_program(options.target, partial(show, frame, options), options)


def check_program(target: str) -> None:
    """Raise InputError if a target is not the path of a program."""
    if not target.endswith(".py"):
        raise InputError("{target}: expected the path of a .py program", target=short(target))


def program_frame(options: argparse.Namespace) -> "ProgramFrame":
    """Return the frame of a program that the options of a command name."""
    from framelens.program.program_frame import ProgramFrame

    return ProgramFrame(
        options.target,
        backend=options.backend,
        edits=options.edits,
        frame=options.frame,
        events=options.events,
        arguments=options.arguments,
        stdin=own_input(options),
        limit=options.limit,
        tell=partial(notify, options),
    )


def print_result(options: argparse.Namespace, result: object, lines: Iterable[str]) -> int:
    """Print a result as JSON where that is asked for, else as lines; return the exit status."""
    print(json.dumps(result, indent=1) if options.json else "\n".join(lines))
    return 0
