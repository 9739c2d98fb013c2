"""The two errors that users see as one line."""


class InputError(ValueError):
    """Bad input: one line that names the file or the key and what was expected (exit status 2)."""


class NoOpenGLError(RuntimeError):
    """No usable OpenGL: one line that names the package to install (exit status 3)."""
