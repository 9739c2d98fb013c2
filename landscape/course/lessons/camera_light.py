"""A light in the camera's frame: a lamp that the viewer carries

glLightfv multiplies a light's position by the modelview matrix of that moment. Set before the
camera's transform, while the matrix is the identity, the position (0, 0, 0) is the eye: the lamp
goes where the viewer goes. Set after it, the same numbers name the world's origin, and the viewer
stands in the dark.

Keys: Up and Down walk; Left and Right turn; Space sets the position after the viewing transform.
"""
# topic: light
# needs: attenuation, frames
# picture: frame 0
# keys: UP DOWN LEFT RIGHT SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

# The viewer: place, and degrees counter-clockwise seen from above.
x = 0.5
z = 6.0
heading = 0
carried = True


def draw_column(x, z):
    """Draw a column in rings, so that there are vertices where the light changes."""
    for y in (-1.5, -0.9, -0.3, 0.3, 0.9, 1.5, 2.1):
        glBegin(GL_QUAD_STRIP)
        for n in range(17):
            normal_x = math.cos(n * math.pi / 8)
            normal_z = -math.sin(n * math.pi / 8)
            glNormal3f(normal_x, 0, normal_z)
            glVertex3f(x + 0.35 * normal_x, y + 0.6, z + 0.35 * normal_z)
            glVertex3f(x + 0.35 * normal_x, y, z + 0.35 * normal_z)
        glEnd()


def draw_hall():
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (0.95, 0.85, 0.7, 1))
    for n in range(6):
        for side in (-2, 2):
            draw_column(side, 3 - 3 * n)
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (0.35, 0.55, 0.65, 1))
    glNormal3f(0, 1, 0)
    for n in range(48):  # the floor, in strips of squares
        glBegin(GL_QUAD_STRIP)
        for m in range(-12, 13):
            glVertex3f(m / 2, -1.5, 6.5 - n / 2)
            glVertex3f(m / 2, -1.5, 7 - n / 2)
        glEnd()


def set_light():
    glLightfv(GL_LIGHT0, GL_POSITION, (0, 0, 0, 1))
    glDisable(GL_LIGHTING)
    glColor3f(1, 0.9, 0.6)
    glBegin(GL_POINTS)
    glVertex3f(0, 0, 0)  # the lamp, where the light is; at the eye it is clipped
    glEnd()
    glEnable(GL_LIGHTING)


def look(width, height):
    glViewport(0, 0, width, height)
    glPointSize(height / 53)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-0.06 * width / height, 0.06 * width / height, -0.06, 0.06, 0.1, 50)
    glMatrixMode(GL_MODELVIEW)


def walk(distance):
    global x, z
    x -= distance * math.sin(math.radians(heading))
    z -= distance * math.cos(math.radians(heading))


def on_key(window, key, scancode, action, mods):
    global carried, heading
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_UP:
        walk(0.5)
    if key == glfw.KEY_DOWN:
        walk(-0.5)
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT):
        heading += 10 if key == glfw.KEY_LEFT else -10
    if key == glfw.KEY_SPACE:
        carried = not carried
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("A light in the camera's frame"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0):
        glEnable(capability)
    glLightfv(GL_LIGHT0, GL_DIFFUSE, (1.6, 1.4, 1.1, 1))
    glLightf(GL_LIGHT0, GL_QUADRATIC_ATTENUATION, 0.05)
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (0.06, 0.07, 0.1, 1))
    glClearColor(0.03, 0.04, 0.06, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glLoadIdentity()
        if carried:
            set_light()
        glRotatef(-heading, 0, 1, 0)
        glTranslatef(-x, 0, -z)
        if not carried:
            set_light()
        draw_hall()

        write(16, 16, "light first, then the view" if carried else "view first, then the light")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
