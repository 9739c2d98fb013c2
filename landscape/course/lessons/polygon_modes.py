"""Polygon modes: faces filled, as lines, or as points

glPolygonMode says how polygons are drawn, for front and back faces apart. The vase is open at the
top, so its inside, which is made of back faces, can be seen. Its outside is filled and its inside
drawn as lines; any pair is possible. With both sides as lines, we see the mesh through and through:
all of its polygons, and how few of them make a round body.

Keys: F changes the mode of the front faces, B that of the back faces; Up and Down tilt the vase.
"""
# topic: meshes
# needs: orientation, transform_order
# picture: frame 0
# keys: F B UP DOWN

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

MODES = (GL_FILL, GL_LINE, GL_POINT)
NAMES = ("GL_FILL", "GL_LINE", "GL_POINT")
SECTORS = 20
PROFILE = (  # radius, height and colour of each ring
    *((0, -0.8, (0.55, 0.2, 0.15)), (0.3, -0.8, (0.6, 0.22, 0.15))),
    *((0.44, -0.62, (0.7, 0.28, 0.17)), (0.58, -0.4, (0.78, 0.31, 0.18))),
    *((0.65, -0.1, (0.85, 0.35, 0.2)), (0.6, 0.18, (0.9, 0.47, 0.27))),
    *((0.46, 0.42, (0.95, 0.62, 0.35)), (0.38, 0.58, (0.95, 0.72, 0.5))),
    *((0.42, 0.7, (0.95, 0.82, 0.65)), (0.54, 0.8, (0.95, 0.9, 0.8))),
)
front = 0
back = 1
tilt = 30  # degrees


def draw_vase():
    """Draw a strip of quads between each ring and the next: their order makes the outside front."""
    for ring in range(len(PROFILE) - 1):
        lower, upper = PROFILE[ring : ring + 2]
        glBegin(GL_QUAD_STRIP)
        for sector in range(SECTORS + 1):
            angle = 2 * math.pi * sector / SECTORS
            for radius, height, color in (upper, lower):
                shade = 0.8 + 0.2 * math.cos(angle + 1)
                glColor3f(*(shade * channel for channel in color))
                glVertex3f(radius * math.sin(angle), height, radius * math.cos(angle))
        glEnd()


def draw():
    width, height = glfw.get_framebuffer_size(glfw.get_current_context())
    glViewport(0, 0, width, height)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glLoadIdentity()
    glTranslatef(0.15, 0, 0)
    glScalef(height / width, 1, -0.5)  # minus: z points to us, and depth away from us
    glRotatef(tilt, 1, 0, 0)
    glEnable(GL_DEPTH_TEST)  # the nearest face is seen, in whatever order they are drawn
    glPointSize(height / 120)
    glLineWidth(height / 400)
    glPolygonMode(GL_FRONT, MODES[front])
    glPolygonMode(GL_BACK, MODES[back])
    draw_vase()
    write(16, 40, "front: {mode}", mode=NAMES[front])
    write(16, 16, "back: {mode}", mode=NAMES[back])


def on_key(window, key, scancode, action, mods):
    global front, back, tilt
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_F:
        front = (front + 1) % 3
    elif key == glfw.KEY_B:
        back = (back + 1) % 3
    elif key == glfw.KEY_DOWN:
        tilt -= 5
    elif key == glfw.KEY_UP:
        tilt += 5
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Polygon modes"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        draw()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
