"""A natural landscape in classic fixed-function OpenGL: the 2006 report brought back.

>>> import landscape
>>> image = landscape.render("fig35e", size=(1280, 720))
"""

from __future__ import annotations

from framelens.base import packages

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from framelens.base.errors import InputError, NoOpenGLError
    from landscape.notebook.cells import lesson, show
    from landscape.notebook.checking import check
    from landscape.notebook.magics import load_ipython_extension
    from landscape.offscreen import Offscreen, render

__version__ = "0.2.0"
__all__ = [
    "InputError",
    "NoOpenGLError",
    "Offscreen",
    "check",
    "lesson",
    "load_ipython_extension",
    "render",
    "show",
]

packages.add("landscape", __file__, unseen=("gl",), version=__version__)

# Imported when asked for: the command line, the lessons and the tests need only some of it.
_HOMES = {
    "InputError": "framelens.base.errors",
    "NoOpenGLError": "framelens.base.errors",
    "Offscreen": "landscape.offscreen",
    "check": "landscape.notebook.checking",
    "lesson": "landscape.notebook.cells",
    "load_ipython_extension": "landscape.notebook.magics",
    "render": "landscape.offscreen",
    "show": "landscape.notebook.cells",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    value = getattr(import_module(_HOMES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOMES])
