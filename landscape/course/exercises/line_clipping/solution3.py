"""Sutherland and Hodgman: one border after the other cuts what is left."""
# exercise: line_clipping
# the rest: start.py


def clip(x0, y0, x1, y1):
    """Return the part of a line that lies in the frame, x0, y0, x1, y1, or None."""
    # Sutherland and Hodgman: what is left of the line after each border.
    line = [np.array((x0, y0)), np.array((x1, y1))]
    for normal, border in (((1, 0), LEFT), ((-1, 0), -RIGHT), ((0, 1), TOP), ((0, -1), -BOTTOM)):
        inside = [np.dot(normal, point) - border for point in line]
        if max(inside) < 0:
            return None
        if min(inside) < 0:
            meeting = line[0] + (line[1] - line[0]) * inside[0] / (inside[0] - inside[1])
            line = [meeting if distance < 0 else point for distance, point in zip(inside, line)]
    return *line[0], *line[1]
