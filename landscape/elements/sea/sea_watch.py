"""Whether any of the sea can be seen: an occlusion query (GL_ARB_occlusion_query, OpenGL 1.5).

In a wood the sea, its waves and the whole mirrored scene would be drawn for nothing: land hides
them. So once the land stands in the depth buffer a square where the sea may reach highest is drawn
into nothing, neither colour nor depth, and OpenGL counts its samples that pass the depth test. None
means that no pixel of the sea can show.

To ask is cheap, to wait for the answer is not: all that was sent before must be drawn first. While
the sea was in view the answer is therefore read a frame later, when it lies ready, and the frame
draws the sea in any case. A frame waits only while the sea was out of view, and after a leap to
another place. A picture never depends on what was seen before.
State used: colour and depth masks, the query.
"""

import numpy as np

from landscape.frame import Frame
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.state import attrib

ABOVE = 0.05  # chosen: units over the water level that no wave and no breaker reaches
LEAP = 0.5  # chosen: units, or of the line of sight: more than a step between two frames


class SeaWatch:
    """Owner of the query and of the square's display list."""

    def __init__(self, level: float, square: tuple[float, float]) -> None:
        """Watch the sea at a ``level``, within ``square`` = (low, high) in x and in z."""
        self._height, self._square = level + ABOVE, square
        self._query = 0
        self._list: DisplayList | None = None
        self._asked = False
        self._shows = True
        self._last: np.ndarray | None = None

    def expected(self, frame: Frame) -> bool:
        """Return whether the sea must be made ready before it is known if any of it shows."""
        if compiling():
            return self._shows
        if self._asked:
            self._shows, self._asked = self._answer() > 0, False
        here = np.concatenate([frame.eye, frame.pose.forward])
        if self._last is not None and np.abs(here - self._last).max() > LEAP:
            self._shows = False
        self._last = here
        return self._shows

    def ask(self, frame: Frame) -> None:
        """Ask whether any of the sea may show over what is in the depth buffer now."""
        if compiling():
            return
        self._asked = frame.eye_y > self._height
        if not self._asked:
            self._shows = True
            return
        if not self._query:
            self._query = int(np.ravel(gl.glGenQueries(1))[0])
        if self._list is None:
            self._list = DisplayList(self._send)
        with attrib(gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT):
            gl.glBeginQuery(gl.GL_SAMPLES_PASSED, self._query)
            self._list.call()
            gl.glEndQuery(gl.GL_SAMPLES_PASSED)

    def shows(self) -> bool:
        """Return whether the sea may show; waits for the answer unless it showed before.

        While a display list is compiled nothing can be asked: the last answer stands.
        """
        if self._asked and not self._shows and not compiling():
            self._shows, self._asked = self._answer() > 0, False
        return self._shows

    def _send(self) -> None:
        """The square, drawn into neither colour nor depth."""
        for off in (gl.GL_LIGHTING, gl.GL_TEXTURE_2D, gl.GL_FOG):
            gl.glDisable(off)
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
        gl.glDepthMask(gl.GL_FALSE)
        low, high = self._square
        gl.glBegin(gl.GL_QUADS)
        for x, z in ((low, low), (low, high), (high, high), (high, low)):
            gl.glVertex3f(x, self._height, z)
        gl.glEnd()

    def _answer(self) -> int:
        """Return the number of samples, after waiting for it."""
        return int(np.ravel(gl.glGetQueryObjectuiv(self._query, gl.GL_QUERY_RESULT))[0])

    def release(self) -> None:
        """Delete the query and the list; may be called twice."""
        if self._query:
            gl.glDeleteQueries(1, np.array([self._query], np.uint32))
        if self._list is not None:
            self._list.release()
        self._query, self._list, self._asked, self._shows = 0, None, False, True


def compiling() -> bool:
    """Return whether OpenGL is compiling a display list."""
    return bool(gl.glGetIntegerv(gl.GL_LIST_INDEX))
