"""What the current OpenGL has: its version and extensions, and what an effect needs of them.

Mesa hides what it has by MESA_EXTENSION_OVERRIDE="-GL_ARB_multitexture ..." and
MESA_GL_VERSION_OVERRIDE=1.3COMPAT, which is how one sees what an older OpenGL would show.
"""

import re
import sys
from collections.abc import Iterable
from typing import NamedTuple

from landscape.gl.calls import gl


class Need(NamedTuple):
    """What an effect needs: in OpenGL since ``version``, before that by one of ``extensions``."""

    version: tuple[int, int]
    extensions: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The need in words."""
        return " or ".join([f"OpenGL {self.version[0]}.{self.version[1]}", *self.extensions])


def version() -> tuple[int, int]:
    """Return the version of the current OpenGL."""
    found = re.match(rb"(\d+)\.(\d+)", gl.glGetString(gl.GL_VERSION))
    assert found is not None
    return int(found[1]), int(found[2])


def extensions() -> frozenset[str]:
    """Return the names of the current OpenGL's extensions."""
    return frozenset(gl.glGetString(gl.GL_EXTENSIONS).decode("ascii").split())


def has(need: Need) -> bool:
    """Return whether the current OpenGL has what is needed."""
    return version() >= need.version or not extensions().isdisjoint(need.extensions)


def first_missing(needs: Iterable[Need]) -> Need | None:
    """Return the first need that the current OpenGL does not fulfil."""
    return next((need for need in needs if not has(need)), None)


_told: set[str] = set()


def tell_off(what: str, need: Need) -> None:
    """Say, once for each effect, in one line on stderr, that it is off and why."""
    line = f"landscape: {what}: off, for this OpenGL has no {need.text}"
    if line not in _told:
        _told.add(line)
        print(line, file=sys.stderr)
