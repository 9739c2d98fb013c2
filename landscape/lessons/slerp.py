"""SLERP: one turn by quaternions and by Euler angles

Two aeroplanes turn between the same two attitudes: the left one by SLERP of quaternions, at
constant speed about one axis, the right one by its yaw, pitch and roll, each on its own. Near the
vertical, yaw and roll turn about nearly the same axis (gimbal lock): the nose takes a detour. A
quaternion and its opposite are one attitude: without the short arc, SLERP may go the long way.

Keys: Right takes the next two attitudes, Space turns the short arc off.
"""
# topic: effects
# needs: matrix_stack, vertex_arrays, second_viewport
# picture: frame 110
# loop: 240 frames
# keys: RIGHT SPACE

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

PAIRS = np.array(
    (
        ((30, 50, 0), (210, 50, -180)),
        ((0, 80, 0), (140, 80, -120)),  # degrees
        ((-105, 0, 0), (105, 0, 0)),
        ((60, 10, 20), (-20, -15, -20)),
    )
)
LABELS = ("over the vertical", "near the vertical", "level, by 210°", "far from the vertical")
CORAL = (0.85, 0.35, 0.2)
AMBER = (0.95, 0.7, 0.35)
CREAM = (0.95, 0.9, 0.8)
pair, short = 0, True


def from_angles(angles):
    """Return the quaternions w, x, y, z of roll about z, then pitch about x, then yaw about y."""
    half = np.radians(angles).T / 2
    (a, b, c), (d, e, f) = np.cos(half), np.sin(half)
    w, x = a * b * c + d * e * f, a * e * c + d * b * f
    return np.array((w, x, d * b * c - a * e * f, a * b * f - d * e * c)).T


def slerp(p, q, t):
    if short and p @ q < 0:
        q = -q  # the same attitude, nearer to p
    angle = np.arccos(p @ q)
    return (np.sin((1 - t) * angle) * p + np.sin(t * angle) * q) / np.sin(angle)


def noses(turns):
    """Return where each of the turns takes the point (0, 0, -1)."""
    w, x, y, z = turns.T
    return np.array((-2 * (x * z + w * y), 2 * (w * x - y * z), 2 * (x * x + y * y) - 1)).T


def draw(mode, points, color):
    glColor3f(*color)
    glVertexPointer(3, GL_FLOAT, 0, np.array(points, np.float32))
    glDrawArrays(mode, 0, len(points))


def draw_flight(turns):
    """Draw a globe, an aeroplane after the last of the turns, and the trail of its nose."""
    for n in range(0, 180, 30):
        for circle in ([(n, a, 0) for a in range(360)], [(a, n - 90, 0) for a in range(360)]):
            draw(GL_LINE_LOOP, noses(from_angles(circle)), (0.24, 0.3, 0.37))
    draw(GL_LINE_STRIP, 1.02 * noses(turns), AMBER)
    glRotatef(2 * np.degrees(np.arccos(turns[-1, 0])), *turns[-1, 1:])
    for x, shade in ((-1, 0.7), (1, 1)):  # there is no light: each side has its shade
        for color, *corners in (
            (CREAM, (0, 0, -1), (0, 0.18, 0), (0, 0.06, 0.6), (0.14 * x, 0, 0.1)),
            (CORAL, (0.08 * x, 0, -0.3), (0.85 * x, 0, 0.3), (0.1 * x, 0, 0.2)),
            (CORAL, (0, 0.05, 0.35), (0.35 * x, 0.05, 0.65), (0, 0.05, 0.6)),
            (AMBER, (0.01 * x, 0.1, 0.25), (0.01 * x, 0.45, 0.65), (0.01 * x, 0.05, 0.6)),
        ):
            draw(GL_POLYGON, corners, [shade * channel for channel in color])
    arcs = 2 * np.arccos(np.minimum(1, abs((turns[1:] * turns[:-1]).sum(axis=1))))
    write(16, 16, "turned so far {angle:.0f}°", angle=np.degrees(arcs.sum()))


def on_key(window, key, scancode, action, mods):
    global pair, short
    if action == glfw.PRESS:
        pair = (pair + (key == glfw.KEY_RIGHT)) % len(PAIRS)
        short ^= key == glfw.KEY_SPACE
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("SLERP"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    glEnableClientState(GL_VERTEX_ARRAY)
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glLineWidth(max(1, height / 240))
        t = min(1, glfw.get_time() % 4 / 3) * np.linspace(0, 1, 120)[:, None]  # up to now
        angles = (1 - t) * PAIRS[pair][0] + t * PAIRS[pair][1]
        for n, turns in enumerate((slerp(*from_angles(PAIRS[pair]), t), from_angles(angles))):
            glViewport(n * width // 2, 0, width // 2, height)
            size = 4 * min(width / 2, height)
            glMatrixMode(GL_PROJECTION)
            glLoadIdentity()
            glFrustum(-width / 2 / size, width / 2 / size, -height / size, height / size, 1, 20)
            glMatrixMode(GL_MODELVIEW)
            glLoadIdentity()
            glTranslatef(0, 0.2, -4.5)
            glRotatef(45, 1, 0, 0)
            draw_flight(turns)
            write(16, 64, ("SLERP of quaternions", "Euler: yaw, pitch, roll")[n])
            if n == 0:
                write(16, 88, LABELS[pair])
                write(16, 40, "short arc on" if short else "short arc off")
        yaw, pitch, roll = angles[-1]
        write(16, 40, "{y:.0f}°, {p:.0f}°, {r:.0f}°", y=yaw, p=pitch, r=roll)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
