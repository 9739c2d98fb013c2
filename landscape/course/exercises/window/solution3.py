"""A triangle strip from an array; the keys' steps from a table."""
# exercise: window
# the rest: start.py

import numpy as np


def draw_sky():
    """Fill the window with the colour of the sky."""
    glColor3fv(light * np.array((1, 0.5, 0.35)))
    glEnableClientState(GL_VERTEX_ARRAY)
    glVertexPointerf([(-1, -1), (1, -1), (-1, 1), (1, 1)])
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4)
    glDisableClientState(GL_VERTEX_ARRAY)


def on_key(window, key, scancode, action, mods):
    global light
    steps = {glfw.KEY_UP: 0.1, glfw.KEY_DOWN: -0.1}
    if action != glfw.RELEASE:
        light = float(np.clip(light + steps.get(key, 0), 0, 1))
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)
