"""The command line: parse, call, report.

Exit status: 0 done, 1 a check failed, 2 bad input, 3 no usable OpenGL, 70 a defect of this program.
"""

import argparse
import contextlib
import gc
import io
import json
import os
import sys
from collections.abc import Callable, Sequence
from dataclasses import astuple, replace
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

from landscape import __version__
from landscape.capture.guard import guarded
from landscape.errors import InputError, NoOpenGLError, say_unexpected, short
from landscape.frame import Pose
from landscape.options import parse
from landscape.scene import SCENES, View, find_view, listed_views, scene
from landscape.system import is_closed_pipe
from landscape.system.processes import Ending, ending_tidily
from landscape.tools.given import given_changes, notify, offscreen_options, tell_of_no_effect


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; return its exit status."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        # A file name may have characters that the terminal's encoding lacks.
        sys.stdout.reconfigure(errors="backslashreplace")

    def run(ending: Ending) -> int:
        options = parse(argv, COMMANDS)
        options.own_process, options.ending = argv is None, ending
        status: int = options.run(options)
        return status

    try:
        with ending_tidily() as ending:
            return _reported(partial(run, ending), ending)
    finally:
        if argv is None:
            # Python ends by looking for garbage among all that was imported, which is none.
            gc.freeze()


def _reported(work: Callable[[], int], ending: Ending) -> int:
    """Return the exit status of ``work``, or of the error that it raises, once that is printed.

    A signal may interrupt OpenGL anywhere, as between glBegin and glEnd: what is then put back on
    the way out may fail, and its error hides what the signal raised. That is no defect.
    """
    try:
        status = work()
        print(end="", flush=True)
        return status
    except InputError as error:
        # A program that was looked into and raised an error has a traceback of its own.
        return _fail(error, 2, getattr(error, "details", ""))
    except NoOpenGLError as error:
        return _fail(error, 3)
    except OSError as error:
        if is_closed_pipe(error):
            # The reader (head, less) closed the pipe, so there is nothing more to print.
            _silence_output()
            return 0
        # Errors in writing files have their own messages; this is standard output on a full disk.
        _silence_output()
        return _fail(f"{error.filename or 'standard output'}: {error.strerror}", 2)
    except MemoryError:
        return _fail("not enough memory: expected a smaller --size or smaller settings", 2)
    except KeyboardInterrupt:
        return _fail("interrupted", 130)
    except Exception as error:
        if ending.status == 130:
            return _fail("interrupted", 130)
        return ending.status or say_unexpected(error)


def _fail(reason: object, status: int, details: str = "") -> int:
    if sys.stderr is not None:
        print("landscape:", " ".join(str(reason).splitlines()), file=sys.stderr)
        print(end=details, file=sys.stderr)
    return status


def _silence_output() -> None:
    """Discard what is left of standard output, or the interpreter reports an error at exit."""
    with contextlib.suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _edits(options: argparse.Namespace) -> list[Any]:
    """Return the edits of --edits, none without it."""
    from landscape.capture.edit_files import read

    return read(options.edits) if options.edits else []


WALK_OPTIONS = (
    "size",
    "fullscreen",
    "record",
    "replay",
    "frames",
    "fps",
    "backend",
    "only",
    "seed",
    "wireframe",
    "quiet",
    "edits",
    "world",
    "path",
)


def _walk(options: argparse.Namespace) -> int:
    from landscape.files.assets import Assets
    from landscape.window.command import walk
    from landscape.window.recording import MAX_NUMBER

    kind, named = find_view(options.view or scene().start)
    begin = kind.as_walked(named, options.preset)
    if options.pose is not None:
        if options.path is not None:
            raise InputError("--pose: a walk along --path begins there; expected one of the two")
        if any(number and abs(number) > MAX_NUMBER for number in astuple(options.pose)):
            raise InputError(f"--pose: expected numbers up to {MAX_NUMBER:g}")
        begin = replace(begin, pose=options.pose)
    if options.kt is not None:
        begin = replace(begin, kt=options.kt)
    changes = given_changes(options, kind)
    if options.replay is None:
        only = kind.shown(begin) if options.only is None else options.only
        told = kind.notices(replace(begin, shown=()), options.preset, changes, only, walking=True)
        notify(options, list(told.values()))
    return walk(
        kind,
        begin,
        settings=kind.values(kind.preset_of(begin), begin.settings, changes),
        assets=Assets(options.assets),
        language=options.lang,
        given=changes,
        **{name: getattr(options, name) for name in WALK_OPTIONS},
    )


def _render(options: argparse.Namespace) -> int:
    from landscape.files.output import output_paths
    from landscape.files.progress import Progress
    from landscape.tools.render_many import render_all

    views: list[tuple[str, str | Pose]] = [(name, name) for name in options.views]
    places = [find_view(name) for name in options.views]
    if options.pose is not None:
        views.append(("pose", options.pose))
        places.append((scene(options.scene), View("pose", "", options.pose)))
    if not views:
        raise InputError("render: expected a VIEW or --pose; `landscape views` lists the views")
    paths = output_paths(options.out, [name for name, _ in views])
    jobs = [(name, view, path) for (name, view), path in zip(views, paths, strict=True)]
    changes = given_changes(options, *(kind for kind, _ in places))
    arguments = {"size": options.size, "settings": changes, "place": options.scene}
    arguments |= offscreen_options(options) | {"world": options.world}
    edits = _edits(options)
    with Progress(len(jobs), options.quiet) as progress:
        missed = render_all(jobs, arguments, options.kt, options.wireframe, progress.step, edits)
    notify(options, missed)
    tell_of_no_effect(options, places, changes)
    if not options.quiet:
        print("\n".join(map(str, paths)))
    return 0


def _views(options: argparse.Namespace) -> int:
    views = listed_views()
    if options.json:
        print(json.dumps(views, indent=1))
    else:
        from landscape.languages import choose, translator

        _ = translator(choose(os.environ), "gallery", "fixes")
        wide = max(len(view["name"]) for view in views)
        for view in views:
            shows = _(view["shows"], view["name"])
            print(f"{view['name']:{wide}} {view['scene']:6} {view['preset']:4} {shows}")
    return 0


def _figures(options: argparse.Namespace) -> int:
    from landscape.gallery import figures

    # The gallery is part of the checkout; without one, look in the current folder.
    kept = Path(__file__).resolve().parents[1] / "screenshots"
    if not kept.is_dir():
        kept = Path("screenshots")
    drawing = {
        **offscreen_options(options),
        "settings": given_changes(options, *map(scene, SCENES)),
    }
    del drawing["preset"]
    if options.update:
        figures.update(options.names, kept, drawing, options.quiet)
        return 0
    if options.check:
        if not kept.is_dir():
            raise InputError(
                "figures --check: the committed pictures are not installed with the program: "
                "expected a checkout, or its folder screenshots in the current folder"
            )
        return figures.check(options.names, kept, options.out, drawing, options.quiet)
    for path in figures.make(options.names, options.out, drawing, options.quiet):
        if not options.quiet:
            print(path)
    return 0


def _frame(name: str) -> Callable[[argparse.Namespace], int]:
    """Return the function of a command that looks into a frame."""

    def run(options: argparse.Namespace) -> int:
        from landscape.languages import choose
        from landscape.tools import frame_commands
        from landscape.tools.target import Target

        if "lang" in options:
            options.lang = options.lang or choose(os.environ)
        other = getattr(options, "diff", None) if name == "trace" else None
        kinds = [] if options.target.endswith(".py") else [find_view(options.target)[0]]
        target = Target(
            options.target,
            size=options.size,
            backend=options.backend,
            preset=options.preset,
            settings=given_changes(options, *kinds),
            only=options.only,
            assets=options.assets,
            seed=options.seed,
            wireframe=options.wireframe,
            edits=options.edits,
            frame=options.frame,
            events=options.events,
            arguments=options.arguments,
            stdin=_own_input(options),
            limit=options.limit,
            tell=partial(notify, options),
        )
        work = partial(frame_commands.RUN[name], target, options)
        programs = [path for path in (options.target, other) if path and path.endswith(".py")]
        return _guarded(" and ".join(programs), work, options) if programs else work()

    return run


def _guarded(programs: str, work: Callable[[], int], options: argparse.Namespace) -> int:
    """Do the work on programs in a process of its own, unless this one is somebody else's."""
    if not options.own_process:
        return work()
    return guarded(programs, lambda: _reported(work, options.ending))


def _own_input(options: argparse.Namespace) -> Any:
    """Return standard input, for a program that reads it; None if it is somebody else's."""
    return sys.stdin if options.own_process else None


def _inspect(options: argparse.Namespace) -> int:
    from landscape.window.program_inspector import inspect

    if not options.target.endswith(".py"):
        walk = "in `landscape walk`, I opens the inspector"
        raise InputError(f"{short(options.target)}: expected the path of a .py program; {walk}")

    def work() -> int:
        given, stdin = options.arguments, _own_input(options)
        notify(options, inspect(options.target, options.edits, options.lang, given, stdin))
        return 0

    return _guarded(options.target, work, options)


def _of(module: str, function: str = "run") -> Callable[[argparse.Namespace], int]:
    """Return the function of a command that another module has; it is imported when it runs."""

    def run(options: argparse.Namespace) -> int:
        status: int = getattr(import_module(f"landscape.{module}"), function)(options)
        return status

    return run


def _flyover(options: argparse.Namespace) -> int:
    from landscape.tools.flyover_command import run

    return run(
        options,
        watch=lambda *given: import_module("landscape.window.flyover").show(*given),
        film=lambda *given: import_module("landscape.film.flyover_film").run(*given),
        version=__version__,
    )


def _assets_build(options: argparse.Namespace) -> int:
    from landscape.studio.build import build

    return build(options.names, options.assets, options.quiet)


def _assets_check(options: argparse.Namespace) -> int:
    from landscape.tools.asset_check import report

    return report(options.assets, options.json)


def _assets_sheet(options: argparse.Namespace) -> int:
    from landscape.files.output import output_paths, save_png
    from landscape.gallery.sheet import contact_sheet

    (path,) = output_paths(options.out, ["sheet"])
    save_png(contact_sheet(options.assets), path)
    print(path)
    return 0


def _assets_fetch(options: argparse.Namespace) -> int:
    from landscape.files.stanford import fetch

    rabbit, dragon = fetch(options.out, quiet=options.quiet)
    print(f"landscape walk --set rabbit.mesh={rabbit} --set dragon.mesh={dragon}")
    return 0


def _settings(options: argparse.Namespace) -> int:
    from landscape.tools.settings_list import as_text, rows

    found = rows(options.preset, given_changes(options, *map(scene, SCENES)), options.word)
    print(json.dumps(found, indent=1) if options.json else "\n".join(as_text(found)))
    return 0


def _doctor(options: argparse.Namespace) -> int:
    from landscape.tools.doctor import examine, report

    found = examine()
    print(json.dumps(found, indent=1) if options.json else report(found))
    return 0 if found["chosen"] else 3


COMMANDS: dict[str, Callable[[argparse.Namespace], int]] = {
    "walk": _walk,
    "render": _render,
    "views": _views,
    "figures": _figures,
    "trace": _frame("trace"),
    "pixel": _frame("pixel"),
    "state": _frame("state"),
    "strip": _frame("strip"),
    "why": _frame("why"),
    "inspect": _inspect,
    "lesson": _of("course.lesson_command"),
    "lecture": _of("course.lecture_command"),
    "flyover": _flyover,
    "assets build": _assets_build,
    "assets check": _assets_check,
    "assets sheet": _assets_sheet,
    "assets fetch-stanford": _assets_fetch,
    "exercise list": _of("course.exercise_commands", "list_"),
    "exercise start": _of("course.exercise_commands", "start_"),
    "exercise check": _of("course.exercise_commands", "check"),
    "places": _of("tools.places_command"),
    "bench": _of("tools.bench_command"),
    "film": _of("film.command"),
    "settings": _settings,
    "doctor": _doctor,
}
