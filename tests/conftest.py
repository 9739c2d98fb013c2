# ruff: noqa: E402  (the environment must be set before OpenGL is imported)
"""Fixtures for all tests. PyOpenGL checks every call, and GL tests must not leave changed state.

A GL test uses the fixture ``stage``; see stage.py.
"""

import gc
import os
import shutil
import sys
import tempfile

# The tests do not use the user's own cache.
# Worker processes of pytest-xdist inherit the folder of the process that started them.
WORKER = "PYTEST_XDIST_WORKER" in os.environ
if WORKER:
    os.environ.setdefault("LP_NUM_THREADS", "0")  # llvmpipe's threads compete with the workers
else:
    os.environ["LANDSCAPE_CACHE"] = tempfile.mkdtemp(prefix="landscape-tests-")
    # Some containers set it; then each of a few hundred processes would compile all modules again.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
# Numpy's library starts a thread for each processor, in each of a few hundred processes.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ["LANDSCAPE_GL_CHECKS"] = "1"  # read when framelens.gl.context first imports OpenGL

from collections import defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from copies import copies
from gl_state import changes, snapshot
from hall_pictures import HallPictures
from stage import Stage, write_plain

from framelens.base.errors import NoOpenGLError
from framelens.gl.context import Context, open_context
from landscape.files.assets import Assets


def pytest_collection_finish() -> None:
    """Look for garbage less often, and not among the tests: that took a tenth of all time."""
    gc.freeze()
    gc.set_threshold(50_000, 20, 100)


def pytest_sessionfinish() -> None:
    copies.end()
    if not WORKER:
        shutil.rmtree(os.environ["LANDSCAPE_CACHE"], ignore_errors=True)


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


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Skip what Windows lacks; leave out most cases of a sweep, unless --all.

    `sweep(n, first=0)` keeps every nth case from the one numbered ``first``, at least one of them.
    """
    for item in items if sys.platform == "win32" else ():
        for marker in item.iter_markers("posix_only"):
            item.add_marker(pytest.mark.skip(reason=f"Windows: {marker.args[0]}"))
    if sys.platform != "win32":
        left = [item for item in items if not item.get_closest_marker("windows_only")]
        config.hook.pytest_deselected(items=[item for item in items if item not in left])
        items[:] = left

    if config.getoption("--all"):
        return
    families: defaultdict[str, list[pytest.Item]] = defaultdict(list)
    for item in items:
        if item.get_closest_marker("sweep"):
            families[item.nodeid.partition("[")[0]].append(item)
    left_out = set()
    for family in families.values():
        marker = family[0].get_closest_marker("sweep")
        assert marker is not None
        every, first = marker.args[0], marker.kwargs.get("first", 0)
        left_out |= {*family} - {*(family[first::every] or family[:1])}

    if left_out:
        config.hook.pytest_deselected(items=list(left_out))
        items[:] = [item for item in items if item not in left_out]


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


@pytest.fixture(scope="module")
def hall_pictures(the_stage: Stage) -> Iterator[HallPictures]:
    """Draws the hall; the test must not use the state of OpenGL itself."""
    the_stage.enter()
    pictures = HallPictures(the_stage)
    yield pictures
    pictures.release()


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
