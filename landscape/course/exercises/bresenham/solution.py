"""Bresenham's algorithm along the longer direction, whichever that is."""
# exercise: bresenham
# the rest: start.py


def segment(x0, y0, x1, y1):
    """Return the pixels of a line, pairs (x, y), in order."""
    dx = abs(x1 - x0)
    dy = abs(y1 - y0)
    step_x = 1 if x1 > x0 else -1
    step_y = 1 if y1 > y0 else -1
    steep = dy > dx
    longer, shorter = (dy, dx) if steep else (dx, dy)
    error = 2 * shorter - longer
    x = x0
    y = y0
    pixels = []
    for _ in range(longer + 1):
        pixels.append((x, y))
        if error > 0:
            if steep:
                x += step_x
            else:
                y += step_y
            error -= 2 * longer
        error += 2 * shorter
        if steep:
            y += step_y
        else:
            x += step_x

    return pixels
