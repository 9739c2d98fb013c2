"""Cohen and Sutherland: a code for each end, and cuts until both are inside."""
# exercise: line_clipping
# the rest: start.py


def outcode(x, y):
    """Return a bit for each border that a point is beyond."""
    return 1 * (x < LEFT) + 2 * (x > RIGHT) + 4 * (y < TOP) + 8 * (y > BOTTOM)


def cut(x, y, other_x, other_y, code):
    """Return where the line from x, y meets a border that this point is beyond."""
    if code & 3:
        border = LEFT if code & 1 else RIGHT
        return border, y + (other_y - y) * (border - x) / (other_x - x)
    border = TOP if code & 4 else BOTTOM
    return x + (other_x - x) * (border - y) / (other_y - y), border


def clip(x0, y0, x1, y1):
    """Return the part of a line that lies in the frame, x0, y0, x1, y1, or None."""
    while True:
        first = outcode(x0, y0)
        second = outcode(x1, y1)
        if first & second:
            return None
        if not first | second:
            return x0, y0, x1, y1
        if first:
            x0, y0 = cut(x0, y0, x1, y1, first)
        else:
            x1, y1 = cut(x1, y1, x0, y0, second)
