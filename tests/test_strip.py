"""A frame growing: its steps, what its buffers hold after each, and the files that show them."""

import base64
import html.parser
import io
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from commands import Shell, landscape, need_library, refused
from PIL import Image
from stage import SMALL_BEST, Stage

from framelens.base.errors import InputError
from framelens.gl.framebuffer import read_pixels
from framelens.gl.seam import begin_pass, drawing, gl, recording, unnoted
from framelens.report.strip import Request, checked_out, make
from framelens.report.strip_pictures import LAYERS, Tones, stencil_color
from framelens.state import state
from framelens.tape.buffers import Buffers
from framelens.tape.pixel import history
from framelens.tape.strip import BUFFERS, Shot, groups, shared_values, shots
from framelens.tape.tape import Tape
from landscape.commands.target import ViewFrame
from landscape.offscreen import Offscreen

SIZE = (160, 120)


def strip(tape: Tape, by: str, buffers: tuple[str, ...] = ("color",)) -> list[Shot]:
    parts = groups(tape, by)
    return list(shots(tape, parts, buffers, shared_values(tape, parts, buffers)))


def color(shot: Shot) -> np.ndarray:
    found = shot.buffers["color"]
    assert found is not None
    return found


@dataclass
class Seen:
    """What was learned of one view's frame while its context was open."""

    frame: np.ndarray
    last: dict[str, Shot]
    elements: list[Shot]
    passes: list[str]
    calls: list[str]
    every: list[str]
    passed: dict[tuple[int, int], int]
    replayed: np.ndarray


def seen(preset: str, view: str) -> Seen:
    random = np.random.default_rng(7)
    few = {"grass.count": 20000} if preset == "2006" else SMALL_BEST
    with Offscreen(SIZE, preset, few, samples=0) as offscreen:
        with offscreen.taped(view) as tape:
            frame = read_pixels(SIZE)
            found = {by: strip(tape, by, BUFFERS) for by in ("pass", "element", "draw")}
            passed = {}
            for x, y in random.integers(0, SIZE, (4, 2)).tolist():
                passed[x, y] = sum(
                    row.parts.get("fragments", 1)
                    for row in history(tape, x, y)
                    if row.outcome in ("drawn", "masked") and row.call.name != "glClear"
                )
            tape.replay()
            return Seen(
                frame,
                {by: shots[-1] for by, shots in found.items()},
                found["element"],
                [shot.group.pass_ for shot in found["pass"]],
                [step.place for shot in found["draw"] for step in shot.group.steps],
                [step.place for step in tape.steps() if step.place],
                passed,
                read_pixels(SIZE),
            )


@pytest.fixture(scope="module")
def plain_view() -> Seen:
    return seen("2006", "fig35f")


@pytest.fixture(scope="module")
def best_view() -> Seen:
    return seen("best", "fig35f")


@pytest.fixture(params=["plain_view", "best_view"])
def view(request: pytest.FixtureRequest) -> Seen:
    return request.getfixturevalue(request.param)


@pytest.mark.sweep(12, first=11)
def test_the_last_picture_is_the_frame_and_nothing_is_changed_by_looking(view: Seen) -> None:
    for by, last in view.last.items():
        assert np.array_equal(color(last), view.frame), by
    assert np.array_equal(view.replayed, view.frame)


@pytest.mark.seldom(10, first=8)
def test_layers_are_the_fragments_that_occlusion_queries_count(view: Seen) -> None:
    for by, last in view.last.items():
        layers = last.buffers["overdraw"]
        assert layers is not None and layers.max() > 3
        assert {(x, y): layers[y, x] for x, y in view.passed} == view.passed, by


def test_steps_are_the_elements_in_the_order_in_which_they_draw(plain_view: Seen) -> None:
    found = [(shot.group.pass_, shot.group.elements) for shot in plain_view.elements]
    assert found[0] == ("main", []), "the clear"
    assert found[1] == ("reflection", ["ground"])
    assert ("main", ["castle"]) in found
    assert found[-1] == ("overlay", ["map"])
    assert plain_view.passes == ["main", "reflection", "main", "overlay"]


@pytest.mark.sweep(10)
def test_each_call_belongs_to_one_step(view: Seen) -> None:
    assert view.calls == view.every


def test_what_is_drawn_into_another_framebuffer_is_one_step_with_that_ones_picture(
    best_view: Seen,
) -> None:
    aside = [shot for shot in best_view.elements if shot.group.aside]
    assert len(aside) == 1 and {"ground", "sky"} <= set(aside[0].group.elements)
    mirror = color(aside[0])
    assert mirror.std() > 10, "a picture of the land upside down"
    assert mirror.shape[:2] != SIZE[::-1]
    assert aside[0].buffers["overdraw"] is None
    position = best_view.elements.index(aside[0])
    before, after = (color(best_view.elements[position + k]) for k in (-1, 1))
    assert before.shape == after.shape == (*SIZE[::-1], 3)


Taped = Callable[[], None]


@pytest.fixture
def taped(stage: Stage) -> Iterator[Callable[[Taped], Tape]]:
    """Tapes what a function draws on the stage, in a projection where x and y are -1 to 1."""
    with stage.borrowed():
        size = stage.read().shape[1::-1]
        start = state.read()

        def tape(draw: Taped) -> Tape:
            before = Buffers.read(size)
            gl.glViewport(0, 0, *size)
            begun = state.read()
            with recording(complete=True) as recorder:
                begin_pass("main")
                draw()
            return Tape(recorder.calls, 0, begun, size, before=before)

        yield tape
        with unnoted():
            state.restore(start)


def quad(left: float = -1.0, z: float = 0.0) -> None:
    gl.glBegin(gl.GL_QUADS)
    for x, y in ((left, -1), (1, -1), (1, 1), (left, 1)):
        gl.glVertex3f(x, y, z)
    gl.glEnd()


def clear() -> None:
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)


def test_layers_count_what_passes_whatever_blending_fog_or_colour_mask(
    taped: Callable[[Taped], Tape],
) -> None:
    def draw() -> None:
        clear()
        quad()
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_ZERO, gl.GL_ONE)
        quad(0.0)
        gl.glEnable(gl.GL_FOG)
        gl.glFogi(gl.GL_FOG_MODE, gl.GL_EXP2)
        quad(0.0)
        gl.glColorMask(False, False, False, False)
        quad(0.0)
        gl.glEnable(gl.GL_ALPHA_TEST)
        gl.glAlphaFunc(gl.GL_LESS, 0.5)
        quad()
        gl.glDisable(gl.GL_ALPHA_TEST)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDepthFunc(gl.GL_LESS)
        quad(z=0.5)
        quad(z=0.75)

    tape = taped(draw)
    found = strip(tape, "draw", BUFFERS)
    middle, width = tape.size[1] // 2, tape.size[0]
    layers = [shot.buffers["overdraw"] for shot in found]
    assert [int(each[middle, width // 4]) for each in layers if each is not None] == [
        *(0, 1, 1, 1, 1, 1, 2, 2)
    ]
    assert [int(each[middle, 3 * width // 4]) for each in layers if each is not None] == [
        *(0, 1, 2, 3, 4, 4, 5, 5)
    ]


def test_depth_becomes_the_distance_from_the_eye_by_the_projection_in_force(
    taped: Callable[[Taped], Tape],
) -> None:
    def draw() -> None:
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glLoadIdentity()
        gl.glFrustum(-0.1, 0.1, -0.1, 0.1, 0.1, 50.0)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        clear()
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glScalef(100.0, 100.0, 1.0)
        quad(z=-20.0)
        quad(0.0, z=-2.0)

    tape = taped(draw)
    parts = groups(tape, "pass")
    found = shared_values(tape, parts, ("depth",))
    (shot,) = shots(tape, parts, ("depth",), found)
    depth = shot.buffers["depth"]
    assert depth is not None and found.depths is not None
    middle, width = tape.size[1] // 2, tape.size[0]
    left, right = depth[middle, width // 4], depth[middle, 3 * width // 4]
    assert found.lens.distance(left) == pytest.approx(20.0, rel=1e-3)
    assert found.lens.distance(right) == pytest.approx(2.0, rel=1e-3)

    tones = Tones(found, "en")
    grey = np.asarray(tones.picture("depth", depth))
    assert grey[middle, width // 4, 0] > grey[middle, 3 * width // 4, 0], "near is dark"
    legend = tones.legend("depth")
    assert legend is not None
    shown = {label: tone[0] for tone, label in legend.entries}
    assert list(shown) == ["2", "5", "10", "20", "nothing"]
    assert shown["20"] == grey[middle, width // 4, 0] and shown["nothing"] == 255


def test_stencil_values_and_layers_have_the_tones_of_their_legend(
    taped: Callable[[Taped], Tape],
) -> None:
    def draw() -> None:
        clear()
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilOp(gl.GL_REPLACE, gl.GL_REPLACE, gl.GL_REPLACE)
        gl.glStencilFunc(gl.GL_ALWAYS, 3, 255)
        with drawing("marks"):
            quad(0.0)

    tape = taped(draw)
    parts = groups(tape, "element")
    assert [part.elements for part in parts] == [[], ["marks"]]
    found = shared_values(tape, parts, BUFFERS)
    shot = list(shots(tape, parts, BUFFERS, found))[-1]
    tones = Tones(found, "fr")
    middle, width = tape.size[1] // 2, tape.size[0]
    tone = {}
    for name in ("stencil", "overdraw"):
        buffer = shot.buffers[name]
        assert buffer is not None
        tone[name] = np.asarray(tones.picture(name, buffer))[middle, 3 * width // 4]
    assert tuple(tone["stencil"]) == stencil_color(3)
    assert tuple(tone["overdraw"]) == LAYERS[1][1]
    legend = tones.legend("stencil")
    assert legend is not None
    assert [label for _, label in legend.entries] == ["0", "3"], "the values present"
    assert tones.layers(shot) == "0,50 couches par pixel, au plus 1"


def test_a_program_that_never_clears_keeps_what_was_there(taped: Callable[[Taped], Tape]) -> None:
    gl.glClearColor(0.2, 0.4, 0.6, 1.0)
    clear()
    tape = taped(lambda: quad(0.0))
    last = strip(tape, "draw", BUFFERS)[-1]
    middle, width = tape.size[1] // 2, tape.size[0]
    assert color(last)[middle, width // 4].tolist() == [51, 102, 153]


def test_a_quad_of_a_display_list_is_split_as_it_was(taped: Callable[[Taped], Tape]) -> None:
    names = []

    def draw() -> None:
        clear()
        names.append(gl.glGenLists(1))
        gl.glNewList(names[0], gl.GL_COMPILE)
        gl.glBegin(gl.GL_QUADS)
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            # Along one diagonal the quad is white, or else along the other one it is black.
            gl.glColor3f(*(3 * [float(x == y)]))
            gl.glVertex3f(x, y, 0.0)
        gl.glEnd()
        gl.glEndList()
        gl.glCallList(names[0])

    tape = taped(draw)
    frame = read_pixels(tape.size)
    assert np.array_equal(color(strip(tape, "draw")[-1]), frame)
    with unnoted():
        gl.glDeleteLists(names[0], 1)


SMALL = ViewFrame("fig35e", SIZE, preset="2006", only=("ground", "sky", "trees"))


@pytest.mark.seldom(10, first=2)
def test_a_sheet_an_animation_and_a_page_show_every_step(tmp_path: Path) -> None:
    steps = ["clear", "ground", "sky", "trees"]
    buffers = ("color", "depth")
    for suffix in ("png", "gif", "html"):
        make(SMALL, Request(buffers=buffers), tmp_path / f"a.{suffix}")
    with Image.open(tmp_path / "a.png") as sheet:
        assert sheet.width >= 2 * 320 and np.asarray(sheet)[0, 0].tolist() == [255, 255, 255]
    with Image.open(tmp_path / "a.gif") as animation:
        assert animation.n_frames == len(steps) and animation.info["loop"] == 0

    page = (tmp_path / "a.html").read_text(encoding="utf-8")
    read = Page()
    read.feed(page)
    assert not read.open and "script" not in read.tags and read.outside == []
    assert re.findall(r"</span>(\w+)</h2>", page) == steps
    assert len(read.pictures) == 2 * len(steps)
    with Offscreen(SIZE, "2006", samples=0, only=SMALL.only) as offscreen:
        offscreen.look("fig35e")
        frame = offscreen.draw()
    with Image.open(io.BytesIO(read.pictures[-2])) as last:
        assert np.array_equal(np.asarray(last), frame), "the last picture is the frame"
    assert "landscape/elements/sky_box.py:" in page and "glBegin(GL_QUADS)" in page


class Page(html.parser.HTMLParser):
    """Reads a page: tags, pictures, and addresses outside of it."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: set[str] = set()
        self.open: list[str] = []
        self.pictures: list[bytes] = []
        self.outside: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        if tag not in ("meta", "img", "br"):
            self.open.append(tag)
        for name, value in attrs:
            if name in ("src", "href") and value:
                kind, _, data = value.partition(";base64,")
                if kind == "data:image/png":
                    self.pictures.append(base64.b64decode(data))
                elif not value.startswith("#"):
                    self.outside.append(value)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("a.jpg", "expected a name that ends in .png, .gif or .html"),
        ("folder.png", "expected a file, found a folder"),
        ("file/a.png", "can(not)? be written"),
    ],
)
def test_outputs_that_cannot_be_written_are_refused(tmp_path: Path, name: str, words: str) -> None:
    (tmp_path / "folder.png").mkdir()
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match=words):
        checked_out(tmp_path / name, "fig35e")


@pytest.mark.seldom(3, first=2)
def test_more_pictures_than_a_sheet_can_show_are_refused_in_one_line(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("framelens.report.strip.MOST", {".png": 3, ".gif": 5, ".html": 5})
    with pytest.raises(InputError, match=r"4 pictures .* --out FILE\.gif or --out FILE\.html"):
        make(SMALL, Request(), tmp_path / "a.png")
    with pytest.raises(InputError, match=r"8 pictures .* fewer --buffers"):
        make(SMALL, Request(buffers=("color", "depth")), tmp_path / "a.gif")
    assert list(tmp_path.iterdir()) == []


def test_a_frame_that_draws_nothing_has_no_steps(taped: Callable[[Taped], Tape]) -> None:
    assert groups(taped(lambda: gl.glEnable(gl.GL_FOG)), "draw") == []


@pytest.mark.seldom(13, first=6)
def test_the_command_writes_by_default_beside_the_user_and_refuses_what_it_does_not_know(
    tmp_path: Path,
) -> None:
    shell = Shell()
    try:
        shell.cwd = tmp_path
        common = ("--only", "sky", "--size", "80x60", *shell.small)
        done = shell("strip", "fig35a", "--by", "pass", "--lang", "fr", *common)
        assert (done.status, done.out, done.err) == (0, "fig35a-strip.png\n", "")
        assert [path.name for path in tmp_path.iterdir()] == ["fig35a-strip.png"]
        refused(shell("strip", "fig35a", "--by", "call"), "--by", "pass", "element", "draw")
        refused(shell("strip", "fig35a", "--buffers", "color,alpha"), "'alpha'", "overdraw")
        refused(shell("strip", "nowhere"), "nowhere")
        refused(shell("strip", "fig35a", "--out", "x.mp4"), "x.mp4", ".html")
    finally:
        shell.close()
    assert len(list(tmp_path.iterdir())) == 1


@pytest.mark.seldom(10, first=4)
def test_osmesa_and_egl_give_the_same_sheet(tmp_path: Path) -> None:
    need_library("OSMesa", "EGL")
    common = ("--preset", "2006", "--only", "sky,trees", "--size", "80x60")
    for backend in ("osmesa", "egl"):
        options = ("--backend", backend, "--buffers", ",".join(BUFFERS), *common)
        done = landscape("strip", "fig35e", *options, "--out", tmp_path / f"{backend}.png")
        assert done.status == 0, done.err
    assert (tmp_path / "osmesa.png").read_bytes() == (tmp_path / "egl.png").read_bytes()
