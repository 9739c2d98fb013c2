"""Sky box: standing stones under an evening sky

The six pictures of sky.jpg are the faces of a cube around the eye. The cube turns with the view,
but the eye's translation comes after it, so that the sky is never nearer. It is drawn first and
writes no depth, and so it is behind all, however small it is. If it writes depth, it hides the
stones; if it is translated, too, you walk out of it; with GL_REPEAT, its edges show.

Keys: the arrows turn and walk; T translates the sky, D lets it write depth, R repeats its faces.
"""
# topic: landscape
# needs: textured_sphere, depth_buffer, look_at
# picture: frame 1
# keys: LEFT RIGHT UP DOWN T D R

import math
import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

# The rotations of the cube's faces, in the order of sky.jpg: an angle and an axis.
FACES = (0, 0, 1, 0), (-90, 0, 1, 0), (180, 0, 1, 0), (90, 0, 1, 0), (90, 1, 0, 0), (-90, 1, 0, 0)
# The sides of a stone: a shade, and x and z at the left and at the right.
SIDES = (1, (-1, 1, 1, 1)), (1, (1, -1, -1, -1)), (0.7, (1, 1, 1, -1)), (0.7, (-1, -1, -1, 1))

# The eye: place, and degrees to the right of north.
x = 9.5
z = -3.5
turn = 250
translation = False
depth = False
repeat = False


def load_faces():
    """Load the six pictures of sky.jpg, which stand beside each other, as a texture each."""
    image = Image.open(Path(__file__).parent / "data" / "sky.jpg")
    side = image.height
    textures = glGenTextures(6)
    for face, texture in enumerate(textures):
        data = image.crop((face * side, 0, (face + 1) * side, side)).tobytes()
        glBindTexture(GL_TEXTURE_2D, texture)
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, side, side, 0, GL_RGB, GL_UNSIGNED_BYTE, data)
    return textures


def draw_sky(textures):
    glEnable(GL_TEXTURE_2D)
    glDepthMask(depth)
    glColor3f(1, 1, 1)
    for texture, rotation in zip(textures, FACES, strict=True):
        glBindTexture(GL_TEXTURE_2D, texture)
        for axis in (GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T):
            glTexParameteri(GL_TEXTURE_2D, axis, GL_REPEAT if repeat else GL_CLAMP_TO_EDGE)
        glPushMatrix()
        glRotatef(*rotation)
        draw_face()
        glPopMatrix()
    glDepthMask(True)
    glDisable(GL_TEXTURE_2D)


def draw_face():
    """Draw the face of the cube that is straight ahead."""
    glBegin(GL_QUADS)
    for s, t in ((0, 1), (1, 1), (1, 0), (0, 0)):  # the first row of a picture is its top
        glTexCoord2f(s, t)
        glVertex3f(2 * s - 1, 1 - 2 * t, -1)
    glEnd()


def draw_stones():
    """Draw thirteen stones in a circle."""
    for stone in range(13):
        glPushMatrix()
        glRotatef(stone * 360 / 13, 0, 1, 0)
        glTranslatef(0, 0, -5)
        glScalef(0.5, 2.2 + 0.5 * math.sin(stone * stone), 0.3)
        draw_stone()
        glPopMatrix()


def draw_stone():
    glBegin(GL_QUADS)
    for shade, (x0, z0, x1, z1) in SIDES:
        for y in (-1, 1):  # the darker half below 0 is the stone's image in the sea
            light = shade * (3 + y)
            glColor3f(0.11 * light, 0.08 * light, 0.085 * light)
            for corner in ((x0, 0, z0), (x1, 0, z1), (x1, y, z1), (x0, y, z0)):
                glVertex3f(*corner)
    glEnd()


def set_projection(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 16, width / height / 16, -0.035, 0.09, 0.1, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def walk(distance):
    global x, z
    x += distance * math.sin(math.radians(turn))
    z -= distance * math.cos(math.radians(turn))


def on_key(window, key, scancode, action, mods):
    global turn, translation, depth, repeat
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn -= 5
    elif key == glfw.KEY_RIGHT:
        turn += 5
    elif key == glfw.KEY_UP:
        walk(0.5)
    elif key == glfw.KEY_DOWN:
        walk(-0.5)
    elif key == glfw.KEY_T:
        translation = not translation
    elif key == glfw.KEY_D:
        depth = not depth
    elif key == glfw.KEY_R:
        repeat = not repeat
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Sky box"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_DEPTH_TEST)
    textures = load_faces()

    while not glfw.window_should_close(window):
        set_projection(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)

        # The sky turns with the view, and is not translated, unless T asks for it.
        glRotatef(turn, 0, 1, 0)
        if not translation:
            draw_sky(textures)
        glTranslatef(-x, -0.9, -z)
        if translation:
            draw_sky(textures)
        draw_stones()

        write(16, 16, "eye at x {east:.1f}, z {south:.1f}", east=x, south=z)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
