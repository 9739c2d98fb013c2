"""Spots: cutoff, exponent, and the mesh that they need

Three spots, red, green and blue, shine on a wall. GL_SPOT_CUTOFF is the angle between the axis of
the cone and its edge; GL_SPOT_EXPONENT makes the light weaker towards the edge. Light is computed
at vertices only: on a coarse mesh the spots become shapeless patches, or fall between vertices.

Keys: Left and Right change the cutoff, Up and Down the exponent; Space makes the mesh coarse.
"""
# topic: light
# needs: attenuation
# picture: frame 0
# loop: 240 frames
# keys: LEFT RIGHT UP DOWN SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

LIGHTS = (GL_LIGHT0, GL_LIGHT1, GL_LIGHT2)
cutoff = 22  # degrees, at most 90
exponent = 8  # at most 128
cells = 90


def aim_lights(time):
    for n, light in enumerate(LIGHTS):
        angle = n * math.tau / 3 + time * math.pi / 2
        x = 0.6 * math.cos(angle)
        y = 0.6 * math.sin(angle)
        glLightfv(light, GL_POSITION, (2 * x, 2 * y, 4, 1))
        glLightfv(light, GL_SPOT_DIRECTION, (-x, -y, -4))  # to a point beside the middle
        glLightfv(light, GL_DIFFUSE, [float(n == channel) for channel in range(3)] + [1])
        glLightf(light, GL_SPOT_CUTOFF, cutoff)
        glLightf(light, GL_SPOT_EXPONENT, exponent)


def draw_wall():
    """Draw a wall of cells by cells quads, 8 by 6."""
    step = 1 / cells
    glNormal3f(0, 0, 1)
    for row in range(cells):
        glBegin(GL_QUAD_STRIP)
        for column in range(cells + 1):
            glVertex3f(8 * column * step - 4, 6 * (row + 1) * step - 3, 0)
            glVertex3f(8 * column * step - 4, 6 * row * step - 3, 0)
        glEnd()


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 3, width / height / 3, -1 / 3, 1 / 3, 1, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, 0.3, -6.8)
    glRotatef(-25, 1, 0, 0)


def on_key(window, key, scancode, action, mods):
    global cells, cutoff, exponent
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        cutoff = max(2, cutoff - 4)
    elif key == glfw.KEY_RIGHT:
        cutoff = min(60, cutoff + 4)
    elif key == glfw.KEY_DOWN:
        exponent = max(0, exponent - 8)
    elif key == glfw.KEY_UP:
        exponent = min(128, exponent + 8)
    elif key == glfw.KEY_SPACE:
        cells = 96 - cells
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Spots"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for capability in (GL_LIGHTING, *LIGHTS):
        glEnable(capability)
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (0.95, 0.95, 0.95, 1))
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (0.1, 0.12, 0.15, 1))
    glClearColor(0.06, 0.07, 0.09, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT)
        aim_lights(glfw.get_time())
        draw_wall()

        write(16, 64, "cutoff {cutoff}°", cutoff=cutoff)
        write(16, 40, "exponent {exponent}", exponent=exponent)
        write(16, 16, "mesh of {cells} × {cells} quads", cells=cells)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
