"""A framebuffer object in the place of a hidden window's own framebuffer.

The pixels of a hidden window are undefined: OpenGL may leave out pixels that no screen owns, and
NVIDIA's driver and macOS do. So a program with a hidden window draws into a framebuffer object
of the window's size, and does not notice: redirected.py has it stand for framebuffer 0.

Two things differ, as they do with OSMesa or EGL: back and front are one image, and there is no
accumulation buffer.
"""

import ctypes

from framelens.gl.raw import raw, raw_function
from framelens.gl.redirected import BINDINGS, DOUBLEBUFFER, DRAW_BUFFER, redirection

FRAMEBUFFER, RENDERBUFFER = 0x8D40, 0x8D41
COLOR, DEPTH_STENCIL = 0x8CE0, 0x821A  # GL_COLOR_ATTACHMENT0, GL_DEPTH_STENCIL_ATTACHMENT
RGBA8, DEPTH24_STENCIL8 = 0x8058, 0x88F0
VERSION, EXTENSIONS = 0x1F02, 0x1F03
NEED = b"GL_ARB_framebuffer_object"  # in OpenGL since 3.0
NONE = 0
FRONT = 0x0404
BACK = 0x0405
# Of a window: front left, back left, front, back, left, front and back.
SIDES = {0x0400, 0x0402, FRONT, BACK, 0x0406, 0x0408}


class WindowFramebuffer:
    """The framebuffer object, of one program at a time."""

    def __init__(self, size: tuple[int, int], double_buffered: bool) -> None:
        """Create it in the current context, ``size`` in pixels, and bind it for framebuffer 0."""
        self.name, self._color, self._depth = (
            self._generated(kind) for kind in ("Framebuffers", "Renderbuffers", "Renderbuffers")
        )
        self.double_buffered = double_buffered
        self._sides = dict.fromkeys(BINDINGS, BACK if double_buffered else FRONT)
        raw.glBindFramebuffer(FRAMEBUFFER, self.name)
        self.resize(size)
        places = ((COLOR, self._color), (DEPTH_STENCIL, self._depth))
        for place, buffer in places:
            raw.glFramebufferRenderbuffer(FRAMEBUFFER, place, RENDERBUFFER, buffer)
        # A new context has the size of its window in both; the window's own size may be another.
        raw.glViewport(0, 0, *size)
        raw.glScissor(0, 0, *size)
        redirection.substitute = self

    def _generated(self, kind: str) -> int:
        number = ctypes.c_uint32()
        raw_function(f"glGen{kind}")(1, ctypes.byref(number))
        return number.value

    @staticmethod
    def possible() -> bool:
        """Return whether the current context can have one."""
        version = ctypes.string_at(raw.glGetString(VERSION))
        if int(version.split(b".")[0]) >= 3:
            return True
        return NEED in ctypes.string_at(raw.glGetString(EXTENSIONS)).split()

    def resize(self, size: tuple[int, int]) -> None:
        """Give it another size, in pixels; what it holds is undefined then, as in a window."""
        for buffer, kind in ((self._color, RGBA8), (self._depth, DEPTH24_STENCIL8)):
            raw.glBindRenderbuffer(RENDERBUFFER, buffer)
            raw.glRenderbufferStorage(RENDERBUFFER, kind, *size)
        raw.glBindRenderbuffer(RENDERBUFFER, 0)

    @staticmethod
    def leave() -> None:
        """Have none stand for framebuffer 0; the objects go with the context."""
        redirection.substitute = None

    def bound(self, buffer: int) -> bool:
        """Return whether it is bound, where DRAW_BUFFER or READ_BUFFER belongs to."""
        number = ctypes.c_int32()
        raw.glGetIntegerv(BINDINGS[buffer], ctypes.byref(number))
        return number.value == 0

    def choose(self, buffer: int, side: int) -> int:
        """Note the side of the window that is chosen; return the attachment that stands for it."""
        if side not in (*SIDES, NONE) or not self.bound(buffer):
            return side
        self._sides[buffer] = side
        return COLOR if side else NONE

    def answer(self, question: int, value: int) -> int:
        """Return what the window would answer where OpenGL answers ``value``."""
        if question in BINDINGS.values():
            return 0 if value == self.name else value
        if question == DOUBLEBUFFER:
            return int(self.double_buffered) if self.bound(DRAW_BUFFER) else value
        return self._sides[question] if value == COLOR and self.bound(question) else value
