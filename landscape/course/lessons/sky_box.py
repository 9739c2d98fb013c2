"""Sky box: standing stones under an evening sky

The six pictures of sky.jpg are the faces of a cube around the eye. The cube turns with the view,
but the eye's translation comes after it, so that the sky is never nearer. It is drawn first and
writes no depth, and so it is behind all, however small it is. If it writes depth, it hides the
stones; if it is translated, too, one walks out of it; with GL_REPEAT, its edges show.

Keys: the arrows turn and walk; T translates the sky, D lets it write depth, R repeats its faces.
"""
# topic: landscape
# needs: textured_sphere, depth_buffer, look_at
# picture: frame 1
# keys: LEFT RIGHT UP DOWN T D R

import math
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

# The rotations of the cube's faces, in the order of sky.jpg; a stone's sides: shade and corners.
FACES = (0, 0, 1, 0), (-90, 0, 1, 0), (180, 0, 1, 0), (90, 0, 1, 0), (90, 1, 0, 0), (-90, 1, 0, 0)
SIDES = (1, (-1, 1, 1, 1)), (1, (1, -1, -1, -1)), (0.7, (1, 1, 1, -1)), (0.7, (-1, -1, -1, 1))
turn, x, z = 250, 9.5, -3.5  # degrees to the right of north; the eye
translation = depth = repeat = False


def load_faces():
    image = Image.open(Path(__file__).parent / "data" / "sky.jpg")
    side, textures = image.height, glGenTextures(6)
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
        glBegin(GL_QUADS)
        for s, t in ((0, 1), (1, 1), (1, 0), (0, 0)):  # the first row of a picture is its top
            glTexCoord2f(s, t)
            glVertex3f(2 * s - 1, 1 - 2 * t, -1)
        glEnd()
        glPopMatrix()
    glDepthMask(True)
    glDisable(GL_TEXTURE_2D)


def draw_stones():
    for stone in range(13):
        glPushMatrix()
        glRotatef(stone * 360 / 13, 0, 1, 0)
        glTranslatef(0, 0, -5)
        glScalef(0.5, 2.2 + 0.5 * math.sin(stone * stone), 0.3)
        glBegin(GL_QUADS)
        for shade, (x0, z0, x1, z1) in SIDES:
            for y in (-1, 1):  # the darker half below 0 is the stone's image in the sea
                glColor3f(*(shade * (3 + y) * part for part in (0.11, 0.08, 0.085)))
                for corner in ((x0, 0, z0), (x1, 0, z1), (x1, y, z1), (x0, y, z0)):
                    glVertex3f(*corner)
        glEnd()
        glPopMatrix()


def on_key(window, key, scancode, action, mods):
    global turn, x, z, translation, depth, repeat
    if action != glfw.RELEASE:
        turn += 5 * ((key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT))
        step = 0.5 * ((key == glfw.KEY_UP) - (key == glfw.KEY_DOWN))
        x, z = x + step * math.sin(math.radians(turn)), z - step * math.cos(math.radians(turn))
        translation ^= key == glfw.KEY_T
        depth ^= key == glfw.KEY_D
        repeat ^= key == glfw.KEY_R
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Sky box"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_DEPTH_TEST)
    textures = load_faces()
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 16, width / height / 16, -0.035, 0.09, 0.1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
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
