"""The specification of OpenGL 1.5 as questions: what is this argument, what may it be?

A call is given by its name and its arguments as PyOpenGL received them; ``index`` counts them from
0. The tables are in the modules ``spec_*`` beside this one: functions, enumerants, state variables,
and the texts. Functions of later versions are unknown, but for framebuffer
objects and a few more; the ARB and EXT names of known functions are understood.
"""

from collections.abc import Sequence
from functools import cache

from framelens.base.texts import translator
from framelens.spec.spec_arguments import (
    deciding,
    enumerant,
    function,
    kind_of,
    legal,
    limits,
    parameter,
    value_of,
)
from framelens.spec.spec_functions import AT_ONCE, DRAWS, QUERIES
from framelens.spec.spec_table import Function, Parameter, functions
from framelens.spec.spec_texts import ARGUMENTS, ENUMERANTS, FUNCTIONS
from framelens.spec.spec_values import parsed, written
from framelens.spec.spec_variables import sets

__all__ = [
    "Function",
    "Parameter",
    "creates",
    "deletes",
    "draws",
    "enumerant",
    "explain",
    "explain_argument",
    "explain_enumerant",
    "function",
    "functions",
    "in_list",
    "is_query",
    "kind_of",
    "legal",
    "limits",
    "parameter",
    "parsed",
    "sets",
    "value_of",
    "written",
]

CREATED = (
    *("glGenTextures", "glGenLists", "glGenBuffers", "glGenQueries", "glGenFramebuffers"),
    *("glGenRenderbuffers", "gluNewQuadric", "gluNewTess", "gluNewNurbsRenderer"),
)


@cache
def draws(name: str) -> bool:
    """Return whether a call writes into the framebuffer; glBegin, for its block up to glEnd.

    False for glCallList and glCallLists, whose calls draw.
    """
    known = function(name)
    return known is not None and (known.group == "draw" or known.base in DRAWS)


def is_query(name: str) -> bool:
    """Return whether a call only returns something, and changes no state."""
    known = function(name)
    return known is not None and (known.group == "get" or known.base in QUERIES)


def creates(name: str) -> bool:
    """Return whether a call makes names of objects, or a GLU object."""
    known = function(name)
    return known is not None and known.base in CREATED


def deletes(name: str) -> bool:
    """Return whether a call deletes objects."""
    return function(name) is not None and name.startswith(("glDelete", "gluDelete"))


def in_list(name: str) -> bool:
    """Return whether a call made between glNewList and glEndList goes into the display list.

    False for what OpenGL executes at once even there: queries, client arrays, pixel storage, buffer
    and framebuffer objects, and whatever creates or deletes objects. A glTexImage call for a proxy
    is executed at once, too.
    """
    known = function(name)
    if known is None or is_query(name):
        return False
    groups = ("array", "buffer", "quadric", "framebuffer")
    compiled = known.group not in groups and known.base not in AT_ONCE
    return compiled or known.base == "glBlitFramebuffer"


def explain(name: str, language: str) -> str:
    """Return what a function does, in a line; "" if it is unknown."""
    known = function(name)
    return translator(language, "calls")(FUNCTIONS[known.base], known.base) if known else ""


def explain_argument(name: str, index: int, args: Sequence[object], language: str) -> str:
    """Return what an argument means, in a line; "" if it is unknown.

    The value of a property is explained as this property: GL_FOG_DENSITY in glFogf.
    """
    known = function(name)
    form = known.form(len(args)) if known else ()
    if known is None or not 0 <= index < len(form):
        return ""
    found = form[index]
    if found.kind == "by":
        pname = deciding(found, form, args)
        if pname:
            return explain_enumerant(pname, language, found.of)
    scopes = (f"{known.base}.", f"{known.group}.", "")
    key = next(f"{scope}{found.name}" for scope in scopes if f"{scope}{found.name}" in ARGUMENTS)
    return translator(language, "calls")(ARGUMENTS[key], key)


def explain_enumerant(name: str, language: str, of: str = "") -> str:
    """Return what an enumerant means, in a line, or "" where its name says it all.

    ``of`` is the group that it belongs to here, as :class:`Parameter` names it: GL_REPLACE has
    other meanings as "stencil_op" and as "env_mode".
    """
    key = f"{of}.{name}" if f"{of}.{name}" in ENUMERANTS else name
    return translator(language, "calls")(ENUMERANTS[key], key) if key in ENUMERANTS else ""
