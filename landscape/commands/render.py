"""`landscape render`: views drawn to PNG files."""

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from framelens.base import arguments
from framelens.base.errors import InputError
from framelens.base.output import output_paths, write_all
from framelens.base.progress import Progress
from framelens.commands.common import edits_option
from framelens.commands.option_values import pathname, refusal
from framelens.commands.reporting import notify
from landscape.commands.changes import given_changes, offscreen_options, tell_of_no_effect
from landscape.commands.common import WORLD, drawing_options, kt_option, pose_option, size_option
from landscape.commands.work import work, work_options
from landscape.frame import Pose
from landscape.passes import files, passes
from landscape.poster import MOST, TILE, draw
from landscape.scene.scene import SCENES, Scene, View, find_view, scene

if TYPE_CHECKING:
    from landscape.commands.render_many import Job

EXAMPLE = "fig35e --out castle.png"
POSTER = (
    "in place of --size, for huge pictures: drawn in tiles, without map and sword, by --jobs "
    "processes or an engine"
)
PASSES = (
    "write NAME.depth.png, too, linear in 16 bits, white at the far plane, and a mask "
    "NAME.ELEMENT.png of each element that is seen; both without antialiasing"
)
SCENE = "the scene that --pose is in; default: the island"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("views", nargs="*", metavar="VIEW", help="see `landscape views`")
    pose_option(parser)
    parser.add_argument("--scene", choices=tuple(SCENES), default="", help=SCENE)
    parser.add_argument("--out", type=pathname, metavar="FILE.png|DIR", help="default: VIEW.png")
    kt_option(parser)
    parser.add_argument("--world", type=pathname, metavar="FILE", help=WORLD)
    edits_option(parser)
    size_option(parser, (800, 600), "size of the pictures")
    parser.add_argument("--passes", action="store_true", help=PASSES)
    parser.add_argument("--poster", type=_poster, metavar="WxH", help=POSTER)
    work_options(parser)
    drawing_options(parser, samples=4)


def run(options: argparse.Namespace) -> int:
    """Draw the views; return the exit status."""
    from framelens.tape.edit_files import read
    from landscape.commands.render_many import render_all

    jobs, places = _jobs(options)
    paths = [path for *_, path in jobs]
    changes = given_changes(options, *(kind for kind, _ in places))
    given = {"size": options.size, "settings": changes, "place": options.scene}
    given |= offscreen_options(options) | {"world": options.world}
    edits = read(options.edits) if options.edits else []
    if options.poster is not None:
        return _draw_posters(jobs, given, options)
    with Progress(len(jobs), options.quiet) as progress:
        with work(options) as (workers, _):
            asked = jobs, given, options.kt, options.wireframe, progress.step, edits
            missed = render_all(*asked, workers, options.jobs or 0)

    if options.passes:
        for job in jobs:
            paths += _write_passes(job, given, options)
    notify(options, missed)
    tell_of_no_effect(options, places, changes)
    if not options.quiet:
        print("\n".join(map(str, paths)))
    return 0


def _jobs(options: argparse.Namespace) -> "tuple[list[Job], list[tuple[Scene, View]]]":
    """Return the views and the pose that are drawn, each with its name and file; and their scenes.

    InputError where there is none.
    """
    views: list[tuple[str, str | Pose]] = [(name, name) for name in options.views]
    places = [find_view(name) for name in options.views]
    if options.pose is not None:
        views.append(("pose", options.pose))
        places.append((scene(options.scene), View("pose", "", options.pose)))
    if not views:
        raise InputError("render: expected a VIEW or --pose; `landscape views` lists the views")
    paths = output_paths(options.out, [name for name, _ in views])
    return [(*view, path) for view, path in zip(views, paths, strict=True)], places


def _write_passes(job: "Job", given: dict[str, object], options: argparse.Namespace) -> list[Path]:
    """Write a view's depths and masks beside its picture; return their files."""
    _, view, picture = job
    beside = files(picture, *passes(view, given, options.kt, options.wireframe))
    write_all(beside)
    return list(beside)


def _poster(text: str) -> tuple[int, int]:
    """Return the size that --poster gives."""
    sides = [arguments.digits(side) for side in text.lower().split("x")]
    sizes = [side for side in sides if isinstance(side, int) and 0 < side <= MOST]
    if len(sides) != 2 or len(sizes) != 2:
        raise refusal(
            "{text!r}: expected WxH, each from 1 to {most}, such as 16384x8192",
            text=text,
            most=MOST,
        )
    return sizes[0], sizes[1]


def _draw_posters(
    wanted: "Sequence[Job]",
    given: dict[str, object],
    options: argparse.Namespace,
) -> int:
    """Draw each view as a poster; return the exit status."""
    for option, value in (
        ("--edits", options.edits),
        ("--world", options.world),
        ("--passes", options.passes),
    ):
        if value:
            raise InputError("--poster: not with {what}", what=option)
    tiles = [-(-side // tile) for side, tile in zip(options.poster, TILE, strict=True)]
    with (
        Progress(len(wanted) * tiles[0] * tiles[1], options.quiet) as progress,
        work(options) as (workers, count),
    ):
        for _, view, path in wanted:
            asked = options.kt, options.wireframe, TILE, progress.step, workers
            draw(view, options.poster, path, given, *asked, jobs=count)
    if not options.quiet:
        print(*(path for *_, path in wanted), sep="\n")
    return 0
