"""The command line of framelens: the commands that look into a frame of a program."""

import argparse
import sys
from collections.abc import Callable, Sequence
from functools import partial

from framelens import __version__
from framelens.base.errors import InputError, short
from framelens.commands import frame_options
from framelens.commands.parser import Parser, backend_option, print_help
from framelens.commands.reporting import on_program, run_command


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; return its exit status."""
    return run_command(argv, parse)


def parse(argv: Sequence[str] | None) -> argparse.Namespace:
    """Parse the command line; without a command it prints the help."""
    words, given = frame_options.parted(list(sys.argv[1:] if argv is None else argv))
    options = build_parser().parse_args(words)
    options.arguments = given
    return options


def build_parser() -> argparse.ArgumentParser:
    """Return the parser of all commands."""
    parser = Parser(
        prog="framelens",
        description="Looks into one frame of any PyOpenGL program.",
        epilog="example: framelens pixel program.py 400,300",
    )
    parser.add_argument("--version", action="version", version=f"framelens {__version__}")
    parser.set_defaults(run=print_help(parser))
    commands = parser.add_subparsers(metavar="COMMAND", parser_class=Parser)

    def command(name: str, help_: str, example: str) -> argparse.ArgumentParser:
        sub = commands.add_parser(
            name,
            help=help_,
            description=help_,
            epilog=f"example: framelens {name} {example}",
        )
        sub.set_defaults(run=_look(name))
        return sub

    frame_options.add(command, _own_options)
    frame_options.add_inspect(command)
    return parser


def _own_options(name: str, parser: argparse.ArgumentParser) -> None:
    """Add the options that are not the same for whoever uses these commands."""
    backend_option(parser)
    if name == "trace":
        parser.add_argument(
            "--element", metavar="NAME", help="only the calls of one function; default: all"
        )
    parser.add_argument(
        "-q", "--quiet", action="store_true", help="print neither progress nor notices"
    )


def _look(name: str) -> Callable[[argparse.Namespace], int]:
    """Return the function of a command; what it needs is imported when it runs."""

    def run(options: argparse.Namespace) -> int:
        from framelens.commands import frame_commands

        _check(options.target)
        frame_commands.settle_language(options)
        if name == "inspect":
            return frame_commands.inspect(options)
        if name == "trace" and (options.diff or options.diff_edits):
            return _compare(options)
        target = frame_commands.program_frame(options)
        return on_program(
            options.target, partial(frame_commands.RUN[name], target, options), options
        )

    return run


def _compare(options: argparse.Namespace) -> int:
    """Print how a frame's calls differ from those of another program, or of other edits."""
    from framelens.commands import frame_commands

    changed = argparse.Namespace(**vars(options))
    changed.target = options.diff or options.target
    changed.edits = options.diff_edits or options.edits
    _check(changed.target)
    target = frame_commands.program_frame(options)
    other = frame_commands.program_frame(changed)
    programs = " and ".join(dict.fromkeys((target.name, other.name)))
    return on_program(programs, lambda: frame_commands.trace(target, options, other), options)


def _check(target: str) -> None:
    if not target.endswith(".py"):
        raise InputError(f"{short(target)}: expected the path of a .py program")
