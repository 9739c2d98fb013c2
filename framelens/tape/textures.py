"""Is a texture complete, and so used? OpenGL treats one that is not as if texturing were off."""

from framelens.gl.seam import gl

MIPMAPPED = (0x2700, 0x2701, 0x2702, 0x2703)  # filters that read smaller levels


def completeness(texture: int) -> tuple[str, object, dict[str, object]] | None:
    """Return why a texture is not complete: state, value, numbers for the text; None if it is."""
    former = int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D))
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    try:
        sizes = [size_of(0)]
        if not all(sizes[0]):
            return "GL_TEXTURE_BINDING_2D", "empty", {"level": 0}
        wanted = int(gl.glGetTexParameteriv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER))
        if wanted not in MIPMAPPED:
            return None
        most = int(gl.glGetTexParameteriv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAX_LEVEL))
        width, height = sizes[0]
        level = 0
        while (width > 1 or height > 1) and level < most:
            width = max(width // 2, 1)
            height = max(height // 2, 1)
            level = level + 1
            if size_of(level) != (width, height):
                return (
                    "GL_TEXTURE_MIN_FILTER",
                    MIN_FILTERS[wanted],
                    {"level": level, "width": width, "height": height},
                )

        return None
    finally:
        gl.glBindTexture(gl.GL_TEXTURE_2D, former)


MIN_FILTERS = {
    0x2700: "GL_NEAREST_MIPMAP_NEAREST",
    0x2701: "GL_LINEAR_MIPMAP_NEAREST",
    0x2702: "GL_NEAREST_MIPMAP_LINEAR",
    0x2703: "GL_LINEAR_MIPMAP_LINEAR",
}


def size_of(level: int) -> tuple[int, int]:
    """Return width and height of a level of the bound texture; 0, 0 if there is none."""
    width, height = (
        int(gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, level, name))
        for name in (gl.GL_TEXTURE_WIDTH, gl.GL_TEXTURE_HEIGHT)
    )
    return width, height
