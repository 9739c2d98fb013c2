"""The current OpenGL's version, extensions, texture units, and widths of lines and points.

The requirements of each effect are in features.py.

Mesa hides what it has by MESA_EXTENSION_OVERRIDE="-GL_ARB_multitexture ..." and
MESA_GL_VERSION_OVERRIDE=1.3COMPAT, which is how one sees what an older OpenGL would show.
"""

import re
import sys
from collections.abc import Iterable
from typing import NamedTuple

from framelens.base.errors import NoOpenGLError
from framelens.base.packages import speaker
from framelens.gl.named import gl_constant
from framelens.gl.seam import gl, unnoted


class Need(NamedTuple):
    """A requirement: in OpenGL since ``version``, before that by one of ``extensions``."""

    version: tuple[int, int] | None
    extensions: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The need in words."""
        core = ["OpenGL {}.{}".format(*self.version)] if self.version else []
        return " or ".join([*core, *self.extensions])


MULTITEXTURE = Need((1, 3), ("GL_ARB_multitexture",))
MULTISAMPLE = Need((1, 3), ("GL_ARB_multisample",))


def version() -> tuple[int, int]:
    """Return the version of the current OpenGL; NoOpenGLError if it is none, as OpenGL ES has."""
    return _numbers(_strings()[0])


def _numbers(text: str) -> tuple[int, int]:
    """Return the two numbers that a version begins with; NoOpenGLError if it does not."""
    numbers = re.match(r"(\d+)\.(\d+)", text)
    if numbers is None:
        raise NoOpenGLError(
            "this driver's version is {text!r}: expected OpenGL, as in '2.1'", text=text
        )
    return int(numbers[1]), int(numbers[2])


def profile_mask() -> int:
    """Return GL_CONTEXT_PROFILE_MASK; 0 before OpenGL 3.2, which does not know it.

    Asked of the context itself, whose core profile has no GL_EXTENSIONS.
    """
    text = gl.glGetString(gl.GL_VERSION) or b""
    if _numbers(text.decode(errors="replace")) < (3, 2):
        return 0
    return int(gl.glGetIntegerv(gl.GL_CONTEXT_PROFILE_MASK))


def extensions() -> frozenset[str]:
    """Return the names of the current OpenGL's extensions."""
    return _strings()[1]


def current_context() -> int:
    """Return a number for the current context; a later one may have the number of a former."""
    from OpenGL import contextdata  # which chooses the platform: after the context has

    handle = contextdata.getContext()
    return int(getattr(handle, "value", handle) or 0)


_known: dict[int, tuple[str, frozenset[str]]] = {}
_units: dict[int, int] = {}


def _strings() -> tuple[str, frozenset[str]]:
    """Return the version and the extensions, which a context is asked for once.

    They belong to no element, so that no trace shows the question.
    """
    context = current_context()
    if context not in _known:
        with unnoted():
            # A driver may answer with nothing, as without a context or about a core profile.
            strings = gl.glGetString(gl.GL_VERSION), gl.glGetString(gl.GL_EXTENSIONS)
        text, names = (string or b"" for string in strings)
        _known[context] = text.decode(), frozenset(names.decode().split())
    return _known[context]


def has(need: Need) -> bool:
    """Return whether the current OpenGL has what is needed."""
    if need.version is not None and version() >= need.version:
        return True
    return not extensions().isdisjoint(need.extensions)


def first_missing(needs: Iterable[Need]) -> Need | None:
    """Return the first need that the current OpenGL does not fulfil."""
    return next((need for need in needs if not has(need)), None)


def texture_units() -> int:
    """Return how many texture units the current OpenGL has: 1 before OpenGL 1.3."""
    context = current_context()
    if context not in _units:
        with unnoted():
            asked = gl.glGetIntegerv(gl.GL_MAX_TEXTURE_UNITS) if has(MULTITEXTURE) else 1
        _units[context] = int(asked)
    return _units[context]


def antialiased() -> bool:
    """Return whether what is drawn to now has several samples a pixel."""
    return has(MULTISAMPLE) and bool(gl.glGetIntegerv(gl.GL_SAMPLE_BUFFERS))


def widest_line() -> float:
    """Return the greatest width in pixels that the current OpenGL draws lines in."""
    name = "GL_ALIASED_LINE_WIDTH_RANGE" if version() >= (1, 2) else "GL_LINE_WIDTH_RANGE"
    return _greatest(name)


def largest_point() -> float:
    """Return the greatest size in pixels that the current OpenGL draws points in."""
    name = "GL_ALIASED_POINT_SIZE_RANGE" if version() >= (1, 2) else "GL_POINT_SIZE_RANGE"
    return _greatest(name)


def _greatest(name: str) -> float:
    with unnoted():
        return float(gl.glGetFloatv(gl_constant(name))[1])


def has_stencil(what: str) -> bool:
    """Return whether there is a stencil buffer; if not, say once that ``what`` is off."""
    found = int(gl.glGetIntegerv(gl.GL_STENCIL_BITS)) > 0
    if not found:
        tell(f"{what}: off, for there is no stencil buffer")
    return found


def largest_texture() -> int:
    """Return the largest side in texels that a 2D texture can have."""
    return int(gl.glGetIntegerv(gl.GL_MAX_TEXTURE_SIZE))


_told: set[str] = set()


def tell(line: str) -> None:
    """Print a line on stderr, once."""
    if line not in _told:
        _told.add(line)
        print(f"{speaker()}: {line}", file=sys.stderr)
