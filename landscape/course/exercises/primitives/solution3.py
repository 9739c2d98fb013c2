"""A display list for each thing; the path as single lines."""
# exercise: primitives
# the rest: start.py
# without: draw_vertices


def compile_list(number, kind, vertices):
    glNewList(number, GL_COMPILE)
    glBegin(kind)
    for x, y in vertices:
        glVertex2f(x, y)
    glEnd()
    glEndList()


def compile_lists():
    pieces = [vertex for pair in zip(PATH, PATH[1:]) for vertex in pair]
    for number, (kind, vertices) in enumerate(
        (
            (GL_TRIANGLES, TREES[::-1]),
            (GL_LINES, FENCE),
            (GL_LINES, pieces),
            (GL_LINE_LOOP, POND),
            (GL_TRIANGLE_STRIP, HILL),
            (GL_TRIANGLE_FAN, SUN[1:]),
        ),
        start=1,
    ):
        compile_list(number, kind, vertices)


def draw_trees():
    glColor3f(0.25, 0.5, 0.42)
    glCallList(1)


def draw_fence():
    glColor3f(0.95, 0.9, 0.8)
    glCallList(2)


def draw_path():
    glColor3f(0.95, 0.62, 0.35)
    glCallList(3)


def draw_pond():
    glColor3f(0.5, 0.75, 0.9)
    glCallList(4)


def draw_hill():
    glColor3f(0.2, 0.35, 0.4)
    glCallList(5)


def draw_sun():
    glColor3f(0.85, 0.35, 0.2)
    glCallList(6)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(480, 360, "A valley at evening", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glPointSize(5)
    glLineWidth(5)
    compile_lists()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glLoadIdentity()
        glOrtho(0, 32, 0, 24, -1, 1)
        glClear(GL_COLOR_BUFFER_BIT)
        draw_trees()
        draw_fence()
        draw_path()
        draw_pond()
        draw_hill()
        draw_sun()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
