"""Column after column instead of row after row, in a function of its own."""
# exercise: floating_horizon
# the rest: start.py


def draw_terrain(picture, rows):
    for x in range(WIDTH):
        draw_column(picture, x, [(low[x], high[x]) for low, high in rows])


def draw_column(picture, x, spans):
    """Draw a column from the nearest row to the farthest, above what is already there."""
    first_free = 0
    for row, (low, high) in enumerate(spans):
        for height in range(first_free, high + 1):
            if height >= low:
                plot(picture, x, height, row)
        first_free = max(first_free, high + 1)
