"""Additions of the preset `best` to the ground: see :class:`terrain.Terrain`."""

# Keys that ask for more than the ground of 2006.
ASKED_BY = ("ground.materials", "ground.low_stretch", "ground.shadows", "ground.tiles")
