"""The hall's materials: the texture of each, and how often it is repeated. No OpenGL."""

# Chosen: texture, and repetitions per unit.
MATERIALS = {
    "stone": ("torch_stone.png", 8.0), "wall": ("castle_brick.png", 5.0),
    "vault": ("castle_brick.png", 5.0), "plinth": ("torch_stone.png", 8.0),
    "pool": ("mosaic.png", 4.0), "wood": ("torch_stone.png", 8.0),
    "iron": ("torch_stone.png", 16.0), "floor": ("torch_stone.png", 5.0),
    "alcove": ("torch_stone.png", 8.0), "band": ("torch_stone.png", 10.0),
    "medallion": ("torch_stone.png", 1.0),
}  # fmt: skip
