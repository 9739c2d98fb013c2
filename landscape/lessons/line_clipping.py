"""Line clipping: cut at the near plane, then at the screen

An outcode has a bit for each border of the screen, the dark area, that a point is beyond. A line
whose ends share a bit is dropped, and any other is cut. Without the near plane, the track behind
the camera hangs upside down in the sky; without the screen, pixels enter at the opposite border.

Keys: N leaves out the near plane, S the screen; Left and Right turn the camera.
"""
# topic: flyover
# needs: projection_by_hand, bresenham
# picture: frame 1
# keys: LEFT RIGHT N S

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LABELS = ("cut nowhere", "cut at the screen"), ("cut at the near plane", "cut at both")
SLATE, LENS, NEAR, FAR = (20, 27, 38), 240, 1.5, 2000  # LENS: pixels of a unit at distance 1
TINTS = np.array(((34, 10, 6), (-8, 24, 24), (22, 22, -8), (6, 10, 38)))  # what each bit adds
COLORS = np.array(((245, 232, 205), (242, 158, 70), (110, 142, 196)))  # whole, cut, dropped
turn = -8
near_plane = True
screen_clip = True
track = [((-40, y, -4), (400, y, -4)) for y in (-2, 2)]  # x ahead, y to the right, z up
track += [((x, -3, -4), (x, 3, -4)) for x in range(-40, 160, 3)]
for x in range(-50, 400, 15):
    track += [((x, y, -4), (x, y, 8)) for y in (-9, 9)]
    track += [((x, y, z), (x + 15, y, z)) for y in (-9, 9) for z in (6, 8)]
hills = [(400, y, 60 * abs(np.sin(y / 90)) + 9 * np.sin(y / 23)) for y in range(-1200, 1201, 15)]
track = np.array(track + list(zip(hills[:-1], hills[1:], strict=True)), float)  # (n, 2, 3)


def outcodes(column, row, left, right, top, bottom):
    """Return the codes of points."""
    return 8 * (row < top) + 4 * (row > bottom) + 2 * (column > right) + (column < left)


def clip(lines, axis, first, last):
    """Return lines (n, 2, k), cut where a coordinate of their two ends is not first to last."""
    for border, sign in (first, 1), (last, -1):
        inside = sign * (lines[..., axis] - border) >= 0
        lines, inside = lines[inside.any(1)], inside[inside.any(1)]
        start, way = lines[:, :1], lines[:, 1:] - lines[:, :1]
        part = (border - start[..., axis]) / np.where(way[..., axis], way[..., axis], 1)
        lines = np.where(inside[..., None], lines, start + part[..., None] * way)
    return lines


def set_pixels(picture, lines):
    """Set the pixels of lines as Bresenham does; indices beyond the last begin again at 0."""
    start, end = np.round(lines).astype(int).transpose(1, 2, 0)
    length = np.maximum(1, abs(end - start)[:2].max(0))
    line = np.repeat(np.arange(len(length)), length + 1)
    k = np.arange(len(line)) - (np.cumsum(length + 1) - length - 1)[line]
    column, row = start[:2, line] + (2 * k * (end - start)[:2, line] // length[line] + 1) // 2
    picture[row % len(picture), column % picture.shape[1]] = start[2:, line].T


def draw(columns):
    """Return the picture, and how many lines in front of the camera are whole, cut and dropped."""
    left, right, top, bottom = box = columns // 5, columns - columns // 5, 84, 380
    row, column = np.ogrid[:480, :columns]
    bits = outcodes(column, row, *box)[..., None] >> np.arange(4) & 1
    picture = np.uint8(SLATE + bits @ TINTS)
    cos, sin = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    lines = track @ ((cos, -sin, 0), (sin, cos, 0), (0, 0, 1))
    x, y, z = np.moveaxis(clip(lines, 0, NEAR, FAR) if near_plane else lines, 2, 0)
    x = np.where(abs(x) < 0.1, 0.1, x)  # never divide by zero
    column, row = columns / 2 + LENS * y / x, 232 - LENS * z / x
    start, end = outcodes(column, row, *box).T
    kind = np.where(start | end, 1 + (start & end > 0), 0)
    lines = np.stack((column, row, *COLORS[kind].T[..., None].repeat(2, 2)), 2)  # with a color
    set_pixels(picture, clip(clip(lines, 0, 0, columns - 1), 1, 0, 479) * (1, 1, 0.7, 0.7, 0.7))
    screen = picture[top : bottom + 1, left : right + 1]
    shown = clip(clip(lines, 0, left, right), 1, top, bottom)
    set_pixels(screen, (shown if screen_clip else lines) - (left, top, 0, 0, 0))
    return picture, np.bincount(kind, minlength=3)


def on_key(window, key, scancode, action, mods):
    global turn, near_plane, screen_clip
    if action != glfw.RELEASE:
        turn = min(16, max(-16, turn + 4 * ((key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT))))
        near_plane ^= key == glfw.KEY_N
        screen_clip ^= key == glfw.KEY_S
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Line clipping"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_TEXTURE_2D)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2048, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes(3 << 20))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        columns = min(2048, 480 * width // height // 4 * 4)
        picture, (whole, parts, out) = draw(columns)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, 480, GL_RGB, GL_UNSIGNED_BYTE, picture)
        glBegin(GL_QUADS)
        for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
            glTexCoord2f(x * columns / 2048, (1 - y) * 480 / 512)  # the first row is the top
            glVertex2f(2 * x - 1, 2 * y - 1)
        glEnd()
        for side, x in (1, -0.8), (0, 0), (2, 0.8):
            for code, y in (8 + side, 0.75), (side, 0.5), (4 + side, -0.65):
                write(-20, -10, "{code:04b}", at=(x, y, 0), code=code)
        write(16, 40, LABELS[near_plane][screen_clip])
        write(16, 16, "{whole} whole, {cut} cut, {out} dropped", whole=whole, cut=parts, out=out)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
