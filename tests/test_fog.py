"""Fog: the specification's formula of the depth, on flat quads."""

import math

import numpy as np
import pytest
from stage import Stage, close, quad, small

from framelens.gl import extensions
from framelens.gl.seam import gl
from landscape.elements.fog import visibility
from landscape.frame import Pose

FOG = np.array([0.4, 0.6, 0.7]) * 255
COLOUR = np.array([1.0, 0.5, 0.0])
DEPTHS = (0.5, 2.0, 5.0, 8.0, 12.0, 25.0)


def at_depth(stage: Stage, depth: float, fog: bool = True, **changes) -> np.ndarray:
    """Return the middle pixel of a quad ``depth`` units in front of the camera."""
    settings = small({f"fog.{key}": value for key, value in changes.items()})
    side = depth * 0.3
    corners = [(-side, -side), (side, -side), (side, side), (-side, side)]
    with stage.frame(settings, Pose(0.0, 0.0, 0.0), fog=fog):
        gl.glColor4f(*COLOUR, 1.0)
        quad(np.array([(x, y, -depth) for x, y in corners]))
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        return np.asarray(stage.read()[60, 80])


def mixed(part: float) -> np.ndarray:
    return part * COLOUR * 255 + (1 - part) * FOG


def test_the_visibility_at_some_depths_is_that_computed_by_hand() -> None:
    # 0.12 * 5 = 0.6, exp(-0.36) = 0.697676; 0.12 * 8 = 0.96, exp(-0.9216) = 0.397882
    assert visibility(np.array([0.0, 5.0, 8.0]), 0.12) == pytest.approx([1.0, 0.697676, 0.397882])


@pytest.mark.parametrize("depth", DEPTHS)
def test_exp2_fog_leaves_exp_of_minus_density_times_depth_squared(
    stage: Stage, depth: float
) -> None:
    assert close(at_depth(stage, depth), mixed(math.exp(-((0.12 * depth) ** 2))), 2)


@pytest.mark.parametrize("depth", DEPTHS)
def test_exp_fog_leaves_exp_of_minus_density_times_depth(stage: Stage, depth: float) -> None:
    got = at_depth(stage, depth, mode="exp", density=0.2)
    assert close(got, mixed(math.exp(-0.2 * depth)), 2)


@pytest.mark.parametrize("depth", DEPTHS)
def test_linear_fog_runs_from_start_to_end(stage: Stage, depth: float) -> None:
    got = at_depth(stage, depth, mode="linear", start=2.0, end=12.0)
    assert close(got, mixed(min(max((12.0 - depth) / 10.0, 0.0), 1.0)), 2)


def test_a_new_colour_and_density_are_applied(stage: Stage) -> None:
    got = at_depth(stage, 3.0, density=0.5, color=(1.0, 0.0, 1.0))
    part = math.exp(-(1.5**2))
    assert close(got, part * COLOUR * 255 + (1 - part) * np.array([255, 0, 255]), 2)


def test_without_fog_the_colour_is_unchanged(stage: Stage) -> None:
    assert close(at_depth(stage, 12.0, fog=False), COLOUR * 255)
    assert close(at_depth(stage, 12.0, enabled=False), COLOUR * 255)


@pytest.mark.parametrize("radial", [False, True])
def test_to_the_side_fog_goes_by_the_depth_or_by_the_distance(stage: Stage, radial: bool) -> None:
    settings = small({"fog.radial": radial})
    depth = 8.0
    aside = 4.0
    half = 0.2
    with stage.frame(settings, Pose(0.0, 0.0, 0.0), fog=True):
        gl.glColor4f(*COLOUR, 1.0)
        corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
        quad(np.array([(aside + x, y, -depth) for x, y in corners]))
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        column = round(80 + 60 / math.tan(math.radians(30)) * aside / depth)
        got = np.asarray(stage.read()[60, column])
    distance = math.hypot(depth, aside) if radial else depth
    assert close(got, mixed(math.exp(-((0.12 * distance) ** 2))), 2)


def test_where_the_distance_cannot_be_chosen_fog_goes_by_the_depth_and_one_line_says_so(
    stage: Stage, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    fog = at_depth(stage, 5.0)
    monkeypatch.setattr(extensions, "extensions", frozenset)
    monkeypatch.setattr(extensions, "_told", set())
    assert close(at_depth(stage, 5.0, radial=True), fog, 1)
    told = capsys.readouterr().err
    assert told == "landscape: fog.radial: off, for this OpenGL has no GL_NV_fog_distance\n"
