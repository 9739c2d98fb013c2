"""Line clipping: cut at the near plane, then at the screen

The screen is the dark area. A point's outcode has a bit for each border of the screen that the
point is beyond. A line whose ends share a bit is dropped, and any other is cut. Without the near
plane, the track behind the camera hangs upside down in the sky; without the screen, pixels enter at
the opposite border.

Keys: N leaves out the near plane, S the screen; Left and Right turn the camera.
"""
# topic: flyover
# needs: projection_by_hand, bresenham
# picture: frame 1
# keys: LEFT RIGHT N S

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LABELS = ("cut nowhere", "cut at the screen"), ("cut at the near plane", "cut at both")
LENS = 240  # pixels of a unit at distance 1
NEAR = 1.5
FAR = 2000
LEFT, RIGHT, BOTTOM, TOP = 1, 2, 4, 8  # the bits of an outcode
SLATE = (20, 27, 38)  # the screen
TINTS = np.array(((34, 10, 6), (-8, 24, 24), (22, 22, -8), (6, 10, 38)))  # what each bit adds
WHOLE, CUT, DROPPED = range(3)
COLORS = np.array(((245, 232, 205), (242, 158, 70), (110, 142, 196)))

turn = -8
near_plane = True
screen_clip = True


def make_track():
    """Return lines (n, 2, 3): a railway with a fence at each side, and hills far ahead.

    x is ahead, y to the right, and z up.
    """
    lines = [((-40, y, -4), (400, y, -4)) for y in (-2, 2)]  # rails
    lines += [((x, -3, -4), (x, 3, -4)) for x in range(-40, 160, 3)]  # sleepers
    for x in range(-50, 400, 15):
        for y in (-9, 9):
            lines.append(((x, y, -4), (x, y, 8)))
        for y in (-9, 9):
            for z in (6, 8):
                lines.append(((x, y, z), (x + 15, y, z)))

    ridge = [
        (400, y, 60 * abs(np.sin(y / 90)) + 9 * np.sin(y / 23)) for y in range(-1200, 1201, 15)
    ]
    lines += zip(ridge[:-1], ridge[1:], strict=True)
    return np.array(lines, float)


TRACK = make_track()


def outcodes(column, row, box):
    """Return the codes of points; box: left, right, top, bottom."""
    left, right, top, bottom = box
    return TOP * (row < top) + BOTTOM * (row > bottom) + RIGHT * (column > right) + (column < left)


def clip(lines, axis, first, last):
    """Return lines (n, 2, k), cut where a coordinate of their two ends is not first to last."""
    lines = cut_at(lines, axis, first, sign=1)
    return cut_at(lines, axis, last, sign=-1)


def cut_at(lines, axis, border, sign):
    """Return what is on one side of a border: a coordinate above it (sign 1) or below it (-1)."""
    inside = sign * (lines[..., axis] - border) >= 0
    some = inside.any(1)  # lines with no end inside are dropped
    lines = lines[some]
    inside = inside[some]

    # Where the lines cross the border, as a part of the way from start to end.
    start = lines[:, :1]
    way = lines[:, 1:] - start
    along = way[..., axis]
    part = (border - start[..., axis]) / np.where(along, along, 1)
    crossing = start + part[..., np.newaxis] * way
    return np.where(inside[..., np.newaxis], lines, crossing)


def set_pixels(picture, lines):
    """Set the pixels of lines, (n, 2, 5): column, row and colour of their ends.

    The lesson bresenham shows how. Indices beyond the last begin again at 0.
    """
    start, end = np.round(lines).astype(int).transpose(1, 2, 0)
    length = np.maximum(1, abs(end - start)[:2].max(0))
    line = np.repeat(np.arange(len(length)), length + 1)  # which line each pixel belongs to
    first = np.cumsum(length + 1) - length - 1  # the number of each line's first pixel
    k = np.arange(len(line)) - first[line]
    column, row = start[:2, line] + (2 * k * (end - start)[:2, line] // length[line] + 1) // 2
    picture[row % len(picture), column % picture.shape[1]] = start[2:, line].T


def paint_regions(columns, box):
    """Return a picture of the nine regions around the screen and of the screen, by outcode."""
    row, column = np.ogrid[:480, :columns]
    codes = outcodes(column, row, box)
    bits = codes[..., np.newaxis] >> np.arange(4) & 1
    return np.uint8(SLATE + bits @ TINTS)


def look():
    """Return the track as the camera sees it: x ahead, y to the right, z up."""
    cos = np.cos(np.radians(turn))
    sin = np.sin(np.radians(turn))
    lines = TRACK @ ((cos, -sin, 0), (sin, cos, 0), (0, 0, 1))
    return clip(lines, 0, NEAR, FAR) if near_plane else lines


def project(lines, columns):
    """Return the columns and rows, (n, 2) each, of both ends of lines."""
    x, y, z = np.moveaxis(lines, 2, 0)
    x = np.where(abs(x) < 0.1, 0.1, x)  # never divide by zero
    return columns / 2 + LENS * y / x, 232 - LENS * z / x


def classify(column, row, box):
    """Return for each line whether it is whole, cut or dropped."""
    start, end = outcodes(column, row, box).T
    beyond_a_border = start & end > 0  # both ends, and the same border
    return np.where(start | end, np.where(beyond_a_border, DROPPED, CUT), WHOLE)


def draw(columns):
    """Return the picture, and how many lines in front of the camera are whole, cut and dropped."""
    left = columns // 5
    right = columns - left
    top = 84
    bottom = 380
    box = left, right, top, bottom
    picture = paint_regions(columns, box)
    column, row = project(look(), columns)
    kind = classify(column, row, box)
    colors = COLORS[kind][:, np.newaxis].repeat(2, 1)  # of both ends
    lines = np.concatenate((np.stack((column, row), 2), colors), 2)

    # Around the screen: darker, and always cut at the window.
    in_window = clip(clip(lines, 0, 0, columns - 1), 1, 0, 479)
    set_pixels(picture, in_window * (1, 1, 0.7, 0.7, 0.7))

    # On the screen, which is a picture of its own; its lines begin at its top left.
    screen = picture[top : bottom + 1, left : right + 1]
    if screen_clip:
        lines = clip(clip(lines, 0, left, right), 1, top, bottom)
    set_pixels(screen, lines - (left, top, 0, 0, 0))
    return picture, np.bincount(kind, minlength=3)


def show(picture):
    """Load a picture into the texture, and draw it over the whole window."""
    rows, columns, _channels = picture.shape
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, rows, GL_RGB, GL_UNSIGNED_BYTE, picture)
    glBegin(GL_QUADS)
    for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
        glTexCoord2f(x * columns / 2048, (1 - y) * rows / 512)  # the first row is the top
        glVertex2f(2 * x - 1, 2 * y - 1)
    glEnd()


def write_outcodes():
    """Write the code of each region into it; the screen itself has 0000."""
    for side, x in (LEFT, -0.8), (0, 0), (RIGHT, 0.8):
        for edge, y in (TOP, 0.75), (0, 0.5), (BOTTOM, -0.65):
            write(-20, -10, "{code:04b}", at=(x, y, 0), code=edge + side)


def on_key(window, key, scancode, action, mods):
    global turn, near_plane, screen_clip
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn = max(-16, turn - 4)
    elif key == glfw.KEY_RIGHT:
        turn = min(16, turn + 4)
    elif key == glfw.KEY_N:
        near_plane = not near_plane
    elif key == glfw.KEY_S:
        screen_clip = not screen_clip
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Line clipping"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_TEXTURE_2D)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2048, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes(3 << 20))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        columns = min(2048, 480 * width // height // 4 * 4)
        picture, (whole, cut, dropped) = draw(columns)
        show(picture)
        write_outcodes()

        write(16, 40, LABELS[near_plane][screen_clip])
        write(16, 16, "{whole} whole, {cut} cut, {out} dropped", whole=whole, cut=cut, out=dropped)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
