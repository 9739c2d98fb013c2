"""Shadow volume: shadows on everything, counted in the stencil buffer

A body keeps the light from a volume: its silhouette, drawn out away from the light. The stencil
buffer counts the front faces between the eye and each pixel, less the back faces; what is left is
in shadow. Without back faces, all behind a volume is dark. With the eye in a volume front faces are
missing; then one counts what is behind the pixel: the faces that fail the depth test.

Keys: V shows the volumes, B leaves out back faces, L puts the eye in the shadow, F counts failures.
"""
# topic: effects
# needs: orientation, depth_buffer, world_light, mirror
# picture: frame 40
# loop: 240 frames
# keys: V B L F

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LIGHTS = np.array(((-3, 7, 3), (-0.875, 1.4, -2)))  # the second one leaves the eye in shadow
CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
FACES = np.array([[*map(int, face)] for face in ("0132", "4675", "0451", "2376", "0264", "1573")])
TILTED = CUBE @ ((0.4, 0.4, -0.3), (-0.45, 0.45, 0), (0.26, 0.26, 0.52))
COLORS = (0.85, 0.35, 0.2, 1), (0.95, 0.65, 0.3, 1), (0.25, 0.6, 0.6, 1), (0.5, 0.56, 0.63, 1)
volumes = False
back = True
low = 0
fail = False


def make_volume(points):
    """Return the quads around what a body keeps from the light; points: its corners, (8, 3)."""
    # It begins a little inside the body: of two faces in one place, the depth test finds either.
    near, far = (points + k * (points - LIGHTS[low]) for k in (0.001, 12))
    lit = [face for face in FACES if np.linalg.det(points[face[:3]] - LIGHTS[low]) < 0]
    edges = {(a, b) for face in lit for a, b in zip(face, np.roll(face, -1), strict=True)}
    sides = [(near[a], far[a], far[b], near[b]) for a, b in edges if (b, a) not in edges]
    return sides + [near[face] for face in lit] + [far[face[::-1]] for face in lit]


def draw(quads, color=(1, 0.8, 0.3, 0.35)):
    glColor4f(*color)
    glBegin(GL_QUADS)
    for quad in quads:
        glNormal3f(*np.cross(quad[1] - quad[0], quad[2] - quad[0]))
        for corner in quad:
            glVertex3f(*corner)
    glEnd()


def count(quads):
    """Count the faces of volumes in the stencil buffer; let only pixels be drawn that are lit."""
    for cap in (GL_STENCIL_TEST, GL_LIGHT0, GL_CULL_FACE):
        glEnable(cap)
    glColorMask(0, 0, 0, 0)
    glDepthMask(0)
    sides = (GL_FRONT, GL_BACK) if fail else (GL_BACK, GL_FRONT)  # to be culled
    for side, step in zip(sides, (GL_INCR, GL_DECR), strict=True):  # no count falls below 0
        glCullFace(side)
        glStencilOp(GL_KEEP, *((step, GL_KEEP) if fail else (GL_KEEP, step)))
        if back or side == GL_BACK:
            draw(quads)
    glDisable(GL_CULL_FACE)
    glColorMask(1, 1, 1, 1)
    glStencilFunc(GL_EQUAL, 0, 255)
    glDepthFunc(GL_EQUAL)


def on_key(window, key, scancode, action, mods):
    global volumes, back, low, fail
    if action == glfw.PRESS:
        volumes, back = volumes ^ (key == glfw.KEY_V), back ^ (key == glfw.KEY_B)
        low, fail = low ^ (key == glfw.KEY_L), fail ^ (key == glfw.KEY_F)
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Shadow volume"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    for cap in (GL_DEPTH_TEST, GL_LIGHTING, GL_COLOR_MATERIAL, GL_NORMALIZE, GL_BLEND):
        glEnable(cap)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 200)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -0.9, -11)
        glRotatef(25, 1, 0, 0)
        glLightfv(GL_LIGHT0, GL_POSITION, (*LIGHTS[low], 1))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)
        bodies = (
            TILTED + (0.4 * np.sin(np.pi / 2 * glfw.get_time()) - 0.9, 2.2, 0.3),
            CUBE * (0.4, 1, 0.4) + (1.5, 1, -0.6),
            CUBE * (1, 0.3, 0.7) + (0.2, 0.3, -1.6),
            CUBE * (4, 0.2, 3) - (0, 0.2, 0),
        )
        quads = [quad for points in bodies[:-1] for quad in make_volume(points)]
        glPushAttrib(GL_ALL_ATTRIB_BITS)
        for light in (False, True):  # first as it is in shadow
            if light:
                count(quads)
            for points, color in zip(bodies, COLORS, strict=True):
                draw(points[FACES], color)
        glPopAttrib()
        if volumes:
            draw(quads)
        write(16, 40, "back faces counted" if back else "back faces left out", (0, 0, 0))
        write(16, 16, "depth test failed" if fail else "depth test passed", (0, 0, 0))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
