"""The Python face: what it accepts, what it refuses, and what becomes of a dropped Offscreen.

A wrong argument of any type is an InputError of one line that names the argument, as on the command
line; a value that Python or numpy users would expect to work does.
"""

import re
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import python, small_textures
from stage import Stage

import landscape
from framelens.base.errors import short
from framelens.gl.framebuffer import Framebuffer
from landscape.frame import Pose
from landscape.settings import declare

NAN, INF = float("nan"), float("inf")
HUGE = 10**400
SIZE = (32, 24)
QUICK = {"size": SIZE, "preset": "2006", "only": ("ground",), "samples": 0}


@pytest.fixture(scope="module")
def view(the_stage: Stage) -> Iterator[landscape.Offscreen]:
    with landscape.Offscreen(**QUICK, settings={"ground.resolution": 20}) as view:
        view.look((20, 3, 24))
        yield view
    the_stage.enter()


def line(error: BaseException) -> str:
    """Return the text of an error, which must be one short line."""
    text = str(error)
    assert "\n" not in text and len(text) < 300, text
    return text


def name(value: Any) -> str:
    """Return a name for a test's value that is the same in every process."""
    return re.sub(r" at 0x\w+", "", short(value))[:50]


# --- arguments of an Offscreen -----------------------------------------------------------------


class Hostile:
    """An object whose text cannot be had."""

    def __repr__(self) -> str:
        raise RuntimeError("no")


REFUSED: dict[str, list[Any]] = {
    "size": [None, 640, "big", "640x480", (640,), (640, 480, 3), (0, 10), (10, -1), (NAN, 10)]
    + [(640.0, 480.0), (True, True), ("640", "480"), (HUGE, 10), (16385, 10), (INF, 1), b"ab"]
    + [{640, 480}, {"width": 640}, np.zeros((2, 2), int), np.array([6.5, 4.5]), Hostile()],
    "preset": ["", "1996", "BEST", 2006, True, NAN, ["best"], b"best", {"best": 1}, Hostile()],
    "backend": ["", "metal", "OSMesa", None, 0, ["osmesa"], ("egl", "glfw"), b"egl", Hostile()],
    "samples": [None, -4, 1, 2, 8, HUGE, True, False, 4.0, NAN, "4", "", [4], (0, 4), Hostile()],
    "seed": [None, -1, 1.0, 0.5, NAN, INF, True, False, "7", "", 10**18, HUGE, [7], Hostile()],
    "only": ["moat", "", "ground,,water", 5, 0, True, NAN, ("ground", "moat"), [None], [1, 2]]
    + [(("ground",),), b"ground", Hostile(), np.array([1, 2]), np.array(5), np.array(None)],
    "edits": [5, "", [], {}, [5], np.zeros(3), b"edits", True, Hostile()],
    "world": [5, True, b"/tmp", "a\0b", Hostile()],
    "assets": ["/nowhere", __file__, 5, True, NAN, b"/tmp", ["/tmp"], "a\0b", "\ud800", Hostile()],
    "settings": ["fog.density=1", 5, True, [("fog.density", 1)], ["fog.density"], {5: 1}, {None: 1}]
    + [{"fog": {5: 1}}, {("fog", "density"): 1}, Hostile()],
}


@pytest.mark.parametrize(
    ("argument", "value"),
    [(argument, value) for argument, values in REFUSED.items() for value in values],
    ids=name,
)
def test_a_wrong_argument_is_refused_by_its_name(argument: str, value: Any) -> None:
    with pytest.raises(landscape.InputError) as caught:
        landscape.Offscreen(**{**QUICK, argument: value})
    text = line(caught.value)
    assert text.startswith(argument) and "expected" in text, text


def test_a_class_that_forgets_to_open_its_context_is_told() -> None:
    class Forgetful(landscape.Offscreen):
        def __init__(self) -> None:
            pass

    view = Forgetful()
    for use in (view.draw, lambda: view.look("fig35a"), lambda: view.renderer):
        with pytest.raises(landscape.InputError, match="is closed"):
            use()
    view.close()


def test_an_argument_that_does_not_exist_is_python_s_own_error() -> None:
    with pytest.raises(TypeError, match="presets"):
        landscape.render("fig35a", presets="best")


@pytest.mark.parametrize(
    "change",
    [
        {"fog.density": NAN},
        {"fog.density": -INF},
        {"fog.density": True},
        {"fog.density": None},
        {"fog.density": 1j},
        {"fog.density": HUGE},
        {"fog.density": [0.05]},
        {"fog.density": {"x": 1}},
        {"fog.density": np.float32(NAN)},
        {"fog.density": np.array([0.05, 0.06])},
        {"fog.density": b"0.05"},
        {"fog.density": "thick"},
        {"fog.density": Hostile()},
        {"fog": {"density": "thick"}},
        {"fog": {"density": {"x": 1}}},
        {"fog.enabled": 1},
        {"fog.enabled": None},
        {"fog.enabled": np.float64(1)},
        {"fog.mode": np.int64(1)},
        {"fog.mode": ["exp"]},
        {"fog.color": np.array([0.1, 0.2])},
        {"fog.color": np.array([[0.1, 0.2, 0.3]])},
        {"fog.color": np.array([0.1, NAN, 0.3])},
        {"fog.color": {0.1, 0.2, 0.3}},
        {"fog.color": 0.5},
        {"fog.color": [True, 0, 0]},
        {"grass.count": 2.5},
        {"grass.count": Fraction(5, 2)},
        {"grass.count": np.float64(2.5)},
        {"grass.count": -1},
        {"grass.count": HUGE},
        {"grass.count": -HUGE},
        {"grass.count": 10**5000},
        {"grass.count": np.array([])},
        {"ground.height_image": 5},
        {"ground.height_image": ""},
        {"ground.height_image": "a\0b"},
        pytest.param(
            {"ground.height_image": "\ud800.png"},
            marks=pytest.mark.posix_only("any text may name a file there"),
        ),
        {"ground.height_image": Path("a\0b")},
        {"ground.height_image": b"height.png"},
        {"moat.depth": 1},
        {"moat": {"depth": 1}},
        {"fog": 1},
        {"": 1},
        {"..": 1},
        {"fog..density": 1},
        {"\ud800": 1},
    ],
    ids=name,
)
def test_a_wrong_setting_is_refused_by_its_key(change: dict[str, Any]) -> None:
    (key, value), *_ = change.items()
    with pytest.raises(landscape.InputError) as caught:
        landscape.Offscreen(**QUICK, settings=change)
    text = line(caught.value)
    wanted = f"{key}.{next(iter(value))}" if isinstance(value, dict) and "." not in key else key
    assert text.startswith("setting ") and repr(wanted)[1:-1] in text, text


@pytest.mark.parametrize(
    ("given", "key", "value"),
    [
        ({"fog": {"density": 0.05}}, "fog.density", 0.05),
        ({"fog": {"density": 0.05}, "fog.density": 0.06}, "fog.density", 0.06),
        ({"fog.density": np.float64(0.05)}, "fog.density", 0.05),
        ({"fog.density": np.array(0.05)}, "fog.density", 0.05),
        ({"fog.density": Fraction(1, 4)}, "fog.density", 0.25),
        ({"fog.density": "0.05"}, "fog.density", 0.05),
        ({"fog.enabled": np.bool_(False)}, "fog.enabled", False),
        ({"fog.color": np.array([0.25, 0.5, 1.0])}, "fog.color", (0.25, 0.5, 1.0)),
        ({"fog.color": [np.float32(0.25), 0.5, 1]}, "fog.color", (0.25, 0.5, 1.0)),
        ({"grass.count": np.int32(7)}, "grass.count", 7),
        ({"grass.count": 7.0}, "grass.count", 7),
        ({"rabbit.mesh": Path("rabbit.ply")}, "rabbit.mesh", "rabbit.ply"),
    ],
    ids=str,
)
@pytest.mark.sweep(4)
def test_settings_may_be_nested_and_values_numpys(
    given: dict[str, Any], key: str, value: Any, the_stage: Stage
) -> None:
    with landscape.Offscreen(**QUICK, settings=given) as view:
        view.look((20, 3, 24))
        found = declare.get(view.scene.settings, key)
        assert found == value and type(found) is type(value)
    the_stage.enter()


@pytest.mark.sweep(5)
@pytest.mark.parametrize(
    "given",
    [
        {"size": [32, 24]},
        {"size": np.array([32, 24])},
        {"size": (np.int16(32), np.uint8(24))},
        {"samples": np.int64(0)},
        {"seed": np.uint32(2006)},
        {"seed": np.array(2006)},
        {"only": "ground"},
        {"only": " ground , ground "},
        {"only": ["ground"]},
        {"only": {"ground": 1}},
        {"only": np.array(["ground"])},
        {"only": iter(["ground"])},
        {"assets": Path(__file__).parent},
        {"assets": str(Path(__file__).parent)},
        {"settings": None},
        {"settings": {}},
    ],
    ids=name,
)
def test_an_argument_in_any_usual_form_gives_the_same_picture(
    given: dict[str, Any], plain_picture: np.ndarray, the_stage: Stage
) -> None:
    with landscape.Offscreen(**{**QUICK, **given}) as view:
        view.look((20, 3, 24))
        picture = view.draw()
    the_stage.enter()
    assert picture.shape == (24, 32, 3) and (picture == plain_picture).all()


@pytest.fixture(scope="module")
def plain_picture(the_stage: Stage) -> np.ndarray:
    with landscape.Offscreen(**QUICK) as view:
        view.look((20, 3, 24))
        picture = view.draw()
    the_stage.enter()
    return picture


def test_no_elements_at_all_are_an_empty_picture(the_stage: Stage) -> None:
    with landscape.Offscreen(**{**QUICK, "only": ()}) as view:
        view.look("fig35a")
        picture = view.draw()
    the_stage.enter()
    assert (picture == picture[0, 0]).all()


def test_a_size_beyond_this_opengl_is_refused(stage: Stage) -> None:
    with pytest.raises(landscape.InputError, match="size 16385x10: expected from 1x1 to"):
        Framebuffer((16385, 10))


# --- look, draw and render ---------------------------------------------------------------------

PLACES: list[Any] = [None, 5, NAN, True, b"fig35a", {"x": 1}, {1, 2, 3}, object(), Hostile()]
PLACES += ["", "fig99z", "FIG35A", "fig35a ", "\ud800", "two\nlines", "x" * 500]
POSES: list[Any] = [
    *[(), (20,), (20, 1), (20, 1, 20, 0, 0, 0), (NAN, 1, 20), (20, INF, 20), (20, NAN, 20)],
    *[(20, 1, 20, -INF), (20, 1, 20, 0, NAN), ("20", 1, 20), (20, "sea", 20), ("ground", 1, 20)],
    *[(20, 1, "ground"), (None, 1, 20), (20, 1, None), (20, 1, 20, None, 0), (True, 1, 20)],
    *[(20, False, 20), (HUGE, 1, 20), (20, -HUGE, 20), (1e9, 1, 20), (1j, 1, 20), ((20,), 1, 20)],
    *[[], ["fig35a"], np.zeros(2), np.zeros(6), np.zeros((1, 5)), np.zeros((5, 1)), np.array(5.0)],
    *[np.array([20, NAN, 20]), np.array([True, False, True]), np.array([1j, 2, 3])],
    *[np.array(["20", "1", "20"]), Pose(NAN, 1, 20), Pose(20, "sea", 20), Pose(20, True, 20)],
    *[Pose(20, 1, 20, "north"), Pose(20, 1, 20, 0, None), (20, Hostile(), 20)],
]


@pytest.mark.parametrize("place", PLACES + POSES, ids=name)
def test_a_wrong_place_is_refused_by_look_and_by_render(
    place: Any, view: landscape.Offscreen
) -> None:
    for attempt in (view.look, landscape.render):
        with pytest.raises(landscape.InputError) as caught:
            attempt(place)
        text = line(caught.value)
        assert text.startswith(("view ", "pose ")), text


@pytest.mark.parametrize(
    "place",
    [
        (20, "ground", 24, 30, -5),
        [20, None, 24, 30, -5],
        [20.0, "ground", np.float32(24), np.int8(30), -5],
        np.array([20, None, 24, 30, -5], object),
        Pose(20, None, 24, 30, -5),
        Pose(20, "ground", 24, 30, -5),  # type: ignore[arg-type]
    ],
    ids=str,
)
def test_a_pose_may_be_a_tuple_a_list_or_an_array_and_stand_on_the_ground(
    place: Any, view: landscape.Offscreen
) -> None:
    view.look(place)
    ground = view.scene.height(20.0, 24.0)
    assert view.moment.pose == Pose(20.0, pytest.approx(ground + 0.1), 24.0, 30.0, -5.0)
    assert view.draw().shape == (24, 32, 3)


@pytest.mark.parametrize("place", [(20, 3, 24), np.array([20, 3, 24]), np.array([20.0, 3, 24, 0])])
def test_yaw_and_pitch_are_0_by_default(place: Any, view: landscape.Offscreen) -> None:
    view.look(place)
    assert view.moment.pose == Pose(20.0, 3.0, 24.0, 0.0, 0.0)


@pytest.mark.parametrize(
    "kt",
    [NAN, INF, -INF, 1e9, HUGE, True, "40", "", [40], (40,), 1j, np.array([1, 2]), Hostile()]
    + [np.bool_(True), np.float32(NAN), np.datetime64("2006-12-01"), np.array("40"), b"40"],
    ids=name,
)
def test_a_wrong_kt_is_refused_everywhere(kt: Any, view: landscape.Offscreen) -> None:
    for attempt in (
        lambda: view.look("fig35a", kt),
        lambda: view.draw(kt),
        lambda: view.submit(kt),
        lambda: landscape.render("fig35a", SIZE, kt),
    ):
        with pytest.raises(landscape.InputError) as caught:
            attempt()
        assert line(caught.value).startswith("kt ")


@pytest.mark.parametrize("kt", [40, 40.0, np.float32(40), np.int8(40), np.array(40), Fraction(40)])
def test_kt_may_be_any_real_number(kt: Any, view: landscape.Offscreen) -> None:
    view.look((20, 3, 24), kt)
    assert view.moment.kt == 40.0 and type(view.moment.kt) is float
    assert view.draw(kt).shape == (24, 32, 3)


@pytest.mark.parametrize(
    "value", [None, 0, 1, "", "yes", NAN, [], np.array([True, False]), Hostile()]
)
def test_wireframe_must_be_true_or_false(value: Any, view: landscape.Offscreen) -> None:
    for attempt in (view.look, landscape.render):
        with pytest.raises(landscape.InputError) as caught:
            attempt("fig35a", wireframe=value)
        assert line(caught.value).startswith("wireframe ")


def test_render_draws_lines_if_asked(the_stage: Stage) -> None:
    lines, filled = (
        np.array(landscape.render((20, 3, 24, 0, -40), **QUICK, wireframe=wire))
        for wire in (np.bool_(True), False)
    )
    the_stage.enter()
    assert (lines != filled).any()


def test_a_refused_call_changes_nothing(view: landscape.Offscreen) -> None:
    view.look((20, 3, 24))
    before, moment = view.draw(), view.moment
    for wrong in (lambda: view.look("fig99z"), lambda: view.look((20, NAN, 24))):
        with pytest.raises(landscape.InputError):
            wrong()
    with pytest.raises(landscape.InputError):
        view.look("fig35a", wireframe="yes")
    assert view.moment is moment and (view.draw() == before).all()


def test_a_frame_can_be_drawn_or_submitted_before_the_first_look(the_stage: Stage) -> None:
    with landscape.Offscreen(**QUICK) as drawn, landscape.Offscreen(**QUICK) as submitted:
        submitted.submit()
        assert (drawn.draw() == submitted.draw()).all()
    the_stage.enter()


# --- several at once, closed, dropped ----------------------------------------------------------


def test_a_closed_offscreen_says_so_whatever_is_asked_of_it(the_stage: Stage) -> None:
    closed = landscape.Offscreen(**QUICK)
    closed.look("fig35a")
    closed.close()
    closed.close()
    for attempt in (
        lambda: closed.look("fig35a"),
        closed.draw,
        closed.submit,
        lambda: closed.renderer,
        closed.__enter__,
    ):
        with pytest.raises(landscape.InputError, match="this Offscreen is closed"):
            attempt()
    the_stage.enter()


START = """
import gc, sys, threading
import numpy as np
import landscape

backend = sys.argv[1]
options = {"size": (64, 48), "preset": "2006", "only": "ground,sky,fog", "samples": 0}

def opened(view="fig35a", **more):
    made = landscape.Offscreen(**{**options, "backend": backend, **more})
    made.look(view)
    made.draw()
    return made

def in_a_thread(work):
    thread = threading.Thread(target=work)
    thread.start()
    thread.join()

kept = opened()
right = kept.draw()
assert right.std() > 5
def good():
    return bool((kept.draw() == right).all())
"""

DROPS = {
    "while another is current": "one = opened('fig35b'); del one",
    "before the first look": "one = landscape.Offscreen(**options, backend=backend); del one",
    "in a reference cycle": "one = opened('fig35b'); one.me = one; del one; gc.collect()",
    "in another thread": "box = [opened('fig35b')]; in_a_thread(box.clear)",
    "closed in another thread": "one = opened('fig35b'); in_a_thread(one.close); one.close()",
    "by a thread that opened it and ended": "in_a_thread(opened)",
    "after its thread ended": "box = []; in_a_thread(lambda: box.append(opened())); box.clear()",
    "closed after its thread ended": (
        "box = []; in_a_thread(lambda: box.append(opened())); box[0].close()"
    ),
    "while another draws": """
before = gc.get_threshold()
gc.set_threshold(50)
one = opened('fig35b'); one.me = one; del one
assert good()
gc.set_threshold(*before)
""",
    "by an error on opening": """
try:
    opened(settings={"ground.height_image": "none.png"})
except landscape.InputError:
    pass
""",
}


@pytest.mark.parametrize("backend", ["osmesa", "egl"])
@pytest.mark.seldom(13, first=3)
def test_an_offscreen_can_be_dropped_at_any_moment(backend: str) -> None:
    steps = [f"{code}\nassert good(), {name!r}" for name, code in DROPS.items()]
    done = python("\n".join([START, *steps, "print('good')"]), backend)
    if "NoOpenGLError" in done.err:
        pytest.skip(f"no {backend} on this machine")
    assert (done.status, done.out, done.err) == (0, "good\n", "")


@pytest.mark.seldom(13, first=5)
def test_what_is_open_at_the_end_of_a_program_ends_with_it_silently() -> None:
    code = "one = opened(); two = opened('fig35c'); two.me = two; sys.modules['late'] = opened()"
    done = python(START + code, "auto")
    assert (done.status, done.out, done.err) == (0, "", "")


MEMORY = """
import resource, sys
import landscape

def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024

for number in range(20):
    view = landscape.Offscreen((640, 480), "2006", only="ground", assets=sys.argv[1])
    view.draw()
    if number == 3:
        before = peak()
print(peak() - before)
"""


@pytest.mark.posix_only("Python does not tell there how much memory a process takes")
@pytest.mark.seldom(14, first=5)
def test_twenty_dropped_offscreens_take_no_more_memory_than_a_few(tmp_path: Path) -> None:
    small_textures(tmp_path)
    done = python(MEMORY, str(tmp_path))
    assert done.status == 0 and done.err == ""
    assert float(done.out) < 40.0, "MB; the targets of the last sixteen have about 12 MB each"


@pytest.mark.seldom(13, first=5)
def test_threads_with_an_offscreen_each_draw_what_one_alone_draws() -> None:
    code = (
        START
        + """
from concurrent.futures import ThreadPoolExecutor
views = ["fig35a", "fig35b"] * 3
alone = [np.array(landscape.render(view, **options)) for view in views]
with ThreadPoolExecutor(3) as pool:
    many = pool.map(lambda view: np.array(landscape.render(view, **options)), views)
    print(all((a == b).all() for a, b in zip(alone, many)))
errors = []
def use():
    for attempt in (kept.draw, kept.submit, lambda: kept.look("fig35b"), lambda: kept.renderer):
        try:
            attempt()
        except landscape.InputError as error:
            errors.append(str(error))
in_a_thread(use)
print(len(errors), set(errors), good())
"""
    )
    done = python(code, "auto")
    said = "this Offscreen belongs to another thread: open one in each thread"
    assert (done.status, done.out, done.err) == (0, f"True\n4 {{{said!r}}} True\n", "")
