"""What the pool's surface throws on pillars, walls and vault: how much, and on which meshes.

The surface is a mirror that the waves tilt to and fro: it spreads the sun's light around the
direction in which calm water would mirror it. No OpenGL here.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from landscape.geometry.mesh import Mesh, merged
from landscape.hall import architecture, plan
from landscape.hall.levels import LEVELS, bay_of, levels_of
from landscape.hall.materials import MATERIALS
from landscape.hall.surfaces import Surface, at, coarser, mesh

LIT = ("wall", "alcove", "stone", "vault")  # materials that face the pool
STEP = 0.06  # chosen: units between vertices of what is lit
SPREAD = 3.0  # chosen: exponent of the cosine around the mirrored sun
ALL_AROUND = 0.16  # chosen: light in all directions, beside the mirrored sun's
GREATEST = 0.8  # chosen: the most light
LEAST = 0.055  # chosen: subtracted from the light, so that it ends without an edge
GLOW = (1.0, 0.93, 0.74)  # chosen: RGB


def pool_points() -> np.ndarray:
    """Return points all over the pool's surface, (n, 3)."""
    pool = plan.POOL
    x, z = np.meshgrid(
        np.linspace(pool.west, pool.east, 5)[:-1] + (pool.east - pool.west) / 8,
        np.linspace(pool.north, pool.south, 7)[:-1] + (pool.south - pool.north) / 12,
    )
    return np.stack([x, np.full_like(x, plan.POOL_WATER), z], axis=-1).reshape(-1, 3)


def thrown(points: np.ndarray, normals: np.ndarray, towards: np.ndarray) -> np.ndarray:
    """Return 0..1, (n,): the pool's light on surfaces at points (n, 3) with normals (n, 3).

    ``towards`` (3,) points to the sun.
    """
    mirrored = np.array([-towards[0], towards[1], -towards[2]])
    total = np.zeros(len(points))
    sources = pool_points()
    area = (plan.POOL.east - plan.POOL.west) * (plan.POOL.south - plan.POOL.north) / len(sources)
    for source in sources:
        way = points - source
        distance = np.maximum(np.linalg.norm(way, axis=1), 0.05)
        along = way / distance[:, None]
        met = np.maximum(-(along * normals).sum(axis=1), 0.0)
        left = np.maximum(along[:, 1], 0.0)
        shine = ALL_AROUND + np.maximum(along @ mirrored, 0.0) ** SPREAD
        total += area * met * (0.3 + 0.7 * left) * shine / distance**2 * (along[:, 1] > 0)
    return np.asarray(np.clip(total - LEAST, 0.0, GREATEST))


def finer(surface: Surface) -> Surface:
    """Return a surface with each interval of its grid divided, to steps of about STEP."""
    wide = [np.linalg.norm(np.diff(surface.points, axis=a), axis=2).max() for a in (0, 1)]
    times = [max(int(np.ceil(each / STEP)), 1) for each in wide]
    parts = [
        np.linspace(0, 1, (count - 1) * each + 1)
        for count, each in zip(surface.points.shape[:2], times, strict=True)
    ]
    rows, columns = np.meshgrid(*parts, indexing="ij")
    points = at(surface.points, rows, columns)
    return replace(surface, points=points, plain=at(surface.on_material, rows, columns))


def lit(surface: Surface, towards: np.ndarray) -> Mesh | None:
    """Return the part of a surface that the pool's light reaches, its light as colours, or None."""
    divided = finer(surface)
    fine = mesh(divided, MATERIALS[surface.material].repeats, divided.on_material)
    light = thrown(fine.vertices, fine.normals, towards)
    reached = (light[fine.triangles] > 1 / 255).any(axis=1)
    if not reached.any():
        return None
    used, own = np.unique(fine.triangles[reached], return_inverse=True)
    colors = np.rint(light[used, None] * np.array(GLOW) * 255).astype(np.uint8)
    return Mesh(
        np.ascontiguousarray(fine.vertices[used]),
        np.ascontiguousarray(fine.normals[used]),
        np.ascontiguousarray(own.reshape(-1, 3), np.uint32),
        (np.ascontiguousarray(fine.coordinates[0][used]),),
        np.ascontiguousarray(colors),
    )


def lit_meshes(towards: np.ndarray) -> Iterator[tuple[tuple[str, int, int], Mesh]]:
    """Yield material, bay and level of detail with one mesh of what the pool's light reaches there.

    Their triangles divide those of the same level of the room, so that they lie on them.
    """
    found: dict[tuple[str, int, int], list[Mesh]] = {}
    for surface in architecture.hall():
        if surface.material not in LIT:
            continue
        for level in levels_of(surface.material):
            simple, _ = coarser(surface, surface.on_material, LEVELS[level])
            if (part := lit(simple, towards)) is not None:
                key = surface.material, bay_of(surface.points), level
                found.setdefault(key, []).append(part)
    for key, parts in found.items():
        yield key, merged(parts)


def brighter(mesh: Mesh, times: float) -> Mesh:
    """Return a mesh with its light, the colours, so many times as bright."""
    assert mesh.colors is not None
    return replace(mesh, colors=np.minimum(np.rint(mesh.colors * times), 255).astype(np.uint8))
