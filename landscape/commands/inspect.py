"""`landscape inspect`: the inspector over a program's window."""

import argparse

from framelens.base.errors import InputError, short
from framelens.commands import common, inspect
from framelens.commands.inspect import EXAMPLE, add_arguments

__all__ = ["EXAMPLE", "add_arguments", "run"]


def run(options: argparse.Namespace) -> int:
    """Open the inspector over a program's window; return the exit status."""
    if not options.target.endswith(".py"):
        walk = "in `landscape walk`, I opens the inspector"
        raise InputError(
            "{target}: expected the path of a .py program; {walk}",
            target=short(options.target),
            walk=walk,
        )
    common.settle_language(options)
    return inspect.show(options)
