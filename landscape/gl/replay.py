"""A whole frame to be drawn again without Python: display lists, and what no list holds."""

from collections.abc import Callable
from functools import partial

from landscape.gl.calls import gl


class Replay:
    """A frame as display lists, with the changes of framebuffer between them.

    A list does not hold those: OpenGL carries them out while it compiles, and never again.
    """

    def __init__(self, draw: Callable[[], object]) -> None:
        """Compile what ``draw`` sends; it must leave the framebuffer bound that it found."""
        self._names: list[int] = []
        self._steps: list[Callable[[], object]] = []
        bind = gl.glBindFramebuffer

        def between(target: int, name: int) -> None:
            gl.glEndList()
            self._steps.append(partial(bind, target, name))
            bind(target, name)
            self._open()

        gl.__dict__["glBindFramebuffer"] = between
        try:
            self._open()
            draw()
        finally:
            gl.glEndList()
            gl.__dict__["glBindFramebuffer"] = bind

    def _open(self) -> None:
        name = int(gl.glGenLists(1))
        self._names.append(name)
        self._steps.append(partial(gl.glCallList, name))
        gl.glNewList(name, gl.GL_COMPILE)

    def call(self) -> None:
        """Draw the frame once more."""
        for step in self._steps:
            step()

    def release(self) -> None:
        """Delete the lists; may be called twice."""
        for name in self._names:
            gl.glDeleteLists(name, 1)
        self._names, self._steps = [], []
