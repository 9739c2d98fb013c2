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

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

# Pairs of attitudes: yaw, pitch and roll in degrees, at the start and at the end.
PAIRS = np.array(
    (
        ((30, 50, 0), (210, 50, -180)),
        ((0, 80, 0), (140, 80, -120)),
        ((-105, 0, 0), (105, 0, 0)),
        ((60, 10, 20), (-20, -15, -20)),
    )
)
LABELS = ("over the vertical", "near the vertical", "level, by 210°", "far from the vertical")
CORAL = np.array((0.85, 0.35, 0.2))
AMBER = np.array((0.95, 0.7, 0.35))
CREAM = np.array((0.95, 0.9, 0.8))
BLUE = (0.24, 0.3, 0.37)

pair = 0
short = True  # the short arc, where the other one of q and -q is nearer


def from_angles(angles):
    """Return the quaternions w, x, y, z of roll about z, then pitch about x, then yaw about y."""
    half = np.radians(angles).T / 2
    cos_yaw, cos_pitch, cos_roll = np.cos(half)
    sin_yaw, sin_pitch, sin_roll = np.sin(half)
    w = cos_yaw * cos_pitch * cos_roll + sin_yaw * sin_pitch * sin_roll
    x = cos_yaw * sin_pitch * cos_roll + sin_yaw * cos_pitch * sin_roll
    y = sin_yaw * cos_pitch * cos_roll - cos_yaw * sin_pitch * sin_roll
    z = cos_yaw * cos_pitch * sin_roll - sin_yaw * sin_pitch * cos_roll
    return np.array((w, x, y, z)).T


def slerp(p, q, t):
    """Return the attitude at the part t of the way from p to q, at constant speed."""
    if short and p @ q < 0:
        q = -q  # the same attitude, nearer to p
    angle = np.arccos(p @ q)
    return (np.sin((1 - t) * angle) * p + np.sin(t * angle) * q) / np.sin(angle)


def noses(turns):
    """Return where each of the turns takes the point (0, 0, -1)."""
    w, x, y, z = turns.T
    return np.array((-2 * (x * z + w * y), 2 * (w * x - y * z), 2 * (x * x + y * y) - 1)).T


def turned(turns):
    """Return how many degrees an aeroplane turns in all from one attitude to the next."""
    cosines = abs((turns[1:] * turns[:-1]).sum(axis=1))  # of half the angle between neighbours
    return np.degrees((2 * np.arccos(np.minimum(1, cosines))).sum())


def draw(mode, points, color):
    glColor3f(*color)
    glVertexPointer(3, GL_FLOAT, 0, np.array(points, np.float32))
    glDrawArrays(mode, 0, len(points))


def draw_globe():
    """Draw circles of equal pitch and circles of equal yaw."""
    for n in range(0, 180, 30):
        meridian = [(n, a, 0) for a in range(360)]
        parallel = [(a, n - 90, 0) for a in range(360)]
        draw(GL_LINE_LOOP, noses(from_angles(meridian)), BLUE)
        draw(GL_LINE_LOOP, noses(from_angles(parallel)), BLUE)


def draw_aeroplane():
    """Draw its two halves; there is no light, so each half has its shade."""
    for side, shade in ((-1, 0.7), (1, 1)):
        body = (0, 0, -1), (0, 0.18, 0), (0, 0.06, 0.6), (0.14 * side, 0, 0.1)
        wing = (0.08 * side, 0, -0.3), (0.85 * side, 0, 0.3), (0.1 * side, 0, 0.2)
        tail = (0, 0.05, 0.35), (0.35 * side, 0.05, 0.65), (0, 0.05, 0.6)
        fin = (0.01 * side, 0.1, 0.25), (0.01 * side, 0.45, 0.65), (0.01 * side, 0.05, 0.6)
        draw(GL_POLYGON, body, shade * CREAM)
        draw(GL_POLYGON, wing, shade * CORAL)
        draw(GL_POLYGON, tail, shade * CORAL)
        draw(GL_POLYGON, fin, shade * AMBER)


def draw_flight(turns):
    """Draw a globe, the trail of a nose, and the aeroplane after the last of the turns."""
    draw_globe()
    draw(GL_LINE_STRIP, 1.02 * noses(turns), AMBER)
    w, *axis = turns[-1]
    glRotatef(2 * np.degrees(np.arccos(w)), *axis)
    draw_aeroplane()


def look_at_half(n, width, height):
    """Look at the globe in the left half of the window, number 0, or in the right one."""
    glViewport(n * width // 2, 0, width // 2, height)
    size = 4 * min(width / 2, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / 2 / size, width / 2 / size, -height / size, height / size, 1, 20)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, 0.2, -4.5)
    glRotatef(45, 1, 0, 0)


def on_key(window, key, scancode, action, mods):
    global pair, short
    if action != glfw.PRESS:
        return
    if key == glfw.KEY_RIGHT:
        pair = (pair + 1) % len(PAIRS)
    elif key == glfw.KEY_SPACE:
        short = not short
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("SLERP"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_DEPTH_TEST)
    glEnableClientState(GL_VERTEX_ARRAY)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glLineWidth(max(1, height / 240))

        # A turn takes three seconds, then rests for one; the trail has 120 points up to now.
        t = min(1, glfw.get_time() % 4 / 3) * np.linspace(0, 1, 120)[:, np.newaxis]
        start, end = PAIRS[pair]
        p, q = from_angles(PAIRS[pair])
        angles = (1 - t) * start + t * end

        # Left: the quaternions are interpolated.
        turns = slerp(p, q, t)
        look_at_half(0, width, height)
        draw_flight(turns)
        write(16, 16, "turned so far {angle:.0f}°", angle=turned(turns))
        write(16, 64, "SLERP of quaternions")
        write(16, 88, LABELS[pair])
        write(16, 40, "short arc on" if short else "short arc off")

        # Right: each of the three angles is.
        turns = from_angles(angles)
        look_at_half(1, width, height)
        draw_flight(turns)
        write(16, 16, "turned so far {angle:.0f}°", angle=turned(turns))
        write(16, 64, "Euler: yaw, pitch, roll")
        yaw, pitch, roll = angles[-1]
        write(16, 40, "{y:.0f}°, {p:.0f}°, {r:.0f}°", y=yaw, p=pitch, r=roll)
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
