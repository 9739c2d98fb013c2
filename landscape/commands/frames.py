"""Shared by the commands that look into a frame: is it the frame of a view or of a program?"""

import argparse
from collections.abc import Callable, Sequence
from functools import partial

from framelens.base.errors import InputError, short
from framelens.commands.common import Show, program_frame, settle_language
from framelens.commands.reporting import notify, on_program
from framelens.program.program_frame import ProgramFrame
from landscape.commands.changes import given_changes
from landscape.commands.target import ViewFrame
from landscape.scene.scene import find_view

Look = ViewFrame | ProgramFrame


def look(show: Show, options: argparse.Namespace) -> int:
    """Show the target that the options name; return the exit status."""
    frame = target(options)
    return on_targets((frame,), partial(show, frame, options), options)


def on_targets(frames: Sequence[Look], work: Callable[[], int], options: argparse.Namespace) -> int:
    """Do the work on frames; where one is a program's, in a process of its own."""
    programs = [frame.name for frame in frames if frame.is_program]
    return on_program(" and ".join(dict.fromkeys(programs)), work, options) if programs else work()


def target(options: argparse.Namespace) -> Look:
    """Return the frame that the options of a command name."""
    settle_language(options)
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
            "--size: it is for views; the window of the program {target} has the size "
            "that the program gives it",
            target=short(options.target),
        )

    return program_frame(options)


def _view(options: argparse.Namespace, changes: dict[str, object]) -> ViewFrame:
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


def _refuse(why: str, options: dict[str, object]) -> None:
    """Raise InputError for the first option that was given."""
    for option, value in options.items():
        if value:
            raise InputError("{option}: {why}", option=option, why=why)
