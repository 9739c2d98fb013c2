"""`landscape flyover`: flies over a terrain without OpenGL, in pictures or in a table of times."""

import argparse
import json
import os
import sys
from pathlib import Path

from framelens.base.errors import InputError
from framelens.base.output import check_writable, output_paths, save_png, write_whole
from framelens.base.progress import Progress
from framelens.base.texts import choose, said
from framelens.commands import option_values
from framelens.commands.common import quiet_option
from framelens.commands.parser import language_option
from framelens.commands.reporting import notify
from landscape import __version__
from landscape.commands.common import settings_options
from landscape.flyover import crew, exchange
from landscape.flyover.app import SIZE
from landscape.flyover.app import ranking as flyover_ranking
from landscape.flyover.crew import Crew
from landscape.flyover.environment import (
    ISLAND,
    NAMES,
    Environment,
    export_island,
    open_environment,
)
from landscape.flyover.settings import BEST, MOST_PROCESSES, PRESETS, Settings, check
from landscape.settings.declare import preset, read_toml, with_settings

FASTEST = 1000.0  # frames per second, chosen
MOST_FRAMES = 100_000  # chosen: almost an hour at 30 frames per second
FILMS = (".mp4", ".webm", ".gif")
SEVERAL = 8  # pictures, chosen: fewer are drawn before another process is ready

FRESH = "in the window, without the preferences that F2 in a walk changes and keeps"

EXAMPLE = "alps --set flyover.mode=filled"
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


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("file", nargs="?", default=ISLAND, metavar="FILE.svg|NAME", help=FILE)
    parser.add_argument("export", nargs="?", default="", help=argparse.SUPPRESS)
    parser.add_argument(
        "--size", type=option_values.size, metavar="WxH", help=f"default: {SIZE[0]}x{SIZE[1]}"
    )
    parser.add_argument("--frames", type=option_values.count, metavar="N", help=FRAMES)
    parser.add_argument("--fps", type=option_values.number, default=30.0, metavar="N", help=FPS)
    parser.add_argument("--at", type=option_values.number, default=0.0, metavar="SECONDS", help=AT)
    parser.add_argument("--out", type=option_values.pathname, metavar="DIR|FILE", help=OUT)
    parser.add_argument("--jobs", type=option_values.jobs, metavar="N", help=JOBS)
    _instead_of_the_window(parser)

    parser.add_argument("--fullscreen", action="store_true", help="fill the screen, as F11 does")
    parser.add_argument("--fresh", action="store_true", help=FRESH)
    parser.add_argument("--preset", default=BEST, metavar="best|document", help=PRESET)
    settings_options(
        parser,
        "[flyover] detail = false",
        "flyover.mode=filled",
        "landscape settings flyover",
    )
    language_option(parser, "language of the window")
    quiet_option(parser, "print neither progress nor file names")


def _instead_of_the_window(parser: argparse.ArgumentParser) -> None:
    """Add the options that measure, or write an environment as files."""
    parser.add_argument("--bench", action="store_true", help=BENCH)
    parser.add_argument(
        "--json",
        type=option_values.pathname,
        metavar="FILE",
        help="with --bench: write the results as JSON",
    )
    parser.add_argument("--profile", action="store_true", help=PROFILE)
    parser.add_argument(
        "--rank", type=option_values.pathname, nargs="+", metavar="FILE.json", help=RANK
    )
    parser.add_argument(
        "--export", type=option_values.pathname, dest="folder", metavar="DIR", help=FOLDER
    )


def run(options: argparse.Namespace) -> int:
    """Do what the command line asks; return the exit status. Raises InputError."""
    if options.rank:
        print(flyover_ranking.ranking([flyover_ranking.read(path) for path in options.rank]))
        return 0
    if options.file == EXPORT:
        return export(options)
    _check(options)
    values = settings_of(options)
    environment = _environment(options, values)

    if options.bench:
        return bench(environment, values, options)
    if options.profile:
        return profile(environment, values, options)
    if options.folder is not None:
        written = exchange.write(environment, values.flyover, options.folder, options.fps)
        if not options.quiet:
            print(*written, sep="\n")
        return 0
    if options.out is None:
        return _show(environment, values, options)
    if options.out.suffix.lower() in FILMS:
        from landscape.flyover.app import film

        return film.run(environment, values, options)
    return draw(environment, values, options)


def _check(options: argparse.Namespace) -> None:
    """Raise InputError for options that do not go together, and values that cannot be."""
    if options.export:
        raise InputError(
            "flyover {file} {export}: expected one environment",
            file=options.file,
            export=options.export,
        )
    if not 0 < options.fps <= FASTEST:
        raise InputError(
            "--fps {fps:g}: expected a number above 0, up to {fastest:g}",
            fps=options.fps,
            fastest=FASTEST,
        )
    if options.at < 0:
        raise InputError("--at {at:g}: expected seconds from 0", at=options.at)

    if options.bench and options.at:
        raise InputError("--at: not with --bench, which flies the whole path")
    if options.json is not None and not options.bench:
        raise InputError("--json: expected --bench, whose results it writes")
    if options.bench and options.out is not None:
        raise InputError("--out: not with --bench, which keeps no pictures")
    alone = [name for name in ("bench", "profile", "folder") if getattr(options, name)]
    if len(alone) > 1:
        raise InputError("flyover: expected one of --bench, --profile and --export")


def _environment(options: argparse.Namespace, values: Settings) -> Environment:
    """Return the environment that is flown over; InputError where --at is after its flight."""
    any_size = bool(values.flyover.resolution)
    if Path(options.file).is_dir():
        environment = exchange.read(Path(options.file), any_size)
    else:
        environment = open_environment(options.file, any_size)

    for line in () if options.quiet else environment.notices:
        print(f"landscape: {line}", file=sys.stderr)
    duration = environment.duration(values.flyover)
    if options.at >= duration:
        raise InputError(
            "--at {at:g}: expected less than the {duration:.1f} seconds of the flight",
            at=options.at,
            duration=duration,
        )
    return environment


def _show(environment: Environment, values: Settings, options: argparse.Namespace) -> int:
    """Fly in a window, by the user's preferences; return the exit status."""
    from landscape.flyover.app import window
    from landscape.walk import preferences
    from landscape.walk.preferences import Preferences

    wishes, wrong = preferences.read() if not options.fresh else (Preferences(), [])
    language = options.lang or wishes.language or choose(os.environ)
    notify(options, [said(message, language) for message in wrong])
    return window.show(environment, values, options, wishes)


def settings_of(options: argparse.Namespace) -> Settings:
    """Return the settings of --preset, --settings and --set, each overriding the one before."""
    changes = read_toml(options.settings) if options.settings else {}
    values = preset(Settings(), PRESETS, options.preset)
    values = with_settings(values, changes | dict(options.changes))
    check(values)
    return values


def export(options: argparse.Namespace) -> int:
    """Write the island as an environment."""
    if not options.export:
        raise InputError("flyover export: expected the name of the file to write, such as mine.svg")
    if options.bench or options.out is not None or options.frames is not None:
        raise InputError("flyover export: expected neither --bench nor --out nor --frames")
    if options.folder is not None:
        raise InputError("flyover export: writes the island; expected no --export")
    path = Path(options.export)
    export_island(path)
    if not options.quiet:
        print(path)
    return 0


def _count(duration: float, options: argparse.Namespace) -> int:
    """Return how many frames of a flight of ``duration`` seconds are drawn."""
    whole = max(round((duration - options.at) * options.fps), 1)
    count = min(whole, MOST_FRAMES) if options.frames is None else options.frames
    single = options.out.suffix.lower() == ".png"
    if options.frames is None and single:
        count = 1
    if not 1 <= count <= MOST_FRAMES:
        raise InputError(
            "--frames {count}: expected a number from 1 to {most_frames}",
            count=count,
            most_frames=MOST_FRAMES,
        )
    return count


def draw(environment: Environment, values: Settings, options: argparse.Namespace) -> int:
    """Draw the flight's frames, each from its own time alone, to PNG files."""
    size = options.size or SIZE
    terrain = environment.field(values.flyover)
    flight = environment.flight(terrain, values.flyover)
    count = _count(flight.duration, options)
    paths = output_paths(options.out, [f"frame-{number:05}" for number in range(count)])
    jobs = crew.processes(options.jobs) if count >= SEVERAL else 1
    with Crew(terrain, jobs) as drawing, Progress(count, options.quiet) as progress:
        for number, path in enumerate(paths):
            camera = flight.camera(options.at + number / options.fps)
            save_png(drawing.draw(camera, values, size).picture, path)
            progress.step(path.name)

    if not options.quiet:
        print(*paths, sep="\n")
    return 0


def profile(environment: Environment, values: Settings, options: argparse.Namespace) -> int:
    """Print where the time of a flight goes."""
    from landscape.flyover.app import profile as flyover_profile

    count = _frames(options)
    with Progress(count, options.quiet) as progress:
        text = flyover_profile.profile(
            environment, values, options.size or SIZE, count, progress.step
        )
    print(text)
    return 0


def bench(environment: Environment, values: Settings, options: argparse.Namespace) -> int:
    """Measure every technique along the path; print a table, or write it as JSON, too."""
    from landscape.flyover.app import bench as flyover_bench

    if options.json is not None:
        check_writable(options.json, "--json ")
    count = _frames(options)
    rows, jobs = flyover_bench.rows(values), crew.processes(options.jobs)
    with Progress(len(rows) * count, options.quiet) as progress:
        result = flyover_bench.measure(
            environment, rows, options.size or SIZE, count, jobs, progress.step, __version__
        )
    if options.json is not None:
        write_whole(options.json, (json.dumps(result, indent=1) + "\n").encode())
    if not options.quiet:
        print(flyover_bench.report(result))
    return 0


def _frames(options: argparse.Namespace) -> int:
    """Return how many frames are measured."""
    from landscape.flyover.app import bench as flyover_bench

    count: int = flyover_bench.FRAMES if options.frames is None else options.frames
    if not 1 <= count <= MOST_FRAMES:
        raise InputError(
            "--frames {count}: expected a number from 1 to {most_frames}",
            count=count,
            most_frames=MOST_FRAMES,
        )
    return count
