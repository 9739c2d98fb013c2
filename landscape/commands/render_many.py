"""Many stills, drawn side by side: a single process keeps only a core and a half busy.

Each worker has one context and one island, like ``landscape render``. A picture does not depend on
the worker that draws it.
"""

import pickle
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from framelens.base.executor import Kept, ahead, in_order, lent_or_own
from framelens.base.output import png, write_whole
from framelens.system.processes import cores
from framelens.tape.edits import Edit, Edits
from landscape.frame import Pose
from landscape.offscreen import Offscreen
from landscape.scene.scene import SCENES

FEWEST = 16  # chosen: with fewer stills, starting another process costs more than it saves

Job = tuple[str, str | Pose, Path]  # name, view, file


@dataclass(frozen=True)
class _Stills:
    """How stills are drawn: what all of them have in common; ``arguments`` are an Offscreen's.

    ``scenes`` is the list of scenes, which a worker would not know if it has been added to.
    """

    arguments: dict[str, Any]
    kt: float | None
    wireframe: bool
    edits: tuple[Edit, ...]
    scenes: dict[str, str]


def render_all(
    jobs: Sequence[Job],
    arguments: Mapping[str, Any],
    kt: float | None,
    wireframe: bool,
    done: Callable[[str], None],
    edits: Sequence[Edit] = (),
    executor: Executor | None = None,
    count: int = 0,
) -> list[str]:
    """Draw and save each job, then call ``done`` with its name; ``arguments`` are an Offscreen's.

    The workers are ``count`` processes of this machine, as many as pay by default, or those of an
    ``executor``.
    ``edits`` are in force in all pictures. Return a line for each that found no call in any.

    After Ctrl-C, or when one job fails, all files on the disk are complete.
    """
    watched = Edits(edits)
    count = count or max(min(cores(), len(jobs) // (FEWEST // 2)), 1)
    stills = _Stills(dict(arguments), kt, wireframe, tuple(edits), dict(SCENES))
    task = partial(draw, pickle.dumps(stills))
    views = [view for _, view, _ in jobs]
    try:
        with (
            lent_or_own(executor, count) as workers,
            closing(in_order(workers, task, views, ahead(count))) as pictures,
        ):
            for (name, _, path), (picture, matched) in zip(jobs, pictures, strict=True):
                write_whole(path, picture)
                watched.found |= matched
                done(name)
    finally:
        _open.close()  # where the executor is one in this process

    return watched.missed()


def draw(packed: bytes, view: str | Pose) -> tuple[bytes, set[int]]:
    """Return a still as a PNG: a task for any executor.

    Return, too, which edits have found their call, in this picture or in an earlier one.
    """
    with _open.opened(packed, lambda: _Opened(pickle.loads(packed))) as opened:
        opened.offscreen.look(view, opened.stills.kt, opened.stills.wireframe)
        return png(opened.offscreen.draw()), opened.edits.found


class _Opened:
    """A context, and the edits that are in force in it."""

    def __init__(self, stills: _Stills) -> None:
        SCENES.update(stills.scenes)
        self.stills = stills
        self.edits = Edits(stills.edits)
        edits = self.edits if stills.edits else None
        self.offscreen = Offscreen(**stills.arguments, edits=edits)

    def close(self) -> None:
        """Release what is open."""
        self.offscreen.close()


_open: Kept[_Opened] = Kept()
