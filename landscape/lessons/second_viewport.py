"""A second viewport: a map in the corner

The scene is drawn twice. First as the viewer sees it, in the whole window; then with glOrtho from
straight above, in a viewport of its own in the upper right corner, with an arrow for the viewer.
The map needs a fresh background and fresh depths, but glClear does not heed the viewport: only the
scissor test limits it. Without it, the map's glClear wipes out the whole window.

Keys: Left and Right turn, Up and Down walk; Space switches the scissor test.
"""
# topic: landscape
# needs: viewport, perspective, look_at, matrix_stack, overlay
# picture: frame 0
# keys: LEFT RIGHT UP DOWN SPACE

import math

import glfw
from OpenGL.GL import *
from text import _, write

x, z, turn, scissor = 1.6, 7.0, -10, True  # turn: degrees to the right of north (-z)
HOUSES = (-3, -1, 1.5), (1, -4, 2), (4, 0.5, 1.3)  # x, z, height
TREES = (-1, 3, 3), (0.2, 1.2, 2.4), (-5, 3.5, 3.4), (5, -4, 3), (-6, -4.5, 2.6), (6.5, 4, 3.2)


def draw_prism(x, z, sides, bottom, top, radius, top_radius, color):
    """Draw a prism, or a cone if top_radius is 0; it is lit from the west (-x)."""
    glBegin(GL_QUADS)
    for k in range(sides):
        a, b = math.radians((k - 0.5) * 360 / sides), math.radians((k + 0.5) * 360 / sides)
        shade = 0.75 - 0.25 * math.cos((a + b) / 2)
        glColor3f(*(shade * channel for channel in color))
        low, high = (bottom, radius), (top, top_radius)
        for angle, (y, r) in (a, low), (a, high), (b, high), (b, low):
            glVertex3f(x + r * math.cos(angle), y, z + r * math.sin(angle))
    glEnd()


def draw_village():
    glColor3f(0.4, 0.5, 0.3)
    glBegin(GL_QUADS)
    for corner in ((-9, 0, -9), (9, 0, -9), (9, 0, 9), (-9, 0, 9)):
        glVertex3f(*corner)
    glEnd()
    for px, pz, height in HOUSES:
        draw_prism(px, pz, 4, 0, height, 1.4, 1.4, (0.95, 0.9, 0.8))
        draw_prism(px, pz, 4, height, height + 1.2, 1.8, 0, (0.85, 0.35, 0.2))
    for px, pz, height in TREES:
        draw_prism(px, pz, 12, 0, 0.5, 0.15, 0.15, (0.5, 0.36, 0.27))
        draw_prism(px, pz, 12, 0.4, height, 0.3 * height, 0, (0.25, 0.6, 0.6))


def on_key(window, key, scancode, action, mods):
    global x, z, turn, scissor
    if action == glfw.RELEASE:
        return
    turn += 5 * ((key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT))
    step = 0.3 * ((key == glfw.KEY_UP) - (key == glfw.KEY_DOWN))
    x, z = x + step * math.sin(math.radians(turn)), z - step * math.cos(math.radians(turn))
    if key == glfw.KEY_SPACE:
        scissor = not scissor
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("A second viewport"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_DEPTH_TEST)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glClearColor(0.55, 0.68, 0.78, 1)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 0.5, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glRotatef(turn, 0, 1, 0)
        glTranslatef(-x, -1.6, -z)
        draw_village()
        size, edge = height * 2 // 5, height // 30
        corner = width - size - edge, height - size - edge, size, size
        glViewport(*corner)
        if scissor:
            glScissor(*corner)
            glEnable(GL_SCISSOR_TEST)
        glClearColor(0.13, 0.16, 0.21, 1)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glDisable(GL_SCISSOR_TEST)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glOrtho(-10, 10, -10, 10, 0, 20)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glRotatef(90, 1, 0, 0)  # looks down; north is up
        glTranslatef(0, -10, 0)
        draw_village()
        glTranslatef(x, 8, z)  # an arrow for the viewer, above the roofs
        glRotatef(-turn, 0, 1, 0)
        glColor3f(0.95, 0.62, 0.35)
        glBegin(GL_TRIANGLES)
        for corner in ((0, 0, -1.6), (-0.9, 0, 1), (0.9, 0, 1)):
            glVertex3f(*corner)
        glEnd()
        glViewport(0, 0, width, height)
        write(16, 16, "scissor test on" if scissor else "scissor test off")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
