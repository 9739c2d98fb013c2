"""What the current OpenGL has: its version and extensions, and what an effect needs of them.

Mesa hides what it has by MESA_EXTENSION_OVERRIDE="-GL_ARB_multitexture ..." and
MESA_GL_VERSION_OVERRIDE=1.3COMPAT, which is how one sees what an older OpenGL would show.
"""

import re
import sys
from collections.abc import Iterable
from typing import NamedTuple

from landscape.gl.calls import gl, unnoted


class Need(NamedTuple):
    """What an effect needs: in OpenGL since ``version``, without that by one of ``extensions``."""

    version: tuple[int, int] | None
    extensions: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The need in words."""
        core = ["OpenGL {}.{}".format(*self.version)] if self.version else []
        return " or ".join([*core, *self.extensions])


# Needs of more than one effect.
MULTITEXTURE = Need((1, 3), ("GL_ARB_multitexture",))
COMBINE = Need((1, 3), ("GL_ARB_texture_env_combine", "GL_EXT_texture_env_combine"))
CROSSBAR = Need((1, 4), ("GL_ARB_texture_env_crossbar",))
FRAMEBUFFERS = Need((3, 0), ("GL_ARB_framebuffer_object", "GL_EXT_framebuffer_object"))


def version() -> tuple[int, int]:
    """Return the version of the current OpenGL."""
    found = re.match(r"(\d+)\.(\d+)", _strings()[0])
    assert found is not None
    return int(found[1]), int(found[2])


def profile_mask() -> int:
    """Return GL_CONTEXT_PROFILE_MASK; 0 before OpenGL 3.2, which does not know it.

    Asked of the context itself, whose core profile has no GL_EXTENSIONS.
    """
    version = gl.glGetString(gl.GL_VERSION).split()[0].split(b".")
    if [int(part) for part in version[:2]] < [3, 2]:
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


def _strings() -> tuple[str, frozenset[str]]:
    """Return the version and the extensions, which a context is asked for once.

    They belong to no element, so that no trace shows the question.
    """
    context = current_context()
    if context not in _known:
        with unnoted():
            text, names = (gl.glGetString(each) for each in (gl.GL_VERSION, gl.GL_EXTENSIONS))
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
    if not has(MULTITEXTURE):
        return 1
    return int(gl.glGetIntegerv(gl.GL_MAX_TEXTURE_UNITS))


def enough_units(what: str, count: int) -> bool:
    """Return whether there are ``count`` texture units; if not, say once that ``what`` is off."""
    found = texture_units()
    if found < count:
        tell(f"landscape: {what}: off, for it needs {count} texture units of {found}")
    return found >= count


def possible(what: str, needs: Iterable[Need], units: int = 1) -> bool:
    """Return whether there is all that ``what`` needs; if not, say once that it is off."""
    if need := first_missing(needs):
        tell_off(what, need)
        return False
    return enough_units(what, units)


def has_stencil(what: str) -> bool:
    """Return whether there is a stencil buffer; if not, say once that ``what`` is off."""
    found = int(gl.glGetIntegerv(gl.GL_STENCIL_BITS)) > 0
    if not found:
        tell(f"landscape: {what}: off, for there is no stencil buffer")
    return found


def largest_texture() -> int:
    """Return the largest side in texels that a 2D texture can have."""
    return int(gl.glGetIntegerv(gl.GL_MAX_TEXTURE_SIZE))


_told: set[str] = set()


def tell_off(what: str, need: Need) -> None:
    """Say, once for each effect, in one line on stderr, that it is off and why."""
    tell(f"landscape: {what}: off, for this OpenGL has no {need.text}")


def tell(line: str) -> None:
    """Print a line on stderr, once."""
    if line not in _told:
        _told.add(line)
        print(line, file=sys.stderr)
