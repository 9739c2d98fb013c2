"""The polished floor: the hall drawn a second time, mirrored at the floor, under a blended floor.

Technique: planar reflection ("glSkel, reflection"; Kilgard's reflectdino). The floor's visible
pixels are marked in the stencil buffer: drawn with the depth test, without colour and depth. There
the hall is drawn again under the matrix diag(1, -1, 1, 1), as the floor is y = 0. Then the floor is
blended over its own image, and only after it the pool's basin is drawn: what lies beneath the floor
would hide the image. The alpha of a polished stone depends on the angle: with
``mirror.fresnel`` a small texture of alpha is laid around the viewer by GL_OBJECT_LINEAR, whose
radius is the tangent of the angle between the line of sight and the normal; it costs a texture
unit and no geometry. The floor has one side; from below, ``mirror.underside`` draws another.
State used: modelview, stencil bit FLOOR, GL_CLIP_PLANE0, front face, light positions,
blending, texture unit UNIT with its texture coordinates.
Polished stone is rougher than a mirror: with ``mirror.fades`` the image of the room is dimmer the
higher above the floor is what it shows. The stone has vertex colours for it, which cost no filling.
What is wrong without its safeguards: without ``mirror.stencil`` the image shows where there is no
floor. A mirror turns every triangle's winding: without ``mirror.winding``, which swaps the front
face, the near sides are culled and the far ones shown. OpenGL keeps lights in eye space: without
``mirror.lights``, which places them again under the mirror, the image is lit from below. Without
``mirror.clip`` what lies under the floor, the pool's basin, stands above it in the image. The
image's statue is a unit mesh under glScalef, which makes normals too long: without
``mirror.normals`` (GL_NORMALIZE) it is far too bright.
"""

from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from typing import Self

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import drawing, drawn_now, gl
from framelens.gl.state import attrib, matrix
from framelens.gl.texture import Texture
from landscape.elements import sun
from landscape.elements.element import Element, Site
from landscape.elements.reflection import MIRROR
from landscape.frame import Frame
from landscape.gl.features import possible
from landscape.hall.settings import Settings

FLOOR = 1  # the stencil bit of the visible floor
UNDERSIDE = (0.10, 0.12, 0.30)  # chosen, as the document's blue
UNIT = 3  # texture unit of the alpha; units before it are the floor's own
TEXELS, REACH = 128, 16.0  # chosen: side of its texture; tangent of the angle at its edge
GRAZING, POWER = 0.42, 4.0  # chosen: reflectance at grazing angles, and how late it rises
FADES = 0.4  # chosen: units above the floor at which the image has a third of its light left


def reflectance(strength: float, tangent: np.ndarray) -> np.ndarray:
    """Return the fraction of mirrored light, ``strength`` from above, GRAZING along the floor.

    As Schlick's approximation of Fresnel's equations; ``tangent`` is that of the angle between the
    line of sight and the floor's normal.
    """
    cosine = 1.0 / np.sqrt(1.0 + np.square(tangent))
    return np.asarray(strength + (max(GRAZING, strength) - strength) * (1.0 - cosine) ** POWER)


def fading(heights: np.ndarray) -> np.ndarray:
    """Return the fraction of light (n,) that the image keeps of what stands at heights (n,)."""
    return np.asarray(np.exp(-np.maximum(heights, 0.0) / FADES), np.float32)


def alpha_image(strength: float) -> np.ndarray:
    """Return the floor's opacity around the viewer, uint8 (TEXELS, TEXELS, 4), white."""
    along = ((np.arange(TEXELS) + 0.5) / TEXELS * 2 - 1) * REACH
    opacity = 1.0 - reflectance(strength, np.hypot(along[:, None], along[None, :]))
    image = np.full((TEXELS, TEXELS, 4), 255, np.uint8)
    image[..., 3] = np.round(opacity * 255)
    return image


class Mirror(Element[Settings]):
    """The mirror image in the floor, and the floor over it."""

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return what the constructor uses of the settings."""
        return settings.mirror.strength

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build it; it needs no files."""
        return cls(site.settings)

    def __init__(self, settings: Settings) -> None:
        """Make the texture of the floor's opacity, where there are texture units for it."""
        self.settings = settings
        self._opacity: Texture | None = None
        if possible("mirror.fresnel"):
            image = alpha_image(settings.mirror.strength)
            self._opacity = Texture(image, repeat=False, trilinear=False, mipmaps=False)

    def shows(self, frame: Frame) -> bool:
        """Return whether there is an image to draw: not from below."""
        return self.settings.mirror.enabled and frame.eye_y > 0.0

    @contextmanager
    def image(self, mark: Callable[[], None]) -> Iterator[None]:
        """Draw the block's elements as the floor mirrors them; ``mark`` sends the floor."""
        values, outside = self.settings.mirror, drawn_now()
        with drawing("mirror"), attrib(gl.GL_STENCIL_BUFFER_BIT):
            if values.stencil:
                self._mark(mark)
                gl.glEnable(gl.GL_STENCIL_TEST)
                gl.glStencilFunc(gl.GL_EQUAL, FLOOR, FLOOR)
                gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)

            groups = gl.GL_POLYGON_BIT | gl.GL_LIGHTING_BIT | gl.GL_TRANSFORM_BIT
            with matrix(), attrib(groups):
                gl.glMultMatrixf(MIRROR)
                if values.winding:
                    gl.glFrontFace(gl.GL_CW)
                if values.lights:
                    sun.place(self.settings.sun)
                if values.clip:
                    # Placed under the mirror matrix: it keeps what is above the floor itself.
                    gl.glClipPlane(gl.GL_CLIP_PLANE0, np.array([0.0, 1.0, 0.0, 0.0], np.float64))
                    gl.glEnable(gl.GL_CLIP_PLANE0)
                with drawing(*outside):
                    yield

    @staticmethod
    def _mark(send: Callable[[], None]) -> None:
        """Mark the visible floor in the stencil buffer; nothing was drawn behind it so far."""
        groups = gl.GL_STENCIL_BUFFER_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups):
            gl.glEnable(gl.GL_STENCIL_TEST)
            gl.glStencilMask(FLOOR)
            gl.glStencilFunc(gl.GL_ALWAYS, FLOOR, FLOOR)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
            gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
            gl.glDepthMask(gl.GL_FALSE)
            send()

    def draw_floor(self, frame: Frame, draw: Callable[[], None]) -> None:
        """Blend the floor over its mirror image; ``draw`` draws it, in the current colour."""
        values = self.settings.mirror
        groups = gl.GL_COLOR_BUFFER_BIT | gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT
        with attrib(groups):
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            if values.fresnel and self._opacity is not None:
                self._lay_opacity(frame, self._opacity)
            else:
                gl.glColor4f(1.0, 1.0, 1.0, 1.0 - values.strength)
            draw()

    @staticmethod
    def _lay_opacity(frame: Frame, texture: Texture) -> None:
        """Let a texture unit multiply the alpha, centred below the eye."""
        gl.glActiveTexture(gl.GL_TEXTURE0 + UNIT)
        gl.glEnable(gl.GL_TEXTURE_2D)
        texture.bind()
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
        (x, y, z), wide = frame.eye.tolist(), 2.0 * REACH
        planes = {"S": (1.0, 0.0, -x), "T": (0.0, 1.0, -z)}
        for name, (along_x, along_z, shift) in planes.items():
            coordinate = gl_constant(f"GL_{name}")
            gl.glTexGeni(coordinate, gl.GL_TEXTURE_GEN_MODE, gl.GL_OBJECT_LINEAR)
            plane = np.array([along_x, 0.0, along_z, shift]) / (wide * y) + (0.0, 0.0, 0.0, 0.5)
            gl.glTexGenfv(coordinate, gl.GL_OBJECT_PLANE, plane.astype(np.float32))
            gl.glEnable(gl_constant(f"GL_TEXTURE_GEN_{name}"))
        gl.glActiveTexture(gl.GL_TEXTURE0)

    def draw_underside(self, send: Callable[[], None]) -> None:
        """Draw the floor as it is seen from below; ``send`` sends it and all that hangs from it."""
        if not self.settings.mirror.underside:
            return
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT
        with attrib(groups | gl.GL_STENCIL_BUFFER_BIT):
            # What it hides is marked for nothing any more.
            gl.glEnable(gl.GL_STENCIL_TEST)
            gl.glStencilFunc(gl.GL_ALWAYS, 0, ~0)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
            gl.glEnable(gl.GL_CULL_FACE)
            gl.glFrontFace(gl.GL_CW)
            gl.glColor3f(*UNDERSIDE)
            send()

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        if self._opacity is not None:
            self._opacity.release()
