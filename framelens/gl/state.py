"""Scoped state: what a block changes is restored after it, even if it raises."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from framelens.gl import extensions
from framelens.gl.features import possible
from framelens.gl.named import gl_constant, texture_unit
from framelens.gl.seam import gl


@contextmanager
def attrib(mask: int) -> Iterator[None]:
    """Save the state groups of ``mask`` (GL_ENABLE_BIT | ...) and restore them."""
    gl.glPushAttrib(mask)
    try:
        yield
    finally:
        gl.glPopAttrib()


@contextmanager
def front_faces(only: bool = True) -> Iterator[None]:
    """Cull the block's triangles that face away from the viewer.

    On a closed mesh none of them is visible. With ``only`` false the block draws all triangles.
    """
    if only:
        gl.glEnable(gl.GL_CULL_FACE)
    try:
        yield
    finally:
        if only:
            gl.glDisable(gl.GL_CULL_FACE)


@contextmanager
def matrix() -> Iterator[None]:
    """Save the current matrix and restore it."""
    gl.glPushMatrix()
    try:
        yield
    finally:
        gl.glPopMatrix()


@contextmanager
def flat_projection(*volume: float) -> Iterator[None]:
    """Replace projection and modelview by glOrtho(``volume``) and the identity, for an overlay."""
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glPushMatrix()
    gl.glLoadIdentity()
    if volume:
        gl.glOrtho(*volume)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glPushMatrix()
    gl.glLoadIdentity()
    try:
        yield
    finally:
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glPopMatrix()
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glPopMatrix()


@contextmanager
def client_arrays(
    vertices: np.ndarray,
    normals: np.ndarray | None = None,
    colors: np.ndarray | None = None,
    coordinates: Sequence[np.ndarray] = (),
) -> Iterator[None]:
    """Enable vertex arrays of a glDrawElements: float32 (n, 3), (n, 3), (n, 3 or 4), (n, 2 or 3).

    ``coordinates`` holds one array per texture unit, from unit 0 on; those that OpenGL has no unit
    for are left out. Colours may be uint8.
    """
    kind = {"float32": gl.GL_FLOAT, "uint8": gl.GL_UNSIGNED_BYTE}
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, vertices)
    if normals is not None:
        gl.glEnableClientState(gl.GL_NORMAL_ARRAY)
        gl.glNormalPointer(gl.GL_FLOAT, 0, normals)
    if colors is not None:
        gl.glEnableClientState(gl.GL_COLOR_ARRAY)
        gl.glColorPointer(colors.shape[1], kind[str(colors.dtype)], 0, colors)
    units = extensions.texture_units()
    coordinates = coordinates[:units]
    several = units > 1  # an OpenGL that has a single one may lack the function, too
    for unit, array in enumerate(coordinates):
        if several:
            gl.glClientActiveTexture(texture_unit(unit))
        gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
        gl.glTexCoordPointer(array.shape[1], gl.GL_FLOAT, 0, array)

    try:
        yield
    finally:
        for unit in reversed(range(len(coordinates))):
            if several:
                gl.glClientActiveTexture(texture_unit(unit))
            gl.glDisableClientState(gl.GL_TEXTURE_COORD_ARRAY)
        if colors is not None:
            gl.glDisableClientState(gl.GL_COLOR_ARRAY)
        if normals is not None:
            gl.glDisableClientState(gl.GL_NORMAL_ARRAY)
        gl.glDisableClientState(gl.GL_VERTEX_ARRAY)


def use_unit(unit: int) -> None:
    """Let the next calls concern a texture unit; where there is a single one, they do already."""
    if extensions.texture_units() > 1:
        gl.glActiveTexture(texture_unit(unit))


def multiply(scale: float = 1.0) -> None:
    """Let the active unit multiply by its texture and by ``scale``, 1, 2 or 4.

    Without GL_COMBINE (OpenGL 1.3) it multiplies by the texture alone.
    """
    env, mode = gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE
    if not possible("doubled textures"):
        gl.glTexEnvi(env, mode, gl.GL_MODULATE)
    elif scale == 1.0:
        gl.glTexEnvf(env, gl.GL_RGB_SCALE, 1.0)
        gl.glTexEnvi(env, mode, gl.GL_MODULATE)
    else:
        gl.glTexEnvi(env, mode, gl.GL_COMBINE)
        gl.glTexEnvi(env, gl.GL_COMBINE_RGB, gl.GL_MODULATE)
        gl.glTexEnvf(env, gl.GL_RGB_SCALE, scale)


def glint_after_texture() -> None:
    """Let what glints be added after the texture instead of multiplied by it (OpenGL 1.2)."""
    if possible("separate glints"):
        gl.glLightModeli(gl.GL_LIGHT_MODEL_COLOR_CONTROL, gl.GL_SEPARATE_SPECULAR_COLOR)


def line_width(pixels: float) -> None:
    """Set the width of lines, from 1 on, or the greatest that OpenGL has."""
    widest = extensions.widest_line()
    if pixels > widest:
        extensions.tell(f"lines: at most {widest:g} pixels wide, as this OpenGL has them")
    gl.glLineWidth(min(max(pixels, 1.0), max(widest, 1.0)))


def point_size(pixels: float) -> None:
    """Set the size of points, from 1 on, or the greatest that OpenGL has."""
    gl.glPointSize(min(max(pixels, 1.0), max(extensions.largest_point(), 1.0)))


def combine(terms: dict[str, str]) -> None:
    """Set terms of the active unit's GL_COMBINE equation (OpenGL 1.3), names without their GL_."""
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_COMBINE)
    for name, value in terms.items():
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl_constant(f"GL_{name}"), gl_constant(f"GL_{value}"))
