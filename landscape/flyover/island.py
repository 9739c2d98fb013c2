"""The island as an environment of the fly-over: its heights in grey, a path, and points to look at.

The map is the one of the island's scene, 40 units wide. Heights have the same scale as lengths, so
that the island is as steep as there. The sea is flat.
"""

import numpy as np

from landscape.elements.settings import Ground, Water
from landscape.files.assets import shipped
from landscape.files.images import read_heights
from landscape.files.svg_writing import grey
from landscape.flyover.settings import Flyover
from landscape.geometry.bezier import through

WIDTH = Ground().size  # units
HEIGHT_IMAGE = "height16.png"
# Chosen, in units: what the path goes through, and what there is to see. It comes from the sea,
# with a view of the island, crosses the massif below its summit, follows the northern coast, and
# goes over the castle's hill back to the bay.
PATH = [
    (12.3, 27.5),
    (11.7, 25.6),
    (11.7, 23.7),
    (11.7, 21.6),
    (11.6, 19.6),
    (10.9, 17.7),
    (12, 16.9),
    (14.1, 16.7),
    (15.4, 15.5),
    (15.1, 13.5),
    (16.2, 11.9),
    (16.3, 9.8),
    (17.1, 8),
    (18.6, 6.7),
    (20.5, 6.6),
    (22.1, 7.8),
    (24.1, 8),
    (25.5, 8.9),
    (24.1, 10.4),
    (22.5, 11.6),
    (22.2, 12.9),
    (23.3, 14.5),
    (24.7, 16.1),
    (26.1, 17.5),
    (26.6, 19.3),
    (25.5, 20.9),
    (24.4, 22.7),
    (23.1, 24.1),
    (21.2, 25.2),
    (19.1, 26.2),
    (16.9, 27.3),
    (14.7, 28.3),
    (13.1, 28.4),
]
SUMMIT = (13.0, 10.0)
SECOND_SUMMIT = (18.3, 7.1)
CASTLE = (26.5, 16.7)


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
