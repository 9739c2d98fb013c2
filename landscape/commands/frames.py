"""The commands that look into a frame, of a view or of a program: trace, pixel, state and so on."""

import argparse
from functools import partial
from typing import Any

from framelens.base.errors import InputError, short
from framelens.commands import frame_commands
from framelens.commands.reporting import notify, on_program
from framelens.program.program_frame import ProgramFrame
from landscape.commands.changes import given_changes
from landscape.commands.target import ViewFrame
from landscape.scene.scene import find_view

Look = ViewFrame | ProgramFrame


def look(name: str, options: argparse.Namespace) -> int:
    """Run the command of this name on the target that the options give."""
    frame_commands.settle_language(options)
    target = _target(options)
    other = _other(options) if name == "trace" else None

    work = partial(frame_commands.RUN[name], target, options)
    if other is not None:
        work = partial(frame_commands.trace, target, options, other)
    programs = [each.name for each in (target, other) if each is not None and each.is_program]
    return on_program(" and ".join(dict.fromkeys(programs)), work, options) if programs else work()


def inspect(options: argparse.Namespace) -> int:
    """Open the inspector over a program's window."""
    if not options.target.endswith(".py"):
        walk = "in `landscape walk`, I opens the inspector"
        raise InputError(f"{short(options.target)}: expected the path of a .py program; {walk}")
    return frame_commands.inspect(options)


def _target(options: argparse.Namespace) -> Look:
    """Return the frame that the options of a command name."""
    if not options.target.endswith(".py"):
        return _view(options, given_changes(options, find_view(options.target)[0]))
    _refuse(
        f"it is for views; {short(options.target)} is a program",
        {
            "--preset": options.preset,
            "--set or --settings": given_changes(options),
            "--only": options.only,
            "--assets": options.assets,
            "--wireframe": options.wireframe,
        },
    )
    if options.size is not None:
        raise InputError(
            f"--size: it is for views; the window of the program {short(options.target)} has the "
            "size that the program gives it"
        )
    return frame_commands.program_frame(options)


def _view(options: argparse.Namespace, changes: dict[str, Any]) -> ViewFrame:
    """Return the frame of a view, drawn with these settings and the options."""
    _refuse(
        f"it is for programs; {short(options.target)} is a view",
        {
            "--frame": options.frame,
            "--events": options.events,
            "--limit": options.limit,
            "--": options.arguments,
        },
    )
    return ViewFrame(
        options.target,
        size=options.size,
        backend=options.backend,
        preset=options.preset,
        settings=changes,
        only=options.only,
        assets=options.assets,
        seed=options.seed,
        wireframe=options.wireframe,
        edits=options.edits,
        tell=partial(notify, options),
    )


def _other(options: argparse.Namespace) -> Look | None:
    """Return the frame that a trace is compared with; None without an option that names one."""
    if not (options.diff or options.diff_set or options.diff_preset or options.diff_edits):
        return None
    changed = argparse.Namespace(**vars(options))
    changed.target = options.diff or options.target
    changed.preset = options.diff_preset or options.preset
    changed.edits = options.diff_edits or options.edits
    changed.changes = [*options.changes, *options.diff_set]
    return _target(changed)


def _refuse(why: str, options: dict[str, Any]) -> None:
    """Raise InputError for the first option that was given."""
    for option, value in options.items():
        if value:
            raise InputError(f"{option}: {why}")
