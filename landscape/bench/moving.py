"""Measures the picture during a walk: frames per second, and how far frames are from stills.

`landscape bench --moving` opens the walk's own window, walks ahead and turns for five seconds of
real time as the walk draws them, and keeps what each frame showed and with how much detail. Then,
with time to spare, some of these frames are drawn again: as the walk drew them, and with all their
detail. So what is compared is what the user saw and the still at the same pose and moment.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

from framelens.base.errors import NoOpenGLError
from framelens.gl.contexts.glfw import GLFWContext
from framelens.gl.framebuffer import read_pixels
from framelens.gl.glfw_library import glfw
from framelens.gl.seam import gl
from landscape.files.assets import Assets
from landscape.frame import FULL, SEED
from landscape.scene.scene import Moment, OpenScene, Scene, View, find_view
from landscape.walk.app import Walk
from landscape.walk.pace import FPS
from landscape.walk.recording import Plan
from landscape.walk.stretch import Stretch
from landscape.walk.walker import Intent

SECONDS = 5.0  # chosen: how long each view is walked from
SWING = 24.0  # chosen: degrees per second by which the walker turns, to one side and back
SAMPLES = 12  # chosen: frames of a walk that are compared with stills
BLOCK = 4  # pixels along each side of the squares whose means are compared
APART = 16.0  # levels of 255 by which the mean of a square may differ
TIMED = 3  # chosen: runs of frames with all detail that are timed
RUN = 3  # chosen: frames of such a run


@dataclass(frozen=True)
class Options:
    """What to measure: the views, and the options of `landscape walk`."""

    views: Sequence[str]
    size: tuple[int, int]
    preset: str | None = None
    settings: Mapping[str, object] = field(default_factory=dict)
    backend: str = "auto"
    assets: Path | None = None
    only: Sequence[str] | None = None
    seed: int = SEED
    fps: float = FPS
    seconds: float = SECONDS


@dataclass(frozen=True)
class WalkedFrame:
    """A frame of a walk: what it showed, with its detail, and the rung of the pace."""

    moment: Moment
    rung: int


def measure(options: Options, done: Callable[[str], None] = lambda name: None) -> dict[str, Any]:
    """Return ``renderer``, ``size`` and ``moving``; call ``done`` after each view.

    ``moving`` has, for each view, over the seconds walked from it:

    - ``fps``: frames a second, as the walk starts and with its pace.
    - ``off``: the fraction of the picture that is off; see :func:`off`. Sword and map are left out.
    - ``rung``: the median rung of the pace; at 0 all detail is drawn.
    - ``fps_full``: frames a second of the same walk with all detail.
    - ``flicker``, ``flicker_full``: see :func:`flicker`, as walked and with all detail.
    """
    result: dict[str, Any] = {"size": list(options.size), "moving": {}}
    for name in dict.fromkeys(options.views):
        kind, view = find_view(name)
        with opened(options, kind, view) as walk:
            result["renderer"] = gl.glGetString(gl.GL_RENDERER).decode()
            result["moving"][name] = _measure(walk, options)
        done(name)
    return result


@contextmanager
def opened(options: Options, kind: Scene, view: View) -> Iterator[Walk]:
    """Open a view's walk as `landscape walk VIEW` does."""
    begin = kind.as_walked(view, options.preset)
    plan = Plan(
        scene=kind.name,
        settings=kind.values(kind.preset_of(begin), begin.settings, options.settings),
        view=begin.name,
        pose=begin.pose,
        size=options.size,
        kt=begin.kt,
        seed=options.seed,
        only=kind.shown(begin, None) if options.only is None else kind.only(options.only),
        wireframe=begin.wireframe,
        preset=kind.preset_of(begin),
    )
    with Walk(plan, Assets(options.assets), _window(options.backend), fps=options.fps) as walk:
        yield walk


def _window(backend: str) -> str:
    """Return what opens the window; in place of auto, what needs no screen where there is none."""
    if backend != "auto":
        return backend
    try:
        GLFWContext().release()
    except NoOpenGLError:
        return "headless"
    return "auto"


def _measure(walk: Walk, options: Options) -> dict[str, float]:
    """Walk, then compare."""
    place = walk.place
    frames, seconds = _walk(walk, options.seconds)
    whole = [replace(frame.moment, detail=FULL) for frame in frames]
    fps_full = _fps_full(walk, place.scene, whole)
    place.scene.shown -= set(place.kind.overlay)

    # The second of each pair is compared with its still; the first tells how they flicker.
    step = max(len(frames) // SAMPLES, 2)
    chosen = [n for n in range(1, len(frames)) if n % step == 1]
    pairs = {n for last in chosen for n in (last - 1, last)}
    as_walked = pictures(place.scene, [frame.moment for frame in frames], pairs)
    stills = pictures(place.scene, [whole[n] for n in sorted(pairs)], set(range(len(pairs))))
    stills = dict(zip(sorted(pairs), stills.values(), strict=True))
    return {
        "fps": len(frames) / seconds if frames else 0.0,
        "rung": median(frame.rung for frame in frames) if frames else 0,
        "fps_full": fps_full,
        **_compared(as_walked, stills, chosen),
    }


def _compared(
    as_walked: "Mapping[int, Picture]", stills: "Mapping[int, Picture]", chosen: Sequence[int]
) -> dict[str, float]:
    """Return how far chosen frames of a walk are off from their stills, and how both flicker."""
    offs = []
    flickers = []
    flickers_full = []
    for n in chosen:
        offs.append(off(as_walked[n].pixels, stills[n].pixels))
        seen = carried(stills[n - 1], stills[n])
        flickers.append(flicker(as_walked[n - 1].pixels, as_walked[n].pixels, seen))
        flickers_full.append(flicker(stills[n - 1].pixels, stills[n].pixels, seen))

    return {
        "off": float(np.mean(offs)) if offs else 0.0,
        "flicker": float(np.mean(flickers)) if flickers else 0.0,
        "flicker_full": float(np.mean(flickers_full)) if flickers_full else 0.0,
    }


def _walk(walk: Walk, seconds: float) -> tuple[list[WalkedFrame], float]:
    """Walk for so many seconds; return the frames, and the time that they took.

    It ends where a door would lead to another scene.
    """
    frames: list[WalkedFrame] = []
    place = walk.place
    begin = now = glfw.get_time()
    while now - begin < seconds:
        tick = walk.listen()
        if tick is None:
            break
        outwards = not seconds / 4 <= now - begin < 3 * seconds / 4
        swing = SWING / place.settings.walk.turn
        tick = replace(tick, intent=Intent(forward=1.0, turn=swing if outwards else -swing))
        walk.advance(tick)
        if walk.place is not place:
            break
        walk.draw()
        frames.append(
            WalkedFrame(replace(walk.moment, detail=walk.steady.detail), walk.steady.level)
        )
        walk.present()
        now = glfw.get_time()

    return frames, now - begin


def _fps_full(walk: Walk, opened: OpenScene, moments: Sequence[Moment]) -> float:
    """Return the frames a second with all detail, of some runs of the moments of a walk."""
    times = []
    for start in np.linspace(0, max(len(moments) - RUN - 1, 0), TIMED).astype(int):
        for n, moment in enumerate(moments[start : start + RUN + 1]):
            begin = glfw.get_time()
            opened.draw(moment)
            gl.glFinish()
            glfw.swap_buffers(walk.window)
            if n:  # the first of a run chooses what to draw from anew
                times.append(glfw.get_time() - begin)
    return 1.0 / float(np.mean(times)) if times else 0.0


@dataclass(frozen=True)
class Picture:
    """Pixels, uint8 (h, w, 3), and depths, float32 (h, w) in 0..1, both from the top row down.

    ``matrix`` (4, 4) takes world coordinates, as columns, to clip coordinates.
    """

    pixels: np.ndarray
    depths: np.ndarray
    matrix: np.ndarray


def pictures(opened: OpenScene, moments: Sequence[Moment], wanted: set[int]) -> dict[int, Picture]:
    """Draw all the moments, one after another as a walk does; return those that are wanted."""
    found = {}
    stretch = Stretch()
    try:
        for n, moment in enumerate(moments):
            stretch.draw(moment, opened.draw, interlaced=False)
            if n in wanted:
                found[n] = Picture(read_pixels(moment.size), _depths(moment.size), _matrix())
    finally:
        stretch.release()
    return found


def _depths(size: tuple[int, int]) -> np.ndarray:
    read = gl.glReadPixels(0, 0, *size, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
    return np.array(read, np.float32).reshape(size[::-1])[::-1]


def _matrix() -> np.ndarray:
    matrices = gl.GL_PROJECTION_MATRIX, gl.GL_MODELVIEW_MATRIX
    # OpenGL returns them by columns.
    projection, modelview = (np.array(gl.glGetDoublev(name)).reshape(4, 4).T for name in matrices)
    return np.asarray(projection @ modelview)


def means(pixels: np.ndarray) -> np.ndarray:
    """Return the means (h / 4, w / 4, 3) of squares of 4x4 pixels; what is left over is cut off."""
    height, width = (side // BLOCK for side in pixels.shape[:2])
    cut = pixels[: height * BLOCK, : width * BLOCK].astype(np.float32)
    return np.asarray(cut.reshape(height, BLOCK, width, BLOCK, 3).mean(axis=(1, 3)))


def off(walked: np.ndarray, still: np.ndarray) -> float:
    """Return the fraction of squares of 4x4 pixels whose mean differs by more than 16 levels.

    The pictures are uint8 (h, w, 3); the channel that differs most counts.
    """
    apart = np.abs(means(walked) - means(still)).max(axis=2)
    return float((apart > APART).mean())


def _clip_coordinates(depths: np.ndarray) -> np.ndarray:
    """Return where the pixels of a picture are, (4, h, w) in its clip coordinates with w 1."""
    height, width = depths.shape
    rows, columns = np.mgrid[:height, :width].astype(np.float64)
    x = (columns + 0.5) / width * 2.0 - 1.0
    y = 1.0 - (rows + 0.5) / height * 2.0
    return np.stack([x, y, depths * 2.0 - 1.0, np.ones_like(x)])


def _alike(then: np.ndarray, now: np.ndarray) -> np.ndarray:
    """Return where depths, 0..1, are those of the same thing: they differ by a twentieth at most.

    Depths are crowded at 1: their distance from it is what is compared.
    """
    then, now = 1.0 - then, 1.0 - now
    return np.asarray(np.abs(then - now) <= 0.05 * np.maximum(then, now) + 1e-6)


def carried(earlier: Picture, later: Picture) -> np.ndarray:
    """Return where in the earlier picture each pixel of the later one was, (h, w, 2) in pixels.

    NaN where that is outside the picture, or where something else was seen there then.
    """
    height, width = later.depths.shape
    there = _clip_coordinates(later.depths)
    back = (earlier.matrix @ np.linalg.inv(later.matrix) @ there.reshape(4, -1)).reshape(
        4, height, width
    )
    x, y, depth = back[:3] / back[3]
    at = np.stack([(1.0 - y) / 2.0 * height - 0.5, (x + 1.0) / 2.0 * width - 0.5], axis=2)
    nearest = np.rint(at).astype(int)
    inside = (nearest >= 0).all(axis=2) & (nearest < (height, width)).all(axis=2) & (back[3] > 0)
    nearest[~inside] = 0

    same = _alike(earlier.depths[nearest[..., 0], nearest[..., 1]], (depth + 1.0) / 2.0)
    return np.where((inside & same)[..., None], at, np.nan)


def flicker(earlier: np.ndarray, later: np.ndarray, at: np.ndarray) -> float:
    """Return by how many levels of 255 pixels differ from what they were in the frame before.

    The earlier picture, uint8 (h, w, 3), is moved by where the pixels were, ``at`` (h, w, 2).
    """
    known = ~np.isnan(at[..., 0])
    if not known.any():
        return 0.0
    moved = _looked_up(earlier.astype(np.float32), at[known])
    return float(np.abs(later[known] - moved).mean())


def _looked_up(pixels: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Return the colours (n, 3) of a picture (h, w, 3) at rows and columns (n, 2), interpolated."""
    row, column = at.T
    height, width = pixels.shape[:2]
    top, left = np.clip(np.floor(row), 0, height - 2), np.clip(np.floor(column), 0, width - 2)
    down, right = np.clip(row - top, 0, 1)[:, None], np.clip(column - left, 0, 1)[:, None]
    top, left = top.astype(int), left.astype(int)
    upper = pixels[top, left] * (1 - right) + pixels[top, left + 1] * right
    lower = pixels[top + 1, left] * (1 - right) + pixels[top + 1, left + 1] * right
    return np.asarray(upper * (1 - down) + lower * down)


def report(result: Mapping[str, Any]) -> str:
    """Return the results as a table of text."""
    width, height = result["size"]
    wide = max(map(len, result["moving"]), default=0) + 2
    lines = [
        f"{result['renderer']}, {width}x{height}, walking",
        "",
        f"{'view':{wide}}     fps   off %  rung  fps full  flicker  flicker full",
    ]
    for name, view in result["moving"].items():
        lines.append(
            f"{name:{wide}} {view['fps']:7.1f} {100 * view['off']:7.1f} {view['rung']:5.0f}"
            f" {view['fps_full']:9.1f} {view['flicker']:8.2f} {view['flicker_full']:13.2f}"
        )
    return "\n".join(lines)
