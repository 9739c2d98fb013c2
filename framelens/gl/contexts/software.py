"""Software rendering asked for, and checked: the choice `--backend software`.

Where the renderer cannot be chosen with the context, Mesa is asked by its environment variables,
which it reads when it draws for the first time.
"""

import ctypes
import os
import sys
from typing import Protocol

from framelens.base.errors import NoOpenGLError
from framelens.gl import advice
from framelens.gl.raw import raw

RENDERER = 0x1F01  # GL_RENDERER
# Parts of that name, in small letters: Mesa's rasterizers, Apple's, SwiftShader, Microsoft's.
NAMES = ("llvmpipe", "softpipe", "swrast", "software", "swiftshader", "gdi generic")


def ask_for_software() -> None:
    """Have Mesa draw by software in this process, if it has not drawn by anything yet."""
    os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"
    if sys.platform == "win32":
        os.environ["GALLIUM_DRIVER"] = "llvmpipe"  # else Mesa may draw by Direct3D


class _Context(Protocol):
    def release(self) -> None: ...


def check_renderer() -> None:
    """Raise NoOpenGLError if the current context draws by something else than software."""
    address = raw.glGetString(RENDERER)
    name = ctypes.string_at(address).decode(errors="replace") if address else ""
    if not any(part in name.lower() for part in NAMES):
        raise NoOpenGLError(advice.software(name))


def check_software(context: _Context) -> None:
    """Do the same for a new context, which is released then."""
    try:
        check_renderer()
    except NoOpenGLError:
        context.release()
        raise
