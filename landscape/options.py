"""The options of the command line, and how their values are read."""

import argparse
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from landscape import arguments
from landscape.errors import InputError
from landscape.scene import SEED
from landscape.window.pace import FPS

Commands = Mapping[str, Callable[[argparse.Namespace], int]]

BY_VIEW = (
    "best or 2006; default: the view's own (see `landscape views`), which is best, or 2006 where "
    "the view shows one technique or flaw of the report"
)

BEGIN = (
    "where the walk begins: a view, a fix such as R12, or a scene; default: fig35e. A view of one "
    "technique, flaw or fix is walked as it is drawn, with its preset, settings, elements and "
    "wireframe"
)


def parse(argv: Sequence[str] | None, commands: Commands) -> argparse.Namespace:
    """Parse the command line; views may come before, between and after the options.

    ``commands`` maps each command's name to the function that runs it.
    """
    parser = build_parser(commands)
    options, rest = parser.parse_known_args(argv)
    if rest:
        # argparse itself takes only the views before the first option.
        if "views" not in options or any(word.startswith("-") for word in rest):
            parser.error(f"unrecognized arguments: {' '.join(rest)}")
        options.views = [*options.views, *rest]
    return options


class _Parser(argparse.ArgumentParser):
    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        # Text that begins like this is a value, never an option: a pose may be -1,2,3,0,0.
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def error(self, message: str) -> Any:
        """Report the error in one line, as for all bad input."""
        raise InputError(f"{message} (see `{self.prog} --help`)")


def build_parser(run: Commands) -> argparse.ArgumentParser:
    """Return the parser of all commands."""
    parser = _Parser(
        prog="landscape",
        description="The landscape of the 2006 report, in fixed-function OpenGL.",
        epilog="example: landscape render fig35e --size 1600x900",
    )
    commands = parser.add_subparsers(metavar="COMMAND", required=True, parser_class=_Parser)

    def command(name: str, help_: str, example: str) -> Any:
        sub = commands.add_parser(
            name, help=help_, description=help_, epilog=f"example: landscape {name} {example}"
        )
        sub.set_defaults(run=run[name])
        return sub

    walk = command("walk", "walk a scene in a window", "fig35a --fullscreen")
    walk.add_argument("view", nargs="?", default="", metavar="VIEW", help=BEGIN)
    walk.add_argument("--pose", type=_pose, metavar="X,Y,Z,YAW,PITCH", help="Y may be `ground`")
    walk.add_argument("--kt", type=_number, metavar="N", help="animation time at the beginning")
    walk.add_argument(
        "--size",
        type=_size,
        metavar="WxH",
        help="default: 1280x720, larger on a display of high resolution; in a replay the recorded "
        "sizes",
    )
    walk.add_argument("--fullscreen", action="store_true")
    walk.add_argument("--record", type=Path, metavar="FILE", help="record the walk")
    walk.add_argument("--replay", type=Path, metavar="FILE", help="replay a recorded walk")
    walk.add_argument(
        "--fps",
        type=_rate,
        default=FPS,
        metavar="N",
        help="frames per second to keep, by drawing less detail if need be; 0: draw all of it "
        "(default: %(default)g)",
    )
    walk.add_argument("--frames", type=_count, metavar="N", help="end after N frames")
    _common(
        walk,
        samples=0,
        preset="best or 2006; default: the view's own. With another one, the walk takes only the "
        "place from the view",
    )

    render = command("render", "render views to PNG files", "fig35e --out castle.png")
    render.add_argument(
        "views", nargs="*", metavar="VIEW", help="views or fixes; see `landscape views`"
    )
    render.add_argument("--pose", type=_pose, metavar="X,Y,Z,YAW,PITCH", help="Y may be `ground`")
    render.add_argument("--out", type=Path, metavar="FILE.png|DIR", help="default: VIEW.png")
    render.add_argument("--kt", type=_number, metavar="N", help="animation time")
    render.add_argument("--size", type=_size, default=(800, 600), metavar="WxH")
    _common(render, samples=4)

    views = command("views", "list the named views", "--json")
    views.add_argument("--json", action="store_true")

    figures = command("figures", "draw the report's figures", "35 --out figures")
    figures.add_argument("names", nargs="*", metavar="FIG", help="35, fig35a or R6; default: all")
    figures.add_argument("--out", type=Path, default=Path("figures"), metavar="DIR")
    figures.add_argument("--check", action="store_true", help="compare with the committed pictures")
    figures.add_argument("--update", action="store_true", help="replace the committed pictures")
    _common(figures, samples=4, preset="the figures of the report are always drawn with 2006")

    trace = command("trace", "print the OpenGL calls of a frame", "fig35f --element fog")
    trace.add_argument("view", metavar="VIEW")
    trace.add_argument("--element", metavar="NAME", help="only the calls of one element")
    trace.add_argument("--json", action="store_true")
    _common(trace, samples=0)

    assets = commands.add_parser(
        "assets",
        help="make, show or fetch assets",
        description="make, show or fetch assets",
        epilog="example: landscape assets fetch-stanford",
    )
    actions = assets.add_subparsers(metavar="ACTION", required=True, parser_class=_Parser)
    build = actions.add_parser(
        "build",
        help="make assets from code (needs the extra `studio`)",
        epilog="example: landscape assets build water.png --assets mine",
    )
    build.add_argument("names", nargs="*", metavar="NAME", help="file names; default: all")
    build.add_argument("--assets", type=Path, metavar="DIR", help="default: in place")
    build.add_argument("-q", "--quiet", action="store_true")
    build.set_defaults(run=run["assets build"])
    check = actions.add_parser(
        "check",
        help="check every asset: seams, edges, sizes, meshes",
        epilog="example: landscape assets check --assets mine",
    )
    check.add_argument("--assets", type=Path, metavar="DIR", help="your own files, used first")
    check.add_argument("--json", action="store_true")
    check.set_defaults(run=run["assets check"])
    sheet = actions.add_parser(
        "sheet",
        help="one contact sheet of all assets",
        epilog="example: landscape assets sheet --out sheet.png",
    )
    sheet.add_argument("--out", type=Path, metavar="FILE.png|DIR", help="default: sheet.png")
    sheet.add_argument("--assets", type=Path, metavar="DIR")
    sheet.set_defaults(run=run["assets sheet"])
    fetch = actions.add_parser(
        "fetch-stanford",
        help="download the Stanford bunny and dragon",
        description="Download the Stanford bunny and dragon, check them, and say how to use them. "
        "Terms: acknowledge the Stanford Computer Graphics Laboratory; no commercial use without "
        "permission.",
        epilog="example: landscape assets fetch-stanford --out stanford",
    )
    fetch.add_argument("--out", type=Path, default=Path("stanford"), metavar="DIR")
    fetch.add_argument("-q", "--quiet", action="store_true")
    fetch.set_defaults(run=run["assets fetch-stanford"])

    bench = command("bench", "measure frames, grass and startup", "fig35a --json out.json")
    bench.add_argument("views", nargs="*", metavar="VIEW", help="default: the nine of figure 35")
    bench.add_argument("--json", type=Path, metavar="FILE", help="write the results as JSON")
    bench.add_argument("--size", type=_size, default=(800, 600), metavar="WxH")
    _common(bench, samples=0)

    values = command("settings", "list the settings: all, or some", "fog --preset 2006")
    values.add_argument(
        "word",
        nargs="?",
        default="",
        metavar="GROUP|WORD",
        help="a group such as fog, part of a key, or a word of what a setting does; default: all",
    )
    values.add_argument("--json", action="store_true")
    _common(values, samples=0, preset="best or 2006; default: best")

    doctor = command("doctor", "report which OpenGL backends work here", "--json")
    doctor.add_argument("--json", action="store_true")
    return parser


def _common(parser: argparse.ArgumentParser, samples: int, preset: str = BY_VIEW) -> None:
    """Add the options that all drawing commands share; ``preset`` is the help of --preset."""
    add = parser.add_argument_group("common options").add_argument
    backends = "|".join(arguments.BACKENDS)
    add("--backend", type=_backend, default="auto", metavar=backends)
    add("--preset", metavar="best|2006", help=preset)
    add("--set", action="append", type=_pair, default=[], metavar="KEY=VALUE", dest="changes")
    add("--settings", type=Path, metavar="FILE.toml")
    add(
        "--assets",
        type=Path,
        metavar="DIR",
        help="your own files, used first",
    )
    add("--only", type=_elements, default=None, metavar="ELEMENT,...")
    add("--wireframe", action="store_true")
    add("--samples", type=_samples, default=samples, metavar="0|4", help="antialiasing")
    add("--seed", type=_count, default=SEED, metavar="N")
    add("-q", "--quiet", action="store_true")


def _checked(check: Callable[..., Any], text: str, value: Any, *more: Any) -> Any:
    """Check the value that a text stands for; argparse shows the text if it is wrong."""
    try:
        return check(value, *more, given=repr(text))
    except InputError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _digits(text: str) -> int | str:
    """Return a text of ASCII digits as a number; it stays a text if there is anything else."""
    # No number of 20 digits is allowed anywhere, and Python converts none of thousands.
    return int(text.lstrip("0")[:20] or 0) if text.isascii() and text.isdigit() else text


def _size(text: str) -> Any:
    sides = [_digits(side) for side in text.lower().split("x")]
    if len(sides) != 2 or not all(isinstance(side, int) for side in sides):
        raise argparse.ArgumentTypeError(f"{text!r}: expected WxH such as 800x600")
    return _checked(arguments.size, text, sides)


def _count(text: str) -> Any:
    return _checked(arguments.whole, text, _digits(text), "")


def _rate(text: str) -> Any:
    rate = _number(text)
    if rate != 0 and not 1 <= rate <= 1000:
        raise argparse.ArgumentTypeError(f"{text!r}: expected a number from 1 to 1000, or 0")
    return rate


def _samples(text: str) -> Any:
    return _checked(arguments.choice, text, _digits(text), "", arguments.SAMPLES)


def _backend(text: str) -> Any:
    return _checked(arguments.choice, text, text, "", arguments.BACKENDS)


def _real(text: str) -> float | str:
    """Return a text as a number; it stays a text if it is none."""
    try:
        return float(text)
    except ValueError:
        return text


def _number(text: str) -> Any:
    return _checked(arguments.number, text, _real(text), "")


def _pair(text: str) -> tuple[str, str]:
    key, equals, value = text.partition("=")
    if not equals:
        raise argparse.ArgumentTypeError(f"{text!r}: expected KEY=VALUE such as fog.density=0.05")
    return key.strip(), value.strip()


def _elements(text: str) -> tuple[str, ...]:
    return arguments.names(text, "only")


def _pose(text: str) -> Any:
    parts = tuple(_real(part.strip()) for part in text.split(","))
    if len(parts) != 5:
        raise argparse.ArgumentTypeError(f"{text!r}: expected X,Y,Z,YAW,PITCH")
    return _checked(arguments.pose, text, parts)
