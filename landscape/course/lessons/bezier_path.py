"""Bezier path: constant speed along a curve

A path over a map, of cubic Bezier curves. De Casteljau's algorithm divides the three lines between
four control points in the ratio t, then the two lines between the new points, then the last line:
that gives the point at t. But t is not a distance: with equal steps of t the marker crawls here and
rushes there.

Keys: Space takes equal steps of t; the arrows move a control point, Tab chooses the next one.
"""
# topic: flyover
# needs: animation, height_field
# picture: frame 70
# loop: 360 frames
# keys: LEFT RIGHT UP DOWN TAB SPACE

import sys
from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from PIL import Image
from text import _, write

SECONDS = 6  # once round the path
CHORDS = 400  # of each curve, to measure it
STEPS = np.arange(CHORDS)[:, np.newaxis] / CHORDS
COLOR_MAP = np.array(
    (  # height, red, green, blue
        (0, 30, 48, 72),
        (0.06, 50, 84, 108),
        (0.08, 158, 148, 112),
        (0.2, 74, 104, 70),
        (0.5, 118, 112, 88),
        (1, 236, 228, 220),
    )
)
CREAM = (245, 232, 205)
DARK = (20, 25, 34)
TEAL = (130, 230, 220)
AMBER = (255, 180, 80)
CORAL = (250, 96, 62)

# The points that the path goes through, and the handle that leads away from each.
knots = np.array(((-130, 60), (-150, -60), (-20, -120), (60, 10), (130, -110), (120, 60)))
handles = np.array(((-15, -15), (15, -120), (12, 20), (40, 60), (110, 10), (-60, 160)))
chosen = 2
even = True  # equal steps of distance, not of t


def make_land():
    """Return the map, (480, 2048, 3): the island in the middle of the sea."""
    image = Image.open(Path(__file__).parent / "data" / "heights.png").convert("F")
    heights = np.asarray(image.resize((480, 480), Image.BICUBIC)) / 65535
    light = 1 + 14 * (np.roll(heights, -1, (0, 1)) - np.roll(heights, 1, (0, 1)))
    levels = COLOR_MAP[:, 0]
    channels = [light * np.interp(heights, levels, COLOR_MAP[:, n]) for n in (1, 2, 3)]
    land = np.uint8(np.stack(channels, 2).clip(0, 255))
    return np.pad(land, ((0, 0), (784, 784), (0, 0)), "edge")  # sea beside it


LAND = make_land()


def casteljau(points, t):
    """Return the points that are found on the way to the one at t, in arrays of 3, 2 and 1."""
    levels = []
    while len(points) > 1:
        points = (1 - t) * points[:-1] + t * points[1:]
        levels.append(points)
    return levels


def make_curves():
    """Return the four control points of each curve, (n, 4, 2)."""
    end = np.roll(knots, -1, 0)
    back = np.roll(handles, -1, 0)
    return np.stack((knots, knots + handles, end - back, end), 1)


def points_on(curve):
    """Return the points of a curve at CHORDS equal steps of t, (n, 2)."""
    control_points = curve[:, np.newaxis]  # each beside all steps
    return casteljau(control_points, STEPS)[-1][0]


def lengths_along(path):
    """Return how far it is along a closed path to each of its points, and back to the first."""
    chords = np.diff(path, axis=0, append=path[:1])
    return np.append(0, np.hypot(chords[:, 0], chords[:, 1]).cumsum())


def places_at(times, path, count):
    """Return the places at times, in rounds: the curve's number, from 0, plus its t."""
    times = times % 1
    if not even:
        return times * count
    lengths = lengths_along(path)
    return np.interp(times * lengths[-1], lengths, np.arange(len(lengths)) / CHORDS)


def levels_at(curves, place):
    """Return the control points of the curve at a place, and all points found from them."""
    curve = curves[int(place)]
    return [curve, *casteljau(curve, place % 1)]


def mark(picture, points, radius, color):
    """Draw discs at points (..., 2): columns and rows from the middle of the picture."""
    rows, columns, _channels = picture.shape
    around = np.argwhere(np.hypot(*np.mgrid[-5:6, -5:6]) <= radius) - 5
    pixels = np.round(points)[..., np.newaxis, :] + around + (columns // 2, rows // 2)
    column, row = np.int64(pixels).T
    picture[row.clip(0, rows - 1), column.clip(0, columns - 1)] = color


def join(picture, points, color):
    """Draw lines from point to point, and the points."""
    steps = STEPS[:, np.newaxis]
    mark(picture, (1 - steps) * points[:-1] + steps * points[1:], 1, color)
    mark(picture, points, 3.2, color)


def draw(columns, now):
    """Return the picture, with dots for the last 30 tenths of a second, and the marker's place."""
    picture = LAND[:, 1024 - columns // 2 : 1024 + columns // 2].copy()
    curves = make_curves()
    path = np.concatenate([points_on(curve) for curve in curves])
    mark(picture, path, 1, CREAM)

    # The dots, and the marker last.
    times = np.append(np.floor(10 * now - np.arange(30)) / 10, now) / SECONDS
    places = places_at(times, path, len(curves))
    for place in places:
        mark(picture, levels_at(curves, place)[-1], 3.2, CORAL)

    # The chosen handle, and how de Casteljau's algorithm finds the marker.
    place = places[-1]
    join(picture, knots[chosen] + ((-1,), (1,)) * handles[chosen], CREAM)
    marker = levels_at(curves, place)
    for points, color in zip(marker, (DARK, TEAL, AMBER, CORAL), strict=True):
        join(picture, points, color)
    mark(picture, marker[-1], 5, CORAL)
    return picture, place


def show(picture):
    """Load a picture into the texture, and draw it over the whole window."""
    rows, columns, _channels = picture.shape
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, rows, GL_RGB, GL_UNSIGNED_BYTE, picture)
    glBegin(GL_QUADS)
    for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
        glTexCoord2f(x * columns / 2048, (1 - y) * rows / 512)  # the first row is the top
        glVertex2f(2 * x - 1, 2 * y - 1)
    glEnd()


def on_key(window, key, scancode, action, mods):
    global chosen, even
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        handles[chosen, 0] -= 10
    elif key == glfw.KEY_RIGHT:
        handles[chosen, 0] += 10
    elif key == glfw.KEY_UP:
        handles[chosen, 1] -= 10
    elif key == glfw.KEY_DOWN:
        handles[chosen, 1] += 10
    elif key == glfw.KEY_TAB:
        chosen = (chosen + 1) % len(knots)
    elif key == glfw.KEY_SPACE:
        even = not even
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Bezier path"), None, None)
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
        picture, place = draw(columns, glfw.get_time())
        show(picture)

        write(16, 40, "equal steps of distance" if even else "equal steps of t")
        write(16, 16, "curve {curve}, t = {t:.2f}", curve=int(place), t=place % 1)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
