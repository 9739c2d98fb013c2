"""`landscape assets sheet`: all assets on one picture."""

import argparse

from framelens.base.output import output_paths, save_png
from framelens.commands import option_values
from landscape.commands.common import assets_option
from landscape.gallery.sheet import contact_sheet

EXAMPLE = "--out sheet.png"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "--out", type=option_values.pathname, metavar="FILE.png|DIR", help="default: sheet.png"
    )
    assets_option(parser)


def run(options: argparse.Namespace) -> int:
    """Draw the sheet; return the exit status."""
    (path,) = output_paths(options.out, ["sheet"])
    save_png(contact_sheet(options.assets), path)
    print(path)
    return 0
