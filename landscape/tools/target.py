"""What the tools look into: a frame of a view, or of any PyOpenGL program."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TextIO, TypeVar

from landscape.capture.edit_files import read
from landscape.capture.edits import Edits
from landscape.capture.program_tape import on_frame
from landscape.capture.tape import Tape
from landscape.errors import InputError, short
from landscape.render import SIZE, Offscreen
from landscape.scene import SEED, find_view

T = TypeVar("T")


@dataclass(frozen=True)
class Target:
    """A frame to look into: a view's name with what it is drawn with, or the path of a program.

    ``settings`` to ``seed`` are as of :class:`landscape.render.Offscreen`, for views; ``frame``,
    ``events``, ``arguments`` and ``stdin`` are for programs, as is ``limit``, in seconds: see
    capture/program.py. ``edits`` is a file of edits. ``tell`` is called with lines for the user:
    settings and edits that changed nothing.
    """

    name: str
    size: tuple[int, int] | None = None
    backend: str = "auto"
    preset: str | None = None
    settings: Mapping[str, Any] = field(default_factory=dict)
    only: Iterable[str] | None = None
    assets: Path | None = None
    seed: int = SEED
    wireframe: bool = False
    edits: Path | None = None
    frame: int = 0
    events: Path | None = None
    arguments: Sequence[str] = ()
    stdin: TextIO | None = None
    limit: float | None = None
    tell: Callable[[Sequence[str]], object] = lambda lines: None

    @property
    def is_program(self) -> bool:
        """Whether the name is the path of a program."""
        return self.name.endswith(".py")

    def look(self, use: Callable[[Tape], T], past: bool = False) -> T:
        """Draw the frame and return what ``use`` makes of its tape, in its context.

        ``past``: a program's tape says what came before the frame, too, and the frame may be one in
        which it raises an error.
        InputError and NoOpenGLError as when a view is rendered.
        """
        edits = None
        if self.edits:
            folder = Path(self.name).resolve().parent if self.is_program else None
            edits = Edits(read(self.edits, folder))

        def look(tape: Tape) -> T:
            self.tell(tape.notices)
            if edits is not None:
                self.tell(edits.missed())
            return use(tape)

        if self.is_program:
            self._check_program()
            return on_frame(
                self.name,
                look,
                self.frame,
                self.events,
                edits,
                self.backend,
                self.limit,
                self.arguments,
                self.stdin,
                past,
            )
        find_view(self.name)
        for what, value in (
            ("--frame", self.frame),
            ("--events", self.events),
            ("--limit", self.limit),
            ("--", self.arguments),
        ):
            if value:
                raise InputError(f"{what}: it is for programs; {short(self.name)} is a view")
        options: dict[str, Any] = {
            "preset": self.preset,
            "settings": self.settings,
            "backend": self.backend,
            "assets": self.assets,
            "only": self.only,
            "seed": self.seed,
        }
        with Offscreen(self.size or SIZE, samples=0, edits=edits, **options) as offscreen:
            with offscreen.taped(self.name, wireframe=self.wireframe) as tape:
                return look(tape)

    def _check_program(self) -> None:
        """Raise InputError for what only views can be drawn with."""
        given = {
            "--preset": self.preset,
            "--set or --settings": self.settings,
            "--only": self.only,
            "--assets": self.assets,
            "--wireframe": self.wireframe,
        }
        if self.size is not None:
            raise InputError(
                f"--size: it is for views; the window of the program {short(self.name)} has the "
                "size that the program gives it"
            )
        for option, value in given.items():
            if value:
                raise InputError(f"{option}: it is for views; {short(self.name)} is a program")


def place_of(tape: Tape, text: str) -> str:
    """Return the place of a call that a user gave by its number, or by an element's name.

    "+12" counts from the frame's beginning, as the inspector of the walk does. An element means
    the first of its calls in the frame. InputError if there is none.
    """
    if text[:1].isdigit():
        return text
    first, point, rest = text[1:].partition(".")
    if text[:1] == "+" and first.isascii() and first.isdigit():
        return f"{tape.begin + int(first[:20])}{point}{rest}"
    named = [call for call in tape.frame if text in call.shared_by]
    if not named:
        elements = dict.fromkeys(name for call in tape.frame for name in call.shared_by)
        raise InputError(
            f"{short(text)}: expected a call's number or an element of the frame: "
            f"{', '.join(elements)}"
        )
    return str(named[0].number)
