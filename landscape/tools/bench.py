"""Measuring: what a frame costs, and what of it is Python's doing (`landscape bench`).

Milliseconds say little on a machine that does other things as well, so two ratios are printed. A
frame is measured in *layers*, times a full-screen, trilinear-filtered, EXP2-fogged textured quad of
the same size; and against its *replay*, the same frame compiled into one display list and called,
which is what OpenGL alone needs. What is compared is timed in turns, a round of each, so that a
slow moment meets all of them; medians are taken. Every time ends in glFinish, and every
combination of states is drawn before it is timed: llvmpipe compiles code at its first use.
"""

import json
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from statistics import median
from types import SimpleNamespace
from typing import Any, cast

import numpy as np

from landscape import keys
from landscape import settings as settings_module
from landscape.elements import meadow, sun
from landscape.elements.grass import Grass
from landscape.elements.ground import Ground
from landscape.elements.meadow.meadow import Meadow
from landscape.errors import InputError
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.gl.calls import gl, recording
from landscape.gl.context import open_context
from landscape.gl.display_list import DisplayList
from landscape.gl.framebuffer import Framebuffer
from landscape.gl.replay import Replay
from landscape.gl.state import attrib, flat_projection
from landscape.gl.texture import Texture
from landscape.island import ELEMENTS, SEED, Island, Moment
from landscape.settings import Settings
from landscape.tools.bench_grass import WAYS, sow
from landscape.views import VIEWS

MAIN_VIEWS = tuple(f"fig35{panel}" for panel in "abcdefghi")
GRASS_VIEW = "fig35b"  # chosen: dense grass
LOT = 200_000  # section 5.3.1: blades on the island
COUNTS = (LOT, 1_500_000, 10_000_000)
MOST_ON_ISLAND = 1_500_000  # section 5.3.1; more blades stand on proportionally larger land
STARTS = 3  # chosen: the first of one more start fills the disk caches
RATE = 30.0  # chosen: frames a second at which the walker comes to a view that is timed
LOOK = 30.0  # chosen: degrees per second he turns then

_FIRST_FRAME = """
import json, sys
from landscape import cli
from landscape.render import Offscreen
asked = json.loads(sys.argv[1])
view, size = asked.pop("view"), asked.pop("size")
offscreen = Offscreen(tuple(size), **asked)
offscreen.look(view)
offscreen.draw()
print("drawn", flush=True)
sys.stdin.read()
offscreen.close()
"""


@dataclass(frozen=True)
class Plan:
    """What to measure, and how: the common options of the command line, and how often."""

    views: Sequence[str] = MAIN_VIEWS
    size: tuple[int, int] = (800, 600)
    preset: str = "best"
    settings: Mapping[str, Any] = field(default_factory=dict)
    backend: str = "auto"
    samples: int = 0
    assets: Path | None = None
    only: tuple[str, ...] = ELEMENTS
    seed: int = SEED
    wireframe: bool = False
    rounds: int = 15  # chosen: how often each thing is timed
    grass: Sequence[int] = COUNTS
    ways: int = LOT  # blades of the comparison against 2006; 0 leaves it out
    starts: int = STARTS

    def values(self, changes: Mapping[str, Any]) -> Settings:
        """Return the preset with a view's settings and then the user's own."""
        base = settings_module.preset(self.preset)
        return keys.with_settings(base, {**changes, **self.settings})


def timed(action: Callable[[], object]) -> float:
    """Return how long ``action`` takes, in milliseconds, all drawing done before and after."""
    gl.glFinish()
    start = time.perf_counter()
    action()
    gl.glFinish()
    return (time.perf_counter() - start) * 1e3


def in_turns(
    actions: Mapping[str, Callable[[], object]],
    rounds: int,
    before: Mapping[str, Callable[[], object]] | None = None,
) -> dict[str, list[float]]:
    """Time the actions one after the other, ``rounds`` times, each on a cleared target.

    Returns the times of each in milliseconds. Each is run twice first. ``before`` holds what is
    done, untimed, before an action each time.
    """
    times: dict[str, list[float]] = {name: [] for name in actions}
    for turn in range(-2, rounds):
        for name, action in actions.items():
            if before and name in before:
                before[name]()
            clear()
            spent = timed(action)
            if turn >= 0:
                times[name].append(spent)
    return times


def clear() -> None:
    """Clear what is drawn on."""
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)


class Layer:
    """The yardstick: a full-screen quad, trilinear-filtered, depth-tested, in EXP2 fog."""

    SIDE = 512  # chosen: texels per side
    TEXELS = 1.4142  # chosen: texels per pixel, half-way between two mip levels

    def __init__(self, size: tuple[int, int]) -> None:
        """Make a texture of noise."""
        noise = np.random.default_rng(SEED).integers(0, 256, (self.SIDE, self.SIDE, 3), np.uint8)
        self._texture = Texture(noise)
        self._size = size

    def draw(self) -> None:
        """Cover the whole target, which must have been cleared."""
        s, t = (self.TEXELS * side / self.SIDE for side in self._size)
        groups = gl.GL_ENABLE_BIT | gl.GL_FOG_BIT | gl.GL_CURRENT_BIT | gl.GL_VIEWPORT_BIT
        with attrib(groups), flat_projection(-1, 1, -1, 1, 1, 9):
            gl.glViewport(0, 0, *self._size)
            for off in (gl.GL_LIGHTING, gl.GL_BLEND, gl.GL_CLIP_PLANE0, gl.GL_STENCIL_TEST):
                gl.glDisable(off)
            for on in (gl.GL_DEPTH_TEST, gl.GL_TEXTURE_2D, gl.GL_FOG):
                gl.glEnable(on)
            gl.glFogi(gl.GL_FOG_MODE, gl.GL_EXP2)
            gl.glFogf(gl.GL_FOG_DENSITY, 0.1)
            self._texture.bind()
            gl.glColor4f(1.0, 1.0, 1.0, 1.0)
            gl.glBegin(gl.GL_QUADS)
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                gl.glTexCoord2f(s * (x + 1) / 2, t * (y + 1) / 2)
                gl.glVertex3f(x, y, -5.0)
            gl.glEnd()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()


def measure(plan: Plan, done: Callable[[str], None] = lambda name: None) -> dict[str, Any]:
    """Measure all of the plan; return what `bench --json` prints. ``done`` hears of each step.

    - ``layer_ms``: the median time of one layer, measured between the frames.
    - ``views``: ``frame_ms`` a whole frame, drawn as the walk draws it, the frame of a step before
      having been drawn just then; ``replay_ms`` the same
      frame as one display list; ``python_ms`` their difference, which is what Python, PyOpenGL and
      sending the frame's arrays cost (noise can bring it below 0); ``python_tax`` their quotient;
      ``layers`` frame_ms / layer_ms; ``gl_calls`` how many calls the program makes in it.
    - ``grass``: see :func:`measure_grass`. ``ways``: see :func:`measure_ways`.
    - ``startup_ms``: see :func:`measure_startup`; null where no start was asked for.
    """
    context = open_context(plan.backend)
    try:
        target = Framebuffer(plan.size, plan.samples)
        try:
            result: dict[str, Any] = {
                "renderer": gl.glGetString(gl.GL_RENDERER).decode(),
                "size": list(plan.size),
                "preset": plan.preset,
                "settings": {key: str(value) for key, value in plan.settings.items()},
            }
            result |= measure_views(plan, done)
            result["grass"] = [_told(measure_grass(plan, n), f"{n:,}", done) for n in plan.grass]
            result["ways"] = _told(measure_ways(plan), "2006", done) if plan.ways else []
        finally:
            target.release()
    finally:
        context.release()
    result["startup_ms"] = None
    if plan.starts:
        result["startup_ms"] = _told(measure_startup(plan), "start", done)
    return result


def steps(plan: Plan) -> int:
    """Return how often :func:`measure` will call ``done``."""
    return len(plan.views) + len(plan.grass) + bool(plan.ways) + bool(plan.starts)


def _told(value: Any, name: str, done: Callable[[str], None]) -> Any:
    done(name)
    return value


def measure_views(plan: Plan, done: Callable[[str], None]) -> dict[str, Any]:
    """Return ``layer_ms`` and ``views``; one island serves all views of the same settings."""
    groups: dict[Settings, list[str]] = {}
    for name in dict.fromkeys(plan.views):
        if name not in VIEWS:
            raise InputError(f"view {name!r}: no such view; `landscape views` lists them all")
        groups.setdefault(plan.values(VIEWS[name].settings), []).append(name)
    layer = Layer(plan.size)
    times: dict[str, list[float]] = {}
    calls: dict[str, int] = {}
    try:
        for values, names in groups.items():
            times |= _measure_group(plan, values, names, layer, calls, done)
    finally:
        layer.release()
    layer_ms = median(t for k, v in times.items() if k.endswith(" layer") for t in v)
    views = {}
    for name in calls:
        frame_ms, replay_ms = median(times[f"{name} frame"]), median(times[f"{name} replay"])
        views[name] = {
            "frame_ms": frame_ms,
            "layers": frame_ms / layer_ms,
            "python_ms": frame_ms - replay_ms,
            "replay_ms": replay_ms,
            "python_tax": frame_ms / replay_ms,
            "gl_calls": calls[name],
        }
    return {"layer_ms": layer_ms, "views": views}


def _measure_group(
    plan: Plan,
    values: Settings,
    names: Sequence[str],
    layer: Layer,
    calls: dict[str, int],
    done: Callable[[str], None],
) -> dict[str, list[float]]:
    """Time frames, replays and layers of views that share an island; count the frames' calls."""
    shown = set().union(*(VIEWS[name].shown for name in names)) & set(plan.only)
    island = Island(values, Assets(plan.assets), plan.seed, tuple(sorted(shown)))
    lists: list[Replay] = []
    actions: dict[str, Callable[[], object]] = {}
    before: dict[str, Callable[[], object]] = {}
    try:
        for name in names:
            draw = partial(draw_view, name, island, plan)
            draw()  # once makes what is made once
            with recording() as recorder:
                draw()
                calls[name] = len(recorder.calls)
            # A frame reads the camera's matrix back, and a list being compiled sets none: having
            # just been drawn, the frame has left the very matrix that it will ask for.
            draw()
            lists.append(Replay(draw))
            # A layer beside each view meets the same slow moments.
            actions |= {
                f"{name} frame": draw,
                f"{name} replay": lists[-1].call,
                f"{name} layer": layer.draw,
            }
            before[f"{name} frame"] = partial(draw_view, name, island, plan, arriving=True)
            done(name)
        return in_turns(actions, plan.rounds, before)
    finally:
        for list_ in lists:
            list_.release()
        island.release()


def draw_view(name: str, island: Island, plan: Plan, arriving: bool = False) -> None:
    """Draw one frame of a named view of an island, or of the step before on the way there."""
    view = VIEWS[name]
    island.shown = set(view.shown) & set(plan.only)
    pose = view.place(island.ground.field, island.settings.walk.eye)
    kt = view.kt
    if arriving:
        x, _, z = pose.forward
        back = island.settings.walk.speed / RATE
        pose = replace(pose, x=pose.x - back * x, z=pose.z - back * z, yaw=pose.yaw - LOOK / RATE)
        kt -= island.settings.clock.kt_per_second / RATE
    wireframe = plan.wireframe or view.wireframe
    island.draw(Moment(pose, plan.size, kt, stroke=view.stroke, wireframe=wireframe))


def measure_grass(plan: Plan, count: int) -> dict[str, Any]:
    """Measure ``count`` blades where the grass is dense.

    ``select_ms``: choosing what to draw, alone; ``draw_ms``: the whole of Grass.draw: bending in
    the wind, sending and drawing what is chosen for a while; ``static_ms``: a display list of the
    same blades, so draw_ms / static_ms is what the grass costs against standing still;
    ``visible``: blades drawn.
    Above 1,500,000 blades the land grows with them, so that they stand as thick as 200,000.
    """
    values = plan.values(VIEWS[GRASS_VIEW].settings)
    wider = 1.0 if count <= MOST_ON_ISLAND else float(np.sqrt(count / LOT))
    values = replace(
        values,
        grass=replace(values.grass, count=count),
        ground=replace(values.ground, size=values.ground.size * wider),
        castle=replace(values.castle, x=values.castle.x * wider, z=values.castle.z * wider),
    )
    assets = Assets(plan.assets)
    owned: list[Any] = []
    try:
        owned.append(ground := Ground(values, assets, sun.direction(values.sun)))
        blades = Meadow if meadow.wanted(values) else Grass
        owned.append(grass := blades(values, assets, ground, plan.seed))
        view = VIEWS[GRASS_VIEW]
        place = replace(view.pose, x=view.pose.x * wider, z=view.pose.z * wider)
        pose = replace(view, pose=place).place(ground.field, values.walk.eye)
        frame = begin_frame(values, Moment(pose, plan.size, view.kt))
        grass.draw(frame)
        drawn = len(grass.select(frame).positions)
        owned.append(static := DisplayList(lambda: grass.draw(frame)))
        times = in_turns(
            {
                "select": lambda: grass.select(frame),
                "draw": lambda: grass.draw(frame),
                "static": static.call,
            },
            plan.rounds,
        )
    finally:
        for owner in reversed(owned):
            owner.release()
    return {
        "count": count,
        "select_ms": median(times["select"]),
        "visible": drawn,
        "draw_ms": median(times["draw"]),
        "static_ms": median(times["static"]),
    }


def begin_frame(values: Settings, moment: Moment) -> Frame:
    """Begin a frame with fog, as the island does, and without one."""
    owner = SimpleNamespace(settings=values, shown={"fog"})
    return Island.begin(cast(Island, owner), moment)


def measure_ways(plan: Plan) -> list[dict[str, Any]]:
    """Draw the same blades in four ways, the report's first (see bench_grass).

    Returns for each its ``name``, the blades on the land (``count``), and the ``ms`` of a frame.
    """
    values = plan.values(VIEWS[GRASS_VIEW].settings)
    assets = Assets(plan.assets)
    owned: list[Any] = []
    try:
        owned.append(ground := Ground(values, assets, sun.direction(values.sun)))
        path = assets.path("blade.png")
        owned.append(texture := Texture(read_image(path, "RGB"), repeat=False))
        blades = sow(ground.field, plan.ways, plan.seed, values.grass.radius, values.grass.scale)
        view = VIEWS[GRASS_VIEW]
        pose = view.place(ground.field, values.walk.eye)
        frame = begin_frame(values, Moment(pose, plan.size, view.kt))
        ways = [way(blades, texture) for way in WAYS]
        owned += ways
        actions = {way.name: (lambda way=way: way.draw(frame)) for way in ways}
        times = in_turns(actions, max(1, plan.rounds // 3))
    finally:
        for owner in reversed(owned):
            owner.release()
    count = len(blades.positions)
    return [{"name": name, "count": count, "ms": median(spent)} for name, spent in times.items()]


def measure_startup(plan: Plan) -> float:
    """Return the median time in milliseconds from the command to the first frame, drawn.

    Each is a process of its own: the interpreter, all imports, the context, building the island,
    one frame read back. One start more comes first and is not counted, so disk caches are warm.
    """
    asked = {
        "view": plan.views[0] if plan.views else MAIN_VIEWS[0],
        "size": list(plan.size),
        "preset": plan.preset,
        "settings": dict(plan.settings),
        "backend": plan.backend,
        "samples": plan.samples,
        "assets": None if plan.assets is None else str(plan.assets),
        "only": list(plan.only),
        "seed": plan.seed,
    }
    times = []
    for _ in range(plan.starts + 1):
        start = time.perf_counter()
        child = subprocess.Popen(
            [sys.executable, "-c", _FIRST_FRAME, json.dumps(asked)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
        with child:
            assert child.stdout is not None
            answer = child.stdout.readline()
            times.append((time.perf_counter() - start) * 1e3)
        if answer.strip() != b"drawn":
            raise InputError("bench: the program started in another process drew no frame")
    return median(times[1:])


def report(result: Mapping[str, Any]) -> str:
    """Write the figures as tables for people."""
    width, height = result["size"]
    lines = [f"{result['renderer']}, {width}x{height}, preset {result['preset']}"]
    if result["views"]:
        lines += [
            f"one layer: {result['layer_ms']:.2f} ms",
            "",
            "view       frame ms  layers  replay ms  python ms   tax   calls",
        ]
    for name, view in result["views"].items():
        lines.append(
            f"{name:9} {view['frame_ms']:9.1f} {view['layers']:7.1f} {view['replay_ms']:10.1f}"
            f" {view['python_ms']:10.1f} {view['python_tax']:5.2f} {view['gl_calls']:7d}"
        )
    if result["grass"]:
        lines += ["", "blades      select ms   visible  draw ms  static ms  draw / static"]
    for row in result["grass"]:
        ratio = row["draw_ms"] / row["static_ms"]
        lines.append(
            f"{row['count']:10,d} {row['select_ms']:10.2f} {row['visible']:9,d}"
            f" {row['draw_ms']:8.2f} {row['static_ms']:10.2f} {ratio:14.2f}"
        )
    if result["ways"]:
        first = result["ways"][0]
        lines += ["", f"{first['count']:,} blades, four ways            ms   times as fast"]
    for row in result["ways"]:
        lines.append(f"{row['name']:30} {row['ms']:10.2f} {first['ms'] / row['ms']:15.1f}")
    if result["startup_ms"] is not None:
        lines += ["", f"from the command to the first frame: {result['startup_ms']:.0f} ms"]
    return "\n".join(lines)
