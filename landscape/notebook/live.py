"""A walk in a cell of a notebook: the window's code, without a screen, in a process beside it.

The process draws a frame for each that the page asks for, after what the user did meanwhile. All of
the walk is there: its keys, doors, list of settings, and the inspector over the picture. It goes on
while the pointer is over it. The file of the notebook keeps a picture as well.
"""

import base64
from multiprocessing import Pipe
from multiprocessing.context import SpawnProcess

import numpy as np

from framelens.base.errors import InputError, NoOpenGLError
from framelens.base.executor import companion
from framelens.base.installation import how_to_add
from framelens.base.output import png
from landscape.notebook.walking import Event, serve
from landscape.walk.recording import Plan

try:
    from jupyter_rfb import RemoteFrameBuffer
except ImportError:
    raise InputError(
        "live: a walk in a cell needs the Python package jupyter_rfb: {command}",
        command=how_to_add("jupyter_rfb", extra="notebook"),
    ) from None

PATIENCE = 60.0  # chosen: seconds in which the process opens the scene, or draws a frame
MOTIONS = 200  # chosen: events that wait for a frame before motions of the pointer are dropped


class LiveWalk(RemoteFrameBuffer):  # type: ignore[misc]
    """A walk that a notebook shows live; ``close()`` ends it."""

    _event_compatibility = 2  # "type", not "event_type"

    def __init__(self, plan: Plan, backend: str = "auto") -> None:
        """Open the scene in a process of its own; InputError, NoOpenGLError."""
        self._pipe, theirs = Pipe()
        self._coming: list[Event] = []
        self._busy = False
        self._process: SpawnProcess | None = companion(serve, theirs, plan, backend)
        theirs.close()
        self._frame = self._next()
        width, height = plan.size
        super().__init__(css_width=f"{width}px", css_height=f"{height}px")
        self.resizable = True

    def get_frame(self) -> np.ndarray:
        """Return the next frame, uint8 (h, w, 3), after what the user did; ask for another one."""
        self._frame = self._next()
        if self._busy:
            self.request_draw()
        return self._frame

    def handle_event(self, event: Event) -> None:
        """Note what the user did."""
        kind = event["type"]
        if kind == "close":
            self._end()
            return
        if kind in ("pointer_enter", "pointer_down", "key_down"):
            self._busy = True
        elif kind == "pointer_leave":
            self._busy = False
        if kind != "pointer_move" or len(self._coming) < MOTIONS:
            self._coming.append(event)
        self.request_draw()

    def _next(self) -> np.ndarray:
        """Return the frame that the process draws next; once it has ended, the last one."""
        if self._process is None:
            return self._frame
        coming, self._coming = self._coming, []
        try:
            self._pipe.send(coming)
            answer = self._pipe.recv() if self._pipe.poll(PATIENCE) else None
        except (EOFError, OSError):
            answer = None
        if isinstance(answer, np.ndarray):
            return answer
        self._end()
        if isinstance(answer, Exception):
            raise answer
        raise NoOpenGLError("the process of the walk has ended: run the cell again")

    def _end(self) -> None:
        if self._process is not None:
            self._pipe.close()
            self._process.join(1.0)
            self._process.kill()
            self._process = None

    def _repr_mimebundle_(self, **options: object) -> object:
        found = super()._repr_mimebundle_(**options)
        data, metadata = found if isinstance(found, tuple) else (found or {}, {})
        return {**data, "image/png": _png(self._frame)}, metadata


def _png(frame: np.ndarray) -> str:
    return base64.b64encode(png(frame, small=True)).decode()
