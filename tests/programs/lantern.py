"""A paper lantern turns over a chequered floor. Space lights it or puts it out."""

import math

import glfw
from OpenGL.GL import *
from OpenGL.GLU import *

angle = 0.0
lit = True
lantern = floor = None


def on_key(window, key, scancode, action, mods):
    global lit
    if key == glfw.KEY_SPACE and action == glfw.PRESS:
        lit = not lit
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def make_texture():
    """Stripes of paper: cream, and a thin red line every eighth row."""
    pixels = bytearray()
    for y in range(32):
        for x in range(32):
            pixels += bytes((200, 60, 40) if y % 8 == 0 else (255, 240 - x % 4 * 6, 200))
    name = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, name)
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 32, 32, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes(pixels))
    return name


def make_lantern():
    """A body of revolution: eight rings of twenty-four sides."""
    name = glGenLists(1)
    glNewList(name, GL_COMPILE)
    for ring in range(8):
        glBegin(GL_QUAD_STRIP)
        for side in range(25):
            a = side * 2 * math.pi / 24
            for row in (ring + 1, ring):
                t = row / 8 * math.pi
                r = 0.35 + 0.65 * math.sin(t)
                glNormal3f(math.sin(t) * math.cos(a), -math.cos(t), math.sin(t) * math.sin(a))
                glTexCoord2f(side / 4, row / 4)
                glVertex3f(r * math.cos(a), -1.2 * math.cos(t), r * math.sin(a))
        glEnd()
    glEndList()
    return name


def make_floor():
    name = glGenLists(1)
    glNewList(name, GL_COMPILE)
    glNormal3f(0, 1, 0)
    glBegin(GL_QUADS)
    for i in range(-12, 12):
        for j in range(-12, 12):
            if (i + j) % 2:
                glColor3f(0.30, 0.34, 0.45)
            else:
                glColor3f(0.62, 0.60, 0.58)
            for x, z in ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)):
                glVertex3f(x / 2, -1.6, z / 2)
    glEnd()
    glEndList()
    return name


def init():
    global lantern, floor
    glEnable(GL_DEPTH_TEST)
    glEnable(GL_LIGHTING)
    glEnable(GL_COLOR_MATERIAL)
    glEnable(GL_NORMALIZE)
    glLightfv(GL_LIGHT0, GL_DIFFUSE, [1.0, 0.8, 0.5, 1.0])
    glLight(GL_LIGHT0, GL_QUADRATIC_ATTENUATION, 0.06)
    glLightfv(GL_LIGHT1, GL_DIFFUSE, [0.25, 0.3, 0.5, 1.0])
    glEnable(GL_LIGHT1)
    glEnable(GL_FOG)
    glFogi(GL_FOG_MODE, GL_EXP2)
    glFogf(GL_FOG_DENSITY, 0.11)
    glFogfv(GL_FOG_COLOR, [0.05, 0.06, 0.13, 1.0])
    glClearColor(0.05, 0.06, 0.13, 1.0)
    make_texture()
    lantern = make_lantern()
    floor = make_floor()


def draw(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(45, width / height, 0.1, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    gluLookAt(0, 1.2, 6, 0, -0.4, 0, 0, 1, 0)

    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glLightfv(GL_LIGHT1, GL_POSITION, [-1, 2, 2, 0])
    glLightfv(GL_LIGHT0, GL_POSITION, [0, 0, 0, 1])
    (glEnable if lit else glDisable)(GL_LIGHT0)
    glCallList(floor)

    glPushMatrix()
    glRotatef(angle, 0, 1, 0)
    glColor3f(1, 1, 1)
    glMaterialfv(GL_FRONT, GL_EMISSION, [0.55, 0.4, 0.2, 1] if lit else [0, 0, 0, 1])
    glEnable(GL_TEXTURE_2D)
    glCallList(lantern)
    glDisable(GL_TEXTURE_2D)
    glMaterialfv(GL_FRONT, GL_EMISSION, [0, 0, 0, 1])
    glPopMatrix()


def main():
    global angle
    if not glfw.init():
        raise RuntimeError("GLFW could not start")
    window = glfw.create_window(400, 300, "Lantern", None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    init()
    while not glfw.window_should_close(window):
        angle = 30 * glfw.get_time()
        draw(*glfw.get_framebuffer_size(window))
        glfw.swap_buffers(window)
        glfw.poll_events()
    glfw.terminate()


if __name__ == "__main__":
    main()
