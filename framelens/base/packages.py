"""The packages that draw: where their sources and texts lie, and which one speaks to the user.

A package that stands on framelens adds itself when it is imported. A trace then names its files
from the package on, texts are translated by its catalogues, too, and lines for the user begin with
its name.
"""

import os
from pathlib import Path
from typing import NamedTuple


class Package(NamedTuple):
    """A package: its name, its folder, and the rooms whose callers a trace shows in their place."""

    name: str
    folder: Path
    unseen: tuple[str, ...] = ()

    @property
    def locale(self) -> Path:
        """The folder of its catalogues, LANGUAGE/DOMAIN.po."""
        return self.folder / "locale"

    def traced(self, path: str) -> str | None:
        """Return a source file's name in a trace, with slashes: from the package on.

        None if the file is not of the package; "" if it is of a room that is not shown.
        """
        root = f"{self.folder}{os.sep}"
        if not path.startswith(root):
            return None
        inside = path[len(root) :].replace(os.sep, "/")
        hidden = any(inside.startswith(f"{room}/") for room in self.unseen)
        return "" if hidden else f"{self.name}/{inside}"


FRAMELENS = Package("framelens", Path(__file__).resolve().parents[1], ("gl",))
PACKAGES = [FRAMELENS]


def add(name: str, folder: Path, unseen: tuple[str, ...] = ()) -> None:
    """Add a package, unless it is there."""
    package = Package(name, folder, unseen)
    if package not in PACKAGES:
        PACKAGES.append(package)


def speaker() -> str:
    """Return the name that lines for the user begin with: that of the package added last."""
    return PACKAGES[-1].name
