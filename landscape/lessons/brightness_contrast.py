"""Brightness and contrast: arithmetic by blending

Each colour c becomes contrast * c + brightness, by quads blended over the picture. What they can
multiply by stops at 1: a contrast above 1 takes a pass for each doubling, which adds the picture to
itself. Between passes, the frame buffer keeps 0 to 1 only: with the contrast first, the lights are
lost. With a contrast of at most 1 and a brightness of at least 0 one pass does both: the quad's
colour is the brightness, its alpha the contrast (GL_ONE, GL_SRC_ALPHA). glCopyPixels with
glPixelTransfer does both at once for all values, and loses nothing in between.

Keys: Up, Down contrast; Left, Right brightness; D doubling; O order; C copied pixels; S tree only.
"""
# topic: effects
# needs: stencil_mirror, billboard, overlay
# picture: frame 0
# keys: UP DOWN LEFT RIGHT D O C S

from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

KEYS = glfw.KEY_D, glfw.KEY_O, glfw.KEY_C, glfw.KEY_S
contrast = 2
brightness = -0.4
on = [True] * len(KEYS)


def load(name, kind):
    image, texture = Image.open(Path(__file__).parent / "data" / name), glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexImage2D(GL_TEXTURE_2D, 0, kind, *image.size, 0, kind, GL_UNSIGNED_BYTE, image.tobytes())
    return texture


def draw_quad(texture, x, y, s, t, grey=(1, 1)):  # of each the first and the last
    glBindTexture(GL_TEXTURE_2D, texture)
    glBegin(GL_QUADS)
    for right, top in ((0, 0), (1, 0), (1, 1), (0, 1)):
        glColor3f(grey[right], grey[right], grey[right])
        glTexCoord2f(s[right], t[top])
        glVertex2f(x[right], y[top])
    glEnd()


def cover(level, alpha=1):
    glColor4f(level, level, level, alpha)
    glRectf(-9, -1, 9, 1)


def change_blended(doubling, brightness_first):
    if contrast <= 1 and brightness >= 0:
        glBlendFunc(GL_ONE, GL_SRC_ALPHA)  # brightness * 1 + contrast * c
        cover(brightness, contrast)
        return

    if contrast < 1:
        brightness_first = False  # nothing leaves 0 to 1 before the brightness is added
    for step in "+*" if brightness_first else "*+":
        if step == "*" and contrast < 1:
            glBlendFunc(GL_ZERO, GL_SRC_ALPHA)
            cover(0, contrast)
        elif step == "*":
            glBlendFunc(GL_DST_COLOR, GL_ONE)  # c * level + c
            for n in range(9 if doubling else 0):
                cover(max(1, min(contrast / 2**n, 2)) - 1)
        else:
            glBlendFunc(GL_ONE, GL_ONE)
            glBlendEquation(GL_FUNC_ADD if brightness > 0 else GL_FUNC_REVERSE_SUBTRACT)
            cover(abs(brightness) / (contrast if brightness_first else 1))
            glBlendEquation(GL_FUNC_ADD)


def on_key(window, key, scancode, action, mods):
    global contrast, brightness
    if action == glfw.PRESS:
        contrast = max(0, contrast + ((key == glfw.KEY_UP) - (key == glfw.KEY_DOWN)) / 2)
        change = ((key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT)) / 10
        brightness = round(brightness + change, 1) + 0.0  # + 0.0 makes 0 of -0
        on[:] = [on[n] ^ (key == KEYS[n]) for n in range(len(KEYS))]
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Brightness and contrast"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glAlphaFunc(GL_GREATER, 0.5)
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)
    for cap in (GL_TEXTURE_2D, GL_ALPHA_TEST, GL_STENCIL_TEST, GL_BLEND):
        glEnable(cap)
    sky, tree = load("sky.jpg", GL_RGB), load("tree.png", GL_RGBA)
    while not glfw.window_should_close(window):
        doubling, brightness_first, blended, whole = on
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glLoadIdentity()
        right = width / height
        glOrtho(-right, right, -1, 1, -1, 1)
        glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)
        draw_quad(sky, (-right, right), (-0.45, 1), (0.38, 0.6), (0.68, 0.01))
        draw_quad(0, (0.2, right - 0.07), (-0.74, -0.58), (0, 1), (0, 1), (0, 1))
        glStencilFunc(GL_ALWAYS, 1, 1)  # the tree marks its pixels with 1
        draw_quad(tree, (-0.8, 0.5), (-0.45, 0.85), (0, 1), (1, 0))
        glBindTexture(GL_TEXTURE_2D, 0)  # none
        glStencilFunc(GL_ALWAYS if whole else GL_EQUAL, 1, 1)
        if blended:
            change_blended(doubling, brightness_first)
        else:
            glPushAttrib(GL_PIXEL_MODE_BIT)
            for scale in (GL_RED_SCALE, GL_GREEN_SCALE, GL_BLUE_SCALE):
                glPixelTransferf(scale, contrast)
            for bias in (GL_RED_BIAS, GL_GREEN_BIAS, GL_BLUE_BIAS):
                glPixelTransferf(bias, brightness)
            glRasterPos2f(-right, -1)
            glCopyPixels(0, 0, width, height, GL_COLOR)
            glPopAttrib()
        glStencilFunc(GL_ALWAYS, 0, 1)
        glBlendFunc(GL_ONE, GL_ZERO)
        draw_quad(0, (0.2, right - 0.07), (-0.93, -0.77), (0, 1), (0, 1), (0, 1))
        write(16, 88, "contrast {c:.1f}, brightness {b:+.1f}", c=contrast, b=brightness)
        write(16, 64, "blended" if blended else "copied pixels")
        write(16, 40, "brightness first" if brightness_first else "contrast first")
        write(16, 16, "doubling" if doubling else "no doubling")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
