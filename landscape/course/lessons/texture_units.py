"""Texture units: two textures on one surface

Unit 0 holds the island's colours, stretched once over the whole ground; unit 1 holds a grey
detail, repeated 32 times. A vertex has a texture coordinate for each unit, and the units work
in a chain: the second combines its texture with the colour that the first one hands on. Without
the detail, the ground under the eye is a blur; without the colours, it is grey to the horizon.

Keys: 1 and 2 switch the units; Space changes how unit 1 combines its texture.
"""
# topic: landscape
# needs: height_field, textured_sphere
# picture: frame 60
# loop: 240 frames
# keys: 1 2 SPACE

import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

DATA = Path(__file__).parent / "data"
MODES = GL_COMBINE, GL_MODULATE, GL_ADD, GL_REPLACE
LABELS = "unit 1: GL_COMBINE", "unit 1: GL_MODULATE", "unit 1: GL_ADD", "unit 1: GL_REPLACE"
RELIEF = 0.45
REPEAT = 32
STEP = 2
switched_on = [True, True]
mode = 0


def load(unit, name):
    """Load an image into a texture of a unit, with the smaller copies for the distance."""
    image = Image.open(DATA / name).convert("RGB")
    glActiveTexture(unit)
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR)
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE)
    data = GL_RGB, GL_UNSIGNED_BYTE, image.tobytes()
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, *image.size, 0, *data)


def make_ground():
    """Compile the ground, from -1 to 1 in x and z, into a display list."""
    image = Image.open(DATA / "heights.png")
    side = image.width - 1
    ground = glGenLists(1)
    glNewList(ground, GL_COMPILE)
    for row in range(0, side, STEP):
        glBegin(GL_TRIANGLE_STRIP)
        for column in range(0, side + 1, STEP):
            for z in (row, row + STEP):
                s = column / side
                t = z / side
                glMultiTexCoord2f(GL_TEXTURE0, s, t)
                glMultiTexCoord2f(GL_TEXTURE1, REPEAT * s, REPEAT * t)
                height = max(0.12, image.getpixel((column, z)) / 65535)
                glVertex3f(2 * s - 1, RELIEF * height, 2 * t - 1)
        glEnd()
    glEndList()
    return ground


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 50, width / height / 50, -0.02, 0.02, 0.04, 10)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glRotatef(9, 1, 0, 0)
    glTranslatef(0, -0.25, -0.7)
    glRotatef(-6 * glfw.get_time(), 0, 1, 0)


def on_key(window, key, scancode, action, mods):
    global mode
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_1:
        switched_on[0] = not switched_on[0]
    elif key == glfw.KEY_2:
        switched_on[1] = not switched_on[1]
    elif key == glfw.KEY_SPACE:
        mode = (mode + 1) % len(MODES)
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Texture units"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.6, 0.75, 0.88, 1)
    glEnable(GL_DEPTH_TEST)
    load(GL_TEXTURE0, "ground.png")
    load(GL_TEXTURE1, "detail.png")

    # GL_COMBINE, here: twice the product. So the mean grey of the detail, 0.5, changes nothing.
    glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_MODULATE)
    glTexEnvf(GL_TEXTURE_ENV, GL_RGB_SCALE, 2)
    ground = make_ground()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        for unit in (0, 1):
            glActiveTexture(GL_TEXTURE0 + unit)
            if switched_on[unit]:
                glEnable(GL_TEXTURE_2D)
            else:
                glDisable(GL_TEXTURE_2D)

        # Unit 1 is still the active one: its mode says how its texture meets the colour of unit 0.
        glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, MODES[mode])
        glColor3f(*(1, 1, 1) if switched_on[0] else (0.5, 0.5, 0.5))
        glCallList(ground)
        glDisable(GL_TEXTURE_2D)
        glActiveTexture(GL_TEXTURE0)

        dark = 0, 0.05, 0.15  # against the sky
        write(16, 440, "unit 0: GL_MODULATE" if switched_on[0] else "unit 0: off", dark)
        write(16, 416, LABELS[mode] if switched_on[1] else "unit 1: off", dark)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
