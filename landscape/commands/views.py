"""`landscape views`: the named views and the fixes."""

import argparse
import json
import os

from framelens.base.texts import choose, translator
from framelens.commands.common import json_option
from landscape.scene.scene import listed_views

EXAMPLE = "--json"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    json_option(parser)


def run(options: argparse.Namespace) -> int:
    """List the views; return the exit status."""
    views = listed_views()
    if options.json:
        print(json.dumps(views, indent=1))
        return 0
    _ = translator(choose(os.environ), "gallery", "fixes")
    wide = max(len(view["name"]) for view in views)
    for view in views:
        shows = _(view["shows"], view["name"])
        print(f"{view['name']:{wide}} {view['scene']:6} {view['preset']:4} {shows}")
    return 0
