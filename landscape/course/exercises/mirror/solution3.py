"""Mirror: a lighthouse in a pond

A lighthouse and a boat stand in a pond. The water is at the height LEVEL, half transparent, and
under it there is only the dark. Fill in draw_image, which draws what the water mirrors: everything
that draw_things draws, once more, upside down.

- The image is mirrored in the plane y = LEVEL.

- It has no part of what is under the water: the foot of the lighthouse and the keel are left out.

- Its front faces are the sides that look out of the things, as before. GL_CULL_FACE stays on, and
  culls the back faces.

- It is lit by the mirrored sun: what is bright in the thing is bright in its image. OpenGL
  multiplies the sun's position by the modelview matrix when set_sun is called.

After draw_image everything is as it was before, for all that is drawn later, the sun included.

Keys: Left and Right go round.
"""
# exercise: mirror

import math
import sys

import glfw
from OpenGL.GL import *

LEVEL = 0.5  # the height of the water
SUN = (-2, 2, 1.5, 0)
turn = 25  # degrees


def set_sun():
    glLightfv(GL_LIGHT0, GL_POSITION, SUN)


def draw_round(profile, sides, color, squeeze=1):
    """Draw a body of revolution: profile lists its radii and heights, from the bottom."""
    glColor3f(*color)
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        slope = math.hypot(r1 - r0, y1 - y0)
        glBegin(GL_QUAD_STRIP)
        for step in range(sides + 1):
            angle = 2 * math.pi * step / sides
            x = math.sin(angle)
            z = math.cos(angle)
            glNormal3f((y1 - y0) / slope * x, (r0 - r1) / slope, (y1 - y0) / slope * z / squeeze)
            glVertex3f(r1 * x, y1, r1 * z * squeeze)
            glVertex3f(r0 * x, y0, r0 * z * squeeze)
        glEnd()


def draw_things():
    for row in range(4):
        bottom = 0.7 - 0.07 * row
        top = 0.63 - 0.07 * row
        color = (0.95, 0.9, 0.8) if row % 2 else (0.85, 0.35, 0.2)
        draw_round(((bottom, 0.7 * row), (top, 0.7 * row + 0.7)), 24, color)
    draw_round(((0.42, 2.8), (0.55, 2.95), (0.55, 3.05), (0.28, 3.05)), 24, (0.45, 0.47, 0.5))
    draw_round(((0.26, 3.05), (0.26, 3.45)), 12, (1, 0.85, 0.45))
    draw_round(((0, 3.45), (0.4, 3.45), (0, 3.85)), 24, (0.25, 0.6, 0.6))
    glPushMatrix()
    glTranslatef(2.1, 0, 1)
    glRotatef(25, 0, 1, 0)
    draw_round(((0, 0.2), (0.35, 0.3), (0.8, 0.85), (0, 0.85)), 24, (0.55, 0.35, 0.22), 0.45)
    draw_round(((0.05, 0.85), (0.05, 2.2), (0, 2.2)), 8, (0.45, 0.47, 0.5))
    draw_round(((0, 1.05), (0.6, 1.05), (0, 2.1)), 24, (0.95, 0.9, 0.8), 0.15)
    glPopMatrix()


def draw_shore():
    """Draw the ground around the pond, in rings."""
    shore = ((4, 0.3), (4.1, LEVEL + 0.1), (4.6, LEVEL + 0.15), (9, LEVEL), (80, LEVEL))
    rings = [(radius, y) for radius, y in reversed(shore)]
    draw_round(rings, 48, (0.45, 0.55, 0.33))


def draw_water():
    glEnable(GL_BLEND)
    glColor4f(0.12, 0.34, 0.42, 0.45)
    glBegin(GL_TRIANGLE_FAN)
    glNormal3f(0, 1, 0)
    for step in range(48):
        angle = 2 * math.pi * step / 48
        glVertex3f(4.1 * math.sin(angle), LEVEL, 4.1 * math.cos(angle))
    glEnd()
    glDisable(GL_BLEND)


def draw_image():
    """Draw the things once more, as the water mirrors them."""
    x, y, z, w = SUN
    glLightfv(GL_LIGHT0, GL_POSITION, (x, -y, z, w))  # the sun's own image
    glClipPlane(GL_CLIP_PLANE0, (0, -1, 0, LEVEL))
    glEnable(GL_CLIP_PLANE0)
    glFrontFace(GL_CW)
    glPushMatrix()
    glTranslatef(0, LEVEL, 0)
    glScalef(1, -1, 1)
    glTranslatef(0, -LEVEL, 0)
    draw_things()
    glPopMatrix()
    glFrontFace(GL_CCW)
    glDisable(GL_CLIP_PLANE0)
    set_sun()


def on_key(window, key, scancode, action, mods):
    global turn
    if key in (glfw.KEY_LEFT, glfw.KEY_RIGHT) and action != glfw.RELEASE:
        turn += 15 if key == glfw.KEY_RIGHT else -15
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A lighthouse in a pond", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.19, 0.26, 0.37, 1)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    for capability in (
        GL_DEPTH_TEST,
        GL_CULL_FACE,
        GL_LIGHTING,
        GL_LIGHT0,
        GL_COLOR_MATERIAL,
        GL_NORMALIZE,
    ):
        glEnable(capability)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 100)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -1.1, -14)
        glRotatef(20, 1, 0, 0)
        glRotatef(turn, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        set_sun()
        draw_image()
        draw_shore()
        draw_water()
        draw_things()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
