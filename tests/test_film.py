"""Films: the same pixels by any number of processes, files that can be played, and refusals."""

import multiprocessing
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest
from commands import SECONDS, Shell, need_library, refused, running
from environments import image, layer, path, svg, written
from executors import Backwards
from PIL import Image

from framelens.base.errors import UNEXPECTED, InputError, say_unexpected
from framelens.base.executor import executor
from framelens.base.texts import translator
from landscape.files.assets import Assets
from landscape.film import encode, making, tour
from landscape.film.captions import Caption
from landscape.film.cut import Film, Part, mixed
from landscape.film.frames import drawn
from landscape.film.making import write
from landscape.film.replay import Replay
from landscape.film.sources import Wanted, film_of
from landscape.film.stage import Drawing, Stage
from landscape.film.views import Flight, Look, Still
from landscape.frame import Pose
from landscape.scene.scene import SCENES, find_view, scene
from landscape.walk.app import Walk
from landscape.walk.recording import Plan, Tick, Writer, read
from landscape.walk.walker import Intent

SIZE = (48, 32)


@pytest.fixture
def boards(monkeypatch: pytest.MonkeyPatch) -> None:
    """Plug in two small scenes; processes that draw get them with the film."""
    monkeypatch.setitem(SCENES, "chessboard", "chessboard_scene")
    monkeypatch.setitem(SCENES, "mortal", "mortal_scene")
    monkeypatch.setitem(SCENES, "faulty", "faulty_scene")


def drawing(size: tuple[int, int] = SIZE) -> Drawing:
    return Drawing(size, samples=0)


def wanted(fps: float = 10.0, **changes) -> Wanted:
    return Wanted(**{"drawing": drawing(), "fps": fps, **changes})


def board(name: str = "chessboard", seconds: float = 0.6) -> Flight:
    kind = scene(name)
    look = Look(name, kind.settings, ("squares",))
    poses = (Pose(4.0, 1.5, 7.0, 0.0, -20.0), Pose(5.0, 1.5, 5.0, 60.0, -20.0))
    return Flight(look, poses, (1.0,)).lasting(seconds)


def pictures(film: Film) -> list[np.ndarray]:
    """Return a film's pictures, each drawn by itself, from the last to the first."""
    with Stage(film.drawing) as stage:
        found = []
        for number in reversed(range(film.frames)):
            found.append(film.open(stage)(number).copy())
        return found[::-1]


def recorded(file: Path, plan: Plan, ticks: list[Tick]) -> Path:
    writer = Writer(file, plan)
    for tick in ticks:
        writer.add(tick)
    writer.finish()
    return file


def strolled(**changes) -> tuple[Plan, list[Tick]]:
    """Return a walk on the chessboard: on, to the side around the tower, and in wireframe."""
    kind = scene("chessboard")
    plan = Plan("chessboard", kind.settings, "board", Pose(4.0, None, 7.0), SIZE, 3.0)
    intents = [Intent(forward=1.0), Intent(forward=1.0, turn=-1.0), Intent(right=1.0, look=(9, 4))]
    ticks = [
        Tick(0.05 + 0.01 * (k % 3), intents[k // 4], ("wireframe",) if k == 8 else (), SIZE)
        for k in range(12)
    ]
    return replace(plan, **changes), ticks


# ---- the same pixels


@pytest.mark.parametrize("jobs", [2, 3])
@pytest.mark.sweep(12, first=11)
def test_several_processes_draw_the_pixels_of_one_in_their_order(
    boards: None, tmp_path: Path, jobs: int
) -> None:
    file = recorded(tmp_path / "stroll.jsonl", *strolled())
    walk = film_of([str(file)], wanted()).parts
    parts = (Part(board()), *walk, Part(board(), 0.3, (Caption("seen", "below", 0.0, 9.0),)))
    film = Film(parts, drawing(), Fraction(10))
    assert film.frames > 12
    alone = pictures(film)
    with executor(jobs) as workers:
        shared = list(drawn(film, workers, jobs))
    assert len({each.tobytes() for each in alone}) > 10
    assert len(shared) == film.frames
    assert all(np.array_equal(a, b) for a, b in zip(alone, shared, strict=True))


@pytest.mark.seldom(14, first=12)
@pytest.mark.parametrize("name", ["film.mp4", "film.webm", "film.gif"])
def test_any_executor_makes_the_same_file(boards: None, tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    film = Film((Part(board(seconds=6.5)), Part(board(), 0.3)), drawing(), Fraction(3))
    files = []
    for jobs, lent in ((1, None), (2, None), (3, Backwards())):
        assert write(film, path, jobs, executor=lent) == film.frames > 12
        files.append(path.read_bytes())
    assert files[0] == files[1] == files[2]
    with av.open(str(path)) as found:
        times = [float(frame.time) for frame in found.decode(video=0)]
    assert times == pytest.approx([k / 3 for k in range(film.frames)], abs=0.006)


@pytest.mark.seldom(13, first=12)
@pytest.mark.slow
def test_the_island_depends_on_the_time_alone() -> None:
    kind, view = find_view("fig35f")
    few = {"grass.count": 2_000_000, "ground.texture_size": 256, "ground.stones": 500}
    look = Look("island", kind.values("best", few), ("ground", "grass"))
    poses = tuple(replace(view.pose, z=view.pose.z - away, yaw=330 + 9 * away) for away in (0, 0.8))
    film = Film((Part(Flight(look, poses, (0.6,))),), drawing(), Fraction(4))
    with Stage(film.drawing) as stage:
        picture = film.open(stage)
        forward = [picture(number) for number in range(film.frames)]
    assert all(np.array_equal(a, b) for a, b in zip(forward, pictures(film), strict=True))


@pytest.mark.window
def test_a_recorded_walk_leads_where_it_led_in_the_window(boards: None, tmp_path: Path) -> None:
    need_library("OSMesa")
    plan, ticks = read(recorded(tmp_path / "stroll.jsonl", *strolled()))
    poses = []
    with Walk(plan, Assets(), "osmesa") as walk:
        for tick in ticks:
            walk.advance(tick)
            poses.append(walk.walker.pose)
    with Stage(drawing()) as stage:
        replay = Replay(plan, tuple(ticks), stage)
        seen = [replay.moment(float(end)) for end in replay.ends]
        assert [moment.pose for moment in seen] == poses
        assert [moment.wireframe for moment in seen] == [k >= 8 for k in range(12)]
        middle = replay.moment(float(replay.ends[0]) + 0.01).pose
        assert middle.x == pytest.approx(poses[0].x + (poses[1].x - poses[0].x) / 6)
        assert replay.moment(float(replay.ends[3])).pose == poses[3], "back to an earlier time"
        replay.release()


def test_a_fade_mixes_the_last_of_one_clip_with_the_first_of_the_next(boards: None) -> None:
    look = board().look
    first, second = (Still(look, pose, 1.0) for pose in board().poses)
    film = Film((Part(first), Part(second, 0.4)), drawing(), Fraction(10), ending=0.2)
    assert film.starts() == [0.0, 0.6, 1.6] and film.frames == 16
    found = pictures(film)
    here, there = found[0], found[11]
    assert np.array_equal(found[8], mixed(here, there, 0.5))
    assert not np.array_equal(here, there) and np.array_equal(found[5], here)
    assert found[15].mean() < found[11].mean()


def test_a_film_without_opengl_needs_none(tmp_path: Path) -> None:
    file = written(tmp_path, svg(image(), layer(path())))
    asked = wanted(scene="flyover", seconds=0.5, drawing=replace(drawing(), backend="nowhere"))
    film = film_of([str(file)], asked)
    assert film.frames == 5
    assert len({each.tobytes() for each in drawn(film, executor(1), 1)}) == 5


def test_a_drawn_path_leads_over_a_scene_and_never_below_its_ground(
    boards: None, tmp_path: Path
) -> None:
    file = written(tmp_path, svg(image(), layer(path())))
    film = film_of([str(file)], wanted(scene="chessboard", seconds=2.0))
    assert film.frames == 20
    seen: list = []
    with Stage(film.drawing) as stage:
        stage.draw = lambda opened, moment: seen.append(moment.pose)  # type: ignore[assignment]
        draw = film.parts[0].clip.open(stage)
        for time_s in np.arange(0.0, 2.0, 0.1):
            draw(float(time_s))
    assert min(pose.y for pose in seen) > 1.0
    assert np.ptp([pose.x for pose in seen]) > 4.0, "most of the board"


def test_views_that_are_drawn_alike_are_joined_by_a_flight_and_others_by_a_cut() -> None:
    film = film_of(["fig35a", "hill", "dusk_bay", "hall", "hall_mirror"], wanted())
    assert [type(part.clip) for part in film.parts] == [Flight, Still, Flight]
    assert len(film.parts[0].clip.poses) == 2  # type: ignore[attr-defined]
    short = film_of(["fig35a", "hill", "dusk_bay"], wanted(seconds=9.0))
    assert short.frames == 90


# ---- files


def noise(count: int, size: tuple[int, int] = SIZE) -> list[np.ndarray]:
    rng = np.random.default_rng(3)
    return [rng.integers(0, 256, (size[1], size[0], 3), np.uint8) for _ in range(count)]


def film_file(out: Path, fps: int, shown: list[np.ndarray]) -> encode.FilmFile:
    return encode.FilmFile(out, encode.format_of(out, SIZE, Fraction(fps), lambda: shown))


@pytest.mark.parametrize(
    ("name", "codec"), [("a.mp4", "h264"), ("a.webm", "vp9"), ("A.GIF", "gif")]
)
def test_a_film_has_its_pictures_in_their_order_size_and_colours(
    tmp_path: Path, name: str, codec: str
) -> None:
    out, greys = tmp_path / name, range(20, 240, 20)
    out.write_bytes(b"former")
    shown = [np.full((32, 48, 3), (grey, 120, 255 - grey), np.uint8) for grey in greys]
    file = film_file(out, 25, shown)
    for pixels in shown:
        file.add(pixels)
    assert out.read_bytes() == b"former"
    file.finish()
    with av.open(str(out)) as film:
        stream = film.streams.video[0]
        assert stream.codec_context.name == codec and stream.average_rate == 25
        levels = {"src_color_range": "MPEG", "dst_color_range": "JPEG"}  # old versions guess wrong
        found = [
            frame.reformat(format="rgb24", src_colorspace="ITU709", **levels).to_ndarray()
            for frame in film.decode(video=0)
        ]

    assert len(found) == len(shown)
    for got, pixels in zip(found, shown, strict=True):
        assert got.shape == pixels.shape
        assert np.abs(got.mean(axis=(0, 1)) - pixels[0, 0]).max() < 8.0
    assert os.listdir(tmp_path) == [name]


def test_a_gif_lasts_as_long_as_it_should_and_keeps_what_stands_still(tmp_path: Path) -> None:
    out = tmp_path / "a.gif"
    still = noise(1)[0] // 64 * 64
    moving = [still.copy() for _ in range(30)]
    for number, pixels in enumerate(moving):
        pixels[:8, number : number + 8] = (255, 0, 0)
    file = film_file(out, 30, moving)
    for pixels in moving:
        file.add(pixels)
    file.finish()
    with Image.open(out) as film:
        frames, total = [], 0
        for number in range(film.n_frames):
            film.seek(number)
            total += film.info["duration"]
            frames.append(np.asarray(film.convert("RGB")).astype(int))
    assert len(frames) == 30 and total == 1000
    assert all(np.array_equal(frame[8:], frames[0][8:]) for frame in frames)
    assert np.abs(frames[9][:8, 9:17] - (255, 0, 0)).max() < 40


@pytest.mark.posix_only("files have no limit of size")
@pytest.mark.parametrize("name", ["a.mp4", "a.webm", "a.gif"])
def test_a_full_disk_ends_in_one_line_and_leaves_the_former_file(tmp_path: Path, name: str) -> None:
    import resource

    out = tmp_path / name
    out.write_bytes(b"former")
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    shown = noise(12)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4000, limits[1]))
    try:
        file = film_file(out, 25, shown)
        with pytest.raises(InputError, match=f"{name}: cannot be written"):
            for pixels in 8 * shown:
                file.add(pixels)
            file.finish()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    file.discard()
    assert os.listdir(tmp_path) == [name] and out.read_bytes() == b"former"


def test_without_pyav_a_line_says_what_to_install_and_gif_works(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "av", None)
    with pytest.raises(InputError, match=r"pip install .*\[film\]"):
        encode.check(tmp_path / "a.mp4", SIZE, Fraction(25))
    encode.check(tmp_path / "a.gif", SIZE, Fraction(25))
    film_file(tmp_path / "a.gif", 25, noise(1)).finish()


def test_a_film_is_written_by_the_command(shell: Shell, tmp_path: Path) -> None:
    out = tmp_path / "new" / "film.mp4"
    words = ["film", "fig2a", "--out", out, "--size", "64x48", "--fps", "5", "--seconds", "1"]
    done = shell(*words, "--samples", "0", "--jobs", "1")
    assert (done.status, done.out) == (0, f"{out}\n"), done
    with av.open(str(out)) as film:
        assert len(list(film.decode(video=0))) == 5
    assert os.listdir(out.parent) == ["film.mp4"]


# ---- ends before the end


@pytest.mark.seldom(13, first=11)
def test_a_process_that_dies_ends_in_one_line_and_leaves_nothing(
    boards: None, tmp_path: Path
) -> None:
    film = Film((Part(board("mortal")),), drawing(), Fraction(10))
    with pytest.raises(InputError, match="a process that draws was killed"):
        write(film, tmp_path / "film.mp4", 2)
    assert os.listdir(tmp_path) == [] and not multiprocessing.active_children()


@pytest.mark.seldom(13, first=2)
def test_a_defect_in_a_process_is_told_with_its_place_and_traceback(
    boards: None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    film = Film((Part(board("faulty")),), drawing(), Fraction(10))
    with pytest.raises(KeyError) as told:
        write(film, tmp_path / "film.mp4", 2)
    assert say_unexpected(told.value) == UNEXPECTED
    line, *trace = capsys.readouterr().err.splitlines()
    assert re.search(r"KeyError: 'a defect', in .*faulty_scene\.py, line \d+$", line)
    assert any("in draw" in each for each in trace)
    assert os.listdir(tmp_path) == [] and not multiprocessing.active_children()


def test_an_error_in_a_process_is_told_in_its_own_words(tmp_path: Path) -> None:
    film = film_of(["fig2a"], wanted(changes={"ground.height_image": "nowhere.png"}))
    with pytest.raises(InputError, match=r"nowhere\.png: no such file"):
        write(film, tmp_path / "film.mp4", 1)
    assert os.listdir(tmp_path) == [] and not multiprocessing.active_children()


@pytest.mark.seldom(13, first=12)
def test_whoever_stops_looking_leaves_no_process_behind(boards: None) -> None:
    film = Film((Part(board()),), drawing(), Fraction(10))
    with pytest.raises(KeyError), executor(2) as workers, closing(drawn(film, workers, 2)) as shown:
        next(shown)
        assert len(multiprocessing.active_children()) == 2
        raise KeyError
    assert not multiprocessing.active_children()


@pytest.mark.seldom(14, first=9)
@pytest.mark.parametrize("name", ["film.mp4", "film.webm", "film.gif"])
def test_an_interrupted_film_is_shorter_and_can_be_played(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    def interrupted(film: Film, workers: Executor, jobs: int, numbers: Sequence[int] | None = None):
        yield from noise(7)
        if numbers is None:
            raise KeyboardInterrupt

    monkeypatch.setattr(making, "drawn", interrupted)
    film = film_of(["fig35a"], wanted())
    assert making.write(film, tmp_path / name, 1) == 7 < film.frames
    with av.open(str(tmp_path / name)) as found:
        assert len(list(found.decode(video=0))) == 7
    assert os.listdir(tmp_path) == [name]


@pytest.mark.parametrize("count", [0, 7])
def test_an_interrupted_film_leaves_the_former_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, count: int
) -> None:
    def interrupted(film: Film, workers: Executor, jobs: int):
        yield from noise(count)
        raise KeyboardInterrupt

    monkeypatch.setattr(making, "drawn", interrupted)
    (tmp_path / "film.mp4").write_bytes(b"former")
    with pytest.raises(KeyboardInterrupt):
        making.write(film_of(["fig35a"], wanted()), tmp_path / "film.mp4", 1)
    assert os.listdir(tmp_path) == ["film.mp4"]
    assert (tmp_path / "film.mp4").read_bytes() == b"former"


@pytest.mark.seldom(14, first=13)
@pytest.mark.posix_only("nothing sends Ctrl-C to one process alone")
@pytest.mark.slow
def test_ctrl_c_ends_all_processes_and_says_how_much_there_is(tmp_path: Path) -> None:
    out = tmp_path / "film.gif"
    words = ["film", "fig2a", "--seconds", "600", "--out", out, "--size", "64x48", "--jobs", "2"]
    with running(*words, stderr=subprocess.PIPE) as process:
        deadline = time.monotonic() + SECONDS
        while time.monotonic() < deadline:
            if any(part.stat().st_size > 3000 for part in tmp_path.glob(".landscape.*")):
                break
            time.sleep(0.05)
        os.killpg(process.pid, signal.SIGINT)
        error = process.communicate(timeout=SECONDS)[1]

    assert process.returncode == 130 and error.count("\n") == 1, error
    assert error.startswith(f"landscape: interrupted: {out} has ")
    with Image.open(out) as film:
        assert f"has {film.n_frames} of 18000 frames" in error  # type: ignore[attr-defined]
    assert os.listdir(tmp_path) == ["film.gif"]
    with pytest.raises(ProcessLookupError):
        while time.monotonic() < deadline:  # multiprocessing's own helper ends a moment later
            os.killpg(process.pid, 0)
            time.sleep(0.05)


# ---- refusals


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["fig35a", "--out", "a.avi"], [".mp4, .webm, .gif"]),
        (["fig35a", "--out", "."], ["--out ."]),
        (["fig35a", "--out", "/dev/null"], ["ends in"]),
        (["fig35a", "--out", "a.mp4/b.mp4"], ["--out a.mp4/b.mp4"]),
        (["fig35a"], ["--out"]),
        (["--out", "a.mp4"], ["VIEW"]),
        (["fig35a", "--out", "b.mp4", "--size", "641x480"], ["even", "641x480"]),
        (["fig35a", "--out", "b.mp4", "--size", "0x480"], ["1x1"]),
        (["fig35a", "--out", "b.gif", "--fps", "60"], ["GIF", "50"]),
        (["fig35a", "--out", "b.mp4", "--fps", "0"], ["from 1 to 120"]),
        (["fig35a", "--out", "b.mp4", "--fps", "nan"], ["--fps", "nan"]),
        (["fig35a", "--out", "b.mp4", "--fps", "1000"], ["from 1 to 120"]),
        (["fig35a", "--out", "b.mp4", "--seconds", "0"], ["from 0.1 to 3600"]),
        (["fig35a", "--out", "b.mp4", "--jobs", "0"], ["from 1 to 256"]),
        (["fig35a", "--out", "b.mp4", "--scene", "hall"], ["--scene hall"]),
        (["fig99z", "--out", "b.mp4"], ["fig99z", "no such view"]),
        (["nowhere.svg", "--out", "b.mp4"], ["nowhere.svg"]),
        (["nowhere.jsonl", "--out", "b.mp4"], ["nowhere.jsonl"]),
        (["a.mp4", "--out", "b.mp4"], ["a.mp4:1"]),
        (["tour", "fig35a", "--out", "b.mp4"], ["tour"]),
        (["tour", "--out", "b.mp4", "--seconds", "9"], ["tour"]),
        (["tour", "--out", "b.mp4", "--set", "fog.densty=1"], ["fog.densty"]),
    ],
)
def test_what_cannot_be_filmed_is_refused_in_one_line(
    shell: Shell, tmp_path: Path, words: list[str], expected: list[str]
) -> None:
    (tmp_path / "a.mp4").write_text("not a recording\n")
    shell.cwd = tmp_path
    refused(shell("film", *words), *expected)
    assert os.listdir(tmp_path) == ["a.mp4"]


# ---- the tour


def test_the_tour_shows_all_scenes_in_about_a_minute_in_either_language() -> None:
    film = film_of(["tour"], wanted())
    shown = {getattr(part.clip, "look", None) and part.clip.look.scene for part in film.parts}  # type: ignore[attr-defined]
    assert set(SCENES) <= shown
    assert 50.0 < film.starts()[-1] < 75.0
    for part in film.parts:
        last = part.clip.seconds if part is film.parts[-1] else part.clip.seconds - 1.0
        assert all(caption.start < caption.end <= last + 3.0 for caption in part.captions)
    _ = translator("fr", "film")
    assert _(tour.TEXTS["hall"], "hall") == "La grande salle"
