"""`landscape inspect`: the inspector over a program's window."""

import argparse

from framelens.base.errors import InputError, short
from framelens.commands import common, inspect
from framelens.commands.inspect import EXAMPLE, add_arguments

__all__ = ["EXAMPLE", "add_arguments", "run"]


def run(options: argparse.Namespace) -> int:
    """Open the inspector over a program's window; return the exit status."""
    if not options.target.endswith(".py"):
        raise InputError(
            "{target}: expected the path of a .py program; in `landscape walk`, I opens the "
            "inspector",
            target=short(options.target),
        )
    common.settle_language(options)
    return inspect.show(options)
