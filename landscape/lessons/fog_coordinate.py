"""Fog coordinate: water that darkens with its depth

Each fragment gets an amount of fog. Usually it follows from the distance to the eye; with
GL_FOG_COORDINATE it is interpolated between numbers that the vertices bring, here their depths.
The shallows are clear and the deep is dark, from wherever one looks. By the distance, the land
darkens as well. If depths are clamped at the surface, as there is no fog above it, the fog climbs
up the rocks: the interpolation then begins at their tops and not at the surface.

Keys: Space fog by the distance, C depths clamped; Up and Down sea level, Left and Right visibility.
"""
# topic: voxels
# needs: fog, height_columns, blending
# picture: frame 1
# keys: SPACE C UP DOWN LEFT RIGHT

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

SIDE, BED, ABOVE = 48, -11, 20  # ABOVE: from here down, depths are counted
DEEP = 0.04, 0.14, 0.26  # the fog's colour: what one sees where no light comes back from the bed
CUBE = np.indices((2, 2, 2)).reshape(3, 8).T  # its corners, from (0, 0, 0) to (1, 1, 1)
FACES = np.array(((4, 6, 7, 5), (0, 1, 3, 2), (2, 3, 7, 6), (1, 5, 7, 3), (0, 2, 6, 4)))
SHADES = np.repeat((0.75, 0.6, 1, 0.85, 0.5), 4)
# The heights from which a column is sand, grass, rock.
TINTS = np.array(((0.6, 0.55, 0.5), (0.93, 0.84, 0.62), (0.5, 0.68, 0.35), (0.62, 0.58, 0.55)))
level = 0
reach = 8
by_depth = True
clamped = False


def make_columns():
    """Return the vertices and colors of the tops and sides of all columns, (n, 3) each."""
    z, x = np.mgrid[:SIDE, :SIDE].reshape(2, -1)
    top = 12 * np.exp(-((x - 9) ** 2 + (z - 6) ** 2) / 330) + 2 * np.sin(x / 5) * np.sin(z / 4)
    top = np.round(top - 0.12 * x - 0.12 * z).clip(BED + 1)
    for east, south, height in ((33, 15, 5), (32, 29, 3), (14, 35, 6), (42, 40, 2)):  # sea stacks
        top[(x - east) ** 2 + (z - south) ** 2 < 5] = height
    low, high = np.stack((x, 0 * x + BED, z), 1), np.stack((x + 1, top, z + 1), 1)
    corners = np.where(CUBE, high[:, None], low[:, None])[:, FACES].reshape(-1, 3)
    tints = TINTS[np.digitize(top, (-4, 2, 6))] * np.random.default_rng(5).uniform(
        0.9, 1, (len(x), 1)
    )
    colors = (tints[:, None] * SHADES[:, None]).reshape(-1, 3)
    return np.float32(corners - (SIDE / 2, 0, SIDE / 2)), np.float32(colors)


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
    if action != glfw.RELEASE:
        level += (key == glfw.KEY_UP) - (key == glfw.KEY_DOWN)
        reach = max(1, reach + (key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT))
        by_depth ^= key == glfw.KEY_SPACE
        clamped ^= key == glfw.KEY_C
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Fog coordinate"), None, None)
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
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 200)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, 4, -119)
        glRotatef(35, 1, 0, 0)
        glRotatef(-40, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glEnable(GL_FOG)
        glFogi(GL_FOG_COORDINATE_SOURCE, GL_FOG_COORDINATE if by_depth else GL_FRAGMENT_DEPTH)
        start = ABOVE - level if by_depth else 85
        glFogf(GL_FOG_START, start)
        glFogf(GL_FOG_END, start + (reach if by_depth else 8 * reach))
        depths = np.maximum(ABOVE - vertices[:, 1], start if clamped else 0)
        glFogCoordPointer(GL_FLOAT, 0, depths)
        glDrawArrays(GL_QUADS, 0, len(vertices))
        glDisable(GL_FOG)
        draw_surface()
        write(16, 64, "depth clamped" if clamped else "depth not clamped")
        write(16, 40, "fog from the depth" if by_depth else "fog from the distance")
        write(16, 16, "sea level {level}, visibility {reach}", level=level, reach=reach)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
