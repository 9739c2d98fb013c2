"""The clearing in a display list; the light by arithmetic with the keys."""
# exercise: window
# the rest: start.py

SKY = 1  # a display list


def draw_sky():
    """Fill the window with the colour of the sky."""
    glPushAttrib(GL_COLOR_BUFFER_BIT)
    glClearColor(*(light * channel for channel in (1, 0.5, 0.35)), 0)
    glCallList(SKY)
    glPopAttrib()


def on_key(window, key, scancode, action, mods):
    global light
    if action != glfw.RELEASE:
        light += 0.1 * ((key == glfw.KEY_UP) - (key == glfw.KEY_DOWN))
        if light < 0:
            light = 0
        if light > 1:
            light = 1
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(320, 240, "The sky over the roofs", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glNewList(SKY, GL_COMPILE)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glEndList()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        draw_sky()
        draw_moon(-0.8 + glfw.get_time() % 1.6)
        draw_street()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
