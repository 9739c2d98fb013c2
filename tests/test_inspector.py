"""The inspector's model: the tree of a frame, the cells of a call, edits, and the picture's places.

Its calls are made up; the window itself is tested in test_inspector_window.py.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from framelens.gl.notes import Site
from framelens.gl.seam import Call, Listing, gl
from framelens.inspector import words
from framelens.inspector.inspector import WHEEL, Inspector
from framelens.inspector.inspector_image import picture
from framelens.inspector.inspector_page import details, foot, head, visible
from framelens.inspector.inspector_tree import Node, Tree
from framelens.inspector.inspector_values import Cell, cells, dragged, stepped
from framelens.tape.effects import Effect
from framelens.tape.safe import may_be_changed, may_be_left_out

# Enumerants are PyOpenGL's, which must know its platform first.
pytestmark = pytest.mark.usefixtures("the_stage")

LETTERS = {"letter": "I", "pixel": "O"}


def call(
    name: str, *args: Any, element: str = "fog", pass_: str = "main", line: int = 1, **more: Any
) -> Call:
    site = Site("landscape/elements/fog.py", line, "enable", __file__)
    return Call(name, args, (element,), pass_, site, **more)


def numbered(calls: Sequence[Call]) -> list[Call]:
    for number, each in enumerate(calls):
        each.number = number
    return list(calls)


def listing(*calls: Call) -> Listing:
    made = Listing(Site("landscape/elements/sky_box.py", 9, "SkyBox", __file__), "sky", 0)
    made.put(list(calls))
    return made


def density(value: float = 0.12) -> Call:
    return call("glFogf", gl.GL_FOG_DENSITY, value)


@pytest.fixture
def frame() -> list[Call]:
    """A frame of two passes; the sky is a display list with a quad."""
    quad = [
        call("glBegin", gl.GL_QUADS, element="sky", pass_="setup"),
        call("glVertex3f", 0.0, 1.0, -2.0, element="sky", pass_="setup"),
        call("glEnd", element="sky", pass_="setup"),
        call("glColor4f", 1.0, 1.0, 1.0, 1.0, element="sky", pass_="setup"),
    ]
    return numbered(
        [
            call("glClear", gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT, element="frame"),
            call("glFogi", gl.GL_FOG_MODE, gl.GL_EXP2),
            density(),
            call("glFogfv", gl.GL_FOG_COLOR, [0.25, 0.5, 0.75, 1.0]),
            call("glCallList", 7, element="sky", executed=[listing(*quad)]),
            call("glClear", gl.GL_DEPTH_BUFFER_BIT, element="frame"),
            call("glLoadMatrixf", np.eye(4, dtype=np.float32), element="map", pass_="overlay"),
            call("glGenTextures", 1, element="map", pass_="overlay"),
        ]
    )


@pytest.fixture
def model(frame: list[Call]) -> Inspector:
    inspector = Inspector()
    inspector.open = True
    inspector.show(frame, {})
    return inspector


def names(nodes: Sequence[Node]) -> list[str]:
    return [f"{'  ' * node.depth}{node.name}" for node in nodes]


def at(model: Inspector, place: str) -> None:
    model.go_to(place)
    assert model.node is not None and model.node.place == place


def cell(model: Inspector, name: str) -> Cell:
    return next(each for each in model.cells() if each.name == name)


def test_the_frame_is_a_tree_of_passes_and_of_elements_in_their_order(frame: list[Call]) -> None:
    tree = Tree(frame)
    opened = {node.identity for node in tree.passes}
    assert names(tree.rows(opened)) == [
        *("main", "  frame", "  fog", "  sky", "  frame"),
        *("overlay", "  map"),
    ]
    assert [node.count for node in tree.passes] == [6, 2]


def test_the_calls_of_a_list_stand_under_its_call_and_a_quad_under_its_begin(
    model: Inspector,
) -> None:
    at(model, "4.1")
    assert model.node and model.node.name == "glVertex3f"
    shown = names(model.rows)
    start = shown.index("    glCallList")
    assert shown[start + 1 : start + 5] == [
        *("      glBegin", "        glVertex3f", "        glEnd", "      glColor4f")
    ]


def test_what_is_chosen_and_open_stays_so_in_the_next_frame(
    model: Inspector, frame: list[Call]
) -> None:
    at(model, "4.3")
    model.show(numbered([call("glFlush", element="frame"), *frame]), {})
    assert model.node and (model.node.place, model.node.name) == ("5.3", "glColor4f")
    model.show(numbered([density()]), {})
    assert model.node and model.node.name == "main", "gone: what it was in is chosen"


def test_keys_open_close_and_go_through_the_rows(model: Inspector) -> None:
    model.press("home")
    seen = []
    for key in ("down", "down", "right", "down", "down", "right", "left", "left", "end", "up"):
        model.press(key)
        seen.append(model.node.name if model.node else "")
    assert seen == [
        *("frame", "fog", "fog", "glFogi", "glFogf", "glFogf", "fog", "fog", "map", "overlay")
    ]


def test_a_number_is_stepped_finely_and_undone(model: Inspector) -> None:
    at(model, "2")
    model.press("more")
    assert [(e.argument, e.value) for e in model.edits] == [(1, 0.125)]
    model.press("less_fine")
    assert [e.value for e in model.edits] == [0.1245]
    model.press("undo")
    assert [e.value for e in model.edits] == [0.125]
    model.press("undo_here")
    assert model.edits == []
    model.press("undo")
    assert [e.value for e in model.edits] == [0.125]
    model.press("undo_all")
    assert model.edits == []


def test_a_step_back_to_the_programs_own_value_is_no_edit(model: Inspector) -> None:
    at(model, "1")
    model.press("more")
    assert [e.value for e in model.edits] == ["GL_LINEAR"]
    model.press("less")
    assert model.edits == []


def test_only_legal_enumerants_can_be_chosen(model: Inspector) -> None:
    at(model, "1")
    mode = cell(model, "param")
    assert set(mode.choices) == {"GL_LINEAR", "GL_EXP", "GL_EXP2"} and mode.value == "GL_EXP2"
    values = {stepped(mode, way, False) for way in (1, -1)}
    assert values < {"GL_LINEAR", "GL_EXP"} or values == {"GL_LINEAR", "GL_EXP"}
    # glFogfv has four numbers here, so no name for which OpenGL reads another count.
    at(model, "3")
    assert cell(model, "pname").kind == "fixed"


def test_a_mask_is_changed_bit_by_bit(model: Inspector) -> None:
    at(model, "0")
    model.place = cell(model, "GL_DEPTH_BUFFER_BIT").place
    model.press("more")
    assert [e.value for e in model.edits] == ["GL_COLOR_BUFFER_BIT"]
    model.press("more")
    model.place = cell(model, "GL_STENCIL_BUFFER_BIT").place
    model.press("more")
    assert set(str(model.edits[0].value).split(" | ")) == {
        *("GL_COLOR_BUFFER_BIT", "GL_DEPTH_BUFFER_BIT", "GL_STENCIL_BUFFER_BIT")
    }


def test_vectors_and_matrices_are_changed_by_component(model: Inspector) -> None:
    at(model, "3")
    model.place = cell(model, "params.green").place
    model.press("more")
    at(model, "6")
    model.place = cell(model, "m.21").place
    model.press("more")
    found = [(e.argument, e.component, e.value) for e in model.edits]
    assert found == [(1, 1, 0.52), (0, 6, 0.05)]
    assert len([each for each in model.cells() if each.kind == "number"]) == 16


def test_two_components_of_a_vector_are_two_edits_and_both_are_shown(model: Inspector) -> None:
    at(model, "3")
    for name in ("params.red", "params.blue"):
        model.place = cell(model, name).place
        model.press("more")
    assert [each.text for each in model.cells()[1:]] == ["0.26", "0.5", "0.76", "1"]


def test_a_number_stays_within_the_limits_of_the_specification() -> None:
    alpha = cells(call("glAlphaFunc", gl.GL_GREATER, 0.99))[-1]
    assert (alpha.low, alpha.high) == (0.0, 1.0)
    assert [stepped(alpha, 1, False), dragged(alpha, 500)] == [1.0, 1.0]
    factor = cells(call("glLineStipple", 2, 255))[0]
    assert factor.whole and [stepped(factor, -1, False), dragged(factor, -100)] == [1, 1]


def test_a_drag_doubles_a_number_over_200_pixels_and_goes_down_through_zero() -> None:
    x = cells(call("glTranslatef", 30.0, -2.0, 0.0))
    grown = [dragged(x[0], pixels) for pixels in (0, 100, 200, 400)]
    assert grown == sorted(grown) and grown[0] == 30.0 and grown[2] > 75
    assert [dragged(x[0], -200), dragged(x[0], -300)] == [0.0, -15.0]
    assert dragged(x[0], 100, fine=True) == pytest.approx(31.54)
    assert [dragged(x[1], 200), dragged(x[2], 20)] == [0.0, pytest.approx(0.0526, abs=1e-4)]


def test_a_call_is_left_out_and_made_again_but_not_one_the_program_needs(model: Inspector) -> None:
    at(model, "2")
    model.press("switch")
    assert [e.skip for e in model.edits] == [True] and model.found and model.is_off(model.found)
    model.press("switch")
    assert model.edits == []
    for place in ("7", "4.0"):
        at(model, place)
        model.press("switch")
        assert model.edits == [] and model.said[0] == "inspector.needed"


def test_nothing_can_be_changed_that_says_what_opengl_reads_from_memory() -> None:
    array = np.zeros((4, 3), np.float32)
    cases = [
        ("glVertexPointer", (3, gl.GL_FLOAT, 0, array), ""),
        ("glDrawElements", (gl.GL_TRIANGLES, 12, gl.GL_UNSIGNED_INT, array), "mode count"),
        ("glDrawArrays", (gl.GL_TRIANGLES, 0, 4), "mode count"),
        ("glPixelStorei", (gl.GL_UNPACK_ALIGNMENT, 4), ""),
        ("glBindTexture", (gl.GL_TEXTURE_2D, 3), "target texture"),
        ("glBindBuffer", (gl.GL_ARRAY_BUFFER, 3), ""),
    ]
    for name, args, wanted in cases:
        free = [each.name for each in cells(call(name, *args)) if each.kind != "fixed"]
        assert " ".join(free) == wanted, name
    count = cells(call("glDrawArrays", gl.GL_TRIANGLES, 0, 4))[2]
    assert (count.low, count.high) == (0.0, 4.0)
    assert not may_be_left_out("glDisableClientState") and may_be_left_out("glDrawArrays")
    assert not may_be_changed("glUnknown", 0, (1,))


def test_a_drag_is_one_change_for_undo(model: Inspector) -> None:
    at(model, "2")
    model.click(("cell", (1, None, "")), 100.0)
    for x in (110.0, 150.0, 180.0):
        model.drag(x, fine=False)
    model.release()
    assert len(model.edits) == 1 and model.edits[0].value > 0.15
    model.press("undo")
    assert model.edits == []


def test_a_click_without_a_drag_goes_on_to_the_next_enumerant(model: Inspector) -> None:
    at(model, "1")
    model.click(("cell", (1, None, "")), 100.0)
    model.release()
    assert [e.value for e in model.edits] == ["GL_LINEAR"]
    model.click(("choice", "GL_EXP"), 0.0)
    assert [e.value for e in model.edits] == ["GL_EXP"]


def test_the_call_that_gave_a_pixel_its_colour_is_chosen(model: Inspector, frame: Any) -> None:
    from framelens.tape.pixel import Row
    from framelens.tape.probe import Pixel
    from framelens.tape.steps import find

    def row(place: str, outcome: str, red: int) -> Row:
        return Row(find(frame, place), outcome, "", Pixel((red, 0, 0, 255), 1.0, 0))

    rows = [row("0", "drawn", 9), row("4.0", "drawn", 80), row("5", "drawn", 80)]
    rows.append(row("4.0", "depth", 80))
    model.ask(rows, listed=False)
    assert model.node and model.node.place == "4.0" and model.history is None
    model.ask(rows, listed=True)
    assert model.history and model.fragment == 1
    model.press("up")
    assert model.node.place == "0"
    model.press("enter")
    assert model.history is None and model.node and model.node.name == "glClear"


@pytest.mark.parametrize("language", ["en", "fr"])
def test_the_panel_explains_the_call_its_argument_and_its_effect(
    language: str, model: Inspector
) -> None:
    at(model, "2")
    model.press("more")
    model.effects = {"2": Effect({"GL_FOG_DENSITY": 0.12}, {"GL_FOG_DENSITY": 0.125})}
    text = "\n".join("".join(s.text for s in block.spans) for block in details(model, language))
    assert "glFogf(GL_FOG_DENSITY, 0.125)" in text and "0.125 (0.12)" in text
    assert "GL_FOG_DENSITY  0.12 → 0.125" in text and "landscape/elements/fog.py:1" in text
    assert {"en": "fog", "fr": "brouillard"}[language] in text
    assert words.counted(language, "inspector.edits", 1) in "".join(
        span.text for span in head(model, language)
    )


def test_a_redundant_and_an_edited_call_are_marked_in_the_list(model: Inspector) -> None:
    model.effects = {"1": Effect({"GL_FOG_MODE": "GL_EXP2"}, {"GL_FOG_MODE": "GL_EXP2"})}
    at(model, "2")
    model.press("more")
    _, lines = visible(model, 100, "en")
    ends = {line.number: [span.style for span in line.end] for line in lines if line.number}
    assert (ends["+1"], ends["+2"], ends["+3"]) == (["redundant"], ["edited"], [])


def test_calls_are_numbered_as_the_commands_count_them(model: Inspector) -> None:
    assert (model.numbered("3"), model.numbered("4.1")) == ("+3", "+4.1")
    model.show(numbered([call("glFlush", pass_="setup"), density()]), {})
    assert (model.numbered("0"), model.numbered("1")) == ("", "+0")
    model.numbers = range(7, 9)
    at(model, "1")
    _, lines = visible(model, 100, "en")
    assert [line.number for line in lines if line.chosen] == ["8"]


def named(model: Inspector, language: str) -> list[str]:
    """Return the names of the passes and elements in the list."""
    lines = visible(model, 100, language)[1]
    return ["".join(span.text for span in line.spans) for line in lines if not line.number]


def test_passes_and_elements_are_named_in_the_user_s_language(model: Inspector) -> None:
    calls = [call("glEnd", element="sky"), call("glEnd", element="castle", pass_="overlay")]
    model.show(numbered(calls), {})
    for language, names in {
        "en": ["main pass", "sky", "overlay", "castle"],
        "fr": ["passe principale", "ciel", "incrustations", "château"],
    }.items():
        assert [name for name in named(model, language) if "(" not in name] == names
    model.frame = 0  # of a program: its elements are its functions
    assert "sky" in named(model, "fr") and "passe principale" in named(model, "fr")


def test_one_call_is_singular(model: Inspector) -> None:
    model.show(numbered([density()]), {})
    for node in model.rows[:2]:
        model.selected = node.identity
        french, english = (
            "".join(span.text for block in details(model, language) for span in block.spans)
            for language in ("fr", "en")
        )
        assert "1 appel." in french and "1 call." in english
    for count, title in ((1, "1 appel"), (0, "0 appel"), (2, "2 appels")):
        assert words.counted("fr", "inspector.calls", count) == title


def test_a_small_window_names_fewer_keys_and_shows_more_rows(model: Inspector) -> None:
    full, few = (foot(model, "fr", LETTERS, few=few)[-1] for few in (False, True))
    assert len(few) < len(full) / 2
    at(model, "2")
    boxes = picture(model, (640, 480), 1.0, "fr", LETTERS).boxes
    assert len({box[4] for box in boxes if box[4][0] == "row"}) >= 12


def test_a_number_that_the_program_set_to_zero_grows_in_even_steps() -> None:
    model = Inspector()
    model.show(numbered([call("glClearColor", 0.0, 0.0, 0.6, 1.0)]), {})
    at(model, "0")
    for _ in range(3):
        model.press("more")
    assert [edit.value for edit in model.edits] == [0.15]


@pytest.mark.parametrize("size", [(640, 480), (1280, 720), (3840, 2160), (64, 48), (1, 1)])
def test_the_panel_leaves_the_middle_free_and_a_click_finds_what_is_drawn_there(
    size: tuple[int, int], model: Inspector
) -> None:
    at(model, "2")
    shown = picture(model, size, 1.0, "fr", LETTERS)
    height, width = shown.image.shape[:2]
    assert shown.image.dtype == np.uint8 and height <= max(size[1], 8)
    if size[0] < 640:
        return
    assert width + size[1] // 48 < size[0] / 2
    targets = {box[4] for box in shown.boxes}
    assert ("cell", (1, None, "")) in targets and ("row", model.index) in targets
    for left, top, right, bottom, target in shown.boxes:
        middle = (left + right) / 2, (top + bottom) / 2
        if target[0] == "cell":
            assert shown.at(*middle) == target and right <= width and bottom <= height


def test_a_trackpad_scrolls_as_many_rows_as_a_wheel_that_turns_as_far(model: Inspector) -> None:
    model.opened |= {node.identity for node in model.rows}
    model.show(numbered([density() for _ in range(30)]), {})
    model.press("right")
    model.wheel(-2.0, 0)
    rows = model.first
    assert rows == 2 * WHEEL < len(model.rows)
    for _ in range(20):
        model.wheel(0.1, model.first or 0)
    assert model.first == 0
