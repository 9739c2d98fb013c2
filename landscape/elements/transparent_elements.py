"""Trees, deer and plants: sprites that must be sorted (Transparent_elements, section 5.1 and 5.2).

Techniques: billboards, quads spanned by the camera's right and up vectors as read from the
modelview matrix, so that they always face it; crossed quads, two fixed quads at right angles whose
top-centre vertex sways. Blending wants far before near, and the z buffer cannot do that: all of
them together are sorted by their eye-space depth. All sprites share one texture, an atlas, so that
one glDrawElements draws them in any order.
Cures of section 11.2, all by vertices and vertex alpha: upright billboards, deer that stand on the
slope, half quads sorted one by one, quads that fade edge-on, crowns and rosettes from above.
State used: GL_BLEND, GL_ALPHA_TEST, GL_TEXTURE_2D, depth writes off. OpenGL 1.1.
"""

import math

import numpy as np

from landscape.assets import Assets
from landscape.cache import content, recall
from landscape.elements.atlas import (
    CELL,
    CELLS,
    COLUMNS,
    FLOWERING,
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
    top_coordinates,
    tops_cell,
)
from landscape.elements.ground import Ground
from landscape.elements.planting import DEER, PLANT, Sprites, plant_everything
from landscape.elements.shadows import SKY_HIDDEN, ShadowMap, cast_sprites
from landscape.elements.sprite_quads import (
    HALVES,
    QUAD,
    Quads,
    billboards,
    box_corners,
    crossed_quads,
    edge_on,
    half_places,
    lying,
    slope_axes,
    smoothstep,
    steepness,
    sway,
    upright_axes,
    within,
)
from landscape.elements.sun import direction
from landscape.frame import Frame, in_view
from landscape.gl.calls import gl
from landscape.gl.state import attrib, client_arrays
from landscape.gl.texture import Texture, mip_chain, read_image
from landscape.settings import Settings

# Sines of the angle of a view from above, all chosen: between which a view from above comes in,
# and the upright picture goes.
COMES, GOES = (0.35, 0.70), (0.80, 0.97)
ROSETTE_HEIGHT, ROSETTE_WIDTH = 0.30, 1.25  # chosen: times the plant's height and width
BLOOM_HEIGHT, BLOOM_WIDTH = 0.65, 0.90  # chosen: the same of the herbs that flower
CROWN_HEIGHT, CROWN_WIDTH = 0.62, 0.95  # chosen: times the tree's height and width
FOOT = 0.07  # chosen: half a trunk, times the tree's width
TRIM_WITHIN = 8.0  # chosen: units; farther billboards are too small for trimming to pay
CROWN_SHADE = 0.6  # chosen: how far a crown hides the sky from the ground, times the tree's width
CROSSFADE = (0.80, 0.90, 1.0)  # chosen: times plants.crossed_within; see _single
SHADE = 0.5  # chosen: power of the ground's light; a plant stands up into more of it
SUNWARD = 0.8  # chosen: times its height, how far sunward of a plant its light is asked for
CLEARS = (0.2, 0.5)  # chosen: a sprite is gone, and whole, that many of its widths away
HAZE = 512.0  # what less than 1 part in 512 is left of is not to be told from the fog

CORNER_S, CORNER_T = np.array([0, 1, 1, 0.0]), np.array([1, 1, 0, 0.0])
CROSS_S, CROSS_T = np.array([0, 0.5, 1.0, 0, 0.5, 1.0]), np.repeat([1.0, 0.0], 3)


def visible_order(
    frame: Frame, positions: np.ndarray, radius: float | np.ndarray, sort: bool = True
) -> np.ndarray:
    """Return the indices of what is before the camera and within ``radius``, far to near."""
    depth = frame.depth(positions)
    dx, dz = positions[:, 0] - frame.pose.x, positions[:, 2] - frame.pose.z
    seen = np.flatnonzero((depth < 0) & (dx * dx + dz * dz < radius * radius))
    return seen[np.argsort(depth[seen], kind="stable")] if sort else seen


def is_deer(cells: np.ndarray) -> np.ndarray:
    """Return which sprites (n,) are deer, by their atlas cells."""
    return np.asarray((cells >= DEER) & (cells < PLANT))


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


def own_turn(positions: np.ndarray) -> np.ndarray:
    """Return an angle in radians (n,) of its own for every place (n, 3)."""
    return np.asarray(7.0 * (positions[:, 0] + positions[:, 2]))


def turned(positions: np.ndarray, quads: int) -> np.ndarray:
    """Return the angles (n, k) of a plant's crossed quads, in radians from x to z.

    Two stand along x and z; three at 60 degrees, each plant turned by its own angle.
    """
    own = own_turn(positions) if quads > 2 else np.zeros(len(positions))
    return np.asarray(own[:, None] + np.arange(quads) * (np.pi / quads))


class TransparentElements:
    """All sprites of the island, in one sort."""

    def __init__(
        self, settings: Settings, assets: Assets, ground: Ground, seed: int, kinds: set[str]
    ) -> None:
        """Draw the places by lot (``seed``) and load the atlas; ``kinds`` are those to show."""
        self.elements = tuple(k for k in ("trees", "deer", "plants") if k in kinds)
        self._settings = settings
        self.sprites = self._planted(assets, ground, seed, kinds)
        self._ground: Ground | None = ground if settings.plants.shaded else None
        herbs = HERBS if settings.plants.species > 1 else ()
        self._paths = [assets.path(name) for name in (*CELLS, *herbs)]

        def pictures() -> tuple[np.ndarray, ...]:
            cells = self._cells()
            chains = [mip_chain(cell, LEVELS) for cell in cells]
            levels = [atlas([chain[level] for chain in chains]) for level in range(LEVELS)]
            return (*outlines(cells), *levels)

        what: list[bytes | str] = ["atlas", *(content(path) for path in self._paths)]
        self._outlines, self._outline_coordinates, *levels = recall(what, pictures)
        self._rows = len(levels[0]) // CELL
        self._texture = Texture(levels, repeat=False)
        self._topped = False

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
        shared, sprites = self._settings.transparent, self.sprites
        seen = self._seen(frame)
        if shared.rooted:
            sprites = rooted(sprites, seen)
        plant = sprites.cells[seen] >= PLANT
        far = np.hypot(*(sprites.positions[seen] - frame.eye)[:, [0, 2]].T)
        board = ~plant
        if within := self._settings.plants.crossed_within:
            board |= far > CROSSFADE[0] * within
            plant &= far < within
        boards = seen[board]
        near = shared.trimmed & (far[board] < TRIM_WITHIN)
        parts = [self._boards(frame, sprites, boards[~near])]
        if near.any():
            parts.append(self._boards(frame, sprites, boards[near], trimmed=True))
        parts.append(self._crossed(frame, sprites, seen[plant]))
        if self._from_above():
            parts.append(self._tops(frame, sprites, seen))
        quads = Quads.join(parts)
        return (
            np.ascontiguousarray(quads.vertices, np.float32),
            np.ascontiguousarray(quads.colours, np.uint8),
            np.ascontiguousarray(quads.coordinates, np.float32),
            quads.indices(shared.sorted),
        )

    def _from_above(self) -> bool:
        """Return whether anything has a picture for who looks from above."""
        return self._settings.trees.crown or self._settings.plants.rosette

    def _has_top(self, cells: np.ndarray) -> np.ndarray:
        """Return which sprites (n,) have such a picture, by their atlas cells."""
        plants, trees = self._settings.plants.rosette, self._settings.trees.crown
        return np.asarray(np.where(cells >= PLANT, plants, (cells < DEER) & trees))

    def _fill_tops(self) -> None:
        """Add the views from above to the bound atlas, once, when they are first asked for."""
        cells = self._cells()
        for number in range(len(TOPS_CELLS) if len(cells) > len(CELLS) else 1):
            row, column = divmod(TOPS_CELLS[number], COLUMNS)
            for level, image in enumerate(mip_chain(tops_cell(cells, number), LEVELS)):
                side = CELL >> level
                box = side * column, side * row, side, side
                gl.glTexSubImage2D(
                    gl.GL_TEXTURE_2D, level, *box, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image
                )
        self._topped = True

    def _seen(self, frame: Frame) -> np.ndarray:
        """Return the indices of the sprites to draw, in order of their numbers."""
        settings, sprites = self._settings, self.sprites
        radius = self._radii(sprites.cells)
        if not settings.transparent.trimmed:
            return visible_order(frame, sprites.positions, radius, sort=False)
        dx, dz = sprites.positions[:, 0] - frame.pose.x, sprites.positions[:, 2] - frame.pose.z
        near = np.flatnonzero(dx * dx + dz * dz < radius * radius)
        middles = sprites.positions[near]
        middles[:, 1] += 0.5 * sprites.sizes[near, 1]
        reach = sprites.sizes[near].sum(axis=1)
        seen = in_view(frame, middles, reach)
        if settings.reflection.enabled:
            middles[:, 1] = 2.0 * settings.water.level - middles[:, 1]
            seen |= in_view(frame, middles, reach)
        return near[seen]

    def _radius(self) -> float:
        """Return how far sprites are drawn; sprites that fade stop where the fog hides all."""
        shared, fog = self._settings.transparent, self._settings.fog
        if shared.fade and fog.enabled and fog.mode == "exp2" and fog.density > 0:
            return min(shared.radius, math.sqrt(math.log(HAZE)) / fog.density)
        return shared.radius

    def _radii(self, cells: np.ndarray) -> np.ndarray:
        """Return how far each of the sprites with these atlas cells (n,) is drawn, units (n,)."""
        radius = self._radius()
        plants = self._settings.plants.radius
        return np.where(cells >= PLANT, min(radius, plants or radius), radius)

    def _colours(self, frame: Frame, sprites: Sprites, which: np.ndarray) -> np.ndarray:
        """Return the sprites' colours (n, 4) in 0..255; alpha fades towards the radius.

        With ``transparent.clear_near`` it fades as well before the eye passes through a sprite.
        """
        colours = sprites.tints[which]
        shared, radius = self._settings.transparent, self._radii(sprites.cells[which])
        if shared.fade or shared.clear_near:
            away = np.hypot(*(sprites.positions[which] - frame.eye)[:, [0, 2]].T)
            if shared.fade:
                colours[:, 3] *= np.clip((radius - away) / (shared.fade * radius), 0.0, 1.0)
            if shared.clear_near:
                gone, whole = CLEARS
                part = (away / sprites.sizes[which, 0] - gone) / (whole - gone)
                colours[:, 3] *= np.clip(part, 0.0, 1.0)
        return colours

    def _crossing(self, away: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the alpha (n,) of plants as single and as crossed quads, ``away`` (n,) units off.

        One comes in before the other goes, so that nothing of the change is seen while walking.
        """
        within = self._settings.plants.crossed_within
        if not within:
            return np.zeros(len(away)), np.ones(len(away))
        start, both, end = (within * part for part in CROSSFADE)
        return smoothstep(start, both, away), 1.0 - smoothstep(both, end, away)

    def _boards(
        self, frame: Frame, sprites: Sprites, which: np.ndarray, trimmed: bool = False
    ) -> Quads:
        """Return the billboards: trees, deer, and plants too far off to be more."""
        settings = self._settings
        positions, sizes, cells = (
            a[which] for a in (sprites.positions, sprites.sizes, sprites.cells)
        )
        colours = self._colours(frame, sprites, which)
        right, up = (
            upright_axes(frame.right) if settings.transparent.upright else (frame.right, frame.up)
        )
        quads = billboards(positions, sizes, right, up)
        deer = np.flatnonzero(is_deer(cells) & settings.deer.follow_slope)
        if len(deer):
            axes = slope_axes(frame.right, sprites.slopes[which[deer]])
            quads[deer] = billboards(positions[deer], sizes[deer], *axes)
        if self._from_above():
            goes = smoothstep(*GOES, steepness(positions - frame.eye))
            colours[:, 3] *= 1.0 - goes * self._has_top(cells)
        plants = np.flatnonzero(cells >= PLANT)
        if len(plants):
            away = np.hypot(*(positions[plants] - frame.eye)[:, [0, 2]].T)
            colours[plants, 3] *= self._crossing(away)[0]
        depth = frame.depth(positions)
        if not trimmed:
            coordinates = cell_coordinates(
                cells, sprites.flipped[which], CORNER_S, CORNER_T, self._rows
            )
            return Quads.of(quads, coordinates, colours, QUAD, depth)
        looks = sprites.flipped[which].astype(int), cells
        quads, coordinates = within(quads, self._outlines[looks]), self._outline_coordinates[looks]
        return Quads.of(quads, coordinates, colours, np.concatenate([QUAD, QUAD + 4]), depth)

    def _crossed(self, frame: Frame, sprites: Sprites, which: np.ndarray) -> Quads:
        """Return the half quads of the plants."""
        settings = self._settings
        count = settings.plants.quads
        positions, sizes = sprites.positions[which], sprites.sizes[which]
        winds = sway(frame.kt, positions, settings.plants.sway)
        winds *= sizes[:, 1:] / settings.plants.size_max
        turns = turned(positions, count)
        quads = crossed_quads(positions, sizes, winds, turns if count > 2 else None)
        colours = self._colours(frame, sprites, which)
        away = positions - frame.eye
        colours[:, 3] *= self._crossing(np.hypot(away[:, 0], away[:, 2]))[1]
        if settings.plants.rosette:
            colours[:, 3] *= 1.0 - smoothstep(*GOES, steepness(away))
        if settings.plants.fade_edge_on:
            colours = np.repeat(colours[:, None], 6 * count, axis=1)
            colours[..., 3] *= np.repeat(edge_on(away, turns), 6, axis=1)
        s, t = np.tile(CROSS_S, count), np.tile(CROSS_T, count)
        coordinates = cell_coordinates(
            sprites.cells[which], sprites.flipped[which], s, t, self._rows
        )
        depth = frame.depth(positions)
        if settings.transparent.split:
            depth = frame.depth(half_places(quads))
        bases = 6 * np.arange(count, dtype=np.uint32)[:, None, None]
        return Quads.of(quads, coordinates, colours, (HALVES + bases).reshape(-1, 6), depth)

    def _tops(self, frame: Frame, sprites: Sprites, seen: np.ndarray) -> Quads:
        """Return the crowns and rosettes of what is seen from above."""
        cells, positions = sprites.cells[seen], sprites.positions[seen]
        share = smoothstep(*COMES, steepness(positions - frame.eye))
        kept = np.flatnonzero(self._has_top(cells) & (share > 0))
        which, plant = seen[kept], cells[kept] >= PLANT
        sizes, middles = sprites.sizes[which], positions[kept]
        looks = [plant & np.isin(cells[kept], FLOWERING), plant]
        rise = np.select(looks, [BLOOM_HEIGHT, ROSETTE_HEIGHT], CROWN_HEIGHT)
        middles[:, 1] += sizes[:, 1] * rise
        widths = sizes[:, 0] * np.select(looks, [BLOOM_WIDTH, ROSETTE_WIDTH], CROWN_WIDTH)
        colours = self._colours(frame, sprites, which)
        colours[:, 3] *= share[kept]
        slopes = sprites.slopes[which] * plant[:, None]
        quads = lying(middles, widths, slopes, own_turn(middles))
        coordinates = top_coordinates(cells[kept], self._rows)
        return Quads.of(quads, coordinates, colours, QUAD, frame.depth(middles))

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


def rooted(sprites: Sprites, which: np.ndarray) -> Sprites:
    """Return sprites of which trees and plants among ``which`` are sunk where the ground slopes.

    By the slope times half the trunk: the foot's lower side then touches the ground.
    """
    steep = np.hypot(sprites.slopes[which, 0], sprites.slopes[which, 1])
    positions = sprites.positions.copy()
    sunk = FOOT * steep * sprites.sizes[which, 0]
    positions[which, 1] -= np.where(is_deer(sprites.cells[which]), 0.0, sunk)
    return Sprites(positions, *list(vars(sprites).values())[1:])
