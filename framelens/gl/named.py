"""Constants and functions of OpenGL and GLFW by their names, where these are data."""

from collections.abc import Callable
from typing import Any

from framelens.gl.seam import gl


def gl_constant(name: str) -> int:
    """Return a constant such as GL_FOG; AttributeError if there is none of this name."""
    return getattr(gl, name)  # type: ignore[no-any-return]


def texture_unit(number: int) -> int:
    """Return the constant of a texture unit, counted from 0."""
    return gl_constant(f"GL_TEXTURE{number}")


def gl_function(name: str) -> Callable[..., Any]:
    """Return a function such as glFogf; AttributeError if there is none of this name."""
    return getattr(gl, name)  # type: ignore[no-any-return]


def glfw_constant(glfw: Any, name: str) -> int:
    """Return a constant of GLFW, such as KEY_A; AttributeError if there is none of this name."""
    return getattr(glfw, name)  # type: ignore[no-any-return]
