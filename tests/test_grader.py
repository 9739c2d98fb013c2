"""The grader: programs that cannot be graded, limits, commands and bad input."""

import json
import os
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from commands import environment, landscape, refused
from PIL import Image
from solved import solved

from framelens.base.errors import InputError
from framelens.system import limits, quoted
from landscape.course.exercise import Grader, Report
from landscape.course.grader.troubles import sentence
from landscape.course.shelf import NAMES, exercise

PATIENCE = 100.0  # seconds a program may take here: the machine may be busy with other tests


@pytest.fixture(scope="module")
def grader() -> Iterator[Grader]:
    with Grader(PATIENCE) as found:
        yield found


def checked(grader: Grader, folder: Path, code: str) -> Report:
    path = folder / "mine.py"
    path.write_text(code, encoding="utf-8")
    return grader.check(path)


def failures(report: Report) -> list[str]:
    return [result.test.key for result in report.results if result.passed is False]


HEAD = "# exercise: winding\nimport os, sys, time\nimport glfw\nfrom OpenGL.GL import *\n"
OPEN = """
glfw.init()
window = glfw.create_window(640, 480, "", None, None)
glfw.make_context_current(window)
"""
LOOP = "while not glfw.window_should_close(window):\n    glClear(GL_COLOR_BUFFER_BIT)\n"
SHOW = "    glfw.swap_buffers(window)\n    glfw.poll_events()\n"
# Writes JSON, with no blobs beside it, into whatever leads to the grader.
FORGE = """
import ctypes, stat, struct
text = {!r}.encode()
text = text[:-1] + b', "blobs": []}}' if text.endswith(b"}}") else text
for file in range(3, 64):
    try:
        if stat.S_ISFIFO(os.fstat(file).st_mode):
            os.write(file, struct.pack(">Q", len(text)) + text)
    except OSError:
        pass
ctypes.CDLL("msvcrt" if os.name == "nt" else None)._exit(0)
"""
WORDS = {
    "aborts": (OPEN + "os.abort()", "crashed_at"),
    "reads address 0": (OPEN + "import ctypes\nctypes.string_at(0)", "crashed_at"),
    "kills itself": ("os.kill(os.getpid(), 9)", "died" if os.name == "nt" else "crashed"),
    "no window": ("print(1)", "no_window"),
    "no OpenGL": ("sys.exit()", "no_window"),
    "no context": (
        OPEN.replace("glfw.make", "# glfw.make") + "glfw.swap_buffers(window)",
        "no_context",
    ),
    "a wrong name": (OPEN + "glEnable(GL_DEPTH_BUFFER_BIT)", "invalid_enumerant"),
    "a pop too many": (OPEN + "glPopMatrix()", "stack_underflow"),
    "raises": (OPEN + "1 / 0", "raised"),
    "error of OpenGL": (OPEN + LOOP + "    glEnable(GL_MODELVIEW)\n" + SHOW, "invalid_enumerant"),
    "no glEnd": (
        OPEN + LOOP + "    glBegin(GL_TRIANGLES)\n    glVertex2f(0, 0)\n" + SHOW,
        "unclosed",
    ),
    "not Python": ("if", "syntax"),
    "takes all memory": (OPEN + "data = [bytearray(1 << 28) for _ in range(40)]", "memory"),
    "calls too often": (
        OPEN + LOOP + "    for _ in range(10**6): glLoadIdentity()\n" + SHOW,
        "calls",
    ),
    "ends early": (OPEN + LOOP + SHOW + "    break\n", "ended"),
    "two windows": (OPEN + OPEN, "two_windows"),
    "writes": (f"open({str(Path.home() / 'x')!r}, 'w')", "write"),
    "removes": ("os.remove(__file__)", "write"),
    "connects": ("import socket\nsocket.socket()", "network"),
    "starts a program": ("os.system('true')", "start"),
    "imports the grader": ("import landscape.course.exercise", "grader"),
    "forges its evidence": (FORGE.format('{"states": [], "frames": 3}'), "died"),
    "forges another error": (FORGE.format('{"error": {"word": "tired"}}'), "died"),
    "forges an error without values": (
        FORGE.format('{"error": {"word": "raised"}, "blobs": []}'),
        "died",
    ),
    "forges an error that is a text": (FORGE.format('{"error": "late"}'), "died"),
    "forges evidence without frames": (
        FORGE.format('{"states": [], "frames": {}, "blobs": []}'),
        "died",
    ),
    "forges blobs": (FORGE.format('{"states": [], "frames": {}, "blobs": [9]}]'), "died"),
    "forges evidence that nests deeply": (FORGE.format("[" * 100_000), "died"),
    "another package": ("import no_such_package", "package"),
}


@pytest.mark.seldom(14, first=7)
@pytest.mark.parametrize("what", WORDS)
def test_a_program_that_cannot_be_graded_says_why(
    what: str, grader: Grader, tmp_path: Path
) -> None:
    code, word = WORDS[what]
    report = checked(grader, tmp_path, HEAD + code + "\n")
    assert report.error is not None and report.error["word"] == word, report.error
    assert report.error.get("line", 5) >= 5 and not report.results and not report.passed


@pytest.mark.seldom(3, first=2)
def test_a_program_without_a_toolkit_is_told_so(grader: Grader, tmp_path: Path) -> None:
    path = tmp_path / "mine.py"
    path.write_text("# exercise: winding\nwhile True:\n    pass\n")
    error = grader.check(path).error
    assert error is not None and error["word"] == "no_toolkit"


def test_a_forged_error_is_still_one_line(grader: Grader, tmp_path: Path) -> None:
    error = {"word": "raised", "line": 5, "error": "x\n" * 9999}
    report = checked(grader, tmp_path, HEAD + FORGE.format(json.dumps({"error": error})))
    assert report.error is not None and report.error["word"] == "raised"
    told = sentence(report.error, lambda text, context="": text)
    assert "\n" not in told and len(told) <= 400


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("while True:\n    pass", {"late_window"}),
        (OPEN + "while True:\n    pass", {"no_frame"}),
        (
            "while True:\n    try:\n        time.sleep(9)\n    except BaseException:\n        pass",
            {"late", "late_window"},
        ),
        pytest.param(
            "import signal\nsignal.signal(signal.SIGALRM, signal.SIG_IGN)\nwhile True:\n    pass",
            {"late"},
            marks=pytest.mark.skipif(os.name == "nt", reason="there is no such signal"),
        ),
    ],
)
@pytest.mark.sweep(12)
def test_a_program_that_never_ends_is_ended(code: str, words: set[str], tmp_path: Path) -> None:
    path = tmp_path / "mine.py"
    path.write_text(HEAD + code + "\n")
    for seconds in (0.4, 2.0, 10.0, 50.0):  # more, where the machine is too busy to come so far
        with Grader(seconds) as hasty:
            hasty._solutions["winding"] = None  # type: ignore[assignment]
            error = hasty.check(path).error
        if error is not None and error["word"] in words:
            return
    raise AssertionError(error)


@pytest.mark.seldom(10, first=2)
def test_a_program_may_print_as_much_as_it_likes(grader: Grader, tmp_path: Path) -> None:
    flood = "print('x' * (100 << 20))\nos.write(1, b'y' * (1 << 20))\n"
    code = solved("missing_enable").replace("import glfw\n", f"import glfw\nimport os\n{flood}", 1)
    assert checked(grader, tmp_path, code).passed


def test_a_call_without_a_context_does_not_count(grader: Grader, tmp_path: Path) -> None:
    on, current = "    glEnable(GL_DEPTH_TEST)\n", "    glfw.make_context_current(window)\n"
    code = solved("missing_enable").replace(on, "").replace(current, on + current)
    report = checked(grader, tmp_path, code)
    line = code.splitlines().index(on.rstrip()) + 1
    if os.name == "nt":  # where it raises
        assert report.error is not None
        assert (report.error["word"], report.error["line"]) == ("early", line)
        return
    (hint,) = [result.hint for result in report.results if result.hint is not None]
    start = f"Line {line} calls glEnable before glfw.make_context_current."
    assert hint.written(str).startswith(start)


def test_the_line_of_an_exception_is_the_last_of_the_program(
    grader: Grader, tmp_path: Path
) -> None:
    code = solved("transform_order").replace("glRotatef(year, 0, 1, 0)", "glRotatef(year)")
    error = checked(grader, tmp_path, code).error
    assert error is not None
    assert error["line"] == code.splitlines().index("    glRotatef(year)") + 1


@pytest.mark.seldom(13, first=5)
def test_what_a_program_wrote_is_gone_and_nothing_runs_on(tmp_path: Path) -> None:
    with Grader(PATIENCE) as short:
        short.check(exercise("winding").folder / "solution.py")
        sandbox = short._sandbox
        assert sandbox._place is not None
        server, folder = sandbox._server, sandbox._place.folder
        assert folder.is_dir() and (server is not None) == limits.FORKS
        assert [each.name for each in folder.iterdir()] == ["lock"], "gone once it has run"
    assert not folder.exists() and (server is None or server._process.poll() is not None)


@pytest.mark.seldom(14, first=6)
def test_the_commands_list_start_and_check(tmp_path: Path) -> None:
    listed = landscape("exercise", "list", "--json", "--lang", "en").json()
    assert [each["name"] for each in listed] == list(NAMES)
    assert all(each["title"] and each["task"] and each["lessons"] for each in listed)
    assert "\n" + " " * 21 + "Lessons to read first: orientation.\n" in (
        landscape("exercise", "list", "--lang", "en").out
    )

    place = {"cwd": tmp_path}
    begun = landscape("exercise", "start", "winding", "--lang", "en", **place)
    mine = tmp_path / "winding.py"
    assert begun.status == 0 and begun.out.splitlines()[0] == "winding.py" and mine.is_file()
    mine.write_text(mine.read_text() + "# mine\n")
    refused(landscape("exercise", "start", "winding", **place), "winding.py", "already")
    assert mine.read_text().endswith("# mine\n")

    words = ("exercise", "check", mine, "--seconds", PATIENCE, "--lang", "en")
    done = landscape(*map(str, words), "--heat-map", str(tmp_path / "map.png"))
    assert done.status == 1 and done.err == ""
    assert re.search(r"^failed +Every triangle is counter-clockwise from outside$", done.out, re.M)
    assert re.search(r"^not checked  The picture is right$", done.out, re.M)
    assert done.out.splitlines()[-1].startswith(str(tmp_path / "map.png"))

    heat = np.asarray(Image.open(tmp_path / "map.png"))
    assert heat.shape == (480, 3 * 640 + 16, 3)
    hot = heat[:, 648:1288].max(axis=2) > 150
    assert 0.02 < hot.mean() < 0.3
    assert "Lessons to read first: orientation.\n" in mine.read_text()
    done = landscape(*map(str, words))
    command = f"exercise check {quoted(str(mine))} --heat-map difference.png"
    assert done.out.splitlines()[-1].endswith(command)

    mine.write_text(HEAD + "1 / 0\n")
    done = landscape(*map(str, words), "--json")
    assert done.status == 2 and "winding.py: line 5" in done.err and done.err.count("\n") == 1
    shown = json.loads(done.out)
    assert shown["passed"] is False and {test["passed"] for test in shown["tests"]} == {None}
    assert "ZeroDivisionError" in shown["error"] and shown["picture_difference"] is None


@pytest.mark.seldom(14, first=12)
def test_a_picture_of_one_colour_gets_its_first_cause(tmp_path: Path) -> None:
    place = {"env": environment(), "cwd": tmp_path}
    landscape("exercise", "start", "fog", "--lang", "en", **place)
    mine = tmp_path / "fog.py"
    source = re.sub(r"glViewport\(.*\)", "glViewport(0, 0, 0, 0)", mine.read_text())
    mine.write_text(source)
    line = source[: source.index("glViewport")].count("\n") + 1
    words = ("exercise", "check", str(mine), "--seconds", str(PATIENCE), "--lang", "en")
    done = landscape(*words)
    told = " ".join(done.out.split())
    assert f"The picture is all of one colour: line {line}. The viewport is 0, 0, 0, 0" in told
    cause = json.loads(landscape(*words, "--json").out)["cause"]
    assert cause["cause"] == "viewport" and cause["source"] == f"fog.py:{line}"


@pytest.mark.seldom(10, first=2)
def test_what_is_refused_is_told_in_french_as_well(tmp_path: Path) -> None:
    french = {**environment(), "LANGUAGE": "fr"}
    (tmp_path / "winding.py").write_text("# mine\n")
    refused_in = {
        ("exercise", "start", "winding"): "winding.py: existe déjà ; donnez avec --out le nom",
        ("exercise", "start", "juggling"): "'juggling': n'est pas un exercice ; il y a missing_en",
        ("exercise", "check", "absent.py"): "absent.py: ne peut pas être lu (il n'existe pas)",
        ("exercise", "check", "winding.py"): "winding.py: il y manque une ligne telle que `# exer",
        ("lesson", "juggling"): "'juggling': n'est pas une leçon ; `landscape lesson`",
    }
    for words, told in refused_in.items():
        done = landscape(*words, env=french, cwd=tmp_path)
        french_marks = str.maketrans({"\u00a0": " ", "\u2019": "'"})
        assert done.err.translate(french_marks).startswith(f"landscape: {told}"), done.err


@pytest.mark.seldom(14, first=11)
def test_a_report_fits_the_terminal_and_paths_with_spaces(tmp_path: Path) -> None:
    folder = tmp_path / "my work"
    folder.mkdir()
    begun = landscape("exercise", "start", "winding", "--out", str(folder), "--lang", "en")
    mine = folder / "winding.py"
    assert mine.is_file() and f"python {quoted(str(mine))}" in begun.out
    words = ("exercise", "check", str(mine), "--seconds", str(PATIENCE))
    for language in ("en", "fr"):
        done = landscape(*words, "--lang", language, env=environment(COLUMNS="72"))
        *lines, command = done.out.splitlines()
        assert done.status == 1 and 60 < max(map(len, lines)) <= 72
        assert f"landscape exercise check {quoted(str(mine))} --heat-map" in command
    done = landscape(*words, "-q")
    assert (done.status, done.out, done.err) == (1, "", "")


@pytest.mark.seldom(3, first=1)
def test_bad_input_is_refused_in_one_line(tmp_path: Path) -> None:
    lines = {
        "none.py": (b"import glfw\n", "# exercise: "),
        "two.py": (b"# exercise: winding\n# exercise: normals\n", "two exercises"),
        "other.py": (b"# exercise: juggling\n", "juggling"),
        "binary.py": (bytes(range(256)), "not text"),
    }
    for name, (data, words) in lines.items():
        path = tmp_path / name
        path.write_bytes(data)
        with pytest.raises(InputError, match=re.escape(words)), Grader() as grader:
            grader.check(path)

    with pytest.raises(InputError, match="folder"), Grader() as grader:
        grader.check(tmp_path)
    with pytest.raises(InputError, match="cannot be read"), Grader() as grader:
        grader.check(tmp_path / "absent.py")
    refused(landscape("exercise", "start", "juggling"), "juggling", "winding")
    out = tmp_path / "none.py" / "mine.py"
    refused(landscape("exercise", "start", "winding", "--out", out), "mine.py")
    refused(landscape("exercise", "check", "x.py", "--heat-map", "map.jpg"), ".png")
    refused(landscape("exercise", "check", "x.py", "--seconds", "0"), "--seconds")
    assert os.listdir(tmp_path) == sorted(os.listdir(tmp_path), key=os.listdir(tmp_path).index)
