"""Clip plane: a planet cut open

A clip plane (a, b, c, d) keeps the points with a x + b y + c z + d >= 0 and cuts the rest away.
glClipPlane takes the plane in the frame of the modelview matrix at the time of the call, and
stores it in eye coordinates. Called after the viewing transform, the cut stays in the planet.
Called before it, the plane belongs to the eye, and the planet turns through the cut.

Keys: Left and Right turn the plane, Up and Down move it; Space calls glClipPlane before that.
"""
# topic: landscape
# needs: frames, normals, light_model, display_list
# picture: frame 80
# loop: 360 frames
# keys: LEFT RIGHT UP DOWN SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

# Radius and colour of each shell, from the crust to the core.
SHELLS = (
    (1, (0.3, 0.5, 0.8)),
    (0.94, (0.6, 0.25, 0.2)),
    (0.72, (0.85, 0.35, 0.2)),
    (0.48, (0.95, 0.62, 0.35)),
    (0.24, (1, 0.95, 0.8)),
)
# The plane: degrees around the y axis, and its distance from the centre.
angle = 180
distance = 0
before_camera = False


def make_planet():
    """Compile the planet, shell in shell, each of slices in two shades, into a display list."""
    planet = glGenLists(1)
    glNewList(planet, GL_COMPILE)
    for radius, color in SHELLS:
        for column in range(64):
            shade = 1 if column // 4 % 2 else 0.87
            glColor3f(*(shade * channel for channel in color))
            draw_slice(radius, column)
    glEndList()
    return planet


def draw_slice(radius, column):
    """Draw one of 64 slices of a sphere, from pole to pole."""
    glBegin(GL_QUAD_STRIP)
    for row in range(33):
        y = math.cos(row * math.pi / 32)
        ring = math.sin(row * math.pi / 32)
        for turn in ((column + 1) * math.pi / 32, column * math.pi / 32):
            normal = ring * math.sin(turn), y, ring * math.cos(turn)
            glNormal3f(*normal)
            glVertex3f(*(radius * part for part in normal))
    glEnd()


def cut():
    """Give the plane to OpenGL, and draw a square in it."""
    a = math.sin(math.radians(angle))
    c = math.cos(math.radians(angle))
    glClipPlane(GL_CLIP_PLANE0, (a, 0, c, distance))
    glDisable(GL_LIGHTING)
    glColor3f(0.6, 0.62, 0.65)
    glBegin(GL_LINE_LOOP)
    for u, y in ((-1.1, -1.1), (1.1, -1.1), (1.1, 1.1), (-1.1, 1.1)):
        glVertex3f(u * c - distance * a, y, -u * a - distance * c)
    glEnd()
    glEnable(GL_LIGHTING)
    write(16, 16, "{a:+.2f} x {b:+.2f} y {c:+.2f} z {d:+.2f} >= 0", a=a, b=0, c=c, d=distance)


def look(width, height):
    glViewport(0, 0, width, height)
    glLineWidth(height / 320)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 5, width / height / 5, -0.2, 0.2, 1, 10)


def on_key(window, key, scancode, action, mods):
    global angle, distance, before_camera
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        angle -= 10
    elif key == glfw.KEY_RIGHT:
        angle += 10
    elif key == glfw.KEY_DOWN:
        distance -= 0.1
    elif key == glfw.KEY_UP:
        distance += 0.1
    elif key == glfw.KEY_SPACE:
        before_camera = not before_camera
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Clip plane"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL):
        glEnable(capability)
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE)  # the shells are lit from inside, too
    planet = make_planet()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glLightfv(GL_LIGHT0, GL_POSITION, (-0.4, 0.5, 1, 0))
        glTranslatef(0, 0.25, -7.8)
        if before_camera:
            cut()
        glRotatef(20, 1, 0, 0)
        glRotatef(45 * math.sin(math.pi / 3 * glfw.get_time()), 0, 1, 0)
        if not before_camera:
            cut()
        glEnable(GL_CLIP_PLANE0)
        glCallList(planet)
        glDisable(GL_CLIP_PLANE0)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
