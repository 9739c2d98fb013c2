"""The fly-over's techniques measured: each alone, all but each, all together (section 3).

The same frames of the same path are drawn in turns, one of each row per round, so that a slow
moment of the machine affects all of them. The first frame of each row is drawn once before, without
being timed: what is computed for the whole terrain is kept from then on, as it is in a flight.
"""

import time
from collections.abc import Callable
from typing import Any

import numpy as np

from landscape.flyover import frame
from landscape.flyover.environment import Environment
from landscape.flyover.settings import Settings
from landscape.keys import with_settings

FRAMES = 12  # chosen: evenly along the path
# Switch and what it needs, in the order in which a student would write them.
TECHNIQUES = {
    "strips": ("flyover.strips",),
    "back faces": ("flyover.back_faces",),
    "bounding volumes": ("flyover.bounding_volumes",),
    "quad-tree": ("flyover.quad_tree", "flyover.bounding_volumes"),
    "level of detail": ("flyover.detail",),
}
HIDDEN = "flyover.hidden_lines"  # which takes time, and makes the picture another one
SWITCHES = tuple(dict.fromkeys(name for names in TECHNIQUES.values() for name in names))
COLUMNS = ("considered", "lines", "pixels")


def rows(values: Settings) -> dict[str, Settings]:
    """Return the settings of each row by its name, the slowest first."""
    lines = with_settings(values, {"flyover.mode": "lines", HIDDEN: False})

    def with_only(*on: str) -> Settings:
        return with_settings(lines, {switch: switch in on for switch in SWITCHES})

    found = {"none": with_only()}
    for name, switches in TECHNIQUES.items():
        found[f"only {name}"] = with_only(*switches)
    for name, (switch, *_) in TECHNIQUES.items():
        # What needs the technique goes with it.
        rest = [switches for switches in TECHNIQUES.values() if switch not in switches]
        found[f"all but {name}"] = with_only(*(each for switches in rest for each in switches))
    found["all"] = with_only(*SWITCHES)
    found["all, hidden lines removed"] = with_settings(found["all"], {HIDDEN: True})
    found["filled"] = with_settings(found["all"], {"flyover.mode": "filled"})
    return found


def measure(
    environment: Environment,
    rows: dict[str, Settings],
    size: tuple[int, int],
    count: int,
    step: Callable[[str], None] = lambda _: None,
) -> dict[str, Any]:
    """Draw ``count`` frames of the flight with the settings of each row, at ``size`` in pixels.

    Returns {"size", "frames", "side" of the height image, "rows": {name: {"ms", "fps", and the mean
    of each count of a frame}}}. ``step`` is called after each frame with the name of its row.
    """
    anyone = next(iter(rows.values())).flyover
    terrain = environment.field(anyone)
    flight = environment.flight(terrain, anyone)
    times: dict[str, list[float]] = {name: [] for name in rows}
    counts: dict[str, list[dict[str, int]]] = {name: [] for name in rows}
    for number in range(count):
        camera = flight.camera(flight.duration * number / count)
        for name, values in rows.items():
            if not number:
                frame.draw(terrain, camera, values, size)
            start = time.perf_counter()
            drawn = frame.draw(terrain, camera, values, size)
            times[name].append((time.perf_counter() - start) * 1e3)
            counts[name].append(drawn.counts)
            step(name)
    result = {}
    for name in rows:
        ms = float(np.mean(times[name]))
        means = {
            key: round(float(np.mean([each[key] for each in counts[name]])))
            for key in counts[name][0]
        }
        result[name] = {"ms": round(ms, 3), "fps": round(1e3 / ms, 2), **means}
    return {
        "environment": environment.name,
        "side": environment.side,
        "size": list(size),
        "frames": count,
        "rows": result,
    }


def report(result: dict[str, Any]) -> str:
    """Return the results as a table."""
    width, height = result["size"]
    side = result["side"]
    lines = [
        f"{result['environment']}, {side} x {side} heights, {width}x{height}, "
        f"{result['frames']} frames along the path",
        f"{'technique':28}{'lines considered':>18}{'drawn':>10}{'pixels':>10}"
        f"{'ms':>9}{'frames/s':>10}{'times':>8}",
    ]
    slowest = next(iter(result["rows"].values()))["ms"]
    for name, row in result["rows"].items():
        numbers = [f"{row[key]:,}" if key in row else "" for key in COLUMNS]
        lines.append(
            f"{name:28}{numbers[0]:>18}{numbers[1]:>10}{numbers[2]:>10}"
            f"{row['ms']:9.1f}{row['fps']:10.1f}{slowest / row['ms']:8.1f}"
        )
    return "\n".join(lines)
