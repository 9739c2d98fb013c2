"""The list of settings in the walk: its rows, its steps, and what its keys change."""

import numpy as np
import pytest
from folded import each

from framelens.base.fonts import font
from framelens.inspector.panel import KEYS, enlarged
from landscape.elements.settings import Settings, preset
from landscape.island.island import ELEMENTS
from landscape.settings import declare
from landscape.walk import list_image as list_pictures
from landscape.walk import settings_list
from landscape.walk.list_image import layout, list_image, visible, wrapped
from landscape.walk.settings_list import Chooser, heading, rows, step_of, stepped, written

pytestmark = pytest.mark.window

BEST = preset("best")
ROWS = {row.name: row for row in rows(Settings)}


def page(settings: Settings, defaults: Settings, *rest: str, hidden: tuple[str, ...] = ()):
    shown = frozenset(ELEMENTS) - set(hidden)
    return settings_list.page(settings, defaults, *rest, shown, ELEMENTS)


def after(*picks: str, settings: Settings = BEST, defaults: Settings = BEST) -> tuple:
    """Open the list, carry out the picks; return the row chosen and the changes."""
    chooser = Chooser(defaults)
    changes = chooser.follow(["list", *picks], settings)
    return chooser.row, changes


def to(name: str) -> list[str]:
    """Return the picks that choose a row from the first one."""
    return ["down"] * list(ROWS).index(name)


def test_every_setting_but_the_names_of_files_has_a_row_or_one_per_component() -> None:
    for key, item in declare.fields(Settings).items():
        names = [name for name, row in ROWS.items() if row.key == key]
        if isinstance(item.default, tuple):
            assert names == [f"{key}.{part}" for part in range(len(item.default))]
        else:
            file = isinstance(item.default, str) and not item.choices
            assert names == ([] if file else [key])
    assert [ROWS[f"fog.color.{part}"].label for part in range(3)] == [
        "color R",
        "color G",
        "color B",
    ]


@pytest.mark.parametrize(
    ("size", "step"), [(0.042, 0.002), (0.12, 0.005), (1.0, 0.05), (60.0, 2.0), (24e6, 1e6)]
)
def test_a_step_is_a_twentieth_of_the_value_rounded_down_to_1_2_or_5(size, step) -> None:
    assert step_of(size) == pytest.approx(step, rel=1e-12)


@pytest.mark.seldom(10, first=7)
@each("name", ROWS)
def test_every_value_can_be_stepped_to_its_limits_and_stays_valid(name: str) -> None:
    row = ROWS[name]
    start = row.value(BEST)
    for way in (1, -1):
        value = start
        for _ in range(60):
            after_step = stepped(row, value, way, 0.0 if isinstance(start, bool | str) else start)
            assert type(after_step) is type(start)
            declare.with_settings(BEST, {row.key: row.changed(BEST, after_step)})
            if not isinstance(start, bool | str):
                limit = row.item.limits[1 if way > 0 else 0]
                assert (after_step - value) * way > 0 or after_step == limit == value
            value = after_step


def test_steps_up_and_down_come_back_and_pass_through_zero() -> None:
    density = ROWS["fog.density"]
    up = stepped(density, 0.042, 1, 0.042)
    assert (up, stepped(density, up, -1, 0.042)) == (0.044, 0.042)
    value = 0.004
    for expected in (0.002, 0.0, 0.0):
        value = stepped(density, value, -1, 0.042)
        assert value == expected
    assert stepped(density, 0.0, 1, 0.042) == 0.002
    assert stepped(ROWS["dragon.sink"], 0.0, -1, -0.15) == -0.005


def test_bools_change_over_and_choices_go_round() -> None:
    assert stepped(ROWS["fog.enabled"], True, 1, 0.0) is False
    units, seen = ROWS["ground.units"], ["both"]
    for _ in range(4):
        seen.append(stepped(units, seen[-1], 1, 0.0))
    assert seen == ["both", "large", "detail", "none", "both"]
    assert stepped(units, "both", -1, 0.0) == "none"


def test_plus_minus_enter_and_backspace_change_the_chosen_setting() -> None:
    thick = declare.with_settings(BEST, {"fog.density": 0.5})
    there = to("fog.density")
    assert after(*there, "more") == ("fog.density", {"fog.density": 0.044})
    assert after(*there, "more", "more", "less") == ("fog.density", {"fog.density": 0.044})
    assert after(*there, "more", "less") == ("fog.density", {})
    assert after(*there, "switch") == ("fog.density", {})
    assert after(*there, "default", settings=thick) == ("fog.density", {"fog.density": 0.042})
    row, changes = after(*to("castle.multitexture"), "switch", "down", "less")
    assert row == "castle.ornate"
    assert changes == {"castle.multitexture": False, "castle.ornate": False}


def test_a_component_is_changed_without_the_others() -> None:
    changes = after(*to("fog.color.1"), "more", "up", "less")[1]
    assert changes == {"fog.color": (0.64, 0.78, 0.84)}


def test_the_arrows_go_from_row_to_row_and_from_group_to_group() -> None:
    assert after()[0] == "time"
    assert after("up")[0] == after("last")[0] == list(ROWS)[-1]
    assert after("up", "down")[0] == after("last", "first")[0] == "time"
    assert after("next_group", "next_group")[0] == "clock.kt_per_second"
    assert after("previous_group")[0] == "mist.enabled"
    assert after("down", "down", "previous_group")[0] == "time"


def test_a_closed_list_takes_nothing_and_reopens_where_it_was() -> None:
    chooser = Chooser(BEST)
    assert chooser.follow(["down", "more"], BEST) == {} and chooser.row == ""
    chooser.follow(["list", *to("fog.mode"), "list"], BEST)
    assert chooser.row == ""
    chooser.follow(["list"], BEST)
    assert chooser.row == "fog.mode"


def test_the_page_shows_value_preset_range_and_what_the_change_did() -> None:
    changed = declare.with_settings(BEST, {"fog.density": 0.05, "grass.count": 20_000_000})
    shown = page(changed, BEST, "fog.density", "changed at once", "en")
    (chosen,) = [line for line in shown.lines if line.chosen]
    assert (chosen.name, chosen.value, chosen.default) == ("density", "0.05", "0.042")
    assert shown.below[:4] == (
        "fog.density",
        "how dense it is in the modes exp2 and exp",
        "from 0 to 1000 per unit (preset: 0.042)",
        "changed at once",
    )
    counts = [line for line in shown.lines if line.default and not line.chosen]
    assert [line.value for line in counts] == ["20\u00a0000\u00a0000"]
    assert not any(line.default for line in page(BEST, BEST, "fog.mode", "", "en").lines)


def test_a_setting_without_effect_is_marked_and_says_why() -> None:
    (start,) = [line for line in page(BEST, BEST, "fog.start", "", "en").lines if line.chosen]
    assert start.idle
    assert page(BEST, BEST, "fog.start", "", "en").below[3] == "ignored while fog.mode is exp2"
    assert page(BEST, BEST, "fog.start", "", "fr").below[3] == "sans effet\u00a0: fog.mode = exp2"
    arch = page(BEST, BEST, "grass.arch", "", "fr", hidden=("grass",))
    assert arch.below[3] == "sans effet\u00a0: grass n’est pas affiché"
    assert page(BEST, BEST, "grass.arch", "", "en").below[3] == ""


def test_the_french_page_has_its_own_words_for_groups_descriptions_and_values() -> None:
    shown = page(BEST, BEST, "fog.enabled", "", "fr")
    assert shown.title == "Réglages"
    assert shown.below[1:3] == ("avec ou sans brouillard", "oui, non (préréglage\u00a0: oui)")
    assert heading("fog", "fr") == "brouillard (fog)" and heading("fog", "en") == "fog"
    assert written(True, "fr") == "oui"
    limits = page(BEST, BEST, "fog.density", "", "fr").below[2]
    assert limits == "de 0 à 1000 par unité (préréglage\u00a0: 0.042)"


SIZES = [(640, 480), (1280, 720), (1920, 1080), (320, 240), (60, 40)]


@pytest.mark.parametrize("language", ["en", "fr"])
@pytest.mark.parametrize("size", SIZES)
@pytest.mark.sweep(3)
def test_the_picture_of_the_list_fits_and_shows_the_chosen_row(size, language: str) -> None:
    pictures = []
    for name in ("camera.fov", "water.query", "fog.end"):
        image = list_image(page(BEST, BEST, name, "", language), size)
        pictures.append(image)
        if size[0] >= 320:
            assert image.shape[1] <= 0.75 * size[0] and image.shape[0] <= size[1]
        # The chosen row has a background of its own.
        assert (image == (88, 84, 58, 225)).all(axis=2).sum() > image.shape[1] / 2
    if size[0] >= 320:
        assert len({picture.shape for picture in pictures}) == 1, "the plate must not jump"
    assert not np.array_equal(pictures[0], pictures[2])


@pytest.mark.parametrize("size", [(1280, 720), (1920, 1080)])
def test_a_larger_size_of_texts_makes_the_rows_of_a_list_larger(size) -> None:
    shown = page(BEST, BEST, "fog.end", "", "en")
    usual = layout(shown, size)
    for times in (1.25, 1.5):
        larger = layout(shown, size, enlarged(size, 1.0, times))
        assert larger.pixels == pytest.approx(times * usual.pixels, abs=1.0)
        assert larger.width <= 0.8 * size[0] and larger.height <= size[1]


def test_a_list_says_how_many_rows_there_are_beyond_its_ends(monkeypatch) -> None:
    said = []
    monkeypatch.setattr(
        list_pictures, "announce", lambda _, count, above, *__: said.append((count, above))
    )
    for name in ("time", "fog.end", list(ROWS)[-1]):
        shown = page(BEST, BEST, name, "", "en")
        laid = layout(shown, (1280, 720))
        said.clear()
        list_image(shown, (1280, 720))
        hidden = len(shown.lines) - laid.end
        assert said == [(n, above) for n, above in ((laid.first, True), (hidden, False)) if n]
        assert said, "no list of all settings fits"


def test_the_number_of_rows_below_has_a_line_of_its_own() -> None:
    size = (1280, 720)
    shown = page(BEST, BEST, "time", "", "en")
    laid = layout(shown, size)
    image = list_image(shown, size)
    last = laid.top + (laid.end - laid.first) * laid.line_height
    assert (image[last : last + laid.line_height, -2 * laid.pixels :] == (*KEYS, 255)).all(2).any()


def test_a_long_list_scrolls_and_keeps_the_chosen_row_in_its_middle() -> None:
    lines = page(BEST, BEST, "fog.end", "", "en").lines
    assert visible(lines, 20) == (len(lines) - 20, len(lines))
    first, end = visible(page(BEST, BEST, "water.relief", "", "en").lines, 21)
    assert lines[(first + end) // 2].name == "relief"
    assert visible(lines[:5], 20) == (0, 5)


def test_text_is_wrapped_at_spaces() -> None:
    face = font(12)
    text = "skip what is outside the view frustum, and back faces"
    lines = wrapped(text, face, 120)
    assert " ".join(lines) == text and len(lines) > 2
    assert all(face.getlength(line) <= 120 for line in lines)
    assert wrapped("unbreakable", face, 5) == ["unbreakable"]


def test_a_path_that_is_too_long_for_a_line_is_broken_behind_its_slashes() -> None:
    face = font(12)
    for path in (
        "/home/somebody/.config/landscape/preferences.toml:",
        r"C:\Users\Somebody\AppData\x",
    ):
        lines = wrapped(f"read {path} again", face, 150)
        assert all(face.getlength(line) <= 150 for line in lines) and len(lines) > 1
        assert "".join(lines) in (f"read {path} again", f"read {path}again")
    assert wrapped("a/b c", face, 150) == ["a/b c"]
