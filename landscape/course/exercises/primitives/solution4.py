"""Indices for each thing: strip, loop and fan are written as triangles and lines."""
# exercise: primitives
# the rest: start.py
# without: draw_vertices

import numpy as np


def draw_elements(kind, vertices, indices):
    corners = np.zeros((len(vertices), 2), np.float32)
    corners[:] = vertices
    glEnableClientState(GL_VERTEX_ARRAY)
    glVertexPointer(2, GL_FLOAT, 0, corners)
    glDrawElementsui(kind, indices)
    glDisableClientState(GL_VERTEX_ARRAY)


def draw_trees():
    glColor3f(0.25, 0.5, 0.42)
    draw_elements(GL_TRIANGLES, TREES, [*range(9)])


def draw_fence():
    glColor3f(0.95, 0.9, 0.8)
    draw_elements(GL_LINES, FENCE, [*range(14)])


def draw_path():
    glColor3f(0.95, 0.62, 0.35)
    draw_elements(GL_LINES, PATH, [0, 1, 1, 2, 2, 3, 3, 4, 4, 5])


def draw_pond():
    glColor3f(0.5, 0.75, 0.9)
    draw_elements(GL_LINE_STRIP, POND, [*range(8), 0])


def draw_hill():
    glColor3f(0.2, 0.35, 0.4)
    draw_elements(GL_TRIANGLES, HILL, [n + k for n in range(20) for k in range(3)])


def draw_sun():
    glColor3f(0.85, 0.35, 0.2)
    triangles = [(0, step, step % 16 + 1) for step in range(1, 17)]
    draw_elements(GL_TRIANGLES, SUN, np.ravel(triangles))
