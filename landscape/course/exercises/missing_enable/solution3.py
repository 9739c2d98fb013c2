"""The depth test, and the scene in a display list."""
# exercise: missing_enable
# the rest: start.py


def make_scene():
    """Return a display list of the board and the towers."""
    scene = glGenLists(1)
    glNewList(scene, GL_COMPILE)
    draw_scene()
    glEndList()
    return scene


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "One missing line", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    scene = make_scene()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -0.6, -13.5)
        glRotatef(28, 1, 0, 0)
        glRotatef(25 + 60 * glfw.get_time(), 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glCallList(scene)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
