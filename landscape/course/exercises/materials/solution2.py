"""Materials and lights: four balls under a lamp and a sky

Four balls of clay, copper, amber and chalk lie in the light of a lamp, GL_LIGHT0. As yet they are
all of the same grey, which is the material that OpenGL begins with.

set_material gets what a ball is made of, each time before one is drawn: red, green and blue of its
colour, of its highlight and of its glow, and its shininess. Let it set the material of the front
faces. The diffuse reflection is the colour, the ambient reflection is 0.4 times the colour, the
specular reflection is the highlight, and the emission is the glow; alpha is 1 everywhere.

Then let set_sky make GL_LIGHT1 the light of a sky. It comes from straight above in the scene, from
infinitely far away. Its diffuse light is SKY; it has neither specular nor ambient light. main calls
set_sky in each picture, after it has placed the camera.

Keys: Left and Right carry the camera around.
"""
# exercise: materials

import math
import sys

import glfw
import numpy as np
from OpenGL.GL import *

BALLS = (  # the colour, the highlight, the shininess, the glow
    ((0.7, 0.3, 0.2), (0.1, 0.1, 0.1), 4, (0, 0, 0)),
    ((0.5, 0.28, 0.16), (0.9, 0.6, 0.4), 40, (0, 0, 0)),
    ((0.5, 0.3, 0.05), (0.7, 0.7, 0.7), 100, (0.35, 0.16, 0)),
    ((0.75, 0.75, 0.7), (0, 0, 0), 0, (0, 0, 0)),
)
SKY = 0.2, 0.35, 0.6
turned = 0


def set_material(color, highlight, shininess, glow):
    """Set the material of what is drawn next."""
    values = {
        GL_AMBIENT: (*np.multiply(color, 0.4), 1),
        GL_DIFFUSE: (*color, 1),
        GL_SPECULAR: (*highlight, 1),
        GL_EMISSION: (*glow, 1),
    }
    for name, value in values.items():
        glMaterialfv(GL_FRONT_AND_BACK, name, value)
    glMateriali(GL_FRONT_AND_BACK, GL_SHININESS, shininess)


def set_sky():
    """Turn on the light of the sky."""
    glLightfv(GL_LIGHT0 + 1, GL_DIFFUSE, np.array((*SKY, 1), np.float32))
    glLightfv(GL_LIGHT0 + 1, GL_POSITION, np.array((0, 2.5, 0, 0), np.float32))
    glEnable(GL_LIGHT0 + 1)


def draw_ball():
    for ring in range(14):
        glBegin(GL_QUAD_STRIP)
        for step in range(29):
            around = 2 * math.pi * step / 28
            for polar in (math.pi * ring / 14, math.pi * (ring + 1) / 14):
                x = math.sin(polar) * math.sin(around)
                z = math.sin(polar) * math.cos(around)
                glNormal3f(x, math.cos(polar), z)
                glVertex3f(x, math.cos(polar), z)
        glEnd()


def draw_balls():
    for number, material in enumerate(BALLS):
        set_material(*material)
        glPushMatrix()
        glTranslatef(2.3 * number - 3.45, 0, 0)
        draw_ball()
        glPopMatrix()


def on_key(window, key, scancode, action, mods):
    global turned
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_RIGHT:
        turned -= 10
    elif key == glfw.KEY_LEFT:
        turned += 10
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(480, 240, "Four balls", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0):
        glEnable(capability)
    glLightfv(GL_LIGHT0, GL_AMBIENT, (0.5, 0.5, 0.5, 1))

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glOrtho(-2.4 * width / height, 2.4 * width / height, -2.4, 2.4, -9, 9)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glRotatef(25, 1, 0, 0)
        glRotatef(turned, 0, 1, 0)
        glLightfv(GL_LIGHT0, GL_POSITION, (-3, 3, 6, 1))
        set_sky()
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_balls()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
