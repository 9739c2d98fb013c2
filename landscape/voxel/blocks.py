"""The kinds of blocks: what each of their faces shows.

A face is a tile of the texture strip times a tint: four kinds of leaves share one grey tile. The
document calls them "matières" (section "Séparation des régions en matières").
"""

from dataclasses import dataclass

import numpy as np

AIR = 0

# The tiles in the order of the strip voxel_tiles.png, from the top; each is square and repeats.
TILES = (
    *("grass_top", "grass_side", "turf_side", "earth", "path", "rock", "sand", "gravel"),
    *("snow", "snow_side"),
    *("bark", "birch_bark", "log_top", "leaves", "needles"),
    *("brick", "slate", "planks", "hide", "lamp"),
)
HOLED = ("leaves", "needles")  # tiles with holes, which show from nearby
# The plants in the order of the columns of voxel_plants.png, from the left.
PLANT_TILES = (
    *("tall_grass", "fern", "poppy", "buttercup", "cornflower", "heather"),
    *("daisy", "reed", "bush", "spruce_tip"),
)

WHITE = (255, 255, 255)
Colour = tuple[int, int, int]


@dataclass(frozen=True)
class Block:
    """A kind of block: its tiles and its tint.

    ``side`` and ``bottom`` are the top's tile if they are empty. ``natural`` blocks vary their tint
    a little over the map. A plant is not solid: it is drawn as two crossed quads.
    """

    name: str
    top: str
    side: str = ""
    bottom: str = ""
    tint: Colour = WHITE
    natural: bool = False
    plant: bool = False


# The number of a block is its place in this tuple; 0 is air. Tints are chosen.
BLOCKS = (
    Block("air", "rock"),
    Block("rock", "rock", tint=(236, 232, 230), natural=True),
    Block("earth", "earth", natural=True),
    Block("grass", "grass_top", "grass_side", "earth", (226, 222, 214), natural=True),
    Block("sand", "sand", natural=True),
    Block("gravel", "gravel", natural=True),
    Block("snow", "snow", "snow_side", "earth"),
    Block("oak log", "log_top", "bark", "log_top", (168, 140, 112)),
    Block("birch log", "log_top", "birch_bark", "log_top"),
    Block("spruce log", "log_top", "bark", "log_top", (128, 98, 80)),
    Block("hawthorn log", "log_top", "bark", "log_top", (186, 172, 152)),
    Block("oak leaves", "leaves", tint=(92, 138, 52), natural=True),
    Block("birch leaves", "leaves", tint=(150, 176, 72), natural=True),
    Block("spruce needles", "needles", tint=(62, 104, 74), natural=True),
    Block("hawthorn leaves", "leaves", tint=(112, 150, 82), natural=True),
    Block("hawthorn blossom", "leaves", tint=(250, 176, 184)),
    Block("brick", "brick"),
    Block("dark brick", "brick", tint=(176, 170, 168)),
    Block("slate", "slate"),
    Block("planks", "planks"),
    Block("red cloth", "hide", tint=(188, 44, 40)),
    Block("lamp", "lamp"),
    Block("fur", "hide", tint=(176, 132, 92)),
    Block("light fur", "hide", tint=(236, 218, 192)),
    Block("dark", "hide", tint=(34, 28, 30)),
    Block("scales", "hide", tint=(58, 140, 112)),
    Block("light scales", "hide", tint=(206, 204, 132)),
    Block("horn", "hide", tint=(240, 230, 204)),
    Block("pink", "hide", tint=(226, 138, 132)),
    Block("tall grass", "tall_grass", tint=(196, 216, 160), natural=True, plant=True),
    Block("fern", "fern", natural=True, plant=True),
    Block("poppy", "poppy", plant=True),
    Block("buttercup", "buttercup", plant=True),
    Block("cornflower", "cornflower", plant=True),
    Block("heather", "heather", plant=True),
    Block("dark rock", "rock", tint=(206, 204, 206), natural=True),
    Block("pale rock", "rock", tint=(255, 250, 236), natural=True),
    Block("warm rock", "rock", tint=(250, 226, 196), natural=True),
    Block("deep snow", "snow", "snow", "rock"),
    Block("turf", "grass_top", "turf_side", "earth", (212, 214, 198), natural=True),
    Block("path", "path", "earth", "earth", natural=True),
    Block("daisies", "daisy", plant=True),
    Block("reeds", "reed", natural=True, plant=True),
    Block("bush", "bush", natural=True, plant=True),
    Block("spruce tip", "spruce_tip", tint=(62, 104, 74), natural=True, plant=True),
    Block("deep scales", "hide", tint=(38, 108, 96)),
    Block("bright scales", "hide", tint=(92, 172, 122)),
    Block("pane", "lamp", tint=(84, 112, 220)),  # the lamp's bars, and a dark blue between them
)
NUMBERS = {block.name: number for number, block in enumerate(BLOCKS)}
SOLID = np.array([number > 0 and not block.plant for number, block in enumerate(BLOCKS)])
# Density to the eye: 0 for air and plants, 1 for leaves, 2 for opaque blocks. A block shows its
# face to a neighbour that is less dense.
LEAFY = np.array([block.top in HOLED for block in BLOCKS])
DENSITY = np.where(SOLID, np.where(LEAFY, 1, 2), 0).astype(np.uint8)


def looked_up(table: np.ndarray, blocks: np.ndarray) -> np.ndarray:
    """Return the entries of a table (kinds,), bool or uint8, for blocks, uint8; read only.

    As ``table[blocks]``, which would first make an index of 8 bytes of each block.
    """
    entries = table.tobytes().ljust(256, b"\0")
    found = blocks.tobytes().translate(entries)
    return np.frombuffer(found, table.dtype).reshape(blocks.shape)


def block(name: str) -> int:
    """Return the number of the block of this name; KeyError if there is none."""
    return NUMBERS[name]
