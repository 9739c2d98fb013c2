"""Pictures of a program's frames, drawn without a screen and with its clock held."""

from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np

from framelens.program.program import LIMIT, run
from framelens.program.program_events import Events
from framelens.program.program_run import Window
from framelens.tape.buffers import Buffers


def pictures(
    path: str | Path,
    frames: Iterable[int],
    events: Events = None,
    backend: str = "auto",
    limit: float = LIMIT,
) -> list[np.ndarray]:
    """Run a program and return the pictures of some of its frames: (h, w, 3) uint8, top row first.

    Raises as :func:`framelens.program.program.run` does.
    """
    watcher = _Watcher(sorted(set(frames)))
    run(path, watcher.last, events, backend=backend, limit=limit, observer=watcher)
    return watcher.pictures


class _Watcher:
    """Observes a program, and reads its picture at the end of chosen frames."""

    def __init__(self, frames: list[int]) -> None:
        self.last = frames[-1]
        self.pictures: list[np.ndarray] = []
        self._frames = set(frames)

    def make(self, name: str, function: Callable[..., object]) -> Callable[..., object]:
        return function

    def opened(self, window: Window) -> None:
        self._size = window.size

    def frame_began(self, number: int) -> None:
        pass

    def frame_ended(self, number: int) -> None:
        if number in self._frames:
            color = Buffers.read(self._size()).color
            self.pictures.append(np.ascontiguousarray(color[::-1, :, :3]))

    def notice(self, text: str) -> None:
        pass
