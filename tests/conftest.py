# ruff: noqa: E402  (the environment must be set before OpenGL is imported)
"""Fixtures for all tests. PyOpenGL checks every call, and GL tests must not leave changed state.

A GL test uses the fixture ``stage``; see stage.py.
"""

import gc
import os
import shutil
import sys
import tempfile
import time
from datetime import date
from pathlib import Path

# The tests do not use the user's own cache.
# Worker processes of pytest-xdist inherit the folder of the process that started them.
WORKER = "PYTEST_XDIST_WORKER" in os.environ
if WORKER:
    os.environ.setdefault("LP_NUM_THREADS", "0")  # llvmpipe's threads compete with the workers
else:
    os.environ["LANDSCAPE_CONFIG"] = ""  # no preferences of whoever runs the tests
    os.environ["LANDSCAPE_CACHE"] = tempfile.mkdtemp(prefix="landscape-tests-")
    # All workers take the same day, even if a run goes past midnight.
    os.environ.setdefault("LANDSCAPE_TESTS_DAY", str(date.today().toordinal()))
    # Where the tests have not been compiled yet, the first worker says by this file that they are.
    compiled = f"test_*.{sys.implementation.cache_tag}-pytest-*.pyc"
    if not any(Path(__file__).parent.glob(f"__pycache__/{compiled}")):
        os.environ["LANDSCAPE_TESTS_COMPILED"] = os.environ["LANDSCAPE_CACHE"] + "-compiled"
    # Some containers set it; then each of a few hundred processes would compile all modules again.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
# Numpy's library starts a thread for each processor, in each of a few hundred processes.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ["LANDSCAPE_GL_CHECKS"] = "1"  # read when framelens.gl.context first imports OpenGL

from collections import defaultdict
from collections.abc import Callable, Generator, Iterator

import pytest
from commands import Shell
from copies import copies
from gl_state import changes, snapshot
from hall_pictures import HallPictures
from stage import Stage, write_plain
from sweeps import Todays, longest_first, of_day

from framelens.base.errors import NoOpenGLError
from framelens.gl.context import Context, open_context
from landscape.files.assets import Assets

MOST_COMPILING = 120.0  # seconds; if the first worker has ended, the others need not wait for ever


def pytest_configure(config: pytest.Config) -> None:
    """Give files to the workers in the order of `longest_first`, not by their numbers of tests."""
    config.option.loadscopereorder = False


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Let one worker alone compile the tests and the program; the others read what it wrote."""
    compiled = os.environ.get("LANDSCAPE_TESTS_COMPILED", "")
    first = os.environ.get("PYTEST_XDIST_WORKER") == "gw0"
    if WORKER and compiled and not first:
        begun = time.monotonic()
        while not os.path.exists(compiled) and time.monotonic() - begun < MOST_COMPILING:
            time.sleep(0.2)
    collected = yield
    if compiled and first:
        Path(compiled).touch()
    return collected


def pytest_collection_finish() -> None:
    """Look for garbage less often, and not among the tests: that took a tenth of all time."""
    gc.freeze()
    gc.set_threshold(50_000, 20, 100)


def pytest_sessionfinish() -> None:
    copies.end()
    if not WORKER:
        shutil.rmtree(os.environ["LANDSCAPE_CACHE"], ignore_errors=True)
        Path(os.environ["LANDSCAPE_CACHE"] + "-compiled").unlink(missing_ok=True)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--update-golden",
        action="store_true",
        help="write the golden images instead of comparing with them",
    )
    parser.addoption(
        "--all",
        action="store_true",
        help="run every case of the tests marked `sweep`",
    )


def names_cases(config: pytest.Config) -> bool:
    """Return whether the command line names tests, by ``::`` or by -k: then all of them are run.

    With ``-k "not ..."`` it says only what is left out.
    """
    return any("::" in word for word in config.args) or (
        bool(config.option.keyword) and "not " not in config.option.keyword
    )


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Skip what Windows lacks; leave out most cases of a sweep, unless --all."""
    if sys.platform == "win32":
        for item in items:
            for marker in item.iter_markers("posix_only"):
                item.add_marker(pytest.mark.skip(reason=f"Windows: {marker.args[0]}"))
    else:
        leave_out(
            config, items, [item for item in items if item.get_closest_marker("windows_only")]
        )
    if not runs_all(config):
        leave_out(config, items, not_today(items, int(os.environ["LANDSCAPE_TESTS_DAY"])))
    if WORKER:
        items.sort(key=lambda item: longest_first(item.location[0]))


def runs_all(config: pytest.Config) -> bool:
    """Return whether every case is run: all are asked for, or some are named."""
    return config.getoption("--all") or names_cases(config)


def not_today(items: list[pytest.Item], day: int) -> list[pytest.Item]:
    """Return what is not run on this day: after n days each test and each case has been run.

    Of a test marked `sweep(n, first=0)` every nth case is run; on the next day the cases after
    them, or none if it has fewer than n; `neighbours` are run together, see `of_day`. A test marked
    `seldom(n, first=0)` is run on one day in n.
    """
    families: defaultdict[str, list[pytest.Item]] = defaultdict(list)
    for item in items:
        if item.get_closest_marker("sweep"):
            families[item.nodeid.partition("[")[0]].append(item)

    rest: list[pytest.Item] = []
    for item in items:
        marker = item.get_closest_marker("seldom")
        if marker is not None and (marker.kwargs.get("first", 0) + day) % marker.args[0]:
            rest.append(item)

    for family in families.values():
        marker = family[0].get_closest_marker("sweep")
        assert marker is not None
        chosen = {id(item) for item in of_day(family, day, marker.args[0], **marker.kwargs)}
        rest += [item for item in family if id(item) not in chosen]
    return rest


def leave_out(config: pytest.Config, items: list[pytest.Item], unwanted: list[pytest.Item]) -> None:
    """Deselect tests."""
    if unwanted:
        gone = {*unwanted}
        config.hook.pytest_deselected(items=unwanted)
        items[:] = [item for item in items if item not in gone]


@pytest.fixture(scope="session")
def todays(pytestconfig: pytest.Config) -> Todays:
    """Chooses cases for this day inside a test, as `sweep` does among tests; at least one."""
    return todays_of(pytestconfig)


def todays_of(config: pytest.Config) -> Todays:
    """Return what chooses the cases of a run."""
    if runs_all(config):
        return lambda cases, every, turns=1: list(cases)
    day = int(os.environ["LANDSCAPE_TESTS_DAY"])
    return lambda cases, every, turns=1: of_day(cases, day // turns, min(every, len(cases)))


@pytest.fixture(scope="session")
def the_stage() -> Iterator[Stage]:
    """The context and the target of the whole test run."""
    try:
        context = open_context("auto")
    except NoOpenGLError as error:
        pytest.fail(f"the tests require OpenGL: {error}")
    stage = Stage(context)
    yield stage
    stage.release()


@pytest.fixture
def stage(the_stage: Stage) -> Iterator[Stage]:
    """The shared stage, made current. The test fails if it leaves an error or changed state."""
    the_stage.enter()
    before = snapshot()
    yield the_stage
    the_stage.enter()
    changed = changes(before, snapshot())
    assert not changed, f"the test left changed state: {changed}"


@pytest.fixture(scope="session")
def the_shell() -> Iterator[Shell]:
    """Runs command lines in one process for the whole test run."""
    process = Shell()
    yield process
    process.close()


@pytest.fixture(scope="module")
def shell(the_shell: Shell) -> Shell:
    """The shared shell, in the folder in which the tests were started."""
    the_shell.cwd = Path.cwd()
    return the_shell


@pytest.fixture(scope="session")
def the_hall_pictures(the_stage: Stage) -> Iterator[HallPictures]:
    """Draws the hall, which stays open from one module of tests to the next."""
    pictures = HallPictures(the_stage)
    yield pictures
    pictures.release()


@pytest.fixture
def hall_pictures(the_stage: Stage, the_hall_pictures: HallPictures) -> HallPictures:
    """Draws the hall; the test must not use the state of OpenGL itself."""
    the_stage.enter()
    return the_hall_pictures


@pytest.fixture
def fresh(stage: Stage) -> Iterator[Callable[[], Context]]:
    """Opens contexts, the last of which is current; the test's own are closed after it."""
    opened: list[Context] = []

    def another() -> Context:
        opened.append(open_context(stage.context.backend))
        return opened[-1]

    yield another
    for context in opened:
        context.release()


@pytest.fixture(scope="session")
def plain(tmp_path_factory: pytest.TempPathFactory) -> Assets:
    """Assets whose images have one colour each."""
    return Assets(write_plain(tmp_path_factory.mktemp("plain")))


@pytest.fixture(scope="session")
def shipped() -> Assets:
    """The shipped assets."""
    return Assets()


@pytest.fixture
def plain_folder(tmp_path: Path) -> Path:
    """A folder of one-colour images that the test may modify."""
    folder = tmp_path / "plain"
    folder.mkdir()
    return write_plain(folder)
