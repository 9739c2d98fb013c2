"""Several processes draw a picture of the fly-over together: the same bytes, and none is left."""

import signal
import subprocess
import sys
import time
from collections.abc import Iterator

import numpy as np
import pytest
from commands import SECONDS, is_running

from landscape.flyover import frame
from landscape.flyover.camera import Camera
from landscape.flyover.crew import Crew, balanced, even
from landscape.flyover.height_field import HeightField, height_field
from landscape.flyover.noise import noise
from landscape.flyover.settings import Flyover, Settings
from landscape.settings.declare import Value, with_settings

RELIEF: dict[str, Value] = {"flyover.relief": 24.0}
FILLED: dict[str, Value] = {"flyover.mode": "filled", "filled.texels": 128, "filled.sea": 0.4}
CAMERA = Camera(20, 30, 34, 0, 0.2, 0.8)


def hills() -> HeightField:
    image = noise(64, 4, 1.9)
    image = (image - image.min()) / np.ptp(image) * 255
    return height_field(image, Flyover(relief=24.0))


@pytest.fixture(scope="module")
def three() -> Iterator[Crew]:
    with Crew(hills(), 3) as crew:
        assert crew.wait() == 3
        yield crew


@pytest.mark.seldom(7, first=2)
def test_three_processes_draw_the_picture_of_one(three: Crew) -> None:
    for changes in ({}, FILLED, {"flyover.colours": "height"}):
        settings = with_settings(Settings(), RELIEF | changes)
        for size in ((97, 64), (160, 120), (2, 5)):
            together = three.draw(CAMERA, settings, size).rgba.copy()
            alone = frame.draw(three.terrain, CAMERA, settings, size).rgba
            assert np.array_equal(together, alone), (changes, size)
    assert three.processes == 3


def test_a_picture_is_divided_where_all_parts_take_the_same_time() -> None:
    assert even(100, 2) == [0, 51, 100] and even(2, 3) == [0, 0, 0, 2]
    cuts = even(1024, 3)
    for _ in range(30):  # the first 256 columns take three times as long as the others
        seconds = np.diff(np.interp(cuts, (0, 256, 1024), (0.0, 3.0, 6.0)))
        cuts = balanced(cuts, seconds.tolist())
    assert np.abs(np.array(cuts) - (0, 171, 512, 1024)).max() <= 2 * frame.CUT
    assert balanced([0, 51, 100], [1.0, 0.0]) != [0, 0, 100]


def test_a_process_that_is_killed_is_replaced_by_the_one_that_asks(
    capfd: pytest.CaptureFixture[str],
) -> None:
    settings = with_settings(Settings(), RELIEF)
    with Crew(hills(), 2) as crew:
        assert crew.wait() == 2
        (worker,) = crew._workers
        worker._process.kill()
        together = crew.draw(CAMERA, settings, (160, 120))
        alone = frame.draw(crew.terrain, CAMERA, settings, (160, 120))
        assert np.array_equal(together.rgba, alone.rgba) and crew.processes == 1
        crew.draw(CAMERA, settings, (160, 120))
    told = capfd.readouterr().err
    assert told.count("\n") == 1 and told.startswith("landscape: flyover: a process that draws")


def test_where_no_process_can_be_started_one_draws_alone(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def refuse(*_: object) -> None:
        raise OSError("no more processes")

    monkeypatch.setattr("multiprocessing.context.SpawnProcess.start", refuse)
    with Crew(hills(), 2) as crew:
        assert crew.wait() == 1
        crew.draw(CAMERA, Settings(), (40, 30))
    assert "(no more processes)" in capsys.readouterr().err


PROGRAM = """
import sys, time
import numpy as np
from landscape.flyover.crew import Crew
from landscape.flyover.height_field import height_field
if __name__ == "__main__":
    crew = Crew(height_field(np.zeros((16, 16), np.uint8)), 2)
    assert crew.wait() == 2
    print(crew._workers[0]._process.pid, flush=True)
    time.sleep(60)
"""


@pytest.mark.seldom(14, first=3)
@pytest.mark.parametrize(
    "interrupted",
    [
        False,
        pytest.param(True, marks=pytest.mark.posix_only("nothing sends Ctrl-C to one process")),
    ],
)
def test_no_process_outlives_the_one_that_started_it(interrupted: bool, tmp_path) -> None:
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    words = [sys.executable, str(program)]
    none = subprocess.DEVNULL
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=none, text=True) as parent:
        assert parent.stdout is not None
        pid = int(parent.stdout.readline())
        if interrupted:
            parent.send_signal(signal.SIGINT)
        else:
            parent.kill()
    until = time.monotonic() + SECONDS
    while is_running(pid) and time.monotonic() < until:
        time.sleep(0.02)
    assert not is_running(pid)
