"""Names of the pictures that only the sprites of the preset ``best`` have, by atlas cell.

A file of places may name them under any preset, and the plain sprites then draw what they have
instead. The pictures of 2006 are in atlas.py.
"""

HERB = 8  # the first herb's cell; the pictures from above use the one before it
HERBS = ("fern.png", "oxeye.png", "willowherb.png", "marram.png", "heather.png")

MORE = 16  # the cell of the first further individual of a tree or deer
MORE_FILES = (
    "oak_leaning.png",
    "oak_tall.png",
    "oak_young.png",
    "hazel.png",
    "birch_tall.png",
    "birch_young.png",
    "pine.png",
    "spruce_young.png",
    "bramble.png",
    "stag_walking.png",
    "doe_grazing.png",
)
