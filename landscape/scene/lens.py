"""A lens in place of a pinhole: what is nearer or farther than the focus is blurred.

Technique: the light that meets in one point of a photograph came through all of the lens. The frame
is drawn from several points of the lens (Haeberli and Akeley, The Accumulation Buffer, SIGGRAPH
1990), each time with its frustum sheared so that the plane of focus stays where it is in the
picture, and the mean of these pictures is shown. A point at distance d, with the focus at f,
becomes a disc of the radius lens * abs(1/f - 1/d), at distance 1.

What has a mean is light, and a colour is about the square root of the light that a screen gives: in
a mean of colours, a white flower out of focus would be a grey smudge instead of a bright disc. So
the squares of the colours are added, which GL_SRC_COLOR makes of them when it multiplies a quad's
colour by itself. glAccum has such a sum in a buffer that few contexts still have. Here it is a
texture of floating-point numbers. Its root is taken by numpy: a table of glPixelMap may have no
more than 256 entries, too few for what is dark.
Each picture is also shifted by another part of a pixel, so that edges are smooth without
multisampling.

What is wrong without its safeguards: if only the eye moves, and not the frustum, everything is
blurred, and what is near the most. If billboards turn to each point of the lens, no tree nearby is
ever sharp (``Moment.faced``).
State used: framebuffer objects, GL_BLEND with GL_SRC_COLOR for what is blended (OpenGL 1.4),
GL_TEXTURE_2D, glDrawPixels, viewport, both matrices; depth test, fog and lighting off.
"""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

from framelens.base.errors import InputError
from framelens.gl.extensions import tell
from framelens.gl.seam import drawing, gl
from framelens.gl.state import attrib, flat_projection
from landscape.elements.settings import Camera
from landscape.frame import Pose
from landscape.gl.accumulating import clear, disc, quad, shifts
from landscape.gl.features import possible
from landscape.gl.texture_target import TextureTarget
from landscape.scene.scene import Moment

FEWEST = 8  # chosen: points of the lens that are used where the blur is smaller than a pixel
SPACING = 2.0  # chosen: pixels between the images of one thing from neighbouring points
MOST = 4096 * 4096  # chosen: pixels of a picture: the mean takes 16 bytes each
NEAREST = 1 / 3  # chosen: of the focus; what is nearer may show that the points are few


def axes(pose: Pose) -> tuple[np.ndarray, np.ndarray]:
    """Return the camera's right and up at a pose, float64 (3,) each."""
    yaw, roll = math.radians(pose.yaw), math.radians(pose.roll)
    level = np.array([math.cos(yaw), 0.0, math.sin(yaw)])
    above = np.cross(level, pose.forward)
    right = math.cos(roll) * level + math.sin(roll) * above
    return right, np.cross(right, pose.forward)


def blur(camera: Camera, height: int, distance: float) -> float:
    """Return the radius in pixels of the disc that a point at a distance in units becomes."""
    return camera.lens * abs(1.0 / camera.focus - 1.0 / distance) * _pixels(camera, height)


def points(camera: Camera, height: int) -> int:
    """Return how many points of the lens a picture of ``height`` pixels is drawn from.

    As many as its blur needs, so that a small picture takes fewer.
    """
    nearest = NEAREST * camera.focus
    largest = max(blur(camera, height, distance) for distance in (nearest, math.inf))
    needed = math.pi * (largest / SPACING) ** 2
    return min(max(math.ceil(needed), FEWEST), camera.lens_points)


def through(moment: Moment, camera: Camera) -> Iterator[Moment]:
    """Yield the moment as it is seen from each point of the lens."""
    pose = moment.pose
    assert pose.y is not None
    right, up = axes(pose)
    count = points(camera, moment.size[1])
    pixels = _pixels(camera, moment.size[1])

    for (across, rise), shift in zip(disc(count) * camera.lens, shifts(count), strict=True):
        x, y, z = (float(each) for each in across * right + rise * up)
        moved = replace(pose, x=pose.x + x, y=pose.y + y, z=pose.z + z)
        # The eye moves to the right, so what is in focus would move to the left in the picture.
        sheared = shift + np.array([across, rise]) / camera.focus * pixels
        detail = replace(moment.detail, shift=(float(sheared[0]), float(sheared[1])))
        yield replace(moment, pose=moved, detail=detail, faced=pose)


def _pixels(camera: Camera, height: int) -> float:
    """Return the height in pixels of an object one unit high, one unit away."""
    return height / (2.0 * math.tan(math.radians(camera.fov) / 2))


class Lens:
    """Owner of the textures that the mean takes; they are made when first needed."""

    def __init__(self, size: tuple[int, int]) -> None:
        """Create nothing yet; ``size`` is the framebuffer's width and height in pixels."""
        self.size = size
        self._one: TextureTarget | None = None  # the picture from one point of the lens
        self._mean: TextureTarget | None = None

    def draw(self, moment: Moment, camera: Camera, draw: Callable[[Moment], None]) -> None:
        """Let ``draw`` draw a moment, through the lens of a camera if it has one.

        InputError if the framebuffer is too large for that.
        """
        if camera.lens and self.size[0] * self.size[1] > MOST:
            raise InputError(
                "size {width}x{height}: expected at most {most} pixels where camera.lens is not 0; "
                "`landscape render --poster` draws larger pictures",
                width=self.size[0],
                height=self.size[1],
                most=MOST,
            )
        if not camera.lens or not self._opened():
            draw(moment)
            return
        assert self._one is not None
        assert self._mean is not None
        seen = list(through(moment, camera))

        for number, each in enumerate(seen):
            with self._one.drawing(clear=False):
                draw(each)
            with drawing("lens"), self._mean.drawing(clear=False):
                if number == 0:
                    clear(self.size, (0.0, 0.0, 0.0, 0.0))
                gl.glViewport(0, 0, *self.size)
                _add_squares(self._one, 1.0 / len(seen))

        with drawing("lens"):
            with self._mean.drawing(clear=False):
                light = gl.glReadPixels(0, 0, *self.size, gl.GL_RGB, gl.GL_FLOAT)
            _show(np.sqrt(np.asarray(light, np.float32)), self.size)

    def _opened(self) -> bool:
        """Make the textures; return whether this OpenGL can draw into them."""
        if not possible("camera.lens"):
            return False
        if self._mean is None:
            self._one = TextureTarget(self.size)
            self._mean = TextureTarget(self.size, "RGBA32F")
            if not self._mean.complete:
                tell("camera.lens: off, for this OpenGL draws into no GL_RGBA32F texture")
        return self._mean.complete

    def release(self) -> None:
        """Delete the textures; may be called twice."""
        for target in (self._one, self._mean):
            if target is not None:
                target.release()
        self._one = self._mean = None


@contextmanager
def _plain() -> Iterator[None]:
    """Let the block's pixels be written as they are, wherever they lie."""
    groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT
    with attrib(groups), flat_projection():
        for off in (gl.GL_DEPTH_TEST, gl.GL_FOG, gl.GL_LIGHTING, gl.GL_CULL_FACE, gl.GL_BLEND):
            gl.glDisable(off)
        yield
    gl.glColor4f(1.0, 1.0, 1.0, 1.0)


def _add_squares(target: TextureTarget, weight: float) -> None:
    """Add the squares of a texture's colours, times ``weight``, to all of the framebuffer."""
    root = math.sqrt(weight)
    with _plain():
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_COLOR, gl.GL_ONE)
        gl.glEnable(gl.GL_TEXTURE_2D)
        target.bind()
        for name in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, name, gl.GL_NEAREST)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
        gl.glColor4f(root, root, root, root)
        quad((0.0, 0.0, 1.0, 1.0), (-1.0, -1.0, 1.0, 1.0), 0.0)


def _show(colours: np.ndarray, size: tuple[int, int]) -> None:
    """Write colours, float32 (h * w * 3 numbers, bottom row first), to all of the framebuffer."""
    gl.glViewport(0, 0, *size)
    with _plain():
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glRasterPos2f(-1.0, -1.0)
        gl.glDrawPixels(*size, gl.GL_RGB, gl.GL_FLOAT, np.ascontiguousarray(colours))
