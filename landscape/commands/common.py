"""The options that several commands share, and how their values are read."""

import argparse
from typing import Any

from framelens.base import arguments
from framelens.commands import option_values
from framelens.commands.option_values import refusal
from framelens.commands.parser import Options, backend_option
from landscape.frame import SEED, Pose, checked_pose

POSE = "where the eye is; angles in degrees; Y may be `ground`: eye height above the ground"
KT = "animation time; default: the view's own"
OWN_FILES = "a folder of your own images and meshes, used first; default: only the shipped ones"
QUIET = "print neither progress, notices nor file names"
WORLD = "for voxel: a file of changed blocks"
BY_VIEW = (
    "best or 2006; default: the view's own (see `landscape views`), which is best, or 2006 where "
    "the view shows one technique or flaw of the report"
)
TARGET = (
    "a view or a fix (see `landscape views`), or the path of a .py program that uses PyOpenGL; "
    "what follows `--` are the program's own arguments"
)


class _Elements:
    """The names of the first scene's elements in a help text; read only when that is printed."""

    def __str__(self) -> str:
        from landscape.scene.scene import scene

        return ", ".join(scene().elements)


def explain(option: Any, text: str) -> None:
    """Give an option a help text in which %(elements)s stands for the names of the elements.

    Afterwards, because from Python 3.14 on argparse expands the text with which an option is added.
    """
    option.elements, option.help = _Elements(), text


def pose_option(parser: argparse.ArgumentParser) -> None:
    """Add --pose."""
    parser.add_argument("--pose", type=_pose, metavar="X,Y,Z,YAW,PITCH", help=POSE)


def _pose(text: str) -> Pose:
    """Return the pose that an option gives."""
    parts = tuple(arguments.real(part.strip()) for part in text.split(","))
    if len(parts) != 5:
        raise refusal("{text!r}: expected X,Y,Z,YAW,PITCH", text=text)
    return option_values.checked(checked_pose, text, parts)


def kt_option(parser: argparse.ArgumentParser, what: str = KT) -> None:
    """Add --kt."""
    parser.add_argument("--kt", type=option_values.number, metavar="N", help=what)


def size_option(
    parser: argparse.ArgumentParser, size: tuple[int, int], what: str, fixed: bool = True
) -> None:
    """Add --size, which is of ``what``; unless it is fixed, the command chooses where it is None.

    The help then names the size that it chooses most often.
    """
    parser.add_argument(
        "--size",
        type=option_values.size,
        default=size if fixed else None,
        metavar="WxH",
        help=f"{what} in pixels; default: {size[0]}x{size[1]}",
    )


def frame_of_a_view(parser: argparse.ArgumentParser) -> None:
    """Add how a view is drawn by a command that looks into a frame."""
    size_option(parser, (800, 600), "for a view: size of the frame", fixed=False)
    drawing_options(parser, samples=0)


def settings_options(parser: Options, example: str, key: str, listed: str) -> None:
    """Add --set and --settings."""
    parser.add_argument(
        "--set",
        action="append",
        type=option_values.pair,
        default=[],
        metavar="KEY=VALUE",
        dest="changes",
        help=f"change a setting, as in {key}; may be repeated; `{listed}` lists the keys and their "
        "values",
    )
    parser.add_argument(
        "--settings",
        type=option_values.pathname,
        metavar="FILE.toml",
        help=f"a file of settings, as in {example}; --set overrides it",
    )


def assets_option(parser: Options) -> None:
    """Add --assets."""
    parser.add_argument("--assets", type=option_values.pathname, metavar="DIR", help=OWN_FILES)


def drawing_options(parser: argparse.ArgumentParser, samples: int, preset: str = BY_VIEW) -> None:
    """Add the options that all drawing commands share; ``preset`` is the help of --preset."""
    group = parser.add_argument_group("common options")
    backend_option(group)
    group.add_argument("--preset", metavar="best|2006", help=preset)
    settings_options(group, "[fog] density = 0.05", "fog.density=0.05", "landscape settings")
    assets_option(group)

    only = group.add_argument("--only", type=option_values.elements, metavar="ELEMENT,...")
    explain(only, "draw only some elements of %(elements)s; default: those of the view")
    group.add_argument("--wireframe", action="store_true", help="draw lines instead of faces")

    group.add_argument(
        "--samples",
        type=option_values.samples,
        default=samples,
        metavar="0|4",
        help="samples per pixel against aliasing; default: %(default)s",
    )
    group.add_argument(
        "--seed",
        type=option_values.count,
        default=SEED,
        metavar="N",
        help="seed of everything random; default: %(default)s",
    )
    group.add_argument("-q", "--quiet", action="store_true", help=QUIET)
