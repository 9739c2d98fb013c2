"""What there is to find on a walk: where it is, when it is found, what is kept and shown."""

import json
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import glfw
import pytest
from commands import environment, python

from landscape.commands.walk import told
from landscape.scene.landmarks import LANDMARKS, NAMES
from landscape.scene.scene import scene
from landscape.walk.landmarks import FILE, SHORES, Found, Search, place_of, title_of
from landscape.walk.landmarks_list import LandmarksList, way
from landscape.walk.list_image import line_at, list_image, text_image
from landscape.walk.place import Place
from landscape.walk.walker import Walker


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder in which is kept what has been found."""
    monkeypatch.setenv("LANDSCAPE_CONFIG", str(tmp_path))
    return tmp_path


class Shore:
    """A flat land with water between x = 10 and x = 20, and the castle's gate."""

    size = 40.0
    doors = (SimpleNamespace(name="castle", x=30.0, z=5.0),)

    def height(self, x: float, z: float) -> float:
        """Return the height of the ground."""
        return 1.0

    def depth(self, x: float, z: float) -> float:
        """Return the water's depth."""
        return 0.3 if 10 < x < 20 else 0.0


def place(name: str = "island") -> Place:
    kind = scene(name)
    found = Place(kind, kind.values(None), None)
    found._scene = Shore()  # type: ignore[assignment]
    return found


def test_every_landmark_has_a_place_a_title_in_both_languages_and_a_lesson() -> None:
    for landmark in LANDMARKS:
        where = place(landmark.scene)
        assert (place_of(landmark, where) is None) == (landmark.name == "far_shore"), landmark
        assert place_of(landmark, place("voxel")) is None
        assert title_of(landmark, "en") != title_of(landmark, "fr"), landmark
        english, french = told(landmark.lesson, "en"), told(landmark.lesson, "fr")
        assert len(english) == len(french) > 2
        assert all(one != other for one, other in zip(english, french, strict=True)), landmark
    assert len(set(NAMES)) == len(NAMES)
    main = scene("island").main
    assert [name for name in NAMES if name.startswith("fig")] == list(main)
    shown = [name for name in scene("hall").views if name.startswith("hall_exhibit_")]
    assert [name for name in NAMES if name.startswith("hall")] == shown


def test_the_dragon_is_found_where_the_settings_have_it() -> None:
    where = place()
    dragon = next(each for each in LANDMARKS if each.name == "dragon")
    x, z = place_of(dragon, where) or (0.0, 0.0)
    near = Walker(x + 1.0, 1.1, z)
    assert "dragon" in Search().reached(where, near)
    assert "dragon" not in Search().reached(where, replace(near, x=x + 3.0))
    assert "dragon" not in Search().reached(where, replace(near, y=9.0)), "high above it"
    where.settings = replace(
        where.settings,
        dragon=replace(where.settings.dragon, x=3.0, z=3.0),  # type: ignore[attr-defined, type-var]
    )
    assert "dragon" in Search().reached(where, Walker(3.0, 1.1, 3.0))


@pytest.mark.parametrize(
    ("way_taken", "flying", "reached"),
    [
        ([9.5, 10.5, *range(11, 21)], False, True),
        ([9.5, 10.5, 11.0, 10.5, 9.5], False, False),
        ([9.5, 10.5, *range(11, 21)], True, False),
        ([9.5, 10.5, 19.5, 20.5], False, False),
    ],
    ids=["through the water", "back to the same shore", "flown", "leapt"],
)
def test_the_far_shore_is_found_by_who_comes_through_the_water(
    way_taken: list[float], flying: bool, reached: bool
) -> None:
    search, where = Search(), place()
    found = [search.reached(where, Walker(x, 1.1, 39.0, flying=flying)) for x in way_taken]
    assert way_taken[-1] - way_taken[0] > SHORES or not reached
    assert any("far_shore" in each for each in found) == reached
    assert ("far_shore" in found[-1]) == reached


def test_what_is_found_is_kept_for_the_next_walk_beside_what_another_walk_finds(
    folder: Path,
) -> None:
    first, messages = Found.read()
    assert (first.names, messages) == (set(), [])
    other, _ = Found.read()
    assert first.add("rabbit", "en") is None
    assert other.add("gate", "fr") is None
    assert Found.read()[0].names == {"rabbit", "gate"}
    text = (folder / FILE).read_text()
    assert text.startswith("# Ce que vous avez découvert") and '"rabbit",' in text
    (folder / FILE).write_text('found = ["rabbit", "unicorn"]')
    assert Found.read()[0].names == {"rabbit"}
    assert Found(("unicorn",)).names == set()


@pytest.mark.parametrize("damaged", [b"found = [", b"found = 3", b"found = [1]", b"\xff\xfe\x00"])
def test_a_damaged_file_is_kept_aside(folder: Path, damaged: bytes) -> None:
    (folder / FILE).write_bytes(damaged)
    found, messages = Found.read()
    assert found.names == set()
    assert str(messages[0]).endswith(f"it is kept as {FILE}.damaged-1")
    (folder / FILE).write_bytes(damaged)
    told_of = found.add("gate", "en")
    assert str(told_of).endswith(f"it is kept as {FILE}.damaged-2")
    assert {(folder / f"{FILE}.damaged-{n}").read_bytes() for n in (1, 2)} == {damaged}
    assert Found.read()[0].names == {"gate"}


def test_nothing_is_kept_without_a_folder_and_what_cannot_be_written_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LANDSCAPE_CONFIG", "")
    found, messages = Found.read()
    assert found.add("gate", "en") is None and found.names == {"gate"} and messages == []
    (tmp_path / "file").write_text("")
    assert "file" in str(Found((), tmp_path / "file" / FILE).add("gate", "en"))


def test_the_list_shows_the_way_and_opens_only_what_has_been_found() -> None:
    where = place()
    walker = Walker(30.0, 1.1, 15.0)  # ten units south of the gate, looking north
    chooser = LandmarksList(Found(("gate",)), told)
    chooser.toggle()
    page = chooser.page("en", where, walker)
    assert page.title.endswith("1/19")
    values = {line.name: line.value for line in page.lines}
    assert values["the castle's gate"] == "✓"
    assert values["the far shore, across the water"] == "–"
    rabbit = next(each for each in LANDMARKS if each.name == "rabbit")
    assert values["the rabbit"] == way(rabbit, where, walker) != ""
    gate = next(each for each in LANDMARKS if each.name == "gate")
    assert way(gate, where, walker) == "↑ 170 m"
    assert way(gate, where, replace(walker, yaw=90.0)) == "← 170 m"

    chooser.key(glfw.KEY_ENTER)
    assert not chooser.reading, "it has not been found"
    line = [each.name for each in page.lines].index("the castle's gate")
    chooser.point(0)
    chooser.point(line)
    assert chooser.row.name == "gate"
    chooser.key(glfw.KEY_ENTER)
    assert chooser.reading and chooser.text("fr")[0] == "la porte du château"
    chooser.key(glfw.KEY_DOWN)
    chooser.key(glfw.KEY_ENTER)
    assert chooser.asked == "light_map"
    chooser.key(glfw.KEY_ESCAPE)
    assert chooser.open and not chooser.reading
    chooser.key(glfw.KEY_ESCAPE)
    assert not chooser.open


@pytest.mark.parametrize("size", [(1280, 720), (300, 900), (1900, 200), (64, 48)])
@pytest.mark.sweep(10)
def test_the_pictures_fit_and_the_mouse_finds_the_chosen_line(size: tuple[int, int]) -> None:
    chooser = LandmarksList(Found(NAMES), told)
    for chooser.index in (0, 12, 18):
        page = chooser.page("fr", place(), Walker(3.0, 1.1, 3.0))
        image = list_image(page, size)
        x = size[1] // 48 + 1
        lines = {line_at(page, size, 1.0, x, y) for y in range(size[1])} - {None}
        chosen = next(k for k, line in enumerate(page.lines) if line.chosen)
        assert chosen in lines or size[1] < 100
        assert line_at(page, size, 1.0, x + image.shape[1], size[1] / 2) is None
    height, width, _ = text_image(chooser.text("fr"), size).shape
    assert width <= max(0.5 * size[0], 1) and (height <= size[1] or size[1] < 250)


WALKS = """
import json, sys
from pathlib import Path
import glfw, numpy as np
from framelens.gl.contexts.glfw import GLFWContext
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.scene.scene import scene
from landscape.walk.app import Walk
from landscape.walk.landmarks import Found
from landscape.walk.loop import run
from landscape.walk.preferences import Preferences
from landscape.walk.recording import Plan, Writer, read

kind = scene("hall")
at = kind.views["hall_exhibit_lines"].pose
begin = Pose(at.x + 0.5, None, at.z, 270.0)
plan = Plan("hall", kind.settings, "hall", begin, (160, 120), only=("floor",))
ran, seen = [], []

def walk(found, writer=None, ticks=None, script=()):
    with Walk(plan, Assets(), "osmesa", keeps=True, preferences=Preferences(), found=found,
              tells=lambda name, language: [name, "text of " + name],
              run_command=lambda words: ran.append(words) or 0) as opened:
        opened._lap = lambda: 0.1
        if ticks is not None:
            run(opened, ticks)
        for keys, frames in script:
            for key in keys:
                opened.hands.key(key, glfw.PRESS)
            run(opened, writer=writer, frames=frames)
            for key in keys:
                opened.hands.key(key, glfw.RELEASE)
            seen.append([opened._message, opened.landmarks.open, opened.landmarks.reading,
                         opened.hands.choosing])
        opened.draw()
        return opened.pixels(), sorted(opened.landmarks.found.names), opened._message

DOWN, UP = glfw.KEY_DOWN, glfw.KEY_UP
walk(Found.read()[0], script=[([], 30), ([glfw.KEY_W], 8), ([], 30), ([glfw.KEY_B], 1), ([UP], 1),
    ([UP], 1), ([glfw.KEY_ENTER], 1), ([glfw.KEY_ENTER], 1), ([glfw.KEY_B], 1)])
out = Path(sys.argv[1])
writer = Writer(out / "a.walk", plan)
first = walk(Found(), writer, script=[([], 30), ([glfw.KEY_W], 8), ([], 30)])
writer.finish()
_, ticks = read(out / "a.walk")
notes = [tick.note for tick in ticks if tick.note]
again = walk(None, ticks=iter(ticks))
print(json.dumps([seen, ran, sorted(Found.read()[0].names), notes,
                  bool(np.array_equal(first[0], again[0])), first[2] == again[2], again[1]]))
"""


@pytest.mark.seldom(12, first=11)
def test_a_walk_finds_names_opens_and_records_a_landmark(folder: Path) -> None:
    done = python(
        WALKS,
        str(folder),
        env=environment(LANG="C", LANDSCAPE_CONFIG=str(folder), LANDSCAPE_CACHE=""),
    )
    assert done.status == 0, done.err
    seen, ran, kept, notes, same, same_message, replayed = json.loads(done.out)
    what = "the dragon engraved, without hidden lines"
    assert notes[-1] == f"found: {what}  (B: more)" and len(notes) == 1
    assert seen[2][0] == notes[0]
    opened = [state[1:] for state in seen[3:9]]
    listed = [True, False, "landmarks"]
    assert opened == [
        *(listed, listed, listed),
        *([True, True, "landmarks"], [True, True, "landmarks"]),
        [False, False, ""],
    ]
    assert ran == [["lesson", "polygon_modes", "--lang", "en"]]
    assert kept == ["hall_exhibit_lines"]
    assert same and same_message and replayed == []
