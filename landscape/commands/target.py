"""A frame of a view, as the commands look into it."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

from framelens.base.errors import InputError
from framelens.tape.edit_files import read
from framelens.tape.edits import Edits
from framelens.tape.tape import Tape
from framelens.tape.target import untold
from landscape.frame import SEED
from landscape.offscreen import SIZE, Offscreen
from landscape.scene.scene import find_view

T = TypeVar("T")


@dataclass(frozen=True)
class ViewFrame:
    """A frame of a view, by the view's name; a :class:`framelens.tape.target.Target`.

    ``settings`` to ``seed`` are as of :class:`landscape.offscreen.Offscreen`. ``edits`` is a file
    of edits. ``tell`` is called with lines for the user: settings and edits that changed nothing.
    """

    name: str
    size: tuple[int, int] | None = None
    backend: str = "auto"
    preset: str | None = None
    settings: Mapping[str, object] = field(default_factory=dict)
    only: Iterable[str] | None = None
    assets: Path | None = None
    seed: int = SEED
    wireframe: bool = False
    edits: Path | None = None
    tell: Callable[[Sequence[str]], object] = untold

    @property
    def is_program(self) -> bool:
        """False: it is a view."""
        return False

    def look(self, use: Callable[[Tape], T], past: bool = False) -> T:
        """Draw the frame and return what ``use`` makes of its tape, in its context.

        ``past`` asks for nothing more: each frame of a view is complete. InputError and
        NoOpenGLError as when a view is rendered.
        """
        edits = Edits(read(self.edits, None)) if self.edits else None
        find_view(self.name)

        with (
            Offscreen(
                self.size or SIZE,
                samples=0,
                edits=edits,
                preset=self.preset,
                settings=self.settings,
                backend=self.backend,
                assets=self.assets,
                only=self.only,
                seed=self.seed,
            ) as offscreen,
            offscreen.taped(self.name, wireframe=self.wireframe) as tape,
        ):
            self.tell(tape.notices)
            if edits is not None:
                self.tell(edits.missed())
            return use(tape)

    def following(self) -> None:
        """Return None: a view has no next frame."""

    def check_element(self, name: str) -> None:
        """Raise InputError if the view's scene has no such element."""
        kind, _ = find_view(self.name)
        if name not in (*kind.elements, "frame"):
            raise InputError(
                "--element {name!r}: expected one of {names}, frame",
                name=name,
                names=", ".join(kind.elements),
            )
