"""Quadrics: spheres, cylinders, cones and disks from GLU

GLU draws round bodies from a few numbers. A quadric object, made by gluNewQuadric, holds how:
filled or as lines, with which normals, and with or without texture coordinates. gluSphere,
gluCylinder and gluDisk then take the sizes, and how many pieces around and along. A cylinder with
one radius 0 is a cone. All lie along the z axis. None is closed: the inside of the cylinder has a
material of its own.

Keys: 1 filled, 2 lines, 3 points; N smooth, flat or no normals; Space takes the texture away;
Left and Right change the number of pieces.
"""
# topic: textures
# needs: textured_sphere, tetrahedron
# picture: frame 0
# keys: 2 3 1 N SPACE LEFT RIGHT
# programs: file_texture

import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from OpenGL.GLU import *
from PIL import Image
from text import _, write

STYLES = ((GLU_FILL, "GLU_FILL"), (GLU_LINE, "GLU_LINE"), (GLU_POINT, "GLU_POINT"))
NORMALS = ((GLU_SMOOTH, "GLU_SMOOTH"), (GLU_FLAT, "GLU_FLAT"), (GLU_NONE, "GLU_NONE"))
SPHERE, CYLINDER, CONE, DISK, PARTIAL_DISK = range(5)
LABELS = ("gluSphere", "gluCylinder", "a cone", "gluDisk", "gluPartialDisk")
style = 0
normals = 0
textured = True
slices = 24


def make_texture():
    image = Image.open(Path(__file__).parent / "data" / "brick.png").convert("RGB")
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    texels = image.tobytes()
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, *image.size, 0, GL_RGB, GL_UNSIGNED_BYTE, texels)


def draw_quadric(quadric, number):
    if number == SPHERE:
        gluSphere(quadric, 0.9, slices, slices // 2)
    elif number == CYLINDER:
        gluCylinder(quadric, 0.7, 0.7, 1.5, slices, 4)  # radius at z = 0, at the top, height
    elif number == CONE:
        gluCylinder(quadric, 0.9, 0, 1.6, slices, 4)
    elif number == DISK:
        gluDisk(quadric, 0.35, 1, slices, 2)  # inner and outer radius
    else:
        gluPartialDisk(quadric, 0.35, 1, slices, 2, 40, 250)  # from 40 degrees, 250 degrees wide


def draw_shapes():
    quadric = gluNewQuadric()
    gluQuadricDrawStyle(quadric, STYLES[style][0])
    gluQuadricNormals(quadric, NORMALS[normals][0])
    gluQuadricTexture(quadric, textured)
    if textured:
        glEnable(GL_TEXTURE_2D)
    if NORMALS[normals][0] == GLU_NONE:
        glNormal3f(0, 0, 1)  # one for all, as the quadric gives none
    for number in range(5):
        glPushMatrix()
        glTranslatef(*place(number), 0)
        glRotatef(-58, 1, 0, 0)  # z, the axis of all quadrics, now points upwards
        glRotatef(25, 0, 0, 1)
        if number in (CYLINDER, CONE):
            glTranslatef(0, 0, -0.75)
        draw_quadric(quadric, number)
        glPopMatrix()

    glDisable(GL_TEXTURE_2D)
    gluDeleteQuadric(quadric)


def place(number):
    """Return where a shape is: three in the upper row, two in the lower one."""
    if number < 3:
        return 2.6 * number - 2.6, 1.25
    return 2.6 * (number - 3) - 1.3, -1.25


def look(width, height):
    glViewport(0, 0, width, height)
    glPointSize(height / 160)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-3 * width / height, 3 * width / height, -3.4, 2.6, -3, 3)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glLightfv(GL_LIGHT0, GL_POSITION, (-0.6, 0.8, 1, 0))


def on_key(window, key, scancode, action, mods):
    global normals, slices, style, textured
    if action == glfw.RELEASE:
        return
    if glfw.KEY_1 <= key < glfw.KEY_1 + 3:
        style = key - glfw.KEY_1
    elif key == glfw.KEY_N:
        normals = (normals + 1) % 3
    elif key == glfw.KEY_SPACE:
        textured = not textured
    elif key == glfw.KEY_LEFT:
        slices = max(4, slices - 4)
    elif key == glfw.KEY_RIGHT:
        slices = min(48, slices + 4)
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Quadrics"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0):
        glEnable(capability)
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, True)  # backs are lit, too, with a turned normal
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (0.95, 0.85, 0.75, 1))
    glMaterialfv(GL_BACK, GL_AMBIENT_AND_DIFFUSE, (0.25, 0.6, 0.6, 1))
    glClearColor(0.13, 0.16, 0.21, 1)
    make_texture()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_shapes()
        for number, label in enumerate(LABELS):
            x, y = place(number)
            write(-5 * len(_(label)), -4, label, (0.95, 0.9, 0.8), at=(x, y - 1.25, 0))

        write(16, 40, "{style}, {normals}", style=STYLES[style][1], normals=NORMALS[normals][1])
        write(16, 16, "{slices} slices", slices=slices)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
