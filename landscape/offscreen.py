"""Stills: a scene drawn without a screen."""

import logging
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from operator import attrgetter
from typing import TypeAlias, TypedDict, Unpack

import numpy as np
from PIL import Image

from framelens.base import arguments
from framelens.base.errors import InputError, short
from framelens.gl.framebuffer import Target, still_target
from framelens.gl.ownership import OwnedContext
from framelens.gl.seam import Edits, edited, gl, recording, unnoted
from framelens.state import state
from framelens.tape.tape import Tape
from landscape.files.assets import Assets
from landscape.frame import SEED, Pose, checked_pose
from landscape.geometry.digging import Diggable, read_world
from landscape.scene.lens import Lens
from landscape.scene.scene import (
    SCENES,
    Moment,
    OpenScene,
    Scene,
    SceneSettings,
    View,
    check_options,
    find_view,
    placed,
    raised,
    scene,
)
from landscape.settings import declare

SIZE = (800, 600)  # chosen
# A view's name, or x, y, z and perhaps yaw and pitch; y may be "ground" or None.
Place: TypeAlias = str | Pose | tuple[object, ...] | list[object] | np.ndarray
Built = tuple[str, tuple[str, ...], SceneSettings]  # a scene's name, elements and settings


class Offscreen:
    """A context, a target and scenes drawn into it; use as ``with Offscreen(...) as view``.

    ``size`` is in pixels; ``preset`` is "best", "2006" or None for each view's own; ``settings``
    maps dotted keys to values, or groups to mappings; ``backend`` is "auto", "osmesa", "egl" or
    "glfw"; ``samples`` is 0 or 4; ``only`` names elements, None means all; ``seed`` is a whole
    number; ``edits`` change single OpenGL calls; ``place`` is the scene that a pose is in, by name;
    ``world`` is a file of changed blocks, as a walk in voxel saves it.
    The attribute ``scene`` is what is drawn, once there is one; ``notices`` has a line for each of
    the ``settings`` that changes nothing there, or whose key has another name now.

    Several may be open at once, each used in the thread that opened it; one thread draws at a time.
    The memory of one that is dropped without :meth:`close` is freed when the next is opened or used
    there. Every method raises InputError for bad input, for use in another thread and after
    :meth:`close`; opening raises NoOpenGLError where no backend works.
    """

    # Until __init__ is called, which that of a class derived from this may forget.
    _owned: OwnedContext | None = None
    _target: Target | None = None
    _lens: Lens | None = None
    _place: Scene | None = None
    scene: OpenScene | None = None

    def __init__(
        self,
        size: tuple[int, int] = SIZE,
        preset: str | None = None,
        settings: Mapping[str, object] | None = None,
        backend: str = "auto",
        samples: int = 4,
        assets: str | os.PathLike[str] | None = None,
        only: str | Iterable[str] | None = None,
        seed: int = SEED,
        edits: Edits | None = None,
        place: str = "",
        world: str | os.PathLike[str] | None = None,
    ) -> None:
        self.notices: list[str] = []
        self._built_for: Built | None = None
        self.size = arguments.size(size)
        self._preset = preset
        self._given: Mapping[str, object] = {} if settings is None else declare.flattened(settings)
        self._only = None if only is None else arguments.names(only, "only")
        check_options(preset, self._given, self._only)
        self._place = scene(arguments.choice(place, "place", ("", *SCENES)))
        self._seed = arguments.whole(seed, "seed")
        if edits is not None and not isinstance(edits, Edits):
            raise InputError(
                "edits {value}: expected an Edits of framelens.tape.edits", value=short(edits)
            )
        self._edits = edits
        self._world = None if world is None else arguments.folder(world, "world")
        self._changed = b"" if self._world is None else read_world(self._world)
        samples = arguments.choice(samples, "samples", arguments.SAMPLES)
        backend = arguments.choice(backend, "backend", arguments.BACKENDS)
        self._assets = Assets(None if assets is None else arguments.folder(assets, "assets"))
        self.moment = Moment(Pose(20.0, 1.0, 20.0), self.size)
        self._lens = Lens(self.size)
        self._owned = OwnedContext(self, backend)

        try:
            with self._current():
                self._target = still_target(self._owned.context, self.size, samples)
        except BaseException:
            self.close()
            raise

    def look(self, view: Place, kt: float | None = None, wireframe: bool = False) -> None:
        """Move to a named view, with its switches, or to a pose (x, y, z, yaw, pitch).

        A pose is in the scene ``place``, by default the first; yaw and pitch may be left out, and
        its y may be "ground" or None: eye height above the ground. ``kt`` is the view's own by
        default.
        """
        kind, named = found(view, self._place)
        kt = named.kt if kt is None else arguments.number(kt, "kt")
        wireframe = arguments.flag(wireframe, "wireframe") or named.wireframe
        with self._current():
            opened = self._open(kind, named)
            pose = placed(named.pose, opened, opened.settings.walk.eye)
            if isinstance(view, str):
                pose = raised(pose, opened, opened.settings.walk.eye)
        self.moment = Moment(pose, self.size, kt, stroke=named.stroke, wireframe=wireframe)

    def _open(self, kind: Scene, view: View) -> OpenScene:
        """Open the scene as the view needs it, unless that one is already open."""
        preset = kind.preset_of(view) if self._preset is None else self._preset
        values = kind.values(preset, view.settings, self._given)
        shown = kind.shown(view, self._only, values)
        wanted = kind.name, shown, values
        if self.scene is None or self._built_for != wanted:
            if not self._applied(kind, shown, values):
                self._build(kind, shown, values, view)
            self._built_for = wanted
            vain = kind.notices(view, preset, self._given, self._only)
            self.notices = [*declare.current_names(values, self._given)[1], *vain.values()]
        assert self.scene is not None
        return self.scene

    def _build(
        self, kind: Scene, shown: tuple[str, ...], values: SceneSettings, view: View
    ) -> None:
        """Open a scene in place of the one that is open."""
        if self.scene is not None:
            self.scene.release()
        self.scene, self._built_for = None, None
        if self._world is not None and not kind.blocks:
            raise InputError(
                "world {world}: expected views of voxel, found {name}",
                world=self._world,
                name=view.name,
            )
        self.scene = kind.open(values, self._assets, self._seed, shown)
        if self._world is not None and isinstance(self.scene, Diggable):
            self.scene.restore(self._changed, f"world {self._world}")

    def _applied(self, kind: Scene, shown: tuple[str, ...], values: SceneSettings) -> bool:
        """Apply settings to the open scene; return False if it must be opened again for them."""
        # Edits find a call by its number among all those that build the scene.
        if self.scene is None or self._built_for is None or self._edits is not None:
            return False
        name, built, before = self._built_for
        if (name, built) != (kind.name, shown) or not baked_alike(kind, before, values):
            return False
        return self.scene.apply(values)

    def draw(self, kt: float | None = None) -> np.ndarray:
        """Draw a frame at ``kt`` (the view's own by default): uint8 (h, w, 3), top row first."""
        return self.picture(lambda: self.submit(kt))

    def submit(self, kt: float | None = None) -> None:
        """Send the frame's calls to OpenGL, without reading the picture back."""
        moment = self.moment if kt is None else replace(self.moment, kt=arguments.number(kt, "kt"))
        with self._current():
            opened = self.scene or self._open(self._place or scene(), View("pose", "", moment.pose))
            self.send(opened, moment)

    def send(self, opened: OpenScene, moment: Moment) -> None:
        """Send a moment of a scene that is open in this context, seen through its camera's lens.

        Edits find a call by its number in a frame that is drawn once, from the lens's middle.
        """
        assert self._lens is not None
        if self._edits is None:
            self._lens.draw(moment, opened.settings.camera, opened.draw)
        else:
            opened.draw(moment)

    @contextmanager
    def taped(
        self, view: Place, kt: float | None = None, wireframe: bool = False
    ) -> Iterator[Tape]:
        """Record a frame of a view whole; in the block its picture and its context are at hand.

        The scene is built anew, so that the recording has all its calls. It is seen from the middle
        of the lens: a recording of a frame from each of its points would take gigabytes.
        """
        with self._current():
            assert self._target is not None
            if self.scene is not None:
                self.scene.release()
            self.scene, self._built_for = None, None
            with recording(complete=True) as recorder:
                self.look(view, kt, wireframe)
                with unnoted():
                    self._target.bind()
                    start = state.read()
                begin = len(recorder.calls)
                assert self.scene is not None
                self.scene.draw(self.moment)

            with unnoted():
                yield Tape(recorder.calls, begin, start, self.size, self.notices)

    @contextmanager
    def targeted(self) -> Iterator[None]:
        """Let the block's own OpenGL calls draw to this target."""
        with self._current():
            assert self._target is not None
            self._target.bind()
            yield

    def picture(self, draw: Callable[[], None]) -> np.ndarray:
        """Return what the OpenGL calls of ``draw`` draw: uint8 (h, w, 3), top row first."""
        with self.targeted():
            draw()
            assert self._target is not None
            return self._target.read()

    @contextmanager
    def _current(self) -> Iterator[None]:
        """Make the context current for the block: another may have been used meanwhile."""
        if self._owned is None:
            raise InputError("this Offscreen is closed: open another one")
        with self._owned.current(), edited(self._edits):
            yield

    @property
    def renderer(self) -> str:
        """The OpenGL that draws: renderer and version."""
        with self._current():
            names = (gl.GL_RENDERER, gl.GL_VERSION)
            return " | ".join(gl.glGetString(name).decode() for name in names)

    def close(self) -> None:
        """Release the scene, the target and the context, in this order; may be called twice.

        In another thread the context is only marked: it is destroyed later, in its own thread.
        """
        owned, parts = self._owned, (self.scene, self._target, self._lens)
        if owned is not None:
            if owned.here:
                with owned.current():
                    for part in parts:
                        if part is not None:
                            part.release()
            owned.release()
        self.scene = self._target = self._owned = None

    def __enter__(self) -> "Offscreen":
        with self._current():
            return self

    def __exit__(self, *_: object) -> None:
        self.close()


def baked_alike(kind: Scene, one: object, other: object) -> bool:
    """Return whether settings of a scene agree in all that is baked into it when it is opened."""
    return all(attrgetter(name)(one) == attrgetter(name)(other) for name in kind.baked)


def found(view: object, place: Scene | None = None) -> tuple[Scene, View]:
    """Return a named view and its scene, or a pose as a view of a scene, by default the first.

    InputError if it is neither.
    """
    if isinstance(view, str):
        return find_view(view)
    if isinstance(view, (Pose, tuple, list, np.ndarray)):
        return place or scene(), View("pose", "", checked_pose(view))
    raise InputError(
        "view {view}: expected a view's name or a pose (x, y, z, yaw, pitch)", view=short(view)
    )


class Options(TypedDict, total=False):
    """The options of Offscreen, but for its size."""

    preset: str | None
    settings: Mapping[str, object] | None
    backend: str
    samples: int
    assets: str | os.PathLike[str] | None
    only: str | Iterable[str] | None
    seed: int
    edits: Edits | None
    place: str
    world: str | os.PathLike[str] | None


def render(
    view: Place,
    size: tuple[int, int] = SIZE,
    kt: float | None = None,
    wireframe: bool = False,
    **options: Unpack[Options],
) -> Image.Image:
    """Draw one view, by name or pose, and return it as a PIL image; options as of Offscreen.

    The logger "landscape" gets the notices as warnings.
    """
    found(view)  # a wrong one is refused before anything is opened
    with Offscreen(size, **options) as offscreen:
        offscreen.look(view, kt, wireframe)
        for line in offscreen.notices:
            logging.getLogger("landscape").warning(line)
        return Image.fromarray(offscreen.draw())
