"""`landscape state`: OpenGL's state at a call of a frame, and what changes between two calls."""

import argparse

from framelens.commands import state
from landscape.commands import frames
from landscape.commands.common import TARGET, frame_of_a_view

EXAMPLE = "fig35e --at castle --diff initial"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    state.add_options(parser, TARGET)
    frame_of_a_view(parser)


def run(options: argparse.Namespace) -> int:
    """Look into the frame of a view or a program; return the exit status."""
    return frames.look(state.show, options)
