"""The command line: parse, call, report.

Exit status: 0 done, 1 a check failed, 2 bad input, 3 no usable OpenGL, 70 a defect of this program.
"""

import argparse
import json
import os
from collections.abc import Callable, Sequence
from dataclasses import astuple, replace
from importlib import import_module
from pathlib import Path
from typing import Any

from framelens.base.errors import InputError
from framelens.commands.reporting import run_command
from landscape import __version__
from landscape.commands.changes import given_changes, notify, offscreen_options, tell_of_no_effect
from landscape.commands.common import parse
from landscape.frame import Pose
from landscape.scene.scene import SCENES, View, find_view, listed_views, scene


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; return its exit status."""
    return run_command(argv, lambda words: parse(words, COMMANDS))


def _edits(options: argparse.Namespace) -> list[Any]:
    """Return the edits of --edits, none without it."""
    from framelens.tape.edit_files import read

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
    from landscape.commands.walk import walk
    from landscape.files.assets import Assets
    from landscape.walk.recording import MAX_NUMBER

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
    from framelens.base.output import output_paths
    from framelens.base.progress import Progress
    from landscape.commands.render_many import render_all

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
        from framelens.base.texts import choose, translator

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
        from landscape.commands.frames import look

        return look(name, options)

    return run


def _of(module: str, function: str = "run") -> Callable[[argparse.Namespace], int]:
    """Return the function of a command that another module has; it is imported when it runs."""

    def run(options: argparse.Namespace) -> int:
        status: int = getattr(import_module(f"landscape.{module}"), function)(options)
        return status

    return run


def _flyover(options: argparse.Namespace) -> int:
    from landscape.flyover.app.command import run

    return run(
        options,
        watch=lambda *given: import_module("landscape.flyover.app.window").show(*given),
        film=lambda *given: import_module("landscape.flyover.app.film").run(*given),
        version=__version__,
    )


def _assets_build(options: argparse.Namespace) -> int:
    from landscape.studio.build import build

    return build(options.names, options.assets, options.quiet)


def _assets_check(options: argparse.Namespace) -> int:
    from landscape.studio.asset_check import report

    return report(options.assets, options.json)


def _assets_sheet(options: argparse.Namespace) -> int:
    from framelens.base.output import output_paths, save_png
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
    from landscape.commands.settings_list import as_text, rows

    found = rows(options.preset, given_changes(options, *map(scene, SCENES)), options.word)
    print(json.dumps(found, indent=1) if options.json else "\n".join(as_text(found)))
    return 0


def _doctor(options: argparse.Namespace) -> int:
    from landscape.commands.doctor import examine, report

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
    "inspect": _of("commands.frames", "inspect"),
    "lesson": _of("commands.lesson"),
    "lecture": _of("commands.lecture"),
    "flyover": _flyover,
    "assets build": _assets_build,
    "assets check": _assets_check,
    "assets sheet": _assets_sheet,
    "assets fetch-stanford": _assets_fetch,
    "exercise list": _of("commands.exercise", "list_"),
    "exercise start": _of("commands.exercise", "start_"),
    "exercise check": _of("commands.exercise", "check"),
    "places": _of("commands.places"),
    "bench": _of("commands.bench"),
    "film": _of("commands.film"),
    "settings": _settings,
    "doctor": _doctor,
}
