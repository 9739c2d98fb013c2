"""Lectures: their files, what they say of their steps, and how a window is divided."""

import re
from pathlib import Path

import numpy as np
import pytest
from commands import Shell, landscape, need_library, python, refused

from framelens.base.texts import translator
from landscape.course.ladder import NAMES, lesson, lessons
from landscape.course.lecture import texts
from landscape.course.lecture.image import caption_image, code_image, steps_image
from landscape.course.lecture.layout import BANDS, arranged, layout
from landscape.course.lecture.list import StepList
from landscape.course.lecture.plan import COURSE, Step, course, new_lines, read
from landscape.island.fixes import FIXES
from landscape.studio.lessons.fresnel import fresnel, picture, schlick
from landscape.studio.lessons.lesson_data import png

DOCS = Path(__file__).resolve().parents[1] / "docs" / "lecture.md"

# Points to the middle of the area with the mouse of 2006, which looks to where it points: north and
# level. Then opens the inspector, and asks whether its foot names the lecture's key.
MOUSE = """
import functools, sys
from pathlib import Path
from framelens.gl.contexts.glfw import GLFWContext
GLFWContext.__init__ = functools.partialmethod(GLFWContext.__init__, backend="headless")
from landscape.course.lecture.plan import read
from landscape.course.lecture.stage import Stage
from landscape.course.lecture.view import LectureWalk, planned
from framelens.inspector.inspector_page import foot
stage = Stage(read(Path(sys.argv[1])), 0, (400, 250), 1)
stage.begin(0)
with LectureWalk(stage, planned("fig5a", stage.pixels(), "en")) as walk:
    walk.button(stage.glfw.MOUSE_BUTTON_LEFT, stage.glfw.PRESS, 0)
    walk.listen()
    across, down = stage.area()
    stage.glfw.set_cursor_pos(stage.window, across / 2, 250 - down / 2)
    walk.advance(walk.listen())
    print(walk.walker.yaw, walk.walker.pitch)
    walk.inspect()
    print("F12" in foot(walk.inspection.model, "en", walk.inspection.letters)[-1])
"""


def _written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "mine.txt"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_lecture_in_the_documentation_is_read_as_it_says(tmp_path: Path) -> None:
    found = re.search(r"```text\n(title: .*?)```", DOCS.read_text(encoding="utf-8"), re.DOTALL)
    assert found
    (tmp_path / "fresnel.png").touch()
    lecture = read(_written(tmp_path, found[1]))
    assert lecture.title == "Mirrors in OpenGL 1.x"
    live = [step.name for step in lecture.steps if step.kind not in ("picture", "slide")]
    assert live == ["scale", "matrix_stack", "fig6a", "R16"]
    assert [step.kind for step in lecture.steps[3:5]] == ["picture", "slide"]
    stack = lecture.steps[1]
    source = lesson("matrix_stack").file.read_text(encoding="utf-8").splitlines()
    assert stack.code is not None
    marked = [source[number - 1].strip() for number in sorted(stack.code)]
    assert marked[0].startswith("def draw_part(") and "glPopMatrix()" in marked
    assert "draw_car(-90 * glfw.get_time())" in marked and stack.code >= {104, 105, 106, 107}
    assert stack.keys == ("SPACE",) and len(stack.notes) == 2
    assert texts.title(lecture.steps[2]) == "The island, twice"


def test_an_indented_line_continues_a_line_and_a_byte_order_mark_is_no_text(tmp_path: Path) -> None:
    text = "\ufeffscale\nOne line,\n  and the rest.\nAnd more.\nNOTE: first\n    half\n"
    (step,) = read(_written(tmp_path, text)).steps
    assert step.caption == "One line, and the rest. And more."
    assert step.notes == ["first half"]


@pytest.mark.parametrize(
    "text, said",
    [
        ("mirorr\n", ", line 1: 'mirorr': expected a lesson, a view, a fix, the path"),
        ("\n\nscale\nnota: x\n", ", line 4: 'nota': expected one of title, code, note, keys"),
        ("scale\nnote:\n", ", line 2: note: expected something after the colon"),
        ("scale\ncode: 90-400\n", ", line 2: code: 90-400: expected lines from 1 to "),
        ("scale\ncode: 9-3\n", ", line 2: code: 9-3: expected lines from 1 to "),
        ("scale\ncode: glFoo\n", ", line 2: code: 'glFoo': is not in scale.py"),
        ('scale\ncode: ""\n', ", line 2: code: "),
        ("fig6a\ncode: glFogf\n", ", line 2: code: expected it at a lesson or program; 'fig6a'"),
        ("slide\nkeys: SPACE\n", ", line 2: keys: expected it at a lesson or program; 'slide'"),
        ("scale\nframe: -1\n", ", line 2: frame: '-1': expected a whole number from 0"),
        ("none.png\n", ", line 1: 'none.png': there is no such file"),
        ("scale\nkeys: SPACE SPACEBAR\n", ", line 2: keys: 'SPACEBAR': expected names such as"),
        ("none.py\n", ", line 1: 'none.py': there is no such file"),
        ("title: Nothing\n", ": has no steps"),
        ("scale\n\x00", ": is not text in UTF-8"),
    ],
)
def test_what_is_wrong_with_a_lecture_is_said_in_one_line(
    shell: Shell, tmp_path: Path, text: str, said: str
) -> None:
    path = _written(tmp_path, text)
    refused(shell("lecture", path, "--list"), f"{path}{said}")


def test_other_bad_input_is_said_in_one_line(shell: Shell, tmp_path: Path) -> None:
    refused(shell("lecture", tmp_path / "no.txt"), "no.txt", "cannot be read")
    (tmp_path / "latin.txt").write_bytes("scale\nÉchelle".encode("latin-1"))
    refused(shell("lecture", tmp_path / "latin.txt"), "latin.txt", "is not text in UTF-8")
    refused(shell("lecture", "--from", "nowhere"), "--from 'nowhere'", "expected the name")
    refused(shell("lecture", "--from", "0"), "--from '0'", "from 1 to")


def test_without_a_screen_a_lecture_says_what_to_do() -> None:
    done = landscape("lecture")
    assert done.status == 3 and "use --list" in done.err and done.err.count("\n") == 1


def test_the_course_has_every_lesson_in_order_and_a_view_after_each_of_the_landscape() -> None:
    steps = course().steps
    there = [each.name for each in lessons()]
    shown = [step.name for step in steps if step.kind == "lesson"]
    file = "landscape/course/lectures/course.txt"
    assert set(there) - set(shown) == set(), f"add these lessons to {file}"
    assert shown == there, f"{file}: not the order of the ladder"
    for one, two in zip(steps, steps[1:], strict=False):
        if one.kind == "lesson" and lesson(one.name).topic == "landscape":
            assert two.kind == "view", one.name
    # What follows the last lesson of a topic: a view, where the topic has a scene.
    pairs = zip(steps, [*steps[1:], None], strict=True)
    after = {lesson(one.name).topic: two for one, two in pairs if one.kind == "lesson"}
    for topic in ("landscape", "effects", "voxels"):
        assert after[topic] and after[topic].kind == "view", topic


def test_the_list_begins_where_the_lecture_would(shell: Shell) -> None:
    whole = shell("lecture", "--list").out.splitlines()
    assert shell("lecture", "--list", "--from", "3").out.splitlines() == whole[2:]
    refused(shell("lecture", "--list", "--from", "nosuch"), "--from 'nosuch'")
    refused(shell("lecture", "--list", "--screen", "9"), "--screen: not with --list")


def test_the_course_is_whole_in_french(shell: Shell) -> None:
    english, french = (shell("lecture", "--list", "--lang", lang) for lang in ("en", "fr"))
    pairs = list(zip(english.out.splitlines(), french.out.splitlines(), strict=True))
    assert len(pairs) == len(course().steps)
    assert [en for en, fr in pairs if en == fr] == []


def test_the_speaker_reads_notes_keys_and_the_next_title(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LANGUAGE", "fr")
    lecture = read(_written(tmp_path, "scale\nnote: One.\nnote: Two.\nkeys: SPACE\n\nfig6a\n"))
    said = texts.for_speaker(lecture, 0)
    assert said.startswith("[1/2] ") and "(scale)" in said
    assert "    One.\n    Two.\n" in said
    assert "Touches" in said and "Touches déjà pressées\u00a0: SPACE" in said
    assert f"Ensuite\u00a0: {texts.title(lecture.steps[1])}" in said
    assert "dernière étape" in texts.for_speaker(lecture, 1)


def test_the_words_of_a_user_are_not_translated_even_if_a_shipped_lecture_has_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LANGUAGE", "fr")
    shipped = COURSE.parent / "reflections.txt"
    text = shipped.read_text(encoding="utf-8").replace(
        "fresnel.png", f"{COURSE.parent}/fresnel.png"
    )
    for lecture, same in ((read(shipped), False), (read(_written(tmp_path, text)), True)):
        step = lecture.steps[0]
        words = texts.heading(lecture), texts.title(step), texts.paragraphs(step), texts.notes(step)
        assert (words == (lecture.title, step.title, step.text, step.notes)) == same


@pytest.mark.seldom(7, first=3)
def test_a_copied_lecture_says_in_its_file_what_the_shipped_one_says_in_the_users_language(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LANGUAGE", "fr")
    for name in ("reflections", "first_course", "course"):
        folder = tmp_path / name
        done = shell("lecture", name, "--copy", str(folder), "--lang", "fr")
        assert done.out.splitlines()[0] == str(folder / f"{name}.txt"), done.err
        shipped, mine = read(COURSE.parent / f"{name}.txt"), read(folder / f"{name}.txt")
        assert texts.heading(shipped) == mine.title
        for one, two in zip(shipped.steps, mine.steps, strict=True):
            said = texts.title, texts.caption, texts.paragraphs, texts.notes, texts.marked
            assert [say(one) for say in said] == [say(two) for say in said], one.name
            assert (one.keys, one.frame) == (two.keys, two.frame)
            assert two.title in ("", texts.title(one)) and (not one.title) == (not two.title)
    assert (tmp_path / "reflections" / "fresnel.png").is_file()

    shell("lecture", "reflections", "--copy", str(tmp_path / "en"), "--lang", "en")
    file = tmp_path / "en" / "reflections.txt"
    assert file.read_bytes() == (COURSE.parent / "reflections.txt").read_bytes()
    refused(
        shell("lecture", "reflections", "--copy", str(file.parent), "--lang", "fr"),
        f"{file}: existe déjà, modifié",
    )
    refused(
        shell("lecture", str(file), "--copy", str(tmp_path)),
        "--copy: expected one of course, first_course, reflections, not",
    )


def test_a_lesson_without_notes_asks_what_its_page_asks(tmp_path: Path) -> None:
    (step,) = read(_written(tmp_path, "matrix_stack\n")).steps
    notes = texts.notes(step)
    assert notes[0].startswith("How many matrices") and notes[1].startswith("Answer: three.")


def test_a_view_takes_its_title_and_caption_from_the_gallery(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LANGUAGE", "fr")
    view, fix = read(_written(tmp_path, "fig6a\n\nR12\n")).steps
    assert texts.title(view) not in ("", view.name) and "mirror" not in texts.title(view)
    assert texts.caption(view).startswith("Il n’y a pas encore d’eau")
    (shown,) = (each for each in FIXES if each.name == fix.name)
    assert texts.caption(fix) == translator("fr", "gallery")(shown.how)  # no picture before it


def test_of_a_lesson_s_own_caption_the_last_sentences_may_be_left_out(tmp_path: Path) -> None:
    text = "matrix_stack\n\nscale\nOne. Two.\n"
    lesson_step, own = read(_written(tmp_path, text)).steps
    captions = texts.captions(lesson_step)
    assert captions[0] == lesson("matrix_stack").about[0] and len(captions) > 2
    assert all(
        long.startswith(f"{short} ") for long, short in zip(captions, captions[1:], strict=False)
    )
    assert texts.captions(own) == ["One. Two."]


def test_the_lines_that_matter_are_those_with_names_no_lesson_had_before() -> None:
    source = lesson("matrix_stack").file.read_text(encoding="utf-8").splitlines()
    lines = {source[number - 1].strip() for number in new_lines("matrix_stack")}
    assert lines == {"glPushMatrix()", "glPopMatrix()"}
    assert any(new_lines(name) for name in NAMES[:5])


def test_the_lecture_on_reflections_is_whole_in_french(shell: Shell) -> None:
    english, french = (
        shell("lecture", "reflections", "--list", "--lang", lang).out.splitlines()
        for lang in ("en", "fr")
    )
    assert len(english) == len(french) == 17
    assert [one for one, two in zip(english, french, strict=True) if one == two] == []


def test_the_curve_of_the_lecture_on_reflections_is_what_the_studio_draws() -> None:
    lecture = read(COURSE.parent / "reflections.txt")
    (step,) = [step for step in lecture.steps if step.kind == "picture"]
    assert step.file is not None and step.file.read_bytes() == png(picture())
    angles = np.radians(np.linspace(0, 90, 91))
    difference = np.abs(fresnel(angles) - schlick(angles))
    assert difference.max() < 0.06 and fresnel(angles)[-1] == pytest.approx(1)
    assert schlick(np.arccos(0.5)) == pytest.approx(0.05, abs=0.002)


@pytest.mark.parametrize("size", [(1920, 1080), (1280, 720), (1024, 768)])
@pytest.mark.parametrize("language", ["en", "fr"])
@pytest.mark.sweep(14, first=9)
def test_the_captions_of_the_course_fit_into_a_band_of_one_height(
    monkeypatch: pytest.MonkeyPatch, language: str, size: tuple[int, int]
) -> None:
    monkeypatch.setenv("LANGUAGE", language)
    for step in course().steps:
        for code in (False, True) if step.file else (False,):
            title, captions = texts.title(step), texts.captions(step)
            assert arranged(size, code, 1.0, title, captions)[0] == layout(size, code), step.name


@pytest.mark.parametrize("size", [(1920, 1080), (1024, 768), (2560, 1600), (320, 240)])
def test_nothing_covers_the_area_and_all_of_the_window_is_used(size: tuple[int, int]) -> None:
    for code in (False, True):
        for bands in BANDS:
            found = layout(size, code, bands=bands)
            across = found.area[0] + (found.code[0] if found.code else 0)
            assert across == size[0]
            assert found.area[1] + found.caption[1] == size[1]
            assert found.caption[0] == found.area[0]
    wide = layout((1920, 1080), False)
    assert wide.area == (1920, 960), "twice 480: the lessons' letters are twice as large there"
    assert layout((1921, 1081), True, 2.0).area[0] % 2 == 0, "whole coordinates of a fine display"


@pytest.mark.seldom(3)
def test_a_long_caption_is_cut_and_a_short_one_is_larger() -> None:
    box = (1920, 120)
    short, long = (
        caption_image(box, 1080, "1/2", "Title", "The plane keeps the land. " * count)
        for count in (2, 60)
    )
    assert short.shape == long.shape == (120, 1920, 4)
    bright = [(image[:, 600:1700, :3].min(axis=2) > 200).any(axis=1) for image in (short, long)]
    edges = [np.flatnonzero(np.diff(rows.astype(int))) for rows in bright]
    assert edges[0][1] - edges[0][0] > edges[1][1] - edges[1][0], "letters of the first line"
    assert not bright[1][[0, -1]].any(), "no line is cut in its height"


def test_a_title_without_a_caption_has_the_whole_width() -> None:
    image = caption_image((1280, 80), 720, "1/2", "What scales about what?", "")
    rows = (image[:-4, :1100, :3].min(axis=2) > 100).any(axis=1)
    assert np.count_nonzero(np.diff(rows.astype(int))) == 2, "one line"


def test_a_caption_keeps_the_band_low_where_its_title_is_long() -> None:
    title = "Listes d’affichage : une fleur compilée une fois, dessinée des centaines de fois"
    size = (1024, 768)
    found, caption = arranged(size, False, 1.0, title, ["Two words."])
    assert found == layout(size, False) and caption == "Two words."
    image = caption_image(found.caption, size[1], "1/2", title, caption)
    words = (image[:-4, :900, :3].min(axis=2) > 100).any(axis=1)
    assert words.any() and not words[[0, -1]].any(), "no line is cut in its height"
    higher, _ = arranged(size, False, 1.0, title, ["A long sentence of the user. " * 14])
    assert higher.area[1] < found.area[1], "what the user wrote is shown"


@pytest.mark.seldom(10, first=1)
def test_a_walk_in_a_lecture_has_its_mouse_in_its_area_and_names_the_lecture_s_key(
    tmp_path: Path,
) -> None:
    need_library("OSMesa")
    done = python(MOUSE, str(_written(tmp_path, "fig5a\n")))
    assert (done.err, done.out) == ("", "0.0 0.0\nTrue\n")


def test_the_code_shows_all_lines_that_matter_even_if_they_are_far_apart() -> None:
    source = [f"line({number})" for number in range(1, 301)]
    marked = {3, 150, 290}
    image = code_image((600, 400), "program.py", source, marked)
    folded = (image[:, 300:590, :3] == (58, 52, 32)).all(axis=(1, 2))
    assert np.count_nonzero(np.diff(folded.astype(int)) == 1) == len(marked)
    scrolled = code_image((600, 400), "program.py", source, marked, first=200)
    assert not (scrolled[:, 300:590, :3] == (58, 52, 32)).all(axis=(1, 2)).any()


def test_code_without_lines_that_matter_begins_with_its_first_function() -> None:
    source = [*["import glfw"] * 40, *["def draw():"] * 100]
    plain = code_image((600, 400), "program.py", source, ())
    assert np.array_equal(plain, code_image((600, 400), "program.py", source, (), first=41))
    assert not np.array_equal(plain, code_image((600, 400), "program.py", source, (), first=1))


def test_the_list_has_a_box_for_each_step_and_pages_where_there_are_too_many() -> None:
    steps = [(str(k), f"Title {k}", f"name_{k}") for k in range(400)]
    found = steps_image((800, 600), "Lecture", steps[:40], 7, 7, "keys")
    assert [box[-1] for box in found.boxes] == list(range(40))
    left, top, right, bottom, index = found.boxes[12]
    assert found.at((left + right) / 2, (top + bottom) / 2) == index == 12
    assert found.at(799, 599) is None
    many = steps_image((800, 600), "Lecture", steps, 333, 7, "keys")
    assert any(box[-1] == 333 for box in many.boxes) and len(many.boxes) < 400


def test_numbers_and_letters_find_a_step(tmp_path: Path) -> None:
    lecture = read(_written(tmp_path, "scale\n\nmatrix_stack\n\nfig6a\ntitle: Mirror, mirror\n"))
    for typed, index in (("2", 1), ("matr", 1), ("mirr", 2), ("fig", 2), ("stack", 1), ("sc", 0)):
        chooser = StepList(lecture)
        chooser.toggle(0)
        for letter in typed:
            chooser.type(letter)
        assert chooser.chosen == index, typed


def test_a_step_of_a_program_has_its_name_for_a_title(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text("import glfw\n")
    (step,) = read(_written(tmp_path, "mine.py\n")).steps
    assert isinstance(step, Step) and step.file == tmp_path / "mine.py"
    assert (texts.title(step), texts.caption(step), texts.notes(step)) == ("mine.py", "", [])
