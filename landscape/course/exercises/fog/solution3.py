"""What does not move in a display list, drawn in fog; the parameters as vectors."""
# exercise: fog
# the rest: start.py
# without: draw_bay


def draw_jetty():
    """Draw what does not move."""
    glBegin(GL_QUADS)
    glColor3f(0.12, 0.4, 0.45)
    for x, z in ((-150, 10), (150, 10), (150, -150), (-150, -150)):
        glVertex3f(x, 0, z)
    for row in range(70):
        glColor3f(*((0.55, 0.4, 0.28) if row % 2 else (0.48, 0.34, 0.24)))
        for x, z in ((-1, -row), (1, -row), (1, -row - 1), (-1, -row - 1)):
            glVertex3f(x, 0.5, z)
    glEnd()
    for x, z in PILES:
        draw_tube(x, z, ((0.16, 0), (0.16, 1.3), (0, 1.4)), (0.5, 0.33, 0.22))


def draw_buoys():
    for x, z in BUOYS:
        y = 0.1 * math.sin(2 * glfw.get_time() + x)
        profile = ((0.6, 0), (0.7, 0.4), (0.2, 1.2), (0.2, 1.6), (0, 1.8))
        draw_tube(x, z, [(r, h + y) for r, h in profile], (0.95, 0.3, 0.15))


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
    # exp(-(density * HALF) ** 2) is one half.
    density = (-math.log(0.5)) ** 0.5 / HALF
    glFogiv(GL_FOG_MODE, [GL_EXP2])
    glFogfv(GL_FOG_DENSITY, [density])
    glFogfv(GL_FOG_COLOR, [*FOG, 1])
    glEnable(GL_FOG)
    still = glGenLists(1)
    glNewList(still, GL_COMPILE)
    draw_jetty()
    glEndList()

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
        glCallList(still)
        draw_buoys()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
