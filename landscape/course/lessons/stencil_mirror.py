"""A mirror and its light: a duck on a polished disc

The disc marks its pixels in the stencil buffer; there all is drawn once more, mirrored, and the
disc is blended over it. Without glFrontFace, the image shows its far sides; without the light's
position set again, it is lit from the wrong side; without GL_NORMALIZE, the normals of spheres
under glScalef have the wrong length, and too much or too little light falls on them.

Keys: S, F, L and N leave out the four, for the image only: stencil, glFrontFace, light, normals.
"""
# topic: effects
# needs: mirror, world_light, scale, normals
# picture: frame 20
# loop: 360 frames
# keys: S F L N

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

LAMP = (1.2, 1.9, 2, 1)
AMBER = (0.95, 0.6, 0.12, 1)
CORAL = (0.9, 0.28, 0.13, 1)
BLACK = (0.05, 0.05, 0.07, 1)
BRIGHT = (5, 5, 4, 1)  # so bright that no side of it is dark
DUCK = (  # place, size and colour of each sphere
    ((0, 0.75, 0), (1.25, 0.75, 0.85), AMBER),  # body
    ((0.85, 1.8, 0), (0.6, 0.6, 0.58), AMBER),  # head
    ((1.5, 1.7, 0), (0.34, 0.1, 0.26), CORAL),  # bill
    ((-0.25, 0.95, -0.7), (0.7, 0.38, 0.22), AMBER),  # wings
    ((-0.25, 0.95, 0.7), (0.7, 0.38, 0.22), AMBER),
    ((1.26, 2, -0.33), (0.1, 0.1, 0.1), BLACK),  # eyes
    ((1.26, 2, 0.33), (0.1, 0.1, 0.1), BLACK),
)
BULB = ((LAMP[:3], (0.14, 0.14, 0.14), BRIGHT),)
DISC = (((0, 0, 0), (3, 0.0001, 3), (0.2, 0.5, 0.58, 0.4)),)  # a sphere, pressed flat

stencil = True
front_face = True
light = True
normalize = True


def make_ball():
    """Return a display list of a sphere of radius 1, in 24 rings."""
    circle = [(math.cos(n * math.pi / 24), math.sin(n * math.pi / 24)) for n in range(49)]
    ball = glGenLists(1)
    glNewList(ball, GL_COMPILE)
    for row in range(24):
        glBegin(GL_QUAD_STRIP)
        for x, z in circle:
            for y, radius in circle[row : row + 2]:
                glNormal3f(radius * x, y, -radius * z)
                glVertex3f(radius * x, y, -radius * z)
        glEnd()
    glEndList()
    return ball


def draw(ball, parts):
    for place, size, color in parts:
        glColor4f(*color)
        glPushMatrix()
        glTranslatef(*place)
        glScalef(*size)
        glCallList(ball)
        glPopMatrix()


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 30)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, -0.15, -10.2)
    glRotatef(27, 1, 0, 0)
    glRotatef(60 * glfw.get_time() - 60, 0, 1, 0)


def mark_disc(ball):
    """Set the stencil buffer to 1 where the disc is, and draw nothing."""
    glEnable(GL_STENCIL_TEST)
    glStencilFunc(GL_NEVER, 1, 1)  # always fails, and so replaces
    glStencilOp(GL_REPLACE, GL_KEEP, GL_KEEP)
    draw(ball, DISC)


def draw_image(ball):
    """Draw the scene mirrored at the disc, where the stencil buffer is 1."""
    glStencilFunc(GL_EQUAL if stencil else GL_ALWAYS, 1, 1)
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP)
    glScalef(1, -1, 1)
    if light:
        glLightfv(GL_LIGHT0, GL_POSITION, LAMP)  # under the mirrored matrix
    glFrontFace(GL_CW if front_face else GL_CCW)
    if normalize:
        glEnable(GL_NORMALIZE)
    else:
        glDisable(GL_NORMALIZE)
    draw(ball, DUCK + BULB)
    glScalef(1, -1, 1)  # mirrored twice is not mirrored


def on_key(window, key, scancode, action, mods):
    global stencil, front_face, light, normalize
    if action != glfw.PRESS:
        return
    if key == glfw.KEY_S:
        stencil = not stencil
    elif key == glfw.KEY_F:
        front_face = not front_face
    elif key == glfw.KEY_L:
        light = not light
    elif key == glfw.KEY_N:
        normalize = not normalize
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("A mirror and its light"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    for cap in (GL_DEPTH_TEST, GL_CULL_FACE, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL, GL_BLEND):
        glEnable(cap)
    glEnable(GL_NORMALIZE)
    ball = make_ball()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)
        glLightfv(GL_LIGHT0, GL_POSITION, LAMP)

        glPushAttrib(GL_ALL_ATTRIB_BITS)
        mark_disc(ball)
        draw_image(ball)
        glPopAttrib()  # all is as before, the light's position, too

        # The disc is blended over the image; then comes the scene itself.
        draw(ball, DISC + DUCK + BULB)

        write(16, 88, "stencil test on" if stencil else "stencil test off")
        write(16, 64, "glFrontFace on" if front_face else "glFrontFace off")
        write(16, 40, "light mirrored" if light else "light not mirrored")
        write(16, 16, "GL_NORMALIZE on" if normalize else "GL_NORMALIZE off")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
