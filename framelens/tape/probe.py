"""Questions about one pixel, answered by OpenGL: which fragments reach it, and with what colour.

Technique: the scissor box is the one pixel. An occlusion query (OpenGL 1.5) counts the fragments
that a draw gives there, with tests switched off or on; and a framebuffer of floating-point numbers
takes the colour of a fragment before the blending rounds it to 8 bits.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from framelens.gl.features import require
from framelens.gl.named import gl_constant
from framelens.gl.seam import gl

Draws = Callable[[], object]
TARGETS = ("GL_TEXTURE_1D", "GL_TEXTURE_2D", "GL_TEXTURE_3D", "GL_TEXTURE_CUBE_MAP")
TESTS = ("clip", "alpha", "stencil", "depth")


@dataclass(frozen=True)
class Pixel:
    """The framebuffer's values at a pixel: RGBA from 0 to 255, depth 0 to 1, stencil."""

    color: tuple[int, int, int, int]
    depth: float | None
    stencil: int | None


class Probe:
    """Asks about one pixel of the bound framebuffer; owns a query and a framebuffer object."""

    def __init__(self, x: int, y: int, size: tuple[int, int]) -> None:
        """``x`` and ``y`` count from the bottom left, as OpenGL does; ``size`` in pixels."""
        require("a pixel's history")
        self._box = (x, y, 1, 1)
        self.target = int(gl.glGetIntegerv(gl.GL_DRAW_FRAMEBUFFER_BINDING))
        self._depth = int(gl.glGetIntegerv(gl.GL_DEPTH_BITS)) > 0
        self._stencil = int(gl.glGetIntegerv(gl.GL_STENCIL_BITS)) > 0
        self._query = int(np.ravel(gl.glGenQueries(1))[0])
        self._planes = int(gl.glGetIntegerv(gl.GL_MAX_CLIP_PLANES))
        self._units = int(gl.glGetIntegerv(gl.GL_MAX_TEXTURE_UNITS))
        self._float, self._buffers = self._create(size)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, self.target)

    def _create(self, size: tuple[int, int]) -> tuple[int, list[int]]:
        name = int(gl.glGenFramebuffers(1))
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, name)
        buffers = []
        for place, kind in (
            (gl.GL_COLOR_ATTACHMENT0, gl.GL_RGBA32F),
            (gl.GL_DEPTH_STENCIL_ATTACHMENT, gl.GL_DEPTH24_STENCIL8),
        ):
            buffer = int(gl.glGenRenderbuffers(1))
            gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, buffer)
            gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, kind, *size)
            gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, place, gl.GL_RENDERBUFFER, buffer)
            buffers.append(buffer)
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, 0)
        return name, buffers

    def release(self) -> None:
        """Delete the query and the framebuffer object."""
        gl.glDeleteFramebuffers(1, np.array([self._float], np.uint32))
        gl.glDeleteRenderbuffers(len(self._buffers), np.array(self._buffers, np.uint32))
        gl.glDeleteQueries(1, np.array([self._query], np.uint32))

    def here(self) -> bool:
        """Whether draws go to the framebuffer that is asked about, now."""
        return int(gl.glGetIntegerv(gl.GL_DRAW_FRAMEBUFFER_BINDING)) == self.target

    def read(self) -> Pixel:
        """Return what the pixel holds."""
        gl.glPushClientAttrib(gl.GL_CLIENT_PIXEL_STORE_BIT)
        gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
        color = np.zeros(4, np.uint8)
        gl.glReadPixels(*self._box, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, color)
        depth, stencil = np.zeros(1, np.float32), np.zeros(1, np.uint8)
        if self._depth:
            gl.glReadPixels(*self._box, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, depth)
        if self._stencil:
            gl.glReadPixels(*self._box, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE, stencil)
        gl.glPopClientAttrib()
        red, green, blue, alpha = (int(value) for value in color)
        return Pixel(
            (red, green, blue, alpha),
            float(depth[0]) if self._depth else None,
            int(stencil[0]) if self._stencil else None,
        )

    @contextmanager
    def scissored(self) -> Iterator[None]:
        """Let the block change this pixel alone; all state is as before after it."""
        gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glScissor(*self._box)
        try:
            yield
        finally:
            gl.glPopAttrib()

    def count(self, draw: Draws, tests: Sequence[str] = ()) -> int:
        """Return how many fragments of a draw reach the pixel, past those of TESTS alone."""
        with self.scissored():
            gl.glColorMask(False, False, False, False)
            gl.glDepthMask(False)
            gl.glStencilMask(0)
            if "clip" not in tests:
                for plane in range(self._planes):
                    gl.glDisable(gl.GL_CLIP_PLANE0 + plane)
            if "alpha" not in tests:
                gl.glDisable(gl.GL_ALPHA_TEST)
            if "stencil" not in tests:
                gl.glDisable(gl.GL_STENCIL_TEST)
            if "depth" not in tests:
                gl.glDisable(gl.GL_DEPTH_TEST)
            gl.glBeginQuery(gl.GL_SAMPLES_PASSED, self._query)
            draw()
            gl.glEndQuery(gl.GL_SAMPLES_PASSED)
        return int(np.ravel(gl.glGetQueryObjectuiv(self._query, gl.GL_QUERY_RESULT))[0])

    def fragment(self, draw: Draws, prepare: Draws = lambda: None) -> tuple[np.ndarray, float]:
        """Return the colour of a draw's fragment, float64 (4,), before blending, and its depth.

        ``prepare`` may change state first: it lasts for this draw. All tests but the clip planes
        are off; of several fragments it is the one that the program's depth test leaves, else the
        last.
        """
        compared, cleared = self._depth_test()
        with self.scissored():
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, self._float)
            for test in (gl.GL_ALPHA_TEST, gl.GL_STENCIL_TEST, gl.GL_BLEND, gl.GL_COLOR_LOGIC_OP):
                gl.glDisable(test)
            # Writing depth takes the test, which lets all pass.
            gl.glEnable(gl.GL_DEPTH_TEST)
            gl.glDepthFunc(compared)
            gl.glDepthMask(True)
            gl.glColorMask(True, True, True, True)
            # As in a framebuffer of 8 bits, which a fragment's colour reaches between 0 and 1.
            gl.glClampColor(gl.GL_CLAMP_FRAGMENT_COLOR, gl.GL_TRUE)
            gl.glClearColor(0.0, 0.0, 0.0, 0.0)
            gl.glClearDepth(cleared)
            gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
            prepare()
            draw()
            color, depth = np.zeros(4, np.float32), np.zeros(1, np.float32)
            gl.glReadPixels(*self._box, gl.GL_RGBA, gl.GL_FLOAT, color)
            gl.glReadPixels(*self._box, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, depth)
            gl.glClampColor(gl.GL_CLAMP_FRAGMENT_COLOR, gl.GL_FIXED_ONLY)
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, self.target)

        return color.astype(np.float64), float(depth[0])

    def _depth_test(self) -> tuple[int, float]:
        """Return which of a draw's fragments is kept: a comparison, and the depth to begin with."""
        compared = int(number("GL_DEPTH_FUNC"))
        tested = enabled("GL_DEPTH_TEST") and number("GL_DEPTH_WRITEMASK")
        if tested and compared in (gl.GL_LESS, gl.GL_LEQUAL):
            return compared, 1.0
        if tested and compared in (gl.GL_GREATER, gl.GL_GEQUAL):
            return compared, 0.0
        return int(gl.GL_ALWAYS), 1.0

    def units(self) -> list[int]:
        """Return the texture units in use."""
        active = int(gl.glGetIntegerv(gl.GL_ACTIVE_TEXTURE))
        found = []
        for unit in range(self._units):
            gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
            if any(gl.glIsEnabled(gl_constant(target)) for target in TARGETS):
                found.append(unit)
        gl.glActiveTexture(active)
        return found

    @staticmethod
    def without_units(units: Sequence[int]) -> None:
        """Switch texture units off, as a ``prepare`` of :meth:`fragment`."""
        for unit in units:
            gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
            for target in TARGETS:
                gl.glDisable(gl_constant(target))

    def planes(self) -> list[int]:
        """Return the clip planes in use."""
        return [k for k in range(self._planes) if gl.glIsEnabled(gl.GL_CLIP_PLANE0 + k)]


def enabled(name: str) -> bool:
    """Whether something is enabled."""
    return bool(gl.glIsEnabled(gl_constant(name)))


def number(name: str) -> Any:
    """Return a state variable's number, or numbers as a list."""
    found = np.ravel(gl.glGetFloatv(gl_constant(name)))
    return float(found[0]) if found.size == 1 else [float(each) for each in found]
