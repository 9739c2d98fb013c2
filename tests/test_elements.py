"""Slots and elements without OpenGL: which class is built, what is kept, what is built again."""

from collections.abc import Hashable, Iterator
from dataclasses import dataclass
from typing import Self

import numpy as np
import pytest

from framelens.gl.seam import drawn_now
from landscape.elements.element import Element, Elements, Site, Slot
from landscape.files.assets import Assets
from landscape.frame import Frame, Pose
from landscape.settings.declare import setting, with_settings


@dataclass(frozen=True)
class Lake:
    """A group of settings."""

    waves: float = setting(0.0, "chosen", "how high", 0, 1)
    size: int = setting(4, "chosen", "how wide", 1, 9)
    color: float = setting(0.5, "chosen", "how blue", 0, 1)
    wrecked: bool = setting(False, "chosen", "a ship that cannot be built")
    boat: bool = setting(False, "chosen", "a boat")


@dataclass(frozen=True)
class Settings:
    """The settings of a scene with a lake."""

    lake: Lake = Lake()


EVENTS: list[str] = []


class Noting(Element[Settings]):
    """Notes what becomes of it."""

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        EVENTS.append(f"build {cls.__name__}")
        return cls(site.settings)

    def __init__(self, settings: Settings) -> None:
        self.settings = settings

    def draw(self, frame: Frame) -> None:
        EVENTS.append(f"draw {type(self).__name__} as {', '.join(drawn_now())}")

    def release(self) -> None:
        EVENTS.append(f"release {type(self).__name__}")


class Bed(Noting):
    """What the rest stands on."""

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        return settings.lake.size


class Still(Noting):
    """Plain water."""


class Wavy(Still):
    """Finer water."""

    asked_by = ("lake.waves",)


class Ship(Noting):
    """What cannot be built if it is wrecked, or taken."""

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        return settings.lake.wrecked

    def __init__(self, settings: Settings) -> None:
        super().__init__(settings)
        if settings.lake.wrecked:
            raise ValueError("wrecked")


class Boat(Noting):
    """What is built only if it is asked for, and beside a ship."""

    asked_by = ("lake.boat",)


SLOTS = (
    Slot("bed", (Bed,), shown_by=("land",), base=True),
    Slot("water", (Wavy, Still)),
    Slot("ship", (Ship,)),
    Slot("boat", (Boat,), shown_by=("ship", "water"), beside=("ship",)),
)
ONLY = ("land", "water", "ship")
FRAME = Frame(Pose(0.0, 0.0, 0.0, 0.0, 0.0), (8, 8), 0.0, np.eye(4), 60.0)


def changed(**lake: object) -> Settings:
    return with_settings(Settings(), {f"lake.{name}": value for name, value in lake.items()})


def opened(only: tuple[str, ...] = ONLY, **lake: object) -> Elements[Settings]:
    elements = Elements(changed(**lake), Assets(), 0, only)
    with elements.building():
        elements.build(*SLOTS)
    return elements


def filled_again(elements: Elements[Settings], settings: Settings) -> list[str]:
    names = elements.apply(settings)
    assert names is not None
    return list(names)


@pytest.fixture(autouse=True)
def events() -> Iterator[list[str]]:
    EVENTS.clear()
    yield EVENTS


def test_the_finest_class_that_is_asked_for_is_built() -> None:
    assert type(opened()[Still]) is Still
    assert type(opened(waves=0.1)[Still]) is Wavy
    assert opened().get(Boat) is None and opened(boat=True).get(Boat) is not None


def test_what_cannot_be_shown_is_not_built() -> None:
    elements = opened(only=("land", "water"), boat=True)
    assert elements.get(Ship) is None and elements.get(Boat) is None
    with pytest.raises(LookupError, match="Ship"):
        elements[Ship]


def test_an_element_is_drawn_under_the_names_that_show_it(events: list[str]) -> None:
    elements = opened()
    events.clear()
    elements.draw("bed", FRAME)
    elements.draw("boat", FRAME)  # not built
    elements.shown = {"water"}
    elements.draw("bed", FRAME)  # not shown
    assert events == ["draw Bed as land"]


def test_settings_are_taken_where_nothing_would_be_built_otherwise(events: list[str]) -> None:
    elements = opened()
    events.clear()
    assert filled_again(elements, changed(color=0.2)) == []
    assert events == []
    assert all(elements[kind].settings.lake.color == 0.2 for kind in (Bed, Still, Ship))


def test_another_class_is_built_in_its_slot_alone(events: list[str]) -> None:
    elements = opened()
    bed = elements[Bed]
    events.clear()
    assert filled_again(elements, changed(waves=0.3, boat=True)) == ["water", "boat"]
    assert events == ["build Wavy", "build Boat", "release Still"]
    assert elements[Bed] is bed and type(elements[Still]) is Wavy
    events.clear()
    assert filled_again(elements, Settings()) == ["water", "boat"]
    assert events == ["build Still", "release Wavy", "release Boat"]


def test_a_base_is_never_built_again_alone(events: list[str]) -> None:
    elements = opened()
    events.clear()
    assert elements.apply(changed(size=5, waves=0.3)) is None
    assert events == [] and elements[Still].settings == Settings()


def test_what_cannot_be_built_leaves_all_as_it_was(events: list[str]) -> None:
    elements = opened()
    before = [elements[kind] for kind in (Bed, Still, Ship)]
    events.clear()
    with pytest.raises(ValueError, match="wrecked"):
        elements.apply(changed(waves=0.3, color=0.2, wrecked=True))
    assert [elements[kind] for kind in (Bed, Still, Ship)] == before
    assert all(element.settings == Settings() for element in before)
    assert events == ["build Wavy", "build Ship", "release Wavy"]
    # Afterwards other settings are taken as ever.
    assert elements.apply(changed(color=0.2)) is not None


def test_a_scene_that_cannot_be_built_releases_what_was_built(events: list[str]) -> None:
    with pytest.raises(ValueError, match="wrecked"):
        opened(wrecked=True)
    assert events[-2:] == ["release Still", "release Bed"]
