"""`framelens pixel`: every draw that covered a pixel, and what became of it."""

import argparse

from framelens.commands import common
from framelens.report import pixel_report
from framelens.tape.pixel import Row, history
from framelens.tape.tape import Tape
from framelens.tape.target import Target
from framelens.why.walk import unseen_draws

EXAMPLE = "program.py 400,300"


def add_options(parser: argparse.ArgumentParser, target: str) -> None:
    """Add the options of the command, whatever the target, which is explained, may be."""
    common.target_argument(parser, target)
    parser.add_argument(
        "pixel", type=common.pixel, metavar="X,Y", help="in pixels from the picture's top left"
    )
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
    """Print what happened to a pixel."""

    def look(tape: Tape) -> tuple[list[Row], list[int] | None, list[str]]:
        rows = history(tape, *options.pixel)
        x, y = options.pixel
        before = None
        if tape.before is not None:
            before = [int(value) for value in tape.before.color[tape.size[1] - 1 - y, x, :3]]
        unseen = [] if options.json or not target.is_program else unseen_draws(tape)
        return rows, before, unseen

    rows, before, unseen = target.look(look)
    text = pixel_report.as_text(rows, before, unseen)
    return common.print_result(options, [row.as_json() for row in rows], text)
