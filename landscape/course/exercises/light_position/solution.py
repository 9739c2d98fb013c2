"""The lamp's place is set in each frame, once the camera's matrix is there."""
# exercise: light_position
# the rest: start.py


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A lamp that stays where it is", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    glEnable(GL_LIGHTING)
    glEnable(GL_LIGHT0)
    glLightfv(GL_LIGHT0, GL_DIFFUSE, (1.7, 1.6, 1.4, 1))
    glLightf(GL_LIGHT0, GL_QUADRATIC_ATTENUATION, 0.08)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -0.9, -12.5)
        glRotatef(30, 1, 0, 0)
        glRotatef(40 + 90 * glfw.get_time(), 0, 1, 0)
        glLightfv(GL_LIGHT0, GL_POSITION, LAMP)
        draw_scene()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
