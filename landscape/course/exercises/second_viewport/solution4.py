"""gluLookAt from above, and the maze in a display list."""
# exercise: second_viewport
# the rest: start.py

from OpenGL.GLU import *


def draw_map(width, height, maze):
    """Draw the map in its corner, in a window of width x height pixels."""
    side = height // 3
    glPushAttrib(GL_ALL_ATTRIB_BITS)
    glViewport(16, 16, side, side)
    glScissor(16, 16, side, side)
    glEnable(GL_SCISSOR_TEST)
    glClearColor(*PAPER)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    for mode in (GL_PROJECTION, GL_MODELVIEW):
        glMatrixMode(mode)
        glPushMatrix()
        glLoadIdentity()
        if mode == GL_PROJECTION:
            glOrtho(-6, 6, -6, 6, 1, 10)
    # From above: north, which is -z, is at the top.
    gluLookAt(0, 5, 0, 0, 0, 0, 0, 0, -1)
    glCallList(maze)
    for mode in (GL_PROJECTION, GL_MODELVIEW):
        glMatrixMode(mode)
        glPopMatrix()
    glPopAttrib()


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A map of the maze", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    maze = glGenLists(1)
    glNewList(maze, GL_COMPILE)
    draw_maze()
    glEndList()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 0.5, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -1.2, -9)
        glRotatef(30, 1, 0, 0)
        glRotatef(turn, 0, 1, 0)
        glCallList(maze)
        draw_map(width, height, maze)
        draw_frame()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
