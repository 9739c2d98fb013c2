"""A horizon for each column, which rises with each row drawn; only what is above it is."""
# exercise: floating_horizon
# the rest: start.py


def draw_terrain(picture, rows):
    horizon = [-1] * WIDTH
    for row, (low, high) in enumerate(rows):
        for x in range(WIDTH):
            for height in range(max(low[x], horizon[x] + 1), high[x] + 1):
                plot(picture, x, height, row)
            horizon[x] = max(horizon[x], high[x])
