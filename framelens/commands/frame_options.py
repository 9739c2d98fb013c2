"""The options of the commands that look into a frame: trace, pixel, state, strip, why."""

import argparse
from collections.abc import Callable, Mapping
from pathlib import Path

from framelens.commands import option_values
from framelens.commands.parser import language_option
from framelens.tape.strip import BUFFERS, GROUPINGS

PROGRAM = (
    "the path of a .py program that uses PyOpenGL; what follows `--` are the program's own "
    "arguments"
)
EXAMPLES = {
    "trace": "program.py --frame 3",
    "pixel": "program.py 400,300",
    "state": "program.py --at display --diff initial",
    "strip": "program.py --by draw --buffers color,depth --out strip.html",
    "why": "program.py 400,300",
}
FRAME = "for a program: the frame to look into, from 0; default: %(default)s"
EVENTS = "for a program: timed keys and mouse moves (see docs/frame.md)"
LIMIT = (
    "for a program: seconds of the processor that it may take to its frame; default: 15 (see "
    "docs/programs.md)"
)
# The commands that run a program: what follows `--` is for it.
PROGRAMS = ("trace", "pixel", "state", "strip", "why", "inspect")
EDITS = "change single OpenGL calls as this file says"
PASS_NAMES = (
    "setup",
    "shadow",
    "reflection",
    "refraction",
    "main",
    "picture",
    "water",
    "overlay",
)
PASSES = (
    "only the calls of one pass: setup, reflection, main or overlay; of the voxel island also "
    "shadow, refraction or water, of the great hall picture; default: all"
)
AT = (
    "the state in which this call is made: its number in the trace, such as 812, or 812.3 for a "
    "call of a display list; or +12, counted from the frame's beginning; or the name of an element "
    "for its first call; default: the state after the frame"
)
DIFF = (
    "print what differs from --at (default: from the frame's beginning) to this call; an element "
    "without --at: what it leaves changed; initial: what --at differs in from a new context"
)
WRONG = (
    "a pixel that should look otherwise, from the picture's top left; default: the whole picture"
)

Add = Callable[[str, str, str], argparse.ArgumentParser]
"""Adds a command to the command line, by name, help and example."""


def add(
    command: Add,
    own: Callable[[str, argparse.ArgumentParser], None],
    target: str = PROGRAM,
    examples: Mapping[str, str] = EXAMPLES,
) -> None:
    """Add the commands; ``own`` adds the caller's own options to each, by its name.

    ``target`` is the help of what they look into, and ``examples`` has an example of each.
    """
    trace = command("trace", "print the OpenGL calls of a frame", examples["trace"])
    _target(trace, target)
    trace.add_argument("--pass", dest="pass_", choices=PASS_NAMES, metavar="NAME", help=PASSES)
    trace.add_argument(
        "--diff", metavar="TARGET2", help="print which calls come, go or change in another target"
    )
    trace.add_argument("--diff-edits", type=Path, metavar="FILE", help="the same for these edits")
    pixel = command(
        "pixel", "print what happened to a pixel: every draw that covered it", examples["pixel"]
    )
    _target(pixel, target)
    pixel.add_argument(
        "pixel", type=_pixel, metavar="X,Y", help="in pixels from the picture's top left"
    )
    state = command("state", "print OpenGL's state at a call of a frame", examples["state"])
    _target(state, target)
    state.add_argument("--at", default="", metavar="CALL|ELEMENT", help=AT)
    state.add_argument("--diff", default="", metavar="CALL|ELEMENT|initial", help=DIFF)
    strip = command(
        "strip",
        "show how a frame grows, step by step: a sheet, an animation or a page",
        examples["strip"],
    )
    _target(strip, target)
    _strip_options(strip)
    language_option(strip)
    why = command(
        "why", "find out why a picture is black, or wrong, and name the cause", examples["why"]
    )
    _target(why, target)
    why.add_argument("pixel", nargs="?", type=_pixel, metavar="X,Y", help=WRONG)
    language_option(why)
    for sub in (trace, pixel, state, why):
        sub.add_argument("--json", action="store_true", help="print JSON")

    named = {"trace": trace, "pixel": pixel, "state": state, "strip": strip, "why": why}
    for name, sub in named.items():
        sub.add_argument("--frame", type=option_values.count, default=0, metavar="N", help=FRAME)
        sub.add_argument("--events", type=Path, metavar="FILE", help=EVENTS)
        sub.add_argument("--limit", type=option_values.seconds, metavar="SECONDS", help=LIMIT)
        own(name, sub)


def _strip_options(strip: argparse.ArgumentParser) -> None:
    strip.add_argument(
        "--by",
        choices=GROUPINGS,
        default="element",
        help="what makes a step: a pass, an element, or every draw call; default: %(default)s",
    )
    strip.add_argument(
        "--buffers",
        type=_buffers,
        default=BUFFERS[:1],
        metavar=",".join(BUFFERS),
        help="what to show of each step: colours; depth, as distance; stencil values; overdraw, "
        "as layers of fragments; default: color",
    )
    strip.add_argument(
        "--out",
        type=Path,
        metavar="FILE.png|.gif|.html",
        help="a sheet, an animation, or a page that lists the calls, too; default: "
        "TARGET-strip.png",
    )


def parted(words: list[str]) -> tuple[list[str], list[str]]:
    """Part a command line, in words, from what its program gets: what follows `--`."""
    if not words or words[0] not in PROGRAMS or "--" not in words:
        return words, []
    at = words.index("--")
    return words[:at], words[at + 1 :]


def add_inspect(command: Add) -> None:
    """Add the command that opens the inspector over a program."""
    inspect = command("inspect", "open the inspector over a program's window (F12)", "program.py")
    inspect.add_argument(
        "target",
        metavar="FILE.py",
        help="a program that uses PyOpenGL with GLFW, GLUT or pygame; what follows `--` are its "
        "own arguments",
    )
    edits_option(inspect)
    language_option(inspect, "language of the inspector")
    inspect.add_argument("-q", "--quiet", action="store_true", help="print no notices")


def edits_option(sub: argparse.ArgumentParser) -> None:
    """Add --edits."""
    sub.add_argument("--edits", type=Path, metavar="FILE", help=EDITS)


def _target(sub: argparse.ArgumentParser, target: str) -> None:
    sub.add_argument("target", metavar="TARGET", help=target)
    edits_option(sub)


def _buffers(text: str) -> tuple[str, ...]:
    names = tuple(dict.fromkeys(part.strip() for part in text.split(",")))
    for name in names:
        if name not in BUFFERS:
            raise argparse.ArgumentTypeError(f"{name!r}: expected some of {', '.join(BUFFERS)}")
    return names


def _pixel(text: str) -> tuple[int, int]:
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 2 or not all(part.isascii() and part.isdigit() for part in parts):
        raise argparse.ArgumentTypeError(f"{text!r}: expected X,Y such as 400,300")
    return int(parts[0][:9]), int(parts[1][:9])
