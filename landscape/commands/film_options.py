"""The options of `landscape film`."""

import argparse
from collections.abc import Callable
from pathlib import Path

from framelens.commands.option_values import jobs
from landscape.scene.scene import SCENES

SIZE, FPS = (1920, 1080), 30.0
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


def add(
    command: Callable[[str, str, str], argparse.ArgumentParser],
    common: Callable[..., None],
    language: Callable[[argparse.ArgumentParser], None],
    size: Callable[[argparse.ArgumentParser, tuple[int, int], str], None],
    number: Callable[[str], float],
) -> None:
    """Add `landscape film`; the other arguments add common options or read a number."""
    film = command("film", "draw a film", "fig35a fig35e --out flight.mp4 --size 1280x720")
    film.add_argument("views", nargs="+", metavar="VIEW|FILE.svg|RECORDING|tour", help=SOURCES)
    film.add_argument("--out", type=Path, required=True, metavar="FILE.mp4|.webm|.gif", help=OUT)
    film.add_argument(
        "--fps",
        type=lambda text: _within(number(text), text, 1.0, MOST_FPS),
        default=FPS,
        metavar="N",
        help="frames per second; default: %(default)g",
    )
    film.add_argument(
        "--seconds",
        type=lambda text: _within(number(text), text, 0.1, MOST_SECONDS),
        metavar="N",
        help=SECONDS % OWN,
    )
    film.add_argument(
        "--scene",
        choices=(*SCENES, "flyover"),
        default="",
        help="where a path leads; flyover: over its own terrain, without OpenGL; default: island",
    )
    film.add_argument("--kt", type=number, metavar="N", help="animation time at the beginning")
    film.add_argument("--jobs", type=jobs, metavar="N", help=JOBS)
    language(film)
    size(film, SIZE, "size of the film")
    common(film, samples=4)


def _within(value: float, text: str, low: float, high: float) -> float:
    if not low <= value <= high:
        raise argparse.ArgumentTypeError(f"{text!r}: expected a number from {low:g} to {high:g}")
    return value
