"""Film the walk as a slow computer draws it: the picture at the top of README.md.

`python scripts/walk_loop.py FILE.webp [VIEW] [RUNG]` walks ahead from a view for some seconds, with
the detail of a rung of the pace, and writes a loop whose end fades into its beginning.
"""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from landscape.bench.moving import Options, opened, pictures
from landscape.scene.scene import find_view
from landscape.walk.pace import WALKING
from landscape.walk.walker import Intent

SIZE = (1280, 720)  # of the window
SHOWN = (720, 405)  # of the loop
FRAMES, SKIPPED, EVERY, FADE = 120, 6, 2, 8  # frames of the walk; of the loop, every second
QUALITY = 42


def walked(view: str, rung: int) -> list[np.ndarray]:
    """Return the frames of a walk from a view, uint8 (h, w, 3)."""
    kind, found = find_view(view)
    with opened(Options([view], SIZE), kind, found) as walk:
        moments = []
        for _ in range(FRAMES):
            tick = walk.listen()
            walk.advance(replace(tick, seconds=1 / 30, intent=Intent(forward=0.6)))
            moments.append(replace(walk.moment, detail=WALKING[rung].detail))
        wanted = set(range(SKIPPED, FRAMES, EVERY))
        drawn = pictures(walk.place.scene, moments, wanted)
        return [drawn[number].pixels for number in sorted(wanted)]


def looped(frames: list[np.ndarray]) -> list[Image.Image]:
    """Return the frames, the last of them mixed with the first."""
    images = [Image.fromarray(frame).resize(SHOWN, Image.Resampling.LANCZOS) for frame in frames]
    body, end = images[FADE:-FADE], images[-FADE:]
    parts = (np.arange(FADE) + 1.0) / (FADE + 1.0)
    fade = [Image.blend(a, b, part) for a, b, part in zip(end, images[:FADE], parts, strict=True)]
    return [*body, *fade]


def main() -> None:
    """Write the loop."""
    file, view, rung = (*sys.argv[1:], *("", "fig35c", "6")[len(sys.argv) - 1 :])[:3]
    frames = looped(walked(view, int(rung)))
    frames[0].save(
        Path(file),
        save_all=True,
        append_images=frames[1:],
        duration=round(1000 * EVERY / 30),
        loop=0,
        quality=QUALITY,
        method=6,
    )


if __name__ == "__main__":
    main()
