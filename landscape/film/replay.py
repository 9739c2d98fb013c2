"""A clip of a recorded walk: the same walk as in the window, without the window.

The walker's intents are carried out frame by frame of the recording, drawn or not, so
each process that draws the film walks the whole walk; that takes a small part of the time of
drawing it. Between two frames of the recording the eye is interpolated: a film may have more frames
per second than the walk had, or fewer. Messages, keys and lists are of the window, and not shown.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from framelens.base.errors import InputError
from landscape.film.clip import Pictures
from landscape.film.stage import Stage
from landscape.frame import Pose
from landscape.geometry.digging import Diggable
from landscape.geometry.doors import Door
from landscape.scene.scene import Moment, scene
from landscape.settings import declare
from landscape.sound.score import Heard
from landscape.walk.builder import SWITCHES, Builder
from landscape.walk.hearing import heard
from landscape.walk.keys import SETTINGS
from landscape.walk.place import Place, Places, at_doors
from landscape.walk.recording import Plan, Tick
from landscape.walk.walker import Intent, Walker, start

JUMP = 0.5  # chosen: units between two frames of a recording, more than any step: not interpolated


@dataclass(frozen=True)
class Recorded:
    """A recorded walk, or its first ``seconds``."""

    plan: Plan
    ticks: tuple[Tick, ...]
    seconds: float

    needs_opengl: ClassVar[bool] = True

    def open(self, stage: Stage) -> Pictures:
        """Return what draws it."""
        return Replay(self.plan, self.ticks, stage).picture

    def listen(self, stage: Stage) -> Callable[[float], Heard]:
        """Return what the walker heard."""
        return Replay(self.plan, self.ticks, stage).heard


@dataclass(frozen=True)
class State:
    """The state of the walk that a frame shows, apart from the scene's own state."""

    walker: Walker
    kt: float
    wireframe: bool
    place: Place


class Replay:
    """The walk as it is carried out; pictures of times that go forward need no second walk."""

    def __init__(self, plan: Plan, ticks: tuple[Tick, ...], stage: Stage) -> None:
        """Open nothing yet."""
        self._plan = plan
        self._ticks = ticks
        self._stage = stage
        self.ends = np.cumsum([tick.seconds for tick in ticks])
        self._places: Places | None = None
        self._next = 0

    def _begin(self) -> None:
        """Open the scene in which the walk begins, and stand where it begins."""
        plan = self._plan
        self.release()
        place = Place(scene(plan.scene), plan.settings, plan.preset or None)
        place.begin_with(plan.view)
        self._places, self._next = Places(plan), 0
        with self._stage.offscreen.targeted():
            place.open(self._stage.assets, plan.seed, plan.only)
        walker = start(plan.pose, place.scene, plan.settings)
        self._builder = Builder(None, plan.language)
        self.state = State(walker, plan.kt, plan.wireframe, place)
        self.before, self._changes = self.state, 0

    def picture(self, seconds: float) -> np.ndarray:
        """Return the picture at a time of the walk, uint8 (h, w, 3)."""
        moment = self.moment(seconds)
        opened = self.state.place.scene
        changes = opened.changes if isinstance(opened, Diggable) else 0
        if changes != self._changes:
            # Part of a changed world follows a frame later; here it is there at once, whichever
            # frames this process draws.
            self._changes = changes
            for _ in range(2):
                self._stage.draw(opened, moment)
        return self._stage.draw(opened, moment)

    def heard(self, seconds: float) -> Heard:
        """Carry out the walk up to a time, and return what is heard then, muted or not."""
        moment = self.moment(seconds)
        walker = replace(self.state.walker, x=moment.pose.x, z=moment.pose.z, yaw=moment.pose.yaw)
        now = heard(self.state.place, walker, moment.kt, self._builder)
        return replace(now, volume=self.state.place.settings.sound.volume)

    def moment(self, seconds: float) -> Moment:
        """Carry out the walk up to a time, and return what is seen then."""
        if self._places is None or (self._next and seconds < self.ends[self._next - 1]):
            self._begin()

        self._carry_out(seconds)

        end = self.ends[self._next - 1] if self._next else 0.0
        length = self._ticks[self._next - 1].seconds if self._next else 0.0
        share = min(max(1.0 - float(end - seconds) / length, 0.0), 1.0) if length > 0.0 else 1.0
        now, then = self.state, self.before
        kt = then.kt + share * (now.kt - then.kt)
        walker = now.walker
        pose = walker.pose
        if now.place is then.place and share < 1.0:
            pose = between(then.walker.pose, pose, share)
        steps = walker.step, walker.stroke
        return Moment(pose, self._stage.size, kt, *steps, now.wireframe)

    def _carry_out(self, seconds: float) -> None:
        """Carry out the frames up to the one that ends at a time or after it.

        What happened until then has happened.
        """
        while self._next < len(self._ticks) and (
            self._next == 0 or self.ends[self._next - 1] < seconds
        ):
            with self._stage.offscreen.targeted():
                self.advance(self._ticks[self._next])
            self._next += 1

    def advance(self, tick: Tick) -> None:
        """Carry out one frame of the walk, as the window does."""
        self.before = self.state
        state, place = self.state, self.state.place
        kt = state.kt + tick.seconds * place.settings.clock.kt_per_second
        state = replace(state, kt=kt)
        for name in tick.actions:
            state = self._switched(state, name)
        if tick.changes:
            self._change(place, tick.changes)
        walker = place.moved(state.walker, tick.intent, tick.seconds)
        self._builder.advance(place.land, walker, tick)
        entered, _ = at_doors(place.doors, walker, tick.intent)
        state = replace(state, walker=walker)
        self.state = state if entered is None else self._passed(state, entered, tick.intent)

    def _switched(self, state: State, name: str) -> State:
        """Return the state after a switch."""
        place = state.place
        if name == "wireframe":
            return replace(state, wireframe=not state.wireframe)
        if name in SWITCHES:
            self._builder.switch(place.land, name)
        elif name in ("fix", "next_fix", "previous_fix", "go_to_fix"):
            if place.kind.fixes:
                return self._fixed(state, name)
        elif name != "help" and SETTINGS[name] in declare.fields(type(place.settings)):
            key = SETTINGS[name]
            self._apply(place, {key: declare.next_value(place.settings, key)})
        return state

    def _fixed(self, state: State, name: str) -> State:
        """Return the state after a fix is chosen, gone to, or turned on or off."""
        place = state.place
        fix = place.choose_fix({"next_fix": 1, "previous_fix": -1}.get(name, 0))
        if name == "go_to_fix":
            return replace(state, walker=start(fix.pose(False), place.scene, place.settings))
        if name == "fix":
            on = declare.with_settings(place.settings, fix.on) == place.settings
            self._apply(place, fix.off if on else fix.on)
        return state

    def _change(self, place: Place, changes: Mapping[str, declare.Value]) -> None:
        """Make changes from the list of settings; those that cannot be made were not, then."""
        assert self._places is not None
        try:
            self._apply(place, changes)
        except InputError:
            return
        self._places.give(dict(changes))

    def _apply(self, place: Place, changes: Mapping[str, object]) -> None:
        place.apply(changes, lambda: place.open(self._stage.assets, self._plan.seed))

    def _passed(self, state: State, door: Door, intent: Intent) -> State:
        """Return the state behind a door."""
        assert self._places is not None
        left, place = state.place, self._places.behind(door)
        try:
            self._places.enter(place, self._stage.assets, self._plan.seed)
        except InputError:
            walker = start(door.way_out, left.scene, left.settings)
            return replace(state, walker=walker)
        self._places.leave(left)
        self._changes = 0
        walker = start(place.way_in(door, intent), place.scene, place.settings)
        return replace(state, walker=walker, place=place)

    def release(self) -> None:
        """Close the scenes of the walk; may be called twice."""
        if self._places is not None:
            with self._stage.offscreen.targeted():
                self.state.place.release()
                self._places.release()
            self._places = None


def between(then: Pose, now: Pose, share: float) -> Pose:
    """Return the pose at ``share`` 0..1 of the way; after a jump, the later one."""
    assert then.y is not None and now.y is not None
    if max(abs(then.x - now.x), abs(then.y - now.y), abs(then.z - now.z)) > JUMP:
        return now
    turn = (now.yaw - then.yaw + 180.0) % 360.0 - 180.0
    return Pose(
        then.x + share * (now.x - then.x),
        then.y + share * (now.y - then.y),
        then.z + share * (now.z - then.z),
        then.yaw + share * turn,
        then.pitch + share * (now.pitch - then.pitch),
    )
