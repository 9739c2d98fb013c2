"""The bar of blocks: the kinds that a walker can place, with the chosen one framed and named."""

from collections.abc import Sequence

import numpy as np
from PIL import Image, ImageDraw

from framelens.base.fonts import font, writable
from framelens.base.texts import translator
from landscape.files.assets import Assets
from landscape.voxel.blocks import BLOCKS, PLANT_TILES, Block
from landscape.voxel.tiles import plants, tiles

# All chosen: sizes as fractions of the window's height, colours RGBA.
SIDE = 0.062  # of a slot
GAP = 0.16  # of a slot's side, between slots
SHADE = {"top": 1.0, "left": 0.8, "right": 0.62}
PLATE = (12, 20, 28, 150)
FRAME = (255, 214, 120, 255)
NUMBER = (240, 240, 235, 255)


class Icons:
    """The pictures of kinds of blocks, made when first needed."""

    def __init__(self, assets: Assets) -> None:
        """Read the tiles."""
        self._tiles, self._plants = tiles(assets), plants(assets)

    def icon(self, kind: int, side: int) -> Image.Image:
        """Return a picture of a block, ``side`` pixels high: a cube seen from above a corner."""
        block = BLOCKS[kind]
        if block.plant:
            wide = self._plants.shape[0]
            column = PLANT_TILES.index(block.top)
            picture = Image.fromarray(self._plants[:, column * wide : (column + 1) * wide])
            return picture.convert("RGBA").resize((side, side), Image.Resampling.LANCZOS)

        found = Image.new("RGBA", (side, side))
        half, quarter = side / 2, side / 4

        # Each face: where its upper left, upper right and lower left corners go.
        faces = (
            ("top", (0, quarter), (half, 0), (half, half)),
            ("left", (0, quarter), (half, half), (0, side - quarter)),
            ("right", (half, half), (side, quarter), (half, side)),
        )
        for name, *corners in faces:
            found.alpha_composite(_laid(self._face(block, name), np.array(corners), side))
        return found

    def _face(self, block: Block, name: str) -> Image.Image:
        tile = block.top if name == "top" else block.side or block.top
        colours = self._tiles[tile][..., :3] * (np.array(block.tint) / 255 * SHADE[name])
        return Image.fromarray(colours.astype(np.uint8)).convert("RGBA")


def _laid(face: Image.Image, corners: np.ndarray, side: int) -> Image.Image:
    """Return a face in a picture of ``side`` pixels; ``corners`` (3, 2): upper two, lower left."""
    origin, across, down = corners
    back = np.linalg.inv(np.array([across - origin, down - origin]).T) * face.width
    offset = -back @ origin
    numbers = (*back[0], offset[0], *back[1], offset[1])
    size = side, side
    return face.transform(size, Image.Transform.AFFINE, numbers, Image.Resampling.BILINEAR)


def bar_image(
    icons: Icons, slots: Sequence[int], chosen: int, height: int, language: str
) -> np.ndarray:
    """Render the bar for a window ``height`` pixels high, uint8 (h, w, 4)."""
    side = max(round(SIDE * height), 14)
    gap = max(round(GAP * side), 2)
    pixels = max(round(side * 0.42), 9)
    face = font(pixels)
    name = writable(translator(language, "scenes")(BLOCKS[slots[chosen]].name), face)
    top = round(1.7 * pixels)
    width = len(slots) * (side + gap) + gap
    image = Image.new("RGBA", (width, top + side + 2 * gap))
    draw = ImageDraw.Draw(image)
    half = face.getlength(name) / 2 + 0.6 * pixels
    draw.rounded_rectangle((width / 2 - half, 0, width / 2 + half, top - gap), gap, PLATE)
    draw.text((width / 2, (top - gap) / 2), name, NUMBER, face, "mm")
    draw.rounded_rectangle((0, top, width - 1, image.height - 1), gap, PLATE)
    small = font(max(pixels * 2 // 3, 8))
    for k, kind in enumerate(slots):
        x, y = gap + k * (side + gap), top + gap
        image.alpha_composite(icons.icon(kind, side), (x, y))
        draw.text(
            (x + side, y + side),
            str(k + 1),
            NUMBER,
            small,
            "rs",
            stroke_width=1,
            stroke_fill=(0, 0, 0),
        )
        if k == chosen:
            thick = max(gap // 2, 1)
            box = (x - thick, y - thick, x + side + thick - 1, y + side + thick - 1)
            draw.rectangle(box, None, FRAME, thick)

    return np.asarray(image)
