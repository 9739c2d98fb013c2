"""Whether any of a level surface can be seen: an occlusion query (GL_ARB_occlusion_query).

Once the land is in the depth buffer, the surface is drawn into neither colour nor depth, and OpenGL
counts the samples that pass the depth test (OpenGL 1.5). If there are none, no pixel of it can
show, and what it would mirror need not be drawn.

Asking is cheap; waiting for the answer is not, because everything sent before must be drawn first.
If the surface was in view, the answer is therefore read one frame later, when it is ready, and the
frame draws it in any case. A frame waits only if it was out of view, and after a jump to another
place. A picture never depends on what was seen before.
State used: colour and depth masks, the query.
"""

import math
from operator import sub

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib
from landscape.frame import Frame
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import level_square

JUMP = 0.5  # chosen: change of position in units, or of the unit view vector: no step is so large


class SurfaceQuery:
    """Owner of the query and of the display list of a square, level at ``height``.

    In each frame: ``expected`` before anything is drawn, ``ask`` after the land, then ``shows``.
    """

    def __init__(self, height: float, low: float, high: float, near: float) -> None:
        """Make the query for a square from ``low`` to ``high`` in x and z; ``near``: the plane."""
        self._height, self._near = height, near

        def send() -> None:
            for off in (gl.GL_LIGHTING, gl.GL_TEXTURE_2D, gl.GL_FOG):
                gl.glDisable(off)
            gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
            gl.glDepthMask(gl.GL_FALSE)
            level_square(low, high, height)

        self._list = DisplayList(send)
        self._query = int(np.ravel(gl.glGenQueries(1))[0])
        self._asked = False
        self._shows = True
        self._last: tuple[float, ...] | None = None

    def expected(self, frame: Frame) -> bool:
        """Return whether to draw a mirror image before it is known if the surface is visible."""
        if compiling():
            return self._shows
        if self._asked:
            self._shows, self._asked = self._answer() > 0, False
        here = (*frame.eye.tolist(), *frame.pose.forward)
        if self._last is not None and max(map(abs, map(sub, here, self._last))) > JUMP:
            self._shows = False
        self._last = here
        return self._shows

    def ask(self, frame: Frame) -> None:
        """Start the query: may any of it show in front of what is in the depth buffer?"""
        if compiling():
            return
        # The near plane would clip a square that is closer than its corners.
        self._asked = frame.eye_y > self._height + self._near * corner(frame)
        if not self._asked:
            self._shows = True
            return
        with attrib(gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT):
            gl.glBeginQuery(gl.GL_SAMPLES_PASSED, self._query)
            self._list.call()
            gl.glEndQuery(gl.GL_SAMPLES_PASSED)

    def shows(self, wait: bool = False) -> bool:
        """Return whether it may show; waits for the answer unless it showed before, or ``wait``.

        While a display list is being compiled no query is possible: the last answer is used.
        """
        if self._asked and (wait or not self._shows) and not compiling():
            self._shows, self._asked = self._answer() > 0, False
        return self._shows

    def _answer(self) -> int:
        """Wait for the number of samples and return it."""
        return int(np.ravel(gl.glGetQueryObjectuiv(self._query, gl.GL_QUERY_RESULT))[0])

    def release(self) -> None:
        """Delete the query and the list; may be called twice."""
        if self._query:
            gl.glDeleteQueries(1, np.array([self._query], np.uint32))
            self._query = 0
        self._list.release()


def corner(frame: Frame) -> float:
    """Return the distance from the eye to the near plane's corners, times that of the plane."""
    top = math.tan(math.radians(frame.fov) / 2)
    return math.hypot(1.0, top, top * frame.size[0] / frame.size[1])


def compiling() -> bool:
    """Return whether OpenGL is compiling a display list."""
    return bool(gl.glGetIntegerv(gl.GL_LIST_INDEX))
