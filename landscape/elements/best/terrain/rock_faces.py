"""The rock of ``ground.ledges`` as it is drawn: finer triangles over those of the height field.

Each cell of the height field with a relief (ledges.py) has its own small grid, drawn before the
broad ground, so that the depth test rejects what lies beneath. Far from the eye a region of many
cells is one display list, with eight triangles a cell or two; a region that is close is drawn in
blocks, each with a list per level of detail. The light on the relief is in the large texture: the
sun on ledges relative to the slope that it has its light from, shadow in gullies and under edges,
lichen on what faces up, streaks where water runs. So it is there at any distance, and in the mirror
image. The units are the ground's four; beside the eye unit 4, if there is one, multiplies by the
rock's texture once again, CLOSER times as often, so that there is a grain at arm's length. A cell
is looked up in one of 17 planes, the one that it lies in best: what is laid down from above is
streaks on a face that stands. Not in the report.
Cost: no layer more (what is below is rejected); some 50 lists a frame, which cost more than their
triangles do; beside the eye one look-up and up to 128 triangles a cell.
State used: as the ground, with five texture units.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from PIL import Image

from framelens.gl.named import texture_unit
from framelens.gl.seam import gl
from framelens.gl.state import combine
from framelens.gl.texture import Texture, mip_levels
from landscape.elements.best.terrain.ledges import FINER, LedgedField, enlarged
from landscape.elements.best.terrain.materials import ROCK, SAND, TURF, look_up
from landscape.frame import Frame
from landscape.geometry.culling import boxes_in_view
from landscape.geometry.mesh import Mesh, grid_triangles
from landscape.geometry.ramp import ramp
from landscape.gl.display_list import DisplayList, call_lists
from landscape.gl.draw import draw_mesh

# All chosen.
EVERY = TURF | SAND | ROCK
STANDS = 0.05  # units of relief above which rock is bare
LEAST = 0.004  # units: a cell whose relief is nowhere higher has none
REGION, BLOCK = 20, 5  # cells along the side of a region and of a block in it
# Every how many-th vertex, and up to which distance: of a block, and of a region that is not close.
LEVELS = ((1, 0.25), (2, 0.8), (4, np.inf))
BROAD = ((4, 9.0), (8, np.inf))
CLOSE = 2.5  # units from the eye within which a region is drawn in blocks
TILTS = np.radians([48.0, 8.0])  # of the planes' normals above the horizon
CLOSER = 4.3  # times as often is the rock's texture repeated in unit 4
GRAIN_LEVELS = 2  # mip levels in which that grain fades out
GRAINED = 0.25  # units from the eye beyond which no block has it
AMBIENT, SUNLIGHT = 0.42, 0.75  # light on rock in shadow, and the sun's on rock that faces it
RANGE = (0.4, 1.4)  # of the factor: more would be white where the large texture is bright
HOLLOW = ((3, 7.0), (10, 3.5))  # cells of the relief around, and how much a hollow darkens
LICHEN = np.array([1.10, 1.09, 0.92])  # times the colour of the rock
RUST = np.array([1.12, 0.98, 0.82])
STREAK = np.array([0.66, 0.67, 0.70])


def planes() -> np.ndarray:
    """Return planes as the directions of s, of t and of the normal, float32 (17, 3, 3).

    The first is level. The others face eight ways, each once aslant and once upright.
    """
    found = [np.array([(1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 1.0, 0.0)])]
    for up in TILTS:
        for turn in np.arange(8) * np.pi / 4:
            ahead = np.array([np.cos(turn), 0.0, np.sin(turn)])
            aside = np.array([-np.sin(turn), 0.0, np.cos(turn)])
            normal = np.array([0.0, np.sin(up), 0.0]) + np.cos(up) * ahead
            found.append(np.array([aside, np.cross(normal, aside), normal]))
    return np.array(found, np.float32)


PLANES = planes()


def normals(heights: np.ndarray, unit: float) -> np.ndarray:
    """Return the normals (m, m, 3) of heights (m, m) that are ``unit`` apart."""
    along_z, along_x = np.gradient(heights, unit)
    found = np.stack([-along_x, np.ones_like(heights), -along_z], axis=2)
    return np.asarray(found / np.linalg.norm(found, axis=2, keepdims=True))


def surfaces(field: LedgedField) -> tuple[np.ndarray, np.ndarray, float]:
    """Return the broad ground's heights and the relief on it, (m, m) each, and their distance."""
    assert field.relief is not None
    raised = field.relief.heights.astype(np.float64)
    unit = field.size / (len(raised) - 1)
    at = np.arange(len(raised)) * unit
    return field.broad.terrain_height(at[None, :], at[:, None]), raised, unit


def lights(field: LedgedField, sun: np.ndarray) -> np.ndarray:
    """Return the light on the relief's vertices, float32 (m, m, 3): a factor on their colours.

    ``sun`` (3,) points to it.
    """
    broad, raised, unit = surfaces(field)
    side = len(raised)

    def blurred(heights: np.ndarray, cells: float) -> np.ndarray:
        image = Image.fromarray(heights.astype(np.float32))
        small = image.resize((max(round(side / cells), 1),) * 2, Image.Resampling.BOX)
        return np.asarray(small.resize((side, side), Image.Resampling.BICUBIC), np.float64)

    fine = normals(broad + raised, unit)
    sunny, was = (
        AMBIENT + SUNLIGHT * np.maximum(each @ sun, 0.0) for each in (fine, normals(broad, unit))
    )
    factor = sunny / was
    for cells, darker in HOLLOW:
        factor *= np.clip(1.0 + darker * (raised - blurred(raised, cells)), 0.45, 1.3)
    factor = np.clip(factor, *RANGE)[..., None] * np.ones(3)
    rng = np.random.default_rng(82)
    some, spots = (
        np.asarray(
            Image.fromarray(rng.random((n, n)).astype(np.float32)).resize(
                (side, side), Image.Resampling.BICUBIC
            )
        )
        for n in (220, 900)
    )
    up = ramp(0.62, 0.9, fine[..., 1]) * ramp(0.45, 0.75, 0.5 * some + 0.5 * spots)
    factor *= 1.0 + up[..., None] * (LICHEN - 1.0)
    factor *= 1.0 + (ramp(0.72, 0.9, spots) * ramp(0.4, 0.8, some))[..., None] * (RUST - 1.0)
    hollow = ramp(0.0, -0.05, raised - blurred(raised, 14)) * ramp(0.85, 0.6, fine[..., 1])
    factor *= 1.0 + hollow[..., None] * (STREAK - 1.0)
    there = ramp(0.0, 0.03, raised)[..., None]
    return (1.0 + there * (factor - 1.0)).astype(np.float32)


def lit_rock(colours: np.ndarray, field: LedgedField, sun: np.ndarray) -> np.ndarray:
    """Return colours, uint8 (n, n, c), of which the first three have the light on the relief."""
    out = colours.copy()
    for channel, factor in enumerate(np.moveaxis(lights(field, sun), 2, 0)):
        light = enlarged(factor, len(colours))
        out[..., channel] = np.clip(colours[..., channel] * light + 0.5, 0, 255)
    return out


@dataclass(frozen=True)
class Block:
    """A square of rock: its meshes, the finest first, its box's corners (3,), its materials.

    ``region`` is its number among the regions, -1 for a region itself.
    """

    meshes: tuple[Mesh, ...]
    low: np.ndarray
    high: np.ndarray
    mixture: int
    region: int


def blocks(
    field: LedgedField,
    mesh: Mesh,
    rates: tuple[float, ...],
    labels: np.ndarray,
) -> list[Block]:
    """Return rock on a ground's ``mesh``, whose triangles have ``labels``: regions, then blocks.

    ``rates`` is how often each texture of ``mesh`` is repeated per unit, 0 for the large one.
    Texture coordinates and the share of rock are interpolated between the vertices of ``mesh``.
    """
    assert field.relief is not None
    raised = field.relief.heights
    cells = len(field.heights) - 1
    highest = raised[:-1, :-1].reshape(cells, FINER, cells, FINER).max(axis=(1, 3))
    used = highest > LEAST
    # A face that stands out is rock all over, whatever grows beneath. Other cells look up all
    # materials: a block for each mixture of them would cost more than it saves.
    soft = (labels.reshape(cells, cells, 2) & (TURF | SAND)).any(axis=2)
    mixed = np.where(soft & (lowest(raised, cells) < STANDS), EVERY, ROCK)
    broad, heights, _ = surfaces(field)
    facing = normals(broad + heights, field.size / (len(heights) - 1)).astype(np.float32)
    assert mesh.colors is not None
    unit = field.size / (len(raised) - 1)
    shares = mesh.colors[:, 3].reshape(cells + 1, cells + 1).astype(np.float32)
    grids = [part.reshape(cells + 1, cells + 1, 2) for part in mesh.coordinates]

    def between(values: np.ndarray, r: int, c: int) -> np.ndarray:
        """Return values at the vertices of cell r, c, from its four corners."""
        t = np.linspace(0.0, 1.0, FINER + 1, dtype=np.float32)
        t = t.reshape(-1, *[1] * (values.ndim - 2))
        upper = values[r, c] * (1 - t) + values[r, c + 1] * t
        lower = values[r + 1, c] * (1 - t) + values[r + 1, c + 1] * t
        return np.asarray(upper * (1 - t[:, None]) + lower * t[:, None])

    def made(of: np.ndarray, steps: Iterable[int]) -> tuple[Mesh, ...]:
        parts: list[list[np.ndarray]] = [[], [], [], *([] for _ in grids)]
        for r, c in of:
            rows = np.arange(FINER + 1) + r * FINER
            columns = np.arange(FINER + 1) + c * FINER
            z, x = np.meshgrid(rows * unit, columns * unit, indexing="ij")
            own = np.ix_(rows, columns)
            y = field.broad.terrain_height(x, z) + raised[own]
            parts[0].append(np.stack([x, y, z], axis=2))
            parts[1].append(facing[own])
            share = between(shares, r, c)
            stands = ramp(0.0, STANDS, raised[own])
            parts[2].append(share + stands * (255.0 - share))
            for part, grid in zip(parts[3:], grids, strict=True):
                part.append(between(grid, r, c))

        many = [np.stack(each) for each in parts]

        def level(step: int) -> Mesh:
            points, up, share, *uv = (each[:, ::step, ::step] for each in many)
            side = points.shape[1]
            few = grid_triangles(side, side).astype(np.int64)
            starts = np.arange(len(points)) * side * side
            rgba = np.repeat(share[..., None], 4, axis=3)
            flat = Mesh(
                points.reshape(-1, 3).astype(np.float32),
                up.reshape(-1, 3).astype(np.float32),
                (few[None] + starts[:, None, None]).reshape(-1, 3),
                tuple(each.reshape(-1, 2).astype(np.float32) for each in uv),
                rgba.reshape(-1, 4).astype(np.uint8),
            )
            return in_planes(flat, rates)

        return tuple(level(step) for step in steps)

    fine_steps, broad_steps = ([step for step, _ in levels] for levels in (LEVELS, BROAD))
    regions = list[Block]()
    parts = list[Block]()
    every = np.argwhere(used)
    number = every // REGION @ (cells + 1, 1)
    for which in np.unique(number):
        here = every[number == which]
        for mixture in (ROCK, EVERY):
            of = here[mixed[here[:, 0], here[:, 1]] == mixture]
            if not len(of):
                continue
            own = of // BLOCK @ (cells + 1, 1)
            inside = [made(of[own == one], fine_steps) for one in np.unique(own)]
            parts += [block(meshes, mixture, len(regions)) for meshes in inside]
            low, high = (
                getattr(np.array([getattr(part, end) for part in parts[-len(inside) :]]), least)(0)
                for end, least in (("low", "min"), ("high", "max"))
            )
            regions.append(Block(made(of, broad_steps), low, high, mixture, -1))
    return [*regions, *parts]


def block(meshes: tuple[Mesh, ...], mixture: int, region: int) -> Block:
    """Return a block of meshes, the finest first, with the box of that one."""
    points = meshes[0].vertices
    return Block(meshes, points.min(axis=0), points.max(axis=0), mixture, region)


def lowest(raised: np.ndarray, cells: int) -> np.ndarray:
    """Return the lowest relief (cells, cells) of each cell, its borders included."""
    rows = np.minimum(raised[:-1:FINER], raised[FINER::FINER])
    for k in range(1, FINER):
        rows = np.minimum(rows, raised[k::FINER][:cells])
    found = np.minimum(rows[:, :-1:FINER], rows[:, FINER::FINER])
    for k in range(1, FINER):
        found = np.minimum(found, rows[:, k::FINER][:, :cells])
    return np.asarray(found)


def in_planes(mesh: Mesh, rates: tuple[float, ...]) -> Mesh:
    """Return a mesh of cells of two triangles whose steep cells have textures seen from in front.

    A cell is looked up in the plane of PLANES that it lies in best; each has its own copies of the
    vertices on its border. A cell that is level keeps its coordinates, as do textures that are
    repeated 0 times per unit, by ``rates``.
    """
    facing = mesh.normals[mesh.triangles.reshape(-1, 6)].sum(axis=1) @ PLANES[:, 2].T
    plane = np.repeat(facing.argmax(axis=1), 2)
    count = len(mesh.vertices)
    corners, triangles = np.unique(mesh.triangles + plane[:, None] * count, return_inverse=True)
    plane, own = np.divmod(corners, count)
    points = mesh.vertices[own]
    seen = (PLANES[plane, :2] * points[:, None]).sum(axis=2)
    level = (plane == 0)[:, None]
    coordinates = tuple(
        np.ascontiguousarray(np.where(level, each[own], rate * seen) if rate else each[own])
        for each, rate in zip(mesh.coordinates, rates, strict=True)
    )
    assert mesh.colors is not None
    return Mesh(
        points,
        mesh.normals[own],
        np.ascontiguousarray(triangles.reshape(-1, 3), np.uint32),
        tuple(each.astype(np.float32) for each in coordinates),
        mesh.colors[own],
    )


def grain(rock: np.ndarray) -> list[np.ndarray]:
    """Return mip levels of a rock texture, uint8 (n, n, c), that fade to mid grey.

    Mid grey leaves colours as they are: there is a grain near the eye, and no repetition afar.
    """
    found = []
    for number, level in enumerate(mip_levels(rock[..., :3])):
        kept = max(1.0 - number / GRAIN_LEVELS, 0.0)
        apart = level.astype(np.float32) - level.mean(axis=(0, 1), dtype=np.float64)
        found.append(np.clip(127.5 + kept * apart, 0, 255).astype(np.uint8))
    return found


class RockFaces:
    """The display lists of all blocks."""

    def __init__(self, parts: list[Block], texture: Texture | None) -> None:
        """Compile them; ``texture`` is the grain of unit 4, if there is one."""
        self._grained = texture is not None
        self._lists: list[DisplayList] = []
        corners = np.array([(part.low, part.high) for part in parts]).reshape(-1, 2, 3)
        self._middles = corners.mean(axis=1)
        self._halves = (corners[:, 1] - corners[:, 0]) / 2.0
        self._regions = np.array([part.region for part in parts], int)
        self._mixtures = np.array([part.mixture for part in parts], int)
        self._parts = [
            [self._compiled(partial(draw_mesh, mesh)) for mesh in part.meshes] for part in parts
        ]

        def before() -> None:
            gl.glPushAttrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT)
            if texture is not None:
                self._units(texture)

        self._before, self._after = self._compiled(before), self._compiled(lambda: gl.glPopAttrib())
        self._without_grain = self._compiled(self._leave_grain)
        self._looks = {of: self._compiled(partial(look_up, of)) for of in (ROCK, EVERY)}

    def _compiled(self, send: Callable[[], None]) -> DisplayList:
        self._lists.append(DisplayList(send))
        return self._lists[-1]

    @staticmethod
    def _units(texture: Texture) -> None:
        """Set unit 4: times the grain, doubled."""
        gl.glActiveTexture(texture_unit(4))
        texture.bind()
        gl.glEnable(gl.GL_TEXTURE_2D)
        combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE"})
        combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"})
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 2.0)
        gl.glActiveTexture(gl.GL_TEXTURE0)

    @staticmethod
    def _leave_grain() -> None:
        """Let unit 4 look up nothing."""
        gl.glActiveTexture(texture_unit(4))
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glActiveTexture(gl.GL_TEXTURE0)

    def draw(self, frame: Frame) -> None:
        """Draw the blocks in view, the nearest first, as fine as their distance asks for."""
        if not self._parts:
            return
        near = np.flatnonzero(boxes_in_view(frame, self._middles, self._halves))
        aside = np.maximum(np.abs(self._middles[near] - frame.eye) - self._halves[near], 0.0)
        away = np.linalg.norm(aside, axis=1)
        close = np.zeros(len(self._parts), bool)
        close[near] = away <= CLOSE
        # A region that is close is drawn in blocks.
        shown = np.where(self._regions[near] < 0, ~close[near], close[self._regions[near]])
        kept, away = near[shown], away[shown]
        order = np.lexsort([away, self._mixtures[kept], away > GRAINED])
        lists, last, grained = [self._before], 0, self._grained
        for k, far in zip(kept[order].tolist(), away[order].tolist(), strict=True):
            if grained and far > GRAINED:
                grained = False
                lists.append(self._without_grain)
            if self._mixtures[k] != last:
                last = int(self._mixtures[k])
                lists.append(self._looks[last])
            levels = BROAD if self._regions[k] < 0 else LEVELS
            level = next(i for i, (_, reach) in enumerate(levels) if far <= reach)
            lists.append(self._parts[k][level])
        call_lists([*lists, self._after])

    def release(self) -> None:
        """Delete the lists; may be called twice."""
        for compiled in self._lists:
            compiled.release()


def with_grain(mesh: Mesh) -> Mesh:
    """Return a ground's mesh with the coordinates of unit 4 added."""
    closer = np.ascontiguousarray(mesh.coordinates[2] * np.float32(CLOSER))
    return replace(mesh, coordinates=(*mesh.coordinates, closer))
