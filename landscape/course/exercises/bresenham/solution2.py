"""All pixels at once by numpy: whole numbers, rounded by adding half a pixel."""
# exercise: bresenham
# the rest: start.py


def segment(x0, y0, x1, y1):
    """Return the pixels of a line, pairs (x, y), in order."""
    longer = max(abs(x1 - x0), abs(y1 - y0))
    if longer == 0:
        return [(x0, y0)]
    steps = np.arange(longer + 1)
    # Half a pixel more, rounded down, is the nearest pixel.
    columns = x0 + (2 * steps * (x1 - x0) + longer) // (2 * longer)
    rows = y0 + (2 * steps * (y1 - y0) + longer) // (2 * longer)
    return np.stack((columns, rows), axis=1)
