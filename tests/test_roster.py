"""A class: submissions found in folders and zips, graded, and written as tables."""

import csv
import io
import json
import os
import zipfile
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import jsonschema
import pytest
from commands import landscape, refused
from solved import solved

from framelens.base.errors import InputError
from framelens.base.executor import Here
from framelens.base.texts import translator
from landscape.commands.exercise_class import _page_name
from landscape.course.roster import grades, moodle, tables
from landscape.course.roster.grades import Graded, Row, Rules, grade_class
from landscape.course.roster.page import as_page, told
from landscape.course.roster.submissions import MOST_BYTES, Submission, submissions

FOLDER = "{}_{}_assignsubmission_file"
HEADERS = "Identifier,Full name,Grade,Last modified (grade),Feedback comments"


ROOT = Path(__file__).resolve().parents[1]
SCHEMA = json.loads((ROOT / "docs/exercises.schema.json").read_text(encoding="utf-8"))


def zipped(path: Path, files: dict[str, str | bytes]) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in files.items():
            archive.writestr(zipfile.ZipInfo(name, (2026, 11, 3, 12, 0, 0)), data)
    return path


def test_the_names_of_moodles_folders_are_those_of_its_own_code() -> None:
    assert moodle.participant("Zoé de la Tour_1042_assignsubmission_file") == (
        "Zoé de la Tour",
        "1042",
    )
    assert moodle.participant("Participant_7_assignsubmission_onlinetext_x") == ("Participant", "7")
    assert moodle.participant("Zoé_seven_assignsubmission_file") is None
    assert moodle.participant("src") is None


def test_submissions_are_found_in_a_zip_as_moodle_makes_it(tmp_path: Path) -> None:
    inner = io.BytesIO()
    with zipfile.ZipFile(inner, "w") as archive:
        archive.writestr("work/mine.py", "inner")
    path = zipped(
        tmp_path / "class.zip",
        {
            f"{FOLDER.format('Ada', 2)}/fog.py": "ada",
            f"{FOLDER.format('Bo', 1)}/one.py": "first",
            f"{FOLDER.format('Bo', 1)}/deep/two.py": "second",
            f"{FOLDER.format('Cy', 3)}/notes.txt": "none",
            f"{FOLDER.format('Di', 4)}/work.zip": inner.getvalue(),
            f"{FOLDER.format('Ed', 5)}/large.py": b" " * (MOST_BYTES + 1),
            f"{FOLDER.format('Flo', 6)}/broken.zip": b"PK no zip",
            "__MACOSX/._fog.py": "rubbish",
        },
    )

    found = submissions([path])
    assert [(each.student, each.id, each.data) for each in found] == [
        ("Ada", "2", b"ada"),
        ("Bo", "1", b"second"),
        ("Bo", "1", b"first"),
        ("Cy", "3", None),
        ("Di", "4", b"inner"),
        ("Ed", "5", None),
        ("Flo", "6", None),
    ]
    assert [str(each.error) for each in found if each.error] == [
        "Cy: handed in no program, expected a file that ends in .py",
        f"{FOLDER.format('Ed', 5)}/large.py: too large, expected at most 1 MB",
        f"{FOLDER.format('Flo', 6)}/broken.zip: is not a zip that can be read",
    ]


def test_files_folders_and_a_folder_around_all_are_submissions_of_who_is_named(
    tmp_path: Path,
) -> None:
    outer = tmp_path / "class" / "week 3"
    for name in ("ada/fog.py", "bo/src/fog.py"):
        (outer / name).parent.mkdir(parents=True)
        (outer / name).write_text(name)
    (tmp_path / "cy.py").write_text("cy")
    found = submissions([tmp_path / "class", tmp_path / "cy.py"])
    assert [each.student for each in found] == ["ada", "bo", "cy"]
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match="empty: expected programs, found none"):
        submissions([tmp_path / "empty"])


@pytest.mark.posix_only("links and pipes")
def test_links_and_pipes_in_a_folder_are_refused_at_once(tmp_path: Path) -> None:
    for name in ("ada", "bob", "eve"):
        (tmp_path / name).mkdir()
    (tmp_path / "ada" / "mine.py").write_text("x")
    (tmp_path / "bob" / "mine.py").symlink_to("../ada/mine.py")
    os.mkfifo(tmp_path / "eve" / "mine.py")
    ada, bob, eve = submissions([tmp_path])
    assert ada.data == b"x"
    assert bob.data is None and "found a link" in str(bob.error)
    assert eve.data is None and "found a pipe" in str(eve.error)


@pytest.mark.parametrize("name", ["../out.py", "/etc/out.py", "a/../../out.py", "..\\out.py"])
def test_a_zip_with_a_name_outside_of_itself_is_refused(name: str, tmp_path: Path) -> None:
    path = zipped(tmp_path / "class.zip", {name: "x"})
    with pytest.raises(InputError, match="has a file outside of itself"):
        submissions([path])


def test_a_zip_that_unpacks_to_too_much_is_refused_before_it_takes_the_memory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("landscape.course.roster.submissions.MOST_UNPACKED", 5000)
    inner = io.BytesIO()
    with zipfile.ZipFile(inner, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("mine.py", " " * 3000)
    said = "expected at most 0 MB of programs"
    two = {"a/mine.py": " " * 3000, "b/mine.py": " " * 3000}
    with pytest.raises(InputError, match=said):
        submissions([zipped(tmp_path / "two.zip", two)])
    nested = {"a/mine.py": " " * 3000, "b/work.zip": inner.getvalue()}
    with pytest.raises(InputError, match=said):
        submissions([zipped(tmp_path / "nested.zip", nested)])


def inner_zip(files: dict[str, str | bytes]) -> bytes:
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return whole.getvalue()


@pytest.mark.parametrize(
    ("handed_in", "said"),
    [
        ({"work.zip": inner_zip({f"{n}.py": b"#" * 1_000_000 for n in range(9)})}, "at most 4 MB"),
        ({f"{n}.py": b"#" * 1_000_000 for n in range(9)}, "at most 4 MB"),
        ({"work.zip": inner_zip({f"{n}.py": "x" for n in range(99)})}, "more than 50 programs"),
        ({f"lib/{n}.py": "x" for n in range(99)}, "more than 50 programs"),
        ({"mine.py/": ""}, "handed in no program"),
        ({"work.zip": inner_zip({"mine.py/": ""})}, "handed in no program"),
    ],
)
@pytest.mark.parametrize("kind", ["zip", "folder"])
def test_what_one_student_hands_in_takes_nothing_from_the_others(
    handed_in: dict[str, bytes], said: str, kind: str, tmp_path: Path
) -> None:
    others = {"bob/work.zip": inner_zip({"mine.py": "bob"}), "cy/mine.py": b"cy"}
    files = {f"ada/{name}": data for name, data in handed_in.items()} | others
    path = zipped(tmp_path / "class.zip", files)
    if kind == "folder":
        path = tmp_path / "class"
        zipfile.ZipFile(tmp_path / "class.zip").extractall(path)
    found = submissions([path])
    assert [each.data for each in found[-2:]] == [b"bob", b"cy"]
    assert said in str(found[-3].error) and found[-3].student == "ada"


def test_a_zip_that_asks_for_gigabytes_to_unpack_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def read(*_: object) -> bytes:
        raise MemoryError

    monkeypatch.setattr(zipfile.ZipExtFile, "read", read)
    (found,) = submissions([zipped(tmp_path / "class.zip", {"mine.py": "x"})])
    assert "is damaged or encrypted" in str(found.error)


CLASS = {
    f"{FOLDER.format('Ada', 2)}/winding.py": solved("winding"),
    f"{FOLDER.format('Bo', 1)}/winding.py": solved("winding").replace(
        "(CREAM, TOP, 2, 3)", "(CREAM, TOP, 3, 2)"
    ),
    f"{FOLDER.format('=Cy', 3)}/winding.py": "print(1)\n",
    f"{FOLDER.format('Di', 4)}/notes.txt": "no program",
}


@pytest.mark.seldom(13, first=1)
def test_a_class_is_a_row_each_in_every_table(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path / "cache"))
    found = submissions([zipped(tmp_path / "class.zip", CLASS)])
    rules = Rules(points=10.0)
    due = datetime(2026, 11, 3, 11, 0, 0)
    graded = grade_class(found, rules, due, executor=Here())
    rows = {each.row.student: each.row for each in graded}

    assert list(rows) == ["=Cy", "Ada", "Bo", "Di"]
    ada, bo = rows["Ada"], rows["Bo"]
    assert ada.passed and (ada.points, ada.of, ada.hint, ada.late) == (10.0, 10.0, "", True)
    assert not bo.passed and 0 < bo.points < 10 and "clockwise" in bo.hint
    assert "expected a line such as" in rows["=Cy"].error and rows["=Cy"].points == 0
    assert rows["Di"].error == "Di: handed in no program, expected a file that ends in .py"
    assert all(bool(each.picture) == bool(each.row.tests) for each in graded)

    read = list(csv.DictReader(io.StringIO(tables.as_csv(list(rows.values())).decode())))
    assert [row["student"] for row in read] == ["'=Cy", "Ada", "Bo", "Di"]
    assert [row["passed"] for row in read] == ["no", "yes", "no", "no"]
    whole = json.loads(tables.as_json(list(rows.values())))
    jsonschema.validate(whole, SCHEMA)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({"submissions": [{**whole["submissions"][0], "points": "1"}]}, SCHEMA)
    whole = whole["submissions"]
    assert whole[1]["tests"][0]["passed"] is True and whole[2]["hint"] == bo.hint
    suites = ElementTree.fromstring(tables.as_junit(list(rows.values())))
    assert [suite.get("failures") for suite in suites] == ["0", "0", "1", "0"]
    assert [suite.get("errors") for suite in suites] == ["1", "0", "0", "1"]
    result = json.loads(tables.as_gradescope(bo))
    assert result["score"] == bo.points and len(result["tests"]) == len(bo.tests)

    # A file that has not changed is not run again, unless that is asked for.
    def fail(*_: object) -> None:
        raise KeyboardInterrupt("graded again")  # an error would be a row's

    monkeypatch.setattr(grades._Opened, "graded", fail)
    assert grade_class(found, rules, due, executor=Here()) == graded
    with monkeypatch.context() as without_workers:
        without_workers.setattr(grades, "lent_or_own", fail)
        assert grade_class(found, rules, due) == graded
    with pytest.raises(KeyboardInterrupt, match="graded again"):
        grade_class(found, Rules(points=10.0, again=True), due, executor=Here())


def test_programs_of_one_exercise_are_graded_together_and_each_worker_gets_some(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    names = ["fog", "winding", "fog", "", "winding", "fog"]
    texts = [f"# exercise: {name}\n{n}".encode() for n, name in enumerate(names)]
    tasks: list[list[int]] = []

    def grade(rules: Rules, given: list[bytes]) -> list[tuple[dict[str, Any], bytes]]:
        tasks.append([texts.index(each) for each in given])
        return [({"hint": str(texts.index(each))}, b"") for each in given]

    monkeypatch.setattr(grades, "grade", grade)
    found = [Submission(f"S{n}", data=text) for n, text in enumerate([*texts, texts[1]])]
    told: list[str] = []
    graded = grade_class(found, Rules(), done=told.append, executor=Here(), jobs=1)
    assert tasks == [[0, 2, 5], [1, 4], [3]]
    assert [each.row.hint for each in graded] == ["0", "1", "2", "3", "4", "5", "1"]
    assert told == [f"S{n}" for n in range(7)]  # in their order

    # Where there are few, no worker takes all of an exercise; where there are many, a task is
    # no longer than one waits for the next line of progress.
    tasks.clear()
    grade_class(found, Rules(), executor=Here(), jobs=2)
    assert tasks == [[0, 2], [1, 4], [3], [5]]
    tasks.clear()
    texts[:] = [f"# exercise: fog\n{n}".encode() for n in range(100)]
    found = [Submission(f"S{n}", data=text) for n, text in enumerate(texts)]
    grade_class(found, Rules(), executor=Here(), jobs=2)
    assert {len(each) for each in tasks[:-1]} == {grades.TOGETHER}


# The attributes of each element of a JUnit report by its schema (Jenkins' junit-10.xsd), and
# the elements that it may have inside; those that we write.
JUNIT = {
    "testsuites": (set(), {"testsuite"}),
    "testsuite": (
        {"name", "tests", "failures", "errors", "skipped", "time"},
        {"testcase"},
    ),
    "testcase": ({"name", "classname"}, {"failure", "error", "skipped"}),
    "failure": ({"message"}, set()),
    "error": ({"message"}, set()),
    "skipped": (set(), set()),
}


def judged() -> list[Row]:
    """Return rows of a class: one with tests, one that did not end, one without a program."""
    tests = [
        {"name": "a", "passed": True, "hint": "", "points": 1.0, "hidden": False},
        {"name": "b", "passed": False, "hint": "<why>", "points": 2.0, "hidden": False},
        {"name": "c", "passed": None, "hint": "", "points": 1.0, "hidden": True},
    ]
    return [
        Row("Ada", "1", "a.py", tests=tests, points=1.0, of=4.0),
        Row("Bo", "2", "b.py", tests=tests, of=4.0, error="did not end"),
        Row("Cy", "3", "c.py", error="no program"),
    ]


def test_a_reader_of_junit_reports_finds_each_test() -> None:
    junitparser = pytest.importorskip("junitparser")
    read = junitparser.JUnitXml.fromstring(tables.as_junit(judged()))
    assert [suite.name for suite in read] == ["Ada", "Bo", "Cy"]
    results = [[type(each).__name__ for case in suite for each in case.result] for suite in read]
    assert results == [["Failure", "Skipped"], ["Error"], ["Error"]]


def test_junit_reports_are_as_their_schema_says_and_their_counts_are_right() -> None:
    rows = judged()
    root = ElementTree.fromstring(tables.as_junit(rows))
    for element in root.iter():
        attributes, inside = JUNIT[element.tag]
        assert set(element.attrib) == attributes and {child.tag for child in element} <= inside
    for suite in root:
        counts = {
            "tests": len(suite.findall("testcase")),
            "failures": len(suite.findall("testcase/failure")),
            "errors": len(suite.findall("testcase/error")),
            "skipped": len(suite.findall("testcase/skipped")),
        }
        assert {name: int(suite.get(name, "")) for name in counts} == counts
    assert [suite.get("tests") for suite in root] == ["3", "1", "1"]


def test_gradescopes_results_have_only_its_own_fields() -> None:
    tests = [
        {"name": "a", "passed": True, "hint": "", "points": 1.0, "hidden": False},
        {"name": "b", "passed": False, "hint": "why", "points": 2.5, "hidden": True},
    ]
    row = Row("Ada", "1", "a.py", tests=tests, points=1.0, of=3.5, hint="why", seconds=0.5)
    result = json.loads(tables.as_gradescope(row))
    assert set(result) <= {
        *("score", "execution_time", "output", "output_format", "visibility"),
        *("stdout_visibility", "extra_data", "tests", "leaderboard"),
    }
    for test in result["tests"]:
        assert set(test) <= {
            *("score", "max_score", "status", "name", "name_format", "number", "output"),
            *("output_format", "tags", "visibility", "extra_data"),
        }
        assert test["status"] in ("passed", "failed")
    assert [test["visibility"] for test in result["tests"]] == ["visible", "hidden"]
    assert sum(test["score"] for test in result["tests"]) == result["score"] == row.points
    assert sum(test["max_score"] for test in result["tests"]) == row.of


def test_names_are_sorted_by_their_letters_whatever_accents_they_have(tmp_path: Path) -> None:
    names = ["Zoé/b.py", "Éva/é.py", "Éva/f.py", "Eve/a.py", "eva/a.py", "Öz/a.py"]
    path = zipped(tmp_path / "class.zip", dict.fromkeys(names, "x"))
    found = [each.file for each in submissions([path])]
    assert found == ["eva/a.py", "Éva/é.py", "Éva/f.py", "Eve/a.py", "Öz/a.py", "Zoé/b.py"]


def test_names_in_utf_8_are_read_where_a_zip_does_not_say_so(tmp_path: Path) -> None:
    data = zipped(tmp_path / "class.zip", {"Zoé/a.py": "x"}).read_bytes()
    silent = data.replace(b"\x00\x08\x00\x00", b"\x00\x00\x00\x00")  # the flag, twice
    assert silent != data
    (tmp_path / "class.zip").write_bytes(silent)
    assert [each.student for each in submissions([tmp_path / "class.zip"])] == ["Zoé"]


def test_a_line_that_the_hint_names_is_not_named_twice() -> None:
    row = Row("a", "1", "a.py", hint="Line 50 draws it.", line=50)
    assert told(row, translator("en", "course")) == "Line 50 draws it."
    assert told(replace(row, hint="It moves."), translator("en", "course")) == "line 50: It moves."


def test_each_program_of_a_student_has_a_page_of_its_own() -> None:
    folder = FOLDER.format("Bo", 1)
    names = "one.py", "a/x.py", "b/x.py", "work.zip/x.py"
    bo = Submission("Bo", folder=folder)
    pages = [_page_name(Graded(Row("Bo", "1", f"{folder}/{name}"), bo)) for name in names]
    assert pages == ["one.html", "a_x.html", "b_x.html", "work_zip_x.html"]
    assert _page_name(Graded(Row("Bo", "1", ""), bo)) == "_.html"
    page = as_page([Graded(Row("Bo", "1", f"{folder}/a/x.py"), bo)], "en", str).decode()
    assert "<td>Bo</td><td>a/x.py</td>" in page


def test_a_worksheet_changes_in_two_columns_and_nowhere_else() -> None:
    lines = [
        f"\ufeff{HEADERS}",
        'Participant 1,"Bo, the ""first""",,-,',
        "Participant 2,Ada,,-,",
        "Participant 9,Nobody,3.00,-,kept",
    ]
    sheet = "\r\n".join([*lines, ""]).encode()
    marks = {
        "1": moodle.Mark("7.5", 'say "which", twice'),
        "2": moodle.Mark("10", ""),
        "5": moodle.Mark("1", "absent"),
    }

    filled, absent = moodle.filled(sheet, marks, "sheet.csv")
    assert absent == ["5"]
    assert filled.decode().split("\r\n") == [
        lines[0],
        'Participant 1,"Bo, the ""first""",7.5,-,"say ""which"", twice"',
        "Participant 2,Ada,10,-,",
        lines[3],
        "",
    ]

    french = "Identifiant,Nom complet,Note,Feedback par commentaires\nParticipant 2,Ada,,\n"
    filled, absent = moodle.filled(french.encode(), marks, "f.csv")
    assert filled.decode().splitlines()[1] == "Participant 2,Ada,10,"

    with pytest.raises(InputError, match=r"sheet\.csv: expected a grading worksheet"):
        moodle.filled(b"a,b\n1,2\n", marks, "sheet.csv")
    with pytest.raises(InputError, match=r"sheet\.csv: expected a grading worksheet"):
        moodle.filled(b"\xff\xfe", marks, "sheet.csv")


def test_the_highest_grade_is_the_number_beside_the_grades() -> None:
    sheets = {
        "Identifier,Grade,Maximum Grade\nParticipant 1,,20.00\n": 20.0,
        'Identifiant,Note,Note maximale\nParticipant 1,,"12,50"\n': 12.5,
        'Identifier,Grade,Scale\nParticipant 1,,"Bad\nGood"\n': None,
        "Identifier,Feedback comments,Grade\nParticipant 1,,\n": None,
    }
    for sheet, most in sheets.items():
        assert moodle.highest(sheet.encode(), "sheet.csv") == most


def test_a_scale_is_told_by_its_header_not_by_what_moodle_last_wrote(tmp_path: Path) -> None:
    by_scale = 'Identifier,Grade,Scale,Feedback comments\nParticipant 1,,"Bad, Good",\n'
    assert moodle.by_scale(by_scale.encode(), "s.csv")
    assert moodle.by_scale(by_scale.replace("Scale", "Barème").encode(), "s.csv")
    assert not moodle.by_scale(f"{HEADERS}\nParticipant 1,Bo,,-,\n".encode(), "s.csv")
    assert not moodle.by_scale(b"Identifier,Grade\nParticipant 1,\n", "s.csv")

    (tmp_path / "empty.py").write_text("\n")
    (tmp_path / "sheet.csv").write_text(by_scale)
    words = ["exercise", "check", "empty.py", "--worksheet", "sheet.csv", "--points", "10"]
    assert landscape(*words, cwd=tmp_path).err == (
        "landscape: sheet.csv: the assignment is graded by a scale: Moodle passes over points, and "
        "takes the comments\n"
    )


def test_control_characters_of_a_student_reach_no_table() -> None:
    row = Row("\x1b[31mEve\n", "1", "a\x00.py", hint="\x07 ring", error="")
    assert tables.printable("a\u00a0: b\u202f!\n") == "a\u00a0: b\u202f! "
    for text in (tables.as_csv([row]), tables.as_junit([row])):
        assert not set(text.decode()) & set("\x1b\x00\x07")
    ElementTree.fromstring(tables.as_junit([row]))


@pytest.mark.seldom(14, first=11)
def test_the_command_writes_what_is_asked_for_and_nothing_where_it_cannot(tmp_path: Path) -> None:
    zipped(tmp_path / "class.zip", CLASS)
    sheet = tmp_path / "sheet.csv"
    headers = HEADERS.replace("Grade,", "Grade,Maximum Grade,")
    sheet.write_text(f"{headers}\nParticipant 1,Bo,,20.00,-,\nParticipant 2,Ada,,20.00,-,\n")
    words = ["exercise", "check", "class.zip", "--worksheet", "sheet.csv", "--feedback", "back.zip"]
    outs = ["--out", "t.csv", "--out", "t.html", "--out", "t.xml", "--out", "gradescope"]
    done = landscape(*words, *outs, "--lang", "fr", cwd=tmp_path)
    assert done.status == 1, done.err
    assert "Ada" in done.out and "Programmes reçus : 1 sur 4" in done.out.replace("\u00a0", " ")
    assert "Participant 2,Ada,20,20.00,-," in sheet.read_text()
    assert "20/20" in done.out and " 0/20" in done.out
    page = (tmp_path / "t.html").read_text()
    assert '<html lang="fr">' in page and page.count("data:image/png") == 2
    assert page.count("<figcaption><span>l’image de l’étudiant</span>") == 2
    with zipfile.ZipFile(tmp_path / "back.zip") as archive:
        assert f"{FOLDER.format('Bo', 1)}/winding.html" in archive.namelist()
    assert len(list((tmp_path / "gradescope").glob("*/results.json"))) == 4

    (tmp_path / "empty.py").write_text("\n")
    words = ["exercise", "check", "empty.py", "--worksheet", "sheet.csv", "--points", "10"]
    done = landscape(*words, "--out", "t.html", cwd=tmp_path)
    assert done.err == (
        "landscape: sheet.csv: the assignment's maximum grade is 20, and a whole program gets 10 "
        "by --points\n"
    )
    assert "0/10  is empty, expected" in done.out
    done = landscape(
        "exercise", "check", "empty.py", "--out", "t.html", "--lang", "fr", cwd=tmp_path
    )
    assert done.status == 1 and "-  est vide" in done.out
    assert '<td class="points">-</td>' in (tmp_path / "t.html").read_text()

    before = sheet.read_bytes()
    for more, expected in (
        (["--out", "t.pdf"], "t.pdf: expected a folder, or a name ending in"),
        (["--worksheet", "t.csv"], "t.csv: expected a grading worksheet"),
        (["--points", "-1"], "expected a number above 0"),
        (["--due", "soon"], "expected a date such as"),
        (["--heat-map", "x.png"], "--heat-map"),
    ):
        refused(landscape("exercise", "check", "class.zip", *more, cwd=tmp_path), expected)
    assert sheet.read_bytes() == before
