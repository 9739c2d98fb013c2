"""The island as an environment of the fly-over: its heights in grey, a path, and points to look at.

The map is the one of the island's scene, 40 units wide. Heights have the same scale as lengths, so
that the island is as steep as there. The sea is flat.
"""

import numpy as np

from landscape.files.assets import shipped
from landscape.files.images import read_heights
from landscape.files.svg_writing import grey
from landscape.flyover.settings import Flyover
from landscape.geometry.bezier import through
from landscape.settings import Ground, Water

WIDTH = Ground().size  # units
HEIGHT_IMAGE = "height16.png"
# Chosen, in units: what the path goes through, and what there is to see. It starts on the meadow,
# follows the beach, passes the massif on both sides, crosses it, and goes around the castle's hill.
PATH = [
    (20.0, 27.0), (16.0, 28.0), (12.0, 24.6), (8.6, 22.0), (7.2, 17.0), (8.6, 12.4), (11.2, 9.4),
    (14.6, 7.6), (17.4, 10.4), (21.0, 12.4), (25.0, 11.4), (28.6, 13.2), (29.8, 18.0),
    (28.4, 22.6), (24.6, 24.6),
]  # fmt: skip
SUMMIT, SECOND_SUMMIT, CASTLE = (13.0, 10.0), (18.3, 7.1), (26.5, 16.7)


def image() -> np.ndarray:
    """Return the heights above the sea as uint16 greys (512, 512), black at flyover.relief."""
    heights = read_heights(shipped() / HEIGHT_IMAGE) / 256.0 * Ground().scale_y
    above = np.maximum(heights - Water().level, 0.0)
    return grey(above / WIDTH * len(heights) / Flyover().relief)


def path() -> np.ndarray:
    """Return the camera's path in pixels, (n, 4, 2), to hundredths as a file has it."""
    curves = through(np.array(PATH) / WIDTH * len(image()), closed=True)
    return np.round(curves, 2)


def targets() -> np.ndarray:
    """Return the points to look at in pixels, (m, 2)."""
    places = np.array([SUMMIT, SECOND_SUMMIT, CASTLE])
    return np.round(places / WIDTH * len(image()), 2)
