"""No horizon: the painter's order, where each row covers what is below it."""
# exercise: floating_horizon
# the rest: start.py


def draw_terrain(picture, rows):
    """Draw from the farthest row to the nearest: each covers all below it in the picture."""
    for row, (low, high) in reversed(list(enumerate(rows))):
        for x in range(WIDTH):
            picture[: max(high[x] + 1, 0), x] = BACKGROUND
            for height in range(low[x], high[x] + 1):
                plot(picture, x, height, row)
