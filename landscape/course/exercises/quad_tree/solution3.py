"""Recursion as a generator."""
# exercise: quad_tree
# the rest: start.py


def visible(x, y, size):
    """Return the tiles that are to be drawn of a square, each as x, y, size."""
    where = look(x, y, size)
    if where == ACROSS and size > SMALLEST:
        half = size // 2
        for number in range(4):
            yield from visible(x + half * (number % 2), y + half * (number // 2), half)
    elif where != OUTSIDE:
        yield x, y, size
