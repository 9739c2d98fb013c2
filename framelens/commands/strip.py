"""`framelens strip`: how a frame grows, step by step, as a sheet, an animation or a page."""

import argparse

from framelens.commands import common
from framelens.commands.option_values import pathname, refusal
from framelens.commands.parser import language_option
from framelens.tape.strip import BUFFERS, GROUPINGS
from framelens.tape.target import Target

EXAMPLE = "program.py --by draw --buffers color,depth --out strip.html"


def add_options(parser: argparse.ArgumentParser, target: str) -> None:
    """Add the options of the command, whatever the target, which is explained, may be."""
    common.target_argument(parser, target)

    parser.add_argument(
        "--by",
        choices=GROUPINGS,
        default="element",
        help="what makes a step: a pass, an element, or every draw call; default: %(default)s",
    )
    parser.add_argument(
        "--buffers",
        type=_buffers,
        default=BUFFERS[:1],
        metavar=",".join(BUFFERS),
        help="what to show of each step: colours; depth, as distance; stencil values; overdraw, "
        "as layers of fragments; default: color",
    )
    parser.add_argument(
        "--out",
        type=pathname,
        metavar="FILE.png|.gif|.html",
        help="a sheet, an animation, or a page that lists the calls, too; default: "
        "TARGET-strip.png",
    )

    language_option(parser)
    common.frame_options(parser)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_options(parser, common.PROGRAM)
    common.drawing_options(parser)


def run(options: argparse.Namespace) -> int:
    """Look into the frame of a program; return the exit status."""
    return common.on_one_program(show, options)


def show(target: Target, options: argparse.Namespace) -> int:
    """Write how the frame grows, and print the file's name."""
    from framelens.report import strip as strips

    out = strips.checked_out(options.out, target.name)
    request = strips.Request(options.by, options.buffers, options.lang, options.quiet)
    strips.make(target, request, out)
    if not options.quiet:
        print(out)
    return 0


def _buffers(text: str) -> tuple[str, ...]:
    names = tuple(dict.fromkeys(part.strip() for part in text.split(",")))
    for name in names:
        if name not in BUFFERS:
            raise refusal("{name!r}: expected some of {names}", name=name, names=", ".join(BUFFERS))
    return names
