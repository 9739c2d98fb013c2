"""Display lists: a flower compiled once, drawn hundreds of times

glNewList records OpenGL calls, glCallList repeats them. What the program computed while it
recorded is fixed: here the number of petals. What is state when the list is called is free: the
matrix, and the colour of the petals, which the list leaves alone. A new number of petals is seen
only after the list is compiled again.

Keys: Left and Right choose a number of petals; Space compiles the list again.
"""
# topic: arrays
# needs: matrix_stack
# picture: frame 30 after RIGHT RIGHT
# loop: 120 frames
# keys: LEFT RIGHT SPACE

import math
import random
import sys

import glfw
from OpenGL.GL import *
from text import _, write

COLORS = ((0.95, 0.9, 0.8), (0.95, 0.62, 0.35), (0.85, 0.35, 0.2), (0.6, 0.65, 0.95))
petals = 6  # chosen
recorded = 0  # petals in the list
compiled = 0  # how often it was compiled
flower = 0  # its name


def compile_flower():
    global compiled, flower, recorded
    flower = flower or glGenLists(1)
    glNewList(flower, GL_COMPILE)
    draw_flower()
    glEndList()
    recorded = petals
    compiled += 1


def draw_flower():
    """Draw a flower, 1 high. The petals have the current colour."""
    draw_petals()
    draw_middle()
    draw_stem()


def draw_petals():
    for n in range(petals):
        glBegin(GL_TRIANGLE_FAN)
        for distance, offset in ((0, 0), (0.2, -0.5), (0.34, -0.25), (0.36, 0.25), (0.2, 0.5)):
            angle = (n + 0.8 * offset) * math.tau / petals
            glVertex3f(distance * math.cos(angle), 1 + distance * math.sin(angle), 0)
        glEnd()


def draw_middle():
    glBegin(GL_TRIANGLE_FAN)
    glColor3f(0.95, 0.75, 0.25)
    for n in range(12):
        angle = n * math.tau / 12
        glVertex3f(0.1 * math.cos(angle), 1 + 0.1 * math.sin(angle), 0.01)
    glEnd()


def draw_stem():
    """Draw the stem and a leaf."""
    glBegin(GL_TRIANGLES)
    glColor3f(0.3, 0.55, 0.35)
    for x, y in ((-0.03, 0), (0.03, 0), (0, 0.95), (0, 0.1), (0.25, 0.45), (0.02, 0.25)):
        glVertex3f(x, y, -0.01)
    glEnd()


def draw_meadow(time):
    glColor3f(0.16, 0.27, 0.24)
    glBegin(GL_QUADS)
    for x, z in ((-20, 2), (20, 2), (20, -20), (-20, -20)):
        glVertex3f(x, 0, z)
    glEnd()
    chance = random.Random(1)
    for n in range(240):
        x = chance.uniform(-7, 7)
        z = -12 + n / 20
        glPushMatrix()
        glTranslatef(x, 0, z)
        glRotatef(6 * math.sin(time * math.pi + x + z), 0, 0, 1)
        glColor3f(*chance.choice(COLORS))
        glCallList(flower)
        glPopMatrix()


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 3, width / height / 3, -1 / 3, 1 / 3, 1, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, -1.2, -4)
    glRotatef(18, 1, 0, 0)


def on_key(window, key, scancode, action, mods):
    global petals
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        petals = max(3, min(16, petals + (1 if key == glfw.KEY_RIGHT else -1)))
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        compile_flower()
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Display lists"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_DEPTH_TEST)
    glClearColor(0.13, 0.16, 0.21, 1)
    compile_flower()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_meadow(glfw.get_time())

        write(16, 40, "petals chosen: {petals}, in the list: {list}", petals=petals, list=recorded)
        write(16, 16, "times compiled: {count}; called 240 times a frame", count=compiled)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
