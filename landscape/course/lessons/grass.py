"""Grass: thousands of blades, sent in three ways

A blade is one opaque triangle, so the depth buffer orders the meadow and nothing is sorted. In
immediate mode the program sends every vertex with a call of its own; a display list is called once;
vertex arrays need a few calls, however many blades there are. The wind moves the tips. Only the
display list cannot follow it: its vertices stay as they were when it was compiled.

Keys: Space goes on to the next way; Up and Down double and halve the number of blades.
"""
# topic: landscape
# needs: vertex_arrays, display_list
# picture: frame 30 after SPACE SPACE UP UP
# loop: 180 frames
# keys: SPACE UP DOWN

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LABELS = "immediate mode", "display list", "vertex arrays"
SKY = (70, (0.1, 0.2, 0.3)), (35, (0.3, 0.4, 0.5)), (0, (1, 0.65, 0.35)), (-2, (0, 0.08, 0.08))
IMMEDIATE, LIST, ARRAYS = range(3)
way = IMMEDIATE
grass_list = 0
count = 2000


def make_blades():
    """Make the vertices of the blades, two feet and a tip each, and compile the display list."""
    global vertices, colors, grass_list
    rng = np.random.default_rng(2)

    # Two feet and a tip: 0.06 wide, turned at random, and 0.4 to 1.2 high.
    depth = 2 + 18 * rng.random(count) ** 1.5  # most of them near the eye
    middle = np.stack([depth * rng.uniform(-1, 1, count), np.full(count, -1), -depth], axis=1)
    turn = rng.uniform(0, np.pi, count)
    half = 0.03 * np.stack([np.cos(turn), np.zeros(count), np.sin(turn)], axis=1)
    tip = middle + np.outer(rng.uniform(0.4, 1.2, count), (0, 1, 0))
    vertices = np.stack([middle - half, middle + half, tip], axis=1).astype(np.float32)

    # Dark at the ground, and yellow to green at the tip.
    colors = np.full((count, 3, 3), (0, 0.12, 0.1), np.float32)
    colors[:, 2] = rng.uniform((0.5, 0.6, 0.2), (0.95, 0.75, 0.4), (count, 3))

    grass_list = grass_list or glGenLists(1)
    glNewList(grass_list, GL_COMPILE)
    draw_one_by_one(vertices)
    glEndList()


def in_wind(time):
    """Return the vertices with their tips moved by waves that run over the meadow."""
    blades = vertices.copy()
    x = blades[:, 2, 0]  # of the tips
    z = blades[:, 2, 2]
    x += 0.2 * np.sin(2.1 * time + 0.9 * x + 0.5 * z) + 0.1 * np.sin(4.2 * time + 7 * z)
    return blades


def draw_one_by_one(blades):
    glBegin(GL_TRIANGLES)
    for color, vertex in np.stack([colors, blades], axis=2).reshape(-1, 2, 3).tolist():
        glColor3f(*color)
        glVertex3f(*vertex)
    glEnd()


def draw_grass(blades):
    """Draw the grass in the chosen way and return the number of OpenGL calls."""
    if way == IMMEDIATE:
        draw_one_by_one(blades)
        return 2 + 6 * count
    if way == LIST:
        glCallList(grass_list)
        return 1

    glVertexPointer(3, GL_FLOAT, 0, blades)
    glColorPointer(3, GL_FLOAT, 0, colors)
    glDrawArrays(GL_TRIANGLES, 0, 3 * count)
    return 3


def draw_sky():
    glBegin(GL_QUAD_STRIP)
    for y, color in SKY:
        glColor3f(*color)
        glVertex3f(-150, y, -100)
        glVertex3f(150, y, -100)
    glEnd()


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 2, width / height / 2, -0.5, 0.5, 1, 150)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def on_key(window, key, scancode, action, mods):
    global way, count
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        way = (way + 1) % 3
    if key in (glfw.KEY_UP, glfw.KEY_DOWN) and action != glfw.RELEASE:
        count = min(64000, 2 * count) if key == glfw.KEY_UP else max(500, count // 2)
        make_blades()
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Grass"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    make_blades()
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_COLOR_ARRAY)
    glEnable(GL_DEPTH_TEST)
    glClearColor(0, 0.08, 0.08, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_sky()
        calls = draw_grass(in_wind(glfw.get_time()))

        write(16, 40, LABELS[way])
        write(16, 16, "{count} blades, OpenGL calls: {calls}", count=count, calls=calls)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
