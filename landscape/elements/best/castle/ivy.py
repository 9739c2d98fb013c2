"""Ivy as seen from an arm's length: single leaves before the quads of growth.py. No OpenGL here.

Each quad of ivy gets a few dozen leaves around its middle, in the castle's own frame. A leaf is two
halves, bent along the midrib, with one of eight pictures (studio/castle/ivy.py). Leaves hang with
their tips down, lie over each other as far out as a bulge of the whole clump says, and are darker
where others lie before them. Shoots at the rim leave the wall. On the wall behind there is soft
shade. All sizes are chosen.
"""

import numpy as np

from landscape.elements.best.castle.footing import Ground
from landscape.elements.best.castle.growth import IVIES
from landscape.elements.best.castle.ornate_masonry import PLINTH
from landscape.files.cache import recall
from landscape.geometry.masonry import TOWER_RADIUS
from landscape.geometry.mesh import Mesh, grid_triangles

COLUMNS, ROWS = 4, 2  # leaves of the sheet
PER_LEAF = 6  # vertices: three across the foot, three across the tip
EACH = 46  # leaves around the middle of a quad
SPREAD = 1.15  # how far, in halves of the quad's side
LENGTH, UNEVEN = 0.0085, 0.36  # median of the leaves' lengths, and standard deviation of its log
FILLED = 0.74  # how much of its cell a leaf fills
BULGE, LOOSE = 0.016, 0.012  # how far a clump stands out, and single leaves
FOLD = 0.22  # how far the rims of a leaf hang below its midrib, in halves of its width
SHOOTS = 46  # that leave the wall
STEPS = (7, 16)  # leaves on such a shoot
STEP = 0.0062  # between two leaves
CELL = 0.010  # side of the squares in which leaves hide each other
DARKEST = 0.26  # light that is left on a leaf under others
SKYWARD = 0.6  # how far the normals that light leaves are bent upwards
SHADE = 0.74  # opacity of the shade on the wall
AROUND, UP = 56, 96  # vertices of the shade
BEYOND, LOWER = 0.11, 0.012  # how far the shade reaches beyond the ivy, and is below it
BESIDE, CAST = 0.15, 0.018  # how far it reaches on the gate wall, and how much wider it is there


class Leaves:
    """Places of leaves: middles, normals, tips' directions (n, 3), lengths and tints."""

    def __init__(self) -> None:
        """Begin without any."""
        self.parts: list[tuple[np.ndarray, ...]] = []

    def add(
        self,
        middles: np.ndarray,
        normals: np.ndarray,
        tips: np.ndarray,
        lengths: np.ndarray,
        tints: np.ndarray,
    ) -> None:
        """Add leaves; ``tips`` need not be at right angles to ``normals``, nor any of length 1."""
        normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        tips = tips - (tips * normals).sum(axis=1, keepdims=True) * normals
        tips = tips / np.maximum(np.linalg.norm(tips, axis=1, keepdims=True), 1e-6)
        self.parts.append((middles, normals, tips, lengths, tints))

    def joined(self) -> list[np.ndarray]:
        """Return the five arrays of all leaves."""
        return [np.concatenate(each) for each in zip(*self.parts, strict=True)]


def middles_of(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Return middles (n, 3) and halves of the sides (n,) of the quads of ivy in growth's mesh."""
    corners = mesh.vertices.reshape(-1, 4, 3).astype(float)
    ivy = mesh.coordinates[0].reshape(-1, 4, 2)[:, :, 1].max(axis=1) < 0.5
    side = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1) / 2
    return corners[ivy].mean(axis=1), side[ivy]


def tower_of(middles: np.ndarray) -> np.ndarray:
    """Return the middle x, z (n, 2) of the tower of IVIES on which each place (n, 3) is."""
    towers = np.array([tower for tower, *_ in IVIES])
    away = np.hypot(*(middles[:, None, [0, 2]] - towers).transpose(2, 0, 1))
    return np.asarray(towers[away.argmin(axis=1)])


def single_leaves(growth: Mesh, ground: Ground) -> tuple[Mesh, np.ndarray]:
    """Return the leaves of the ivy in ``growth`` (growth.leaves) as a mesh, and tints (n, 3)."""
    rng = np.random.default_rng([2006, 31])
    middles, sides = middles_of(growth)
    towers = tower_of(middles)
    found = Leaves()
    _clad(found, middles, sides, towers, ground, rng)
    some = rng.choice(len(middles), SHOOTS * len(IVIES))
    _shoot(found, middles[some], towers[some], ground, rng)
    return _mesh(found, rng)


def _clad(
    found: Leaves,
    middles: np.ndarray,
    sides: np.ndarray,
    towers: np.ndarray,
    ground: Ground,
    rng: np.random.Generator,
) -> None:
    """Add the leaves that lie on the wall."""
    count = EACH * len(middles)
    middle, side, tower = (np.repeat(each, EACH, axis=0) for each in (middles, sides, towers))
    away = middle[:, [0, 2]] - tower
    part = np.sqrt(rng.random(count))  # evenly over a disc, of radius 1
    turn = rng.uniform(0.0, 2 * np.pi, count)
    bearing = np.arctan2(away[:, 1], away[:, 0])
    bearing += SPREAD * side * part * np.cos(turn) / TOWER_RADIUS
    y = middle[:, 1] + SPREAD * side * part * np.sin(turn)

    # What stands out farther lies before the rest, and gets more light.
    least = np.hypot(*away.T) - TOWER_RADIUS
    least = np.where(y < PLINTH[1] + 0.02, np.maximum(least, PLINTH[2] + 0.003), least)
    loose = rng.random(count)
    proud = least + BULGE * (1.0 - part * part) + LOOSE * loose
    radius = TOWER_RADIUS + proud
    out = np.stack([np.cos(bearing), np.zeros(count), np.sin(bearing)], axis=1)
    places = np.stack([tower[:, 0] + radius * out[:, 0], y, tower[:, 1] + radius * out[:, 2]], 1)
    light = _light_between(tower[:, 0] + 2 * tower[:, 1], bearing * TOWER_RADIUS, y, proud)

    across = np.stack([-out[:, 2], np.zeros(count), out[:, 0]], axis=1)
    up = np.array([0.0, 1.0, 0.0])
    # At a clump's rim leaves look to its outside.
    rim = part * part
    sideways = 0.9 * rim * np.cos(turn) + rng.normal(0.0, 0.34, count)
    upwards = 0.35 + 0.55 * rim * np.sin(turn) + rng.normal(0.0, 0.25, count)
    normals = out + sideways[:, None] * across + upwards[:, None] * up
    tips = -up + rng.normal(0.0, 0.75, count)[:, None] * across + 0.3 * out
    lengths = LENGTH * np.exp(rng.normal(0.0, UNEVEN, count))
    lengths = np.clip(lengths, 0.45 * LENGTH, 2.1 * LENGTH)

    # Sprigs differ in hue, leaves a little; those in the light are yellower.
    sprig = np.repeat(rng.normal(0.0, 1.0, len(middles)), EACH)
    hue = np.clip(0.10 * sprig + rng.normal(0.0, 0.08, count) + 0.12 * (light - 0.6), -0.06, 0.3)
    tints = np.stack([1.0 + 1.3 * hue, 1.0 + 0.35 * hue, 1.0 - 0.5 * hue], axis=1)
    tints *= (light * np.exp(rng.normal(0.0, 0.17, count)))[:, None]
    kept = y > ground(places[:, [0, 2]]) - 0.004
    kept &= ~(np.abs(places[:, [0, 2]] - 0.5) < 0.504).all(axis=1)
    found.add(*(each[kept] for each in (places, normals, tips, lengths, tints)))


def _light_between(
    tower: np.ndarray, along: np.ndarray, y: np.ndarray, proud: np.ndarray
) -> np.ndarray:
    """Return how much light falls between the other leaves on each, DARKEST to 1.15."""
    cells = np.stack([tower, np.floor(along / CELL), np.floor(y / CELL)], axis=1)
    _, number = np.unique(cells, axis=0, return_inverse=True)
    number = number.ravel()
    front = np.full(number.max() + 1, -np.inf)
    np.maximum.at(front, number, proud)
    mean = np.bincount(number, proud) / np.bincount(number)
    depth = np.clip((front[number] - proud) / (0.65 * BULGE), 0.0, 1.0)
    bulging = np.clip(0.5 + (proud - mean[number]) / LOOSE, 0.0, 1.0)
    return np.asarray(DARKEST + (1.15 - DARKEST) * (1.0 - depth) * (0.5 + 0.5 * bulging))


def _shoot(
    found: Leaves,
    starts: np.ndarray,
    towers: np.ndarray,
    ground: Ground,
    rng: np.random.Generator,
) -> None:
    """Add shoots that leave the wall and hang, with younger leaves on both sides."""
    up = np.array([0.0, 1.0, 0.0])
    for start, tower in zip(starts, towers, strict=True):
        out = np.array([start[0] - tower[0], 0.0, start[2] - tower[1]])
        out /= np.linalg.norm(out)
        across = np.array([-out[2], 0.0, out[0]])

        place = start + 0.022 * out
        heading = 0.65 * out + rng.normal(0.0, 0.8) * across + rng.normal(0.35, 0.5) * up
        count = int(rng.integers(*STEPS))
        for k in range(count):
            heading = heading - 0.20 * up + rng.normal(0.0, 0.16, 3)
            heading /= np.linalg.norm(heading)
            place = place + STEP * heading

            if np.hypot(*(place[[0, 2]] - tower)) < TOWER_RADIUS + PLINTH[2] + 0.004:
                break
            if place[1] < float(ground(place[None, [0, 2]])[0]):
                break

            side = across if k % 2 else -across
            tip = 0.5 * heading + 0.8 * side - 0.5 * up + rng.normal(0.0, 0.2, 3)
            normal = out + 0.6 * up + 0.5 * side + rng.normal(0.0, 0.25, 3)

            length = LENGTH * (1.0 - 0.6 * k / count) * rng.uniform(0.8, 1.2)
            young = 0.06 + 0.22 * k / count
            tint = rng.normal(0.95, 0.08) * np.array([1 + young, 1 + 0.5 * young, 1 - 0.4 * young])

            rows = (place + 0.4 * length * side, normal, tip, np.array(length), tint)
            found.add(*(row[None] for row in rows))


def _mesh(found: Leaves, rng: np.random.Generator) -> tuple[Mesh, np.ndarray]:
    """Return all leaves as a mesh of six vertices each, and the tint of each vertex (n, 3)."""
    middles, normals, tips, lengths, tints = found.joined()
    count = len(middles)
    across = np.cross(tips, normals)
    half = (lengths / FILLED / 2)[:, None]
    drop = FOLD * half * normals
    rows = [middles + way * half * tips for way in (-1.0, 1.0)]
    vertices = np.stack(
        [row + (k * half * across - abs(k) * drop) for row in rows for k in (-1, 0, 1)], axis=1
    )
    # Light that comes through leaves and from between them: no side of the clump is black.
    lit = normals + SKYWARD * np.array([0.0, 1.0, 0.0])
    facing = np.stack([lit + 0.45 * k * across for _ in rows for k in (-1, 0, 1)], axis=1)
    facing /= np.linalg.norm(facing, axis=2, keepdims=True)

    cell = rng.integers(COLUMNS * ROWS, size=count)
    turned = np.where(rng.random(count) < 0.5, -1.0, 1.0)
    left, low = (cell % COLUMNS) / COLUMNS, (cell // COLUMNS) / ROWS
    inset = 0.004
    s = 0.5 + turned[:, None] * np.array([-0.5, 0.0, 0.5]) * (1 - 2 * inset)
    t = np.array([1.0 - inset, inset])  # a leaf's tip is at the top of its cell
    uv = np.empty((count, PER_LEAF, 2))
    uv[..., 0] = left[:, None] + np.tile(s, 2) / COLUMNS
    uv[..., 1] = low[:, None] + np.repeat(t, 3) / ROWS
    quads = np.array([(0, 1, 4), (0, 4, 3), (1, 2, 5), (1, 5, 4)])
    triangles = (PER_LEAF * np.arange(count)[:, None, None] + quads).reshape(-1, 3)
    mesh = Mesh(
        np.ascontiguousarray(vertices.reshape(-1, 3), np.float32),
        np.ascontiguousarray(facing.reshape(-1, 3), np.float32),
        np.ascontiguousarray(triangles, np.uint32),
        (np.ascontiguousarray(uv.reshape(-1, 2), np.float32),),
    )
    return mesh, np.repeat(tints, PER_LEAF, axis=0)


def remembered_leaves(growth: Mesh, ground: Ground) -> tuple[Mesh, np.ndarray]:
    """Return :func:`single_leaves`, from the cache if they were made before.

    The weeds in ``growth`` stand on the ground all around: they tell one ground from another.
    """

    def make() -> tuple[np.ndarray, ...]:
        mesh, tints = single_leaves(growth, ground)
        return mesh.vertices, mesh.normals, mesh.triangles, mesh.coordinates[0], tints

    vertices, normals, triangles, coordinates, tints = recall(
        ["single leaves of ivy", growth.vertices.tobytes()], make
    )
    return Mesh(vertices, normals, triangles, (coordinates,)), tints


def remembered_shade(growth: Mesh) -> tuple[np.ndarray, ...]:
    """Return :func:`shade_on_wall`, from the cache if it was made before."""
    return recall(["shade of ivy", growth.vertices.tobytes()], lambda: shade_on_wall(growth))


def shade_on_wall(growth: Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the shade behind the ivy: vertices (n, 3), colours float32 (n, 4), triangles (m, 3).

    It is a little lower than the ivy, and soft. There is one grid of UP by AROUND vertices on each
    tower, and one on the gate wall beside the first, whose ivy reaches into the corner.
    """
    middles, sides = middles_of(growth)
    towers = tower_of(middles)
    grids: list[tuple[np.ndarray, np.ndarray]] = []
    for tower, angle, *_ in IVIES:
        mine = (towers == tower).all(axis=1)
        grids.append(_shade_on_tower(middles[mine], sides[mine], tower, angle))
    tower = IVIES[0][0]
    mine = (towers == tower).all(axis=1)
    grids.append(_shade_on_gate_wall(middles[mine], sides[mine], tower[0]))

    faces = grid_triangles(AROUND, UP)
    each = UP * AROUND
    triangles = np.concatenate([faces + np.uint32(k * each) for k in range(len(grids))])
    points = np.concatenate([grid.reshape(-1, 3) for grid, _ in grids])
    colours = np.zeros((len(points), 4), np.float32)
    colours[:, :3] = (0.020, 0.026, 0.012)
    cover = np.concatenate([cover.ravel() for _, cover in grids])
    colours[:, 3] = SHADE * (1.0 - np.exp(-1.6 * cover))
    return points.astype(np.float32), colours, triangles


def _shade_on_tower(
    middles: np.ndarray, sides: np.ndarray, tower: tuple[float, float], angle: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return a grid (UP, AROUND, 3) on a tower, and how much ivy covers it (UP, AROUND)."""
    x, z = tower
    bearing = np.arctan2(middles[:, 2] - z, middles[:, 0] - x)
    bearing = angle + (bearing - angle + np.pi) % (2 * np.pi) - np.pi
    y = middles[:, 1]
    turn = np.linspace(bearing.min() - BEYOND / TOWER_RADIUS, bearing.max(), AROUND)
    turn = turn + np.linspace(0.0, BEYOND / TOWER_RADIUS, AROUND)
    level = np.linspace(y.min() - BEYOND, y.max() + BEYOND, UP)
    near_u = np.square(TOWER_RADIUS * (turn[:, None] - bearing))
    near_y = np.square(level[:, None] + LOWER - y)
    wide = np.square(1.05 * sides)
    cover = np.exp(-2.2 * (near_y[:, None] + near_u[None]) / wide).sum(axis=2)
    radius = TOWER_RADIUS + 0.0015 + _projecting(level)
    grid = np.stack(
        [
            x + radius[:, None] * np.cos(turn),
            np.broadcast_to(level[:, None], cover.shape),
            z + radius[:, None] * np.sin(turn),
        ],
        axis=-1,
    )
    return grid, cover


def _projecting(y: np.ndarray) -> np.ndarray:
    """Return how far the plinth, whose top slopes, projects from a wall at heights y (n,)."""
    _, top, out = PLINTH
    return np.clip(top + out - y, 0.0, out)


def _shade_on_gate_wall(
    middles: np.ndarray, sides: np.ndarray, corner: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return a grid (UP, AROUND, 3) on the gate wall up to x = ``corner``, and its cover.

    The ivy stands before the wall: its shade is as wide as it, and weaker where it is farther away.
    """
    x = np.linspace(corner - TOWER_RADIUS - BESIDE, corner - 0.3 * TOWER_RADIUS, AROUND)
    y = np.linspace(middles[:, 1].min() - BEYOND, middles[:, 1].max() + BEYOND, UP)
    z = -0.0015 - _projecting(y)
    grid = np.empty((UP, AROUND, 3))
    grid[..., 0], grid[..., 1], grid[..., 2] = x, y[:, None], z[:, None]
    near_x = np.square(x[:, None] - middles[:, 0])
    near_y = np.square(y[:, None] + LOWER - middles[:, 1])
    near_z = np.square(z[:, None] - middles[:, 2])
    wide = np.square(CAST + sides)
    cover = np.exp(-2.2 * (near_x[None] + (near_y + near_z)[:, None]) / wide).sum(axis=2)
    return grid, cover * np.clip((x - x[0]) / (0.5 * BESIDE), 0.0, 1.0)
