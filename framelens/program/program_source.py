"""A program's source before it runs: is it Python, and which library opens its window?

PyOpenGL is bound to a platform before it is first imported, so the library must be known earlier.
It is not enough to know what is imported: a GLUT program may import pygame for its sound only.
"""

import ast
import importlib.util
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import CodeType

from framelens.base.errors import InputError
from framelens.base.input import read_bounded
from framelens.base.installation import how_to_add

# Each toolkit's call that makes a context current. The order counts: a program of GLFW or pygame
# may use GLUT for its shapes and letters only.
TOOLKITS = {
    "glfw": "glfw.make_context_current",
    "pygame": "pygame.display.set_mode",
    "glut": "glutCreateWindow",
    "qt": "initializeGL",
}
QT = ("PySide6", "PyQt6", "PyQt5", "PySide2")  # packages of Python for Qt
# The functions that open a window for OpenGL, by their last names; for Qt, its widget.
OPENINGS = {
    "create_window": "glfw",
    "set_mode": "pygame",
    "glutCreateWindow": "glut",
    "glutEnterGameMode": "glut",
    "QOpenGLWidget": "qt",
}
FLAG = "OPENGL"  # without it, pygame's window is none for OpenGL
# Libraries that open windows in which programs cannot be run to a frame; what users call them.
OTHERS = {
    **dict.fromkeys((*QT, "PyQt4", "PySide", "qtpy"), "Qt"),
    **{"pyglet": "pyglet", "moderngl_window": "moderngl-window", "arcade": "arcade"},
    **{"wx": "wxPython", "gi": "GTK", "gtk": "GTK", "sdl2": "PySDL2", "kivy": "Kivy"},
    **{"direct": "Panda3D", "panda3d": "Panda3D", "ursina": "Ursina", "vispy": "VisPy"},
    **{"pyopengltk": "Tk", "tkinter": "Tk", "Tkinter": "Tk"},
}
# Libraries that call OpenGL by themselves, past PyOpenGL.
PAST_PYOPENGL = {"moderngl": "moderngl", "pyglet": "pyglet", "zengl": "zengl"}
WORDS = (b"ERROR_CHECKING", b"gluNewNurbsRenderer")
MOST_BYTES = 4 << 20  # chosen: of a file of a program; Python takes 50 times that to compile it


@dataclass(frozen=True)
class Source:
    """A compiled program. ``modules``: what it and the modules beside it import, by full names.

    Among them is "nurbs" where GLU's NURBS are used, which libGLU draws by itself. ``opens`` are
    the toolkits whose functions that open a window are named in these files.
    """

    path: Path
    code: CodeType
    modules: frozenset[str]
    checked: bool  # whether PyOpenGL checks for errors: it does unless told otherwise
    opens: frozenset[str] = frozenset()

    @property
    def toolkit(self) -> str:
        """The library that opens the window, of TOOLKITS; "" if it is none of them."""
        imported = [toolkit for toolkit in TOOLKITS if toolkit in self.modules]
        opening = [toolkit for toolkit in imported if toolkit in self.opens]
        if not opening and self.other:
            return ""
        return next(iter(opening or imported), "")

    @property
    def other(self) -> str:
        """The usual name of an imported library that opens windows by itself; "" if none is."""
        return next((name for module, name in OTHERS.items() if module in self.modules), "")

    @property
    def past(self) -> str:
        """The usual name of an imported library that bypasses PyOpenGL; "" if none is."""
        found = (name for module, name in PAST_PYOPENGL.items() if module in self.modules)
        return next(found, "")

    @property
    def opening(self) -> str:
        """The function of its toolkit that makes a context current."""
        return TOOLKITS[self.toolkit]


class ProgramError(InputError):
    """A program that cannot be run to its frame; ``details`` is its own traceback, or ""."""

    def __init__(self, template: str, details: str = "", /, **values: object) -> None:
        super().__init__(template, **values)
        self.details = details


def read_source(path: Path) -> Source:
    """Compile a program; ProgramError if it cannot be read or is not Python."""
    try:
        text = read_bounded(path, MOST_BYTES)
    except InputError as error:
        raise ProgramError("{error}", error=error) from None
    try:
        tree = ast.parse(text, str(path))
        code = compile(tree, str(path), "exec", dont_inherit=True)
    except SyntaxError as error:
        import traceback

        line = f", line {error.lineno}" if error.lineno else ""
        details = "".join(traceback.format_exception_only(error))
        raise ProgramError(
            "{path}{line}: is not Python 3 ({msg})", details, path=path, line=line, msg=error.msg
        ) from None
    except (ValueError, RecursionError, MemoryError) as error:
        raise ProgramError(
            "{path}: is not a Python program ({error})", path=path, error=error
        ) from None
    modules: set[str] = set()
    opens: set[str] = set()
    checked = _read(path, text, tree, modules, opens, set())
    return Source(path, code, frozenset(modules), checked, frozenset(opens))


def _read(
    path: Path,
    data: bytes,
    tree: ast.Module,
    modules: set[str],
    opens: set[str],
    seen: set[Path],
) -> bool:
    """Add what a file imports and opens, and what the files beside it do.

    Return whether errors count.
    """
    seen.add(path.resolve())
    opens |= _opened(data, tree)

    # Without its comments, which takes as long as compiling it, so only where a word is there.
    text = ast.unparse(tree) if any(word in data for word in WORDS) else ""
    checked = "ERROR_CHECKING = False" not in text
    if "gluNewNurbsRenderer" in text:
        modules.add("nurbs")
    for name in (*_imported(tree), *_imported_by_name(data, tree)):
        parts = name.split(".")
        if parts[0] in ("glfw", "pygame"):
            modules.add(parts[0])
        elif parts[0] == "OpenGL":
            modules.add(name)
            if parts[1:2] == ["GLUT"]:
                modules.add("glut")
        else:
            modules.add(parts[0])
            if parts[0] in QT:
                modules.add("qt")
            for file in _beside(path.parent, parts):
                if file.resolve() not in seen:
                    checked = _read_other(file, modules, opens, seen) and checked

    return checked


def _read_other(path: Path, modules: set[str], opens: set[str], seen: set[Path]) -> bool:
    try:
        data = read_bounded(path, MOST_BYTES)
        return _read(path, data, ast.parse(data), modules, opens, seen)
    except (OSError, ValueError, SyntaxError, RecursionError):
        return True  # importing it will say so


def _imported(tree: ast.Module) -> Iterator[str]:
    """Yield the full names of what a file imports, of the names taken from modules too."""
    for node in _statements(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = node.module or ""
            yield module
            yield from (f"{module}.{alias.name}".lstrip(".") for alias in node.names)


def _opened(data: bytes, tree: ast.Module) -> set[str]:
    """Return the toolkits of which a file names a function that opens a window for OpenGL."""
    if not any(name.encode() in data for name in OPENINGS):
        return set()
    used = {
        getattr(node, "attr", getattr(node, "id", getattr(node, "name", "")))
        for node in ast.walk(tree)
        if isinstance(node, (ast.Attribute, ast.Name, ast.alias))
    }
    opened = {toolkit for name, toolkit in OPENINGS.items() if name in used}
    return opened if FLAG in used else opened - {"pygame"}


def _imported_by_name(data: bytes, tree: ast.Module) -> Iterator[str]:
    """Yield what a file imports by ``importlib.import_module`` or ``__import__``."""
    if b"import_module" not in data and b"__import__" not in data:
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and node.args:
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            given = getattr(node.args[0], "value", None)
            if name in ("import_module", "__import__") and isinstance(given, str):
                yield given


# Fields of a syntax node that hold statements, also those of `except` and `case`.
BLOCKS = ("body", "orelse", "finalbody", "handlers", "cases")


def _statements(node: object) -> Iterator[object]:
    """Yield the statements inside a node; ast.walk looks at every expression too."""
    for name in BLOCKS:
        block = getattr(node, name, None)
        if isinstance(block, list):  # that of a lambda is an expression
            for each in block:
                yield each
                yield from _statements(each)


def _beside(folder: Path, parts: list[str]) -> list[Path]:
    """Return the files of a module in a program's folder."""
    found = []
    for count in range(1, len(parts) + 1):
        place = folder.joinpath(*parts[:count])
        found += [place.with_suffix(".py"), place / "__init__.py"]
    return [file for file in found if file.is_file()]


def need_package(name: str, path: Path) -> None:
    """Raise ProgramError if the Python package of a toolkit is not installed."""
    if importlib.util.find_spec(name) is None:
        raise ProgramError(
            "{path}: needs the Python package {name}: {how_to_add}",
            path=path,
            name=name,
            how_to_add=how_to_add(name),
        )
