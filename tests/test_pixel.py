"""Pixel history: every draw that covered a pixel, and the arithmetic of what it did."""

import json
import re
from collections.abc import Iterator

import numpy as np
import pytest
from commands import landscape, need_library
from stage import SMALL_BEST, Stage

from framelens.base.errors import InputError
from framelens.gl.framebuffer import read_pixels
from framelens.gl.seam import gl, recording, unnoted
from framelens.state import state
from framelens.tape.pixel import Row, history
from framelens.tape.tape import Tape
from landscape.offscreen import Offscreen

SIZE = (160, 120)
VIEWS = {"2006": ("fig35a", "fig35e", "fig35f", "fig35g"), "best": ("fig35e",)}
FEW = {"2006": {}, "best": SMALL_BEST | {"trees.count": 700, "grass.count": 20_000}}


def result_of(row: Row) -> np.ndarray:
    """Return the colour that a row's arithmetic ends with, 0 to 255."""
    numbers = re.findall(r"= \(([^)]*)\)", row.arithmetic)[-1].split(",")
    return np.array([float(number) for number in numbers]) * 255


@pytest.mark.parametrize("preset", ["2006", "best"])
@pytest.mark.sweep(14, first=1)
def test_the_history_ends_with_the_frames_pixel_and_its_arithmetic_is_right(preset: str) -> None:
    random = np.random.default_rng(35)
    outcomes = set()
    with Offscreen(SIZE, preset, FEW[preset], samples=0) as offscreen:
        for view in VIEWS[preset]:
            with offscreen.taped(view) as tape:
                frame = read_pixels(SIZE)
                for _ in range(8):
                    x, y = int(random.integers(SIZE[0])), int(random.integers(SIZE[1]))
                    rows = history(tape, x, y)
                    assert rows[-1].pixel.color[:3] == tuple(frame[y, x]), (view, x, y)
                    for row in rows:
                        outcomes.add(row.outcome)
                        if row.outcome == "drawn":
                            off = np.abs(result_of(row) - row.pixel.color[:3]).max()
                            assert off <= 1.0, (view, x, y, row)
                        elif row.outcome in ("alpha", "stencil", "depth"):
                            assert "fails" in row.arithmetic
                # Asking has changed nothing.
                tape.replay()
                assert np.array_equal(read_pixels(SIZE), frame), view

    assert {"drawn", "depth"} <= outcomes


@pytest.fixture
def tests_at_one_pixel(stage: Stage) -> Iterator[list[Row]]:
    """The history of a pixel that six quads cover: five fail a test each, the last is blended."""

    def quad(alpha: float, z: float = 0.0) -> None:
        gl.glBegin(gl.GL_QUADS)
        gl.glColor4f(1.0, 0.5, 0.25, alpha)
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            gl.glVertex3f(x, y, z)
        gl.glEnd()

    with stage.borrowed():
        size = stage.read().shape[1::-1]
        start = state.read()
        with recording(complete=True) as recorder:
            gl.glViewport(0, 0, *size)
            for matrix in (gl.GL_PROJECTION, gl.GL_MODELVIEW):
                gl.glMatrixMode(matrix)
                gl.glLoadIdentity()
            gl.glClearColor(0.0, 0.0, 1.0, 1.0)
            gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
            gl.glClipPlane(gl.GL_CLIP_PLANE0, np.array([0.0, 0.0, 1.0, -2.0]))
            gl.glEnable(gl.GL_CLIP_PLANE0)
            quad(1.0)
            gl.glDisable(gl.GL_CLIP_PLANE0)
            gl.glEnable(gl.GL_SCISSOR_TEST)
            gl.glScissor(0, 0, 1, 1)
            quad(1.0)
            gl.glDisable(gl.GL_SCISSOR_TEST)
            gl.glEnable(gl.GL_ALPHA_TEST)
            gl.glAlphaFunc(gl.GL_GREATER, 0.5)
            quad(0.25)
            gl.glDisable(gl.GL_ALPHA_TEST)
            gl.glEnable(gl.GL_STENCIL_TEST)
            gl.glStencilFunc(gl.GL_EQUAL, 1, 255)
            quad(1.0)
            gl.glDisable(gl.GL_STENCIL_TEST)
            gl.glEnable(gl.GL_DEPTH_TEST)
            gl.glDepthFunc(gl.GL_GREATER)
            quad(1.0)
            gl.glDepthFunc(gl.GL_LESS)
            gl.glColorMask(False, False, False, False)
            quad(1.0, 0.5)
            gl.glColorMask(True, True, True, True)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            quad(0.25)

        with unnoted():
            rows = history(Tape(recorder.calls, 0, start, size), size[0] // 2, size[1] // 2)
            state.restore(start)
        yield rows


def test_each_test_that_a_fragment_fails_is_named_with_its_numbers(
    tests_at_one_pixel: list[Row],
) -> None:
    rows = tests_at_one_pixel
    outcomes = [row.outcome for row in rows]
    assert outcomes == ["drawn", "clip", "scissor", "alpha", "stencil", "depth", "masked", "drawn"]
    texts = {row.outcome: row.arithmetic for row in rows}
    assert texts["clip"] == "behind GL_CLIP_PLANE0"
    assert texts["alpha"] == "alpha 0.250 GL_GREATER 0.500: fails"
    assert texts["stencil"] == "reference 1 GL_EQUAL 0 in the stencil buffer: fails"
    assert texts["depth"] == "depth 0.500000 GL_GREATER 1.000000: fails"
    assert rows[-2].pixel.depth == pytest.approx(0.75), "masked, but its depth is written"


def test_a_blended_fragment_shows_both_terms(tests_at_one_pixel: list[Row]) -> None:
    last = tests_at_one_pixel[-1]
    assert last.arithmetic == (
        "0.251 x (1.000, 0.502, 0.251) + 0.749 x (0.000, 0.000, 1.000) = (0.2510, 0.1260, 0.8120)"
    )
    assert last.pixel.color[:3] == (64, 32, 207)


def four(*values: float) -> np.ndarray:
    return np.array(values, np.float32)


def lit_rows(stage: Stage, light: tuple[float, ...]) -> list[Row]:
    """Return the history of a pixel of a quad that a light at ``light`` lights."""
    with stage.borrowed():
        size = stage.read().shape[1::-1]
        start = state.read()
        with recording(complete=True) as recorder:
            gl.glViewport(0, 0, *size)
            for matrix in (gl.GL_PROJECTION, gl.GL_MODELVIEW):
                gl.glMatrixMode(matrix)
                gl.glLoadIdentity()
            gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)

            gl.glEnable(gl.GL_LIGHTING)
            gl.glEnable(gl.GL_LIGHT0)
            gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, four(0.1, 0.1, 0.1, 1.0))
            gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, four(*light))
            gl.glLightfv(gl.GL_LIGHT0, gl.GL_AMBIENT, four(0.0, 0.2, 0.0, 1.0))
            gl.glLightf(gl.GL_LIGHT0, gl.GL_CONSTANT_ATTENUATION, 2.0)
            gl.glMaterialfv(gl.GL_FRONT, gl.GL_AMBIENT, four(0.5, 0.5, 0.5, 1.0))
            gl.glMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE, four(1.0, 0.5, 0.25, 1.0))
            gl.glMaterialfv(gl.GL_FRONT, gl.GL_EMISSION, four(0.0, 0.0, 0.2, 1.0))

            gl.glBegin(gl.GL_QUADS)
            gl.glNormal3f(0.6, 0.0, 0.8)
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                gl.glVertex3f(x, y, 0.0)
            gl.glEnd()
        with unnoted():
            rows = history(Tape(recorder.calls, 0, start, size), size[0] // 2, size[1] // 2)
            state.restore(start)
    return rows


def test_lighting_is_spelled_out_by_light_and_share(stage: Stage) -> None:
    row = lit_rows(stage, (0.0, 0.0, 1.0, 0.0))[-1]
    lighting = row.parts["lighting"]
    assert lighting["emission"] == pytest.approx([0.0, 0.0, 0.2], abs=2e-3)
    assert lighting["scene_ambient"] == pytest.approx([0.05] * 3, abs=2e-3)
    (light,) = lighting["lights"]
    assert light["n_l"] == pytest.approx(0.8, abs=2e-3)
    assert light["ambient"] == pytest.approx([0.0, 0.1, 0.0], abs=2e-3), "no attenuation: w is 0"
    assert light["diffuse"] == pytest.approx([0.8, 0.4, 0.2], abs=2e-3)
    assert light["specular"] == pytest.approx([0.0] * 3, abs=2e-3)
    assert lighting["result"] == pytest.approx([0.85, 0.55, 0.45], abs=2e-3)
    assert "diffuse (0.800, 0.400, 0.200) by N.L 0.800 + specular" in row.arithmetic


def test_the_arithmetic_of_lighting_says_that_a_light_is_near_or_behind(stage: Stage) -> None:
    near = lit_rows(stage, (0.0, 0.0, 50.0, 1.0))[-1]
    assert near.parts["lighting"]["lights"][0]["attenuation"] == pytest.approx(0.5, abs=2e-3)
    assert "and attenuation 0.500" in near.arithmetic
    behind = lit_rows(stage, (0.0, 0.0, -1.0, 0.0))[-1]
    assert "by N.L 0.000, the light is behind the surface" in behind.arithmetic


def test_a_pixel_outside_is_refused_in_one_line() -> None:
    with Offscreen(SIZE, "2006", samples=0, only=("sky",)) as offscreen:
        with offscreen.taped("fig35a") as tape:
            with pytest.raises(InputError, match=r"pixel 160,0: expected .* 0,0 to 159,119"):
                history(tape, 160, 0)


@pytest.mark.seldom(10, first=1)
def test_the_command_prints_json_with_the_fields_of_the_contract() -> None:
    done = landscape("pixel", "fig35e", "80,60", "--preset", "2006", "--size", "160x120", "--json")
    assert done.status == 0, done.err
    rows = json.loads(done.out)
    wanted = {"call", "name", "element", "source", "pass", "outcome", "arithmetic", "color"}
    assert rows and all({*wanted, "depth", "stencil"} <= row.keys() for row in rows)
    assert all(isinstance(row["call"], int) and len(row["color"]) == 4 for row in rows)
    done = landscape("pixel", "fig35e", "80;60")
    assert done.status == 2 and "expected X,Y such as 400,300" in done.err


@pytest.mark.seldom(10, first=1)
def test_the_history_is_the_same_through_osmesa_and_egl() -> None:
    need_library("OSMesa", "EGL")
    words = ("pixel", "fig35e", "80,60", "--preset", "2006", "--size", "160x120", "--json")
    done = [landscape(*words, "--backend", backend) for backend in ("osmesa", "egl")]
    assert done[0].status == done[1].status == 0 and done[0].out == done[1].out
