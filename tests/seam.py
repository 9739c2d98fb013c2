"""A stand-in for edits: the simplest thing that changes calls at the seam."""

from typing import Any

from framelens.gl.seam import Listing


class Replaced:
    """An edit of the simplest kind: every call of a name gets other arguments, or is left out."""

    def __init__(self, name: str, args: tuple[Any, ...] | None) -> None:
        self._name, self._args = name, args

    def begin(self) -> None: ...

    def begin_list(self, listing: Listing) -> None: ...

    def end_list(self) -> None: ...

    def change(self, name: str, args: tuple[Any, ...], *_: Any) -> tuple[Any, ...] | None:
        return self._args if name == self._name else args
