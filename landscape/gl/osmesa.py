"""OSMesa where others made its context: GLFW only forgets a context that is no longer current."""


def leave() -> None:
    """Have no context of OSMesa current; PyOpenGL must be bound to it."""
    from OpenGL import osmesa
    from OpenGL.GL import GL_UNSIGNED_BYTE

    osmesa.OSMesaMakeCurrent(None, None, GL_UNSIGNED_BYTE, 0, 0)
