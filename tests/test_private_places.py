"""What is nobody else's business is not read by a checked program, wherever it lies.

The process that runs programs is told that a folder of the test is one of the system's, as
/usr/share is: so all in it would be read but for what is hidden.
"""

import os
import tempfile
from argparse import Namespace
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from solved import solved

from framelens.system import containment
from landscape.commands import exercise_class
from landscape.course.exercise import Grader, Report
from landscape.course.grader import confinement, workplace
from landscape.course.grader.confinement import LANDLOCK, NONE, REQUIRE
from landscape.course.roster.grades import Rules, grade_class
from landscape.course.roster.submissions import submissions
from landscape.course.shelf import FOLDER

pytestmark = [
    pytest.mark.posix_only("the system contains no programs"),
    pytest.mark.skipif(
        not containment.possible(), reason="the system has no Landlock, or another processor"
    ),
]
SECONDS = 60.0  # a program may take; the machine may be busy with other tests
SOLUTION = solved("winding")
READS = """
import os
def reads():
    for place in {places!r}:
        try:
            if os.path.isdir(place):
                yield place, os.listdir(place)
            else:
                file = os.open(place, os.O_RDONLY)
                yield place, os.read(file, 9)
        except OSError:
            pass
seen = {seen!r}
assert seen is None or os.listdir(seen), "what is the system's is read"
found = list(reads())
if found:
    raise RuntimeError(f"LEAK {{found}}")
"""


def reads(*places: Path, seen: Path | None = None) -> str:
    """Return a right program that fails if it can read one of some files and folders."""
    code = READS.format(places=[str(each) for each in places], seen=seen and str(seen))
    return SOLUTION.replace("import sys\n", f"import sys\n{code}", 1)


@pytest.fixture
def system(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of the system's, in which there is a class."""
    place = tmp_path / "system"
    for name in ("shared", "class/ada", "class/bob"):
        (place / name).mkdir(parents=True)
    (place / "shared" / "font").write_text("of the system")
    (place / "class" / "bob" / "mine.py").write_text(SOLUTION)
    told(tmp_path, place, monkeypatch)
    return place


def told(tmp_path: Path, place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a folder be one of the system's for the processes that are started."""
    start = tmp_path / "start"
    start.mkdir()
    code = f"from framelens.system import containment\ncontainment.SYSTEM += ({str(place)!r},)\n"
    (start / "sitecustomize.py").write_text(code)
    paths = f"{start}{os.pathsep}{os.environ.get('PYTHONPATH', '')}"
    monkeypatch.setenv("PYTHONPATH", paths)
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path / "cache"))


def checked(path: Path) -> Report:
    with Grader(SECONDS, REQUIRE) as grader:
        return grader.check(path)


def assert_passes(report: Report) -> None:
    assert report.passed and report.contained == LANDLOCK, report.error


@pytest.mark.seldom(10, first=3)
def test_the_others_of_a_class_are_hidden_and_the_rest_of_the_system_is_not(system: Path) -> None:
    mine = system / "class" / "ada" / "mine.py"
    other = system / "class" / "bob"
    mine.write_text(reads(other, other / "mine.py", seen=system / "shared"))
    assert_passes(checked(mine))


@pytest.mark.seldom(10, first=3)
def test_a_class_behind_a_link_is_hidden(system: Path, tmp_path: Path) -> None:
    other = system / "class" / "bob" / "mine.py"
    (tmp_path / "link").symlink_to(system / "class")
    linked = tmp_path / "link" / "ada" / "mine.py"
    linked.write_text(reads(other, tmp_path / "link" / "bob" / "mine.py"))
    assert_passes(checked(linked))
    linked.rename(system / "class" / "bob" / "ada.py")
    linked.symlink_to(system / "class" / "bob" / "ada.py")
    assert_passes(checked(linked))


@pytest.mark.seldom(10, first=3)
@pytest.mark.parametrize("kind", ["a folder", "files"])
def test_a_class_that_is_graded_is_hidden_with_its_tables(
    system: Path, kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = system / "class"
    table = system / "tables" / "grades.csv"
    table.parent.mkdir()
    table.write_text("ada,6")
    (place / "ada.py").write_text(reads(place, place / "bob" / "mine.py", table))
    files = [place] if kind == "a folder" else [place / "ada.py", place / "bob" / "mine.py"]
    options = Namespace(files=files, out=[table], worksheet=None, feedback=None)
    private = exercise_class._private(options)
    temporary = system.parent / "temporary"
    temporary.mkdir()
    monkeypatch.setenv("TMPDIR", str(temporary))
    each = next(each for each in submissions(files) if b"LEAK" in (each.data or b""))
    (graded,) = grade_class([each], Rules(contain=REQUIRE, private=private), jobs=1)
    assert graded.row.passed and graded.row.contained == LANDLOCK, graded.row.error
    assert not list(temporary.iterdir()), "workers delete what they wrote"


@pytest.mark.seldom(10, first=3)
def test_python_alone_refuses_the_class_and_reads_itself_inside_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    other, mine = tmp_path / "class" / "bob.py", tmp_path / "mine.py"
    modules = tmp_path / "class" / "modules"
    modules.mkdir(parents=True)
    other.write_text(SOLUTION)
    (modules / "late_module.py").write_text("")
    monkeypatch.setenv("PYTHONPATH", f"{modules}{os.pathsep}{os.environ.get('PYTHONPATH', '')}")
    with Grader(SECONDS, NONE, private=[str(tmp_path / "class")]) as grader:
        mine.write_text(SOLUTION.replace("import sys\n", "import sys, late_module\n", 1))
        assert grader.check(mine).passed
        mine.write_text(SOLUTION.replace("import sys\n", f"import sys\nopen({str(other)!r})\n", 1))
        error = grader.check(mine).error
    assert error is not None and error["word"] == "read"


@pytest.mark.seldom(10, first=3)
def test_homes_caches_temporary_folders_and_checkouts_are_hidden(
    system: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    secrets = [system / name / "secret" for name in ("home", "cache", "temporary")]
    for path, name in zip(secrets, ("HOME", "LANDSCAPE_CACHE", "TMPDIR"), strict=True):
        path.parent.mkdir()
        path.write_text("secret")
        monkeypatch.setenv(name, str(path.parent))
    monkeypatch.setattr(tempfile, "tempdir", str(system / "temporary"))
    mine = system / "class" / "ada" / "mine.py"
    mine.write_text(reads(*secrets, seen=system / "shared"))
    assert_passes(checked(mine))


@pytest.mark.seldom(10, first=3)
@pytest.mark.parametrize("home", ["/", "/usr", "/opt/nobody"])
def test_any_home_will_do(home: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", home)
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path / "cache"))
    mine = tmp_path / "mine.py"
    mine.write_text(SOLUTION)
    assert_passes(checked(mine))


@pytest.mark.seldom(10, first=3)
def test_a_checkout_in_a_folder_of_the_system_is_hidden(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    checkout = FOLDER.parents[2]
    told(tmp_path, checkout, monkeypatch)
    mine = tmp_path / "mine.py"
    solution = FOLDER / "winding" / "solution.py"
    mine.write_text(reads(checkout / "tests", checkout / "pyproject.toml", solution))
    assert_passes(checked(mine))


@pytest.fixture
def seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., list[str]]]:
    """A function that returns the folders of a test's own system that are read, by their names."""
    place = tmp_path.resolve() / "system"
    for name in ("lib/modules/one", "lib/modules/two/three", "share"):
        (place / name).mkdir(parents=True)
    monkeypatch.setattr(containment, "SYSTEM", (str(place / "lib"), str(place / "share")))
    monkeypatch.syspath_prepend(place / "lib" / "modules")

    def found(cwd: str = "", beside: str = "", private: str = "") -> list[str]:
        confinement._readable.cache_clear()
        places = [str(place / each) for each in (cwd, beside, private)]
        readable, _listed = confinement._readable(places[0], frozenset([places[1]]), places[2])
        inside = [each for each in readable if each.startswith(f"{place}/")]
        return [each.removeprefix(f"{place}/") for each in inside]

    yield found
    confinement._readable.cache_clear()


def test_only_what_is_needed_stays_of_a_folder_with_something_private(
    seen: Callable[..., list[str]],
) -> None:
    assert seen("none", "none", "none") == ["lib", "lib/modules", "share"]
    # Where one works may be the folder that has what is needed.
    assert seen("lib", "none", "share") == ["lib", "lib/modules", "share"]
    assert seen("", "none", "lib/modules") == ["lib", "lib/modules", "share"]
    # A program in a folder of its student, in one of the class.
    assert seen("none", "lib/modules/two/three", "none") == ["lib/modules/one", "share"]
    assert seen("none", "none", "lib/modules/two/three") == ["lib/modules/one", "share"]


def test_a_folder_that_another_grader_takes_as_it_begins_is_made_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    take = workplace._take
    for other_holds in (True, False):
        deleted: list[Path] = []

        def took(lock: int, deleted: list[Path] = deleted, held: bool = other_holds) -> bool:
            if not deleted:
                deleted += tmp_path.glob(f"{workplace.PREFIX}*")
                workplace.delete(deleted[0])
                return not held
            return take(lock)

        monkeypatch.setattr(workplace, "_take", took)
        made = workplace.Workplace()
        assert deleted and made.folder.exists() and made.folder not in deleted
        with made.parts(1) as (part,):
            assert part.is_dir()
        made.close()
