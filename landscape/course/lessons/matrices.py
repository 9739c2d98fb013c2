"""Matrices: what glTranslatef, glRotatef and glScalef multiply by

The outline is a shape as it is given, the filled one what the modelview matrix makes of it. Below
is that matrix, read back from OpenGL, times the marked corner. A translation is in the last
column; a rotation and a scale are in the upper left 3 by 3. A product of them has both: every
affine map is one 4 by 4 matrix. That is what the fourth coordinate is good for.

Keys: 1 translation, 2 rotation, 3 scale, 4 all three; Left and Right change its amount; Space
turns about the x axis instead of z.
"""
# topic: transforms
# needs: homogeneous
# picture: frame 0
# keys: 1 2 3 LEFT RIGHT SPACE

import sys

import glfw
from OpenGL.GL import *
from text import _, write

FLAG = ((0, 0), (0.3, 0), (0.3, 1.1), (1.5, 1.1), (1.2, 1.5), (1.5, 1.9), (0, 1.9))
CORNER = (1.5, 1.9, 0)
LABELS = ("glTranslatef", "glRotatef", "glScalef", "all three")
TRANSLATE, ROTATE, SCALE, ALL = range(4)
mode = ALL
amount = 3  # steps
axis = (0, 0, 1)


def transform():
    """Multiply the modelview matrix by what is chosen; in the product the scale acts first."""
    if mode in (TRANSLATE, ALL):
        glTranslatef(0.4 * amount, 0.2 * amount, 0)
    if mode in (ROTATE, ALL):
        glRotatef(10 * amount, *axis)
    if mode in (SCALE, ALL):
        glScalef(1 + 0.25 * amount, 1 - 0.1 * amount, 1)


def draw_flag():
    """Draw the pole and the cloth: each of them is convex, so that a fan fills it."""
    foot, foot_right, hoist_right, *cloth = FLAG
    hoist = (0, 1.1)  # where the cloth begins, at the left of the pole
    for fan in ((hoist, foot, foot_right, hoist_right), (cloth[-1], hoist, *cloth[:-1])):
        glBegin(GL_TRIANGLE_FAN)
        for x, y in fan:
            glVertex2f(x, y)
        glEnd()


def draw_outline():
    glBegin(GL_LINE_LOOP)
    for x, y in FLAG:
        glVertex2f(x, y)
    glEnd()


def draw_axes():
    glColor3f(0.35, 0.4, 0.47)
    glBegin(GL_LINES)
    for end in ((6, 0), (-6, 0), (0, 6), (0, -6)):
        glVertex2f(0, 0)
        glVertex2f(*end)
    for n in range(-6, 7):
        for x, y in ((n, -0.08), (n, 0.08), (-0.08, n), (0.08, n)):
            glVertex2f(x, y)
    glEnd()


def draw_corner(height):
    glPointSize(height / 40)
    glColor3f(0.95, 0.9, 0.8)
    glBegin(GL_POINTS)
    glVertex3f(*CORNER)
    glEnd()


def write_product(matrix):
    """Write the matrix, the corner as a column, and their product."""
    column = (*CORNER, 1)
    image = matrix @ column
    for line in range(4):
        a, b, c, d = matrix[line].round(2) + 0  # + 0 makes 0 of -0
        y = 88 - 24 * line
        write(16, y, "{a:6.2f} {b:6.2f} {c:6.2f} {d:6.2f}", a=a, b=b, c=c, d=d)
        write(310, y, "{value:5.2f}", (0.95, 0.62, 0.35), value=column[line])
        write(400, y, "{value:6.2f}", (0.95, 0.5, 0.35), value=image[line].round(2) + 0)
    write(378, 52, "=")
    write(296, 52, "×")


def draw(width, height):
    bottom = int(152 * (height // 480 or height / 480))  # above the text
    glViewport(0, bottom, width, height - bottom)
    reach = 2.3 * width / (height - bottom)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-reach + 0.6, reach + 0.6, -0.9, 3.7, -3, 3)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glLineWidth(height / 240)
    draw_axes()

    # The transformed flag, and its outline as it was.
    transform()
    matrix = glGetFloatv(GL_MODELVIEW_MATRIX).T  # OpenGL stores its columns
    glColor3f(0.85, 0.35, 0.2)
    draw_flag()
    draw_corner(height)
    glLoadIdentity()
    glColor3f(0.95, 0.62, 0.35)
    draw_outline()

    glViewport(0, 0, width, height)
    write(16, 112, LABELS[mode])
    write_product(matrix)


def on_key(window, key, scancode, action, mods):
    global amount, axis, mode
    if action == glfw.RELEASE:
        return
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        mode = key - glfw.KEY_1
    elif key == glfw.KEY_LEFT:
        amount = max(-6, amount - 1)
    elif key == glfw.KEY_RIGHT:
        amount = min(6, amount + 1)
    elif key == glfw.KEY_SPACE:
        axis = (1, 0, 0) if axis == (0, 0, 1) else (0, 0, 1)
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Matrices"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT)
        draw(*glfw.get_framebuffer_size(window))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
