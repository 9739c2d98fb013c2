"""Animation: a function of time, not of the frame count

The program draws all the time, and each picture differs a little from the one before. The upper
block follows the clock: its position is a function of glfw.get_time(). The lower block counts
frames. They agree at 60 frames a second, but on a slow computer the lower one is slow.

Keys: Space makes the computer slow: each frame takes a tenth of a second longer.
"""
# topic: window
# needs: keys
# picture: frame 12 after SPACE
# loop: 240 frames
# keys: SPACE
# programs: idle_color

import math
import sys
import time

import glfw
from OpenGL.GL import *
from text import _, write

PERIOD = 4  # seconds from left to right and back
frames = 0
slow = False


def draw_block(seconds, bottom, color):
    """Draw a block that swings once in a PERIOD."""
    x = -0.75 * math.cos(2 * math.pi * seconds / PERIOD)
    glColor3f(*color)
    # A rectangle from corner to corner. The window goes from -1 to 1 in both directions.
    glRectf(x - 0.15, bottom, x + 0.15, bottom + 0.5)


def draw():
    width, height = glfw.get_framebuffer_size(glfw.get_current_context())
    glViewport(0, 0, width, height)
    glClearColor(0.13, 0.16, 0.21, 1)
    glClear(GL_COLOR_BUFFER_BIT)
    draw_block(glfw.get_time(), 0.35, (0.95, 0.62, 0.35))
    draw_block(frames / 60, -0.3, (0.25, 0.6, 0.6))
    write(16, 64, "upper: {time:.1f} s by the clock", (0.95, 0.62, 0.35), time=glfw.get_time())
    write(16, 40, "lower: {frames} frames", (0.4, 0.8, 0.8), frames=frames)
    write(16, 16, "slow computer" if slow else "fast computer")


def on_key(window, key, scancode, action, mods):
    global slow
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        slow = not slow
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    global frames
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Animation"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.swap_interval(1)  # one frame for each picture of the screen: usually 60 a second
    glfw.set_key_callback(window, on_key)

    while not glfw.window_should_close(window):
        draw()
        frames += 1
        if slow:
            time.sleep(0.1)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
