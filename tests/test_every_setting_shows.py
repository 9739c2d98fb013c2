"""Each setting has a view in which it shows: changed there, it changes the picture.

A few settings save work and must not change the picture: they change the OpenGL calls. Those of the
walker change the walk.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pytest
from flat_land import flat
from other_values import FEW, another
from stage import SIZE, Stage, small

from framelens.gl.seam import Call, recording
from landscape.elements.settings import BEST, PRESETS, Settings
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.island.fixes import FIXES
from landscape.island.island import ELEMENTS, Island
from landscape.island.slots import SLOTS
from landscape.scene.lens import Lens
from landscape.scene.scene import Moment, placed
from landscape.settings.declare import fields, get, with_settings
from landscape.settings.notices import WALK, conditions, ignored
from landscape.walk.walker import Intent, advance, start

KEYS = fields(Settings)
WALKING = [key for key in KEYS if WALK in conditions(Settings, key)]
FLAT = flat().field
LEAST = 3  # levels of 255: less may be the rounding of colours

BAY = Pose(13.4, 1.75, 27.6, 345.0, -14.0)
SEA = Pose(12.0, 1.1, 30.5, 330.0, -4.0)
GATE = Pose(28.3, 2.6, 18.9, 336.0, 2.0)
DOOR = Pose(27.6, 2.4, 17.4, 336.0, 2.0)
RABBIT = Pose(20.2, 1.4, 24.5, 40.0, -15.0)
WOOD = Pose(19.5, 1.45, 26.0, 320.0, -3.0)
LAWN = Pose(20.0, None, 28.0, 180.0, -20.0)
SPRITES = ("trees", "deer", "plants")
AS_IN_2006 = {f"{kind}.count": get(Settings(), f"{kind}.count") for kind in SPRITES}


@dataclass(frozen=True)
class Shot:
    """Where a setting shows: the pose, the elements, settings beside it, and its other value.

    Without a ``value`` it is the preset's that is not ``preset``, or else any other.
    """

    pose: Pose
    only: tuple[str, ...]
    settings: dict[str, Any] = field(default_factory=dict)
    value: Any = None
    preset: str = "2006"
    kt: float = 40.0
    stroke: int = 0


def of_fix(name: str, **more: Any) -> Shot:
    """Return the view of a fix's first picture, the flaw."""
    fix = next(fix for fix in FIXES if fix.name == name)
    settings = {**AS_IN_2006, **fix.settings(False)}
    return replace(Shot(fix.pose(False), fix.only, settings, kt=fix.kt), **more)


GROUPS = {
    "camera": Shot(RABBIT, ("ground", "rabbit")),
    "walk": Shot(LAWN, ("ground",)),
    "sun": Shot(RABBIT, ("rabbit",)),
    "shading": Shot(RABBIT, ("rabbit",)),
    "ground": Shot(BAY, ("ground",), {"ground.detail_repeat": 40.0}),
    "reflection": Shot(SEA, ("ground", "water", "reflection")),
    "water": Shot(SEA, ("ground", "water")),
    "sky": Shot(replace(RABBIT, y=2.5), ("sky", "fog")),
    "transparent": Shot(WOOD, SPRITES, {"trees.count": 900, "plants.count": 900}),
    "trees": Shot(WOOD, ("trees",), {"trees.count": 900}),
    "deer": Shot(WOOD, ("deer",), {"deer.count": 900}),
    "plants": Shot(WOOD, ("plants",), {"plants.count": 4000}),
    "grass": Shot(LAWN, ("grass",)),
    "castle": Shot(GATE, ("castle",)),
    "rabbit": Shot(RABBIT, ("rabbit",)),
    "dragon": Shot(SEA, ("dragon",)),
    "overlay": Shot(SEA, ("sword", "map"), stroke=2),
    "fog": Shot(BAY, ("ground", "fog")),
    "mist": Shot(BAY, ("ground", "mist"), {"mist.enabled": True}),
}
MATERIALS: dict[str, Any] = {"ground.materials": True, "ground.detail_repeat": 40.0}
STONY = of_fix("best4")
GLINTING = of_fix("best3", settings={**of_fix("best3").settings, "water.glitter": 0.35})
WOODED: dict[str, Any] = {"trees.count": 900, "trees.grouped": True, "trees.variety": True}
HUGE: dict[str, Any] = {"trees.count": 900, "trees.size_min": 15.0, "trees.size_max": 15.0}
WHOLE = {"ground.detail_repeat": 40.0, "ground.tiles": 1}  # the ground as of 2006, in one piece
SHOTS = {
    "time": Shot(BAY, ("ground", "fog", "sky")),
    "sun.tint": replace(GROUPS["ground"], value=(0.6, 0.5, 0.4)),
    "sun.relit": replace(GROUPS["ground"], settings=MATERIALS | {"sun.tint": (1.0, 0.5, 0.4)}),
    "sun.shade": replace(
        GROUPS["ground"], settings=MATERIALS | {"sun.relit": True}, value=(0.1, 0.1, 0.1)
    ),
    "water.roughness": replace(GLINTING, value=0.6),
    "water.sheltered": of_fix("best10"),
    "castle.sides": replace(GROUPS["castle"], value=24),
    "castle.torches": replace(GROUPS["castle"], settings={"castle.ornate": True}),
    "castle.open": replace(GROUPS["castle"], settings={"castle.ornate": True}),
    "castle.depth": Shot(DOOR, ("castle",), {"castle.ornate": True, "castle.open": True}),
    "castle.glow": replace(GROUPS["castle"], settings={"castle.ornate": True}),
    "castle.weathered": replace(GROUPS["castle"], settings={"castle.ornate": True}),
    "camera.lens": replace(GROUPS["camera"], value=0.02),
    "camera.focus": replace(GROUPS["camera"], settings={"camera.lens": 0.02}, value=4.0),
    "camera.lens_points": replace(GROUPS["camera"], settings={"camera.lens": 0.02}, value=2),
    "camera.near": replace(GROUPS["camera"], value=2.0),
    "camera.far": replace(GROUPS["camera"], value=3.0),
    "camera.lod_pixels": replace(GROUPS["camera"], value=20.0),
    # The far side of a mesh is seen between the lines of the near side.
    "camera.cull": replace(GROUPS["camera"], only=("rabbit",)),
    "ground.height_image": replace(GROUPS["ground"], value="height16.png"),
    "ground.clip": replace(GROUPS["ground"], pose=SEA),
    "ground.texture_size": replace(GROUPS["ground"], value=16),
    "ground.mid_repeat": replace(GROUPS["ground"], settings=MATERIALS, value=13.0),
    "ground.lit": replace(GROUPS["ground"], settings=WHOLE),
    "ground.passes": replace(
        GROUPS["ground"],
        settings=WHOLE | {"fog.density": 0.3},
        only=("ground", "fog"),
    ),
    "ground.subdivide": of_fix(
        "R14", settings=of_fix("R14").settings | {"ground.smooth": "catmull_rom"}, value=1
    ),
    "ground.exact_height": of_fix("R15"),
    "ground.materials": STONY,
    "ground.sand_texture": replace(GROUPS["ground"], settings=MATERIALS),
    "ground.sand_repeat": replace(GROUPS["ground"], settings=MATERIALS, value=9.0),
    "ground.rock_texture": replace(STONY, settings=STONY.settings | MATERIALS),
    "ground.rock_repeat": replace(STONY, settings=STONY.settings | MATERIALS, value=9.0),
    "ground.low_stretch": replace(STONY, settings={"ground.detail_repeat": 40.0}),
    "ground.weathered": replace(STONY, only=("ground",), settings=MATERIALS),
    "ground.stones": replace(STONY, only=("ground",), settings=MATERIALS, value=5_000),
    "ground.lod_bias": replace(GROUPS["ground"], settings=MATERIALS, value=-2.0),
    "ground.verdure": replace(GROUPS["ground"], settings=MATERIALS, value=1.0),
    "ground.tone": replace(GROUPS["ground"], settings=MATERIALS, value=1.0),
    "ground.clouds": replace(GROUPS["ground"], settings={"ground.shadows": True}, value=1.0),
    "ground.ledges": replace(
        STONY,
        only=("ground",),
        settings=MATERIALS | {"ground.tiles": 8, "ground.exact_height": True},
        value=1.0,
    ),
    "ground.wet": replace(GROUPS["ground"], settings=MATERIALS, pose=SEA),
    "ground.shadows": replace(GROUPS["ground"], only=("ground", "castle"), pose=GATE),
    "reflection.stencil": of_fix("stencil"),
    "reflection.castle": Shot(replace(GATE, pitch=-30.0), ("castle", "reflection")),
    "reflection.lod_scale": Shot(SEA, ("dragon", "reflection"), {"camera.lod_pixels": 2.0}, 50.0),
    "water.points": replace(GROUPS["water"], value=6),
    "water.horizon": of_fix("stencil", value=400.0),
    "water.glitter": replace(GLINTING, value=0.1),
    "water.relief": of_fix("R17"),
    "water.under": Shot(Pose(11.25, 0.2, 30.0, 340.0, 14.0), ("ground", "water")),
    "water.shallow": of_fix("best1"),
    "water.foam": of_fix("best2"),
    "water.run_up": of_fix("best2", settings={**of_fix("best2").settings, "water.foam": True}),
    "water.ripples": of_fix("best1", value=0.5),
    "water.horizon_contrast": Shot(SEA, ("water", "fog"), {"water.horizon": 400.0}, 0.5),
    "water.caustics": Shot(
        Pose(5.9, 0.78, 29.2, 315.0, -28.0),
        ("ground", "water"),
        MATERIALS
        | {
            "ground.tiles": 4,
            "ground.resolution": 160,
            "water.shallow": True,
            "ground.height_image": "height16.png",
            "reflection.rippled": True,
        },
    ),
    "sky.moving": of_fix("R1"),
    "sky.background": of_fix("R9"),
    "transparent.split": of_fix("R3"),
    "transparent.upright": of_fix("R4", only=("trees",)),
    "transparent.places": replace(GROUPS["transparent"], value="avenue.csv"),
    "deer.back": replace(
        of_fix("R4", only=("deer",)),
        pose=Pose(20.27, 1.8, 28.9, 0.0, -84.0),
        settings={"deer.count": 70, "plants.species": 5, "transparent.upright": True},
    ),
    "deer.species": replace(GROUPS["deer"], value=2),
    "transparent.fade": replace(GROUPS["transparent"], value=0.6),
    "transparent.clear_near": replace(GROUPS["trees"], settings=HUGE),
    "transparent.sunward": replace(GROUPS["trees"], value=0.8),
    "transparent.contact": replace(GROUPS["trees"], settings=WOODED, value=0.8),
    "trees.variety": replace(GROUPS["trees"], settings=WOODED),
    "transparent.min_pixels": replace(GROUPS["transparent"], value=20.0),
    "trees.crown": of_fix("R4", only=("trees",)),
    "deer.count": replace(GROUPS["deer"], value=10),
    "deer.follow_slope": of_fix("R5", only=("deer",)),
    "plants.sway": replace(GROUPS["plants"], value=4.0),
    "plants.radius": replace(GROUPS["plants"], value=2.0),
    "plants.quads": of_fix("R6a"),
    "plants.fade_edge_on": of_fix("R6a"),
    "plants.rosette": of_fix("R6b"),
    "plants.crossed_within": replace(GROUPS["plants"], value=0.5),
    "plants.shaded": Shot(
        LAWN,
        ("ground", "trees", "plants"),
        {"plants.count": 4000, "trees.count": 4000, "ground.shadows": True},
    ),
    "grass.count": replace(GROUPS["grass"], value=10_000),
    "grass.tinted": replace(GROUPS["grass"], only=("ground", "grass")),
    "grass.facing": of_fix("R7", value=0.6),
    "grass.variety": replace(GROUPS["grass"], settings={"grass.fade": True}, value=1.0),
    "grass.flowers": replace(
        GROUPS["grass"], settings={"grass.sward": True, "grass.scale": (0.5, 1.5)}, value=1.0
    ),
    "castle.flame_faces": of_fix("R2", only=("castle",)),
    "rabbit.fur": replace(GROUPS["rabbit"], settings={"rabbit.scale": 0.3}, value=6),
    "dragon.wet": replace(GROUPS["dragon"], settings={"dragon.sheen": 0.8, "dragon.painted": True}),
    "overlay.blade": replace(GROUPS["overlay"], stroke=0),
    "dragon.repeat": replace(GROUPS["dragon"], settings={"dragon.mapping": "axis"}),
    "dragon.sink": replace(GROUPS["dragon"], value=0.5),
    "overlay.sheen": replace(GROUPS["overlay"], stroke=1),
    "fog.start": replace(GROUPS["fog"], settings={"fog.mode": "linear"}, value=3.0),
    "fog.end": replace(GROUPS["fog"], settings={"fog.mode": "linear"}, value=10.0),
}
WIREFRAME = ("camera.cull",)
# These save time; the picture must stay as it is, and the calls differ.
ONLY_CALLS = {
    "ground.tiles": GROUPS["ground"],
    "grass.method": GROUPS["grass"],
    "water.query": replace(GROUPS["reflection"], settings={"reflection.rippled": True}),
}
# In the preset best these have an effect of their own beside the others.
IN_BEST = (
    "sun.fill",
    "reflection.enabled",
    "water.color",
    "sky.unfogged",
    "trees.species",
    "fog.density",
    "dragon.gloss",
    "dragon.sheen",
    "overlay.sheen",
    "rabbit.mapping",
    "grass.arch",
    "transparent.radius",
    "ground.materials",
)
# What of best takes longest to build, and none of these needs.
QUICK: dict[str, Any] = {
    "ground.weathered": False,
    "ground.stones": 0,
    "castle.weathered": False,
    "grass.sward": False,
}


@pytest.fixture(scope="module")
def islands(the_stage: Stage) -> Iterator[dict[Any, Island]]:
    """The last island opened, by what it was opened for: neighbours in the list share it."""
    kept: dict[Any, Island] = {}
    yield kept
    the_stage.enter()
    for island in kept.values():
        island.release()


def opened(islands: dict[Any, Island], settings: Settings, only: tuple[str, ...]) -> Island:
    wanted = settings, only
    if wanted not in islands:
        while islands:
            islands.popitem()[1].release()
        islands[wanted] = Island(settings, Assets(), only=only)
    return islands[wanted]


def drawn(stage: Stage, island: Island, shot: Shot, lines: bool = False) -> np.ndarray:
    """Return the second of two pictures, as an occlusion query answers a frame later."""
    pose = placed(shot.pose, island, island.settings.walk.eye)
    moment = Moment(pose, SIZE, shot.kt, 3.0, shot.stroke, lines)
    lens = Lens(SIZE)
    with stage.borrowed():
        for _ in range(2):
            lens.draw(moment, island.settings.camera, island.draw)
        lens.release()
        return stage.read()


def names(calls: Iterable[Call]) -> Iterator[str]:
    """Yield the names of calls, and of those in the display lists that they call."""
    for call in calls:
        yield call.name
        yield from names(call.listed)


def recorded(stage: Stage, island: Island, shot: Shot) -> tuple[np.ndarray, list[str]]:
    """Return what :func:`drawn` does when all that is seen was seen before; the calls' names."""
    drawn(stage, island, shot)
    with recording() as recorder:
        return drawn(stage, island, shot), list(names(recorder.calls))


def difference(stage: Stage, islands: dict[Any, Island], key: str, shot: Shot) -> int:
    """Return by how many levels a key changes the picture at most."""
    island, changed = prepared(islands, key, shot)
    lines = key in WIREFRAME
    before = drawn(stage, island, shot, lines)
    after = drawn_with(changed, stage, island, shot, lines)
    return int(np.abs(before - after).max())


def prepared(islands: dict[Any, Island], key: str, shot: Shot) -> tuple[Island, Settings]:
    """Return the island in which a key shows, and its settings with the key's other value."""
    beside = {k: v for k, v in shot.settings.items() if k != key or shot.value is not None}
    base = small({**PRESETS[shot.preset], **FEW, **beside})
    shown = tuple(name for name in ELEMENTS if name in shot.only)
    reason = ignored(base, key, shown, ELEMENTS, SLOTS)
    assert not reason, f"{key}: {reason} in the view that should show it"
    value = shot.value
    if value is None:
        value = BEST.get(key) if shot.preset == "2006" else KEYS[key].default
    if value is None or value == get(base, key):
        value = another(key, KEYS[key], get(base, key))
    changed = with_settings(base, {key: value})
    assert changed != base, f"{key}: not changed"
    return opened(islands, base, shown), changed


def drawn_with(
    changed: Settings, stage: Stage, island: Island, shot: Shot, lines: bool = False
) -> np.ndarray:
    """Return what :func:`drawn` does of an island with other settings; it keeps its own."""
    base = island.settings
    if island.apply(changed):
        found = drawn(stage, island, shot, lines)
        assert island.apply(base)
        return found
    other = Island(changed, Assets(), only=tuple(name for name in ELEMENTS if name in island.shown))
    found = drawn(stage, other, shot, lines)
    other.release()
    return found


def test_each_setting_has_a_view_that_shows_it() -> None:
    known = {*SHOTS, *WALKING, *ONLY_CALLS}
    unseen = [key for key in KEYS if key not in known and key.split(".")[0] not in GROUPS]
    assert unseen == [], "add a Shot of the group to GROUPS, or of the setting to SHOTS"


@pytest.mark.parametrize("key", [k for k in KEYS if k not in (*WALKING, *ONLY_CALLS)])
@pytest.mark.sweep(14, first=1)
def test_a_setting_changes_the_picture_of_the_view_that_shows_it(
    stage: Stage, islands: dict[Any, Island], key: str
) -> None:
    shot = SHOTS.get(key) or GROUPS[key.split(".")[0]]
    found = difference(stage, islands, key, shot)
    assert found >= LEAST, f"{key} changes nothing in its view"


@pytest.mark.parametrize("key", IN_BEST)
@pytest.mark.sweep(14, first=1)
def test_a_setting_of_best_shows_beside_the_others_of_best(
    stage: Stage, islands: dict[Any, Island], key: str
) -> None:
    shot = replace(SHOTS.get(key) or GROUPS[key.split(".")[0]], preset="best", value=None)
    found = difference(stage, islands, key, replace(shot, settings=QUICK))
    assert found >= LEAST, f"{key} changes nothing in best"


@pytest.mark.parametrize("key", ONLY_CALLS)
@pytest.mark.sweep(3)
def test_a_setting_that_saves_work_changes_the_calls_and_not_the_picture(
    stage: Stage, islands: dict[Any, Island], key: str
) -> None:
    shot = ONLY_CALLS[key]
    island, changed = prepared(islands, key, shot)
    before, calls = recorded(stage, island, shot)
    assert calls == recorded(stage, island, shot)[1]
    other = Island(changed, Assets(), only=shot.only)
    after, others = recorded(stage, other, shot)
    other.release()
    assert calls != others and np.abs(before - after).max() < LEAST


def vain(preset: str) -> list[tuple[str, str]]:
    """Return the keys that have no effect beside the others of a preset, and the preset."""
    settings = small({**PRESETS[preset], **FEW})
    found = [key for key in KEYS if ignored(settings, key, (*ELEMENTS, WALK), ELEMENTS, SLOTS)]
    # A walk shows everything sharp; what is drawn here is a still.
    found.remove("camera.lens")
    assert len(found) > 5
    return [(key, preset) for key in found]


@pytest.mark.parametrize(("key", "preset"), [*vain("2006"), *vain("best")])
@pytest.mark.sweep(14, first=13)
def test_what_is_said_to_change_nothing_changes_nothing(
    stage: Stage, islands: dict[Any, Island], key: str, preset: str
) -> None:
    shot = GROUPS[key.split(".")[0]]
    shown = tuple(name for name in ELEMENTS if name in {*shot.only, "water"})
    base = small({**PRESETS[preset], **FEW})
    changed = with_settings(base, {key: another(key, KEYS[key], get(base, key))})
    island = opened(islands, base, shown)
    before = drawn(stage, island, shot)
    assert (before == drawn_with(changed, stage, island, shot)).all()


BY_THE_WINDOW = {
    "walk.mouse_relative": "decides what the window makes of the mouse",
    "walk.swim": "is seen where there is deep water",
    "walk.solid": "is seen where there are trees: see test_island.py",
    "walk.jump": "is seen by one who jumps: see test_walker.py",
    "sound.volume": "is heard: see test_sound.py",
    "sound.muted": "is heard: see test_sound.py",
    "sound.captions": "is seen in the window: see test_sound_walk.py",
}


@pytest.mark.parametrize("key", [key for key in WALKING if key not in BY_THE_WINDOW])
def test_a_setting_of_the_walker_changes_the_walk(key: str) -> None:
    moves = [Intent(forward=1.0, turn=0.5), Intent(forward=1.0, run=True, look=(9.0, 4.0))]
    moves += [Intent(strike=True), *[Intent(forward=1.0)] * 9]
    value = another(key, KEYS[key], get(Settings(), key))
    ends = []
    for settings in (Settings(), with_settings(Settings(), {key: value})):
        walker, path = start(Pose(5.0, None, 5.0), FLAT, settings), []
        for move in moves:
            walker = advance(walker, move, 0.02, FLAT, (), settings)
            path.append(walker)
        ends.append(path)
    assert ends[0] != ends[1], f"{key} changes nothing in a walk"
