"""What a run leaves out of a sweep: each case has its day."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from conftest import names_cases, not_today, todays_of
from folded import each
from sweeps import LONG, longest_first


def case(test: str, number: int, marker: Any) -> Any:
    def closest(name: str) -> Any:
        return marker if marker is not None and marker.name == name else None

    return SimpleNamespace(nodeid=f"{test}[{number}]", get_closest_marker=closest)


def cases(test: str, count: int, every: int, first: int = 0) -> list[Any]:
    marker = pytest.mark.sweep(every, first=first).mark
    return [case(test, number, marker) for number in range(count)]


def left(items: list[Any], day: int) -> list[str]:
    rest = not_today(items, day)
    return [item.nodeid for item in items if item not in rest]


@pytest.mark.parametrize(("count", "every"), [(9, 3), (10, 4), (2, 8), (1, 3)])
def test_each_case_of_a_sweep_has_run_after_as_many_days(count: int, every: int) -> None:
    items = cases("test_one", count, every)
    days = [left(items, day) for day in range(every)]
    assert sum(map(bool, days)) == min(count, every)
    assert sorted(each for day in days for each in day) == sorted(item.nodeid for item in items)


@pytest.mark.parametrize(("count", "every"), [(100, 14), (9, 3), (2, 8)])
def test_neighbours_run_on_the_same_day_and_each_case_has_run_after_as_many_days(
    count: int, every: int
) -> None:
    marker = pytest.mark.sweep(every, first=1, neighbours=True).mark
    items = [case("test_one", number, marker) for number in range(count)]
    days = [left(items, day) for day in range(-1, every - 1)]
    assert [name for day in days for name in day] == [item.nodeid for item in items]
    assert max(map(len, days)) <= -(-count // every)


def test_sweeps_through_one_list_take_other_cases_of_it_on_each_day() -> None:
    items = cases("test_one", 6, 2) + cases("test_other", 6, 2, first=1)
    for day in range(4):
        numbers = [name.partition("[")[2] for name in left(items, day)]
        assert sorted(numbers) == [f"{number}]" for number in range(6)]


def test_a_seldom_test_runs_on_one_day_in_n() -> None:
    items = [case("test_long", 0, pytest.mark.seldom(3, first=1).mark)]
    assert [len(left(items, day)) for day in range(6)] == [0, 0, 1, 0, 0, 1]


@pytest.mark.parametrize(("count", "every", "turns"), [(6, 2, 14), (9, 3, 10), (3, 10, 14)])
def test_a_seldom_test_takes_other_cases_in_each_turn(
    count: int, every: int, turns: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    config: Any = SimpleNamespace(
        args=["tests"], option=SimpleNamespace(keyword=""), getoption=lambda name: False
    )
    seen: list[int] = []
    for turn in range(every):
        monkeypatch.setenv("LANDSCAPE_TESTS_DAY", str(3 + turns * turn))
        chosen = todays_of(config)(range(count), every, turns)
        assert chosen
        seen += chosen
    assert {*seen} == {*range(count)}


def test_other_tests_always_run() -> None:
    items = [case("test_plain", number, None) for number in range(3)]
    assert not_today(items, 5) == []


@pytest.mark.parametrize(
    ("args", "keyword", "named"),
    [
        (["tests/test_bench.py"], "", False),
        (["tests/test_bench.py::test_it"], "", True),
        (["tests/test_lessons.py"], "fog or ladder", True),
        (["tests"], "not window", False),
    ],
)
def test_what_is_named_by_its_path_or_a_word_is_run(
    args: list[str], keyword: str, named: bool
) -> None:
    config: Any = SimpleNamespace(args=args, option=SimpleNamespace(keyword=keyword))
    assert names_cases(config) is named


@each("colour", ["red", "green"])
def test_a_folded_test_is_found_by_each_of_its_cases(
    colour: str, request: pytest.FixtureRequest
) -> None:
    assert colour in request.function.__dict__


def test_a_folded_test_lists_every_case_that_fails() -> None:
    @each("number", [1, 2, 3, 4], ids=lambda number: f"case {number}")
    def only_even(number: int, wanted: int) -> None:
        assert number % 2 == wanted

    with pytest.raises(AssertionError, match="2 of 4 failed") as caught:
        only_even(wanted=0)
    said = str(caught.value)
    assert "case 1: " in said and "case 3: " in said and "case 2" not in said
    with pytest.raises(AssertionError, match="no case"):
        each("number", [])(only_even)()


def test_each_file_that_takes_long_is_there_and_begins_before_the_others() -> None:
    here = Path(__file__).parent
    assert [name for name in LONG if not (here / f"test_{name}.py").exists()] == []
    assert longest_first(f"tests/test_{LONG[1]}.py") == 1
    assert longest_first("tests/test_sweeps.py") == len(LONG)
