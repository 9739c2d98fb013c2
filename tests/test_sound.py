"""The sound of the scenes: its sources, the mixer, and the command that writes a file of it."""

import math
import wave
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from commands import landscape, refused

from landscape.elements.best.sea.foam import PERIOD, turns
from landscape.files.assets import Assets
from landscape.scene.scene import Terrain, scene
from landscape.sound import bank, steps, wind
from landscape.sound.mixer import MOST, mix
from landscape.sound.room import LN_1000, Room
from landscape.sound.score import (
    BOB,
    LOW,
    UNEVEN,
    Heard,
    Key,
    Score,
    foot_down,
    footfalls,
    standing,
)
from landscape.sound.sea import Shore, drawn_swell
from landscape.sound.signal import QUANTUM, RATE, amplitude, decibels, rms
from landscape.sound.soundscape import Ear, Soundscape, pan

KT = 30.0  # a second
EDGE, INLAND, HILL = (22.9, 2.7), (20.5, 5.5), (13.1, 10.3)  # x, z on the island


@cache
def place(name: str) -> tuple[Soundscape, Terrain]:
    """Return what a scene sounds like in its preset best, and its terrain."""
    kind = scene(name)
    settings = kind.values(None)
    terrain = kind.terrain(settings, Assets())
    return kind.sounds(settings, terrain), terrain


def ear(name: str, x: float, z: float, kt: float = 0.0, yaw: float = 0.0, up: float = 0.1) -> Ear:
    return Ear(x, float(place(name)[1].height(x, z)) + up, z, yaw, kt)


def walked(seconds: float, volume: float = 1.0, frames: int = 30, more: int = 0) -> Score:
    """Return the score of a walk from the shore uphill; a stroke of the sword on the way."""
    score, ((x, z), (to_x, to_z)) = Score(), (EDGE, INLAND)
    soundscape = place("island")[0]
    for k in range(math.ceil(seconds * frames) + 1):
        since = k / frames
        share = min(since / 4.0, 1.0)
        here = ear("island", x + share * (to_x - x), z + share * (to_z - z), KT * since, 40.0)
        stroke = 1 if 0.5 < since < 0.7 else 0
        score.add(since, Heard(soundscape, here, 27.0 * since, stroke, more, 0, volume))
    return score


def stood(name: str, x: float, z: float, seconds: float, kt: float = 0.0) -> np.ndarray:
    score = standing(place(name)[0], ear(name, x, z, kt), seconds, KT)
    return mix(score, 0, round(seconds * RATE))


@pytest.mark.seldom(3)
def test_two_runs_are_equal_and_blocks_of_any_size_too() -> None:
    whole = mix(walked(1.2), 0, RATE)
    assert whole.dtype == np.float32 and whole.shape == (RATE, 2)
    assert (whole == mix(walked(1.2), 0, RATE)).all()
    score = walked(1.2)
    for size in (97, 480, 2048):
        parts = [mix(score, k, min(size, 4800 - k)) for k in range(0, 4800, size)]
        assert (np.concatenate(parts) == whole[:4800]).all(), size


def test_what_is_forgotten_is_not_heard_any_more() -> None:
    score = walked(1.2)
    later = mix(score, RATE // 2, RATE // 2)
    score.forget(RATE // 2 // QUANTUM)
    assert len(score.keys) < 30
    assert (mix(score, RATE // 2, RATE // 2) == later).all()


def test_a_walk_has_no_clicks_no_dc_and_headroom() -> None:
    sound = mix(walked(3.0), 0, 3 * RATE)
    assert np.isfinite(sound).all()
    assert np.abs(np.diff(sound, axis=0)).max() < 0.05
    assert np.abs(sound.mean(axis=0)).max() < 1e-3
    assert -22.0 < decibels(float(np.abs(sound).max())) < -11.0


def test_amplitudes_go_in_a_straight_line_from_one_frame_to_the_next() -> None:
    flame, score = Soundscape(fires=np.zeros((1, 3)), windy=0.0), Score()
    table = np.full((3, 2), 0.5, np.float32)
    score.keys = [Key(0, flame, 0 * table, 1.0), Key(4, flame, table, 1.0)]
    samples = 4 * QUANTUM
    loop = bank.loop(bank.FIRE, None)[:, :samples].sum(axis=0)
    expected = loop * 0.5 * np.arange(samples) / samples
    assert np.abs(mix(score, 0, samples) - expected[:, None]).max() < 1e-6


def test_nothing_is_above_the_limit_and_what_is_muted_is_silent() -> None:
    loud = mix(walked(2.0, volume=8.0), 0, 2 * RATE)
    assert 0.6 < np.abs(loud).max() <= MOST < 0.8913
    assert not mix(walked(0.5, volume=0.0), 0, RATE // 2).any()


def test_the_sea_is_loud_at_the_shore_and_hardly_heard_on_the_hill() -> None:
    soundscape, _ = place("island")
    sea = slice(0, 24)
    levels = {}
    for name, at in (("edge", EDGE), ("hill", HILL)):
        tables = [soundscape.heard(ear("island", *at, kt))[sea] for kt in range(0, 180, 10)]
        levels[name] = max(float(np.sqrt(np.square(table).sum())) for table in tables)
    assert levels["edge"] > 0.5
    assert levels["hill"] < 0.01 * levels["edge"]
    assert -42.0 < decibels(rms(stood("island", *EDGE, 6.0))) < -28.0


def test_the_sea_swells_when_the_drawn_wave_is_ashore() -> None:
    place_of_it = np.array([[5.0, 5.0]])
    shore = Shore(place_of_it, np.array([1.0]), 0.0, drawn_swell)
    times = np.arange(0.0, PERIOD)
    loud = np.array([shore.loudness(5.0, 0.1, 5.3, kt).sum(axis=0) for kt in times])
    drawn = [float(np.cos(turns(place_of_it[:, 0], place_of_it[:, 1], kt))[0]) for kt in times]
    crest = int(np.argmax(drawn))
    thud, hiss = (int(np.argmax(loud[:, band])) for band in (0, 2))
    assert abs((thud - crest + 90) % 180 - 90) <= 2
    assert 10 < (hiss - crest) % 180 < 60  # the foam runs up the beach after the breaker
    assert loud[:, 0].max() > 5 * loud[:, 0].min()


def test_far_shores_are_fainter_and_duller() -> None:
    shore = Shore(np.array([[0.0, 0.0]]), np.array([1.0]), 0.0, drawn_swell)
    near, far = (shore.loudness(x, 0.0, 0.0, 0.0).sum(axis=0) for x in (0.5, 3.0))
    assert (far < near / 3).all()
    assert far[2] / near[2] < 0.5 * far[0] / near[0]


def test_the_wind_rises_with_the_gusts_that_bend_the_grass() -> None:
    kts = np.arange(0.0, 400.0, 2.0)
    loud = np.array([wind.loudness(kt, 10.0, 10.0, 0.0, 1.0, 1.0) for kt in kts])
    calm = np.array([wind.loudness(kt, 10.0, 10.0, 0.0, 0.0, 1.0) for kt in kts])
    speeds = np.array([wind.speed(kt, np.array([9.7]), np.array([10.0]))[0] for kt in kts])
    assert np.corrcoef(loud[:, 0, 0], speeds)[0, 1] > 0.95
    assert loud[:, 0, 2].max() > 4 * calm[:, 0, 2].max()
    # A gust is at one ear before it is at the other.
    assert np.abs(loud[:, 0, 0] - loud[:, 1, 0]).max() > 0.1
    # It sounds higher, not only louder.
    assert (loud[:, 0, 2] / loud[:, 0, 0]).max() > 3 * (loud[:, 0, 2] / loud[:, 0, 0]).min()


def centroid(sound: np.ndarray) -> float:
    """Return the mean frequency of a sound in Hz, weighted by its power."""
    power = np.square(np.abs(np.fft.rfft(sound)))
    return float((np.fft.rfftfreq(len(sound), 1 / RATE) * power).sum() / power.sum())


def test_a_step_sounds_like_its_ground() -> None:
    found = {
        name: float(np.mean([centroid(each[:, 0]) for each in bank.short(name, None)[:3]]))
        for name in steps.GROUNDS
    }
    assert 200.0 < found["stone"] < 1000.0
    assert 500.0 < found["water"] < 1500.0
    assert 1000.0 < found["sand"] < 3000.0
    assert 3000.0 < found["grass"] < 6000.0
    variants = bank.short("sand", None)
    assert len(variants) == 8 and len(np.unique(variants[:, 2000, 0])) == 8


@pytest.mark.parametrize(
    ("x", "z", "ground"),
    [(12.5, 27.6, "water"), (20.0, 24.0, "grass"), (27.3, 16.9, "stone"), (*HILL, "grass")],
)
def test_the_ground_underfoot(x: float, z: float, ground: str) -> None:
    soundscape, terrain = place("island")
    assert soundscape.ground(x, float(terrain.height(x, z)) + 0.1, z) == ground


def test_beaches_are_sand() -> None:
    soundscape, terrain = place("island")
    found = [
        soundscape.ground(x, 1.0, z)
        for x, z in np.random.default_rng(1).uniform(2.0, 38.0, (400, 2))
        if 0.65 < float(terrain.height(x, z)) < 0.75
    ]
    assert found.count("sand") > 0.6 * len(found) > 5


def test_a_foot_comes_down_about_where_the_head_is_lowest() -> None:
    assert math.cos(LOW / 3) == pytest.approx(-1.0)
    around = UNEVEN * BOB
    low = [LOW + BOB * k for k in range(3)]
    assert [len(footfalls(at - 1.01 * around, at + 1.01 * around)) for at in low] == [1, 1, 1]
    assert len(footfalls(5.0, 5.0)) == len(footfalls(30.0, 5.0)) == len(footfalls(0.0, 500.0)) == 0
    score = walked(2.0)
    feet = [event.sample / RATE for event in score.events if event.name in steps.GROUNDS]
    assert feet == pytest.approx([foot_down(k) / 27.0 for k in range(len(feet))], abs=0.004)
    apart = np.diff([foot_down(k) for k in range(200)]) / BOB
    assert len(set(apart.round(3))) > 40 and apart.mean() == pytest.approx(1.0, abs=0.01)
    assert 1 - 2 * UNEVEN <= apart.min() < 0.95 and 1.05 < apart.max() <= 1 + 2 * UNEVEN
    assert len(feet) == 3
    # However fast the frames come, the feet come down at the same time.
    slow = [e.sample for e in walked(2.0, frames=11).events if e.name in steps.GROUNDS]
    assert slow == pytest.approx([round(at * RATE) for at in feet], abs=600)
    assert [event.name for event in score.events if event.name == bank.STROKE] == [bank.STROKE]


def test_blocks_are_heard_when_they_are_dug_and_placed() -> None:
    soundscape, score = place("voxel")[0], Score()
    here = ear("voxel", 14.6, 32.3)
    for since, dug, placed in ((0.0, 4, 1), (0.1, 5, 1), (0.2, 5, 3)):
        score.add(since, Heard(soundscape, here, dug=dug, placed=placed))
    assert [event.name for event in score.events] == [bank.DIG, bank.PLACE, bank.PLACE]
    silent = standing(soundscape, here, 0.4, 0.0)
    begin = round(0.1 * RATE)
    difference = np.abs(mix(score, 0, RATE // 4) - mix(silent, 0, RATE // 4))
    assert difference[:begin].max() < 1e-6
    assert difference[begin : begin + 4800].max() > 0.05


def test_sides_have_equal_power_and_what_is_at_the_right_is_heard_there() -> None:
    for relative in (0.0, 33.0, 90.0, 200.0):
        assert np.square(pan(relative)).sum() == pytest.approx(1.0)
    assert pan(90.0)[0] == pytest.approx(0.0, abs=1e-9) and pan(-90.0)[1] == pytest.approx(0.0)
    assert pan(0.0)[0] == pytest.approx(pan(180.0)[1])
    flame = np.array([[1.0, 0.0, 0.0]])
    fire = Soundscape(fires=flame, windy=0.0)
    facing_north, facing_south = (fire.heard(Ear(0.8, 0.0, 0.0, yaw, 0.0)) for yaw in (0.0, 180.0))
    assert (facing_north[:, 1] > 5 * facing_north[:, 0]).all()
    assert (facing_south[:, 0] > 5 * facing_south[:, 1]).all()


def test_fire_is_heard_at_the_gate_and_falls_off_with_distance() -> None:
    gate = place("island")[0]
    x, y, z = gate.fires.mean(axis=0)
    only = replace(gate, shore=None, windy=0.0)
    levels = [
        rms(mix(standing(only, Ear(x, y, z + away, 0.0, 0.0), 1.0, KT), 0, RATE))
        for away in (0.1, 0.5, 3.0)
    ]
    assert -48.0 < decibels(levels[0]) < -30.0
    assert levels[0] > 2 * levels[1] > 50 * levels[2]


def test_fire_crackles() -> None:
    _, hiss, crackle = bank.loop(bank.FIRE, None)
    assert np.abs(crackle).max() > 12 * rms(crackle)  # a few loud ones, and pauses
    assert np.abs(hiss).max() < 13 * rms(hiss) < np.abs(crackle).max()


@pytest.mark.seldom(10, first=4)
def test_loops_are_long_and_have_no_seam() -> None:
    room = place("hall")[0].room
    for name in (bank.SEA, bank.WIND, bank.FIRE, bank.DROPS, bank.AIR):
        loop = bank.loop(name, None if name in bank.OPEN else room)
        assert loop.dtype == np.float32
        assert loop.shape[1] - QUANTUM >= 8 * RATE
        once = loop[:, :-QUANTUM]
        seam = np.abs(once[:, 0] - once[:, -1])
        assert (seam <= np.abs(np.diff(once, axis=1)).max(axis=1)).all()
        assert (loop[:, -QUANTUM:] == loop[:, :QUANTUM]).all()
        assert np.abs(once.mean(axis=1)).max() < 1e-4


@pytest.mark.seldom(10, first=4)
def test_the_hall_rings_as_sabine_has_it() -> None:
    room = Room(1000.0, 700.0, 0.1)
    assert room.seconds == pytest.approx(0.161 * 1000 / 70)
    echo = room.echo(1)
    assert np.square(echo).sum() == pytest.approx(1.0)
    low = np.array([rms(echo[k : k + 4800]) for k in (4800, 48_000)])
    # All decays, high notes sooner than Sabine's time, which is that of the low ones.
    fall = -math.log(low[1] / low[0]) / 0.9
    assert LN_1000 / room.seconds < fall < 1.8 * LN_1000 / room.seconds
    hall, open_air = place("hall")[0], place("island")[0]
    assert hall.room is not None and 2.0 < hall.room.seconds < 5.0
    ringing, dry = hall.short("stone")[0], open_air.short("stone")[0]
    assert rms(ringing[RATE : 2 * RATE]) > 1e-4 and len(dry) < RATE
    assert -50.0 < decibels(rms(stood("hall", 1.6, 2.6, 2.0))) < -32.0


@pytest.mark.seldom(5, first=3)
def test_a_door_leads_from_one_sound_into_the_other_without_a_jump() -> None:
    score = Score()
    for k in range(20):
        name, at = ("island", (27.5, 17.5)) if k < 10 else ("hall", (1.6, 2.6))
        score.add(k / 25, Heard(place(name)[0], ear(name, *at, KT * k / 25)))
    sound = mix(score, 0, round(0.75 * RATE))
    assert np.abs(np.diff(sound, axis=0)).max() < 0.05
    alone = stood("hall", 1.6, 2.6, 0.2)
    assert rms(sound[-4800:]) == pytest.approx(rms(alone[-4800:]), rel=0.6)


def test_under_water_only_the_low_bands_are_left() -> None:
    soundscape, _ = place("island")
    above, below = (soundscape.heard(Ear(*(EDGE[0], y, EDGE[1]), 0.0, 60.0)) for y in (0.62, 0.3))
    for row, left in ((0, 0.9), (2, 0.05)):
        assert below[row:24:3].max() < left * above[row:24:3].max()
    assert below[0:24:3].max() > 0.2 * above[0:24:3].max()


def test_each_scene_says_what_it_sounds_like() -> None:
    for name, at in (("island", EDGE), ("hall", (1.6, 2.6)), ("voxel", (14.6, 32.3))):
        sound = stood(name, *at, 0.5)
        assert -55.0 < decibels(rms(sound)) < -25.0, name
    assert amplitude(-1.0) == pytest.approx(MOST)


def test_the_command_writes_a_file_that_can_be_played(tmp_path: Path) -> None:
    out = tmp_path / "shore.wav"
    done = landscape("sound", "fig35e", "--seconds", "0.5", "--out", str(out), "--kt", "90")
    assert (done.status, done.out) == (0, f"{out}\n")
    assert "dBFS" in done.err
    with wave.open(str(out)) as file:
        assert file.getparams()[:4] == (2, 2, RATE, RATE // 2)
        samples = np.frombuffer(file.readframes(RATE), "<i2")
    assert 20 < np.abs(samples).max() < 30_000
    again = tmp_path / "again.wav"
    landscape("sound", "fig35e", "--seconds", "0.5", "--out", str(again), "--kt", "90", "-q")
    assert out.read_bytes() == again.read_bytes()


def test_the_command_refuses_what_it_cannot_write(tmp_path: Path) -> None:
    refused(landscape("sound", "fig35e", "--out", str(tmp_path / "a.mp3")), "--out", ".wav")
    refused(landscape("sound", "fig35e", "--out", "a.wav", "--seconds", "0"), "--seconds", "0.01")
    refused(landscape("sound", "nowhere", "--out", "a.wav"), "nowhere")
