"""What water mirrors: the land, as an eye sees it that is as far below the water as the eye above.

A ray that meets the water goes on upwards as if it came from that eye, in the same column of the
screen. So the heights that were looked up for the columns serve again (:mod:`.march`): projected
for the eye below, they say which step each row of the mirror image shows.

Of the land, only what is behind the water counts. So each water that a column crosses has a mirror
image of its own: that of the land from its near shore on.
"""

from dataclasses import dataclass

import numpy as np

from landscape.flyover import march

ACROSS = 4  # columns of the picture for each column of the mirror image, chosen
DOWN = 2.0  # rows of the picture for each of its rows, chosen
WATERS = 3  # that a column crosses and that have mirror images; those beyond share the last, chosen
STEEPEST = 2.0  # rise of rays that may meet land, chosen: steeper ones meet the sky
LOW = 0.01  # height of land that water does not mirror, chosen


@dataclass(frozen=True)
class Reflection:
    """Mirror images of land: which step their rows show, int16 (waters, rows, columns / ACROSS).

    It is the number of steps where there is none. Row 0 is for rays that rise by ``steepest``, and
    each row for ``step`` less. ``water`` int32 (steps, columns / ACROSS) says where each step's
    image begins among all of them. ``lift`` is how far the eye is above the one below the water.
    """

    filled: np.ndarray
    water: np.ndarray
    steepest: float
    step: float
    lift: float

    def seen(self, step: np.ndarray, column: np.ndarray, up: np.ndarray) -> np.ndarray:
        """Return the step that rays (n,) show which rise by ``up`` from water at a step."""
        _, rows, columns = self.filled.shape
        row = up * np.float32(-1 / self.step)
        row += np.float32(self.steepest / self.step + 0.5)
        np.maximum(row, 0, out=row)
        np.minimum(row, rows - 1, out=row)
        at = row.astype(np.int32)
        at *= columns
        column = column // ACROSS
        at += column
        place = step * columns
        place += column
        at += self.water.ravel().take(place, mode="clip")
        found = self.filled.ravel().take(at)
        # What is steeper than the first row is sky.
        found[up > self.steepest] = np.iinfo(np.int16).max
        return found


def reflection(
    heights: np.ndarray, distances: np.ndarray, above: float, steepest: float, pixel: float
) -> Reflection | None:
    """Return what water mirrors of the land; None if there is no water.

    ``heights`` (steps, columns) are above the eye, which is ``above`` the water; ``distances``
    (steps,) are those of the steps. Rays rise by ``steepest`` at most, and by ``pixel`` less from
    row to row of the picture.
    """
    land = heights[:, ::ACROSS] + np.float32(above)
    wet = land <= LOW

    begins = wet.copy()
    begins[1:] &= ~wet[:-1]
    number = begins.astype(np.int8)
    for before, after in zip(number[:-1], number[1:], strict=True):
        after += before
    count = min(int(number[-1].max(initial=0)), WATERS)
    if not count:
        return None

    np.minimum(number, WATERS, out=number)
    steepest, step = min(steepest, STEEPEST), DOWN * pixel
    rows = int(steepest / step) + 1
    land += np.float32(above)
    land /= distances[:, None]
    land *= np.float32(-1 / step)
    land += np.float32(steepest / step + 0.5)
    np.putmask(land, wet, rows)

    filled = np.empty((count, rows, land.shape[1]), np.int16)
    for water in range(count):
        np.putmask(land, number == water, rows)
        filled[water] = march.filled_by(land.copy(), rows)

    begin = np.maximum(number, 1).astype(np.int32)
    begin -= 1
    begin *= rows * land.shape[1]
    return Reflection(filled, begin, steepest, step, 2 * above)
