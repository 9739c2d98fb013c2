"""Sorting: transparent trees from far to near

Blending mixes a fragment with what is already there, so what lies behind must be drawn first. The
trees are sorted by their depth in eye coordinates, the third row of the modelview matrix times
their place. Unsorted, the clear surround of a near tree writes depth too, and cuts a hole into
the trees that come later. The alpha test drops clear fragments in any order, but its edge is hard.

Keys: Space leaves out the sort; T switches from blending to the alpha test.
"""
# topic: landscape
# needs: blending, billboard
# picture: frame 60
# loop: 360 frames
# keys: SPACE T

import math
import random
import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

sort = True
alpha_test = False


def plant_trees():
    """Return x, z and height of seventy trees at random, none too close to another."""
    chance = random.Random(7)
    trees = []
    while len(trees) < 70:
        angle = chance.uniform(0, 2 * math.pi)
        radius = 7 * math.sqrt(chance.random())
        x = radius * math.cos(angle)
        z = radius * math.sin(angle)
        height = chance.uniform(1.8, 3)
        if all(math.dist((x, z), other[:2]) > 0.8 for other in trees):
            trees.append((x, z, height))
    return trees


TREES = plant_trees()


def load_tree():
    image = Image.open(Path(__file__).parent / "data" / "tree.png")
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE)
    data = GL_RGBA, GL_UNSIGNED_BYTE, image.tobytes()
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, *image.size, 0, *data)


def draw_trees():
    """Draw the trees as billboards, upright and parallel to the screen."""
    matrix = glGetFloatv(GL_MODELVIEW_MATRIX)  # PyOpenGL's matrix[i] is column i

    def depth(tree):
        return matrix[0, 2] * tree[0] + matrix[2, 2] * tree[1] + matrix[3, 2]

    right_x = matrix[0, 0]  # the first row: the screen's right
    right_z = matrix[2, 0]
    glEnable(GL_TEXTURE_2D)
    glEnable(GL_ALPHA_TEST if alpha_test else GL_BLEND)
    glColor3f(1, 1, 1)
    glBegin(GL_QUADS)
    # Eye coordinates look along -z: what is farther away has a smaller z.
    for x, z, height in sorted(TREES, key=depth) if sort else TREES:
        for s, t in ((0, 1), (1, 1), (1, 0), (0, 0)):
            glTexCoord2f(s, t)
            across = (s - 0.5) * height
            glVertex3f(x + across * right_x, (1 - t) * height, z + across * right_z)
    glEnd()
    for capability in (GL_TEXTURE_2D, GL_ALPHA_TEST, GL_BLEND):
        glDisable(capability)


def draw_ground():
    glBegin(GL_TRIANGLE_FAN)
    glColor3f(0.5, 0.62, 0.3)
    glVertex3f(0, 0, 0)
    glColor3f(0.3, 0.45, 0.22)
    for step in range(49):
        glVertex3f(9 * math.cos(step * math.pi / 24), 0, -9 * math.sin(step * math.pi / 24))
    glEnd()


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 0.8, 60)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, -0.8, -11)
    glRotatef(12, 1, 0, 0)
    glRotatef(10 * glfw.get_time(), 0, 1, 0)


def on_key(window, key, scancode, action, mods):
    global sort, alpha_test
    if action != glfw.PRESS:
        return
    if key == glfw.KEY_SPACE:
        sort = not sort
    elif key == glfw.KEY_T:
        alpha_test = not alpha_test
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Sorting"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.95, 0.85, 0.75, 1)
    glEnable(GL_DEPTH_TEST)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glAlphaFunc(GL_GREATER, 0.5)
    load_tree()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_ground()
        draw_trees()

        write(16, 40, "sorted" if sort else "not sorted")
        write(16, 16, "alpha test" if alpha_test else "blending")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
