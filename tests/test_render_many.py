"""Many stills by several processes: the same pictures, each reported once, no partial files."""

import os
import re
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from commands import SECONDS, running
from executors import Backwards
from PIL import Image

from framelens.base import executor
from framelens.base.errors import UNEXPECTED, InputError, say_unexpected
from landscape.commands import render_many
from landscape.island.views import VIEWS
from landscape.offscreen import Offscreen

ARGUMENTS = {"size": (48, 32), "preset": "2006", "only": ("ground", "sky", "fog"), "samples": 0}
NAMES = ("fig35a", "fig35e", "fig35g", "fig2a")


@pytest.fixture
def two(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make four pictures enough for two processes, on any machine."""
    monkeypatch.setattr(render_many, "FEWEST", 2)
    monkeypatch.setattr(render_many, "cores", lambda: 2)


@pytest.mark.seldom(13, first=10)
def test_several_processes_draw_the_same_pictures_as_one(two: None, tmp_path: Path) -> None:
    told: list[str] = []
    jobs = [(name, name, tmp_path / f"{name}.png") for name in NAMES]
    render_many.render_all(jobs, ARGUMENTS, 7.0, False, told.append)
    assert sorted(told) == sorted(NAMES)
    with Offscreen(**ARGUMENTS) as offscreen:
        for name, _, path in jobs:
            offscreen.look(name, 7.0)
            assert np.array_equal(np.asarray(Image.open(path)), offscreen.draw())
    assert len(list(tmp_path.iterdir())) == len(NAMES)


@pytest.mark.seldom(13, first=6)
def test_an_error_in_one_process_is_reported_in_its_own_words(two: None, tmp_path: Path) -> None:
    jobs = [(name, name, tmp_path / f"{name}.png") for name in NAMES]
    arguments = {**ARGUMENTS, "settings": {"ground.height_image": "nowhere.png"}}
    with pytest.raises(InputError, match=r"nowhere\.png: no such file"):
        render_many.render_all(jobs, arguments, None, False, lambda name: None)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.seldom(13, first=10)
def test_a_defect_in_one_process_is_told_with_its_place_there(
    two: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    fixed = "from landscape.scene import scene; scene.begin_frame = lambda *_, **__: {}['a defect']"
    (tmp_path / "sitecustomize.py").write_text(fixed, encoding="utf-8")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=os.pathsep)
    jobs = [(name, name, tmp_path / f"{name}.png") for name in NAMES]
    with pytest.raises(KeyError) as told:
        render_many.render_all(jobs, ARGUMENTS, None, False, lambda name: None)
    assert say_unexpected(told.value) == UNEXPECTED
    line, *trace = capsys.readouterr().err.splitlines()
    assert re.search(r"KeyError: 'a defect', in .*sitecustomize\.py, line 1$", line)
    assert any("begin_frame" in line for line in trace)


def test_few_pictures_are_drawn_without_further_processes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(executor, "Processes", None)
    told: list[str] = []
    jobs = [("fig35a", "fig35a", tmp_path / "a.png")]
    render_many.render_all(jobs, ARGUMENTS, None, False, told.append)
    assert told == ["fig35a"] and (tmp_path / "a.png").exists()


def test_any_executor_draws_the_same_files(tmp_path: Path) -> None:
    files = []
    for lent in (None, Backwards()):
        jobs = [(name, name, tmp_path / f"{name}.png") for name in NAMES]
        render_many.render_all(jobs, ARGUMENTS, 7.0, False, lambda name: None, executor=lent)
        files.append([path.read_bytes() for _, _, path in jobs])
    assert files[0] == files[1] and len(set(files[0])) == len(NAMES)


@pytest.mark.seldom(13, first=6)
@pytest.mark.slow
@pytest.mark.posix_only("nothing sends Ctrl-C to one process alone")
def test_ctrl_c_while_drawing_many_pictures_leaves_only_complete_files(tmp_path: Path) -> None:
    words = ["render", *list(VIEWS)[:40], "--size", "160x120", "--samples", "0", "--out", tmp_path]
    with running(*words, stderr=subprocess.PIPE) as process:
        deadline = time.monotonic() + SECONDS
        while len(list(tmp_path.glob("*.png"))) < 3 and time.monotonic() < deadline:
            time.sleep(0.02)
        os.killpg(process.pid, signal.SIGINT)
        error = process.communicate(timeout=SECONDS)[1]
    files = list(tmp_path.iterdir())
    assert process.returncode == 130 and "Traceback" not in error, error
    assert 3 <= len(files) < 40 and all(path.suffix == ".png" for path in files)
    for path in files:
        with Image.open(path) as image:
            image.load()
