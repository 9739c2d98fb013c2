"""Pictures whose transparent parts are left out: by samples of a pixel where it has several."""

from collections.abc import Iterator
from contextlib import contextmanager

from framelens.gl.extensions import Need, antialiased, has
from framelens.gl.seam import gl
from framelens.gl.state import attrib

DITHER_CONTROL = Need(None, ("GL_NV_alpha_to_coverage_dither_control",))


@contextmanager
def cut_out() -> Iterator[None]:
    """Leave out what is transparent in a picture; with several samples a pixel, by their number.

    GL_SAMPLE_ALPHA_TO_COVERAGE is of OpenGL 1.3: alpha says how many samples are written. Where a
    driver varies which ones from pixel to pixel (Mesa 26), soft edges are chequered: with
    GL_NV_alpha_to_coverage_dither_control it does not.
    """
    with attrib(gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT):
        gl.glEnable(gl.GL_ALPHA_TEST)
        if not antialiased():
            gl.glAlphaFunc(gl.GL_GREATER, 0.5)
            yield
            return

        gl.glEnable(gl.GL_SAMPLE_ALPHA_TO_COVERAGE)
        gl.glAlphaFunc(gl.GL_GREATER, 0.1)
        if not has(DITHER_CONTROL):
            yield
            return
        gl.glAlphaToCoverageDitherControlNV(gl.GL_ALPHA_TO_COVERAGE_DITHER_DISABLE_NV)
        try:
            yield
        finally:
            gl.glAlphaToCoverageDitherControlNV(gl.GL_ALPHA_TO_COVERAGE_DITHER_DEFAULT_NV)
