"""Mirror and shadow: a dinosaur, its image and its shadow on one floor

The floor marks its pixels with 1 in the stencil buffer, and the mirrored dinosaur is drawn there.
The floor blended over it marks them with 3. The dinosaur flattened onto it darkens each pixel that
is above 2, and leaves 2 there: no pixel is darkened twice, and nothing beside the floor. Drag the
mouse to move the light: it goes around, up and down. From below, the floor has another colour.

Keys: R reflection, S shadow, D depth test, U under the floor.
"""
# topic: effects
# needs: stencil_mirror, planar_shadow, mouse
# picture: frame 30
# loop: 360 frames
# keys: R S D U

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

SKIN = (0.42, 0.62, 0.25)
BELLY = (0.75, 0.72, 0.42)
LEGS = (0.34, 0.5, 0.22)
EYES = (0.05, 0.05, 0.05)
WIDE = 7  # half the side of the floor
ALL = 0xFFFFFFFF  # bits of the stencil buffer

reflection = True
shadow = True
depth = True
under = False

# The light: radians around the dinosaur, and units above the floor.
angle = 2.3
height = 6.0
last = 0.0, 0.0  # where the mouse was
dragging = False


def make_dinosaur():
    """Return the place, size and colour of each sphere that the dinosaur is made of."""
    parts = [
        ((0, 1.8, 0), (1.35, 0.85, 0.75), SKIN),
        ((-0.05, 1.55, 0), (1.15, 0.7, 0.66), BELLY),
    ]
    for x in (-0.7, 0.75):
        for z in (-0.4, 0.4):
            parts.append(((x, 0.65, z), (0.28, 0.66, 0.24), LEGS))

    # A neck that rises to the right, and a tail that sinks to the left, both ever thinner.
    for n in range(9):
        t = n / 8
        neck = (1.1 + 1.1 * t, 2.2 + 1.9 * t, 0)
        tail = (-1.1 - 2.4 * t, 1.9 - 1.1 * t * t, 0)
        parts.append((neck, (0.42 - 0.2 * t, 0.5 - 0.2 * t, 0.3), SKIN))
        parts.append((tail, (0.55 - 0.4 * t, 0.44 - 0.38 * t, 0.3), SKIN))

    parts.append(((2.5, 4.25, 0), (0.48, 0.27, 0.25), SKIN))  # head
    parts.append(((2.86, 4.15, 0), (0.25, 0.16, 0.19), BELLY))  # muzzle
    for z in (-0.2, 0.2):
        parts.append(((2.5, 4.42, z), (0.07, 0.07, 0.05), EYES))
    return parts


PARTS = make_dinosaur()


def make_ball():
    """Return a display list of a sphere of radius 1, in 12 rings."""
    circle = [(math.cos(n * math.pi / 12), math.sin(n * math.pi / 12)) for n in range(25)]
    ball = glGenLists(1)
    glNewList(ball, GL_COMPILE)
    for row in range(12):
        glBegin(GL_QUAD_STRIP)
        for x, z in circle:
            for y, radius in circle[row : row + 2]:
                glNormal3f(radius * x, y, -radius * z)
                glVertex3f(radius * x, y, -radius * z)
        glEnd()
    glEndList()
    return ball


def draw(ball, parts, shadow=False):
    for place, size, color in parts:
        if not shadow:  # a shadow keeps the current colour
            glColor3f(*color)
        glPushMatrix()
        glTranslatef(*place)
        glScalef(*size)
        glCallList(ball)
        glPopMatrix()


def draw_floor(alpha=1.0, color=None):
    """Draw the floor in a colour, or as a chessboard."""
    glNormal3f(0, 1, 0)
    glBegin(GL_QUADS)
    for x in range(-WIDE, WIDE):
        for z in range(-WIDE, WIDE):
            light = 0.75 if (x + z) % 2 else 0.45
            glColor4f(*color or (light, light, 0.9 * light), alpha)
            for corner in ((x, 0, z), (x, 0, z + 1), (x + 1, 0, z + 1), (x + 1, 0, z)):
                glVertex3f(*corner)
    glEnd()


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 60)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, 1.0 if under else -0.6, -18)
    glRotatef(-18 if under else 20, 1, 0, 0)
    glRotatef(30 * math.sin(math.pi / 6 * glfw.get_time()), 0, 1, 0)


def clear():
    if depth:
        glEnable(GL_DEPTH_TEST)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)
    else:
        glDisable(GL_DEPTH_TEST)
        glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)


def mark_floor():
    """Set the stencil buffer to 1 where the floor is, and draw nothing."""
    glPushAttrib(GL_ALL_ATTRIB_BITS)
    glDisable(GL_DEPTH_TEST)
    glColorMask(False, False, False, False)
    glStencilFunc(GL_ALWAYS, 1, ALL)
    glStencilOp(GL_REPLACE, GL_REPLACE, GL_REPLACE)
    draw_floor()
    glPopAttrib()


def draw_mirrored(ball, light):
    """Draw the mirrored dinosaur where the stencil buffer is 1."""
    glPushAttrib(GL_ALL_ATTRIB_BITS)
    glStencilFunc(GL_EQUAL, 1, ALL)
    glPushMatrix()
    glScalef(1, -1, 1)
    glLightfv(GL_LIGHT0, GL_POSITION, light)  # mirrored, too
    glFrontFace(GL_CW)
    draw(ball, PARTS)
    glPopMatrix()
    glPopAttrib()


def draw_both_floors():
    """Draw the floor's underside, and its upper side over the image; it leaves 3 where it is."""
    glStencilFunc(GL_ALWAYS, 3, ALL)
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)
    glFrontFace(GL_CW)
    draw_floor(1, (0.1, 0.1, 0.7))
    glFrontFace(GL_CCW)
    draw_floor(0.7 if reflection else 1)


def draw_dinosaur(ball):
    """Draw the dinosaur; it takes its own pixels from the floor."""
    glStencilFunc(GL_ALWAYS, 0, ALL)
    draw(ball, PARTS)


def draw_shadow(ball, light):
    """Flatten the dinosaur onto y = 0, by (p.l) I - l p^T with p = (0, 1, 0, 0)."""
    x, y, z, w = light
    matrix = (
        (y, -x, 0, 0),
        (0, 0, 0, 0),
        (0, -z, y, 0),
        (0, -w, 0, y),
    )
    glPushAttrib(GL_ALL_ATTRIB_BITS)
    glStencilFunc(GL_LESS, 2, ALL)  # passes where 2 < what is there
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)
    glDisable(GL_LIGHTING)
    glEnable(GL_POLYGON_OFFSET_FILL)
    glColor4f(0, 0, 0, 0.5)
    glPushMatrix()
    glMultTransposeMatrixf(matrix)
    draw(ball, PARTS, shadow=True)
    glPopMatrix()
    glPopAttrib()


def draw_lamp(ball, light):
    glDisable(GL_LIGHTING)
    draw(ball, [(light[:3], (0.2, 0.2, 0.2), (1, 0.9, 0.3))])
    glEnable(GL_LIGHTING)


def on_button(window, button, action, mods):
    global dragging
    dragging = button == glfw.MOUSE_BUTTON_LEFT and action == glfw.PRESS


def on_move(window, x, y):
    global angle, height, last
    if dragging:
        angle -= 0.01 * (x - last[0])
        height = max(4.8, min(height - 0.03 * (y - last[1]), 12))  # above the dinosaur's head
    last = x, y


def on_key(window, key, scancode, action, mods):
    global reflection, shadow, depth, under
    if action != glfw.PRESS:
        return
    if key == glfw.KEY_R:
        reflection = not reflection
    elif key == glfw.KEY_S:
        shadow = not shadow
    elif key == glfw.KEY_D:
        depth = not depth
    elif key == glfw.KEY_U:
        under = not under
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Mirror and shadow"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glfw.set_mouse_button_callback(window, on_button)
    glfw.set_cursor_pos_callback(window, on_move)
    glClearColor(0.13, 0.16, 0.21, 1)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glPolygonOffset(-2, -1)
    for cap in (GL_CULL_FACE, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL, GL_BLEND, GL_NORMALIZE):
        glEnable(cap)
    glEnable(GL_STENCIL_TEST)
    ball = make_ball()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        clear()
        light = 5 * math.cos(angle), height, 5 * math.sin(angle), 1
        glLightfv(GL_LIGHT0, GL_POSITION, light)

        # The image first: everything else is drawn over it.
        if reflection and not under:
            mark_floor()
            draw_mirrored(ball, light)
        draw_both_floors()
        draw_dinosaur(ball)
        if shadow:
            draw_shadow(ball, light)
        draw_lamp(ball, light)

        write(16, 88, "reflection on" if reflection else "reflection off")
        write(16, 64, "shadow on" if shadow else "shadow off")
        write(16, 40, "depth test on" if depth else "depth test off")
        write(16, 16, "drag the mouse: the light")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
