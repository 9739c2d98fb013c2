"""Stencil buffer: an image that leaves its mirror

A round mirror stands on a chessboard, with a lamp and a jug in front of it. draw_image draws what
it shows, upright and in the right place behind it. But one sees the image beside the mirror as
well, as if there were two lamps and two jugs. Fill in draw_reflection, so that the image is drawn
only where the glass is.

- First mark the pixels of the glass in the stencil buffer: draw_glass draws it. Neither the picture
  nor the depth buffer may change by that; the image is farther away than the glass.

- Then draw the image, and let the stencil test keep out all other pixels.

- The marks of one frame must not be there in the next.

After draw_reflection the stencil test is off, and what is drawn later is drawn as before.

Keys: Left and Right go round.
"""
# exercise: stencil_mirror

import math
import sys

import glfw
from OpenGL.GL import *

LIGHT = (-2, 4, 3, 0)
turn = 20  # degrees


def draw_round(profile, color):
    """Draw a body of revolution: profile lists its radii and heights, from the bottom."""
    glColor3f(*color)
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        slope = math.hypot(r1 - r0, y1 - y0)
        glBegin(GL_QUAD_STRIP)
        for step in range(33):
            x = math.sin(math.pi * step / 16)
            z = math.cos(math.pi * step / 16)
            glNormal3f((y1 - y0) / slope * x, (r0 - r1) / slope, (y1 - y0) / slope * z)
            glVertex3f(r1 * x, y1, r1 * z)
            glVertex3f(r0 * x, y0, r0 * z)
        glEnd()


def draw_things():
    """Draw the lamp, the jug and the chessboard, which are in front of the mirror."""
    glPushMatrix()
    glTranslatef(-0.9, 0, 1.3)
    draw_round(((0.4, 0), (0.4, 0.08), (0.06, 0.12), (0.06, 1.1)), (0.45, 0.47, 0.5))
    draw_round(((0.5, 1.05), (0.25, 1.6), (0, 1.6)), (0.95, 0.62, 0.35))
    glTranslatef(1.9, 0, 0.2)
    draw_round(((0.3, 0), (0.5, 0.35), (0.42, 0.7), (0.2, 0.95), (0.28, 1.1)), (0.25, 0.6, 0.6))
    glPopMatrix()
    draw_board(0, 4)


def draw_board(near, far):
    glBegin(GL_QUADS)
    glNormal3f(0, 1, 0)
    for x in range(-4, 4):
        for z in range(near, far):
            glColor3f(*((0.95, 0.9, 0.8) if (x + z) % 2 else (0.35, 0.45, 0.5)))
            for corner_x, corner_z in ((x, z), (x, z + 1), (x + 1, z + 1), (x + 1, z)):
                glVertex3f(corner_x, 0, corner_z)
    glEnd()


def draw_image(things):
    """Draw what the mirror, at z = 0, shows."""
    glPushMatrix()
    glScalef(1, 1, -1)
    glLightfv(GL_LIGHT0, GL_POSITION, LIGHT)
    glFrontFace(GL_CW)
    glCallList(things)
    glFrontFace(GL_CCW)
    glPopMatrix()
    glLightfv(GL_LIGHT0, GL_POSITION, LIGHT)


def draw_glass():
    """Draw the glass of the mirror, as a dark film that can be seen through."""
    glEnable(GL_BLEND)
    glColor4f(0.1, 0.2, 0.25, 0.25)
    glBegin(GL_POLYGON)
    glNormal3f(0, 0, 1)
    for step in range(48):
        angle = math.pi * step / 24
        glVertex3f(1.3 * math.cos(angle), 1.4 + 1.3 * math.sin(angle), 0)
    glEnd()
    glDisable(GL_BLEND)


def draw_frame():
    glPushMatrix()
    glTranslatef(0, 1.4, -0.1)
    glRotatef(90, 1, 0, 0)
    draw_round(((1.3, -0.1), (1.45, -0.1), (1.45, 0.1), (1.3, 0.1)), (0.85, 0.35, 0.2))
    glPopMatrix()


def draw_reflection(things):
    """Draw what the mirror shows, where its glass is."""
    glEnable(GL_STENCIL_TEST)
    glStencilMask(0x80)
    glStencilFunc(GL_ALWAYS, 0x80, 0x80)
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)
    glDrawBuffer(GL_NONE)
    glDepthMask(GL_FALSE)
    draw_glass()
    glDepthMask(GL_TRUE)
    glDrawBuffer(GL_BACK)
    glStencilFunc(GL_EQUAL, 0x80, 0x80)
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP)
    draw_image(things)
    glStencilMask(0xFF)
    glDisable(GL_STENCIL_TEST)


def on_key(window, key, scancode, action, mods):
    global turn
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        turn += 10 if key == glfw.KEY_RIGHT else -10
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A round mirror", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL, GL_NORMALIZE):
        glEnable(capability)
    things = glGenLists(1)
    glNewList(things, GL_COMPILE)
    draw_things()
    glEndList()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -0.9, -9)
        glRotatef(16, 1, 0, 0)
        glRotatef(turn, 0, 1, 0)
        glLightfv(GL_LIGHT0, GL_POSITION, LIGHT)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)
        draw_reflection(things)
        draw_glass()
        draw_frame()
        glCallList(things)
        draw_board(-4, 0)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
