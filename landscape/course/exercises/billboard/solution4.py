"""Billboard: apple trees that face the eye

Each tree of the orchard is a single quad with a picture on it. From the first side it looks well,
but if one goes round the orchard, the trees are seen from the edge, and then they are gone: their
backs are culled.

Turn each tree about its own vertical so that its front faces the eye: seen from above, the quad
must be at right angles to the line from the tree to the eye. So trees to the left and to the right
turn by different angles. They stay upright and in their places, also when the eye is higher.

The quad of draw_tree stands in the plane x = 0, and its front is the side of positive x. eye()
returns where the eye is.

Keys: Left and Right go round the orchard, Up and Down raise and lower the eye.
"""
# exercise: billboard

import math
import sys

import glfw
import numpy as np
from OpenGL.GL import *

IMAGE = (
    "......gggg......",
    "....ggGGGGgg....",
    "...gGGGGGGGGg...",
    "..gGGaGGGGGGGg..",
    "..gGGGGGGGaGGGg.",
    ".gGGGGGGGGGGGGg.",
    ".gGGGGGaGGGGGGGg",
    "gGGGGGGGGGGGaGGg",
    "gGaGGGGGGGGGGGGg",
    "gGGGGGGGaGGGGGg.",
    ".gGGGGGGGGGGGg..",
    "..ggGGGtGGgttg..",
    "....gggttttg....",
    ".......tt.......",
    ".......tt.......",
    "......tttt......",
)
COLORS = {
    ".": (0, 0, 0, 0),
    "g": (38, 97, 60, 255),
    "G": (72, 140, 78, 255),
    "a": (217, 60, 40, 255),
    "t": (120, 84, 60, 255),
}
TREES = ((0, 0), (2.6, 1.2), (1, -2.6), (-2.4, 1.8), (-1.8, -1.6), (3, -2.4), (0.6, 3.2))  # x, z
turn = -90  # degrees
pitch = 15


def eye():
    """Return x and z of the eye."""
    distance = 11 * math.cos(math.radians(pitch))
    return -distance * math.sin(math.radians(turn)), distance * math.cos(math.radians(turn))


def make_texture():
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE)
    data = bytes(channel for row in IMAGE for letter in row for channel in COLORS[letter])
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 16, 16, 0, GL_RGBA, GL_UNSIGNED_BYTE, data)


def draw_trees():
    """Draw all trees by one call; each stands on its point x, 0, z."""
    places = np.array(TREES)
    to_eye = eye() - places
    to_eye /= np.linalg.norm(to_eye, axis=1, keepdims=True)
    right = np.stack((to_eye[:, 1], -to_eye[:, 0]), axis=1)
    corners = np.array(((0, 1), (1, 1), (1, 0), (0, 0)))
    across = 2.2 * (corners[:, 0] - 0.5)
    points = np.empty((len(TREES), 4, 3), "f")
    points[..., ::2] = places[:, None] + across[:, None] * right[:, None]
    points[..., 1] = 2.2 * (1 - corners[:, 1])
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_TEXTURE_COORD_ARRAY)
    glVertexPointerf(points.reshape(-1, 3))
    glTexCoordPointerf(np.tile(corners, (len(TREES), 1)).astype("f"))
    glDrawArrays(GL_QUADS, 0, 4 * len(TREES))
    glDisableClientState(GL_TEXTURE_COORD_ARRAY)
    glDisableClientState(GL_VERTEX_ARRAY)


def draw_orchard():
    glBegin(GL_TRIANGLE_FAN)
    glColor3f(0.62, 0.72, 0.4)
    glVertex3f(0, 0, 0)
    glColor3f(0.45, 0.58, 0.32)
    for step in range(49):
        glVertex3f(5 * math.cos(step * math.pi / 24), 0, -5 * math.sin(step * math.pi / 24))
    glEnd()
    glEnable(GL_TEXTURE_2D)
    glEnable(GL_ALPHA_TEST)  # leaves out what is transparent in the picture
    glColor3f(1, 1, 1)
    draw_trees()
    glDisable(GL_ALPHA_TEST)
    glDisable(GL_TEXTURE_2D)


def on_key(window, key, scancode, action, mods):
    global turn, pitch
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn -= 20
    elif key == glfw.KEY_RIGHT:
        turn += 20
    elif key == glfw.KEY_DOWN:
        pitch = max(5, pitch - 10)
    elif key == glfw.KEY_UP:
        pitch = min(75, pitch + 10)
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "An orchard", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.7, 0.82, 0.92, 1)
    glEnable(GL_DEPTH_TEST)
    glEnable(GL_CULL_FACE)
    glAlphaFunc(GL_GREATER, 0.5)
    make_texture()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 0.6, 60)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, 0, -11)
        glRotatef(pitch, 1, 0, 0)
        glTranslatef(0, -0.7, 0)
        glRotatef(turn, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_orchard()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
