"""Which sprites may be visible: chosen with a margin, and kept while the eye stays near.

Choosing tests every sprite of the island. The plain form is to choose in each frame, with no
margin: ``choose(laid_out, frame, settings)``. With a margin, one choice is used for several frames.
It then includes sprites that are not visible yet, but they change no pixel: they are outside the
window or have faded out. Their data that no frame changes is prepared once per choice, in the types
that OpenGL takes, float32 and uint8. No OpenGL here.
"""

from dataclasses import dataclass

import numpy as np

from landscape.elements.atlas import cell_coordinates
from landscape.elements.best.sprites.crossings import neighbours
from landscape.elements.best.sprites.refined_atlas import FLOWERING
from landscape.elements.best.sprites.refined_planting import TintedSprites
from landscape.elements.best.sprites.refined_quads import half_places, on_slope, still_quads, turned
from landscape.elements.best.sprites.rules import has_top, is_deer, radii
from landscape.elements.best.sprites.slope_billboards import leaning
from landscape.elements.planting import PLANT
from landscape.elements.settings import Settings
from landscape.elements.transparent_elements import CROSS_S, CROSS_T, QUAD, QUAD_S, QUAD_T, visible
from landscape.frame import Frame
from landscape.geometry.culling import in_view
from landscape.geometry.height_field import mirrored_height

FOOT = 0.07  # chosen: half a trunk's width, times the tree's width
# Chosen: how high the picture from above lies, times the height of a plant, of a herb that flowers,
# and of a tree.
ROSETTE_HEIGHT = 0.30
BLOOM_HEIGHT = 0.65
CROWN_HEIGHT = 0.62


def rooted(sprites: TintedSprites) -> np.ndarray:
    """Return the places (n, 3) with trees and plants lowered where the ground slopes.

    They are lowered by the slope times half the trunk's width: the downhill side of the foot then
    touches the ground.
    """
    steep = np.hypot(sprites.slopes[:, 0], sprites.slopes[:, 1])
    sunk = FOOT * steep * sprites.sizes[:, 0]
    places = sprites.positions.copy()
    places[:, 1] -= np.where(is_deer(sprites.cells), 0.0, sunk)
    return places


def top_heights(cells: np.ndarray, heights: np.ndarray) -> np.ndarray:
    """Return how high above their feet pictures from above lie (n,), for sprites' ``heights``."""
    plant = cells >= PLANT
    looks = [plant & np.isin(cells, FLOWERING), plant]
    return np.asarray(heights * np.select(looks, [BLOOM_HEIGHT, ROSETTE_HEIGHT], CROWN_HEIGHT))


class LaidOut:
    """All sprites of the island as arrays in OpenGL's types, and the atlas they are drawn from.

    ``outlines`` and ``outline_st`` say what is opaque in each cell, see :func:`atlas.outlines`;
    ``rows`` is how many rows the atlas has.
    """

    def __init__(
        self, sprites: TintedSprites, outlines: np.ndarray, outline_st: np.ndarray, rows: int
    ) -> None:
        """Prepare what is the same in every frame."""
        self.places = {
            False: np.ascontiguousarray(sprites.positions, np.float32),
            True: np.ascontiguousarray(rooted(sprites), np.float32),
        }
        self.sizes = np.ascontiguousarray(sprites.sizes, np.float32)
        self.reaches = self.sizes.sum(axis=1)  # radii of spheres around sprites' middles
        self.cells = sprites.cells
        self.flipped = sprites.flipped
        self.slopes = sprites.slopes
        self.tops = top_heights(sprites.cells, self.sizes[:, 1]).astype(np.float32)
        self.leaning = leaning(sprites.slopes).astype(np.float32)
        self.tints = sprites.tints.astype(np.uint8)
        self.pictures = sprites.pictures
        self.st = cell_coordinates(sprites.pictures, sprites.flipped, QUAD_S, QUAD_T, rows)
        self.outlines = outlines
        self.outline_st = outline_st
        self.rows = rows
        boards = np.flatnonzero(sprites.cells < PLANT)
        self.neighbours = boards[neighbours(sprites.positions[boards], sprites.sizes[boards, 0])]


@dataclass(frozen=True)
class Crossed:
    """Plants near enough to be crossed quads: their indices in a choice, (m,).

    ``turns`` (m, k) are the angles of their k quads, ``still`` (m, 6 k, 3) these without wind,
    ``feet`` (m, 2 k, 3) the middles of the half quads' feet, ``st`` (m, 6 k, 2) in the atlas.
    """

    which: np.ndarray
    turns: np.ndarray
    still: np.ndarray
    feet: np.ndarray
    st: np.ndarray


@dataclass(frozen=True)
class Choice:
    """Sprites that may be visible, in order of their indices ``which`` (n,) on the island.

    For each, the position (n, 3), size (n, 2), height of its picture from above, atlas cell of its
    species and of its picture, and radius; which are deer, and which have a picture from above; for
    their billboards, the texture coordinates ``st`` (n, 4, 2), the tint's opacity (n,) in 0..255,
    colours (n, 4, 4), whose alpha each frame writes, and triangles (n, 6); and the boxes of what is
    opaque in their pictures (n, 8, 2), on the quad and in the atlas. ``neighbours`` (m, 2) are the
    pairs of trees and deer, by their number in the choice, that may cross.
    """

    which: np.ndarray
    positions: np.ndarray
    sizes: np.ndarray
    tops: np.ndarray
    cells: np.ndarray
    pictures: np.ndarray
    radius: np.ndarray
    deer: np.ndarray
    topped: np.ndarray
    st: np.ndarray
    opacity: np.ndarray
    colours: np.ndarray
    triangles: np.ndarray
    boxes: tuple[np.ndarray, np.ndarray]
    neighbours: np.ndarray
    crossed: Crossed


def choose(
    laid_out: LaidOut, frame: Frame, settings: Settings, margin: float = 0.0, angle: float = 0.0
) -> Choice:
    """Return the sprites that may be visible, mirrored or not, from the eye of a frame.

    That includes any eye within ``margin`` units of it, turned by up to ``angle`` radians.
    """
    places = laid_out.places[settings.transparent.rooted]
    radius = radii(settings, laid_out.cells, laid_out.sizes[:, 1], frame)
    if settings.transparent.trimmed:
        which = in_window(laid_out, frame, settings, radius, margin, angle)
    else:
        which = visible(frame, places, radius)

    cells, flipped = laid_out.cells[which], laid_out.flipped[which].astype(int)
    pictures = laid_out.pictures[which]
    return Choice(
        which=which,
        positions=places[which],
        sizes=laid_out.sizes[which],
        tops=laid_out.tops[which],
        cells=cells,
        pictures=pictures,
        radius=radius[which],
        deer=np.flatnonzero(is_deer(cells)),
        topped=has_top(settings, cells),
        st=laid_out.st[which],
        opacity=laid_out.tints[which, 3],
        colours=np.repeat(laid_out.tints[which][:, None], 4, axis=1),
        triangles=4 * np.arange(len(which), dtype=np.uint32)[:, None] + QUAD,
        boxes=(laid_out.outlines[flipped, pictures], laid_out.outline_st[flipped, pictures]),
        neighbours=among(laid_out.neighbours, which, len(laid_out.cells)),
        crossed=crossed_plants(laid_out, frame, settings, which, margin),
    )


def among(pairs: np.ndarray, which: np.ndarray, count: int) -> np.ndarray:
    """Return those pairs (m, 2) of ``count`` sprites of which both are in ``which`` (n,).

    They are given by their numbers there.
    """
    number = np.full(count, -1)
    number[which] = np.arange(len(which))
    one, other = number.take(pairs.T)
    both = np.flatnonzero((one >= 0) & (other >= 0))
    return np.stack([one.take(both), other.take(both)], axis=1)


def in_window(
    laid_out: LaidOut,
    frame: Frame,
    settings: Settings,
    radius: np.ndarray,
    margin: float,
    angle: float,
) -> np.ndarray:
    """Return the indices of the sprites within their ``radius`` (n,) that meet the view frustum.

    Either they or their mirror images meet it. The test uses a sprite's largest bounding sphere.
    """
    places, slack = laid_out.places[settings.transparent.rooted], np.float32(margin)
    dx, dz = places[:, 0] - frame.pose.x, places[:, 2] - frame.pose.z
    flat, farthest = dx * dx + dz * dz, radius + slack
    which = np.flatnonzero(flat < farthest * farthest)
    sizes, middles = laid_out.sizes[which], places[which]
    middles[:, 1] += 0.5 * sizes[:, 1]
    mirrored = middles.copy()
    mirrored[:, 1] = mirrored_height(mirrored[:, 1], settings.water.level)
    kept = np.zeros(len(which), bool)
    for points in (middles, mirrored) if settings.reflection.enabled else (middles,):
        away = np.sqrt(flat[which] + np.square(points[:, 1] - np.float32(frame.eye_y)))
        kept |= in_view(frame, points, laid_out.reaches[which] + slack + np.float32(angle) * away)
    return which[kept]


def crossed_plants(
    laid_out: LaidOut, frame: Frame, settings: Settings, which: np.ndarray, margin: float
) -> Crossed:
    """Return the plants among ``which`` that may be crossed quads."""
    far = settings.plants.crossed_within or np.inf
    points = laid_out.places[settings.transparent.rooted][which]
    away = np.hypot(points[:, 0] - frame.pose.x, points[:, 2] - frame.pose.z)
    near = np.flatnonzero((laid_out.cells[which] >= PLANT) & (away < far + margin))
    count, own = settings.plants.quads, which[near]
    turns = turned(points[near], count)
    still = still_quads(points[near], laid_out.sizes[own], turns)
    if settings.transparent.follow_slope:
        still = on_slope(still, points[near], laid_out.leaning[own])
    s, t = np.tile(CROSS_S, count), np.tile(CROSS_T, count)
    st = cell_coordinates(laid_out.cells[own], laid_out.flipped[own], s, t, laid_out.rows)
    return Crossed(near, turns, still, half_places(still), st)
