"""Erosion of a height field: rivers, landslides and rain drops.

Rivers cut by the implicit stream power law of Braun and Willett (2013), with the drainage network
from a priority flood (Barnes et al. 2014), as in Cordonnier et al. (2016). Slopes beyond the angle
of repose slide (Musgrave et al. 1989). Rain drops carve the small gullies (Beyer 2015). Arrays are
[z, x], and are modified in place.
"""

import heapq
import math

import numpy as np
from numba import njit


@njit(cache=True)
def _drain(h: np.ndarray, order: np.ndarray, receiver: np.ndarray) -> None:
    """Compute the drainage by a priority flood, so that every cell drains to the border.

    ``order`` receives the cells from the border inward, ``receiver`` the cell that each drains to.
    """
    n = h.shape[0]
    flat = h.ravel()
    seen = np.zeros(n * n, np.bool_)
    heap = [(flat[0], 0)]
    heap.pop()
    for p in range(n * n):
        row, column = p // n, p % n
        if row == 0 or column == 0 or row == n - 1 or column == n - 1:
            heapq.heappush(heap, (flat[p], p))
            seen[p] = True
            receiver[p] = p

    count = 0
    while len(heap) > 0:
        level, p = heapq.heappop(heap)
        order[count] = p
        count += 1
        row, column = p // n, p % n
        steepest = 0.0
        for dj in range(-1, 2):
            for di in range(-1, 2):
                a, b = row + dj, column + di
                if (dj == 0 and di == 0) or a < 0 or b < 0 or a >= n or b >= n:
                    continue
                q = a * n + b
                if not seen[q]:
                    seen[q] = True
                    receiver[q] = p
                    heapq.heappush(heap, (max(flat[q], level + 1e-7), q))
                elif receiver[p] != p:
                    slope = (flat[p] - flat[q]) / math.sqrt(dj * dj + di * di)
                    if slope > steepest and flat[receiver[p]] < flat[p]:
                        steepest = slope
                        receiver[p] = q


@njit(cache=True)
def rivers(
    h: np.ndarray, low: np.ndarray, uplift: np.ndarray, power: np.ndarray, cell: float, steps: int
) -> np.ndarray:
    """Raise ``h`` (n, n) by ``uplift`` and erode it by rivers of strength ``power``, in place.

    Each step solves dh/dt = uplift - power * area**0.5 * slope implicitly, from the sea upward. No
    cell is cut below ``low``. Returns the drainage area (n, n) of each cell.
    """
    n = h.shape[0]
    flat = h.ravel()
    bound = low.ravel()
    rise = uplift.ravel()
    k = power.ravel()
    order, receiver = np.empty(n * n, np.int64), np.empty(n * n, np.int64)
    area = np.empty(n * n)
    for _ in range(steps):
        _drain(h, order, receiver)
        area[:] = cell * cell
        for c in range(n * n - 1, -1, -1):
            p = order[c]
            if receiver[p] != p:
                area[receiver[p]] += area[p]
        for c in range(n * n):
            p = order[c]
            q = receiver[p]
            if q != p and flat[p] > bound[p]:
                flat[p] += rise[p]
                across = p // n != q // n and p % n != q % n
                f = k[p] * math.sqrt(area[p]) / (cell * (1.4142 if across else 1.0))
                cut = (flat[p] + f * flat[q]) / (1.0 + f)
                flat[p] = max(bound[p], min(flat[p], cut))
        for _slide in range(2):
            slide_once(h, 1.2 * cell)

    return area.reshape(n, n)


@njit(cache=True)
def slide_once(h: np.ndarray, repose: float) -> None:
    """Reduce height differences beyond ``repose`` between neighbours by a fifth, in place."""
    n = h.shape[0]
    change = np.zeros_like(h)
    for j in range(n):
        for i in range(n):
            for dj, di in ((0, 1), (1, 0), (1, 1), (1, -1)):
                a, b = j + dj, i + di
                if a >= n or b >= n or b < 0:
                    continue
                limit = repose * (1.4142 if dj and di else 1.0)
                drop = h[j, i] - h[a, b]
                if drop > limit:
                    change[j, i] -= 0.1 * (drop - limit)
                    change[a, b] += 0.1 * (drop - limit)
                elif drop < -limit:
                    change[j, i] -= 0.1 * (drop + limit)
                    change[a, b] += 0.1 * (drop + limit)
    h += change


@njit(cache=True)
def rain(
    h: np.ndarray, drops: int, rng: np.random.Generator, radius: int, sea: float
) -> np.ndarray:
    """Erode and fill ``h`` (n, n) by rain drops, in place; return the water that passed each cell.

    The parameters are Beyer's (inertia 0.05, erosion 0.3, evaporation 0.01, gravity 4), except that
    deposition is 0.1: his 0.3 fills the valleys that the rivers have cut. The brush is centred on
    the drop and not on its cell, because a bias of half a cell erodes one side of every ridge more
    than the other.
    """
    n = h.shape[0]
    passes = np.zeros((n, n))
    for _ in range(drops):
        x, z = rng.random() * (n - 2), rng.random() * (n - 2)
        if h[int(z), int(x)] < sea:
            continue
        dx = 0.0
        dz = 0.0
        speed = 1.0
        water = 1.0
        load = 0.0
        for _life in range(60):
            i, j = int(x), int(z)
            u, v = x - i, z - j
            a = h[j, i]
            b = h[j, i + 1]
            c = h[j + 1, i]
            d = h[j + 1, i + 1]
            here = (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v
            dx = dx * 0.05 - ((b - a) * (1 - v) + (d - c) * v) * 0.95
            dz = dz * 0.05 - ((c - a) * (1 - u) + (d - b) * u) * 0.95
            length = math.hypot(dx, dz)
            if length < 1e-9:
                break
            dx, dz = dx / length, dz / length
            x, z = x + dx, z + dz
            if x < 1 or z < 1 or x >= n - 2 or z >= n - 2:
                break
            i2, j2 = int(x), int(z)
            s, t = x - i2, z - j2
            there = (h[j2, i2] * (1 - s) + h[j2, i2 + 1] * s) * (1 - t) + (
                h[j2 + 1, i2] * (1 - s) + h[j2 + 1, i2 + 1] * s
            ) * t
            rise = there - here
            passes[j, i] += water
            capacity = max(-rise, 0.0008) * speed * water * 4.0
            if load > capacity or rise > 0.0:
                deposited = min(rise, load) if rise > 0.0 else (load - capacity) * 0.1
                load -= deposited
                h[j, i] += deposited * (1 - u) * (1 - v)
                h[j, i + 1] += deposited * u * (1 - v)
                h[j + 1, i] += deposited * (1 - u) * v
                h[j + 1, i + 1] += deposited * u * v
            else:
                eroded = min((capacity - load) * 0.3, -rise)
                load += eroded
                total = 0.0
                for phase in range(2):
                    for bj in range(-radius, radius + 2):
                        for bi in range(-radius, radius + 2):
                            weight = radius - math.hypot(bi - u, bj - v)
                            if weight > 0 and 0 <= j + bj < n and 0 <= i + bi < n:
                                if phase == 0:
                                    total += weight
                                else:
                                    h[j + bj, i + bi] -= eroded * weight / total
            if there < sea:
                break
            speed = math.sqrt(max(0.0, speed * speed - rise * 4.0))
            water *= 0.99

    return passes
