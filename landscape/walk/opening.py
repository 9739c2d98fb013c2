"""The window of a walk, opened at once, with a picture in it while the program is still being read.

To read the modules of the title or of a scene takes longer than to open a window. So this module
imports little.
"""

from pathlib import Path

from PIL import Image, UnidentifiedImageError

from framelens.gl.contexts.glfw import GLFWContext
from framelens.gl.seam import gl, unnoted

SIZE = (1280, 720)  # chosen: a walk's window, in the window system's coordinates
EMPTY = (41, 56, 71)  # chosen: RGB of a window without a picture


def open_window(
    picture: Path | None, size: tuple[int, int] | None = None, fullscreen: bool = False
) -> GLFWContext:
    """Open a walk's window with a picture that fills it; NoOpenGLError.

    Without a ``size`` it is SIZE, enlarged on a display of high resolution.
    """
    context = GLFWContext(size or SIZE, "landscape", True, fullscreen, "auto", size is None)
    pixels = context.pixels()
    if 0 not in pixels:
        fill(covering(picture, pixels))
        context.show()
    context.glfw.poll_events()
    return context


def fill(image: Image.Image) -> None:
    """Fill a window with an image of its size, RGBA; the state is as it was before.

    Before anything else is drawn the matrices are the identity: (-1, -1) is the lower left corner.
    """
    rows = image.transpose(Image.Transpose.FLIP_TOP_BOTTOM).tobytes()
    with unnoted():
        gl.glPushAttrib(gl.GL_CURRENT_BIT)  # has the raster position
        gl.glRasterPos2f(-1.0, -1.0)
        gl.glDrawPixels(*image.size, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, rows)
        gl.glPopAttrib()


def covering(path: Path | None, size: tuple[int, int]) -> Image.Image:
    """Return a picture that fills a window of ``size`` pixels, RGBA; plain without a file."""
    plain = Image.new("RGBA", size, (*EMPTY, 255))
    if path is None:
        return plain
    try:
        with Image.open(path) as found:
            picture = found.convert("RGBA")
    except (OSError, UnidentifiedImageError, Image.DecompressionBombError):
        return plain
    width, height = size
    times = max(width / picture.width, height / picture.height)
    # A division may round up: no part is larger than the picture.
    part = min(width / times, picture.width), min(height / times, picture.height)
    left, top = (picture.width - part[0]) / 2, (picture.height - part[1]) / 2
    box = (left, top, min(left + part[0], picture.width), min(top + part[1], picture.height))
    return picture.resize(size, Image.Resampling.BILINEAR, box)
