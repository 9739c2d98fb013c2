"""Line clipping: only what is in the frame

A bundle of lines, and a frame in the middle of the picture. The lines are drawn from one end to the
other, in amber at the first end and in blue at the second, also outside of the frame.

Let clip return only the part of a line that lies in the frame: its two ends x0, y0, x1, y1, in the
same order as before, or None if no part of the line lies there. The frame reaches from LEFT to
RIGHT and from TOP to BOTTOM, borders included; rows are counted downwards, so TOP is less than
BOTTOM. The numbers have fractions, and need not be rounded. A line may be horizontal or vertical,
it may begin and end outside of the frame and cross it nevertheless, and it may pass it by.

Where a line is cut at a border, it keeps its direction: the cut divides it in a certain ratio,
which is the same for x and for y.

OpenGL only shows the picture. Change only clip.

Keys: Left and Right turn the lines.
"""
# exercise: line_clipping

import sys

import glfw
import numpy as np
from OpenGL.GL import *

WIDTH = 80  # of the picture; each of its pixels covers several of the window's
HEIGHT = 60
SIDE = 128  # of the texture: a power of two
LEFT = 22
TOP = 16
RIGHT = 58
BOTTOM = 44
OUTSIDE = (26, 32, 42)
INSIDE = (54, 66, 82)
COLORS = ((242, 150, 60), (225, 170, 120), (200, 200, 200), (120, 170, 215), (50, 140, 230))
LINES = (  # from the middle of the frame, before they are turned
    ((-15, -6), (12, 8)),
    ((-30, 3), (-4, 10)),
    ((2, -10), (33, -4)),
    ((-32, -12), (31, 11)),
    ((-12, 26), (-9, -25)),
    ((0, 0), (0, 27)),
    ((-36, 0), (25, 0)),
    ((6, -24), (6, 24)),
    ((-36, 8), (-14, 26)),
    ((36, -4), (10, -26)),
    ((-38, -26), (-28, -14)),
    ((22, 24), (34, 20)),
    ((14, 10), (34, 24)),
    ((-25, -18), (-8, -2)),
    ((30, -14), (30, 12)),
    ((-14, 22), (10, 22)),
)
turned = 0


def outcode(x, y):
    """Return a bit for each border that a point is beyond."""
    return 1 * (x < LEFT) + 2 * (x > RIGHT) + 4 * (y < TOP) + 8 * (y > BOTTOM)


def cut(x, y, other_x, other_y, code):
    """Return where the line from x, y meets a border that this point is beyond."""
    if code & 3:
        border = LEFT if code & 1 else RIGHT
        return border, y + (other_y - y) * (border - x) / (other_x - x)
    border = TOP if code & 4 else BOTTOM
    return x + (other_x - x) * (border - y) / (other_y - y), border


def clip(x0, y0, x1, y1):
    """Return the part of a line that lies in the frame, x0, y0, x1, y1, or None."""
    while True:
        first = outcode(x0, y0)
        second = outcode(x1, y1)
        if first & second:
            return None
        if not first | second:
            return x0, y0, x1, y1
        if first:
            x0, y0 = cut(x0, y0, x1, y1, first)
        else:
            x1, y1 = cut(x1, y1, x0, y0, second)


def draw_line(picture, x0, y0, x1, y1):
    """Draw a line, in amber where it begins and in blue where it ends."""
    count = int(max(abs(x1 - x0), abs(y1 - y0))) + 1
    for step in range(count + 1):
        column = int(np.floor(x0 + (x1 - x0) * step / count + 0.5))
        row = int(np.floor(y0 + (y1 - y0) * step / count + 0.5))
        if 0 <= column < WIDTH and 0 <= row < HEIGHT:
            picture[row, column] = COLORS[5 * step // (count + 1)]


def make_picture():
    picture = np.full((HEIGHT, WIDTH, 3), OUTSIDE, np.uint8)
    picture[TOP : BOTTOM + 1, LEFT : RIGHT + 1] = INSIDE
    cos = np.cos(np.radians(turned))
    sin = np.sin(np.radians(turned))
    for line in LINES:
        ends = [(40 + cos * x - sin * y, 30 + sin * x + cos * y) for x, y in line]
        clipped = clip(*ends[0], *ends[1])
        if clipped is not None:
            draw_line(picture, *clipped)
    return picture


def draw(picture):
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, WIDTH, HEIGHT, GL_RGB, GL_UNSIGNED_BYTE, picture)
    glBegin(GL_QUADS)
    for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
        glTexCoord2f(x * WIDTH / SIDE, y * HEIGHT / SIDE)
        glVertex2f(2 * x - 1, 1 - 2 * y)  # the picture's first row is at the top
    glEnd()


def on_key(window, key, scancode, action, mods):
    global turned
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turned -= 20
    elif key == glfw.KEY_RIGHT:
        turned += 20
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(320, 240, "Lines in a frame", None, None)
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
