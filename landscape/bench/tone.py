"""Brightness and contrast: blending timed against copying pixels (hall/tone.py).

The document claims that blending is 4 to 25 times as fast, by implementation, number of pixels and
values (glSkel, scale and bias).
"""

from collections.abc import Callable
from functools import partial
from statistics import median
from typing import Any

from landscape.bench.timing import in_turns
from landscape.files.assets import Assets
from landscape.hall.statue import Statue
from landscape.hall.tone import Tone
from landscape.scene.scene import Moment, begin_frame, find_view, placed
from landscape.settings import declare

VIEW = "hall_contrast"  # chosen: the statue fills a good part of it
# Chosen: brightness, contrast and area; one pass, two passes, and three with a part marked.
CASES = ((0.1, 0.7, "picture"), (-0.1, 1.6, "picture"), (0.0, 3.0, "statue"))
METHODS = ("blend", "pixels")


Row = dict[str, float | str]
"""A case, and its times."""


def measure_tone(
    values: Any, size: tuple[int, int], assets: Assets, rounds: int, done: Callable[[str], None]
) -> list[Row]:
    """Return for each case ``brightness``, ``contrast``, ``area``, ``blend_ms`` and ``pixels_ms``.

    ``ratio`` is how many times as long copying takes as blending. ``values`` are the hall's
    settings; the target must have no antialiasing.
    """
    kind, view = find_view(VIEW)
    pose = placed(view.pose, kind.terrain(values, assets), values.walk.eye)
    found: list[Row] = []
    statue = Statue(values, assets)
    try:
        tone = Tone(values, assets)
        frame = begin_frame(Moment(pose, size, view.kt), values.camera, values.sun, values.fog)
        for brightness, contrast, area in CASES:
            case: Row = {"brightness": brightness, "contrast": contrast, "area": area}

            def draw(method: str, case: Row = case) -> None:
                changes = {f"tone.{name}": value for name, value in case.items()}
                tone.take(declare.with_settings(values, {**changes, "tone.method": method}))
                with tone.marking():
                    statue.send()
                tone.draw(frame)

            ways = {method: partial(draw, method) for method in METHODS}
            times = in_turns({**ways, "statue": statue.send}, rounds)
            alone = median(times["statue"])
            blend, pixels = (max(median(times[method]) - alone, 1e-3) for method in METHODS)
            times_as_long = pixels / blend
            found.append({**case, "blend_ms": blend, "pixels_ms": pixels, "ratio": times_as_long})
            done(f"tone {contrast:g}")
    finally:
        statue.release()
    return found


def report(rows: list[Row]) -> list[str]:
    """Return the lines of a table, none without rows."""
    if not rows:
        return []
    lines = ["", "brightness  contrast  area       blending ms  copying ms  times as long"]
    for row in rows:
        lines.append(
            f"{row['brightness']:10.1f} {row['contrast']:9.1f}  {row['area']:9} "
            f"{row['blend_ms']:12.2f} {row['pixels_ms']:11.2f} {row['ratio']:14.1f}"
        )
    return lines
