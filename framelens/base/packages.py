"""The packages that draw: where their sources and texts lie, and which one speaks to the user.

A package that stands on framelens adds itself when it is imported. A trace then names its files
from the package on, texts are translated by its catalogues, too, and lines for the user begin with
its name.
"""

from __future__ import annotations

import os

# Every program that imports a package imports this: pathlib and typing would take half of the time.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from pathlib import Path


class Package:
    """A package: its name, folder and version, and the rooms that a trace does not show.

    In their place it shows who calls them.
    """

    def __init__(
        self,
        name: str,
        folder: str | os.PathLike[str],
        unseen: tuple[str, ...] = (),
        version: str = "",
    ) -> None:
        self.name = name
        self.version = version
        self.unseen = unseen
        self._root = os.fspath(folder)

    @property
    def folder(self) -> Path:
        """The folder of the package."""
        from pathlib import Path

        return Path(self._root)

    @property
    def locale(self) -> Path:
        """The folder of its catalogues, LANGUAGE/DOMAIN.po."""
        return self.folder / "locale"

    def traced(self, path: str) -> str | None:
        """Return a source file's name in a trace, with slashes: from the package on.

        None if the file is not of the package; "" if it is of a room that is not shown.
        """
        root = f"{self._root}{os.sep}"
        if not path.startswith(root):
            return None
        inside = path[len(root) :].replace(os.sep, "/")
        hidden = any(inside.startswith(f"{room}/") for room in self.unseen)
        return "" if hidden else f"{self.name}/{inside}"


FRAMELENS = Package(
    "framelens", os.path.dirname(os.path.dirname(os.path.realpath(__file__))), unseen=("gl",)
)
PACKAGES = [FRAMELENS]


def add(name: str, file: str, unseen: tuple[str, ...] = (), version: str = "") -> None:
    """Add a package, whose __init__ is this file, unless it is there."""
    if name not in [package.name for package in PACKAGES]:
        PACKAGES.append(Package(name, os.path.dirname(os.path.realpath(file)), unseen, version))


def speaker() -> str:
    """Return the name of the package added last, with which lines for the user begin."""
    return PACKAGES[-1].name
