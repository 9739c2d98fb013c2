"""The sound of films: of their clips, faded as pictures are, encoded as a part of its own."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest
from commands import landscape, refused

from framelens.base.executor import lent_or_own
from landscape.film.cut import Film, Part
from landscape.film.making import write
from landscape.film.parted import draw, join
from landscape.film.replay import Recorded
from landscape.film.sound import BLOCK, blocks, eased, encoded
from landscape.film.stage import Drawing, Stage
from landscape.frame import Pose
from landscape.scene.scene import scene
from landscape.sound import steps
from landscape.sound.mixer import mix
from landscape.sound.score import KEYS_PER_SECOND, Heard, Score, standing
from landscape.sound.signal import RATE, rms
from landscape.sound.soundscape import Ear, Soundscape
from landscape.walk.recording import Plan, Tick
from landscape.walk.walker import Intent

DRAWING = Drawing((32, 24), 0)
GUSTY = Soundscape(windy=1.0)


@dataclass(frozen=True)
class Blown:
    """A clip in which the wind blows, and nothing is to be seen."""

    seconds: float
    needs_opengl: ClassVar[bool] = False

    def open(self, stage: Stage) -> Callable[[float], np.ndarray]:
        return lambda seconds: np.full((24, 32, 3), 90, np.uint8)

    def listen(self, stage: Stage) -> Callable[[float], Heard]:
        return lambda seconds: Heard(GUSTY, Ear(0.0, 2.0, 0.0, 0.0, 30.0 * seconds))


@dataclass(frozen=True)
class Silent:
    """A clip that cannot be heard."""

    seconds: float
    needs_opengl: ClassVar[bool] = False

    def open(self, stage: Stage) -> Callable[[float], np.ndarray]:
        return lambda seconds: np.zeros((24, 32, 3), np.uint8)


def heard(film: Film) -> np.ndarray:
    """Return all the sound of a film, (n, 2)."""
    return np.concatenate(list(blocks(film, Stage(film.drawing))))


def film_of(*parts: Part, ending: float = 0.0) -> Film:
    return Film(parts, DRAWING, Fraction(10), ending, sound=True)


def test_a_clip_is_heard_as_in_a_walk() -> None:
    film = film_of(Part(Blown(2.5)))
    score = standing(GUSTY, Ear(0.0, 2.0, 0.0, 0.0, 0.0), 2.5, 30.0)
    sound = heard(film)
    assert sound.shape == (round(2.5 * RATE), 2)
    # The last key is of the clip's end, not after it.
    same = round((2.5 - 1 / KEYS_PER_SECOND) * RATE)
    assert (sound[:same] == mix(score, 0, same)).all()
    assert same > BLOCK * RATE


def test_sound_fades_as_pictures_do() -> None:
    whole = heard(film_of(Part(Blown(4.0))))
    faded = heard(film_of(Part(Blown(4.0), fade=1.0), ending=1.0))
    seconds = np.arange(len(whole)) / RATE
    wanted = eased(seconds) * eased(4.0 - seconds)
    assert np.abs(faded - whole * wanted[:, None]).max() < 1e-6
    assert rms(faded[:480]) < 0.01 * rms(whole[:480])


def test_two_clips_cross_with_equal_power() -> None:
    film = film_of(Part(Blown(2.0)), Part(Blown(2.0), fade=1.0))
    sound = heard(film)
    assert len(sound) == 3 * RATE
    one = mix(standing(GUSTY, Ear(0.0, 2.0, 0.0, 0.0, 0.0), 2.0, 30.0), 0, 2 * RATE)
    at = round(1.5 * RATE)
    half = math.sqrt(0.5)
    mixed = half * one[at] + half * one[at - RATE]
    assert sound[at] == pytest.approx(mixed, abs=1e-4)
    assert np.abs(np.diff(sound, axis=0)).max() < 0.05


def test_a_clip_without_sound_is_silent() -> None:
    sound = heard(film_of(Part(Silent(1.0)), Part(Blown(1.0))))
    assert not sound[:RATE].any() and sound[RATE + 4800 :].any()


def decoded(path: Path) -> tuple[int, np.ndarray]:
    """Return how many pictures a film has, and its sound, (n, 2)."""
    av = pytest.importorskip("av")
    with av.open(str(path)) as opened:
        pictures = sum(1 for _ in opened.decode(video=0))
    with av.open(str(path)) as opened:
        sound = [frame.to_ndarray() for frame in opened.decode(audio=0)]
    return pictures, np.concatenate(sound, axis=1).T


@pytest.mark.seldom(13, first=7)
@pytest.mark.parametrize("ending", [".mp4", ".webm"])
def test_a_film_has_its_sound_byte_for_byte(tmp_path: Path, ending: str) -> None:
    film = film_of(Part(Blown(4.6)))
    first, second = (tmp_path / f"{name}{ending}" for name in ("first", "second"))
    assert write(film, first, 1) == write(film, second, 1) == 46
    assert first.read_bytes() == second.read_bytes()
    silent = tmp_path / f"silent{ending}"
    write(Film(film.parts, DRAWING, Fraction(10)), silent, 1)
    assert silent.stat().st_size < first.stat().st_size

    pictures, found = decoded(first)
    wanted = heard(film)
    assert pictures == 46
    assert abs(len(found) - len(wanted)) < 2048
    shared = min(len(found), len(wanted)) - 4800
    likeness = np.corrcoef(found[4800:shared, 0], wanted[4800:shared, 0])[0, 1]
    assert likeness > 0.9


@pytest.mark.seldom(10, first=9)
def test_the_parts_of_a_folder_are_joined_with_their_sound(tmp_path: Path) -> None:
    film = film_of(Part(Blown(4.6)))
    whole, joined = tmp_path / "whole.mp4", tmp_path / "joined.mp4"
    write(film, whole, 1)
    parting = draw(film, tmp_path / "parts", ".mp4", partial(lent_or_own, None, 1), 1)
    join(parting.parts, joined)
    assert joined.read_bytes() == whole.read_bytes()
    parting.parts.sound.unlink()
    with pytest.raises(Exception, match="sound-"):
        join(parting.parts, joined)


@pytest.mark.seldom(10, first=1)
def test_a_recorded_walk_is_heard_with_its_steps() -> None:
    kind = scene("hall")
    settings = kind.values(None, {"sound.muted": True})
    plan = Plan("hall", settings, "hall", Pose(1.4, None, 2.7, 0.0), (32, 24), only=("sword",))
    ticks = tuple(Tick(0.05, Intent(forward=1.0, run=True), (), (32, 24)) for _ in range(40))
    score, listening = Score(), None
    with Stage(DRAWING) as stage:
        listening = Recorded(plan, ticks, 2.0).listen(stage)
        for k in range(2 * KEYS_PER_SECOND + 1):
            score.add(k / KEYS_PER_SECOND, listening(k / KEYS_PER_SECOND))
    feet = [event for event in score.events if event.name == steps.STONE]
    assert len(feet) >= 2
    assert mix(score, 0, RATE).any()  # it was muted for the walker, not for the film


def test_sound_that_cannot_be_is_refused(tmp_path: Path) -> None:
    refused(landscape("film", "fig2a", "--sound", "--out", str(tmp_path / "a.gif")), "--sound")


def test_encoded_sound_does_not_depend_on_its_blocks() -> None:
    pytest.importorskip("av")
    sound = heard(film_of(Part(Blown(1.0))))
    parts: list[Any] = [sound[k : k + 7000] for k in range(0, len(sound), 7000)]
    assert encoded(iter([sound]), ".mp4") == encoded(iter(parts), ".mp4")
