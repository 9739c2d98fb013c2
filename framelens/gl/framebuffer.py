"""Where stills are drawn: a framebuffer object, antialiased or not, and reading it back.

Every backend draws stills to the same kind of target, so that the same command gives the same
pixels whatever the backend. It needs ARB_framebuffer_object (OpenGL 3.0); the pictures themselves
need nothing later than OpenGL 1.5. Without it stills are drawn, not antialiased, into the context's
own framebuffer.
"""

import sys

import numpy as np

from framelens.base.errors import InputError
from framelens.gl.context import Context
from framelens.gl.features import possible
from framelens.gl.seam import gl

MOST_SMOOTH = 1 << 25  # pixels, chosen: a picture of 7680x4320 takes 1.8 GB with four samples


class Framebuffer:
    """Owner of a colour and a depth-stencil renderbuffer, 0 or 4 samples."""

    def __init__(self, size: tuple[int, int], samples: int = 0) -> None:
        """Create and bind a target of ``size`` = (width, height) pixels.

        InputError where the size exceeds GL_MAX_VIEWPORT_DIMS or, with samples, MOST_SMOOTH.
        """
        check_size(size, int(gl.glGetIntegerv(gl.GL_MAX_RENDERBUFFER_SIZE)))
        if samples and size[0] * size[1] > MOST_SMOOTH:
            text = f"{size[0]}x{size[1]}"
            raise InputError(
                "size {text}: expected at most {most_smooth:.0f} megapixels with "
                "antialiasing, or samples 0",
                text=text,
                most_smooth=MOST_SMOOTH / 1000000.0,
            )
        self.size = size
        self.samples = min(samples, int(gl.glGetIntegerv(gl.GL_MAX_SAMPLES)))
        self._names: list[tuple[int, list[int]]] = [self._create(self.samples)]
        if self.samples:
            self._names.append(self._create(0))
        self._pixels = np.empty((size[1], size[0], 3), np.uint8)
        self.bind()

    def _create(self, samples: int) -> tuple[int, list[int]]:
        frame = int(gl.glGenFramebuffers(1))
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, frame)
        buffers = []
        for place, kind in (
            (gl.GL_COLOR_ATTACHMENT0, gl.GL_RGBA8),
            (gl.GL_DEPTH_STENCIL_ATTACHMENT, gl.GL_DEPTH24_STENCIL8),
        ):
            buffer = int(gl.glGenRenderbuffers(1))
            gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, buffer)
            gl.glRenderbufferStorageMultisample(gl.GL_RENDERBUFFER, samples, kind, *self.size)
            gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, place, gl.GL_RENDERBUFFER, buffer)
            buffers.append(buffer)

        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, 0)

        state = gl.glCheckFramebufferStatus(gl.GL_FRAMEBUFFER)
        if state != gl.GL_FRAMEBUFFER_COMPLETE:
            raise InputError(
                "size {width}x{height}: no memory for the framebuffer",
                width=self.size[0],
                height=self.size[1],
            )
        return frame, buffers

    def bind(self) -> None:
        """Draw here from now on."""
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, self._names[0][0])

    def read(self) -> np.ndarray:
        """Return the picture, uint8 (h, w, 3), top row first: a new array."""
        width, height = self.size
        if self.samples:
            source, target = self._names[0][0], self._names[1][0]
            gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, source)
            gl.glBindFramebuffer(gl.GL_DRAW_FRAMEBUFFER, target)
            box = (0, 0, width, height)
            gl.glBlitFramebuffer(*box, *box, gl.GL_COLOR_BUFFER_BIT, gl.GL_NEAREST)
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, target)
        pixels = read_pixels(self.size, self._pixels)
        self.bind()
        return pixels

    def release(self) -> None:
        """Delete the framebuffer and its renderbuffers; may be called twice."""
        for frame, buffers in self._names:
            gl.glDeleteFramebuffers(1, np.array([frame], np.uint32))
            gl.glDeleteRenderbuffers(len(buffers), np.array(buffers, np.uint32))
        self._names = []


class DefaultFramebuffer:
    """The context's own framebuffer, as large as a still; it has one sample a pixel."""

    samples = 0

    def __init__(self, context: Context, size: tuple[int, int]) -> None:
        """Give the framebuffer the ``size`` in pixels; InputError if it cannot have it."""
        check_size(size)
        context.resize(size)
        self.size = size

    def bind(self) -> None:
        """Draw here from now on: nothing else can be bound."""

    def read(self) -> np.ndarray:
        """Return the picture, uint8 (h, w, 3), top row first: a new array."""
        return read_pixels(self.size)

    def release(self) -> None:
        """Nothing was made in OpenGL."""


Target = Framebuffer | DefaultFramebuffer


def still_target(context: Context, size: tuple[int, int], samples: int) -> Target:
    """Return what to draw a still of ``size`` in: with framebuffer objects or without."""
    if possible("stills in framebuffer objects"):
        return Framebuffer(size, samples)
    if samples:
        possible("antialiasing")
    return DefaultFramebuffer(context, size)


def check_size(size: tuple[int, int], most: int = sys.maxsize) -> None:
    """Raise InputError unless OpenGL can draw pictures of a size, with sides of ``most`` pixels."""
    most = min(most, *(int(side) for side in gl.glGetIntegerv(gl.GL_MAX_VIEWPORT_DIMS)))
    if not all(0 < side <= most for side in size):
        text = f"{size[0]}x{size[1]}"
        raise InputError(
            "size {text}: expected from 1x1 to {most}x{most} on this OpenGL", text=text, most=most
        )


def read_pixels(size: tuple[int, int], scratch: np.ndarray | None = None) -> np.ndarray:
    """Read the bound framebuffer, uint8 (h, w, 3), top row first."""
    width, height = size
    pixels = np.empty((height, width, 3), np.uint8) if scratch is None else scratch
    gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
    gl.glReadPixels(0, 0, width, height, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, pixels)
    gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 4)
    return np.ascontiguousarray(pixels[::-1])
