"""The levels as comparisons; between two of them the heights are mixed."""
# exercise: level_of_detail
# the rest: start.py


def step_at(distance):
    """Return the step of the grid at a distance from the camera."""
    if distance < 16:
        return 1
    if distance < 32:
        return 2
    if distance < 64:
        return 4
    return 8


def height_of(x, step, distance):
    """Return the height at which the vertex x of a grid is drawn."""
    if step == 8 or x % (2 * step) == 0:
        return HEIGHTS[x]
    between = (HEIGHTS[x - step] + HEIGHTS[x + step]) / 2
    weight = (distance - 12 * step) / (4 * step)
    weight = min(max(weight, 0), 1)
    return (1 - weight) * HEIGHTS[x] + weight * between
