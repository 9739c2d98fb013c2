"""The glass marked in the stencil buffer, and the image drawn where the mark is."""
# exercise: stencil_mirror
# the rest: start.py


def draw_reflection():
    """Draw what the mirror shows, where its glass is."""
    glEnable(GL_STENCIL_TEST)
    glStencilFunc(GL_ALWAYS, 1, 1)
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE)
    glDepthMask(GL_FALSE)
    draw_glass()
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE)
    glDepthMask(GL_TRUE)
    glStencilFunc(GL_EQUAL, 1, 1)
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP)
    draw_image()
    glDisable(GL_STENCIL_TEST)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A round mirror", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL, GL_NORMALIZE):
        glEnable(capability)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -0.9, -9)
        glRotatef(16, 1, 0, 0)
        glRotatef(turn, 0, 1, 0)
        glLightfv(GL_LIGHT0, GL_POSITION, LIGHT)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)
        draw_reflection()
        draw_glass()
        draw_frame()
        draw_things()
        draw_board(-4, 0)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
