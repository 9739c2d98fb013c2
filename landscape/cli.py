"""The command line. Each command is a module of :mod:`landscape.commands`, imported when asked for.

Exit status: 0 done, 1 a check failed, 2 bad input, 3 no usable OpenGL, 70 a defect of this program.
"""

import argparse
import os
import sys
from collections.abc import Sequence

from framelens.base.errors import Message
from framelens.base.texts import Phrases, choose, said, translator
from framelens.base.texts import marked as _
from framelens.commands.parser import Parser, add_commands, parted
from framelens.commands.reporting import run_command
from landscape import __version__

COMMANDS = {
    "walk": "walk a scene in a window",
    "render": "render views to PNG files",
    "views": "list the named views and the fixes",
    "figures": "draw the report's figures",
    "trace": "print the OpenGL calls of a frame",
    "pixel": "print what happened to a pixel: every draw that covered it",
    "state": "print OpenGL's state at a call of a frame",
    "strip": "show how a frame grows, step by step: a sheet, an animation or a page",
    "why": "find out why a picture is black, or wrong, and name the cause",
    "inspect": "open the inspector over a program's window (F12)",
    "flyover": "fly over a terrain, drawn without OpenGL",
    "lesson": _("list the lessons of the course; run one, draw it or copy it"),
    "exercise": _("exercises for students: list them, start one, check what was written"),
    "exercise list": _("list the exercises, the easiest first"),
    "exercise start": _("write the program of an exercise, with its task and a hole to fill"),
    "exercise solution": _("print how an exercise is solved, where the solutions are installed"),
    "exercise check": _(
        "run a program that was written for an exercise, and grade it: exit status 0 if it "
        "passes, 1 if not, 2 if it cannot be run"
    ),
    "exercise new": _("begin an exercise of your own: a whole small one, to be changed"),
    "exercise test": _(
        "try an exercise before students get it: its solutions pass, and each mistake has its hint"
    ),
    "exercise pack": _("pack exercises: what students get, and what their teacher keeps"),
    "lecture": _("show lessons and views one after another, full screen"),
    "assets": "make, show or fetch assets",
    "assets build": "make assets from code (needs the extra `studio`)",
    "assets check": "check every asset: seams, edges, sizes, meshes",
    "assets sheet": "one contact sheet of all assets",
    "assets fetch-stanford": "download the Stanford bunny and dragon",
    "places": "save where trees, deer and plants stand to a file",
    "bench": "measure frames, grass and startup",
    "film": "draw a film",
    "sound": "write what there is to hear in a view, as a WAV file",
    "settings": "list the settings: all, or some",
    "doctor": "report which OpenGL backends work here",
}
"""The commands by name, with what their help says that they do."""

PROGRAMS = ("trace", "pixel", "state", "strip", "why", "inspect")
"""The commands that run a program: what follows `--` is for it."""

COURSE = ("lesson", "exercise", "lecture")
"""The commands whose help is in the user's language."""

HELP: Phrases = (
    "usage: ",
    "positional arguments",
    "options",
    "example: ",
    "show this help message and exit",
    "language of the texts; default: by LANGUAGE, LC_ALL, LC_MESSAGES or LANG",
    "how OpenGL is opened; default: %(default)s, the first that works",
)
"""What argparse writes into a help, and what commands of other subjects write there, too."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; return its exit status."""
    return run_command(argv, parse)


def parse(argv: Sequence[str] | None = None) -> argparse.Namespace:
    """Parse the command line; views may come before, between and after the options."""
    words, arguments = parted(list(sys.argv[1:] if argv is None else argv), PROGRAMS)
    language = choose(os.environ) if words and words[0] in COURSE else "en"
    parser = build_parser(words[:1], language)
    options, rest = parser.parse_known_args(words)
    options.arguments = arguments
    if rest:
        # argparse itself takes only the views before the first option.
        if "views" not in options or any(word.startswith("-") for word in rest):
            unknown = Message("unrecognized arguments: {words}", words=" ".join(rest))
            parser.error(said(unknown, choose(os.environ)))
        options.views = [*options.views, *rest]
    return options


def build_parser(
    asked: Sequence[str] | None = None, language: str = "en"
) -> argparse.ArgumentParser:
    """Return the parser; without a command it prints the help.

    With ``asked``, the first word of a command line, only the command of that name has its options.
    """
    parser = Parser(
        prog="landscape",
        description="The landscape of the 2006 report, in fixed-function OpenGL.",
        epilog="example: landscape render fig35e --size 1600x900",
    )
    parser.add_argument("--version", action="version", version=f"landscape {__version__}")
    translate = translator(language, "course")
    add_commands(parser, COMMANDS, "landscape.commands", asked, translate)
    return parser
