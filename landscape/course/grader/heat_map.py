"""Where a student's picture differs: both pictures and, between them, the difference as heat."""

import numpy as np

from landscape.course.grader.evidence import Evidence
from landscape.course.grader.grading import LEVELS, difference, differing

HEAT = np.array([(0.13, 0.16, 0.21), (0.85, 0.35, 0.2), (0.95, 0.62, 0.35), (1.0, 1.0, 1.0)])
GAP = 8  # pixels, chosen: between the pictures
# The colours, uint8 (n, 3): of a pixel that counts as different, by how many levels it differs;
# and of another one, by the sum of the solution's three channels.
_places, _levels = np.linspace(0, 1, len(HEAT)), np.arange(256) / 255
_bright = np.stack([np.interp(_levels, _places, HEAT[:, each]) for each in range(3)], axis=1)
BRIGHT = (_bright * 255).astype(np.uint8)
_faint = HEAT[0] * 0.6 + np.arange(3 * 255 + 1)[:, None] / 3 / 255 * 0.18
FAINT = (_faint * 255).astype(np.uint8)


def _heat(mine: np.ndarray, wanted: np.ndarray, counted: np.ndarray) -> np.ndarray:
    """Return the solution's picture faintly, with the pixels that are ``counted`` (h, w) bright."""
    red, green, blue = (wanted[..., each].astype(np.int16) for each in range(3))
    heat = FAINT[red + green + blue]
    apart = np.abs(mine[counted].astype(int) - wanted[counted].astype(int))
    heat[counted] = BRIGHT[np.maximum(apart.max(axis=1, initial=0), LEVELS)]
    return np.asarray(heat)


def heat_map(work: Evidence, solution: Evidence) -> np.ndarray:
    """Return three pictures in a row, uint8 (h, w, 3): the student's, the heat, the solution's.

    They are of the frame that differs most. A pixel that counts as different is the brighter the
    more it differs; the others are dark, and show the solution faintly.
    """
    number = max(
        solution.frames, key=lambda each: difference(work.frame(each), solution.frame(each))
    )
    mine, wanted = work.frame(number).picture, solution.frame(number).picture
    if mine.shape == wanted.shape:
        counted = differing(work.frame(number), solution.frame(number))
        parts = [mine, _heat(mine, wanted, counted), wanted]
    else:
        parts = [mine, np.full_like(mine, 255), wanted]

    height = max(part.shape[0] for part in parts)
    white = np.full((height, GAP, 3), 255, np.uint8)
    row = []
    for part in parts:
        below = ((0, height - part.shape[0]), (0, 0), (0, 0))
        row += [np.pad(part, below, constant_values=255), white]
    return np.concatenate(row[:-1], axis=1)
