"""Billboard: trees that face the viewer

A tree is one quad with a picture whose surround is transparent: the alpha test leaves it out.
Fixed quads are seen edge-on from the side, and the tree is a line. So each quad is turned about
its own vertical by the angle to the eye; or the rotation is cleared from the modelview matrix, and
the quad is parallel to the screen. From above, the second way lets the trees lie on their backs.

Keys: Space changes how the quads are turned; Up and Down raise and lower the eye.
"""
# topic: landscape
# needs: textured_sphere, matrix_stack, look_at
# picture: frame 60
# loop: 360 frames
# keys: SPACE UP DOWN

import math
import random
import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

FIXED, TURNED, CLEARED = range(3)
LABELS = "fixed", "turned by the angle to the eye", "rotation cleared"
way = TURNED
pitch = 15  # degrees that the camera looks down


def plant_trees():
    """Return x, z and height of thirty trees at random, none too close to another."""
    chance = random.Random(4)
    trees = []
    while len(trees) < 30:
        angle = chance.uniform(0, 2 * math.pi)
        radius = 7 * math.sqrt(chance.random())
        x = radius * math.cos(angle)
        z = radius * math.sin(angle)
        height = chance.uniform(1.6, 2.8)
        if all(math.dist((x, z), other[:2]) > 1.4 for other in trees):
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


def draw_tree(x, z, height, eye):
    glPushMatrix()
    glTranslatef(x, 0, z)
    if way == TURNED:
        glRotatef(math.degrees(math.atan2(eye[0] - x, eye[2] - z)), 0, 1, 0)
    elif way == CLEARED:
        matrix = glGetFloatv(GL_MODELVIEW_MATRIX)
        matrix[:3, :3] = ((1, 0, 0), (0, 1, 0), (0, 0, 1))  # the tree's place stays, in row 3
        glLoadMatrixf(matrix)
    glBegin(GL_QUADS)
    for s, t in ((0, 1), (1, 1), (1, 0), (0, 0)):
        glTexCoord2f(s, t)
        glVertex3f((s - 0.5) * height, (1 - t) * height, 0)
    glEnd()
    glPopMatrix()


def draw_ground():
    glBegin(GL_TRIANGLE_FAN)
    glColor3f(0.5, 0.62, 0.3)
    glVertex3f(0, 0, 0)
    glColor3f(0.3, 0.45, 0.22)
    for step in range(49):
        glVertex3f(9 * math.cos(step * math.pi / 24), 0, -9 * math.sin(step * math.pi / 24))
    glEnd()


def draw_trees(eye):
    glEnable(GL_TEXTURE_2D)
    glEnable(GL_ALPHA_TEST)
    glColor3f(1, 1, 1)
    for x, z, height in TREES:
        draw_tree(x, z, height, eye)
    glDisable(GL_ALPHA_TEST)
    glDisable(GL_TEXTURE_2D)


def look(width, height):
    """Set the matrices, and return the eye's place among the trees."""
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 0.6, 60)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, -1, -13)
    glRotatef(pitch, 1, 0, 0)
    glRotatef(15 * glfw.get_time() + 55, 0, 1, 0)
    camera = glGetFloatv(GL_MODELVIEW_MATRIX)
    return -camera[:3, :3] @ camera[3, :3]


def on_key(window, key, scancode, action, mods):
    global way, pitch
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_SPACE:
        way = (way + 1) % len(LABELS)
    elif key == glfw.KEY_UP:
        pitch = min(85, pitch + 10)
    elif key == glfw.KEY_DOWN:
        pitch = max(5, pitch - 10)
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Billboard"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.7, 0.82, 0.92, 1)
    glEnable(GL_DEPTH_TEST)
    glAlphaFunc(GL_GREATER, 0.5)
    load_tree()

    while not glfw.window_should_close(window):
        eye = look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_ground()
        draw_trees(eye)
        write(16, 16, LABELS[way])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
