"""The state that elements share, for the tests' state check: all of it but what no one relies on.

Left out is what OpenGL leaves undefined after a draw call (the current normal and the texture
coordinates, which each element that reads them sends), where client arrays lie and how they are
laid out, which is said before each use, and so is the alignment of images in memory.
"""

import re
from functools import cache
from typing import Any

from framelens.gl.seam import gl
from framelens.state.state import difference, read

LEFT_OUT = re.compile(
    r"GL_CURRENT_NORMAL|.*\.GL_CURRENT_TEXTURE_COORDS|GL_(UN)?PACK_ALIGNMENT"
    r"|.*_ARRAY_(SIZE|TYPE|STRIDE|POINTER|BUFFER_BINDING)"
)
changes = difference


def snapshot() -> dict[str, Any]:
    """Return the state that elements share, by name, and under "error" the pending error."""
    error = int(gl.glGetError())
    return {"error": error} | {k: v for k, v in read().items() if not _left_out(k)}


@cache
def _left_out(name: str) -> bool:
    return LEFT_OUT.fullmatch(name) is not None
