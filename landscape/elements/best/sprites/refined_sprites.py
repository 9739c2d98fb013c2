"""Trees, deer and plants of the preset best: the flaws of section 11.2 fixed, one switch each.

Techniques, all by vertices and vertex alpha, still in one sort and one glDrawElements:

- ``transparent.upright`` (R4): billboards turn about the y axis only; ``trees.crown`` fades in a
  horizontal picture of the crown when seen from above.
- ``transparent.faces``: billboards face the eye's place, and stay while the camera turns.
- ``transparent.split`` (R3): each half of a crossed quad has its own place in the sort, and trees
  and deer are cut where they cross (:mod:`crossings`).
- ``deer.follow_slope`` (R5): a deer's billboard is perpendicular to the slope; with
  ``transparent.follow_slope`` so are trees and plants. ``deer.back``: from above it shows its back.
- ``plants.quads``, ``plants.fade_edge_on``, ``plants.rosette`` (R6): three quads, which fade when
  seen edge-on, and a horizontal picture when seen from above.
- ``transparent.fade``, ``clear_near``, ``min_pixels``: alpha towards the radius, near the eye, and
  where a sprite is only a few pixels high; ``plants.crossed_within``: far plants are billboards.
- ``transparent.trimmed``: quads end where the picture does, and what is out of view is not sent.
- ``transparent.rooted``: feet sink a little on slopes; ``plants.shaded``: plants in the ground's
  shadows are darker; ``trees.grouped``, ``plants.species``: see :mod:`planting`.

With all of them off the picture is that of ``elements/transparent_elements.py``, which shows the
technique of 2006. State used: GL_BLEND, GL_ALPHA_TEST, GL_TEXTURE_2D, depth writes off;
GL_COLOR_ARRAY. OpenGL 1.1.
"""

from collections.abc import Hashable
from dataclasses import replace
from typing import Self

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays
from framelens.gl.texture import Texture
from landscape.elements.atlas import CELL, CELLS, GUTTER, mip_levels, read_cells
from landscape.elements.best.sprites import individuals
from landscape.elements.best.sprites.choice import LaidOut
from landscape.elements.best.sprites.refined_atlas import (
    bled_levels,
    outlines,
    tops_levels,
    tops_place,
    with_herbs,
)
from landscape.elements.best.sprites.refined_planting import (
    TintedSprites,
    plant_refined,
    planted_by_file,
    planted_from,
)
from landscape.elements.best.sprites.rules import backs_fit
from landscape.elements.best.sprites.sprites_in_view import SpritesInView
from landscape.elements.best.terrain.cloud_shade import cloud_light, clouds_shade
from landscape.elements.best.terrain.shadows import SKY_HIDDEN, ShadowMap, cast_from, cast_sprites
from landscape.elements.element import Element, Site
from landscape.elements.ground import Ground
from landscape.elements.places_file import RANDOM
from landscape.elements.planting import DEER, PLANT
from landscape.elements.settings import Settings
from landscape.elements.sprite_names import HERBS
from landscape.elements.sun import direction
from landscape.elements.transparent_elements import blend_pictures, kinds_in
from landscape.files.assets import Assets
from landscape.files.cache import content, recall
from landscape.frame import Frame

CROWN_SHADE = 0.6  # chosen: radius within which a crown blocks the sky, times the tree's width
SHADE = 0.5  # chosen: exponent on the ground's light; a plant rises into more light
SUNWARD = 0.8  # chosen: times a plant's height, how far towards the sun its light is looked up


class RefinedSprites(Element[Settings]):
    """All sprites of the island, in one sort."""

    asked_by = (
        "transparent.sunward",
        "transparent.contact",
        "transparent.faces",
        "transparent.follow_slope",
        "transparent.upright",
        "transparent.split",
        "transparent.fade",
        "transparent.clear_near",
        "transparent.rooted",
        "transparent.trimmed",
        "transparent.min_pixels",
        "transparent.trilinear",
        "trees.grouped",
        "trees.crown",
        "trees.variety",
        "ground.shadows",
        "deer.follow_slope",
        "deer.variety",
        "plants.species",
        "plants.radius",
        "plants.shaded",
        "plants.rosette",
        "plants.quads",
        "plants.fade_edge_on",
        "plants.crossed_within",
    )

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Plant them on the ground, by the seed."""
        ground = site.elements[Ground]
        return cls(site.settings, site.assets, ground, site.seed, kinds_in(site.only))

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return all settings that a :class:`RefinedSprites` reads when it is built."""
        shadows = cast_from(settings) if settings.plants.shaded else ()
        shared = settings.transparent
        return (*planted_from(settings), shared.trilinear, shared.places, shared.surround, shadows)

    def __init__(
        self, settings: Settings, assets: Assets, ground: Ground, seed: int, kinds: set[str]
    ) -> None:
        """Place the sprites by ``seed`` and load the atlas; ``kinds`` are those to show."""
        self.settings = settings
        self._paths = [assets.path(name) for name in individuals.files(settings)]
        self._contents = [content(path) for path in self._paths]
        self._surround = settings.transparent.surround
        self._outlines, self._outline_st, *levels = recall(
            ["refined atlas", self._surround, *self._contents], self._make_atlas
        )
        self._rows = len(levels[0]) // CELL
        self._unshaded: Ground | None = ground if settings.plants.shaded else None
        large = content(assets.path(settings.ground.large_texture))
        what = repr((planted_from(settings), seed, sorted(kinds)))
        if settings.transparent.places == RANDOM:
            found = recall(
                (what, ground.field.heights.tobytes(), large),
                lambda: tuple(vars(plant_refined(settings, ground, seed, kinds)).values()),
            )
            self.stand(TintedSprites(*found))
        else:
            path = assets.path(settings.transparent.places, "transparent.places")
            self.stand(planted_by_file(settings, path, ground.field, kinds))

        self._texture = Texture(levels, repeat=False, trilinear=settings.transparent.trilinear)
        self._topped = False

    def stand(self, sprites: TintedSprites) -> None:
        """Place these sprites on the island, and no others."""
        self.sprites = sprites
        self._view: SpritesInView | None = None

    def _make_atlas(self) -> tuple[np.ndarray, ...]:
        """Return the pictures' outlines and the atlas's mip levels."""
        cells = self._cells()
        levels = bled_levels if len(cells) == individuals.CELL_COUNT else mip_levels
        return (*outlines(cells), *levels(cells))

    def _cells(self) -> list[np.ndarray]:
        """Return the atlas's cells; the one before the herbs is for the pictures from above."""
        pictures = read_cells(self._paths, self._surround)
        every = len(pictures) > len(CELLS) + len(HERBS)
        return individuals.cells_of(pictures) if every else with_herbs(pictures)

    def cast(self, shadows: ShadowMap) -> None:
        """Cast the sprites' shadows, and darken the ground at the trees' feet."""
        shown = replace(self.sprites, cells=self.sprites.pictures)
        cast_sprites(shadows, shown, [cell[GUTTER:, :, 3] for cell in self._cells()])
        trees = self.sprites.cells < DEER
        widths = self.sprites.sizes[trees, 0]
        shadows.hide_sky(self.sprites.positions[trees], CROWN_SHADE * widths, SKY_HIDDEN)

    def shade(self, ground: Ground) -> None:
        """Darken the plants by the shadows on the ground beside them."""
        plants = np.flatnonzero(self.sprites.cells >= PLANT)
        # Looked up on its sunny side: elsewhere a plant would be in its own shadow.
        sunward = direction(self.settings.sun)[[0, 2]]
        step = SUNWARD * self.sprites.sizes[plants, 1:] * sunward
        x, z = (self.sprites.positions[plants][:, [0, 2]] + step).T
        shadow = ground.light(x, z) / self.settings.sun.tint
        self.sprites.tints[plants, :3] *= np.minimum(shadow, 1.0) ** SHADE
        if clouds_shade(self.settings):
            # On trees and deer no shadows fall but those of clouds.
            tall = np.flatnonzero(self.sprites.cells < PLANT)
            x, _, z = self.sprites.positions[tall].T
            self.sprites.tints[tall, :3] *= cloud_light(self.settings, ground.field, x, z) ** SHADE
        self._view = None

    def prepare(self, frame: Frame) -> tuple[np.ndarray, ...]:
        """Return the frame's vertices, colours, texture coordinates and sorted indices."""
        if self._unshaded:
            # The first frame comes after all shadows have been baked into the ground.
            self.shade(self._unshaded)
            self._unshaded = None
        if self._view is None:
            arrays = self._outlines, self._outline_st, self._rows
            self._view = SpritesInView(LaidOut(self.sprites, *arrays))
        return self._view.arrays(frame, self.settings)

    def _fill_tops(self) -> None:
        """Add the pictures from above to the bound atlas, once, when they are first needed."""
        levels = recall(["tops", *self._contents], lambda: tops_levels(self._cells()))
        for level, images in enumerate(levels):
            for number, image in enumerate(images):
                box = tops_place(number, level)
                gl.glTexSubImage2D(
                    gl.GL_TEXTURE_2D, level, *box, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image
                )
        self._topped = True

    def draw(self, frame: Frame, prepared: tuple[np.ndarray, ...] | None = None) -> None:
        """Blend the sprites, far to near, in the order that :meth:`prepare` found."""
        settings = self.settings
        vertices, tints, coordinates, indices = prepared or self.prepare(frame)
        if not len(indices):
            return
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups | gl.GL_CURRENT_BIT):
            if settings.transparent.textured:
                blend_pictures(self._texture)
                tops = settings.trees.crown, settings.plants.rosette, backs_fit(settings)
                if any(tops) and not self._topped:
                    self._fill_tops()

            with client_arrays(vertices, None, tints, [coordinates]):
                gl.glDrawElements(gl.GL_TRIANGLES, indices.size, gl.GL_UNSIGNED_INT, indices)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the atlas; may be called twice."""
        self._texture.release()
