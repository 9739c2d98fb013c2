"""Light maps: light painted into a texture

Wall and floor are drawn twice. The first pass draws their bricks; the second draws the same quads
with a picture of the light, and glBlendFunc(GL_DST_COLOR, GL_ZERO) multiplies the two.
OpenGL computes no lighting here: moving the light only moves texture coordinates. With GL_REPEAT
instead of GL_CLAMP_TO_EDGE, the one light shines again and again.

Keys: arrows move the light; 1 bricks, 2 light, 3 both multiplied; Space repeats the light map.
"""
# topic: landscape
# needs: blending, texture_units
# picture: frame 0
# loop: 120 frames
# keys: LEFT RIGHT UP DOWN 1 2 SPACE

import math
import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image, ImageOps
from text import _, write

LABELS = "bricks", "light map", "bricks times light map"
light_x = -0.6
light_y = 1.4
BRICKS, LIGHT, PRODUCT = range(3)
shown = PRODUCT
repeat = False


def make_texture(image):
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE)
    data = GL_RGB, GL_UNSIGNED_BYTE, image.tobytes()
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, *image.size, 0, *data)
    return texture


def draw_room(texture, x0, y0, size, wrap):
    """Draw wall and floor like a folded sheet; the texture begins at x0, y0 and is size wide."""
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap)
    glBegin(GL_QUAD_STRIP)
    for y, z in ((7, 0), (0, 0), (0, 7)):
        for x in (-9, 9):
            glTexCoord2f((x - x0) / size, (y - z - y0) / size)  # z is 0 on the wall, y on the floor
            glVertex3f(x, y, z)
    glEnd()


def draw_flame(radius):
    """Add a glowing disc where the light is, in front of the wall."""
    glBlendFunc(GL_ONE, GL_ONE)
    glBegin(GL_TRIANGLE_FAN)
    glColor3f(1, 0.9, 0.6)
    glVertex3f(light_x, light_y, 0.5)
    glColor3f(0, 0, 0)
    for angle in range(0, 361, 20):
        x = radius * math.cos(math.radians(angle))
        y = 1.6 * radius * math.sin(math.radians(angle))
        glVertex3f(light_x + x, light_y + y, 0.5)
    glEnd()


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, -1, -11)
    glRotatef(20, 1, 0, 0)
    glRotatef(-20, 0, 1, 0)


def make_glow():
    """Return a texture of light: from the flame in the middle to the blue of the night."""
    gradient = Image.radial_gradient("L")  # 0 in the middle, 181 at the edge
    return make_texture(
        ImageOps.colorize(
            gradient,
            black="#fff4d8",
            blackpoint=0,
            mid="#c08850",
            midpoint=80,
            white="#303c68",
            whitepoint=181,
        )
    )


def draw_light(glow):
    """Draw the light map over wall and floor; it flickers."""
    size = 5.5 + 0.2 * math.sin(9.4 * glfw.get_time()) * math.sin(22 * glfw.get_time())
    wrap = GL_REPEAT if repeat else GL_CLAMP_TO_EDGE
    draw_room(glow, light_x - size / 2, light_y - size / 2, size, wrap)


def on_key(window, key, scancode, action, mods):
    global light_x, light_y, shown, repeat
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        light_x -= 0.2
    elif key == glfw.KEY_RIGHT:
        light_x += 0.2
    elif key == glfw.KEY_UP:
        light_y += 0.2
    elif key == glfw.KEY_DOWN:
        light_y -= 0.2
    elif glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        shown = key - glfw.KEY_1
    elif key == glfw.KEY_SPACE:
        repeat = not repeat
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Light maps"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    bricks = make_texture(Image.open(Path(__file__).parent / "data" / "brick.png").convert("RGB"))
    glow = make_glow()

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT)
        glColor3f(1, 1, 1)
        glEnable(GL_TEXTURE_2D)
        if shown != LIGHT:
            draw_room(bricks, 0, 0, 3, GL_REPEAT)
        if shown == PRODUCT:
            glEnable(GL_BLEND)
            glBlendFunc(GL_DST_COLOR, GL_ZERO)
        if shown != BRICKS:
            draw_light(glow)
        glDisable(GL_TEXTURE_2D)
        glEnable(GL_BLEND)
        draw_flame(0.2)
        glDisable(GL_BLEND)

        write(16, 16, LABELS[shown], (0, 0, 0) if shown == BRICKS else (1, 1, 1))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
