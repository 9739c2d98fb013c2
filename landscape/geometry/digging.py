"""Digging and building, for scenes made of blocks. No OpenGL."""

from collections.abc import Callable, Hashable
from pathlib import Path
from typing import Protocol, runtime_checkable

import numpy as np

from framelens.base.input import read_bounded
from landscape.frame import Pose
from landscape.geometry.bodies import Body

TOOLS = ("dig", "place", "pick")
"""What a walker does with the block in his cross-hair: takes it out, puts another one to it, or
chooses its kind, to place such blocks from then on."""

MOST_BYTES = 192 << 20  # chosen: what a file of a world may have


def read_world(path: Path) -> bytes:
    """Return the content of a file of changed blocks; InputError if it cannot be read."""
    return read_bounded(path, MOST_BYTES, f"world {path}")


@runtime_checkable
class Diggable(Protocol):
    """An open scene in which a walker digs and builds; it need not be one.

    ``changes`` counts the blocks that were changed.
    """

    changes: int

    @property
    def is_changed(self) -> bool:
        """Whether any block is not as it was at the beginning."""

    def use(self, tool: str, pose: Pose, body: Body | None) -> str:
        """Use one of TOOLS at ``pose``; return why that is impossible, in English, or "".

        Nothing is placed in the walker's ``body``, which is in units.
        """

    def choose(self, slot: int) -> None:
        """Choose the kind of block in a slot of the bar: 0 to 8, and on from the first again."""

    @property
    def slot(self) -> int:
        """The chosen slot."""

    def bar(self, height: int, language: str) -> tuple[Hashable, Callable[[], np.ndarray]]:
        """Return what the picture of the bar depends on, and how to make it, uint8 (h, w, 4).

        It is for a window ``height`` pixels high.
        """

    def covered(self, size: tuple[int, int]) -> int:
        """Return how many rows at the lower edge of a window of ``size`` pixels show something.

        That is something of the scene's own, which no message should hide.
        """

    def saved(self) -> bytes:
        """Return the changed blocks, and on what land, as the content of a file."""

    def restore(self, data: bytes, name: str) -> None:
        """Change blocks as a file's content says; ``name`` stands for the file in messages.

        InputError, changing nothing, if it is not such a file or belongs to another land.
        """

    def merged(self, base: bytes, theirs: bytes, name: str) -> bytes:
        """Return what :meth:`saved` does, with the changes from ``base`` to ``theirs`` as well.

        InputError if ``theirs`` is no such file or belongs to another land, or if both have changed
        the same blocks.
        """
