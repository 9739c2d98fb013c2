"""Overlays: a sword in front of everything

The sword is one textured quad, drawn last and with matrices of its own. The identity as modelview
matrix keeps it in the hand, and its own projection keeps its size when the scene is zoomed. But its
tip is 1.4 ahead, and a wall may be nearer: glDisable(GL_DEPTH_TEST) puts the sword in front of
everything. With the depth test it sinks into the wall, and only the tip shows above.

Keys: Up and Down walk, Left and Right turn; F zooms; Space switches the sword's depth test.
"""
# topic: landscape
# needs: blending, look_at, crossed_quads
# picture: frame 0
# keys: UP DOWN LEFT RIGHT F SPACE

import math
import sys
from pathlib import Path

import glfw
from OpenGL.GL import *
from PIL import Image
from text import _, write

# The viewer: place, and degrees to the right.
x = 0.2
z = -1.2
turn = 25
steps = 0  # walked so far: the view bobs at each
zoom = 1
depth_test = False


def make_texture(name):
    image = Image.open(Path(__file__).parent / "data" / name).convert("RGBA")
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE)
    data = GL_RGBA, GL_UNSIGNED_BYTE, image.tobytes()
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, *image.size, 0, *data)
    return texture


def draw_quad(s, t, a, b, c, d):
    """Draw the quad a, b, c, d; the texture repeats s times across and t times up."""
    glBegin(GL_QUADS)
    for u, v, corner in (0, t, a), (s, t, b), (s, 0, c), (0, 0, d):
        glTexCoord2f(u, v)
        glVertex3f(*corner)
    glEnd()


def draw_yard(bricks):
    glBindTexture(GL_TEXTURE_2D, bricks)
    for shade in (0.95, 0.6, 0.8, 0.5):
        glColor3f(shade, shade, shade)
        draw_quad(4, 1.3, (-2, -1, -2), (2, -1, -2), (2, 0.3, -2), (-2, 0.3, -2))
        glRotatef(90, 0, 1, 0)
    glColor3f(0.4, 0.45, 0.5)
    draw_quad(4, 4, (-2, -1, 2), (2, -1, 2), (2, -1, -2), (-2, -1, -2))


def draw_sword(sword):
    glBindTexture(GL_TEXTURE_2D, sword)
    glEnable(GL_BLEND)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glColor3f(1, 1, 1)
    near = -0.5  # the hand
    far = -1.4  # the tip
    draw_quad(1, 1, (0, -0.4, near), (0.5, -0.4, near), (0.5, 0.7, far), (0, 0.7, far))
    glDisable(GL_BLEND)


def set_projection(half, width, height):
    """Set a projection, and the identity as modelview; half: of the near plane's height."""
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-half * width / height, half * width / height, -half, half, 0.1, 20)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def walk(distance):
    global x, z, steps
    x = max(-1.6, min(1.6, x + distance * math.sin(math.radians(turn))))
    z = max(-1.6, min(1.6, z - distance * math.cos(math.radians(turn))))
    steps += 1


def on_key(window, key, scancode, action, mods):
    global turn, zoom, depth_test
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        turn -= 5
    elif key == glfw.KEY_RIGHT:
        turn += 5
    elif key == glfw.KEY_UP:
        walk(0.1)
    elif key == glfw.KEY_DOWN:
        walk(-0.1)
    elif key == glfw.KEY_F:
        zoom = 2 if zoom == 1 else 1
    elif key == glfw.KEY_SPACE:
        depth_test = not depth_test
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Overlays"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.3, 0.45, 0.6, 1)
    bricks = make_texture("brick.png")
    sword = make_texture("sword.png")
    glEnable(GL_TEXTURE_2D)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)

        # The yard: seen from the viewer's place, and zoomed.
        set_projection(0.05 / zoom, width, height)
        glRotatef(turn, 0, 1, 0)
        glTranslatef(-x, 0.02 * math.cos(steps), -z)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glEnable(GL_DEPTH_TEST)
        draw_yard(bricks)

        # The sword: where the hand is, never zoomed, and in front of everything.
        set_projection(0.05, width, height)
        if not depth_test:
            glDisable(GL_DEPTH_TEST)
        draw_sword(sword)

        write(16, 16, "depth test on" if depth_test else "depth test off", (0, 0, 0))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
