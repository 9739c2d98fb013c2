"""A lens on one frame of any PyOpenGL program: its calls, its state, its pixels, and why.

framelens pixel program.py 400,300
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from framelens.report.look import look

__version__ = "0.2.0"
__all__ = ["look"]


def __getattr__(name: str) -> Any:
    # Imported when asked for: the command line needs little of it.
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    value = getattr(import_module("framelens.report.look"), name)
    globals()[name] = value
    return value
