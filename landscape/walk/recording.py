"""Recorded walks: a JSON Lines file from which a walk is replayed, pixel for pixel.

The first line is the plan: format version, settings, seed, view, size and so on. Then comes one
line per frame: its length in seconds, and whatever input differs from the default. A setting that
was changed is recorded with its new value, not with the key that was pressed. A walk may lead
through doors into other scenes: then settings are those of the scene he is in. The last line
has the number of frames, so that a truncated file is detected. Floats are written with full
precision. Assets are not stored: replaying a walk on your own island needs the same ``--assets``.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any, TypeVar

from framelens.base.arguments import MAX_PIXELS, MAX_SIDE, is_number
from framelens.base.errors import InputError
from framelens.base.input import read_bounded
from framelens.base.output import Output
from framelens.system import interrupts_held
from landscape.frame import Pose
from landscape.scene.scene import SCENES, Scene, SceneSettings, scene
from landscape.settings.declare import Value, current_names, get, with_settings
from landscape.settings.declare import fields as keys_of
from landscape.walk.settings_list import rows
from landscape.walk.walker import Intent

Kind = TypeVar("Kind")
VERSION = 1
MOST_BYTES = 64 << 20  # chosen: what MOST_FRAMES take at most
MOST_FRAMES = 500_000  # chosen: over two hours at 60 frames per second
LONGEST_LINE = 1 << 16  # chosen: bytes; the plan with all settings takes a tenth of it
MAX_SECONDS = 1.0  # chosen: a longer frame (after the machine was suspended) counts as this
MAX_NUMBER = 1e6  # of a pose, in units or degrees
ACTIONS = (
    "map",
    "wireframe",
    "fog",
    "reflection",
    "sorting",
    "time",
    "mute",
    "help",
    "next_fix",
    "previous_fix",
    "go_to_fix",
    "fix",
    *(f"slot_{n}" for n in range(1, 10)),
    "next_slot",
    "previous_slot",
)  # switches
FORMER = {"next_cure": "next_fix", "cure": "fix"}  # names in older recordings


@dataclass(frozen=True)
class Plan:
    """The start of a walk; ``pose.y`` may be None: eye height above the ground.

    ``only`` names the elements; empty means all. ``preset`` is what the list of settings goes back
    to; empty means the scene's own. ``given`` are the settings that the user has set: they go with
    him through a door.
    """

    scene: str
    settings: SceneSettings
    view: str
    pose: Pose
    size: tuple[int, int]
    kt: float = 0.0
    seed: int = 0
    only: tuple[str, ...] = ()
    wireframe: bool = False
    language: str = "en"
    preset: str = ""
    given: Mapping[str, Value] = field(default_factory=dict)


@dataclass(frozen=True)
class Tick:
    """One frame of a walk: its length, what was asked for, and the window's size in pixels.

    ``actions`` are some of ACTIONS; ``note`` is a message that does not come from an action.
    ``row`` is the one chosen in the list of settings, "" while it is closed; ``changes`` are the
    settings changed there, by dotted key.
    """

    seconds: float
    intent: Intent
    actions: tuple[str, ...]
    size: tuple[int, int]
    note: str = ""
    row: str = ""
    changes: Mapping[str, Value] = field(default_factory=dict)


def plan_line(plan: Plan) -> dict[str, object]:
    """Return a plan as JSON."""
    pose = plan.pose
    return {
        "landscape walk": VERSION,
        "scene": plan.scene,
        "view": plan.view,
        "pose": [pose.x, pose.y, pose.z, pose.yaw, pose.pitch],
        "kt": plan.kt,
        "size": list(plan.size),
        "seed": plan.seed,
        "only": list(plan.only),
        "wireframe": plan.wireframe,
        "language": plan.language,
        "preset": plan.preset,
        "given": dict(plan.given),
        "settings": {key: get(plan.settings, key) for key in keys_of(type(plan.settings))},
    }


def tick_line(tick: Tick, size: tuple[int, int], row: str) -> dict[str, object]:
    """Return a frame as JSON; size and row are left out where they are still ``size``, ``row``."""
    default = asdict(Intent())
    line: dict[str, object] = {"dt": tick.seconds}
    line |= {name: v for name, v in asdict(tick.intent).items() if v != default[name]}
    if tick.actions:
        line["do"] = list(tick.actions)
    if tick.size != size:
        line["size"] = list(tick.size)
    if tick.note:
        line["note"] = tick.note
    if tick.row != row:
        line["list"] = tick.row
    if tick.changes:
        line["set"] = dict(tick.changes)
    return line


class Writer:
    """Writes a recording, which appears in its place when the walk ends (base/output.py)."""

    def __init__(self, path: Path, plan: Plan) -> None:
        """Begin the file; InputError if it cannot be written."""
        self._size = plan.size
        self._row = ""
        self._count = 0
        self._output = Output(path, f"--record {path}")
        self._write(plan_line(plan))

    def _write(self, line: Mapping[str, object]) -> None:
        self._output.write((json.dumps(line, allow_nan=False) + "\n").encode())

    def add(self, tick: Tick) -> None:
        """Write one frame; InputError where the disk is full, and then the recording is gone."""
        with interrupts_held():  # or the count of the frames could be wrong
            self._write(tick_line(tick, self._size, self._row))
            self._size, self._row = tick.size, tick.row
            self._count += 1

    def finish(self) -> bool:
        """Complete the recording; return False if no frame was recorded, or it is gone."""
        if not self._count or self._output.closed:
            self.discard()
            return False
        self._write({"frames": self._count})
        self._output.finish()
        return True

    def discard(self) -> None:
        """Leave what stood there before."""
        self._output.discard()


def read(path: Path) -> tuple[Plan, list[Tick]]:
    """Read a recording; InputError names the file and the first bad line."""
    data = read_bounded(path, MOST_BYTES, f"--replay {path}")
    if data.count(b"\n") > MOST_FRAMES + 2:
        raise InputError(
            "{path}: too long, expected at most {most_frames} frames",
            path=path,
            most_frames=MOST_FRAMES,
        )
    lines = data.splitlines()
    first = _checked_ends(path, lines)
    try:
        plan = _plan(first)
    except (InputError, ValueError, TypeError, KeyError) as error:
        raise InputError("{path}:1: {reason}", path=path, reason=_reason(error)) from None

    ticks, before = [], Tick(0.0, Intent(), (), plan.size)
    for number, line in enumerate(lines[1:-1], 2):
        frame = _object(path, number, line)
        try:
            before = _tick(frame, before, plan.scene)
        except (InputError, ValueError, TypeError, KeyError) as error:
            raise InputError(
                "{path}:{number}: {reason}", path=path, number=number, reason=_reason(error)
            ) from None
        ticks.append(before)

    return plan, ticks


def _is_count(value: object, wanted: int) -> bool:
    """Whether a value is a number; true is not 1."""
    return is_number(value) and value == wanted


def _object(path: Path, number: int, line: bytes) -> dict[str, object]:
    try:
        value = json.loads(line) if len(line) <= LONGEST_LINE else None
    except (ValueError, RecursionError):
        value = None
    if not isinstance(value, dict):
        raise InputError(
            "{path}:{number}: expected one JSON object per line, as --record writes",
            path=path,
            number=number,
        )
    return value


def _reason(error: Exception) -> str:
    return f"expected {error}" if isinstance(error, KeyError) else str(error)


def _number(value: object, name: str, low: float, high: float) -> float:
    if not is_number(value) or not low <= value <= high:
        raise ValueError(f"{name}: expected a number from {low:g} to {high:g}, not {value!r}")
    return float(value)


def _numbers(value: object, name: str, count: int, low: float, high: float) -> tuple[float, ...]:
    if not isinstance(value, list) or len(value) != count:
        raise ValueError(f"{name}: expected {count} numbers, not {value!r}")
    return tuple(_number(item, name, low, high) for item in value)


def _size(value: object) -> tuple[int, int]:
    width, height = map(int, _numbers(value, "size", 2, 1, MAX_SIDE))
    if width * height > MAX_PIXELS:
        raise ValueError(f"size: expected at most {MAX_PIXELS} pixels, not {value!r}")
    return width, height


def _kind(value: object, name: str, kind: type[Kind]) -> Kind:
    if type(value) is not kind:
        raise ValueError(f"{name}: expected {kind.__name__}, not {value!r}")
    return value


def _names(value: object, name: str) -> tuple[str, ...]:
    return tuple(_kind(item, name, str) for item in _kind(value, name, list))


def _row(value: object, first: str) -> str:
    name = _kind(value, "list", str)
    known = (row.name for kind in _scenes(first) for row in rows(type(kind.settings)))
    if name and name not in known:
        raise ValueError(f"list: expected the name of a row, not {name!r}")
    return name


def _scenes(first: str) -> Iterator[Scene]:
    """Yield the scenes in which a frame may be: the one of the plan, and others behind doors."""
    yield scene(first)
    yield from (scene(name) for name in SCENES if name != first)


def _changes(value: object, name: str, first: str) -> dict[str, Value]:
    """Return settings by key, checked and converted as those on the command line.

    They are those of the plan's scene or, if it does not have them, of another one.
    """
    given = _kind(value, name, dict)
    reasons = []
    for kind in _scenes(first) if given else ():
        changes = current_names(kind.settings, given)[0]
        try:
            changed = with_settings(kind.settings, changes)
        except InputError as error:
            reasons.append(error)
        else:
            return {key: get(changed, key) for key in changes}
    if reasons:
        raise reasons[0]
    return {}


def _checked_ends(path: Path, lines: Sequence[bytes]) -> dict[str, object]:
    """Return the first line; InputError unless it is a recording's, and the last counts frames."""
    first = _object(path, 1, lines[0]) if lines else {}
    if not _is_count(first.get("landscape walk"), VERSION):
        raise InputError(
            '{path}:1: expected a line with "landscape walk": {version}', path=path, version=VERSION
        )
    last = len(lines)
    end = _object(path, last, lines[-1]) if last > 1 else {}
    if list(end) != ["frames"] or not _is_count(end["frames"], last - 2):
        raise InputError(
            "{path}:{last}: truncated: expected a last line that counts the frames",
            path=path,
            last=last,
        )
    return first


def _pose(value: object) -> Pose:
    x, y, z, yaw, pitch = _kind(value, "pose", list)
    x, z, yaw, pitch = _numbers([x, z, yaw, pitch], "pose", 4, -MAX_NUMBER, MAX_NUMBER)
    y = None if y is None else _number(y, "pose", -MAX_NUMBER, MAX_NUMBER)
    return Pose(x, y, z, yaw, pitch)


def _plan(line: Mapping[str, object]) -> Plan:
    pose = _pose(line["pose"])
    # Older recordings name no scene: they are of the first one.
    kind = scene(_kind(line.get("scene", ""), "scene", str))
    only = kind.only(_names(line["only"], "only"))
    seed = _kind(line["seed"], "seed", int)
    if seed < 0:
        raise ValueError(f"seed: expected a whole number from 0, not {seed}")

    # A recording of the time before anybody jumped does not have that setting.
    settings = {"walk.jump": False, **_kind(line["settings"], "settings", dict)}
    return Plan(
        scene=kind.name,
        settings=with_settings(kind.settings, settings),
        view=_kind(line["view"], "view", str),
        pose=pose,
        size=_size(line["size"]),
        kt=_number(line["kt"], "kt", -1e12, 1e12),
        seed=seed,
        only=only,
        wireframe=_kind(line["wireframe"], "wireframe", bool),
        language=_kind(line["language"], "language", str),
        preset=_preset(kind, line.get("preset", "")),
        given=_changes(line.get("given", {}), "given", kind.name),
    )


def _preset(kind: Scene, value: object) -> str:
    name = _kind(value, "preset", str)
    kind.values(name or None)
    return name


def _intent(line: Mapping[str, object]) -> Intent:
    """Return what a frame's line asks of the walker."""
    intent: dict[str, Any] = {}  # fields, each of its type
    for item in fields(Intent):
        if item.name not in line:
            continue
        value = line[item.name]
        if item.name == "look":
            intent["look"] = _numbers(value, "look", 2, -1e6, 1e6)
        elif isinstance(item.default, bool):
            intent[item.name] = _kind(value, item.name, bool)
        else:
            intent[item.name] = _number(value, item.name, -1, 1)
    return Intent(**intent)


def _tick(line: Mapping[str, object], before: Tick, first: str) -> Tick:
    """Return a frame of a walk that began in the scene ``first``.

    What its line leaves out is as in the frame ``before``.
    """
    known = {item.name for item in fields(Intent)} | {"dt", "do", "size", "note", "list", "set"}
    if not set(line) <= known:
        raise ValueError(f"unknown: {', '.join(sorted(set(line) - known))}")
    actions = tuple(FORMER.get(name, name) for name in _names(line.get("do", []), "do"))
    if not set(actions) <= set(ACTIONS):
        raise ValueError(f"do: expected some of {', '.join(ACTIONS)}")
    return Tick(
        seconds=_number(line["dt"], "dt", 0, MAX_SECONDS),
        intent=_intent(line),
        actions=actions,
        size=_size(line["size"]) if "size" in line else before.size,
        note=_kind(line.get("note", ""), "note", str),
        row=_row(line["list"], first) if "list" in line else before.row,
        changes=_changes(line.get("set", {}), "set", first),
    )
