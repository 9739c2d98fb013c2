"""Sphere map: a torus that mirrors its surroundings

GL_SPHERE_MAP computes texture coordinates from the direction that each vertex mirrors; the texture
is the picture of a small mirror ball, as in the corner. It holds for one line of sight: walk around
the torus, and the sphere map turns with you. A cube map with GL_REFLECTION_MAP stays where it is.

Keys: Left and Right walk around; Space takes the cube map.
"""
# topic: effects
# needs: generated_texture, vertex_arrays, sky_box
# picture: frame 1 after RIGHT RIGHT
# keys: LEFT RIGHT SPACE

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))
CORAL = (0.85, 0.35, 0.2)
# The torus: its vertices in 97 circles of 49; a strip goes back and forth between two circles.
TURNS = 97
AROUND = 49
STRIP = np.arange((TURNS - 1) * AROUND, dtype=np.uint32)[:, np.newaxis] + np.array(
    (AROUND, 0), np.uint32
)
turned = 0  # degrees that you have walked around it
cube = False


def surroundings(x, y, z):
    """Return the colours, (512, 512, 3), of what lies in directions: sky, two towers and floor."""
    slope = y / np.hypot(x, z)
    colors = (0.8, 0.88, 0.95) - np.arctan(slope).clip(0)[..., np.newaxis] * (0.45, 0.36, 0.15)
    towers = (abs(np.arctan2(x, z) % np.pi - 2.9) < 0.12) & (slope < 0.22)
    colors[towers] = CORAL

    far = 1.3 / (-y).clip(0.01)  # to where the direction meets the floor
    tiles = np.clip(25 / far * np.sin(2 * x * far) * np.sin(2 * z * far), -1, 1)
    floor = (0.48, 0.5, 0.48) + tiles[..., np.newaxis] * (0.28, 0.23, 0.12)
    colors[y < 0] = floor[y < 0]
    return colors


def make_image(target, x, y, z):
    """Load a picture of the surroundings; x, y, z: the direction that each texel shows."""
    texels = np.uint8(255 * surroundings(x, y, z))
    glTexImage2D(target, 0, GL_RGB, *x.shape, 0, GL_RGB, GL_UNSIGNED_BYTE, texels)


def make_sphere_map():
    """Load the picture of a mirror ball as seen from far away, along -z."""
    t, s = np.mgrid[-1:1:512j, -1:1:512j]
    z = np.sqrt((1 - s * s - t * t).clip(0))  # s, t, z: the normal of the mirror ball
    make_image(GL_TEXTURE_2D, 2 * z * s, 2 * z * t, 2 * z * z - 1)


def make_cube_map():
    """Load the six faces; the table of directions is in the specification, section 3.8.6."""
    t, s = np.mgrid[-1:1:512j, -1:1:512j]
    one = np.ones((512, 512))
    faces = (
        (one, -t, -s),
        (-one, -t, s),
        (s, one, t),
        (s, -one, -t),
        (s, -t, one),
        (-s, -t, -one),
    )
    for number, face in enumerate(faces):
        make_image(GL_TEXTURE_CUBE_MAP_POSITIVE_X + number, *face)


def make_torus():
    turn, around = np.meshgrid(np.linspace(0, 2 * np.pi, TURNS), np.linspace(0, 2 * np.pi, AROUND))
    x = np.cos(turn)
    y = np.sin(turn)
    radius = np.cos(around)
    normals = np.array((radius * x, radius * y, np.sin(around)), np.float32)
    places = 0.5 * normals + np.array((x, y, 0 * x))
    glVertexPointer(3, GL_FLOAT, 0, places.T.astype(np.float32))
    glNormalPointer(GL_FLOAT, 0, normals.T.copy())


def draw_quad(target, points, coordinates):
    glEnable(target)
    glBegin(GL_QUADS)
    for point, coordinate in zip(points, coordinates, strict=True):
        glTexCoord3f(*coordinate)
        glVertex3f(*point)
    glEnd()
    glDisable(target)


def look(width, height):
    glViewport(0, 0, width, height)
    wide = width / height
    for mode in (GL_MODELVIEW, GL_TEXTURE, GL_PROJECTION):
        glMatrixMode(mode)
        glLoadIdentity()
    glFrustum(-wide / 4, wide / 4, -0.25, 0.25, 1, 50)
    glMatrixMode(GL_TEXTURE)
    glRotatef(-turned, 0, 1, 0)  # from eye to world coordinates


def draw_surroundings(wide):
    """Draw the cube map behind everything; a point far away is its own direction."""
    behind = [(10 * wide * x, 10 * y, -40) for x, y in CORNERS]
    draw_quad(GL_TEXTURE_CUBE_MAP, behind, behind)


def draw_ball(wide):
    """Draw the sphere map's texture in the corner, untransformed."""
    glLoadIdentity()
    corner = [(0.1 * x - 0.3 * wide + 0.115, 0.1 * y + 0.185, -1.2) for x, y in CORNERS]
    draw_quad(GL_TEXTURE_2D, corner, [(x > 0, y > 0, 0) for x, y in CORNERS])


def draw_torus():
    """Draw the torus; the texture coordinates come from what each vertex mirrors."""
    glMatrixMode(GL_MODELVIEW)
    glTranslatef(0, 0, -7.5)
    glRotatef(turned, 0, 1, 0)
    glPushAttrib(GL_ENABLE_BIT)
    glEnable(GL_TEXTURE_CUBE_MAP if cube else GL_TEXTURE_2D)
    mode = GL_REFLECTION_MAP if cube else GL_SPHERE_MAP
    generate(GL_S, GL_TEXTURE_GEN_S, mode)
    generate(GL_T, GL_TEXTURE_GEN_T, mode)
    if cube:  # a direction has three
        generate(GL_R, GL_TEXTURE_GEN_R, mode)
    glDrawElements(GL_TRIANGLE_STRIP, STRIP.size, GL_UNSIGNED_INT, STRIP)
    glPopAttrib()
    glMatrixMode(GL_TEXTURE)
    glLoadIdentity()  # the letters have a texture, too


def generate(coordinate, capability, mode):
    glTexGeni(coordinate, GL_TEXTURE_GEN_MODE, mode)
    glEnable(capability)


def on_key(window, key, scancode, action, mods):
    global cube, turned
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turned -= 15
    elif key == glfw.KEY_RIGHT:
        turned += 15
    elif key == glfw.KEY_SPACE:
        cube = not cube
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Sphere map"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for name in (GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T):
        glTexParameteri(GL_TEXTURE_CUBE_MAP, name, GL_CLAMP_TO_EDGE)
    for target in (GL_TEXTURE_2D, GL_TEXTURE_CUBE_MAP):
        glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    make_sphere_map()
    make_cube_map()
    make_torus()
    for array in (GL_VERTEX_ARRAY, GL_NORMAL_ARRAY):
        glEnableClientState(array)
    glEnable(GL_DEPTH_TEST)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        look(width, height)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_surroundings(width / height)
        if not cube:
            draw_ball(width / height)
        draw_torus()
        write(16, 16, "cube map" if cube else "sphere map", (0, 0, 0))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
