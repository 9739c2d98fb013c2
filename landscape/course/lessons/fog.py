"""Fog: colour that fades with distance

Fog mixes each fragment with the fog's colour: C = f * C + (1 - f) * fog. The factor f falls with
the distance d: in a straight line (GL_LINEAR), as exp(-density * d) (GL_EXP), or as
exp(-(density * d)^2) (GL_EXP2). The dots on the curve are the trees. Nothing fogs the background:
unless it has the fog's colour, far trees stand out against it, pale and sharp.

Keys: 1 linear, 2 exp, 3 exp2; Up and Down change the density; Space makes the background blue.
"""
# topic: landscape
# needs: depth_buffer, look_at
# picture: frame 0
# keys: 1 2 UP DOWN SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

MODES = GL_LINEAR, GL_EXP, GL_EXP2
LABELS = "linear: f = ({end} - d) / {end}", "exp: f = exp(-{c} d)", "exp2: f = exp(-({c} d)²)"
FOG = 0.68, 0.74, 0.76
mode = 2
density = 0.05
matched = True
TREES = [(2.8 + 0.6 * math.sin(4 * row), 4 + 2.5 * row) for row in range(14)]  # x, distance
# The cones of a tree, from its trunk upwards: bottom, top, radius.
CONES = (-1, -0.4, 0.1), (-0.8, 0.5, 0.8), (-0.1, 1.2, 0.6), (0.6, 1.8, 0.4)
BROWN = (0.4, 0.25, 0.18)
GREEN = (0.14, 0.38, 0.3)


def factor(d):
    """Return the fog factor at distance d: 1 is clear, 0 is only fog."""
    if MODES[mode] == GL_LINEAR:
        return max(0, 1 - d * density / 2)  # GL_FOG_END is 2 / density
    if MODES[mode] == GL_EXP:
        return math.exp(-density * d)
    return math.exp(-((density * d) ** 2))


def draw_tree(x, d):
    for number, (bottom, top, radius) in enumerate(CONES):
        color = BROWN if number == 0 else GREEN
        glBegin(GL_TRIANGLE_FAN)
        glColor3f(*color)
        glVertex3f(x, top, -d)
        for k in range(17):
            angle = k * math.pi / 8
            shade = 0.65 - 0.35 * math.cos(angle)  # lit from the left
            glColor3f(*(shade * channel for channel in color))
            glVertex3f(x + radius * math.cos(angle), bottom, radius * math.sin(angle) - d)
        glEnd()


def draw_ground():
    glBegin(GL_QUADS)
    glColor3f(0.5, 0.45, 0.3)
    for x, z in ((-90, 1), (90, 1), (90, -60), (-90, -60)):
        glVertex3f(x, -1, z)  # the eye is at 0
    glEnd()


def draw_avenue():
    draw_ground()
    for x, d in TREES:
        draw_tree(x, d)
        draw_tree(0.5 - x, d)


def set_fog():
    glEnable(GL_FOG)
    glFogi(GL_FOG_MODE, MODES[mode])
    glFogfv(GL_FOG_COLOR, (*FOG, 1))
    glFogf(GL_FOG_DENSITY, density)
    glFogf(GL_FOG_END, 2 / density)


def draw_curve(height):
    """Draw the factor over the distance, 0 to 40; ``height`` is that of the window."""
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-75, 43, -0.75, 5, -1, 1)
    glDisable(GL_DEPTH_TEST)
    glColor3f(0.13, 0.16, 0.21)
    glBegin(GL_QUAD_STRIP)
    for d in range(41):
        glVertex2f(d, 0)
        glVertex2f(d, factor(d))
    glEnd()
    glColor3f(0.95, 0.62, 0.35)
    glPointSize(height / 80)
    glBegin(GL_POINTS)
    for _x, d in TREES:
        glVertex2f(d, factor(d))
    glEnd()
    write(0, 8, "f(d)", at=(0, 1, 0))


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 2.5, width / height / 2.5, -0.4, 0.4, 1, 60)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def on_key(window, key, scancode, action, mods):
    global mode, density, matched
    if action == glfw.RELEASE:
        return
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        mode = key - glfw.KEY_1
    elif key == glfw.KEY_UP:
        density *= 1.25
    elif key == glfw.KEY_DOWN:
        density /= 1.25
    elif key == glfw.KEY_SPACE:
        matched = not matched
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Fog"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        look(width, height)
        glClearColor(*(FOG if matched else (0.3, 0.5, 0.8)), 1)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glEnable(GL_DEPTH_TEST)
        set_fog()
        draw_avenue()
        glDisable(GL_FOG)
        draw_curve(height)

        write(16, 16, LABELS[mode], c=round(density, 3), end=round(2 / density))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
