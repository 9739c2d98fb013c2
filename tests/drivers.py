"""Other drivers, emulated: of another version, without some extensions, with fewer texture units.

What the program asks OpenGL gets the driver's answers, and a call that the driver would not know is
refused: it does nothing and is noted. What belongs to which version and extension is taken from
PyOpenGL, which has it from the registry of OpenGL.
"""

import functools
import importlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from framelens.gl import extensions, seam
from framelens.spec.spec import kind_of
from landscape.gl.features import FEATURES

VERSIONS = ("1_1", "1_2", "1_3", "1_4", "1_5", "2_0", "2_1", "3_0", "3_1", "3_2", "3_3")
SUFFIXES = ("ARB", "EXT", "NV", "SGIS")
# All extensions that the program knows of.
KNOWN = frozenset(
    name for feature in FEATURES.values() for need in feature.needs for name in need.extensions
) | {"GL_ARB_multitexture"}
TEXTURE0, SOURCES = 0x84C0, range(0x8580, 0x858B)  # GL_SRC0_RGB to GL_SRC2_ALPHA
UNIT_CALLS = ("glActiveTexture", "glClientActiveTexture", "glMultiTexCoord2f")


@functools.cache
def in_core() -> tuple[dict[str, tuple[int, int]], dict[int, tuple[int, int]]]:
    """Return the version in which each function and each enumerant's value came."""
    functions: dict[str, tuple[int, int]] = {}
    values: dict[int, tuple[int, int]] = {}
    for text in VERSIONS:
        major, minor = map(int, text.split("_"))
        module = importlib.import_module(f"OpenGL.raw.GL.VERSION.GL_{text}")
        for name, value in vars(module).items():
            if name.startswith("gl"):
                functions.setdefault(name, (major, minor))
            elif name.startswith("GL_") and isinstance(value, int):
                values.setdefault(int(value), (major, minor))
    return functions, values


@functools.cache
def in_extension(name: str) -> tuple[frozenset[str], frozenset[int]]:
    """Return the functions of an extension, by their names in the core, and its values."""
    _, vendor, rest = name.split("_", 2)
    module = vars(importlib.import_module(f"OpenGL.raw.GL.{vendor}.{rest}"))
    functions = {each.removesuffix(end) for each in module for end in SUFFIXES if each[:2] == "gl"}
    values = {
        int(value)
        for each, value in module.items()
        if each.startswith("GL_") and isinstance(value, int)
    }
    return frozenset(functions), frozenset(values)


@dataclass
class Driver:
    """What a driver has; ``refused`` collects the calls that it does not know."""

    version: tuple[int, int] = (4, 6)
    hidden: frozenset[str] = frozenset()
    units: int = 8
    widest: float = 8.0
    refused: list[str] = field(default_factory=list)

    @property
    def extensions(self) -> frozenset[str]:
        return KNOWN - self.hidden

    def has(self, since: tuple[int, int], *names: str) -> bool:
        return self.version >= since or not self.extensions.isdisjoint(names)

    def knows_function(self, name: str) -> bool:
        since = in_core()[0].get(name, (9, 9))
        return self.has(since) or any(name in in_extension(each)[0] for each in self.extensions)

    def knows_value(self, value: int) -> bool:
        since = in_core()[1].get(value, (9, 9))
        return self.has(since) or any(value in in_extension(each)[1] for each in self.extensions)

    def objection(self, name: str, args: tuple[Any, ...]) -> str:
        """Return why a call is refused, "" if it is not."""
        if not self.knows_function(name):
            return "unknown function"
        for k, value in enumerate(args):
            number = isinstance(value, (int, np.integer)) and not isinstance(value, bool)
            if number and kind_of(name, k, args) == "enum" and not self.knows_value(int(value)):
                return f"unknown enumerant 0x{int(value):X}"

        if name in UNIT_CALLS and int(args[0]) - TEXTURE0 >= self.units:
            return "no such texture unit"
        if name == "glTexEnvi" and int(args[1]) in SOURCES and int(args[2]) in self._all_units():
            if not self.has((1, 4), "GL_ARB_texture_env_crossbar"):
                return "no crossbar"
            if int(args[2]) - TEXTURE0 >= self.units:
                return "no such texture unit"

        any_size = self.has((2, 0), "GL_ARB_texture_non_power_of_two")
        sides = args[3:5] if name == "glTexImage2D" and not any_size else ()
        if any(int(side) & (int(side) - 1) for side in sides):
            return "sides that are no powers of two"
        if name == "glTexParameterf" and int(args[1]) == 0x8501 and not self.has((1, 4)):
            return "LOD bias of a texture"
        if name == "glLineWidth" and args[0] > self.widest:
            return "too wide a line"
        return ""

    @staticmethod
    def _all_units() -> range:
        return range(TEXTURE0, TEXTURE0 + 32)

    def wrapped(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        """Return an OpenGL function as the driver has it."""

        def called(*args: Any, **named: Any) -> Any:
            if why := self.objection(name, args):
                self.refused.append(f"{name}{args[:4]}: {why}")
                return 0
            answer = self.answer(name, args)
            return function(*args, **named) if answer is None else answer

        return called

    def answer(self, name: str, args: tuple[Any, ...]) -> Any:
        """Return what the driver says of itself, None if OpenGL is to answer."""
        asked = name, int(args[0]) if args and isinstance(args[0], (int, np.integer)) else 0
        return {
            ("glGetString", 0x1F02): "{}.{} Other".format(*self.version).encode(),
            ("glGetString", 0x1F03): " ".join(sorted(self.extensions)).encode(),
            ("glGetIntegerv", 0x84E2): self.units,
            ("glGetFloatv", 0x846E): np.array([1.0, self.widest], np.float32),
            ("glGetFloatv", 0x0B22): np.array([1.0, self.widest], np.float32),
        }.get(asked)


@contextmanager
def emulated(driver: Driver) -> Iterator[Driver]:
    """Let the program meet a driver in the block; its contexts must be opened in it, too."""
    original = seam.original

    def own(name: str) -> Any:
        value = original(name)
        return driver.wrapped(name, value) if name.startswith("gl") and callable(value) else value

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(seam, "original", own)
        patch.setattr(extensions, "_known", {})
        patch.setattr(extensions, "_units", {})
        patch.setattr(extensions, "_told", set())
        _forget()
        try:
            yield driver
        finally:
            _forget()


def _forget() -> None:
    """Let the seam look all functions up again."""
    seam.seam.plain.clear()
    seam.seam.noted.clear()
