"""glClearColor in each frame; the light kept between 0 and 1 in steps of 0.1."""
# exercise: window
# the rest: start.py


def draw_sky():
    """Fill the window with the colour of the sky."""
    glClearColor(light, 0.5 * light, 0.35 * light, 1)
    glClear(GL_COLOR_BUFFER_BIT)


def on_key(window, key, scancode, action, mods):
    global light
    if action in (glfw.PRESS, glfw.REPEAT):
        if key == glfw.KEY_UP:
            light = min(light + 0.1, 1)
        if key == glfw.KEY_DOWN:
            light = max(light - 0.1, 0)
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)
