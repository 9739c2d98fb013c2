"""The command `landscape film`: from its options to a film on the disk."""

import argparse
import os
import sys
from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import replace
from functools import partial
from pathlib import Path

from framelens.base.errors import InputError, Message
from framelens.base.executor import lent_or_own
from framelens.base.output import check_folder
from framelens.base.texts import choose, said
from framelens.commands.option_values import number, pathname, refusal
from framelens.commands.parser import language_option
from framelens.commands.reporting import notify
from landscape.commands.changes import given_changes, tell_of_no_effect
from landscape.commands.common import drawing_options, kt_option, size_option
from landscape.commands.work import work, work_options
from landscape.film.cut import Film
from landscape.film.encode import check, check_format
from landscape.film.folder import Parts, opened
from landscape.film.making import finished, write
from landscape.film.parted import draw, join, status
from landscape.film.rig import ONE, RIGS
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
CAMERA = (
    "stereo: two eyes side by side, each half as wide; 360: all around, equirectangular (--size "
    "twice as wide as high); default: one"
)
PARTS = (
    "draw the film in parts of four seconds, which stay in this folder: whatever cuts it off, the "
    "same command draws what is missing; without --out, only the parts"
)
SHARE = "with --parts: other processes, on other machines with the same folder, draw parts, too"
JOIN = "make the film --out of the parts in a folder"
STATUS = "print which parts a folder has, who works on which, and how long it still takes"
SOUND = "with the sound of the walk (docs/sound.md); a GIF has none"
OUT = "the film: H.264, VP9 or a GIF, by the name's ending (the first two need the extra `film`)"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("views", nargs="*", metavar="VIEW|FILE.svg|RECORDING|tour", help=SOURCES)
    parser.add_argument("--out", type=pathname, metavar="FILE.mp4|.webm|.gif", help=OUT)

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
    work_options(parser, JOBS)

    group = parser.add_argument_group("parts")
    group.add_argument("--parts", type=pathname, metavar="DIR", help=PARTS)
    group.add_argument("--share", action="store_true", help=SHARE)
    group.add_argument("--join", type=pathname, metavar="DIR|FILE.json", help=JOIN)
    group.add_argument("--status", type=pathname, metavar="DIR|FILE.json", help=STATUS)

    parser.add_argument("--camera", choices=RIGS, default=ONE, help=CAMERA)
    parser.add_argument("--sound", action="store_true", help=SOUND)
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
    if options.status is not None:
        return _status(options)
    if options.join is not None:
        return _join(options)
    return _draw(options)


def _status(options: argparse.Namespace) -> int:
    """Print what there is of the films in a folder."""
    _refuse("--status", options, views=options.views, out=options.out, join=options.join)
    for parts in opened(options.status, "--status"):
        for line in status(parts):
            print(said(line, _language(options)))
    return 0


def _join(options: argparse.Namespace) -> int:
    """Join the parts in a folder."""
    _refuse("--join", options, views=options.views, parts=options.parts, sound=options.sound)
    found = opened(options.join, "--join")
    if len(found) > 1:
        names = ", ".join(f"film-{parts.plan.hash}.json" for parts in found)
        raise InputError(
            "--join {folder}: expected one of its files {names}", folder=options.join, names=names
        )
    return _joined(found[0], options)


def _joined(parts: Parts, options: argparse.Namespace) -> int:
    if options.out is None:
        raise InputError("--join: expected --out, too, the name of the film")
    check(options.out, *parts.plan.picture)
    if options.out.suffix.lower() != parts.plan.ending:
        raise InputError(
            "--out {out}: the parts are of a film {ending}",
            out=options.out,
            ending=parts.plan.ending,
        )
    join(parts, options.out)
    return _told(options.out, options)


def _refuse(option: str, options: argparse.Namespace, **others: object) -> None:
    """Raise InputError where something is given that an option does not go with."""
    for name, value in others.items():
        if value:
            what = "VIEW" if name == "views" else f"--{name}"
            raise InputError("{option}: not with {what}", option=option, what=what)


def _draw(options: argparse.Namespace) -> int:
    if not options.views:
        raise InputError("film: expected VIEW, FILE.svg, RECORDING or tour")
    if options.out is None and options.parts is None:
        raise InputError("film: expected --out or --parts")
    if options.share and options.parts is None:
        raise InputError("--share: expected --parts, too, the folder that is shared")
    wanted = _wanted(options)
    found = places(options.views, wanted)
    changes = given_changes(options, *(kind for kind, _ in found))
    wanted = replace(wanted, changes=changes)

    out = _checked_out(options, wanted)
    film = film_of(options.views, wanted)
    with work(options) as (workers, jobs):
        if options.parts is not None:
            status = _draw_parts(film, out.suffix.lower(), workers, jobs, changes, options)
        else:
            status = finished(film, write(film, out, jobs, options.quiet, workers), options)
    if found:
        seen = {key: value for key, value in changes.items() if not key.startswith("sound.")}
        tell_of_no_effect(options, found, seen if options.sound else changes)
    return status


def _checked_out(options: argparse.Namespace, wanted: Wanted) -> Path:
    """Return the film's file; InputError where it, or the folder of its parts, cannot be."""
    # A folder with all parts, which one can only read, will do.
    if options.parts is not None and not options.parts.is_dir():
        check_folder(options.parts, f"--parts {options.parts}")
    out = Path(options.out or options.parts / "film.mp4")
    (check_format if options.out is None else check)(out, options.size, wanted.rate)
    if options.sound and out.suffix.lower() == ".gif":
        raise InputError("--sound: a GIF has none; expected .mp4 or .webm")
    return out


def _wanted(options: argparse.Namespace) -> Wanted:
    """Return what the options ask for, but for changes of settings."""
    drawing = Drawing(
        options.size,
        options.samples,
        options.backend,
        options.assets,
        options.seed,
        rig=options.camera,
    )
    return Wanted(
        drawing,
        fps=options.fps,
        seconds=options.seconds,
        scene=options.scene,
        preset=options.preset,
        only=options.only,
        kt=options.kt,
        wireframe=options.wireframe,
        language=_language(options),
        sound=options.sound,
    )


def _draw_parts(
    film: Film,
    ending: str,
    workers: Executor | None,
    jobs: int,
    changes: Mapping[str, object],
    options: argparse.Namespace,
) -> int:
    """Draw what is missing of a film's parts; join them if a film is asked for."""
    # Films in one folder are told apart by these words.
    preset = [f"--preset {options.preset}"] if options.preset else []
    words = [*options.views, *preset, *(f"{key}={value}" for key, value in changes.items())]

    try:
        parting = draw(
            film,
            options.parts,
            ending,
            partial(lent_or_own, workers, jobs),
            jobs,
            options.share,
            words,
            options.quiet,
        )
    except KeyboardInterrupt:
        line = Message(
            "interrupted: run the same command again, it draws what {folder} lacks",
            folder=options.parts,
        )
        notify(options, [said(line, _language(options))])
        return 130

    if parting.failed:
        lines = [said(line, _language(options)) for line in parting.told()]
        print(*(f"landscape: {line}" for line in lines), sep="\n", file=sys.stderr)
        return 1

    if options.out is None:
        return _told(options.parts, options)
    return _joined(parting.parts, options)


def _told(path: Path, options: argparse.Namespace) -> int:
    if not options.quiet:
        print(path)
    return 0


def _language(options: argparse.Namespace) -> str:
    return options.lang or choose(os.environ)
