"""`landscape assets build`: the assets, made from code."""

import argparse

from framelens.commands import option_values
from framelens.commands.common import quiet_option
from landscape.commands.common import QUIET
from landscape.commands.work import work, work_options

EXAMPLE = "water.png --assets mine"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("names", nargs="*", metavar="NAME", help="file names; default: all")
    parser.add_argument(
        "--assets",
        type=option_values.pathname,
        metavar="DIR",
        help="where to write them; default: in place",
    )
    work_options(parser)
    quiet_option(parser, QUIET)


def run(options: argparse.Namespace) -> int:
    """Make assets; return the exit status."""
    # The studio needs an extra; the help of this command does not.
    from landscape.studio.build import build

    with work(options) as (workers, _):
        return build(options.names, options.assets, options.quiet, workers, options.jobs or 0)
