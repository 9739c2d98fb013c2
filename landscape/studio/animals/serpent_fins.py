"""Spines and membranes of the dragon of the preset `best`.

A fin is a row of spines, each a curve that grows thin; a membrane hangs between each two of them
and is a little slack. The membrane is a sheet without thickness. Its ragged edge, its veins and
where light comes through are in the texture.
"""

from dataclasses import dataclass

import numpy as np

from landscape.elements.best.animals.serpent_skin import BONE, FIN_RAYS, laid
from landscape.studio.animals.serpent_paint import BONE_STRIP, FIN_STRIP

POINTS = 5  # chosen: points along a spine
SLACK = 0.10  # chosen: how far a membrane sags, in distances between spines
SPACING = 0.052  # chosen: distance between two spines of the crest along the back
DEEPEST = -0.16  # chosen: the height under which the crest is not seen, and ends
SEED = 48
HORN_COLOUR = (118, 104, 80)  # chosen, of bone, as the spines'; the texture multiplies it
SPINE_COLOUR = (76, 74, 62)
TOOTH_COLOUR = (176, 164, 134)


@dataclass(frozen=True)
class Part:
    """Vertices (n, 3), faces (m, 3), colours uint8 (n, 3), texture coordinates (n, 2)."""

    vertices: np.ndarray
    faces: np.ndarray
    colours: np.ndarray
    coordinates: np.ndarray


def joined(parts: list[Part]) -> Part:
    """Return parts as one."""
    starts = np.cumsum([0, *(len(part.vertices) for part in parts[:-1])])
    faces = [part.faces + start for part, start in zip(parts, starts, strict=True)]
    return Part(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate(faces),
        np.concatenate([part.colours for part in parts]),
        np.concatenate([part.coordinates for part in parts]),
    )


def swept(
    path: np.ndarray,
    thick: np.ndarray,
    sides: int,
    share: tuple[float, float],
    colour: tuple[int, int, int],
) -> Part:
    """Return a closed tube of radii ``thick`` (k,) about ``path`` (k, 3), of bone.

    ``share`` is the part of the texture of bone, 0..1, that lies along it.
    """
    tangent = np.gradient(path, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    helper = np.array([0.0, 0.0, 1.0]) if abs(tangent[0, 2]) < 0.8 else np.array([1.0, 0.0, 0.0])
    one = np.cross(tangent, helper)
    one /= np.linalg.norm(one, axis=1)[:, None]
    other = np.cross(tangent, one)
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = np.cos(angle)[:, None] * one[:, None] + np.sin(angle)[:, None] * other[:, None]
    count = len(path)
    vertices = (path[:, None] + thick[:, None, None] * ring).reshape(-1, 3)
    vertices = np.concatenate([vertices, path[:1], path[-1:]])

    k, j = np.meshgrid(np.arange(count - 1), np.arange(sides), indexing="ij")
    a, b = (k * sides + j).ravel(), (k * sides + (j + 1) % sides).ravel()
    c, d = a + sides, b + sides
    foot, tip = count * sides, count * sides + 1
    first = np.arange(sides)
    following = (first + 1) % sides
    last = (count - 1) * sides
    faces = np.concatenate(
        [
            np.stack([a, b, d], axis=1),
            np.stack([a, d, c], axis=1),
            np.stack([np.full(sides, foot), following, first], axis=1),
            np.stack([np.full(sides, tip), last + first, last + following], axis=1),
        ]
    )
    along = np.repeat(np.linspace(0.0, 1.0, count), sides)
    around = np.tile(np.abs(1.0 - 2.0 * np.arange(sides) / sides), count)
    s = np.concatenate([along, [0.0, 1.0]])
    places = np.stack(
        [
            BONE[0] + (share[0] + (share[1] - share[0]) * s) * (BONE[1] - BONE[0]),
            np.append(around, [0.5, 0.5]),
        ],
        axis=1,
    )
    strip = np.full(len(vertices), BONE_STRIP)
    shade = (0.62 + 0.38 * s)[:, None]
    colours = np.rint(np.array(colour) * shade).astype(np.uint8)
    return Part(vertices, faces[:, ::-1], colours, laid(strip, places))


@dataclass(frozen=True)
class Fin:
    """Spines (n, POINTS, 3) and their radii at the root (n,); ``tint`` multiplies the membrane."""

    rays: np.ndarray
    thick: np.ndarray
    tint: tuple[float, float, float] = (1.0, 1.0, 1.0)

    def spines(self) -> list[Part]:
        """Return the spines, closed tubes."""
        taper = np.linspace(1.0, 0.08, POINTS)
        return [
            swept(ray, thick * taper, 5, (0.45, 0.75), SPINE_COLOUR)
            for ray, thick in zip(self.rays, self.thick, strict=True)
        ]

    def membrane(self) -> Part:
        """Return the membrane between the spines, two strips of quads between each two."""
        rows = []
        for k in range(len(self.rays) - 1):
            one, next_one = self.rays[k], self.rays[k + 1]
            middle = 0.5 * (one + next_one)
            across = np.cross(next_one - one, np.gradient(one, axis=0))
            across /= np.maximum(np.linalg.norm(across, axis=1)[:, None], 1e-9)
            gap = np.linalg.norm(next_one - one, axis=1)[:, None]
            rows += [one, middle + SLACK * (1 if k % 2 else -1) * gap * across]
        rows.append(self.rays[-1])
        grid = np.array(rows)
        columns, points = grid.shape[:2]
        s, t = np.meshgrid(np.arange(columns) / 2.0, np.linspace(0, 1, points), indexing="ij")
        column, row = np.meshgrid(np.arange(columns - 1), np.arange(points - 1), indexing="ij")
        a = (column * points + row).ravel()
        b, c, d = a + points, a + 1, a + points + 1
        faces = np.concatenate([np.stack([a, b, d], axis=1), np.stack([a, d, c], axis=1)])
        places = np.stack([s.ravel() / FIN_RAYS, t.ravel()], axis=1)
        strip = np.full(len(places), FIN_STRIP)
        colour = np.rint(255 * np.array(self.tint)).astype(np.uint8)
        colours = np.tile(colour, (len(places), 1))
        return Part(grid.reshape(-1, 3), faces, colours, laid(strip, places))


def _arc(foot: np.ndarray, direction: np.ndarray, bend: np.ndarray, length: float) -> np.ndarray:
    """Return a spine (POINTS, 3) from ``foot``, bent towards ``bend``."""
    t = np.linspace(0.0, 1.0, POINTS)[:, None]
    return np.asarray(foot + length * (t * direction + 0.28 * t * t * bend))


def _spine(
    row: np.ndarray, foot: np.ndarray, generator: np.random.Generator
) -> tuple[np.ndarray, float]:
    """Return a spine of the back (POINTS, 3) and how thick it is; it stands at ``foot`` (3,).

    ``row`` is the curve's there.
    """
    radius, back, side = row[3], row[5:8], row[8:11]
    rise = np.clip((foot[1] - DEEPEST) / 0.40, 0.0, 1.0)
    tall = (0.045 + 0.95 * radius) * (0.30 + 0.70 * rise**0.8)
    tall *= min(1.0, 0.30 + row[12] / 0.22)
    tall *= generator.uniform(0.86, 1.10) * (0.62 if generator.random() < 0.07 else 1.0)

    tangent = np.cross(back, side)
    lean = 0.62 + 0.10 * generator.normal()
    sway = side * 0.10 * generator.normal()
    direction = np.cos(lean) * back - np.sin(lean) * tangent + sway
    return _arc(foot, direction, -tangent, tall), 0.0048 + 0.020 * radius


def crest(curve: np.ndarray) -> list[Fin]:
    """Return the fins along the back: one on each arch and one on the neck."""
    generator = np.random.default_rng(SEED)
    along = curve[:, 11]
    rim = curve[:, :3] + 1.2 * curve[:, 3:4] * curve[:, 5:8]
    walked = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(rim, axis=0), axis=1)))
    at = np.interp(np.arange(0.0, walked[-1], SPACING), walked, np.arange(len(curve)))

    # A fin ends where the back is under water.
    fins: list[list[tuple[np.ndarray, float]]] = [[]]
    for place in at:
        i = int(place)
        row = curve[min(i + 1, len(curve) - 1)] * (place - i) + curve[i] * (1 - place + i)
        foot = row[:3] + 0.93 * row[3] * row[5:8]
        if foot[1] > DEEPEST and along[i] > 0.14 and row[12] > 0.03:
            fins[-1].append(_spine(row, foot, generator))
        elif fins[-1]:
            fins.append([])

    return [
        Fin(np.array([ray for ray, _ in fin]), np.array([thick for _, thick in fin]))
        for fin in fins
        if len(fin) > 2
    ]


def fluke(curve: np.ndarray) -> Fin:
    """Return the fin of the tail: a fan, forked, in the plane of the body's curve."""
    generator = np.random.default_rng(SEED + 1)
    row = curve[0]
    back, side = row[5:8], row[8:11]
    out = -np.cross(back, side)
    rays, thick = [], []
    for phi in np.linspace(-1.28, 1.28, 19):
        edge = abs(phi) / 1.28
        length = 0.145 + 0.17 * edge**1.3 - 0.05 * edge**8
        length *= generator.uniform(0.94, 1.05)
        direction = np.cos(phi) * out + np.sin(phi) * back + 0.10 * generator.normal() * side
        foot = row[:3] - 0.075 * out + 0.034 * np.sin(phi) * back
        bend = out + 0.4 * side * np.sin(2.0 * phi)
        rays.append(_arc(foot, direction, 0.9 * bend, length + 0.06))
        thick.append(0.0030 + 0.0058 * edge**3)
    return Fin(np.array(rays), np.array(thick))


def ears() -> list[Fin]:
    """Return the two fins behind the jaw, in head space."""
    fins = []
    for side in (1.0, -1.0):
        rays = []
        for k, tilt in enumerate(np.linspace(-0.75, 0.95, 8)):
            length = (0.12, 0.15, 0.185, 0.19, 0.20, 0.185, 0.16, 0.12)[k]
            direction = np.array([-0.86 * np.cos(tilt), np.sin(tilt), 0.50 * side])
            foot = np.array([0.005, -0.012 + 0.030 * np.sin(tilt), 0.080 * side])
            rays.append(_arc(foot, direction, np.array([-0.5, 0.0, -0.25 * side]), length))
        fins.append(Fin(np.array(rays), np.full(8, 0.0062)))
    return fins
