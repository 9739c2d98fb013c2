"""`framelens state`: OpenGL's state at a call of a frame, and what changes between two calls."""

import argparse

from framelens.commands import common
from framelens.report import state_report
from framelens.tape.target import Target

EXAMPLE = "program.py --at display --diff initial"
AT = (
    "the state in which this call is made: its number in the trace, such as 812, or 812.3 for a "
    "call of a display list; or +12, counted from the frame's beginning; or the name of an element "
    "for its first call; default: the state after the frame"
)
DIFF = (
    "print what differs from --at (default: from the frame's beginning) to this call; an element "
    "without --at: what it leaves changed; initial: what --at differs in from a new context"
)


def add_options(parser: argparse.ArgumentParser, target: str) -> None:
    """Add the options of the command, whatever the target, which is explained, may be."""
    common.target_argument(parser, target)
    parser.add_argument("--at", default="", metavar="CALL|ELEMENT", help=AT)
    parser.add_argument("--diff", default="", metavar="CALL|ELEMENT|initial", help=DIFF)
    common.json_option(parser)
    common.frame_options(parser)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_options(parser, common.PROGRAM)
    common.drawing_options(parser)


def run(options: argparse.Namespace) -> int:
    """Look into the frame of a program; return the exit status."""
    return common.on_one_program(show, options)


def show(target: Target, options: argparse.Namespace) -> int:
    """Print the state at a call, what differs between two calls, or what an element leaks."""
    report = target.look(lambda tape: state_report.report(tape, options.at, options.diff))
    return common.print_result(options, report.as_json(), report.as_text())
