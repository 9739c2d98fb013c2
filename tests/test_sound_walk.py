"""Sound in a walk: the ring and the device, captions with their arrows, the key that mutes."""

import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from importlib.machinery import ModuleSpec
from pathlib import Path
from threading import Event
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from commands import SECONDS

from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.scene.scene import scene
from landscape.sound import bank
from landscape.sound.captions import LASTS, Line, lines
from landscape.sound.score import Event as Sounded
from landscape.sound.score import Heard
from landscape.sound.signal import QUANTUM, RATE
from landscape.sound.soundscape import Ear, Soundscape
from landscape.walk import session, words
from landscape.walk.app import Walk
from landscape.walk.caption_image import caption_image
from landscape.walk.hearing import Hearing, captioned
from landscape.walk.recording import Plan, Tick
from landscape.walk.speaker import AHEAD, FADE, Ring, Speaker, quiet
from landscape.walk.walker import Intent

FLAME = Soundscape(fires=np.array([[1.0, 0.0, 0.0]]), windy=0.0)


def tone(count: int) -> np.ndarray:
    """Return int16 samples (count, 2) that are nowhere 0."""
    return np.full((count, 2), 9000, np.int16)


def test_the_ring_gives_what_was_written_in_order() -> None:
    ring, given = Ring(1000), []
    samples = np.arange(1, 4001, dtype=np.int16)[:, None].repeat(2, axis=1)
    ring.write(samples[:600])
    given.append(ring.take(400))
    for begin in range(600, 4000, 200):
        ring.write(samples[begin : begin + 200])
        given.append(ring.take(200))
    found = np.concatenate(given)
    assert (found[FADE:] == samples[FADE : len(found)]).all()
    assert ring.ready == 200


def test_what_does_not_fit_into_the_ring_is_dropped() -> None:
    ring = Ring(100)
    ring.write(tone(150))
    assert ring.ready == 100


def test_where_nothing_lies_ready_the_sound_fades_out_and_in_again() -> None:
    ring = Ring()
    ring.write(tone(2000))
    heard = [ring.take(1500), ring.take(1500)]
    ring.write(tone(1000))
    heard.append(ring.take(800))
    sound = np.concatenate(heard).astype(float)
    assert np.abs(np.diff(sound[:, 0])).max() <= 9000 / FADE + 1
    assert (sound[FADE:2000] == 9000).all()
    assert not sound[2000 + FADE : 3000].any()
    assert sound[3000 + FADE, 0] == 9000


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A home folder of one's own: libraries of sound systems write into it."""
    for name in ("HOME", "XDG_CONFIG_HOME", "XDG_RUNTIME_DIR"):
        monkeypatch.setenv(name, str(tmp_path))
    yield tmp_path


def test_the_null_device_takes_what_is_written(home: Path) -> None:
    pytest.importorskip("miniaudio", reason="the extra `sound` is not installed")
    speaker = Speaker(null=True)
    try:
        assert speaker.wanted(0.0) == round(AHEAD * RATE / QUANTUM)
        speaker.write(np.zeros((speaker.wanted(0.3) * QUANTUM, 2), np.float32))
        for _ in range(200):
            if speaker.ring.taken > QUANTUM:
                break
            time.sleep(0.01)
        assert speaker.ring.taken > QUANTUM
    finally:
        speaker.close()
    speaker.close()


def prepared(hearing: Hearing) -> None:
    """Wait until what may be heard has been made."""
    assert hearing._preparing is not None
    hearing._preparing.join()


@pytest.mark.parametrize("installed", [False, True])
def test_a_walk_prepares_sound_where_something_can_play_it(
    installed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    given: list[object] = []

    def opened(*_: object, speaker: object, **__: object) -> None:
        given.append(speaker)
        raise LookupError

    module = ModuleType("miniaudio")
    module.__spec__ = ModuleSpec("miniaudio", None)
    monkeypatch.setitem(sys.modules, "miniaudio", module if installed else None)  # type: ignore[arg-type]
    monkeypatch.setattr(session, "Walk", opened)
    island = scene("island")
    view = island.views[island.start]
    with pytest.raises(LookupError):
        session.walk(island, view, island.values(None), Assets())
    assert given == [Speaker if installed else None]


def playing(opens: Callable[[], Any]) -> tuple[Hearing, bool]:
    """Return what hears the second frame of a walk, and whether there is a device."""
    hearing = Hearing(opens)
    assert not hearing.plays(1.0)  # the first picture does not wait for it
    return hearing, hearing.plays(1.0)


def test_where_no_device_opens_no_sound_is_made(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Soundscape, "prepare", lambda *_: pytest.fail("prepared"))
    asked = []

    def opens() -> Speaker:
        asked.append(1)
        raise OSError("no device")

    hearing, plays = playing(opens)
    assert not plays
    for k in range(3):
        hearing.hear(Heard(FLAME, Ear(0.5, 0.0, 0.0, 0.0, 0.0)), float(k), False)
        assert not hearing.plays(1.0)
    assert hearing._preparing is None and asked == [1]
    hearing.release()


def test_without_miniaudio_a_walk_is_silent_and_says_nothing(
    home: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "miniaudio", None)
    assert not playing(Speaker)[1]
    assert capfd.readouterr() == ("", "")


def test_nothing_is_written_to_standard_error_in_between(capfd: pytest.CaptureFixture[str]) -> None:
    import os

    os.write(2, b"before ")
    with quiet():
        os.write(2, b"ALSA lib confmisc.c: cannot find card 0")
    os.write(2, b"after")
    assert capfd.readouterr().err == "before after"


class Recorder:
    """A speaker that keeps what is written."""

    def __init__(self) -> None:
        self.samples: list[np.ndarray] = []
        self.closed = False

    def wanted(self, seconds: float) -> int:
        return 4

    def write(self, samples: np.ndarray) -> None:
        self.samples.append(samples)

    def close(self) -> None:
        self.closed = True


def test_what_is_heard_goes_to_the_speaker_block_by_block_without_a_jump() -> None:
    speaker = Recorder()
    hearing, _ = playing(lambda: speaker)
    FLAME.prepare()
    for k in range(60):
        hearing.hear(Heard(FLAME, Ear(0.9 - 0.02 * k, 0.0, 0.1, 3.0 * k, float(k))), k / 25, False)
        prepared(hearing)
    sound = np.concatenate(speaker.samples)
    assert len(sound) % (4 * QUANTUM) == 0 and len(sound) >= 59 * 4 * QUANTUM
    assert np.abs(sound).max() > 0.01
    assert np.abs(np.diff(sound, axis=0)).max() < 0.05
    hearing.release()
    assert speaker.closed


def test_a_walk_that_begins_muted_opens_no_device() -> None:
    hearing = Hearing(lambda: pytest.fail("opened"))
    assert not any(hearing.plays(0.0) for _ in range(3))
    hearing.release()


def test_who_leaves_waits_for_the_sound_that_is_being_made_and_for_no_other(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    (hearing, _), begun = playing(Recorder), Event()
    made = []

    def make(name: str, _: object) -> None:
        made.append(name)
        begun.set()
        assert hearing._released.wait(SECONDS)

    monkeypatch.setattr(bank, "loop", make)
    monkeypatch.setattr(bank, "short", make)
    hearing.hear(Heard(FLAME, Ear(0.5, 0.0, 0.0, 0.0, 0.0)), 0.0, False)
    assert begun.wait(SECONDS)
    hearing.release()
    assert len(made) == 1


@pytest.mark.parametrize(
    ("yaw", "arrow"),
    [(0.0, "→"), (90.0, "↑"), (180.0, "←"), (270.0, "↓"), (45.0, "↗"), (135.0, "↖")],
)
def test_an_arrow_leads_to_what_is_heard(yaw: float, arrow: str) -> None:
    now = Heard(FLAME, Ear(0.9, 0.0, 0.0, yaw, 0.0))
    (line,) = lines(now, [], 0.0)
    assert (line.name, line.arrow) == ("fire", arrow)
    assert line.opacity > 0.5
    far = replace(now, ear=replace(now.ear, x=-8.0))
    assert lines(far, [], 0.0) == ()


def test_a_short_sound_is_shown_for_a_while_and_fades() -> None:
    silent = Heard(Soundscape(windy=0.0), Ear(0.0, 0.0, 0.0, 0.0, 0.0))
    event = Sounded(RATE, "sand", 0, (1.0, 1.0), silent.soundscape)
    shown = [lines(silent, [event], 1.0 + since) for since in (-0.1, 0.0, 1.2, LASTS)]
    assert shown[0] == shown[3] == ()
    assert shown[1] == (Line("sand", "", 1.0),)
    assert 0.0 < shown[2][0].opacity < 1.0


def test_all_that_sounds_has_a_name_in_both_languages() -> None:
    from landscape.sound import bank

    for name in (*bank.SHORT, bank.SEA, bank.WIND, bank.FIRE, bank.DROPS):
        english, french = (words.text(each, f"sound.{name}") for each in ("en", "fr"))
        assert english != french or name in ("vent",), name


def test_captions_stand_under_each_other_and_fade() -> None:
    picture = caption_image([("sea", "←", 1.0), ("wind", "", 0.4)], (640, 480))
    half = len(picture) // 2
    assert picture[:half, :, 3].max() > 1.8 * picture[half:, :, 3].max() > 0
    arrow = picture[:, : 2 * half // 2]
    assert (arrow[:half, :, :3].max(axis=2) > 150).any()
    assert not (arrow[half:, :, :3].max(axis=2) > 150).any()


def test_captions_are_shown_while_muted_or_when_asked_for() -> None:
    settings = scene("hall").values(None)
    for captions, muted, shown in (
        *(("muted", False, False), ("muted", True, True), ("on", False, True)),
        ("off", True, False),
    ):
        changed = replace(settings.sound, captions=captions, muted=muted)
        assert captioned(replace(settings, sound=changed)) is shown  # type: ignore[type-var]


@pytest.mark.window
def test_the_key_mutes_and_shows_captions_and_a_replay_looks_the_same(tmp_path: Path) -> None:
    kind = scene("hall")
    plan = Plan(
        scene="hall",
        settings=kind.values(None, {"flight.enabled": False}),
        view="hall",
        pose=Pose(1.4, None, 2.3, 270.0),
        size=(320, 240),
        only=("sword",),
    )
    pictures = []
    with Walk(plan, Assets(), "osmesa") as walk:
        for actions in ((), ("mute",), ()):
            walk.advance(Tick(0.05, Intent(), actions, plan.size))
            walk.draw()
            pictures.append(walk.pixels())
        assert walk.place.settings.sound.muted
        names = [line.name for line in walk.hearing.lines]
        assert "fire" in names
        walk.advance(Tick(0.05, Intent(), ("mute",), plan.size))
        assert walk.hearing.lines == ()
    upper_right = np.s_[100:200, 200:]
    assert (pictures[0][upper_right] != pictures[2][upper_right]).any()
