"""Whole numbers as coordinates, scaled by the texture matrix, in a display list."""
# exercise: textured_sphere
# the rest: start.py

PLANET = 1  # a display list


def draw_planet():
    glCallList(PLANET)


def compile_planet():
    glMatrixMode(GL_TEXTURE)
    glScalef(1 / COLUMNS, 1 / ROWS, 1)  # so columns and rows are the coordinates
    glMatrixMode(GL_MODELVIEW)
    glNewList(PLANET, GL_COMPILE)
    glBegin(GL_TRIANGLES)
    for row in range(ROWS):
        for column in range(COLUMNS):
            for right, below in ((0, 0), (0, 1), (1, 1), (1, 1), (1, 0), (0, 0)):
                add_vertex(column + right, row + below)
    glEnd()
    glEndList()


def add_vertex(column, row):
    longitude = 2 * math.pi * column / COLUMNS
    polar = math.pi * row / ROWS
    ring = math.sin(polar)
    place = ring * math.cos(longitude), math.cos(polar), -ring * math.sin(longitude)
    glTexCoord2i(column, row)
    glNormal3fv(place)
    glVertex3fv(place)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(300, 300, "A planet", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.08, 0.1, 0.14, 1)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_TEXTURE_2D):
        glEnable(capability)
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (1, 1, 1, 1))
    glLightfv(GL_LIGHT0, GL_POSITION, (-1, 1, 3, 0))
    make_texture()
    compile_planet()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glOrtho(-1.2 * width / height, 1.2 * width / height, -1.2, 1.2, -3, 3)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glRotatef(tilted, 1, 0, 0)
        glRotatef(turned, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_planet()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
