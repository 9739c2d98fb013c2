"""A film's frame depends on its moment alone: whatever was drawn before it, and wherever."""

import random
from fractions import Fraction

import numpy as np
import pytest
from commands import need_library
from stage import SMALL, SMALL_BEST

from framelens.base.executor import executor
from landscape.film.cut import Film
from landscape.film.frames import drawn
from landscape.film.sources import Wanted, film_of
from landscape.film.stage import Drawing, Stage

SIZE = (96, 64)
NEAR = 1 / 40  # seconds between two frames of which one may keep what the other chose
FLIGHTS = {
    "2006": (["fig35a", "fig35e"], {"preset": "2006", "changes": SMALL}),
    "best": (["fig35a", "fig35e", "fig35f"], {"preset": "best", "changes": SMALL_BEST}),
    "hall": (["hall", "hall_mirror", "hall_caustics"], {}),
    "voxel": (["voxel_bay", "voxel_water", "voxel_cliff"], {}),
}


def flight(name: str) -> Film:
    need_library("OSMesa")
    words, asked = FLIGHTS[name]
    drawing = Drawing(SIZE, samples=0, backend="osmesa")
    return film_of(words, Wanted(drawing, fps=1 / NEAR, seconds=12.0, **asked))


def drawn_in(film: Film, order: list[int]) -> dict[int, np.ndarray]:
    with Stage(film.drawing) as stage:
        picture = film.open(stage)
        return {number: picture(number).copy() for number in order}


def random_frames(film: Film, count: int) -> list[int]:
    """Return frames of which each has a neighbour."""
    rng = random.Random(film.frames)
    pairs = [rng.randrange(film.frames - 2) for _ in range(count)]
    return list(dict.fromkeys(number + more for number in pairs for more in (0, 1, 2)))


@pytest.mark.parametrize("name", FLIGHTS)
@pytest.mark.sweep(12, first=4)
def test_random_frames_in_random_order_are_the_same_in_a_fresh_and_in_a_used_process(
    name: str,
) -> None:
    film = flight(name)
    frames = random_frames(film, 3)
    first = drawn_in(film, frames)
    again = drawn_in(film, random.Random(7).sample(frames, len(frames)))
    assert [k for k in frames if not np.array_equal(first[k], again[k])] == []
    assert len({pixels.tobytes() for pixels in first.values()}) > len(frames) / 2


@pytest.mark.slow
@pytest.mark.seldom(14, first=4)
@pytest.mark.parametrize("name", FLIGHTS)
def test_all_frames_are_the_same_forwards_backwards_and_in_other_processes(name: str) -> None:
    film = flight(name)
    numbers = list(range(film.frames))
    forwards, backwards = drawn_in(film, numbers), drawn_in(film, numbers[::-1])
    with executor(2) as workers:
        shared = dict(enumerate(drawn(film, workers, 2)))
    assert film.fps == Fraction(40)
    for other in (backwards, shared):
        assert [k for k in numbers if not np.array_equal(forwards[k], other[k])] == []
