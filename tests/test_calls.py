"""The seam: off, it is PyOpenGL itself; on, it records every call, the report's among them."""

import ast
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import OpenGL
import pytest
from seam import Replaced
from stage import SMALL, Stage, close, kind_in, small

from framelens.gl.context import open_context
from framelens.gl.notes import plain
from framelens.gl.replay import Replay
from framelens.gl.seam import Call, begin_pass, drawing, edited, gl, recording
from framelens.gl.state import attrib
from framelens.inspector.panel import Panel
from framelens.report.trace_text import as_text
from landscape.commands.target import ViewFrame
from landscape.course.grader.recorded import PLAYER
from landscape.elements.best.sea.sea import reflected
from landscape.elements.ground import clipped
from landscape.elements.reflection import inside_water, mirrored
from landscape.elements.water_surface import WaterSurface
from landscape.frame import Pose
from landscape.gl.display_list import DisplayList, call_lists
from landscape.gl.texture_target import TextureTarget
from landscape.island.island import ELEMENTS
from landscape.island.slots import SKY
from landscape.island.views import VIEWS
from landscape.offscreen import Offscreen

ROOT = Path(__file__).resolve().parents[1]


def test_when_off_the_seam_has_pyopengls_own_functions_and_constants(stage: Stage) -> None:
    import OpenGL.GL as original

    for name in ("glEnable", "glDrawElements", "glTexImage2D", "glClipPlane", "GL_EXP2", "GL_FOG"):
        assert getattr(gl, name) is getattr(original, name)
        assert gl.__dict__[name] is getattr(original, name), "looked up once, then an attribute"


def test_after_recording_the_seam_is_pyopengl_again(stage: Stage) -> None:
    import OpenGL.GL as original

    with recording():
        gl.glIsEnabled(gl.GL_FOG)
        assert gl.glIsEnabled is not original.glIsEnabled
    assert gl.glIsEnabled is original.glIsEnabled
    with pytest.raises(RuntimeError):
        with recording():
            raise RuntimeError
    assert gl.glIsEnabled is original.glIsEnabled


def test_names_unknown_to_opengl_are_missing_and_load_nothing() -> None:
    for name in ("__test__", "pytestmark", "enable"):
        assert not hasattr(gl, name)
    assert not hasattr(gl, "glNoSuchFunction")


def test_a_nested_recording_keeps_its_own_calls_and_then_hands_back(stage: Stage) -> None:
    with recording() as outer:
        gl.glIsEnabled(gl.GL_FOG)
        with recording() as inner:
            gl.glIsEnabled(gl.GL_BLEND)
        gl.glIsEnabled(gl.GL_LIGHTING)
    assert [call.shown for call in inner.calls] == [["GL_BLEND"]]
    assert [call.shown for call in outer.calls] == [["GL_FOG"], ["GL_LIGHTING"]]


def test_a_recorded_call_has_its_name_arguments_element_source_and_pass(
    stage: Stage, plain: Any
) -> None:
    settings = small()
    water = WaterSurface(settings, plain)
    with stage.frame(settings, Pose(20.0, 2.0, 20.0)) as frame:
        with recording() as recorder:
            begin_pass("main")
            with drawing("water"):
                water.draw(frame)

    water.release()
    blend = next(call for call in recorder.calls if call.name == "glBlendFunc")
    assert blend.shown == ["GL_SRC_ALPHA", "GL_ONE_MINUS_SRC_ALPHA"]
    assert (blend.element, blend.pass_) == ("water", "main")
    file, line = blend.source.split(":")
    assert file == "landscape/elements/water_surface.py"
    text = (ROOT / file).read_text(encoding="utf-8").splitlines()[int(line) - 1]
    assert "glBlendFunc" in text

    # A call in the gl rooms is told where the element asked for it.
    push = next(call for call in recorder.calls if call.name == "glPushAttrib")
    assert push.source.startswith("landscape/elements/water_surface.py:")
    assert "GL_LIGHTING_BIT" in push.shown[0] and "GL_ENABLE_BIT" in push.shown[0]


def test_the_contents_of_a_list_are_recorded_under_its_call(stage: Stage) -> None:
    with stage.borrowed(), recording() as recorder:
        owner = DisplayList(lambda: gl.glColor4f(1.0, 0.5, 0.25, 1.0))
        owner.call()
        owner.release()
    names = [call.name for call in recorder.calls]
    assert names == ["glGenLists", "glNewList", "glEndList", "glCallList", "glDeleteLists"]
    called = recorder.calls[3]
    assert [(call.name, call.shown) for call in called.listed] == [
        ("glColor4f", [1.0, 0.5, 0.25, 1.0])
    ]
    entry = called.as_json()
    assert entry["list"][0]["name"] == "glColor4f" and "list" not in entry["list"][0]


def test_the_drawing_block_names_the_element_and_the_innermost_wins(stage: Stage) -> None:
    @drawing("fog")
    def decorated() -> None:
        gl.glIsEnabled(gl.GL_FOG)

    with recording() as recorder:
        gl.glIsEnabled(gl.GL_FOG)
        with drawing("water"):
            gl.glIsEnabled(gl.GL_FOG)
            with drawing("trees", "deer"):
                gl.glIsEnabled(gl.GL_FOG)
            decorated()
            decorated()
            with pytest.raises(RuntimeError), drawing("castle"):
                raise RuntimeError
            gl.glIsEnabled(gl.GL_FOG)
        gl.glIsEnabled(gl.GL_FOG)
    named = [call.shared_by for call in recorder.calls]
    assert named == [
        ("frame",),
        ("water",),
        ("trees", "deer"),
        ("fog",),
        ("fog",),
        ("water",),
        ("frame",),
    ]
    assert recorder.calls[2].element == "trees"


def test_clipping_and_mirroring_own_their_calls_but_not_those_in_the_block(
    stage: Stage,
) -> None:
    settings = small()
    pose = Pose(20.0, 2.0, 20.0)
    with stage.frame(settings, pose) as frame, recording() as recorder, drawing("mine"):
        with reflected(frame, settings, None), mirrored(settings):
            gl.glIsEnabled(gl.GL_FOG)
        with clipped(0.5):
            gl.glIsEnabled(gl.GL_FOG)
        with inside_water(lambda: None):
            gl.glIsEnabled(gl.GL_FOG)

    named: dict[str, set[str]] = {}
    for call in recorder.calls:
        named.setdefault(call.name, set()).add(call.element)
    assert named["glIsEnabled"] == {"mine"}
    assert named["glClipPlane"] == {"ground"}
    assert (
        named["glMultMatrixf"] == named["glFrontFace"] == named["glStencilFunc"] == {"reflection"}
    )
    assert named["glPushMatrix"] == named["glPopMatrix"] == {"reflection"}
    assert named["glPushAttrib"] == named["glPopAttrib"] == {"reflection", "ground"}
    assert named["glLightfv"] == {"frame"}


def test_the_help_panel_names_its_calls(stage: Stage) -> None:
    panel = Panel("keys", [("W", "walk")])
    with stage.borrowed(), recording() as recorder:
        panel.draw(stage.size, keys=True)
    panel.release()
    assert {call.element for call in recorder.calls} == {"panel"}


def test_the_source_is_the_calling_file_even_outside_the_package(stage: Stage) -> None:
    with recording() as recorder:
        with attrib(gl.GL_ENABLE_BIT):
            gl.glIsEnabled(gl.GL_FOG)
    lines = Path(__file__).read_text(encoding="utf-8").splitlines()
    for call, wanted in zip(recorder.calls, ("attrib(", "glIsEnabled", "attrib("), strict=True):
        file, line = call.source.split(":")
        assert file == "test_calls.py" and wanted in lines[int(line) - 1]


def test_the_calls_of_a_list_compiled_before_the_recording_are_known(stage: Stage) -> None:
    import OpenGL.GL as original

    array = np.array([1.0, 0.5, 0.25, 1.0], np.float32)
    begin_pass("setup")
    with drawing("castle"):
        first = DisplayList(lambda: gl.glFogfv(gl.GL_FOG_COLOR, array))
    assert gl.glFogfv is original.glFogfv, "noting ends with the list"
    with drawing("rabbit"):
        second = DisplayList(lambda: (gl.glPointSize(2.0), first.call()))
    with stage.borrowed(), recording() as recorder, drawing("sky"):
        first.call()
        call_lists([first, second])
    one, several = recorder.calls
    [inner] = one.listed
    assert (inner.name, inner.element, inner.pass_) == ("glFogfv", "castle", "setup")
    assert inner.source.startswith("test_calls.py:")
    assert inner.args[1] is array, "a reference, not a copy"
    assert inner.shown[1]["values"] == array.tolist()
    assert [call.name for call in several.listed] == ["glFogfv", "glPointSize", "glCallList"]
    assert [call.name for call in several.listed[2].listed] == ["glFogfv"]
    assert (one.element, several.listed[1].element) == ("sky", "rabbit")
    second.release()
    first.release()


def test_a_failure_while_compiling_ends_the_list_and_its_recording(stage: Stage) -> None:
    import OpenGL.GL as original

    def fail() -> None:
        raise RuntimeError

    with pytest.raises(RuntimeError):
        DisplayList(fail)
    assert gl.glIsEnabled is original.glIsEnabled
    assert not gl.glGetIntegerv(gl.GL_LIST_INDEX)


def test_a_released_list_is_forgotten_and_its_number_may_be_used_again(stage: Stage) -> None:
    before = dict(stage.context.lists)
    owner = DisplayList(lambda: gl.glPointSize(2.0))
    number = owner.name
    assert set(stage.context.lists) == {*before, number}
    owner.release()
    owner.release()
    assert stage.context.lists == before
    with stage.borrowed(), recording() as recorder:
        gl.glCallList(number)
    assert not recorder.calls[0].listed
    gl.glNewList(number, gl.GL_COMPILE)
    gl.glEndList()
    gl.glDeleteLists(number, 1)


@pytest.mark.parametrize("through_another", [False, True])
def test_a_list_that_calls_itself_is_listed_once(through_another: bool, stage: Stage) -> None:
    first = gl.glGenLists(2)
    with stage.borrowed(), recording() as recorder:
        for name, other in ((first, first + through_another), (first + 1, first)):
            gl.glNewList(name, gl.GL_COMPILE)
            gl.glPointSize(2.0)
            gl.glCallList(other)
            gl.glEndList()
        gl.glCallList(first)
    calls, depth = recorder.calls[-1].listed, 0
    while calls:
        assert [call.name for call in calls] == ["glPointSize", "glCallList"]
        calls, depth = calls[-1].listed, depth + 1
    assert depth == 1 + through_another
    gl.glDeleteLists(first, 2)


def test_each_context_knows_its_own_lists(stage: Stage) -> None:
    mine = DisplayList(lambda: gl.glPointSize(2.0))
    other = open_context(stage.context.backend)
    try:
        theirs: list[DisplayList] = []
        while not theirs or theirs[-1].name < mine.name:
            theirs.append(DisplayList(lambda: gl.glPointSize(3.0)))
        assert theirs[-1].name == mine.name
        for context, size in ((other, 3.0), (stage.context, 2.0), (other, 3.0)):
            context.make_current()
            with stage.borrowed(), recording() as recorder:
                gl.glCallList(mine.name)
            assert [call.shown for call in recorder.calls[0].listed] == [[size]]
        theirs[-1].release()
    finally:
        other.release()
        stage.enter()

    with stage.borrowed(), recording() as recorder:
        mine.call()
    assert recorder.calls[0].listed, "released in the other context only"
    mine.release()


def test_an_array_shows_the_values_it_had_at_the_call(stage: Stage) -> None:
    colour = np.array([1.0, 0.0, 0.0, 1.0], np.float32)
    with stage.borrowed(), recording() as recorder:
        gl.glFogfv(gl.GL_FOG_COLOR, colour)
        colour[:] = 0.5
        gl.glFogfv(gl.GL_FOG_COLOR, colour)
    shown = [call.shown[1]["values"] for call in recorder.calls]
    assert shown == [[1.0, 0.0, 0.0, 1.0], [0.5, 0.5, 0.5, 0.5]]


def test_an_edit_changes_the_calls_that_a_list_compiles(stage: Stage) -> None:
    with edited(Replaced("glPointSize", (7.0,))):
        owner = DisplayList(lambda: gl.glPointSize(2.0))
    with stage.borrowed(), recording() as recorder:
        owner.call()
        size = gl.glGetFloatv(gl.GL_POINT_SIZE)
    owner.release()
    assert float(np.ravel(size)[0]) == 7.0
    inside = recorder.calls[0].listed[0]
    assert (inside.shown, inside.given) == ([7.0], (2.0,))


def test_a_nested_recording_hands_the_pass_back(stage: Stage) -> None:
    with recording() as outer:
        begin_pass("main")
        with recording() as inner:
            gl.glIsEnabled(gl.GL_FOG)
        gl.glIsEnabled(gl.GL_FOG)
    assert [call.pass_ for call in (*inner.calls, *outer.calls)] == ["setup", "main"]


def test_a_replay_is_split_where_the_framebuffer_changes_and_restores_the_seam(
    stage: Stage,
) -> None:
    target = TextureTarget((8, 8))
    plain = gl.glBindFramebuffer

    def draw() -> None:
        gl.glPointSize(1.0)
        with target.drawing():
            gl.glPointSize(2.0)
        gl.glPointSize(3.0)

    with stage.borrowed():
        replay = Replay(draw)
        assert gl.glBindFramebuffer is plain
        with recording() as recorder:
            replay.call()
        bound = int(gl.glGetIntegerv(gl.GL_FRAMEBUFFER_BINDING))
    names = [call.name for call in recorder.calls]
    assert names == ["glCallList", "glBindFramebuffer"] * 2 + ["glCallList"]
    sizes = [
        [inner.shown for inner in call.listed if inner.name == "glPointSize"]
        for call in recorder.calls
    ]
    assert sizes == [[[1.0]], [], [[2.0]], [], [[3.0]]]
    assert recorder.calls[1].args[1] != recorder.calls[3].args[1] == bound
    before = len(stage.context.lists)
    replay.release()
    replay.release()
    target.release()
    assert len(stage.context.lists) == before - 3

    def fail() -> None:
        raise RuntimeError

    with pytest.raises(RuntimeError):
        Replay(fail)
    assert gl.glBindFramebuffer is plain


def test_an_edit_changes_what_opengl_gets(stage: Stage) -> None:
    with edited(Replaced("glClearColor", (0.0, 1.0, 0.0, 1.0))), recording() as recorder:
        with stage.frame(small(), Pose(0.0, 0.0, 0.0)):
            picture = stage.read()
    assert close(picture, (0, 255, 0))
    call = next(call for call in recorder.calls if call.name == "glClearColor")
    assert call.shown == [0.0, 1.0, 0.0, 1.0] and call.given is not None
    with stage.frame(small(), Pose(0.0, 0.0, 0.0)):
        assert close(stage.read(), np.array([0.4, 0.6, 0.7]) * 255)


def test_an_edit_may_leave_a_call_out(stage: Stage) -> None:
    with stage.borrowed():
        gl.glPointSize(3.0)
        with edited(Replaced("glPointSize", None)), recording() as recorder:
            gl.glPointSize(9.0)
        size = gl.glGetFloatv(gl.GL_POINT_SIZE)
    assert float(np.ravel(size)[0]) == 3.0
    assert [call.skipped for call in recorder.calls] == [True]
    assert recorder.calls[0].as_json()["skipped"] is True


def test_with_edits_that_change_nothing_arguments_reach_opengl_as_they_are(stage: Stage) -> None:
    with edited(Replaced("glNoSuchCall", None)), recording() as recorder:
        gl.glIsEnabled(gl.GL_FOG)
    assert recorder.calls[0].given is None and not recorder.calls[0].skipped


def test_a_complete_recording_copies_what_a_draw_call_reads(stage: Stage) -> None:
    points = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], np.float32)
    with stage.borrowed(), recording(complete=True) as recorder:
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, points)
        gl.glDrawArrays(gl.GL_POINTS, 0, 2)
        points[1, 0] = 5.0
        gl.glDrawArrays(gl.GL_POINTS, 0, 2)
        gl.glDisableClientState(gl.GL_VERTEX_ARRAY)
        gl.glDrawArrays(gl.GL_POINTS, 0, 2)
    draws = [call.arrays for call in recorder.calls if call.name == "glDrawArrays"]
    names = ["glVertexPointer", "glEnableClientState"]
    assert [[name for name, _ in arrays] for arrays in draws] == [names, names, []]
    assert [float(arrays[0][1][3][1, 0]) for arrays in draws[:2]] == [1.0, 5.0]


def test_recording_changes_no_pixel(stage: Stage, plain: Any) -> None:
    settings, pose = small(), Pose(20.0, 1.0, 20.0, 30.0, 20.0)
    pictures = []
    for record in (False, True):
        sky = kind_in(SKY, settings)(settings, plain)
        with stage.frame(settings, pose, fog=True) as frame:
            if record:
                with recording():
                    sky.draw(frame)
            else:
                sky.draw(frame)
            pictures.append(stage.read())
        sky.release()
    assert (pictures[0] == pictures[1]).all()


def test_arguments_become_json() -> None:
    assert plain(np.float32(0.5)) == 0.5
    assert plain(None) is None and plain(3) == 3 and plain("text") == "text"
    assert plain(np.eye(2, dtype=np.float32)) == {
        "shape": [2, 2],
        "dtype": "float32",
        "values": [1.0, 0.0, 0.0, 1.0],
    }
    assert len(plain(np.zeros(500))["values"]) == 64
    assert plain(object()) == "object"


@pytest.mark.seldom(13, first=10)
def test_only_the_gl_rooms_import_opengl() -> None:
    found = set()
    for path in (*ROOT.glob("framelens/**/*.py"), *ROOT.glob("landscape/**/*.py")):
        text = path.read_text(encoding="utf-8")
        # The player is a program, too.
        looked_at = "OpenGL" in text and path != PLAYER
        for node in ast.walk(ast.parse(text)) if looked_at else ():
            names = [a.name for a in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and node.level == 0:
                names = [node.module or ""]
            if any(name.split(".")[0] in ("OpenGL", "OpenGL_accelerate") for name in names):
                found.add("/".join(path.relative_to(ROOT).parts[:3]))
    # The lessons and exercises are programs of their own, which nothing imports.
    programs = {f"landscape/course/{each}" for each in ("lessons", "exercises", "scaffold")}
    assert all(each.startswith("framelens/gl/") for each in found - programs)


def test_the_suite_itself_runs_with_pyopengls_checks_on() -> None:
    assert OpenGL.ERROR_CHECKING and OpenGL.ERROR_ON_COPY


def trace_view(view: str, preset: str, settings: dict[str, Any], **options: Any) -> list[Call]:
    """Return the calls of a view, small, those of the setup first."""
    target = ViewFrame(view, (320, 240), preset=preset, settings=settings, **options)
    return target.look(lambda tape: list(tape.calls))


def as_it_is(call: Call) -> dict[str, Any]:
    """Return a call without its number, which depends on what was called before the frame."""
    entry = call.as_json()
    del entry["call"]
    return entry


@pytest.mark.seldom(3, first=2)
def test_a_recording_of_running_islands_sees_inside_the_lists_of_each(
    stage: Stage, plain_folder: Path
) -> None:
    options = {"assets": plain_folder, "only": ("ground", "sky", "castle", "fog")}
    changes = [{**SMALL, "ground.resolution": points} for points in (20, 30)]
    wanted = [trace_view("fig35f", "2006", each, **options) for each in changes]
    with (
        Offscreen((64, 48), "2006", changes[0], **options) as first,
        Offscreen((64, 48), "2006", changes[1], **options) as second,
    ):
        for offscreen in (first, second):
            offscreen.look("fig35f")
            offscreen.draw()
        for offscreen, trace in zip((first, second), wanted, strict=True):
            with recording() as recorder:
                offscreen.draw()
            inside, traced = (
                [call.listed for call in calls if call.name == "glCallList"]
                for calls in (recorder.calls, trace)
            )
            assert inside and all(inside)
            assert [list(map(as_it_is, calls)) for calls in inside] == [
                list(map(as_it_is, calls)) for calls in traced
            ]

    stage.enter()


@pytest.fixture(scope="module")
def arrival() -> Iterator[list[Call]]:
    """The trace of fig35f, every element shown, in the preset 2006 with its 200,000 blades."""
    changes = {**SMALL, "grass.count": 200_000}
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(VIEWS, "fig35f", replace(VIEWS["fig35f"], shown=()))
        yield trace_view("fig35f", "2006", changes)


def drawn(trace: list[Call]) -> list[Call]:
    """Return the calls of the frame, those inside lists after the call that runs them."""
    flat: list[Call] = []
    for call in trace:
        if call.pass_ != "setup":
            flat += [call, *call.listed]
    return flat


def of(trace: list[Call], element: str, name: str) -> list[list[Any]]:
    """Return the arguments of an element's calls of one name."""
    shared = [c for c in drawn(trace) if element in c.shared_by or c.element == element]
    return [call.shown for call in shared if call.name == name]


def test_a_frame_with_200_000_blades_makes_fewer_than_400_calls(arrival: list[Call]) -> None:
    frame = [call for call in arrival if call.pass_ != "setup"]
    assert 100 < len(frame) < 400


def test_every_element_draws_in_the_arrival_at_the_castle(arrival: list[Call]) -> None:
    names = {name for call in drawn(arrival) for name in (call.element, *call.shared_by)}
    assert set(ELEMENTS) - {"mist"} <= names  # which lies there on request alone


def test_the_contents_of_a_list_belong_to_its_element(arrival: list[Call]) -> None:
    for call in arrival:
        if call.listed or call.name == "glNewList":
            assert call.element != "frame"
            assert {inner.element for inner in call.listed} <= {call.element}


def test_the_passes_come_in_order(arrival: list[Call]) -> None:
    passes = [call.pass_ for call in arrival]
    changes = [p for before, p in zip([None, *passes], passes) if p != before]  # noqa: B905
    assert changes == ["setup", "main", "reflection", "main", "overlay"]


def test_the_ground_is_one_list_with_two_texture_units(arrival: list[Call]) -> None:
    lists = [c for c in arrival if c.element == "ground" and c.name == "glCallList"]
    assert [call.pass_ for call in lists] == ["reflection", "main"]
    inside = [(call.name, call.shown) for call in lists[0].listed]
    assert ("glActiveTexture", ["GL_TEXTURE0"]) in inside
    assert ("glActiveTexture", ["GL_TEXTURE1"]) in inside
    assert ("glTexEnvi", ["GL_TEXTURE_ENV", "GL_TEXTURE_ENV_MODE", "GL_COMBINE"]) in inside
    assert [name for name, _ in inside].count("glDrawElements") == 1


def test_the_clip_plane_is_0_1_0_minus_the_level(arrival: list[Call]) -> None:
    planes = of(arrival, "ground", "glClipPlane")
    assert planes
    for plane, equation in planes:
        assert plane == "GL_CLIP_PLANE0"
        assert equation["values"] == [0.0, 1.0, 0.0, -0.6]


def test_the_mirror_matrix_is_sent_once_in_the_reflection(arrival: list[Call]) -> None:
    mirrors = [call for call in drawn(arrival) if call.name == "glMultMatrixf"]
    assert [call.pass_ for call in mirrors] == ["reflection"]
    values = mirrors[0].shown[0]["values"]
    assert values == np.diag([1.0, -1.0, 1.0, 1.0]).ravel().tolist()
    fronts = [call.shown for call in drawn(arrival) if call.name == "glFrontFace"]
    assert fronts == [["GL_CW"]]
    lights = [c for c in drawn(arrival) if c.name == "glLightfv" and "GL_POSITION" in c.shown]
    assert [call.pass_ for call in lights] == ["main", "reflection"]


def test_the_light_on_the_gate_is_multiplied(arrival: list[Call]) -> None:
    assert ["GL_ZERO", "GL_SRC_COLOR"] in of(arrival, "castle", "glBlendFunc")


def test_the_fog_is_exp2_of_0_12_in_the_reports_colour(arrival: list[Call]) -> None:
    assert of(arrival, "fog", "glFogi") == [["GL_FOG_MODE", "GL_EXP2"]]
    assert of(arrival, "fog", "glFogf") == [["GL_FOG_DENSITY", 0.12]]
    [[name, colour]] = of(arrival, "fog", "glFogfv")
    assert name == "GL_FOG_COLOR"
    assert colour["values"] == pytest.approx([0.4, 0.6, 0.7, 1.0])


def test_the_map_has_its_own_viewport_and_a_point_of_five_pixels(arrival: list[Call]) -> None:
    assert of(arrival, "map", "glViewport") == [[0, 180, 80, 60]]
    assert of(arrival, "map", "glOrtho") == [[-1, 1, -1, 1, 0.1, 2]]
    assert of(arrival, "map", "glPointSize") == [[5.0]]


def test_the_water_is_drawn_five_by_five_times(arrival: list[Call]) -> None:
    moves = of(arrival, "water", "glTranslatef")
    wanted = {(10.0 * kx, 0.0, 10.0 * kz) for kx in range(-1, 4) for kz in range(-1, 4)}
    assert {tuple(move) for move in moves} == wanted and len(moves) == 25
    assert ["GL_SRC_ALPHA", "GL_ONE_MINUS_SRC_ALPHA"] in of(arrival, "water", "glBlendFunc")


def test_all_sprites_share_one_draw_call_per_pass(arrival: list[Call]) -> None:
    draws = [c for c in arrival if "trees" in c.shared_by and c.name == "glDrawElements"]
    assert [call.pass_ for call in draws] == ["reflection", "main"]
    assert draws[0].shared_by == ("trees", "deer", "plants")
    assert draws[0].as_json()["shared_by"] == ["trees", "deer", "plants"]


def test_all_grass_goes_in_one_draw_call(arrival: list[Call]) -> None:
    counts = [shown[1] for shown in of(arrival, "grass", "glDrawElements")]
    assert len(counts) == 1 and counts[0] % 9 == 0 and counts[0] > 9 * 1000


def test_rabbit_dragon_sky_and_sword_are_lists(arrival: list[Call]) -> None:
    for element, times in (("rabbit", 1), ("dragon", 2), ("sky", 2), ("sword", 1), ("map", 1)):
        assert len(of(arrival, element, "glCallList")) == times, element


def test_what_is_pushed_is_popped(arrival: list[Call]) -> None:
    names = [call.name for call in drawn(arrival)]
    assert names.count("glPushMatrix") == names.count("glPopMatrix") > 10
    assert names.count("glPushAttrib") == names.count("glPopAttrib") > 10


def test_the_text_of_a_trace_has_one_line_per_call_and_indents_lists(arrival: list[Call]) -> None:
    lines = list(as_text(arrival))
    assert len(lines) == sum(1 + len(call.listed) for call in arrival)
    fog = next(line for line in lines if "glFogi(" in line)
    assert "glFogi(GL_FOG_MODE, GL_EXP2)" in fog and "landscape/elements/fog.py:" in fog
    assert any("   glDrawElements(GL_TRIANGLES" in line for line in lines)
