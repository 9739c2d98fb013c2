"""A picture from a file on a lit sphere that turns, with GLFW."""

import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from OpenGL.GLU import *
from PIL import Image

FILE = Path(__file__).parents[1] / "data" / "planet.png"  # unless another one is named
angle = 0


def make_texture(file):
    """Read a picture, and make a texture object of it."""
    image = Image.open(file).convert("RGB")
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR)
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1)  # rows of any width
    texels = image.transpose(Image.Transpose.FLIP_TOP_BOTTOM).tobytes()  # from below
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, *image.size, 0, GL_RGB, GL_UNSIGNED_BYTE, texels)
    return texture


def draw_sphere(texture):
    """Draw a sphere as a quadric, which has texture coordinates; GLUT's sphere has none."""
    glBindTexture(GL_TEXTURE_2D, texture)
    glEnable(GL_TEXTURE_2D)
    quadric = gluNewQuadric()
    gluQuadricTexture(quadric, GL_TRUE)
    gluQuadricNormals(quadric, GLU_SMOOTH)
    gluSphere(quadric, 2, 128, 64)
    gluDeleteQuadric(quadric)
    glDisable(GL_TEXTURE_2D)


def set_light():
    """Set a light at infinity, along the z axis of the frame that is current."""
    glLightfv(GL_LIGHT0, GL_DIFFUSE, (0.6, 0.6, 0.6, 1))
    glLightfv(GL_LIGHT0, GL_SPECULAR, (0.6, 0.6, 0.6, 1))
    glLightfv(GL_LIGHT0, GL_POSITION, (0, 0, 10, 0))


def set_material():
    glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, (1, 1, 1, 1))
    glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, (1, 1, 1, 1))
    glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 110)
    glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT, (0.2, 0.2, 0.2, 1))


def display(window):
    glClearColor(1, 1, 1, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glPushMatrix()
    gluLookAt(8, 10, 15, 0, 0, 0, 0, 1, 0)
    set_material()
    glRotatef(0.05 * angle, 0, 1, 0)
    draw_sphere(texture)
    glPopMatrix()
    glfw.swap_buffers(window)


def reshape(window, width, height):
    """Called for a new size: the viewport, and the projection with its aspect."""
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(20, width / max(height, 1), 0.01, 10000)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    set_light()


def main():
    global angle, texture
    if not glfw.init():
        sys.exit("GLFW cannot start: is there a screen?")

    window = glfw.create_window(500, 500, "A picture on a sphere", None, None)
    if not window:
        sys.exit("GLFW cannot open a window with OpenGL.")

    glfw.set_window_pos(window, 100, 100)
    glfw.make_context_current(window)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0):
        glEnable(capability)
    glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, True)
    glShadeModel(GL_SMOOTH)
    glfw.set_framebuffer_size_callback(window, reshape)
    reshape(window, *glfw.get_framebuffer_size(window))
    texture = make_texture(sys.argv[1] if sys.argv[1:] else FILE)

    while not glfw.window_should_close(window):
        display(window)
        angle += 1
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
