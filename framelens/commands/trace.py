"""`framelens trace`: the OpenGL calls of a frame, or how they differ from those of another."""

import argparse
from collections.abc import Callable
from functools import partial

from framelens.base.errors import InputError
from framelens.commands import common, option_values
from framelens.commands.reporting import on_program
from framelens.gl.seam import Call
from framelens.report import trace_diff, trace_text
from framelens.tape.tape import Tape
from framelens.tape.target import Target
from framelens.why.walk import without_trace

EXAMPLE = "program.py --frame 3"
PASS_NAMES = (
    "setup",
    "shadow",
    "reflection",
    "refraction",
    "main",
    "picture",
    "water",
    "overlay",
)
PASSES = (
    "only the calls of one pass: setup, reflection, main or overlay; of the voxel island also "
    "shadow, refraction or water, of the great hall picture; default: all"
)


def add_options(parser: argparse.ArgumentParser, target: str) -> None:
    """Add the options of the command, whatever the target, which is explained, may be."""
    common.target_argument(parser, target)
    parser.add_argument("--pass", dest="pass_", choices=PASS_NAMES, metavar="NAME", help=PASSES)
    parser.add_argument(
        "--diff", metavar="TARGET2", help="print which calls come, go or change in another target"
    )
    parser.add_argument(
        "--diff-edits", type=option_values.pathname, metavar="FILE", help="the same for these edits"
    )
    common.json_option(parser)
    common.frame_options(parser)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_options(parser, common.PROGRAM)
    common.backend_option(parser)
    parser.add_argument(
        "--element", metavar="NAME", help="only the calls of one function; default: all"
    )
    common.quiet_option(parser, "print neither progress nor notices")


def run(options: argparse.Namespace) -> int:
    """Trace one program, or compare two; return the exit status."""
    if not options.diff and not options.diff_edits:
        return common.on_one_program(show, options)
    changed = argparse.Namespace(**vars(options))
    changed.target = options.diff or options.target
    changed.edits = options.diff_edits or options.edits
    for target in (options.target, changed.target):
        common.check_program(target)

    frame = common.program_frame(options)
    other = common.program_frame(changed)
    programs = " and ".join(dict.fromkeys((frame.name, other.name)))
    return on_program(programs, partial(show, frame, options, other), options)


def show(target: Target, options: argparse.Namespace, other: Target | None = None) -> int:
    """Print the calls of a frame, or how they differ from those of an ``other``."""
    if options.element:
        target.check_element(options.element)

    idle: set[str] = set()
    calls = _reader(target, options, idle)
    first = target.look(calls)
    if other is None:
        text = trace_text.as_text(first, idle=idle)
        return common.print_result(options, [call.as_json() for call in first], text)
    second = other.look(calls)
    difference = trace_diff.difference(first, second)
    return common.print_result(options, difference.as_json(), trace_diff.as_text(difference))


def _reader(
    target: Target, options: argparse.Namespace, idle: set[str]
) -> Callable[[Tape], list[Call]]:
    """Return the function that reads the chosen calls from a tape.

    It adds to ``idle`` the functions of a program that left no trace, where those are printed.
    """

    def calls(tape: Tape) -> list[Call]:
        if target.is_program and not options.json:
            idle.update(without_trace(tape))
        names = dict.fromkeys(name for call in tape.calls for name in call.shared_by)
        if options.element and target.is_program and options.element not in names:
            raise InputError(
                "--element {element!r}: expected one of {names}",
                element=options.element,
                names=", ".join(names),
            )
        return trace_text.chosen(tape.calls, options.element, options.pass_)

    return calls
