"""The step doubled in a loop; the mixture by the part of the way to the next level."""
# exercise: level_of_detail
# the rest: start.py


def step_at(distance):
    """Return the step of the grid at a distance from the camera."""
    step = 1
    while step < 8 and distance >= 16 * step:
        step *= 2
    return step


def height_of(x, step, distance):
    """Return the height at which the vertex x of a grid is drawn."""
    kept = step == 8 or x // step % 2 == 0
    if kept or distance <= 12 * step:
        return HEIGHTS[x]
    neighbors = HEIGHTS[[x - step, x + step]].mean()
    if distance >= 16 * step:
        return neighbors
    part = distance / step - 12
    return HEIGHTS[x] + (neighbors - HEIGHTS[x]) * part / 4
