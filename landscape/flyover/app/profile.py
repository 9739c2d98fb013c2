"""Where the time of a flight goes: Python's own profiler over its frames (`flyover --profile`).

One process draws, as those of a crew would each be profiled alone. The first frame is left out:
what is computed for the whole terrain is kept from then on.
"""

import cProfile
import io
import pstats
from collections.abc import Callable
from pathlib import Path

from landscape.flyover.crew import Crew
from landscape.flyover.environment import Environment
from landscape.flyover.settings import Settings

PACKAGE = Path(__file__).resolve().parents[2]
LINES = 25  # chosen: functions listed


def profile(
    environment: Environment,
    values: Settings,
    size: tuple[int, int],
    count: int,
    step: Callable[[str], None] = lambda _: None,
) -> str:
    """Return a table of the functions in which ``count`` frames along the path spend their time."""
    terrain = environment.field(values.flyover)
    flight = environment.flight(terrain, values.flyover)
    cameras = [flight.camera(flight.duration * number / count) for number in range(count)]
    profiler = cProfile.Profile()
    with Crew(terrain, 1) as crew:
        crew.draw(cameras[0], values, size)
        for camera in cameras:
            profiler.enable()
            crew.draw(camera, values, size)
            profiler.disable()
            step("profile")

    table = io.StringIO()
    stats = pstats.Stats(profiler, stream=table)
    stats.sort_stats("tottime").print_stats(LINES)
    width, height = size
    head = f"{environment.name}, {width}x{height}, {count} frames along the path, one process"
    rows = [line.replace(f"{PACKAGE}/", "") for line in table.getvalue().splitlines()]
    return "\n".join([head, *(line.rstrip() for line in rows if line.strip())])
