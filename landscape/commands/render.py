"""`landscape render`: views drawn to PNG files."""

import argparse
from pathlib import Path

from framelens.base.errors import InputError
from framelens.base.output import output_paths
from framelens.base.progress import Progress
from framelens.commands.common import edits_option
from framelens.commands.reporting import notify
from landscape.commands.changes import given_changes, offscreen_options, tell_of_no_effect
from landscape.commands.common import WORLD, drawing_options, kt_option, pose_option, size_option
from landscape.commands.work import work, work_options
from landscape.frame import Pose
from landscape.scene.scene import SCENES, View, find_view, scene

EXAMPLE = "fig35e --out castle.png"
SCENE = "the scene that --pose is in; default: the island"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("views", nargs="*", metavar="VIEW", help="see `landscape views`")
    pose_option(parser)
    parser.add_argument("--scene", choices=tuple(SCENES), default="", help=SCENE)
    parser.add_argument("--out", type=Path, metavar="FILE.png|DIR", help="default: VIEW.png")
    kt_option(parser)
    parser.add_argument("--world", type=Path, metavar="FILE", help=WORLD)
    edits_option(parser)
    size_option(parser, (800, 600), "size of the pictures")
    work_options(parser)
    drawing_options(parser, samples=4)


def run(options: argparse.Namespace) -> int:
    """Draw the views; return the exit status."""
    from framelens.tape.edit_files import read
    from landscape.commands.render_many import render_all

    views: list[tuple[str, str | Pose]] = [(name, name) for name in options.views]
    places = [find_view(name) for name in options.views]
    if options.pose is not None:
        views.append(("pose", options.pose))
        places.append((scene(options.scene), View("pose", "", options.pose)))
    if not views:
        raise InputError("render: expected a VIEW or --pose; `landscape views` lists the views")

    paths = output_paths(options.out, [name for name, _ in views])
    jobs = [(name, view, path) for (name, view), path in zip(views, paths, strict=True)]
    changes = given_changes(options, *(kind for kind, _ in places))
    arguments = {"size": options.size, "settings": changes, "place": options.scene}
    arguments |= offscreen_options(options) | {"world": options.world}
    edits = read(options.edits) if options.edits else []
    with Progress(len(jobs), options.quiet) as progress:
        with work(options) as (workers, _):
            asked = jobs, arguments, options.kt, options.wireframe, progress.step, edits
            missed = render_all(*asked, workers, options.jobs or 0)

    notify(options, missed)
    tell_of_no_effect(options, places, changes)
    if not options.quiet:
        print("\n".join(map(str, paths)))
    return 0
