"""Shadow volume: shadows on everything, counted in the stencil buffer

A body keeps the light from a volume: its silhouette, drawn out away from the light. The stencil
buffer counts the front faces between the eye and each pixel, less the back faces: where the count
is above 0, the pixel is in shadow. Without back faces, all behind a volume is dark. With the eye in
a volume front faces are missing; the fix is to count what is behind the pixel: the faces that fail
the depth test.

Keys: V shows the volumes, B leaves out back faces, L puts the eye in the shadow, F counts failures.
"""
# topic: effects
# needs: orientation, depth_buffer, world_light, mirror
# picture: frame 40
# loop: 240 frames
# keys: V B L F

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LIGHTS = np.array(((-3, 7, 3), (-0.875, 1.4, -2)))  # the second one leaves the eye in shadow
CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
# The corners of each face of a cube, counter-clockwise seen from outside.
FACES = np.array(
    (
        (0, 1, 3, 2),
        (4, 6, 7, 5),
        (0, 4, 5, 1),
        (2, 3, 7, 6),
        (0, 2, 6, 4),
        (1, 5, 7, 3),
    )
)
TILTED = CUBE @ ((0.4, 0.4, -0.3), (-0.45, 0.45, 0), (0.26, 0.26, 0.52))
CORAL = (0.85, 0.35, 0.2, 1)
AMBER = (0.95, 0.65, 0.3, 1)
TEAL = (0.25, 0.6, 0.6, 1)
GREY = (0.5, 0.56, 0.63, 1)
GLASS = (1, 0.8, 0.3, 0.35)  # of the volumes, where they are shown

volumes = False  # the volumes are shown
back = True  # their back faces are counted
low = False  # the lamp is behind the cube
fail = False  # faces behind a pixel are counted, not those in front of it


def light():
    return LIGHTS[int(low)]


def place_bodies(time):
    """Return the bodies, each with its corners (8, 3) and its colour; the last is the floor."""
    sway = 0.4 * np.sin(np.pi / 2 * time)
    return (
        (TILTED + (sway - 0.9, 2.2, 0.3), CORAL),
        (CUBE * (0.4, 1, 0.4) + (1.5, 1, -0.6), AMBER),
        (CUBE * (1, 0.3, 0.7) + (0.2, 0.3, -1.6), TEAL),
        (CUBE * (4, 0.2, 3) - (0, 0.2, 0), GREY),
    )


def is_lit(points, face):
    """Return whether the front of a face is turned to the lamp."""
    return np.linalg.det(points[face[:3]] - light()) < 0


def make_volume(points):
    """Return the quads around what a body keeps from the light; points: its corners, (8, 3)."""
    # It begins a little inside the body: of two faces in one place, the depth test finds either.
    away = points - light()
    near = points + 0.001 * away
    far = points + 12 * away

    lit = [face for face in FACES if is_lit(points, face)]
    edges = set()
    for face in lit:
        for a, b in zip(face, np.roll(face, -1), strict=True):
            edges.add((a, b))

    # The silhouette: edges that lit faces have in one direction only.
    sides = [(near[a], far[a], far[b], near[b]) for a, b in edges if (b, a) not in edges]
    front_cap = [near[face] for face in lit]
    back_cap = [far[face[::-1]] for face in lit]
    return sides + front_cap + back_cap


def draw(quads, color):
    glColor4f(*color)
    glBegin(GL_QUADS)
    for quad in quads:
        glNormal3f(*np.cross(quad[1] - quad[0], quad[2] - quad[0]))
        for corner in quad:
            glVertex3f(*corner)
    glEnd()


def draw_bodies(bodies):
    for points, color in bodies:
        draw(points[FACES], color)


def count_volumes(quads):
    """Draw the volumes into the stencil buffer only: 0 is left where a pixel is in no volume."""
    for cap in (GL_STENCIL_TEST, GL_LIGHT0, GL_CULL_FACE):
        glEnable(cap)
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE)
    glDepthMask(GL_FALSE)

    # What adds comes first, so that no count falls below 0.
    if fail:
        count_faces(quads, culled=GL_FRONT, on_fail=GL_INCR, on_pass=GL_KEEP)
        count_faces(quads, culled=GL_BACK, on_fail=GL_DECR, on_pass=GL_KEEP)
    else:
        count_faces(quads, culled=GL_BACK, on_fail=GL_KEEP, on_pass=GL_INCR)
        count_faces(quads, culled=GL_FRONT, on_fail=GL_KEEP, on_pass=GL_DECR)

    glDisable(GL_CULL_FACE)
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE)


def count_faces(quads, culled, on_fail, on_pass):
    """Count the front or the back faces, those that are not culled, by the depth test's result."""
    glCullFace(culled)
    glStencilOp(GL_KEEP, on_fail, on_pass)
    if back or culled == GL_BACK:
        draw(quads, GLASS)


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 200)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, -0.9, -11)
    glRotatef(25, 1, 0, 0)


def on_key(window, key, scancode, action, mods):
    global volumes, back, low, fail
    if action != glfw.PRESS:
        return
    if key == glfw.KEY_V:
        volumes = not volumes
    elif key == glfw.KEY_B:
        back = not back
    elif key == glfw.KEY_L:
        low = not low
    elif key == glfw.KEY_F:
        fail = not fail
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Shadow volume"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    for cap in (GL_DEPTH_TEST, GL_LIGHTING, GL_COLOR_MATERIAL, GL_NORMALIZE, GL_BLEND):
        glEnable(cap)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glLightfv(GL_LIGHT0, GL_POSITION, (*light(), 1))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)
        *casters, floor = place_bodies(glfw.get_time())
        quads = [quad for points, _color in casters for quad in make_volume(points)]

        # Pass 1: everything as it is in shadow; this fills the depth buffer.
        glPushAttrib(GL_ALL_ATTRIB_BITS)
        draw_bodies((*casters, floor))

        # Pass 2: for each pixel, count the volumes that it is in.
        count_volumes(quads)

        # Pass 3: everything in the light, where the pixel is in no volume.
        glStencilFunc(GL_EQUAL, 0, 255)
        glDepthFunc(GL_EQUAL)
        draw_bodies((*casters, floor))
        glPopAttrib()

        if volumes:
            draw(quads, GLASS)
        write(16, 40, "back faces counted" if back else "back faces left out", (0, 0, 0))
        write(16, 16, "depth test failed" if fail else "depth test passed", (0, 0, 0))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
