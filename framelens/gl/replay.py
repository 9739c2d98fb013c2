"""Replaying a whole frame without Python: display lists, and the calls that no list can hold."""

from collections.abc import Callable

from framelens.gl.seam import gl, noting, replacing


class Replay:
    """A frame as display lists, with the framebuffer changes between them.

    A list cannot hold those: OpenGL executes glBindFramebuffer at once, even while it compiles a
    list, and calling the list does not repeat it. So a list ends before each such call, and the
    next begins after it.
    """

    def __init__(self, draw: Callable[[], object]) -> None:
        """Compile what ``draw`` calls; it must leave the same framebuffer bound as before."""
        self._names: list[int] = []
        self._steps: list[Callable[[], object]] = []
        with replacing("glBindFramebuffer", self._between) as self._bind:
            self._begin()
            try:
                draw()
            finally:
                gl.glEndList()

    def _begin(self) -> None:
        name = int(gl.glGenLists(1))
        self._names.append(name)
        self._steps.append(lambda: gl.glCallList(name))
        gl.glNewList(name, gl.GL_COMPILE)

    def _between(self, target: int, name: int) -> None:
        gl.glEndList()
        self._steps.append(lambda: gl.glBindFramebuffer(target, name))
        self._bind(target, name)
        self._begin()

    def call(self) -> None:
        """Draw the frame once more."""
        for step in self._steps:
            step()

    def release(self) -> None:
        """Delete the lists; may be called twice."""
        with noting():
            for name in self._names:
                gl.glDeleteLists(name, 1)
        self._names, self._steps = [], []
