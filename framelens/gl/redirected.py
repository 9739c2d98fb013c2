"""Functions of OpenGL that name a framebuffer or its buffers, for a window that has a substitute.

A program with a hidden window draws into a framebuffer object in the place of the window's own
(window_framebuffer.py), and does not notice: framebuffer 0 is this one, GL_BACK and GL_FRONT are
its colours, and questions about them are answered as the window would. :func:`redirected` wraps the
few functions that this concerns. The program calls them so, and so do the tools that
look at it, by the seam and by raw.py.
"""

import ctypes
from collections.abc import Callable
from typing import Any, Protocol

Function = Callable[..., Any]

DRAW_BUFFER = 0x0C01
READ_BUFFER = 0x0C02
DOUBLEBUFFER = 0x0C32
# GL_DRAW_FRAMEBUFFER_BINDING and GL_READ_FRAMEBUFFER_BINDING, of each of these buffers.
BINDINGS = {DRAW_BUFFER: 0x8CA6, READ_BUFFER: 0x8CAA}
ASKED = {DRAW_BUFFER, READ_BUFFER, DOUBLEBUFFER, *BINDINGS.values()}


class Substitute(Protocol):
    """The framebuffer object in place of a window's framebuffer; see WindowFramebuffer."""

    name: int

    def choose(self, buffer: int, side: int) -> int:
        """Note the side of the window that is chosen; return the attachment that stands for it."""

    def answer(self, question: int, value: int) -> int:
        """Return what the window would answer where OpenGL answers ``value``."""


class Redirection:
    """Where framebuffer 0 leads: to ``substitute``, or to the window's own if it is None."""

    substitute: Substitute | None = None


redirection = Redirection()


def redirected(name: str, function: Function) -> Function:
    """Return OpenGL's function of a name; framebuffer 0 is the substitute, if any."""
    if name in ("glBindFramebuffer", "glBindFramebufferEXT"):
        return _binding(function)
    if name in ("glDrawBuffer", "glReadBuffer"):
        return _choosing(function, DRAW_BUFFER if name == "glDrawBuffer" else READ_BUFFER)
    if name in ("glGetIntegerv", "glGetBooleanv"):
        return _answering(function)
    return function


def _binding(function: Function) -> Function:
    def bind(target: int, framebuffer: int) -> object:
        now = redirection.substitute
        return function(target, framebuffer or (now.name if now else 0))

    return bind


def _choosing(function: Function, buffer: int) -> Function:
    def choose(mode: int) -> object:
        now = redirection.substitute
        return function(now.choose(buffer, int(mode)) if now else mode)

    return choose


def _answering(function: Function) -> Function:
    def ask(pname: int, *params: Any) -> object:
        result = function(pname, *params)
        now = redirection.substitute
        if now is None or int(pname) not in ASKED:
            return result
        if not params:
            return now.answer(int(pname), int(result))
        params[0][0] = now.answer(int(pname), int(params[0][0]))
        return result

    return ask


def redirected_raw(name: str, function: Function) -> Function:
    """Return the same for a function of raw.py, which takes addresses for arrays."""
    if name != "glGetIntegerv":
        return redirected(name, function)

    def ask(pname: int, params: Any) -> None:
        function(pname, params)
        now = redirection.substitute
        if now is not None and pname in ASKED:
            place = ctypes.cast(params, ctypes.POINTER(ctypes.c_int32))
            place[0] = now.answer(pname, place[0])

    return ask
