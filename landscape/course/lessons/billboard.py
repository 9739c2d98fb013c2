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
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

LABELS = "fixed", "turned by the angle to the eye", "rotation cleared"
way, pitch = 1, 15  # degrees that the camera looks down
chance = random.Random(4)
TREES = []  # x, z, height
while len(TREES) < 30:
    angle, radius = chance.uniform(0, 2 * math.pi), 7 * math.sqrt(chance.random())
    tree = radius * math.cos(angle), radius * math.sin(angle), chance.uniform(1.6, 2.8)
    if all(math.dist(tree[:2], other[:2]) > 1.4 for other in TREES):
        TREES.append(tree)


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
    if way == 1:
        glRotatef(math.degrees(math.atan2(eye[0] - x, eye[2] - z)), 0, 1, 0)
    if way == 2:
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


def on_key(window, key, scancode, action, mods):
    global way, pitch
    if action != glfw.RELEASE:
        way = (way + (key == glfw.KEY_SPACE)) % 3
        pitch = max(5, min(85, pitch + 10 * ((key == glfw.KEY_UP) - (key == glfw.KEY_DOWN))))
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Billboard"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.7, 0.82, 0.92, 1)
    glEnable(GL_DEPTH_TEST)
    glAlphaFunc(GL_GREATER, 0.5)
    load_tree()
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
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
        eye = -camera[:3, :3] @ camera[3, :3]  # its place among the trees
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_ground()
        glEnable(GL_TEXTURE_2D)
        glEnable(GL_ALPHA_TEST)
        glColor3f(1, 1, 1)
        for tree in TREES:
            draw_tree(*tree, eye)
        glDisable(GL_ALPHA_TEST)
        glDisable(GL_TEXTURE_2D)
        write(16, 16, LABELS[way])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
