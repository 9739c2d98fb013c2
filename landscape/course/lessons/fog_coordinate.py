"""Fog coordinate: water that darkens with its depth

Each fragment gets an amount of fog. Usually it follows from the distance to the eye; with
GL_FOG_COORDINATE it is interpolated between values given with the vertices, here their depths. The
shallows are clear and the deep is dark, from every direction. With fog by distance, the land
darkens as well. If depths are clamped at the surface, as there is no fog above it, the fog climbs
up the rocks: the interpolation then begins at their tops and not at the surface.

Keys: Space fog by the distance, C depths clamped; Up and Down sea level, Left and Right visibility.
"""
# topic: voxels
# needs: fog, height_columns, blending
# picture: frame 1
# keys: SPACE C UP DOWN LEFT RIGHT

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

SIDE = 48  # columns of the land, across and down
BED = -11  # the height of the deepest bed
ABOVE = 20  # from here down, depths are counted
DEEP = 0.04, 0.14, 0.26  # the fog's colour: what one sees where no light comes back from the bed
STACKS = ((33, 15, 5), (32, 29, 3), (14, 35, 6), (42, 40, 2))  # x, z and height of rocks in the sea
CUBE = np.indices((2, 2, 2)).reshape(3, 8).T  # its corners, from (0, 0, 0) to (1, 1, 1)
FACES = np.array(((4, 6, 7, 5), (0, 1, 3, 2), (2, 3, 7, 6), (1, 5, 7, 3), (0, 2, 6, 4)))
SHADES = np.repeat((0.75, 0.6, 1, 0.85, 0.5), 4)[:, np.newaxis]  # of the faces' vertices
MUD, SAND, GRASS, ROCK = (0.6, 0.55, 0.5), (0.93, 0.84, 0.62), (0.5, 0.68, 0.35), (0.62, 0.58, 0.55)

level = 0  # of the sea
reach = 8  # visibility: so deep, everything has the fog's colour
by_depth = True
clamped = False


def make_tops():
    """Return x, z and the height of the top of each column: a hill, and some rocks in the sea."""
    z, x = np.mgrid[:SIDE, :SIDE].reshape(2, -1)
    top = 12 * np.exp(-((x - 9) ** 2 + (z - 6) ** 2) / 330) + 2 * np.sin(x / 5) * np.sin(z / 4)
    top = np.round(top - 0.12 * x - 0.12 * z).clip(BED + 1)
    for east, south, height in STACKS:
        top[(x - east) ** 2 + (z - south) ** 2 < 5] = height
    return x, z, top


def make_columns():
    """Return the vertices and colours of the tops and sides of all columns, (n, 3) each."""
    x, z, top = make_tops()
    low = np.stack((x, np.full_like(x, BED), z), 1)
    high = np.stack((x + 1, top, z + 1), 1)
    corners = np.where(CUBE, high[:, np.newaxis], low[:, np.newaxis])
    vertices = corners[:, FACES].reshape(-1, 3) - (SIDE / 2, 0, SIDE / 2)

    kinds = np.digitize(top, (-4, 2, 6))  # the heights from which it is sand, grass, rock
    grain = np.random.default_rng(5).uniform(0.9, 1, (len(x), 1))
    tints = np.array((MUD, SAND, GRASS, ROCK))[kinds] * grain
    colors = (tints[:, np.newaxis] * SHADES).reshape(-1, 3)
    return np.float32(vertices), np.float32(colors)


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 200)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, 4, -119)
    glRotatef(35, 1, 0, 0)
    glRotatef(-40, 0, 1, 0)


def set_fog():
    """Let the fog begin at the surface of the sea, or at a distance; return where it begins."""
    if by_depth:
        source = GL_FOG_COORDINATE
        start = ABOVE - level
        end = start + reach
    else:
        source = GL_FRAGMENT_DEPTH
        start = 85
        end = start + 8 * reach
    glFogi(GL_FOG_COORDINATE_SOURCE, source)
    glFogf(GL_FOG_START, start)
    glFogf(GL_FOG_END, end)
    return start


def draw_land(vertices):
    """Draw the land and the bed; each vertex brings its depth as its fog coordinate."""
    glEnable(GL_FOG)
    surface = set_fog()
    depths = ABOVE - vertices[:, 1]
    if clamped:
        depths = np.maximum(depths, surface)
    else:
        depths = np.maximum(depths, 0)
    glFogCoordPointer(GL_FLOAT, 0, depths)
    glDrawArrays(GL_QUADS, 0, len(vertices))
    glDisable(GL_FOG)


def draw_surface():
    """Blend the surface of the sea over what lies below; it has no fog."""
    glEnable(GL_BLEND)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glColor4f(0.45, 0.7, 0.8, 0.22)
    glBegin(GL_QUADS)
    for x, z in ((-1, -1), (-1, 1), (1, 1), (1, -1)):
        glVertex3f(x * SIDE / 2, level - 0.1, z * SIDE / 2)
    glEnd()
    glDisable(GL_BLEND)


def on_key(window, key, scancode, action, mods):
    global level, reach, by_depth, clamped
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_UP:
        level += 1
    elif key == glfw.KEY_DOWN:
        level -= 1
    elif key == glfw.KEY_LEFT:
        reach = max(1, reach - 1)
    elif key == glfw.KEY_RIGHT:
        reach += 1
    elif key == glfw.KEY_SPACE:
        by_depth = not by_depth
    elif key == glfw.KEY_C:
        clamped = not clamped
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Fog coordinate"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    glFogi(GL_FOG_MODE, GL_LINEAR)
    glFogfv(GL_FOG_COLOR, (*DEEP, 1))
    vertices, colors = make_columns()
    glVertexPointer(3, GL_FLOAT, 0, vertices)
    glColorPointer(3, GL_FLOAT, 0, colors)
    for array in (GL_VERTEX_ARRAY, GL_COLOR_ARRAY, GL_FOG_COORDINATE_ARRAY):
        glEnableClientState(array)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_land(vertices)
        draw_surface()

        write(16, 64, "depth clamped" if clamped else "depth not clamped")
        write(16, 40, "fog from the depth" if by_depth else "fog from the distance")
        write(16, 16, "sea level {level}, visibility {reach}", level=level, reach=reach)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
