"""OpenGL's constants and functions by their names, where these are data and not written down."""

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
