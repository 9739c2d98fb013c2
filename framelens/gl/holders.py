"""Replace objects wherever the modules of some packages hold them, modules imported later included.

``from OpenGL.GL import *`` copies names, so that one function is held by dozens of modules. A
program that is to use another function must find it in all of them before it imports any.
"""

import importlib.abc
import importlib.machinery
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from types import ModuleType
from typing import Any

Choose = Callable[[str, str, object], object]
"""From a module's name, a name in it and its value: what to put in its place, or None."""


@contextmanager
def replaced(
    packages: Sequence[str], choose: Choose, prefix: str = "", but: Sequence[str] = ()
) -> Iterator[None]:
    """Inside the block, the modules of ``packages`` hold what ``choose`` gives for their values.

    A value is replaced by the same object wherever it is held, and put back afterwards; what the
    modules of the packages ``but`` hold stays. Only names that begin with ``prefix`` are looked at:
    of PyOpenGL's 30,000 most are constants.
    """
    replacements: dict[int, object] = {}  # by the identity of the value
    originals: dict[int, object] = {}  # by the identity of the replacement

    def apply(module: ModuleType) -> None:
        if _belongs(module.__name__, but):
            return
        held = vars(module)
        for name, value in _held(held, prefix):
            if id(value) in originals:
                continue
            new = replacements.get(id(value))
            if new is None:
                new = choose(module.__name__, name, value)
                if new is None:
                    continue
                replacements[id(value)] = new
                originals[id(new)] = value  # keeps the value alive, so that its identity stays its
            held[name] = new

    hook = _Hook(packages, apply)
    for module in _modules(packages):
        apply(module)
    sys.meta_path.insert(0, hook)
    try:
        yield
    finally:
        sys.meta_path.remove(hook)
        for module in _modules(packages):
            held = vars(module)
            for name, value in _held(held, prefix):
                if id(value) in originals:
                    held[name] = originals[id(value)]


def _held(held: dict[str, object], prefix: str) -> list[tuple[str, object]]:
    names = [name for name in held if name.startswith(prefix) and not name.startswith("__")]
    return [(name, held[name]) for name in names]


def _belongs(name: str, packages: Sequence[str]) -> bool:
    return name in packages or name.startswith(tuple(f"{package}." for package in packages))


def _modules(packages: Sequence[str]) -> list[ModuleType]:
    some, beginnings = list(sys.modules.items()), tuple(packages)
    loaded = [(name, module) for name, module in some if name.startswith(beginnings)]
    return [module for name, module in loaded if module and _belongs(name, packages)]


class _Hook(importlib.abc.MetaPathFinder):
    """Calls ``apply`` on each module of ``packages`` as soon as it has been executed."""

    def __init__(self, packages: Sequence[str], apply: Callable[[ModuleType], None]) -> None:
        self._packages = packages
        self._apply = apply

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> importlib.machinery.ModuleSpec | None:
        if not _belongs(fullname, self._packages):
            return None
        for finder in sys.meta_path:
            spec = None if finder is self else finder.find_spec(fullname, path, target)
            if spec is not None:
                break
        else:
            return None
        loader: Any = spec.loader
        if loader is not None:
            execute = loader.exec_module

            def exec_module(module: ModuleType) -> None:
                execute(module)
                self._apply(module)

            loader.exec_module = exec_module
        return spec
