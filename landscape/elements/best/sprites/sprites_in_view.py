"""What a frame shows of the refined sprites, as arrays for one glDrawElements. No OpenGL.

A frame computes them once and draws them twice, mirrored and not. :mod:`choice` selects the sprites
that may be visible; here a frame adds what depends on the eye: the quads' corners, alpha and order.
"""

import math
from dataclasses import dataclass

import numpy as np

from landscape.elements.best.sprites.choice import Choice, LaidOut, choose
from landscape.elements.best.sprites.contact import contact_quads
from landscape.elements.best.sprites.crossings import cut, cuts
from landscape.elements.best.sprites.individuals import ROWS
from landscape.elements.best.sprites.refined_atlas import FLOWERING, box_corners, top_coordinates
from landscape.elements.best.sprites.refined_quads import (
    Quads,
    edge_on,
    lying,
    own_turn,
    points_of,
    smoothstep,
)
from landscape.elements.best.sprites.relighting import changes, corner_light, light_at, lit
from landscape.elements.best.sprites.rules import clearness, crossing, is_deer
from landscape.elements.best.sprites.slope_billboards import place_axes, slope_axes, upright_axes
from landscape.elements.planting import PLANT
from landscape.elements.settings import Settings
from landscape.elements.sun import direction, painted
from landscape.elements.transparent_elements import HALVES, QUAD, billboards
from landscape.frame import Frame
from landscape.geometry.culling import REUSE_ANGLE, REUSE_DISTANCE, is_near
from landscape.geometry.wind import sway

# Sines of the angle at which the eye looks down on a picture from above, all chosen: between the
# first two it fades in, between the others the upright picture fades out.
COMES, GOES = (0.35, 0.70), (0.80, 0.97)
# Chosen: the picture's width, times that of a plant, of a herb that flowers, and of a tree.
ROSETTE_WIDTH = 1.25
BLOOM_WIDTH = 0.90
CROWN_WIDTH = 0.95
TRIM_WITHIN = 8.0  # chosen: units; farther billboards are too small for trimming to pay off
CUT_WITHIN = 5.0  # chosen: units; of farther ones one does not see which is in front
# Chosen: units that the eye may move, radians that it may turn, and the time, in kt, that may pass
# while a coarser frame shows the quads of the one before.
SERVES, SERVES_KT = (0.04, math.radians(1.5)), 2.0

FARTHER, WIDER = 3.0, 1.5  # chosen: times the margin and the angle of a choice for such frames

TWO_BOXES = np.concatenate([QUAD, QUAD + 4])  # what is opaque in a picture, see atlas.outlines


@dataclass(frozen=True)
class Seen:
    """How the eye sees each sprite of a choice, (n,) each.

    ``away`` is the horizontal distance in units, ``below`` the sine of the angle at which the eye
    looks down on its picture from above: negative for an eye below that, as a walker's is under a
    tree. ``depth`` is its place in the sort, see :func:`order_of`, ``alpha`` 0..1.
    """

    away: np.ndarray
    below: np.ndarray
    depth: np.ndarray
    alpha: np.ndarray


class SpritesInView:
    """All sprites of the island, and what a frame shows of them."""

    def __init__(self, laid_out: LaidOut) -> None:
        """Show these sprites."""
        self._all = laid_out
        self._choice: Choice | None = None
        self._chosen_for: tuple[Frame, Settings] | None = None
        self._last: tuple[Frame, Settings, tuple[np.ndarray, ...]] | None = None
        self._tops: dict[bool, tuple[np.ndarray, ...]] = {}

    def arrays(self, frame: Frame, settings: Settings) -> tuple[np.ndarray, ...]:
        """Return vertices, colours, texture coordinates and indices, sorted or not.

        In the coarser frames of a walk those of the frame before serve once more where the eye has
        hardly moved. All stand where they stand; what lags behind is how far they turn and sway.
        """
        if self._last is not None:
            then, chosen_settings, arrays = self._last
            soon = 0.0 <= frame.kt - then.kt <= SERVES_KT
            coarser = then.detail.coarser == frame.detail.coarser > 1.0
            if soon and coarser and chosen_settings is settings and is_near(then, frame, *SERVES):
                return arrays
        arrays = self._computed(frame, settings)
        self._last = frame, settings, arrays
        return arrays

    def _computed(self, frame: Frame, settings: Settings) -> tuple[np.ndarray, ...]:
        """Return what :meth:`arrays` does, for this very frame."""
        choice = self.choice(frame, settings)
        seen = self._seen(frame, settings, choice)
        plants = choice.crossed.which
        single, crossed = crossing(settings, seen.away[plants])
        alpha = seen.alpha.copy()
        alpha[plants] *= single
        light = corner_light(settings.sun, frame, settings.transparent.sunward)
        parts = self._boards(frame, settings, choice, seen, alpha, light)
        if settings.transparent.contact and self._all.rows == ROWS:
            slopes = self._all.slopes[choice.which]
            given = choice, seen.away, seen.alpha, seen.depth, slopes
            shadows = contact_quads(frame, settings, *given)
            parts += [shadows] if shadows else []

        crossed *= seen.alpha[plants]
        near = np.flatnonzero(crossed)
        if len(near):
            crosses = self._crossed(frame, settings, choice, seen, near, crossed[near])
            # Their quads stand at all angles: each has the mean light.
            relit = light if changes(settings.sun) else None
            parts.append(crosses if relit is None else crosses.lit(relit.mean(axis=0)))

        top = np.flatnonzero(choice.topped & (seen.below > COMES[0]))
        if len(top):
            crowns = self._from_above(frame, settings, choice, seen, top)
            overhead = painted(settings.sun, float(direction(settings.sun)[1]))
            parts.append(crowns.lit(overhead) if changes(settings.sun) else crowns)

        quads = Quads.join(parts) if len(parts) > 1 else parts[0]
        return (
            np.ascontiguousarray(quads.vertices, np.float32),
            quads.colours,
            quads.coordinates,
            quads.indices(settings.transparent.sorted),
        )

    def choice(self, frame: Frame, settings: Settings) -> Choice:
        """Return the sprites that may be visible: the last choice while it is valid, or a new one.

        Without ``transparent.fade`` an old choice would show sprites beyond their radius, and
        without ``transparent.trimmed`` a choice omits what is behind the eye: in either case each
        position of the eye needs its own choice.
        """
        shared = settings.transparent
        reusable = shared.fade and shared.trimmed
        margin, angle = (REUSE_DISTANCE, REUSE_ANGLE) if reusable else (0.0, 0.0)
        if frame.detail.coarser > 1.0:
            # A walk on a slow machine moves far between two frames.
            margin, angle = FARTHER * margin, WIDER * angle
        if self._choice is None or not self._still_serves(frame, settings, margin, angle):
            self._choice = choose(self._all, frame, settings, margin, angle)
            self._chosen_for = frame, settings
        return self._choice

    def _still_serves(self, frame: Frame, settings: Settings, margin: float, angle: float) -> bool:
        """Return whether the last choice was made for these settings and an eye near this one."""
        assert self._chosen_for is not None
        then, chosen_settings = self._chosen_for
        return chosen_settings is settings and is_near(then, frame, margin, angle)

    def _seen(self, frame: Frame, settings: Settings, choice: Choice) -> Seen:
        """Return how the eye of a frame sees the sprites of a choice."""
        line = choice.positions - frame.eye.astype(np.float32)
        x, y, z = line.T
        flat = x * x + z * z
        away = np.sqrt(flat)
        to_top = y + choice.tops
        below = -to_top / np.sqrt(np.maximum(flat + to_top * to_top, 1e-12))
        alpha = clearness(settings, choice.cells, choice.radius, choice.sizes[:, 0], away)
        return Seen(away, below, order_of(frame, settings, choice.positions), alpha)

    def _boards(
        self,
        frame: Frame,
        settings: Settings,
        choice: Choice,
        seen: Seen,
        alpha: np.ndarray,
        light: np.ndarray | None,
    ) -> list[Quads]:
        """Return the billboards of ``alpha`` (n,) over 0: trees, deer, and plants far away.

        ``light`` (4, 3) is the light at their corners, None the one that is painted in. Corners and
        colours are computed for all sprites, which costs less than selecting some.
        """
        quads = self._quads(frame, settings, choice)
        board = alpha > 0.0
        above = np.flatnonzero(choice.topped & (seen.below > GOES[0]))
        if len(above):
            alpha[above] *= 1.0 - smoothstep(*GOES, seen.below[above])
        colours = choice.colours
        colours[..., 3] = (choice.opacity * alpha)[:, None]
        pieces = None
        if settings.transparent.split:
            cuttable = board & (seen.away < CUT_WITHIN)
            one, other = cuttable.take(choice.neighbours.T)
            pairs = choice.neighbours.compress(one & other, axis=0)
            pieces = cut(*cuts(quads, pairs))
            board[pieces.owner] = False

        close = board & (seen.away < (TRIM_WITHIN if settings.transparent.trimmed else 0.0))
        far, near = np.flatnonzero(board & ~close), np.flatnonzero(close)
        parts = [
            Quads(
                quads.reshape(-1, 3),
                choice.st.reshape(-1, 2),
                (colours if light is None else self._lit(settings, choice, light)).reshape(-1, 4),
                choice.triangles[far],
                seen.depth[far],
            )
        ]
        if len(near):
            corners, st = (box[near] for box in choice.boxes)
            boxes = points_of(quads[near], corners)
            own = self._own(settings, choice, near, light, corners)
            parts.append(Quads.of(boxes, st, own, TWO_BOXES, seen.depth[near]))

        if pieces is not None and len(pieces.owner):
            which, corners = pieces.owner, box_corners(pieces.boxes)
            boxes, st = points_of(quads[which], corners), points_of(choice.st[which], corners)
            own = self._own(settings, choice, which, light, corners)
            middles = boxes.mean(axis=1)
            # Whole billboards are sorted by their feet, and so are parts of them.
            middles[:, 1] = choice.positions[which, 1]
            depth = order_of(frame, settings, middles)
            parts.append(
                Quads.of(boxes.astype(np.float32), st.astype(np.float32), own, QUAD, depth)
            )

        return parts

    def _quads(self, frame: Frame, settings: Settings, choice: Choice) -> np.ndarray:
        """Return the rectangles (n, 4, 3) of all sprites of a choice as billboards."""
        shared = settings.transparent
        positions = choice.positions
        sizes = choice.sizes
        if shared.faces == "place":
            middles = positions.copy()
            middles[:, 1] += 0.5 * sizes[:, 1]
            right, up = place_axes(frame, middles, shared.upright)
        elif shared.upright:
            right, up = (axis.astype(np.float32) for axis in upright_axes(frame.right))
        else:
            right, up = frame.right.astype(np.float32), frame.up.astype(np.float32)

        quads = billboards(positions, sizes, right, up)
        tilted = np.flatnonzero(choice.cells < PLANT) if shared.follow_slope else choice.deer
        if (shared.follow_slope or settings.deer.follow_slope) and len(tilted):
            own = right[tilted] if right.ndim == 2 else frame.right
            axes = slope_axes(own, self._all.leaning[choice.which[tilted]])
            quads[tilted] = billboards(positions[tilted], sizes[tilted], *axes)

        return quads

    def _own(
        self,
        settings: Settings,
        choice: Choice,
        which: np.ndarray,
        light: np.ndarray | None,
        corners: np.ndarray,
    ) -> np.ndarray:
        """Return the colours of parts of billboards ``which`` (m,): (m, 4), or of each corner.

        ``corners`` (m, k, 2) are the parts' corners s, t, ``light`` is that of :meth:`_boards`.
        """
        own = choice.colours[which, 0]
        if light is None:
            return own
        there = light_at(light, corners)
        if not changes(settings.sun):
            there[choice.cells[which] >= PLANT] = 1.0
        return lit(own[:, None], there)

    def _lit(self, settings: Settings, choice: Choice, light: np.ndarray) -> np.ndarray:
        """Return the colours of billboards in a light (4, 3); by day herbs keep the painted one."""
        if changes(settings.sun):
            return lit(choice.colours, light)
        colours, others = choice.colours.copy(), np.flatnonzero(choice.cells < PLANT)
        colours[others] = lit(choice.colours[others], light)
        return colours

    def _crossed(
        self,
        frame: Frame,
        settings: Settings,
        choice: Choice,
        seen: Seen,
        near: np.ndarray,
        alpha: np.ndarray,
    ) -> Quads:
        """Return the half quads of the plants ``near``, indexed as in choice.crossed."""
        crossed, count = choice.crossed, settings.plants.quads
        which = crossed.which[near]
        turns = crossed.turns[near]
        quads = crossed.still[near]
        positions, sizes = choice.positions[which], choice.sizes[which]

        winds = sway(frame.kt, positions, settings.plants.sway)
        if settings.plants.sway_by_size:
            winds *= sizes[:, 1:] / settings.plants.size_max
        quads[:, 4::6, ::2] += winds[:, None]

        if settings.plants.rosette:
            alpha = alpha * (1.0 - smoothstep(*GOES, seen.below[which]))
        if settings.plants.fade_edge_on:
            line = positions - frame.eye
            alpha = alpha[:, None] * np.repeat(edge_on(line, turns), 6, axis=1)

        depth = seen.depth[which]
        if settings.transparent.split:
            feet = crossed.feet[near]
            depth = order_of(frame, settings, feet.reshape(-1, 3)).reshape(feet.shape[:2])

        bases = 6 * np.arange(count, dtype=np.uint32)[:, None, None]
        pattern = (HALVES + bases).reshape(-1, 6)
        colours = tinted(self._all.tints[choice.which[which]], alpha)
        return Quads.of(quads, crossed.st[near], colours, pattern, depth)

    def _from_above(
        self, frame: Frame, settings: Settings, choice: Choice, seen: Seen, top: np.ndarray
    ) -> Quads:
        """Return the crowns and rosettes of what is seen from above, ``top`` of a choice."""
        which = choice.which[top]
        quads, st, middles = (a[which] for a in self._lying(settings.transparent.rooted))
        # A deer's picture from above is not round as a crown is: both pictures are seldom seen at
        # once, so that it does not look like two.
        below, deer = seen.below[top], is_deer(choice.cells[top])
        shown = np.where(deer, smoothstep(*GOES, below), smoothstep(*COMES, below))
        alpha = seen.alpha[top] * shown
        colours = tinted(self._all.tints[which], alpha)
        return Quads.of(quads, st, colours, QUAD, order_of(frame, settings, middles))

    def _lying(self, rooted: bool) -> tuple[np.ndarray, ...]:
        """Return quads (n, 4, 3), coordinates and middles (n, 3) of all sprites' tops.

        Computed when one is first seen: they never change.
        """
        if rooted not in self._tops:
            every = self._all
            cells = every.cells
            sizes = every.sizes
            middles = every.places[rooted].copy()
            plant = cells >= PLANT
            looks = [plant & np.isin(cells, FLOWERING), plant]
            middles[:, 1] += every.tops
            widths = sizes[:, 0] * np.select(looks, [BLOOM_WIDTH, ROSETTE_WIDTH], CROWN_WIDTH)
            tilted = plant | is_deer(cells)
            quads = lying(middles, widths, every.slopes * tilted[:, None], own_turn(middles))
            st = top_coordinates(cells, every.rows)
            self._tops[rooted] = quads.astype(np.float32), st, middles
        return self._tops[rooted]


def order_of(frame: Frame, settings: Settings, points: np.ndarray) -> np.ndarray:
    """Return the places in the sort (n,) of points (n, 3): the greater, the later drawn.

    It is the eye-space z of section 5.1.1. Billboards that face the eye's place are not parallel to
    the screen: of two that overlap, the one at the smaller distance from the eye is in front.
    """
    if settings.transparent.faces == "plane":
        return frame.depth(points)
    x, y, z = (points - frame.eye.astype(points.dtype)).T
    return np.asarray(-np.sqrt(x * x + y * y + z * z))


def tinted(tints: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """Return tints (n, 4) with this alpha (n,), or (n, k, 4) with (n, k)."""
    colours = tints if alpha.ndim == 1 else np.repeat(tints[:, None], alpha.shape[1], axis=1)
    colours[..., 3] = colours[..., 3] * alpha
    return colours
