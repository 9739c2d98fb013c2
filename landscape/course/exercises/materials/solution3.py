"""A display list for each material; the light's direction turned upwards by a matrix."""
# exercise: materials
# the rest: start.py


def set_material(color, highlight, shininess, glow):
    """Set the material of what is drawn next."""
    glCallList(1 + BALLS.index((color, highlight, shininess, glow)))


def compile_materials():
    for number, (color, highlight, shininess, glow) in enumerate(BALLS):
        red, green, blue = color
        glNewList(1 + number, GL_COMPILE)
        glMaterialfv(GL_FRONT, GL_AMBIENT, (0.4 * red, 0.4 * green, 0.4 * blue, 1))
        glMaterialfv(GL_FRONT, GL_DIFFUSE, (red, green, blue, 1))
        glMaterialfv(GL_FRONT, GL_SPECULAR, (*highlight, 1))
        glMaterialfv(GL_FRONT, GL_EMISSION, (*glow, 1))
        glMaterialf(GL_FRONT, GL_SHININESS, shininess)
        glEndList()


def set_sky():
    """Turn on the light of the sky."""
    if not glIsEnabled(GL_LIGHT1):
        glEnable(GL_LIGHT1)
        glLightfv(GL_LIGHT1, GL_DIFFUSE, SKY + (1,))
    glPushMatrix()
    glRotatef(-90, 1, 0, 0)
    glLightfv(GL_LIGHT1, GL_POSITION, (0, 0, 1, 0))
    glPopMatrix()


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(480, 240, "Four balls", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0):
        glEnable(capability)
    glLightfv(GL_LIGHT0, GL_AMBIENT, (0.5, 0.5, 0.5, 1))
    compile_materials()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glOrtho(-2.4 * width / height, 2.4 * width / height, -2.4, 2.4, -9, 9)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glRotatef(25, 1, 0, 0)
        glRotatef(turned, 0, 1, 0)
        glLightfv(GL_LIGHT0, GL_POSITION, (-3, 3, 6, 1))
        set_sky()
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_balls()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
