"""The fly-over's techniques measured: each alone, all but each, all together (section 3).

The same frames of the same path are drawn in turns, one of each row per round, so that a slow
moment of the machine affects all of them: by one process, and by as many as draw together. The
first frame of each row is drawn before, without being timed: what is computed for the whole terrain
is kept from then on, as it is in a flight. Where several processes divide a picture follows from
the one before it, which in a flight is nearly the same; so they draw each once without being timed.
"""

import os
import platform
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from landscape.flyover.camera import Camera
from landscape.flyover.crew import Crew
from landscape.flyover.environment import Environment
from landscape.flyover.settings import Settings
from landscape.settings.declare import with_settings

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
        # Techniques that need this one go with it.
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
    jobs: int = 1,
    step: Callable[[str], None] = lambda _: None,
    version: str = "",
) -> dict[str, object]:
    """Draw ``count`` frames of the flight with the settings of each row, at ``size`` in pixels.

    Returns {"environment", its "hash", "version" of this program, "machine", "size", "frames",
    "side" of the height image, "processes" that drew together, "rows": {name: {"ms" and "fps" of
    these, "alone_ms" of one process, and the mean of each count of a frame}}}. Times are medians.
    ``step`` is called after each frame with the name of its row.
    """
    anyone = next(iter(rows.values())).flyover
    terrain = environment.field(anyone)
    flight = environment.flight(terrain, anyone)
    together: dict[str, list[float]] = {name: [] for name in rows}
    alone: dict[str, list[float]] = {name: [] for name in rows}
    counts: dict[str, list[dict[str, int]]] = {name: [] for name in rows}
    with Crew(terrain, jobs) as crew, Crew(terrain, 1) as single:
        processes = crew.wait()
        for number in range(count):
            camera = flight.camera(flight.duration * number / count)
            for name, values in rows.items():
                if processes > 1 or not number:
                    crew.draw(camera, values, size)
                ms, found = timed(single, camera, values, size)
                alone[name].append(ms)
                counts[name].append(found)
                if processes > 1:
                    ms = timed(crew, camera, values, size)[0]
                together[name].append(ms)
                step(name)

    result = {}
    for name in rows:
        ms = float(np.median(together[name]))
        means = {
            key: round(float(np.mean([each[key] for each in counts[name]])))
            for key in counts[name][0]
        }
        result[name] = {
            "ms": round(ms, 3),
            "fps": round(1e3 / ms, 2),
            "alone_ms": round(float(np.median(alone[name])), 3),
            **means,
        }

    return {
        "environment": environment.name,
        "hash": environment.hash,
        "version": version,
        "machine": machine(),
        "side": environment.side,
        "size": list(size),
        "frames": count,
        "processes": processes,
        "rows": result,
    }


def machine() -> dict[str, str]:
    """Return what the times depend on: the system, the processor, Python and numpy."""
    cores = os.cpu_count() or 1
    return {
        "system": platform.platform(terse=True),
        "processor": f"{processor_name()}, {cores} core{'s' * (cores > 1)}",
        "python": platform.python_version(),
        "numpy": np.__version__,
    }


def processor_name() -> str:
    """Return the processor's name, as Linux has it in a file, or else as Python knows it."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return " ".join(line.partition(":")[2].split())
    except OSError:
        pass
    return platform.processor() or platform.machine() or "unknown processor"


def timed(
    crew: Crew, camera: Camera, values: Settings, size: tuple[int, int]
) -> tuple[float, dict[str, int]]:
    """Draw a frame; return how many milliseconds it took, and its counts."""
    start = time.perf_counter()
    drawn = crew.draw(camera, values, size)
    return (time.perf_counter() - start) * 1e3, drawn.counts


def report(result: dict[str, Any]) -> str:
    """Return the results as a table."""
    width, height = result["size"]
    side = result["side"]
    lines = [
        f"{result['environment']}, {side} x {side} heights, {width}x{height}, "
        f"{result['frames']} frames along the path; processes: {result['processes']}",
        f"{'technique':26}{'lines considered':>17}{'drawn':>10}{'pixels':>10}"
        f"{'ms alone':>10}{'ms':>8}{'frames/s':>9}{'times':>7}",
    ]
    slowest = next(iter(result["rows"].values()))["ms"]
    for name, row in result["rows"].items():
        numbers = [f"{row[key]:,}" if key in row else "" for key in COLUMNS]
        lines.append(
            f"{name:26}{numbers[0]:>17}{numbers[1]:>10}{numbers[2]:>10}"
            f"{row['alone_ms']:10.1f}{row['ms']:8.1f}{row['fps']:9.1f}{slowest / row['ms']:7.1f}"
        )
    return "\n".join(lines)
