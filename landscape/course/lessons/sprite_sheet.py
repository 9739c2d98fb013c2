"""Sprite sheets: a fire of sixteen pictures

One texture holds sixteen pictures of a flame in four rows of four. Picture k is in column k % 4 and
row k // 4, and a quad shows it by its texture coordinates: nothing else changes from frame to
frame. Additive blending lets overlapping flames grow brighter. Without blending every quad is a
card; with coordinates from 0 to 1 all sixteen pictures burn at once.

Keys: Left and Right step, Up and Down change the speed; B: next blending; Space: the whole sheet.
"""
# topic: landscape
# needs: blending, billboard
# picture: frame 0
# loop: 80 frames
# keys: LEFT RIGHT UP DOWN B SPACE

import math
import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

FLAMES = (-0.6, 0, 2.6, 5), (0.7, 0, 2.4, 10), (0.1, -0.1, 4, 0)  # x, y, size, pictures ahead
LOGS = (-0.5, 0.1, 20), (0.6, 0.1, 160), (-0.3, -0.1, -12), (0.4, -0.2, 195)  # x, y, angle

ADDITIVE, ALPHA, NONE = range(3)
LABELS = "additive blending", "alpha blending", "no blending"
blending = ADDITIVE
step = 0
speed = 12  # pictures per second
whole = False


def load_sheet():
    image = Image.open(Path(__file__).parent / "data" / "fire.png").convert("RGBA")
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE)
    data = GL_RGBA, GL_UNSIGNED_BYTE, image.tobytes()
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, *image.size, 0, *data)


def draw_sprite(x, y, size, picture=None):
    """Draw a quad that stands on (x, y) with one of the pictures, or with the whole sheet."""
    part = 1 if picture is None else 1 / 4
    row, column = divmod(picture or 0, 4)
    glBegin(GL_QUADS)
    for across, up in ((0, 0), (1, 0), (1, 1), (0, 1)):
        glTexCoord2f(column / 4 + part * across, row / 4 + part * (1 - up))  # t = 0 is the top
        glVertex2f(x + size * (across - 0.5), y + size * up)
    glEnd()


def draw_hearth():
    """Draw the lit ground and four logs, each a rotated quad."""
    glBegin(GL_TRIANGLE_FAN)
    glColor3f(0.75, 0.38, 0.15)
    glVertex2f(0, 0)
    glColor3f(0.13, 0.16, 0.21)
    for angle in range(0, 361, 10):
        glVertex2f(4 * math.cos(math.radians(angle)), math.sin(math.radians(angle)))
    glEnd()
    for x, y, angle in LOGS:
        glPushMatrix()
        glTranslatef(x, y, 0)
        glRotatef(angle, 0, 0, 1)
        draw_log()
        glPopMatrix()


def draw_log():
    """Draw a log, which glows at its upper right corner."""
    glBegin(GL_QUADS)
    for across, up, red in (-1.2, -1, 0.1), (1, -1, 0.2), (1, 1, 0.7), (-1.2, 1, 0.3):
        glColor3f(red, 0.55 * red, 0.35 * red)
        glVertex2f(across, 0.13 * up)
    glEnd()


def draw_fire(picture):
    """Draw the flames, and at the right the sheet as it is."""
    glEnable(GL_TEXTURE_2D)
    if blending == ADDITIVE:
        glEnable(GL_BLEND)
        glBlendFunc(GL_SRC_ALPHA, GL_ONE)
    elif blending == ALPHA:
        glEnable(GL_BLEND)
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)

    glColor3f(1, 1, 1)
    for x, y, size, ahead in FLAMES:
        draw_sprite(x, y, size, None if whole else (picture + ahead) % 16)
    draw_sprite(3.9, 1.2, 3)
    glDisable(GL_BLEND)
    glDisable(GL_TEXTURE_2D)


def draw_frame(row, column, height):
    """Draw a frame around the picture in the sheet."""
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE)
    glLineWidth(height / 400)
    glRectf(2.4 + 0.75 * column, 4.2 - 0.75 * row, 3.15 + 0.75 * column, 3.45 - 0.75 * row)
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL)


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glOrtho(-3.4 * width / height, 3.4 * width / height, -2.3, 4.5, -1, 1)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(-1.4, 0, 0)


def on_key(window, key, scancode, action, mods):
    global step, speed, blending, whole
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        step -= 1
    elif key == glfw.KEY_RIGHT:
        step += 1
    elif key == glfw.KEY_UP:
        speed += 2
    elif key == glfw.KEY_DOWN:
        speed = max(0, speed - 2)
    elif key == glfw.KEY_B:
        blending = (blending + 1) % len(LABELS)
    elif key == glfw.KEY_SPACE:
        whole = not whole
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Sprite sheets"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    load_sheet()
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        look(width, height)
        glClear(GL_COLOR_BUFFER_BIT)
        draw_hearth()
        picture = (int(speed * glfw.get_time()) + step) % 16
        row, column = divmod(picture, 4)
        draw_fire(picture)
        draw_frame(row, column, height)

        write(16, 40, "picture {k}: column {column}, row {row}", k=picture, column=column, row=row)
        write(16, 64, "pictures per second: {speed}", speed=speed)
        write(16, 16, LABELS[blending])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
