"""The user's preferences: their file, the list that changes them, and keys of one's own."""

from pathlib import Path

import glfw
import pytest

from framelens.base.errors import InputError
from framelens.inspector.keys import us_name
from landscape.elements.settings import Settings
from landscape.walk import words
from landscape.walk.hands import Hands
from landscape.walk.keymap import ACTIONS, DEFAULT, FIXED, KEY_NAMES, Keymap, key_named
from landscape.walk.preferences import (
    FILE,
    MOST_BYTES,
    Preferences,
    keep,
    kept,
    parsed,
    read,
    written,
)
from landscape.walk.preferences_list import ROWS, PreferencesList
from landscape.walk.walker import Intent

OWN = Preferences(
    mouse_speed=1.5,
    invert=True,
    field_of_view=75.0,
    reduced_motion=True,
    text_size=1.25,
    language="fr",
    fullscreen=True,
    keys=Keymap({"forward": (glfw.KEY_I, glfw.KEY_UP), "map": (glfw.KEY_F3,)}),
)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder in which preferences are kept."""
    monkeypatch.setenv("LANDSCAPE_CONFIG", str(tmp_path))
    return tmp_path


def test_what_is_kept_is_read_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert read() == (Preferences(), [])
    monkeypatch.setenv("LANDSCAPE_CONFIG", str(folder / "new"))
    assert keep(OWN) == (True, [])
    assert read() == (OWN, [])
    text = (folder / "new" / FILE).read_text()
    assert "# vertical, en degrés" in text and 'forward = ["I", "Up"]' in text
    assert max(map(len, text.splitlines())) <= 100


FIRST = """# as the first version with preferences wrote them: without the sound's
mouse_speed = 2.5
invert = true
field_of_view = 70.0
reduced_motion = false
text_size = 1.5
language = "fr"
fullscreen = false

[keys]
forward = ["I", "Up"]
"""


def test_a_file_of_an_older_version_is_read(folder: Path) -> None:
    (folder / FILE).write_text(FIRST)
    keys = Keymap({"forward": (glfw.KEY_I, glfw.KEY_UP)})
    known = {"mouse_speed": 2.5, "field_of_view": 70.0, "text_size": 1.5, "language": "fr"}
    expected = Preferences(invert=True, keys=keys, **known)  # type: ignore[arg-type]
    assert read() == (expected, [])
    assert keep(expected)[0] and read() == (expected, [])


def test_nothing_is_kept_without_a_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LANDSCAPE_CONFIG", "")
    assert keep(OWN) == (False, []) and read() == (Preferences(), [])


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("mouse_speed = 0", "mouse_speed: expected times the usual speed"),
        ("mouse_speed = true", "mouse_speed: expected"),
        ("invert = 1", "invert: expected true"),
        ('language = "de"', "language: expected"),
        ("field_of_view = 170", "field_of_view: expected vertical"),
        ("gamma = 2.2", "gamma: expected one of mouse_speed"),
        ("keys = 3", "keys: expected a table"),
        ('[keys]\nhop = ["H"]', "keys.hop: expected one of forward"),
        ('[keys]\nrun = "R"', "keys.run: expected a list"),
        ('[keys]\nrun = ["Escape"]', "'Escape': expected a key"),
        ('[keys]\nrun = ["Alt Gr"]', "'Alt Gr': expected a key"),
        ('[keys]\nrun = ["F4"]\nmap = ["F4"]', "keys.map: expected keys that run does not have"),
    ],
)
def test_a_wrong_value_is_named_and_the_others_are_taken(
    folder: Path, line: str, told: str
) -> None:
    (folder / FILE).write_text(f"text_size = 1.5\n{line}\n")
    found, messages = read()
    assert found.text_size == 1.5
    assert len(messages) == 1 and str(messages[0]).startswith(f"{folder / FILE}: {told}")


@pytest.mark.parametrize("damaged", [b"mouse_speed = ", b"\xff\xfe\x00", b"[" * 5000])
def test_a_damaged_file_is_kept_aside(folder: Path, damaged: bytes) -> None:
    for number in (1, 2):
        (folder / FILE).write_bytes(damaged)
        found, messages = read()
        assert found == Preferences()
        assert str(messages[0]).endswith(f"it is kept as {FILE}.damaged-{number}")
        assert (folder / f"{FILE}.damaged-{number}").read_bytes() == damaged
        assert not (folder / FILE).exists()


@pytest.mark.parametrize(
    "former",
    [
        b"gamma = 2.2  # of a newer version\ntext_size = 1.5\n",
        b'[keys]\nhop = ["H"]\n',
        b"text_size = 1.5\n" + b"#" * MOST_BYTES,
        b"mouse_speed = ",
    ],
)
def test_what_was_not_taken_of_a_file_is_not_lost_when_others_are_kept(
    folder: Path, former: bytes
) -> None:
    for number in (1, 2):
        (folder / FILE).write_bytes(former)
        line = kept(OWN, "en")
        assert line.startswith("your preferences are kept\n"), line
        assert line.endswith(f"it is kept as {FILE}.damaged-{number}"), line
        assert (folder / f"{FILE}.damaged-{number}").read_bytes() == former
        assert read() == (OWN, [])
    assert kept(OWN, "en") == "your preferences are kept"


def test_they_change_only_settings_that_a_scene_has() -> None:
    assert OWN.changes(Settings) == {"camera.fov": 75.0, "walk.bob": 0.0, "plants.sway": 0.0}
    assert Preferences().changes(Settings) == {}


def test_the_mouse_obeys_them() -> None:
    hands = Hands()
    hands.speed, hands.inverted = 2.0, True
    hands.capture(True)
    for x, y in ((0.0, 0.0), (3.0, 4.0)):
        hands.motion(x, y)
    assert hands.take()[0] == Intent(look=(6.0, -8.0))


def test_an_action_has_its_own_key_and_no_other() -> None:
    hands = Hands(keymap=OWN.keys)
    for key, taken in (
        (glfw.KEY_I, (Intent(forward=1.0), ())),
        (glfw.KEY_W, (Intent(), ())),
        (glfw.KEY_F3, (Intent(), ("map",))),
        (glfw.KEY_M, (Intent(), ())),
        (glfw.KEY_G, (Intent(), ("fog",))),
    ):
        hands.key(key, glfw.PRESS)
        assert hands.take() == taken
        hands.key(key, glfw.RELEASE)
        hands.take()
    assert OWN.keys.labels("map", "en", us_name) == "F3"
    assert OWN.keys.labels("walk", "en", us_name) == "I A S D"


def test_no_two_actions_have_the_same_key() -> None:
    for claimed in ((), ("L", "B", "K")):
        keys = [k for action in ACTIONS for k in DEFAULT.keys_of(action, us_name, claimed)]
        assert len(keys) == len(set(keys))
    with pytest.raises(InputError, match="fly: M is the key of map"):
        DEFAULT.with_key("fly", glfw.KEY_M, us_name)
    with pytest.raises(InputError, match="cannot be chosen"):
        DEFAULT.with_key("fly", glfw.KEY_1, us_name)
    free = DEFAULT.with_key("map", glfw.KEY_F3, us_name).with_key("fly", glfw.KEY_M, us_name)
    assert free.chosen == {"map": (glfw.KEY_F3,), "fly": (glfw.KEY_M,)}
    assert free.without("fly").chosen == {"map": (glfw.KEY_F3,)}


def test_every_key_has_a_name_of_its_own() -> None:
    assert len(set(map(str.casefold, KEY_NAMES.values()))) == len(KEY_NAMES)
    assert all(key_named(name) == key for key, name in KEY_NAMES.items() if key not in FIXED)


def pressed(wishes: PreferencesList, *keys: int) -> None:
    for key in keys:
        wishes.key(key, us_name)


def test_the_list_changes_values_within_their_limits() -> None:
    wishes = PreferencesList(Preferences())
    wishes.toggle()
    pressed(wishes, *[glfw.KEY_KP_SUBTRACT] * 30)
    assert wishes.preferences.mouse_speed == 0.1
    pressed(wishes, glfw.KEY_DOWN, glfw.KEY_ENTER, glfw.KEY_DOWN, glfw.KEY_KP_ADD)
    assert wishes.preferences.invert and wishes.preferences.field_of_view == 60.0
    pressed(wishes, *[glfw.KEY_KP_SUBTRACT] * 5)
    assert wishes.preferences.field_of_view == 0.0
    pressed(wishes, glfw.KEY_UP, glfw.KEY_BACKSPACE, glfw.KEY_HOME, glfw.KEY_BACKSPACE)
    assert wishes.preferences == Preferences()
    pressed(wishes, glfw.KEY_ESCAPE)
    assert not wishes.open


@pytest.mark.parametrize("language", ["en", "fr"])
def test_the_list_gives_an_action_the_next_key(language: str) -> None:
    wishes = PreferencesList(Preferences())
    wishes.toggle()
    wishes.index = ROWS.index("forward")
    pressed(wishes, glfw.KEY_ENTER)
    lines = {line.name: line.value for line in wishes.page(language, us_name, ()).lines}
    text = words.text(language, "action.forward")
    assert lines[text] == words.text(language, "preferences.press")

    pressed(wishes, glfw.KEY_M)
    assert wishes.preferences == Preferences()  # that is the map's
    refused = wishes.page(language, us_name, ()).below[0]
    assert words.text(language, "action.map") in refused and text in refused

    pressed(wishes, glfw.KEY_ENTER, glfw.KEY_ESCAPE)
    assert wishes.open and wishes.preferences == Preferences()
    pressed(wishes, glfw.KEY_ENTER, glfw.KEY_Y)
    assert wishes.preferences.keys.chosen == {"forward": (glfw.KEY_Y,)}
    pressed(wishes, glfw.KEY_BACKSPACE)
    assert wishes.preferences == Preferences()


def test_the_file_says_what_each_value_means() -> None:
    text = written(Preferences())
    again, messages = parsed(text, Path("preferences.toml"))
    assert again == Preferences() and messages == []
    assert text.count("\n# ") >= len(Preferences.__dataclass_fields__) - 1
