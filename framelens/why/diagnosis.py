"""The diagnosis: rules suspect, changes are tried, and what is seen to mend the picture is named.

First the frame is surveyed. Then all rules hand over their suspects, the likeliest first, and for
each the frame is drawn again with its change. A cause is proven if enough pixels differ, among them
the one asked about. Where no change alone does it, the likeliest are tried in pairs. What was tried
in vain is ruled out.
"""

import logging
import time
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from typing import Any

import numpy as np

from framelens.base.errors import InputError
from framelens.gl.raw import raw
from framelens.gl.seam import Call, GluCall, gl
from framelens.tape.tape import Tape
from framelens.why import (
    rules_arrays,
    rules_color,
    rules_frames,
    rules_light,
    rules_matrices,
    rules_outside,
    rules_shapes,
    rules_tests,
    rules_texture,
    rules_window,
)
from framelens.why.findings import FAMILIES, mend, text, word
from framelens.why.survey import Survey, survey
from framelens.why.suspects import Rule, Suspect
from framelens.why.trial import changed
from framelens.why.walk import lines

RULES: tuple[Rule, ...] = (
    *rules_window.RULES,
    *rules_frames.RULES,
    *rules_shapes.RULES,
    *rules_matrices.RULES,
    *rules_outside.RULES,
    *rules_arrays.RULES,
    *rules_texture.RULES,
    *rules_light.RULES,
    *rules_color.RULES,
    *rules_tests.RULES,
)
# Of a frame that ends with an error: the rest of it is not there to be looked at.
BROKEN_OFF: tuple[Rule, ...] = (*rules_window.RULES, rules_matrices.unbalanced)
LOG = logging.getLogger(__name__)
LIMIT = 8.0  # seconds that the search may take; chosen
ALWAYS = 4  # suspects that are tried however late it is; chosen
LEAST = 12  # pixels that must differ for a proof; chosen
PAIRS = 6  # suspects that are tried in pairs; chosen
MOST = 3  # causes that are named; chosen
WEAKER = 6  # by how much less likely a second cause may be to be named, too; chosen


@dataclass(frozen=True)
class Cause:
    """A proven cause, as the contract's JSON has it; ``values`` fill in its texts."""

    cause: str
    call: int
    source: str
    state: str
    value: object
    pixels: int
    values: dict[str, object]
    hidden: bool = False  # whether the pixels are those that a window does not show

    def as_json(self, language: str) -> dict[str, object]:
        """Return the cause as `landscape why --json` prints it."""
        return {
            "cause": self.cause,
            "call": self.call,
            "source": self.source,
            "state": self.state,
            "value": _plain(self.value),
            "text": text(language, self.cause, self.values),
            "mend": mend(language, self.cause, self.values),
            "pixels": self.pixels,
        }


@dataclass(frozen=True)
class Diagnosis:
    """What was found: a verdict by its key in findings.py, and the causes, the likeliest first."""

    verdict: str
    verdict_values: dict[str, object]
    causes: Sequence[Cause]
    ruled_out: Sequence[str]
    walk: Sequence[str] = field(default_factory=tuple)
    drew: bool = True  # whether the frame draws anything at all

    def as_json(self, language: str) -> dict[str, object]:
        """Return the diagnosis as `landscape why --json` prints it."""
        return {
            "verdict": word(language, self.verdict, **self.verdict_values),
            "causes": [cause.as_json(language) for cause in self.causes],
            "ruled_out": list(self.ruled_out),
        }


def diagnose(
    tape: Tape,
    pixel: tuple[int, int] | None = None,
    limit: float = LIMIT,
    language: str = "en",
    step: Callable[[int, int], object] = lambda done, of: None,
    only: Collection[str] = (),
) -> Diagnosis:
    """Find out why a tape's frame shows what it shows; its context must be current.

    ``pixel`` is one that should look otherwise, from the top left; ``limit`` are seconds for the
    search; ``language`` is that of the walk through the pipeline; ``step`` is told how many
    suspects of how many were tried; ``only`` limits the causes. InputError for a pixel outside the
    picture.
    """
    width, height = tape.size
    if pixel is not None and not (0 <= pixel[0] < width and 0 <= pixel[1] < height):
        raise InputError(
            "pixel {x},{y}: expected one of the picture, 0,0 to {width},{height}",
            x=pixel[0],
            y=pixel[1],
            width=width - 1,
            height=height - 1,
        )

    until = time.monotonic() + limit
    found = survey(tape, pixel)
    try:
        return _diagnosed(found, until, language, step, only)
    finally:
        found.trial.release()


def suspects_of(found: Survey) -> list[Suspect]:
    """Return what all rules suspect, the likeliest first."""
    suspects: list[Suspect] = []
    error = found.past.error if found.past else None
    drawn = -1
    for rule in RULES if error is None else BROKEN_OFF:
        try:
            if drawn != found.trial.times:
                found.tape.rewind()
                drawn = found.trial.times
            suspects += list(rule(found))
        except Exception:  # a rule that stumbles must not keep the others from being asked
            LOG.debug("a rule has stumbled", exc_info=True)
            _drain()
    suspects.sort(key=lambda suspect: -suspect.strength)
    return suspects


def _diagnosed(
    found: Survey,
    until: float,
    language: str,
    step: Callable[[int, int], object],
    only: Collection[str],
) -> Diagnosis:
    suspects = [each for each in suspects_of(found) if not only or each.cause in only]
    proven, failed = _tried(found, suspects, until, step)
    if not proven and found.empty and found.pixel is not None:
        # Where nothing is seen at all, what makes it appear elsewhere is a cause as well.
        anywhere = [replace(each, reach=max(found.base.shape)) for each in failed]
        proven, failed = _tried(found, anywhere, until, step)
    if not proven:
        proven = _in_pairs(found, failed, until)

    step(len(suspects), len(suspects))
    proven = _ordered(proven)
    causes = [_cause(found, suspect, pixels) for suspect, pixels in _distinct(proven)][:MOST]
    named = {cause.cause for cause in causes}
    ruled_out = [s.cause for s in failed if s.cause not in named]
    verdict, values = _verdict(found, causes)
    return Diagnosis(
        verdict,
        values,
        causes,
        list(dict.fromkeys(ruled_out)),
        tuple(lines(found, language)),
        bool(found.shapes),
    )


def _tried(
    found: Survey,
    suspects: Sequence[Suspect],
    until: float,
    step: Callable[[int, int], object],
) -> tuple[list[tuple[Suspect, int]], list[Suspect]]:
    """Try suspects, the likeliest first; return the proven ones with pixels, and the others."""
    proven: list[tuple[Suspect, int]] = []
    failed: list[Suspect] = []
    for index, suspect in enumerate(suspects):
        step(index, len(suspects))
        if proven and suspect.strength < proven[0][0].strength - WEAKER:
            break
        if index >= ALWAYS and time.monotonic() > until:
            break
        pixels = _proof(found, suspect)
        if pixels:
            proven.append((suspect, pixels))
        else:
            failed.append(suspect)
    return proven, failed


def _in_pairs(found: Survey, failed: Sequence[Suspect], until: float) -> list[tuple[Suspect, int]]:
    """Return two suspects whose changes mend the picture together, nothing if none do."""
    if not (found.empty or found.pixel):
        return []
    for first, second in combinations(failed[:PAIRS], 2):
        if time.monotonic() > until or first.change is None or second.change is None:
            return []
        if first.cause == second.cause:
            continue
        both = Suspect(
            first.cause,
            at=first.at,
            change=first.change | second.change,
            strength=min(first.strength, second.strength),
        )
        pixels = _proof(found, both)
        if pixels:
            return [(first, pixels), (second, pixels)]
    return []


def _ordered(proven: Sequence[tuple[Suspect, int]]) -> list[tuple[Suspect, int]]:
    return sorted(proven, key=lambda each: -each[0].strength)


def _distinct(proven: Sequence[tuple[Suspect, int]]) -> list[tuple[Suspect, int]]:
    seen: set[object] = set()
    kept = []
    for suspect, pixels in proven:
        family = FAMILIES.get(suspect.cause, suspect.cause)
        keys = {("family", family), ("state", suspect.state or suspect.cause)}
        if not keys & seen:
            kept.append((suspect, pixels))
        seen |= keys
    return kept


def _proof(found: Survey, suspect: Suspect) -> int:
    """Return how many pixels a suspect's change makes different, 0 if it proves nothing."""
    if suspect.change is None:
        return suspect.pixels
    picture = found.trial.picture(suspect.change)
    _drain()
    if picture is None or picture.shape != found.base.shape:
        return 0
    mask = changed(found.base, picture)
    broken_off = found.past is not None and found.past.error is not None
    if found.pixel is not None and not broken_off and not _near(mask, found.pixel, suspect.reach):
        return 0  # of a frame that is broken off, the draw that was to reach it may be missing
    pixels = int(mask.sum())
    if suspect.appear and not _appear(found, suspect):
        return 0
    return pixels if pixels >= max(LEAST, suspect.least) else 0


def _appear(found: Survey, suspect: Suspect) -> bool:
    """Return whether the draws of a suspect have fragments that pass, with its change."""
    assert suspect.change is not None
    counts = found.trial.counts(suspect.change)
    _drain()
    return counts is not None and any(counts[draw.index] for draw in suspect.draws)


def _near(mask: np.ndarray, pixel: tuple[int, int], reach: int) -> bool:
    x, y = pixel
    rows = slice(max(y - reach, 0), y + reach + 1)
    return bool(mask[rows, max(x - reach, 0) : x + reach + 1].any())


def _drain() -> None:
    for _ in range(20):
        if not raw.glGetError():
            break


def _cause(found: Survey, suspect: Suspect, pixels: int) -> Cause:
    at = suspect.at
    number, source = -1, suspect.source
    if isinstance(at, Call):
        number = at.number
        source = source or at.source
    elif isinstance(at, GluCall):
        number = at.begin
        source = source or at.source
    elif suspect.draws:
        number = suspect.draws[0].number
        source = source or suspect.draws[0].call.source

    if number >= found.tape.begin:
        number = int(found.place_of(number).partition(".")[0])
    values = {"state": suspect.state, "value": suspect.value, **suspect.values}
    return Cause(
        suspect.cause,
        number,
        source,
        suspect.state.removeprefix("GL_TEXTURE0."),
        suspect.value,
        pixels,
        values,
        suspect.change is None,
    )


def _verdict(found: Survey, causes: Sequence[Cause]) -> tuple[str, dict[str, Any]]:
    at = {"x": found.pixel[0], "y": found.pixel[1]} if found.pixel else {}
    if causes:
        if not found.shapes:
            return "nothing-drawn", {}
        if found.empty:
            return "one-color", {}
        return ("wrong-at", at) if at else ("wrong", {})
    if not found.shapes:
        return "nothing-drawn", {}
    if found.empty:
        return "not-found", {}
    if at:
        seen = [d for d in found.shapes if d.at_pixel[0]]
        if seen:
            return "visible-at", at | {"line": seen[-1].call.site.line}
        return "background-at", at
    return "visible", {}


def _plain(value: object) -> object:
    if isinstance(value, (np.integer, np.floating)):
        return value.item()
    if isinstance(value, tuple):
        return list(value)
    return value


__all__ = ["LIMIT", "Cause", "Diagnosis", "diagnose", "gl"]
