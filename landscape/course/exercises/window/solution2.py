"""A quad that fills the window; the light counted in tenths."""
# exercise: window
# the rest: start.py

light = 5  # in tenths


def draw_sky():
    """Fill the window with the colour of the sky."""
    glColor3f(0.1 * light, 0.05 * light, 0.035 * light)
    glBegin(GL_QUADS)
    for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        glVertex2f(x, y)
    glEnd()


def on_key(window, key, scancode, action, mods):
    global light
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_UP and light < 10:
        light += 1
    elif key == glfw.KEY_DOWN and light > 0:
        light -= 1
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)
