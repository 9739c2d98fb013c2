"""The mirror image as a texture (R16): where it lies, how far it reaches, and that it ripples."""

import numpy as np
import pytest
from seaside import LEVEL, POSE, mirrored_wall, red
from stage import Stage, close, pixel, project, quad, small

from framelens.gl.seam import gl
from landscape.elements.best.sea import waves
from landscape.elements.best.sea.mirror_image import MirrorImage, widened
from landscape.files.assets import Assets


def test_the_reflections_edge_moves_with_kt_only_when_rippled(stage: Stage, plain: Assets) -> None:
    still = [red(mirrored_wall(stage, plain, {}, kt)) for kt in (0, 40)]
    moving = [red(mirrored_wall(stage, plain, {"reflection.rippled": True}, kt)) for kt in (0, 40)]
    assert still[0].sum() > 500 and moving[0].sum() > 500
    assert (still[0] == still[1]).all()
    assert (moving[0] != moving[1]).sum() > 50


def test_without_waves_the_texture_lies_where_the_mirrored_scene_would(
    stage: Stage, plain: Assets, monkeypatch: pytest.MonkeyPatch
) -> None:
    flat = mirrored_wall(stage, plain, {})
    monkeypatch.setattr(waves, "STEEP", 0.0 * waves.STEEP)
    textured = mirrored_wall(stage, plain, {"reflection.rippled": True})
    assert (red(flat) != red(textured)).mean() < 0.01
    inside = project(POSE, (20.0, LEVEL - 0.4, 18.0))
    assert close(pixel(flat, inside), pixel(textured, inside), 3)


def test_the_ripples_leave_no_hole_at_the_windows_borders(stage: Stage, plain: Assets) -> None:
    changes = {"reflection.rippled": True, "water.color": (0.0, 0.0, 1.0, 0.5)}
    for kt in (0, 33):
        picture = mirrored_wall(stage, plain, changes, kt)
        below = picture[int(project(POSE, (20, LEVEL, 8))[1]) + 2 :]
        assert (below[..., 2] >= 120).all(), "every pixel of water has half of the water's blue"


def test_the_texture_is_drawn_outside_the_framebuffer_and_is_taken_once(stage: Stage) -> None:
    image = MirrorImage()
    with stage.frame(small(), POSE) as frame:
        assert image.take() is None
        with image.drawing(frame) as smaller:
            assert smaller.size == (80, 60) and smaller.fov > frame.fov
            gl.glColor4f(1.0, 0.0, 0.0, 1.0)
            quad(np.array([(-99, -99, -9), (99, -99, -9), (99, 99, -9), (-99, 99, -9)], float))
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        assert (stage.read() == stage.read()[0, 0]).all(), "nothing fell into the framebuffer"
        taken = image.take()
        assert taken is not None and image.take() is None
        taken[0].bind()
        for name in (gl.GL_TEXTURE_WRAP_S, gl.GL_TEXTURE_WRAP_T):
            wrap = gl.glGetTexParameteriv(gl.GL_TEXTURE_2D, name)
            assert int(np.ravel(wrap)[0]) == gl.GL_CLAMP_TO_EDGE
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
    image.release()
    image.release()


def test_the_mirror_reaches_beyond_the_window_by_its_margin() -> None:
    projection = np.array([(1.5, 0, 0, 0), (0, 2, 0, 0), (0, 0, -1, -0.04), (0, 0, -1, 0)])
    corner = np.array([2.0 / 1.5, 1.0, -2.0, 1.0])
    x, y, _, w = widened(projection, 1.25) @ corner
    assert (x / w, y / w) == pytest.approx((0.8, 0.8))
