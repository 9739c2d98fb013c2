"""`landscape pixel`: every draw that covered a pixel, and what became of it."""

import argparse

from framelens.commands import pixel
from landscape.commands import frames
from landscape.commands.common import TARGET, frame_of_a_view

EXAMPLE = "fig35e 400,300"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    pixel.add_options(parser, TARGET)
    frame_of_a_view(parser)


def run(options: argparse.Namespace) -> int:
    """Look into the frame of a view or a program; return the exit status."""
    return frames.look(pixel.show, options)
