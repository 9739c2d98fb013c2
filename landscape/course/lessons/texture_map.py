"""The texture map: a point of the image, a point of the surface

On the left is the image, flat, with s to the right and t upwards; on the right a surface that
wears it. A surface is a function from s and t to space. The mark at s, t of the image is at that
function's value on the surface, and the two lines through it, of equal s and of equal t, are
there again as curves. So every point of the surface has its point of the image: s times the
width, t times the height.

Keys: the arrows move the mark; 1 sphere, 2 cylinder, 3 torus, 4 a sheet; Space draws the grid
alone.
"""
# topic: textures
# needs: texture_objects
# picture: frame 0
# keys: LEFT RIGHT UP DOWN 2 3 4 1 SPACE

import math
import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

LABELS = ("a sphere", "a cylinder", "a torus", "a sheet")
surface = 0

# The texture coordinates of the mark.
s = 0.6
t = 0.65
textured = True
picture = 0, 0  # texels

CORAL = (0.95, 0.45, 0.3)
TEAL = (0.4, 0.85, 0.85)
CREAM = (0.95, 0.9, 0.8)


def flat(s, t):
    return s, t, 0


def sphere(s, t):
    longitude = math.tau * s
    latitude = math.pi * (t - 0.5)
    ring = math.cos(latitude)
    return ring * math.sin(longitude), math.sin(latitude), ring * math.cos(longitude)


def cylinder(s, t):
    longitude = math.tau * s
    return 0.8 * math.sin(longitude), 2 * t - 1, 0.8 * math.cos(longitude)


def torus(s, t):
    around = math.tau * s
    across = math.tau * t
    ring = 0.75 - 0.35 * math.cos(across)
    return ring * math.sin(around), -0.35 * math.sin(across), ring * math.cos(around)


def sheet(s, t):
    return 2 * s - 1, 0.25 * math.sin(math.tau * s) + 0.5 * (2 * t - 1), 0.9 - 1.8 * t


SURFACES = (sphere, cylinder, torus, sheet)


def make_texture():
    global picture
    image = Image.open(Path(__file__).parent / "data" / "planet.png").convert("RGB")
    picture = image.size
    texels = image.transpose(Image.Transpose.FLIP_TOP_BOTTOM).tobytes()  # t = 0 is its lowest row
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, *picture, 0, GL_RGB, GL_UNSIGNED_BYTE, texels)


def draw_surface(function, columns, rows):
    """Draw a surface as a mesh: each vertex has s and t, and the function gives its place."""
    if textured:
        glEnable(GL_TEXTURE_2D)
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL if textured else GL_LINE)
    glColor3f(*((1, 1, 1) if textured else (0.45, 0.5, 0.57)))
    for row in range(rows):
        glBegin(GL_QUAD_STRIP)
        for column in range(columns + 1):
            for step in (row + 1, row):
                glTexCoord2f(column / columns, step / rows)
                glVertex3f(*function(column / columns, step / rows))
        glEnd()
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL)
    glDisable(GL_TEXTURE_2D)


def draw_mark(function):
    """Draw the lines of equal s and of equal t, and the point in which they meet."""
    glColor3f(*CORAL)
    glBegin(GL_LINE_STRIP)
    for n in range(65):
        glVertex3f(*function(s, n / 64))
    glEnd()
    glColor3f(*TEAL)
    glBegin(GL_LINE_STRIP)
    for n in range(65):
        glVertex3f(*function(n / 64, t))
    glEnd()
    glColor3f(*CREAM)
    glBegin(GL_POINTS)
    glVertex3f(*function(s, t))
    glEnd()


def set_projection(left, right, bottom, top):
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(left, right, bottom, top, -3, 3)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def draw(width, height):
    bottom = int(88 * (height // 480 or height / 480))  # above the text
    middle = width // 2
    upper = height - bottom
    glLineWidth(height / 200)
    glPointSize(height / 48)

    glViewport(0, bottom, middle, upper)
    tall = 0.6 * upper / middle  # the image is twice as wide as high
    set_projection(-0.1, 1.1, 0.5 - 2 * tall, 0.5 + 2 * tall)
    draw_surface(flat, 24, 12)
    draw_mark(flat)
    write(-8, -26, "s", CORAL, at=(s, 0, 0))
    write(-18, -10, "t", TEAL, at=(0, t, 0))

    glViewport(middle, bottom, middle, upper)
    reach = 1.3
    set_projection(-reach, reach, -reach * upper / middle, reach * upper / middle)
    glRotatef(20, 1, 0, 0)
    if surface != 3:
        glRotatef(-360 * s + 25, 0, 1, 0)  # the mark is in sight
    glEnable(GL_DEPTH_TEST)
    draw_surface(SURFACES[surface], 36, 24)
    glDepthFunc(GL_LEQUAL)  # the lines lie on the surface
    glDepthRange(0, 0.99)
    draw_mark(SURFACES[surface])
    glDepthRange(0, 1)
    glDisable(GL_DEPTH_TEST)

    glViewport(0, 0, width, height)
    write(16, 64, LABELS[surface])
    write(16, 40, "s = {s:.2f}, t = {t:.2f}", s=s, t=t)
    across, up = picture
    write(16, 16, "texel {x:.0f}, {y:.0f} of {w} × {h}", x=s * across, y=t * up, w=across, h=up)


def on_key(window, key, scancode, action, mods):
    global s, surface, t, textured
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        s = (s - 0.05) % 1
    elif key == glfw.KEY_RIGHT:
        s = (s + 0.05) % 1
    elif key == glfw.KEY_UP:
        t = min(1, t + 0.05)
    elif key == glfw.KEY_DOWN:
        t = max(0, t - 0.05)
    elif glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        surface = key - glfw.KEY_1
    elif key == glfw.KEY_SPACE:
        textured = not textured
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("The texture map"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    make_texture()

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw(*glfw.get_framebuffer_size(window))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
