"""Brightness and contrast of the picture, or of a part of it (glSkel, scale and bias).

Each colour becomes scale * colour + bias: ``tone.contrast`` is the scale, ``tone.brightness`` the
bias. Two ways, by ``tone.method``:
- blend: quads over the whole window whose blending does the arithmetic in the frame buffer. With
  (GL_ONE, GL_SRC_ALPHA) the colour's alpha is the scale and its RGB the bias, both in 0..1. A
  negative bias needs GL_FUNC_REVERSE_SUBTRACT (OpenGL 1.4); a scale above 1 needs further passes
  of (GL_DST_COLOR, GL_ONE), which multiply by 1 + colour, at most by 2: doubling.
- pixels: glCopyPixels of the window onto itself, with scale and bias by glPixelTransfer. That is
  impossible where pixels have several samples; then it is blended, and a line says so.
A part of the picture (``tone.area``) is marked in the stencil buffer while the statue is drawn.
What is wrong with blending: the frame buffer holds 0..1 in 8 bits and clamps after each pass, so
the bias comes before a scale above 1, and its rounding is then enlarged. Without ``tone.doubling``
alpha stops at 1 and so does the contrast.
State used: GL_BLEND and its equation, the stencil test, pixel transfer, raster position.
"""

from collections.abc import Iterator
from contextlib import contextmanager

from framelens.gl.extensions import antialiased, tell
from framelens.gl.named import gl_constant
from framelens.gl.seam import gl
from framelens.gl.state import attrib, flat_projection
from landscape.elements.element import Element
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.gl.features import possible
from landscape.hall.settings import Settings

MARK = 16  # the stencil bit of the statue


def doublings(scale: float) -> list[float]:
    """Return the factors, each above 1 and at most 2, whose product is a scale above 1."""
    factors = []
    while scale > 2.0:
        factors.append(2.0)
        scale /= 2.0
    return [*factors, scale]


class Tone(Element[Settings]):
    """Brightness and contrast, applied to what has been drawn."""

    def __init__(self, settings: Settings, assets: Assets, stencil: bool = True) -> None:
        """Take the settings; without a ``stencil`` buffer no part of the picture is changed."""
        self.settings, self._stencil = settings, stencil

    @property
    def _changes(self) -> bool:
        """Whether there is anything to change, and a way to do it."""
        tone = self.settings.tone
        possible = tone.area == "picture" or self._stencil
        return possible and (tone.brightness, tone.contrast) != (0.0, 1.0)

    @contextmanager
    def marking(self) -> Iterator[None]:
        """Mark the pixels of what the block draws, if a part of the picture will be changed.

        What is drawn later must not cover them, or clear their marks.
        """
        if self.settings.tone.area == "picture" or not self._changes:
            yield
            return
        with attrib(gl.GL_ENABLE_BIT | gl.GL_STENCIL_BUFFER_BIT):
            gl.glEnable(gl.GL_STENCIL_TEST)
            gl.glStencilMask(MARK)
            gl.glStencilFunc(gl.GL_ALWAYS, MARK, MARK)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
            yield

    def draw(self, frame: Frame) -> None:
        """Change the picture drawn so far, if there is anything to change."""
        if not self._changes:
            return
        tone = self.settings.tone
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        groups |= gl.GL_STENCIL_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_PIXEL_MODE_BIT
        with attrib(groups):
            if tone.area != "picture":
                gl.glEnable(gl.GL_STENCIL_TEST)
                gl.glStencilFunc(gl.GL_EQUAL, MARK if tone.area == "statue" else 0, MARK)
                gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
            gl.glDisable(gl.GL_DEPTH_TEST)
            gl.glDepthMask(gl.GL_FALSE)
            with flat_projection():
                if tone.method == "pixels" and copies():
                    self._copy(frame)
                else:
                    self._blend()

    def _blend(self) -> None:
        tone = self.settings.tone
        bias, scale = tone.brightness, tone.contrast
        gl.glEnable(gl.GL_BLEND)
        if scale <= 1.0 and bias >= 0.0:
            # RGB = bias * 1 + previous RGB * scale, in one pass.
            gl.glBlendFunc(gl.GL_ONE, gl.GL_SRC_ALPHA)
            cover(bias, bias, bias, scale)
            return

        if scale <= 1.0:
            gl.glBlendFunc(gl.GL_ZERO, gl.GL_SRC_ALPHA)
            cover(0.0, 0.0, 0.0, scale)
            self._add(bias)
            return

        # A scale above 1 comes last: what it makes too bright or too dark, it makes so in the end.
        self._add(bias / scale)
        gl.glBlendFunc(gl.GL_DST_COLOR, gl.GL_ONE)
        for factor in doublings(scale) if tone.doubling else ():
            more = factor - 1.0
            cover(more, more, more, 1.0)

    def _add(self, bias: float) -> None:
        """Add a number in -1..1 to all colours."""
        gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
        if bias >= 0.0:
            cover(bias, bias, bias, 1.0)
        elif possible("tone.brightness below 0"):
            gl.glBlendEquation(gl.GL_FUNC_REVERSE_SUBTRACT)
            cover(-bias, -bias, -bias, 1.0)
            gl.glBlendEquation(gl.GL_FUNC_ADD)

    def _copy(self, frame: Frame) -> None:
        tone = self.settings.tone
        for name in ("RED", "GREEN", "BLUE"):
            gl.glPixelTransferf(gl_constant(f"GL_{name}_SCALE"), tone.contrast)
            gl.glPixelTransferf(gl_constant(f"GL_{name}_BIAS"), tone.brightness)
        gl.glRasterPos2f(-1.0, -1.0)
        gl.glCopyPixels(*frame.corner, *frame.viewport, gl.GL_COLOR)


def copies() -> bool:
    """Return whether pixels can be copied; if not, say once that they are blended instead.

    Where each pixel has several samples, glCopyPixels is an error of OpenGL.
    """
    if not antialiased():
        return True
    tell(
        "tone.method=pixels: blended, for each pixel has several samples; --samples 0 copies pixels"
    )
    return False


def cover(*color: float) -> None:
    """Draw a quad of one colour (RGBA) over the window."""
    gl.glColor4f(*color)
    gl.glRectf(-1.0, -1.0, 1.0, 1.0)
