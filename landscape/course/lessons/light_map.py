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
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image, ImageOps
from text import _, write

LABELS = "bricks", "light map", "bricks times light map"
light_x = -0.6
light_y = 1.4
shown = 3
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
        x, y = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        glVertex3f(light_x + radius * x, light_y + 1.6 * radius * y, 0.5)
    glEnd()


def on_key(window, key, scancode, action, mods):
    global light_x, light_y, shown, repeat
    if action == glfw.RELEASE:
        return
    light_x += 0.2 * ((key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT))
    light_y += 0.2 * ((key == glfw.KEY_UP) - (key == glfw.KEY_DOWN))
    if key - glfw.KEY_1 in range(3):
        shown = key - glfw.KEY_1 + 1
    repeat ^= key == glfw.KEY_SPACE
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Light maps"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    bricks = make_texture(Image.open(Path(__file__).parent / "data" / "brick.png").convert("RGB"))

    # The gradient is 0 in the middle and 181 at the edge: from the flame to the blue of the night.
    colors, levels = ("#fff4d8", "#303c68", "#c08850"), (0, 181, 80)
    glow = make_texture(ImageOps.colorize(Image.radial_gradient("L"), *colors, *levels))
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glTranslatef(0, -1, -11)
        glRotatef(20, 1, 0, 0)
        glRotatef(-20, 0, 1, 0)
        glClear(GL_COLOR_BUFFER_BIT)
        glColor3f(1, 1, 1)
        glEnable(GL_TEXTURE_2D)
        if shown != 2:
            draw_room(bricks, 0, 0, 3, GL_REPEAT)
        if shown == 3:
            glEnable(GL_BLEND)
            glBlendFunc(GL_DST_COLOR, GL_ZERO)
        if shown != 1:
            size = 5.5 + 0.2 * math.sin(9.4 * glfw.get_time()) * math.sin(22 * glfw.get_time())
            wrap = GL_REPEAT if repeat else GL_CLAMP_TO_EDGE
            draw_room(glow, light_x - size / 2, light_y - size / 2, size, wrap)
        glDisable(GL_TEXTURE_2D)
        glEnable(GL_BLEND)
        draw_flame(0.2)
        glDisable(GL_BLEND)
        write(16, 16, LABELS[shown - 1], (0, 0, 0) if shown == 1 else (1, 1, 1))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
