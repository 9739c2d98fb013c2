"""What every slot of every scene must do, whatever fills it.

A frame leaves OpenGL's state as its beginning set it, and so does each slot in it. A frame after
the first makes and deletes no objects. Settings that an open scene takes are drawn as if it had
been opened with them; where it refuses them, or what they ask for cannot be built, nothing has
changed. Released, it leaves no name behind, and may be released again.
"""

import gc
import weakref
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gl_state import changes, snapshot
from other_values import FEW, another
from stage import SIZE, Stage, live_names, write_plain
from sweeps import Todays

from framelens.base.errors import InputError
from framelens.gl.seam import gl, recording
from landscape.elements.element import Elements
from landscape.files.assets import Assets
from landscape.frame import Frame, Pose
from landscape.offscreen import Offscreen, baked_alike
from landscape.scene.scene import Moment, OpenScene, Scene, View, begin_frame, placed, scene
from landscape.settings.declare import fields, get, with_settings
from landscape.voxel.settings import PICTURES

Changes = dict[str, Any]


@dataclass(frozen=True)
class Case:
    """A scene with a preset, and what is tried in it.

    In the ``moments`` together each of its slots draws, but for those ``without`` calls of their
    own. ``variants`` are settings that an open scene takes; where some are ``daily``, the others
    rotate. ``together`` are groups of settings that are changed at once, seen in the same pictures:
    no group of a line hides what another one shows. ``refused`` are changes that an open scene
    cannot take, ``impossible`` what cannot be built, and the file that is named then. ``rebuilt``
    says which slots are filled again.
    """

    place: str
    preset: str
    settings: Changes
    moments: tuple[Moment, ...]
    variants: Mapping[str, Changes]
    together: tuple[tuple[str, ...], ...]
    refused: tuple[Changes, ...]
    rebuilt: tuple[tuple[Changes, set[str]], ...]
    impossible: tuple[Changes, str] | None = None
    daily: tuple[str, ...] = ()
    without: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.place} {self.preset}"

    @property
    def scene(self) -> Scene:
        return scene(self.place)

    def values(self, changed: Mapping[str, Any] | None = None) -> Any:
        """Return the scene's settings with some changed."""
        return self.scene.values(self.preset, self.settings, changed or {})

    def open(self, settings: Any, assets: Assets | None = None) -> Any:
        """Open the scene with all its elements."""
        return self.scene.open(settings, assets or Assets(), 0, self.scene.elements)


ISLAND = (
    Moment(Pose(12.0, 1.1, 30.5, 330.0, -4.0), SIZE, 40.0, 3.0, 2),  # dragon, water, trees, overlay
    Moment(Pose(28.3, 2.6, 18.9, 336.0, 2.0), SIZE, 40.0),  # castle, grass, plants
    Moment(Pose(20.2, 1.4, 24.5, 40.0, -15.0), SIZE, 40.0),  # rabbit
)
ISLAND_VARIANTS: dict[str, Changes] = {
    "the castle mirrored": {"reflection.castle": True},
    "no reflection": {"reflection.enabled": False},
    "unsorted, with the stencil": {"transparent.sorted": False, "reflection.stencil": True},
    "no fog": {"fog.enabled": False},
}
ISLAND_TOGETHER = (
    ("camera", "clock", "walk", "sound", "time"),
    ("castle", "rabbit", "overlay"),
    ("sky", "dragon", "grass"),
    ("sun", "shading"),
    ("ground",),
    ("water", "reflection"),
    ("transparent",),
    ("trees", "deer", "plants"),
    ("fog",),
    ("mist",),
)
LIVE = {"fog.density": 0.2, "overlay.map": False, "camera.fov": 50.0}
# The same voxel island in larger blocks, which is built in a quarter of the time.
COARSE: Changes = {
    "voxel.regions": 5,
    "voxel.region_size": 50,
    "voxel.block": 0.16,
    "voxel.levels": 48,
    "voxel.sea": 5,
}
CASES = (
    Case(
        "island",
        "2006",
        FEW,
        ISLAND,
        {**ISLAND_VARIANTS, "to the horizon": {"water.horizon": 70.0}},
        ISLAND_TOGETHER,
        # The fog could be taken; the ground is compiled, and all else stands on it.
        refused=({"fog.density": 0.4, "ground.resolution": 41},),
        rebuilt=((LIVE, set()), ({"sky.moving": True}, {"sky"})),
        impossible=(
            {"fog.density": 0.4, "sky.half_width": 6.5, "dragon.mesh": "none.ply"},
            "none.ply",
        ),
    ),
    Case(
        "island",
        "best",
        {**FEW, "ground.stones": 500},
        (*ISLAND, Moment(Pose(11.25, 0.2, 30.0, 340.0, 14.0), SIZE, 40.0)),  # under water
        {
            **ISLAND_VARIANTS,
            "mist": {"mist.enabled": True},
            "in the framebuffer": {"reflection.rippled": False},
        },
        ISLAND_TOGETHER,
        refused=({"fog.density": 0.4, "ground.resolution": 41},),
        rebuilt=((LIVE, set()), ({"sky.moving": False}, {"sky"})),
        impossible=(
            {"fog.density": 0.4, "sky.half_width": 6.5, "transparent.places": "none.csv"},
            "none.csv",
        ),
        without=("query",),
    ),
    Case(
        "hall",
        "best",
        {"flight.path": True, "mist.enabled": True, "tone.brightness": -0.05},
        (
            Moment(Pose(1.6, 0.12, 2.6, 0.0, 4.0), SIZE, 20.0, 3.0, 2),  # from the door
            Moment(Pose(1.36, 0.55, 1.8, 0.0, -25.0), SIZE, 20.0),  # over the pool
            Moment(Pose(1.6, -0.4, 2.2, 0.0, 20.0), SIZE, 20.0),  # below the floor
            Moment(Pose(1.6, 0.3, 1.3, 0.0, 0.0), SIZE, 20.0),  # the statue's shadow on the wall
        ),
        {
            "no stencil": {"mirror.stencil": False, "shadow.stencil": False},
            "mirror without Fresnel": {"mirror.fresnel": False},
            "both lights": {"shadow.light": "both", "mirror.enabled": True},
            "a lamp that is no point": {
                "shadow.lamp": 0.02,
                "shadow.casters": "all",
                "shadow.shine": 1.0,
            },
            "caustics in one pass": {"caustics.passes": "one"},
            "planes of the eye": {"caustics.planes": "eye_before_camera"},
        },
        (
            ("mirror", "exhibits"),
            ("caustics", "tone"),
            ("shadow", "flight"),
            ("mist", "camera"),
            ("fog", "pool", "shafts"),
        ),
        refused=(),
        rebuilt=(),
    ),
    Case(
        "voxel",
        "best",
        {**COARSE, "overlay.map": True},
        (Moment(Pose(4.8, 1.3, 9.3, 0.0, -12.0), SIZE, 12.0, 3.0, 2),),
        {
            "no offset": {"shadow.offset": False, "shadow.snapped": False},
            "no reflection": {"water.reflection": False},
            "no refraction": {"water.refraction": False},
            "as much at all angles": {"water.by_angle": False},
            "regions": {"debug.regions": True},
            "textures": {"debug.textures": True},
            "edges": {"debug.edges": True},
            **{f"picture of {name}": {"debug.picture": name} for name in PICTURES},
            "everything is sent": {
                "voxel.cull": False,
                "voxel.facing": False,
                "voxel.horizon": False,
            },
            "no fog": {"fog.enabled": False},
            "sunset": {"time": "sunset"},
        },
        (("debug", "water"), ("shadow", "voxel"), ("fog", "camera")),
        refused=({"shadow.enabled": False}, {"voxel.mipmaps": False}),
        rebuilt=(),
        daily=("textures",),
    ),
)

# Groups of settings of views and fixes that an open scene takes only roughly.
BAKED = {"hall": {"room", "sky", "torches", "statue", "sun"}, "voxel": {"sun", "time"}}

MAKING = ("glGen", "glDelete", "glTexImage")
DRAWING = ("glDraw", "glCall", "glBegin", "glMultiDraw", "glRect", "glCopyPixels", "glAccum")


class Opened:
    """The scene of a case while its tests run."""

    def __init__(self, case: Case, stage: Stage) -> None:
        self.case = case
        self.base = case.values()
        self._stage = stage
        self.before = live_names()
        self.scene: Any = case.open(self.base)

    def frames(self) -> list[Moment]:
        """Return the case's moments, with the poses' heights."""
        eye = self.scene.settings.walk.eye
        return [
            replace(moment, pose=placed(moment.pose, self.scene, eye))
            for moment in self.case.moments
        ]

    def pictures(self) -> list[np.ndarray]:
        """Draw each moment, twice, as what is first seen may come a frame later."""
        return pictures(self._stage, self.scene, self.frames())


def pictures(stage: Stage, opened: OpenScene, moments: list[Moment]) -> list[np.ndarray]:
    """Return the pictures of an open scene, int64 (h, w, 3) each."""
    drawn = []
    with stage.borrowed():
        for moment in moments:
            opened.draw(moment)
            opened.draw(moment)
            drawn.append(stage.read())
    return drawn


@pytest.fixture(scope="module", params=CASES, ids=str)
def opened(request: pytest.FixtureRequest, the_stage: Stage) -> Iterator[Opened]:
    the_stage.enter()
    found = Opened(request.param, the_stage)
    yield found
    the_stage.enter()
    if hasattr(found, "scene"):
        found.scene.release()


# What a frame under water sets, and each frame before it uses it: no attribute group restores the
# plane (see UnderWater.keep_below).
SET_BEFORE_USE = {"GL_CLIP_PLANE0.equation", "GL_COLOR_CLEAR_VALUE"}


def drawn_with_state_watched(
    opened: OpenScene, moment: Moment, monkeypatch: pytest.MonkeyPatch, slots: bool = True
) -> dict[str, Any]:
    """Draw a frame; return what state each slot, if asked for, and the frame left changed."""
    left: dict[str, Any] = {}
    drawn: set[str] = set()
    first: list[dict[str, Any]] = []
    module = type(opened).__module__

    def begun(*arguments: Any, **named: Any) -> Frame:
        frame = begin_frame(*arguments, **named)
        first.append(snapshot())
        return frame

    def watched(self: Elements[Any], name: str, frame: Frame, *part: Any) -> None:
        drawn.add(name)
        before = snapshot() if slots else {}
        draw(self, name, frame, *part)
        if slots and (changed := changes(before, snapshot())):
            left.setdefault(name, changed)

    draw = Elements.draw
    with monkeypatch.context() as patch:
        patch.setattr(Elements, "draw", watched)
        patch.setattr(f"{module}.begin_frame", begun)
        opened.draw(moment)
    usual = SET_BEFORE_USE if "under" in drawn else set()
    changed = changes(first[0], snapshot())
    if changed.keys() - usual:
        left["the frame"] = changed
    return left


@pytest.mark.sweep(14)
def test_a_frame_and_each_slot_leave_the_state_as_found(
    stage: Stage, opened: Opened, monkeypatch: pytest.MonkeyPatch
) -> None:
    with stage.borrowed():
        for moment in opened.frames():
            left = drawn_with_state_watched(opened.scene, moment, monkeypatch)
            assert not left, f"{left} in {moment}"
            lines = replace(moment, wireframe=True)
            left = drawn_with_state_watched(opened.scene, lines, monkeypatch, slots=False)
            assert not left, f"{left} in {lines}"


@pytest.mark.sweep(14, first=6)
def test_with_other_settings_a_frame_leaves_the_state_as_found(
    stage: Stage, opened: Opened, todays: Todays, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = opened.case
    others = [name for name in case.variants if name not in case.daily]
    try:
        for name in (*case.daily, *(todays(others, 9, 14) if case.daily else others)):
            assert opened.scene.apply(case.values(case.variants[name])), name
            with stage.borrowed():
                for moment in opened.frames():
                    left = drawn_with_state_watched(opened.scene, moment, monkeypatch, False)
                    assert not left, f"{name}: {left} in {moment}"
    finally:
        assert opened.scene.apply(opened.base)


@pytest.mark.seldom(13, first=10)
def test_a_leak_in_one_slot_is_told(
    stage: Stage, opened: Opened, monkeypatch: pytest.MonkeyPatch
) -> None:
    draw = Elements.draw

    def leaking(self: Elements[Any], name: str, frame: Frame, *part: Any) -> None:
        draw(self, name, frame, *part)
        if name == "sky":
            gl.glDepthFunc(gl.GL_GEQUAL)

    monkeypatch.setattr(Elements, "draw", leaking)
    with stage.borrowed():
        left = drawn_with_state_watched(opened.scene, opened.frames()[0], monkeypatch)
    assert {"sky", "the frame"} <= left.keys()
    assert "GL_DEPTH_FUNC" in left["sky"]


@pytest.mark.sweep(14, first=10)
def test_a_frame_after_the_first_makes_and_deletes_no_objects_and_each_slot_draws(
    stage: Stage, opened: Opened
) -> None:
    opened.pictures()  # what waits for its size or first use is made now
    with stage.borrowed(), recording() as recorder:
        for moment in opened.frames():
            opened.scene.draw(replace(moment, kt=moment.kt + 9.0))
    names = {call.name for call in recorder.calls}
    assert not {name for name in names - {"glGenerateMipmap"} if name.startswith(MAKING)}

    elements = opened.scene.elements  # type: ignore[attr-defined]
    drew = {call.element for call in recorder.calls if call.name.startswith(DRAWING)}
    for name, slot in elements._slots.items():
        if elements.at(name) is not None and name not in opened.case.without:
            assert drew & {*slot.names}, f"no moment of the case shows {name}"


def tried(opened: Opened) -> Iterator[tuple[str, Any, Pose | None]]:
    """Yield keys with another value each; where views have some, with the pose of the view."""
    case = opened.case
    if case.place == "island":
        for key, item in fields(type(opened.base)).items():
            yield key, another(key, item, get(opened.base, key)), None
        return
    for view, given in of_views(case.scene):
        pose = placed(view.pose, opened.scene, opened.base.walk.eye)
        for key, value in given.items():
            yield key, value, pose


def of_views(kind: Scene) -> Iterator[tuple[View, Mapping[str, Any]]]:
    """Yield each view and each half of a fix: where to look from, and the settings."""
    for view in kind.views.values():
        yield view, view.settings
    for fix in kind.fixes:
        for after in (False, True):
            yield replace(fix.as_view(), pose=fix.pose(after)), fix.on if after else fix.off


@pytest.mark.sweep(14, first=1)
@pytest.mark.slow
def test_what_is_taken_is_drawn_as_if_built_so_and_the_rest_is_refused(
    stage: Stage, opened: Opened, todays: Todays
) -> None:
    for groups in todays(opened.case.together, 10, 14):
        check_taken(stage, opened, groups)


def check_taken(stage: Stage, opened: Opened, groups: tuple[str, ...]) -> None:
    """Change the settings of some groups; compare with a scene opened with what was taken."""
    base, kind = opened.base, opened.case.scene
    settings, taken, poses = base, {}, {}
    for key, value, pose in tried(opened):
        if key.split(".")[0] not in groups or not get(settings, key) == get(base, key) != value:
            continue
        # Each beside those taken before it: one picture then shows them all.
        changed = with_settings(settings, {key: value})
        if not baked_alike(kind, base, changed):
            continue
        if opened.scene.apply(changed):
            assert opened.scene.settings == changed
            settings, taken[key] = changed, value
            poses[pose] = None
        else:
            assert opened.scene.settings == settings, f"{key}: refused, and yet changed"

    if not taken:
        assert opened.case.place == "island", groups
        return
    views = [Moment(pose, SIZE, 20.0) for pose in poses if pose] or opened.frames()
    drawn = pictures(stage, opened.scene, views)
    assert opened.scene.apply(base)
    built = opened.case.open(settings)
    wanted = pictures(stage, built, views)
    built.release()
    for number, (got, expected) in enumerate(zip(drawn, wanted, strict=True)):
        off = np.abs(got - expected).max()
        assert off == 0, f"{', '.join(taken)}: picture {number} is off by {off} levels"


@pytest.mark.seldom(14, first=6)
def test_what_is_refused_or_cannot_be_built_changes_nothing(stage: Stage, opened: Opened) -> None:
    before = opened.pictures()
    for changed in opened.case.refused:
        assert not opened.scene.apply(with_settings(opened.base, changed))
        assert opened.scene.settings == opened.base
    if opened.case.impossible:
        changed, file = opened.case.impossible
        with pytest.raises(InputError, match=file):
            opened.scene.apply(with_settings(opened.base, changed))
        assert opened.scene.settings == opened.base
    after = opened.pictures()
    assert all((a == b).all() for a, b in zip(before, after, strict=True))


@pytest.mark.sweep(4)
def test_only_the_slots_that_cannot_take_a_setting_are_filled_again(
    stage: Stage, opened: Opened
) -> None:
    elements = opened.scene.elements  # type: ignore[attr-defined]
    for changed, rebuilt in opened.case.rebuilt:
        before = {name: elements.at(name) for name in elements._slots}
        assert opened.scene.apply(with_settings(opened.base, changed))
        assert {name for name, was in before.items() if elements.at(name) is not was} == rebuilt
        assert opened.scene.apply(opened.base)
    assert opened.scene.shown == {*opened.case.scene.elements}


# The last test of a case, which ends with it.
@pytest.mark.sweep(4)
def test_release_leaves_no_name_and_may_be_called_twice(stage: Stage, opened: Opened) -> None:
    assert live_names() != opened.before
    elements = opened.scene.elements
    built = {name: elements.at(name) for name in elements._slots}
    parts = {name: weakref.ref(part) for name, part in built.items() if part is not None}
    assert parts
    del elements, built

    # Python's collector counts objects, not bytes: what waits for it may take all the memory.
    gc.collect()
    gc.disable()
    try:
        for _ in range(2):
            opened.scene.release()
            assert live_names() == opened.before
        assert int(gl.glGetError()) == 0
        del opened.scene
        assert [name for name, part in parts.items() if part() is not None] == []
    finally:
        gc.enable()


def test_an_island_that_cannot_be_built_releases_what_it_had_built(
    stage: Stage, tmp_path: Path
) -> None:
    folder = write_plain(tmp_path)
    (folder / "sword_rest.png").write_bytes(b"not an image")
    before = live_names()
    with pytest.raises(InputError, match=r"sword_rest\.png"):
        shown = ("ground", "water", "sky", "castle", "sword")
        scene("island").open(CASES[0].values(), Assets(folder), 0, shown)
    assert live_names() == before


@pytest.mark.parametrize("case", CASES, ids=str)
def test_every_group_of_settings_is_changed_or_baked(case: Case) -> None:
    if case.place == "island":
        groups = {key.split(".")[0] for key in fields(type(case.values()))}
        assert groups == set(sum(case.together, ()))
        return
    groups = {key.split(".")[0] for _, given in of_views(case.scene) for key in given}
    assert groups == set(sum(case.together, ())) | BAKED[case.place]
    assert BAKED[case.place] <= set(case.scene.baked)


@pytest.mark.seldom(14, first=11)
@pytest.mark.parametrize(
    ("place", "applied", "baked"),
    [
        ("hall", ("hall_sphere", "hall_mist", "hall_shadow"), "hall_contrast"),
        ("voxel", ("voxel_bay", "voxel_fog"), "voxel_sparkle"),
    ],
)
def test_views_share_a_scene_unless_something_else_is_baked_into_it(
    place: str, applied: tuple[str, ...], baked: str
) -> None:
    settings = COARSE if place == "voxel" else {}
    with Offscreen((40, 30), None, settings, samples=0) as view:
        scenes = []
        for name in (*applied, baked):
            view.look(name)
            scenes.append(view.scene)
        assert all(each is scenes[0] for each in scenes[:-1])
        assert scenes[-1] is not scenes[0]
