"""GLU's functions in Python: pictures equal to libGLU's, closed forms, and calls that are seen."""

from typing import Any

import numpy as np
import pytest
from commands import environment, need_library, python
from stage import Stage

from framelens.gl.foreign import patched
from framelens.gl.originals import original
from framelens.gl.seam import gl

# libGLU draws through libGL, so not in an OSMesa context.
BOTH = """
import itertools, json, sys
import numpy as np
from framelens.gl.contexts.egl import EGLContext
context = EGLContext((96, 96))
from OpenGL.GL import *
from OpenGL import GLU
from framelens.gl.glu import FUNCTIONS
import types
OURS = types.SimpleNamespace(**FUNCTIONS)

def picture(glu, shape, style, normals, orientation, texture):
    glMatrixMode(GL_PROJECTION); glLoadIdentity()
    glu.gluPickMatrix(48, 48, 90, 90, [0, 0, 96, 96])
    glu.gluPerspective(40, 1.25, 1, 20)
    glMatrixMode(GL_MODELVIEW); glLoadIdentity()
    glu.gluLookAt(1, -4, 3, 0, 0, 0.5, 0, 0, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glNormal3f(0, 0, 1)
    quadric = glu.gluNewQuadric()
    glu.gluQuadricDrawStyle(quadric, style)
    glu.gluQuadricNormals(quadric, normals)
    glu.gluQuadricOrientation(quadric, orientation)
    glu.gluQuadricTexture(quadric, texture)
    getattr(glu, shape[0])(quadric, *shape[1:])
    glu.gluDeleteQuadric(quadric)
    pixels = glReadPixels(0, 0, 96, 96, GL_RGB, GL_UNSIGNED_BYTE)
    return np.frombuffer(pixels, np.uint8).astype(int)

for what in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_CULL_FACE, GL_TEXTURE_2D):
    glEnable(what)
rng = np.random.default_rng(1)
image = rng.integers(0, 256, (24, 40, 3), np.uint8)
for glu in (OURS, GLU):
    assert not glu.gluBuild2DMipmaps(GL_TEXTURE_2D, GL_RGB, 40, 24, GL_RGB, GL_UNSIGNED_BYTE, image)
    levels = [
        np.frombuffer(glGetTexImage(GL_TEXTURE_2D, level, GL_RGB, GL_UNSIGNED_BYTE), np.uint8)
        for level in range(3)
    ]
    glu.levels = [level.astype(int) for level in levels]
mipmaps = [int(abs(a - b).max()) for a, b in zip(OURS.levels, GLU.levels)]
shapes = [("gluSphere", 1.2, 14, 9), ("gluCylinder", 1, 0.4, 1.5, 9, 3),
          ("gluDisk", 0.3, 1.2, 11, 3), ("gluDisk", 0, 1.2, 7, 2),
          ("gluPartialDisk", 0.2, 1.3, 8, 2, 30, 250)]
styles = (GLU.GLU_FILL, GLU.GLU_LINE, GLU.GLU_SILHOUETTE, GLU.GLU_POINT)
ways = itertools.product(shapes, styles, (GLU.GLU_SMOOTH, GLU.GLU_FLAT, GLU.GLU_NONE),
                         (GLU.GLU_OUTSIDE, GLU.GLU_INSIDE), (0, 1))
worst, drawn = {}, 0
for shape, *way in ways:
    if way[1] == GLU.GLU_FLAT and way[0] in (GLU.GLU_POINT, GLU.GLU_SILHOUETTE):
        continue  # libGLU reads memory that it has not written
    ours, theirs = picture(OURS, shape, *way), picture(GLU, shape, *way)
    drawn += bool(theirs.any())
    different = (abs(ours - theirs).reshape(-1, 3).max(axis=1) > 1).mean()
    if different > 0.0002:  # a pixel or two on lines, by single precision
        worst[str((shape, *map(int, way)))] = float(different)
print(json.dumps({"worst": worst, "drawn": drawn, "mipmaps": mipmaps}))
"""


@pytest.mark.seldom(3, first=2)
def test_pictures_and_mipmaps_are_those_of_libglu() -> None:
    need_library("EGL", "GLU")
    done = python(BOTH, env=environment()).json()
    assert done["drawn"] > 150
    assert done["worst"] == {}
    assert max(done["mipmaps"]) <= 1


class Notes:
    """Keeps the calls that the seam's replacement sees."""

    def __init__(self) -> None:
        self.calls: list[tuple[Any, ...]] = []

    def make(self, name: str, function: Any) -> Any:
        def noted(*args: Any, **named: Any) -> Any:
            self.calls.append((name, *args))
            return function(*args, **named)

        return noted


def test_calls_made_for_glu_are_seen_and_everything_is_put_back(stage: Stage) -> None:
    import OpenGL.GL
    from OpenGL import GLU

    before = OpenGL.GL.glVertex3f, OpenGL.GL.glTranslated, GLU.gluLookAt
    notes = Notes()
    with patched(notes.make):
        with stage.borrowed():
            GLU.gluLookAt(1, 2, 3, 0, 0, 0, 0, 1, 0)
            GLU.gluSphere(GLU.gluNewQuadric(), 2.0, 5, 4)
        assert original("glVertex3f") is before[0]
    assert (OpenGL.GL.glVertex3f, OpenGL.GL.glTranslated, GLU.gluLookAt) == before
    names = [call[0] for call in notes.calls if call[0].startswith(("glMult", "glTr", "glBegin"))]
    assert names == ["glMultMatrixf", "glTranslated", *["glBegin"] * 4]
    points = np.array([call[1:] for call in notes.calls if call[0] == "glVertex3f"])
    assert np.linalg.norm(points, axis=1) == pytest.approx(2.0)


def test_what_pyopengl_calls_past_its_wrappers_stays_as_it_was(stage: Stage) -> None:
    from OpenGL import GL
    from OpenGL.raw.GL.VERSION import GL_1_1

    before = {name: value for name, value in vars(GL_1_1).items() if name.startswith("gl")}
    own = GL.glVertexPointer
    with patched(Notes().make):
        assert {name: getattr(GL_1_1, name) for name in before} == before
        assert GL.glVertexPointer is not own


def test_projections_are_undone_by_unprojecting(stage: Stage) -> None:
    from framelens.gl.glu import gluPerspective, gluProject, gluUnProject, gluUnProject4

    with stage.borrowed():
        gl.glViewport(10, 20, 100, 50)
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glLoadIdentity()
        gluPerspective(90, 2, 1, 3)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glLoadIdentity()
        assert gluProject(0, 0, -1) == pytest.approx((60, 45, 0))
        # At distance 2 the upper edge is 2 above the axis: tan 45 degrees = 1.
        assert gluProject(0, 2, -2)[:2] == pytest.approx((60, 70))
        assert gluUnProject(*gluProject(0.5, -0.25, -1.5)) == pytest.approx((0.5, -0.25, -1.5))
        x, y, z, w = gluUnProject4(60, 45, 0, 1)
        assert (x / w, y / w, z / w) == pytest.approx((0, 0, -1))
        with pytest.raises(ValueError, match="Projection failed"):
            gluUnProject(0, 0, 0, np.zeros((4, 4)))


def test_images_are_scaled_by_areas_and_halved_by_means() -> None:
    from framelens.gl.glu_images import halved, scaled

    image = np.arange(16, dtype=np.uint8).reshape(4, 4, 1) * 10
    assert halved(image)[..., 0].tolist() == [[25, 45], [105, 125]]
    assert halved(image[:1])[..., 0].tolist() == [[5, 25]]
    assert scaled(image, 2, 2)[..., 0].tolist() == [[25, 45], [105, 125]]
    flat = np.full((3, 5, 4), 77, np.uint8)
    assert (scaled(flat, 8, 4) == 77).all()


def test_an_image_with_gaps_is_read_as_the_pixel_store_modes_say(stage: Stage) -> None:
    from framelens.gl.glu_images import gluScaleImage

    with stage.borrowed():
        gl.glPushClientAttrib(gl.GL_CLIENT_PIXEL_STORE_BIT)
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 4)
        into = np.zeros((2, 2), np.uint8)
        rows = bytes((1, 2, 0, 0, 3, 4, 0, 0))
        luminance = int(gl.GL_LUMINANCE), int(gl.GL_UNSIGNED_BYTE)
        gluScaleImage(luminance[0], 2, 2, luminance[1], rows, 2, 2, luminance[1], into)
        with pytest.raises(ValueError, match="7 bytes are too few for an image of 4 x 2"):
            gluScaleImage(luminance[0], 4, 2, luminance[1], rows[:7], 2, 2, luminance[1], into)
        gl.glPopClientAttrib()
    assert into.tolist() == [[1, 2], [3, 4]]
