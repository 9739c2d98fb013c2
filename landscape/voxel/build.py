"""Building the world: land from the height image, what stands on it, and the meshes of all regions.

All of it is kept in the cache, so that it is made once.
"""

import contextlib
import math
from collections.abc import Callable, Generator, Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from framelens.base.errors import InputError
from framelens.system.beside import threads
from landscape.elements import sun
from landscape.elements.settings import Sun
from landscape.files.assets import Assets
from landscape.files.cache import content, recall
from landscape.files.images import read_heights
from landscape.settings.declare import get
from landscape.voxel.blocks import TILES
from landscape.voxel.distant import distant_meshes
from landscape.voxel.faces import DIRECTIONS, shown_in
from landscape.voxel.heights import Heights, heights
from landscape.voxel.landmarks import (
    Site,
    build_castle,
    free_columns,
    grow,
    lay_paths,
    place_dragon,
    place_finds,
    place_rabbit,
)
from landscape.voxel.materials import filled, strata, top_materials, variation
from landscape.voxel.memory import give_back
from landscape.voxel.mesh import SETS, TURNS, VERTEX, Look, RegionMesh, region_meshes, shown_tiles
from landscape.voxel.packed_mesh import LARGE, PackedMesh, packed
from landscape.voxel.relief import roughened
from landscape.voxel.settings import Settings, Shadow, Voxel
from landscape.voxel.world import MOST_AT_ONCE, MOST_BLOCKS, MOST_COLUMNS, ROOM, World

Mesh = RegionMesh | PackedMesh
Meshes = Sequence[Mesh]

TINT_SIZE = 40.0  # columns, chosen: size of the largest patches of lighter and darker tint
# Settings of which the world and its meshes are made.
BUILT = (
    "height_image",
    "regions",
    "region_size",
    "block",
    "levels",
    "sea",
    "merge",
    "occlusion",
    "trees",
    "buildings",
)
LEAST_LEFT = 0.02  # chosen: of the light in shadow, so that a colour is never divided by 0
# Which of TILES only what is built has.
BUILDINGS = np.isin(TILES, ("brick", "slate", "planks", "hide", "lamp"))
# Blocks, chosen: how far quads overlap, also level ones, from afar, where pixels are larger.
FAR_OVERLAP, FAR_FIRM = 0.02, 0.1
# Columns, chosen: larger worlds are not cached, which they would fill, and their meshes are packed.
MOST_KEPT = 1000
# Blocks, chosen: as many are meshed at once. With twice as many the usual land is built a tenth
# sooner, but one that is too rough takes nearly twice the time and memory until it is refused.
MOST_CELLS = 1 << 21
# Measured on two processors: 0.39 s instead of 0.46, and 6.0 s instead of 8.8 for 2,000 x 2,000
# columns.
THREADS = 2
MOST_VERTICES = 18 << 20  # chosen: the largest map of the shipped image has 17 millions
FAR_SHADE = 0.93  # measured: how dark the corners are on average
# Chosen: light on faces that look up, down and to the sides, without sun, and what the sun adds.
SKYLIGHT = {"up": 0.64, "down": 0.42}
SIDELIGHT = 0.54
SUNLIGHT = 0.52
BLUE_SKY = np.array([0.94, 0.98, 1.06])
WARMER = 0.35  # chosen: how far the light of the sky has the colour of the sun's


class TooLargeToKeep(Exception):
    """A world that the cache does not keep, with its meshes, which are packed."""

    def __init__(self, place: World, found: Meshes) -> None:
        super().__init__()
        self.place, self.found = place, found


def image_heights(values: Voxel, assets: Assets) -> Heights:
    """Return the heights of the image in blocks; InputError for what cannot be a world."""
    columns = values.regions * values.region_size
    tall = values.levels + ROOM
    most = min(math.isqrt(MOST_BLOCKS // tall), MOST_COLUMNS)

    if columns > most:
        raise InputError(
            "settings voxel.regions={regions} and voxel.region_size={region_size}: "
            "expected at most {most} x {most} columns of {levels} levels, not {columns} x "
            "{columns}, which do not fit in memory",
            regions=values.regions,
            region_size=values.region_size,
            most=most,
            levels=values.levels,
            columns=columns,
        )

    if values.region_size**2 * tall > MOST_AT_ONCE:
        raise InputError(
            "setting voxel.region_size={region_size}: expected at most {most} for "
            "{levels} levels: a region does not fit in memory",
            region_size=values.region_size,
            most=math.isqrt(MOST_AT_ONCE // tall),
            levels=values.levels,
        )

    image = read_heights(assets.path(values.height_image, "voxel.height_image"))
    return heights(image, columns, values.levels)


def source(values: Voxel, assets: Assets) -> Heights:
    """Return the heights of the land in blocks; InputError for what cannot be a world."""
    return roughened(image_heights(values, assets))


def world(values: Voxel, assets: Assets, seed: int) -> World:
    """Return the land and what stands on it."""
    land = source(values, assets)
    rng = np.random.default_rng(seed)
    tops = land.tops
    kinds = top_materials(land, values.sea, rng)
    blocks = filled(tops, kinds, int(tops.max()) + ROOM, strata(len(tops), rng))
    sites: list[Site] = []
    if values.buildings:
        sites = build_castle(blocks, tops, values.sea)
        gate = sites[:1]
        sites += place_rabbit(blocks, tops, values.sea, sites, assets)
        sites += place_finds(blocks, tops, values.sea, sites, rng)
        jetty = place_dragon(blocks, tops, values.sea, assets)
        if gate:
            goals = [*gate, *sites[2:], *jetty]
            kinds = lay_paths(blocks, tops, kinds, values.sea, goals, rng)

    if values.trees:
        shore = abs(tops - values.sea + 0.5) < 1
        grow(blocks, tops, kinds, free_columns(len(blocks), sites), shore, rng)
    return World(blocks, tops, values.region_size, values.sea, values.block)


def day_light(light: Sun, faced: float | np.ndarray, sky: float) -> np.ndarray:
    """Return the light (..., 3) of ``sky`` and sun where the cosine to the sun is ``faced`` (...).

    ``sky`` is the part of the sky's light that arrives there.
    """
    air = BLUE_SKY * (1.0 - WARMER * (1.0 - np.array(light.diffuse)))
    sunny = np.sqrt(np.maximum(faced, 0.0))[..., None]
    return np.asarray(sky * air + SUNLIGHT * sunny * np.array(light.diffuse))


def slope_light(land: Heights, light: Sun, strength: float) -> np.ndarray:
    """Return how much lighter level faces are for the land's slope, float32 (n + 1, n + 1) [x, z].

    The cubes' upper faces all look the same way, but the land that they stand for does not: its
    normal at each corner of a column says how much it faces the sun. 1 is level land, or all of it
    at a ``strength`` of 0.
    """
    towards = sun.direction(light).astype(np.float64)
    at = np.arange(len(land.field) + 1)
    cosine = land.normal(at[:, None], at[None, :]) @ towards
    here, level = (
        day_light(light, faced, SKYLIGHT["up"]).mean(axis=-1) for faced in (cosine, towards[1])
    )
    return (1.0 + strength * (here / level - 1.0)).astype(np.float32)


def face_light(light: Sun, shadow: Shadow) -> np.ndarray:
    """Return the light (6, 4) on faces in each of DIRECTIONS.

    The fourth component is what is left to a face in the sun, when there are shadows: 1, or for one
    that is turned away from the sun as much as in shadow, so that it does not depend on the shadow
    map, which is not exact there. Its colour is then so much brighter.
    """
    towards = sun.direction(light)
    found = np.ones((len(DIRECTIONS), 4))
    left = max(math.fsum(shadow.color) / 3.0, LEAST_LEFT)
    for k, direction in enumerate(DIRECTIONS):
        axis = {0: 0, 1: 2, 2: 1}[direction.axis]  # of [x, z, y] in x, y, z
        faced = max(direction.sign * float(towards[axis]), 0.0)
        found[k, :3] = day_light(light, faced, SKYLIGHT.get(direction.name, SIDELIGHT))
        if shadow.enabled and not faced:
            found[k, :3] /= left
            found[k, 3] = left
    return np.clip(found, 0.0, 1.0)


def look(settings: Settings, land: Heights, seed: int) -> Look:
    """Return what the vertices depend on besides the blocks; ``land`` is the image's."""
    values = settings.voxel
    side = values.regions * values.region_size
    tint = variation(side + 1, TINT_SIZE, np.random.default_rng(seed + 1)).astype(np.float32)
    # The water is between these, and so is all that is drawn of what lies under it.
    shore = values.sea - 1, values.sea + 1
    slope = slope_light(land, settings.sun, values.slope)
    return Look(face_light(settings.sun, settings.shadow), tint, slope=slope, shore=shore)


def meshes(
    place: World, colours: Look, values: Voxel, kept: Callable[[RegionMesh], Mesh]
) -> Generator[tuple[Mesh, ...], None, None]:
    """Yield the meshes of each region, for near, for far, and distant, as ``kept`` returns them.

    Threads share the work: numpy lets others run while it goes through large arrays. They work
    ahead, until this is closed.
    """
    size, height = place.region_size, place.blocks.shape[2]
    many = max(1, MOST_CELLS // (size * size * height))
    number, rows = min(many, place.regions), max(1, many // place.regions)

    def part(row: int, column: int) -> list[tuple[Mesh, ...]]:
        """Return the meshes of so many regions from one on."""
        across, along = min(rows, place.regions - row), min(number, place.regions - column)
        first = row * place.regions + column
        found = meshed(place, first, colours, values, along, across)
        return [tuple(map(kept, each)) for each in zip(*found, strict=True)]

    starts = product(range(0, place.regions, rows), range(0, place.regions, number))
    workers = threads(THREADS)
    try:
        for found in workers.map(part, *zip(*starts, strict=True)):
            yield from found
    finally:
        # After Ctrl-C nobody waits for what the threads still do.
        workers.shutdown(wait=False, cancel_futures=True)


def all_meshes(place: World, colours: Look, values: Voxel) -> Meshes:
    """Return the meshes of all regions: first all those for near, then for far, then distant.

    If they are large they are packed, from the moment when that shows. InputError for too many.
    """
    large = place.side > MOST_KEPT
    give_back()

    def kept(mesh: RegionMesh) -> Mesh:
        return packed(mesh) if large else mesh

    regions: list[tuple[Mesh, ...]] = []
    count = 0
    # Threads that nobody waits for would take as much memory as the meshes that are refused.
    with contextlib.closing(meshes(place, colours, values, kept)) as found:
        for region in found:
            count += sum(mesh.size for mesh in region)
            if count > MOST_VERTICES:
                raise InputError(
                    "the land of blocks has more than {most} vertices, which do not fit in memory: "
                    "expected a smoother voxel.height_image, fewer voxel.levels or fewer changed "
                    "blocks",
                    most=MOST_VERTICES,
                )
            if count > LARGE and not large:
                large = True
                regions = [tuple(map(packed, each)) for each in regions]
            # What threads had made before is not packed yet.
            regions.append(tuple(map(packed, region)) if large else region)
    give_back()
    return [mesh for level in zip(*regions, strict=True) for mesh in level]


def meshed(
    place: World, region: int, colours: Look, values: Voxel, number: int = 1, rows: int = 1
) -> tuple[list[RegionMesh], list[RegionMesh], list[RegionMesh]]:
    """Return the meshes of ``number`` regions from one on, for near, for far, and where distant.

    They lie one after the other along z; in the following ``rows`` there are as many.

    Dark corners keep faces from being merged. From afar they do not show, and without them, and
    without plants, there are two thirds as many quads. Distant blocks are joined by eight, but not
    where something is built.
    """
    blocks, origin = place.with_edge(region, number, rows)
    size = place.region_size
    merge = values.merge
    plain = seen_from_afar(colours)
    shown = shown_in(blocks)
    near = region_meshes(
        blocks, size, origin, colours, merge, values.occlusion, plants=True, shown=shown
    )
    far = region_meshes(
        blocks, size, origin, plain, merge, occlusion=False, plants=False, shown=shown
    )
    distant = distant_meshes(blocks, size, origin, plain, merge)
    distant = [
        fine if shows_buildings(fine) else coarse for fine, coarse in zip(far, distant, strict=True)
    ]
    return near, far, distant


def shows_buildings(mesh: RegionMesh) -> bool:
    """Return whether a mesh has faces of what is built, which would be lumps in larger blocks."""
    return bool(BUILDINGS[shown_tiles(mesh)].any())


def seen_from_afar(colours: Look) -> Look:
    """Return what the meshes for far are made with: no dark corners, and a larger overlap."""
    light = colours.light * (*3 * [FAR_SHADE], 1.0)
    return replace(colours, light=light, overlap=FAR_OVERLAP, firm=FAR_FIRM)


def built(settings: Settings, assets: Assets, seed: int) -> tuple[World, Look, Meshes]:
    """Return the world, its colours and its meshes, from the cache if they were built before."""
    values = settings.voxel
    colours = look(settings, image_heights(values, assets), seed)
    parts = (
        "voxel world",
        content(assets.path(values.height_image, "voxel.height_image")),
        repr(([get(settings, f"voxel.{name}") for name in BUILT], seed)),
        colours.light.tobytes(),
        colours.slope.tobytes(),
    )

    def make() -> tuple[np.ndarray, ...]:
        place = world(values, assets, seed)
        found = all_meshes(place, colours, values)
        kept = [mesh for mesh in found if isinstance(mesh, RegionMesh)]
        if len(kept) < len(found):
            raise TooLargeToKeep(place, found)
        vertices = np.concatenate([mesh.vertices for mesh in kept])
        counts = np.stack([mesh.counts for mesh in kept])
        return place.blocks, place.ground, vertices.view(np.uint8), counts

    try:
        blocks, ground, data, counts = recall(parts, make)
    except TooLargeToKeep as large:
        return large.place, colours, large.found
    place = World(blocks, ground, values.region_size, values.sea, values.block)
    return place, colours, _taken_apart(data.view(VERTEX), counts)


def _taken_apart(vertices: np.ndarray, counts: np.ndarray) -> list[RegionMesh]:
    """Return the meshes whose vertices, VERTEX (n,), follow each other, and their counts."""
    ends = np.cumsum(counts.reshape(len(counts), -1).sum(axis=1))
    shape = len(TURNS), SETS
    return [
        RegionMesh(vertices[end - count.sum() : end], count.reshape(shape))
        for end, count in zip(ends, counts, strict=True)
    ]
