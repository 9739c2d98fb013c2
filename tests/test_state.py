"""The classic state is read whole, set again on any context, and compared."""

import json
import re
from collections.abc import Callable

import numpy as np
import pytest
from commands import environment, need_library, python
from state_calls import CHANGES, Expected, Fresh, scrambled
from test_backends import screen  # noqa: F401

from framelens.gl.framebuffer import Framebuffer
from framelens.gl.raw import end_primitive, raw
from framelens.gl.seam import gl, recording
from framelens.state.state import DEFAULTS, StateError, changed, difference, read, restore

# What depends on the window and on the OpenGL.
WINDOW = {"GL_VIEWPORT", "GL_SCISSOR_BOX", "GL_DRAW_BUFFER", "GL_READ_BUFFER", "GL_POINT_SIZE_MAX"}

# Set by tests of their own, below; only read; has a single legal value.
NOT_IN_CHANGES = re.compile(
    "GL_(DRAW|READ)_FRAMEBUFFER_BINDING|GL_RENDERBUFFER_BINDING|GL_VERTEX_ARRAY_BINDING"
    "|.*_STACK(_DEPTH)?|GL_(RENDER_MODE|(SELECTION|FEEDBACK)_BUFFER_(SIZE|TYPE|POINTER))"
    "|GL_SAMPLES_PASSED.GL_CURRENT_QUERY|GL_CURRENT_PROGRAM|GL_SECONDARY_COLOR_ARRAY_SIZE"
)


# Opens a backend, reads the state, and prints what differs from the initial state.
FRESH = """
import json, sys
from framelens.state.state import DEFAULTS, difference, read
from framelens.gl.context import open_context
from framelens.gl.contexts.glfw import GLFWContext
from framelens.gl.raw import raw

if sys.argv[1] == "bare":
    import glfw
    glfw.init()
    original = glfw.window_hint
    glfw.window_hint = lambda hint, value: original(
        hint, 0 if hint in (glfw.DEPTH_BITS, glfw.STENCIL_BITS) else value
    )
    context = GLFWContext()
elif sys.argv[1] == "null":
    context = GLFWContext(backend="headless")
else:
    context = open_context(sys.argv[1])
found = read()
print(json.dumps([difference(DEFAULTS, found), raw.glGetError()]))
"""


@pytest.mark.seldom(13, first=4)
@pytest.mark.parametrize("backend", ["osmesa", "egl", "null", "glfw", "bare"])
def test_a_fresh_context_has_the_initial_values_of_the_specification(
    backend: str, request: pytest.FixtureRequest
) -> None:
    on_screen = backend in ("glfw", "bare")
    need_library({"egl": "EGL", "glfw": "GL", "bare": "GL"}.get(backend, "OSMesa"))
    env = request.getfixturevalue("screen") if on_screen else None
    done = python(FRESH, backend, env=env)
    assert done.status == 0, done.err
    found, error = json.loads(done.out)
    assert set(found) <= WINDOW, found
    assert found["GL_VIEWPORT"][1][2:] > [0, 0]
    assert error == 0


RESTORED = """
from framelens.state.state import changed, difference, read, restore
from framelens.gl.seam import gl
from framelens.gl.context import open_context
from framelens.gl.raw import raw

context = open_context("auto")
initial = read()
assert changed(initial) == {}
gl.glStencilFunc(gl.GL_LESS, 3, 15)
gl.glStencilMask(3)
gl.glStencilOp(gl.GL_KEEP, gl.GL_INCR, gl.GL_DECR)
gl.glBlendEquation(gl.GL_MAX)
other = read()
assert len(difference(initial, other)) >= 7
for state in (initial, other):
    restore(state)
    assert difference(state, read()) == {}
assert raw.glGetError() == 0
print(len(initial))
"""


@pytest.mark.seldom(10, first=1)
def test_an_older_opengl_has_fewer_variables_and_is_read_and_restored() -> None:
    """Mesa plays an older version by this variable; elsewhere it has no effect."""
    counts = []
    for version in ("1.5", "2.1", "4.5COMPAT"):
        done = python(RESTORED, env=environment(MESA_GL_VERSION_OVERRIDE=version))
        assert done.status == 0, done.err
        counts.append(int(done.out))
    assert counts == sorted(counts)


CORE = """
import glfw

glfw.init()
glfw.window_hint(glfw.VISIBLE, False)
glfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, 3)
glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, 3)
glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)
window = glfw.create_window(16, 16, "", None, None)
glfw.make_context_current(window)
from framelens.state.state import StateError, read
from framelens.gl.raw import raw

try:
    read()
except StateError as error:
    print(error, raw.glGetError())
"""


@pytest.mark.seldom(3)
@pytest.mark.window
def test_a_core_profile_is_refused(screen: dict[str, str]) -> None:  # noqa: F811
    done = python(CORE, env=screen)
    said = "a core profile has no fixed function: only trace looks into it 0\n"
    assert done.out == said, done.err


@pytest.mark.parametrize("change", CHANGES, ids=lambda change: change.__name__)
def test_a_call_changes_the_variables_it_is_documented_to_change_and_no_others(
    fresh: Fresh, change: Callable[[np.random.Generator], Expected]
) -> None:
    fresh()
    rng = np.random.default_rng(1)
    for _ in range(3):
        before = read()
        expected = change(rng)
        after = read()
        assert {name: after[name] for name in expected} == expected
        assert set(difference(before, after)) <= set(expected)


@pytest.mark.seldom(13, first=4)
def test_every_variable_is_changed_by_some_call(fresh: Fresh) -> None:
    fresh()
    rng, seen = np.random.default_rng(2), set()
    for _ in range(12):
        for change in CHANGES:
            change(rng)
            seen |= set(difference(DEFAULTS, read()))

    def numberless(name: str) -> str:
        """A light, a unit and a plane stand for the others of their kind."""
        return re.sub(r"^(GL_LIGHT|GL_TEXTURE|GL_CLIP_PLANE)\d", r"\1", name)

    kinds = {numberless(name) for name in DEFAULTS if not NOT_IN_CHANGES.fullmatch(name)}
    assert kinds - {numberless(name) for name in seen} == set()


@pytest.mark.parametrize("seed", range(4))
def test_a_random_state_is_restored_on_a_fresh_context(fresh: Fresh, seed: int) -> None:
    fresh()
    scrambled(seed)
    state = read()
    assert len(changed(state)) > 300
    fresh()
    restore(state)
    assert difference(state, read()) == {}
    assert int(gl.glGetError()) == 0


def test_a_random_state_is_restored_on_a_context_in_another_random_state(fresh: Fresh) -> None:
    first = fresh()
    initial = read()
    scrambled(5)
    state = read()
    scrambled(6)
    restore(state)
    assert difference(state, read()) == {}
    restore(initial)
    assert difference(initial, read()) == {}
    first.make_current()


def test_a_state_written_as_json_is_restored(fresh: Fresh) -> None:
    fresh()
    scrambled(7)
    state = json.loads(json.dumps(read()))
    fresh()
    restore(state)
    assert difference(state, read()) == {}


def test_a_part_of_a_state_leaves_the_rest_alone(fresh: Fresh) -> None:
    fresh()
    scrambled(8)
    before = read()
    restore({"GL_FOG_DENSITY": 0.25, "GL_LIGHT3.GL_POSITION": [1.0, 2.0, 3.0, 1.0]})
    assert set(difference(before, read())) == {"GL_FOG_DENSITY", "GL_LIGHT3.GL_POSITION"}


def test_reading_changes_nothing_fetches_no_error_and_is_not_recorded(fresh: Fresh) -> None:
    fresh()
    scrambled(9)
    with recording() as recorder:
        states = [read() for _ in range(3)]
    assert recorder.calls == []
    assert states[0] == states[1] == states[2]
    raw.glEnable(0)  # an error that the program may still ask for
    read()
    assert raw.glGetError() == int(gl.GL_INVALID_ENUM)
    assert raw.glGetError() == 0


def test_the_state_is_read_in_a_few_milliseconds(fresh: Fresh) -> None:
    """As the number of calls, which no other load on the machine changes."""
    fresh()
    from framelens.state import state_reading

    todo = state_reading.plan()
    queries = sum(map(len, todo.steps.values())) + sum(map(len, todo.flags.values()))
    assert queries < 1000


def test_attributes_that_are_pushed_are_read_and_restored_with_their_masks(fresh: Fresh) -> None:
    fresh()
    scrambled(10)
    below = read()
    masks = [int(gl.GL_FOG_BIT | gl.GL_LIGHTING_BIT), int(gl.GL_ALL_ATTRIB_BITS)]
    client = [int(gl.GL_CLIENT_ALL_ATTRIB_BITS)]
    middle: list[dict] = []
    for mask in masks:
        gl.glPushAttrib(mask)
        scrambled(mask % 97, 30)
        middle.append(read())

    gl.glPushClientAttrib(client[0])
    scrambled(11, 30)
    plain = read()
    state = read(masks, client)
    assert read() == plain, "reading what was pushed leaves the state as it is"
    fresh()
    restore(state)
    assert difference(plain, read()) == {}
    assert read(masks, client) == state
    gl.glPopClientAttrib()
    gl.glPopAttrib()
    popped = read()
    for name in ("GL_FOG_DENSITY", "GL_BLEND_COLOR", "GL_LIGHT0.GL_POSITION"):
        assert popped[name] == middle[0][name]
    gl.glPopAttrib()
    popped = read()
    for name in ("GL_FOG_DENSITY", "GL_FOG_COLOR", "GL_LIGHT0.GL_POSITION", "GL_SHADE_MODEL"):
        assert popped[name] == below[name]


def test_masks_that_do_not_match_the_pushes_are_refused(fresh: Fresh) -> None:
    fresh()
    gl.glPushAttrib(gl.GL_FOG_BIT)
    with pytest.raises(StateError, match=r"GL_ATTRIB_STACK_DEPTH is 1, and 2 masks were given"):
        read([1, 2])


def test_restoring_closes_what_half_a_frame_leaves_open(fresh: Fresh) -> None:
    fresh()
    for mode in (gl.GL_PROJECTION, gl.GL_TEXTURE, gl.GL_MODELVIEW):
        gl.glMatrixMode(mode)
        gl.glPushMatrix()
        gl.glRotatef(90.0, 0.0, 0.0, 1.0)

    state = read()
    gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
    gl.glPushAttrib(gl.GL_FOG_BIT)
    gl.glPushClientAttrib(gl.GL_CLIENT_PIXEL_STORE_BIT)
    gl.glEnable(gl.GL_FOG)
    for _ in range(4):
        gl.glPushMatrix()
        gl.glTranslatef(1.0, 2.0, 3.0)
    restore(state)
    assert read() == state
    gl.glPopMatrix()
    restore(state)
    assert read() == state
    gl.glNewList(7, gl.GL_COMPILE)
    gl.glBegin(gl.GL_TRIANGLES)
    restore(state)
    assert read() == state
    gl.glBegin(gl.GL_TRIANGLES)
    restore(state)
    assert read() == state
    assert int(gl.glGetError()) == 0
    # Between glBegin and glEnd PyOpenGL asks for no errors; now it must again.
    from OpenGL.error import GLError

    with pytest.raises(GLError, match="invalid enumerant"):
        gl.glEnable(0)


def test_pushes_that_are_missing_are_made_and_save_nothing(fresh: Fresh) -> None:
    fresh()
    gl.glPushAttrib(gl.GL_FOG_BIT)
    gl.glPushClientAttrib(gl.GL_CLIENT_PIXEL_STORE_BIT)
    state = read()
    fresh()
    restore(state)
    assert read() == state
    gl.glEnable(gl.GL_FOG)
    gl.glPopAttrib()
    assert gl.glIsEnabled(gl.GL_FOG)


def test_the_state_is_not_read_inside_a_primitive_or_a_display_list(fresh: Fresh) -> None:
    fresh()
    gl.glNewList(3, gl.GL_COMPILE)
    with pytest.raises(StateError, match="display list 3 is compiled"):
        read()
    gl.glEndList()
    gl.glBegin(gl.GL_POINTS)
    with pytest.raises(StateError, match="between glBegin and glEnd"):
        read()
    end_primitive()


def test_framebuffers_are_bound_again_with_their_buffers(fresh: Fresh) -> None:
    context = fresh()
    window = read()
    target = Framebuffer((8, 8))
    gl.glDrawBuffer(gl.GL_NONE)
    buffer = int(gl.glGenRenderbuffers(1))
    gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, buffer)
    drawn = read()
    assert drawn["GL_DRAW_FRAMEBUFFER_BINDING"] == drawn["GL_READ_FRAMEBUFFER_BINDING"] > 0
    assert drawn["GL_RENDERBUFFER_BINDING"] == buffer
    assert (drawn["GL_DRAW_BUFFER"], drawn["GL_READ_BUFFER"]) == ("GL_NONE", "GL_COLOR_ATTACHMENT0")
    restore(window)
    assert read() == window
    restore(drawn)
    assert read() == drawn
    fresh()
    with pytest.raises(StateError, match="no such framebuffer here"):
        restore(drawn)
    context.make_current()
    target.release()


def test_an_array_of_arrays_is_bound_again(fresh: Fresh) -> None:
    fresh()
    before = read()
    name = int(gl.glGenVertexArrays(1))
    gl.glBindVertexArray(name)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    inside = read()
    assert inside["GL_VERTEX_ARRAY_BINDING"] == name
    restore(before)
    assert read() == before
    restore(inside)
    assert read() == inside


def test_selection_feedback_and_queries_are_begun_and_ended(fresh: Fresh) -> None:
    fresh()
    before = read()
    pointers = {"GL_SELECTION_BUFFER_POINTER", "GL_FEEDBACK_BUFFER_POINTER"}

    hits = np.zeros(64, np.uint32)
    gl.glSelectBuffer(64, hits)
    gl.glRenderMode(gl.GL_SELECT)
    gl.glPushName(4)
    selecting = read()
    assert selecting["GL_RENDER_MODE"] == "GL_SELECT"
    assert selecting["GL_NAME_STACK_DEPTH"] == 1
    assert selecting["GL_SELECTION_BUFFER_SIZE"] == 64

    restore(before)
    assert set(difference(before, read())) <= pointers
    restore(selecting)
    assert set(difference(selecting, read())) <= pointers
    restore(before)

    answers = np.zeros(32, np.float32)
    gl.glFeedbackBuffer(32, gl.GL_3D_COLOR, answers)
    gl.glRenderMode(gl.GL_FEEDBACK)
    feeding = read()
    assert feeding["GL_FEEDBACK_BUFFER_TYPE"] == "GL_3D_COLOR"
    restore(before)
    restore(feeding)
    assert set(difference(feeding, read())) <= pointers
    restore(before)

    query = 5
    gl.glBeginQuery(gl.GL_SAMPLES_PASSED, query)
    counting = read()
    assert counting["GL_SAMPLES_PASSED.GL_CURRENT_QUERY"] == query
    restore(before)
    assert set(difference(before, read())) <= pointers
    restore(counting)
    assert set(difference(counting, read())) <= pointers
    restore(before)


def test_what_changed_leaves_out_what_depends_on_the_window(fresh: Fresh) -> None:
    fresh()
    assert changed(read()) == {}
    gl.glViewport(0, 0, 300, 200)
    gl.glFogf(gl.GL_FOG_DENSITY, 0.5)
    assert changed(read()) == {"GL_FOG_DENSITY": [1.0, 0.5]}
    gl.glScissor(0, 0, 30, 20)
    gl.glEnable(gl.GL_SCISSOR_TEST)
    assert set(changed(read())) == {"GL_FOG_DENSITY", "GL_SCISSOR_TEST", "GL_SCISSOR_BOX"}
    gl.glViewport(10, 0, 300, 200)
    assert "GL_VIEWPORT" in changed(read())
    found = changed(read(), (300, 200))
    assert found["GL_VIEWPORT"] == [[0, 0, 300, 200], [10, 0, 300, 200]]


def test_a_difference_names_what_only_one_state_has() -> None:
    assert difference({"A": 1, "B": [2]}, {"B": [2], "C": True}) == {
        "A": [1, None],
        "C": [None, True],
    }
