"""The frame loop: frame after frame, live or from a recording."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from landscape.walk.app import Walk
from landscape.walk.recording import Tick, Writer
from landscape.walk.waiting import Left

if TYPE_CHECKING:
    from landscape.walk.course import Course


def run(
    walk: Walk,
    ticks: Iterator[Tick] | None = None,
    writer: Writer | None = None,
    frames: int | None = None,
    course: "Course | None" = None,
) -> int:
    """Walk live or replay ``ticks``, for at most ``frames`` frames; return how many were drawn.

    A ``course`` carries the walker along a path.
    """
    drawn = 0
    while frames is None or drawn < frames:
        if walk.resting():
            continue
        if ticks is None or walk.inspection.holds:
            tick = walk.listen()
        else:
            coming = next(ticks, None)
            tick = coming and walk.follow(coming)
        if tick is None:
            break
        if 0 in tick.size:
            continue
        if writer is not None:
            writer.add(tick)
        if course is not None:
            tick = course.take(tick)
        try:
            walk.advance(tick)
        except Left:
            break
        if course is not None:
            walk.walker = course.carried(walk.walker, tick.seconds)
        walk.draw()
        walk.present()
        drawn += 1

    return drawn
