"""`landscape why`: why a picture is black, or wrong, and what would mend it."""

import argparse

from framelens.commands import why
from landscape.commands import frames
from landscape.commands.common import TARGET, frame_of_a_view

EXAMPLE = "program.py 400,300"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    why.add_options(parser, TARGET)
    frame_of_a_view(parser)


def run(options: argparse.Namespace) -> int:
    """Look into the frame of a view or a program; return the exit status."""
    return frames.look(why.show, options)
