"""The tetrahedron: a mesh as two tables

A mesh is a table of vertices and a table of faces; a face is a list of numbers of vertices. So each
vertex is stored once, although three faces meet in it. The numbers of a face are in
counter-clockwise order as seen from outside, and culling leaves out the faces that are turned away.
If one face lists its numbers in the opposite order, there is a hole.

Keys: Left and Right turn the body; Up and Down choose a face; Space reverses its order.
"""
# topic: meshes
# needs: orientation, polygon_modes
# picture: frame 0
# keys: LEFT RIGHT UP DOWN SPACE
# programs: mesh

import sys

import glfw
from OpenGL.GL import *
from text import _, write

VERTICES = ((-0.8, -0.55, 0.45), (0.8, -0.55, 0.45), (0, -0.55, -0.95), (0, 0.8, 0))
FACES = [[0, 1, 3], [1, 2, 3], [2, 0, 3], [0, 2, 1]]
COLORS = ((0.85, 0.35, 0.2), (0.95, 0.62, 0.35), (0.3, 0.65, 0.65), (0.4, 0.6, 0.9))
angle = 50  # degrees about the vertical axis
chosen = 0


def draw_faces():
    glBegin(GL_TRIANGLES)
    for number, face in enumerate(FACES):
        glColor3f(*COLORS[number])
        for vertex in face:
            glVertex3f(*VERTICES[vertex])
    glEnd()


def draw_edges(face):
    glColor3f(0.95, 0.9, 0.8)
    glBegin(GL_LINE_LOOP)
    for number in face:
        glVertex3f(*VERTICES[number])
    glEnd()


def draw():
    width, height = glfw.get_framebuffer_size(glfw.get_current_context())
    glViewport(0, 0, width, height)
    glClear(GL_COLOR_BUFFER_BIT)
    glLoadIdentity()
    glTranslatef(0.3, 0.1, 0)
    glScalef(0.85 * height / width, 0.85, -0.5)  # minus: z points to us, and depth away from us
    glRotatef(20, 1, 0, 0)
    glRotatef(angle, 0, 1, 0)
    glLineWidth(height / 160)
    glEnable(GL_CULL_FACE)  # no face hides another: each that is left is turned to us
    draw_faces()
    glDisable(GL_CULL_FACE)
    draw_edges(FACES[chosen])
    write_tables()


def write_tables():
    """Write the number of each vertex beside it, and the numbers of each face."""
    for number, vertex in enumerate(VERTICES):
        write(-5, -10, "{number}", at=[1.12 * part for part in vertex], number=number)
    for number, face in enumerate(FACES):
        row = " ".join(str(vertex) for vertex in face)
        write(36, 88 - 24 * number, "face {number}: {row}", COLORS[number], number=number, row=row)
    write(16, 88 - 24 * chosen, "»")


def on_key(window, key, scancode, action, mods):
    global angle, chosen
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        angle -= 10
    elif key == glfw.KEY_RIGHT:
        angle += 10
    elif key == glfw.KEY_UP:
        chosen = (chosen - 1) % len(FACES)
    elif key == glfw.KEY_DOWN:
        chosen = (chosen + 1) % len(FACES)
    elif key == glfw.KEY_SPACE:
        FACES[chosen].reverse()
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("The tetrahedron"), None, None)
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
