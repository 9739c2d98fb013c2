"""The hall without a stencil buffer: a line says what is off, and all else is drawn as before.

What other drivers lack is in test_drivers.py.
"""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from hall_pictures import SIZE, HallPictures
from stage import Stage

from framelens.gl import extensions
from framelens.gl.seam import gl
from landscape.frame import Pose
from landscape.hall import hall

# Nave with pool and statue; the exhibits of motion blur and of shadow volume from nearby.
PLACES = ("hall", Pose(1.2, 0.15, 1.52, 270.0, 0.0), Pose(1.2, 0.15, 2.32, 270.0, 0.0))


@pytest.fixture(scope="module")
def whole(the_stage: Stage, the_hall_pictures: HallPictures) -> list[np.ndarray]:
    the_stage.enter()
    return [the_hall_pictures(place) for place in PLACES]


Draw = Callable[[], list[np.ndarray]]


@pytest.fixture
def anew(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> Iterator[Draw]:
    """Opens another hall, in which what is hidden meanwhile is missing, and draws it."""
    monkeypatch.setattr(extensions, "_told", set())
    pictures = HallPictures(stage)
    yield lambda: [pictures(place) for place in PLACES]
    pictures.release()


def assert_as_good(found: list[np.ndarray], whole: list[np.ndarray]) -> None:
    """Assert that pictures are neither black nor broken: much as they are with every effect."""
    for one, other in zip(found, whole, strict=True):
        assert one.shape == (SIZE[1], SIZE[0], 3)
        assert one.max(axis=2).mean() > 0.8 * other.max(axis=2).mean()
        off = np.abs(one - other).max(axis=2)
        assert off.mean() < 16 and (off > 80).mean() < 0.06
        black = (one.max(axis=2) < 6) & (other.max(axis=2) > 30)
        assert black.mean() < 0.002


def told(capfd: pytest.CaptureFixture[str]) -> list[str]:
    return capfd.readouterr().err.splitlines()


@pytest.fixture
def without_stencil(stage: Stage) -> Iterator[None]:
    """Takes the stage's depth and stencil buffer away, and gives it a depth buffer alone."""
    point, renderbuffer = gl.GL_DEPTH_STENCIL_ATTACHMENT, gl.GL_RENDERBUFFER
    kept = gl.glGetFramebufferAttachmentParameteriv(
        gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME
    )
    depth = int(gl.glGenRenderbuffers(1))
    gl.glBindRenderbuffer(renderbuffer, depth)
    gl.glRenderbufferStorage(renderbuffer, gl.GL_DEPTH_COMPONENT24, *stage.size)
    gl.glBindRenderbuffer(renderbuffer, 0)
    gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, point, renderbuffer, 0)
    gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, renderbuffer, depth)
    assert gl.glCheckFramebufferStatus(gl.GL_FRAMEBUFFER) == gl.GL_FRAMEBUFFER_COMPLETE
    yield
    stage.enter()
    gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, point, renderbuffer, int(kept))
    gl.glDeleteRenderbuffers(1, np.array([depth], np.uint32))


@pytest.mark.seldom(14, first=11)
def test_without_a_stencil_buffer_what_needs_it_is_off(
    without_stencil: None,
    whole: list[np.ndarray],
    hall_pictures: HallPictures,
    anew: Draw,
    capfd: pytest.CaptureFixture[str],
) -> None:
    assert gl.glGetIntegerv(gl.GL_STENCIL_BITS) == 0
    found = anew()
    assert_as_good(found, whole)
    off = {"exhibits.solids": False}
    left = tuple(name for name in hall.SCENE.elements if name not in ("mirror", "shadow"))
    np.testing.assert_array_equal(found[0], hall_pictures(PLACES[0], only=left, settings=off))
    assert told(capfd) == [f"landscape: {hall.IN_STENCIL}: off, for there is no stencil buffer"]


def test_a_black_or_a_broken_picture_would_be_found(whole: list[np.ndarray]) -> None:
    black: list[Any] = [np.zeros_like(each) for each in whole]
    hole = [each.copy() for each in whole]
    hole[0][40:50, 50:70] = 0
    for wrong in (black, hole, [each[:, ::-1] for each in whole], [each // 2 for each in whole]):
        with pytest.raises(AssertionError):
            assert_as_good(wrong, whole)
