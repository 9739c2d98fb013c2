"""Liang and Barsky: where along the line each pair of borders is entered and left."""
# exercise: line_clipping
# the rest: start.py


def clip(x0, y0, x1, y1):
    """Return the part of a line that lies in the frame, x0, y0, x1, y1, or None."""
    first = 0  # the part of the line that is left
    last = 1
    for begin, way, low, high in ((x0, x1 - x0, LEFT, RIGHT), (y0, y1 - y0, TOP, BOTTOM)):
        if way == 0:
            if not low <= begin <= high:
                return None
            continue
        enters = (low - begin) / way
        leaves = (high - begin) / way
        if way < 0:
            enters, leaves = leaves, enters
        first = max(first, enters)
        last = min(last, leaves)

    if first > last:
        return None
    return (
        x0 + first * (x1 - x0),
        y0 + first * (y1 - y0),
        x0 + last * (x1 - x0),
        y0 + last * (y1 - y0),
    )
