"""Fog set once before the loop; its density from the distance at which half is left."""
# exercise: fog
# the rest: start.py


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A jetty in the morning", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(*FOG, 1)
    glEnable(GL_DEPTH_TEST)
    glEnable(GL_FOG)
    glFogi(GL_FOG_MODE, GL_EXP2)
    glFogf(GL_FOG_DENSITY, math.sqrt(math.log(2)) / HALF)
    glFogfv(GL_FOG_COLOR, (*FOG, 1))

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 2, width / height / 2, -0.5, 0.5, 1, 200)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glRotatef(11, 1, 0, 0)
        glTranslatef(0.4, -2.6, -4)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_bay()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
