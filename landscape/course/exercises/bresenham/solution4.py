"""One error for both directions, so that no octant is a special case."""
# exercise: bresenham
# the rest: start.py


def segment(x0, y0, x1, y1):
    """Return the pixels of a line, pairs (x, y), in order: one error for both directions."""
    dx = abs(x1 - x0)
    dy = -abs(y1 - y0)
    step_x = (x1 > x0) - (x1 < x0)
    step_y = (y1 > y0) - (y1 < y0)
    error = dx + dy
    pixels = [(x0, y0)]
    while (x0, y0) != (x1, y1):
        twice = 2 * error
        if twice >= dy:
            error += dy
            x0 += step_x
        if twice <= dx:
            error += dx
            y0 += step_y
        pixels.append((x0, y0))
    return pixels
