"""What the system leaves to a program that is checked: which files it reads, and where it writes.

It reads Python, the installed packages, the system's libraries and its own file; not this package,
in which the solutions and the grader are, nor anybody's home, nor the folder in which the programs
of others may lie. It writes into a folder of its own. framelens/system/containment.py does it.
"""

import os
import re
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

from framelens.system import containment

# How far programs are contained: by the system, if it can; in any case; by Python alone.
AUTO, REQUIRE, NONE = "auto", "require", "none"
CHOICES = (AUTO, REQUIRE, NONE)
# What contains them.
LANDLOCK, PYTHON = "landlock", "python"

PACKAGE = Path(__file__).resolve().parents[2]
LIBRARY = re.compile(r"\s(/\S.*)$")
# What a program needs of the environment: the rest may hold what is nobody's business.
KEPT = re.compile(
    r"PATH|HOME|LANG|LANGUAGE|TZ|TMPDIR|DISPLAY|WAYLAND_DISPLAY|XAUTHORITY|XDG_RUNTIME_DIR"
    r"|(LC|LD|PYTHON|PYOPENGL|PYGLFW|OPENBLAS|OMP|LP|MESA|GALLIUM|LIBGL|EGL|__EGL|__GLX|__GL|NVIDIA"
    r"|LANDSCAPE)_?\w*"
)


def environment() -> dict[str, str]:
    """Return the part of the environment that programs may see."""
    return {name: value for name, value in os.environ.items() if KEPT.fullmatch(name)}


def confine(
    program: Path,
    readable: Iterable[Path],
    writable: Iterable[Path],
    private: Iterable[str] = (),
) -> None:
    """Leave this process what a program may have, and some files and folders more.

    Nothing but the program is read in the folders that are ``private``. OSError if the system
    cannot.
    """
    own = os.path.dirname(os.path.abspath(program)), os.getcwd()
    seen, listed = _readable(*own, *private)
    containment.confine(
        [*seen, str(program), *map(str, readable)], listed, list(map(str, writable))
    )


@cache
def _readable(*work: str) -> tuple[list[str], list[str]]:
    """Return the files and folders to read, and the folders of which only the names may be seen.

    ``work``: where programs lie that are nobody else's business.
    """
    prefixes = {os.path.realpath(each) for each in (sys.prefix, sys.base_prefix, sys.exec_prefix)}
    private = (os.path.expanduser("~"), *_courses(), *work)
    hidden = {str(PACKAGE), *map(os.path.realpath, private)} - prefixes
    readable: set[str] = set()
    listed: set[str] = set()
    for root in (*containment.SYSTEM, *prefixes, *_paths(prefixes, hidden), *_libraries()):
        for path, whole in _parts(os.path.realpath(root), hidden):
            (readable if whole else listed).add(path)
    return sorted(readable), sorted(listed)


def _courses() -> Iterator[str]:
    """Yield where this package is installed: it may be in several places."""
    for entry in sys.path:
        place = os.path.join(entry, PACKAGE.name)
        if os.path.isdir(os.path.join(place, "course")):
            yield place


def _paths(prefixes: Iterable[str], hidden: Iterable[str]) -> Iterator[str]:
    """Yield where Python looks for modules beside its own folders, unless more lies there.

    Of a checkout of this program only the package of tools: its folder has the history, too.
    """
    checkouts = {os.path.dirname(place) for place in _courses()}
    for entry in filter(os.path.isdir, sys.path):
        if any(_inside(entry, prefix) for prefix in prefixes):
            yield entry
        elif entry in checkouts:
            yield os.path.join(entry, "framelens")
        elif not any(_inside(each, os.path.realpath(entry)) for each in hidden):
            yield entry


def _libraries() -> Iterator[str]:
    """Yield the libraries that this process has loaded, and the folders that are searched."""
    yield from filter(None, os.environ.get("LD_LIBRARY_PATH", "").split(os.pathsep))
    lines = Path("/proc/self/maps").read_text(errors="surrogateescape").splitlines()
    for line in lines:
        if (found := LIBRARY.search(line)) and ".so" in found[1]:
            yield found[1]


def _parts(root: str, hidden: Iterable[str]) -> Iterator[tuple[str, bool]]:
    """Yield the parts of a folder without what is hidden, and whether each is to be read whole.

    A folder inside one that is hidden was asked for by name: that of a Python in a home.
    """
    if root in hidden:
        return
    if not any(_inside(each, root) for each in hidden):
        yield root, True
        return
    yield root, False
    with os.scandir(root) as entries:
        for entry in entries:
            if not entry.is_symlink():
                yield from _parts(entry.path, hidden)


def _inside(path: str, folder: str) -> bool:
    return path == folder or path.startswith(folder.rstrip(os.sep) + os.sep)
