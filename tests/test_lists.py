"""Display lists compiled again from their calls: the same picture, or the edited one."""

import json
from pathlib import Path

import numpy as np
import pytest
from commands import landscape
from stage import SMALL_BEST

from framelens.gl.seam import Listing, lists_now
from framelens.tape.edits import Edit, Edits, ListKey, located
from framelens.tape.lists import compile_again, recompile
from landscape.island.views import MAIN, VIEWS
from landscape.offscreen import Offscreen

SIZE = (96, 72)


@pytest.mark.seldom(14, first=4)
@pytest.mark.parametrize("preset", ["2006", "best"])
def test_lists_compiled_again_without_edits_leave_every_pixel_as_it_was(preset: str) -> None:
    few = {"trees.count": 200, "grass.count": 2000} if preset == "2006" else SMALL_BEST
    overlay = {"overlay.map": True, "overlay.sword": True}
    with Offscreen(SIZE, preset, few | overlay, samples=0) as view:
        before = {name: drawn(view, name) for name in MAIN}
        scene = view.scene
        with view._current():
            lists = dict(lists_now())
            for number, listing in lists.items():
                compile_again(number, listing, Edits())
        for name in MAIN:
            assert np.array_equal(drawn(view, name), before[name]), name
        assert len(lists) > 4 and view.scene is scene


def drawn(view: Offscreen, name: str) -> np.ndarray:
    """Return the picture from where a view is."""
    view.look(VIEWS[name].pose, VIEWS[name].kt)
    return view.draw()


def first(name: str) -> tuple[Listing, Edit]:
    """Return the first list with a call of that name, and an edit of the call's first argument."""
    for listing in lists_now().values():
        for call in located(listing.calls(), listing):
            if call.call.name == name:
                return listing, call.edit(0, "GL_LINES")
    raise AssertionError(name)


@pytest.mark.seldom(3)
def test_an_edit_inside_a_list_shows_at_once_and_undone_gives_the_former_bytes() -> None:
    few = {"trees.count": 200, "grass.count": 2000}
    with Offscreen(SIZE, "2006", few, samples=0) as view:
        view.look("fig35f")
        before = view.draw()
        with view._current():
            listing, edit = first("glDrawElements")
            key = ListKey.of(listing)
            assert recompile({key}, Edits([edit])) == 1
            assert any(call.given is not None for call in listing.calls())
        edited = view.draw()
        assert not np.array_equal(edited, before)
        with view._current():
            recompile({key}, Edits([edit]))
        assert np.array_equal(view.draw(), edited), "compiled again, it is not edited twice"
        with view._current():
            recompile({key}, Edits())
        assert np.array_equal(view.draw(), before)

    with Offscreen(SIZE, "2006", few, samples=0, edits=Edits([edit])) as view:
        view.look("fig35f")
        assert np.array_equal(view.draw(), edited), "as if the program had drawn lines"


FOG = {
    "name": "glFogf",
    "element": "fog",
    "pass": "main",
    "file": "landscape/elements/fog.py",
    "function": "enable",
    "text": "gl.glFogf(gl.GL_FOG_DENSITY, fog.density)",
    "select": ["GL_FOG_DENSITY"],
}


@pytest.mark.seldom(10, first=3)
def test_render_plays_a_file_of_edits_and_tells_of_one_without_a_call(tmp_path: Path) -> None:
    path = tmp_path / "edits.json"
    lost = {**FOG, "element": "nowhere"}
    edits = [{"call": call, "argument": 1, "value": 0.3} for call in (FOG, lost)]
    path.write_text(json.dumps({"version": 1, "edits": edits}))
    words = ("render", "fig35a", "fig35e", "--preset", "2006", "--size", "64x48", "--quiet")
    words += ("--only", "ground,fog")
    plain = landscape(*words, "--set", "fog.density=0.3", "--out", tmp_path / "plain")
    loud = tuple(word for word in words if word != "--quiet")
    done = landscape(*loud, "--edits", path, "--out", tmp_path / "edited")
    assert (plain.status, done.status) == (0, 0), plain.err + done.err
    assert done.err.count("\n") == 1 and "edit 2: no call glFogf of nowhere" in done.err
    for name in ("fig35a.png", "fig35e.png"):
        drawn = [(tmp_path / folder / name).read_bytes() for folder in ("plain", "edited")]
        assert drawn[0] == drawn[1], name
