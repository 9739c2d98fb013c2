"""The plane around display lists of wall and stair."""
# exercise: clip_plane
# the rest: start.py


def draw_tower(wall, stair):
    glPushMatrix()
    glTranslatef(0.4, 0, -1)
    glRotatef(turn, 0, 1, 0)
    glClipPlane(GL_CLIP_PLANE0, (0, 0, -1, 0.3))
    glEnable(GL_CLIP_PLANE0)
    glCallList(wall)
    glDisable(GL_CLIP_PLANE0)
    glCallList(stair)
    glPopMatrix()


def listed(draw):
    """Return a display list of what a function draws."""
    number = glGenLists(1)
    glNewList(number, GL_COMPILE)
    draw()
    glEndList()
    return number


def main():
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(640, 480, "A tower, cut open", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.55, 0.7, 0.85, 1)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL, GL_NORMALIZE):
        glEnable(capability)
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE)  # the wall is lit from inside, too
    glLightfv(GL_LIGHT0, GL_POSITION, (-1, 1, 1.5, 0))
    wall = listed(draw_wall)
    stair = listed(draw_stair)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(-0.4, -2.3, -12.5)
        glRotatef(14, 1, 0, 0)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw_tower(wall, stair)
        draw_hill()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()
