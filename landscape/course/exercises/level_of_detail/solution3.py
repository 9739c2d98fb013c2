"""Level of detail: a mountain range with few vertices

A section through a mountain range, drawn from vertices and lines between them. The camera stands at
`eye`. Near it there should be a vertex at each whole number x, and fewer far away; as yet there are
as many everywhere.

step_at(distance) returns how many units lie between two vertices at a distance from the camera: 1
below 16, 2 from 16 on, 4 from 32 on, 8 from 64 on, and never more than 8. There is a vertex at x if
x is a multiple of the step at its distance.

When the camera moves, vertices come and go, and the picture would jump. So a vertex that the next
grid, of twice the step, does not have glides to the line between its two neighbours before it goes.
height_of(x, step, distance) returns the height at which the vertex x of a grid is drawn. If x is a
multiple of twice the step, or if the step is 8, that is HEIGHTS[x]. Otherwise it is a mixture: up
to the distance 12 * step it is HEIGHTS[x], from 16 * step on it is the mean of HEIGHTS[x - step]
and HEIGHTS[x + step], and in between it changes evenly with the distance.

OpenGL only shows the picture. Change step_at and height_of.

Keys: Left and Right move the camera.
"""
# exercise: level_of_detail

import sys

import glfw
import numpy as np
from OpenGL.GL import *

WIDTH = 160  # of the picture; each of its pixels covers several of the window's
HEIGHT = 64
SIDE = 256  # of the texture: a power of two
BACKGROUND = (33, 41, 53)
CAMERA = (240, 240, 245)
COLORS = {1: (225, 160, 70), 2: (150, 180, 90), 4: (70, 160, 150), 8: (80, 130, 200)}
X = np.arange(WIDTH + 17)  # farther than what is drawn
HEIGHTS = 26 + 12 * np.sin(X / 13) + 7 * np.sin(X / 4.1) + 4 * np.sin(2.3 * X) + 3 * np.sin(1.3 * X)
eye = 30


def step_at(distance):
    """Return the step of the grid at a distance from the camera."""
    return 2 ** int(np.searchsorted((16, 32, 64), distance, side="right"))


def height_of(x, step, distance):
    """Return the height at which the vertex x of a grid is drawn."""
    weight = np.interp(distance, (12 * step, 16 * step), (0, 1))
    if x % (2 * step) == 0 or step > 4:
        weight = 0
    left = max(x - step, 0)
    right = min(x + step, WIDTH)
    return np.dot((weight / 2, 1 - weight, weight / 2), HEIGHTS[[left, x, right]])


def make_vertices():
    """Return the vertices from left to right: x, the height, and the step of the grid."""
    vertices = []
    for x in range(WIDTH + 1):
        distance = abs(x - eye)
        step = step_at(distance)
        if x % step == 0:
            vertices.append((x, height_of(x, step, distance), step))
    return vertices


def make_picture():
    picture = np.full((HEIGHT, WIDTH, 3), BACKGROUND, np.uint8)
    vertices = make_vertices()
    for (x, height, step), (next_x, next_height, _step) in zip(vertices, vertices[1:]):
        color = np.array(COLORS.get(step, CAMERA))
        for column in range(x, next_x):
            level = height + (next_height - height) * (column - x) / (next_x - x)
            row = HEIGHT - 1 - int(np.clip(level + 0.5, 0, HEIGHT - 1))
            picture[row:, column] = color // 2
            picture[row : row + 2, column] = CAMERA if column == x else color
    picture[:4, max(eye, 0) : max(eye, 0) + 1] = CAMERA
    return picture


def draw(picture):
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, WIDTH, HEIGHT, GL_RGB, GL_UNSIGNED_BYTE, picture)
    glBegin(GL_QUADS)
    for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
        glTexCoord2f(x * WIDTH / SIDE, y * HEIGHT / SIDE)
        glVertex2f(2 * x - 1, 1 - 2 * y)  # the picture's first row is at the top
    glEnd()


def on_key(window, key, scancode, action, mods):
    global eye
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        eye -= 3
    elif key == glfw.KEY_RIGHT:
        eye += 3
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 256, "A mountain range", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_TEXTURE_2D)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, SIDE, SIDE, 0, GL_RGB, GL_UNSIGNED_BYTE, None)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glClear(GL_COLOR_BUFFER_BIT)
        draw(make_picture())
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
