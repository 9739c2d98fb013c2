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

from landscape.errors import InputError
from landscape.files.output import save_png
from landscape.files.processes import begin_worker, interrupts_held
from landscape.frame import Pose
from landscape.render import Offscreen
from landscape.scene import SCENES

FEWEST = 16  # chosen: with fewer stills, starting another process costs more than it saves
MOST_PROCESSES = 4  # chosen: llvmpipe's own threads keep the other cores busy

Job = tuple[str, str | Pose, Path]  # name, view, file
_offscreen: Offscreen | None = None


def render_all(
    jobs: Sequence[Job],
    arguments: Mapping[str, Any],
    kt: float | None,
    wireframe: bool,
    done: Callable[[str], None],
) -> None:
    """Draw and save each job, then call ``done`` with its name; ``arguments`` are an Offscreen's.

    After Ctrl-C, or when one job fails, jobs that have begun are finished and no more are started,
    so all files on the disk are complete.
    """
    count = min(os.cpu_count() or 1, MOST_PROCESSES, len(jobs) // (FEWEST // 2))
    if count < 2:
        with Offscreen(**arguments) as offscreen:
            for name, view, path in jobs:
                offscreen.look(view, kt, wireframe)
                save_png(offscreen.draw(), path)
                done(name)
        return
    # Spawned, not forked: a fork of a process that has used OpenGL may hang.
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(count, spawn, _prepare, (dict(SCENES),)) as pool:
        with interrupts_held():
            names = {
                pool.submit(_draw, dict(arguments), view, kt, wireframe, path): name
                for name, view, path in jobs
            }
        try:
            for drawn in as_completed(names):
                drawn.result()
                done(names[drawn])
        except BrokenProcessPool:
            raise InputError("render: a process was killed (perhaps out of memory)") from None
        finally:
            pool.shutdown(cancel_futures=True)


def _prepare(scenes: Mapping[str, str]) -> None:
    """Begin a worker process, with its parent's list of scenes."""
    begin_worker()
    SCENES.update(scenes)


def _draw(
    arguments: dict[str, Any], view: str | Pose, kt: float | None, wireframe: bool, path: Path
) -> None:
    """Draw one picture in a process of the pool; the first one opens its context."""
    global _offscreen
    if _offscreen is None:
        _offscreen = Offscreen(**arguments)
    _offscreen.look(view, kt, wireframe)
    save_png(_offscreen.draw(), path)
