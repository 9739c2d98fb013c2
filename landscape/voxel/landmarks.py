"""Places on the island: castle, rabbit and sea dragon, woods and meadows.

Where each stands is found in the heights, so that any height image has them. No OpenGL.
"""

from typing import NamedTuple

import numpy as np

from landscape.files.assets import Assets
from landscape.voxel.blocks import AIR, block
from landscape.voxel.models import castle, finds
from landscape.voxel.models.creatures import SEA, dragon, rabbit
from landscape.voxel.models.meadow import forest, plants, reeds
from landscape.voxel.models.paths import ways, worn
from landscape.voxel.models.shapes import put
from landscape.voxel.models.trees import KINDS, bush, tree
from landscape.voxel.sites import bay_site, level_site, window_ends

# All chosen, in blocks.
CASTLE_REACH = 22
CASTLE_ABOVE = 4
CASTLE_HIGH = 0.35
RABBIT_REACH = 10
RABBIT_ABOVE = 3
RABBIT_HIGH = 0.02
DRAGON_LENGTH = 60
DRAGON_REACH = 14
DRAGON_LAND = 70
JETTY_NORTH = 34  # of the dragon's middle
CLEARING = 5  # around a building, without trees
WAY = 30  # in front of the castle's gate, without trees
BESIDE = 2  # columns beside a path without trees
BOULDERS, BUSHES = 1 / 3500, 1 / 2600  # of the columns of grass
SHAPES = 12  # of each kind of tree; each of them is also turned and mirrored
EMPTIED = 255  # no block has this number


class Site(NamedTuple):
    """The middle column of something that stands on the island, and how far it reaches."""

    x: int
    z: int
    reach: int


def build_castle(blocks: np.ndarray, tops: np.ndarray, sea: int) -> list[Site]:
    """Build the castle on the most level of the high hills, in place; return what it covers."""
    found = level_site(tops, CASTLE_REACH, sea + CASTLE_ABOVE, [], CASTLE_HIGH)
    if found is None:
        return []
    x, z = found
    model = castle.castle()
    wide, deep = (side // 2 for side in castle.PLAN)
    floor = int(np.median(tops[x - wide : x + wide, z - deep : z + deep]))
    hole = np.where(castle.hollow(model), EMPTIED, 0).astype(np.uint8)
    put(blocks, hole, (x, z, floor), castle.FLOOR)
    around = blocks[x - wide - 1 : x + wide + 2, z - deep - 1 : z + deep + 2]
    around[around == EMPTIED] = 0
    put(blocks, model, (x, z, floor), castle.FLOOR)
    return [Site(x, z, CASTLE_REACH), Site(x, z + CASTLE_REACH + WAY // 2, WAY // 2)]


def place_rabbit(
    blocks: np.ndarray, tops: np.ndarray, sea: int, taken: list[Site], assets: Assets
) -> list[Site]:
    """Place the rabbit in a level meadow, in place; return what it covers."""
    found = level_site(tops, RABBIT_REACH, sea + RABBIT_ABOVE, list(taken), RABBIT_HIGH)
    if found is None:
        return []
    x, z = found
    model = rabbit(assets.path("rabbit.ply"))
    wide, deep = (side // 2 for side in model.shape[:2])
    put(blocks, model, (x, z, int(tops[x - wide : x + wide, z - deep : z + deep].min())))
    return [Site(x, z, RABBIT_REACH)]


def place_dragon(blocks: np.ndarray, tops: np.ndarray, sea: int, assets: Assets) -> list[Site]:
    """Let the sea dragon rise from the bay with the most land around it, in place.

    A jetty reaches out to it from the bay's western shore; return where that begins.
    """
    found = bay_site(tops, sea, DRAGON_REACH, DRAGON_LAND)
    if found is None:
        return []
    x, z = found
    model = dragon(assets.path("dragon.ply"), DRAGON_LENGTH)
    put(blocks, model, (x, z, sea), round(SEA * model.shape[2]))
    z = max(z - JETTY_NORTH, 0)
    shore = np.flatnonzero(tops[:x, z] >= sea)
    if not len(shore):
        return []
    put(blocks, finds.jetty(), (int(shore[-1]), z, sea), finds.DECK)
    return [Site(int(shore[-1]), z, 0)]


def lay_paths(
    blocks: np.ndarray,
    tops: np.ndarray,
    kinds: np.ndarray,
    sea: int,
    sites: list[Site],
    rng: np.random.Generator,
) -> np.ndarray:
    """Wear paths into the grass from the first of the sites, the castle, to the others, in place.

    Return the topmost blocks (n, n) with them, and with no grass close beside them.
    """
    (x, z, _), *others = sites
    gate = x + castle.DOORSTEP[0], min(z + castle.DOORSTEP[1], len(tops) - 1)
    lines = ways(tops, sea, gate, [(each.x, each.z) for each in others])
    on = worn(len(tops), lines, rng)
    top = np.maximum(tops.astype(np.intp) - 1, 0)[..., None]
    here = np.take_along_axis(blocks, top, axis=2)[..., 0]
    soft = on & ((here == block("grass")) | (here == block("earth")))
    np.put_along_axis(blocks, top, np.where(soft, block("path"), here)[..., None], axis=2)
    _, beside = window_ends(on.astype(np.uint8), BESIDE)
    found = kinds.copy()
    found[(beside > 0) & (kinds == block("grass"))] = block("path")
    return found


def place_finds(
    blocks: np.ndarray, tops: np.ndarray, sea: int, taken: list[Site], rng: np.random.Generator
) -> list[Site]:
    """Place what one comes upon, in place: the smaller buildings; return what they cover."""
    sites: list[Site] = []
    for model, reach, high in (
        (finds.beacon(), 7, 0.9),
        (finds.stone_circle(rng), 10, 0.05),
        (finds.ruin(rng), 8, 0.3),
        (finds.well(), 5, 0.0),
    ):
        found = level_site(tops, reach, sea + 2, [*taken, *sites], high)
        if found is not None:
            x, z = found
            half = reach // 2
            ground = int(np.median(tops[x - half : x + half + 1, z - half : z + half + 1]))
            put(blocks, model, (x, z, ground), finds.FLOOR)
            sites.append(Site(x, z, reach))
    return sites


def free_columns(side: int, sites: list[Site]) -> np.ndarray:
    """Return which columns (n, n) are not near a site."""
    found = np.ones((side, side), bool)
    for x, z, reach in sites:
        keep = reach + CLEARING
        found[max(x - keep, 0) : x + keep, max(z - keep, 0) : z + keep] = False
    return found


def scatter(
    blocks: np.ndarray, tops: np.ndarray, places: np.ndarray, rng: np.random.Generator
) -> None:
    """Put boulders and bushes on some of the ``places`` (n, n), in place."""
    columns = np.argwhere(places)
    for share, make, floor in ((BOULDERS, finds.boulder, 1), (BUSHES, bush, 0)):
        for x, z in rng.permutation(columns)[: round(share * len(columns))].tolist():
            put(blocks, make(rng), (x, z, int(tops[x, z])), floor)


def _plant_trees(
    blocks: np.ndarray,
    tops: np.ndarray,
    where: np.ndarray,
    rng: np.random.Generator,
    own: np.random.Generator,
) -> None:
    """Plant trees where they may stand (n, n), in place; ``own`` is the generator of shapes."""
    shapes = {kind: [tree(kind, own) for _ in range(SHAPES)] for kind in KINDS}
    for kind, x, z in forest(where, tops, rng):
        model = shapes[kind][int(rng.integers(SHAPES))]
        turned = np.rot90(model, int(rng.integers(4)))
        put(blocks, turned[::-1] if rng.random() < 0.5 else turned, (x, z, int(tops[x, z])))


def grow(
    blocks: np.ndarray,
    tops: np.ndarray,
    kinds: np.ndarray,
    free: np.ndarray,
    wet: np.ndarray,
    rng: np.random.Generator,
) -> None:
    """Plant trees and flowers where there is grass and nothing else, in place.

    Trees only stand in the columns that are ``free``; flowers grow right up to the walls.
    ``tops`` and ``kinds`` (n, n) are the heights and the topmost blocks of the bare land; reeds
    grow on sand that is ``wet`` (n, n).
    """
    grass = kinds == block("grass")
    own = rng.spawn(1)[0]  # so that where trees stand does not depend on their shapes
    _plant_trees(blocks, tops, grass & free, rng, own)
    scatter(blocks, tops, grass & free, own)
    below = np.take_along_axis(blocks, tops[..., None].astype(np.intp) - 1, axis=2)[..., 0]
    sown = plants((kinds == block("grass")) & (below == block("grass")), rng)
    sown[reeds((below == block("sand")) & wet, own)] = block("reeds")
    at = np.nonzero(sown)
    at = (*at, tops[at])
    blocks[at] = np.where(blocks[at] == AIR, sown[at[:2]], blocks[at])
