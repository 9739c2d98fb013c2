"""The command line: parse, call, report.

Exit status: 0 done, 1 a check failed, 2 bad input, 3 no usable OpenGL.
"""

import argparse
import contextlib
import io
import json
import os
import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from landscape import keys
from landscape import settings as settings_module
from landscape.errors import InputError, NoOpenGLError
from landscape.frame import Pose
from landscape.island import ELEMENTS, SEED
from landscape.views import VIEWS

MAX_SIDE = 16384  # the largest viewport side of llvmpipe; a context may allow less


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; return its exit status."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        # A file may have a name that the terminal's alphabet lacks.
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        options = _parse(argv)
        status: int = options.run(options)
        print(end="", flush=True)
        return status
    except InputError as error:
        return _fail(error, 2)
    except NoOpenGLError as error:
        return _fail(error, 3)
    except BrokenPipeError:
        # The reader left (head, less): there is nothing more to say.
        _silence_output()
        return 0
    except OSError as error:
        # What is written to a file has its own message: this is standard output on a full disk.
        _silence_output()
        return _fail(f"{error.filename or 'standard output'}: {error.strerror}", 2)
    except MemoryError:
        return _fail("not enough memory: expected a smaller --size or smaller settings", 2)
    except KeyboardInterrupt:
        return _fail("interrupted", 130)


def _fail(reason: object, status: int) -> int:
    if sys.stderr is not None:
        print("landscape:", " ".join(str(reason).splitlines()), file=sys.stderr)
    return status


def _silence_output() -> None:
    """Let what is left of standard output vanish, or the interpreter complains as it ends."""
    with contextlib.suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _parse(argv: Sequence[str] | None) -> argparse.Namespace:
    """Parse the command line; views may stand before, between and after the options."""
    parser = _parser()
    options, rest = parser.parse_known_args(argv)
    if rest:
        # argparse itself takes those before the first option only.
        if "views" not in options or any(word.startswith("-") for word in rest):
            parser.error(f"unrecognized arguments: {' '.join(rest)}")
        options.views = [*options.views, *rest]
    return options


class _Parser(argparse.ArgumentParser):
    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        # What begins so is a value, never an option: a pose may be -1,2,3,0,0.
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def error(self, message: str) -> Any:
        """End in one line, as all bad input does."""
        raise InputError(f"{message} (see `{self.prog} --help`)")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="landscape",
        description="The landscape of the 2006 report, in fixed-function OpenGL.",
        epilog="example: landscape render fig35e --size 1600x900",
    )
    commands = parser.add_subparsers(metavar="COMMAND", required=True, parser_class=_Parser)

    def command(name: str, run: Callable[..., int], help_: str, example: str) -> Any:
        sub = commands.add_parser(
            name, help=help_, description=help_, epilog=f"example: landscape {name} {example}"
        )
        sub.set_defaults(run=run)
        return sub

    walk = command("walk", _walk, "walk the island in a window", "fig35a --fullscreen")
    walk.add_argument("view", nargs="?", default="fig35e", metavar="VIEW", help="where to start")
    walk.add_argument("--size", type=_size, default=(1280, 720), metavar="WxH")
    walk.add_argument("--fullscreen", action="store_true")
    walk.add_argument("--record", type=Path, metavar="FILE", help="write the walk down")
    walk.add_argument("--replay", type=Path, metavar="FILE", help="walk a recorded walk again")
    walk.add_argument("--frames", type=_count, metavar="N", help="end after N frames")
    _common(walk, samples=0)

    render = command("render", _render, "render views to PNG files", "fig35e --out castle.png")
    render.add_argument("views", nargs="*", metavar="VIEW", help="see `landscape views`")
    render.add_argument("--pose", type=_pose, metavar="X,Y,Z,YAW,PITCH", help="Y may be `ground`")
    render.add_argument("--out", type=Path, metavar="FILE.png|DIR", help="default: VIEW.png")
    render.add_argument("--kt", type=_number, metavar="N", help="the animation's counter")
    render.add_argument("--size", type=_size, default=(800, 600), metavar="WxH")
    _common(render, samples=4)

    views = command("views", _views, "list the named views", "--json")
    views.add_argument("--json", action="store_true")

    figures = command("figures", _figures, "make the report's figures", "35 --out figures")
    figures.add_argument("names", nargs="*", metavar="FIG", help="35, fig35a or R6; default: all")
    figures.add_argument("--out", type=Path, default=Path("figures"), metavar="DIR")
    figures.add_argument("--check", action="store_true", help="compare with the kept pictures")
    figures.add_argument("--update", action="store_true", help="renew the kept pictures")
    _common(figures, samples=4)

    trace = command("trace", _trace, "print the OpenGL calls of a frame", "fig35f --element fog")
    trace.add_argument("view", metavar="VIEW")
    trace.add_argument("--element", choices=ELEMENTS, metavar="NAME")
    trace.add_argument("--json", action="store_true")
    _common(trace, samples=0)

    assets = command("assets", _assets, "make, show or fetch assets", "fetch-stanford")
    actions = assets.add_subparsers(metavar="ACTION", required=True, parser_class=_Parser)
    build = actions.add_parser(
        "build",
        help="make assets from code (needs the extra `studio`)",
        epilog="example: landscape assets build water.png --assets mine",
    )
    build.add_argument("names", nargs="*", metavar="NAME", help="file names; default: all")
    build.add_argument("--assets", type=Path, metavar="DIR", help="where to; default: in place")
    build.add_argument("-q", "--quiet", action="store_true")
    build.set_defaults(run=_assets_build)
    check = actions.add_parser(
        "check",
        help="measure every asset: seams, edges, sizes, meshes",
        epilog="example: landscape assets check --assets mine",
    )
    check.add_argument("--assets", type=Path, metavar="DIR", help="your own files, before ours")
    check.add_argument("--json", action="store_true")
    check.set_defaults(run=_assets_check)
    sheet = actions.add_parser(
        "sheet",
        help="one contact sheet of all assets",
        epilog="example: landscape assets sheet --out sheet.png",
    )
    sheet.add_argument("--out", type=Path, default=Path("sheet.png"), metavar="FILE.png")
    sheet.add_argument("--assets", type=Path, metavar="DIR")
    sheet.set_defaults(run=_assets_sheet)
    fetch = actions.add_parser(
        "fetch-stanford",
        help="download the Stanford bunny and dragon",
        description="Download the Stanford bunny and dragon, check them, and say how to use them. "
        "Terms: acknowledge the Stanford Computer Graphics Laboratory; no commercial use without "
        "permission.",
        epilog="example: landscape assets fetch-stanford --out stanford",
    )
    fetch.add_argument("--out", type=Path, default=Path("stanford"), metavar="DIR")
    fetch.add_argument("-q", "--quiet", action="store_true")
    fetch.set_defaults(run=_assets_fetch)

    bench = command(
        "bench", _bench, "measure frames, grass and the start", "fig35a --json out.json"
    )
    bench.add_argument("views", nargs="*", metavar="VIEW", help="default: the nine of figure 35")
    bench.add_argument("--json", type=Path, metavar="FILE", help="write the figures down")
    bench.add_argument("--size", type=_size, default=(800, 600), metavar="WxH")
    _common(bench, samples=0)

    values = command("settings", _settings, "list every setting", "--preset best --json")
    values.add_argument("--json", action="store_true")
    _common(values, samples=0)

    doctor = command("doctor", _doctor, "say which OpenGL backends work here", "--json")
    doctor.add_argument("--json", action="store_true")
    return parser


def _common(parser: argparse.ArgumentParser, samples: int) -> None:
    """Add the options that all drawing commands share."""
    add = parser.add_argument_group("common options").add_argument
    add("--backend", choices=("auto", "osmesa", "egl", "glfw"), default="auto")
    add("--preset", choices=tuple(settings_module.PRESETS), default=None)
    add("--set", action="append", type=_pair, default=[], metavar="KEY=VALUE", dest="changes")
    add("--settings", type=Path, metavar="FILE.toml")
    add("--assets", type=Path, metavar="DIR", help="your own files, before the shipped ones")
    add("--only", type=_elements, default=None, metavar="ELEMENT,...")
    add("--wireframe", action="store_true")
    add("--samples", type=int, choices=(0, 4), default=samples, help="antialiasing")
    add("--seed", type=_count, default=SEED, metavar="N")
    add("-q", "--quiet", action="store_true")


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.lower().partition("x")
    if not (width.isascii() and width.isdigit() and height.isascii() and height.isdigit()):
        raise argparse.ArgumentTypeError(f"{text!r}: expected WxH such as 800x600")
    size = int(width[:9]), int(height[:9])
    if not all(0 < side <= MAX_SIDE for side in size):
        raise argparse.ArgumentTypeError(f"{text!r}: expected from 1x1 to {MAX_SIDE}x{MAX_SIDE}")
    return size


def _count(text: str) -> int:
    if not (text.isascii() and text.isdigit() and len(text) < 19):
        raise argparse.ArgumentTypeError(f"{text!r}: expected a whole number from 0")
    return int(text)


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = float("nan")
    if not abs(number) < 1e9:
        raise argparse.ArgumentTypeError(f"{text!r}: expected a number")
    return number


def _pair(text: str) -> tuple[str, str]:
    key, equals, value = text.partition("=")
    if not equals:
        raise argparse.ArgumentTypeError(f"{text!r}: expected KEY=VALUE such as fog.density=0.05")
    return key.strip(), value.strip()


def _elements(text: str) -> tuple[str, ...]:
    names = tuple(name.strip() for name in text.split(","))
    for name in names:
        if name not in ELEMENTS:
            raise argparse.ArgumentTypeError(f"{name!r}: expected some of {', '.join(ELEMENTS)}")
    return names


def _pose(text: str) -> Pose:
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 5:
        raise argparse.ArgumentTypeError(f"{text!r}: expected X,Y,Z,YAW,PITCH")
    numbers = [float("nan") if part == "ground" else _number(part) for part in parts]
    if any(part == "ground" for k, part in enumerate(parts) if k != 1):
        raise argparse.ArgumentTypeError(f"{text!r}: only Y may be `ground`")
    return Pose(*numbers)


def _changes(options: argparse.Namespace) -> dict[str, Any]:
    """Return the settings of --settings and --set, the latter winning."""
    changes = keys.read_toml(options.settings) if options.settings else {}
    return {**changes, **dict(options.changes)}


def _preset(options: argparse.Namespace, default: str = "best") -> str:
    return options.preset or default


def _check_view(name: str) -> None:
    if name not in VIEWS:
        raise InputError(f"view {name!r}: no such view; `landscape views` lists them all")


def _offscreen_options(options: argparse.Namespace) -> dict[str, Any]:
    return {
        "backend": options.backend,
        "samples": options.samples,
        "assets": options.assets,
        "only": options.only or ELEMENTS,
        "seed": options.seed,
    }


def _walk(options: argparse.Namespace) -> int:
    from landscape.files.assets import Assets
    from landscape.window.app import walk

    _check_view(options.view)
    values = keys.with_settings(settings_module.preset(_preset(options)), _changes(options))
    return walk(
        settings=values,
        assets=Assets(options.assets),
        view=options.view,
        size=options.size,
        fullscreen=options.fullscreen,
        record=options.record,
        replay=options.replay,
        frames=options.frames,
        backend=options.backend,
        only=options.only or ELEMENTS,
        seed=options.seed,
        wireframe=options.wireframe,
        quiet=options.quiet,
    )


def _render(options: argparse.Namespace) -> int:
    from landscape.files.output import output_paths
    from landscape.files.progress import Progress
    from landscape.tools.render_many import render_all

    for name in options.views:
        _check_view(name)
    views: list[tuple[str, str | Pose]] = [(name, name) for name in options.views]
    if options.pose is not None:
        views.append(("pose", options.pose))
    if not views:
        raise InputError("render: expected a VIEW or --pose; `landscape views` lists the views")
    paths = output_paths(options.out, [name for name, _ in views])
    jobs = [(name, view, path) for (name, view), path in zip(views, paths, strict=True)]
    arguments = {
        **{"size": options.size, "preset": _preset(options), "settings": _changes(options)},
        **_offscreen_options(options),
    }
    with Progress(len(jobs), options.quiet) as progress:
        render_all(jobs, arguments, options.kt, options.wireframe, progress.step)
    if not options.quiet:
        for path in paths:
            print(path)
    return 0


def _views(options: argparse.Namespace) -> int:
    from landscape.views import placed_views

    views = placed_views()
    if options.json:
        print(json.dumps(views, indent=1))
    else:
        for entry in views:
            print(f"{entry['name']:8} {VIEWS[entry['name']].shows}")
    return 0


def _figures(options: argparse.Namespace) -> int:
    from landscape.gallery import figures

    # The gallery is kept in the checkout; elsewhere it is looked for in the current folder.
    kept = Path(__file__).resolve().parents[1] / "screenshots"
    if not kept.is_dir():
        kept = Path("screenshots")
    drawing = {**_offscreen_options(options), "settings": _changes(options)}
    if options.update:
        figures.update(options.names, kept, drawing, options.quiet)
        return 0
    if options.check:
        return figures.check(options.names, kept, options.out, drawing, options.quiet)
    for path in figures.make(options.names, options.out, drawing, options.quiet):
        if not options.quiet:
            print(path)
    return 0


def _trace(options: argparse.Namespace) -> int:
    from landscape.tools.trace import as_text, trace_view

    _check_view(options.view)
    # A trace shows the report's own calls unless told otherwise.
    preset = _preset(options, VIEWS[options.view].preset)
    calls = trace_view(
        options.view, preset, _changes(options), options.wireframe, **_offscreen_options(options)
    )
    if options.element:
        calls = [call for call in calls if options.element in call.shared_by]
    if options.json:
        print(json.dumps([call.as_json() for call in calls], indent=1))
    else:
        print("\n".join(as_text(calls)))
    return 0


def _assets(options: argparse.Namespace) -> int:
    return 0


def _assets_build(options: argparse.Namespace) -> int:
    from landscape.studio.build import build

    return build(options.names, options.assets, options.quiet)


def _assets_check(options: argparse.Namespace) -> int:
    from landscape.tools.asset_check import report

    return report(options.assets, options.json)


def _assets_sheet(options: argparse.Namespace) -> int:
    from landscape.files.output import save_png
    from landscape.gallery.sheet import contact_sheet

    save_png(contact_sheet(options.assets), options.out)
    print(options.out)
    return 0


def _assets_fetch(options: argparse.Namespace) -> int:
    from landscape.files.stanford import fetch

    rabbit, dragon = fetch(options.out, quiet=options.quiet)
    print(f"landscape walk --set rabbit.mesh={rabbit} --set dragon.mesh={dragon}")
    return 0


def _bench(options: argparse.Namespace) -> int:
    from landscape.files.output import write_whole
    from landscape.files.progress import Progress
    from landscape.tools import bench

    for name in options.views:
        _check_view(name)
    plan = bench.Plan(
        views=options.views or bench.MAIN_VIEWS,
        size=options.size,
        preset=_preset(options),
        settings=_changes(options),
        wireframe=options.wireframe,
        **_offscreen_options(options),
    )
    with Progress(bench.steps(plan), options.quiet) as progress:
        result = bench.measure(plan, progress.step)
    if options.json is not None:
        write_whole(options.json, (json.dumps(result, indent=1) + "\n").encode())
    if not options.quiet:
        print(bench.report(result))
    return 0


def _settings(options: argparse.Namespace) -> int:
    values = keys.with_settings(settings_module.preset(_preset(options)), _changes(options))
    rows = keys.table(values)
    if options.json:
        print(json.dumps(rows, indent=1))
    else:
        for row in rows:
            value = row["value"]
            shown = ",".join(f"{v:g}" for v in value) if isinstance(value, tuple) else value
            print(f"{row['key']:28} {shown!s:20} {row['unit']} [{row['source']}]")
    return 0


def _doctor(options: argparse.Namespace) -> int:
    from landscape.tools.doctor import examine, report

    found = examine()
    print(json.dumps(found, indent=1) if options.json else report(found))
    return 0 if found["chosen"] else 3
