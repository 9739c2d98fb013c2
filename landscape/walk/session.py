"""The command `landscape walk`: from its options to a plan, a recording and a window."""

import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from framelens.base.errors import InputError
from framelens.base.texts import choose
from framelens.gl.contexts.glfw import HEADLESS, GLFWContext
from framelens.gl.glfw_library import glfw
from framelens.tape.edit_files import read as read_edits
from landscape.files.assets import Assets, recording
from landscape.frame import SEED
from landscape.scene.scene import Scene, SceneSettings, View, scene
from landscape.settings import declare
from landscape.walk import words
from landscape.walk.app import Walk
from landscape.walk.builder import WorldFile
from landscape.walk.landmarks import Found
from landscape.walk.landmarks_list import Teller, nothing_told
from landscape.walk.loop import run
from landscape.walk.opening import SIZE
from landscape.walk.pace import FPS
from landscape.walk.preferences import Preferences
from landscape.walk.recording import Plan, Tick, Writer, read
from landscape.walk.speaker import Speaker, is_installed
from landscape.walk.title import TO_TITLE
from landscape.walk.waiting import Left

if TYPE_CHECKING:
    from landscape.flyover.environment import Environment


def walk(
    kind: Scene,
    begin: View,
    settings: SceneSettings,
    assets: Assets,
    size: tuple[int, int] | None = None,
    fullscreen: bool = False,
    record: Path | None = None,
    replay: Path | None = None,
    frames: int | None = None,
    backend: str = "auto",
    only: Iterable[str] | None = None,
    seed: int = SEED,
    wireframe: bool = False,
    given: Mapping[str, object] | None = None,
    quiet: bool = False,
    language: str = "",
    fps: float = FPS,
    edits: Path | None = None,
    world: Path | None = None,
    path: str | None = None,
    preferences: Preferences | None = None,
    context: GLFWContext | None = None,
    titled: bool = False,
    found: Found | None = None,
    tells: Teller = nothing_told,
) -> int:
    """Walk a scene in a window until the user leaves; return the exit status.

    From the view ``begin`` come the pose, kt, the wireframe and, without ``only``, the elements.
    :meth:`Scene.as_walked` makes one of a named view. A replay takes everything except ``assets``,
    ``backend``, ``fullscreen`` and ``frames`` from its file, and its sizes too unless ``size`` is
    given. Without ``size`` a live walk has SIZE, enlarged on a display of high resolution. It draws
    less detail where that keeps ``fps`` frames per second; 0 draws everything, as a replay does.
    ``language`` is "en" or "fr"; without it the environment chooses, or a replay its file.
    ``edits`` is a file of edits to OpenGL calls, ``world`` one of changed blocks, which a replay
    only reads; a recording does not contain what is in them. ``path`` is an SVG file, or the name
    of an environment of the fly-over, along whose path the walk begins; it cannot be recorded.
    ``given`` are the settings among ``settings`` that the user has set: they go with him through
    doors. ``preferences`` are the user's keys, mouse and comfort, None without them; a replay takes
    the keys alone. ``found`` are the landmarks that have been found, ``tells`` has the texts of
    their lessons. A walk that is recorded begins with none found, so that a recording is the same
    for everybody. ``context`` is the window if it is open already. With ``titled`` it is the
    title's: it stays open, and TO_TITLE is returned if the user wants back. Raises InputError and
    NoOpenGLError.
    """
    _check(backend, frames, record, replay, path)
    environment = _environment(path, quiet) if path is not None else None
    ticks = None
    if replay is not None:
        plan, ticks = _recorded(replay, size, language)
        preferences = Preferences(keys=preferences.keys) if preferences is not None else None
    else:
        only = kind.shown(begin, only) if only is None else kind.only(only)
        plan = _plan(kind, begin, settings, size, seed, tuple(only), wireframe, language, given)

    changes = read_edits(edits) if edits is not None else []
    kept_world = _world(world, plan.scene, ticks is None) if world is not None else None
    writer = Writer(record, plan) if record is not None else None
    try:
        kept_rate = fps if ticks is None else 0.0
        enlarged = size is None and replay is None
        if preferences is not None and replay is None:
            fullscreen = fullscreen or preferences.fullscreen
        options = backend, fullscreen, kept_rate, enlarged, changes
        # Who asks for a number of frames does not listen.
        listens = frames is None and backend not in HEADLESS
        live = ticks is None and listens and backend != "headless"
        with Walk(
            plan,
            assets,
            *options,
            context=context,
            world=kept_world,
            preferences=preferences,
            speaker=Speaker if listens and is_installed() else None,
            titled=titled,
            keeps=live,
            found=(Found() if record is not None or found is None else found) if live else None,
            tells=tells,
        ) as opened:
            course = None
            if environment is not None:
                from landscape.walk.course import Course

                course = Course(environment, opened.place.scene, settings, plan.language)
            run(opened, ticks, writer, frames, course)
        if not quiet:
            _report(opened, plan.language)
    except Left:
        closed = not titled or context is None or glfw.window_should_close(context.window)
        return 0 if closed else TO_TITLE
    finally:
        # After Ctrl-C or an error, the recording up to then shows what led to it.
        kept = writer is not None and writer.finish()

    if kept and not quiet:
        print(record)
        if changes:
            print("landscape:", words.text(plan.language, "inspector.record"), file=sys.stderr)

    return TO_TITLE if opened.to_title else 0


def _check(
    backend: str, frames: int | None, record: Path | None, replay: Path | None, path: str | None
) -> None:
    """Raise InputError for options that do not go together."""
    if backend == "cgl":
        raise InputError("--backend cgl: it opens no window; expected auto, glfw or software")
    if backend in HEADLESS and frames is None and replay is None:
        raise InputError(
            "--backend {backend}: no window to leave by; expected --frames as well", backend=backend
        )
    if path is not None and (record is not None or replay is not None):
        raise InputError("--path: a flight is not recorded; expected no --record and no --replay")


def _environment(path: str, quiet: bool) -> "Environment":
    """Return the environment of the fly-over whose path the walk follows; print its notices."""
    # A walk without a path begins sooner without the fly-over's modules.
    from landscape.flyover.environment import open_environment

    environment = open_environment(path)
    for line in environment.notices if not quiet else ():
        print(f"landscape: {line}", file=sys.stderr)
    return environment


def _plan(
    kind: Scene,
    begin: View,
    settings: SceneSettings,
    size: tuple[int, int] | None,
    seed: int,
    shown: tuple[str, ...],
    wireframe: bool,
    language: str,
    given: Mapping[str, object] | None,
) -> Plan:
    """Return the plan of a live walk, which shows the elements ``shown``."""
    return Plan(
        scene=kind.name,
        settings=settings,
        view=begin.name,
        pose=begin.pose,
        size=size or SIZE,
        kt=begin.kt,
        seed=seed,
        only=shown,
        wireframe=wireframe or begin.wireframe,
        language=language or choose(os.environ),
        preset=kind.preset_of(begin),
        given=_checked(settings, given or {}),
    )


def _recorded(
    replay: Path, size: tuple[int, int] | None, language: str
) -> tuple[Plan, Iterator[Tick]]:
    """Return the plan and the frames of a recording, in another size or language if given."""
    plan, ticks = read(recording(replay))
    plan = replace(plan, language=language or plan.language)
    if size is not None:
        plan = replace(plan, size=size)
        ticks = [replace(tick, size=size) for tick in ticks]
    return plan, iter(ticks)


def _world(world: Path, name: str, keep: bool) -> WorldFile:
    """Return the file of changed blocks of the scene ``name``; InputError if that has no blocks."""
    if not scene(name).blocks:
        raise InputError(
            "world {world}: expected a view of a scene of blocks, such as voxel", world=world
        )
    return WorldFile(world, keep=keep)


def _report(opened: Walk, language: str) -> None:
    """Print what was asked for and could not be had: the window's size, edits of calls."""
    if opened.resizer.refused:
        wanted, got = ("{}x{}".format(*size) for size in opened.resizer.refused)
        told = words.text(language, "resized", wanted=wanted, given=got)
        print("landscape:", told, file=sys.stderr)
    for line in opened.inspection.missed():
        print(f"landscape: {line}", file=sys.stderr)


def _checked(settings: object, given: Mapping[str, object]) -> dict[str, declare.Value]:
    """Return the values that the keys which were given have in settings, under their names now."""
    return {key: declare.get(settings, key) for key in declare.current_names(settings, given)[0]}
