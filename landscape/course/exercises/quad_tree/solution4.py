"""One level of the tree after the other, as arrays."""
# exercise: quad_tree
# the rest: start.py


def visible(x, y, size):
    """Return the tiles that are to be drawn of a square, each as x, y, size."""
    tiles = []
    level = np.array(((x, y, size),))
    quarters = np.array(((0, 0, 0.5), (0.5, 0, 0.5), (0, 0.5, 0.5), (0.5, 0.5, 0.5)))
    while len(level):
        where = np.array([look(*tile) for tile in level])
        done = (where == INSIDE) | (level[:, 2] == SMALLEST)
        tiles += level[done & (where != OUTSIDE)].tolist()
        divided = level[~done & (where == ACROSS)]
        places = divided * (1, 1, 0)
        level = (places[:, None] + divided[:, None, 2:] * quarters).reshape(-1, 3).astype(int)
    return tiles
