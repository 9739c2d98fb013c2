"""A frame of a program, as the commands look into it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TextIO, TypeVar

from framelens.program.program_tape import on_frame
from framelens.tape.edit_files import read
from framelens.tape.edits import Edits
from framelens.tape.tape import Tape
from framelens.tape.target import untold

T = TypeVar("T")


@dataclass(frozen=True)
class ProgramFrame:
    """A frame of a program, named by the program's path; a :class:`framelens.tape.target.Target`.

    ``frame``, ``events``, ``limit`` (in seconds), ``arguments`` and ``stdin`` are as of
    :func:`framelens.program.program_tape.on_frame`. ``edits`` is a file of edits. ``tell`` is
    called with lines for the user: edits that changed nothing, and what the window would show.
    """

    name: str
    backend: str = "auto"
    edits: Path | None = None
    frame: int = 0
    events: Path | Sequence[Mapping[str, object]] | None = None
    arguments: Sequence[str] = ()
    stdin: TextIO | None = None
    limit: float | None = None
    tell: Callable[[Sequence[str]], object] = untold

    @property
    def is_program(self) -> bool:
        """True."""
        return True

    def look(self, use: Callable[[Tape], T], past: bool = False) -> T:
        """Run the program and return what ``use`` makes of the frame's tape, in its context.

        See :class:`framelens.tape.target.Target`. InputError and NoOpenGLError as on_frame raises.
        """
        edits = Edits(read(self.edits, Path(self.name).resolve().parent)) if self.edits else None

        def look(tape: Tape) -> T:
            self.tell(tape.notices)
            if edits is not None:
                self.tell(edits.missed())
            return use(tape)

        return on_frame(
            self.name,
            look,
            frame=self.frame,
            events=self.events,
            edits=edits,
            backend=self.backend,
            limit=self.limit,
            arguments=self.arguments,
            stdin=self.stdin,
            past=past,
        )

    def following(self) -> "ProgramFrame":
        """Return the program's next frame, without lines for the user."""
        return replace(self, frame=self.frame + 1, tell=untold)

    def check_element(self, name: str) -> None:
        """Accept any name: which elements a program has shows when it has drawn."""
