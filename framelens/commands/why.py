"""`framelens why`: why a picture is black, or wrong, and what would mend it."""

import argparse

from framelens.commands import common
from framelens.commands.parser import language_option
from framelens.tape.target import Target

EXAMPLE = "program.py 400,300"
WRONG = (
    "a pixel that should look otherwise, from the picture's top left; default: the whole picture"
)


def add_options(parser: argparse.ArgumentParser, target: str) -> None:
    """Add the options of the command, whatever the target, which is explained, may be."""
    common.target_argument(parser, target)
    parser.add_argument("pixel", nargs="?", type=common.pixel, metavar="X,Y", help=WRONG)
    language_option(parser)
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
    """Print why a frame shows what it shows, and what would mend it."""
    from framelens.report import why_report

    answer = why_report.find(target, options.pixel, language=options.lang, quiet=options.quiet)
    lines = why_report.as_text(answer, options.lang)
    return common.print_result(options, answer.as_json(options.lang), lines)
