"""`landscape strip`: how a frame grows, step by step, as a sheet, an animation or a page."""

import argparse

from framelens.commands import strip
from landscape.commands import frames
from landscape.commands.common import TARGET, frame_of_a_view

EXAMPLE = "fig35e --by element --buffers color,depth --out castle.html"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    strip.add_options(parser, TARGET)
    frame_of_a_view(parser)


def run(options: argparse.Namespace) -> int:
    """Look into the frame of a view or a program; return the exit status."""
    return frames.look(strip.show, options)
