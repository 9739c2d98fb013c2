"""Where a student's picture differs: both pictures and, between them, the difference as heat."""

import numpy as np

from landscape.course.grader.evidence import Evidence
from landscape.course.grader.grading import LEVELS, difference, differing

HEAT = np.array([(0.13, 0.16, 0.21), (0.85, 0.35, 0.2), (0.95, 0.62, 0.35), (1.0, 1.0, 1.0)])
GAP = 8  # pixels, chosen: between the pictures


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
        levels = np.abs(mine.astype(int) - wanted.astype(int)).max(axis=2)
        counted = differing(work.frame(number), solution.frame(number))
        heat = np.where(counted, np.clip(levels, LEVELS, 255) / 255, 0)
        place = np.linspace(0, 1, len(HEAT))
        middle = np.stack([np.interp(heat, place, HEAT[:, each]) for each in range(3)], axis=2)
        faint = wanted.mean(axis=2, keepdims=True) / 255 * 0.18
        middle = np.where(counted[:, :, None], middle, middle * 0.6 + faint)
        parts = [mine, (middle * 255).astype(np.uint8), wanted]
    else:
        parts = [mine, np.full_like(mine, 255), wanted]

    height = max(part.shape[0] for part in parts)
    white = np.full((height, GAP, 3), 255, np.uint8)
    row = []
    for part in parts:
        below = ((0, height - part.shape[0]), (0, 0), (0, 0))
        row += [np.pad(part, below, constant_values=255), white]
    return np.concatenate(row[:-1], axis=1)
