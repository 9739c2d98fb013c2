"""The sword: in front of everything, bobbing, one picture for each part of the stroke."""

import math

import numpy as np
import pytest
from PIL import Image
from stage import PLAIN, Stage, close, small

from framelens.gl.seam import gl
from landscape.elements.settings import preset
from landscape.elements.sword import ASPECT, STROKES, Sword, bob
from landscape.files.assets import Assets
from landscape.frame import Pose

BACKGROUND = np.array([0.4, 0.6, 0.7]) * 255
POSE = Pose(20.0, 1.0, 20.0, 33.0, -20.0)
SETTINGS = small()


def test_the_bob_is_the_reports() -> None:
    assert bob(0.0) == 0.005
    assert bob(4 * math.pi) == pytest.approx(-0.005)
    # cos(2.5) = -0.801144
    assert bob(10.0) == pytest.approx(0.005 * -0.801144, rel=1e-5)


def drawn(stage: Stage, assets: Assets, **how) -> np.ndarray:
    sword = Sword(SETTINGS, assets)
    with stage.frame(SETTINGS, POSE, **how) as frame:
        sword.draw(frame)
        picture = stage.read()
    sword.release()
    return picture


@pytest.mark.parametrize("stroke", range(1, STROKES + 1))
def test_each_part_of_the_stroke_has_its_own_texture(
    stage: Stage, plain: Assets, stroke: int
) -> None:
    picture = drawn(stage, plain, stroke=stroke)
    assert close(picture[10:110, 5:155], PLAIN[f"sword_{stroke}.png"][:3])


@pytest.mark.parametrize("fog", [False, True])
def test_the_sword_at_rest_is_blended_over_the_picture_without_fog(
    stage: Stage, plain: Assets, fog: bool
) -> None:
    part = 128 / 255
    wanted = part * np.array([255, 0, 255]) + (1 - part) * BACKGROUND
    assert close(drawn(stage, plain, fog=fog)[60, 80], wanted)


def test_nothing_is_nearer_than_the_sword(stage: Stage, plain: Assets) -> None:
    sword = Sword(SETTINGS, plain)
    with stage.frame(SETTINGS, POSE, stroke=1) as frame:
        gl.glClearDepth(0.0)
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        gl.glClearDepth(1.0)
        sword.draw(frame)
        picture = stage.read()
    sword.release()
    assert close(picture[60, 80], PLAIN["sword_1.png"][:3])


def test_a_wide_window_shows_the_picture_at_its_right_side(stage: Stage, plain: Assets) -> None:
    picture = drawn(stage, plain, stroke=2, size=(160, 60))[60:]
    left = 160 - 60 * ASPECT
    assert close(picture[30, int(left + 2)], PLAIN["sword_2.png"][:3])
    assert close(picture[30, int(left - 2)], BACKGROUND)


def test_the_sword_rises_and_falls_with_the_steps(stage: Stage, plain_folder) -> None:
    picture = np.zeros((512, 512, 4), np.uint8)
    picture[:256] = (255, 255, 255, 255)  # a horizon at the middle
    Image.fromarray(picture).save(plain_folder / "sword_1.png")
    assets = Assets(plain_folder)
    heights = []
    for step in (0.0, 4 * math.pi):
        column = drawn(stage, assets, stroke=1, step=step)[:, 80, 0].astype(float)
        # Where the edge lies to a fraction of a pixel, as the filter blurs it.
        part = (column - BACKGROUND[0]) / (255 - BACKGROUND[0])
        heights.append(part[30:90].sum())
    top = math.tan(math.radians(30))
    moved = 0.01 / (2 * top) * 120
    assert heights[1] - heights[0] == pytest.approx(moved, abs=0.2)


def test_no_setting_changes_the_sword(stage: Stage, plain: Assets) -> None:
    sword = Sword(SETTINGS, plain)
    sword.take(preset("best"))
    with stage.frame(SETTINGS, POSE, stroke=1) as frame:
        sword.draw(frame)
        picture = stage.read()
    sword.release()
    assert (picture == drawn(stage, plain, stroke=1)).all()
