"""Pictures of the hall with some settings changed; it is opened once for each set of elements.

Of those, the ones used last stay open for the tests that follow.
"""

from typing import Any

import numpy as np
from stage import Stage

from framelens.gl.framebuffer import read_pixels
from framelens.gl.seam import gl
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.hall.hall import SCENE, Hall
from landscape.hall.settings import Settings
from landscape.offscreen import baked_alike
from landscape.scene.scene import Moment, placed
from landscape.settings.declare import with_settings

SIZE = (120, 90)
MOST = 3  # halls that are open at a time


class HallPictures:
    """The halls opened so far, by their elements."""

    def __init__(self, stage: Stage) -> None:
        self.stage = stage
        self.halls: dict[tuple[str, ...], Hall] = {}

    def __call__(
        self,
        where: str | Pose,
        kt: float = 20.0,
        only: tuple[str, ...] = (),
        settings: dict[str, Any] | None = None,
        wireframe: bool = False,
    ) -> np.ndarray:
        """Return the picture of a view or a pose, int16 (h, w, 3), top row first."""
        values = with_settings(SCENE.settings, settings or {})
        only = only or SCENE.elements
        pose = SCENE.views[where].pose if isinstance(where, str) else where

        with self.stage.borrowed():
            hall = self._opened(values, only)
            pose = placed(pose, hall, values.walk.eye)
            hall.draw(Moment(pose, SIZE, kt, wireframe=wireframe))
            gl.glFinish()
            return read_pixels(SIZE).astype(np.int16)

    def _opened(self, values: Settings, only: tuple[str, ...]) -> Hall:
        """Return a hall with these settings, the last of those that are open."""
        hall = self.halls.pop(only, None)
        alike = hall is not None and baked_alike(SCENE, hall.settings, values)
        if hall is None or not alike or not hall.apply(values):
            if hall is not None:
                hall.release()
            elif len(self.halls) == MOST:
                self.halls.pop(next(iter(self.halls))).release()
            hall = Hall(values, Assets(), 0, only)
        hall.shown = set(only)
        self.halls[only] = hall
        return hall

    def release(self) -> None:
        """Release the halls."""
        self.stage.enter()
        while self.halls:
            self.halls.popitem()[1].release()
