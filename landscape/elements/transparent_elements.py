"""Trees, deer and plants: sprites that must be sorted (Transparent_elements, section 5.1 and 5.2).

Techniques: billboards, quads spanned by the camera's right and up vectors as read from the
modelview matrix, so that they always face it; crossed quads, two fixed quads at right angles whose
top-centre vertex sways. Blending wants far before near, and the z buffer cannot do that: all of
them together are sorted by their eye-space depth. All sprites share one texture, an atlas, so that
one glDrawElements draws them in any order.
Fixes of section 11.2, all by vertices and vertex alpha: upright billboards, deer that stand on the
slope, half quads sorted one by one, quads that fade edge-on, crowns and rosettes from above.
State used: GL_BLEND, GL_ALPHA_TEST, GL_TEXTURE_2D, depth writes off. OpenGL 1.1.
"""

import numpy as np

from landscape.elements.ground import Ground
from landscape.elements.sprites.atlas import (
    CELL,
    CELLS,
    COLUMNS,
    GUTTER,
    HERB_ROWS,
    HERBS,
    LEVELS,
    ROWS,
    TOPS_CELLS,
    atlas,
    cell_coordinates,
    outline,
    padded,
    tops_cell,
)
from landscape.elements.sprites.planting import DEER, PLANT, Sprites, plant_everything
from landscape.elements.sprites.sprite_quads import box_corners
from landscape.elements.sprites.sprites_in_view import SpriteView
from landscape.elements.sun import direction
from landscape.elements.terrain.shadows import SKY_HIDDEN, ShadowMap, cast_sprites
from landscape.files.assets import Assets
from landscape.files.cache import content, recall
from landscape.files.images import mip_chain, read_image
from landscape.frame import Frame
from landscape.gl.calls import gl
from landscape.gl.state import attrib, client_arrays
from landscape.gl.texture import Texture
from landscape.settings import Settings

CROWN_SHADE = 0.6  # chosen: how far a crown hides the sky from the ground, times the tree's width
SHADE = 0.5  # chosen: power of the ground's light; a plant stands up into more of it
SUNWARD = 0.8  # chosen: times its height, how far sunward of a plant its light is asked for


def outlines(cells: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Return where the two boxes of each picture lie on its quad, and in the atlas.

    Both are (2, cells, 8, 2): not mirrored and mirrored, then 4 corners of each box.
    """
    boxes = np.array([outline(cell[GUTTER:, :, 3]) for cell in cells])
    rows = HERB_ROWS if len(cells) > len(CELLS) else ROWS
    mirrored = np.stack([1 - boxes[..., 2], boxes[..., 1], 1 - boxes[..., 0], boxes[..., 3]], 2)
    corners = box_corners(np.stack([boxes, mirrored])).reshape(2, len(cells), 8, 2)
    coordinates = np.array(
        [
            [
                cell_coordinates(np.array([cell]), np.array([bool(flip)]), s, t, rows)[0]
                for cell, (s, t) in enumerate(corners[flip].transpose(0, 2, 1))
            ]
            for flip in (0, 1)
        ]
    )
    return corners.astype(np.float32), coordinates


class TransparentElements:
    """All sprites of the island, in one sort."""

    def __init__(
        self, settings: Settings, assets: Assets, ground: Ground, seed: int, kinds: set[str]
    ) -> None:
        """Draw the places by lot (``seed``) and load the atlas; ``kinds`` are those to show."""
        self.elements = tuple(k for k in ("trees", "deer", "plants") if k in kinds)
        self._settings = settings
        self.stand(self._planted(assets, ground, seed, kinds))
        self._ground: Ground | None = ground if settings.plants.shaded else None
        herbs = HERBS if settings.plants.species > 1 else ()
        self._paths = [assets.path(name) for name in (*CELLS, *herbs)]

        def pictures() -> tuple[np.ndarray, ...]:
            cells = self._cells()
            chains = [mip_chain(cell, LEVELS) for cell in cells]
            levels = [atlas([chain[level] for chain in chains]) for level in range(LEVELS)]
            return (*outlines(cells), *levels)

        self._outlines, self._outline_coordinates, *levels = recall(
            ["atlas", *self._contents()], pictures
        )
        self._rows = len(levels[0]) // CELL
        self._texture = Texture(levels, repeat=False, trilinear=settings.transparent.trilinear)
        self._topped = False

    def stand(self, sprites: Sprites) -> None:
        """Let these sprites stand on the island, and no others."""
        self.sprites = sprites
        self._view: SpriteView | None = None

    def _planted(self, assets: Assets, ground: Ground, seed: int, kinds: set[str]) -> Sprites:
        """Draw the places by lot, or recall them."""
        settings = self._settings
        large = content(assets.path(settings.ground.large_texture))
        groups = [settings.ground, settings.water, settings.castle, settings.rabbit]
        groups += [settings.trees, settings.deer, settings.plants]
        what = (repr((groups, seed, sorted(kinds))), ground.field.heights.tobytes(), large)
        planted = recall(
            what, lambda: tuple(vars(plant_everything(settings, ground, seed, kinds)).values())
        )
        return Sprites(*planted)

    def _contents(self) -> list[bytes]:
        """Return what tells the atlas's pictures from any others."""
        return [content(path) for path in self._paths]

    def _cells(self) -> list[np.ndarray]:
        """Return the atlas's cells; the one before the herbs is for the views from above."""
        cells = [padded(read_image(path)) for path in self._paths]
        if len(cells) > len(CELLS):
            cells.insert(len(CELLS), np.zeros_like(cells[0]))
        return cells

    def cast(self, shadows: ShadowMap) -> None:
        """Throw the sprites' shadows, and darken the ground at the trees' feet."""
        cast_sprites(shadows, self.sprites, [cell[GUTTER:, :, 3] for cell in self._cells()])
        trees = self.sprites.cells < DEER
        widths = self.sprites.sizes[trees, 0]
        shadows.hide_sky(self.sprites.positions[trees], CROWN_SHADE * widths, SKY_HIDDEN)

    def _shade(self, ground: Ground) -> None:
        """Darken the plants by the shadows beside them; asked once all shadows have fallen."""
        plants = np.flatnonzero(self.sprites.cells >= PLANT)
        # On the sunny side of it, or a plant would stand in its own shadow.
        sunward = direction(self._settings.sun)[[0, 2]]
        step = SUNWARD * self.sprites.sizes[plants, 1:] * sunward
        x, z = (self.sprites.positions[plants][:, [0, 2]] + step).T
        self.sprites.tints[plants, :3] *= ground.light(x, z)[:, None] ** SHADE

    def prepare(self, frame: Frame) -> tuple[np.ndarray, ...]:
        """Return the frame's vertices, colours, texture coordinates and sorted indices."""
        if self._ground:
            self._shade(self._ground)
            self._ground = None
        if self._view is None:
            self._view = SpriteView(
                self.sprites, self._outlines, self._outline_coordinates, self._rows
            )
        return self._view.arrays(frame, self._settings)

    def _from_above(self) -> bool:
        """Return whether anything has a picture for who looks from above."""
        return self._settings.trees.crown or self._settings.plants.rosette

    def _fill_tops(self) -> None:
        """Add the views from above to the bound atlas, once, when they are first asked for."""

        def views() -> tuple[np.ndarray, ...]:
            cells = self._cells()
            count = len(TOPS_CELLS) if len(cells) > len(CELLS) else 1
            tops = [mip_chain(tops_cell(cells, number), LEVELS) for number in range(count)]
            return tuple(np.stack(level) for level in zip(*tops, strict=True))

        for level, images in enumerate(recall(["tops", *self._contents()], views)):
            side = CELL >> level
            for number, image in enumerate(images):
                row, column = divmod(TOPS_CELLS[number], COLUMNS)
                box = side * column, side * row, side, side
                gl.glTexSubImage2D(
                    gl.GL_TEXTURE_2D, level, *box, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image
                )
        self._topped = True

    def draw(self, frame: Frame, prepared: tuple[np.ndarray, ...] | None = None) -> None:
        """Blend the sprites, far to near; ``prepared`` saves the work in the second pass."""
        vertices, tints, coordinates, indices = prepared or self.prepare(frame)
        if not len(indices):
            return
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups | gl.GL_CURRENT_BIT):
            gl.glDepthMask(gl.GL_FALSE)
            if self._settings.transparent.textured:
                gl.glEnable(gl.GL_BLEND)
                gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
                gl.glEnable(gl.GL_ALPHA_TEST)
                gl.glAlphaFunc(gl.GL_GREATER, 0.02)
                gl.glEnable(gl.GL_TEXTURE_2D)
                self._texture.bind()
                if self._from_above() and not self._topped:
                    self._fill_tops()
            else:
                gl.glDepthMask(gl.GL_TRUE)
            with client_arrays(vertices, None, tints, [coordinates]):
                gl.glDrawElements(gl.GL_TRIANGLES, indices.size, gl.GL_UNSIGNED_INT, indices)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the atlas; may be called twice."""
        self._texture.release()
