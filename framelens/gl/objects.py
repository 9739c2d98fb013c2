"""The objects of a context: deleted when another program is to find it as if it were new."""

import ctypes

from framelens.gl.raw import raw, raw_function
from framelens.gl.seam import gl

NAMES = 4096  # chosen: names that are looked at; programs count their objects from 1
LEVELS = 15  # of a texture of 16384 texels
KINDS = ("Texture", "Buffer", "Framebuffer", "Renderbuffer")


def forget_objects() -> None:
    """Delete the objects that a program has left in the current context.

    Nothing may be bound but the textures 0; these are emptied, and get their initial parameters.
    """
    for name in range(1, NAMES):
        if raw.glIsList(name):
            raw.glDeleteLists(name, 1)
    for kind in KINDS:
        is_one, delete = raw_function(f"glIs{kind}"), raw_function(f"glDelete{kind}s")
        for name in range(1, NAMES):
            if is_one(name):
                delete(1, (ctypes.c_uint * 1)(name))

    for level in range(LEVELS):
        image = gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None
        raw.glTexImage1D(gl.GL_TEXTURE_1D, level, gl.GL_RGBA, 0, 0, *image)
        raw.glTexImage2D(gl.GL_TEXTURE_2D, level, gl.GL_RGBA, 0, 0, 0, *image)

    for target in (gl.GL_TEXTURE_1D, gl.GL_TEXTURE_2D):
        for name, value in (
            (gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST_MIPMAP_LINEAR),
            (gl.GL_TEXTURE_MAG_FILTER, gl.GL_LINEAR),
            (gl.GL_TEXTURE_WRAP_S, gl.GL_REPEAT),
            (gl.GL_TEXTURE_WRAP_T, gl.GL_REPEAT),
            (gl.GL_GENERATE_MIPMAP, gl.GL_FALSE),
            (gl.GL_TEXTURE_BASE_LEVEL, 0),
            (gl.GL_TEXTURE_MAX_LEVEL, 1000),
        ):
            raw.glTexParameteri(target, name, value)
