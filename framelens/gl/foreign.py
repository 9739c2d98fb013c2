"""The OpenGL functions of programs that know nothing of the seam, replaced before their imports.

Inside :func:`patched` every module of PyOpenGL holds, in place of each function, what ``make``
returned for it. So it does not matter how the program imports OpenGL. PyOpenGL's wrappers call each
other: whoever notes calls must note the outermost only.

An alias is named as the function that it stands for: ``glLight`` is glLightfv. ``glVertex`` and its
like, which choose a function by their arguments, stay as they are, and the function they choose is
replaced. What libGLU computes is done by Python (glu.py): its calls of OpenGL then are seen too,
and work in every context. The shapes and letters of GLUT and GLE, and NURBS, which libraries draw
by calls of their own, are passed to ``make`` by their own names, as if OpenGL had them.
"""

import ctypes
import importlib
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from types import ModuleType
from typing import Any

from framelens.gl import libraries
from framelens.gl.binding import use_platform
from framelens.gl.holders import replaced
from framelens.gl.originals import patches, unwrapped
from framelens.gl.redirected import redirected
from framelens.gl.seam import glu_noted

Make = Callable[[str, Callable[..., object]], Callable[..., object]]

# Each chooses a function by its arguments; the tables from which it takes that function.
CHOOSERS = ("glColor", "glMaterial", "glRasterPos", "glTexParameter", "glVertex")
TABLES = ("glColorDispatch", "glRasterPosDispatch", "glVertexDispatch")

_SHAPES = "Cone Cube Cylinder Dodecahedron Icosahedron Octahedron RhombicDodecahedron"
_SHAPES += " SierpinskiSponge Sphere Teacup Teapot Teaspoon Tetrahedron Torus"
_LETTERS = "BitmapCharacter BitmapString StrokeCharacter StrokeString"
OPAQUE = {
    *(f"glut{style}{shape}" for style in ("Solid", "Wire") for shape in _SHAPES.split()),
    *(f"glut{letters}" for letters in _LETTERS.split()),
    *("gluEndCurve", "gluEndSurface", "gluEndTrim"),
    *("glePolyCylinder", "glePolyCone", "gleExtrusion", "gleTwistExtrusion", "gleSuperExtrusion"),
    *("gleSpiral", "gleLathe", "gleHelicoid", "gleToroid", "gleScrew"),
}


@contextmanager
def patched(make: Make) -> Iterator[None]:
    """Replace each OpenGL function f by ``make(name, f)`` in every module that holds it.

    The platform of PyOpenGL must have been chosen. ``make`` is called once for each function; what
    it returns is called as the program calls the function, with keywords too; it may be f itself.
    """
    import OpenGL.GL
    from OpenGL.arrays import vbo

    from framelens.gl.executed_lists import taken_apart
    from framelens.gl.glu import FUNCTIONS

    make = taken_apart(make, unwrapped(OpenGL.GL.glCallList))
    names: dict[str, Callable[..., object]] = {}

    def choose(module: str, name: str, value: Any) -> Any:
        if name in FUNCTIONS and module.startswith("OpenGL.GLU"):
            # One for each function replaced, so that each can be put back.
            return glu_noted(name, FUNCTIONS[name])
        if not (_is_function(name, value) or name in OPAQUE) or hasattr(value, "__wrapped__"):
            return None
        name = _own_name(name, value)
        names[name] = value
        return _replacement(make, name, value)

    with ExitStack() as stack:
        patches.append(names)
        stack.callback(patches.remove, names)
        stack.callback(setattr, vbo.Implementation, "CHOSEN", None)
        vbo.Implementation.CHOSEN = None  # holds functions, chosen at the first use
        # OpenGL.raw's functions take arguments as in C, for PyOpenGL's own use.
        stack.enter_context(replaced(("OpenGL",), choose, prefix="gl", but=("OpenGL.raw",)))
        for table in (getattr(OpenGL.GL.exceptional, table) for table in TABLES):
            stack.callback(table.update, dict(table))
            table.update({n: _replacement(make, f.__name__, f) for n, f in table.items()})
        yield


def _is_function(name: str, value: object) -> bool:
    """Return whether a name in a module of PyOpenGL is that of a function of OpenGL."""
    if not (name.startswith("gl") and name[2:3].isupper() and callable(value)):
        return False
    # glInit...EXT asks whether there is an extension.
    helper = name.startswith("glInit") and name != "glInitNames"
    return not (isinstance(value, type) or name in CHOOSERS or helper)


def _own_name(name: str, value: object) -> str:
    """Return the name of the OpenGL function that ``name`` stands for: glLightfv for glLight."""
    own = getattr(value, "__name__", name)
    return own if isinstance(own, str) and own.startswith(name) else name


def _replacement(make: Make, name: str, function: Any) -> object:
    from OpenGL.raw.GL.VERSION import GL_1_0, GL_1_1

    if any(getattr(raw, name, None) is function for raw in (GL_1_0, GL_1_1)):
        noted = make(
            name, redirected(name, function)
        )  # always there, and without keywords: nothing in between
        if noted is not function:
            noted.__wrapped__ = function  # type: ignore[attr-defined]
        return noted
    return _Wrapper(make, name, function)


class _Wrapper:
    """Stands for a function that may be absent, take keywords, or have attributes."""

    def __init__(self, make: Make, name: str, function: Any) -> None:
        self.__wrapped__ = function
        self._noted = make(name, redirected(name, function))

    def __call__(self, *args: object, **named: object) -> object:
        return self._noted(*args, **named)

    def __bool__(self) -> bool:
        return bool(self.__wrapped__)

    def __getattr__(self, name: str) -> object:
        return getattr(self.__wrapped__, name)


def beside(
    function: Callable[..., object],
    before: Callable[[], object] = lambda: None,
    after: Callable[[], object] = lambda: None,
) -> Callable[..., object]:
    """Return ``function`` with something done before and after it; its caller stays its caller."""

    def both(*args: object, **named: object) -> object:
        before()
        result = function(*args, **named)
        after()
        return result

    return both


def load_glut(checked: bool) -> bool:
    """Bind PyOpenGL to the screen and load GLUT; return whether there is one.

    On Linux it is loaded here, as PyOpenGL does not find Debian 12's libglut.so.3.12.
    """
    linux = sys.platform == "linux"
    try:
        glut = libraries.load("glut") if linux else None
    except OSError:
        return False
    use_platform("glx" if linux else "native", checked)
    from OpenGL import platform

    if platform.PLATFORM.GLUT is None and glut is not None:
        platform.PLATFORM.GLUT = ctypes.CDLL(glut._name, ctypes.RTLD_GLOBAL)
    return platform.PLATFORM.GLUT is not None


def library(name: str) -> ModuleType:
    """Return a package of PyOpenGL, such as GLUT; the platform must have been chosen."""
    return importlib.import_module(f"OpenGL.{name}")
