"""Stills: an island drawn with no screen."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from landscape import keys
from landscape import settings as settings_module
from landscape.errors import InputError
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.gl.calls import gl
from landscape.gl.context import Context, open_context
from landscape.gl.framebuffer import Framebuffer
from landscape.island import ELEMENTS, SEED, Island, Moment
from landscape.views import VIEWS, View

SIZE = (800, 600)  # chosen


class Offscreen:
    """A context, a target and islands drawn into it; use as ``with Offscreen(...) as view``.

    ``size`` is in pixels; ``preset`` "best" or "2006"; ``settings`` dotted keys to values;
    ``backend`` "auto", "osmesa", "egl" or "glfw"; ``samples`` 0 or 4; ``only`` names of elements.
    Raises InputError for bad input and NoOpenGLError where no backend works.
    """

    def __init__(
        self,
        size: tuple[int, int] = SIZE,
        preset: str = "best",
        settings: Mapping[str, Any] | None = None,
        backend: str = "auto",
        samples: int = 4,
        assets: str | Path | None = None,
        only: tuple[str, ...] = ELEMENTS,
        seed: int = SEED,
    ) -> None:
        self.size = size
        self._base = settings_module.preset(preset)
        self._given = dict(settings or {})
        keys.with_settings(self._base, self._given)
        self._only, self._seed = only, seed
        self._assets = Assets(Path(assets) if assets is not None else None)
        self._context: Context | None = open_context(backend)
        self._target: Framebuffer | None = None
        self.island: Island | None = None
        self._built_for: Any = None
        self.moment = Moment(Pose(20.0, 1.0, 20.0), size)
        try:
            self._target = Framebuffer(size, samples)
        except BaseException:
            self.close()
            raise

    def look(
        self, view: str | Pose | tuple[float, ...], kt: float | None = None, wireframe: bool = False
    ) -> None:
        """Take a named view's place and switches, or a pose (x, y, z, yaw, pitch)."""
        if isinstance(view, str):
            if view not in VIEWS:
                raise InputError(f"view {view!r}: no such view; `landscape views` lists them all")
            named = VIEWS[view]
        else:
            named = View("pose", "", view if isinstance(view, Pose) else Pose(*view))
        self._build({**named.settings, **self._given}, named.shown)
        assert self.island is not None
        self.moment = Moment(
            named.place(self.island.ground.field, self.island.settings.walk.eye),
            self.size,
            named.kt if kt is None else kt,
            stroke=named.stroke,
            wireframe=wireframe or named.wireframe,
        )

    def _build(self, changes: Mapping[str, Any], shown: tuple[str, ...]) -> None:
        """Build the island these settings ask for, unless it is the one that stands."""
        values = keys.with_settings(self._base, changes)
        only = tuple(e for e in ELEMENTS if e in shown and e in self._only)
        if self._built_for != (values, only):
            self._enter()
            if self.island is not None:
                self.island.release()
            self.island, self._built_for = None, None
            self.island = Island(values, self._assets, self._seed, only)
            self._built_for = (values, only)

    def draw(self, kt: float | None = None) -> np.ndarray:
        """Draw a frame at ``kt`` (the view's own by default): uint8 (h, w, 3), top row first."""
        if self._target is None:
            raise RuntimeError("this Offscreen is closed")
        if self.island is None:
            self._build(self._given, ELEMENTS)
        assert self.island is not None
        moment = self.moment
        if kt is not None:
            moment = Moment(
                moment.pose, moment.size, kt, moment.step, moment.stroke, moment.wireframe
            )
        self._enter()
        self._target.bind()
        self.island.draw(moment)
        return self._target.read()

    def _enter(self) -> None:
        """Make the context current: another Offscreen may have been used meanwhile."""
        assert self._context is not None
        self._context.make_current()

    @property
    def renderer(self) -> str:
        """The OpenGL that draws: renderer and version."""
        names = (gl.GL_RENDERER, gl.GL_VERSION)
        return " | ".join(gl.glGetString(name).decode() for name in names)

    def close(self) -> None:
        """Release the island, the target and the context, in this order; may be called twice."""
        if self._context is not None:
            self._enter()
        for owner in (self.island, self._target, self._context):
            if owner is not None:
                owner.release()
        self.island = self._target = self._context = None

    def __enter__(self) -> "Offscreen":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def render(
    view: str | Pose | tuple[float, ...],
    size: tuple[int, int] = SIZE,
    kt: float | None = None,
    **options: Any,
) -> Image.Image:
    """Draw one view, by name or pose, and return it as a PIL image; options as of Offscreen."""
    with Offscreen(size, **options) as offscreen:
        offscreen.look(view, kt)
        return Image.fromarray(offscreen.draw())
