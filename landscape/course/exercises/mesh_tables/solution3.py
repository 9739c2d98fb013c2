"""The faces in another order and turn, each a fan, in a display list."""
# exercise: mesh_tables
# the rest: start.py

FACES = (
    *((5, 3, 2), (4, 3, 0), (5, 1, 0), (4, 1, 2)),
    *((4, 2, 3), (5, 0, 3), (4, 0, 1), (5, 2, 1)),
)
GEM = 1  # a display list


def draw_gem():
    glCallList(GEM)


def compile_gem():
    glNewList(GEM, GL_COMPILE)
    for a, b, c in FACES:
        glColor3fv(color_of((VERTICES[a], VERTICES[b], VERTICES[c])))
        glBegin(GL_TRIANGLE_FAN)
        glVertex3fv(VERTICES[a])
        glVertex3fv(VERTICES[b])
        glVertex3fv(VERTICES[c])
        glEnd()
    glEndList()


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(320, 320, "A gem", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    glEnable(GL_CULL_FACE)
    compile_gem()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glOrtho(-1.6 * width / height, 1.6 * width / height, -1.6, 1.6, -3, 3)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glRotatef(tilted, 1, 0, 0)
        glRotatef(turned, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_gem()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
