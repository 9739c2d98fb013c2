"""Light vectors: N, L, V, R and H at a point

The light at a point of a surface depends on directions: N at right angles to the surface, L to the
light, V to the viewer. Diffuse light goes with the cosine of the angle between N and L, and is 0
when the light is below the surface. Specular light is strong where V is near R, the mirror image of
L, or, as OpenGL has it, where H, halfway between L and V, is near N; both to the power n.

Keys: Left and Right move the light, Up and Down the viewer; N changes the exponent n; Space shows N
and L alone.
"""
# topic: light
# needs: depth_buffer
# picture: frame 0
# keys: LEFT RIGHT UP DOWN N SPACE

import math
import sys

import glfw
from OpenGL.GL import *
from text import _, write

to_light = 50  # degrees from N
to_viewer = -30
exponent = 8
specular = True

GREY = (0.45, 0.5, 0.57)
CREAM = (0.95, 0.9, 0.8)
TEAL = (0.4, 0.8, 0.8)
AMBER = (0.95, 0.72, 0.35)
CORAL = (0.95, 0.5, 0.35)
BLUE = (0.6, 0.75, 1)


def draw_arrow(name, degrees, color, length=1.0):
    """Draw a direction from the point, ``degrees`` from N to the left."""
    angle = math.radians(degrees)
    x = -math.sin(angle)
    y = math.cos(angle)
    glColor3f(*color)
    glBegin(GL_LINES)
    glVertex2f(0, 0)
    glVertex2f(length * x, length * y)
    glEnd()
    glBegin(GL_TRIANGLES)
    for along, aside in ((0, 0), (-0.09, 0.035), (-0.09, -0.035)):
        glVertex2f((length + along) * x - aside * y, (length + along) * y + aside * x)
    glEnd()
    tip = ((length + 0.1) * x, (length + 0.1) * y, 0)
    write(-5, -10, "{name}", color, at=tip, name=name)


def draw_arc(radius, first, last, color):
    glColor3f(*color)
    glBegin(GL_LINE_STRIP)
    for n in range(25):
        angle = math.radians(first + (last - first) * n / 24)
        glVertex2f(-radius * math.sin(angle), radius * math.cos(angle))
    glEnd()


def draw_surface(color):
    """Draw the surface in section, with the point in the colour of its light."""
    glColor3f(0.2, 0.25, 0.32)
    glRectf(-3, -0.3, 3, 0)
    glColor3f(*GREY)
    glBegin(GL_LINES)
    glVertex2f(-3, 0)
    glVertex2f(3, 0)
    glEnd()
    glColor3f(*color)
    glBegin(GL_POLYGON)
    for n in range(24):
        glVertex2f(0.07 * math.cos(n * math.pi / 12), 0.07 * math.sin(n * math.pi / 12))
    glEnd()


def cosine(degrees):
    """Return the cosine of an angle, 0 for more than 90 degrees."""
    return max(0.0, math.cos(math.radians(degrees)))


def draw(width, height):
    bottom = int(136 * (height // 480 or height / 480))  # above the text
    glViewport(0, bottom, width, height - bottom)
    reach = 0.8 * width / (height - bottom)
    glLoadIdentity()
    glOrtho(-reach, reach, -0.3, 1.3, -1, 1)
    glLineWidth(height / 200)

    # R is at -to_light, so that the angle from R to V is the sum.
    diffuse = cosine(to_light)
    lit = diffuse > 0
    half = (to_light + to_viewer) / 2
    phong = lit * cosine(to_viewer + to_light) ** exponent
    blinn = lit * cosine(half) ** exponent
    shine = blinn if specular else 0

    draw_surface([min(1, 0.08 + diffuse * part + shine) for part in (0.8, 0.33, 0.2)])
    draw_arc(0.3, 0, to_light, AMBER)
    if specular:
        draw_arc(0.42, -to_light, to_viewer, CORAL)
        draw_arc(0.54, 0, half, BLUE)
        draw_arrow("R", -to_light, CORAL, 0.95)
        draw_arrow("H", half, BLUE, 0.95)
        draw_arrow("V", to_viewer, TEAL)

    draw_arrow("L", to_light, AMBER, 1.1)
    draw_arrow("N", 0, CREAM, 1.1)

    glViewport(0, 0, width, height)
    write(16, 112, "angle N, L: {a}°", AMBER, a=abs(to_light))
    write(280, 112, "diffuse: cos = {d:.2f}", AMBER, d=diffuse)
    if specular:
        write(16, 88, "angle R, V: {a}°", CORAL, a=abs(to_viewer + to_light))
        write(280, 88, "Phong: cos^{n} = {s:.2f}", CORAL, n=exponent, s=phong)
        write(16, 64, "angle N, H: {a:.0f}°", BLUE, a=abs(half))
        write(280, 64, "OpenGL: cos^{n} = {s:.2f}", BLUE, n=exponent, s=blinn)

    write(16, 16, "lit" if lit else "the light is below the surface: neither term")


def on_key(window, key, scancode, action, mods):
    global exponent, specular, to_light, to_viewer
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_RIGHT:
        to_light = max(-120, to_light - 10)
    elif key == glfw.KEY_LEFT:
        to_light = min(120, to_light + 10)
    elif key == glfw.KEY_DOWN:
        to_viewer = max(-80, to_viewer - 10)
    elif key == glfw.KEY_UP:
        to_viewer = min(80, to_viewer + 10)
    elif key == glfw.KEY_N:
        exponent = exponent * 2 if exponent < 128 else 1
    elif key == glfw.KEY_SPACE:
        specular = not specular
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Light vectors"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT)
        draw(*glfw.get_framebuffer_size(window))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
