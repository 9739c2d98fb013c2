"""The scenes of a walk: the one that the walker is in, and those that he has left by a door.

A scene that is left stays open, so that coming back takes no time; the price is its memory.
"""

import math
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from framelens.base.errors import InputError
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.digging import Diggable
from landscape.geometry.doors import Door, Doored
from landscape.geometry.flown import Flown
from landscape.scene.scene import Fix, Moment, OpenScene, Scene, SceneSettings, scene
from landscape.settings import declare
from landscape.settings.declare import Value
from landscape.sound.soundscape import Soundscape
from landscape.walk.collisions import Surroundings, reachable, solid
from landscape.walk.escape import moved
from landscape.walk.list_image import list_image
from landscape.walk.recording import Plan
from landscape.walk.settings_list import Chooser, page
from landscape.walk.walker import Intent, Walker


class Place:
    """A scene as it is walked: what kind it is, its settings and their list, the chosen fix."""

    def __init__(self, kind: Scene, settings: SceneSettings, preset: str | None) -> None:
        """Open nothing yet; ``preset`` is what the list of settings goes back to."""
        self.kind, self.settings = kind, settings
        self._defaults = kind.values(preset)
        self.chooser = Chooser(self._defaults)
        self._fix = 0
        self._scene: OpenScene | None = None
        self._sounds: tuple[tuple[OpenScene, SceneSettings], Soundscape] | None = None

    @property
    def scene(self) -> OpenScene:
        """The open scene."""
        assert self._scene is not None
        return self._scene

    @property
    def land(self) -> Diggable | None:
        """The open scene as one of blocks; None if it has none."""
        return self.scene if isinstance(self.scene, Diggable) else None

    def shows(self, moment: Moment) -> tuple[object, ...]:
        """Return what the picture of a moment depends on besides the walker.

        Settings, elements, changed blocks, and the camera's pose, which may fly by itself.
        """
        scene = self.scene
        changes = self.land.changes if self.land is not None else 0
        eye = scene.eye(moment.pose, moment.kt) if isinstance(scene, Flown) else moment.pose
        return self.settings, frozenset(scene.shown), changes, eye

    def soundscape(self) -> Soundscape:
        """Return what there is to hear in the open scene with its settings."""
        made_of = self.scene, self.settings
        if self._sounds is None or self._sounds[0] != made_of:
            self._sounds = made_of, self.kind.sounds(self.settings, self.scene)
        return self._sounds[1]

    @property
    def is_open(self) -> bool:
        """Whether the scene is open."""
        return self._scene is not None

    def open(self, assets: Assets, seed: int, only: Sequence[str] | None = None) -> None:
        """Open the scene; if it is open, open it anew with the elements it shows. InputError.

        Blocks that were changed stay so; as another land has none of them, that is not opened then.
        """
        former = self._scene
        names = former.shown if former is not None else only
        opened = self.kind.open(self.settings, assets, seed, self.kind.only(names or None))
        if isinstance(former, Diggable) and isinstance(opened, Diggable) and former.is_changed:
            try:
                opened.restore(former.saved(), self.kind.title)
            except InputError:
                opened.release()
                raise InputError("blocks were changed, which another land would not have") from None
        self._scene, self._sounds = opened, None
        if former is not None:
            former.release()

    def apply(self, changes: Mapping[str, object], anew: Callable[[], None]) -> None:
        """Change settings, and call ``anew`` to open the scene again if it cannot take them.

        InputError if it cannot be opened with them. Whatever is raised, nothing has changed then.
        """
        former = self.settings
        self.settings = declare.passing(former, self._defaults, changes)
        try:
            if self.is_open and not self.scene.apply(self.settings):
                anew()
        except BaseException:
            self.settings = former
            raise

    def begin_with(self, name: str) -> None:
        """Choose the fix of a name, if there is one."""
        names = [fix.name for fix in self.kind.fixes]
        self._fix = names.index(name) if name in names else 0

    def choose_fix(self, way: int) -> Fix:
        """Return the chosen fix (``way`` 0), or choose the next (1) or the previous (-1)."""
        self._fix = (self._fix + way) % len(self.kind.fixes)
        return self.kind.fixes[self._fix]

    @property
    def doors(self) -> Sequence[Door]:
        """The scene's doors, none if it has none."""
        return self.scene.doors if isinstance(self.scene, Doored) else ()

    def way_in(self, door: Door, intent: Intent) -> Pose:
        """Return where one stands who has come here, by ``intent``, through a door elsewhere."""
        own = next((each for each in self.doors if each.name == door.to), None)
        return own.left_by(intent.way) if own else self.kind.views[self.kind.start].pose

    def moved(self, walker: Walker, intent: Intent, seconds: float) -> Walker:
        """Return the walker ``seconds`` later: let out if he is stuck, led to a door beside him."""
        opened, settings = self.scene, self.settings
        after = moved(walker, intent, seconds, opened, opened.obstacles, settings)
        if after.flying or after.body is not None or not intent.walks or not self.doors:
            return after
        reach = settings.walk.speed * seconds / 2
        if math.dist((walker.x, walker.z), (after.x, after.z)) > reach:
            return after
        return _led(self.doors, after, intent, reach, opened)

    def release(self) -> None:
        """Release the scene; may be called twice."""
        if self._scene is not None:
            self._scene.release()
        self._scene = self._sounds = None


class Places:
    """The places that the walker has left, and what the user has set in any of them."""

    def __init__(self, plan: Plan) -> None:
        """Nothing has been left yet."""
        self._preset = plan.preset
        self._given: dict[str, Value] = dict(plan.given)
        self._left: dict[str, Place] = {}

    def give(self, changes: Mapping[str, Value]) -> None:
        """Take note of settings that the user has changed."""
        self._given |= changes

    def behind(self, door: Door) -> Place:
        """Return the place behind a door: the one that was left, or one not open yet."""
        kind = scene(door.scene)
        preset = self._preset if self._preset in kind.presets else kind.preset
        return self._left.get(kind.name) or Place(kind, kind.values(preset), preset)

    def enter(self, place: Place, assets: Assets, seed: int) -> None:
        """Open a place unless it is open. InputError if it cannot be opened.

        What the user has set elsewhere goes with him where the scene has such a setting.
        """
        known = declare.fields(type(place.settings))
        own = {key: value for key, value in self._given.items() if key in known}
        place.apply(own, lambda: place.open(assets, seed))
        if not place.is_open:
            place.open(assets, seed)
        self._left.pop(place.kind.name, None)

    def leave(self, place: Place) -> None:
        """Keep a place, to come back to."""
        self._left[place.kind.name] = place

    def release(self) -> None:
        """Release the places that were left; may be called twice."""
        while self._left:
            self._left.popitem()[1].release()


def at_doors(
    doors: Sequence[Door], walker: Walker, intent: Intent
) -> tuple[Door | None, Door | None]:
    """Return the door that a walker goes through, and the one that he stands before, if any."""
    pose = walker.pose
    way = pose.yaw + intent.way
    place = walker.x, walker.y, walker.z
    entered = (door for door in doors if intent.walks and door.entered(place, way))
    return next(entered, None), next((door for door in doors if door.faced(pose)), None)


def _led(
    doors: Sequence[Door], walker: Walker, intent: Intent, reach: float, opened: OpenScene
) -> Walker:
    """Return the walker up to ``reach`` units nearer to the door whose wall he walks at, if any."""
    at = walker.x, walker.y, walker.z
    for door in doors:
        if aside := door.aside(at, walker.yaw + intent.way):
            yaw = math.radians(door.yaw)
            step = max(-reach, min(-aside, reach))
            to = walker.x + step * math.cos(yaw), walker.z + step * math.sin(yaw)
            near = solid(Surroundings(opened.obstacles).at(walker.x, walker.z), walker.y)
            x, z = reachable((walker.x, walker.z), to, opened, near)
            return replace(walker, x=x, z=z)
    return walker


def list_picture(
    place: Place, row: str, done: str, language: str, size: tuple[int, int], dpi: float
) -> tuple[Hashable, Callable[[], np.ndarray]]:
    """Return what the picture of a place's list of settings depends on, and how to make it."""
    state = place.settings, place.chooser.defaults, row, done, language
    kind = place.kind
    shows = *state, frozenset(place.scene.shown), kind.elements, kind.slots, kind.unread
    return shows, lambda: list_image(page(*shows), size, dpi)
