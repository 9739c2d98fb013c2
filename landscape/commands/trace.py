"""`landscape trace`: the OpenGL calls of a frame, or how they differ from those of another."""

import argparse
from functools import partial

from framelens.commands import option_values, trace
from landscape.commands import frames
from landscape.commands.common import TARGET, explain, frame_of_a_view

EXAMPLE = "fig35f --element fog"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    trace.add_options(parser, TARGET)
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
    explain(element, "only the calls of one element: %(elements)s or frame; default: all")
    frame_of_a_view(parser)


def run(options: argparse.Namespace) -> int:
    """Trace a frame, or compare it with another; return the exit status."""
    target = frames.target(options)
    other = _other(options)
    if other is None:
        return frames.on_targets((target,), partial(trace.show, target, options), options)
    work = partial(trace.show, target, options, other)
    return frames.on_targets((target, other), work, options)


def _other(options: argparse.Namespace) -> frames.Look | None:
    """Return the frame that a trace is compared with; None without an option that names one."""
    if not (options.diff or options.diff_set or options.diff_preset or options.diff_edits):
        return None
    changed = argparse.Namespace(**vars(options))
    changed.target = options.diff or options.target
    changed.preset = options.diff_preset or options.preset
    changed.edits = options.diff_edits or options.edits
    changed.changes = [*options.changes, *options.diff_set]
    return frames.target(changed)
