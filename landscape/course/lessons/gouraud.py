"""Flat shading and Gouraud shading: the highlight that gets lost

GL_FLAT gives a face the colour of one vertex; GL_SMOOTH, Gouraud's way, interpolates the colours of
its vertices. The light is computed at vertices only, so a highlight appears where a vertex happens
to be. Turned by half a segment, no vertex is at its middle; on a coarse mesh it is nearly gone.

Keys: Left and Right change the number of segments; Space turns the balls by half a segment.
"""
# topic: light
# needs: normals
# picture: frame 0
# keys: LEFT RIGHT SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

segments = 12
half = False


def draw_ball():
    """Draw a ball of segments by segments quads around the y axis."""
    for row in range(segments):
        glBegin(GL_QUAD_STRIP)
        for column in range(segments + 1):
            longitude = column * math.tau / segments
            for latitude in (row * math.pi / segments, (row + 1) * math.pi / segments):
                radius = math.sin(latitude)
                x = radius * math.sin(longitude)
                z = radius * math.cos(longitude)
                glNormal3f(x, math.cos(latitude), z)
                glVertex3f(x, math.cos(latitude), z)
        glEnd()


def place_light():
    """Place the light so that the highlight's middle is 30° to the left and 15° up, at a vertex."""
    longitude = math.radians(-30)
    latitude = math.radians(15)
    radius = math.cos(latitude)
    x = radius * math.sin(longitude)
    y = math.sin(latitude)
    z = radius * math.cos(longitude)
    # The direction to the light is the direction to the viewer, mirrored at the normal (x, y, z).
    glLightfv(GL_LIGHT0, GL_POSITION, (2 * z * x, 2 * z * y, 2 * z * z - 1, 0))


def set_material():
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (0.75, 0.31, 0.18, 1))
    glMaterialfv(GL_FRONT, GL_SPECULAR, (0.9, 0.9, 0.9, 1))
    glMaterialf(GL_FRONT, GL_SHININESS, 60)


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-1.7 * width / height, 1.7 * width / height, -1.7, 1.7, -2, 2)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def draw_shaded(model, x):
    """Draw a ball at x in a shading model, and its name below it."""
    glShadeModel(model)
    glLoadIdentity()
    glTranslatef(x, 0.15, 0)
    if half:
        glRotatef(180 / segments, 0, 1, 0)
    draw_ball()
    write(-40, -24, "GL_FLAT" if model == GL_FLAT else "GL_SMOOTH", at=(0, -1.05, 0))


def on_key(window, key, scancode, action, mods):
    global half, segments
    if key == glfw.KEY_LEFT and action != glfw.RELEASE:
        segments = max(6, segments // 2)
    if key == glfw.KEY_RIGHT and action != glfw.RELEASE:
        segments = min(48, segments * 2)
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        half = not half
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Gouraud shading"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0):
        glEnable(capability)
    set_material()
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        place_light()
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_shaded(GL_FLAT, -1.1)
        draw_shaded(GL_SMOOTH, 1.1)
        write(16, 40, "{segments} segments", segments=segments)
        write(16, 16, "turned by half a segment" if half else "not turned")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
