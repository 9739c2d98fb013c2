"""Which element draws, as the code says it; a recording notes it with each call."""

from contextlib import ContextDecorator

_drawing: list[tuple[str, ...]] = [("frame",)]


class drawing(ContextDecorator):
    """Say which element the block draws: ``with drawing("water"):``, or as a decorator.

    Several names share what is drawn. The innermost block applies; outside all blocks the element
    is "frame".
    """

    def __init__(self, element: str, *others: str) -> None:
        self._elements = (element, *others)

    def __enter__(self) -> None:
        _drawing.append(self._elements)

    def __exit__(self, *_: object) -> None:
        _drawing.pop()


def drawn_now() -> tuple[str, ...]:
    """Return the names that the innermost drawing() block gave.

    A context manager that draws by itself reads them before its own drawing() block, and runs its
    caller's block inside ``drawing(*names)``.
    """
    return _drawing[-1]
