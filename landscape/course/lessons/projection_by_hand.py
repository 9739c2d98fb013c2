"""Projection by hand: from points in space to pixels, without OpenGL

Sines and cosines take points into the camera's frame of reference, and a division by x', the
distance along the line of sight, takes them to the screen. OpenGL only shows the pixels. Without
the division nothing gets smaller with distance; with a square frustum on a screen that is wider
than high, the sun is an ellipse; with the fraction cut off, pixels are one too far left and up.

Keys: arrows and R turn the camera; D leaves out the division, S is the square frustum, C cuts off.
"""
# topic: flyover
# needs: height_field, perspective, look_at
# picture: frame 1
# keys: LEFT RIGHT UP DOWN R D S C

import sys
from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from PIL import Image
from text import _, write

CAMERA = -38, 64, 36  # x along the image's rows, y down its columns, z up; 1 unit is a pixel
NEAR = 1.5  # the frustum: at this distance it reaches from -1 to 1, across and up
FLAT = 90  # the distance of all points, where the division is left out
BACKGROUND = (33, 41, 54)
COLOR_MAP = np.array(
    (  # height of the ground, red, green, blue; of the sun, from 2
        (0.12, 80, 130, 205),
        (0.18, 120, 190, 175),
        (0.4, 155, 195, 100),
        (0.65, 235, 155, 90),
        (1, 255, 245, 230),
        (2, 205, 60, 50),
        (4, 255, 190, 80),
    )
)

theta = np.array((0, 10, 0))  # degrees about x, y and z: it rolls, looks down and turns
divided = True
square = False
cut = False


def make_sun():
    """Return a grid of points on half a sphere, (13, 25, 4): x, y, z and a place in COLOR_MAP."""
    u, v = np.mgrid[-0.5:0.5:13j, 0:2:25j] * np.pi  # latitude and longitude
    x = 230 + 66 * np.cos(u) * np.cos(v)
    y = 64 + 66 * np.cos(u) * np.sin(v)
    z = 52 + 66 * np.sin(u)
    return np.stack((x, y, z, 3 + u), 2)


def make_ground():
    """Return a grid of points on the island, (33, 33, 4): x, y, z and a place in COLOR_MAP."""
    image = Image.open(Path(__file__).parent / "data" / "heights.png")
    heights = np.asarray(image)[::4, ::4] / 65535
    y, x = 4 * np.indices((33, 33))
    z = 48 * np.maximum(heights, 0.12)  # the level of the sea
    return np.stack((x, y, z, heights), 2)


def grid_edges(rows, columns):
    """Return the edges of a grid, (n, 2): the numbers of their ends."""
    number = np.arange(rows * columns).reshape(rows, columns)  # of each point
    across = np.stack((number[:, :-1].ravel(), number[:, 1:].ravel()), 1)
    down = np.stack((number[:-1].ravel(), number[1:].ravel()), 1)
    return np.concatenate((across, down))


def make_scene():
    """Return points (n, 3), their colours, the edges between them, and the summit's number."""
    sun = make_sun()
    ground = make_ground()
    points = np.concatenate((sun.reshape(-1, 4), ground.reshape(-1, 4)))
    first = sun.shape[0] * sun.shape[1]  # the number of the first point of the ground
    edges = np.concatenate((grid_edges(13, 25), first + grid_edges(33, 33)))
    summit = first + ground[..., 3].argmax()

    levels = COLOR_MAP[:, 0]
    channels = [np.interp(points[:, 3], levels, COLOR_MAP[:, n]) for n in (1, 2, 3)]
    return points[:, :3], np.stack(channels, 1), edges, summit


points, colors, edges, summit = make_scene()


def camera_transform():
    """Return x', y' and z': how far ahead of the camera points are, to its right, and above it."""
    x, y, z = (points - CAMERA).T
    sin_x, sin_y, sin_z = np.sin(np.radians(theta))
    cos_x, cos_y, cos_z = np.cos(np.radians(theta))

    # About z: the camera's heading becomes x.
    forward = sin_z * y + cos_z * x
    right = cos_z * y - sin_z * x

    # About y: what it looks down.
    ahead = cos_y * forward - sin_y * z
    up = cos_y * z + sin_y * forward

    # About x: what it rolls.
    return ahead, sin_x * up + cos_x * right, cos_x * up - sin_x * right


def project(x, y, z, width, height):
    """Return columns and rows, with fractions; (0, 0) is the top left."""
    across = 1 if square else width / height  # how far the frustum reaches left and right
    distance = x if divided else FLAT
    column = width * (y * NEAR / distance + across) / (2 * across)
    row = height * (1 - (z * NEAR / distance + 1) / 2)
    return np.stack((column, row))


def to_pixels(places):
    """Return the pixels of places with fractions; to cut off is to round down."""
    return np.trunc(places) if cut else np.ceil(places)


def draw(width, height):
    """Return the picture, where edges are rows of points, and the summit's column and row."""
    picture = np.full((height, width, 3), BACKGROUND, np.uint8)
    x, y, z = camera_transform()
    places = project(np.maximum(x, NEAR), y, z, width, height)
    ahead = edges[(x[edges] > NEAR).all(1)]  # never divide by zero
    ahead = ahead[np.argsort(-x[ahead].sum(1))]  # the nearest are drawn last, over the others

    draw_points(picture, places, ahead, steps=np.linspace(0, 1, 64), light=0.7)
    draw_points(picture, places, ahead, steps=np.array((0, 1)), light=1)  # the ends are brighter
    return picture, places[:, summit]


def draw_points(picture, places, edges, steps, light):
    """Draw points along edges; steps: where on an edge, from 0, its start, to 1, its end."""
    height, width, _channels = picture.shape
    start = places[:, edges[:, :1]]
    end = places[:, edges[:, 1:]]
    column, row = to_pixels(start * (1 - steps) + end * steps).astype(int)
    on_screen = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    shades = np.repeat(light * colors[edges[:, :1]], len(steps), 1)
    picture[row[on_screen], column[on_screen]] = shades[on_screen]


def make_texture():
    glEnable(GL_TEXTURE_2D)
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 1024, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, None)
    for name in GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER:
        glTexParameteri(GL_TEXTURE_2D, name, GL_NEAREST)


def show(picture):
    """Load a picture into the texture, and draw it over the whole window."""
    height, width, _channels = picture.shape
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, picture)
    glBegin(GL_QUADS)
    for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
        glTexCoord2f(x * width / 1024, (1 - y) * height / 512)  # the first row is the top
        glVertex2f(2 * x - 1, 2 * y - 1)
    glEnd()


def on_key(window, key, scancode, action, mods):
    global divided, square, cut
    if action == glfw.RELEASE:
        return

    if key == glfw.KEY_R:
        theta[0] += 5
    elif key == glfw.KEY_UP:
        theta[1] -= 5
    elif key == glfw.KEY_DOWN:
        theta[1] += 5
    elif key == glfw.KEY_LEFT:
        theta[2] -= 5
    elif key == glfw.KEY_RIGHT:
        theta[2] += 5
    elif key == glfw.KEY_D:
        divided = not divided
    elif key == glfw.KEY_S:
        square = not square
    elif key == glfw.KEY_C:
        cut = not cut
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Projection by hand"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    make_texture()

    while not glfw.window_should_close(window):
        size = np.array(glfw.get_framebuffer_size(window))
        glViewport(0, 0, *size)
        scale = max(1, size[1] // 240)  # a pixel of the picture takes several of the window's
        width, height = np.minimum(size // scale, (1024, 512))
        picture, (column, row) = draw(width, height)
        show(picture)

        write(16, 40, "theta x {x}°, y {y}°, z {z}°", x=theta[0], y=theta[1], z=theta[2])
        x, y = to_pixels((column, row))
        write(16, 16, "summit: {a:.2f}, {b:.2f}: pixel {x:.0f}, {y:.0f}", a=column, b=row, x=x, y=y)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
