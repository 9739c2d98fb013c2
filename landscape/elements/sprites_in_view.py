"""What a frame shows of the sprites, as arrays for one glDrawElements, far to near. No OpenGL.

A frame asks for it once and draws it twice, mirrored and straight. What a sprite never changes
(its place, picture and tint) is laid out once in the form that OpenGL takes, float32 and uint8; a
frame gathers the rows it needs and adds what depends on the eye: the quads' corners, alpha, order.
"""

import math
from dataclasses import dataclass

import numpy as np

from landscape.elements.atlas import (
    FLOWERING,
    cell_coordinates,
    top_coordinates,
)
from landscape.elements.planting import DEER, PLANT, Sprites
from landscape.elements.sprite_quads import (
    HALVES,
    QUAD,
    Quads,
    billboards,
    crossed_quads,
    edge_on,
    half_places,
    lying,
    slope_axes,
    smoothstep,
    sway,
    upright_axes,
    within,
)
from landscape.frame import Frame, in_view
from landscape.settings import Settings

# Sines of the angle of a view from above, all chosen: between which a view from above comes in,
# and the upright picture goes.
COMES, GOES = (0.35, 0.70), (0.80, 0.97)
ROSETTE_HEIGHT, ROSETTE_WIDTH = 0.30, 1.25  # chosen: times the plant's height and width
BLOOM_HEIGHT, BLOOM_WIDTH = 0.65, 0.90  # chosen: the same of the herbs that flower
CROWN_HEIGHT, CROWN_WIDTH = 0.62, 0.95  # chosen: times the tree's height and width
FOOT = 0.07  # chosen: half a trunk, times the tree's width
TRIM_WITHIN = 8.0  # chosen: units; farther billboards are too small for trimming to pay
CROSSFADE = (0.80, 0.90, 1.0)  # chosen: times plants.crossed_within; see crossing
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


def own_turn(positions: np.ndarray) -> np.ndarray:
    """Return an angle in radians (n,) of its own for every place (n, 3)."""
    return np.asarray(7.0 * (positions[:, 0] + positions[:, 2]))


def turned(positions: np.ndarray, quads: int) -> np.ndarray:
    """Return the angles (n, k) of a plant's crossed quads, in radians from x to z.

    Two stand along x and z; three at 60 degrees, each plant turned by its own angle.
    """
    own = own_turn(positions) if quads > 2 else np.zeros(len(positions))
    return np.asarray(own[:, None] + np.arange(quads) * (np.pi / quads))


def rooted(sprites: Sprites) -> np.ndarray:
    """Return the places (n, 3) with trees and plants sunk where the ground slopes.

    By the slope times half the trunk: the foot's lower side then touches the ground.
    """
    steep = np.hypot(sprites.slopes[:, 0], sprites.slopes[:, 1])
    sunk = FOOT * steep * sprites.sizes[:, 0]
    places = sprites.positions.copy()
    places[:, 1] -= np.where(is_deer(sprites.cells), 0.0, sunk)
    return places


def reach(settings: Settings) -> float:
    """Return how far sprites are drawn; sprites that fade stop where the fog hides all."""
    shared, fog = settings.transparent, settings.fog
    if shared.fade and fog.enabled and fog.mode == "exp2" and fog.density > 0:
        return min(shared.radius, math.sqrt(math.log(HAZE)) / fog.density)
    return shared.radius


def radii(settings: Settings, cells: np.ndarray, heights: np.ndarray, frame: Frame) -> np.ndarray:
    """Return how far sprites of these atlas cells and heights (n,) are drawn, float32 units.

    No farther than ``transparent.radius`` and ``plants.radius``, and as far as they are at least
    ``transparent.least`` pixels high.
    """
    far, least = reach(settings), settings.transparent.least
    plants = np.float32(min(far, settings.plants.radius or far))
    out = np.where(cells >= PLANT, plants, np.float32(far))
    return np.minimum(out, heights * np.float32(frame.pixels / least)) if least else out


def clearness(
    settings: Settings, radius: np.ndarray, widths: np.ndarray, away: np.ndarray
) -> np.ndarray:
    """Return 0..1 (n,), how much is seen of sprites of these widths, ``away`` units off.

    They fade towards their ``radius`` (``transparent.fade``), and before the eye passes through
    them (``transparent.clear_near``).
    """
    shared, out = settings.transparent, np.ones_like(away)
    if shared.fade:
        out *= np.clip((radius - away) / (np.float32(shared.fade) * radius), 0.0, 1.0)
    if shared.clear_near:
        gone, whole = CLEARS
        near = np.flatnonzero(away < whole * widths)
        part = (away[near] / widths[near] - gone) / (whole - gone)
        out[near] *= np.clip(part, 0.0, 1.0)
    return out


def crossing(settings: Settings, away: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the alpha (n,) of plants as single and as crossed quads, ``away`` (n,) units off.

    One comes in before the other goes, so that nothing of the change is seen while walking.
    """
    far = settings.plants.crossed_within
    if not far:
        return np.zeros_like(away), np.ones_like(away)
    start, both, end = (far * part for part in CROSSFADE)
    return smoothstep(start, both, away), 1.0 - smoothstep(both, end, away)


def has_top(settings: Settings, cells: np.ndarray) -> np.ndarray:
    """Return which sprites (n,) have a picture for who looks from above, by their atlas cells."""
    plants, trees = settings.plants.rosette, settings.trees.crown
    return np.asarray(np.where(cells >= PLANT, plants, (cells < DEER) & trees))


@dataclass(frozen=True)
class Seen:
    """Sprites that a frame shows: their numbers (n,) and, of each, what several quads need.

    ``away`` is the distance on the map in units, ``below`` the sine of the angle at which the view
    goes down to it, ``depth`` the eye-space z, ``alpha`` 0..1.
    """

    which: np.ndarray
    positions: np.ndarray
    sizes: np.ndarray
    cells: np.ndarray
    away: np.ndarray
    below: np.ndarray
    depth: np.ndarray
    alpha: np.ndarray

    def only(self, kept: np.ndarray) -> "Seen":
        """Return those of a mask (n,), or of an array of indices."""
        return Seen(*(values[kept] for values in vars(self).values()))


class SpriteView:
    """All sprites of the island, and what a frame shows of them."""

    def __init__(
        self, sprites: Sprites, outlines: np.ndarray, outline_coordinates: np.ndarray, rows: int
    ) -> None:
        """Lay out what never changes; ``outlines`` are the boxes of the pictures, see outlines."""
        self._places = {
            False: np.ascontiguousarray(sprites.positions, np.float32),
            True: np.ascontiguousarray(rooted(sprites), np.float32),
        }
        self._sizes = np.ascontiguousarray(sprites.sizes, np.float32)
        self._cells, self._slopes, self._rows = sprites.cells, sprites.slopes, rows
        self._looks = sprites.flipped.astype(int)
        self._flipped = sprites.flipped
        self._tints = sprites.tints.astype(np.uint8)
        self._coordinates = cell_coordinates(
            sprites.cells, sprites.flipped, CORNER_S, CORNER_T, rows
        )
        self._outlines, self._outline_coordinates = outlines, outline_coordinates

    def arrays(self, frame: Frame, settings: Settings) -> tuple[np.ndarray, ...]:
        """Return vertices, colours, texture coordinates and indices, sorted if they are to be."""
        seen = self.seen(frame, settings)
        plant = seen.cells >= PLANT
        board = ~plant
        if within := settings.plants.crossed_within:
            board |= seen.away > CROSSFADE[0] * within
            plant &= seen.away < within
        near = board & (seen.away < TRIM_WITHIN) & settings.transparent.trimmed
        parts = [self._boards(frame, settings, seen.only(np.flatnonzero(board & ~near)))]
        if near.any():
            parts.append(self._boards(frame, settings, seen.only(near), trimmed=True))
        if plant.any():
            parts.append(self._crossed(frame, settings, seen.only(plant)))
        if settings.trees.crown or settings.plants.rosette:
            top = has_top(settings, seen.cells) & (seen.below > COMES[0])
            if top.any():
                parts.append(self._tops(frame, settings, seen.only(top)))
        quads = Quads.join(parts)
        return (
            np.ascontiguousarray(quads.vertices, np.float32),
            quads.colours,
            quads.coordinates,
            quads.indices(settings.transparent.sorted),
        )

    def seen(self, frame: Frame, settings: Settings) -> Seen:
        """Return the sprites to draw, mirrored or not, in order of their numbers."""
        shared, places = settings.transparent, self._places[settings.transparent.rooted]
        radius = radii(settings, self._cells, self._sizes[:, 1], frame)
        if not shared.trimmed:
            which = visible_order(frame, places, radius, sort=False)
        else:
            dx, dz = places[:, 0] - frame.pose.x, places[:, 2] - frame.pose.z
            which = np.flatnonzero(dx * dx + dz * dz < radius * radius)
            sizes, middles = self._sizes[which], places[which]
            middles[:, 1] += 0.5 * sizes[:, 1]
            balls = sizes.sum(axis=1)
            kept = in_view(frame, middles, balls)
            if settings.reflection.enabled:
                middles[:, 1] = 2.0 * settings.water.level - middles[:, 1]
                kept |= in_view(frame, middles, balls)
            which = which[kept]
        positions, sizes, cells = places[which], self._sizes[which], self._cells[which]
        line = positions - frame.eye.astype(np.float32)
        flat = line[:, 0] * line[:, 0] + line[:, 2] * line[:, 2]
        away = np.sqrt(flat)
        below = -line[:, 1] / np.sqrt(np.maximum(flat + line[:, 1] * line[:, 1], 1e-12))
        alpha = clearness(settings, radius[which], sizes[:, 0], away)
        return Seen(which, positions, sizes, cells, away, below, frame.depth(positions), alpha)

    def _colours(self, seen: Seen, alpha: np.ndarray) -> np.ndarray:
        """Return the sprites' tints (n, 4) with this alpha (n,), or (n, k, 4) with (n, k)."""
        colours = self._tints[seen.which]
        if alpha.ndim == 2:
            colours = np.repeat(colours[:, None], alpha.shape[1], axis=1)
        colours[..., 3] = colours[..., 3] * alpha
        return colours

    def _boards(self, frame: Frame, settings: Settings, seen: Seen, trimmed: bool = False) -> Quads:
        """Return the billboards: trees, deer, and plants too far off to be more."""
        right, up = (
            upright_axes(frame.right) if settings.transparent.upright else (frame.right, frame.up)
        )
        quads = billboards(
            seen.positions, seen.sizes, right.astype(np.float32), up.astype(np.float32)
        )
        if settings.deer.follow_slope:
            deer = np.flatnonzero(is_deer(seen.cells))
            axes = slope_axes(frame.right, self._slopes[seen.which[deer]])
            quads[deer] = billboards(seen.positions[deer], seen.sizes[deer], *axes)
        alpha = seen.alpha.copy()
        above = np.flatnonzero(seen.below > GOES[0])
        if len(above):
            goes = smoothstep(*GOES, seen.below[above])
            alpha[above] *= 1.0 - goes * has_top(settings, seen.cells[above])
        plants = np.flatnonzero(seen.cells >= PLANT)
        alpha[plants] *= crossing(settings, seen.away[plants])[0]
        colours = self._colours(seen, alpha)
        if not trimmed:
            return Quads.of(quads, self._coordinates[seen.which], colours, QUAD, seen.depth)
        looks = self._looks[seen.which], seen.cells
        quads, coordinates = within(quads, self._outlines[looks]), self._outline_coordinates[looks]
        return Quads.of(quads, coordinates, colours, np.concatenate([QUAD, QUAD + 4]), seen.depth)

    def _crossed(self, frame: Frame, settings: Settings, seen: Seen) -> Quads:
        """Return the half quads of the plants."""
        count = settings.plants.quads
        winds = sway(frame.kt, seen.positions, settings.plants.sway)
        winds *= seen.sizes[:, 1:] / settings.plants.size_max
        turns = turned(seen.positions, count)
        quads = crossed_quads(seen.positions, seen.sizes, winds, turns if count > 2 else None)
        alpha = seen.alpha * crossing(settings, seen.away)[1]
        if settings.plants.rosette:
            alpha *= 1.0 - smoothstep(*GOES, seen.below)
        if settings.plants.fade_edge_on:
            line = seen.positions - frame.eye
            alpha = alpha[:, None] * np.repeat(edge_on(line, turns), 6, axis=1)
        s, t = np.tile(CROSS_S, count), np.tile(CROSS_T, count)
        flipped = self._flipped[seen.which]
        coordinates = cell_coordinates(seen.cells, flipped, s, t, self._rows)
        depth = seen.depth
        if settings.transparent.split:
            depth = frame.depth(half_places(quads))
        bases = 6 * np.arange(count, dtype=np.uint32)[:, None, None]
        pattern = (HALVES + bases).reshape(-1, 6)
        return Quads.of(quads, coordinates, self._colours(seen, alpha), pattern, depth)

    def _tops(self, frame: Frame, settings: Settings, seen: Seen) -> Quads:
        """Return the crowns and rosettes of what is seen from above."""
        plant, middles = seen.cells >= PLANT, seen.positions.copy()
        looks = [plant & np.isin(seen.cells, FLOWERING), plant]
        rise = np.select(looks, [BLOOM_HEIGHT, ROSETTE_HEIGHT], CROWN_HEIGHT)
        middles[:, 1] += seen.sizes[:, 1] * rise
        widths = seen.sizes[:, 0] * np.select(looks, [BLOOM_WIDTH, ROSETTE_WIDTH], CROWN_WIDTH)
        colours = self._colours(seen, seen.alpha * smoothstep(*COMES, seen.below))
        slopes = self._slopes[seen.which] * plant[:, None]
        quads = lying(middles, widths, slopes, own_turn(middles))
        coordinates = top_coordinates(seen.cells, self._rows)
        return Quads.of(quads, coordinates, colours, QUAD, frame.depth(middles))
