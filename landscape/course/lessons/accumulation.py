"""Accumulation: motion blur from many pictures

While the shutter is open the wheel turns on: the picture is the mean of several, each a moment
later. glAccum adds them, each times 1 / n, to the accumulation buffer of 16 bits a channel. Where
there is none, each is blended with the mean of those before. Too few pictures can be told apart. If
their parts are summed in the 8 bits of a colour, what each part loses adds up, too.

Keys: Space takes 1, 4 or 16 pictures; B sums their parts in 8 bits.
"""
# topic: effects
# needs: animation, normals, blending, textured_sphere
# picture: frame 10
# loop: 45 frames
# keys: SPACE B

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

CORAL = (0.85, 0.35, 0.2)
CREAM = (0.95, 0.9, 0.8)
TEAL = (0.25, 0.6, 0.6)
SHUTTER = 1 / 24  # seconds that it is open
ACCUM, BLENDED, ROUGH = range(3)  # how pictures are added
LABELS = ("mean by glAccum", "mean by blending", "sum in 8 bits")
count = 16
rough = False


def draw_tube(color, at, bottom, top, radius):
    """Draw a tube along y; at: the x and z of its axis."""
    glColor3f(*color)
    glBegin(GL_QUAD_STRIP)
    for step in range(17):
        angle = step * math.tau / 16
        x = math.cos(angle)
        z = -math.sin(angle)
        glNormal3f(x, 0, z)
        glVertex3f(at[0] + radius * x, top, at[1] + radius * z)
        glVertex3f(at[0] + radius * x, bottom, at[1] + radius * z)
    glEnd()


def draw_wheel():
    """Draw the rim in 48 parts, and six spokes; the first spoke is coral."""
    for part in range(48):
        draw_tube(CREAM, (1.9, 0), -0.14, 0.14, 0.25)
        if part % 8 == 0:
            draw_tube(CREAM if part else CORAL, (0, 0), 0, 1.8, 0.13)
        glRotatef(360 / 48, 0, 0, 1)


def draw_scene(time):
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glLoadIdentity()
    glTranslatef(0, 0.1, -10.8)
    glRotatef(-30, 0, 1, 0)
    draw_tube(TEAL, (0, -0.6), -4, 0.3, 0.3)
    glRotatef(480 * time, 0, 0, -1)
    glCallList(1)


def blend(number, width, height):
    """Blend a picture with those before, which are in the texture; put both into the texture."""
    glPushAttrib(GL_ENABLE_BIT)
    glDisable(GL_LIGHTING)
    glEnable(GL_TEXTURE_2D)
    glEnable(GL_BLEND)

    # The picture has the share 1 / (number + 1) of the mean; in a sum all have 1 / count.
    glBlendFunc(GL_ONE if rough else GL_ONE_MINUS_SRC_ALPHA, GL_SRC_ALPHA)
    before = 1.0 if number > 0 else 0.0  # there is nothing before the first
    glColor4f(before, before, before, 1 / (count if rough else number + 1))

    # A quad over the whole picture; the texture is larger, as its sides are powers of two.
    wide = next_power_of_two(width)
    high = next_power_of_two(height)
    glLoadIdentity()
    glBegin(GL_QUADS)
    for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
        glTexCoord2f(x * width / wide, y * height / high)
        glVertex3f((x - 0.5) * 0.51 * width / height, (y - 0.5) * 0.51, -1.02)
    glEnd()
    glPopAttrib()
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, wide, high, 0)


def next_power_of_two(size):
    power = 1
    while power < size:
        power *= 2
    return power


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
    glMatrixMode(GL_MODELVIEW)


def choose_sum():
    """Return how pictures are to be added: not every window has an accumulation buffer."""
    if rough:
        return ROUGH
    return ACCUM if glGetIntegerv(GL_ACCUM_RED_BITS) > 0 else BLENDED


def on_key(window, key, scancode, action, mods):
    global count, rough
    if action != glfw.PRESS:
        return
    if key == glfw.KEY_SPACE:
        count = {1: 4, 4: 16, 16: 1}[count]
    elif key == glfw.KEY_B:
        rough = not rough
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    for hint in (glfw.ACCUM_RED_BITS, glfw.ACCUM_GREEN_BITS, glfw.ACCUM_BLUE_BITS):
        glfw.window_hint(hint, 16)
    window = glfw.create_window(640, 480, _("Accumulation"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL):
        glEnable(capability)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)
    glNewList(1, GL_COMPILE)
    draw_wheel()
    glEndList()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        look(width, height)
        way = choose_sum()
        for number in range(count):
            draw_scene(glfw.get_time() + number / count * SHUTTER)
            if way == ACCUM:
                glAccum(GL_ACCUM if number else GL_LOAD, 1 / count)
            else:
                blend(number, width, height)
        if way == ACCUM:
            glAccum(GL_RETURN, 1)

        write(16, 40, "pictures: {count}", count=count)
        write(16, 16, LABELS[way])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
