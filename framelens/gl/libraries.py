"""System libraries, loaded as the system's own loader finds them.

ctypes.util.find_library asks ldconfig and a compiler. Neither knows a library that is found only by
LD_LIBRARY_PATH or an RPATH, as on NixOS, in Guix and in Conda. So a library is first looked for
under the file names that PyOpenGL tries, in PyOpenGL's order: both then have the same file.
"""

import ctypes
import ctypes.util
import sys
from collections.abc import Mapping, Sequence
from types import SimpleNamespace
from typing import Any

from framelens.base.errors import NoOpenGLError
from framelens.gl import advice

Signature = tuple[Any, Sequence[Any]]
"""The type of a function's result, and those of its arguments."""

# Names with more than one digit, which PyOpenGL does not try: Debian 12 has freeglut as this.
MORE_NAMES = {"glut": ("libglut.so.3.12",)}


def file_names(library: str) -> list[str]:
    """Return the file names of a library on Linux, in the order in which they are tried."""
    name = f"lib{library}.so"
    return [name, *(f"{name}.{n}" for n in reversed(range(10))), *MORE_NAMES.get(library, ())]


def load(library: str) -> ctypes.CDLL:
    """Load a system library such as "EGL"; OSError says why it cannot be loaded."""
    reason = "none found"
    for name in file_names(library) if sys.platform == "linux" else ():
        try:
            return ctypes.CDLL(name)
        except OSError as error:
            # Of the names most do not exist; a library that does not load has a reason of its own.
            if not (name in str(error) and "No such file" in str(error)):
                reason = str(error)
    path = ctypes.util.find_library(library)
    if path is None:
        raise OSError(reason)
    try:
        return ctypes.CDLL(path)
    except OSError as error:
        # Windows does not say which file it is that does not load.
        raise OSError(error if path in str(error) else f"{path}: {error}") from None


def require(library: str, backend: str) -> ctypes.CDLL:
    """Load what a backend needs; NoOpenGLError with the package to install if that fails."""
    try:
        return load(library)
    except OSError as error:
        wanted = advice.install(backend, str(error))
        raise NoOpenGLError(
            "no {library} library ({error}): {wanted}", library=library, error=error, wanted=wanted
        ) from None


def functions(
    library: ctypes.CDLL, name: str, signatures: Mapping[str, Signature], backend: str
) -> object:
    """Return functions of a library, declared; NoOpenGLError if it lacks one of them."""
    declared = SimpleNamespace()
    for function, (result, arguments) in signatures.items():
        try:
            found = library[function]
        except AttributeError:
            wanted = advice.install(backend)
            raise NoOpenGLError(
                "the {name} library has no {function}: {wanted}",
                name=name,
                function=function,
                wanted=wanted,
            ) from None
        found.restype, found.argtypes = result, arguments
        setattr(declared, function, found)
    return declared
