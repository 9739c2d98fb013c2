"""Trees, deer and plants: sprites that must be sorted (Transparent_elements, section 5.1 and 5.2).

Techniques: *billboards* (trees, deer) are rectangles spanned by the camera's right and up vectors,
read from the modelview matrix, so that they always face the viewer. *Crossed quads* (plants) are
two fixed rectangles at right angles; their top-centre vertex sways in the wind. Both have pictures
with a transparent surround. Blending needs far objects drawn before near ones, and the depth buffer
cannot order them, so all sprites together are *sorted* each frame by their eye-space depth. Their
pictures share one texture, an atlas, so that one glDrawElements draws them in that order.

``transparent.sorted`` off shows what the sort is for; ``transparent.textured`` off shows the quads.
Two flaws remain, as in 2006 (section 11.2): seen from above, billboards lie flat and plants
are crosses; and where two sprites intersect, no order is right. ``best/sprites/`` fixes them, and
makes deer lean with the slope.
State used: GL_BLEND, GL_ALPHA_TEST, GL_TEXTURE_2D, depth writes off. OpenGL 1.1.
"""

from collections.abc import Collection, Hashable
from dataclasses import replace
from typing import Self

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays
from framelens.gl.texture import Texture
from landscape.elements.atlas import CELLS, cell_coordinates, mip_levels, read_cells
from landscape.elements.element import Element, Site
from landscape.elements.ground import Ground
from landscape.elements.places_file import RANDOM, read_places
from landscape.elements.planting import PLANT, Sprites, counts_and_sizes, plant, site
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.files.cache import content, recall
from landscape.frame import Frame
from landscape.geometry.wind import sway

SPRITES = ("trees", "deer", "plants")  # one element: all of them must be sorted together
# A billboard's vertices are bottom left, bottom right, top right, top left: two triangles.
QUAD = np.array([[0, 1, 2, 0, 2, 3]], np.uint32)
QUAD_S, QUAD_T = np.array([0.0, 1.0, 1.0, 0.0]), np.array([1.0, 1.0, 0.0, 0.0])
# A crossed quad's are bottom left, middle, right, top left, middle, right. Each half is two
# triangles, and each of the four triangles has the top middle, which sways.
HALVES = np.array([[0, 4, 3, 0, 1, 4], [1, 2, 4, 4, 2, 5]], np.uint32)
CROSS = np.concatenate([HALVES, HALVES + 6])  # the four halves of a plant's two quads
CROSS_S, CROSS_T = np.array([0.0, 0.5, 1.0, 0.0, 0.5, 1.0]), np.repeat([1.0, 0.0], 3)
CLEAR = 0.02  # chosen: fragments of lower alpha are invisible and are not blended


def visible(frame: Frame, positions: np.ndarray, radius: float | np.ndarray) -> np.ndarray:
    """Return the indices of positions (n, 3) in front of the camera and within ``radius`` units.

    The distance is taken in x and z only, and compared squared, as in 2006.
    """
    dx, dz = positions[:, 0] - frame.pose.x, positions[:, 2] - frame.pose.z
    return np.flatnonzero((frame.depth(positions) < 0) & (dx * dx + dz * dz < radius * radius))


def far_to_near(rows: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """Sort rows (n, ...) by eye-space z (n,), which is more negative the farther away."""
    return rows[np.argsort(depth, kind="stable")]


def billboards(
    positions: np.ndarray, sizes: np.ndarray, right: np.ndarray, up: np.ndarray
) -> np.ndarray:
    """Return quads (n, 4, 3) with their feet at positions (n, 3), sizes (n, 2) = width and height.

    ``right`` and ``up`` are unit vectors, (3,) for all or (n, 3), one for each.
    """
    across = 0.5 * sizes[:, :1] * right
    rise = sizes[:, 1:] * up
    out = np.empty((len(positions), 4, 3), across.dtype)
    np.subtract(positions, across, out=out[:, 0])
    np.add(positions, across, out=out[:, 1])
    np.add(out[:, 1], rise, out=out[:, 2])
    np.add(out[:, 0], rise, out=out[:, 3])
    return out


def crossed_quads(positions: np.ndarray, sizes: np.ndarray, winds: np.ndarray) -> np.ndarray:
    """Return two quads of six vertices for each plant, (n, 12, 3), along x and along z.

    Their top middles are moved by ``winds`` (n, 2) = dx, dz in units.
    """
    out = np.repeat(positions[:, None, :], 12, axis=1)
    across = np.array([-0.5, 0.0, 0.5, -0.5, 0.0, 0.5])
    out[:, :6, 0] += across * sizes[:, :1]
    out[:, 6:, 2] += across * sizes[:, :1]
    for top in (3, 9):
        out[:, top : top + 3, 1] += sizes[:, 1:]
        out[:, top + 1, ::2] += winds
    return out


def blend_pictures(texture: Texture) -> None:
    """Set the state in which sprites are blended with their pictures, inside an attrib."""
    gl.glDepthMask(gl.GL_FALSE)
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    gl.glEnable(gl.GL_ALPHA_TEST)
    gl.glAlphaFunc(gl.GL_GREATER, CLEAR)
    gl.glEnable(gl.GL_TEXTURE_2D)
    texture.bind()


def kinds_in(only: Collection[str]) -> set[str]:
    """Return the kinds of sprites that may be shown."""
    return {name for name in SPRITES if name in only}


class TransparentElements(Element[Settings]):
    """All trees, deer and plants of the island, in one sort."""

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Plant them on the ground, by the seed."""
        ground = site.elements[Ground]
        return cls(site.settings, site.assets, ground, site.seed, kinds_in(site.only))

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that the sprites' places, sizes and kinds depend on."""
        species = settings.trees.species, settings.deer.species
        shared = settings.transparent
        places = shared.places, shared.surround
        return (*counts_and_sizes(settings), *species, *places, *site(settings))

    def __init__(
        self, settings: Settings, assets: Assets, ground: Ground, seed: int, kinds: set[str]
    ) -> None:
        """Place the sprites by ``seed`` and load the atlas; ``kinds`` are those to show."""
        self.settings = settings
        shared = settings.transparent
        if shared.places == RANDOM:
            self.stand(plant(settings, ground.field, seed, kinds))
        else:
            path = assets.path(shared.places, "transparent.places")
            placed, *_ = read_places(path, ground.field, kinds)
            # Here all plants are of one kind.
            self.stand(replace(placed, cells=np.minimum(placed.cells, PLANT)))

        paths = [assets.path(name) for name in CELLS]
        levels = recall(
            ["atlas", shared.surround, *map(content, paths)],
            lambda: mip_levels(read_cells(paths, shared.surround)),
        )
        self._texture = Texture(list(levels), repeat=False)

    def stand(self, sprites: Sprites) -> None:
        """Place these sprites on the island, and no others."""
        self.sprites = sprites
        drawn = replace(
            sprites,
            positions=sprites.positions.astype(np.float32),
            sizes=sprites.sizes.astype(np.float32),
        )
        crossed = sprites.cells >= PLANT

        self._boards = boards = drawn.only(~crossed)
        self._board_st = cell_coordinates(boards.cells, boards.flipped, QUAD_S, QUAD_T)

        self._plants = plants = drawn.only(crossed)
        s, t = np.tile(CROSS_S, 2), np.tile(CROSS_T, 2)
        self._plant_st = cell_coordinates(plants.cells, plants.flipped, s, t)

    def prepare(self, frame: Frame) -> tuple[np.ndarray, ...]:
        """Return the frame's vertices, texture coordinates and sorted indices.

        The mirrored scene is drawn from the same arrays, so the sort is done once a frame.
        """
        shared = self.settings.transparent
        boards = visible(frame, self._boards.positions, shared.radius)
        plants = visible(frame, self._plants.positions, shared.radius)
        quads = self._billboards(frame, boards)
        crosses = self._crossed_quads(frame, plants)

        # A row of six indices is a billboard, or half of a crossed quad: two triangles.
        quad_indices = 4 * np.arange(len(boards), dtype=np.uint32)[:, None] + QUAD
        first = 4 * len(boards)  # the vertex after those of the billboards
        firsts = np.arange(first, first + 12 * len(plants), 12, dtype=np.uint32)
        cross_indices = (firsts[:, None, None] + CROSS).reshape(-1, 6)
        indices = np.concatenate([quad_indices, cross_indices])
        if shared.sorted:
            quad_depth = frame.depth(self._boards.positions[boards])
            cross_depth = frame.depth(self._plants.positions[plants])
            depth = np.concatenate([quad_depth, np.repeat(cross_depth, len(CROSS))])
            indices = far_to_near(indices, depth)

        quad_st, cross_st = self._board_st[boards], self._plant_st[plants]
        return (
            np.concatenate([quads.reshape(-1, 3), crosses.reshape(-1, 3)]),
            np.concatenate([quad_st.reshape(-1, 2), cross_st.reshape(-1, 2)]),
            indices.ravel(),
        )

    def _billboards(self, frame: Frame, which: np.ndarray) -> np.ndarray:
        """Return the quads (n, 4, 3) of some trees and deer, turned towards the camera."""
        right, up = frame.right.astype(np.float32), frame.up.astype(np.float32)
        return billboards(self._boards.positions[which], self._boards.sizes[which], right, up)

    def _crossed_quads(self, frame: Frame, which: np.ndarray) -> np.ndarray:
        """Return the quads (n, 12, 3) of some plants, swaying in the wind."""
        plants = self.settings.plants
        places, sizes = self._plants.positions[which], self._plants.sizes[which]
        winds = sway(frame.kt, places, plants.sway)
        if plants.sway_by_size:
            winds *= sizes[:, 1:] / plants.size_max
        return crossed_quads(places, sizes, winds)

    def draw(self, frame: Frame, prepared: tuple[np.ndarray, ...] | None = None) -> None:
        """Blend the sprites, far to near, in the order that :meth:`prepare` found."""
        vertices, coordinates, indices = prepared or self.prepare(frame)
        if not len(indices):
            return
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups | gl.GL_CURRENT_BIT):
            gl.glColor3f(*self.settings.sun.tint)
            if self.settings.transparent.textured:
                blend_pictures(self._texture)
            with client_arrays(vertices, coordinates=[coordinates]):
                gl.glDrawElements(gl.GL_TRIANGLES, indices.size, gl.GL_UNSIGNED_INT, indices)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the atlas; may be called twice."""
        self._texture.release()
