"""The command `landscape film`: from its options to a film on the disk."""

import argparse
import os
from pathlib import Path

from framelens.base.texts import choose
from framelens.commands.option_values import jobs, number, refusal
from framelens.commands.parser import language_option
from framelens.system.processes import cores
from landscape.commands.changes import given_changes, tell_of_no_effect
from landscape.commands.common import drawing_options, kt_option, size_option
from landscape.film.encode import check
from landscape.film.making import finished, write
from landscape.film.sources import Wanted, film_of, places
from landscape.film.stage import Drawing
from landscape.scene.scene import SCENES

EXAMPLE = "fig35a fig35e --out flight.mp4 --size 1280x720"
SIZE = (1920, 1080)
FPS = 30.0
MOST_FPS, MOST_SECONDS = 120.0, 3600.0  # chosen

SOURCES = (
    "a view (a moment in it) or several (the camera flies from one to the next), see `landscape "
    "views`; a path drawn in Inkscape, FILE.svg; a walk recorded by `landscape walk --record`; or "
    "`tour`, the trailer of this project"
)
SECONDS = "how long the film is; default: %s"
OWN = "as long as the path, at the speed of a flight; a single view 5, a recording all of it"
JOBS = "processes that draw, each on a core of its own; default: one for each core"
OUT = "the film: H.264, VP9 or a GIF, by the name's ending (the first two need the extra `film`)"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("views", nargs="+", metavar="VIEW|FILE.svg|RECORDING|tour", help=SOURCES)
    parser.add_argument("--out", type=Path, required=True, metavar="FILE.mp4|.webm|.gif", help=OUT)
    parser.add_argument(
        "--fps",
        type=lambda text: _within(number(text), text, 1.0, MOST_FPS),
        default=FPS,
        metavar="N",
        help="frames per second; default: %(default)g",
    )
    parser.add_argument(
        "--seconds",
        type=lambda text: _within(number(text), text, 0.1, MOST_SECONDS),
        metavar="N",
        help=SECONDS % OWN,
    )
    parser.add_argument(
        "--scene",
        choices=(*SCENES, "flyover"),
        default="",
        help="where a path leads; flyover: over its own terrain, without OpenGL; default: island",
    )
    kt_option(parser, "animation time at the beginning")
    parser.add_argument("--jobs", type=jobs, metavar="N", help=JOBS)
    language_option(parser)
    size_option(parser, SIZE, "size of the film")
    drawing_options(parser, samples=4)


def _within(value: float, text: str, low: float, high: float) -> float:
    if not low <= value <= high:
        raise refusal(
            "{text!r}: expected a number from {low:g} to {high:g}", text=text, low=low, high=high
        )
    return value


def run(options: argparse.Namespace) -> int:
    """Draw a film; return the exit status. Raises InputError and NoOpenGLError."""
    drawing = Drawing(options.size, options.samples, options.backend, options.assets, options.seed)
    wanted = Wanted(
        drawing,
        fps=options.fps,
        seconds=options.seconds,
        scene=options.scene,
        preset=options.preset,
        only=options.only,
        kt=options.kt,
        wireframe=options.wireframe,
        language=options.lang or choose(os.environ),
    )

    found = places(options.views, wanted)
    changes = given_changes(options, *(kind for kind, _ in found))
    wanted = Wanted(**{**vars(wanted), "changes": changes})

    check(options.out, options.size, wanted.rate)
    film = film_of(options.views, wanted)
    kept = write(film, options.out, options.jobs or cores(), options.quiet)
    if found:
        tell_of_no_effect(options, found, changes)
    return finished(film, kept, options)
