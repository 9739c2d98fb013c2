"""Recursion that returns lists."""
# exercise: quad_tree
# the rest: start.py


def visible(x, y, size):
    """Return the tiles that are to be drawn of a square, each as x, y, size."""
    where = look(x, y, size)
    if where == OUTSIDE:
        return []
    if where == INSIDE or size == SMALLEST:
        return [(x, y, size)]
    half = size // 2
    tiles = []
    for right in (0, half):
        for down in (0, half):
            tiles += visible(x + right, y + down, half)
    return tiles
