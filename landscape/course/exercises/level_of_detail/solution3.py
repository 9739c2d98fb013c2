"""The levels searched in a table; heights as a product with their weights."""
# exercise: level_of_detail
# the rest: start.py


def step_at(distance):
    """Return the step of the grid at a distance from the camera."""
    return 2 ** int(np.searchsorted((16, 32, 64), distance, side="right"))


def height_of(x, step, distance):
    """Return the height at which the vertex x of a grid is drawn."""
    weight = np.interp(distance, (12 * step, 16 * step), (0, 1))
    if x % (2 * step) == 0 or step > 4:
        weight = 0
    left = max(x - step, 0)
    right = min(x + step, WIDTH)
    return np.dot((weight / 2, 1 - weight, weight / 2), HEIGHTS[[left, x, right]])
