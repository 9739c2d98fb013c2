"""SQUAD: a smooth turn through many attitudes

An aeroplane turns through six attitudes in a circle, each a quaternion w + x i + y j + z k. By
SLERP it turns at constant speed from one to the next, and jerks at each: the graph of its turning
speed has steps. SQUAD, the spherical cubic, is a SLERP between two SLERPs: one between the
attitudes, one between control points beside them. Speed and axis are then continuous.

Keys: Space SQUAD or SLERP; I, J and K turn the aeroplane by i, j and k, half a turn each.
"""
# topic: effects
# needs: slerp
# picture: frame 75
# loop: 360 frames
# keys: SPACE I J K

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

ONE, TURN_I, TURN_J, TURN_K = np.eye(4)  # the quaternions 1, i, j and k
CORAL = np.array((0.85, 0.35, 0.2))
AMBER = np.array((0.95, 0.7, 0.35))
CREAM = np.array((0.95, 0.9, 0.8))
SECONDS = 2  # from attitude to attitude
STEPS = 60  # of graph and trail between two attitudes

squad_on = True
extra = ONE  # the turns by i, j and k


def product(p, q):
    """Return p q by the rules i i = j j = k k = -1, i j = k, j k = i, k i = j: 16 products."""
    p_w, p_x, p_y, p_z = p
    q_w, q_x, q_y, q_z = q
    w = p_w * q_w - p_x * q_x - p_y * q_y - p_z * q_z
    x = p_w * q_x + p_x * q_w + p_y * q_z - p_z * q_y
    y = p_w * q_y - p_x * q_z + p_y * q_w + p_z * q_x
    z = p_w * q_z + p_x * q_y - p_y * q_x + p_z * q_w
    return np.array((w, x, y, z))


def inverse(q):
    return q * (1, -1, -1, -1)


def about(axis, degrees):
    """Return the turn about an axis: cos(a / 2) + v sin(a / 2), where v has the length 1."""
    half = np.radians(degrees) / 2
    vector = np.sin(half) * np.array(axis) / np.linalg.norm(axis)
    return np.array((np.cos(half), *vector))


def logarithm(q):
    """Return of cos(a) + v sin(a) the vector a v."""
    sine = np.linalg.norm(q[1:])
    return np.arctan2(sine, q[0]) / max(sine, 1e-12) * q[1:]


def exponential(vector):
    """Return of a vector a v the quaternion cos(a) + v sin(a)."""
    angle = np.linalg.norm(vector)
    return np.array((np.cos(angle), *(np.sin(angle) / max(angle, 1e-12) * vector)))


def slerp(p, q, t):
    angle = np.arccos(np.clip(p @ q, -1, 1))
    if angle < 1e-6:
        return p
    return (np.sin((1 - t) * angle) * p + np.sin(t * angle) * q) / np.sin(angle)


def control(before, here, after):
    """Return the control point beside ``here``: a quarter of the bend, the other way."""
    ways = [logarithm(product(inverse(here), neighbour)) for neighbour in (before, after)]
    return product(here, exponential(-sum(ways) / 4))


def make_attitudes():
    """Return six attitudes in a circle, each by a turn of the one before."""
    attitudes = [about((0, 1, 0), 0)]
    for axis, degrees in (
        ((0, 1, 0.3), 110),
        ((1, 0, 0.2), 40),
        ((0, 0.2, 1), 75),
        ((0.4, 1, 0), 100),
        ((-1, 0.5, 0), 55),
    ):
        attitudes.append(product(about(axis, degrees), attitudes[-1]))
    return attitudes


ATTITUDES = make_attitudes()


def neighbours(first):
    """Return the attitude before this one, this one, and the two after it."""
    four = [ATTITUDES[(first + n) % len(ATTITUDES)] for n in (-1, 0, 1, 2)]
    for n in (1, 2, 3):  # q and -q are the same attitude: take the nearer
        if four[n] @ four[n - 1] < 0:
            four[n] = -four[n]
    return four


def attitude(time):
    """Return the attitude at a time, in attitudes."""
    t = time % 1
    before, p, q, after = neighbours(int(time))
    if not squad_on:
        return slerp(p, q, t)

    a = control(before, p, q)
    b = control(p, q, after)
    return slerp(slerp(p, q, t), slerp(a, b, t), 2 * t * (1 - t))


def noses(turns):
    """Return where each of the turns takes the point (0, 0, -1)."""
    w, x, y, z = np.array(turns).T
    return np.array((-2 * (x * z + w * y), 2 * (w * x - y * z), 2 * (x * x + y * y) - 1)).T


def speeds(turns):
    """Return by how many degrees a second it turns from each of these attitudes to the next."""
    cosines = np.abs((turns[1:] * turns[:-1]).sum(axis=1))  # of half the angle between neighbours
    angles = 2 * np.arccos(np.clip(cosines, 0, 1))
    return np.degrees(angles) * STEPS / SECONDS


def draw(mode, points, color):
    glColor3f(*color)
    glVertexPointer(3, GL_FLOAT, 0, np.array(points, np.float32))
    glDrawArrays(mode, 0, len(points))


def draw_aeroplane(turn):
    """Draw its two halves; there is no light, so each half has its shade."""
    w, *axis = turn
    glRotatef(2 * np.degrees(np.arccos(np.clip(w, -1, 1))), *axis)
    for side, shade in ((-1, 0.7), (1, 1)):
        body = (0, 0, -1), (0, 0.18, 0), (0, 0.06, 0.6), (0.14 * side, 0, 0.1)
        wing = (0.08 * side, 0, -0.3), (0.85 * side, 0, 0.3), (0.1 * side, 0, 0.2)
        tail = (0, 0.05, 0.35), (0.35 * side, 0.05, 0.65), (0, 0.05, 0.6)
        fin = (0.01 * side, 0.1, 0.25), (0.01 * side, 0.45, 0.65), (0.01 * side, 0.05, 0.6)
        draw(GL_POLYGON, body, shade * CREAM)
        draw(GL_POLYGON, wing, shade * CORAL)
        draw(GL_POLYGON, tail, shade * CORAL)
        draw(GL_POLYGON, fin, shade * AMBER)


def draw_graph(turns, now):
    """Draw the turning speed over the whole circle, and a line where it is now."""
    for n in range(len(ATTITUDES) + 1):
        draw_mark(n, (0.3, 0.36, 0.43))

    high = -0.95 + 0.006 * speeds(turns)
    along = np.linspace(-0.95, 0.95, len(high))
    draw(GL_LINE_STRIP, np.array((along, high, 0 * along)).T, AMBER)
    draw_mark(now, CREAM)


def draw_mark(time, color):
    """Draw a vertical line in the graph."""
    x = -0.95 + 1.9 * time / len(ATTITUDES)
    draw(GL_LINES, ((x, -0.95, 0), (x, -0.35, 0)), color)


def draw_trail(turns, now):
    """Draw the way of the nose, and brighter what it has come so far."""
    draw(GL_LINE_STRIP, 1.2 * noses(turns), (0.4, 0.47, 0.55))
    so_far = [*turns[: int(now * STEPS) + 1], attitude(now)]
    draw(GL_LINE_STRIP, 1.2 * noses(so_far), AMBER)


def look_flat():
    """Set both matrices to the identity, for the graph."""
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()


def look_in_space(width, height):
    glMatrixMode(GL_PROJECTION)
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 20)
    glMatrixMode(GL_MODELVIEW)
    glTranslatef(0, 0.62, -5.6)
    glRotatef(35, 1, 0, 0)


def on_key(window, key, scancode, action, mods):
    global squad_on, extra
    if action != glfw.PRESS:
        return
    if key == glfw.KEY_SPACE:
        squad_on = not squad_on
    elif key == glfw.KEY_I:
        extra = product(extra, TURN_I)
    elif key == glfw.KEY_J:
        extra = product(extra, TURN_J)
    elif key == glfw.KEY_K:
        extra = product(extra, TURN_K)
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("SQUAD"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnableClientState(GL_VERTEX_ARRAY)

    while not glfw.window_should_close(window):
        now = glfw.get_time() / SECONDS % len(ATTITUDES)
        turns = np.array([attitude(n / STEPS) for n in range(len(ATTITUDES) * STEPS + 1)])
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glLineWidth(max(1, height / 240))

        look_flat()
        glDisable(GL_DEPTH_TEST)
        draw_graph(turns, now)

        glEnable(GL_DEPTH_TEST)
        look_in_space(width, height)
        draw_trail(turns, now)
        turn = product(attitude(now), extra)
        draw_aeroplane(turn)

        w, x, y, z = turn
        write(16, 448, "q = {w:+.2f} {x:+.2f} i {y:+.2f} j {z:+.2f} k", w=w, x=x, y=y, z=z)
        write(16, 424, "SQUAD" if squad_on else "SLERP")
        write(16, 172, "turning speed, 0 to 100° a second")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
