"""The horizon as an array: each row is drawn by one mask."""
# exercise: floating_horizon
# the rest: start.py


def draw_terrain(picture, rows):
    heights = np.arange(HEIGHT)[:, None]
    horizon = np.full(WIDTH, -1000)
    for row, (low, high) in enumerate(rows):
        seen = (heights >= low) & (heights <= high) & (heights > horizon)
        picture[seen] = COLORS[row]
        horizon = np.maximum(horizon, high)
