"""The framebuffer's contents when a frame begins: not every program clears it."""

from dataclasses import dataclass

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import gl


@dataclass(frozen=True)
class Buffers:
    """Colour, uint8 (h, w, 4), depth, float32 (h, w), and stencil, uint8 (h, w); bottom row first.

    None for a buffer that the framebuffer lacks.
    """

    color: np.ndarray
    depth: np.ndarray | None
    stencil: np.ndarray | None

    @classmethod
    def read(cls, size: tuple[int, int]) -> "Buffers":
        """Read the bound framebuffer, of ``size`` pixels."""
        width, height = size
        gl.glPushClientAttrib(gl.GL_CLIENT_PIXEL_STORE_BIT)
        gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
        color = np.empty((height, width, 4), np.uint8)
        gl.glReadPixels(0, 0, width, height, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, color)
        depth = stencil = None
        if gl.glGetIntegerv(gl.GL_DEPTH_BITS):
            depth = np.empty((height, width), np.float32)
            gl.glReadPixels(0, 0, width, height, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, depth)
        if gl.glGetIntegerv(gl.GL_STENCIL_BITS):
            stencil = np.empty((height, width), np.uint8)
            kind = gl.GL_STENCIL_INDEX
            gl.glReadPixels(0, 0, width, height, kind, gl.GL_UNSIGNED_BYTE, stencil)
        gl.glPopClientAttrib()
        return cls(color, depth, stencil)

    def write(self) -> None:
        """Put it back into the bound framebuffer, in whatever state OpenGL is."""
        height, width = self.color.shape[:2]
        gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
        gl.glPushClientAttrib(gl.GL_CLIENT_PIXEL_STORE_BIT)
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        for each in ("ALPHA_TEST", "BLEND", "COLOR_LOGIC_OP", "DEPTH_TEST", "DITHER", "FOG"):
            gl.glDisable(gl_constant(f"GL_{each}"))
        for each in ("LIGHTING", "SCISSOR_TEST", "STENCIL_TEST", "TEXTURE_1D", "TEXTURE_2D"):
            gl.glDisable(gl_constant(f"GL_{each}"))
        gl.glColorMask(True, True, True, True)
        gl.glDepthMask(True)
        gl.glStencilMask(0xFF)
        gl.glPixelZoom(1.0, 1.0)
        gl.glViewport(0, 0, width, height)
        gl.glWindowPos2i(0, 0)
        gl.glDrawPixels(width, height, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, self.color)
        if self.stencil is not None:
            kind = gl.GL_STENCIL_INDEX
            gl.glDrawPixels(width, height, kind, gl.GL_UNSIGNED_BYTE, self.stencil)
        if self.depth is not None:
            gl.glEnable(gl.GL_DEPTH_TEST)
            gl.glDepthFunc(gl.GL_ALWAYS)
            gl.glColorMask(False, False, False, False)
            gl.glDrawPixels(width, height, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, self.depth)

        gl.glPopClientAttrib()
        gl.glPopAttrib()
