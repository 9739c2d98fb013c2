"""A frame on tape: complete, so that it is drawn again in its context and in another one."""

import json

import numpy as np
import pytest
from commands import landscape
from stage import SMALL_BEST

from framelens.base.errors import InputError
from framelens.gl.framebuffer import read_pixels
from framelens.gl.seam import make_again, recording, unnoted
from framelens.tape.effects import effects, watch
from framelens.tape.steps import find, issue, repeatable
from landscape.commands.target import ViewFrame
from landscape.gallery.compare import difference
from landscape.offscreen import Offscreen

SIZE = (160, 120)


@pytest.mark.seldom(13, first=8)
@pytest.mark.parametrize(("view", "preset"), [("fig35e", "2006"), ("fig35f", "best")])
def test_a_view_is_drawn_from_its_tape_alone_by_a_new_context(view: str, preset: str) -> None:
    only = ("ground", "water", "reflection", "sky", "castle", "map", "fog")
    few = SMALL_BEST if preset == "best" else {}
    with Offscreen(SIZE, preset, few, samples=0, only=only) as first, first.taped(view) as tape:
        wanted = read_pixels(SIZE)
        tape.replay()
        assert np.array_equal(read_pixels(SIZE), wanted), "again, in the same context"
        tape.rewind()
        for step in tape.steps():
            issue(step.call)
        # Mesa rounds the fog's distance in a list otherwise than outside of one.
        levels = difference(read_pixels(SIZE), wanted)
        assert levels.max() <= 1 and (levels > 0).mean() < 0.001, "with the calls of each list"
    with Offscreen(SIZE, preset, few, samples=0, only=only) as second, second.targeted(), unnoted():
        tape.play()
        assert np.array_equal(read_pixels(SIZE), wanted)


def test_calls_made_again_are_listed_once_and_their_effects_are_seen_on_the_way() -> None:
    only = ("ground", "sky", "grass", "fog")
    with Offscreen(SIZE, "2006", samples=0, only=only) as offscreen:
        with offscreen.taped("fig35e") as tape:
            made = [call for call in tape.frame if repeatable(call.name)]
            assert any(call.arrays for call in made)
            found = effects(tape)
            tape.rewind()
            with recording(complete=True) as recorder:
                seen = watch(recorder, range(len(made)))
                for call in made:
                    make_again(call)
    assert [call.name for call in recorder.calls] == [call.name for call in made]
    wanted = {k: found.get(str(call.number)) for k, call in enumerate(made)}
    assert seen == {str(k): effect for k, effect in wanted.items() if effect is not None}
    assert any(effect.redundant for effect in seen.values())


@pytest.mark.seldom(10, first=9)
def test_the_tape_has_the_picture_that_is_rendered() -> None:
    wanted = ViewFrame("fig35e", SIZE, preset="2006").look(lambda tape: read_pixels(SIZE))
    with Offscreen(SIZE, "2006", samples=0) as offscreen:
        offscreen.look("fig35e")
        assert np.array_equal(offscreen.draw(), wanted)


def test_a_call_that_does_not_exist_is_refused_in_one_line_with_those_there_are() -> None:
    calls = ViewFrame("fig35a", SIZE, preset="2006", only=("sky",)).look(lambda tape: tape.calls)
    last = len(calls) - 1
    for place, said in {
        "99999": f"the frame has {len(calls)} calls, expected 0 to {last}",
        "0.3": "call 0 executes no calls",
        "1.x": "expected a number such as 12",
    }.items():
        with pytest.raises(InputError, match=said):
            find(calls, place)
    listed = next(call for call in calls if call.listed)
    assert find(calls, f"{listed.number}.1").call is listed.listed[1]
    assert find(calls, f"{listed.number}.1").top is listed


@pytest.mark.seldom(13, first=12)
def test_the_command_says_what_a_setting_changes() -> None:
    small = ("--preset", "2006", "--size", "160x120", "--only", "sky,fog")
    done = landscape("trace", "fig35a", *small, "--diff-set", "fog.density=0.3")
    assert done.status == 0, done.err
    assert "~ glFogf(GL_FOG_DENSITY, 0.12) -> glFogf(GL_FOG_DENSITY, 0.3)" in done.out
    assert done.out.endswith("0 calls came (+), 0 went (-), 1 changed (~)\n")
    done = landscape("trace", "fig35a", *small, "--diff", "fig35b", "--json")
    found = json.loads(done.out)
    assert found.keys() == {"added", "removed", "changed"} and found["changed"]
    assert all(each.keys() == {"from", "to"} for each in found["changed"])
