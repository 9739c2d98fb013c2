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

import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

contrast = 2
brightness = -0.4
doubling = True
brightness_first = True
blended = True
whole = True  # the whole picture, not the tree only


def load(name, kind):
    image = Image.open(Path(__file__).parent / "data" / name)
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    glTexImage2D(GL_TEXTURE_2D, 0, kind, *image.size, 0, kind, GL_UNSIGNED_BYTE, image.tobytes())
    return texture


def draw_quad(texture, x, y, s, t, grey=(1, 1)):
    """Draw a quad; x, y, s and t: each from the first to the last; grey: at the left and right."""
    glBindTexture(GL_TEXTURE_2D, texture)
    glBegin(GL_QUADS)
    for right, top in ((0, 0), (1, 0), (1, 1), (0, 1)):
        glColor3f(grey[right], grey[right], grey[right])
        glTexCoord2f(s[right], t[top])
        glVertex2f(x[right], y[top])
    glEnd()


def draw_picture(sky, tree, right):
    """Draw a sky, a ramp of greys below it, and a tree that marks its pixels with 1."""
    draw_quad(sky, (-right, right), (-0.45, 1), (0.38, 0.6), (0.68, 0.01))
    draw_quad(0, (0.2, right - 0.07), (-0.74, -0.58), (0, 1), (0, 1), grey=(0, 1))
    glStencilFunc(GL_ALWAYS, 1, 1)
    draw_quad(tree, (-0.8, 0.5), (-0.45, 0.85), (0, 1), (1, 0))


def cover(level, alpha=1):
    """Draw a grey quad over everything, by the blending that is set."""
    glColor4f(level, level, level, alpha)
    glRectf(-9, -1, 9, 1)


def multiply():
    """Multiply by the contrast: in one pass below 1, else in one for each doubling."""
    if contrast < 1:
        glBlendFunc(GL_ZERO, GL_SRC_ALPHA)
        cover(0, contrast)
        return

    glBlendFunc(GL_DST_COLOR, GL_ONE)  # c * level + c
    for n in range(9 if doubling else 0):
        cover(max(1, min(contrast / 2**n, 2)) - 1)


def add(level):
    """Add a level, or subtract it where it is negative."""
    glBlendFunc(GL_ONE, GL_ONE)
    glBlendEquation(GL_FUNC_ADD if level > 0 else GL_FUNC_REVERSE_SUBTRACT)
    cover(abs(level))
    glBlendEquation(GL_FUNC_ADD)


def change_blended():
    if contrast <= 1 and brightness >= 0:
        glBlendFunc(GL_ONE, GL_SRC_ALPHA)  # brightness * 1 + contrast * c
        cover(brightness, contrast)
    elif brightness_first and contrast >= 1:
        add(brightness / contrast)
        multiply()
    else:  # below 1, nothing leaves 0 to 1 before the brightness is added
        multiply()
        add(brightness)


def change_copied(width, height, right):
    """Copy all pixels onto themselves; on the way, each is scaled and biased."""
    glPushAttrib(GL_PIXEL_MODE_BIT)
    for scale in (GL_RED_SCALE, GL_GREEN_SCALE, GL_BLUE_SCALE):
        glPixelTransferf(scale, contrast)
    for bias in (GL_RED_BIAS, GL_GREEN_BIAS, GL_BLUE_BIAS):
        glPixelTransferf(bias, brightness)
    glRasterPos2f(-right, -1)
    glCopyPixels(0, 0, width, height, GL_COLOR)
    glPopAttrib()


def draw_unchanged_ramp(right):
    """Draw the ramp once more below the changed one, to compare."""
    glStencilFunc(GL_ALWAYS, 0, 1)
    glBlendFunc(GL_ONE, GL_ZERO)
    draw_quad(0, (0.2, right - 0.07), (-0.93, -0.77), (0, 1), (0, 1), grey=(0, 1))


def change_brightness(step):
    global brightness
    brightness = round(brightness + step, 1) + 0.0  # + 0.0 makes 0 of -0


def on_key(window, key, scancode, action, mods):
    global contrast, doubling, brightness_first, blended, whole
    if action != glfw.PRESS:
        return

    if key == glfw.KEY_UP:
        contrast += 0.5
    elif key == glfw.KEY_DOWN:
        contrast = max(0, contrast - 0.5)
    elif key == glfw.KEY_LEFT:
        change_brightness(-0.1)
    elif key == glfw.KEY_RIGHT:
        change_brightness(0.1)
    elif key == glfw.KEY_D:
        doubling = not doubling
    elif key == glfw.KEY_O:
        brightness_first = not brightness_first
    elif key == glfw.KEY_C:
        blended = not blended
    elif key == glfw.KEY_S:
        whole = not whole
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Brightness and contrast"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glAlphaFunc(GL_GREATER, 0.5)
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)
    for cap in (GL_TEXTURE_2D, GL_ALPHA_TEST, GL_STENCIL_TEST, GL_BLEND):
        glEnable(cap)
    sky = load("sky.jpg", GL_RGB)
    tree = load("tree.png", GL_RGBA)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        right = width / height
        glViewport(0, 0, width, height)
        glLoadIdentity()
        glOrtho(-right, right, -1, 1, -1, 1)
        glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)
        draw_picture(sky, tree, right)

        glBindTexture(GL_TEXTURE_2D, 0)  # none
        glStencilFunc(GL_ALWAYS if whole else GL_EQUAL, 1, 1)
        if blended:
            change_blended()
        else:
            change_copied(width, height, right)
        draw_unchanged_ramp(right)

        write(16, 88, "contrast {c:.1f}, brightness {b:+.1f}", c=contrast, b=brightness)
        write(16, 64, "blended" if blended else "copied pixels")
        write(16, 40, "brightness first" if brightness_first else "contrast first")
        write(16, 16, "doubling" if doubling else "no doubling")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
