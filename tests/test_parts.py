"""A film in parts: what is there is not drawn again, what fails is told, several share the work."""

import json
import os
import socket
import subprocess
import time
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Future
from contextlib import nullcontext
from dataclasses import replace
from fractions import Fraction
from functools import partial
from pathlib import Path

import pytest
from commands import Shell, refused, running
from failing_clips import Failing

from framelens.base import claims as claims_module
from framelens.base.claims import STALE, Claims
from framelens.base.errors import InputError
from framelens.base.executor import Here, lent_or_own
from landscape.film import parted
from landscape.film.cut import Film, Part
from landscape.film.folder import Parts, film_hash, opened, plan_of
from landscape.film.making import write
from landscape.film.parted import Parting, draw, join, status
from landscape.film.sources import Wanted, film_of
from landscape.film.stage import Drawing
from landscape.maker import Maker, maker

SIZE = (32, 32)
FPS = Fraction(2)  # a part has eight frames, of four seconds
MAKER = Maker("1", "2", "3", "4", "5")


def film(clip: Failing) -> Film:
    return Film((Part(clip),), Drawing(SIZE, samples=0), FPS)


def drawn(clip: Failing, folder: Path, jobs: int = 1, ending: str = ".mp4", **more) -> Parting:
    return draw(film(clip), folder, ending, partial(lent_or_own, None, jobs), jobs, **more)


def pictures(log: Path) -> list[str]:
    """Return of which seconds pictures were drawn since the last call, the palette's left out."""
    found = log.read_text().split() if log.exists() else []
    log.unlink(missing_ok=True)
    return found


# ---- the parts are the checkpoint


@pytest.mark.parametrize("ending", [".mp4", ".gif"])
@pytest.mark.sweep(4)
def test_a_second_run_draws_what_is_missing_and_the_film_is_the_same(
    tmp_path: Path, ending: str
) -> None:
    log, whole = tmp_path / "log", tmp_path / f"whole{ending}"
    clip = Failing(22.0, log=str(log))
    write(film(clip), whole, 1)
    assert len(pictures(log)) == 44 + 12 * (ending == ".gif")
    parts = drawn(clip, tmp_path / "parts", ending=ending).parts
    assert parts.plan.parts == 6 and parts.missing() == []
    pictures(log)
    parts.path(1).unlink()
    parts.path(5).unlink()
    assert parts.missing() == [1, 5] and parts.drawn_frames() == 32
    drawn(clip, tmp_path / "parts", ending=ending)
    assert pictures(log) == [f"{k / 2:g}" for k in (*range(8, 16), *range(40, 44))]
    out = tmp_path / f"joined{ending}"
    join(parts, out)
    assert out.read_bytes() == whole.read_bytes()


def test_parts_are_named_by_film_format_and_maker() -> None:
    asked = Wanted(Drawing(SIZE, samples=0), seconds=1.0)
    film = film_of(["fig2a"], asked)
    others = [
        film_of(["fig2b"], asked),
        film_of(["fig2a"], replace(asked, kt=1.0)),
        film_of(["fig2a"], replace(asked, changes={"fog.density": 0.03})),
        film_of(["fig2a"], replace(asked, drawing=Drawing((64, 32), samples=0))),
        film_of(["fig2a"], replace(asked, drawing=Drawing(SIZE, samples=4))),
    ]
    assert len({film_hash(each) for each in (film, *others)}) == 6
    assert film_hash(film_of(["fig2a"], asked)) == film_hash(film)
    plan = plan_of(film, ".mp4", MAKER, ["fig2a"])
    assert plan_of(film, ".mp4", MAKER, ["other words"]).hash == plan.hash
    assert plan_of(film, ".webm", MAKER, ["fig2a"]).hash != plan.hash
    assert plan_of(film, ".mp4", replace(MAKER, renderer="6"), []).hash != plan.hash


def test_a_file_that_a_film_is_made_of_counts_by_its_contents(tmp_path: Path) -> None:
    image = tmp_path / "heights.png"
    asked = Wanted(Drawing(SIZE), seconds=1.0, changes={"ground.height_image": str(image)})
    hashes = set()
    for data in (b"one", b"other"):
        image.write_bytes(data)
        hashes.add(film_hash(film_of(["fig2a"], asked)))
    assert len(hashes) == 2


def test_a_folder_says_what_is_there_and_who_works(tmp_path: Path) -> None:
    parts = drawn(Failing(22.0), tmp_path, sources=["a", "b"]).parts
    for number, path in enumerate(map(parts.path, range(4))):
        os.utime(path, (0, 1000.0 + 60.0 * number))
    parts.path(4).unlink()
    parts.path(5).unlink()
    assert parts.claims.take(parts.name(4))
    found = opened(tmp_path, "--status")
    assert [each.plan for each in found] == [parts.plan]
    first, count, work, left = map(str, status(found[0]))
    assert first == f"film-{parts.plan.hash}.json: a b, 44 frames of 32x32 at 2 per second"
    assert count == "4 of 6 parts"
    assert work.startswith(f"frames 32 to 39: {socket.gethostname()}:{os.getpid()}, for 0.")
    assert left == "about 2 min more"
    with pytest.raises(InputError, match=r"2 of 6 parts of film-.* are missing"):
        join(parts, tmp_path / "film.mp4")
    parts.claims.release(parts.name(4))


def test_a_damaged_part_or_plan_is_named(tmp_path: Path) -> None:
    parts = drawn(Failing(9.0), tmp_path).parts
    for wrong in (b"no film", b"", parts.read(0)):
        parts.path(2).write_bytes(wrong)
        with pytest.raises(InputError, match=r"part-00002-.*: no part of a film with 2 frames"):
            join(parts, tmp_path / "film.mp4")
    assert not (tmp_path / "film.mp4").exists()
    plan = next(tmp_path.glob("film-*.json"))
    good = json.loads(plan.read_text())
    for wrong in ([], {}, {**good, "frames": -1}, {**good, "fps": "0/0"}, {**good, "length": 3}):
        plan.write_text(json.dumps(wrong))
        with pytest.raises(InputError, match="expected a film's plan"):
            opened(plan, "--join")


def test_a_part_of_a_gif_that_is_cut_off_is_named(tmp_path: Path) -> None:
    parts = drawn(Failing(9.0), tmp_path, ending=".gif").parts
    whole = parts.read(0)
    for end in (0, 5, len(whole) // 2, len(whole) - 1):
        parts.path(0).write_bytes(whole[:end])
        with pytest.raises(InputError, match=r"part-00000-.*: no part of a film with 8 frames"):
            join(parts, tmp_path / "film.gif")


# ---- faults


def test_a_part_that_fails_thrice_is_told_and_the_others_are_drawn(tmp_path: Path) -> None:
    log = tmp_path / "log"
    parting = drawn(Failing(22.0, 9, "raise", str(log)), tmp_path / "parts", jobs=1)
    assert parting.parts.missing() == [2]
    [line] = map(str, parting.told())
    assert line.startswith("frames 16 to 23: KeyError: 'a defect', in ")
    assert line.endswith("(tried 3 times)")
    assert pictures(log).count("8") == 3
    assert not list((tmp_path / "parts").glob("*.claim"))


@pytest.mark.seldom(14, first=6)
@pytest.mark.posix_only("no signal ends a process there")
@pytest.mark.slow
def test_a_part_that_kills_its_process_is_told_and_the_others_are_drawn(tmp_path: Path) -> None:
    parting = drawn(Failing(22.0, 9, "kill"), tmp_path, jobs=2)
    assert parting.parts.missing() == [2]
    [line] = map(str, parting.told())
    assert line.startswith("frames 16 to 23: a process was killed")


class Breaking(Here):
    """Refuses every task after so many, as a pool does of which a process was killed."""

    def __init__(self, tasks: int) -> None:
        self.left = tasks
        self.functions: list[Callable] = []

    def submit(self, function: Callable, /, *arguments: object, **named: object) -> Future:
        self.functions.append(function)
        self.left -= 1
        if self.left < 0:
            raise BrokenExecutor
        return super().submit(function, *arguments, **named)


def test_what_was_not_handed_over_to_a_broken_pool_is_drawn_by_the_next(tmp_path: Path) -> None:
    log = tmp_path / "log"
    pools = [Breaking(5), Breaking(1), Breaking(99)]
    opened = iter(pools)
    clip = film(Failing(22.0, log=str(log)))
    parting = draw(clip, tmp_path / "parts", ".mp4", lambda: nullcontext(next(opened)), 2)
    assert parting.parts.missing() == [] and not parting.failed
    assert len(pictures(log)) == 44, "drawn twice"
    assert pools[0].functions[:2] == [maker, maker], "each worker starts at once"
    assert [pool.left for pool in pools] == [-1, -1, 97]


@pytest.mark.parametrize("tasks", [0, 2])
def test_a_pool_that_takes_nothing_ends_it_in_one_line(tmp_path: Path, tasks: int) -> None:
    opened = iter([Breaking(tasks), Breaking(0)])
    with pytest.raises(InputError, match="a process that draws was killed"):
        draw(film(Failing(22.0)), tmp_path, ".mp4", lambda: nullcontext(next(opened)), 2)
    assert not list(tmp_path.glob("*.claim"))


def test_bad_input_ends_it_at_once_and_no_claim_is_left(tmp_path: Path) -> None:
    asked = Wanted(Drawing(SIZE), seconds=1.0, changes={"ground.height_image": "nowhere.png"})
    pool = partial(lent_or_own, None, 1)
    with pytest.raises(InputError, match=r"nowhere\.png: no such file"):
        draw(film_of(["fig2a"], asked), tmp_path, ".mp4", pool, 1)
    assert not list(tmp_path.glob("*.claim"))


@pytest.mark.posix_only("files have no limit of size")
def test_a_full_disk_ends_in_one_line_and_leaves_whole_parts(tmp_path: Path) -> None:
    import resource

    clip = Failing(22.0)
    sizes = [drawn(clip, tmp_path / "all").parts.path(k).stat().st_size for k in range(6)]
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (max(sizes) - 1, limits[1]))
    try:
        with pytest.raises(InputError, match="cannot be written"):
            drawn(clip, tmp_path / "full")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    for path in (tmp_path / "full").glob("part-*"):
        assert path.read_bytes() == (tmp_path / "all" / path.name).read_bytes()


# ---- claims


def held(folder: Path, name: str, host: str, pid: int, silent: float = 0.0) -> Path:
    path = folder / f"{name}.claim"
    path.write_text(json.dumps({"host": host, "pid": pid, "since": time.time() - silent}))
    os.utime(path, (0, time.time() - silent))
    return path


def dead() -> int:
    with subprocess.Popen(["true"]) as process:
        return process.pid


def test_what_another_process_has_claimed_is_left_to_it(tmp_path: Path) -> None:
    ours, theirs = Claims(tmp_path), Claims(tmp_path)
    assert theirs.take("a") and not ours.take("a") and ours.take("b")
    ours.release("a")
    assert not ours.take("a"), "only who has it gives it up"
    theirs.release("a")
    assert ours.take("a")
    held(tmp_path, "c", "elsewhere", 1, STALE - 20.0)
    assert not ours.take("c")
    assert set(ours.holders()) == {"a", "b", "c"}
    (tmp_path / "d.claim").touch()  # being written
    assert not ours.take("d")


@pytest.mark.posix_only("`true` is no program there")
def test_the_claim_of_who_is_gone_is_taken_over(tmp_path: Path) -> None:
    ours = Claims(tmp_path)
    held(tmp_path, "a", socket.gethostname(), dead())
    held(tmp_path, "b", "elsewhere", 1, STALE + 20.0)
    assert ours.take("a") and ours.take("b")
    assert {str(holder) for holder in ours.holders().values()} == {
        f"{socket.gethostname()}:{os.getpid()}"
    }
    assert sorted(os.listdir(tmp_path)) == ["a.claim", "b.claim"]


def test_a_claim_of_a_time_to_come_is_taken_over_for_the_clock_was_put_back(tmp_path: Path) -> None:
    held(tmp_path, "a", "elsewhere", 1, -STALE - 20.0)
    held(tmp_path, "b", "elsewhere", 1, -STALE + 20.0)
    ours = Claims(tmp_path)
    assert ours.take("a") and not ours.take("b")


def test_a_claim_is_touched_while_its_process_works(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(claims_module, "BEAT", 0.01)
    ours = Claims(tmp_path)
    with ours.kept():
        assert ours.take("a")
        os.utime(tmp_path / "a.claim", (0, 0))
        while not (tmp_path / "a.claim").stat().st_mtime:
            time.sleep(0.01)
    assert os.listdir(tmp_path) == [], "at the end it is given up"


def test_who_shares_leaves_to_others_what_they_have_claimed_until_it_is_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    clip = Failing(22.0)
    parts = drawn(clip, tmp_path / "parts").parts
    theirs = parts.read(2)
    parts.path(2).unlink()
    parts.path(3).unlink()
    other = Claims(parts.folder)
    assert other.take(parts.name(2))
    with pytest.raises(InputError, match="with --share both do"):
        drawn(clip, parts.folder)
    assert 2 in parts.missing()

    def sleep(_: float) -> None:
        assert parts.missing() == [2], "what nobody has claimed is drawn meanwhile"
        parts.path(2).write_bytes(theirs)
        other.release(parts.name(2))

    monkeypatch.setattr(parted.time, "sleep", sleep)
    assert drawn(clip, parts.folder, share=True).parts.missing() == []
    assert parts.read(2) == theirs


def test_the_same_film_is_not_drawn_in_two_ways_at_once(tmp_path: Path) -> None:
    parts = drawn(Failing(9.0), tmp_path).parts
    other = replace(parts.plan, maker={**parts.plan.maker, "numpy": "0.1"})
    Parts.begun(tmp_path, other)
    claims = Claims(tmp_path)
    assert claims.take(Parts(tmp_path, other).name(0))
    with pytest.raises(InputError, match=r"draws this film there; here is another numpy \d"):
        drawn(Failing(9.0), tmp_path)
    claims.release(Parts(tmp_path, other).name(0))
    drawn(Failing(9.0), tmp_path)


@pytest.mark.seldom(14, first=6)
@pytest.mark.slow
def test_two_processes_with_nothing_but_a_folder_in_common_make_one_film(tmp_path: Path) -> None:
    words = ["film", "fig2a", "--seconds", "20", "--fps", "10", "--size", "48x32"]
    words += ["--samples", "0", "--jobs", "1", "--parts", tmp_path / "parts", "--share"]
    with (
        running(*words, "--out", tmp_path / "a.mp4") as first,
        running(*words, "--out", tmp_path / "b.mp4") as second,
    ):
        assert first.wait() == second.wait() == 0
    assert (tmp_path / "a.mp4").read_bytes() == (tmp_path / "b.mp4").read_bytes()
    write(
        film_of(["fig2a"], Wanted(Drawing((48, 32), samples=0), 10.0, 20.0)), tmp_path / "c.mp4", 1
    )
    assert (tmp_path / "a.mp4").read_bytes() == (tmp_path / "c.mp4").read_bytes()
    assert not list((tmp_path / "parts").glob("*.claim"))


# ---- the command


@pytest.mark.seldom(3)
def test_the_command_draws_parts_tells_their_status_and_joins_them(
    shell: Shell, tmp_path: Path
) -> None:
    shell.cwd = tmp_path
    words = ["film", "fig2a", "--size", "32x32", "--fps", "1", "--seconds", "6", "--samples", "0"]
    done = shell(*words, "--parts", "parts", "--jobs", "1")
    assert (done.status, done.out) == (0, "parts\n"), done
    done = shell("film", "--status", "parts")
    assert done.out.splitlines()[1] == "2 of 2 parts", done
    done = shell("film", "--join", "parts", "--out", "film.mp4")
    assert (done.status, done.out) == (0, "film.mp4\n"), done
    refused(shell("film", "--join", "parts", "--out", "film.webm"), "parts are of a film .mp4")
    refused(shell("film", "--join", "parts"), "--out")
    refused(shell("film", "--join", "nowhere", "--out", "a.mp4"), "nowhere", "no such folder")
    refused(shell("film", "--status", "."), "--status .: no film")
    refused(shell("film", "fig2a", "--status", "parts"), "--status: not with VIEW")
    refused(shell(*words, "--share", "--out", "a.mp4"), "--parts")
    refused(shell(*words), "--out or --parts")
    refused(shell("film", "--out", "a.mp4"), "VIEW")
    (tmp_path / "file").touch()
    refused(shell(*words, "--parts", "file"), "--parts file: expected a folder")
    done = shell(*words, "--set", "fog.density=0.2", "--parts", "parts", "--jobs", "1")
    assert "fog.density: ignored" in done.err, "a notice, as where a film is drawn without parts"
    told = shell("film", "--status", "parts").out
    assert "json: fig2a, 6" in told and "json: fig2a fog.density=0.2, 6" in told, told
    refused(shell("film", "--join", "parts", "--out", "b.mp4"), "one of its files")
