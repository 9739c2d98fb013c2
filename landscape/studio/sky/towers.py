"""Cumulus clouds as towers: domes upon domes over a flat base, in the sky of the preset 2006."""

import numpy as np

from landscape.studio.sky.cumulus import HALF
from landscape.studio.sky.scatter import Place, coverage, scattered

# Lengths are in metres.
SEED = 849  # chosen by eye: clouds on every side, and none over the sun at noon or at sunset
CLEARING = 3100.0  # chosen: radius without clouds; nearer ones would fill the view
# Chosen: least width, greatest width and number of placement attempts of three sizes of cloud.
SIZES = ((1700.0, 3200.0, 44), (700.0, 1600.0, 170), (280.0, 650.0, 480))


def _cloud_spheres(rng: np.random.Generator, x: float, z: float, width: float) -> list[list[float]]:
    """Return the spheres of one cloud: x, height of the centre above the base, z, radius."""
    turn, stretch = rng.uniform(0.0, np.pi), rng.uniform(1.0, 1.9)
    tall = min(0.65 * width, 21.0 * width**0.5, 1000.0) * rng.uniform(0.65, 1.1)
    peak = rng.uniform(-0.7, 0.7)  # off centre, or every cloud would be a pyramid
    spheres = []
    for tower in range(int(7 + width / 100.0)):
        # The first towers form a core that connects the others; some stand at its edge.
        distance, angle = rng.random() ** 0.65, rng.uniform(0.0, 2.0 * np.pi)
        distance = (
            0.4 * distance if tower < 4 else 0.95 + 0.35 * distance if tower % 5 == 4 else distance
        )
        along, across = np.cos(angle) * distance * stretch, np.sin(angle) * distance / stretch
        u = x + 0.5 * width * (along * np.cos(turn) - across * np.sin(turn))
        v = z + 0.5 * width * (along * np.sin(turn) + across * np.cos(turn))
        radius = min(width * rng.uniform(0.10, 0.20), 330.0) * (1.2 - 0.55 * distance)
        radius = max(75.0, radius)
        lower = min(1.0, np.hypot(along - peak, across)) ** 2
        top = tall * (1.0 - 0.6 * lower) * rng.uniform(0.45, 1.0)
        top = min(top, 4.5 * radius)  # or narrow towers would be spikes
        up = 0.25 * radius
        while True:
            r = radius * rng.uniform(0.8, 1.15)
            spheres.append([u, up, v, r])
            up += 0.8 * r
            if up + 0.6 * r > top:
                break
            u, v = u + rng.normal(0.12, 0.22) * r, v + rng.normal(0.0, 0.22) * r

    parents = list(spheres)
    for children in (6, 4):
        born = []
        for u, up, v, r in parents:
            for _ in range(children):
                d = rng.normal(size=3)
                d /= np.linalg.norm(d)
                small = r * rng.uniform(0.35, 0.6)
                if small > 45.0 and d[1] > -0.25:
                    reach = r * rng.uniform(0.72, 0.95)
                    born.append([u + d[0] * reach, up + d[1] * reach, v + d[2] * reach, small])
        spheres += born
        parents = born

    return spheres


def all_spheres() -> np.ndarray:
    """Return the spheres of all clouds, (n, 4)."""
    rng, cover = np.random.default_rng(SEED), coverage(SEED)
    spheres: list[list[float]] = []
    taken: list[Place] = []

    def suits(x: float, z: float, width: float, covered: float) -> bool:
        """Return whether a cloud may be there; small ones near the eye would look like crumbs."""
        clear = 2.0 * CLEARING if width < 700.0 else CLEARING + 0.55 * width
        return bool(np.hypot(x, z) >= clear and covered >= rng.uniform(-0.3, 1.5))

    for low, high, count in SIZES:
        for x, z, width in scattered(rng, cover, (low, high), count, taken, suits, room):
            # A generator per cloud, so that a change to one cloud leaves the others as they are.
            shape = np.random.default_rng([SEED, len(taken)])
            distance = float(np.hypot(x, z))
            spheres += _cloud_spheres(shape, x, z, width * (1.0 - 0.3 * distance / HALF))
    return np.array(spheres)


def room(width: float) -> float:
    """Return how far apart clouds are; wide ones keep a distance, small ones may merge."""
    return 0.42 if width > 700.0 else 0.0
