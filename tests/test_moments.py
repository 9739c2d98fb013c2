"""The state at a call of a frame, what elements leave changed, and `landscape state`."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import Shell, refused, small_textures
from stage import SMALL, SMALL_BEST, Stage
from state_calls import Fresh

from framelens.base.errors import InputError
from framelens.gl.framebuffer import Framebuffer, read_pixels
from framelens.gl.seam import Call, drawing, gl, recording, unnoted
from framelens.report.state_report import report
from framelens.state.state import State, changed, difference, read, restore
from framelens.tape.moments import leaks, state_at
from framelens.tape.steps import issue
from framelens.tape.tape import Tape
from landscape.gl.display_list import DisplayList
from landscape.offscreen import Offscreen

SIZE = (96, 72)
QUICK = {"2006": SMALL, "best": SMALL_BEST}
NINE = tuple(f"fig35{letter}" for letter in "abcdefghi")


def without_names(state: State) -> State:
    """Return a state without what another context and another memory have other names for."""
    names = ("FRAMEBUFFER_BINDING", "RENDERBUFFER_BINDING", "POINTER")
    return {name: value for name, value in state.items() if not name.endswith(names)}


def without_vertices(calls: Sequence[Call], at: int) -> int:
    """Return a call's number, or that of the last glBegin if it is between that and its glEnd."""
    names = [call.name for call in calls[:at]]
    begin = len(names) - 1 - names[::-1].index("glBegin") if "glBegin" in names else at
    return at if "glEnd" in names[begin:] else begin


@pytest.fixture(scope="module")
def assets(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of small textures, in place of those that are slowest to load."""
    folder = tmp_path_factory.mktemp("small")
    small_textures(folder)
    return folder


@dataclass
class LaidOpen:
    """What is asked of one frame: pairs of calls with their states, and what elements leak."""

    calls: Sequence[Call]
    begin: int
    pairs: dict[tuple[int, int], tuple[State, State]]
    leaks: dict[str, dict[str, dict[str, list[Any]]]]
    same_picture: bool


@pytest.fixture(scope="module", params=["2006", "best"])
def laid_open(request: pytest.FixtureRequest, assets: Path) -> LaidOpen:
    """A frame of each preset: building an island takes most of the time."""
    rng = np.random.default_rng(15)
    with Offscreen(
        SIZE, request.param, QUICK[request.param], samples=0, assets=assets
    ) as offscreen:
        with offscreen.taped("fig35e") as tape:
            frame = read_pixels(SIZE)
            pairs = {}
            for _ in range(5):
                drawn = rng.integers(tape.begin, len(tape.calls), 2)
                first, last = sorted(without_vertices(tape.calls, int(at)) for at in drawn)
                pairs[first, last] = state_at(tape, str(first)), state_at(tape, str(last))
            elements = dict.fromkeys(name for call in tape.frame for name in call.shared_by)
            found = {name: leaks(tape, name) for name in elements if name != "frame"}
            same = np.array_equal(read_pixels(SIZE), frame)
            return LaidOpen(tape.calls, tape.begin, pairs, found, same)


@pytest.mark.seldom(13, first=12)
def test_from_the_state_at_one_call_a_new_context_comes_to_the_state_at_a_later_one(
    laid_open: LaidOpen, fresh: Fresh
) -> None:
    states = [state for pair in laid_open.pairs.values() for state in pair]
    assert any(state["GL_ATTRIB_STACK_DEPTH"] for state in states)
    fresh()
    target = Framebuffer(SIZE)
    here = {name: value for name, value in read().items() if name.endswith("FRAMEBUFFER_BINDING")}

    # The frame makes textures and a framebuffer for the mirror image when it first needs them: they
    # must exist, as they do in a context to which a frame is drawn again from its middle.
    for call in laid_open.calls:
        issue(call)
    for (first, last), (before, after) in laid_open.pairs.items():
        restore({**before, **here})
        for call in laid_open.calls[first:last]:
            issue(call)
        stacks = [after.get(f"GL_{which}ATTRIB_STACK", []) for which in ("", "CLIENT_")]
        masks = [[level["mask"] for level in stack] for stack in stacks]
        got = read(*masks) if any(masks) else read()
        assert difference(without_names(after), without_names(got)) == {}

    target.release()


@pytest.mark.seldom(12, first=3)
def test_asking_for_states_does_not_change_the_picture(laid_open: LaidOpen) -> None:
    assert laid_open.same_picture


@pytest.mark.seldom(12, first=3)
def test_of_the_elements_only_the_fog_leaves_something_changed(laid_open: LaidOpen) -> None:
    """It is there for all that are drawn after it."""
    assert set(laid_open.leaks) > {"water", "castle", "reflection"}
    leaking = {name for name, passes in laid_open.leaks.items() if any(passes.values())}
    assert leaking == {"fog"}
    fog = {"GL_FOG", "GL_FOG_MODE", "GL_FOG_DENSITY", "GL_FOG_COLOR"}
    assert set(laid_open.leaks["fog"]["main"]) == fog


@pytest.mark.seldom(14, first=6)
@pytest.mark.parametrize("preset", ["2006", "best"])
def test_a_frame_of_the_main_views_ends_in_the_state_in_which_it_began(
    assets: Path, preset: str
) -> None:
    """All of the state, but for where the vertex arrays point, which are disabled."""
    with Offscreen(SIZE, preset, QUICK[preset], samples=0, assets=assets) as offscreen:
        for view in NINE:
            offscreen.look(view)
            offscreen.draw()
            before = read()
            offscreen.submit()
            after = read()
            found = {name for name in difference(before, after) if not name.endswith("POINTER")}
            assert found == set(), view
            enabled = [name for name in after if name.endswith("_ARRAY") and after[name]]
            assert enabled == []


@pytest.fixture
def drawn(stage: Stage) -> Iterator[Callable[[Callable[[], object]], Tape]]:
    """Makes a tape of what a function draws, in the test's context."""

    def tape(draw: Callable[[], object]) -> Tape:
        start = read()
        with recording(complete=True) as recorder:
            draw()
        return Tape(recorder.calls, 0, start, stage.size)

    with stage.borrowed(), unnoted():
        yield tape


def test_an_element_that_leaks_is_found(drawn: Callable[[Callable[[], object]], Tape]) -> None:
    def draw() -> None:
        with drawing("fog"):
            gl.glEnable(gl.GL_FOG)
            gl.glDisable(gl.GL_FOG)
        with drawing("castle"):
            gl.glPushMatrix()
            gl.glLineWidth(3.0)

    tape = drawn(draw)
    assert leaks(tape, "fog") == {"setup": {}}
    found = leaks(tape, "castle")["setup"]
    assert set(found) == {"GL_LINE_WIDTH", "GL_MODELVIEW_STACK", "GL_MODELVIEW_STACK_DEPTH"}
    gl.glPopMatrix()
    gl.glLineWidth(1.0)


def test_a_state_inside_a_primitive_and_inside_a_display_list_is_found(
    drawn: Callable[[Callable[[], object]], Tape],
) -> None:
    def inside() -> None:
        gl.glLineWidth(2.0)
        gl.glBegin(gl.GL_TRIANGLES)
        gl.glColor3f(0.25, 0.5, 0.75)
        gl.glVertex3f(0.0, 0.0, 0.0)
        gl.glEnd()
        gl.glLineWidth(4.0)

    kept: list[DisplayList] = []

    def draw() -> None:
        kept.append(DisplayList(inside))
        gl.glLineWidth(1.0)
        gl.glCallList(kept[0].name)

    tape = drawn(draw)
    number = tape.calls[-1].number
    assert tape.calls[-1].name == "glCallList"
    assert state_at(tape, str(number))["GL_LINE_WIDTH"] == 1.0
    in_list = [state_at(tape, f"{number}.{k}") for k in range(6)]
    assert [state["GL_LINE_WIDTH"] for state in in_list] == [1.0, 2.0, 2.0, 2.0, 2.0, 2.0]
    assert in_list[3]["GL_CURRENT_COLOR"] == [0.25, 0.5, 0.75, 1.0]
    assert in_list[2]["GL_CURRENT_COLOR"] != in_list[3]["GL_CURRENT_COLOR"]
    assert state_at(tape)["GL_LINE_WIDTH"] == 4.0
    state_at(tape, f"{number}.3")
    assert read()["GL_LINE_WIDTH"] == 4.0, "afterwards the context is as it was after the frame"
    gl.glLineWidth(1.0)
    kept[0].release()


def test_reports_name_their_moments(assets: Path) -> None:
    with Offscreen(
        SIZE, "2006", SMALL, samples=0, assets=assets, only=("fog", "castle")
    ) as offscreen:
        with offscreen.taped("fig35e") as tape:
            whole = report(tape)
            assert next(whole.as_text()) == "state after the frame"
            assert whole.as_json()["GL_FOG_DENSITY"] == 0.12

            initial = report(tape, "castle", "initial")
            first = next(call for call in tape.frame if "castle" in call.shared_by)
            line = next(initial.as_text())
            assert line.startswith(f"a new context -> before call {first.number}: ")
            assert "castle, main pass, landscape/elements/castle.py:" in line
            assert initial.as_json()["GL_FOG"] == [False, True]
            assert initial.as_json().keys() == changed(state_at(tape, str(first.number))).keys()

            between = report(tape, str(first.number), str(first.number + 1))
            assert len(between.as_json()) < 10
            since = report(tape, diff=str(first.number)).as_json()
            assert since["GL_DEPTH_TEST"] == [False, True]
            assert report(tape, "+3").parts == report(tape, str(tape.begin + 3)).parts
            assert report(tape, diff="+3").parts == report(tape, diff=str(tape.begin + 3)).parts

            leak = report(tape, diff="castle")
            assert list(leak.as_text()) == ["castle leaves, main pass", "    nothing differs"]
            assert leak.as_json() == {}

            for wrong in ("99999", "0", "moon", "1.2.x"):
                with pytest.raises(InputError, match=wrong):
                    report(tape, wrong)
                with pytest.raises(InputError, match=wrong):
                    report(tape, diff=wrong)


FEW = ("--preset", "2006", "--size", "96x72", "--only", "ground,sky,fog,map")


@pytest.mark.seldom(7, first=2)
def test_the_command_prints_a_state_as_json_and_as_text(shell: Shell) -> None:
    command = ("state", "fig35f", *FEW, *shell.small)
    state = shell(*command, "--at", "fog", "--json").json()
    assert state["GL_FOG"] is False and len(state["GL_MODELVIEW_MATRIX"]) == 16
    difference = shell(*command, "--diff", "fog", "--json").json()
    assert difference["GL_FOG_DENSITY"] == [1.0, 0.12]
    done = shell(*command, "--at", "map")
    assert done.status == 0 and done.err == ""
    assert "GL_FOG_DENSITY" in done.out and "\ncolouring and lighting\n" in done.out


@pytest.mark.seldom(13, first=4)
@pytest.mark.parametrize("option", ["--at", "--diff"])
def test_calls_and_elements_that_the_frame_does_not_have_are_refused(
    shell: Shell, option: str
) -> None:
    command = ("state", "fig35f", *FEW, *shell.small, option)
    refused(shell(*command, "99999"), "99999", "calls")
    refused(shell(*command, "0"), "'0'", "before the frame begins")
    refused(shell(*command, "castle"), "castle", "expected a call's number or an element", "map")
    refused(shell(*command, "12.x"), "12.x", "12.3")
