"""Where things stand: places found in the heights, so that any height image has them. No OpenGL."""

import numpy as np

STEP = 4  # columns, chosen: sites are looked for on a grid this coarse


def _coarse(field: np.ndarray) -> np.ndarray:
    """Return every STEP-th value of an array (n, n) along both axes."""
    return field[::STEP, ::STEP]


def window_ends(field: np.ndarray, reach: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the least and greatest values (m, m) within ``reach`` cells of each cell (m, m)."""
    padded = np.pad(field, reach, mode="edge")
    width = 2 * reach + 1
    along = np.lib.stride_tricks.sliding_window_view(padded, width, axis=0)
    low, high = along.min(axis=-1), along.max(axis=-1)
    across = np.lib.stride_tricks.sliding_window_view
    return across(low, width, axis=1).min(axis=-1), across(high, width, axis=1).max(axis=-1)


def level_site(
    tops: np.ndarray,
    reach: int,
    lowest: int,
    taken: list[tuple[int, int, int]],
    high: float = 0.0,
) -> tuple[int, int] | None:
    """Return the column x, z with the most level land within ``reach`` columns; None without land.

    All of it must be at ``lowest`` or above. ``taken`` holds x, z and reach of other sites, to keep
    off. ``high`` says how much a block of height makes up for one of unevenness.
    """
    low, top = window_ends(_coarse(tops).astype(np.float64), max(1, reach // STEP))
    x, z = np.meshgrid(*(np.arange(side) * STEP for side in low.shape), indexing="ij")
    fits = (low >= lowest) & (np.minimum(x, z) >= reach)
    fits &= np.maximum(x, z) < len(tops) - reach
    for at_x, at_z, keep in taken:
        fits &= np.maximum(abs(x - at_x), abs(z - at_z)) > keep + reach
    if not fits.any():
        return None
    cost = np.where(fits, (top - low) - high * low, np.inf)
    i, k = np.unravel_index(int(cost.argmin()), cost.shape)
    return int(i) * STEP, int(k) * STEP


def _sums(values: np.ndarray, width: int) -> np.ndarray:
    """Return the sums (n, m) of the squares of ``width``, odd, around each of the values (n, m)."""
    padded = np.pad(values, width // 2)
    total = np.pad(padded.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
    count = total[width:, width:] - total[:-width, width:]
    return np.asarray(count - total[width:, :-width] + total[:-width, :-width])


def bay_site(tops: np.ndarray, sea: int, reach: int, around: int) -> tuple[int, int] | None:
    """Return the column x, z in the sea with the most land around it; None without such a place.

    Within ``reach`` columns there is only water; land is counted within ``around`` columns.
    """
    land = _coarse(tops >= sea).astype(np.float64)
    _, any_land = window_ends(land, max(1, reach // STEP))
    count = np.where(any_land == 0, _sums(land, 2 * max(1, around // STEP) + 1), -1.0)
    border = max(1, reach // STEP)
    count[:border], count[-border:], count[:, :border], count[:, -border:] = -1, -1, -1, -1
    if count.max() <= 0:
        return None
    i, k = np.unravel_index(int(count.argmax()), count.shape)
    return int(i) * STEP, int(k) * STEP
