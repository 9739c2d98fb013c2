"""Mirror: a knot in a polished floor

glScalef(1, -1, 1) draws the knot once more, upside down under the floor; the floor is then blended
over it. A mirrored triangle winds the other way: without glFrontFace, the image shows its inside. A
clip plane cuts off what is below the floor: without it, the image of that rises above the floor.
The stencil buffer keeps the image inside the outline of the floor.

Keys: F leaves out glFrontFace, C the clip plane, S the stencil test.
"""
# topic: landscape
# needs: clip_plane, orientation, blending, world_light
# picture: frame 60
# loop: 240 frames
# keys: F C S

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LIGHT = (-2, 5, 3, 0)
CORAL = (0.95, 0.45, 0.25)
CREAM = (0.95, 0.9, 0.8, 0.5)
TEAL = (0.15, 0.35, 0.4, 0.5)
TURNS = 193  # vertices along the knot
AROUND = 25  # and around its tube; the last is where the first is
front_face = True
clip_plane = True
stencil = True


def make_knot():
    """Make a tube along a curve that winds around a ring; return the indices of its strip."""
    turn, around = np.meshgrid(np.linspace(0, 2 * np.pi, TURNS), np.linspace(0, 2 * np.pi, AROUND))
    x = np.cos(2 * turn)
    y = np.sin(2 * turn)
    z = 0 * turn
    outward = np.array((x * np.cos(3 * turn), y * np.cos(3 * turn), np.sin(3 * turn)))
    center = np.array((x, y + 1.15, z)) + outward / 2  # some of it is below y = 0
    across = np.cross(np.gradient(center, axis=2), outward, axis=0)
    normals = np.cos(around) * outward + np.sin(around) * across / np.linalg.norm(across, axis=0)
    glVertexPointer(3, GL_FLOAT, 0, (center + 0.27 * normals).T.astype(np.float32))
    glNormalPointer(GL_FLOAT, 0, normals.T.astype(np.float32))

    # The strip goes back and forth between a circle of the tube and the next one.
    first = np.arange((TURNS - 1) * AROUND, dtype=np.uint32)
    return np.stack((first + AROUND, first), 1).astype(np.uint32)


def draw_knot(strip):
    glColor3f(*CORAL)
    glDrawElements(GL_TRIANGLE_STRIP, strip.size, GL_UNSIGNED_INT, strip)


def draw_floor():
    """Draw a chessboard at y = 0, half transparent."""
    glBegin(GL_QUADS)
    glNormal3f(0, 1, 0)
    for x in range(-3, 3):
        for z in range(-3, 3):
            glColor4f(*(CREAM if (x + z) % 2 else TEAL))
            for corner_x, corner_z in ((x, z), (x, z + 1), (x + 1, z + 1), (x + 1, z)):
                glVertex3f(corner_x, 0, corner_z)
    glEnd()


def mark_floor():
    """Set the stencil buffer to 1 where the floor is, and draw nothing."""
    glStencilFunc(GL_NEVER, 1, 1)  # always fails, and so replaces
    glStencilOp(GL_REPLACE, GL_KEEP, GL_KEEP)
    draw_floor()


def draw_image(strip):
    """Draw the mirrored knot, where the floor will be blended over it."""
    glStencilFunc(GL_EQUAL if stencil else GL_ALWAYS, 1, 1)
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP)
    glScalef(1, -1, 1)
    glLightfv(GL_LIGHT0, GL_POSITION, LIGHT)  # mirrored, too
    glFrontFace(GL_CW if front_face else GL_CCW)
    glClipPlane(GL_CLIP_PLANE0, (0, 1, 0, 0))
    if clip_plane:
        glEnable(GL_CLIP_PLANE0)
    else:
        glDisable(GL_CLIP_PLANE0)
    draw_knot(strip)
    glDisable(GL_CLIP_PLANE0)
    glFrontFace(GL_CCW)
    glScalef(1, -1, 1)  # mirrored twice is not mirrored


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 30)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, -0.1, -13.5)
    glRotatef(20, 1, 0, 0)
    glRotatef(20 * glfw.get_time(), 0, 1, 0)


def on_key(window, key, scancode, action, mods):
    global front_face, clip_plane, stencil
    if action != glfw.PRESS:
        return
    if key == glfw.KEY_F:
        front_face = not front_face
    elif key == glfw.KEY_C:
        clip_plane = not clip_plane
    elif key == glfw.KEY_S:
        stencil = not stencil
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Mirror"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    for cap in (GL_DEPTH_TEST, GL_CULL_FACE, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL, GL_BLEND):
        glEnable(cap)
    for array in (GL_VERTEX_ARRAY, GL_NORMAL_ARRAY):
        glEnableClientState(array)
    strip = make_knot()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)

        # First the image, then the floor over it, then the knot itself.
        glEnable(GL_STENCIL_TEST)
        mark_floor()
        draw_image(strip)
        glDisable(GL_STENCIL_TEST)
        glLightfv(GL_LIGHT0, GL_POSITION, LIGHT)
        draw_floor()
        draw_knot(strip)

        write(16, 64, "glFrontFace on" if front_face else "glFrontFace off")
        write(16, 40, "clip plane on" if clip_plane else "clip plane off")
        write(16, 16, "stencil test on" if stencil else "stencil test off")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
