"""OpenGL's own functions, past the seam: never recorded, never checked, arguments not converted.

Whoever reads or restores the state around a frame needs them. A query costs a third of what it
costs through PyOpenGL, it never appears in a recording, and it does not fetch the error that the
program itself may ask for next. And a vertex array can be pointed at an address again without
PyOpenGL letting go of the memory that it keeps for that array.

Everything that draws goes through :data:`framelens.gl.seam.gl`.
"""

import ctypes
from collections.abc import Callable
from importlib import import_module
from typing import Any

from framelens.gl.redirected import redirected_raw

VERSIONS = ("1_0", "1_1", "1_2", "1_3", "1_4", "1_5", "2_0", "2_1", "3_0")


class Raw:
    """OpenGL's functions as attributes, looked up at the first use, when a platform is chosen.

    Arguments are Python numbers for numbers, and ctypes arrays, addresses or None for pointers.
    """

    def __getattr__(self, name: str) -> object:
        if not name.startswith("gl"):
            raise AttributeError(name)
        from OpenGL.platform import PLATFORM

        known = _declared(name)
        try:
            address = ctypes.cast(getattr(PLATFORM.GL, name), ctypes.c_void_p).value
        except AttributeError:
            address = PLATFORM.getExtensionProcedure(name.encode())
        result, *arguments = (_plain(kind) for kind in (known.restype, *known.argtypes))
        function = PLATFORM.DEFAULT_FUNCTION_TYPE(result, *arguments)(address)
        function = redirected_raw(name, function)
        self.__dict__[name] = function
        return function


def _plain(kind: Any) -> object:
    """Return the C type of a declared one: itself for numbers and None, else an address.

    How an array is declared differs between the versions of PyOpenGL, and between PyOpenGL with
    and without its accelerator: as an object, or as a type derived from a pointer.
    """
    if kind is None:
        return None
    simple = isinstance(kind, type) and issubclass(kind, ctypes._SimpleCData)
    pointer = simple and issubclass(kind, (ctypes.c_void_p, ctypes.c_char_p))
    return kind if simple and not pointer else ctypes.c_void_p


def _declared(name: str) -> Any:
    """Return PyOpenGL's declaration of a function; AttributeError for an unknown one."""
    for version in VERSIONS:
        module = import_module(f"OpenGL.raw.GL.VERSION.GL_{version}")
        if hasattr(module, name):
            return getattr(module, name)
    raise AttributeError(name)


raw: Any = Raw()


def end_primitive() -> None:
    """End a glBegin whose glEnd will not come through PyOpenGL, and drop the error if none is open.

    Between the two PyOpenGL does not ask for errors: without being told, it never would again.
    """
    from OpenGL.raw.GL import _errors

    raw.glEnd()
    raw.glGetError()
    if _errors._error_checker:
        _errors._error_checker.onEnd()


def raw_function(name: str) -> Callable[..., Any]:
    """Return a function whose name is data; AttributeError if there is none of this name."""
    return getattr(raw, name)  # type: ignore[no-any-return]
