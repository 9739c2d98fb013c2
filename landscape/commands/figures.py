"""`landscape figures`: the report's figures, drawn again, compared or replaced."""

import argparse
from pathlib import Path

import landscape
from framelens.base.errors import InputError
from framelens.commands import option_values
from landscape.commands.changes import given_changes, offscreen_options
from landscape.commands.common import drawing_options
from landscape.commands.work import work, work_options
from landscape.scene.scene import SCENES, scene

EXAMPLE = "35 --out figures"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "names",
        nargs="*",
        metavar="FIG",
        help="35, fig35a, R6; hall, voxel or flyover; or a picture or pair of these three pages",
    )
    parser.add_argument(
        "--out",
        type=option_values.pathname,
        default=Path("figures"),
        metavar="DIR",
        help="default: %(default)s",
    )
    parser.add_argument("--check", action="store_true", help="compare with the committed pictures")
    parser.add_argument("--update", action="store_true", help="replace the committed pictures")
    parser.add_argument(
        "--pages", action="store_true", help="replace the pages that show them, and no picture"
    )
    work_options(parser, "processes that draw; default: 1")
    drawing_options(
        parser, samples=4, preset="the figures of the report are always drawn with 2006"
    )


def run(options: argparse.Namespace) -> int:
    """Draw the figures, compare or replace them; return the exit status."""
    from landscape.gallery import figures

    # The gallery is part of the checkout; without one, look in the current folder.
    gallery = Path(landscape.__file__).resolve().parents[1] / "screenshots"
    if not gallery.is_dir():
        gallery = Path("screenshots")
    changes = given_changes(options, *map(scene, SCENES))
    drawing = {**offscreen_options(options), "settings": changes}
    del drawing["preset"]

    if options.pages:
        figures.update_pages(options.names, gallery)
        return 0
    if options.check and not gallery.is_dir():
        raise InputError(
            "figures --check: the committed pictures are not installed with the program: "
            "expected a checkout, or its folder screenshots in the current folder"
        )
    with work(options) as (executor, jobs):
        workers = figures.Workers(executor, options.jobs or (jobs if executor else 1))
        asked = drawing, options.quiet, workers
        if options.update:
            figures.update(options.names, gallery, *asked)
            return 0
        if options.check:
            return figures.check(options.names, gallery, options.out, *asked)
        paths = figures.make(options.names, options.out, *asked)
    if not options.quiet:
        print(*paths, sep="\n")
    return 0
