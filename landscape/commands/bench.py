"""The command `landscape bench`: what a frame costs, or with --moving what a walk shows."""

import argparse
import json
from collections.abc import Mapping, Sequence
from typing import Any

from framelens.base.errors import InputError
from framelens.base.output import check_writable, write_whole
from framelens.base.progress import Progress
from framelens.commands import option_values
from landscape.bench import bench
from landscape.commands.changes import given_changes, offscreen_options, tell_of_no_effect
from landscape.commands.common import drawing_options, size_option
from landscape.scene.scene import find_view, scene

EXAMPLE = "fig35a --json out.json"
STILL_SIZE = (800, 600)  # chosen: pixels of a frame that is timed by itself


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "views", nargs="*", metavar="VIEW", help="views or fixes; default: the nine of figure 35"
    )
    parser.add_argument(
        "--json", type=option_values.pathname, metavar="FILE", help="write the results as JSON"
    )
    parser.add_argument(
        "--moving",
        action="store_true",
        help="walk from each view: frames a second, and how far they are from stills",
    )
    size_option(parser, STILL_SIZE, "size of the frames; with --moving 1280x720", fixed=False)
    drawing_options(parser, samples=0)


def run(options: argparse.Namespace) -> int:
    """Measure what is asked for, print it, and write it if a file is given."""
    if options.json is not None:
        check_writable(options.json, "--json ")
    names = options.views or scene().main
    places = [find_view(name) for name in names]
    changes = given_changes(options, *(kind for kind, _ in places))
    result, report = (_moving if options.moving else _standing)(options, names, changes)
    tell_of_no_effect(options, places, changes)
    if options.json is not None:
        write_whole(options.json, (json.dumps(result, indent=1) + "\n").encode())
    if not options.quiet:
        print(report)
    return 0


def _standing(
    options: argparse.Namespace, names: Sequence[str], changes: Mapping[str, object]
) -> tuple[dict[str, Any], str]:
    """Return the costs of single frames, and a table of them."""
    asked = bench.Options(
        views=names,
        size=options.size or STILL_SIZE,
        settings=changes,
        wireframe=options.wireframe,
        **offscreen_options(options),
    )
    with Progress(bench.steps(asked), options.quiet) as progress:
        result = bench.measure(asked, progress.step)
    return result, bench.report(result)


def _moving(
    options: argparse.Namespace, names: Sequence[str], changes: Mapping[str, object]
) -> tuple[dict[str, object], str]:
    """Return what walks from the views show, and a table of it."""
    from landscape.bench import moving as bench_moving
    from landscape.walk.opening import SIZE

    if options.samples:
        raise InputError("--samples: not with --moving, as a walk has one sample per pixel")
    if options.wireframe:
        raise InputError("--wireframe: not with --moving")
    asked = bench_moving.Options(
        views=names,
        size=options.size or SIZE,
        preset=options.preset,
        settings=changes,
        backend=options.backend,
        assets=options.assets,
        only=options.only,
        seed=options.seed,
    )
    with Progress(len(set(names)), options.quiet) as progress:
        result = bench_moving.measure(asked, progress.step)
    return result, bench_moving.report(result)
