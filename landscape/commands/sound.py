"""`landscape sound`: what there is to hear in a view, as a WAV file."""

import argparse

from framelens.base.errors import InputError
from framelens.base.output import check_writable
from framelens.commands.option_values import number, pathname, refusal
from framelens.commands.reporting import notify
from landscape.commands.changes import given_changes
from landscape.commands.common import (
    BY_VIEW,
    QUIET,
    assets_option,
    kt_option,
    pose_option,
    settings_options,
)
from landscape.files.assets import Assets
from landscape.scene.scene import find_view, placed, raised, scene
from landscape.sound.mixer import mix
from landscape.sound.score import Score, standing
from landscape.sound.signal import RATE, decibels, rms
from landscape.sound.soundscape import Ear
from landscape.sound.wave_file import write_wave

EXAMPLE = "fig35i --seconds 20 --out shore.wav"
MOST_SECONDS = 600.0  # chosen: 115 MB
SECONDS = 5.0  # chosen
VIEW = "where one stands and listens, see `landscape views`; default: fig35e"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("view", nargs="?", default="", metavar="VIEW", help=VIEW)
    pose_option(parser)
    kt_option(parser, "animation time at the beginning; default: the view's own")
    parser.add_argument(
        "--seconds",
        type=_seconds,
        default=SECONDS,
        metavar="N",
        help="how long; default: %(default)g",
    )
    parser.add_argument("--out", type=pathname, required=True, metavar="FILE.wav", help="the file")
    parser.add_argument("--preset", metavar="best|2006", help=BY_VIEW)
    settings_options(parser, "[sound] volume = 2.0", "sound.volume=2", "landscape settings sound")
    assets_option(parser)
    parser.add_argument("-q", "--quiet", action="store_true", help=QUIET)


def _seconds(text: str) -> float:
    value = number(text)
    if not 0.01 <= value <= MOST_SECONDS:
        raise refusal(
            "{text!r}: expected a number from {low:g} to {high:g}",
            text=text,
            low=0.01,
            high=MOST_SECONDS,
        )
    return value


def run(options: argparse.Namespace) -> int:
    """Write the file; return the exit status. No OpenGL is opened."""
    if options.out.suffix.lower() != ".wav":
        raise InputError("--out {out}: expected a name that ends in .wav", out=options.out)
    check_writable(options.out, "--out ")

    samples = mix(_score(options), 0, round(options.seconds * RATE))
    write_wave(options.out, samples)
    notify(options, [f"{decibels(rms(samples)):.1f} dBFS, as the root of the mean square"])
    if not options.quiet:
        print(options.out)
    return 0


def _score(options: argparse.Namespace) -> Score:
    """Return what there is to hear where the options let one stand."""
    kind, view = find_view(options.view or scene().start)
    settings = kind.values(
        options.preset or kind.preset_of(view), view.settings, given_changes(options, kind)
    )

    terrain = kind.terrain(settings, Assets(options.assets))
    eye = settings.walk.eye
    pose = raised(placed(options.pose or view.pose, terrain, eye), terrain, eye)
    assert pose.y is not None

    kt = view.kt if options.kt is None else options.kt
    volume = 0.0 if settings.sound.muted else settings.sound.volume
    return standing(
        kind.sounds(settings, terrain),
        Ear(pose.x, pose.y, pose.z, pose.yaw, kt),
        options.seconds,
        settings.clock.kt_per_second,
        volume,
    )
