"""The settings: presets, values as text, TOML, limits, and the description of each key."""

import re
from pathlib import Path

import pytest
from folded import each

from framelens.base.errors import InputError
from landscape.elements import settings
from landscape.elements.settings import Settings, preset
from landscape.settings import declare
from landscape.settings.declare import get, read_toml, with_settings

KEYS = declare.fields(Settings)
NUMBERS = [key for key, item in KEYS.items() if type(item.default) in (int, float)]


def changed(key: str, value: object) -> declare.Value:
    return get(with_settings(Settings(), {key: value}), key)


@each("key", KEYS)
def test_every_default_is_within_its_own_limits_and_survives_being_written(key: str) -> None:
    default = KEYS[key].default
    assert changed(key, default) == default
    text = ",".join(map(str, default)) if isinstance(default, tuple) else str(default)
    assert changed(key, text) == default
    assert type(changed(key, text)) is type(default)


@each("key", KEYS)
def test_every_key_says_what_it_does_its_unit_and_its_source(key: str) -> None:
    item = KEYS[key]
    assert len(item.does.split()) > 1 and declare.unit(item)
    assert item.does != declare.unit(item)
    # A place in the report, one of its wishes (R1 to R19), a neighbour of it, or "chosen".
    known = r"(section|figure) \d+(\.\d+)*|introduction|R\d+|glskel effects|chosen"
    assert re.fullmatch(rf"({known})(, ({known}))*", item.source)
    assert declare.expected(item)


@each("key", NUMBERS)
def test_every_number_is_accepted_at_its_limits_and_refused_beyond(key: str) -> None:
    low, high = KEYS[key].limits
    assert [changed(key, low), changed(key, high)] == [low, high] and low < high
    beyond: list[object] = [low - 1, high + 1, 10**400, float("nan"), float("inf")]
    for wrong in [*beyond, True, None, "", []]:
        with pytest.raises(InputError, match=re.escape(f"setting {key}: expected ")):
            changed(key, wrong)


def test_the_preset_2006_is_the_defaults() -> None:
    assert preset("2006") == Settings()


def test_the_preset_best_sets_only_existing_keys_to_the_given_values() -> None:
    best = preset("best")
    for key, value in settings.BEST.items():
        assert key in KEYS
        assert get(best, key) == value
        assert value != KEYS[key].default, f"{key} need not stand in BEST"
    for key in KEYS.keys() - settings.BEST.keys():
        assert get(best, key) == KEYS[key].default


def test_an_unknown_preset_is_refused_with_the_known_ones() -> None:
    with pytest.raises(InputError, match=r"'worst'.*2006, best"):
        preset("worst")


def test_the_report_s_fog_is_the_default() -> None:
    fog = Settings().fog
    assert (fog.mode, fog.density, fog.color) == ("exp2", 0.12, (0.4, 0.6, 0.7))


@pytest.mark.parametrize("text", ["true", "True", "ON", "1", "yes"])
def test_words_for_true_are_understood(text: str) -> None:
    assert changed("water.fresnel", text) is True


@pytest.mark.parametrize("text", ["false", "False", "off", "0", "NO"])
def test_words_for_false_are_understood(text: str) -> None:
    assert changed("fog.enabled", text) is False


def test_numbers_are_read_as_people_write_them() -> None:
    assert changed("grass.count", "1_000_000") == 1_000_000
    assert changed("grass.count", 2000.0) == 2000 and isinstance(
        changed("grass.count", 2000.0), int
    )
    assert changed("fog.density", " 5e-2 ") == 0.05
    assert changed("fog.density", 1) == 1.0 and isinstance(changed("fog.density", 1), float)
    assert changed("fog.color", " .1, 0.2 ,.3") == (0.1, 0.2, 0.3)
    assert changed("fog.color", [0, 1, 0.5]) == (0.0, 1.0, 0.5)


def test_a_change_leaves_all_other_settings_and_the_original_alone() -> None:
    before = Settings()
    after = with_settings(before, {"fog.density": "0.05", "grass.count": 7})
    differing = {key for key in KEYS if get(before, key) != get(after, key)}
    assert differing == {"fog.density", "grass.count"}
    assert before == Settings()


def test_a_later_change_wins() -> None:
    once = with_settings(Settings(), {"fog.density": 0.5})
    assert with_settings(once, {"fog.density": 0.25}).fog.density == 0.25


def test_a_toml_file_may_use_tables_dotted_keys_and_a_byte_order_mark(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(
        "\ufeff# mine\ngrass.count = 1_000\r\n[fog]\r\ndensity = 0.05\ncolor = [0.5, 1, 0]\n"
        "enabled = false\nmode = 'exp'\n",
        encoding="utf-8",
    )
    values = with_settings(Settings(), read_toml(path))
    assert values.grass.count == 1000
    assert values.fog == settings.Fog(False, "exp", 0.05, (0.5, 1.0, 0.0))


def test_an_empty_toml_file_changes_nothing(tmp_path: Path) -> None:
    (tmp_path / "empty.toml").write_text("")
    assert read_toml(tmp_path / "empty.toml") == {}


def test_the_error_message_says_what_is_expected() -> None:
    for key, value, message in (
        ("grass.count", "2.5", "a whole number from 0 to 40000000, not '2.5'"),
        ("fog.color", "1,2", "3 numbers from 0 to 1, separated by commas, not '1,2'"),
        ("fog.mode", "exp3", "one of exp2, exp, linear, not 'exp3'"),
        ("fog.enabled", 2, "true or false, not 2"),
        ("rabbit.mesh", "", "a file name, not ''"),
    ):
        with pytest.raises(InputError) as caught:
            changed(key, value)
        assert str(caught.value) == f"setting {key}: expected {message}"


def test_a_row_of_the_list_has_the_value_and_the_default() -> None:
    row = declare.row(preset("best"), "fog.density")
    assert row["default"] == 0.12 and row["value"] == settings.BEST["fog.density"]
    assert row["unit"] == "per unit" and row["source"] == "section 10.2"
    assert (row["low"], row["high"], row["choices"]) == (0, 1000, ())


# The document's sections that have no part with a number of its own below them.
SECTIONS = {
    *("1", "2.1.1", "2.1.2", "2.2.1", "2.2.2", "3.1", "3.2", "4.1", "4.2", "5.1.1", "5.1.2"),
    *("5.2.1", "5.2.2", "5.3.1", "5.3.2", "6.1", "7.1", "7.2", "8.1", "8.2", "9.1", "9.2"),
    *("10.1", "10.2", "11.1", "11.2.1", "11.2.2", "11.2.3", "11.2.4", "11.2.5", "11.2.6", "12"),
}


@each("key", KEYS)
def test_a_setting_names_a_section_that_the_document_has(key: str) -> None:
    for cited in re.findall(r"section ([\d.]+)", KEYS[key].source):
        assert any(each == cited or each.startswith(cited + ".") for each in SECTIONS), key
