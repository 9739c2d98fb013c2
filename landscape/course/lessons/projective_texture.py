"""Projective texture: a slide projector in a room of blocks

The projector is a second camera: its matrix leads from each point to a place on the slide, and the
planes of the texture coordinates are its rows. The division by q makes a second picture, upside
down, on what is behind the projector; the clip plane w = 0 takes it away. With q = 1 nothing is
divided; without a border, slides stand side by side.

Keys: 1 leaves out the clip plane, 2 sets q to 1, 3 leaves out the border, 4 leaves out nothing.
"""
# topic: voxels
# needs: hidden_faces, perspective, clip_plane, blending, shadow_map
# picture: frame 80
# loop: 360 frames
# keys: 1 2 3

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

AIR, STONE, WOOD, PROJECTOR = range(4)
COLORS = np.array(((0, 0, 0), (0.8, 0.77, 0.74), (0.62, 0.45, 0.32), (0.85, 0.35, 0.2)))
SQUARE = (0, 0), (1, 0), (1, 1), (0, 1)
PLACE = np.array((7.5, 6.5, 7.5))  # of the projector, the origin of all vertices
PANES = np.array(((255, 205, 75), (225, 55, 45), (50, 110, 230), (255, 155, 45), (45, 165, 130)))
WHITE = (250, 245, 230)

NO_CLIP_PLANE, PARALLEL, REPEATED, COMPLETE = range(4)
LABELS = "no clip plane", "q = 1", "GL_REPEAT", "one slide"
chosen = COMPLETE


def build_hall():
    """Return the kind of block at each place, [x, y, z]: two walls, stairs, and the projector."""
    blocks = np.full((16, 14, 16), AIR)
    blocks[1:15, 1, 1:15] = STONE  # the floor
    build_wall(blocks)
    build_wall(blocks.transpose(2, 1, 0))  # the same one across: x and z exchanged

    for step in range(4):
        blocks[6 + step, 2 : 3 + step, 2:5] = WOOD
        blocks[2:5, 2 : 3 + step, 13 - step] = WOOD

    blocks[7, 2:6, 7] = WOOD  # the post under it
    blocks[7, 6, 7] = PROJECTOR
    return blocks


def build_wall(blocks):
    """Build a wall along z, with two pillars and with crenels."""
    blocks[1, 1:11, 1:15] = STONE
    blocks[2, 2:11, [3, 10]] = STONE
    blocks[1, 11, 2:15:2] = STONE


def make_mesh(blocks):
    """Return the vertices of all faces beside air: colour, normal and place."""
    vertices = []
    for axis, side in np.ndindex(3, 2):
        normal = np.roll((2 * side - 1, 0, 0), axis)
        corners = [np.roll((side, s, t), axis) - PLACE for s, t in SQUARE]
        beside = np.roll(blocks, 1 - 2 * side, axis)  # the neighbour of each block
        for place in np.argwhere((blocks != AIR) & (beside == AIR)):
            shade = 0.9 if sum(place) % 2 else 1  # a chessboard
            color = COLORS[blocks[tuple(place)]] * shade
            for corner in corners:
                vertices.append((*color, 1, *normal, *(place + corner)))

    return np.array(vertices, np.float32)


def make_slide():
    """Load a rose window: twelve panes in each of five rings, with black lead between them."""
    y, x = np.mgrid[-1:1:256j, -1:1:256j]
    ring = 5 * np.hypot(x, y)
    turn = np.arctan2(y, x) * 6 / np.pi
    slide = PANES[ring.astype(int) % 5]
    slide[(ring > 1) & (np.abs(turn - 3) < 0.5)] = WHITE  # at the top

    outside = ring > 4.9
    between_rings = ring % 1 < 0.12
    between_panes = (ring > 1) & (np.abs(turn % 1 - 0.5) > 0.44)
    slide[outside | between_rings | between_panes] = 0
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 256, 256, 0, GL_RGB, GL_UNSIGNED_BYTE, np.uint8(slide))


def set_lights():
    """Set light 0, the lamp of the projector, and light 1, that of the hall."""
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (0, 0, 0, 1))
    glLightfv(GL_LIGHT1, GL_AMBIENT, (0.22, 0.25, 0.32, 1))
    glLightfv(GL_LIGHT1, GL_DIFFUSE, (0.3, 0.28, 0.26, 1))


def look_from_projector():
    """Return the rows x, y and w of the matrix that leads to the slide; it is not kept."""
    for mode in (GL_MODELVIEW, GL_PROJECTION):
        glMatrixMode(mode)
        glLoadIdentity()
    glFrustum(-0.66, 0.66, -0.66, 0.66, 1, 10)
    glRotatef(32 + 10 * np.sin(np.pi / 3 * glfw.get_time()), 0, 1, 0)
    x, y, _z, w = glGetFloatv(GL_PROJECTION_MATRIX).T
    glLoadIdentity()
    return x, y, w


def look_from_camera(width, height):
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 60)
    glMatrixMode(GL_MODELVIEW)
    glTranslatef(0, 1.5, -40)
    glRotatef(28, 1, 0, 0)
    glRotatef(-45, 0, 1, 0)


def draw_hall(count):
    """Draw the hall in its own light."""
    glEnable(GL_LIGHT1)
    glDrawArrays(GL_QUADS, 0, count)
    glDisable(GL_LIGHT1)


def add_slide(count, x, y, w):
    """Draw the hall once more, in the projector's light, and add it to what is there.

    x, y, w: the rows of the projector's matrix, which become planes.
    """
    for cap in (GL_LIGHT0, GL_BLEND, GL_TEXTURE_2D, GL_POLYGON_OFFSET_FILL):
        glEnable(cap)

    # Only what is in front of the projector has a positive w.
    glClipPlane(GL_CLIP_PLANE0, w)
    if chosen == NO_CLIP_PLANE:
        glDisable(GL_CLIP_PLANE0)
    else:
        glEnable(GL_CLIP_PLANE0)

    wrap = GL_REPEAT if chosen == REPEATED else GL_CLAMP_TO_BORDER  # the border is black
    for name in (GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T):
        glTexParameteri(GL_TEXTURE_2D, name, wrap)

    # From -w to w on the slide becomes 0 to q, and OpenGL divides by q.
    q = (0, 0, 0, 1) if chosen == PARALLEL else w
    generate_coordinate(GL_S, GL_TEXTURE_GEN_S, (x + q) / 2)
    generate_coordinate(GL_T, GL_TEXTURE_GEN_T, (y + q) / 2)
    generate_coordinate(GL_Q, GL_TEXTURE_GEN_Q, q)
    glDrawArrays(GL_QUADS, 0, count)


def generate_coordinate(coordinate, capability, plane):
    glTexGeni(coordinate, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR)
    glTexGenfv(coordinate, GL_EYE_PLANE, plane)
    glEnable(capability)


def on_key(window, key, scancode, action, mods):
    global chosen
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        chosen = key - glfw.KEY_1
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Projective texture"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    vertices = make_mesh(build_hall())
    glInterleavedArrays(GL_C4F_N3F_V3F, 0, vertices)
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    make_slide()
    set_lights()
    glPolygonOffset(-1, -1)  # the second pass is nearer than the first
    glBlendFunc(GL_ONE, GL_ONE)
    for cap in (GL_DEPTH_TEST, GL_LIGHTING, GL_COLOR_MATERIAL):
        glEnable(cap)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        x, y, w = look_from_projector()
        look_from_camera(width, height)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glLightfv(GL_LIGHT1, GL_POSITION, (2, 6, 4, 0))
        glLightfv(GL_LIGHT0, GL_POSITION, (0, 0, 0, 1))  # where the projector is

        glPushAttrib(GL_ALL_ATTRIB_BITS)
        draw_hall(len(vertices))
        add_slide(len(vertices), x, y, w)
        glPopAttrib()

        write(16, 16, LABELS[chosen])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
