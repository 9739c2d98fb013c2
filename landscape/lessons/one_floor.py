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

import glfw
from OpenGL.GL import *
from text import _, write

KEYS = glfw.KEY_R, glfw.KEY_S, glfw.KEY_D, glfw.KEY_U
on = [True, True, True, False]
angle, height = 2.3, 6.0  # of the light: radians around the dinosaur, and units above the floor
last, dragging = (0.0, 0.0), False
ALL, WIDE = 0xFFFFFFFF, 7  # WIDE: half the side of the floor
SKIN = (0.42, 0.62, 0.25)
BELLY = (0.75, 0.72, 0.42)
LEGS = (0.34, 0.5, 0.22)
PARTS = [((0, 1.8, 0), (1.35, 0.85, 0.75), SKIN), ((-0.05, 1.55, 0), (1.15, 0.7, 0.66), BELLY)]
PARTS += [((x, 0.65, z), (0.28, 0.66, 0.24), LEGS) for x in (-0.7, 0.75) for z in (-0.4, 0.4)]
for n in range(9):  # a neck that rises to the right, and a tail that sinks to the left
    t = n / 8
    PARTS.append(((1.1 + 1.1 * t, 2.2 + 1.9 * t, 0), (0.42 - 0.2 * t, 0.5 - 0.2 * t, 0.3), SKIN))
    PARTS.append(
        ((-1.1 - 2.4 * t, 1.9 - 1.1 * t * t, 0), (0.55 - 0.4 * t, 0.44 - 0.38 * t, 0.3), SKIN)
    )
PARTS += [((2.5, 4.25, 0), (0.48, 0.27, 0.25), SKIN), ((2.86, 4.15, 0), (0.25, 0.16, 0.19), BELLY)]
PARTS += [((2.5, 4.42, z), (0.07, 0.07, 0.05), (0.05, 0.05, 0.05)) for z in (-0.2, 0.2)]


def make_ball():
    circle = [(math.cos(n * math.pi / 12), math.sin(n * math.pi / 12)) for n in range(25)]
    glNewList(ball := glGenLists(1), GL_COMPILE)
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
    glNormal3f(0, 1, 0)
    glBegin(GL_QUADS)
    for x in range(-WIDE, WIDE):
        for z in range(-WIDE, WIDE):
            light = 0.75 if (x + z) % 2 else 0.45
            glColor4f(*color or (light, light, 0.9 * light), alpha)
            for corner in ((x, 0, z), (x, 0, z + 1), (x + 1, 0, z + 1), (x + 1, 0, z)):
                glVertex3f(*corner)
    glEnd()


def draw_mirrored(ball, light):
    """Mark the floor with 1, and draw the mirrored dinosaur there."""
    glPushAttrib(GL_ALL_ATTRIB_BITS)
    glDisable(GL_DEPTH_TEST)
    glColorMask(False, False, False, False)
    glStencilFunc(GL_ALWAYS, 1, ALL)
    glStencilOp(GL_REPLACE, GL_REPLACE, GL_REPLACE)
    draw_floor()
    glPopAttrib()
    glPushAttrib(GL_ALL_ATTRIB_BITS)
    glStencilFunc(GL_EQUAL, 1, ALL)
    glPushMatrix()
    glScalef(1, -1, 1)
    glLightfv(GL_LIGHT0, GL_POSITION, light)  # mirrored, too
    glFrontFace(GL_CW)
    draw(ball, PARTS)
    glPopMatrix()
    glPopAttrib()


def draw_shadow(ball, light):
    """Flatten the dinosaur onto y = 0, by (p.l) I - l p^T with p = (0, 1, 0, 0)."""
    x, y, z, w = light
    glPushAttrib(GL_ALL_ATTRIB_BITS)
    glStencilFunc(GL_LESS, 2, ALL)  # passes where 2 < what is there
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)
    glDisable(GL_LIGHTING)
    glEnable(GL_POLYGON_OFFSET_FILL)
    glColor4f(0, 0, 0, 0.5)
    glPushMatrix()
    glMultTransposeMatrixf([[y, -x, 0, 0], [0, 0, 0, 0], [0, -z, y, 0], [0, -w, 0, y]])
    draw(ball, PARTS, shadow=True)
    glPopMatrix()
    glPopAttrib()


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
    if action == glfw.PRESS:
        on[:] = [on[n] ^ (key == KEYS[n]) for n in range(len(KEYS))]
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Mirror and shadow"), None, None)
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
        reflection, shadow, depth, under = on
        width, height_in_pixels = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height_in_pixels)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height_in_pixels / 4, width / height_in_pixels / 4, -0.25, 0.25, 1, 60)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, 1.0 if under else -0.6, -18)
        glRotatef(-18 if under else 20, 1, 0, 0)
        glRotatef(30 * math.sin(math.pi / 6 * glfw.get_time()), 0, 1, 0)
        (glEnable if depth else glDisable)(GL_DEPTH_TEST)
        buffers = GL_COLOR_BUFFER_BIT | (GL_DEPTH_BUFFER_BIT if depth else 0)
        glClear(buffers | GL_STENCIL_BUFFER_BIT)
        light = 5 * math.cos(angle), height, 5 * math.sin(angle), 1
        glLightfv(GL_LIGHT0, GL_POSITION, light)
        if reflection and not under:
            draw_mirrored(ball, light)
        glStencilFunc(GL_ALWAYS, 3, ALL)
        glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)
        glFrontFace(GL_CW)  # the underside
        draw_floor(1, (0.1, 0.1, 0.7))
        glFrontFace(GL_CCW)
        draw_floor(0.7 if reflection else 1)
        glStencilFunc(GL_ALWAYS, 0, ALL)
        draw(ball, PARTS)  # it takes its own pixels from the floor
        if shadow:
            draw_shadow(ball, light)
        glDisable(GL_LIGHTING)
        draw(ball, [(light[:3], (0.2, 0.2, 0.2), (1, 0.9, 0.3))])
        glEnable(GL_LIGHTING)
        write(16, 88, "reflection on" if reflection else "reflection off")
        write(16, 64, "shadow on" if shadow else "shadow off")
        write(16, 40, "depth test on" if depth else "depth test off")
        write(16, 16, "drag the mouse: the light")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
