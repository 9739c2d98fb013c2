"""The options of the command line, and how their values are read."""

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from framelens.base import arguments
from framelens.commands import frame_options, option_values
from framelens.commands.parser import Parser, backend_option, language_option, print_help
from landscape import __version__
from landscape.commands import course_help, course_options, film_options
from landscape.course.language import told_in
from landscape.flyover.app import options as flyover_options
from landscape.frame import checked_pose
from landscape.scene.scene import SCENES, SEED, scene
from landscape.walk.pace import FPS

Commands = Mapping[str, Callable[[argparse.Namespace], int]]

POSE = "where the eye is; angles in degrees; Y may be `ground`: eye height above the ground"
ALONG = (
    "begin with a flight along the path drawn in this file (docs/environments.md); or along that "
    "of island, alps or canyon"
)
KT = "animation time; default: the view's own"
SCENE = "the scene that --pose is in; default: the island"
JSON = "print JSON"
OWN_FILES = "a folder of your own images and meshes, used first; default: only the shipped ones"
PLACES = "the file to write, which the setting transparent.places reads"
QUIET = "print neither progress, notices nor file names"

BY_VIEW = (
    "best or 2006; default: the view's own (see `landscape views`), which is best, or 2006 where "
    "the view shows one technique or flaw of the report"
)

TARGET = (
    "a view or a fix (see `landscape views`), or the path of a .py program that uses PyOpenGL; "
    "what follows `--` are the program's own arguments"
)
FRAME_EXAMPLES = {
    "trace": "fig35f --element fog",
    "pixel": "fig35e 400,300",
    "state": "fig35e --at castle --diff initial",
    "strip": "fig35e --by element --buffers color,depth --out castle.html",
    "why": "program.py 400,300",
}

BEGIN = (
    "where the walk begins: a view, a fix such as R12, or a scene; default: fig35e. A view of one "
    "technique, flaw or fix is walked as it is drawn, with its preset, settings, elements and "
    "wireframe"
)

WORLD = "for voxel: a file of changed blocks"

REPLAY = "replay a recorded walk; `tour` is the one that comes with the program"


def _pose(text: str) -> Any:
    """Return the pose that an option gives."""
    parts = tuple(arguments.real(part.strip()) for part in text.split(","))
    if len(parts) != 5:
        raise argparse.ArgumentTypeError(f"{text!r}: expected X,Y,Z,YAW,PITCH")
    return option_values.checked(checked_pose, text, parts)


def parse(argv: Sequence[str] | None, commands: Commands) -> argparse.Namespace:
    """Parse the command line; views may come before, between and after the options.

    ``commands`` maps each command's name to the function that runs it.
    """
    words = list(sys.argv[1:] if argv is None else argv)
    language = course_help.language(words)
    with told_in(language):
        parser = build_parser(commands, language)
        words, given = frame_options.parted(words)
        options, rest = parser.parse_known_args(words)
        options.arguments = given
        if rest:
            # argparse itself takes only the views before the first option.
            if "views" not in options or any(word.startswith("-") for word in rest):
                parser.error(f"unrecognized arguments: {' '.join(rest)}")
            options.views = [*options.views, *rest]
    return options


class _Elements:
    """The names of the first scene's elements in a help text; read only when that is printed."""

    def __str__(self) -> str:
        return ", ".join(scene().elements)


def _explain(option: Any, text: str) -> None:
    """Give an option a help text in which %(elements)s stands for the names of the elements.

    Afterwards, because from Python 3.14 on argparse expands the text with which an option is added.
    """
    option.elements, option.help = _Elements(), text


def build_parser(run: Commands, language: str = "en") -> argparse.ArgumentParser:
    """Return the parser of all commands; without a command it prints the help.

    ``language``: of the help of the course's commands; the others' is English.
    """
    parser = Parser(
        prog="landscape",
        description="The landscape of the 2006 report, in fixed-function OpenGL.",
        epilog="example: landscape render fig35e --size 1600x900",
    )
    parser.add_argument("--version", action="version", version=f"landscape {__version__}")
    parser.set_defaults(run=print_help(parser))
    commands = parser.add_subparsers(metavar="COMMAND", parser_class=Parser)

    def command(name: str, help_: str, example: str, below: Any = commands) -> Any:
        sub = below.add_parser(
            name.split()[-1],
            help=help_,
            description=help_,
            epilog=f"example: landscape {name} {example}".rstrip(),
        )
        sub.set_defaults(run=run[name])
        return sub

    def group(name: str, help_: str, example: str) -> Any:
        sub = commands.add_parser(
            name, help=help_, description=help_, epilog=f"example: landscape {example}"
        )
        sub.set_defaults(run=print_help(sub))
        return sub.add_subparsers(metavar="ACTION", parser_class=Parser)

    walk = command("walk", "walk a scene in a window", "fig35a --fullscreen")
    walk.add_argument("view", nargs="?", default="", metavar="VIEW", help=BEGIN)
    walk.add_argument("--pose", type=_pose, metavar="X,Y,Z,YAW,PITCH", help=POSE)
    walk.add_argument(
        "--kt", type=option_values.number, metavar="N", help=f"at the beginning: {KT}"
    )
    walk.add_argument(
        "--size",
        type=option_values.size,
        metavar="WxH",
        help="default: 1280x720, larger on a fine display; in a replay the recorded sizes",
    )
    walk.add_argument("--fullscreen", action="store_true", help="fill the screen, as F11 does")
    language_option(walk, "language of the window")
    frame_options.edits_option(walk)
    walk.add_argument("--world", type=Path, metavar="FILE", help=f"{WORLD}, loaded and saved")
    walk.add_argument("--record", type=Path, metavar="FILE", help="record the walk")
    walk.add_argument("--replay", type=Path, metavar="FILE", help=REPLAY)
    walk.add_argument("--path", metavar="FILE.svg", help=ALONG)
    walk.add_argument(
        "--fps",
        type=option_values.rate,
        default=FPS,
        metavar="N",
        help="frames per second to keep, by drawing less detail if need be; 0: draw all of it; "
        "default: %(default)g",
    )
    walk.add_argument(
        "--frames",
        type=option_values.count,
        metavar="N",
        help="end after N frames; default: when the window is closed",
    )
    _common(
        walk,
        samples=0,
        preset="best or 2006; default: the view's own. With another one, the walk takes only the "
        "place from the view",
    )

    render = command("render", "render views to PNG files", "fig35e --out castle.png")
    render.add_argument("views", nargs="*", metavar="VIEW", help="see `landscape views`")
    render.add_argument("--pose", type=_pose, metavar="X,Y,Z,YAW,PITCH", help=POSE)
    render.add_argument("--scene", choices=tuple(SCENES), default="", help=SCENE)
    render.add_argument("--out", type=Path, metavar="FILE.png|DIR", help="default: VIEW.png")
    render.add_argument("--kt", type=option_values.number, metavar="N", help=KT)
    render.add_argument("--world", type=Path, metavar="FILE", help=WORLD)
    frame_options.edits_option(render)
    _size_option(render, (800, 600), "size of the pictures")
    _common(render, samples=4)

    views = command("views", "list the named views and the fixes", "--json")
    views.add_argument("--json", action="store_true", help=JSON)

    figures = command("figures", "draw the report's figures", "35 --out figures")
    figures.add_argument(
        "names", nargs="*", metavar="FIG", help="35, fig35a, R6, hall, voxel or flyover"
    )
    figures.add_argument(
        "--out", type=Path, default=Path("figures"), metavar="DIR", help="default: %(default)s"
    )
    figures.add_argument("--check", action="store_true", help="compare with the committed pictures")
    figures.add_argument("--update", action="store_true", help="replace the committed pictures")
    _common(figures, samples=4, preset="the figures of the report are always drawn with 2006")

    count = option_values.count
    size = option_values.size
    frame_options.add(command, _of_a_frame, TARGET, FRAME_EXAMPLES)
    frame_options.add_inspect(command)
    flyover_options.add(command, language_option)
    course_options.add(command, group, language_option, backend_option, size, count)
    if language != "en":
        course_help.put(commands, language)

    actions = group("assets", "make, show or fetch assets", "assets fetch-stanford")
    build = command(
        "assets build",
        "make assets from code (needs the extra `studio`)",
        "water.png --assets mine",
        actions,
    )
    build.add_argument("names", nargs="*", metavar="NAME", help="file names; default: all")
    build.add_argument(
        "--assets", type=Path, metavar="DIR", help="where to write them; default: in place"
    )
    build.add_argument("-q", "--quiet", action="store_true", help=QUIET)
    check = command(
        "assets check", "check every asset: seams, edges, sizes, meshes", "--assets mine", actions
    )
    check.add_argument("--assets", type=Path, metavar="DIR", help=OWN_FILES)
    check.add_argument("--json", action="store_true", help=JSON)
    sheet = command("assets sheet", "one contact sheet of all assets", "--out sheet.png", actions)
    sheet.add_argument("--out", type=Path, metavar="FILE.png|DIR", help="default: sheet.png")
    sheet.add_argument("--assets", type=Path, metavar="DIR", help=OWN_FILES)
    fetch = command(
        "assets fetch-stanford",
        "download the Stanford bunny and dragon",
        "--out stanford",
        actions,
    )
    fetch.description = (
        "Download the Stanford bunny and dragon, check them, and say how to use them. Terms: "
        "acknowledge the Stanford Computer Graphics Laboratory; no commercial use without "
        "permission."
    )
    fetch.add_argument(
        "--out", type=Path, default=Path("stanford"), metavar="DIR", help="default: %(default)s"
    )
    fetch.add_argument("-q", "--quiet", action="store_true", help=QUIET)

    places = command(
        "places", "save where trees, deer and plants stand to a file", "mine.csv --preset 2006"
    )
    places.add_argument("file", type=Path, metavar="FILE.csv", help=PLACES)
    _common(places, samples=0, preset="best or 2006; default: best")

    bench = command("bench", "measure frames, grass and startup", "fig35a --json out.json")
    bench.add_argument(
        "views", nargs="*", metavar="VIEW", help="views or fixes; default: the nine of figure 35"
    )
    bench.add_argument("--json", type=Path, metavar="FILE", help="write the results as JSON")
    bench.add_argument(
        "--moving",
        action="store_true",
        help="walk from each view: frames a second, and how far they are from stills",
    )
    _size_option(bench, (800, 600), "size of the frames; with --moving 1280x720")
    bench.set_defaults(size=None)
    _common(bench, samples=0)

    film_options.add(command, _common, language_option, _size_option, option_values.number)

    values = command("settings", "list the settings: all, or some", "fog --preset 2006")
    values.add_argument(
        "word",
        nargs="?",
        default="",
        metavar="GROUP|WORD",
        help="a group such as fog, part of a key, or a word of what a setting does; default: all",
    )
    values.add_argument("--json", action="store_true", help=JSON)
    _common(values, samples=0, preset="best or 2006; default: best")

    doctor = command("doctor", "report which OpenGL backends work here", "--json")
    doctor.add_argument("--json", action="store_true", help=JSON)
    return parser


def _size_option(parser: argparse.ArgumentParser, size: tuple[int, int], what: str) -> None:
    parser.add_argument(
        "--size",
        type=option_values.size,
        default=size,
        metavar="WxH",
        help=f"{what} in pixels; default: {size[0]}x{size[1]}",
    )


def _of_a_frame(name: str, parser: argparse.ArgumentParser) -> None:
    """Add the options of a command that draws a frame to look into it."""
    if name == "trace":
        _of_a_trace(parser)
    _size_option(parser, (800, 600), "for a view: size of the frame")
    parser.set_defaults(size=None)
    _common(parser, samples=0)


def _of_a_trace(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--diff-set",
        action="append",
        type=option_values.pair,
        default=[],
        metavar="KEY=VALUE",
        help="print which calls come, go or change with this setting; may be repeated",
    )
    parser.add_argument("--diff-preset", metavar="best|2006", help="the same for another preset")
    element = parser.add_argument("--element", metavar="NAME")
    _explain(element, "only the calls of one element: %(elements)s or frame; default: all")


def _common(parser: argparse.ArgumentParser, samples: int, preset: str = BY_VIEW) -> None:
    """Add the options that all drawing commands share; ``preset`` is the help of --preset."""
    group = parser.add_argument_group("common options")
    backend_option(group)
    add = group.add_argument
    add("--preset", metavar="best|2006", help=preset)
    add(
        "--set",
        action="append",
        type=option_values.pair,
        default=[],
        metavar="KEY=VALUE",
        dest="changes",
        help="change a setting, as in fog.density=0.05; may be repeated; `landscape settings` "
        "lists the keys and their values",
    )
    add(
        "--settings",
        type=Path,
        metavar="FILE.toml",
        help="a file of settings, as in [fog] density = 0.05; --set overrides it",
    )
    add("--assets", type=Path, metavar="DIR", help=OWN_FILES)
    only = add("--only", type=option_values.elements, metavar="ELEMENT,...")
    _explain(only, "draw only some elements of %(elements)s; default: those of the view")
    add("--wireframe", action="store_true", help="draw lines instead of faces")
    add(
        "--samples",
        type=option_values.samples,
        default=samples,
        metavar="0|4",
        help="samples per pixel against aliasing; default: %(default)s",
    )
    add(
        "--seed",
        type=option_values.count,
        default=SEED,
        metavar="N",
        help="seed of everything random; default: %(default)s",
    )
    add("-q", "--quiet", action="store_true", help=QUIET)
