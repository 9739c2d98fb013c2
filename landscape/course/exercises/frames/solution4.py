"""Display lists for rim and cabin; each movement is undone by its opposite."""
# exercise: frames
# the rest: start.py

RIM = 1  # display lists
CABIN = 2


def compile_lists():
    glNewList(RIM, GL_COMPILE)
    draw_rim()
    glEndList()
    glNewList(CABIN, GL_COMPILE)
    draw_cabin()
    glPushMatrix()
    glMultMatrixf([0.45, 0, 0, 0, 0, 0.45, 0, 0, 0, 0, 1, 0, 0.15, -0.9, 0, 1])
    draw_person()
    glPopMatrix()
    glEndList()


def place(degrees):
    return math.cos(math.radians(degrees)), math.sin(math.radians(degrees))


def draw_wheel(angle):
    glPushAttrib(GL_TRANSFORM_BIT)
    glMatrixMode(GL_MODELVIEW)
    glTranslatef(*HUB, 0)
    glRotatef(angle, 0, 0, 1)
    glCallList(RIM)
    glRotatef(-angle, 0, 0, 1)
    for number in reversed(range(8)):
        x, y = (RADIUS * part for part in place(angle + 45 * number))
        glTranslatef(x, y, 0)
        glCallList(CABIN)
        glTranslatef(-x, -y, 0)
    glTranslatef(-HUB[0], -HUB[1], 0)
    glPopAttrib()


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(360, 360, "A Ferris wheel", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glLineWidth(5)
    compile_lists()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glOrtho(-5, 5, -5, 5, -1, 1)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glClear(GL_COLOR_BUFFER_BIT)
        draw_wheel(turned)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
