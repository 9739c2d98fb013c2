"""What a frame shows of the sprites, as arrays for one glDrawElements, far to near. No OpenGL.

A frame asks for it once and draws it twice, mirrored and straight. The sprites that may show are
chosen for several frames at once (:class:`Choice`), and all that stays the same of them is laid out
in the form that OpenGL takes, float32 and uint8; a frame adds what depends on the eye: the quads'
corners, alpha, order.
"""

from dataclasses import dataclass

import numpy as np

from landscape.elements.sprites.atlas import FLOWERING, cell_coordinates, top_coordinates
from landscape.elements.sprites.planting import PLANT, Sprites
from landscape.elements.sprites.sprite_quads import (
    HALVES,
    QUAD,
    Quads,
    billboards,
    crossed_quads,
    edge_on,
    half_places,
    leaning,
    lying,
    slope_axes,
    smoothstep,
    sway,
    upright_axes,
    within,
)
from landscape.elements.sprites.sprite_rules import (
    clearness,
    crossing,
    has_top,
    is_deer,
    radii,
    visible_order,
)
from landscape.frame import Frame
from landscape.geometry.camera import REUSE_ANGLE, REUSE_DISTANCE, in_view, is_near
from landscape.settings import Settings

# Sines of the angle of a view from above, all chosen: between which a view from above comes in,
# and the upright picture goes.
COMES, GOES = (0.35, 0.70), (0.80, 0.97)
ROSETTE_HEIGHT, ROSETTE_WIDTH = 0.30, 1.25  # chosen: times the plant's height and width
BLOOM_HEIGHT, BLOOM_WIDTH = 0.65, 0.90  # chosen: the same of the herbs that flower
CROWN_HEIGHT, CROWN_WIDTH = 0.62, 0.95  # chosen: times the tree's height and width
FOOT = 0.07  # chosen: half a trunk, times the tree's width
TRIM_WITHIN = 8.0  # chosen: units; farther billboards are too small for trimming to pay

TWO_BOXES = np.concatenate([QUAD, QUAD + 4])  # what is opaque in a picture, see outlines
CORNER_S, CORNER_T = np.array([0, 1, 1, 0.0]), np.array([1, 1, 0, 0.0])
CROSS_S, CROSS_T = np.array([0, 0.5, 1.0, 0, 0.5, 1.0]), np.repeat([1.0, 0.0], 3)


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


@dataclass(frozen=True)
class Choice:
    """Sprites that may show while the eye stays about where it is, in order of their numbers.

    Of each the place (n, 3), size (n, 2), atlas cell and radius; where the deer, and those with a
    picture from above are; of their billboards texture coordinates (n, 4, 2), the tint's opacity
    (n,) in 0..255, colours (n, 4, 4), whose alpha each frame writes, and triangles (n, 6); and
    boxes of what is opaque in their pictures (n, 8, 2), on the quad and in the atlas.
    """

    made_for: tuple[Frame, Settings]
    which: np.ndarray
    positions: np.ndarray
    sizes: np.ndarray
    cells: np.ndarray
    radius: np.ndarray
    deer: np.ndarray
    topped: np.ndarray
    coordinates: np.ndarray
    opacity: np.ndarray
    colours: np.ndarray
    triangles: np.ndarray
    boxes: tuple[np.ndarray, np.ndarray]
    crossed: "Crossed"


@dataclass(frozen=True)
class Crossed:
    """Plants so near that they may be crossed quads: their numbers in a choice, (m,).

    ``turns`` (m, k) are the angles of their k quads, ``still`` (m, 6 k, 3) these without wind,
    ``feet`` (m, 2 k, 3) the middles of the half quads' feet, and texture coordinates (m, 6 k, 2).
    """

    which: np.ndarray
    turns: np.ndarray
    still: np.ndarray
    feet: np.ndarray
    coordinates: np.ndarray


@dataclass(frozen=True)
class Seen:
    """How the eye sees each sprite of a choice, (n,) each.

    ``away`` is the distance on the map in units, ``below`` the sine of the angle at which the view
    goes down to it, ``depth`` the eye-space z, ``alpha`` 0..1.
    """

    away: np.ndarray
    below: np.ndarray
    depth: np.ndarray
    alpha: np.ndarray


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
        self._leaning = leaning(sprites.slopes).astype(np.float32)
        self._flipped = sprites.flipped
        self._tints = sprites.tints.astype(np.uint8)
        self._coordinates = cell_coordinates(
            sprites.cells, sprites.flipped, CORNER_S, CORNER_T, rows
        )
        self._outlines, self._outline_coordinates = outlines, outline_coordinates
        self._choice: Choice | None = None
        self._crowns: dict[bool, tuple[np.ndarray, ...]] = {}

    def arrays(self, frame: Frame, settings: Settings) -> tuple[np.ndarray, ...]:
        """Return vertices, colours, texture coordinates and indices, sorted if they are to be."""
        choice = self.choice(frame, settings)
        seen = self._seen(frame, settings, choice)
        plants = choice.crossed.which
        single, crossed = crossing(settings, seen.away[plants])
        alpha = seen.alpha.copy()
        alpha[plants] *= single
        parts = self._boards(frame, settings, choice, seen, alpha)
        crossed *= seen.alpha[plants]
        near = np.flatnonzero(crossed)
        if len(near):
            parts.append(self._crossed(frame, settings, choice, seen, near, crossed[near]))
        top = np.flatnonzero(choice.topped & (seen.below > COMES[0]))
        if len(top):
            parts.append(self._tops(frame, settings, choice, seen, top))
        quads = Quads.join(parts) if len(parts) > 1 else parts[0]
        return (
            np.ascontiguousarray(quads.vertices, np.float32),
            quads.colours,
            quads.coordinates,
            quads.indices(settings.transparent.sorted),
        )

    def choice(self, frame: Frame, settings: Settings) -> Choice:
        """Return the sprites that may show, mirrored or not: the last choice while it serves.

        What it holds too much does not show: it lies beside the window, or has faded away. Without
        ``transparent.fade`` and ``transparent.trimmed`` each place of the eye has its own choice.
        """
        shared = settings.transparent
        reusable = shared.fade and shared.trimmed
        spare, turn = (REUSE_DISTANCE, REUSE_ANGLE) if reusable else (0.0, 0.0)
        if self._choice is not None:
            then, chosen_settings = self._choice.made_for
            if chosen_settings is settings and is_near(then, frame, spare, turn):
                return self._choice
        places = self._places[shared.rooted]
        radius = radii(settings, self._cells, self._sizes[:, 1], frame)
        if shared.trimmed:
            which = self._around(frame, settings, places, radius, spare, turn)
        else:
            which = visible_order(frame, places, radius, sort=False)
        cells = self._cells[which]
        looks = self._flipped[which].astype(int), cells
        self._choice = Choice(
            made_for=(frame, settings),
            which=which,
            positions=places[which],
            sizes=self._sizes[which],
            cells=cells,
            radius=radius[which],
            deer=np.flatnonzero(is_deer(cells)),
            topped=has_top(settings, cells),
            coordinates=self._coordinates[which],
            opacity=self._tints[which, 3],
            colours=np.repeat(self._tints[which][:, None], 4, axis=1),
            triangles=4 * np.arange(len(which), dtype=np.uint32)[:, None] + QUAD,
            boxes=(self._outlines[looks], self._outline_coordinates[looks]),
            crossed=self._crossings(frame, settings, places, which, spare),
        )
        return self._choice

    def _around(
        self,
        frame: Frame,
        settings: Settings,
        places: np.ndarray,
        radius: np.ndarray,
        spare: float,
        turn: float,
    ) -> np.ndarray:
        """Return the numbers of what may show within ``spare`` units and ``turn`` radians."""
        dx, dz = places[:, 0] - frame.pose.x, places[:, 2] - frame.pose.z
        flat, reach = dx * dx + dz * dz, radius + np.float32(spare)
        which = np.flatnonzero(flat < reach * reach)
        sizes, middles = self._sizes[which], places[which]
        middles[:, 1] += 0.5 * sizes[:, 1]
        mirrored = middles.copy()
        mirrored[:, 1] = 2.0 * settings.water.level - mirrored[:, 1]
        kept = np.zeros(len(which), bool)
        for points in (middles, mirrored) if settings.reflection.enabled else (middles,):
            away = np.sqrt(flat[which] + np.square(points[:, 1] - np.float32(frame.eye_y)))
            balls = sizes.sum(axis=1) + np.float32(spare) + np.float32(turn) * away
            kept |= in_view(frame, points, balls)
        return which[kept]

    def _crossings(
        self,
        frame: Frame,
        settings: Settings,
        places: np.ndarray,
        which: np.ndarray,
        spare: float,
    ) -> Crossed:
        """Return the plants that may be crossed quads."""
        far = settings.plants.crossed_within or np.inf
        points = places[which]
        away = np.hypot(points[:, 0] - frame.pose.x, points[:, 2] - frame.pose.z)
        near = np.flatnonzero((self._cells[which] >= PLANT) & (away < far + spare))
        count, own = settings.plants.quads, which[near]
        turns = turned(points[near], count)
        calm = np.zeros((len(near), 2), np.float32)
        still = crossed_quads(points[near], self._sizes[own], calm, turns if count > 2 else None)
        s, t = np.tile(CROSS_S, count), np.tile(CROSS_T, count)
        coordinates = cell_coordinates(self._cells[own], self._flipped[own], s, t, self._rows)
        return Crossed(near, turns, still, half_places(still), coordinates)

    def _seen(self, frame: Frame, settings: Settings, choice: Choice) -> Seen:
        """Return how the eye of a frame sees the sprites of a choice."""
        line = choice.positions - frame.eye.astype(np.float32)
        x, y, z = line.T
        flat = x * x + z * z
        away = np.sqrt(flat)
        below = -y / np.sqrt(np.maximum(flat + y * y, 1e-12))
        alpha = clearness(settings, choice.radius, choice.sizes[:, 0], away)
        return Seen(away, below, frame.depth(choice.positions), alpha)

    def _boards(
        self, frame: Frame, settings: Settings, choice: Choice, seen: Seen, alpha: np.ndarray
    ) -> list[Quads]:
        """Return the billboards of ``alpha`` (n,) over 0: trees, deer, plants too far to be more.

        Corners and colours are reckoned of all sprites, which costs less than to pick some.
        """
        right, up = (
            upright_axes(frame.right) if settings.transparent.upright else (frame.right, frame.up)
        )
        quads = billboards(
            choice.positions, choice.sizes, right.astype(np.float32), up.astype(np.float32)
        )
        deer = choice.deer
        if settings.deer.follow_slope and len(deer):
            axes = slope_axes(frame.right, self._leaning[choice.which[deer]])
            quads[deer] = billboards(choice.positions[deer], choice.sizes[deer], *axes)
        board = alpha > 0.0
        above = np.flatnonzero(choice.topped & (seen.below > GOES[0]))
        if len(above):
            alpha[above] *= 1.0 - smoothstep(*GOES, seen.below[above])
        colours = choice.colours
        colours[..., 3] = (choice.opacity * alpha)[:, None]
        close = board & (seen.away < (TRIM_WITHIN if settings.transparent.trimmed else 0.0))
        far, near = np.flatnonzero(board & ~close), np.flatnonzero(close)
        parts = [
            Quads(
                quads.reshape(-1, 3),
                choice.coordinates.reshape(-1, 2),
                colours.reshape(-1, 4),
                choice.triangles[far],
                seen.depth[far],
            )
        ]
        if len(near):
            corners, coordinates = (box[near] for box in choice.boxes)
            boxes = within(quads[near], corners)
            depth = seen.depth[near]
            parts.append(Quads.of(boxes, coordinates, colours[near, 0], TWO_BOXES, depth))
        return parts

    def _crossed(
        self,
        frame: Frame,
        settings: Settings,
        choice: Choice,
        seen: Seen,
        near: np.ndarray,
        alpha: np.ndarray,
    ) -> Quads:
        """Return the half quads of those plants that are ``near``, by their place in crossed."""
        crossed, count = choice.crossed, settings.plants.quads
        which, turns, quads = crossed.which[near], crossed.turns[near], crossed.still[near]
        positions, sizes = choice.positions[which], choice.sizes[which]
        winds = sway(frame.kt, positions, settings.plants.sway)
        winds *= sizes[:, 1:] / settings.plants.size_max
        quads[:, 4::6, ::2] += winds[:, None]
        if settings.plants.rosette:
            alpha = alpha * (1.0 - smoothstep(*GOES, seen.below[which]))
        if settings.plants.fade_edge_on:
            line = positions - frame.eye
            alpha = alpha[:, None] * np.repeat(edge_on(line, turns), 6, axis=1)
        depth = seen.depth[which]
        if settings.transparent.split:
            depth = frame.depth(crossed.feet[near])
        bases = 6 * np.arange(count, dtype=np.uint32)[:, None, None]
        pattern = (HALVES + bases).reshape(-1, 6)
        colours = tinted(self._tints[choice.which[which]], alpha)
        return Quads.of(quads, crossed.coordinates[near], colours, pattern, depth)

    def _tops(
        self, frame: Frame, settings: Settings, choice: Choice, seen: Seen, top: np.ndarray
    ) -> Quads:
        """Return the crowns and rosettes of what is seen from above, ``top`` of a choice."""
        which = choice.which[top]
        quads, coordinates, middles = (a[which] for a in self._lying(settings.transparent.rooted))
        alpha = seen.alpha[top] * smoothstep(*COMES, seen.below[top])
        colours = tinted(self._tints[which], alpha)
        return Quads.of(quads, coordinates, colours, QUAD, frame.depth(middles))

    def _lying(self, rooted: bool) -> tuple[np.ndarray, ...]:
        """Return quads (n, 4, 3), coordinates and middles (n, 3) of all sprites' views from above.

        Reckoned when one is first seen: they never change.
        """
        if rooted not in self._crowns:
            cells, sizes, middles = self._cells, self._sizes, self._places[rooted].copy()
            plant = cells >= PLANT
            looks = [plant & np.isin(cells, FLOWERING), plant]
            rise = np.select(looks, [BLOOM_HEIGHT, ROSETTE_HEIGHT], CROWN_HEIGHT)
            middles[:, 1] += sizes[:, 1] * rise
            widths = sizes[:, 0] * np.select(looks, [BLOOM_WIDTH, ROSETTE_WIDTH], CROWN_WIDTH)
            quads = lying(middles, widths, self._slopes * plant[:, None], own_turn(middles))
            coordinates = top_coordinates(cells, self._rows)
            self._crowns[rooted] = quads.astype(np.float32), coordinates, middles
        return self._crowns[rooted]


def tinted(tints: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """Return tints (n, 4) with this alpha (n,), or (n, k, 4) with (n, k)."""
    colours = tints if alpha.ndim == 1 else np.repeat(tints[:, None], alpha.shape[1], axis=1)
    colours[..., 3] = colours[..., 3] * alpha
    return colours
