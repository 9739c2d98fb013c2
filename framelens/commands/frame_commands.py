"""The commands that look into a frame: what they print."""

import argparse
import json
import os
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

from framelens.base.errors import InputError
from framelens.base.texts import choose
from framelens.commands.reporting import notify, on_program, own_input
from framelens.gl.seam import Call
from framelens.program.program_frame import ProgramFrame
from framelens.report import pixel_report, state_report, trace_diff, trace_text
from framelens.tape.pixel import Row, history
from framelens.tape.tape import Tape
from framelens.tape.target import Target
from framelens.why.walk import unseen_draws, without_trace


def trace(target: Target, options: argparse.Namespace, other: Target | None = None) -> int:
    """Print the calls of a frame, or how they differ from those of an ``other``."""
    if options.element:
        target.check_element(options.element)

    idle: set[str] = set()

    def calls(tape: Tape) -> list[Call]:
        if target.is_program and not options.json:
            idle.update(without_trace(tape))
        names = dict.fromkeys(name for call in tape.calls for name in call.shared_by)
        if options.element and target.is_program and options.element not in names:
            raise InputError(f"--element {options.element!r}: expected one of {', '.join(names)}")
        return trace_text.chosen(tape.calls, options.element, options.pass_)

    first = target.look(calls)
    if other is None:
        text = trace_text.as_text(first, idle=idle)
        return _print(options, [call.as_json() for call in first], text)
    second = other.look(calls)
    found = trace_diff.difference(first, second)
    return _print(options, found.as_json(), trace_diff.as_text(found))


def pixel(target: Target, options: argparse.Namespace) -> int:
    """Print what happened to a pixel."""

    def look(tape: Tape) -> tuple[list[Row], list[int] | None, list[str]]:
        rows = history(tape, *options.pixel)
        x, y = options.pixel
        before = None
        if tape.before is not None:
            before = [int(value) for value in tape.before.color[tape.size[1] - 1 - y, x, :3]]
        unseen = [] if options.json or not target.is_program else unseen_draws(tape)
        return rows, before, unseen

    rows, before, unseen = target.look(look)
    text = pixel_report.as_text(rows, before, unseen)
    return _print(options, [row.as_json() for row in rows], text)


def state(target: Target, options: argparse.Namespace) -> int:
    """Print the state at a call, what differs between two calls, or what an element leaks."""
    found = target.look(lambda tape: state_report.report(tape, options.at, options.diff))
    return _print(options, found.as_json(), found.as_text())


def strip(target: Target, options: argparse.Namespace) -> int:
    """Write how the frame grows, and print the file's name."""
    from framelens.report import strip as strips

    out = strips.checked_out(options.out, target.name)
    request = strips.Request(options.by, options.buffers, options.lang, options.quiet)
    strips.make(target, request, out)
    if not options.quiet:
        print(out)
    return 0


def why(target: Target, options: argparse.Namespace) -> int:
    """Print why a frame shows what it shows, and what would mend it."""
    from framelens.report import why_report as reasons

    found = reasons.find(target, options.pixel, language=options.lang, quiet=options.quiet)
    return _print(options, found.as_json(options.lang), reasons.as_text(found, options.lang))


def _print(options: argparse.Namespace, found: Any, lines: Iterable[str]) -> int:
    print(json.dumps(found, indent=1) if options.json else "\n".join(lines))
    return 0


def settle_language(options: argparse.Namespace) -> None:
    """Where a command has a language and none is given, choose that of the environment."""
    if "lang" in options:
        options.lang = options.lang or choose(os.environ)


def program_frame(options: argparse.Namespace) -> ProgramFrame:
    """Return the frame of a program that the options of a command name."""
    return ProgramFrame(
        options.target,
        backend=options.backend,
        edits=options.edits,
        frame=options.frame,
        events=options.events,
        arguments=options.arguments,
        stdin=own_input(options),
        limit=options.limit,
        tell=partial(notify, options),
    )


def inspect(options: argparse.Namespace) -> int:
    """Open the inspector over a program's window."""
    from framelens.inspector import program_inspector

    def work() -> int:
        lines = program_inspector.inspect(
            options.target, options.edits, options.lang, options.arguments, own_input(options)
        )
        notify(options, lines)
        return 0

    return on_program(options.target, work, options)


RUN: dict[str, Callable[[Target, argparse.Namespace], int]] = {
    "trace": trace,
    "pixel": pixel,
    "state": state,
    "strip": strip,
    "why": why,
}
