"""glDrawElements with pointers that are set once."""
# exercise: vertex_arrays
# the rest: start.py


def draw_vase():
    glDrawElements(GL_TRIANGLES, TRIANGLES.size, GL_UNSIGNED_INT, TRIANGLES)


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A vase in one call", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL):
        glEnable(capability)
    for array in (GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY):
        glEnableClientState(array)
    glVertexPointer(3, GL_FLOAT, 0, VERTICES)
    glNormalPointer(GL_FLOAT, 0, NORMALS)
    glColorPointer(4, GL_UNSIGNED_BYTE, 0, COLORS)
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE)  # one sees into the vase
    glLightfv(GL_LIGHT0, GL_POSITION, (-2, 3, 3, 0))

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -0.9, -9)
        glRotatef(25, 1, 0, 0)
        glRotatef(30 * glfw.get_time(), 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_vase()
        draw_table()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
