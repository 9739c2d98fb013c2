"""What the system leaves to a program that is checked: which files it reads, and where it writes.

It reads Python, the installed packages, the system's libraries and its own file; not this package,
in which the solutions and the grader are, nor anybody's home, nor the folders in which the programs
of others may lie, wherever that is. It writes into a folder of its own.
framelens/system/containment.py does it.
"""

import contextlib
import os
import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from pathlib import Path

from framelens.system import containment
from landscape.files.cache import folder as cache_folder

# How far programs are contained: by the system, if it can; in any case; by Python alone.
AUTO, REQUIRE, NONE = "auto", "require", "none"
CHOICES = (AUTO, REQUIRE, NONE)
# What contains them.
LANDLOCK, PYTHON = "landlock", "python"

# Asked hundreds of times for a program, mostly of folders that all programs have.
_real = cache(os.path.realpath)

PACKAGE = Path(__file__).resolve().parents[2]
# Of a folder into which Python is installed: in /usr and /opt others may have things, too.
PARTS = ("bin", "lib", "lib32", "lib64", "share", "etc", "plugins", "ssl", "pyvenv.cfg")
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


def prepare() -> None:
    """Look once, before processes are forked, at what :func:`confine` looks at for each of them."""
    _readable(os.getcwd(), frozenset())


def confine(
    program: Path,
    readable: Iterable[Path],
    writable: Iterable[Path],
    private: Iterable[str] = (),
) -> None:
    """Leave this process what a program may have, and some files and folders more.

    Nothing but the program is read in the folder in which it lies, nor in those that are
    ``private``, files or folders. OSError if the system cannot.
    """
    path = os.path.abspath(program)
    beside = {os.path.dirname(path), os.path.dirname(_real(path))}
    seen, listed = _readable(os.getcwd(), frozenset(beside), *private)
    containment.confine(
        [*seen, str(program), *map(str, readable)], listed, list(map(str, writable))
    )


@cache
def _readable(cwd: str, beside: frozenset[str], *private: str) -> tuple[list[str], list[str]]:
    """Return the files and folders to read, and the folders of which only the names may be seen.

    ``beside``: the folders of the program; with what lies around them they are nobody else's
    business, nor is what is ``private``.
    """
    prefixes = {_real(each) for each in (sys.prefix, sys.base_prefix, sys.exec_prefix)}
    python = {os.path.join(prefix, part) for prefix in prefixes for part in PARTS}
    cached = cache_folder()
    ours = str(PACKAGE), *_courses(), *_checkouts(python)

    named = (
        *(os.path.expanduser("~"), cwd, *private),
        *(_around(each, python) for each in beside),
        *([str(cached)] if cached is not None else []),
    )

    # Where modules are looked for, names must be seen.
    entries = [_real(each) for each in sys.path if os.path.isdir(each)]
    needed = {_real(each) for each in (*containment.SYSTEM, *python)}
    needed.update(each for each in entries if any(_inside(each, part) for part in needed))
    hidden = set(map(_real, named)) - needed | set(map(_real, ours))

    # Of many a library several parts are loaded, each of which names it.
    roots = {*containment.SYSTEM, *python, *_paths(python, hidden), *_libraries()}
    return _open_to(set(map(_real, roots)), hidden, entries)


def _open_to(
    roots: Iterable[str], hidden: set[str], entries: Sequence[str]
) -> tuple[list[str], list[str]]:
    """Return what of ``roots`` is to be read, and of what only the names, around the ``hidden``.

    ``entries`` are the folders in which modules are looked for.
    """
    readable: set[str] = set()
    listed: set[str] = set()
    for root in roots:
        for path, whole in _parts(root, hidden):
            if whole:
                readable.add(path)
            elif any(_inside(path, entry) for entry in entries):
                listed.add(path)

    return sorted(readable), sorted(listed)


def _courses() -> Iterator[str]:
    """Yield where this package is installed: it may be in several places."""
    for entry in sys.path:
        place = os.path.join(entry, PACKAGE.name)
        if os.path.isdir(os.path.join(place, "course")):
            yield place


def _checkouts(python: Iterable[str]) -> Iterator[str]:
    """Yield the checkouts of this program, which have the solutions in their history, too."""
    for place in (str(PACKAGE), *_courses()):
        folder = os.path.dirname(_real(place))
        if not any(_inside(folder, _real(each)) for each in python) or os.path.exists(
            os.path.join(folder, "pyproject.toml")
        ):
            yield folder


def _around(folder: str, python: Iterable[str]) -> str:
    """Return the highest folder around one in which nothing lies that programs need.

    A program may lie in a folder of its student, beside those of the others.
    """
    needed = {
        *map(_real, (*containment.SYSTEM, *python, *sys.path)),
        _real(os.path.expanduser("~")),
    }
    found = _real(folder)
    while (parent := os.path.dirname(found)) != found:
        if any(_inside(each, parent) for each in needed):
            break
        found = parent
    return found


def _paths(python: Iterable[str], hidden: Iterable[str]) -> Iterator[str]:
    """Yield where Python looks for modules beside its own folders, unless more lies there.

    Of a checkout of this program only the package of tools.
    """
    checkouts = set(_checkouts(python))
    for entry in filter(os.path.isdir, sys.path):
        place = _real(entry)
        if place in checkouts:
            yield os.path.join(entry, "framelens")
            continue
        of_python = any(_inside(place, _real(each)) for each in python)
        if of_python or not any(_inside(each, place) for each in hidden):
            yield entry


def _libraries() -> Iterator[str]:
    """Yield the libraries that this process has loaded, and the folders that are searched."""
    yield from filter(None, os.environ.get("LD_LIBRARY_PATH", "").split(os.pathsep))
    for file in Path("/etc/ld.so.conf.d").glob("*.conf"):
        with contextlib.suppress(OSError):
            lines = file.read_text(errors="surrogateescape").splitlines()
            yield from (line.strip() for line in lines if line.startswith("/"))
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
    with contextlib.suppress(OSError), os.scandir(root) as entries:
        for entry in entries:
            if not entry.is_symlink():
                yield from _parts(entry.path, hidden)


def _inside(path: str, folder: str) -> bool:
    return path == folder or path.startswith(folder.rstrip(os.sep) + os.sep)
