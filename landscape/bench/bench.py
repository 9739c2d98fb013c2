"""Measure what a frame costs, and how much of that is Python's share (`landscape bench`).

The time of a frame is given in *layers*: one layer is the time of a full-screen, trilinear-filtered
textured quad in EXP2 fog, of the same size. It is also compared with the frame's *replay*: the same
frame compiled into display lists and called, which is what OpenGL alone needs. Medians are taken.
Every combination of states is drawn before it is timed, as llvmpipe compiles code at first use.
"""

import json
import subprocess
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any, TypeVar

from framelens.base.errors import InputError
from framelens.base.isolated import started
from framelens.gl.context import open_context
from framelens.gl.framebuffer import still_target
from framelens.gl.replay import Replay
from framelens.gl.seam import gl, recording
from landscape.bench import blades as bench_blades
from landscape.bench import tone
from landscape.bench.timing import Layer, in_turns
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.frame import SEED
from landscape.scene.scene import (
    SCENES,
    Moment,
    OpenScene,
    Scene,
    SceneSettings,
    View,
    find_view,
    placed,
    raised,
    scene,
)
from landscape.settings import declare

T = TypeVar("T")
STARTS = 3  # chosen: starts that count; one more comes first, to fill the disk caches
RATE = 30.0  # chosen: frames per second at which the walker approaches a timed view
LOOK = 30.0  # chosen: degrees per second by which the walker turns meanwhile

_FIRST_FRAME = """
import json, sys, time
from landscape import cli
from landscape.offscreen import Offscreen
from landscape.scene.scene import SCENES
asked = json.loads(sys.argv[1])
SCENES.update(asked.pop("scenes"))
view, size = asked.pop("view"), asked.pop("size")
offscreen = Offscreen(tuple(size), **asked)
offscreen.look(view)
offscreen.draw()
print(time.perf_counter())
offscreen.close()
"""


@dataclass(frozen=True)
class Options:
    """What to measure, and how: the common options of the command line, and how often."""

    views: Sequence[str] = field(default_factory=lambda: scene().main)
    size: tuple[int, int] = (800, 600)
    preset: str | None = None
    settings: Mapping[str, object] = field(default_factory=dict)
    backend: str = "auto"
    samples: int = 0
    assets: Path | None = None
    only: Iterable[str] | None = None
    seed: int = SEED
    wireframe: bool = False
    rounds: int = 15  # chosen: how often each thing is timed
    grass: Sequence[int] = bench_blades.COUNTS
    ways: int = bench_blades.BLADES  # blades of the comparison against 2006; 0 leaves it out
    starts: int = STARTS

    def values(self, kind: Scene, view: View) -> SceneSettings:
        """Return the settings a view is drawn with."""
        return kind.values(
            kind.preset_of(view) if self.preset is None else self.preset,
            view.settings,
            self.settings,
        )

    @property
    def grassy(self) -> bool:
        """Whether the scene of the first view has grass, which is then measured too."""
        return "grass" in _kind(self).elements

    @property
    def toned(self) -> bool:
        """Whether the first view's scene changes brightness and contrast, which is then timed."""
        return "tone" in _kind(self).elements and not self.samples


def _kind(options: Options) -> Scene:
    return find_view(options.views[0])[0] if options.views else scene()


def measure(options: Options, done: Callable[[str], None] = lambda name: None) -> dict[str, object]:
    """Measure all that is asked for; return what `bench --json` prints; call ``done`` per step.

    - ``layer_ms``: the median time of one layer, measured between the frames.
    - ``views``, for each view: ``frame_ms``, a whole frame as in the walk, drawn just after the
      frame one step before it; ``replay_ms``, the same frame as display lists; ``python_ms``, their
      difference, which is what Python, PyOpenGL and sending the frame's arrays cost (noise can
      bring it below 0); ``python_tax``, frame_ms / replay_ms; ``layers``, frame_ms / layer_ms;
      ``gl_calls``, how many calls the program makes in the frame.
    - ``grass`` and ``ways``: see :mod:`landscape.bench.blades`; empty for a scene without
      grass.
    - ``tone``: see :mod:`landscape.bench.tone`; empty for a scene without it.
    - ``startup_ms``: see :func:`measure_startup`; null if no start was asked for.
    """
    context = open_context(options.backend)
    try:
        target = still_target(context, options.size, options.samples)
        try:
            result: dict[str, object] = {
                "renderer": gl.glGetString(gl.GL_RENDERER).decode(),
                "size": list(options.size),
                "preset": options.preset or _kind(options).preset,
                "settings": {key: str(value) for key, value in options.settings.items()},
            }
            result |= measure_views(options, done)
            result |= measure_blades(options, done)
            result["tone"] = measure_tone(options, done)
        finally:
            target.release()
    finally:
        context.release()

    result["startup_ms"] = None
    if options.starts:
        result["startup_ms"] = _told(measure_startup(options), "start", done)
    return result


def steps(options: Options) -> int:
    """Return how often :func:`measure` will call ``done``."""
    blades = len(options.grass) + bool(options.ways) if options.grassy else 0
    tones = len(tone.CASES) if options.toned else 0
    return len(options.views) + blades + tones + bool(options.starts)


def _told(value: T, name: str, done: Callable[[str], None]) -> T:
    done(name)
    return value


def measure_views(options: Options, done: Callable[[str], None]) -> dict[str, object]:
    """Return ``layer_ms`` and ``views``; views with the same settings share one open scene."""
    groups = _groups(options)
    layer = Layer(options.size)
    times: dict[str, list[float]] = {}
    calls: dict[str, int] = {}
    try:
        for (kind_name, values), names in groups.items():
            times |= _measure_group(options, scene(kind_name), values, names, layer, calls, done)
    finally:
        layer.release()

    layer_ms = median(t for k, v in times.items() if k.endswith(" layer") for t in v)
    views = {}
    for name in calls:
        frame_ms, replay_ms = median(times[f"{name} frame"]), median(times[f"{name} replay"])
        views[name] = _costs(frame_ms, replay_ms, layer_ms) | {"gl_calls": calls[name]}
    return {"layer_ms": layer_ms, "views": views}


def _groups(options: Options) -> dict[tuple[str, SceneSettings], list[str]]:
    """Return the names of the views by scene and settings."""
    groups: dict[tuple[str, SceneSettings], list[str]] = {}
    for name in dict.fromkeys(options.views):
        kind, view = find_view(name)
        groups.setdefault((kind.name, options.values(kind, view)), []).append(name)
    return groups


def _costs(frame_ms: float, replay_ms: float, layer_ms: float) -> dict[str, float]:
    """Return what a view's frame costs, itself and compared with its replay and with a layer."""
    return {
        "frame_ms": frame_ms,
        "layers": frame_ms / layer_ms,
        "python_ms": frame_ms - replay_ms,
        "replay_ms": replay_ms,
        "python_tax": frame_ms / replay_ms,
    }


def _measure_group(
    options: Options,
    kind: Scene,
    values: SceneSettings,
    names: Sequence[str],
    layer: Layer,
    calls: dict[str, int],
    done: Callable[[str], None],
) -> dict[str, list[float]]:
    """Time frames, replays and layers of views that share a scene; count the frames' calls."""
    views = {name: find_view(name)[1] for name in names}
    shown = {e for view in views.values() for e in kind.shown(view, options.only)}
    opened = kind.open(values, Assets(options.assets), options.seed, kind.only(shown))
    lists: list[Replay] = []
    actions: dict[str, Callable[[], object]] = {}
    before: dict[str, Callable[[], object]] = {}
    try:
        for name in names:
            shown_here = set(kind.shown(views[name], options.only))
            draw = partial(draw_view, views[name], opened, shown_here, options)
            draw()  # the first frame makes what is made only once
            with recording() as recorder:
                draw()
                calls[name] = len(recorder.calls)
            # A frame reads the camera's matrix back, but compiling a list sets no matrix. The
            # frame just drawn has left the very matrix that will be read.
            draw()
            lists.append(Replay(draw))
            # A layer timed beside each view meets the same slow moments.
            actions |= {
                f"{name} frame": draw,
                f"{name} replay": lists[-1].call,
                f"{name} layer": layer.draw,
            }
            before[f"{name} frame"] = partial(draw, arriving=True)
            done(name)

        return in_turns(actions, options.rounds, before)
    finally:
        for list_ in lists:
            list_.release()
        opened.release()


def draw_view(
    view: View, opened: OpenScene, shown: set[str], options: Options, arriving: bool = False
) -> None:
    """Draw one frame of a view of an open scene; if ``arriving``, the frame one step before.

    It is a frame of a walk. In a still, a scene may draw at once what a walk draws over several
    frames, such as the next square of a shadow map, and a view on the border of two would pay for
    that in each frame.
    """
    opened.shown = shown
    values = opened.settings
    eye = values.walk.eye
    pose = raised(placed(view.pose, opened, eye), opened, eye)
    kt = view.kt
    if arriving:
        x, _, z = pose.forward
        back = values.walk.speed / RATE
        pose = replace(pose, x=pose.x - back * x, z=pose.z - back * z, yaw=pose.yaw - LOOK / RATE)
        kt -= values.clock.kt_per_second / RATE

    wireframe = options.wireframe or view.wireframe
    moment = Moment(pose, options.size, kt, stroke=view.stroke, wireframe=wireframe, walking=True)
    opened.draw(moment)


def measure_blades(options: Options, done: Callable[[str], None]) -> dict[str, object]:
    """Return ``grass`` and ``ways``, if there is grass."""
    if not options.grassy:
        return {"grass": [], "ways": []}
    kind = _kind(options)
    values = declare.with_settings(kind.values(options.preset), options.settings)
    assert isinstance(values, Settings)  # the scene with grass is the island
    common = options.size, Assets(options.assets), options.seed
    grass = [
        _told(
            bench_blades.measure_grass(values, count, *common, options.rounds), f"{count:,}", done
        )
        for count in options.grass
    ]
    rounds = max(1, options.rounds // 3)
    ways = []
    if options.ways:
        ways = bench_blades.measure_ways(values, options.ways, *common, rounds)
        done("2006")
    return {"grass": grass, "ways": ways}


def measure_tone(options: Options, done: Callable[[str], None]) -> list[tone.Row]:
    """Return ``tone``, if there is any."""
    if not options.toned:
        return []
    values = declare.with_settings(_kind(options).values(options.preset), options.settings)
    return tone.measure_tone(values, options.size, Assets(options.assets), options.rounds, done)


def measure_startup(options: Options) -> float:
    """Return the median time in milliseconds from the command to the first drawn frame.

    Each start is a new process: the interpreter, all imports, the context, building the scene, one
    frame read back. One more start comes first and is not counted, so that disk caches are warm.
    """
    asked = {
        "view": options.views[0] if options.views else _kind(options).start,
        "scenes": SCENES,
        "size": list(options.size),
        "preset": options.preset,
        "settings": dict(options.settings),
        "backend": options.backend,
        "samples": options.samples,
        "assets": None if options.assets is None else str(options.assets),
        "only": None if options.only is None else list(options.only),
        "seed": options.seed,
    }
    times = []
    for _ in range(options.starts + 1):
        start = time.perf_counter()  # a clock that all processes of a system share
        words = ["-c", _FIRST_FRAME, json.dumps(asked)]
        with started(words, {}, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE) as process:
            drawn_at, _errors = process.communicate()
        if not drawn_at:
            raise InputError("bench: the program started in another process drew no frame")
        times.append((float(drawn_at) - start) * 1e3)

    return median(times[1:])


def report(result: Mapping[str, Any]) -> str:
    """Return the results as tables of text."""
    width, height = result["size"]
    wide = max(map(len, result["views"]), default=0) + 2
    lines = [f"{result['renderer']}, {width}x{height}, preset {result['preset']}"]
    if result["views"]:
        lines += [
            f"one layer: {result['layer_ms']:.2f} ms",
            "",
            f"{'view':{wide}}  frame ms  layers  replay ms  python ms   tax   calls",
        ]

    for name, view in result["views"].items():
        lines.append(
            f"{name:{wide}} {view['frame_ms']:9.1f} {view['layers']:7.1f} {view['replay_ms']:10.1f}"
            f" {view['python_ms']:10.1f} {view['python_tax']:5.2f} {view['gl_calls']:7d}"
        )

    lines += bench_blades.report(result) + tone.report(result["tone"])
    if result["startup_ms"] is not None:
        lines += ["", f"from the command to the first frame: {result['startup_ms']:.0f} ms"]
    return "\n".join(lines)
