"""Scale: what glScalef does to normals

Five meshes of different sizes are scaled. Lighting needs normals of length 1, but glScalef(s, s, s)
makes normals 1 / s as long: what was enlarged is dark, what was made smaller is too bright.
GL_RESCALE_NORMAL undoes one common factor; GL_NORMALIZE makes every normal 1 long, also after an
uneven scale, and costs a square root per vertex.

Keys: 1 leaves the normals alone; 2 enables GL_RESCALE_NORMAL; 3 enables GL_NORMALIZE.
"""
# topic: light
# needs: transform_order, normals
# picture: frame 0
# keys: 1 2

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

SCALES = ((0.5, 0.5, 0.5), (1, 1, 1), (2, 2, 2), (0.6, 1.2, 0.6), (1.3, 0.5, 1.3))
MODES = (0, GL_RESCALE_NORMAL, GL_NORMALIZE)
LABELS = {
    0: "normals as scaled",
    GL_RESCALE_NORMAL: "GL_RESCALE_NORMAL",
    GL_NORMALIZE: "GL_NORMALIZE",
}
mode = GL_NORMALIZE


def draw_sphere(radius):
    """Draw a sphere as strips from pole to pole; its normals have the length 1."""
    for n in range(32):
        glBegin(GL_QUAD_STRIP)
        for m in range(17):
            height = math.cos(m * math.pi / 16)
            ring = math.sin(m * math.pi / 16)
            for side in (n + 1, n):
                angle = side * math.pi / 16
                x = ring * math.cos(angle)
                y = height
                z = -ring * math.sin(angle)
                glNormal3f(x, y, z)
                glVertex3f(radius * x, radius * y, radius * z)
        glEnd()


def place(n):
    """Return where ball n is: three in the upper row, two in the lower one."""
    if n < 3:
        return 2.1 * n - 2.1, 1.3
    return 2.1 * (n - 3) - 1.05, 1.3 - 2.3


def draw_balls():
    for n, scale in enumerate(SCALES):
        glLoadIdentity()
        glTranslatef(*place(n), 0)
        glScalef(*scale)
        # The meshes of the first row are as large, before they are scaled, as makes them equal.
        draw_sphere(0.8 / abs(scale[0]) if n < 3 else 0.8)


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-2.7 * width / height, 2.7 * width / height, -2.9, 2.5, -2, 2)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glLightfv(GL_LIGHT0, GL_POSITION, (-0.5, 0.8, 1, 0))


def on_key(window, key, scancode, action, mods):
    global mode
    if glfw.KEY_1 <= key < glfw.KEY_1 + 3:
        mode = MODES[key - glfw.KEY_1]
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Scale"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0):
        glEnable(capability)
    glClearColor(0.13, 0.16, 0.21, 1)
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (0.85, 0.35, 0.2, 1))

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        for capability in (GL_RESCALE_NORMAL, GL_NORMALIZE):
            if mode == capability:
                glEnable(capability)
            else:
                glDisable(capability)
        draw_balls()
        glLoadIdentity()
        for n, scale in enumerate(SCALES):
            x, y = place(n)
            label = "{}, {}, {}".format(*scale)
            write(-5 * len(label), -8, label, at=(x, y - 1.3, 0))

        write(16, 16, LABELS[mode])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
