"""Showing frames at a steady rate: how finely the next one is drawn follows from the last ones.

The pace decides (pace.py), the stretch draws (stretch.py), and here the time is taken. It begins
and ends with work: waiting for the screen is no reason to draw less.
"""

from collections.abc import Callable
from dataclasses import replace

import glfw

from framelens.gl.seam import gl
from landscape.frame import Detail
from landscape.scene.scene import Moment
from landscape.walk.pace import Pace
from landscape.walk.stretch import Stretch


class Steady:
    """Draws the frames of a window, and shows them; owns the textures that this takes."""

    def __init__(self, fps: float) -> None:
        """Keep ``fps`` frames per second where less detail can; 0 always draws everything."""
        self._pace, self._stretch = Pace(fps), Stretch()
        self._began = self._ended = 0.0
        self._shown: tuple[object, ...] = ()
        self._moved = True

    @property
    def level(self) -> int:
        """How much less is drawn: a level of the pace, 0 for everything."""
        return self._pace.level

    @property
    def detail(self) -> Detail:
        """The detail of the next frame."""
        return self._pace.detail

    def draw(
        self,
        moment: Moment,
        draw: Callable[[Moment], None],
        whole: bool = False,
        scene: tuple[object, ...] = (),
    ) -> None:
        """Let ``draw`` draw a moment; ``whole`` asks for all its detail.

        ``scene`` is what else the picture depends on: when it is another one than before, the
        picture does not stand still, or what has changed would only fade in.
        """
        self._began = glfw.get_time()
        shown = moment.pose, moment.stroke, moment.size, moment.wireframe, scene
        self._moved, self._shown = shown != self._shown, shown
        if not whole:
            moment = replace(moment, detail=self._pace.detail)
        self._stretch.draw(moment, draw, self._pace.interlaced and not whole)

    def show(self, window: object) -> None:
        """Show what was drawn, and take note of how long it took."""
        if not self._pace.active:
            glfw.swap_buffers(window)
            return
        gl.glFinish()
        drawn = glfw.get_time()
        glfw.swap_buffers(window)
        now = glfw.get_time()
        # To swap is to copy the picture, at least in software; but it may also wait.
        spent = drawn - self._began
        spent += min(now - drawn, spent / 4)
        self._pace.frame(spent, max(now - self._ended, 0.0), self._moved)
        self._ended = now

    def release(self) -> None:
        """Delete the textures; may be called twice."""
        self._stretch.release()
