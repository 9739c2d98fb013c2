"""Only the octant to the right and down is drawn; the others are mirrored onto it."""
# exercise: bresenham
# the rest: start.py


def segment(x0, y0, x1, y1):
    """Return the pixels of a line, pairs (x, y), in order."""
    if abs(y1 - y0) > abs(x1 - x0):
        return [(x, y) for y, x in segment(y0, x0, y1, x1)]
    if x1 < x0:
        return [(-x, y) for x, y in segment(-x0, y0, -x1, y1)]
    if y1 < y0:
        return [(x, -y) for x, y in segment(x0, -y0, x1, -y1)]

    # To the right and down, in steps of one column.
    error = 2 * (y1 - y0) - (x1 - x0)
    y = y0
    pixels = []
    for x in range(x0, x1 + 1):
        pixels.append((x, y))
        if error > 0:
            y += 1
            error -= 2 * (x1 - x0)
        error += 2 * (y1 - y0)
    return pixels
