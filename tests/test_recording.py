"""Recorded walks: written, read back, and refused where they are damaged."""

import dataclasses
import errno
import json
import os
import re
from pathlib import Path
from typing import Any

import pytest

from framelens.base.errors import InputError
from framelens.base.output import next_free
from landscape.elements.settings import preset
from landscape.frame import Pose
from landscape.settings.declare import with_settings
from landscape.walk import recording
from landscape.walk.recording import Plan, Tick, Writer
from landscape.walk.walker import Intent

pytestmark = pytest.mark.window


def plan(**changes: Any) -> Plan:
    values = with_settings(preset("best"), {"fog.density": 0.1 + 0.2, "water.color": (0, 1, 0, 1)})
    settled = Plan(
        "island", values, "fig35e", Pose(21.1, None, 20.5, 62.0, 3.0), (320, 240), 50.0, 7
    )
    return dataclasses.replace(settled, **changes)


TICKS = [
    Tick(0.0, Intent(), (), (320, 240)),
    Tick(1 / 3, Intent(forward=1, look=(0.1, -2.5), run=True), ("fog", "map"), (320, 240)),
    Tick(0.1, Intent(strike=True, fly=True, turn=-1), (), (97, 61), "saved"),
    Tick(0.1, Intent(), ("help",), (97, 61)),
    Tick(0.1, Intent(), (), (97, 61), row="fog.color.1"),
    Tick(0.1, Intent(), (), (97, 61), "", "fog.color.1", {"fog.color": (0.1 + 0.2, 1.0, 0.0)}),
    Tick(0.1, Intent(), ("map",), (97, 61), "", "castle.ornate", {"castle.ornate": True}),
    Tick(0.1, Intent(), (), (97, 61), "", ""),
]


def write(path: Path, plan: Plan, ticks: list[Tick]) -> Path:
    writer = Writer(path, plan)
    for tick in ticks:
        writer.add(tick)
    assert writer.finish()
    return path


def test_a_recording_is_read_back_exactly(tmp_path: Path) -> None:
    wanted = plan(pose=Pose(0.1, 1 / 3, 2.0))
    got, ticks = recording.read(write(tmp_path / "a.jsonl", wanted, TICKS))
    assert (got, ticks) == (wanted, TICKS)
    got, _ = recording.read(write(tmp_path / "a.jsonl", plan(), TICKS))
    assert got.pose.y is None
    assert [path.name for path in tmp_path.iterdir()] == ["a.jsonl"]


def test_a_recording_made_before_there_was_a_list_of_settings_is_still_read(tmp_path: Path) -> None:
    path = write(tmp_path / "a.jsonl", plan(), TICKS[:4])
    first, *rest = path.read_text().splitlines()
    head = {key: value for key, value in json.loads(first).items() if key != "preset"}
    path.write_text("\n".join([json.dumps(head), *rest]))
    got, ticks = recording.read(path)
    assert got.preset == "" and ticks == TICKS[:4]


def test_an_empty_or_unfinished_recording_does_not_replace_an_earlier_file(tmp_path: Path) -> None:
    path = tmp_path / "a.jsonl"
    path.write_text("earlier")
    empty, broken = Writer(path, plan()), None
    assert not empty.finish()
    broken = Writer(path, plan())
    broken.add(TICKS[1])
    assert path.read_text() == "earlier"
    broken.discard()
    assert [p.name for p in tmp_path.iterdir()] == ["a.jsonl"]
    assert path.read_text() == "earlier"


@pytest.mark.parametrize("name", ["file/a.jsonl", "."])
def test_a_path_that_cannot_be_written_is_bad_input(tmp_path: Path, name: str) -> None:
    (tmp_path / "file").write_text("kept")
    with pytest.raises(InputError, match="--record"):
        Writer(tmp_path / name, plan())
    assert [p.name for p in tmp_path.iterdir()] == ["file"]


@pytest.mark.posix_only("its pipes have no names in folders")
def test_a_recording_goes_through_links_and_pipes_and_replaces_neither(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(tmp_path / "deep" / "real.jsonl")
    write(tmp_path / "link", plan(), TICKS)
    assert (tmp_path / "link").is_symlink()
    assert recording.read(tmp_path / "deep" / "real.jsonl") == (plan(), TICKS)

    os.mkfifo(tmp_path / "pipe")
    # Open for reading and writing: neither end waits for the other.
    pipe = os.open(tmp_path / "pipe", os.O_RDWR | os.O_NONBLOCK)
    write(tmp_path / "pipe", plan(), TICKS)
    (tmp_path / "copy").write_bytes(os.read(pipe, 1 << 20))
    os.close(pipe)
    assert (tmp_path / "pipe").is_fifo()
    assert recording.read(tmp_path / "copy") == (plan(), TICKS)


def test_a_recording_on_a_full_disk_leaves_what_was_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.jsonl"
    path.write_text("earlier")
    writer = Writer(path, plan())
    writer.add(TICKS[0])

    def full_disk(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "replace", full_disk)
    with pytest.raises(InputError, match=r"--record .*a\.jsonl: .*No space left"):
        writer.finish()
    assert path.read_text() == "earlier" and not writer.finish()
    assert [p.name for p in tmp_path.iterdir()] == ["a.jsonl"]


def _with(line: int, **changes: Any):
    def damage(lines: list[str]) -> list[str]:
        lines[line] = json.dumps(json.loads(lines[line]) | changes)
        return lines

    return damage


DAMAGES = {
    "empty": (1, lambda lines: []),
    "no recording": (1, lambda lines: ["{}"] + lines[1:]),
    "cut in a line": (3, lambda lines: lines[:2] + [lines[2][:9]]),
    "cut between lines": (8, lambda lines: lines[:-2]),
    "a line lost": (9, lambda lines: lines[:2] + lines[3:]),
    "another version": (1, _with(0, **{"landscape walk": 99})),
    "a version that is no number": (1, _with(0, **{"landscape walk": True})),
    "no such setting": (1, _with(0, settings={"fog.colour": 1})),
    "setting of the wrong type": (1, _with(0, settings={"fog.density": "thick"})),
    "size of nothing": (1, _with(0, size=[0, 5])),
    "size of a wall": (1, _with(0, size=[16384, 16384])),
    "pose of four": (1, _with(0, pose=[1, 2, 3, 4])),
    "seed below 0": (1, _with(0, seed=-1)),
    "no such element": (1, _with(0, only=["moon"])),
    "time that runs back": (3, _with(2, dt=-0.1)),
    "time of an hour": (3, _with(2, dt=3600)),
    "time that is no number": (3, _with(2, dt=None)),
    "infinite time": (3, lambda lines: lines[:2] + ['{"dt": NaN}'] + lines[3:]),
    "no time": (4, lambda lines: lines[:3] + ['{"run": true}'] + lines[4:]),
    "too fast": (2, _with(1, forward=2)),
    "no such switch": (2, _with(1, do=["sleep"])),
    "no such intent": (2, _with(1, swim=1)),
    "strike of a number": (2, _with(1, strike=1)),
    "a setting changed that does not exist": (2, _with(1, set={"fog.colour": 1})),
    "a setting changed to the wrong type": (2, _with(1, set={"fog.density": "thick"})),
    "a list of changes": (2, _with(1, set=["fog.density"])),
    "no such row": (2, _with(1, list="fog.colour")),
    "a row that is a number": (2, _with(1, list=5)),
    "no such preset": (1, _with(0, preset="worst")),
    "no object": (2, lambda lines: [lines[0], "[1]", *lines[2:]]),
}


@pytest.mark.parametrize("name", DAMAGES)
def test_a_damaged_recording_is_bad_input_and_the_line_is_named(tmp_path: Path, name: str) -> None:
    line, damage = DAMAGES[name]
    path = write(tmp_path / "a.jsonl", plan(), TICKS)
    lines = damage(path.read_text().splitlines())
    path.write_text("\n".join(lines))
    with pytest.raises(InputError) as error:
        recording.read(path)
    assert str(error.value).startswith(f"{path}:{line}: ")
    assert "\n" not in str(error.value)


def test_a_binary_or_missing_file_is_bad_input(tmp_path: Path) -> None:
    path = tmp_path / "a.jsonl"
    path.write_bytes(b"\x89PNG\r\n\x1a\n\xff\x00")
    for bad in (path, tmp_path, tmp_path / "none"):
        with pytest.raises(InputError, match=re.escape(str(bad))):
            recording.read(bad)


def test_screenshots_take_the_next_free_name(tmp_path: Path) -> None:
    (tmp_path / "shot-0001.png").write_text("mine")
    assert next_free("shot", ".png", tmp_path).name == "shot-0002.png"
    assert next_free("shot", ".png", tmp_path).name == "shot-0003.png"
    assert (tmp_path / "shot-0001.png").read_text() == "mine"
