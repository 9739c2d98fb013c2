"""The options of `landscape flyover`."""

import argparse
from collections.abc import Callable
from pathlib import Path

from framelens.commands.option_values import count, jobs, number, pair, size
from landscape.flyover.environment import ISLAND, NAMES
from landscape.flyover.settings import BEST, MOST_PROCESSES

SIZE = 1024, 768  # chosen: the size at which its speed is stated
EXPORT = "export"
FILE = (
    "an environment drawn in Inkscape, FILE.svg, a folder that --export wrote, or one that comes "
    f"with the program: {', '.join(NAMES)}; default: {ISLAND}. `{EXPORT} FILE.svg` writes the "
    "island as an environment, to be changed in Inkscape"
)
OUT = (
    "draw it without a screen: a folder for one PNG per frame, FILE.png for a single frame, or a "
    "film, FILE.mp4, .webm or .gif"
)
FRAMES = (
    "how many frames; default: of a flight that is drawn to files, all from --at on; of --bench "
    "12; in the window, until it is closed"
)
FPS = "frames per second of flight; default: %(default)g"
FOLDER = (
    "write the environment as plain files for other programs into a folder, heights.bmp, "
    "heights.png, path.json and flight.csv, which is read again in the place of FILE.svg"
)
PROFILE = "fly along the path and print in which functions the time goes"
RANK = "print results of --bench --json ranked by frames a second, for each environment"
BENCH = "fly the path without each technique, with each alone and with all; print how long it took"
JOBS = (
    "processes that draw, each on a core of its own; default: one for each core, up to "
    f"{MOST_PROCESSES}; the picture is the same"
)
AT = "seconds of the flight at which it begins; default: %(default)g"
PRESET = "best, or document: black lines on white as the project asks for; default: best"


def add(
    command: Callable[[str, str, str], argparse.ArgumentParser],
    language: Callable[[argparse.ArgumentParser, str], None],
) -> None:
    """Add `landscape flyover`; ``language`` adds --lang."""
    flyover = command(
        "flyover", "fly over a terrain, drawn without OpenGL", "alps --set flyover.mode=filled"
    )
    flyover.add_argument("file", nargs="?", default=ISLAND, metavar="FILE.svg|NAME", help=FILE)
    flyover.add_argument("export", nargs="?", default="", help=argparse.SUPPRESS)
    flyover.add_argument("--size", type=size, metavar="WxH", help=f"default: {SIZE[0]}x{SIZE[1]}")
    flyover.add_argument("--frames", type=count, metavar="N", help=FRAMES)
    flyover.add_argument("--fps", type=number, default=30.0, metavar="N", help=FPS)
    flyover.add_argument("--at", type=number, default=0.0, metavar="SECONDS", help=AT)
    flyover.add_argument("--out", type=Path, metavar="DIR|FILE", help=OUT)
    flyover.add_argument("--jobs", type=jobs, metavar="N", help=JOBS)
    flyover.add_argument("--bench", action="store_true", help=BENCH)
    flyover.add_argument(
        "--json", type=Path, metavar="FILE", help="with --bench: write the results as JSON"
    )
    flyover.add_argument("--profile", action="store_true", help=PROFILE)
    flyover.add_argument("--rank", type=Path, nargs="+", metavar="FILE.json", help=RANK)
    flyover.add_argument("--export", type=Path, dest="folder", metavar="DIR", help=FOLDER)
    flyover.add_argument("--fullscreen", action="store_true", help="fill the screen, as F11 does")
    flyover.add_argument("--preset", default=BEST, metavar="best|document", help=PRESET)
    flyover.add_argument(
        "--set",
        action="append",
        type=pair,
        default=[],
        metavar="KEY=VALUE",
        dest="changes",
        help="change a setting, as in flyover.mode=filled; may be repeated; `landscape settings "
        "flyover` lists the keys and their values",
    )
    flyover.add_argument(
        "--settings",
        type=Path,
        metavar="FILE.toml",
        help="a file of settings, as in [flyover] detail = false; --set overrides it",
    )
    language(flyover, "language of the window")
    flyover.add_argument(
        "-q", "--quiet", action="store_true", help="print neither progress nor file names"
    )
