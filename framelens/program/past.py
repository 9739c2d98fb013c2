"""The time before a frame: which call set each variable last, and how the first frame began.

A tape holds the calls of one frame. Who asks why it looks as it does needs the lines that set what
the frame begins with, made frames ago; and what the very first picture began with, to tell what
leaks from one frame into the next.
"""

import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from framelens.gl.seam import Call, GluCall, Site
from framelens.program.program_run import Chain, EarlyCall, Showing, Window, chain
from framelens.spec.spec import sets
from framelens.state.state import State

MODES = {0x1700: "GL_MODELVIEW", 0x1701: "GL_PROJECTION", 0x1702: "GL_TEXTURE"}
MATRIX = (
    *("glLoad", "glMult", "glRotate", "glTranslate", "glScale", "glOrtho", "glFrustum"),
    *("glPushMatrix", "glPopMatrix"),
)
UNIT0 = 0x84C0  # GL_TEXTURE0


class Setters:
    """Which call set each variable last, by the names of framelens/state/state.py.

    Follows the matrix mode and the texture unit, which decide what other calls set.
    """

    def __init__(self) -> None:
        self.last: dict[str, Call] = {}
        self.chained: dict[str, list[Call]] = {}  # a matrix: the calls since it was loaded
        self._stacks: dict[str, list[tuple[Call | None, list[Call]]]] = {}
        self._known: dict[str, object] = {
            "GL_MATRIX_MODE": "GL_MODELVIEW",
            "GL_ACTIVE_TEXTURE": "GL_TEXTURE0",
            "GL_CLIENT_ACTIVE_TEXTURE": "GL_TEXTURE0",
            "GL_COLOR_MATERIAL": False,
            "GL_COLOR_MATERIAL_FACE": "GL_FRONT_AND_BACK",
            "GL_COLOR_MATERIAL_PARAMETER": "GL_AMBIENT_AND_DIFFUSE",
        }
        self._silent: set[str] = set()  # names of calls that set nothing

    @property
    def matrix(self) -> str:
        """The name of the current matrix."""
        mode = self._known["GL_MATRIX_MODE"]
        if mode == "GL_TEXTURE":
            return f"{self._known['GL_ACTIVE_TEXTURE']}.GL_TEXTURE_MATRIX"
        return f"{mode}_MATRIX"

    def follow(self, call: Call) -> None:
        """Take note of a call, with what a display list of it executes."""
        if call.skipped:
            return
        for inner in call.listed:
            self.follow(inner)
        name = call.name
        if name in self._silent:
            return
        if name.startswith(MATRIX):
            self._multiplied(call)
            return
        if name == "glMatrixMode":
            self._known["GL_MATRIX_MODE"] = MODES.get(int(call.args[0]), "GL_MODELVIEW")
        elif name in ("glActiveTexture", "glClientActiveTexture"):
            unit = f"GL_TEXTURE{int(call.args[0]) - UNIT0}"
            client = name != "glActiveTexture"
            self._known["GL_CLIENT_ACTIVE_TEXTURE" if client else "GL_ACTIVE_TEXTURE"] = unit
        elif name == "glColorMaterial":
            self._known["GL_COLOR_MATERIAL_FACE"] = getattr(call.args[0], "name", "")
            self._known["GL_COLOR_MATERIAL_PARAMETER"] = getattr(call.args[1], "name", "")

        try:
            names = sets(name, call.args, self._known)
        except (KeyError, TypeError, ValueError, IndexError):
            return

        if not names:
            self._silent.add(name)
        for variable in names:
            self.last[variable] = call
            if variable == "GL_COLOR_MATERIAL":
                self._known["GL_COLOR_MATERIAL"] = name == "glEnable"

    def _multiplied(self, call: Call) -> None:
        matrix = self.matrix
        stack = self._stacks.setdefault(matrix, [])
        chain = self.chained.setdefault(matrix, [])
        if call.name == "glPushMatrix":
            stack.append((self.last.get(matrix), list(chain)))
            return
        if call.name == "glPopMatrix":
            if stack:
                last, self.chained[matrix] = stack.pop()
                if last is not None:
                    self.last[matrix] = last
            return
        if call.name.startswith("glLoad"):
            self.chained[matrix] = [call]
        else:
            chain.append(call)
        self.last[matrix] = call

    def copied(self) -> "Setters":
        """Return a copy, which follows other calls."""
        other = Setters()
        other.last = dict(self.last)
        other.chained = {name: list(calls) for name, calls in self.chained.items()}
        other._stacks = {name: list(calls) for name, calls in self._stacks.items()}
        other._known = dict(self._known)
        other._silent = self._silent
        return other

    def forget(self, most: int) -> None:
        """Keep at most so many calls of each matrix, the last ones."""
        for calls in self.chained.values():
            del calls[: max(len(calls) - most, 0)]


@dataclass
class Past:
    """The past of a program's frame, and how the program shows the frame.

    ``setters`` are those when the frame begins; ``first`` is the state in which the first frame
    began to draw, ``now`` that of this frame. ``chains`` has the lines that led to each call of the
    frame that draws or changes a matrix, by its number. ``glu`` are the calls of GLU in the setup
    and in the frame. ``early`` were made without a context. ``error`` is what the program raised
    in the frame, if it did.
    """

    window: Window
    showing: Showing
    frame: int
    source: str
    setters: Setters
    first: State
    now: State
    chains: Mapping[int, Chain]
    glu: Sequence[GluCall]
    early: Sequence[EarlyCall] = ()
    pixels: Mapping[bytes, tuple[str, Site]] = field(default_factory=dict)
    previous: Sequence[Call] = ()
    error: BaseException | None = None


def chains_of(
    path: str, draws: Callable[[str], bool]
) -> tuple[dict[int, Chain], Callable[[Call], None]]:
    """Return a dictionary, and what fills it if a recorder tells it of each call in advance."""
    found: dict[int, Chain] = {}

    def before(call: Call) -> None:
        if draws(call.name) or call.name.startswith(MATRIX) or call.name == "glCallList":
            found[call.number] = chain(sys._getframe(2), path)

    return found, before


def followed(calls: Iterable[Call]) -> Setters:
    """Return what set each variable last, after these calls."""
    setters = Setters()
    for call in calls:
        setters.follow(call)
    return setters
