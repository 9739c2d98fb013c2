"""`landscape assets fetch-stanford`: the meshes of the report, from where they are kept."""

import argparse
from pathlib import Path

from framelens.commands import option_values
from framelens.commands.common import quiet_option
from landscape.commands.common import QUIET
from landscape.files.stanford import fetch

EXAMPLE = "--out stanford"
DESCRIPTION = (
    "Download the Stanford bunny and dragon, check them, and say how to use them. Terms: "
    "acknowledge the Stanford Computer Graphics Laboratory; no commercial use without "
    "permission."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "--out",
        type=option_values.pathname,
        default=Path("stanford"),
        metavar="DIR",
        help="default: %(default)s",
    )
    quiet_option(parser, QUIET)


def run(options: argparse.Namespace) -> int:
    """Download the meshes, and print how to use them; return the exit status."""
    rabbit, dragon = fetch(options.out, quiet=options.quiet)
    print(f"landscape walk --set rabbit.mesh={rabbit} --set dragon.mesh={dragon}")
    return 0
