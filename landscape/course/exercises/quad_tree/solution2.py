"""A list of tiles that still wait, instead of recursion."""
# exercise: quad_tree
# the rest: start.py


def visible(x, y, size):
    """Return the tiles that are to be drawn of a square, each as x, y, size."""
    tiles = []
    waiting = [(x, y, size)]
    while waiting:
        tile = waiting.pop()
        where = look(*tile)
        if where == ACROSS and tile[2] > SMALLEST:
            x = tile[0]
            y = tile[1]
            half = tile[2] // 2
            waiting += [(x, y, half), (x + half, y, half), (x, y + half, half)]
            waiting.append((x + half, y + half, half))
        elif where != OUTSIDE:
            tiles.append(tile)
    return tiles
