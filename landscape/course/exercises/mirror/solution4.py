"""A display list of all things, drawn twice: mirrored and as it is."""
# exercise: mirror
# the rest: start.py


def draw_image(things):
    """Draw the things once more, as the water mirrors them."""
    glPushMatrix()
    glTranslatef(0, 2 * LEVEL, 0)
    glScalef(1, -1, 1)
    set_sun()
    glClipPlane(GL_CLIP_PLANE0, (0, 1, 0, -LEVEL))
    glEnable(GL_CLIP_PLANE0)
    glFrontFace(GL_CW)
    glCallList(things)
    glFrontFace(GL_CCW)
    glDisable(GL_CLIP_PLANE0)
    glPopMatrix()
    set_sun()


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A lighthouse in a pond", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.19, 0.26, 0.37, 1)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    for capability in (
        GL_DEPTH_TEST,
        GL_CULL_FACE,
        GL_LIGHTING,
        GL_LIGHT0,
        GL_COLOR_MATERIAL,
        GL_NORMALIZE,
    ):
        glEnable(capability)
    things = glGenLists(1)
    glNewList(things, GL_COMPILE)
    draw_things()
    glEndList()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 100)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -1.1, -14)
        glRotatef(20, 1, 0, 0)
        glRotatef(turn, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        set_sun()
        draw_image(things)
        draw_shore()
        draw_water()
        glCallList(things)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
