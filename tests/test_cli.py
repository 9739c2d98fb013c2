"""The command line and the Python interface, as documented."""

import argparse
import ctypes
import json
import math
import os
import re
import signal
import subprocess
import sys
import time
import tomllib
from pathlib import Path
from typing import Any

import pytest
from commands import SECONDS, TESTS, Shell, environment, landscape, python, running
from PIL import Image
from stage import SMALL_BEST

from landscape import __version__, cli
from landscape.cli import build_parser, parse
from landscape.elements import settings
from landscape.files.assets import recording
from landscape.island.fixes import FIXES
from landscape.island.island import ELEMENTS
from landscape.island.views import VIEWS
from landscape.scene.scene import SCENES, listed_views, scene
from landscape.settings import declare

# A key that means the same in several scenes is listed once.
EVERY_KEY = [
    key
    for key, _does in dict.fromkeys(
        (key, item.does)
        for name in SCENES
        for key, item in declare.fields(type(scene(name).settings)).items()
    )
]
NINE = [f"fig35{panel}" for panel in "abcdefghi"]
SMALL = (
    *("--preset", "2006", "--size", "48x36", "--samples", "0", "--only", "ground,water,sky,fog"),
    "--set=ground.texture_size=256",
)
MODULE = [sys.executable, "-m", "landscape"]


@pytest.fixture
def shell(the_shell: Shell, tmp_path: Path) -> Shell:
    the_shell.cwd = tmp_path
    return the_shell


def commands(
    parser: argparse.ArgumentParser, prefix: tuple[str, ...] = ()
) -> list[tuple[str, ...]]:
    """Return every command and subcommand of the parser."""
    found = [prefix]
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for name, sub in action.choices.items():
                found += commands(sub, (*prefix, name))
    return found


ALL = commands(build_parser())


def pictures(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


# --- help --------------------------------------------------------------------------------------


@pytest.mark.sweep(8, first=7)
@pytest.mark.parametrize("command", ALL, ids=" ".join)
def test_every_command_has_help_with_an_example(command: tuple[str, ...], shell: Shell) -> None:
    done = shell(*command, "--help")
    assert done.status == 0 and done.err == ""
    assert done.out.startswith("usage: landscape")
    if command != ("assets",):
        assert "example: landscape " + " ".join(command) in " ".join(done.out.split())


def imported(*words: str) -> set[str]:
    """Return the modules that a fresh Python has imported after a command."""
    code = (
        "import sys\nfrom landscape.cli import main\nmain(sys.argv[1:])\nprint()\n"
        "print(*sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, *words], env=environment(), capture_output=True, text=True
    )
    return set(done.stdout.splitlines()[-1].split())


@pytest.mark.seldom(13, first=8)
def test_a_command_imports_neither_another_one_nor_what_that_needs() -> None:
    modules = imported("settings", "fog")
    assert "landscape.commands.settings" in modules
    assert not modules & {"landscape.commands.views", "landscape.commands.walk", "glfw"}


@pytest.mark.seldom(10, first=1)
def test_a_walk_without_a_path_imports_no_module_of_the_fly_over() -> None:
    words = "walk", "hall", "--only", "floor", "--size", "40x30", "--frames", "1"
    modules = imported(*words, "--backend", "osmesa", "--fresh")
    assert "landscape.walk.loop" in modules
    assert not [name for name in modules if name.startswith("landscape.flyover")]


def test_the_list_of_commands_imports_none_of_them() -> None:
    modules = imported()
    assert "landscape.cli" in modules
    assert not modules & {"numpy", "OpenGL", "landscape.commands.walk", "landscape.scene"}


@pytest.mark.parametrize("words", [(), ("assets",)], ids=["landscape", "assets"])
def test_without_a_command_the_help_is_printed(words: tuple[str, ...], shell: Shell) -> None:
    done = shell(*words)
    assert (done.status, done.err) == (0, "") and done.out == shell(*words, "--help").out


def test_the_version_is_that_of_the_package(shell: Shell) -> None:
    assert shell("--version").out == f"landscape {__version__}\n"


@pytest.mark.parametrize("command", ALL, ids=" ".join)
@pytest.mark.sweep(3)
def test_every_option_has_help_that_names_its_default(command: tuple[str, ...]) -> None:
    parser: Any = build_parser()
    for word in command:
        parser = parser._subparsers._group_actions[0].choices[word]
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            continue
        assert action.help, f"{command}: {action.dest}"
        default = action.default
        if isinstance(default, tuple):
            default = "x".join(map(str, default))
        if default not in (None, False, [], "", argparse.SUPPRESS):
            assert re.search(r"default: %\(default\)|default: " + str(default), action.help), action


@pytest.mark.parametrize("command", ALL, ids=" ".join)
@pytest.mark.sweep(3)
def test_an_empty_text_is_no_path(command: tuple[str, ...]) -> None:
    parser: Any = build_parser()
    for word in command:
        parser = parser._subparsers._group_actions[0].choices[word]
    paths = [each for each in parser._actions if isinstance(each.metavar, str)]
    for action in (each for each in paths if re.search("DIR|FILE", each.metavar) and each.type):
        with pytest.raises(argparse.ArgumentTypeError, match="expected the path of a file or"):
            action.type("")
        assert action.type("a b") == Path("a b"), action.dest


def test_an_option_without_a_path_writes_nothing(shell: Shell, tmp_path: Path) -> None:
    done = shell("film", "fig2a", "--parts", "")
    assert (done.status, done.out, list(tmp_path.iterdir())) == (2, "", [])
    assert done.err.startswith("landscape: argument --parts: '': expected the path of a file")


def test_a_help_text_can_be_expanded_as_soon_as_its_option_is_added(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """From Python 3.14 on, argparse does so itself and raises ValueError if it cannot."""

    def expanded(action: argparse.Action) -> argparse.Action:
        if action.help:
            argparse.HelpFormatter("landscape")._expand_help(action)
        return action

    add, command = argparse._ActionsContainer.add_argument, argparse._SubParsersAction.add_parser

    def add_argument(self: Any, *args: Any, **options: Any) -> argparse.Action:
        return expanded(add(self, *args, **options))

    def add_parser(self: Any, *args: Any, **options: Any) -> argparse.ArgumentParser:
        parser = command(self, *args, **options)
        expanded(self._choices_actions[-1])
        return parser

    monkeypatch.setattr(argparse._ActionsContainer, "add_argument", add_argument)
    monkeypatch.setattr(argparse._SubParsersAction, "add_parser", add_parser)
    build_parser()
    # The check itself: a text that lacks its parameter, and a lone percent sign.
    for text in ("some of %(elements)s", "50% of the elements"):
        parser = argparse.ArgumentParser()
        with pytest.raises((KeyError, TypeError, ValueError)):
            parser.add_argument("--only", help=text)
        with pytest.raises((KeyError, TypeError, ValueError)):
            parser.add_subparsers().add_parser("draw", help=text)


def test_the_help_names_the_elements(shell: Shell) -> None:
    for command, start in (("walk", "draw only some elements of"), ("trace", "one element:")):
        text = " ".join(shell(command, "--help").out.split())
        assert f"{start} {', '.join(ELEMENTS)}" in text


def test_the_tour_is_replayed_by_its_name_from_any_folder(shell: Shell) -> None:
    words = ("walk", "--backend", "osmesa", "--frames", "1", "--replay")
    (shell.cwd / "elsewhere").write_text("no recording")
    done = shell(*words, "elsewhere")
    assert done.status == 2 and "elsewhere:1" in done.err
    (shell.cwd / "tour").write_text("mine")
    done = shell(*words, "tour")
    assert done.status == 2 and done.err.startswith("landscape: tour:1"), "a file comes first"
    (shell.cwd / "tour").unlink()
    assert recording(Path("tour")).is_file() and recording(Path("x/tour")) == Path("x/tour")


def test_the_wheel_contains_the_tour_where_it_is_looked_for() -> None:
    build = tomllib.loads((TESTS.parent / "pyproject.toml").read_text())["tool"]["hatch"]["build"]
    wheel = build["targets"]["wheel"]
    assert "screenshots/tour.jsonl" in wheel["only-include"]
    assert wheel["sources"]["screenshots"] == "landscape/recordings"
    assert (TESTS.parent / "screenshots" / "tour.jsonl").is_file()


def test_the_gallery_s_check_without_its_pictures_says_so(
    shell: Shell, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(shell.cwd)
    monkeypatch.setattr("landscape.__file__", str(shell.cwd / "landscape" / "__init__.py"))
    assert cli.main(["figures", "fig4a", "--check"]) == 2
    told = capsys.readouterr().err
    assert told.startswith("landscape: figures --check: ") and told.count("\n") == 1
    assert not list(shell.cwd.iterdir())


def test_the_documented_commands_exist() -> None:
    names = {" ".join(command) for command in ALL}
    wanted = {"walk", "render", "views", "figures", "trace", "bench", "settings", "doctor"}
    assert "assets check" in names
    assert wanted | {"assets build", "assets sheet", "assets fetch-stanford"} <= names


@pytest.mark.parametrize("command", ["walk", "render", "trace", "settings"])
def test_rendering_commands_share_the_common_options(command: str, shell: Shell) -> None:
    text = shell(command, "--help").out
    for option in ("--backend", "--preset", "--set", "--settings", "--assets", "--only"):
        assert option in text
    for option in ("--wireframe", "--samples", "--seed", "--quiet", "auto", "osmesa", "egl"):
        assert option in text


@pytest.mark.parametrize("command", ["walk", "render", "trace"])
def test_the_example_in_the_help_parses(command: str, shell: Shell) -> None:
    text = " ".join(shell(command, "--help").out.split())
    arguments = text.partition("example: landscape ")[2].split()
    assert arguments[0] == command
    assert parse(arguments).run is not None


# --- JSON output -------------------------------------------------------------------------------


@pytest.mark.seldom(3)
def test_views_json_lists_names_figures_poses_kt_and_presets(shell: Shell) -> None:
    found = shell("views", "--json").json()
    assert isinstance(found, list)
    for entry in found:
        assert set(entry) == {"name", "scene", "figure", "pose", "kt", "preset", "shows"}
        assert len(entry["pose"]) == 5
        assert all(isinstance(v, int | float) and math.isfinite(v) for v in entry["pose"])
        assert isinstance(entry["kt"], int | float)
        assert entry["preset"] in settings.PRESETS
    names = [entry["name"] for entry in found]
    assert len(set(names)) == len(names) and set(NINE) <= set(names)
    assert found[names.index("fig35a")]["figure"] == "35 a"


@pytest.mark.seldom(3, first=1)
def test_views_prints_one_line_per_view(shell: Shell) -> None:
    lines = shell("views").out.splitlines()
    island = [line.split()[0] for line in lines if line.split()[1] == "island"]
    assert island == [*VIEWS, *(fix.name for fix in FIXES)]
    assert [line.split()[0] for line in lines] == [view["name"] for view in listed_views()]


def test_settings_json_lists_key_value_default_unit_and_source(shell: Shell) -> None:
    rows = shell("settings", "--json", "--preset", "2006", "--set", "fog.density=0.05").json()
    assert [row["key"] for row in rows] == EVERY_KEY
    for row in rows:
        assert {"key", "value", "default", "unit", "source"} <= set(row)
    density = next(row for row in rows if row["key"] == "fog.density")
    assert (density["value"], density["default"], density["source"]) == (0.05, 0.12, "section 10.2")


def test_settings_prints_every_key_in_eighty_columns(shell: Shell) -> None:
    lines = shell("settings").out.splitlines()
    assert max(map(len, lines)) <= 80
    heads = [line.split()[0] for line in lines if re.match(r"  \S", line)]
    assert heads == EVERY_KEY


def test_settings_says_value_range_presets_unit_source_and_what_a_key_does(shell: Shell) -> None:
    head, *rest = shell("settings", "fog.density").out.splitlines()[1:]
    assert re.fullmatch(r"  fog\.density +0\.042 per unit +\[section 10\.2\]", head)
    assert [line.strip() for line in rest[:2]] == [
        "how dense it is in the modes exp2 and exp",
        "0 to 1000; 2006: 0.12, best: 0.042; hall: 0.12; voxel: 0.037",
    ]
    needs = " ".join(line.strip() for line in rest[2:])
    assert needs.startswith("needs fog shown or ")
    assert needs.endswith("; fog.enabled on; fog.mode not linear")
    text = shell("settings", "grass.method").out
    assert "cells | loop; 2006: cells, best: cells" in text
    assert "now ignored while grass.tinted is on" in text
    assert "now ignored" not in shell("settings", "grass.method", "--preset", "2006").out


@pytest.mark.parametrize(
    ("word", "wanted"),
    [
        ("fog", [key for key in EVERY_KEY if key.startswith("fog.")]),
        ("densit", ["fog.density", "mist.density"]),
        ("Wash", ["water.foam"]),
        ("", EVERY_KEY),
    ],
)
def test_settings_takes_a_group_part_of_a_key_or_a_word(
    word: str, wanted: list[str], shell: Shell
) -> None:
    assert [row["key"] for row in shell("settings", word, "--json").json()] == wanted


def test_a_setting_that_means_something_else_in_another_scene_is_listed_for_each(
    shell: Shell,
) -> None:
    rows = shell("settings", "shadow.enabled", "--json").json()
    assert [(row["scene"], row["does"]) for row in rows] == [
        ("hall", "the statue casts shadows"),
        ("voxel", "the land is in shadow where the sun does not see it"),
    ]
    horizons = shell("settings", "water.horizon", "--json").json()
    assert {row["scene"] for row in horizons if row["key"] == "water.horizon"} == {
        "island",
        "voxel",
    }
    assert "shadow of voxel: The sun's shadows." in shell("settings", "shadow").out
    times = shell("settings", "time").out
    assert "time of island:" in times and "time of voxel:" in times


@pytest.mark.seldom(14, first=13)
@pytest.mark.parametrize("name", ["shadow", "reflection", "refraction", "water"])
def test_trace_shows_each_pass_of_the_voxel_island(name: str, shell: Shell) -> None:
    few = ("--set=voxel.regions=4", "--size", "64x48")
    calls = shell("trace", "voxel_water", "--pass", name, "--json", *few).json()
    assert calls and {call["pass"] for call in calls} == {name}


def test_settings_of_the_software_flyover_are_listed_by_their_groups(shell: Shell) -> None:
    done = shell("settings", "flyover", "--json", "--set", "flyover.mode=filled")
    by = {row["key"]: row for row in done.json()}
    assert by["flyover.mode"]["value"] == "filled" and by["flyover.mode"]["scene"] == "flyover"
    assert by["flyover.colours"]["presets"] == {"document": "plain", "best": "height"}
    assert "flyover.mode is filled" in by["flyover.hidden_lines"]["ignored"]
    text = shell("settings", "filled", "--preset", "document").out
    assert "filled.clouds" in text and "now ignored while flyover.mode is lines" in text
    wrong = shell("settings", "flyover", "--set", "flyover.mode=walls")
    assert (wrong.status, wrong.out) == (2, "") and "flyover.mode: expected" in wrong.err


def test_settings_refuses_an_unknown_word_with_the_groups(shell: Shell) -> None:
    done = shell("settings", "treacle")
    assert (done.status, done.out) == (2, "") and done.err.count("\n") == 1
    assert done.err.startswith("landscape: settings 'treacle'") and "transparent" in done.err


def test_settings_come_from_the_preset_then_the_file_then_the_command_line(shell: Shell) -> None:
    (shell.cwd / "my settings.toml").write_text("[fog]\ndensity = 0.5\n[grass]\ncount = 7\n")
    arguments = ("--preset", "best", "--settings", "my settings.toml", "--set", "fog.density=0.25")
    rows = {row["key"]: row["value"] for row in shell("settings", "--json", *arguments).json()}
    assert rows["fog.density"] == 0.25 and rows["grass.count"] == 7
    assert rows["ground.resolution"] == settings.BEST["ground.resolution"]
    text = shell("settings", *arguments).out
    assert any(line.split()[:2] == ["fog.density", "0.25"] for line in text.splitlines())


@pytest.mark.seldom(14, first=8)
@pytest.mark.parametrize("view", ["fig35f", "fig6a"])
def test_render_and_trace_take_the_preset_that_views_says(shell: Shell, view: str) -> None:
    entries = {entry["name"]: entry for entry in shell("views", "--json").json()}
    preset = entries[view]["preset"]
    assert (view, preset) in (("fig35f", "best"), ("fig6a", "2006"))
    coarse = [
        f"--set=ground.{key}"
        for key in ("resolution=40", "tiles=2", "texture_size=256", "stones=0")
    ]
    small = ("--only", "ground,fog", "--size", "32x24", "--samples", "0", "--quiet", *coarse)
    pictures = {}
    for name, options in (("own", ()), ("best", ("--preset=best",)), ("2006", ("--preset=2006",))):
        assert shell("render", view, *small, *options, "--out", f"{name}.png").status == 0
        pictures[name] = (shell.cwd / f"{name}.png").read_bytes()
    assert pictures["own"] == pictures[preset] and pictures["best"] != pictures["2006"]
    trace = ("trace", view, "--only", "ground,fog", "--json", *coarse)
    assert shell(*trace).json() == shell(*trace, "--preset", preset).json()


def check_call(call: dict[str, Any]) -> None:
    assert {"name", "args", "element", "source", "pass"} <= set(call)
    assert call["name"].startswith("gl")
    assert call["element"] in {*ELEMENTS, "frame", "sun"}
    assert call["pass"] in ("setup", "reflection", "main", "overlay")
    path, _, line = call["source"].rpartition(":")
    assert path.startswith("landscape/") and path.endswith(".py") and int(line) > 0
    for arg in call["args"]:
        if isinstance(arg, dict):
            assert set(arg) == {"shape", "dtype", "values"}
            assert len(arg["values"]) == min(math.prod(arg["shape"]), 64)
        else:
            assert arg is None or isinstance(arg, str | int | float)
    for inner in call.get("list", []):
        assert call["name"] in ("glCallList", "glCallLists")
        check_call(inner)


def test_trace_json_lists_the_calls_in_order_with_named_constants_and_nested_lists(
    shell: Shell,
) -> None:
    only = ("--preset", "2006", "--only", "ground,water,fog,map")
    calls = shell("trace", "fig35a", *only, "--json").json()
    for call in calls:
        check_call(call)
    assert {"setup", "main"} <= {call["pass"] for call in calls}
    fog = next(c for c in calls if c["name"] == "glFogf" and c["args"][0] == "GL_FOG_DENSITY")
    assert fog["args"] == ["GL_FOG_DENSITY", 0.12] and fog["element"] == "fog"
    assert fog["source"].startswith("landscape/elements/fog.py:")
    ground = next(c for c in calls if c["name"] == "glCallList" and c["element"] == "ground")
    assert "glDrawElements" in [inner["name"] for inner in ground["list"]]
    array = next(a for c in ground["list"] for a in c["args"] if isinstance(a, dict))
    assert array["dtype"] == "float32" and len(array["values"]) == 64


@pytest.mark.seldom(3, first=1)
def test_trace_can_be_limited_to_one_element_and_printed_as_text(shell: Shell) -> None:
    only = ("trace", "fig35a", "--preset=2006", "--only", "sky,fog", "--element", "fog")
    calls = shell(*only, "--json").json()
    assert calls and {call["element"] for call in calls} == {"fog"}
    lines = shell(*only).out.splitlines()
    assert len(lines) == len(calls)
    assert any("glFogi(GL_FOG_MODE, GL_EXP2)" in line for line in lines)


# --- process behaviour -------------------------------------------------------------------------


@pytest.mark.seldom(14, first=2)
def test_the_module_and_the_console_script_do_the_same() -> None:
    script = Path(sys.executable).with_name("landscape")
    if not script.exists():
        pytest.skip("the package is not installed")
    options: dict[str, Any] = {"capture_output": True, "timeout": SECONDS, "env": environment()}
    for arguments in (["settings", "--json"], ["render", "fig99z"]):
        one, two = (subprocess.run([*c, *arguments], **options) for c in (MODULE, [str(script)]))
        assert (one.returncode, one.stdout, one.stderr) == (two.returncode, two.stdout, two.stderr)


def test_bad_input_gives_the_process_status_2_and_one_line() -> None:
    done = landscape("render", "fig99z")
    assert (done.status, done.out) == (2, "")
    assert done.err == "landscape: view 'fig99z': no such view; `landscape views` lists them all\n"


@pytest.mark.seldom(10)
def test_a_closed_pipe_on_standard_output_is_not_an_error() -> None:
    read, write = os.pipe()
    os.close(read)
    with os.fdopen(write, "wb") as stdout:
        done = subprocess.run(
            [*MODULE, "settings", "--json"],
            stdout=stdout,
            stderr=subprocess.PIPE,
            env=environment(),
        )
    assert (done.returncode, done.stderr) == (0, b"")


@pytest.mark.seldom(10)
@pytest.mark.posix_only("it has no device that is full")
def test_a_full_disk_on_standard_output_gives_one_error_line() -> None:
    if not os.path.exists("/dev/full"):
        pytest.skip("there is no /dev/full on this system")
    with open("/dev/full", "wb") as stdout:
        done = subprocess.run(
            [*MODULE, "settings"], stdout=stdout, stderr=subprocess.PIPE, env=environment()
        )
    assert done.returncode == 2
    assert done.stderr == b"landscape: standard output: No space left on device\n"


@pytest.mark.seldom(13, first=1)
@pytest.mark.posix_only("a shell of POSIX closes streams")
def test_closed_standard_streams_are_tolerated(tmp_path: Path) -> None:
    line = f"{sys.executable} -m landscape render fig35a fig35b {' '.join(SMALL)} >&- 2>&-"
    done = subprocess.run(["sh", "-c", line], cwd=tmp_path, env=environment(), timeout=SECONDS)
    assert done.returncode == 0
    assert pictures(tmp_path) == ["fig35a.png", "fig35b.png"]


@pytest.mark.seldom(7)
def test_a_name_that_the_terminal_cannot_encode_is_escaped(tmp_path: Path) -> None:
    env = environment(PYTHONIOENCODING="ascii")
    done = landscape("render", "fig35a", *SMALL, "--out", "é.png", env=env, cwd=tmp_path)
    assert (done.status, done.err) == (0, "")
    assert done.out == "\\xe9.png\n" and pictures(tmp_path) == ["é.png"]


@pytest.mark.seldom(13, first=8)
@pytest.mark.posix_only("nothing sends Ctrl-C to one process alone")
def test_ctrl_c_while_rendering_many_views_leaves_only_complete_files(tmp_path: Path) -> None:
    words = ["render", *NINE, "--preset", "2006", "--size", "640x480", "--out", "many"]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    first = tmp_path / "many" / "fig35a.png"
    with running(*words, cwd=tmp_path, **pipes) as process:
        end = time.monotonic() + SECONDS
        while not first.exists() and process.poll() is None and time.monotonic() < end:
            time.sleep(0.005)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=SECONDS)
    assert (process.returncode, out, err) == (130, "", "landscape: interrupted\n")
    names = pictures(first.parent)
    assert names and set(names) < {f"{name}.png" for name in NINE}
    for name in names:
        with Image.open(first.parent / name) as image:
            image.load()
            assert image.size == (640, 480)


# --- messages ----------------------------------------------------------------------------------


def test_a_run_prints_its_file_names_and_nothing_else(shell: Shell) -> None:
    done = shell("render", "fig35a", "fig35b", *SMALL, *shell.small, "--out", "two views")
    assert (done.status, done.err) == (0, "")
    assert done.out.replace(os.sep, "/") == "two views/fig35a.png\ntwo views/fig35b.png\n"


@pytest.mark.parametrize("quiet", ["-q", "--quiet"])
def test_a_quiet_run_prints_nothing(quiet: str, shell: Shell) -> None:
    done = shell("render", "fig35a", *SMALL, *shell.small, quiet)
    assert (done.status, done.out, done.err) == (0, "", "")
    assert pictures(shell.cwd) == ["fig35a.png"]


@pytest.mark.seldom(13, first=1)
@pytest.mark.posix_only("Python has no pseudo-terminals there")
@pytest.mark.parametrize("quiet", [False, True])
def test_progress_is_shown_on_a_terminal_unless_quiet(quiet: bool, tmp_path: Path) -> None:
    ours, theirs = os.openpty()
    command = [*MODULE, "render", "fig35a", "fig35b", *SMALL, *(["-q"] if quiet else [])]
    done = subprocess.run(
        command, cwd=tmp_path, env=environment(), stdout=subprocess.PIPE, stderr=theirs
    )
    # Write something, because reading would block if nothing else was written.
    os.write(theirs, b"end")
    os.close(theirs)
    shown = os.read(ours, 10_000).decode()
    os.close(ours)
    assert done.returncode == 0
    assert ("2/2 fig35b" in shown) is not quiet
    if quiet:
        assert shown == "end"


# --- rendering ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "only",
    ["ground,sky", "ground,water", "castle,rabbit,dragon", "trees,deer,plants", "grass,sword,map"],
)
@pytest.mark.sweep(14, first=9)
def test_the_same_command_twice_gives_the_same_bytes(tmp_path: Path, only: str) -> None:
    counts = [f"--set={key}={value}" for key, value in SMALL_BEST.items()]
    # The second makes all anew that the first finds in the cache, or puts there.
    for name, env in (
        ("first.png", environment()),
        ("second.png", environment(LANDSCAPE_CACHE="")),
    ):
        words = ("render", "fig35a", "--size", "64x48", "--only", only, "--out", name, *counts)
        done = landscape(*words, cwd=tmp_path, env=env)
        assert done.status == 0, done.err  # it says which settings have no effect
    first, second = (path.read_bytes() for path in sorted(tmp_path.iterdir()))
    assert first == second


def test_one_view_is_written_to_the_current_directory_by_default(shell: Shell) -> None:
    shell("render", "fig35a", *SMALL)
    assert pictures(shell.cwd) == ["fig35a.png"]
    with Image.open(shell.cwd / "fig35a.png") as image:
        assert image.size == (48, 36) and image.mode == "RGB"


def test_views_may_come_before_between_and_after_the_options(shell: Shell) -> None:
    small = (*SMALL, *shell.small)
    done = shell("render", "fig35a", "--kt", "3", "fig35b", *small, "fig35c", "--out", "d")
    assert done.status == 0, done.err
    assert pictures(shell.cwd / "d") == ["fig35a.png", "fig35b.png", "fig35c.png"]
    done = shell("render", *small, "fig35d")
    assert done.status == 0 and (shell.cwd / "fig35d.png").exists()


@pytest.mark.seldom(3, first=1)
def test_a_view_is_the_same_alone_and_after_others(shell: Shell) -> None:
    shell("render", "fig35a", "fig35b", "fig35a", *SMALL, *shell.small, "--out", "many")
    shell("render", "fig35a", *SMALL, *shell.small, "--out", "alone.png")
    alone = (shell.cwd / "alone.png").read_bytes()
    assert (shell.cwd / "many" / "fig35a.png").read_bytes() == alone
    assert (shell.cwd / "many" / "fig35b.png").read_bytes() != alone


def rendered(shell: Shell, *arguments: str) -> bytes:
    done = shell("render", *arguments, *shell.small, "-q", "--out", "x.png")
    assert (done.status, done.err) == (0, "")
    return (shell.cwd / "x.png").read_bytes()


@pytest.mark.seldom(14, first=8)
@pytest.mark.parametrize(
    "change",
    [
        ["--kt", "90"],
        ["--wireframe"],
        ["--samples", "4"],
        ["--preset", "best", "--set", "ground.stones=0"],
        ["--set", "fog.density=0.5"],
        ["--set", "fog.color=1, 0, 0"],
        ["--set", "fog.enabled=off"],
        ["--only", "ground,sky"],
        ["--size", "64x48"],
    ],
    ids=" ".join,
)
def test_each_option_of_render_changes_the_image(change: list[str], shell: Shell) -> None:
    assert rendered(shell, "fig35a", *SMALL, *change) != rendered(shell, "fig35a", *SMALL)


@pytest.mark.seldom(3, first=1)
def test_the_seed_changes_the_trees_but_not_the_ground(shell: Shell) -> None:
    def picture(only: str, seed: str) -> bytes:
        return rendered(shell, "fig35a", *SMALL, "--only", only, "--seed", seed)

    assert picture("ground,trees", "1") != picture("ground,trees", "2")
    assert picture("ground", "1") == picture("ground", "2")


@pytest.mark.seldom(10, first=4)
def test_a_pose_may_start_with_a_minus_sign_and_kt_may_be_negative(shell: Shell) -> None:
    west = rendered(shell, *SMALL, "--pose", "-3,2,20,90,-5", "--kt", "-4")
    assert west == rendered(shell, *SMALL, "--pose=-3,2,20,90,-5", "--kt=-4")
    assert west != rendered(shell, *SMALL, "--pose", "3,2,20,90,-5", "--kt", "-4")


def test_yaw_90_looks_east_and_pitch_90_looks_up() -> None:
    def forward(pose: str) -> tuple[float, ...]:
        arguments = ["render", f"--pose={pose}"]
        return parse(arguments).pose.forward  # type: ignore[no-any-return]

    assert forward("1, 2, 3, 90, 0") == pytest.approx((1, 0, 0))
    assert forward("1,2,3,0,0") == pytest.approx((0, 0, -1))
    assert forward("1,2,3,0,90") == pytest.approx((0, 1, 0))


# --- Python ------------------------------------------------------------------------------------

EXAMPLE = """
import numpy as np
import PIL.Image
import landscape

few = {"ground.stones": 500, "ground.texture_size": 256}
image = landscape.render("fig35e", (64, 36), settings=few, only=("ground", "sky"), samples=0)
assert isinstance(image, PIL.Image.Image) and image.size == (64, 36) and image.mode == "RGB"
assert image._repr_png_(), "Jupyter would not show it"

options = {"preset": "2006", "only": ("ground", "water", "fog")}
with landscape.Offscreen(size=(640, 480), settings={"fog.density": 0.05}, **options) as view:
    view.look("fig35d")
    pixels = view.draw(kt=40)
    assert pixels.shape == (480, 640, 3) and pixels.dtype == np.uint8
    assert (pixels == view.draw(kt=40)).all()
    assert (pixels != view.draw(kt=55)).any(), "the water stands still"
    # The top row comes first: it has the fog colour of the sky, the bottom row does not.
    fog = np.round(np.array(view.scene.settings.fog.color) * 255)
    assert (abs(pixels[0].astype(int) - fog) <= 1).all()
    assert (abs(pixels[-1].astype(int) - fog) > 1).any()
    kept = pixels.copy()
    view.look((20.0, None, 20.0, 0.0, 0.0))
    ground = float(view.scene.height(20.0, 20.0))
    assert abs(view.moment.pose.y - ground - 0.1) < 1e-6
    assert (view.draw() != kept).any() and (pixels == kept).all(), "an earlier image was changed"

with landscape.Offscreen((32, 24), **options) as thicker:
    thicker.look("fig35d")
    thick = thicker.draw(kt=40)
with landscape.Offscreen((32, 24), settings={"fog.density": 0.05}, **options) as thinner:
    thinner.look("fig35d")
    assert (thinner.draw(kt=40) != thick).any()
    thinner.close()
thinner.close()

# Two at once, alternating: each draws into its own context.
with landscape.Offscreen((32, 24), preset="2006", only=("ground", "fog")) as one:
    one.look("fig35d")
    alone = one.draw()
    with landscape.Offscreen((32, 24), preset="2006", only=("sky", "trees")) as other:
        other.look("fig35b")
        assert (other.draw() != alone).any() and (one.draw() == alone).all()
    assert (one.draw() == alone).all()

from landscape import InputError
for wrong in (
    lambda: landscape.render("fig99z"),
    lambda: landscape.Offscreen(size=(0, 10)),
    lambda: landscape.Offscreen(settings={"fog.thickness": 1}),
    lambda: landscape.Offscreen(preset="1996"),
    lambda: landscape.Offscreen(assets="/nowhere"),
    lambda: landscape.Offscreen(only=("ground", "moat")),
    lambda: landscape.render((20.0, float("nan"), 20.0, 0.0, 0.0)),
    lambda: landscape.render((20.0, 1.0)),
):
    try:
        wrong()
    except InputError:
        continue
    raise SystemExit("no InputError")
print("good")
"""


@pytest.mark.seldom(13, first=8)
def test_the_python_interface_works_as_documented() -> None:
    done = python(EXAMPLE)
    assert (done.status, done.out, done.err) == (0, "good\n", "")


def test_importing_landscape_imports_no_opengl() -> None:
    done = python("import sys, landscape; print([m for m in sys.modules if 'OpenGL' in m])")
    assert done.out == "[]\n", done.err


@pytest.mark.seldom(3, first=1)
def test_json_output_contains_no_nan(shell: Shell) -> None:
    for command in (["views"], ["settings"], ["trace", "fig6a", "--only", "ground,fog"]):
        json.loads(shell(*command, "--json").out, parse_constant=lambda name: 1 / 0)


@pytest.mark.parametrize(("number", "status"), [(signal.SIGTERM, 143), (signal.SIGINT, 130)])
def test_what_fails_on_the_way_out_of_a_command_that_is_ended_is_no_defect(
    number: signal.Signals, status: int, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    class Argument:
        """An argument of a C function that a signal finds while ctypes is converting it."""

        @classmethod
        def from_param(cls, _: object) -> None:
            signal.raise_signal(number)

    convert = ctypes.CFUNCTYPE(None, Argument)(1)

    def work(options: argparse.Namespace) -> int:
        convert(0)
        return 0

    before = signal.signal(number, signal.default_int_handler)
    monkeypatch.setattr("landscape.commands.views.run", work)
    assert cli.main(["views"]) == status
    assert signal.signal(number, before) is signal.default_int_handler
    assert "defect" not in capsys.readouterr().err
