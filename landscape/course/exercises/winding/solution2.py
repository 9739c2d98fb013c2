"""The table computed from the ring, with the lower faces the other way round."""
# exercise: winding
# the rest: start.py

RING = tuple((number, (number + 1) % 6) for number in range(6))
COLORS = RED, ORANGE, CREAM, GREEN, BLUE, VIOLET
FACES = [(color, a, b, TOP) for color, (a, b) in zip(COLORS, RING)]
FACES += [(color, b, a, BOTTOM) for color, (a, b) in zip(COLORS, RING)]
