"""Who draws: the versions of all that a picture's bytes depend on besides what it shows.

Two computers draw the same picture where these are the same; a film's parts are named by them, and
a worker on another computer is refused if it differs.
"""

import functools
import zlib
from dataclasses import asdict, dataclass, fields

import numpy as np

from framelens.base import packages
from framelens.base.errors import NoOpenGLError
from landscape.files.cache import code, code_below
from landscape.offscreen import Offscreen

NONE = "none"


@dataclass(frozen=True)
class Maker:
    """A computer's identity as a renderer: versions, OpenGL, and a checksum of its arithmetic."""

    landscape: str
    numpy: str
    arithmetic: str
    encoder: str
    renderer: str

    def differences(self, other: "Maker") -> str:
        """Return in which words another differs: "numpy 2.1.0 (expected 2.3.5)"; "" if nowhere.

        What is not there here, anything may be there.
        """
        found = []
        for field in fields(self):
            mine, theirs = getattr(self, field.name), getattr(other, field.name)
            if mine not in (theirs, NONE):
                found.append(f"{field.name} {theirs} (expected {mine})")
        return ", ".join(found)

    @property
    def values(self) -> dict[str, str]:
        """The values by their names."""
        return asdict(self)


@functools.lru_cache(maxsize=4)
def maker(backend: str = "") -> Maker:
    """Return who draws in this process by an OpenGL backend; without one, no OpenGL is opened.

    A task for any executor.
    """
    return Maker(version(), np.__version__, arithmetic(), encoder(), renderer(backend))


@functools.lru_cache(maxsize=1)
def version() -> str:
    """Return the version, with a hash of the code: a checkout may have changed since."""
    hashed = zlib.crc32(code() + code_below(packages.FRAMELENS.folder))
    return f"{packages.PACKAGES[-1].version}+{hashed:08x}"


def arithmetic() -> str:
    """Return a checksum of functions of which numpy has other forms for other processors."""
    values = np.linspace(-3.0, 3.0, 1009)
    results = [
        function(values.astype(kind))
        for kind in (np.float32, np.float64)
        for function in (np.sin, np.cos, np.exp, np.tanh, np.arctan)
    ]
    results += [np.abs(values) ** 0.7, np.abs((values + 1j).astype(np.complex64))]
    return f"{zlib.crc32(b''.join(each.tobytes() for each in results)):08x}"


def encoder() -> str:
    """Return the versions of what encodes films, if it is installed."""
    try:
        import av
    except ImportError:
        return NONE
    numbers = (".".join(map(str, each)) for each in av.library_versions.values())
    return " ".join((av.__version__, *numbers))


def renderer(backend: str) -> str:
    """Return the OpenGL renderer and version; "none" without one, or if no backend is asked for."""
    if not backend:
        return NONE
    try:
        with Offscreen((16, 16), backend=backend, samples=0) as offscreen:
            return offscreen.renderer
    except NoOpenGLError:
        return NONE
