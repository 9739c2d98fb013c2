"""Two lights: behind the viewer, and on the world's z axis

The same numbers, (0, 0, 1, 0), as the position of a light: a direction along z, infinitely far
away. Given before gluLookAt they are counted in the camera's frame, and the light comes from behind
the viewer, wherever they go. Given after it they are counted in the world's frame, and the light
stays with the teapot. On the left are the two frames and both lights from outside, on the right is
what the camera sees.

Keys: the arrows lead the camera around; Space gives the position before or after gluLookAt.
"""
# topic: light
# needs: camera_light, world_light, teapot
# picture: frame 0
# keys: LEFT RIGHT UP DOWN SPACE
# programs: light_of_camera light_of_world

import math
import sys
from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from OpenGL.GLU import gluLookAt, gluPerspective
from text import _, write

PATCHES = np.loadtxt(Path(__file__).parent / "data" / "teapot.txt").reshape(32, 4, 4, 3)
DIRECTION = (0, 0, 1, 0)
DISTANCE = 6
# The camera: degrees around the teapot, and degrees above it.
turn = 50
lift = 25
carried = False  # the light is given in the camera's frame

CAMERA_LIGHT = (1, 0.6, 0.45)
WORLD_LIGHT = (0.55, 0.85, 0.85)
GREY = (0.45, 0.5, 0.57)


def draw_teapot(size):
    """Draw the patches; GL_AUTO_NORMAL lets the evaluator compute their normals, too."""
    glEnable(GL_MAP2_VERTEX_3)
    glEnable(GL_AUTO_NORMAL)
    glMapGrid2f(10, 0, 1, 10, 0, 1)
    for patch in PATCHES:
        glMap2f(GL_MAP2_VERTEX_3, 0, 1, 0, 1, size * patch)
        glEvalMesh2(GL_FILL, 0, 10, 0, 10)
    glDisable(GL_AUTO_NORMAL)
    glDisable(GL_MAP2_VERTEX_3)


def draw_arrow(color, sent):
    """Draw a light that comes along -z to the origin: three parallel arrows if it is ``sent``."""
    glColor3f(*color)
    glBegin(GL_LINES)
    for x, y in ((0, 0), (0.35, 0), (-0.35, 0)) if sent else ((0, 0),):
        glVertex3f(x, y, 3.6)
        glVertex3f(x, y, 1.8)
        for side in (-0.12, 0.12):
            glVertex3f(x, y, 1.8)
            glVertex3f(x + side, y, 2.05)
    glEnd()


def draw_axes(length):
    for tip in ((length, 0, 0), (0, length, 0), (0, 0, length)):
        glColor3f(*(0.45 + 0.5 * (value > 0) for value in tip))
        glBegin(GL_LINES)
        glVertex3f(0, 0, 0)
        glVertex3f(*tip)
        glEnd()
        write(3, 0, "xyz"[[value > 0 for value in tip].index(True)], at=tip)


def draw_outside():
    """Draw both frames and both lights, with lighting off."""
    gluLookAt(9, 8, 12, 1.7, 0.6, 1.9, 0, 1, 0)
    draw_axes(2.4)
    draw_arrow(WORLD_LIGHT, not carried)
    glPushMatrix()
    glRotatef(turn, 0, 1, 0)  # to the camera's frame
    glRotatef(-lift, 1, 0, 0)
    draw_arrow(CAMERA_LIGHT, carried)
    glTranslatef(0, 0, DISTANCE)
    draw_axes(0.9)
    draw_camera()
    glPopMatrix()


def draw_camera():
    """Draw the camera as a pyramid, with its tip at the eye."""
    glColor3f(0.95, 0.9, 0.8)
    glBegin(GL_LINES)
    for x, y in ((-0.4, -0.3), (0.4, -0.3), (0.4, 0.3), (-0.4, 0.3)):
        glVertex3f(0, 0, 0)
        glVertex3f(x, y, -0.8)
    glEnd()
    write(-30, -24, "camera", at=(0, 0, 0))


def set_projection(angle, aspect):
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(angle, aspect, 1, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def draw(width, height):
    bottom = int(64 * (height // 480 or height / 480))  # above the text
    middle = width // 2
    aspect = middle / (height - bottom)
    around = math.radians(turn)
    above = math.radians(lift)
    eye = (math.sin(around) * math.cos(above), math.sin(above), math.cos(around) * math.cos(above))
    glLineWidth(height / 240)

    glViewport(0, bottom, middle, height - bottom)
    set_projection(36, aspect)
    draw_outside()
    glEnable(GL_LIGHTING)
    if carried:  # seen from outside, the camera's light is where the camera is
        glLightfv(GL_LIGHT0, GL_POSITION, (*eye, 0))
    else:
        glLightfv(GL_LIGHT0, GL_POSITION, DIRECTION)
    draw_teapot(1)
    glDisable(GL_LIGHTING)

    glViewport(middle, bottom, middle, height - bottom)
    set_projection(34, aspect)
    if carried:
        glLightfv(GL_LIGHT0, GL_POSITION, DIRECTION)
    gluLookAt(*(DISTANCE * value for value in eye), 0, 0, 0, 0, 1, 0)
    if not carried:
        glLightfv(GL_LIGHT0, GL_POSITION, DIRECTION)
    draw_axes(2.4)
    glEnable(GL_LIGHTING)
    draw_teapot(1)
    glDisable(GL_LIGHTING)

    glViewport(0, 0, width, height)
    write(16, 40, "glLightfv before gluLookAt", CAMERA_LIGHT if carried else GREY)
    write(16, 16, "glLightfv after gluLookAt", GREY if carried else WORLD_LIGHT)


def on_key(window, key, scancode, action, mods):
    global carried, lift, turn
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn -= 15
    elif key == glfw.KEY_RIGHT:
        turn += 15
    elif key == glfw.KEY_DOWN:
        lift = max(-75, lift - 10)
    elif key == glfw.KEY_UP:
        lift = min(75, lift + 10)
    elif key == glfw.KEY_SPACE:
        carried = not carried
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Two lights"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for capability in (GL_DEPTH_TEST, GL_LIGHT0, GL_NORMALIZE):
        glEnable(capability)
    glLightfv(GL_LIGHT0, GL_DIFFUSE, (0.8, 0.8, 0.8, 1))
    glLightfv(GL_LIGHT0, GL_SPECULAR, (0.6, 0.6, 0.6, 1))
    glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT, (0.7, 0.6, 0.5, 1))
    glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, (0.9, 0.8, 0.65, 1))
    glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, (1, 1, 1, 1))
    glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 110)
    glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, True)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw(*glfw.get_framebuffer_size(window))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
