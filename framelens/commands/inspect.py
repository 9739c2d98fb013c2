"""`framelens inspect`: the inspector over a program's window."""

import argparse

from framelens.commands import common
from framelens.commands.parser import language_option
from framelens.commands.reporting import notify, on_program, own_input

EXAMPLE = "program.py"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "target",
        metavar="FILE.py",
        help="a program that uses PyOpenGL with GLFW, GLUT or pygame; what follows `--` are its "
        "own arguments",
    )
    common.edits_option(parser)
    language_option(parser, "language of the inspector")
    common.quiet_option(parser, "print no notices")


def run(options: argparse.Namespace) -> int:
    """Open the inspector over a program's window; return the exit status."""
    common.check_program(options.target)
    common.settle_language(options)
    return show(options)


def show(options: argparse.Namespace) -> int:
    """Open the inspector over the window of a program that is one."""
    from framelens.inspector import program_inspector

    def work() -> int:
        lines = program_inspector.inspect(
            options.target, options.edits, options.lang, options.arguments, own_input(options)
        )
        notify(options, lines)
        return 0

    return on_program(options.target, work, options)
