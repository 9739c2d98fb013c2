"""A lecturer's own exercises, in any folder: from beginning to grading; and own lessons."""

import io
import shutil
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from commands import landscape, refused
from folded import each

import framelens
from framelens.base.errors import InputError
from framelens.base.executor import Here
from framelens.base.texts import translator
from landscape import __version__
from landscape.commands.exercise_check import as_json, as_text
from landscape.course import handout
from landscape.course.exercise import Grader, Report, gradings
from landscape.course.grader import recorded
from landscape.course.grader.mutants import Mutant, mutants
from landscape.course.own_exercise import FRENCH, new, untranslated, with_new_texts
from landscape.course.own_lesson import own_lesson
from landscape.course.rehearsal import Rehearsal, count
from landscape.course.roster.grades import Rules, grade_class
from landscape.course.roster.page import as_page
from landscape.course.roster.submissions import submissions
from landscape.course.shelf import NAMES, Shelf, start
from landscape.course.solutions import whole

PATIENCE = 100.0  # seconds a program may take here: the machine may be busy with other tests
NAME = "hand"
# Wrong only after forty times Left, which the hidden test presses, and no trial.
TURN = "-turned, 0, 0, 1"
CLAMPED = "-turned if turned != -1200 else 0, 0, 0, 1"


def plain(text: str, context: str = "") -> str:
    return text


def write(folder: Path, language: str = "en") -> Path:
    folder.mkdir(parents=True)
    for name, text in new(NAME, language).items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def shelf(tmp_path_factory: pytest.TempPathFactory) -> Shelf:
    """The new exercise, as it is begun."""
    root = tmp_path_factory.mktemp("exercises")
    write(root / NAME)
    return Shelf(root)


@pytest.fixture(scope="module")
def grader(shelf: Shelf) -> Iterator[Grader]:
    with Grader(PATIENCE, shelf=shelf, seed=1) as found:
        yield found


@pytest.fixture(scope="module")
def clamped(shelf: Shelf, grader: Grader, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A program in which only the hidden test fails."""
    path = tmp_path_factory.mktemp("student") / "ada.py"
    code = (shelf.own[NAME] / "solution.py").read_text(encoding="utf-8")
    path.write_text(code.replace(TURN, CLAMPED), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def report(clamped: Path, grader: Grader) -> Report:
    return grader.check(clamped)


@each("language", ["en", "fr"])
def test_a_new_exercise_has_all_files_and_its_name_in_each_program(language: str) -> None:
    files = new(NAME, language)
    assert set(files) - {FRENCH} == {
        *("README.md", "start.py", "solution.py", "solution2.py"),
        *("grading.py", "hidden.py", "mutants.py"),
    }
    assert (FRENCH in files) == (language == "en")
    for name, text in files.items():
        if name.endswith(".py"):
            compile(text, name, "exec")
    for name in ("start.py", "solution.py", "solution2.py"):
        assert f"# exercise: {NAME}\n" in files[name]
    assert ("aiguille" in files["start.py"]) == (language == "fr")
    for said in set(files) - {"README.md"}:
        assert f"`{said}`" in files["README.md"]


@pytest.mark.parametrize("name", ["", "a b", "../a", "1st", "a" * 61, "hand\n"])
def test_a_name_that_is_no_name_of_an_exercise_is_refused(name: str) -> None:
    with pytest.raises(InputError, match="expected a name of letters"):
        new(name, "en")


@pytest.mark.seldom(13, first=12)
def test_a_new_exercise_holds_as_it_is(shelf: Shelf, grader: Grader) -> None:
    found = shelf.exercise(NAME)
    findings = list(Rehearsal(found, grader, plain).all())
    assert [(str(each.tried), str(each.wrong)) for each in findings if each.wrong] == []
    tried = [str(each.tried) for each in findings]
    assert "start.py runs and does not pass: it gets 0 of 8 points" in tried
    assert len(findings) == count(found) == 2 + 2 + len(mutants(found)) + 1


def test_a_folder_is_read_before_the_course_and_may_be_an_exercise_itself(shelf: Shelf) -> None:
    assert list(shelf.names) == [NAME, *NAMES]
    assert list(Shelf(shelf.own[NAME]).own) == [NAME]
    assert shelf.exercise("winding").folder.parent.name == "exercises"
    assert Shelf(shelf.own[NAME].parent / "none").folder is not None
    with pytest.raises(InputError, match="none: expected a folder with exercises"):
        assert Shelf(shelf.own[NAME].parent / "none").own
    french = start(shelf.exercise(NAME), "fr")
    assert "Un cadran se trouve" in french and "# Votre code vient ici." in french


def changed(name: str, old: str, new_text: str) -> Callable[[Path], None]:
    def change(folder: Path) -> None:
        path = folder / name
        code = path.read_text(encoding="utf-8")
        assert old in code
        path.write_text(code.replace(old, new_text), encoding="utf-8")

    return change


def without(name: str) -> Callable[[Path], None]:
    return lambda folder: (folder / name).unlink()


FAULTS = {
    "no start": (without("start.py"), "start.py: cannot be read"),
    "no grading": (without("grading.py"), "grading.py: cannot be read"),
    "no mutants": (without("mutants.py"), "mutants.py: cannot be read"),
    "no task": (changed("start.py", '"""The hand', 'x = """The hand'), 'start.py: expected """'),
    "no marker": (
        changed("start.py", "# exercise: hand", "# exercise: other"),
        "start.py: expected the line `# exercise: hand`",
    ),
    "no hole": (
        changed("start.py", "# Your code goes here.", "# Here."),
        "start.py: expected the line `# Your code goes here.`",
    ),
    "lessons": (
        changed("start.py", "lessons: transform_order", "lessons: none_such"),
        "start.py: # lessons: 'none_such': expected a lesson",
    ),
    "no python": (changed("start.py", "DIAL = (", "DIAL = (("), "start.py, line "),
    "grading is no python": (
        changed("grading.py", "FRAMES = (0, 2, 4)", "FRAMES = (0, 2"),
        "grading.py, line 12: is not Python",
    ),
    "grading raises": (
        changed("grading.py", "NEAR = 0.02", "NEAR = 1 / 0"),
        "grading.py, line 18: raised ZeroDivisionError",
    ),
    "frames": (
        changed("grading.py", "FRAMES = (0, 2, 4)", "FRAMES = (0, 2, -4)"),
        "grading.py: FRAMES: expected numbers of frames",
    ),
    "events": (
        changed("grading.py", '"key": "RIGHT"', '"key": "RIHGT"'),
        "grading.py: EVENTS: events: event 1",
    ),
    "elsewhere": (
        changed("grading.py", "NEAR = 0.02", "NEAR = 0.02\nELSEWHERE = 2"),
        "grading.py: ELSEWHERE: expected a fraction of the pixels",
    ),
    "needs": (
        changed("grading.py", "stacks = balanced(picture)", "del drawn"),
        "grading.py: placed: needs drawn, which must stand before it",
    ),
    "picture": (
        changed("grading.py", "stacks = balanced(picture)", "del picture"),
        "grading.py: picture: expected a test of this name",
    ),
    "mutants": (
        changed("mutants.py", "MUTANTS = {", "OTHERS = {"),
        "mutants.py: MUTANTS: expected mistakes",
    ),
}


@each("fault", FAULTS)
@pytest.mark.seldom(3, first=2)
def test_a_fault_of_an_exercise_is_one_line_that_names_the_file_and_the_key(
    fault: str, tmp_path: Path
) -> None:
    change, expected = FAULTS[fault]
    folder = write(tmp_path / fault.replace(" ", "_") / NAME)
    change(folder)
    with pytest.raises(InputError) as error:
        found = Shelf(folder.parent).exercise(NAME)
        gradings(found)
        mutants(found)
    assert expected in str(error.value) and "\n" not in str(error.value)
    assert str(error.value).startswith(str(folder))


@pytest.mark.seldom(14, first=11)
def test_a_rehearsal_says_what_does_not_hold(shelf: Shelf, grader: Grader, tmp_path: Path) -> None:
    found = shelf.exercise(NAME)
    rehearsal = Rehearsal(found, grader, plain)
    assert rehearsal.start().wrong is None
    mistakes = mutants(found)
    changes = mistakes["wrong_way"].changes
    wrong = {
        "it passes": Mutant("", "placed", []),
        "fails in turns, expected placed": Mutant("", "placed", changes),
        "times in the solution": Mutant("", "placed", [("none such", "")]),
    }
    for expected, mutant in wrong.items():
        assert expected in str(rehearsal.mistake("", mutant).wrong)
    assert rehearsal.mistake("order", mistakes["order"]).wrong is None
    assert "gets the hint of order" in str(rehearsal.mistake("again", mistakes["order"]).wrong)
    few = rehearsal.count(dict(list(mistakes.items())[:3]))
    assert (str(few.tried), str(few.wrong)) == ("mutants.py has at least 4 mistakes", "it has 3")


@pytest.mark.seldom(14, first=5)
def test_what_a_test_raises_of_the_solution_is_said_with_its_line(tmp_path: Path) -> None:
    folder = write(tmp_path / NAME)
    changed("grading.py", "return (left + right) / 2, tip", "return left(right), tip")(folder)
    line = (folder / "grading.py").read_text().splitlines().index("    return left(right), tip") + 1
    own = Shelf(tmp_path)
    with Grader(PATIENCE, shelf=own, seed=1) as grader:
        found = Rehearsal(own.exercise(NAME), grader, plain).solution(folder / "solution.py")
    assert str(found.wrong) == (
        f"placed raised TypeError, grading.py, line {line}: 'numpy.ndarray' object is not callable"
    )


def test_new_texts_come_into_the_catalogue_and_the_rest_of_it_stays(tmp_path: Path) -> None:
    folder = write(tmp_path / NAME)
    changed("hidden.py", "The hand turns back", "The hand comes back")(folder)
    found = Shelf(tmp_path).exercise(NAME)
    assert untranslated(found) == ["The hand comes back beyond a whole turn"]
    data, added = with_new_texts(found)
    assert added == 1 and data.decode().startswith((folder / FRENCH).read_text()[:400])
    gone, back = 'msgid "The hand turns back', 'msgid "The hand comes back'
    assert f"#~ {gone}" in data.decode() and f"\n{back}" in data.decode()
    (folder / FRENCH).write_bytes(data)
    assert with_new_texts(found) == (data, 0)
    assert untranslated(found) == ["The hand comes back beyond a whole turn"]
    (folder / FRENCH).write_text("msgtext\n")
    with pytest.raises(InputError, match=r"fr\.po: not a catalogue of texts"):
        untranslated(found)


@pytest.mark.seldom(4, first=3)
def test_only_a_hidden_test_fails_where_no_other_looks(report: Report) -> None:
    assert [result.test.key for result in report.results if not result.passed] == ["back"]
    assert not report.passed
    shown = as_json(report, plain)["tests"]
    assert [test["hidden"] for test in shown] == [False] * 6 + [True]
    assert [test["points"] for test in shown] == [1, 1, 2, 1, 1, 1, 1]
    assert "back beyond a whole turn (not shown to students)" in "\n".join(as_text(report, plain))


@pytest.mark.seldom(13, first=12)
def test_points_count_and_what_is_hidden_reaches_no_students_page(
    clamped: Path, shelf: Shelf, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path))
    found = submissions([clamped])
    (graded,) = grade_class(found, Rules(exercises=shelf.folder), executor=Here())
    row = graded.row
    assert (row.points, row.of, row.passed) == (7, 8, False)
    assert row.hint == "The tests that you see pass, but not all of those that you do not see."
    assert row.tests[-1]["hidden"] and row.tests[-1]["hint"]
    page, whole = (as_page([graded], "en", plain, hidden) for hidden in (False, True))
    assert row.tests[-1]["hint"].encode() in whole and row.tests[-1]["hint"].encode() not in page


@pytest.mark.seldom(14, first=11)
def test_students_check_what_they_get_and_get_no_solution(shelf: Shelf, tmp_path: Path) -> None:
    found = shelf.exercise(NAME)
    files = handout.for_students([found, shelf.exercise("winding")], shelf, "fr")
    assert sorted(files) == [
        "README.txt",
        *(f"exercises/{NAME}/{name}" for name in (FRENCH, "grading.py", recorded.FILE, "start.py")),
        f"{NAME}.py",
        "winding.py",
    ]
    wheels = f"framelens-{framelens.__version__}-py3-none-any.whl landscape_gl-{__version__}-"
    assert f"pip install {wheels}" in files["README.txt"].decode()
    assert b"glTranslatef" not in b"".join(files[name] for name in files if NAME in name)
    assert "Quarante fois" not in files[f"exercises/{NAME}/{FRENCH}"].decode()
    for name, data in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(data)
    with Grader(PATIENCE, shelf=Shelf(tmp_path / "exercises")) as grader:
        mine = tmp_path / "mine.py"
        mine.write_text(whole(shelf.own[NAME] / "solution2.py", shelf.own[NAME]), encoding="utf-8")
        assert grader.check(mine).passed
        assert not grader.check(tmp_path / f"{NAME}.py").passed
    programs = handout.for_students([found], shelf, "en", checks=False)
    assert sorted(programs) == ["README.txt", f"{NAME}.py"]
    kept = handout.for_teachers([found])
    assert {f"{NAME}/{name}" for name in ("solution.py", "hidden.py", "mutants.py")} <= set(kept)


@pytest.mark.seldom(14, first=8)
def test_the_commands_begin_start_and_pack_an_exercise(tmp_path: Path) -> None:
    done = landscape("exercise", "new", NAME, cwd=tmp_path)
    assert (done.status, done.out.splitlines()[-1]) == (0, f"landscape exercise test {NAME}")
    refused(landscape("exercise", "new", NAME, cwd=tmp_path), f"{NAME}: is there already")
    done = landscape("exercise", "list", "--exercises", ".", cwd=tmp_path)
    assert done.out.startswith(NAME)
    done = landscape(
        "exercise", "start", NAME, "--exercises", ".", "--out", "mine.py", cwd=tmp_path
    )
    assert done.status == 0, done.err
    done = landscape(
        "exercise", "check", "mine.py", "--exercises", ".", "--lang", "fr", cwd=tmp_path
    )
    assert done.status == 1 and "Il y a une aiguille" in done.out
    refused(landscape("exercise", "check", "mine.py", cwd=tmp_path), "'hand': expected an exercise")
    (tmp_path / "empty").mkdir()
    refused(
        landscape("exercise", "list", "--exercises", "empty", cwd=tmp_path),
        "--exercises empty: expected a folder with exercises",
    )

    shutil.rmtree(tmp_path / NAME / "__pycache__", ignore_errors=True)
    words = ["exercise", "pack", NAME, "--out", "handout"]
    done = landscape(*words, "--untested", cwd=tmp_path)
    assert done.status == 0, done.err
    with zipfile.ZipFile(io.BytesIO((tmp_path / "handout/students.zip").read_bytes())) as archive:
        assert f"{NAME}.py" in archive.namelist()
    changed("solution.py", "-turned", "turned")(tmp_path / NAME)
    refused(
        landscape(*words, cwd=tmp_path),
        f"{NAME}: expected that solution.py passes, but: turns does not find what it looks for",
    )
    done = landscape("exercise", "test", NAME, "--french", "--lang", "fr", cwd=tmp_path)
    assert done.status == 1 and "turns ne trouve pas ce que le test cherche" in done.out
    assert translator("fr", "course")("The exercise does not hold yet.") in done.out


@pytest.mark.seldom(10, first=5)
def test_a_program_of_ones_own_is_a_lesson(tmp_path: Path) -> None:
    code = new(NAME, "en")["solution.py"]
    tags = "# picture: frame 2 after RIGHT\n"
    (tmp_path / "mine.py").write_text(f'"""A hand\n\nIt turns.\n"""\n{tags}{code}')
    done = landscape("lesson", "./mine.py", "--out", "hand.png", cwd=tmp_path)
    assert (done.status, done.out) == (0, "hand.png\n"), done.err
    found = own_lesson(tmp_path / "mine.py")
    assert (found.name, found.title, found.about) == ("mine", "A hand", ("It turns.",))
    assert (found.frame, found.pressed) == (2, ("RIGHT",))

    (tmp_path / "bare.py").write_text(code)
    assert own_lesson(tmp_path / "bare.py").title == "bare"
    (tmp_path / "wrong.py").write_text("# picture: third\n")
    (tmp_path / "broken.py").write_text("def f(:\n")
    for name, *words, expected in (
        ("wrong.py", "wrong.py: expected `# picture: frame N"),
        ("broken.py", "broken.py, line 1: is not Python (invalid syntax)"),
        ("absent.py", "absent.py: cannot be read"),
        ("bare.py", "--copy", "--copy: expected a lesson of the course, not bare.py"),
    ):
        refused(landscape("lesson", name, *words, cwd=tmp_path), expected)
