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

import glfw
from OpenGL.GL import *
from text import _, write

FLAG = ((0, 0), (0.3, 0), (0.3, 1.1), (1.5, 1.1), (1.2, 1.5), (1.5, 1.9), (0, 1.9))
CORNER = (1.5, 1.9, 0)
LABELS = ("glTranslatef", "glRotatef", "glScalef", "all three")
mode = 3
amount = 3  # steps
axis = (0, 0, 1)


def transform():
    """Multiply the modelview matrix by what is chosen; in the product the scale acts first."""
    if mode in (0, 3):
        glTranslatef(0.4 * amount, 0.2 * amount, 0)
    if mode in (1, 3):
        glRotatef(10 * amount, *axis)
    if mode in (2, 3):
        glScalef(1 + 0.25 * amount, 1 - 0.1 * amount, 1)


def draw_flag():
    for first, last in ((0, 4), (2, 7)):  # two convex parts
        part = (FLAG[0], FLAG[1], FLAG[2], (0, 1.1)) if first == 0 else ((0, 1.1), *FLAG[3:last])
        glBegin(GL_TRIANGLE_FAN)
        for x, y in (part[-1], *part[:-1]):
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
    transform()
    matrix = glGetFloatv(GL_MODELVIEW_MATRIX).T  # OpenGL stores its columns
    glColor3f(0.85, 0.35, 0.2)
    draw_flag()
    glPointSize(height / 40)
    glColor3f(0.95, 0.9, 0.8)
    glBegin(GL_POINTS)
    glVertex3f(*CORNER)
    glEnd()
    glLoadIdentity()
    glColor3f(0.95, 0.62, 0.35)
    draw_outline()
    glViewport(0, 0, width, height)
    column = (*CORNER, 1)
    image = matrix @ column
    write(16, 112, LABELS[mode])
    for line in range(4):
        row = [value + 0 for value in matrix[line].round(2)]  # + 0 makes 0 of -0
        y = 88 - 24 * line
        write(16, y, "{a:6.2f} {b:6.2f} {c:6.2f} {d:6.2f}", a=row[0], b=row[1], c=row[2], d=row[3])
        write(310, y, "{value:5.2f}", (0.95, 0.62, 0.35), value=column[line])
        write(400, y, "{value:6.2f}", (0.95, 0.5, 0.35), value=image[line].round(2) + 0)

    write(378, 52, "=")
    write(296, 52, "×")


def on_key(window, key, scancode, action, mods):
    global amount, axis, mode
    if action == glfw.RELEASE:
        return
    if key - glfw.KEY_1 in range(4):
        mode = key - glfw.KEY_1
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT):
        amount = max(-6, min(amount + (1 if key == glfw.KEY_RIGHT else -1), 6))
    if key == glfw.KEY_SPACE:
        axis = (1, 0, 0) if axis == (0, 0, 1) else (0, 0, 1)
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Matrices"), None, None)
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
