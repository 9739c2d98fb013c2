"""Trees, deer and plants: sprites that must be sorted (Transparent_elements, section 5.1 and 5.2).

Techniques: billboards, quads spanned by the camera's right and up vectors as read from the
modelview matrix, so that they always face it; crossed quads, two fixed quads at right angles whose
top-centre vertex sways. Blending wants far before near, and the z buffer cannot do that: all of
them together are sorted by their eye-space depth. All sprites share one texture, an atlas, so that
one glDrawElements draws them in any order.
State used: GL_BLEND, GL_ALPHA_TEST, GL_TEXTURE_2D, depth writes off.
"""

import numpy as np
from PIL import Image

from landscape.assets import Assets
from landscape.elements.ground import Ground
from landscape.elements.planting import PLANT, plant_everything
from landscape.frame import Frame
from landscape.gl.calls import gl
from landscape.gl.state import attrib, client_arrays
from landscape.gl.texture import Texture, mip_chain, read_image
from landscape.settings import Settings

CELL = 512  # chosen: texels per side of a sprite in the atlas
CELLS = (
    "tree_broadleaf.png",
    "tree_conifer.png",
    "tree_birch.png",
    "tree_shrub.png",
    "deer_stag.png",
    "deer_doe.png",
    "plant.png",
)
COLUMNS, ROWS = 4, 2
# Chosen: transparent texels left above each sprite. At mip level 5 they are still one texel, and
# the foot of the tree in the row above does not show over a fern's head.
GUTTER = 32
LEVELS = 6  # chosen: at the last mip level a cell is 16 texels wide

# Crossed quads: a quad's six vertices are bottom left, middle, right and top left, middle, right;
# its 4 triangles share the top middle, which sways.
CROSS_TRIANGLES = np.array([0, 4, 3, 0, 1, 4, 1, 2, 4, 4, 2, 5], np.uint32)
CROSS_INDICES = np.concatenate([CROSS_TRIANGLES, CROSS_TRIANGLES + 6])
QUAD_INDICES = np.array([0, 1, 2, 0, 2, 3], np.uint32)


def sway(kt: float, positions: np.ndarray, strength: float = 1.0) -> np.ndarray:
    """Return dx, dz (n, 2) in units of the wind at positions (n, 3), section 5.2.2."""
    x, z = positions[:, 0], positions[:, 2]
    dx = 0.05 * np.cos(kt / 10 - 1.2 * x - 0.744 * z)
    dz = 0.03 * np.cos(kt / 9.6 - 1.44 * x)
    return np.stack([dx, dz], axis=1) * strength


def visible_order(
    frame: Frame, positions: np.ndarray, radius: float, sort: bool = True
) -> np.ndarray:
    """Return the indices of what is before the camera and within ``radius``, far to near."""
    depth = frame.depth(positions)
    dx, dz = positions[:, 0] - frame.pose.x, positions[:, 2] - frame.pose.z
    seen = np.flatnonzero((depth < 0) & (dx * dx + dz * dz < radius * radius))
    return seen[np.argsort(depth[seen], kind="stable")] if sort else seen


def billboards(
    positions: np.ndarray, sizes: np.ndarray, right: np.ndarray, up: np.ndarray
) -> np.ndarray:
    """Return quads (n, 4, 3) that stand on positions (n, 3), sizes (n, 2) = width and height.

    Corners: bottom left, bottom right, top right, top left.
    """
    across = 0.5 * sizes[:, :1] * right
    rise = sizes[:, 1:] * up
    low, high = positions - across, positions + across
    return np.stack([low, high, high + rise, low + rise], axis=1)


def upright_axes(right: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return right and up of billboards that turn about the y axis only."""
    level = np.array([right[0], 0.0, right[2]])
    return level / max(float(np.linalg.norm(level)), 1e-9), np.array([0.0, 1.0, 0.0])


def crossed_quads(positions: np.ndarray, sizes: np.ndarray, winds: np.ndarray) -> np.ndarray:
    """Return two quads of six vertices each, (n, 12, 3), along x and along z.

    Per quad: bottom left, middle, right, top left, middle, right; the top middle moved by
    ``winds`` (n, 2) = dx, dz.
    """
    out = np.repeat(positions[:, None, :], 12, axis=1)
    across = np.array([-0.5, 0.0, 0.5, -0.5, 0.0, 0.5])
    out[:, :6, 0] += across * sizes[:, :1]
    out[:, 6:, 2] += across * sizes[:, :1]
    for top in (3, 9):
        out[:, top : top + 3, 1] += sizes[:, 1:]
        out[:, top + 1, 0] += winds[:, 0]
        out[:, top + 1, 2] += winds[:, 1]
    return out


def cell_coordinates(
    cells: np.ndarray, flipped: np.ndarray, s: np.ndarray, t: np.ndarray
) -> np.ndarray:
    """Return texture coordinates (n, k, 2) in the atlas of points s, t (k,) in 0..1 of cells (n,).

    ``flipped`` (n,) mirrors s; half a texel is kept clear of the neighbouring cells, and
    the GUTTER above.
    """
    s = 0.5 / CELL + s * (1.0 - 1.0 / CELL)
    t = GUTTER / CELL + t * (1.0 - (GUTTER + 0.5) / CELL)
    turned = np.where(flipped[:, None], 1.0 - s, s)
    u = (cells[:, None] % COLUMNS + turned) / COLUMNS
    v = (cells[:, None] // COLUMNS + t) / ROWS
    return np.ascontiguousarray(np.stack([u, v + 0 * u], axis=2), np.float32)


def sorted_indices(order: np.ndarray, is_plant: np.ndarray, bases: np.ndarray) -> np.ndarray:
    """Return the index array (uint32) that draws objects in ``order``.

    Object i owns the vertices from ``bases[i]`` on: 4 of a billboard (6 indices), or 12 of crossed
    quads (24 indices).
    """
    plant = is_plant[order]
    counts = np.where(plant, len(CROSS_INDICES), len(QUAD_INDICES))
    owner = np.repeat(np.arange(len(order)), counts)
    local = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    cross = CROSS_INDICES[np.minimum(local, len(CROSS_INDICES) - 1)]
    quad = QUAD_INDICES[np.minimum(local, len(QUAD_INDICES) - 1)]
    return (bases[order][owner] + np.where(plant[owner], cross, quad)).astype(np.uint32)


class TransparentElements:
    """All sprites of the island, in one sort."""

    def __init__(
        self, settings: Settings, assets: Assets, ground: Ground, seed: int, kinds: set[str]
    ) -> None:
        """Draw the places by lot (``seed``) and load the atlas; ``kinds`` are those to show."""
        self.elements = tuple(k for k in ("trees", "deer", "plants") if k in kinds)
        self._settings = settings
        self.sprites = plant_everything(settings, ground, seed, kinds)
        self._is_plant = self.sprites.cells >= PLANT
        cells = [self._cell(assets, name) for name in CELLS]
        chains = [mip_chain(cell, LEVELS) for cell in cells]
        self._texture = Texture(
            [atlas([chain[level] for chain in chains]) for level in range(LEVELS)], repeat=False
        )

    def _cell(self, assets: Assets, name: str) -> np.ndarray:
        image = Image.fromarray(read_image(assets.path(name)))
        image = image.resize((CELL, CELL - GUTTER), Image.Resampling.LANCZOS)
        # Above the sprite stand its own top colours, fully transparent.
        cell = np.pad(np.asarray(image), ((GUTTER, 0), (0, 0), (0, 0)), mode="edge")
        cell[:GUTTER, :, 3] = 0
        return cell

    def prepare(self, frame: Frame) -> tuple[np.ndarray, ...]:
        """Return the frame's vertices, colours, texture coordinates and sorted indices."""
        settings, sprites = self._settings, self.sprites
        shared = settings.transparent
        order = visible_order(frame, sprites.positions, shared.radius, shared.sorted)
        plant = self._is_plant[order]
        boards, crosses = order[~plant], order[plant]
        axes = upright_axes(frame.right) if shared.upright else (frame.right, frame.up)
        quads = billboards(sprites.positions[boards], sprites.sizes[boards], *axes)
        winds = sway(frame.kt, sprites.positions[crosses], settings.plants.sway)
        winds *= sprites.sizes[crosses, 1:] / settings.plants.size_max
        cross = crossed_quads(sprites.positions[crosses], sprites.sizes[crosses], winds)
        vertices = np.concatenate([quads.reshape(-1, 3), cross.reshape(-1, 3)])
        s4, t4 = np.array([0, 1, 1, 0.0]), np.array([1, 1, 0, 0.0])
        s12, t12 = np.tile([0, 0.5, 1.0], 4), np.tile(np.repeat([1.0, 0.0], 3), 2)
        coordinates = np.concatenate(
            [
                cell_coordinates(sprites.cells[which], sprites.flipped[which], s, t).reshape(-1, 2)
                for which, s, t in ((boards, s4, t4), (crosses, s12, t12))
            ]
        )
        tints = np.concatenate(
            [np.repeat(sprites.tints[boards], 4, axis=0), np.repeat(sprites.tints[crosses], 12, 0)]
        )
        bases = np.empty(len(order), np.int64)
        bases[~plant] = 4 * np.arange(len(boards))
        bases[plant] = 4 * len(boards) + 12 * np.arange(len(crosses))
        indices = sorted_indices(np.arange(len(order)), plant, bases)
        return (
            np.ascontiguousarray(vertices, np.float32),
            np.ascontiguousarray(tints, np.uint8),
            coordinates,
            indices,
        )

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
            else:
                gl.glDepthMask(gl.GL_TRUE)
            with client_arrays(vertices, None, tints, [coordinates]):
                gl.glDrawElements(gl.GL_TRIANGLES, indices.size, gl.GL_UNSIGNED_INT, indices)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the atlas; may be called twice."""
        self._texture.release()


def atlas(cells: list[np.ndarray]) -> np.ndarray:
    """Lay equal cells (side, side, 4) out in rows of COLUMNS."""
    side = cells[0].shape[0]
    sheet = np.zeros((ROWS * side, COLUMNS * side, 4), np.uint8)
    for k, cell in enumerate(cells):
        row, column = divmod(k, COLUMNS)
        sheet[row * side : (row + 1) * side, column * side : (column + 1) * side] = cell
    return sheet
