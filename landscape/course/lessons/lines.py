"""Lines and patterns: width, stipple and smoothing

A line has a width in pixels, and a point a size. With GL_LINE_STIPPLE a line is dashed: 16 bits
say which pixels are drawn, the lowest bit first, each for as many pixels as the factor says. A
polygon has a stipple, too, 32 by 32 bits that lie on the screen like a screen of holes. Without
smoothing a slanted line is a staircase. With it, a pixel that the line covers in part is drawn in
part, which is done by blending.

Keys: Up and Down change the width; Left and Right the factor; Space smooths; F changes the
pattern of the polygon.
"""
# topic: shapes
# needs: primitives
# picture: frame 0
# keys: LEFT RIGHT UP DOWN SPACE F

import sys

import glfw
from OpenGL.GL import *
from text import _, write

PATTERNS = (0xFFFF, 0x00FF, 0x3333, 0x1C47)
LABELS = ("stripes", "checks", "no pattern")
width = 3
factor = 2
smooth = True
hatching = 0

AMBER = (0.95, 0.62, 0.35)
TEAL = (0.3, 0.65, 0.65)
CREAM = (0.95, 0.9, 0.8)


def stipple():
    """Return 32 rows of 32 bits, from the lowest row up: stripes, or checks."""
    rows = []
    for row in range(32):
        if hatching == 0:
            bits = [(column + row) % 8 < 3 for column in range(32)]
        else:
            bits = [(column // 4 + row // 4) % 2 for column in range(32)]
        rows.append(sum(1 << 31 - column for column, bit in enumerate(bits) if bit))
    return b"".join(row.to_bytes(4, "big") for row in rows)


def set_smoothing(on):
    for capability in (GL_LINE_SMOOTH, GL_POINT_SMOOTH, GL_POLYGON_SMOOTH, GL_BLEND):
        if on:
            glEnable(capability)
        else:
            glDisable(capability)
    # A pixel that is covered in part keeps the rest of what was there: the lesson blending.
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)


def draw_lines(pixel):
    """Draw a slanted line for each pattern, with its bits, and points of the same width."""
    glEnable(GL_LINE_STIPPLE)
    for number, pattern in enumerate(PATTERNS):
        y = 380 - 52 * number
        glLineStipple(max(1, round(factor * pixel)), pattern)
        glColor3f(*AMBER)
        glBegin(GL_LINES)
        glVertex2f(24, y)
        glVertex2f(330, y + 34)
        glEnd()
    glDisable(GL_LINE_STIPPLE)
    glColor3f(*TEAL)
    glBegin(GL_POINTS)
    for number in range(8):
        glVertex2f(34 + 40 * number, 170)
    glEnd()


def draw_polygons():
    """Draw three triangles, two with the pattern over the third: it covers only some pixels."""
    glColor3f(0.22, 0.36, 0.42)
    glBegin(GL_TRIANGLES)
    for x, y in ((410, 170), (610, 250), (450, 420)):
        glVertex2f(x, y)
    glEnd()
    if hatching < 2:
        glEnable(GL_POLYGON_STIPPLE)
        glPolygonStipple(stipple())
    glColor3f(0.85, 0.35, 0.2)
    glBegin(GL_TRIANGLES)
    for x, y in ((380, 330), (520, 200), (620, 390)):
        glVertex2f(x, y)
    glEnd()
    glDisable(GL_POLYGON_STIPPLE)


def draw(wide, height):
    glViewport(0, 0, wide, height)
    glLoadIdentity()
    glOrtho(0, 480 * wide / height, 0, 480, -1, 1)
    glLineWidth(width * height / 480)
    glPointSize(3 * width * height / 480)
    set_smoothing(smooth)
    draw_lines(height / 480)
    draw_polygons()
    set_smoothing(False)
    for number, pattern in enumerate(PATTERNS):
        write(0, 4, "{bits:016b}", CREAM, at=(176, 370 - 52 * number, 0), bits=pattern)
    write(16, 88, "glLineWidth({width})", AMBER, width=width)
    write(16, 64, "glPointSize({width})", TEAL, width=3 * width)
    write(16, 40, "glLineStipple({factor}, bits)", AMBER, factor=factor)
    write(16, 16, "smooth" if smooth else "not smooth")
    write(380, 16, LABELS[hatching], (0.95, 0.5, 0.35))


def on_key(window, key, scancode, action, mods):
    global factor, hatching, smooth, width
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_DOWN:
        width = max(1, width - 1)
    elif key == glfw.KEY_UP:
        width = min(8, width + 1)
    elif key == glfw.KEY_LEFT:
        factor = max(1, factor - 1)
    elif key == glfw.KEY_RIGHT:
        factor = min(8, factor + 1)
    elif key == glfw.KEY_SPACE:
        smooth = not smooth
    elif key == glfw.KEY_F:
        hatching = (hatching + 1) % 3
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Lines and patterns"), None, None)
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
