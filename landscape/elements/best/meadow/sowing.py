"""What is sown in the meadow: where tufts and blades stand, and the random numbers of each.

To draw random numbers takes a tenth of the time of computing vertices and tints from them (see
growth.py), so a layer of a cell is sown as a whole, and takes shape in those parts that are seen.
No OpenGL here.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from landscape.elements.settings import Grass


class Sown(NamedTuple):
    """The blades of a layer before they have a shape: where they stand, and random numbers.

    ``roots`` (t, 2) are the tufts' places on the map, and ``tuft`` (n,) is each blade's; ``ranges``
    (n,) is how far away each would be drawn. ``lots`` are random numbers in 0..1 by their names,
    (n,) of the blades or (t,) of the tufts; see :func:`lots_of`.
    """

    roots: np.ndarray
    tuft: np.ndarray
    ranges: np.ndarray
    lots: dict[str, np.ndarray]

    def only(self, tufts: np.ndarray) -> "Sown":
        """Return some of the tufts, given by a mask (t,), with their blades."""
        blades = tufts[self.tuft]
        numbers = np.cumsum(tufts) - 1
        lots = {
            name: values[tufts if name in OF_TUFTS else blades]
            for name, values in self.lots.items()
        }
        return Sown(self.roots[tufts], numbers[self.tuft[blades]], self.ranges[blades], lots)


OF_TUFTS = {"size", "tone", "hue", "green", "straw", "pale"}  # the other lots are the blades'


def lots_of(grass: Grass) -> list[str]:
    """Return the names of the random numbers of a layer, in the order in which they are drawn.

    ``angle`` turns a blade, ``outwards`` takes it from the tuft's root; ``height`` and ``size``
    make it taller. ``kind`` chooses a card's picture, ``lean`` bends it; the others colour it.
    """
    names = ["angle"]
    if grass.tufts:
        names.append("outwards")
    if grass.sward:
        names += ["kind", "lean", "size", "height"]
        if grass.tinted:
            names += ["tone", "own_hue", "hue", "brightness"]
        return names
    if grass.fade:
        names += ["height", "size"]
    if grass.tinted:
        names += ["green", "straw", "pale", "brightness"]
    return names


def together(layers: Sequence[Sown]) -> Sown:
    """Return what is sown in several layers as one."""
    if len(layers) == 1:
        return layers[0]
    starts = np.cumsum([0, *(len(layer.roots) for layer in layers[:-1])])
    return Sown(
        np.concatenate([layer.roots for layer in layers]),
        np.concatenate([layer.tuft + start for layer, start in zip(layers, starts, strict=True)]),
        np.concatenate([layer.ranges for layer in layers]),
        {name: np.concatenate([layer.lots[name] for layer in layers]) for name in layers[0].lots},
    )


def between(low: float, high: float, lots: np.ndarray) -> np.ndarray:
    """Return random numbers from ``low`` to ``high`` for lots in 0..1."""
    return low + (high - low) * lots
