"""The lessons: what each file says of itself, its picture, its keys, and its window."""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pictures
import pytest
from commands import TESTS, Shell, environment, landscape, refused
from folded import each
from PIL import Image
from starting import Starter
from test_window import screen, xdotool
from watching import Watcher

from framelens.program.program_events import presses
from landscape.course.ladder import (
    LADDER,
    LESSONS,
    NAMES,
    SECTIONS,
    TOPICS,
    Lesson,
    lesson,
    program_files,
    read,
)
from landscape.course.pages import page

__all__ = ["screen"]  # the fixture
HELPER = "text"  # the lesson that others may import
SMALL = 4  # pixels of a lesson's picture to one of its golden picture, each way
SYMBOLS = {
    **{"SPACE": "space", "ENTER": "Return", "TAB": "Tab", "MINUS": "minus", "EQUAL": "equal"},
    **{"PAGE_UP": "Prior", "PAGE_DOWN": "Next", "HOME": "Home", "END": "End"},
    **{name: name.capitalize() for name in ("LEFT", "RIGHT", "UP", "DOWN")},
}
PRESSED = [name for name in NAMES if lesson(name).pressed]  # keys, before the picture
each_lesson = pytest.mark.parametrize("name", NAMES)
all_lessons = each("name", NAMES)


@pytest.fixture(scope="module")
def watcher() -> Iterator[Watcher]:
    watcher = Watcher(LESSONS, prepared=True)
    yield watcher
    watcher.close()


def test_the_ladder_holds_every_file_and_each_topic_has_a_title() -> None:
    for folder in (LESSONS, LESSONS / "pages"):
        found = {path.stem for path in folder.iterdir() if path.suffix in (".py", ".md")}
        assert found - set(NAMES) == set(), f"{folder}: not in LADDER (landscape/course/ladder.py)"
        assert set(NAMES) - found == set(), f"in LADDER, but not a file of {folder}"
    assert list(LADDER) == list(TOPICS)


@all_lessons
def test_a_lesson_is_tagged_and_builds_on_those_before_it(name: str) -> None:
    found = lesson(name)
    source = found.file.read_text(encoding="utf-8")
    assert name in LADDER[found.topic]
    assert len(found.title) <= 70 and not found.title.endswith(".")
    assert found.about[-1].startswith("Keys: ") and len(found.about) >= 2
    earlier = NAMES[: NAMES.index(name)]
    assert set(found.needs) <= set(earlier), "it needs a lesson that comes later"
    imported = set(re.findall(r"^(?:import|from) (\w+)", source, re.MULTILINE))
    allowed = {
        "glfw",
        "OpenGL",
        "math",
        "pathlib",
        "random",
        "numpy",
        "PIL",
        "sys",
        "time",
        "ctypes",
    }
    assert imported <= allowed | {HELPER}, "it imports more than a student has"
    assert "from OpenGL.GL import *" in source
    assert not re.search("OpenGL.GLUT", source), "no lesson needs GLUT, or a screen"
    assert not re.search(r"glCreateShader|glUseProgram", source)


TAUGHT = {
    **{"glRectf": "animation", "glBegin": "triangle", "glOrtho": "viewport"},
    **{"glLineStipple": "lines", "glCullFace": "orientation", "GL_DEPTH_TEST": "z_buffer"},
    **{"glMatrixMode": "matrices", "glTranslatef": "matrices", "glRotatef": "matrices"},
    **{"glFrustum": "perspective", "glMultMatrixf": "look_at", "gluLookAt": "teapot"},
    **{"gluPerspective": "teapot", "glPushMatrix": "matrix_stack", "glLightfv": "light_model"},
    **{"glMaterialfv": "light_model", "GL_NORMALIZE": "scale", "glShadeModel": "gouraud"},
    **{"glVertexPointer": "vertex_arrays", "glNewList": "display_list"},
    **{"glTexImage2D": "generated_texture", "glGenTextures": "texture_objects"},
}
"""The first lesson that may use a call or a capability: what its page is about."""


@pytest.mark.seldom(3, first=2)
@all_lessons
def test_a_lesson_uses_nothing_that_a_later_one_teaches(name: str) -> None:
    if name == HELPER:
        return
    tree = ast.parse(lesson(name).file.read_text(encoding="utf-8"))
    used = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    place = NAMES.index(name)
    early = {call: TAUGHT[call] for call in used & TAUGHT.keys()}
    assert [call for call, where in early.items() if NAMES.index(where) > place] == []


@all_lessons
def test_a_lesson_names_only_keys_that_qwerty_and_azerty_have_in_one_place(name: str) -> None:
    used = set(re.findall(r"glfw\.KEY_(\w+)", lesson(name).file.read_text(encoding="utf-8")))
    assert not used & set("AQWZM")
    named = set(lesson(name).keys)
    # Digits may be counted: KEY_1 + number.
    assert named - used <= set("123456789") and used - named <= {"ESCAPE"}


@all_lessons
def test_every_text_that_a_lesson_writes_can_be_translated(name: str) -> None:
    tree = ast.parse(lesson(name).file.read_text(encoding="utf-8"))
    assigned = {ast.unparse(n.targets[0]) for n in ast.walk(tree) if isinstance(n, ast.Assign)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "write":
            (text,) = node.args[2:3]
            fixed = isinstance(text, ast.Constant | ast.IfExp | ast.Subscript)
            assert fixed or "LABELS" in assigned or name == HELPER, ast.unparse(node)
            assert not isinstance(text, ast.JoinedStr), ast.unparse(node)


@all_lessons
def test_a_page_has_its_four_sections_and_answers_its_questions(name: str) -> None:
    blocks = page(lesson(name))
    assert tuple(b.text for b in blocks if b.is_heading) == SECTIONS
    for one, two in zip(blocks, blocks[1:], strict=False):
        assert not (one.is_heading and two.is_heading), f"{one.text} is empty"
    asked = blocks[[b.text for b in blocks].index(SECTIONS[-1]) + 1 :]
    assert any(b.text.endswith("?") for b in asked)
    assert any(b.text.startswith("Answer:") for b in asked)
    words = sum(len(b.text.split()) for b in blocks)
    assert words >= 120, f"a page has at least 120 words, this one {words}"


def test_a_wrong_tag_is_found(tmp_path: Path) -> None:
    whole = lesson(HELPER).file.read_text(encoding="utf-8")
    for tag, said in (("# topic: ", "topic"), ("frame 0", "picture: frame N")):
        path = tmp_path / "lesson.py"
        path.write_text(whole.replace(tag, "# " if "#" in tag else "frames"))
        with pytest.raises(ValueError, match=said):
            read(path)


@pytest.mark.golden
@each_lesson
@pytest.mark.sweep(14)
def test_a_lesson_looks_as_it_did(
    name: str, watcher: Watcher, tmp_path: Path, pytestconfig: pytest.Config, stage: object
) -> None:
    picture, backend = picture_of(name, watcher, tmp_path)
    with Image.fromarray(picture) as image:
        small = np.asarray(image.reduce(SMALL))
    if name == "accumulation" and backend in ("egl", "glfw"):
        # No accumulation buffer: the mean is made by blending, of 8 bits, as the label says.
        label, golden = slice(110, 117), pictures.golden(f"lesson_{name}")
        off = pictures.difference(golden, small)
        assert off[label].max() > 50
        off[label] = 0
        assert off.max() <= 2
        return
    pictures.check(f"lesson_{name}", small, pytestconfig.getoption("--update-golden"))


def picture_of(name: str, watcher: Watcher, folder: Path) -> tuple[np.ndarray, str]:
    """Return the picture (480, 640, 3) of a lesson, of the frame that it names, and the backend."""
    found, file = lesson(name), folder / "picture.rgb"
    drawn = watcher(found.file, found.frame, events=presses(found.pressed), file=str(file))
    assert drawn.error == "", drawn.details
    assert (drawn.out, drawn.err, drawn.size) == ("", "", [640, 480])
    return np.fromfile(file, np.uint8).reshape(480, 640, 3), drawn.log[0][2]


@pytest.mark.seldom(13)
@pytest.mark.parametrize("name", ["text", "matrix_stack", PRESSED[0], PRESSED[-1]])
def test_the_picture_of_a_lesson_is_written_to_a_file(
    name: str, shell: Shell, watcher: Watcher, tmp_path: Path
) -> None:
    path = tmp_path / f"{name}.png"
    done = shell("lesson", name, "--out", path, "--lang", "en")
    assert (done.status, done.out, done.err) == (0, f"{path}\n", "")
    with Image.open(path) as image:
        assert image.mode == "RGB"
        assert (np.asarray(image) == picture_of(name, watcher, tmp_path)[0]).all()


@each_lesson
@pytest.mark.sweep(14, first=13)
def test_each_key_of_a_lesson_changes_its_picture(name: str, watcher: Watcher) -> None:
    found = lesson(name)

    def seen(frame: int, events: list[dict[str, object]]) -> list[str]:
        drawn = watcher(found.file, frame, events=events, each=True)
        assert drawn.error == "", drawn.details
        assert drawn.colours > 1 or name in LADDER["window"], "an empty picture"
        return drawn.pictures

    # One key after the other in one run, where nothing else changes the picture.
    in_turn = [event for at, key in enumerate(found.keys, 2) for event in presses((key,), at)]
    frames = seen(len(found.keys) + 1, in_turn)
    if frames[0] == frames[1]:
        pairs = zip(found.keys, frames[1:-1], frames[2:], strict=True)
        idle = [key for key, before, after in pairs if before == after]
    else:
        idle = list(found.keys)
    # The others each in a run of its own: of what moves, and of what another key has turned off.
    without = seen(1, [])[1] if idle else ""
    assert [key for key in idle if seen(1, presses((key,)))[1] == without] == []


SIZED = [
    name
    for name in NAMES
    if re.search(r"glPointSize|glLineWidth|/ 480", lesson(name).file.read_text(encoding="utf-8"))
]


@pytest.mark.parametrize("name", SIZED)
@pytest.mark.sweep(12, first=7)
def test_lines_points_and_what_is_measured_in_letters_grow_with_the_window(
    name: str, watcher: Watcher
) -> None:
    found = lesson(name)
    sizes = [{"frame": at, "resize": size} for at, size in ((2, [320, 240]), (3, [1280, 960]))]
    grids = watcher(found.file, 3, events=[*presses(found.pressed), *sizes], grids=True).grids
    as_made, small, large = (np.array(grids[at]) for at in (1, 2, 3))
    # In a small window no line is thinner than a pixel, so there is a little more of some.
    assert np.abs(small - as_made).max() < 24
    assert np.abs(large - as_made).max() < 12.5


def test_a_drag_of_the_mouse_changes_the_lesson_mouse(watcher: Watcher) -> None:
    drag = [
        {"frame": 1, "move": [320, 240]},
        {"frame": 1, "button": "left", "action": "press"},
        {"frame": 1, "move": [420, 140]},
    ]
    file = lesson("mouse").file
    assert watcher(file, 2, events=drag).picture != watcher(file, 2).picture
    assert watcher(file, 2, events=drag[::2]).picture == watcher(file, 2).picture, "no button"


@pytest.mark.seldom(3, first=2)
def test_the_right_button_opens_the_popup_menu_and_the_left_one_chooses(watcher: Watcher) -> None:
    file = lesson("popup_menu").file

    def seen(*events: dict[str, object]) -> str:
        drawn = watcher(file, 6, events=list(events))
        assert drawn.error == "", drawn.details
        return drawn.picture

    def at(frame: int, x: int, y: int) -> dict[str, object]:
        return {"frame": frame, "move": [x, y]}

    def click(frame: int, button: str) -> list[dict[str, object]]:
        return [{"frame": frame, "button": button, "action": a} for a in ("press", "release")]

    plain = seen()
    opened = (at(1, 100, 100), *click(2, "right"))
    # The first line, colour, and beside it the second line, amber.
    to_amber = (*opened, at(3, 120, 110), at(4, 280, 140))
    assert len({plain, seen(*opened), seen(*to_amber)}) == 3
    chosen = seen(*to_amber, *click(5, "left"))
    assert chosen != plain, "the square is amber"
    assert seen(*opened, at(3, 500, 400), *click(4, "left")) == plain, "a click beside closes it"
    assert seen(*click(1, "left")) == plain, "there is no menu"
    drag = (at(1, 400, 220), {"frame": 2, "button": "middle", "action": "press"}, at(3, 300, 300))
    up = {"frame": 4, "button": "middle", "action": "release"}
    assert seen(*drag, up) not in (plain, chosen)


@pytest.fixture
def starter(screen: dict[str, str], starters: list[Starter]) -> Starter:
    """A process to start lessons from; another one after a lesson that had to be ended."""
    if not starters or not starters[-1].alive:
        starters.append(Starter(screen))
    return starters[-1]


@pytest.fixture(scope="module")
def starters() -> Iterator[list[Starter]]:
    starters: list[Starter] = []
    yield starters
    for starter in starters:
        starter.close()


@pytest.mark.window
@each_lesson
@pytest.mark.sweep(14)
def test_a_lesson_runs_in_a_window_until_escape(
    name: str, screen: dict[str, str], starter: Starter, tmp_path: Path
) -> None:
    found, printed = lesson(name), tmp_path / "printed.txt"
    pid = starter.start(found.file, printed)
    keys = [SYMBOLS.get(key, key.lower()) for key in found.keys]
    window = xdotool(screen, "search", "--onlyvisible", "--pid", str(pid))
    pressed = ("key", "--delay", "40", *keys) if keys else ()
    # Held: a program that asks for the key's state would miss one that is down between two frames.
    xdotool(screen, "windowfocus", "--sync", window, *pressed, "keydown", "Escape")
    try:
        assert (starter.end(), printed.read_text()) == (0, "")
    finally:
        xdotool(screen, "keyup", "Escape")


@pytest.mark.seldom(3, first=1)
def test_the_list_names_every_lesson_in_both_languages(shell: Shell) -> None:
    names = [each["name"] for each in shell("lesson", "--json").json()]
    assert names == list(NAMES)
    english, french = (shell("lesson", "--lang", lang).out for lang in ("en", "fr"))
    assert "The matrix stack: a car" in english and "La pile de matrices" in french
    for name in names:
        assert f" {name} " in english and f" {name} " in french
    advice = "landscape strip matrix_stack.py --frame 45"
    assert english.endswith(f"{advice}\n") and french.endswith(f"{advice}\n")


def test_a_lesson_as_json_has_what_a_script_needs(shell: Shell) -> None:
    found = shell("lesson", "matrix_stack", "--json").json()
    assert found == lesson("matrix_stack").as_json()
    assert {"name", "title", "file", "topic", "needs", "lines"} < set(found)
    assert (found["frame"], found["pressed"]) == (45, [])
    assert Path(found["file"]).is_file()


def _copied(found: Lesson, folder: Path) -> list[Path]:
    return [folder / f"{found.name}.py", folder / "text.py", folder / "data" / "letters.png"]


def test_a_copy_in_french_is_french_wherever_it_runs(
    shell: Shell, watcher: Watcher, tmp_path: Path
) -> None:
    done = shell("lesson", "matrix_stack", "--copy", tmp_path, "--lang", "fr")
    assert done.status == 0, done.err
    french = (tmp_path / "matrix_stack.py").read_text(encoding="utf-8")
    assert french.startswith('"""La pile de matrices\u00a0: une voiture, ')
    assert '_("Pile de matrices")' in french and "# en degrés\n" in french
    copied, original = tmp_path / "matrix_stack.py", lesson("matrix_stack").file
    assert watcher(copied, 2).picture != watcher(original, 2).picture, "the texts are French"
    assert "Écrit un texte" in (tmp_path / "text.py").read_text(encoding="utf-8")
    done = shell("lesson", "mirror", "--copy", tmp_path, "--lang", "en")
    assert done.status == 0, "what a lesson imports may be there in French"
    assert "Écrit un texte" in (tmp_path / "text.py").read_text(encoding="utf-8")


def test_a_copy_runs_in_its_folder_and_is_never_overwritten(
    shell: Shell, watcher: Watcher, tmp_path: Path
) -> None:
    found = lesson("matrix_stack")
    folder = tmp_path / "tp"
    copies = _copied(found, folder)
    done = shell("lesson", found.name, "--copy", folder)
    assert (done.status, done.out.split()) == (0, [str(path) for path in copies])
    assert watcher(copies[0], 2).picture == watcher(found.file, 2).picture
    assert shell("lesson", found.name, "--copy", folder).status == 0, "unchanged, it may stay"
    copies[0].write_text("changed")
    refused(shell("lesson", found.name, "--copy", folder), str(copies[0]), "changed")
    assert copies[0].read_text() == "changed"


@pytest.mark.seldom(3, first=2)
@pytest.mark.parametrize(
    "words, said",
    [
        (("no_such",), "expected a lesson"),
        (("text", "--out", f"{__file__}/x.png"), "test_lessons.py/x.png"),
        (("text", "--out", "picture.jpg"), "picture.jpg: expected a name ending in .png"),
        (("text", "--copy", f"{__file__}/x"), "--copy "),
        (("text", "--copy", __file__), f"--copy {__file__}: expected a folder"),
        (("text", "--out", "a.png", "--copy"), "not allowed with"),
    ],
)
def test_what_cannot_be_done_is_told_in_one_line(
    shell: Shell, words: tuple[str, ...], said: str
) -> None:
    refused(shell("lesson", *words), said)


@pytest.mark.seldom(7, first=5)
@pytest.mark.posix_only("there is always a screen")
def test_without_a_screen_a_lesson_says_how_to_see_it() -> None:
    done = landscape("lesson", "text")
    assert done.status == 3 and "--out FILE.png" in done.err and done.err.count("\n") == 1


@pytest.mark.seldom(10, first=1)
@pytest.mark.posix_only("there is always a screen")
def test_a_copied_lesson_without_a_screen_ends_with_one_line_and_does_not_abort() -> None:
    files = [lesson(name).file for name in NAMES]
    files += [program_files(program)[0] for name in NAMES for program in lesson(name).programs]
    done = subprocess.run(
        [sys.executable, TESTS / "without_screen.py", *files],
        capture_output=True,
        text=True,
        env=environment(LANG="C", LANGUAGE="en"),
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, ""), done.stdout.splitlines()[-1:]
    said = [line.split("\t") for line in done.stdout.splitlines()]
    assert [name for name, _start, _window in said] == [file.stem for file in files]
    start = "GLFW cannot start: is there a screen?"
    window = "GLFW cannot open a window with OpenGL."
    assert [line for line in said if line[1:] != [start, window]] == []
