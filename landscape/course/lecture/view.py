"""A step that is a view: its scene is walked live in the area; and one that stands still."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from framelens.gl.apart import apart
from framelens.gl.named import glfw_constant
from framelens.gl.seam import gl, recording, unnoted
from framelens.state import state
from framelens.tape.tape import Tape
from landscape.course.lecture.image import message_image
from landscape.course.lecture.program import strip
from landscape.course.lecture.stage import Stage
from landscape.files.assets import Assets
from landscape.frame import SEED
from landscape.scene.scene import Moment, find_view
from landscape.walk.app import Walk
from landscape.walk.pace import FPS
from landscape.walk.recording import Plan


class LectureWalk(Walk):
    """A walk on a stage, which plays the step."""

    def __init__(self, stage: Stage, plan: Plan) -> None:
        """Open the scene on the stage; InputError, NoOpenGLError as for a walk."""
        super().__init__(plan, Assets(), fps=FPS, context=stage)

    def tape(self) -> Tape:
        """Return a frame of the scene as it is now, recorded."""
        walker = self.walker
        moment = Moment(
            walker.pose, self._size, self.kt, walker.step, walker.stroke, self._wireframe
        )
        with recording(complete=True) as recorder:
            begins = state.read()
            self.place.scene.draw(moment)
        return Tape(recorder.calls, 0, begins, self._size)

    def key(self, key: int, action: int, mods: int) -> None:
        """Take a key."""
        self.hands.key(key, action, mods)

    def button(self, button: int, action: int, mods: int) -> None:
        """Take a button of the mouse."""
        self.hands.button(button, action, mods)

    def motion(self, x: float, y: float) -> None:
        """Take a motion of the mouse."""
        self.hands.motion(x, y)

    def scroll(self, x: float, y: float) -> None:
        """Take the mouse's wheel."""
        self.hands.wheel(y)

    def obey(self, order: str) -> None:
        """Carry out an order; the inspector names the key that opens it in any step."""
        super().obey(order)
        if order == "inspector":
            self.inspection.letters["letter"] = "F12"

    def inspect(self) -> None:
        """Open or close the inspector."""
        self.obey("inspector")

    def escape(self) -> bool:
        """Close the inspector or the list of settings, or release the mouse."""
        if self.inspection.open:
            self.obey("inspector")
        elif self.hands.captured:
            self.obey("release")
        elif self.hands.listing:
            self.hands.picks.append("list")
            self.hands.listing = False
        else:
            return False
        return True


def play(stage: Stage, name: str, keys: Sequence[str], language: str) -> None:
    """Walk a view until the user leaves; InputError, NoOpenGLError as for a walk."""
    with LectureWalk(stage, planned(name, stage.pixels(), language)) as walk:
        stage.player = walk
        for key in keys:
            code = glfw_constant(stage.glfw, f"KEY_{key}")
            walk.key(code, stage.glfw.PRESS, 0)
            walk.key(code, stage.glfw.RELEASE, 0)
        while not stage.leaving:
            if not walk.resting():
                _frame(stage, walk, name, language)
        walk.obey("release")


def planned(name: str, size: tuple[int, int], language: str) -> Plan:
    """Return how the walk begins at a view, in an area of ``size`` pixels."""
    kind, begin = find_view(name)
    preset = kind.preset_of(begin)
    return Plan(
        scene=kind.name,
        settings=kind.values(preset, begin.settings),
        view=begin.name,
        pose=begin.pose,
        size=size,
        kt=begin.kt,
        seed=SEED,
        only=kind.shown(begin),
        wireframe=begin.wireframe,
        language=language,
        preset=preset,
    )


def _frame(stage: Stage, walk: LectureWalk, name: str, language: str) -> None:
    tick = walk.listen()
    if tick is None:
        stage.to = -1
        return
    walk.advance(tick)
    walk.draw()
    if stage.wants_strip:
        picture = strip(walk.tape(), stage, name, language)
        stage.show_strip(picture)
        walk.draw()
    stage.cover()
    walk.steady.show(walk.window)
    stage.pace()


def say(stage: Stage, text: str) -> None:
    """Show a sentence until the user leaves."""
    stand(stage, partial(message_image, text=text))


def stand(stage: Stage, image: Callable[[tuple[int, int], int], np.ndarray]) -> None:
    """Show a picture, made for the area's size and the window's height, until the user leaves."""
    with unnoted():
        gl.glClearColor(0.0, 0.0, 0.0, 1.0)
    still: Any = _Still()
    stage.player = still
    while not stage.leaving:
        stage.poll()
        with unnoted(), apart(stage.whole()):
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            shows = stage.pixels(), stage.whole()[1]
            stage.plates.draw("still", (0, 0), (stage.index, *shows), partial(image, *shows))
        stage.wants_strip = False
        stage.show()


class _Still:
    """Plays a step that stands still: it takes no notice of the user."""

    def key(self, *_: object) -> None:
        pass

    button = motion = scroll = inspect = key

    def escape(self) -> bool:
        return False
