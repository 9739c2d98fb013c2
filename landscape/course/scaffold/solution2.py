# Another way to solve it, without a matrix: the tests must let it pass, too. Write as many of these
# as you can think of: solution3.py, solution4.py.
# exercise: clock_hand

import math
import sys

import glfw
from OpenGL.GL import *

DIAL = (0.4, -0.2)  # its middle
turned = 0  # degrees


def draw_dial():
    glColor3f(0.95, 0.9, 0.8)
    glBegin(GL_TRIANGLE_FAN)
    glVertex2f(*DIAL)
    for step in range(37):
        angle = math.radians(10 * step)
        glVertex2f(DIAL[0] + 0.6 * math.cos(angle), DIAL[1] + 0.6 * math.sin(angle))
    glEnd()


def draw_mark():
    glColor3f(0.3, 0.5, 0.8)
    glBegin(GL_QUADS)
    for x, y in ((-0.95, 0.75), (-0.75, 0.75), (-0.75, 0.95), (-0.95, 0.95)):
        glVertex2f(x, y)
    glEnd()


def draw_scene():
    draw_dial()
    angle = math.radians(turned)
    glColor3f(0.85, 0.35, 0.2)
    glBegin(GL_TRIANGLES)
    for x, y in ((-0.06, 0), (0.06, 0), (0, 0.5)):
        glVertex2f(
            DIAL[0] + math.cos(angle) * x + math.sin(angle) * y,
            DIAL[1] - math.sin(angle) * x + math.cos(angle) * y,
        )
    glEnd()
    draw_mark()


def on_key(window, key, scancode, action, mods):
    global turned
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_RIGHT:
        turned += 30
    elif key == glfw.KEY_LEFT:
        turned -= 30
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(400, 300, "The hand of a clock", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glOrtho(-width / height, width / height, -1, 1, -1, 1)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glClear(GL_COLOR_BUFFER_BIT)
        draw_scene()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
