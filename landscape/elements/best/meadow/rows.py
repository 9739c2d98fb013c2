"""Arrays that grow together: a table to which rows are added at its end. No OpenGL here."""

import numpy as np


class Rows:
    """Named arrays of which the first axis is common: row k of each belongs to one thing.

    Memory for them doubles when it is used up, so that to add a few takes little time.
    """

    def __init__(self, **empty: np.ndarray) -> None:
        """Hold nothing yet, of these types and shapes: arrays (0, ...)."""
        self._arrays = empty
        self.count = 0

    def __getitem__(self, name: str) -> np.ndarray:
        """Return the whole of an array, (count, ...), to read or to write."""
        return self._arrays[name][: self.count]

    def take(self, name: str, which: np.ndarray) -> np.ndarray:
        """Return some rows of an array, (n, ...), as a copy."""
        return self._arrays[name].take(which, axis=0)  # several times as fast as [which]

    def add(self, count: int, **values: np.ndarray) -> None:
        """Add ``count`` rows.

        Arrays for which there are no ``values`` (count, ...) are to be written later.
        """
        first, self.count = self.count, self.count + count
        for name, array in self._arrays.items():
            if self.count > len(array):
                more = np.empty((2 * self.count, *array.shape[1:]), array.dtype)
                more[:first] = array[:first]
                self._arrays[name] = more
        for name, each in values.items():
            self._arrays[name][first : self.count] = each

    def keep(self, which: np.ndarray) -> None:
        """Keep these rows only, in this order."""
        for array in self._arrays.values():
            array[: len(which)] = array.take(which, axis=0)
        self.count = len(which)


def spans(firsts: np.ndarray, counts: np.ndarray) -> np.ndarray:
    """Return the numbers (counts.sum(),) from each of ``firsts`` (n,) on, ``counts`` (n,) of each.

    >>> spans(np.array([7, 20]), np.array([3, 2])).tolist()
    [7, 8, 9, 20, 21]
    """
    before = np.cumsum(counts) - counts
    return np.repeat(firsts - before, counts) + np.arange(int(counts.sum()))
