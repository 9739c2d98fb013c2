"""Captions: what is heard, in words, with an arrow to where it comes from.

For those who hear little or nothing, or whose sound is off. Names are keys; who shows them
translates. No OpenGL here.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from landscape.sound.score import Event, Heard
from landscape.sound.signal import RATE

ARROWS = "↑↗→↘↓↙←↖"  # from straight ahead on, by the right
FAINT, CLEAR = 0.04, 0.14  # chosen: amplitudes from which on a sound is shown, and is fully opaque
LASTS, FADES = 1.6, 0.8  # chosen: seconds that a short sound is shown, and at their end fades
LEVELS = 5  # chosen: of opacity, so that the picture is not made again at each frame
MOST = 5  # chosen: lines


@dataclass(frozen=True)
class Line:
    """A caption: what sounds, an arrow of ARROWS or "", and its opacity, 0 to 1."""

    name: str
    arrow: str
    opacity: float


def lines(now: Heard, events: Sequence[Event], seconds: float) -> tuple[Line, ...]:
    """Return the captions at a time: short sounds first, the last one at the top."""
    found: dict[str, Line] = {}
    for event in sorted(events, key=lambda event: -event.sample):
        since = seconds - event.sample / RATE
        opacity = stepped(min((LASTS - since) / FADES, 1.0))
        if since >= 0.0 and opacity > 0.0 and event.name not in found:
            found[event.name] = Line(event.name, "", opacity)
    for source in now.soundscape.sources(now.ear):
        opacity = stepped((source.loudness - FAINT) / (CLEAR - FAINT))
        if opacity > 0.0:
            found[source.name] = Line(source.name, arrow(source.relative), opacity)
    return tuple(found.values())[:MOST]


def stepped(opacity: float) -> float:
    """Return an opacity in LEVELS steps; 0 only where there is nothing to see."""
    if opacity <= 0.0:
        return 0.0
    return max(round(min(opacity, 1.0) * LEVELS), 1) / LEVELS


def arrow(relative: float | None) -> str:
    """Return the arrow to what is ``relative`` degrees to the right; "" for what is all around."""
    if relative is None:
        return ""
    return ARROWS[round(relative / 360.0 * len(ARROWS)) % len(ARROWS)]
