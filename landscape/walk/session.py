"""The command `landscape walk`: from its options to a plan, a recording and a window."""

import os
import sys
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

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
from landscape.walk.recording import Plan, Writer, read
from landscape.walk.speaker import Speaker, is_installed
from landscape.walk.title import TO_TITLE
from landscape.walk.waiting import Left


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
    if backend == "cgl":
        raise InputError("--backend cgl: it opens no window; expected auto, glfw or software")
    if backend in HEADLESS and frames is None and replay is None:
        raise InputError(
            "--backend {backend}: no window to leave by; expected --frames as well", backend=backend
        )
    if path is not None and (record is not None or replay is not None):
        raise InputError("--path: a flight is not recorded; expected no --record and no --replay")
    environment = None
    if path is not None:
        # A walk without a path begins sooner without the fly-over's modules.
        from landscape.flyover.environment import open_environment

        environment = open_environment(path)
        for line in environment.notices if not quiet else ():
            print(f"landscape: {line}", file=sys.stderr)
    ticks = None
    if replay is not None:
        plan, recorded = read(recording(replay))
        plan = replace(plan, language=language or plan.language)
        preferences = Preferences(keys=preferences.keys) if preferences is not None else None
        if size is not None:
            plan = replace(plan, size=size)
            recorded = [replace(tick, size=size) for tick in recorded]
        ticks = iter(recorded)
    else:
        plan = Plan(
            scene=kind.name,
            settings=settings,
            view=begin.name,
            pose=begin.pose,
            size=size or SIZE,
            kt=begin.kt,
            seed=seed,
            only=kind.shown(begin, only) if only is None else kind.only(only),
            wireframe=wireframe or begin.wireframe,
            language=language or choose(os.environ),
            preset=kind.preset_of(begin),
            given=_checked(settings, given or {}),
        )

    changes = read_edits(edits) if edits is not None else []
    kept_world = None
    if world is not None:
        if not scene(plan.scene).blocks:
            raise InputError(
                "world {world}: expected a view of a scene of blocks, such as voxel", world=world
            )
        kept_world = WorldFile(world, keep=ticks is None)

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
        if opened.resizer.refused and not quiet:
            wanted, got = ("{}x{}".format(*size) for size in opened.resizer.refused)
            told = words.text(plan.language, "resized", wanted=wanted, given=got)
            print("landscape:", told, file=sys.stderr)
        if not quiet:
            for line in opened.inspection.missed():
                print(f"landscape: {line}", file=sys.stderr)
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


def _checked(settings: object, given: Mapping[str, object]) -> dict[str, declare.Value]:
    """Return the values that the keys which were given have in settings, under their names now."""
    return {key: declare.get(settings, key) for key in declare.current_names(settings, given)[0]}
