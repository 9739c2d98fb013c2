"""All trees in one array, drawn by one call."""
# exercise: billboard
# the rest: start.py
# without: draw_tree

import numpy as np


def draw_trees():
    """Draw all trees by one call; each stands on its point x, 0, z."""
    places = np.array(TREES)
    to_eye = eye() - places
    to_eye /= np.linalg.norm(to_eye, axis=1, keepdims=True)
    right = np.stack((to_eye[:, 1], -to_eye[:, 0]), axis=1)
    corners = np.array(((0, 1), (1, 1), (1, 0), (0, 0)))
    across = 2.2 * (corners[:, 0] - 0.5)
    points = np.empty((len(TREES), 4, 3), "f")
    points[..., ::2] = places[:, None] + across[:, None] * right[:, None]
    points[..., 1] = 2.2 * (1 - corners[:, 1])
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_TEXTURE_COORD_ARRAY)
    glVertexPointerf(points.reshape(-1, 3))
    glTexCoordPointerf(np.tile(corners, (len(TREES), 1)).astype("f"))
    glDrawArrays(GL_QUADS, 0, 4 * len(TREES))
    glDisableClientState(GL_TEXTURE_COORD_ARRAY)
    glDisableClientState(GL_VERTEX_ARRAY)


def draw_orchard():
    glBegin(GL_TRIANGLE_FAN)
    glColor3f(0.62, 0.72, 0.4)
    glVertex3f(0, 0, 0)
    glColor3f(0.45, 0.58, 0.32)
    for step in range(49):
        glVertex3f(5 * math.cos(step * math.pi / 24), 0, -5 * math.sin(step * math.pi / 24))
    glEnd()
    glEnable(GL_TEXTURE_2D)
    glEnable(GL_ALPHA_TEST)  # leaves out what is transparent in the picture
    glColor3f(1, 1, 1)
    draw_trees()
    glDisable(GL_ALPHA_TEST)
    glDisable(GL_TEXTURE_2D)
