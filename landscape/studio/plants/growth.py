"""Growth of the trees' skeletons, from the foot to the twigs.

The skeletons of the broad-leaved trees grow by space colonisation (Runions, Lane and Prusinkiewicz
2007, "Modeling trees with a space colonization algorithm") inside a crown made of ellipsoidal
lobes. The spruce is built whorl by whorl, similar to Weber and Penn 1995 ("Creation and rendering
of realistic trees"). Radii follow the pipe model. Coordinates are those of
:mod:`landscape.studio.plants.foliage`.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from landscape.studio.plants.foliage import unit

PIPE_EXPONENT = 2.3  # Runions 2007: values lie between 2 (da Vinci) and 3


@dataclass
class Skeleton:
    """Limbs as a tree of nodes: positions (n, 3) and parent indices (n,), -1 at the foot."""

    points: np.ndarray
    parents: np.ndarray

    def radii(self, twig: float, trunk: float) -> np.ndarray:
        """Return the radii (n,) of the pipe model, from ``twig`` at the tips to ``trunk``."""
        area = np.zeros(len(self.points))
        for i in range(len(self.points) - 1, -1, -1):
            area[i] = max(area[i], 1.0)
            if self.parents[i] >= 0:
                area[self.parents[i]] += area[i]
        r = area ** (1 / PIPE_EXPONENT)
        gamma = np.log(trunk / twig) / np.log(r[0])
        return twig * r**gamma

    def child_counts(self) -> np.ndarray:
        """Return the number of children (n,) of every node."""
        return np.bincount(self.parents[self.parents >= 0], minlength=len(self.points))

    def smooth(self, passes: int) -> None:
        """Move every node with one child towards its neighbours' midpoint, to remove zigzags."""
        counts = self.child_counts()
        child = np.full(len(self.points), -1)
        child[self.parents[1:]] = np.arange(1, len(self.points))
        inner = np.flatnonzero((counts == 1) & (self.parents >= 0))
        for _ in range(passes):
            middle = (self.points[self.parents[inner]] + self.points[child[inner]]) / 2
            self.points[inner] = 0.5 * self.points[inner] + 0.5 * middle


def from_foot(stems: list[np.ndarray]) -> Skeleton:
    """Return the skeleton of stems, polylines (k, 3), that all start at the foot."""
    points, parents = [np.array([0.0, 0.0, 0.0])], [-1]
    for line in stems:
        last = 0
        for point in line:
            points.append(point)
            parents.append(last)
            last = len(points) - 1
    return Skeleton(np.array(points), np.array(parents))


def colonise(
    attractors: np.ndarray, start: Skeleton, step: float, bias: np.ndarray, seed: int
) -> Skeleton:
    """Grow limbs from those of ``start`` towards the attractors (n, 3).

    Each new node is ``step`` from its parent; ``bias`` (3,) is added to its direction.
    """
    rng = np.random.default_rng(seed)
    nodes, origin = start.points, start.parents

    # If every node of a stem could branch, the limbs would look like the teeth of a comb.
    fertile = rng.random(len(nodes)) < 0.4
    fertile[start.child_counts() == 0] = True
    for _ in range(220):
        if len(attractors) == 0:
            break
        able = np.flatnonzero(fertile)
        distance, nearest = cKDTree(nodes[able]).query(attractors)
        nearest = able[nearest]
        near = distance < 17 * step if len(nodes) > len(start.points) + 40 else distance < 1e9
        if not near.any():
            break
        toward = np.zeros_like(nodes)
        offsets = attractors[near] - nodes[nearest[near]]
        np.add.at(toward, nearest[near], offsets / np.linalg.norm(offsets, axis=1, keepdims=True))
        growing = np.unique(nearest[near])
        direction = toward[growing]
        direction /= np.linalg.norm(direction, axis=1, keepdims=True) + 1e-9
        direction += bias + 0.18 * rng.standard_normal(direction.shape)
        direction /= np.linalg.norm(direction, axis=1, keepdims=True)
        fresh = nodes[growing] + step * direction
        # A node between two attractors would grow the same twig forever: drop duplicates.
        free = cKDTree(nodes).query(fresh)[0] > 0.55 * step
        if not free.any():
            break
        nodes = np.concatenate([nodes, fresh[free]])
        origin = np.concatenate([origin, growing[free]])
        fertile = np.concatenate([fertile, np.ones(free.sum(), bool)])
        attractors = attractors[cKDTree(nodes).query(attractors)[0] > 2.0 * step]

    return Skeleton(nodes, origin)


def stem(*points: tuple[float, float, float], step: float = 0.04) -> np.ndarray:
    """Return a polyline (k, 3) through the points with a node about every ``step``."""
    p = np.array(points)
    t = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(p, axis=0), axis=1))])
    s = np.linspace(0.0, t[-1], max(2, round(t[-1] / step) + 1))[1:]
    return np.stack([np.interp(s, t, p[:, k]) for k in range(3)], 1)


def in_lobes(
    centres: np.ndarray, radii: np.ndarray, count: int, rng: np.random.Generator
) -> np.ndarray:
    """Scatter points (count, 3) in ellipsoids (centres and radii (n, 3)), more in larger ones."""
    weight = radii.prod(axis=1) ** 0.8
    lobe = rng.choice(len(centres), count, p=weight / weight.sum())
    direction = rng.standard_normal((count, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    return centres[lobe] + direction * radii[lobe] * rng.random((count, 1)) ** 0.4


def crown_lobes(
    centre: list[float],
    radii: list[float],
    count: int,
    size: tuple[float, float],
    low: float,
    seed: int,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the lobes of a crown, centres and radii (count, 3), spread over an ellipsoid.

    ``low`` is the lowest position on the ellipsoid: -1 is its bottom, 1 its top.
    """
    rng = np.random.default_rng(seed)
    k = np.arange(count) + 0.5
    y = 1.0 - (1.0 - low) * k / count
    angle = np.pi * (1 + 5**0.5) * k + rng.uniform(-0.5, 0.5, count)
    ring = np.sqrt(np.maximum(0.0, 1.0 - y * y))
    shell = np.stack([ring * np.cos(angle), y, ring * np.sin(angle)], 1)
    shell *= rng.uniform(0.68, 0.98, (count, 1))
    r = rng.uniform(*size, (count, 1)) * np.array([1.15, 0.8, 1.1])
    return np.array(centre) + shell * np.array(radii), r


def hang_twigs(
    skeleton: Skeleton,
    tips: np.ndarray,
    steps: tuple[int, int],
    step: float,
    rng: np.random.Generator,
) -> Skeleton:
    """Add a hanging twig to each of the nodes ``tips``; ``steps`` is its (least, most) nodes."""
    points, parents = list(skeleton.points), list(skeleton.parents)
    for tip in tips:
        direction = unit(skeleton.points[tip] - skeleton.points[skeleton.parents[tip]])
        last = tip
        for _ in range(rng.integers(*steps)):
            direction = unit(
                direction + np.array([0.0, -0.33, 0.0]) + 0.12 * rng.standard_normal(3)
            )
            points.append(points[last] + step * direction)
            parents.append(last)
            last = len(points) - 1

    return Skeleton(np.array(points), np.array(parents))


def spruce_limbs(rng: np.random.Generator) -> tuple[Skeleton, np.ndarray]:
    """Return the spruce's trunk, whorls and hanging twigs, and the nodes (k,) that bear needles."""
    points = [np.zeros(3)]
    parents = [-1]
    twigs = []

    def grow(
        start: int, direction: np.ndarray, length: float, step: float, bend: float, green: bool
    ) -> list[int]:
        made = []
        last = start
        for k in range(max(2, round(length / step))):
            lift = bend * (k * step / length - 0.35)
            # Keep the lowest boughs above the ground.
            lift += 5.0 * max(0.0, 0.21 - points[last][1]) / length
            direction = unit(
                direction
                + np.array([0.0, lift * step / length * 2, 0.0])
                + 0.05 * rng.standard_normal(3)
            )
            points.append(points[last] + step * direction)
            parents.append(last)
            last = len(points) - 1
            made.append(last)
            if green:
                twigs.append(last)

        return made

    trunk = [0]
    for y in np.arange(0.02, 2.0, 0.02):
        points.append(np.array([0.012 * np.sin(3 * y), y, 0.0]))
        parents.append(trunk[-1])
        trunk.append(len(points) - 1)
    y = 0.27
    while y < 1.92:
        fraction = (y - 0.27) / 1.69
        reach = 0.86 * (1 - fraction) ** 0.92 * min(1.0, 0.62 + 2.2 * fraction) + 0.018
        turn = rng.uniform(0, 2 * np.pi)
        count = 7 if y < 1.5 else 5
        for k in range(count):
            angle = turn + 2 * np.pi * (k + rng.uniform(-0.3, 0.3)) / count
            length = reach * rng.uniform(0.72, 1.12)
            slope = -0.36 + 1.25 * fraction**1.6 + rng.uniform(-0.1, 0.1)
            direction = unit(np.array([np.cos(angle), slope, np.sin(angle)]))
            node = trunk[min(len(trunk) - 1, int((y + rng.uniform(-0.015, 0.015)) / 0.02))]
            branch = grow(node, direction, length, 0.03, 0.7, False)
            for j, at in enumerate(branch):
                if j * 0.03 > 0.1 * length:
                    twigs.append(at)
                side_length = 0.36 * length * (1 - j / len(branch)) ** 0.7 + 0.03
                if j * 0.03 < 0.12 * length:
                    continue
                run = unit(points[at] - points[parents[at]])
                flat = unit(np.cross(run, np.array([0.0, 1.0, 0.0])))
                for side in (-1, 1):
                    out = unit(run * 0.8 + side * flat + np.array([0.0, -0.25, 0.0]))
                    grow(at, out, side_length * rng.uniform(0.7, 1.2), 0.026, -0.5, True)
        y += 0.052 + 0.03 * (1 - fraction) * rng.uniform(0.7, 1.3)
    return Skeleton(np.array(points), np.array(parents)), np.array(twigs + trunk[-9:])
