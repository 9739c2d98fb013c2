"""The island's slots without OpenGL: which class the settings ask for, said by the classes."""

from typing import Any

import pytest
from other_values import another

from landscape.elements.element import Element
from landscape.elements.settings import Settings, preset
from landscape.island.slots import SLOTS
from landscape.settings.declare import fields, with_settings

KEYS = fields(Settings)
CLASSES = [(slot, kind) for slot in SLOTS for kind in slot.kinds]
ASKED = [
    (slot, kind, key)
    for slot, kind in CLASSES
    if kind.serves.__func__ is Element.serves.__func__  # type: ignore[attr-defined]
    for key in kind.asked_by
]


@pytest.mark.parametrize(("slot", "kind"), CLASSES, ids=lambda each: getattr(each, "name", None))
def test_the_keys_that_a_class_names_are_settings(slot: Any, kind: type[Element[Any]]) -> None:
    assert {*kind.asked_by, *kind.ignores} <= KEYS.keys()


@pytest.mark.parametrize("slot", SLOTS, ids=lambda slot: slot.name)
def test_by_the_defaults_the_technique_of_2006_is_drawn(slot: Any) -> None:
    assert slot.kind(Settings()) in (slot.kinds[-1], None)


@pytest.mark.parametrize(
    ("slot", "kind", "key"), ASKED, ids=[f"{kind.__name__}-{key}" for _, kind, key in ASKED]
)
def test_each_key_that_asks_for_a_class_is_enough(slot: Any, kind: Any, key: str) -> None:
    changed = with_settings(Settings(), {key: another(key, KEYS[key], KEYS[key].default)})
    assert slot.kind(changed) is kind


def test_the_preset_best_asks_for_the_finest_of_most() -> None:
    kinds = {slot.name: slot.kind(preset("best")) for slot in SLOTS}
    finest = {slot.name: slot.kinds[0] for slot in SLOTS}
    assert {name for name in kinds if kinds[name] is not finest[name]} == {"ring", "mist"}
