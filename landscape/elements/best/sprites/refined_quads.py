"""The quads of the refined sprites as arrays: what the lesson's billboards and crosses lack.

Plants are two or three crossed quads that fade when seen edge-on; crowns and rosettes are flat
(section 11.2). A :class:`Quads` holds what one glDrawElements needs of any of them. Quads are what
is sorted, so each half of a crossed quad can have its own place in the order. The plain forms are
in ``elements/transparent_elements.py``. No OpenGL here.
"""

from dataclasses import dataclass, replace

import numpy as np

from landscape.elements.transparent_elements import crossed_quads, far_to_near


@dataclass(frozen=True)
class Quads:
    """Vertices (v, 3), texture coordinates (v, 2), colours (v, 4) in 0..255; quads as triangles.

    ``triangles`` (n, 6) holds the vertex indices of each quad's two triangles; ``depth`` (n,) is
    its place in the sort.
    """

    vertices: np.ndarray
    coordinates: np.ndarray
    colours: np.ndarray
    triangles: np.ndarray
    depth: np.ndarray

    @staticmethod
    def of(
        vertices: np.ndarray,
        coordinates: np.ndarray,
        colours: np.ndarray,
        pattern: np.ndarray,
        depth: np.ndarray,
    ) -> "Quads":
        """Return the quads ``pattern`` (k, 6) n times, each time over c of the vertices (n, c, 3).

        Coordinates are (n, c, 2), colours (n, 4) or (n, c, 4), depth (n,) or (n, k).
        """
        n, c = vertices.shape[:2]
        each = colours if colours.ndim == 3 else np.repeat(colours[:, None], c, axis=1)
        bases = np.arange(0, n * c, c, dtype=np.uint32)[:, None, None]
        return Quads(
            vertices.reshape(-1, 3),
            coordinates.reshape(-1, 2),
            each.reshape(-1, 4),
            (bases + pattern).reshape(-1, 6),
            depth.ravel() if depth.ndim == 2 else np.repeat(depth, len(pattern)),
        )

    def lit(self, light: np.ndarray) -> "Quads":
        """Return these quads in one light (3,), which multiplies their colours."""
        colours = self.colours.copy()
        colours[:, :3] = colours[:, :3] * light
        return replace(self, colours=colours)

    @staticmethod
    def join(parts: "list[Quads]") -> "Quads":
        """Return all quads of ``parts``, in order."""
        bases = np.cumsum([0, *(len(part.vertices) for part in parts)]).astype(np.uint32)
        return Quads(
            np.concatenate([part.vertices for part in parts]),
            np.concatenate([part.coordinates for part in parts]),
            np.concatenate([part.colours for part in parts]),
            np.concatenate([p.triangles + b for p, b in zip(parts, bases, strict=False)]),
            np.concatenate([part.depth for part in parts]),
        )

    def indices(self, sort: bool) -> np.ndarray:
        """Return the index array (uint32) of all triangles, from far to near if ``sort``."""
        triangles = far_to_near(self.triangles, self.depth) if sort else self.triangles
        return np.ascontiguousarray(triangles.ravel(), np.uint32)


def points_of(quads: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return the points (n, k, 3) at s, t = ``corners`` (n, k, 2) of billboards (n, 4, 3)."""
    low = quads[:, :1]
    points = corners[..., :1] * (quads[:, 1:2] - low)
    points += (1.0 - corners[..., 1:]) * (quads[:, 3:] - low)
    points += low
    return np.asarray(points)


def own_turn(positions: np.ndarray) -> np.ndarray:
    """Return a different angle in radians (n,) for each place (n, 3)."""
    return np.asarray(7.0 * (positions[:, 0] + positions[:, 2]))


def turned(positions: np.ndarray, quads: int) -> np.ndarray:
    """Return the angles (n, k) of a plant's crossed quads, in radians from x to z.

    Two are along x and z; three are at 60 degrees, each plant turned by its own angle.
    """
    own = own_turn(positions) if quads > 2 else np.zeros(len(positions))
    return np.asarray(own[:, None] + np.arange(quads) * (np.pi / quads))


def still_quads(positions: np.ndarray, sizes: np.ndarray, turns: np.ndarray) -> np.ndarray:
    """Return crossed quads of six vertices each, (n, 6 k, 3), at angles ``turns`` (n, k), no wind.

    Two are those of 2006, exactly along x and z.
    """
    count = turns.shape[1]
    if count == 2:
        return crossed_quads(positions, sizes, np.zeros((len(positions), 2), np.float32))
    out = np.repeat(positions[:, None, :], 6 * count, axis=1)
    across = np.array([-0.5, 0.0, 0.5, -0.5, 0.0, 0.5])
    along = (sizes[:, :1, None] * across) * np.ones((1, count, 1))
    out[..., 0] += (np.cos(turns)[..., None] * along).reshape(out.shape[:2])
    out[..., 2] += (np.sin(turns)[..., None] * along).reshape(out.shape[:2])
    for top in range(3, 6 * count, 6):
        out[:, top : top + 3, 1] += sizes[:, 1:]
    return out


def half_places(crossed: np.ndarray) -> np.ndarray:
    """Return the middles (n, 2 k, 3) of the half quads' feet, left and right in turn."""
    n, count = len(crossed), crossed.shape[1] // 6
    quads = crossed.reshape(n, count, 6, 3)
    middles = np.stack([quads[:, :, 0] + quads[:, :, 1], quads[:, :, 1] + quads[:, :, 2]], axis=2)
    return np.asarray(0.5 * middles.reshape(n, 2 * count, 3))


def on_slope(quads: np.ndarray, positions: np.ndarray, slopes: np.ndarray) -> np.ndarray:
    """Return quads (n, k, 3) tilted about their feet at positions (n, 3), as the ground is.

    ``slopes`` (n, 2) = dy/dx, dy/dz. What was along x and z lies in the slope, and what was upright
    is perpendicular to it.
    """
    axes = np.zeros((len(quads), 3, 3), quads.dtype)
    axes[:, 0, 0] = axes[:, 1, 1] = axes[:, 2, 2] = 1.0
    axes[:, 0, 1], axes[:, 2, 1] = slopes.T
    axes[:, 1, 0], axes[:, 1, 2] = -slopes.T
    axes /= np.linalg.norm(axes, axis=2, keepdims=True)
    return np.asarray((quads - positions[:, None]) @ axes + positions[:, None])


def lying(
    positions: np.ndarray, widths: np.ndarray, slopes: np.ndarray, turns: np.ndarray
) -> np.ndarray:
    """Return quads (n, 4, 3) around positions, parallel to the ground of slopes (n, 2).

    ``turns`` (n,) in radians turns each in its plane.
    """
    angle = turns[:, None] + np.pi / 4 + np.arange(4) * (np.pi / 2)
    half = np.stack([np.cos(angle), np.sin(angle)], axis=2)
    half *= (widths * np.sqrt(0.5))[:, None, None]
    rise = (half * slopes[:, None, :]).sum(axis=2)
    return positions[:, None, :] + np.stack([half[..., 0], rise, half[..., 1]], axis=2)


def smoothstep(low: float, high: float, values: np.ndarray) -> np.ndarray:
    """Return 0 up to ``low``, 1 from ``high`` on, and a smooth cubic between."""
    t = np.clip((values - low) / (high - low), 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t))


def edge_on(away: np.ndarray, turns: np.ndarray) -> np.ndarray:
    """Return how visible (n, k) 0..1 the quads at angles ``turns`` are from the eye.

    ``away`` (n, 3) points from the eye to the plant. A quad's normal is (-sin, cos) of its turn:
    its component along the view is 1 face-on and 0 edge-on.
    """
    x, z = away[:, :1], away[:, 2:]
    far = np.sqrt(np.maximum(x * x + z * z, 1e-18))
    facing = np.abs(z * np.cos(turns) - x * np.sin(turns)) / far
    return smoothstep(0.08, 0.4, facing)  # chosen: 5 and 24 degrees
