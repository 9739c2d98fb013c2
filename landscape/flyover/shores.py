"""What water mirrors of the land behind it: how high it rises, seen from the water.

A ray that water mirrors goes up and away. It meets land if it rises less steeply than the land
does, seen from there. That is looked up for some places along each column; between them it hardly
changes. Where between the shore and the highest land the ray ends is told by how steep it is.
"""

from dataclasses import dataclass

import numpy as np

STRIDE = 3  # of so many steps the highest land counts, chosen
PLACES = 2  # of so many of these the first is a place that is looked from, chosen
ACROSS = 4  # of so many columns the first is looked along, chosen
FINE = 1 << 15  # rises for each unit of slope that are told apart
STEEPEST = 60.0  # a slope that counts as upright


@dataclass(frozen=True)
class Shores:
    """For places along columns, (places, columns / ACROSS): the land seen from there.

    ``slope`` is the rise of the steepest line of sight that still meets land, 0 if there is none;
    ``shore`` and ``crest`` are the steps at which land begins, and at which that line ends.
    """

    slope: np.ndarray
    shore: np.ndarray
    crest: np.ndarray


def shores(land: np.ndarray, distances: np.ndarray) -> Shores:
    """Return what is seen of land from the water.

    ``land`` (steps, columns) is how high the land is above the water, 0 where there is water;
    ``distances`` (steps,) are those of the steps.
    """
    count = -(-len(land) // STRIDE)
    rise = np.zeros((count * STRIDE, -(-land.shape[1] // ACROSS)), np.float32)
    rise[: len(land)] = land[:, ::ACROSS]
    rise = rise.reshape(count, STRIDE, -1).max(axis=1)
    away = distances[::STRIDE]
    # Somewhere among so many steps there is land.
    middle = np.minimum(np.arange(count) * STRIDE + STRIDE // 2, len(land) - 1)
    shape = -(-count // PLACES), rise.shape[1]
    slope, shore = np.zeros(shape, np.float32), np.zeros(shape, np.int64)
    crest = np.zeros(shape, np.int64)
    water = (land[::STRIDE, ::ACROSS].min(axis=1) <= 0).tolist()
    index = np.arange(count, dtype=np.int32)[:, None]
    begins = np.where(rise > 0, index, np.int32(count - 1))
    for k in range(count - 2, -1, -1):
        np.minimum(begins[k], begins[k + 1], out=begins[k])
    for place, k in enumerate(range(0, count - 1, PLACES)):
        if not any(water[k : k + 2 * PLACES]):
            continue
        ahead = rise[k + 1 :] * (FINE / (away[k + 1 :] - away[k]))[:, None]
        # Steepness in the upper bits and the step in the lower ones: one maximum finds both.
        np.minimum(ahead, FINE * STEEPEST, out=ahead)
        most = (ahead.astype(np.int32) * 1024 + index[k + 1 :]).max(axis=0)
        slope[place] = (most >> 10) * np.float32(1 / FINE)
        crest[place] = middle.take(most & 1023)
        shore[place] = middle.take(begins[k + 1])
    return Shores(slope, shore, crest)
