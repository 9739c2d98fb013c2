"""Finding the files the island is made of: the user's own first, then the shipped ones."""

import os
from pathlib import Path

from framelens.base.errors import InputError
from landscape.files.cache import content

PACKAGE = Path(__file__).resolve().parents[1]


def shipped() -> Path:
    """Return the folder of the shipped assets, in a wheel or in a checkout."""
    inside = PACKAGE / "assets"
    return inside if inside.is_dir() else PACKAGE.parent / "assets"


def recording(path: Path) -> Path:
    """Return the path of a recording: a file, or else the shipped one of that name, as `tour`."""
    name = f"{path}.jsonl"
    shipped_ones = (PACKAGE / "recordings" / name, PACKAGE.parent / "screenshots" / name)
    if path.name == str(path) and not os.path.exists(path):
        return next((each for each in shipped_ones if each.is_file()), path)
    return path


class Assets:
    """File names to paths."""

    def __init__(self, folder: Path | None = None) -> None:
        """Look in ``folder`` before the shipped assets; InputError if that is impossible."""
        if folder is not None and not os.path.isdir(folder):
            raise InputError("assets {folder}: expected a folder", folder=folder)
        if folder is not None and not os.access(folder, os.R_OK | os.X_OK):
            raise InputError("assets {folder}: expected a folder that can be read", folder=folder)
        self._folders = ([folder] if folder is not None else []) + [shipped()]

    def has_own(self, *names: str) -> bool:
        """Return whether the user's folder has a file of one of these names."""
        return any(os.path.exists(folder / name) for folder in self._folders[:-1] for name in names)

    def contents(self, *names: str) -> list[bytes]:
        """Return a hash of the bytes of every file an island may be made of, and of ``names``.

        A file that is missing or cannot be read counts as empty. What else is in the user's folder
        is not read: there may be much of it.
        """
        given = [os.path.expanduser(name) for name in names]
        known = [*sorted(path.name for path in shipped().iterdir()), *given]
        return [content(folder / name) for folder in (*self._folders, Path()) for name in known]

    def path(self, name: str, key: str = "") -> Path:
        """Return the path of a file; a name without a folder is looked up in the asset folders.

        InputError names the file, and the setting (``key``) it came from.
        """
        given = Path(os.path.expanduser(name))
        candidates = [given]
        if given.name == name:
            candidates = [folder / name for folder in self._folders] + [given]
        where = f"setting {key}: " if key else ""
        for path in candidates:
            try:
                os.stat(path)
                return path
            except PermissionError:
                raise InputError(
                    "{where}{name}: cannot be read (Permission denied)", where=where, name=name
                ) from None
            except (OSError, ValueError):
                continue
        raise InputError("{where}{name}: no such file", where=where, name=name)
