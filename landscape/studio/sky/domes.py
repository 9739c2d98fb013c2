"""Cumulus clouds as domes side by side on one base, wider than high, in the sky of the preset best.

What is below the base is cut off when the field is marched.
"""

import numpy as np

from landscape.studio.sky.scatter import Place, coverage, scattered

# Lengths are in metres.
SEED = 849  # chosen by eye: clouds on every side
# Chosen: least and greatest width, least and greatest distance from the eye, height over width, and
# number of placement attempts of each kind of cloud: far towers, wide ones, usual ones, shreds.
KINDS = (
    (2600.0, 3400.0, 16e3, 24e3, 0.56, 7),
    (1500.0, 2600.0, 4200.0, 27e3, 0.36, 44),
    (650.0, 1400.0, 3300.0, 27e3, 0.42, 200),
    (240.0, 520.0, 4600.0, 17e3, 0.40, 190),
)
GAP_AZIMUTH_DEG, GAP_DEG = 250.0, 7.0  # the setting sun's direction, and how far it is kept clear


def _lobe(rng: np.random.Generator, x: float, z: float, wide: float, tall: float) -> np.ndarray:
    """Return the spheres (n, 4) of a dome of this radius and height on the base.

    A sphere is x, height of the centre above the base, z, radius. The dome itself is a cap of a
    sphere, or a stack of two if it is a turret; smaller spheres on it make it uneven.
    """
    core = max(wide, 0.5 * (wide * wide / tall + tall)) if tall < wide else wide
    spheres = [(x, tall - core, z, core)]
    if tall > wide:
        spheres.append((x, 0.35 * tall - 0.3 * wide, z, 1.15 * wide))
    for _ in range(11):
        out, angle = wide * np.sqrt(rng.random()), rng.uniform(0.0, 2.0 * np.pi)
        top = tall * np.sqrt(max(0.0, 1.0 - (out / wide) ** 2))
        radius = min(wide, 1.3 * tall) * rng.uniform(0.24, 0.46)
        up = top * rng.uniform(0.70, 1.0) - 0.35 * radius
        spheres.append((x + out * np.cos(angle), up, z + out * np.sin(angle), radius))
    return np.array(spheres)


def _buds(rng: np.random.Generator, parents: np.ndarray, each: int) -> np.ndarray:
    """Return smaller spheres (n, 4) on the upper sides of others, ``each`` on every one."""
    parents = np.repeat(parents, each, axis=0)
    d = rng.normal(size=(len(parents), 3))
    d /= np.linalg.norm(d, axis=1, keepdims=True)
    small = parents[:, 3] * rng.uniform(0.35, 0.58, len(parents))
    reach = parents[:, 3] * rng.uniform(0.74, 0.95, len(parents))
    born = np.concatenate([parents[:, :3] + d * reach[:, None], small[:, None]], axis=1)
    return born[(small > 42.0) & (d[:, 1] > -0.3) & (born[:, 1] > -0.2 * small)]


def cloud_spheres(
    rng: np.random.Generator, x: float, z: float, width: float, tall: float
) -> np.ndarray:
    """Return the spheres (n, 4) of one cloud: domes side by side, the highest off centre."""
    turn, stretch = rng.uniform(0.0, np.pi), rng.uniform(1.05, 1.7)
    crest = rng.uniform(-0.6, 0.6)  # or every cloud would be a pyramid
    lobes = []
    count = 4 + int(width / 260.0)
    for number in range(count):
        along = crest if number == 0 else rng.uniform(-1.0, 1.0)
        across = 0.0 if number == 0 else rng.normal(0.0, 0.5) * np.sqrt(1.0 - along**2)
        wide = 0.5 * width * rng.uniform(0.28, 0.52) * (1.0 - 0.35 * abs(along))
        lower = min(1.0, np.hypot(along - crest, across))
        up = tall * (1.0 if number == 0 else rng.uniform(0.45, 0.95) * (1.0 - 0.6 * lower))
        up = min(max(up, 0.45 * wide), 1.35 * wide)
        u, v = 0.5 * width * along * stretch**0.5, 0.5 * width * across / stretch**0.5
        at = x + u * np.cos(turn) - v * np.sin(turn), z + u * np.sin(turn) + v * np.cos(turn)
        lobes.append(_lobe(rng, *at, wide, up))

    bodies = np.concatenate(lobes)
    first = _buds(rng, bodies[bodies[:, 3] < 0.5 * tall + 200.0], 5)
    return np.concatenate([bodies, first, _buds(rng, first, 4)])


def all_spheres() -> np.ndarray:
    """Return the spheres of all clouds, (n, 4)."""
    rng, cover = np.random.default_rng(SEED), coverage(SEED)
    spheres: list[np.ndarray] = []
    taken: list[Place] = []
    for low, high, nearest, farthest, rise, count in KINDS:

        def suits(
            x: float,
            z: float,
            width: float,
            covered: float,
            nearest: float = nearest,
            farthest: float = farthest,
            rise: float = rise,
        ) -> bool:
            """Return whether a cloud of this kind may be there."""
            distance = float(np.hypot(x, z))
            if not nearest + 0.5 * width < distance < farthest:
                return False
            off = np.degrees(np.arctan2(x, -z)) - GAP_AZIMUTH_DEG
            gap = GAP_DEG + np.degrees(0.5 * width / distance)
            if abs((off + 180.0) % 360.0 - 180.0) < gap:
                return False
            return bool(rise >= 0.5 or covered >= rng.uniform(-0.5, 1.3))

        for x, z, width in scattered(rng, cover, (low, high), count, taken, suits, room):
            # A generator per cloud, so that a change to one cloud leaves the others as they are.
            shape = np.random.default_rng([SEED, len(taken)])
            tall = width * rise * shape.uniform(0.75, 1.2)
            spheres.append(cloud_spheres(shape, x, z, width, tall))
    return np.concatenate(spheres)


def room(width: float) -> float:
    """Return how far apart clouds are; wide ones keep a distance, small ones may merge."""
    return 0.48 if width > 600.0 else 0.25
