"""`landscape settings`: every setting, or some, with values, defaults and sources."""

import argparse
import json

from framelens.commands.common import json_option
from landscape.commands.changes import given_changes
from landscape.commands.common import drawing_options
from landscape.commands.settings_list import as_text, rows
from landscape.scene.scene import SCENES, scene

EXAMPLE = "fog --preset 2006"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "word",
        nargs="?",
        default="",
        metavar="GROUP|WORD",
        help="a group such as fog, part of a key, or a word of what a setting does; default: all",
    )
    json_option(parser)
    drawing_options(parser, samples=0, preset="best or 2006; default: best")


def run(options: argparse.Namespace) -> int:
    """List the settings; return the exit status."""
    listed = rows(options.preset, given_changes(options, *map(scene, SCENES)), options.word)
    print(json.dumps(listed, indent=1) if options.json else "\n".join(as_text(listed)))
    return 0
