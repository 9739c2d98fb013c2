"""The tables of the specification, read: a function's parameters, and the names in a group."""

import functools
import itertools
import re
from dataclasses import dataclass, replace

from framelens.spec.spec_enumerants import BY_OTHER, BY_PNAME, GROUPS
from framelens.spec.spec_functions import FUNCTIONS

TYPES: dict[str, tuple[str, float | None, float | None]] = {
    # suffix: numpy's name of the type, its least and its greatest value where it has few
    "b": ("int8", -128, 127),
    "s": ("int16", -(2**15), 2**15 - 1),
    "i": ("int32", -(2**31), 2**31 - 1),
    "f": ("float32", None, None),
    "d": ("float64", None, None),
    "ub": ("uint8", 0, 255),
    "us": ("uint16", 0, 2**16 - 1),
    "ui": ("uint32", 0, 2**32 - 1),
}
SMALLEST = 1e-6  # chosen: the least number that counts as positive where OpenGL allows no zero


@dataclass(frozen=True)
class Parameter:
    """The kind of one argument.

    ``of`` names the group of legal enumerants or bits, what an object is ("texture", "list", ...)
    or what a vector holds ("color", "position", "direction", "plane", ...). ``other`` is the
    earlier parameter that decides which group it is. ``count`` is the number of components where
    it is fixed. ``low`` and ``high`` are limits, inclusive, of each component; a value of ``also``
    is legal beyond them.
    """

    name: str
    kind: str
    of: str = ""
    other: str = ""
    count: int | None = None
    low: float | None = None
    high: float | None = None
    also: tuple[float, ...] = ()


@dataclass(frozen=True)
class Function:
    """One function. ``forms`` are the ways in which PyOpenGL accepts its arguments.

    ``base`` is its name without number and type: the texts belong to it. ``type`` is the suffix of
    its numbers' type, or "". ``vector`` says whether numbers come as an array (glFogfv).
    """

    name: str
    base: str
    forms: tuple[tuple[Parameter, ...], ...]
    group: str
    since: str
    type: str
    vector: bool

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The parameters of the full form."""
        return self.forms[0]

    def form(self, count: int) -> tuple[Parameter, ...]:
        """Return the parameters of a call with ``count`` arguments."""
        exact = (form for form in self.forms if len(form) == count)
        longer = (form for form in self.forms if len(form) > count)
        return next(exact, next(longer, self.forms[0]))


@functools.cache
def functions() -> dict[str, Function]:
    """Return all functions by name."""
    found = {}
    for (group, since), rows in FUNCTIONS.items():
        for row in re.split(r"\n\s*(?=gl)", rows.strip()):
            for function in _expanded(row, group, since):
                found[function.name] = function
    return found


def _expanded(row: str, group: str, since: str) -> list[Function]:
    """Return the functions of one row."""
    pattern, _, rest = " ".join(row.split()).partition(" ")
    pieces = re.split(r"\{([^}]*)\}", pattern)
    found = []
    for choice in itertools.product(*(piece.split(",") for piece in pieces[1::2])):
        name = pieces[0] + "".join(a + b for a, b in zip(choice, pieces[2::2], strict=True))
        number = next((int(part) for part in choice if part.isdigit()), None)
        type_ = next((part for part in choice if part in TYPES), "")
        vector = bool(type_) and name.endswith("v")
        forms = tuple(_form(text, number, type_) for text in rest.split("|"))
        found.append(Function(name, pieces[0], forms, group, since, type_, vector))
    return found


def _form(text: str, number: int | None, type_: str) -> tuple[Parameter, ...]:
    """Read the parameters of one form; ``number`` of the plain ones are kept."""
    form, plain = [], 0
    for word in text.split():
        if re.fullmatch(r"\w+", word):
            plain += 1
            if number is not None and plain > number:
                continue
        form.append(read_parameter(word, number, type_))
    return tuple(form)


_PARAMETER = re.compile(
    r"(?P<name>\w+)(:(?P<kind>\w+))?(\*(?P<count>\w+))?(=(?P<of>\w+))?(@(?P<other>\w+))?"
    r"(\[(?P<limits>[^]]*)\])?"
)


def read_parameter(text: str, number: int | None = None, type_: str = "") -> Parameter:
    """Read a parameter as :mod:`spec_functions` writes it, for a variant of the given type."""
    match = _PARAMETER.fullmatch(text)
    assert match is not None, text
    kind = match["kind"] or "number"
    low, high, also = _limits(match["limits"], kind)
    dtype, least, most = TYPES[type_] if type_ else ("float", None, None)
    if kind == "number":
        kind = "float" if dtype.startswith("float") else "int"
        low, high = least if low is None else low, most if high is None else high
    count = {None: None, "N": number}.get(match["count"], 0)
    if count == 0:
        count = int(match["count"])
    return Parameter(
        match["name"], kind, match["of"] or "", match["other"] or "", count, low, high, also
    )


def _limits(text: str | None, kind: str) -> tuple[float | None, float | None, tuple[float, ...]]:
    """Read limits such as ">=0" or "0..90|180"; without any, those of the kind."""
    if text is None:
        low = {"clampf": 0.0, "count": 0.0, "object": 0.0, "bits": 0.0}.get(kind)
        return low, {"clampf": 1.0, "bits": 2.0**32 - 1}.get(kind), ()
    if text.startswith(">="):
        return float(text[2:]), None, ()
    if text.startswith(">"):
        return SMALLEST, None, ()
    bounds, *also = text.split("|")
    low_text, high_text = bounds.split("..")
    return float(low_text), float(high_text), tuple(map(float, also))


@functools.cache
def names(group: str) -> tuple[str, ...]:
    """Return the enumerants, bits or numbers of a group, in the table's order, each once."""
    found: dict[str, None] = {}
    text = GROUPS[group] if group in GROUPS else " ".join(BY_PNAME[group])
    for word in text.split():
        series = re.fullmatch(r"(\w*?)(\d+)\.\.(\d+)", word)
        if word.startswith("+"):
            found |= dict.fromkeys(names(word[1:]))
        elif series:
            first, last = int(series[2]), int(series[3])
            found |= {f"GL_{series[1]}{k}": None for k in range(first, last + 1)}
        elif word.startswith("GLU_") or re.fullmatch(r"[\d.]+", word):
            found[word] = None
        else:
            found[f"GL_{word}"] = None
    return tuple(found)


def group_of(parameter: Parameter, other: str) -> str:
    """Return the group of a parameter's legal values, where the deciding argument is ``other``."""
    if not parameter.other:
        return parameter.of
    choices = BY_OTHER[parameter.of]
    return choices.get(other.removeprefix("GL_"), choices[""])


@functools.cache
def by_pname(group: str, pname: str, function: Function) -> Parameter | None:
    """Return what the argument after ``pname`` is, or None where the table lacks the pname."""
    text = BY_PNAME[group].get(pname.removeprefix("GL_"))
    if text is None:
        return None
    last = function.parameters[-1].name
    parameter = read_parameter(f"{last}:{text}", type_=function.type)
    integers = bool(function.type) and not TYPES[function.type][0].startswith("float")
    if integers and parameter.kind == "float":
        parameter = replace(parameter, kind="int")
    if function.vector and parameter.kind != "vector":
        parameter = replace(parameter, count=1)
    return parameter


@functools.cache
def scalar_pnames(group: str) -> tuple[str, ...]:
    """Return the pnames of a group whose value is one number: all that glFogf and glFogi accept."""
    values = {f"GL_{name}": text for name, text in BY_PNAME[group].items()}
    return tuple(name for name, text in values.items() if not text.startswith("vector"))
