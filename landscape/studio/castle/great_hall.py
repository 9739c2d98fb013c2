"""The great hall as it is seen through the castle's gate: one mesh, and one texture baked for it.

Technique: texture baking. The hall's surfaces keep their places in its light maps (hall/light.py),
and each texel of these gets its material's colour times its light: both units of the hall's own
drawing in one picture. The statue is gilded by a picture of a gilded ball, looked up by its normals
as seen from the door: a sphere map whose coordinates are vertices' own, since who looks through a
door sees the statue from one side.
Triangles that face away from each point of the opening are left out, and the farther a bay is, the
coarser is its stone. Places are in the castle's frame (elements/best/castle/doorway.py), into which
the hall is turned by half a turn.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import fast_simplification
import numpy as np
from scipy import ndimage

from landscape.elements.best.castle.doorway import MESH, PICTURE, THICK
from landscape.files.assets import shipped
from landscape.files.images import read_image
from landscape.files.meshes import read_ply
from landscape.geometry.mesh import Mesh, centred, merged, vertex_normals
from landscape.hall import plan
from landscape.hall.architecture import hall
from landscape.hall.light import FILE, SCALE, SIZES, light_map, placed
from landscape.hall.materials import MATERIALS
from landscape.hall.statue import standing
from landscape.hall.surfaces import Surface, coarser, mesh
from landscape.studio.hall.light import CANVAS, ORIGINS

# All chosen.
TOLERANCE = 0.006  # units per unit of distance from the door by which stone may differ
TEXELS = {"hall": 200.0, "floor": 426.0, "north": 426.0}  # texels per unit of each sheet
STATUE_FACES = 1800
DOOR = 0.08  # units around the hall's door within which its leaves and frame lie
BALL = (1540, 260, 240)  # on the canvas: left, top and side of the picture of a gilded ball
POOL = (1800, 260, 96, 144)  # left, top, width and height of the picture of the pool's water
SKY = (1920, 280)  # a texel amid those with the colour of the sky behind the windows
SKY_COLOUR = (236, 243, 250)
FLAME = 0.010, 0.044  # half width and height of a torch's flame
CORE, EDGE, TIP = np.array([(255, 250, 205), (255, 170, 45), (225, 75, 12)])  # its colours
PATCH = 16  # half the side of a patch of one colour, in texels
GOLD = np.array([1.0, 0.66, 0.26])
WATER_NEAR, WATER_FAR = np.array([30.0, 50.0, 54.0]), np.array([104.0, 84.0, 54.0])
EYES = [(x, y, 0.0) for x in (-0.075, 0.0, 0.075) for y in (0.01, 0.11, 0.21)]


def at_door(surface: Surface) -> bool:
    """Return whether a surface is part of the hall's own door: the castle's is in its place."""
    x, _, z = np.abs(surface.points.reshape(-1, 3) - (plan.AXIS, 0.0, plan.INSIDE.south)).T
    return bool(x.max() < plan.DOOR_HALF + DOOR and z.max() < DOOR)


@cache
def stone() -> list[tuple[str, str, Mesh]]:
    """Return sheet, material and mesh of each surface, in the hall's frame.

    Coordinates are those of the material, and those of the light in texels of the canvas.
    """
    parts = []
    for each in placed(hall()):
        if at_door(each.surface):
            continue
        material = MATERIALS[each.surface.material]
        distance = plan.INSIDE.south - float(each.surface.points[..., 2].max())
        tolerance = TOLERANCE * max(distance, 0.4)
        surface, light = coarser(each.surface, each.light, tolerance)
        sheet = surface.sheet
        at = light + ORIGINS[sheet]
        parts.append((sheet, surface.material, mesh(surface, material.repeats, at)))
    return parts


def sampled(image: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Return an image's colours (n, 3) at places (n, 2) in repeats, linearly interpolated."""
    height, width = image.shape[:2]
    rows, columns = places[:, 1] * height - 0.5, places[:, 0] * width - 0.5
    at = np.stack([rows, columns])
    return np.stack(
        [ndimage.map_coordinates(image[..., k], at, order=1, mode="grid-wrap") for k in range(3)],
        axis=-1,
    )


def material_image(name: str, sheet: str) -> np.ndarray:
    """Return a material's picture, float64 (h, w, 3), reduced to about the sheet's texels."""
    material = MATERIALS[name]
    image = read_image(shipped() / material.texture, "RGB").astype(float)
    step = max(int(image.shape[1] * material.repeats / TEXELS[sheet]), 1)
    while image.shape[0] % step or image.shape[1] % step:
        step -= 1
    height, width = image.shape[0] // step, image.shape[1] // step
    small = image.reshape(height, step, width, step, 3).mean(axis=(1, 3))
    return small * np.array(material.tint)


def covered(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the texels (n, 2), column and row, whose centres a triangle covers, and their weights.

    ``corners`` (3, 2) are in texels; weights (n, 3) are barycentric.
    """
    low = np.maximum(np.floor(corners.min(axis=0) - 0.5), 0)
    high = np.minimum(np.ceil(corners.max(axis=0) + 0.5), CANVAS)
    columns, rows = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
    at = np.stack([columns.ravel(), rows.ravel()], axis=-1)
    edges = np.stack([corners[1] - corners[0], corners[2] - corners[0]], axis=-1)
    if abs(np.linalg.det(edges)) < 1e-6:
        return at[:0].astype(int), np.empty((0, 3))
    b, c = np.linalg.solve(edges, (at + 0.5 - corners[0]).T)
    weights = np.stack([1.0 - b - c, b, c], axis=-1)
    inside = (weights > -1e-3).all(axis=1)
    return at[inside].astype(int), weights[inside]


def lit_canvas() -> np.ndarray:
    """Return the light of all sheets, uint8 (h, w, 3), on one canvas."""
    picture = read_image(shipped() / FILE, "RGB")
    canvas = np.zeros((CANVAS[1], CANVAS[0], 3), np.uint8)
    for sheet, (x, y) in ORIGINS.items():
        width, height = SIZES[sheet]
        canvas[y : y + height, x : x + width] = light_map(picture, sheet)[..., :3]
    return canvas


def painted() -> np.ndarray:
    """Return material times light of all stone, uint8 (h, w, 3), on the canvas."""
    light = lit_canvas().astype(float) / 255.0
    found = np.zeros(light.shape)
    known = np.zeros(light.shape[:2], bool)
    images: dict[tuple[str, str], np.ndarray] = {}
    for sheet, material, part in stone():
        if (material, sheet) not in images:
            images[material, sheet] = material_image(material, sheet)
        plain, at = (each.astype(float) for each in part.coordinates)
        for triangle in part.triangles:
            texels, weights = covered(at[triangle])
            rows, columns = texels[:, 1], texels[:, 0]
            colour = sampled(images[material, sheet], weights @ plain[triangle])
            found[rows, columns] = SCALE * colour * light[rows, columns]
            known[rows, columns] = True
    # Texels beside a surface are like the nearest that it has, for filtering.
    rows, columns = ndimage.distance_transform_edt(
        ~known, return_distances=False, return_indices=True
    )
    return np.asarray(np.clip(found[rows, columns], 0, 255) + 0.5, np.uint8)


def _mirrored_by_ball(side: int) -> np.ndarray:
    """Return the directions (side, side, 3) that a ball mirrors to an eye that looks along -z."""
    axis = (np.arange(side) + 0.5) / side * 2.0 - 1.0
    x, y = np.meshgrid(axis, -axis)
    z = np.sqrt(np.maximum(1.0 - x**2 - y**2, 0.0))
    return np.stack([2 * z * x, 2 * z * y, 2 * z * z - 1.0], axis=-1)


def gilded_ball() -> np.ndarray:
    """Return a ball of gold, uint8 (side, side, 3), in light from windows on the right and torches.

    Seen along -z; the middle of each texel has the normal of the ball there.
    """
    mirrored = _mirrored_by_ball(BALL[2])

    def spot(towards: tuple[float, float, float], sharp: float) -> np.ndarray:
        unit = np.array(towards) / np.linalg.norm(towards)
        return np.asarray(np.exp(-sharp * (1.0 - mirrored @ unit)))

    up = mirrored[..., 1]
    light = 0.26 + 0.22 * np.clip(up, -0.4, 1.0) + 0.16 * np.clip(-up, 0.0, 1.0) ** 2
    light += 1.2 * spot((0.9, 0.25, 0.35), 5.0) + 0.5 * spot((-0.7, 0.1, 0.7), 9.0)
    light += 2.2 * spot((-0.5, 0.15, 0.8), 60.0) + 0.8 * spot((0.2, -0.35, 0.9), 8.0)
    return np.asarray(np.clip(255.0 * light[..., None] * GOLD, 0, 255) + 0.5, np.uint8)


def statue() -> Mesh:
    """Return the gilded dragon in the hall's frame, with coordinates on the canvas."""
    points, triangles = read_ply(shipped() / "dragon.ply")
    points, triangles = fast_simplification.simplify(
        centred(points), triangles, target_count=STATUE_FACES, agg=5
    )
    triangles = np.ascontiguousarray(triangles, np.uint32)

    unit = Mesh(points, vertex_normals(points, triangles), triangles)
    vertices, normals, low = standing(unit)
    east, south = plan.STATUE
    lift = plan.PLINTH[1] - plan.STATUE_SCALE * low
    places = plan.STATUE_SCALE * vertices + (east, lift, south)

    left, top, side = BALL
    # 0.97: so that filtering does not leave the ball.
    across = 0.5 + 0.485 * normals[:, :2] * (1.0, -1.0)
    at = np.array([left, top]) + side * across

    return Mesh(
        np.ascontiguousarray(places, np.float32),
        np.ascontiguousarray(normals, np.float32),
        triangles,
        (at.astype(np.float32),),
    )


def quad(corner: tuple[float, ...], along: tuple[float, ...], up: tuple[float, ...]) -> np.ndarray:
    """Return the corners (4, 3) of a parallelogram, counter-clockwise."""
    start, a, b = (np.array(each, float) for each in (corner, along, up))
    return np.stack([start, start + a, start + a + b, start + b])


def panel(corners: np.ndarray, at: np.ndarray) -> Mesh:
    """Return a quad with its places on the canvas (4, 2)."""
    normal = np.cross(corners[1] - corners[0], corners[3] - corners[0])
    normals = np.tile(normal / np.linalg.norm(normal), (4, 1)).astype(np.float32)
    triangles = np.array([(0, 1, 2), (0, 2, 3)], np.uint32)
    return Mesh(corners.astype(np.float32), normals, triangles, (at.astype(np.float32),))


def furniture() -> list[Mesh]:
    """Return the pool's water, the sky behind the windows, and the torches' flames."""
    inside, wall = plan.INSIDE, plan.WALL
    x0, x1, z0, z1 = plan.POOL
    left, top, width, height = POOL
    on_pool = np.array([(0, height), (width, height), (width, 0), (0, 0)]) + (left, top)
    water = quad((x0, plan.POOL_WATER, z1), (x1 - x0, 0, 0), (0, 0, z0 - z1))
    sky = np.tile(SKY, (4, 1))
    length = inside.south - inside.north
    eastern = quad((inside.east + wall, 0, inside.north), (0, 0, length), (0, plan.CROWN, 0))
    middle, radius = plan.ROSE
    low = middle - 1.2 * radius
    northern = quad(
        (plan.AXIS - 1.2 * radius, low, inside.north - wall),
        (2.4 * radius, 0, 0),
        (0, 2.4 * radius, 0),
    )
    found = [panel(water, on_pool), panel(eastern, sky), panel(northern, sky)]
    return [plain(each) for each in found] + [
        flame(x, y + 0.4 * FLAME[1], z) for x, y, z in (plan.TORCH, *plan.PILLAR_TORCHES)
    ]


def plain(part: Mesh) -> Mesh:
    """Return a mesh with white as the colour that multiplies its texture."""
    return replace(part, colors=np.full((len(part.vertices), 3), 255, np.uint8))


def flame(x: float, y: float, z: float) -> Mesh:
    """Return a flame that faces the door: a drop, bright in its middle and red at its tip."""
    half, tall = FLAME
    height = np.array([0.0, 0.08, 0.25, 0.45, 0.65, 0.85])
    width = half * np.array([0.35, 0.8, 1.0, 0.75, 0.45, 0.15])
    right = np.stack([width, tall * height], axis=-1)
    outline = np.concatenate([right, [(0.0, tall)], right[::-1] * (-1, 1)])

    middle = [(0.0, 0.28 * tall)]
    flat = np.concatenate([middle, outline])
    corners = np.column_stack([x + flat[:, 0], y + flat[:, 1], np.full(len(flat), z)])

    share = flat[:, 1:2] / tall
    colours = EDGE + (TIP - EDGE) * share**2
    colours[0] = CORE

    count = len(outline)
    fan = [(0, k + 1, (k + 1) % count + 1) for k in range(count)]
    return Mesh(
        corners.astype(np.float32),
        np.tile(np.array([0, 0, 1], np.float32), (len(flat), 1)),
        np.array(fan, np.uint32),
        (np.tile(np.array(SKY, np.float32), (len(flat), 1)),),
        np.rint(colours).astype(np.uint8),
    )


def in_castle(points: np.ndarray) -> np.ndarray:
    """Return places (n, 3) of the hall in the castle's frame."""
    x, y, z = np.asarray(points, float).T
    return np.stack([0.5 + plan.AXIS - x, y, THICK + plan.INSIDE.south - z], axis=-1)


def facing(part: Mesh) -> np.ndarray:
    """Return which triangles (n,) of a mesh in the castle's frame face a point of the opening."""
    corners = part.vertices[part.triangles].astype(float)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    seen = np.zeros(len(normal), bool)
    for eye in EYES:
        towards = np.array(eye) + (0.5, 0.0, 0.0) - corners[:, 0]
        seen |= (normal * towards).sum(axis=1) > 1e-12
    return seen


def seen_through_gate() -> tuple[np.ndarray, ...]:
    """Return vertices, triangles, colours and texture coordinates of all that may be seen."""
    parts = [replace(part, coordinates=part.coordinates[1:]) for _, _, part in stone()]
    whole = merged([*(plain(part) for part in parts), plain(statue()), *furniture()])
    turned = replace(whole, vertices=in_castle(whole.vertices))
    assert whole.colors is not None
    triangles = whole.triangles[facing(turned)]
    used, number = np.unique(triangles, return_inverse=True)
    at = whole.coordinates[0][used] / np.array(CANVAS, np.float32)
    return (
        turned.vertices[used].astype(np.float32),
        number.reshape(-1, 3),
        whole.colors[used],
        at.astype(np.float32),
    )


def pool_water() -> np.ndarray:
    """Return the pool's water as it is seen from the door, uint8 (h, w, 3), far end first.

    Dark near the eye, far off the north wall's warm light, and in its middle the statue's gold, in
    streaks that waves have drawn out towards the eye.
    """
    width, height = POOL[2:]
    across, down = np.meshgrid(np.linspace(-1.0, 1.0, width), np.linspace(0.0, 1.0, height))
    wave = np.sin(9.0 * np.pi * down**0.7 + 1.7 * np.sin(5.0 * across))
    far = (1.0 - down) ** 1.5 * (1.0 + 0.25 * wave)
    gold = np.exp(-((across / 0.45) ** 2) - (down / 0.55) ** 2) * (0.6 + 0.4 * wave)
    water = WATER_NEAR + far[..., None] * (WATER_FAR - WATER_NEAR)
    return np.asarray(np.clip(water + 120.0 * gold[..., None] * GOLD, 0, 255), np.uint8)


def great_hall() -> np.ndarray:
    """Return the picture of the hall's surfaces, uint8 (h, w, 3)."""
    canvas = painted()
    left, top, side = BALL
    canvas[top : top + side, left : left + side] = gilded_ball()
    left, top, width, height = POOL
    canvas[top : top + height, left : left + width] = pool_water()
    x, y = SKY
    canvas[y - PATCH : y + PATCH, x - PATCH : x + PATCH] = SKY_COLOUR
    return canvas


ASSETS: dict[str, Callable[[], object]] = {MESH: seen_through_gate, PICTURE: great_hall}
