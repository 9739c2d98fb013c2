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

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

KEYS = dict(zip((glfw.KEY_I, glfw.KEY_J, glfw.KEY_K), np.eye(4)[1:], strict=True))  # i, j and k
CORAL = (0.85, 0.35, 0.2)
AMBER = (0.95, 0.7, 0.35)
CREAM = (0.95, 0.9, 0.8)
SECONDS, STEPS = 2, 60  # from attitude to attitude; steps of graph and trail between two
squad_on, extra = True, np.array((1.0, 0, 0, 0))


def product(p, q):
    """Return p q by the rules i i = j j = k k = -1, i j = k, j k = i, k i = j: 16 products."""
    (a, b, c, d), (e, f, g, h) = p, q
    return np.array(
        (
            a * e - b * f - c * g - d * h,
            a * f + b * e + c * h - d * g,
            a * g - b * h + c * e + d * f,
            a * h + b * g - c * f + d * e,
        )
    )


def inverse(q):
    return q * (1, -1, -1, -1)


def about(axis, degrees):
    half = np.radians(degrees) / 2
    return np.array((np.cos(half), *(np.sin(half) * np.array(axis) / np.linalg.norm(axis))))


def logarithm(q):  # cos(a) + v sin(a) becomes the vector a v
    sine = np.linalg.norm(q[1:])
    return np.arctan2(sine, q[0]) / max(sine, 1e-12) * q[1:]


def exponential(vector):
    angle = np.linalg.norm(vector)
    return np.array((np.cos(angle), *(np.sin(angle) / max(angle, 1e-12) * vector)))


def slerp(p, q, t):
    angle = np.arccos(np.clip(p @ q, -1, 1))
    if angle < 1e-6:
        return p
    return (np.sin((1 - t) * angle) * p + np.sin(t * angle) * q) / np.sin(angle)


def control(before, here, after):
    """Return the control point beside ``here``: a quarter of the bend, the other way."""
    ways = [logarithm(product(inverse(here), each)) for each in (before, after)]
    return product(here, exponential(-sum(ways) / 4))


def make_attitudes():
    """Return six attitudes in a circle, each in the half of the sphere of the one before."""
    found = [about((0, 1, 0), 0)]
    for axis, degrees in (
        ((0, 1, 0.3), 110),
        ((1, 0, 0.2), 40),
        ((0, 0.2, 1), 75),
        ((0.4, 1, 0), 100),
        ((-1, 0.5, 0), 55),
    ):
        found.append(product(about(axis, degrees), found[-1]))
    return found


ATTITUDES = make_attitudes()


def attitude(time):
    """Return the attitude at a time, in attitudes."""
    first, t = int(time), time % 1
    four = [ATTITUDES[(first + n) % len(ATTITUDES)] for n in (-1, 0, 1, 2)]
    for n in (1, 2, 3):  # q and -q are the same attitude: take the nearer
        four[n] = four[n] if four[n] @ four[n - 1] >= 0 else -four[n]
    p, q = four[1:3]
    if not squad_on:
        return slerp(p, q, t)
    return slerp(slerp(p, q, t), slerp(control(*four[:3]), control(*four[1:]), t), 2 * t * (1 - t))


def noses(turns):
    """Return where each of the turns takes the point (0, 0, -1)."""
    w, x, y, z = np.array(turns).T
    return np.array((-2 * (x * z + w * y), 2 * (w * x - y * z), 2 * (x * x + y * y) - 1)).T


def draw(mode, points, color):
    glColor3f(*color)
    glVertexPointer(3, GL_FLOAT, 0, np.array(points, np.float32))
    glDrawArrays(mode, 0, len(points))


def draw_aeroplane(turn):
    glRotatef(2 * np.degrees(np.arccos(np.clip(turn[0], -1, 1))), *turn[1:])
    for x, shade in ((-1, 0.7), (1, 1)):  # there is no light: each side has its shade
        for color, *corners in (
            (CREAM, (0, 0, -1), (0, 0.18, 0), (0, 0.06, 0.6), (0.14 * x, 0, 0.1)),
            (CORAL, (0.08 * x, 0, -0.3), (0.85 * x, 0, 0.3), (0.1 * x, 0, 0.2)),
            (CORAL, (0, 0.05, 0.35), (0.35 * x, 0.05, 0.65), (0, 0.05, 0.6)),
            (AMBER, (0.01 * x, 0.1, 0.25), (0.01 * x, 0.45, 0.65), (0.01 * x, 0.05, 0.6)),
        ):
            draw(GL_POLYGON, corners, [shade * channel for channel in color])


def speeds(turns):
    """Return by how many degrees a second it turns from each of these attitudes to the next."""
    near = np.clip(np.abs((turns[1:] * turns[:-1]).sum(axis=1)), 0, 1)
    return np.degrees(2 * np.arccos(near)) * STEPS / SECONDS


def draw_graph(turns, now):
    """Draw the turning speed over the whole circle, and a line where it is now."""
    along, high = np.linspace(-0.95, 0.95, len(turns) - 1), -0.95 + 0.006 * speeds(turns)
    for n in range(len(ATTITUDES) + 1):
        x = -0.95 + 1.9 * n / len(ATTITUDES)
        draw(GL_LINES, ((x, -0.95, 0), (x, -0.35, 0)), (0.3, 0.36, 0.43))
    draw(GL_LINE_STRIP, np.array((along, high, 0 * along)).T, AMBER)
    x = -0.95 + 1.9 * now / len(ATTITUDES)
    draw(GL_LINES, ((x, -0.95, 0), (x, -0.35, 0)), CREAM)


def on_key(window, key, scancode, action, mods):
    global squad_on, extra
    if action == glfw.PRESS:
        squad_on ^= key == glfw.KEY_SPACE
        extra = product(extra, KEYS.get(key, (1, 0, 0, 0)))
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("SQUAD"), None, None)
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
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glMatrixMode(GL_MODELVIEW)
        glLoadIdentity()
        glDisable(GL_DEPTH_TEST)
        draw_graph(turns, now)
        glEnable(GL_DEPTH_TEST)
        glMatrixMode(GL_PROJECTION)
        glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 20)
        glMatrixMode(GL_MODELVIEW)
        glTranslatef(0, 0.62, -5.6)
        glRotatef(35, 1, 0, 0)
        draw(GL_LINE_STRIP, 1.2 * noses(turns), (0.4, 0.47, 0.55))
        draw(GL_LINE_STRIP, 1.2 * noses([*turns[: int(now * STEPS) + 1], attitude(now)]), AMBER)
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
