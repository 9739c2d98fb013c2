"""Where the pixels of images come from, whose first row is the top one.

OpenGL takes the first row of an image for the lowest. pygame and PIL give the top row first, unless
they are told otherwise; whoever sees an image upside down must know which call gave its bytes.
"""

import functools
import hashlib
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import numpy as np

from framelens.gl.notes import caller
from framelens.gl.seam import Site

Origins = dict[bytes, tuple[str, Site]]
"""By :func:`key_of`: the call that gave the pixels, and its line."""


def key_of(data: object) -> bytes:
    """Return what tells the pixels of an image from those of others."""
    raw = data if isinstance(data, (bytes, bytearray)) else np.ascontiguousarray(data).tobytes()
    return hashlib.sha1(raw).digest()


@contextmanager
def noted() -> Iterator[Origins]:
    """Note, within the block, each image that pygame or PIL gives with its top row first.

    Only of those that are imported already.
    """
    found: Origins = {}
    with ExitStack() as stack:
        if pygame := sys.modules.get("pygame"):
            for name in ("tostring", "tobytes"):
                if hasattr(pygame.image, name):
                    new = _of_pygame(name, getattr(pygame.image, name), found)
                    stack.enter_context(_replaced(pygame.image, name, new))
        if "PIL.Image" in sys.modules:
            image = sys.modules["PIL.Image"].Image
            for name, new in _of_pil(image, found).items():
                stack.enter_context(_replaced(image, name, new))
        yield found


@contextmanager
def _replaced(owner: object, name: str, new: object) -> Iterator[None]:
    former = owner.__dict__[name]
    setattr(owner, name, new)
    try:
        yield
    finally:
        setattr(owner, name, former)


def _of_pygame(name: str, function: Callable[..., object], found: Origins) -> Callable[..., object]:
    @functools.wraps(function)
    def given(
        surface: object, format: str, flipped: bool = False, *args: object, **named: object
    ) -> object:
        data = function(surface, format, flipped, *args, **named)
        if not flipped:
            found[key_of(data)] = f"pygame.image.{name}", caller(sys._getframe(1))
        return data

    return given


def _of_pil(image: Any, found: Origins) -> dict[str, Any]:
    """Return what takes the place of an image's methods; flips are followed by an attribute."""
    new_image = image._new
    transpose = image.transpose
    tobytes = image.tobytes

    def _new(self: Any, core: object) -> object:
        derived = new_image(self, core)
        derived.rows_flipped = getattr(self, "rows_flipped", False)
        return derived

    def flip(self: object, method: Any) -> object:
        derived = transpose(self, method)
        # FLIP_TOP_BOTTOM and ROTATE_180 turn the rows round.
        if int(method) in (1, 3):
            derived.rows_flipped = not getattr(self, "rows_flipped", False)
        return derived

    def given(self: object, *args: object, **named: object) -> bytes:
        data: bytes = tobytes(self, *args, **named)
        if not getattr(self, "rows_flipped", False):
            found[key_of(data)] = "tobytes", caller(sys._getframe(1))
        return data

    return {"_new": _new, "transpose": flip, "tobytes": given}
