"""What is refused, asked by the command line and by Python: both say the same of it.

Values of other types than a command line has are in test_face.py, and what only a command line can
get wrong in test_bad_input.py.
"""

import math
from collections.abc import Iterator
from typing import Any

import pytest
from commands import Shell, refused
from folded import each

import landscape

NUMBERS = "the numbers x, y, z, yaw and pitch; y may be `ground`"
ISLAND = "ground, water, sky, trees, deer, plants, grass, castle, rabbit, dragon, sword, map, fog"
LARGEST = "expected from 1x1 to 16384x16384"
# The argument, a wrong value as a command line has it and as Python has it, and what is expected.
ARGUMENTS: tuple[tuple[str, str, Any, str], ...] = (
    ("size", "0x0", (0, 0), LARGEST),
    ("size", "0x10", (0, 10), LARGEST),
    ("size", "99999x99999", (99999, 99999), LARGEST),
    ("size", "10x16385", (10, 16385), LARGEST),
    ("size", "16384x16384", (16384, 16384), "expected at most 67 megapixels"),
    ("only", "cows", "cows", f"expected some of {ISLAND}, reflection, mist"),
    ("only", "", "", f"expected some of {ISLAND}, reflection, mist"),
    ("samples", "3", 3, "expected one of 0, 4"),
    ("seed", "-1", -1, "expected a whole number from 0"),
    ("seed", "9" * 30, int("9" * 30), "expected a whole number from 0"),
    ("backend", "metal", "metal", "expected one of auto, osmesa, egl, glfw, cgl, software"),
    ("preset", "worst", "worst", "expected one of 2006, best"),
    ("assets", "nowhere", "nowhere", "expected a folder"),
    ("kt", "nan", math.nan, "expected a number"),
    ("kt", "inf", math.inf, "expected a number"),
    ("kt", "now", "now", "expected a number"),
    ("pose", "1,2,3,nan,0", (1, 2, 3, math.nan, 0), f"expected {NUMBERS}"),
    ("pose", "1,2,3,inf,0", (1, 2, 3, math.inf, 0), f"expected {NUMBERS}"),
    ("pose", "1,2,3,north,0", (1, 2, 3, "north", 0), f"expected {NUMBERS}"),
    ("pose", "ground,2,3,0,0", ("ground", 2, 3, 0, 0), f"expected {NUMBERS}"),
)
SETTINGS = (
    ["fog.density=thick", "fog.density=", "fog.density=nan", "fog.density=-nan", "fog.density=inf"]
    + ["fog.density=-0.1", "fog.density=1e999", "fog.density=1,2", "fog.density=0x10"]
    + ["grass.count=many", "grass.count=2.5", "grass.count=nan", "grass.count=-1"]
    + ["grass.count=" + "9" * 30, "grass.count=" + "9" * 400, "grass.count=" + "9" * 5000]
    + ["grass.count=99999999", "trees.count=1000001", "ground.resolution=1", "water.points=0"]
    + ["fog.color=1,2", "fog.color=1,2,3,4", "fog.color=0,nan,0", "fog.color=red", "fog.color=,,"]
    + ["fog.enabled=maybe", "fog.enabled=2", "fog.mode=EXP3", "fog.mode=", "sky.set=night"]
    + ["rabbit.mesh=", "ground.height_image="]
    + ["nokey=1", "fog=1", "fog.x.y=1", "fog.Density=1", "=1", ".=1"]
)
by_argument = each("case", ARGUMENTS, ids=lambda case: f"{case[0]} {case[1][:20]!r}")
by_setting = each("change", SETTINGS, ids=lambda change: change[:30])


@pytest.fixture(scope="module")
def view() -> Iterator[landscape.Offscreen]:
    with landscape.Offscreen((8, 6), "2006", only=("map",), samples=0) as opened:
        opened.look("fig4a")
        yield opened


@by_argument
def test_the_command_line_refuses_a_wrong_argument(case: Any, shell: Shell) -> None:
    argument, words, _, expected = case
    where = () if argument == "pose" else ("fig35a",)
    done = shell("render", *where, f"--{argument}={words}", "--out", "none.png")
    refused(done, argument, expected)
    assert "Traceback" not in done.err


@by_argument
def test_python_refuses_a_wrong_argument(case: Any, view: landscape.Offscreen) -> None:
    argument, _, value, expected = case
    with pytest.raises(landscape.InputError) as caught:
        if argument == "kt":
            view.draw(kt=value)
        elif argument == "pose":
            view.look(value)
        else:
            landscape.Offscreen(**{"size": (8, 6), argument: value})
    said = str(caught.value)
    assert said.startswith(f"{argument} ") and said.endswith(expected), said


@pytest.mark.seldom(10, first=6)
@by_setting
def test_a_wrong_setting_is_refused_by_its_key_in_the_same_words(change: str, shell: Shell) -> None:
    key, _, value = change.partition("=")
    with pytest.raises(landscape.InputError) as caught:
        landscape.Offscreen((8, 6), settings={key: value})
    for command in (("settings",), ("render", "fig35a", "--out", "none.png")):
        done = shell(*command, "--set", change)
        refused(done, key)
        assert done.err == f"landscape: {caught.value}\n"
        assert len(done.err) < 200, "a long value should be truncated"
