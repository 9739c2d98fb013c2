"""`landscape assets check`: are the assets whole and of the right kind?"""

import argparse

from framelens.commands.common import json_option
from landscape.commands.common import assets_option

EXAMPLE = "--assets mine"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    assets_option(parser)
    json_option(parser)


def run(options: argparse.Namespace) -> int:
    """Check every asset; return the exit status."""
    # The studio needs an extra; the help of this command does not.
    from landscape.studio.asset_check import report

    return report(options.assets, options.json)
