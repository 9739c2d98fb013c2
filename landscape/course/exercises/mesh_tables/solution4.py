"""The table from the signs of the corners' coordinates; one call draws it."""
# exercise: mesh_tables
# the rest: start.py

import numpy as np

FACES = [
    (x, z, y) if (x < 1) ^ (z < 2) ^ (y < 5) else (z, x, y)
    for x in (0, 2)
    for z in (1, 3)
    for y in (4, 5)
]


def draw_gem():
    corners = np.array(VERTICES)[np.array(FACES)]
    colors = np.repeat([color_of(each) for each in corners], 3, axis=0)
    glPushClientAttrib(GL_CLIENT_ALL_ATTRIB_BITS)
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_COLOR_ARRAY)
    glVertexPointerd(corners.reshape(-1, 3))
    glColorPointerd(colors)
    glDrawArrays(GL_TRIANGLES, 0, 24)
    glPopClientAttrib()
