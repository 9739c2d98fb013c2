"""Bezier path: constant speed along a curve

A path over a map, of cubic Bezier curves. De Casteljau's algorithm divides the lines between four
control points in the ratio t, those between the three points found, and the last one: that is the
point at t. But t is no distance, and with equal steps of t the marker crawls, and rushes.

Keys: Space takes equal steps of t; the arrows move a control point, Tab chooses the next one.
"""
# topic: flyover
# needs: animation, height_field
# picture: frame 70
# loop: 360 frames
# keys: LEFT RIGHT UP DOWN TAB SPACE

from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from PIL import Image
from text import _, write

SECONDS, CHORDS = 6, 400  # once round the path; of each curve, to measure it
STEPS = np.arange(CHORDS)[:, None, None] / CHORDS
LEVELS = 0, 0.06, 0.08, 0.2, 0.5, 1  # heights, and their red, green and blue
SHADES = (30, 50, 158, 74, 118, 236), (48, 84, 148, 104, 112, 228), (72, 108, 112, 70, 88, 220)
COLORS = (245, 232, 205), (20, 25, 34), (130, 230, 220), (255, 180, 80), (250, 96, 62)
image = Image.open(Path(__file__).parent / "data" / "heights.png").convert("F")
heights = np.asarray(image.resize((480, 480), Image.BICUBIC)) / 65535
light = 1 + 14 * (np.roll(heights, -1, (0, 1)) - np.roll(heights, 1, (0, 1)))
land = np.stack([np.interp(heights, LEVELS, each) for each in SHADES], 2) * light[..., None]
land = np.pad(np.uint8(land.clip(0, 255)), ((0, 0), (784, 784), (0, 0)), "edge")  # sea beside it
knots = np.array(((-130, 60), (-150, -60), (-20, -120), (60, 10), (130, -110), (120, 60)))
handles = np.array(((-15, -15), (15, -120), (12, 20), (40, 60), (110, 10), (-60, 160)))
chosen, even = 2, True


def casteljau(points, t):
    """Return the points that are found on the way to the one at t, in arrays of 3, 2 and 1."""
    found = []
    while len(points) > 1:
        points = (1 - t) * points[:-1] + t * points[1:]
        found.append(points)
    return found


def mark(picture, points, radius, color):
    """Draw discs at points (..., 2): columns and rows from the middle of the picture."""
    around = np.argwhere(np.hypot(*np.mgrid[-5:6, -5:6]) <= radius) - 5
    column, row = np.int64(np.round(points)[..., None, :] + around + (picture.shape[1] // 2, 240)).T
    picture[row.clip(0, 479), column.clip(0, len(picture[0]) - 1)] = color


def join(picture, points, color):
    """Draw lines from point to point, and the points."""
    mark(picture, (1 - STEPS) * points[:-1] + STEPS * points[1:], 1, color)
    mark(picture, points, 3.2, color)


def draw(columns, now):
    """Return the picture, with dots for the last 30 tenths of a second, and the marker's place."""
    picture = land[:, 1024 - columns // 2 : 1024 + columns // 2].copy()
    end, back = np.roll(knots, -1, 0), np.roll(handles, -1, 0)
    curves = np.stack((knots, knots + handles, end - back, end), 1)
    path = casteljau(curves.swapaxes(0, 1)[:, :, None], STEPS[:, 0])[-1].reshape(-1, 2)
    length = np.append(0, np.hypot(*np.diff(path, axis=0, append=path[:1]).T).cumsum())
    mark(picture, path, 1, COLORS[0])
    times = np.append(np.floor(10 * now - np.arange(30)) / 10, now) / SECONDS % 1
    places = times * len(curves)
    if even:
        places = np.interp(times * length[-1], length, np.arange(len(length)) / CHORDS)
    for place in places:
        levels = [curves[int(place)], *casteljau(curves[int(place)], place % 1)]
        mark(picture, levels[-1], 3.2, COLORS[-1])
    handle = knots[chosen] + ((-1,), (1,)) * handles[chosen]
    for points, color in zip((handle, *levels), COLORS, strict=True):
        join(picture, points, color)
    mark(picture, points, 5, COLORS[-1])
    return picture, place


def on_key(window, key, scancode, action, mods):
    global chosen, even
    if action != glfw.RELEASE:
        handles[chosen, 0] += 10 * ((key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT))
        handles[chosen, 1] += 10 * ((key == glfw.KEY_DOWN) - (key == glfw.KEY_UP))
        chosen = (chosen + (key == glfw.KEY_TAB)) % len(knots)
        even ^= key == glfw.KEY_SPACE
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Bezier path"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_TEXTURE_2D)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2048, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes(3 << 20))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        columns = min(2048, 480 * width // height // 4 * 4)
        picture, place = draw(columns, glfw.get_time())
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, 480, GL_RGB, GL_UNSIGNED_BYTE, picture)
        glBegin(GL_QUADS)
        for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
            glTexCoord2f(x * columns / 2048, (1 - y) * 480 / 512)  # the first row is the top
            glVertex2f(2 * x - 1, 2 * y - 1)
        glEnd()
        write(16, 40, "equal steps of distance" if even else "equal steps of t")
        write(16, 16, "curve {curve}, t = {t:.2f}", curve=int(place), t=place % 1)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
