"""Random programs that are right: shapes of several kinds, each seen, drawn in the usual ways.

A program is put together from the parts of a first course: a projection and a camera, shapes by
glBegin, from arrays, buffers, display lists and GLU's quadrics, and around each of them state that
is set and set back: light, textures, culling, blending, fog, a stencil, a clip plane, text.
"""

import random

HEAD = """\
import ctypes
import glfw
import numpy as np
from OpenGL.GL import *
from OpenGL.GLU import *

glfw.init()
window = glfw.create_window({width}, {height}, "scene", None, None)
glfw.make_context_current(window)
"""
CUBE = """\
corners = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], np.float32)
faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
normals = ((0, 0, -1), (0, 0, 1), (0, -1, 0), (0, 1, 0), (-1, 0, 0), (1, 0, 0))


def cube():
    glBegin(GL_QUADS)
    for normal, face in zip(normals, faces):
        glNormal3fv(normal)
        for corner, (s, t) in zip(face, ((0, 0), (1, 0), (1, 1), (0, 1))):
            glTexCoord2f(s, t)
            glVertex3fv(corners[corner])
    glEnd()


"""
BALL = """\
quadric = gluNewQuadric()
gluQuadricTexture(quadric, GL_TRUE)


def ball():
    gluSphere(quadric, 1.2, {slices}, {stacks})


"""
CONE = """\
cone_list = glGenLists(1)
glNewList(cone_list, GL_COMPILE)
side = gluNewQuadric()
gluCylinder(side, 1, 0, 2, {slices}, 3)
gluQuadricOrientation(side, GLU_INSIDE)
gluDisk(side, 0, 1, {slices}, 1)
glEndList()


def cone():
    glRotatef(-90, 1, 0, 0)
    glCallList(cone_list)


"""
DISK = """\
turn = np.linspace(0, 2 * np.pi, {slices}, endpoint=False)
rim = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1).astype(np.float32)


def disk():
    glNormal3f(0, 0, 1)
    glEnableClientState(GL_VERTEX_ARRAY)
    glVertexPointer(3, GL_FLOAT, 0, rim)
    glDrawArrays(GL_TRIANGLE_FAN, 0, {slices})
    glDisableClientState(GL_VERTEX_ARRAY)


"""
PYRAMID = """\
points = np.array(
    [[-1, -1, 1], [1, -1, 1], [1, -1, -1], [-1, -1, -1], [0, 1, 0]], np.float32
)
order = np.array([0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 3, 2, 0, 2, 1], np.uint32)
flat = points[order]
across = np.cross(flat[1::3] - flat[0::3], flat[2::3] - flat[0::3])
across /= np.linalg.norm(across, axis=1)[:, None]
rows = np.hstack([flat, np.repeat(across, 3, axis=0)]).astype(np.float32)
buffer = glGenBuffers(1)
glBindBuffer(GL_ARRAY_BUFFER, buffer)
glBufferData(GL_ARRAY_BUFFER, rows.nbytes, rows, GL_STATIC_DRAW)
glBindBuffer(GL_ARRAY_BUFFER, 0)


def pyramid():
    glBindBuffer(GL_ARRAY_BUFFER, buffer)
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_NORMAL_ARRAY)
    glVertexPointer(3, GL_FLOAT, 24, ctypes.c_void_p(0))
    glNormalPointer(GL_FLOAT, 24, ctypes.c_void_p(12))
    glDrawArrays(GL_TRIANGLES, 0, 18)
    glDisableClientState(GL_NORMAL_ARRAY)
    glDisableClientState(GL_VERTEX_ARRAY)
    glBindBuffer(GL_ARRAY_BUFFER, 0)


"""
RIBBON = """\
def ribbon():
    glNormal3f(0, 0, 1)
    glBegin({mode})
    for k in range(9):
        glVertex3f(k / 4 - 1, -0.4 + 0.1 * (k % 3), 0)
        glVertex3f(k / 4 - 1, 0.5 - 0.1 * (k % 2), 0)
    glEnd()


"""
WIRE = """\
def frame():
    glDisable(GL_LIGHTING)
    glLineWidth({wide})
    glBegin(GL_LINE_LOOP)
    for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        glVertex2f(x, y)
    glEnd()
    glPointSize(9)
    glBegin(GL_POINTS)
    glVertex3f(0, 0, 0)
    glEnd()
{light}

"""
IMAGE = """\
image = np.random.default_rng({seed}).integers(60, 256, (16, 16, 3)).astype(np.uint8)
texture = glGenTextures(1)
glBindTexture(GL_TEXTURE_2D, texture)
glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)
glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 16, 16, 0, GL_RGB, GL_UNSIGNED_BYTE, image)
"""
LIGHT = """\
glEnable(GL_LIGHTING)
glEnable(GL_LIGHT0)
glEnable(GL_COLOR_MATERIAL)
glEnable(GL_NORMALIZE)
glLightfv(GL_LIGHT0, GL_POSITION, (2, 4, 6, {w}))
"""
OVERLAY = """\
    glMatrixMode(GL_PROJECTION)
    glPushMatrix()
    glLoadIdentity()
    glOrtho(0, {width}, 0, {height}, -1, 1)
    glMatrixMode(GL_MODELVIEW)
    glPushMatrix()
    glLoadIdentity()
    glPushAttrib(GL_ENABLE_BIT)
    for name in (GL_DEPTH_TEST, GL_LIGHTING, GL_TEXTURE_2D, GL_FOG, GL_CULL_FACE):
        glDisable(name)
    glColor3f(1, 1, 0.2)
    glRectf(10, 10, 90, 30)
    glPopAttrib()
    glPopMatrix()
    glMatrixMode(GL_PROJECTION)
    glPopMatrix()
    glMatrixMode(GL_MODELVIEW)
"""
GLASS = """\
    glEnable(GL_BLEND)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glDepthMask(GL_FALSE)
    glColor4f(0.4, 0.7, 1, 0.5)
    glPushMatrix()
    glTranslatef(0, 0, 2)
    glScalef(2, 1, 1)
    glBegin(GL_QUADS)
    glNormal3f(0, 0, 1)
    for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        glVertex2f(x, y)
    glEnd()
    glPopMatrix()
    glDepthMask(GL_TRUE)
    glDisable(GL_BLEND)
"""
END = """\
    glfw.swap_buffers(window)
    glfw.poll_events()
    count += 1
glfw.terminate()
"""
SOLIDS = ("cube", "ball", "cone", "pyramid")
SHEETS = ("disk", "ribbon", "frame")


def program(dice: random.Random) -> str:
    """Return the text of a random program, which draws with GLFW."""
    width, height = dice.choice(((400, 300), (320, 320), (300, 400)))
    light = dice.random() < 0.5
    parts = [HEAD.format(width=width, height=height), CUBE]
    slices, stacks = dice.randrange(8, 24), dice.randrange(6, 16)
    parts.append(BALL.format(slices=slices, stacks=stacks))
    parts.append(CONE.format(slices=slices))
    parts.append(DISK.format(slices=slices))
    parts.append(PYRAMID)
    parts.append(RIBBON.format(mode=dice.choice(("GL_QUAD_STRIP", "GL_TRIANGLE_STRIP"))))
    again = "    glEnable(GL_LIGHTING)\n" if light else ""
    parts.append(WIRE.format(wide=dice.choice((1, 3)), light=again))
    image = IMAGE.format(seed=dice.randrange(1000))
    loading = len(parts)
    parts.append("glEnable(GL_DEPTH_TEST)\n")
    culling = dice.random() < 0.4
    if light:
        parts.append(LIGHT.format(w=dice.choice((0, 1))))
    if dice.random() < 0.3:
        parts.append("glEnable(GL_FOG)\nglFogi(GL_FOG_MODE, GL_LINEAR)\n")
        parts.append("glFogf(GL_FOG_START, 6)\nglFogf(GL_FOG_END, 40)\n")
    parts.append(_projection(dice, width, height))
    parts.append(f"glClearColor{tuple(round(dice.uniform(0, 0.3), 2) for _ in range(4))}\n")
    parts.append("count = 0\nwhile not glfw.window_should_close(window):\n")
    parts.append("    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)\n    glLoadIdentity()\n")
    if dice.random() < 0.5:
        parts.append("    glTranslatef(0, 0, -9)\n")
    else:
        parts.append("    gluLookAt(1, 2, 9, 0, 0, 0, 0, 1, 0)\n")

    for _ in range(dice.randrange(2, 6)):
        parts.append(_shape(dice, culling))
    if dice.random() < 0.3:
        parts.append(GLASS)
    if dice.random() < 0.3:
        parts.append(OVERLAY.format(width=width, height=height))
    if any("glEnable(GL_TEXTURE_2D)" in part for part in parts):
        parts.insert(loading, image)
    return "".join([*parts, END])


def _projection(dice: random.Random, width: int, height: int) -> str:
    aspect = width / height
    kinds = (
        f"gluPerspective(50, {aspect:.4f}, 1, 60)",
        f"glFrustum({-aspect / 2:.4f}, {aspect / 2:.4f}, -0.5, 0.5, 1, 50)",
        f"glOrtho({-4 * aspect:.4f}, {4 * aspect:.4f}, -4, 4, 0, 50)",
    )
    kind = dice.choice(kinds)
    return f"glMatrixMode(GL_PROJECTION)\n{kind}\nglMatrixMode(GL_MODELVIEW)\n"


def _shape(dice: random.Random, culling: bool) -> str:
    """Return the lines that draw one shape somewhere in the view, and set back what they set."""
    name = dice.choice(SOLIDS + SHEETS)
    color = tuple(round(dice.uniform(0.4, 1.0), 2) for _ in range(3))
    place = (round(dice.uniform(-2, 2), 2), round(dice.uniform(-2, 2), 2), dice.choice((-2, 0, 1)))
    lines = ["glPushMatrix()", f"glTranslatef{place}"]
    if name in SOLIDS:
        lines.append(
            f"glRotatef({dice.randrange(360)} + count, {dice.choice(('1, 1, 0', '0, 1, 0'))})"
        )
    if dice.random() < 0.3:
        lines.append(f"glScalef({dice.choice((0.5, 0.8, 1.4))}, 0.7, 0.7)")
    textured = name in ("cube", "ball") and dice.random() < 0.5
    culled = culling and name in ("cube", "ball", "pyramid")
    lines.append(f"glColor3f{(1, 1, 1) if textured else color}")
    for wanted, flag in ((textured, "GL_TEXTURE_2D"), (culled, "GL_CULL_FACE")):
        if wanted:
            lines.append(f"glEnable({flag})")
    lines.append(f"{name}()")
    for wanted, flag in ((textured, "GL_TEXTURE_2D"), (culled, "GL_CULL_FACE")):
        if wanted:
            lines.append(f"glDisable({flag})")
    lines.append("glPopMatrix()")
    return "".join(f"    {line}\n" for line in lines)
