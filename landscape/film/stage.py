"""Where a film's pictures are drawn: one context, and the scenes that are open in it.

The context is opened when the first scene is, so a film that needs no OpenGL is drawn without it.
"""

from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType

import numpy as np

from landscape.files.assets import Assets
from landscape.film.rig import ONE, drawn_size, picture
from landscape.frame import SEED
from landscape.offscreen import Offscreen
from landscape.scene.scene import SCENES, Moment, OpenScene, SceneSettings, scene

KEPT = 2  # how many scenes are open at once: those of a cross-fade


@dataclass(frozen=True)
class Drawing:
    """How a film is drawn: what all its pictures have in common.

    ``size`` is in pixels; ``scenes`` is the list of scenes, which a worker process would not know
    if it has been added to. ``rig`` says how many cameras there are (rig.py).
    """

    size: tuple[int, int]
    samples: int = 4
    backend: str = "auto"
    assets: Path | None = None
    seed: int = SEED
    scenes: dict[str, str] = field(default_factory=lambda: dict(SCENES))
    rig: str = ONE


class Stage:
    """Opens scenes and draws moments of them; use as ``with Stage(drawing) as stage``."""

    def __init__(self, drawing: Drawing) -> None:
        """Open nothing yet."""
        self.drawing = drawing
        self.size = drawn_size(drawing.rig, drawing.size)
        self.assets = Assets(drawing.assets)
        self._offscreen: Offscreen | None = None
        self._open: dict[object, OpenScene] = {}  # the most recently used last

    @property
    def offscreen(self) -> Offscreen:
        """The context and the target; NoOpenGLError if there is none."""
        if self._offscreen is None:
            drawing = self.drawing
            self._offscreen = Offscreen(self.size, backend=drawing.backend, samples=drawing.samples)
        return self._offscreen

    def scene(self, name: str, values: SceneSettings, shown: tuple[str, ...]) -> OpenScene:
        """Return a scene with these settings and elements, open; it may be closed by later calls.

        InputError if it cannot be opened.
        """
        wanted = name, values, shown
        found = self._open.pop(wanted, None)
        if found is None:
            with self.offscreen.targeted():
                while len(self._open) >= KEPT:
                    self._open.pop(next(iter(self._open))).release()
                found = scene(name).open(values, self.assets, self.drawing.seed, shown)
        self._open[wanted] = found
        return found

    def draw(self, opened: OpenScene, moment: Moment) -> np.ndarray:
        """Return the picture of a moment, uint8 (h, w, 3), top row first."""

        def drawn(each: Moment) -> np.ndarray:
            return self.offscreen.picture(lambda: self.offscreen.send(opened, each))

        drawing, eye = self.drawing, opened.settings.walk.eye
        return picture(drawing.rig, drawing.size, moment, eye, drawn)

    def close(self) -> None:
        """Release the scenes and the context; may be called twice."""
        if self._offscreen is not None:
            with self._offscreen.targeted():
                while self._open:
                    self._open.popitem()[1].release()
            self._offscreen.close()
            self._offscreen = None

    def __enter__(self) -> "Stage":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()
