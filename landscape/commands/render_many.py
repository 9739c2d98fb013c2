"""Many stills, drawn by several processes: a single one keeps only a core and a half busy.

Each process has one context and one island, like ``landscape render``. A picture does not depend on
the process that draws it.
"""

import multiprocessing
import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any

from framelens.base.errors import InputError
from framelens.base.output import save_png
from framelens.system import starting_workers
from framelens.system.processes import begin_worker
from framelens.tape.edits import Edit, Edits
from landscape.frame import Pose
from landscape.offscreen import Offscreen
from landscape.scene.scene import SCENES

FEWEST = 16  # chosen: with fewer stills, starting another process costs more than it saves
MOST_PROCESSES = 4  # chosen: llvmpipe's own threads keep the other cores busy

Job = tuple[str, str | Pose, Path]  # name, view, file
_offscreen: Offscreen | None = None
_edits = Edits()


def render_all(
    jobs: Sequence[Job],
    arguments: Mapping[str, Any],
    kt: float | None,
    wireframe: bool,
    done: Callable[[str], None],
    edits: Sequence[Edit] = (),
) -> list[str]:
    """Draw and save each job, then call ``done`` with its name; ``arguments`` are an Offscreen's.

    ``edits`` are in force in all pictures. Return a line for each that found no call in any.

    After Ctrl-C, or when one job fails, jobs that have begun are finished and no more are started,
    so all files on the disk are complete.
    """
    count = min(os.cpu_count() or 1, MOST_PROCESSES, len(jobs) // (FEWEST // 2))
    watched = Edits(edits)
    if count < 2:
        with Offscreen(**arguments, edits=watched if edits else None) as offscreen:
            for name, view, path in jobs:
                offscreen.look(view, kt, wireframe)
                save_png(offscreen.draw(), path)
                done(name)
        return watched.missed()

    # Spawned, not forked: a fork of a process that has used OpenGL may hang.
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(count, spawn, _prepare, (dict(SCENES),)) as pool:
        with starting_workers():
            names = {
                pool.submit(_draw, dict(arguments), view, kt, wireframe, path, edits): name
                for name, view, path in jobs
            }
        try:
            for drawn in as_completed(names):
                watched.found |= drawn.result()
                done(names[drawn])
        except BrokenProcessPool:
            raise InputError("render: a process was killed (perhaps out of memory)") from None
        finally:
            pool.shutdown(cancel_futures=True)

    return watched.missed()


def _prepare(scenes: Mapping[str, str]) -> None:
    """Begin a worker process, with its parent's list of scenes."""
    begin_worker()
    SCENES.update(scenes)


def _draw(
    arguments: dict[str, Any],
    view: str | Pose,
    kt: float | None,
    wireframe: bool,
    path: Path,
    edits: Sequence[Edit],
) -> set[int]:
    """Draw one picture in a process of the pool; the first one opens its context.

    Return which edits have found their call, in this picture or in an earlier one.
    """
    global _offscreen, _edits
    if _offscreen is None:
        _edits = Edits(edits)
        _offscreen = Offscreen(**arguments, edits=_edits if edits else None)
    _offscreen.look(view, kt, wireframe)
    save_png(_offscreen.draw(), path)
    return _edits.found
