"""The type of a scene, the start of each of its frames, and the list of all scenes.

A scene is a module with a :class:`SceneOf` named ``SCENE``: the names of its elements, its views,
its settings and presets, and a function that opens it in the current OpenGL context. Walking,
rendering, tracing and measuring work on any scene in :data:`SCENES`; a new scene is one line there.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib import import_module
from typing import (
    Generic,
    Protocol,
    SupportsFloat,
    TypeAlias,
    TypedDict,
    TypeVar,
    runtime_checkable,
)

import numpy as np

from framelens.base.errors import InputError, listed, short
from framelens.gl.seam import frame_begins, gl
from landscape.elements import fog, sun
from landscape.elements.element import Slot
from landscape.elements.settings import Camera, Clock, Fog, Sound, Sun, Walk
from landscape.files.assets import Assets
from landscape.frame import FULL, Detail, Frame, Pose, Tile, scaled
from landscape.geometry.obstacle_grid import Obstacles
from landscape.settings import declare
from landscape.settings import notices as conditions
from landscape.settings.declare import Toggle, Value
from landscape.sound.soundscape import STONY, Soundscape

CLOSE = 4  # chosen: how many names like a wrong one an error lists

# Name to module. A module is imported when one of its views is first asked for; the first scene is
# the default.
SCENES: dict[str, str] = {
    "island": "landscape.island.island",
    "hall": "landscape.hall.hall",
    "voxel": "landscape.voxel.voxel",
}


class SceneSettings(Protocol):
    """The groups that the settings of every scene have."""

    @property
    def camera(self) -> Camera:
        """How the camera sees."""

    @property
    def clock(self) -> Clock:
        """How fast kt runs in a walk."""

    @property
    def walk(self) -> Walk:
        """How the walker moves."""

    @property
    def sound(self) -> Sound:
        """How loud a walk is."""


Values = TypeVar("Values", bound=SceneSettings)  # a scene's own settings


@dataclass(frozen=True)
class Moment:
    """A frame's moment: pose, size in pixels, kt, the walker's step and sword stroke (0 to 4).

    The pose's ``y`` must be a number. ``detail`` says how finely to draw it. ``walking`` says that
    it is the next frame of a walk: what is costly may then be spread over several. Of a ``tile``
    only that part of the picture is drawn, without what is laid over it. Billboards turn to the eye
    of the pose ``faced`` if that is another than the moment's own.
    """

    pose: Pose
    size: tuple[int, int]
    kt: float = 0.0
    step: float = 0.0
    stroke: int = 0
    wireframe: bool = False
    detail: Detail = FULL
    walking: bool = False
    tile: Tile | None = None
    faced: Pose | None = None


class Terrain(Protocol):
    """The land that a walker stands on: a square of ``size`` units from (0, 0) to (size, size)."""

    @property
    def size(self) -> float:
        """The side of the square in units."""

    def height(self, x: float, z: float) -> SupportsFloat:
        """Return the height in units of what one stands on at x, z: ground or water."""


@runtime_checkable
class Watery(Protocol):
    """A terrain with water that one can wade and swim in; a scene's terrain need not be one."""

    def depth(self, x: float, z: float) -> SupportsFloat:
        """Return the water's depth in units at x, z, 0 on land."""


@runtime_checkable
class Diveable(Protocol):
    """A terrain with water that one can look into from below; a scene's terrain need not be one."""

    def bed(self, x: float, z: float) -> float:
        """Return the height in units of the water's bed at x, z, or of the land."""


class Fix(Protocol):
    """A fix that the walk can switch: settings for the flaw (``off``) and without it (``on``)."""

    @property
    def name(self) -> str:
        """A short name, as R4."""

    @property
    def title(self) -> str:
        """The flaw that it fixes, in a few words."""

    @property
    def off(self) -> Mapping[str, Value]:
        """The settings that show the flaw."""

    @property
    def on(self) -> Mapping[str, Value]:
        """The settings that fix it."""

    def as_view(self) -> "View":
        """Return the view that shows it fixed, under the fix's name."""

    def pose(self, after: bool) -> Pose:
        """Where to look at the flaw from, or at the fix; its y may be None."""


class OpenSceneOf(Terrain, Protocol[Values]):
    """A scene whose elements are built, in the OpenGL context that was current then."""

    settings: Values
    shown: set[str]  # names of elements to draw; may be changed between frames

    @property
    def obstacles(self) -> Obstacles:
        """Obstacles in the walker's way: a plain sequence, or a grid if there are many."""

    def draw(self, moment: Moment) -> None:
        """Draw one frame into the current framebuffer."""

    def apply(self, settings: Values) -> bool:
        """Apply other settings without building anything; return False if that is impossible.

        Then nothing has changed, and the caller opens the scene again.
        """

    def release(self) -> None:
        """Delete what was made in OpenGL; may be called twice."""


@dataclass(frozen=True)
class View:
    """A named place and its switches.

    ``pose.y`` may be None: the walker's eye height above the ground there. ``shown`` names the
    elements to draw; empty means all of the scene's. ``preset`` is the one it is drawn with unless
    another is asked for; empty means the scene's own default. ``settings`` change the preset.
    """

    name: str
    shows: str
    pose: Pose
    kt: float = 0.0
    preset: str = ""
    shown: tuple[str, ...] = ()
    settings: Mapping[str, Value] = field(default_factory=dict)
    stroke: int = 0
    wireframe: bool = False

    @property
    def figure(self) -> str:
        """The report's figure and panel, as in "35 a"; empty for a view that is not a figure."""
        return f"{self.name[3:-1]} {self.name[-1]}" if self.name.startswith("fig") else ""


@dataclass(frozen=True)
class SceneOf(Generic[Values]):
    """A scene whose settings are of a class; nothing of it needs OpenGL until it is opened.

    ``settings`` is an instance of the scene's settings class with the defaults (see
    :mod:`landscape.settings.declare`); it must have the groups ``camera``, ``clock``, ``walk`` and
    ``sound``.
    ``presets`` map a name to differences from it, ``preset`` is the default one. ``start`` names
    the view where a walk begins, ``main`` the views that are measured when none is named. ``open``
    builds the elements: ``open(settings, assets, seed, only)``. ``terrain`` answers heights without
    OpenGL. ``overlay`` names elements that a walk shows even if it begins in a view without them.
    ``digits`` says what the keys 1 to 9 do in a walk, ``letters`` what letters do that the scene
    has for itself. ``carried`` returns what a drag with the right button changes: of settings, and
    pixels right and down. ``title`` is for people, in English. ``blocks`` says that a walker digs
    and builds in it (geometry/digging.py). ``baked`` names settings that an open scene takes only
    roughly, which is enough for a walk. ``slots`` are the places that several classes may fill.
    ``unread`` names settings of the groups it shares with others that have no effect in it.
    ``sounds`` says what there is to hear, of its settings and its terrain, be it an open scene.
    """

    name: str
    elements: tuple[str, ...]
    views: Mapping[str, View]
    settings: Values
    presets: Mapping[str, Mapping[str, Value]]
    preset: str
    start: str
    main: tuple[str, ...]
    open: Callable[[Values, Assets, int, tuple[str, ...]], OpenSceneOf[Values]]
    terrain: Callable[[Values, Assets], Terrain]
    fixes: Sequence[Fix] = ()
    overlay: tuple[str, ...] = ()
    digits: Mapping[str, Toggle] = field(default_factory=dict)
    letters: Mapping[str, Toggle] = field(default_factory=dict)
    carried: Callable[[Values, float, float], Mapping[str, Value]] | None = None
    title: str = ""
    blocks: bool = False
    baked: tuple[str, ...] = ()
    slots: tuple[Slot[Values], ...] = ()
    unread: tuple[str, ...] = ()
    sounds: Callable[[Values, Terrain], Soundscape] = lambda settings, terrain: STONY

    def values(self, preset: str | None, *changes: Mapping[str, object]) -> Values:
        """Return the settings of a preset (None: the default) with changes; later ones override.

        A word among them, such as the time of day, changes the preset before all other changes.
        """
        name = self.preset if preset is None else preset
        values = declare.preset(self.settings, self.presets, name)
        merged: dict[str, object] = {}
        for each in changes:
            merged |= declare.current_names(self.settings, each)[0]
        return declare.with_settings(values, merged)

    def preset_of(self, view: View) -> str:
        """Return the preset a view is drawn with unless another is asked for."""
        return view.preset or self.preset

    def named(self, name: str) -> View | None:
        """Return the view of this name, be it a fix's; None if there is none."""
        fixed = (fix.as_view() for fix in self.fixes if fix.name == name)
        return self.views.get(name) or next(fixed, None)

    def as_walked(self, view: View, preset: str | None) -> View:
        """Return a view as a walk begins in it; ``preset`` is the one asked for, if any.

        With the view's own preset the walk begins with all that the view is drawn with. Only where
        that is the scene's default do all elements stand around it: other views show one technique
        or a fix, which the rest of the scene would hide. With another preset only the place and the
        settings of a fix are taken. The angle of view of a photograph through a lens is not: a walk
        has none.
        """
        if "camera.lens" in view.settings:
            wide = {key: value for key, value in view.settings.items() if key != "camera.fov"}
            view = replace(view, settings=wide)
        own = self.preset_of(view)
        if preset not in (None, own):
            on = next((fix.on for fix in self.fixes if fix.name == view.name), {})
            return replace(view, preset=preset, settings=on, shown=(), wireframe=False)
        if own == self.preset or not view.shown:
            return replace(view, shown=())
        return replace(view, shown=self.only((*view.shown, *self.overlay)))

    def notices(
        self,
        view: View,
        preset: str | None,
        given: Mapping[str, object],
        only: Iterable[str] | None = None,
        walking: bool = False,
    ) -> dict[str, str]:
        """Return a line for each given setting that changes nothing in a view, by key."""
        values = self.values(preset or self.preset_of(view), view.settings, given)
        drawn = self.shown(view, only, None if walking else values)
        shown = (*drawn, *([conditions.WALK] if walking else []))
        return conditions.notices(values, given, shown, self.elements, self.slots, self.unread)

    def only(self, names: Iterable[str] | None) -> tuple[str, ...]:
        """Return the elements in ``names`` in the scene's order, all for None.

        InputError for a name that is none of them.
        """
        wanted = self.elements if names is None else tuple(names)
        for name in wanted:
            if name not in self.elements:
                raise InputError(
                    "only {name}: expected some of {names}",
                    name=short(name),
                    names=", ".join(self.elements),
                )
        return tuple(name for name in self.elements if name in wanted)

    def shown(
        self, view: View, only: Iterable[str] | None = None, values: Values | None = None
    ) -> tuple[str, ...]:
        """Return the elements a view draws, of those in ``only``.

        With a lens in the ``values`` of a still, nothing is laid over it: a photograph has neither
        sword nor map.
        """
        left_out = self.overlay if values is not None and values.camera.lens else ()
        allowed = (name for name in self.only(only) if name not in left_out)
        return tuple(name for name in allowed if not view.shown or name in view.shown)


Scene: TypeAlias = SceneOf[SceneSettings]
"""A scene of the list, as whoever draws any of them sees it."""

OpenScene: TypeAlias = OpenSceneOf[SceneSettings]


def scene(name: str = "") -> Scene:
    """Return a scene by name, the first of the list without one; InputError if there is none."""
    name = name or next(iter(SCENES))
    if name not in SCENES:
        raise InputError(
            "scene {name!r}: expected one of {names}", name=name, names=", ".join(SCENES)
        )
    found: Scene = import_module(SCENES[name]).SCENE
    return found


def check_options(
    preset: str | None, settings: Mapping[str, object], only: Iterable[str] | None
) -> None:
    """Check options given for views that are not known yet: some scene must accept all of them.

    If none does, raises the InputError of the scene that knows most of the keys.
    """
    reasons: dict[int, InputError] = {}
    for kind in map(scene, SCENES):
        try:
            declare.with_settings(kind.values(preset), settings)
            kind.only(only)
            return
        except InputError as error:
            known = declare.current_names(kind.settings, settings)[0].keys()
            reasons.setdefault(len(known & declare.fields(type(kind.settings)).keys()), error)
    raise reasons[max(reasons)]


def find_view(name: str) -> tuple[Scene, View]:
    """Return a view and its scene; InputError if there is none of this name.

    A fix's name means the view that shows it fixed, a scene's name the one where its walk begins.
    """
    if name in SCENES:
        found = scene(name)
        return found, found.views[found.start]
    for kind in map(scene, SCENES):  # the next one is imported only where it is needed
        if view := kind.named(name):
            return kind, view
    kinds = [scene(each) for each in SCENES]
    names = [each for kind in kinds for each in (*kind.views, *(fix.name for fix in kind.fixes))]
    close = [each for each in names if name and each.lower().startswith(name.lower())][:CLOSE]
    if close:
        raise InputError(
            "view {name}: no such view, but {similar}; `landscape views` lists them all",
            name=short(name),
            similar=listed(close),
        )
    raise InputError(
        "view {name}: no such view; `landscape views` lists them all", name=short(name)
    )


def without_effect(
    views: Iterable[tuple[Scene, View]],
    preset: str | None,
    given: Mapping[str, object],
    only: Iterable[str] | None = None,
    walking: bool = False,
) -> list[str]:
    """Return a line for each given setting that changes nothing in any of these views."""
    found = [kind.notices(view, preset, given, only, walking) for kind, view in views]
    return [line for key, line in found[0].items() if all(key in each for each in found)]


def placed(pose: Pose, terrain: Terrain, eye: float) -> Pose:
    """Return a pose with a height: ``eye`` units above the ground where it has none."""
    if pose.y is not None:
        return pose
    return replace(pose, y=float(terrain.height(pose.x, pose.z)) + eye)


def raised(pose: Pose, terrain: Terrain, eye: float) -> Pose:
    """Return a view's pose, ``eye`` units above the ground if it lies below: on another island.

    In water that one can dive into, only the bed counts.
    """
    ground = float(terrain.height(pose.x, pose.z))
    if (
        isinstance(terrain, Diveable)
        and pose.y is not None
        and pose.y > terrain.bed(pose.x, pose.z)
    ):
        return pose
    return pose if pose.y is None or pose.y > ground else replace(pose, y=ground + eye)


class ListedView(TypedDict):
    """A view as `landscape views --json` prints it; ``pose`` is x, y, z, yaw and pitch."""

    name: str
    scene: str
    figure: str
    pose: list[float]
    kt: float
    preset: str
    shows: str


def listed_views() -> list[ListedView]:
    """Return every view of every scene as `landscape views --json` prints it, heights filled in.

    The views of a scene come first, then its fixes.
    """
    entries: list[ListedView] = []
    for found in map(scene, SCENES):
        terrains: dict[str, Terrain] = {}
        for view in (*found.views.values(), *(fix.as_view() for fix in found.fixes)):
            preset = found.preset_of(view)
            values = found.values(preset)
            if preset not in terrains:
                terrains[preset] = found.terrain(values, Assets())
            pose = placed(view.pose, terrains[preset], values.walk.eye)
            numbers = (pose.x, pose.y, pose.z, pose.yaw, pose.pitch)
            entries.append(
                {
                    "name": view.name,
                    "scene": found.name,
                    "figure": view.figure,
                    "pose": [round(v, 4) for v in numbers if v is not None],
                    "kt": view.kt,
                    "preset": preset,
                    "shows": view.shows,
                }
            )

    return entries


def _set_viewport(moment: Moment) -> None:
    if moment.tile is None:
        gl.glViewport(0, 0, *(scaled(side, moment.detail.scale) for side in moment.size))
    else:
        # The tile is the part of this viewport that is in the framebuffer.
        x, y, *drawn = moment.tile.block
        gl.glViewport(x - moment.tile.x, y - moment.tile.y, *drawn)


def _look_from(pose: Pose) -> None:
    """Multiply the matrix by the one of a camera at a pose."""
    assert pose.y is not None
    if pose.roll:
        gl.glRotatef(-pose.roll, 0.0, 0.0, 1.0)
    gl.glRotatef(-pose.pitch, 1.0, 0.0, 0.0)
    gl.glRotatef(pose.yaw, 0.0, 1.0, 0.0)
    gl.glTranslatef(-pose.x, -pose.y, -pose.z)


def begin_frame(
    moment: Moment, camera: Camera, light: Sun, haze: Fog, fogged: bool = True, far: float = 0.0
) -> Frame:
    """Clear, set the viewport, the camera, the sun and the fog; return what elements need.

    ``far`` may move the far plane beyond ``camera.far``, in units.
    """
    pose, detail = moment.pose, moment.detail
    frame_begins()
    _set_viewport(moment)
    gl.glClearColor(*haze.color, 1.0)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    far = max(camera.far, 2 * camera.near, far)
    gl.glFrustum(*_near_plane(moment, camera), camera.near, far)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    _look_from(pose)

    sun.shine(light)
    if fogged and haze.enabled:
        fog.enable(haze)
    else:
        gl.glDisable(gl.GL_FOG)
    modelview = np.array(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX), np.float64).ravel()
    return Frame(
        pose,
        moment.size,
        moment.kt,
        modelview,
        camera.fov,
        moment.step,
        moment.stroke,
        detail=detail,
        tile=moment.tile,
        faced=moment.faced,
    )


def _near_plane(moment: Moment, camera: Camera) -> tuple[float, float, float, float]:
    """Return left, right, bottom and top of what is seen of the near plane, in units.

    At a scale below 1 the viewport may reach a little beyond the window, at its right and top.
    """
    pixel = 2 * camera.near * math.tan(math.radians(camera.fov) / 2) / moment.size[1]
    edges: list[float] = []
    if moment.tile is not None:
        for k, side in enumerate(moment.size):
            begin, length = moment.tile.block[k], moment.tile.block[k + 2]
            middle = side / 2 + moment.detail.shift[k]
            edges += [pixel * (begin - middle), pixel * (begin + length - middle)]
        return edges[0], edges[1], edges[2], edges[3]
    for side, shift in zip(moment.size, moment.detail.shift, strict=True):
        low = -pixel * (side / 2 + shift)
        drawn = scaled(side, moment.detail.scale) / moment.detail.scale
        edges += [low, pixel * (drawn - side / 2 - shift)]
    left, right, bottom, top = edges
    return left, right, bottom, top
