"""Options of every command that draws: settings, preset; and the notices that follow from them."""

import argparse
from collections.abc import Mapping, Sequence
from typing import Any

from framelens.commands.reporting import notify
from landscape.scene.scene import Scene, View, without_effect
from landscape.settings import declare


def given_changes(options: argparse.Namespace, *kinds: Scene) -> dict[str, object]:
    """Return the settings of --settings and --set, the latter winning.

    A notice on standard error names each key that one of the scenes has renamed.
    """
    changes = declare.read_toml(options.settings) if options.settings else {}
    changes |= dict(options.changes)
    notify(
        options,
        [line for kind in kinds for line in declare.current_names(kind.settings, changes)[1]],
    )
    return changes


def tell_of_no_effect(
    options: argparse.Namespace, views: Sequence[tuple[Scene, View]], changes: Mapping[str, object]
) -> None:
    """Print a notice for each setting given that changes nothing in any of these views."""
    notify(options, without_effect(views, options.preset, changes, options.only))


def offscreen_options(options: argparse.Namespace) -> dict[str, Any]:
    """Return the common options as the arguments of an Offscreen."""
    return {
        "preset": options.preset,
        "backend": options.backend,
        "samples": options.samples,
        "assets": options.assets,
        "only": options.only,
        "seed": options.seed,
    }
