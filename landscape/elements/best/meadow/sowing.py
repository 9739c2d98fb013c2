"""What is sown in the meadow: where tufts stand, and the random numbers of tufts and blades.

To draw random numbers takes a tenth of the time of computing shapes and tints from them (see
shapes.py), so a layer of a cell is sown as a whole, and of it takes shape what is seen. No OpenGL
here.
"""

import numpy as np

from landscape.elements.settings import Grass

OF_TUFTS = ("size", "tone", "hue", "green", "straw", "pale")  # the other lots are the blades'


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


def between(low: float, high: float, lots: np.ndarray) -> np.ndarray:
    """Return random numbers from ``low`` to ``high`` for lots in 0..1."""
    return low + (high - low) * lots
