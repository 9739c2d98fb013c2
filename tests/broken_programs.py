"""Small programs with one mistake each, and the same programs without it.

A case is a body of code in a frame of a toolkit. ``BROKEN`` gives for each the causes that
`landscape why` may name first, and what mends it: a text of the body and what takes its place.
"""

from dataclasses import dataclass

GLFW = """\
import ctypes
import glfw
import numpy as np
from OpenGL.GL import *
from OpenGL.GLU import *

glfw.init()
window = glfw.create_window(240, 180, "case", None, None)
glfw.make_context_current(window)
{setup}
while not glfw.window_should_close(window):
{draw}
    glfw.swap_buffers(window)
    glfw.poll_events()
glfw.terminate()
"""
CAMERA = """\
glEnable(GL_DEPTH_TEST)
glMatrixMode(GL_PROJECTION)
gluPerspective(45, 240 / 180, 0.5, 50)
glMatrixMode(GL_MODELVIEW)
"""
BEGIN = """\
glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
glLoadIdentity()
glTranslatef(0, 0, -5)
"""
QUAD = """\
glBegin(GL_QUADS)
for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
    glVertex3f(x, y, 0)
glEnd()
"""
BEHIND = """\
glColor3f(0.2, 0.3, 0.4)
glRectf(-3, -2, 3, -1.5)
"""
TEXTURED = """\
glBegin(GL_QUADS)
for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
    glTexCoord2f(s, t)
    glVertex3f(2 * s - 1, 2 * t - 1, 0)
glEnd()
"""
IMAGE = """\
image = np.zeros((32, 32, 3), np.uint8)
image[::4] = 255
image[:16, :16] = (200, 100, 50)
glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 32, 32, 0, GL_RGB, GL_UNSIGNED_BYTE, image)
"""
BALL = """\
ball = gluNewQuadric()
"""
FLAT = "gluOrtho2D(0, 240, 0, 180)\n"
CLEAR = "glClear(GL_COLOR_BUFFER_BIT)\n"
CUBE = """\
corners = ((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1),
           (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1))
faces = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (2, 3, 7, 6), (0, 4, 7, 3), (1, 2, 6, 5)]
normals = [(0, 0, -1), (0, 0, 1), (0, -1, 0), (0, 1, 0), (-1, 0, 0), (1, 0, 0)]


def cube():
    glBegin(GL_QUADS)
    for k in range(6):
        glColor3f(0.2 + 0.1 * k, 0.9 - 0.1 * k, 0.5)
        glNormal3fv(normals[k])
        for corner in faces[k]:
            glVertex3fv(corners[corner])
    glEnd()


"""
TURNED = "glRotatef(30, 1, 1, 0)\ncube()\n"
LIGHT = "glEnable(GL_LIGHTING)\nglEnable(GL_LIGHT0)\n"


@dataclass(frozen=True)
class Case:
    """A program: what is set up, what each frame draws, and how the mistake is mended."""

    causes: tuple[str, ...]
    setup: str
    draw: str
    mend: tuple[str, str] = ("", "")
    frame: int = 0
    pixel: tuple[int, int] | None = None

    def source(self, mended: bool = False) -> str:
        """Return the program."""
        text = GLFW.format(
            setup=self.setup,
            draw="".join(f"    {line}\n" for line in self.draw.splitlines()),
        )
        if mended:
            assert text.count(self.mend[0]) >= 1, self.mend[0]
            text = text.replace(*self.mend)
        return text


BROKEN = {
    "behind": Case(
        ("behind",), CAMERA, BEGIN.replace("-5", "5") + QUAD, ("(0, 0, 5)", "(0, 0, -5)")
    ),
    "behind, one matrix": Case(
        ("behind",),
        "gluPerspective(45, 240 / 180, 0.1, 50)\nglTranslatef(0, 0, 5)\n",
        CLEAR + QUAD,
        ("(0, 0, 5)", "(0, 0, -5)"),
    ),
    "near": Case(
        ("beyond-near",), CAMERA.replace("0.5, 50", "8, 50"), BEGIN + QUAD, ("8, 50", "1, 50")
    ),
    "far": Case(
        ("beyond-far",), CAMERA.replace("0.5, 50", "0.5, 3"), BEGIN + QUAD, ("0.5, 3)", "0.5, 30)")
    ),
    "near zero": Case(
        ("near-zero",), CAMERA.replace("0.5, 50", "0, 50"), BEGIN + QUAD, ("0, 50)", "0.1, 50)")
    ),
    "radians": Case(
        ("fovy-radians",), CAMERA.replace("(45", "(0.785"), BEGIN + QUAD, ("0.785", "45")
    ),
    "no projection": Case(
        ("no-projection",),
        "",
        CLEAR + "glRectf(60, 40, 200, 150)\n",
        ("(60, 40, 200, 150)", "(-0.5, -0.5, 0.5, 0.5)"),
    ),
    "wiped": Case(
        ("projection-wiped", "behind", "no-projection"),
        CAMERA.replace("glMatrixMode(GL_MODELVIEW)\n", ""),
        BEGIN + QUAD,
        ("50)\n", "50)\nglMatrixMode(GL_MODELVIEW)\n"),
    ),
    "multiplied": Case(
        ("accumulated",),
        "glMatrixMode(GL_PROJECTION)\n",
        "glMatrixMode(GL_PROJECTION)\ngluPerspective(45, 4 / 3, 1, 50)\n"
        "glMatrixMode(GL_MODELVIEW)\n" + BEGIN + QUAD,
        ("gluPerspective", "glLoadIdentity()\n    gluPerspective"),
        frame=5,
    ),
    "up": Case(
        ("look-at-up",),
        CAMERA,
        "glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)\nglLoadIdentity()\n"
        "gluLookAt(0, 6, 0, 0, 0, 0, 0, 1, 0)\nglRotatef(90, 1, 0, 0)\n" + QUAD,
        ("0, 1, 0)\n    glRot", "0, 0, -1)\n    glRot"),
    ),
    "rows": Case(
        ("transposed",),
        CAMERA + "move = np.eye(4, dtype=np.float32)\nmove[:3, 3] = 0, 0, -5\n",
        "glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)\nglLoadMatrixf(move)\n" + QUAD,
        ("glLoadMatrixf(move)", "glLoadMatrixf(move.T.copy())"),
    ),
    "flattened": Case(
        ("zero-scale",), CAMERA, BEGIN + "glScalef(1, 0, 1)\n" + QUAD, ("(1, 0, 1)", "(1, 1, 1)")
    ),
    "texture mode": Case(
        ("matrix-mode",),
        CAMERA,
        BEGIN
        + BEHIND
        + "glMatrixMode(GL_TEXTURE)\nglTranslatef(0, 0, -2)\nglColor3f(1, 1, 0)\n"
        + QUAD
        + "glMatrixMode(GL_MODELVIEW)\n",
        ("GL_TEXTURE)", "GL_MODELVIEW)"),
    ),
    "viewport": Case(
        ("viewport",),
        FLAT + "glViewport(0, 0, 0, 0)\n",
        CLEAR + "glRectf(60, 40, 200, 150)\n",
        ("(0, 0, 0, 0)", "(0, 0, 240, 180)"),
    ),
    "not a number": Case(
        ("nan",),
        CAMERA,
        BEGIN + BEHIND + QUAD.replace("0)", "float('nan'))"),
        ("float('nan')", "0.0"),
    ),
    "three corners": Case(
        ("too-few-vertices",),
        FLAT,
        CLEAR
        + BEHIND.replace("-3, -2, 3, -1.5", "0, 0, 240, 20")
        + "glBegin(GL_QUADS)\nfor p in ((60, 40), (200, 40), (130, 150)):\n    glVertex2f(*p)\n"
        + "glEnd()\n",
        ("GL_QUADS", "GL_TRIANGLES"),
    ),
    "outside begin": Case(
        ("outside-begin",),
        FLAT,
        CLEAR + "for p in ((60, 40), (200, 40), (130, 150)):\n    glVertex2f(*p)\n",
        (
            "for p in",
            "glRectf(60, 40, 200, 150)\n    for p in ():\n        pass\n    for p in () and",
        ),
    ),
    "enable inside": Case(
        ("inside-begin",),
        FLAT,
        CLEAR + "glBegin(GL_TRIANGLES)\nglEnable(GL_BLEND)\n"
        "for p in ((60, 40), (200, 40), (130, 150)):\n    glVertex2f(*p)\nglEnd()\n",
        ("    glEnable(GL_BLEND)\n", ""),
    ),
    "depth to 0": Case(
        ("clear-depth",), CAMERA + "glClearDepth(0.0)\n", BEGIN + QUAD, ("(0.0)", "(1.0)")
    ),
    "depth equal": Case(
        ("depth-func",),
        CAMERA + "glDepthFunc(GL_GEQUAL)\n",
        BEGIN + BEHIND,
        ("GL_GEQUAL", "GL_LEQUAL"),
    ),
    "depth stays": Case(
        ("no-depth-clear", "accumulated"),
        CAMERA + "x = 0\n",
        BEGIN.replace(" | GL_DEPTH_BUFFER_BIT", "").replace("0, 0, -5", "0.2 * x, 0, -5 - x")
        + QUAD
        + "x += 1\n",
        ("glClear(GL_COLOR_BUFFER_BIT)", "glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)"),
        frame=3,
    ),
    "culled side": Case(
        ("cull-front",),
        CAMERA + CUBE + "glEnable(GL_CULL_FACE)\nglCullFace(GL_FRONT)\n",
        BEGIN + TURNED,
        ("GL_FRONT)", "GL_BACK)"),
    ),
    "clockwise": Case(
        ("front-face", "culled"),
        CAMERA + "glEnable(GL_CULL_FACE)\nglFrontFace(GL_CW)\n",
        BEGIN + BEHIND + QUAD,
        ("GL_CW", "GL_CCW"),
    ),
    "alpha": Case(
        ("alpha-test",),
        FLAT + "glEnable(GL_ALPHA_TEST)\nglAlphaFunc(GL_GREATER, 0.5)\n",
        CLEAR + "glColor4f(1, 1, 1, 1)\nglRectf(0, 0, 240, 20)\nglColor4f(1, 0, 0, 0.3)\n"
        "glRectf(60, 40, 200, 150)\n",
        ("0.3)", "0.9)"),
    ),
    "masked": Case(
        ("color-mask", "leak"),
        FLAT,
        CLEAR + "glRectf(0, 0, 240, 20)\nglColorMask(False, False, False, False)\n"
        "glRectf(60, 40, 200, 150)\nglColorMask(True, True, True, True)\n",
        ("False, False, False, False", "True, True, True, False"),
    ),
    "transparent": Case(
        ("alpha-zero",),
        FLAT + "glEnable(GL_BLEND)\nglBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)\n",
        CLEAR + "glColor4f(1, 1, 1, 1)\nglRectf(0, 0, 240, 20)\nglColor4f(1, 0, 0, 0)\n"
        "glRectf(60, 40, 200, 150)\n",
        ("(1, 0, 0, 0)", "(1, 0, 0, 0.5)"),
    ),
    "black on black": Case(
        ("same-color",),
        FLAT,
        CLEAR + "glColor3f(0, 0, 0)\nglRectf(60, 40, 200, 150)\n",
        ("(0, 0, 0)", "(1, 0, 0)"),
    ),
    "fog": Case(
        ("fog",),
        CAMERA + "glEnable(GL_FOG)\nglFogi(GL_FOG_MODE, GL_LINEAR)\nglFogf(GL_FOG_START, 1)\n"
        "glFogf(GL_FOG_END, 3)\n",
        BEGIN + QUAD,
        ("END, 3)", "END, 30)"),
    ),
    "covered": Case(
        ("overdrawn",),
        FLAT,
        CLEAR + "glColor3f(1, 0, 0)\nglRectf(60, 40, 200, 150)\nglColor3f(0, 0, 1)\n"
        "glRectf(0, 0, 240, 180)\n",
        ("(0, 0, 240, 180)", "(0, 0, 240, 30)"),
    ),
    "dark room": Case(
        ("light-off",),
        CAMERA + CUBE + "glEnable(GL_LIGHTING)\nglEnable(GL_COLOR_MATERIAL)\n",
        BEGIN + TURNED,
        ("glEnable(GL_LIGHTING)", "glEnable(GL_LIGHTING)\nglEnable(GL_LIGHT0)"),
    ),
    "second light": Case(
        ("light-black",),
        CAMERA + CUBE + "glEnable(GL_LIGHTING)\nglEnable(GL_LIGHT1)\nglEnable(GL_COLOR_MATERIAL)\n",
        BEGIN + TURNED,
        ("GL_LIGHT1", "GL_LIGHT0"),
    ),
    "no normals": Case(
        ("no-normals",),
        CAMERA
        + CUBE.replace("        glNormal3fv(normals[k])\n", "")
        + LIGHT
        + "glEnable(GL_COLOR_MATERIAL)\n",
        BEGIN + TURNED,
        ("    for k in range(6):\n", "    for k in range(6):\n        glNormal3fv(normals[k])\n"),
    ),
    "long normals": Case(
        ("normals-length",),
        CAMERA + CUBE + LIGHT + "glEnable(GL_COLOR_MATERIAL)\n",
        BEGIN + "glScalef(0.2, 0.2, 0.2)\n" + TURNED,
        ("glEnable(GL_LIGHT0)", "glEnable(GL_LIGHT0)\nglEnable(GL_NORMALIZE)"),
    ),
    "light behind": Case(
        ("light-far-side",),
        CAMERA
        + CUBE
        + LIGHT
        + "glEnable(GL_COLOR_MATERIAL)\nglLightfv(GL_LIGHT0, GL_POSITION, (0, 0, -1, 0))\n",
        BEGIN + "cube()\n",
        ("(0, 0, -1, 0)", "(0, 0, 1, 0)"),
    ),
    "incomplete": Case(
        ("texture-incomplete",),
        CAMERA
        + IMAGE.replace("glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)\n", "")
        + "glEnable(GL_TEXTURE_2D)\n",
        BEGIN + TEXTURED,
        (
            "glTexImage2D",
            "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)\nglTexImage2D",
        ),
    ),
    "not bound": Case(
        ("texture-not-bound", "texture-incomplete"),
        CAMERA
        + IMAGE
        + "glEnable(GL_TEXTURE_2D)\nglBindTexture(GL_TEXTURE_2D, glGenTextures(1))\n",
        BEGIN + TEXTURED,
        (
            "glEnable(GL_TEXTURE_2D)\nglBindTexture(GL_TEXTURE_2D, glGenTextures(1))",
            "glEnable(GL_TEXTURE_2D)",
        ),
    ),
    "texture left on": Case(
        ("texture-left",),
        CAMERA + IMAGE,
        BEGIN
        + "glEnable(GL_TEXTURE_2D)\nglColor3f(1, 1, 1)\n"
        + TEXTURED
        + "glColor3f(0, 1, 0)\nglTranslatef(1.5, 0, 0)\n"
        + QUAD,
        ("glTranslatef(1.5", "glDisable(GL_TEXTURE_2D)\n    glTranslatef(1.5"),
        pixel=(180, 90),
    ),
    "black times": Case(
        ("texture-times-black",),
        CAMERA + IMAGE + "glEnable(GL_TEXTURE_2D)\n",
        BEGIN + "glColor3f(0, 0, 0)\n" + TEXTURED,
        ("(0, 0, 0)\n    glBegin", "(1, 1, 1)\n    glBegin"),
    ),
    "stride": Case(
        ("stride",),
        FLAT
        + "data = np.array([[60, 40, 1, 0, 0], [200, 40, 0, 1, 0], [130, 150, 0, 0, 1]])\n"
        + "data = data.astype(np.float32)\n"
        "glBindBuffer(GL_ARRAY_BUFFER, glGenBuffers(1))\n"
        "glBufferData(GL_ARRAY_BUFFER, data.nbytes, data, GL_STATIC_DRAW)\n"
        "glEnableClientState(GL_VERTEX_ARRAY)\nglVertexPointer(2, GL_FLOAT, 8, None)\n",
        CLEAR + "glDrawArrays(GL_TRIANGLES, 0, 3)\n",
        ("GL_FLOAT, 8,", "GL_FLOAT, 20,"),
    ),
    "wide indices": Case(
        ("index-type",),
        FLAT + "data = np.array([[60, 40], [200, 40], [200, 150], [60, 150]], np.float32)\n"
        "order = np.array([0, 1, 2, 0, 2, 3])\n"
        "glBindBuffer(GL_ARRAY_BUFFER, glGenBuffers(1))\n"
        "glBufferData(GL_ARRAY_BUFFER, data.nbytes, data, GL_STATIC_DRAW)\n"
        "glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, glGenBuffers(1))\n"
        "glBufferData(GL_ELEMENT_ARRAY_BUFFER, order.nbytes, order, GL_STATIC_DRAW)\n"
        "glEnableClientState(GL_VERTEX_ARRAY)\nglVertexPointer(2, GL_FLOAT, 0, None)\n",
        CLEAR + "glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_INT, None)\n",
        ("[0, 1, 2, 0, 2, 3]", "[0, 1, 2, 0, 2, 3], np.uint32"),
    ),
    "empty list": Case(
        ("list-unknown",),
        FLAT
        + "shape = glGenLists(2)\nglNewList(shape + 1, GL_COMPILE)\nglRectf(60, 40, 200, 150)\n"
        + "glEndList()\n",
        CLEAR + "glCallList(shape)\n",
        ("glCallList(shape)", "glCallList(shape + 1)"),
    ),
    "bytes": Case(
        ("color-range-bytes",),
        FLAT,
        CLEAR + "glColor3ub(1, 1, 0)\nglRectf(60, 40, 200, 150)\n",
        ("glColor3ub", "glColor3f"),
    ),
    "push": Case(
        ("push-without-pop", "not-undone"),
        CAMERA,
        BEGIN
        + "glPushMatrix()\nglTranslatef(0, 0, 2)\n"
        + QUAD
        + "glTranslatef(0, 0, -1)\n"
        + BEHIND,
        ("glTranslatef(0, 0, -1)", "glPopMatrix()"),
    ),
    "aspect in a list": Case(
        ("aspect-zero",),
        "lens = glGenLists(1)\nglNewList(lens, GL_COMPILE)\n"
        + CAMERA.replace("240 / 180", "180 // 240")
        + "glEndList()\n",
        "glCallList(lens)\n" + BEGIN + QUAD,
        ("180 // 240", "240 / 180"),
    ),
    "camera in a list": Case(
        ("behind",),
        CAMERA
        + "view = glGenLists(1)\nglNewList(view, GL_COMPILE)\nglLoadIdentity()\n"
        + "gluLookAt(0, 0, 5, 0, 0, 9, 0, 1, 0)\nglEndList()\n",
        CLEAR + "glClear(GL_DEPTH_BUFFER_BIT)\nglCallList(view)\n" + QUAD,
        ("0, 0, 9, 0", "0, 0, 0, 0"),
    ),
    "no slices": Case(
        ("glu-nothing",), CAMERA + BALL, BEGIN + "gluSphere(ball, 1, 1, 12)\n", ("1, 1,", "1, 16,")
    ),
    "list not called": Case(
        ("list-not-called",),
        FLAT + "shape = glGenLists(1)\nglNewList(shape, GL_COMPILE)\nglRectf(60, 40, 200, 150)\n"
        "glEndList()\n",
        CLEAR,
        (
            "    glClear(GL_COLOR_BUFFER_BIT)\n",
            "    glClear(GL_COLOR_BUFFER_BIT)\n    glCallList(shape)\n",
        ),
    ),
    "no end of a list": Case(
        ("no-end-list",),
        FLAT + "shape = glGenLists(1)\nglNewList(shape, GL_COMPILE)\nglRectf(60, 40, 200, 150)\n",
        CLEAR + "glCallList(shape)\n",
        ("200, 150)\n", "200, 150)\nglEndList()\n"),
    ),
    "list base": Case(
        ("list-base",),
        FLAT + "base = glGenLists(2)\nglNewList(base + 1, GL_COMPILE)\nglRectf(60, 40, 200, 150)\n"
        "glEndList()\nglNewList(base, GL_COMPILE)\nglRectf(10, 10, 30, 30)\nglEndList()\n",
        CLEAR + "glListBase(base + 64)\nglCallLists(np.array([0, 1], np.uint8))\n",
        ("base + 64", "base"),
    ),
    "four channels": Case(
        ("image-format",),
        CAMERA
        + IMAGE.replace("32, 3)", "32, 4)").replace("(200, 100, 50)", "(200, 100, 50, 255)")
        + "glEnable(GL_TEXTURE_2D)\n",
        BEGIN + TEXTURED,
        ("0, GL_RGB, GL_UNSIGNED", "0, GL_RGBA, GL_UNSIGNED"),
    ),
    "two of three numbers": Case(
        ("pointer-size",),
        FLAT + "data = np.array([[60, 40, 0], [200, 40, 0], [130, 150, 0]], np.float32)\n"
        "glEnableClientState(GL_VERTEX_ARRAY)\nglVertexPointer(2, GL_FLOAT, 0, data)\n",
        CLEAR + "glDrawArrays(GL_TRIANGLES, 0, 3)\n",
        ("glVertexPointer(2", "glVertexPointer(3"),
    ),
    "faces counted": Case(
        ("count",),
        FLAT + "data = np.array([[60, 40], [200, 40], [200, 150], [60, 150]], np.float32)\n"
        "order = np.array([[0, 1, 2], [0, 2, 3]], np.uint32)\n"
        "glEnableClientState(GL_VERTEX_ARRAY)\nglVertexPointer(2, GL_FLOAT, 0, data)\n",
        CLEAR + "glDrawElements(GL_TRIANGLES, len(order), GL_UNSIGNED_INT, order)\n",
        ("len(order)", "order.size"),
    ),
    "colours as bytes": Case(
        ("color-range-bytes",),
        FLAT + "data = np.array([[60, 40], [200, 40], [130, 150]], np.float32)\n"
        "colors = np.array([[1, 0, 0], [0, 1, 0], [1, 1, 0]], np.uint8)\n"
        "glEnableClientState(GL_VERTEX_ARRAY)\nglEnableClientState(GL_COLOR_ARRAY)\n"
        "glVertexPointer(2, GL_FLOAT, 0, data)\n"
        "glColorPointer(3, GL_UNSIGNED_BYTE, 0, colors)\n",
        CLEAR + "glDrawArrays(GL_TRIANGLES, 0, 3)\n",
        ("0, colors)", "0, colors * 255)"),
    ),
    "colours left on": Case(
        ("array-left",),
        FLAT + "data = np.array([[20, 40], [100, 40], [60, 150]], np.float32)\n"
        "dark = np.full((3, 3), 0.1, np.float32)\n",
        CLEAR
        + "glEnableClientState(GL_VERTEX_ARRAY)\nglEnableClientState(GL_COLOR_ARRAY)\n"
        + "glVertexPointer(2, GL_FLOAT, 0, data)\nglColorPointer(3, GL_FLOAT, 0, dark)\n"
        + "glDrawArrays(GL_TRIANGLES, 0, 3)\n"
        + "glVertexPointer(2, GL_FLOAT, 0, data + 100)\nglColor3f(1, 0.8, 0)\n"
        + "glDrawArrays(GL_TRIANGLES, 0, 3)\n",
        (
            "    glVertexPointer(2, GL_FLOAT, 0, data + 100)",
            "    glDisableClientState(GL_COLOR_ARRAY)\n"
            "    glVertexPointer(2, GL_FLOAT, 0, data + 100)",
        ),
    ),
    "a square of triangles": Case(
        ("left-over",),
        FLAT,
        CLEAR
        + "glBegin(GL_TRIANGLES)\nfor x, y in ((60, 40), (200, 40), (200, 150), (60, 150)):\n"
        + "    glVertex2f(x, y)\nglEnd()\n",
        ("GL_TRIANGLES", "GL_QUADS"),
    ),
    "no vertices": Case(
        ("no-vertices",),
        FLAT,
        CLEAR
        + "glBegin(GL_TRIANGLES)\nfor k in range(3, 0):\n    glVertex2f(60 * k, 20 * k * k)\n"
        + "glEnd()\n",
        ("range(3, 0)", "range(3)"),
    ),
    "no map": Case(
        ("map-not-enabled",),
        FLAT + "points = np.array([[20, 20, 0], [90, 170, 0], [220, 60, 0]], np.float32)\n"
        "glMap1f(GL_MAP1_VERTEX_3, 0, 1, points)\n",
        CLEAR + "glBegin(GL_LINE_STRIP)\nfor k in range(21):\n    glEvalCoord1f(k / 20)\nglEnd()\n",
        ("0, 1, points)\n", "0, 1, points)\nglEnable(GL_MAP1_VERTEX_3)\n"),
    ),
    "logic": Case(
        ("logic-op",),
        FLAT + "glEnable(GL_COLOR_LOGIC_OP)\nglLogicOp(GL_NOOP)\n",
        CLEAR + "glRectf(60, 40, 200, 150)\n",
        ("GL_NOOP", "GL_COPY"),
    ),
    "tiny": Case(
        ("tiny",),
        CAMERA,
        BEGIN + "glScalef(0.001, 0.001, 0.001)\n" + QUAD,
        ("0.001, 0.001, 0.001", "0.9, 0.9, 0.9"),
    ),
    "camera wiped": Case(
        ("camera-wiped",),
        CAMERA + CUBE,
        CLEAR
        + "glClear(GL_DEPTH_BUFFER_BIT)\ngluLookAt(2, 3, 6, 0, 0, 0, 0, 1, 0)\n"
        + "glLoadIdentity()\ncube()\n",
        (
            "gluLookAt(2, 3, 6, 0, 0, 0, 0, 1, 0)\n    glLoadIdentity()",
            "glLoadIdentity()\n    gluLookAt(2, 3, 6, 0, 0, 0, 0, 1, 0)",
        ),
    ),
    "picking left": Case(
        ("pick-matrix-left",),
        "glMatrixMode(GL_PROJECTION)\ngluPickMatrix(20, 20, 5, 5, (0, 0, 240, 180))\n"
        + CAMERA.replace("glMatrixMode(GL_PROJECTION)\n", ""),
        BEGIN + QUAD,
        ("gluPickMatrix(20, 20, 5, 5, (0, 0, 240, 180))\n", ""),
    ),
    "zeros": Case(
        ("matrix-zero",),
        CAMERA + "matrix = np.diag((1.0, 1.0, 1.0, 0.0))\nmatrix[3, 2] = -5\n",
        CLEAR + "glLoadMatrixd(matrix)\n" + QUAD,
        ("1.0, 0.0))", "1.0, 1.0))"),
    ),
    "spot": Case(
        ("spot",),
        CAMERA
        + CUBE
        + LIGHT
        + "glEnable(GL_COLOR_MATERIAL)\nglLightfv(GL_LIGHT0, GL_POSITION, (0, 0, 1, 1))\n"
        + "glLightf(GL_LIGHT0, GL_SPOT_CUTOFF, 80)\n"
        + "glLightfv(GL_LIGHT0, GL_SPOT_DIRECTION, (0, 0, 1))\n",
        BEGIN + TURNED,
        ("(0, 0, 1))", "(0, 0, -1))"),
    ),
    "attenuation": Case(
        ("attenuation",),
        CAMERA
        + CUBE
        + LIGHT
        + "glEnable(GL_COLOR_MATERIAL)\nglLightfv(GL_LIGHT0, GL_POSITION, (9, 9, 9, 1))\n"
        + "glLightf(GL_LIGHT0, GL_QUADRATIC_ATTENUATION, 1)\n",
        BEGIN + TURNED,
        ("ATTENUATION, 1)", "ATTENUATION, 0.001)"),
    ),
    "material of the back": Case(
        ("material-face",),
        CAMERA + CUBE + LIGHT,
        BEGIN + "glMaterialfv(GL_BACK, GL_DIFFUSE, (0.9, 0.1, 0.1, 1))\n" + TURNED,
        ("GL_BACK", "GL_FRONT"),
    ),
    "specular colours": Case(
        ("color-material-which",),
        CAMERA
        + CUBE
        + LIGHT
        + "glColorMaterial(GL_FRONT, GL_SPECULAR)\nglEnable(GL_COLOR_MATERIAL)\n",
        BEGIN + "glColor3f(0.9, 0.1, 0.1)\n" + TURNED,
        ("GL_SPECULAR", "GL_AMBIENT_AND_DIFFUSE"),
    ),
    "far, in two views": Case(
        ("beyond-far",),
        """glEnable(GL_DEPTH_TEST)


def view(angle, x):
    glViewport(x, 0, 120, 180)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(angle, 120 / 180, 0.5, 3)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, 0, -5)


""",
        "glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)\n"
        "glViewport(0, 0, 240, 180)\nglMatrixMode(GL_PROJECTION)\nglLoadIdentity()\n"
        "glMatrixMode(GL_MODELVIEW)\nglLoadIdentity()\nglRectf(-1, -1, 1, -0.9)\n"
        "for angle, x in ((40, 0), (60, 120)):\n    view(angle, x)\n"
        "    glRectf(-1, -1, 1, 1)\n",
        ("0.5, 3)", "0.5, 30)"),
        pixel=(180, 90),
    ),
    "projection wiped, and text after it": Case(
        ("projection-wiped",),
        "points = np.array([[[-1, -1, 0], [1, -1, 0]], [[-1, 1, 0], [1, 1, 0]]], np.float32)\n"
        "glEnable(GL_MAP2_VERTEX_3)\nglMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, points)\n"
        "glMapGrid2f(4, 0, 1, 4, 0, 1)\n"
        "glMatrixMode(GL_PROJECTION)\ngluPerspective(45, 240 / 180, 0.5, 50)\n",
        """\
glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
glLoadIdentity()
gluLookAt(0, 0, 5, 0, 0, 0, 0, 1, 0)
glEvalMesh2(GL_FILL, 0, 4, 0, 4)
glPushAttrib(GL_TRANSFORM_BIT)
glMatrixMode(GL_PROJECTION)
glPushMatrix()
glLoadIdentity()
glOrtho(0, 240, 0, 180, -1, 1)
glMatrixMode(GL_MODELVIEW)
glPushMatrix()
glLoadIdentity()
glRectf(10, 10, 60, 20)
glPopMatrix()
glMatrixMode(GL_PROJECTION)
glPopMatrix()
glPopAttrib()
""",
        ("0.5, 50)\n", "0.5, 50)\nglMatrixMode(GL_MODELVIEW)\n"),
        pixel=(120, 90),
    ),
    "masked but for alpha": Case(
        ("color-mask",),
        FLAT,
        CLEAR + "glColorMask(False, False, False, True)\nglRectf(60, 40, 200, 150)\n",
        ("False, False, False, True", "True, True, True, True"),
    ),
    "lighting off after the lamp": Case(
        ("lighting-off",),
        CAMERA + CUBE + LIGHT,
        BEGIN
        + "glDisable(GL_LIGHTING)\nglColor3f(0.9, 0.9, 0.5)\nglRectf(-2, -2, -1.5, -1.5)\n"
        + "glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (0.9, 0.1, 0.1, 1))\n"
        + TURNED,
        ("glMaterialfv", "glEnable(GL_LIGHTING)\n    glMaterialfv"),
    ),
    "lit from the far side in one view": Case(
        ("light-far-side",),
        CAMERA + CUBE + LIGHT + "glEnable(GL_COLOR_MATERIAL)\n",
        BEGIN
        + "glTranslatef(-1.4, 0, -2)\nglLightfv(GL_LIGHT0, GL_POSITION, (0, 0, -1, 0))\ncube()\n"
        + "glTranslatef(2.8, 0, 0)\nglLightfv(GL_LIGHT0, GL_POSITION, (0, 0, 1, 0))\ncube()\n",
        ("(0, 0, -1, 0)", "(0, 0, 1, 0)"),
        pixel=(90, 90),
    ),
    "an array's colours lit": Case(
        ("no-color-material",),
        FLAT
        + LIGHT
        + "data = np.array([[60, 40], [200, 40], [130, 150]], np.float32)\n"
        + "colors = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1]], np.float32)\n"
        + "glEnableClientState(GL_VERTEX_ARRAY)\nglEnableClientState(GL_COLOR_ARRAY)\n"
        + "glVertexPointer(2, GL_FLOAT, 0, data)\nglColorPointer(3, GL_FLOAT, 0, colors)\n"
        + "glNormal3f(0, 0, 1)\n",
        CLEAR
        + "glDrawArrays(GL_TRIANGLES, 0, 3)\nglPushAttrib(GL_ALL_ATTRIB_BITS)\n"
        + "glDisable(GL_LIGHTING)\nglDisable(GL_COLOR_MATERIAL)\nglRectf(0, 0, 240, 20)\n"
        + "glPopAttrib()\n",
        ("glNormal3f", "glEnable(GL_COLOR_MATERIAL)\nglNormal3f"),
        frame=1,
    ),
    "texture disabled, never enabled": Case(
        ("texture-off",),
        CAMERA + IMAGE + "first = image.copy()\n" + IMAGE,
        BEGIN
        + "glColor3f(1, 1, 1)\nglBindTexture(GL_TEXTURE_2D, 1)\n"
        + TEXTURED
        + "glDisable(GL_TEXTURE_2D)\nglPushAttrib(GL_ENABLE_BIT)\nglEnable(GL_TEXTURE_2D)\n"
        + "glBindTexture(GL_TEXTURE_2D, 2)\nglTranslatef(2.2, 0, 0)\n"
        + TEXTURED
        + "glPopAttrib()\n",
        ("GL_TEXTURE_2D, 1)", "GL_TEXTURE_2D, 1)\n    glEnable(GL_TEXTURE_2D)"),
        pixel=(120, 90),
    ),
    "blending asked for, and on for others": Case(
        ("no-blend",),
        FLAT,
        CLEAR
        + "glColor4f(0, 0, 1, 1)\nglRectf(0, 0, 240, 100)\n"
        + "glBlendFunc(GL_SRC_ALPHA, GL_ONE)\nglColor4f(1, 0, 0, 0.5)\n"
        + "glRectf(60, 40, 120, 150)\nglRectf(80, 60, 140, 170)\nglDisable(GL_BLEND)\n"
        + "glEnable(GL_BLEND)\nglBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)\n"
        + "glRectf(180, 60, 220, 120)\nglDisable(GL_BLEND)\n",
        ("glBlendFunc(GL_SRC_ALPHA, GL_ONE)", "glEnable(GL_BLEND); glBlendFunc(GL_SRC_ALPHA, 1)"),
        pixel=(100, 90),
    ),
}

RIGHT = {
    "one lamp after the other": Case(
        (),
        CAMERA + CUBE + LIGHT + "glEnable(GL_COLOR_MATERIAL)\n",
        BEGIN
        + "glLightfv(GL_LIGHT0, GL_POSITION, (0, 3, 3, 1))\nglDisable(GL_LIGHT0)\n"
        + "glLightfv(GL_LIGHT1, GL_POSITION, (3, 0, 3, 1))\n"
        + "glLightfv(GL_LIGHT1, GL_DIFFUSE, (1, 1, 1, 1))\nglEnable(GL_LIGHT1)\n"
        + TURNED
        + "glDisable(GL_LIGHT1)\nglEnable(GL_LIGHT0)\n",
        pixel=(120, 90),
    ),
    "a shape with a texture, and without": Case(
        (),
        CAMERA
        + IMAGE
        + "\n\ndef square():\n"
        + "".join(f"    {line}\n" for line in TEXTURED.splitlines())
        + "\n\n",
        BEGIN
        + "glTranslatef(-1.1, 0, -1)\nglEnable(GL_TEXTURE_2D)\nglColor3f(1, 1, 1)\nsquare()\n"
        + "glDisable(GL_TEXTURE_2D)\nglRectf(0, 1.2, 1, 1.5)\nglTranslatef(2.2, 0, 0)\n"
        + "glColor3f(0.9, 0.5, 0.2)\nsquare()\n",
        pixel=(160, 90),
    ),
    "a sky around of the colour that was cleared": Case(
        (),
        CAMERA
        + "texture = int(np.ravel(glGenTextures(1))[0])\n"
        + "glBindTexture(GL_TEXTURE_CUBE_MAP, texture)\n"
        + "glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_NEAREST)\n"
        + "for k in range(6):\n"
        + "    glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + k, 0, GL_RGB, 1, 1, 0, GL_RGB,\n"
        + "                 GL_UNSIGNED_BYTE, np.array([0, 0, 255], np.uint8))\n"
        + "glClearColor(0, 0, 1, 1)\n",
        BEGIN
        + "glColor3f(1, 1, 1)\nglRectf(-3, -2, 3, -1.2)\nglEnable(GL_TEXTURE_CUBE_MAP)\n"
        + "glRectf(-1, -1, 1, 1)\nglDisable(GL_TEXTURE_CUBE_MAP)\n",
        pixel=(120, 90),
    ),
    "light painted into a texture": Case(
        (),
        CAMERA + IMAGE + "glEnable(GL_LIGHT0)\nglEnable(GL_TEXTURE_2D)\n",
        BEGIN + "glNormal3f(0, 0.6, 0.8)\n" + TEXTURED,
        pixel=(120, 90),
    ),
    "fragments counted": Case(
        (),
        FLAT + "query = int(np.ravel(glGenQueries(1))[0])\n",
        CLEAR
        + "glRectf(0, 0, 240, 20)\nglColorMask(False, False, False, False)\n"
        + "glBeginQuery(GL_SAMPLES_PASSED, query)\nglRectf(60, 40, 200, 150)\n"
        + "glEndQuery(GL_SAMPLES_PASSED)\nglColorMask(True, True, True, True)\n",
        pixel=(120, 90),
    ),
    "a mirror out of sight": Case(
        (),
        FLAT + "glfw.window_hint(glfw.STENCIL_BITS, 8)\n",
        CLEAR
        + "glClear(GL_STENCIL_BUFFER_BIT)\nglRectf(0, 0, 240, 20)\nglEnable(GL_STENCIL_TEST)\n"
        + "glStencilFunc(GL_ALWAYS, 1, 1)\nglStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)\n"
        + "glRectf(400, 400, 500, 500)\n"
        + "glStencilFunc(GL_EQUAL, 1, 1)\nglStencilOp(GL_KEEP, GL_KEEP, GL_KEEP)\n"
        + "glColor3f(1, 0, 0)\nglRectf(60, 40, 200, 150)\nglDisable(GL_STENCIL_TEST)\n"
        + "glColor3f(1, 1, 1)\n",
        pixel=(120, 90),
    ),
    "a background behind all": Case(
        (),
        CAMERA
        + """

def background(x, blue):
    glDepthRange(1, 1)
    glDepthFunc(GL_LEQUAL)
    glColor3f(0, 0, blue)
    glRectf(x - 0.5, -0.5, x + 0.5, 0.5)
    glDepthRange(0, 1)


""",
        BEGIN
        + "glColor3f(1, 1, 1)\nglRectf(-1, -1, 1, 1)\nglTranslatef(0, 0, 1)\n"
        + "background(1.5, 1)\nbackground(0, 0.5)\n",
        pixel=(120, 90),
    ),
}
"""Programs that mean what they do, at a pixel where another one would be mistaken."""
