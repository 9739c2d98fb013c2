"""Stills: a scene drawn without a screen."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import astuple, replace
from numbers import Real
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from landscape.errors import InputError
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.gl.calls import gl
from landscape.gl.context import Context, open_context
from landscape.gl.framebuffer import Framebuffer
from landscape.scene import (
    SEED,
    Moment,
    OpenScene,
    Scene,
    View,
    check_options,
    find_view,
    placed,
    scene,
)

SIZE = (800, 600)  # chosen
Place = str | Pose | tuple[Any, ...]


class Offscreen:
    """A context, a target and scenes drawn into it; use as ``with Offscreen(...) as view``.

    ``size`` is in pixels; ``preset`` is "best", "2006" or None for each view's own; ``settings``
    maps dotted keys to values; ``backend`` is "auto", "osmesa", "egl" or "glfw"; ``samples`` is 0
    or 4; ``only`` names elements, None means all. ``scene`` is what is drawn, once there is one.
    Raises InputError for bad input and NoOpenGLError where no backend works.
    """

    def __init__(
        self,
        size: tuple[int, int] = SIZE,
        preset: str | None = None,
        settings: Mapping[str, Any] | None = None,
        backend: str = "auto",
        samples: int = 4,
        assets: str | Path | None = None,
        only: Iterable[str] | None = None,
        seed: int = SEED,
    ) -> None:
        self.size = size
        self._preset, self._given = preset, dict(settings or {})
        self._only = None if only is None else tuple(only)
        check_options(preset, self._given, self._only)
        self._seed = seed
        self._assets = Assets(Path(assets) if assets is not None else None)
        self._context: Context | None = open_context(backend)
        self._target: Framebuffer | None = None
        self.scene: OpenScene | None = None
        self._built_for: Any = None
        self.moment = Moment(Pose(20.0, 1.0, 20.0), size)
        try:
            self._target = Framebuffer(size, samples)
        except BaseException:
            self.close()
            raise

    def look(self, view: Place, kt: float | None = None, wireframe: bool = False) -> None:
        """Move to a named view, with its switches, or to a pose (x, y, z, yaw, pitch).

        A pose is in the first scene; its y may be None: eye height above the ground.
        """
        if isinstance(view, str):
            kind, named = find_view(view)
        else:
            kind, named = scene(), View("pose", "", checked_pose(view))
        opened = self._open(kind, named)
        self.moment = Moment(
            placed(named.pose, opened, opened.settings.walk.eye),
            self.size,
            named.kt if kt is None else kt,
            stroke=named.stroke,
            wireframe=wireframe or named.wireframe,
        )

    def _open(self, kind: Scene, view: View) -> OpenScene:
        """Open the scene as the view needs it, unless that one is already open."""
        preset = self._preset or kind.preset_of(view)
        values = kind.values(preset, view.settings, self._given)
        wanted = (kind.name, values, kind.shown(view, self._only))
        if self.scene is None or self._built_for != wanted:
            self._enter()
            if self.scene is not None:
                self.scene.release()
            self.scene, self._built_for = None, None
            self.scene = kind.open(values, self._assets, self._seed, wanted[2])
            self._built_for = wanted
        return self.scene

    def draw(self, kt: float | None = None) -> np.ndarray:
        """Draw a frame at ``kt`` (the view's own by default): uint8 (h, w, 3), top row first."""
        if self._target is None:
            raise RuntimeError("this Offscreen is closed")
        if self.scene is None:
            self._open(scene(), View("pose", "", self.moment.pose))
        self._enter()
        self._target.bind()
        self.submit(kt)
        return self._target.read()

    def submit(self, kt: float | None = None) -> None:
        """Send the frame's calls to OpenGL, without reading the picture back."""
        assert self.scene is not None
        self.scene.draw(self.moment if kt is None else replace(self.moment, kt=kt))

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
        """Release the scene, the target and the context, in this order; may be called twice."""
        if self._context is not None:
            self._enter()
        for owner in (self.scene, self._target, self._context):
            if owner is not None:
                owner.release()
        self.scene = self._target = self._context = None

    def __enter__(self) -> "Offscreen":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def checked_pose(pose: Pose | tuple[Any, ...]) -> Pose:
    """Return a pose of finite numbers, its y perhaps None; InputError if it is not one."""
    given = astuple(pose) if isinstance(pose, Pose) else tuple(pose)
    numbers = [value for k, value in enumerate(given) if not (k == 1 and value is None)]
    real = all(isinstance(value, Real) and math.isfinite(value) for value in numbers)
    if not 3 <= len(given) <= 5 or not real:
        raise InputError(
            f"pose {given}: expected the numbers x, y, z, yaw and pitch; y may be None"
        )
    return Pose(*given)


def render(
    view: Place,
    size: tuple[int, int] = SIZE,
    kt: float | None = None,
    **options: Any,
) -> Image.Image:
    """Draw one view, by name or pose, and return it as a PIL image; options as of Offscreen."""
    with Offscreen(size, **options) as offscreen:
        offscreen.look(view, kt)
        return Image.fromarray(offscreen.draw())
