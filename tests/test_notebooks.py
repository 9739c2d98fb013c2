"""Notebooks: those of docs/notebooks run as they are, and what a notebook shows of each object."""

import ast
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import TESTS

import framelens
import landscape
from framelens.base.errors import InputError
from framelens.base.texts import LANGUAGES, speaking

NOTEBOOKS = TESTS.parent / "docs" / "notebooks"
NAMES = "island", "lessons", "exercises"
# How many of its cells keep a picture as PNG, and how many HTML.
KEPT = {"island": (3, 3), "lessons": (3, 2), "exercises": (1, 1)}

# Ends its process as a driver does that crashes.
CRASHING = """
import ctypes
import glfw
from OpenGL.GL import *
glfw.init()
glfw.make_context_current(glfw.create_window(64, 64, "", None, None))
ctypes.string_at(0)
"""


def sources(name: str, language: str = "en") -> list[str]:
    """Return the cells of code of a notebook."""
    return ["".join(cell["source"]) for cell in cells(name, language) if _is_code(cell)]


def cells(name: str, language: str = "en") -> list[dict[str, Any]]:
    file = name if language == "en" else f"{name}.{language}"
    found: list[dict[str, Any]] = json.loads(
        (NOTEBOOKS / f"{file}.ipynb").read_text(encoding="utf-8")
    )["cells"]
    return found


def _is_code(cell: dict[str, Any]) -> bool:
    return bool(cell["cell_type"] == "code")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.sweep(14, first=1)
def test_a_notebook_runs_without_a_browser_and_keeps_its_pictures(
    name: str, tmp_path: Path
) -> None:
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("jupyter_rfb")
    code = list(map(nbformat.v4.new_code_cell, sources(name)))
    book = nbformat.v4.new_notebook(cells=code)
    nbclient.NotebookClient(book, timeout=120, resources={"metadata": {"path": tmp_path}}).execute()

    shown = {cell.source: _data(cell.outputs) for cell in book.cells}
    pages = [data["text/html"] for data in shown.values() if "text/html" in data]
    assert (sum("image/png" in data for data in shown.values()), len(pages)) == KEPT[name]
    for page in pages:
        assert 'class="framelens"' in page and "<script" not in page
    assert list(tmp_path.iterdir()) == [], "the notebook writes nothing"

    last = list(shown.values())[-1]
    if name == "island":
        live = next(data for source, data in shown.items() if "live=True" in source)
        assert "application/vnd.jupyter.widget-view+json" in live and len(live["image/png"]) > 9000
    elif name == "lessons":
        assert "GL_DEPTH_BUFFER_BIT" in last["text/html"]
    else:
        assert last["text/plain"].startswith("(False,") and "depth test" in last["text/plain"]


def _data(outputs: Any) -> dict[str, str]:
    found: dict[str, str] = {}
    for output in outputs:
        assert output.output_type != "error"
        found |= output.get("data", {})
    return found


@pytest.mark.parametrize("name", NAMES)
def test_a_notebook_is_committed_without_outputs_and_in_each_language(name: str) -> None:
    for language in LANGUAGES:
        for cell in cells(name, language):
            assert not cell.get("outputs") and cell.get("execution_count") is None
        assert list(map(calls, sources(name, language))) == list(map(calls, sources(name)))


def calls(source: str) -> tuple[list[str], str]:
    """Return the magic lines and the statements of a cell, without its texts and comments."""
    lines = source.splitlines()
    magic = [line for line in lines if line.startswith("%")]
    tree = ast.parse("\n".join(line for line in lines if not line.startswith("%")))
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.FunctionDef) and ast.get_docstring(node) is not None:
            node.body = node.body[1:]
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            node.value = ""
    return magic, ast.dump(tree)


@pytest.mark.seldom(14, first=12)
def test_a_frame_is_shown_as_a_picture_and_asked_for_pixels_calls_and_causes() -> None:
    mirror = landscape.lesson("mirror", keys="S", size=(160, 120))
    assert mirror.picture.size == (160, 120) and mirror._repr_png_()[:4] == b"\x89PNG"
    row = mirror.pixel(80, 60).rows[-1]
    assert list(mirror.picture.getpixel((80, 60))) == row["color"][:3]
    calls = mirror.calls("draw_knot")
    assert {call["element"] for call in calls.calls} == {"draw_knot"}
    assert "glDrawElements" in calls._repr_html_()
    with speaking("fr"):
        assert "Issue" in mirror.pixel(0, 0)._repr_html_()


@pytest.mark.seldom(14)
def test_the_keys_of_a_lesson_s_picture_give_way_to_those_that_are_named() -> None:
    plain, own, named = (
        np.asarray(landscape.lesson("mirror", keys, size=(80, 60)).picture)
        for keys in ("", None, "S")
    )
    assert (plain == own).all() and (plain != named).any()


@pytest.mark.seldom(3, first=2)
def test_a_program_that_crashes_ends_its_own_process_only(tmp_path: Path) -> None:
    (tmp_path / "crash.py").write_text(CRASHING)
    with pytest.raises(InputError, match="crash"):
        framelens.look(tmp_path / "crash.py")


@pytest.mark.seldom(3, first=2)
def test_bad_input_is_refused_before_anything_is_drawn() -> None:
    for wrong, said in (
        (lambda: landscape.show("fig99"), "fig99"),
        (lambda: landscape.show("mine.py", preset="2006"), "is a program"),
        (lambda: landscape.show("fig6a", settings={"fog.densty": 1}), "fog.densty"),
        (lambda: landscape.lesson("mirorr"), "mirorr"),
        (lambda: landscape.lesson("mirror", keys="SPACEBAR"), "SPACEBAR"),
        (lambda: landscape.lesson("mirror", frame=-1), "frame"),
        (lambda: landscape.check("a = 1\nb = 2\n"), "cell.py: expected a line such as"),
    ):
        with pytest.raises(InputError, match=said):
            wrong()


@pytest.mark.seldom(13)
def test_a_check_shows_each_test_and_where_the_picture_differs() -> None:
    start = (TESTS.parent / "landscape/course/exercises/missing_enable/start.py").read_text("utf-8")
    found = landscape.check(start)
    assert not found.passed and found.exercise == "missing_enable" and found.difference
    page = found._repr_html_()
    hint = next(test["hint"] for test in found.tests if test["hint"])
    assert hint.split("'")[0].split('"')[0] in page and "data:image/png" in page
    assert found._repr_png_()[:4] == b"\x89PNG"
    assert repr(found).splitlines()[0].startswith("missing_enable: ")


@pytest.mark.seldom(13)
def test_a_live_walk_takes_events_without_a_browser() -> None:
    pytest.importorskip("jupyter_rfb")
    walk = landscape.show("fig6a", size=(160, 120), live=True)
    try:
        first = walk.get_frame()
        assert first.shape == (120, 160, 3)

        def press(key: str, *modifiers: str) -> np.ndarray:
            for kind in ("key_down", "key_up"):
                walk.handle_event({"type": kind, "key": key, "modifiers": modifiers})
            return walk.get_frame()

        turned = press("ArrowLeft")
        for x in (80, 90, 100):
            kind = "pointer_down" if x == 80 else "pointer_move"
            walk.handle_event({"type": kind, "x": x, "y": 60, "button": 1, "modifiers": ()})
        dragged = walk.get_frame()
        assert (first != turned).any() and (turned != dragged).any()
        walk.handle_event({"type": "pointer_up", "x": 100, "y": 60, "button": 1, "modifiers": ()})
        inspected = press("i")
        assert inspected[:, :40].mean() < 0.7 * dragged[:, :40].mean(), "the panel, at the left"
        press("Escape")
        walk.handle_event({"type": "resize", "width": 200, "height": 100, "ratio": 2})
        walk.get_frame()
        assert walk.get_frame().shape == (100, 200, 3)
    finally:
        walk.close()
