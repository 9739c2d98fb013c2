"""Colors multiplied by their alpha beforehand, and tubes from vertex arrays."""
# exercise: blending_order
# the rest: start.py

import numpy as np


def draw_tube(x, z, color):
    """Draw a tube of glass, which is open above and below; its color times its alpha."""
    *channels, alpha = color
    glColor4f(*(alpha * channel for channel in channels), alpha)
    angles = np.arange(33) * 2 * np.pi / 32
    points = np.empty((33, 2, 3), "f")
    points[..., 0] = x + np.cos(angles)[:, None]
    points[..., 1] = 2.6, 0
    points[..., 2] = z + np.sin(angles)[:, None]
    glEnableClientState(GL_VERTEX_ARRAY)
    glVertexPointerf(points.reshape(-1, 3))
    glDrawArrays(GL_QUAD_STRIP, 0, 66)
    glDisableClientState(GL_VERTEX_ARRAY)


def draw_scene():
    draw_opaque()
    glEnable(GL_BLEND)
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA)
    glDepthMask(GL_FALSE)
    distances = [math.dist((x, z), eye()) for x, z, _color in TUBES]
    for number in np.argsort(distances)[::-1]:
        draw_tube(*TUBES[number])
    glDepthMask(GL_TRUE)
    glDisable(GL_BLEND)
