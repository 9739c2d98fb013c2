"""The two faces that are the wrong way round, turned."""
# exercise: winding
# the rest: start.py

FACES = (
    (RED, TOP, 0, 1),
    (ORANGE, TOP, 1, 2),
    (CREAM, TOP, 2, 3),
    (GREEN, TOP, 3, 4),
    (BLUE, TOP, 4, 5),
    (VIOLET, TOP, 5, 0),
    (RED, BOTTOM, 1, 0),
    (ORANGE, BOTTOM, 2, 1),
    (CREAM, BOTTOM, 3, 2),
    (GREEN, BOTTOM, 4, 3),
    (BLUE, BOTTOM, 5, 4),
    (VIOLET, BOTTOM, 0, 5),
)
