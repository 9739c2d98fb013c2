"""Display lists: calls that OpenGL keeps, so that one call repeats them all (OpenGL 1.0)."""

from collections.abc import Callable

import numpy as np

from framelens.gl.seam import gl, noting


class DisplayList:
    """Owner of one display list. A recording shows the calls it was compiled from."""

    def __init__(self, draw: Callable[[], None]) -> None:
        """Compile what ``draw`` calls; vertex arrays are copied into the list."""
        self.name = int(gl.glGenLists(1))
        with noting():
            gl.glNewList(self.name, gl.GL_COMPILE)
            try:
                draw()
            finally:
                gl.glEndList()

    def call(self) -> None:
        """Execute the list."""
        gl.glCallList(self.name)

    def release(self) -> None:
        """Delete the list; may be called twice."""
        if self.name:
            with noting():
                gl.glDeleteLists(self.name, 1)
            self.name = 0


def call_lists(lists: list[DisplayList]) -> None:
    """Execute several lists in order, by one glCallLists."""
    names = np.array([each.name for each in lists], np.uint32)
    gl.glCallLists(len(names), gl.GL_UNSIGNED_INT, names)
