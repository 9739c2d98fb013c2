"""OpenGL's own functions and enumerants, whatever stands in their place in PyOpenGL's modules."""

import importlib
import sys
from collections.abc import Callable
from typing import Any

from framelens.gl.redirected import redirected

# Extensions that OpenGL.GL does not offer: their functions and enumerants are found by name, too.
EXTENSIONS = ("OpenGL.GL.NV.alpha_to_coverage_dither_control",)

patches: list[dict[str, Callable[..., object]]] = []
"""The functions that foreign.py has replaced, by name: the last replacement last."""


def original(name: str) -> object:
    """Return OpenGL's own function or enumerant of a name, whatever has taken its place.

    Functions of GLU, GLUT and GLE that foreign.py replaced are found, too.
    """
    import OpenGL.GL

    if hasattr(OpenGL.GL, name):
        return redirected(name, unwrapped(getattr(OpenGL.GL, name)))
    for names in reversed(patches):
        if name in names:
            return names[name]
    for package in ("GLUT", "GLU", "GLE"):
        module = sys.modules.get(f"OpenGL.{package}")
        if hasattr(module, name):
            return unwrapped(getattr(module, name))
    for package in EXTENSIONS if name.endswith("NV") else ():
        module = importlib.import_module(package)
        if hasattr(module, name):
            return unwrapped(getattr(module, name))
    raise AttributeError(f"no function {name} in OpenGL, GLU or GLUT")


def unwrapped(value: object) -> Any:
    """Return what a wrapper, or a wrapper of wrappers, stands for."""
    while hasattr(value, "__wrapped__"):
        value = value.__wrapped__
    return value
