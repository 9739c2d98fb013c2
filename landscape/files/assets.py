"""Finding the files the island is made of: the user's own first, then those that came with it."""

import os
from pathlib import Path

from landscape.errors import InputError
from landscape.files.cache import content

PACKAGE = Path(__file__).resolve().parents[1]


def shipped() -> Path:
    """Return the folder of the shipped assets, in a wheel or in a checkout."""
    inside = PACKAGE / "assets"
    return inside if inside.is_dir() else PACKAGE.parent / "assets"


class Assets:
    """File names to paths."""

    def __init__(self, folder: Path | None = None) -> None:
        """Look in ``folder`` before the shipped assets; InputError where it is no folder."""
        if folder is not None and not os.path.isdir(folder):
            raise InputError(f"--assets {folder}: expected a folder")
        self._folders = ([folder] if folder is not None else []) + [shipped()]

    def contents(self, *names: str) -> list[bytes]:
        """Return hashes of what all files are that an island may be made of, ``names`` included.

        A file that is missing or cannot be read counts as an empty one.
        """
        paths = [path for folder in self._folders for path in sorted(folder.iterdir())]
        paths += [Path(os.path.expanduser(name)) for name in names]
        return [content(path) for path in paths]

    def path(self, name: str, key: str = "") -> Path:
        """Return the path of a file; a name with no folder is looked up in the asset folders.

        InputError names the file, and the settings ``key`` it came from.
        """
        given = Path(os.path.expanduser(name))
        candidates = [given]
        if given.name == name:
            candidates = [folder / name for folder in self._folders] + [given]
        for path in candidates:
            if os.path.exists(path):
                return path
        where = f"setting {key}: " if key else ""
        raise InputError(f"{where}{name}: no such file")
