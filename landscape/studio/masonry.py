"""The castle's pictures: ashlar wall, gate, torch light, carved stone of the torches.

Each is a height field with a colour per stone, plank or iron, lit once by a soft sun from the upper
left (Lambert on the gradient of the height, occlusion from the height's own blur) and averaged
down. Lengths of the tiles are in tile sides, those of the gate in wall widths (1 = 17 m), so
the formulas do not know the number of texels. Rounded boxes and arches are signed distances.
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from landscape.studio.images import bleed, shrink, smoothstep, spectral_noise, to_srgb, to_uint8

OVERSAMPLE = 2  # every picture is drawn this many times larger, then averaged
LIGHT = np.array([-0.52, 0.58, 0.63])  # chosen: upper left, x right, y up, z to the viewer
SKY_FILL = 0.52  # chosen: share of the light that comes from everywhere

COURSES = 8  # chosen: courses per tile, 32 on a wall of 17 m
PER_COURSE = 4  # chosen: stones per course, so that a stone is twice as long as high
JOINT = 0.0055  # chosen: half width of the mortar, tile sides
# Linear albedos of the stones, drawn between at random: medieval grey to beige. Chosen.
STONES = np.array(
    [[0.300, 0.268, 0.215], [0.335, 0.285, 0.212], [0.262, 0.250, 0.220], [0.368, 0.322, 0.250]]
)
MORTAR = np.array([0.300, 0.272, 0.222])  # chosen

# The gate, in wall widths: between the torches, x from 0.36 to 0.64 and y up to 0.42.
SPRING = 0.238  # chosen: height where the arch begins
OPENING = 0.094  # chosen: half width of the opening
CENTRE = 0.038  # chosen: distance of the two arch centres from the axis; 0 is a round arch
RING = 0.042  # chosen: thickness of the ring of voussoirs
VOUSSOIRS = 6.5  # chosen: per side; the half one is half of the keystone
JAMB = 0.0476  # chosen: height of a jamb stone, a fifth of SPRING
PLANKS = 8  # chosen: over both leaves
WOOD = np.array([0.150, 0.088, 0.046])  # chosen: oiled oak
IRON = np.array([0.040, 0.041, 0.046])  # chosen: forged, blackened
GATE_SIZE = 1024  # texels for the whole wall

# The torches, in wall widths from the left and from the bottom: where the report has its fires.
TORCHES = ((0.27, 0.28), (0.75, 0.28))
AMBIENT = np.array([0.79, 0.80, 0.84])  # chosen: the wall in its own shade, by day
HALO = np.array([1.00, 0.97, 0.85])  # chosen: the wall at the flame


def slopes(height: np.ndarray, per_unit: float, mode: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the slopes of a height field to the right and upwards, each (h, w)."""
    d_x = ndimage.correlate1d(height, [-0.5, 0.0, 0.5], axis=1, mode=mode) * per_unit
    d_y = ndimage.correlate1d(height, [0.5, 0.0, -0.5], axis=0, mode=mode) * per_unit
    return d_x, d_y


def light_relief(height: np.ndarray, per_unit: float, wide: float, tile: bool) -> np.ndarray:
    """Return the light on a height field, (h, w), 1 on a flat lit surface.

    ``height`` and ``wide`` (reach of the occlusion) are in units of ``per_unit`` texels; row 0 is
    the top. ``tile`` says whether the picture wraps.
    """
    mode = "wrap" if tile else "nearest"
    d_x, d_y = slopes(height, per_unit, mode)
    normal_z = 1.0 / np.sqrt(1.0 + d_x**2 + d_y**2)
    light = LIGHT / np.linalg.norm(LIGHT)
    sun = np.clip((-d_x * light[0] - d_y * light[1] + light[2]) * normal_z, 0.0, None) / light[2]
    reach = wide * per_unit
    sunk = sum(ndimage.gaussian_filter(height, reach * s, mode=mode) - height for s in (0.35, 1.0))
    occlusion = np.exp(-np.clip(sunk, 0.0, None) / wide * 1.1)
    return ((1.0 - SKY_FILL) * sun * (0.5 + 0.5 * occlusion) + SKY_FILL * normal_z**0.5) * occlusion


def tile_axes(size: int) -> tuple[np.ndarray, np.ndarray]:
    """Return x to the right and y upwards at texel centres, each (size, size), in 0..1."""
    axis = (np.arange(size) + 0.5) / size
    return np.broadcast_to(axis, (size, size)), np.broadcast_to(axis[::-1, None], (size, size))


def finish(linear: np.ndarray) -> np.ndarray:
    """Average a linear picture down by OVERSAMPLE and encode it."""
    return to_uint8(to_srgb(shrink(linear, OVERSAMPLE)))


def castle_brick() -> np.ndarray:
    """Return the wall tile, (512, 512, 3) uint8: eight courses in running bond."""
    size = 512 * OVERSAMPLE
    rng = np.random.default_rng(1066)
    x, y = tile_axes(size)
    fine = spectral_noise(size, 1.1, 11, low_cut=24.0)
    rough = spectral_noise(size, 1.6, 12, low_cut=10.0)
    soft = spectral_noise(size, 1.9, 13, low_cut=3.0)
    # Hand-cut stones have no ruled edge: bend the plane before the grid is laid on it.
    x_bent = x + 0.0013 * rough + 0.0010 * soft
    y_bent = y + 0.0013 * spectral_noise(size, 1.6, 14, low_cut=10.0)
    course = np.floor(y_bent * COURSES).astype(int)
    up = y_bent * COURSES - course
    course %= COURSES
    # Joints: running bond, each one shifted a little, as stones are not cut to one length.
    joints = (np.arange(PER_COURSE)[None, :] + 0.5 * (np.arange(COURSES) % 2)[:, None]) / PER_COURSE
    joints = joints + rng.uniform(-0.030, 0.030, joints.shape)
    joints = np.sort(joints % 1.0, axis=1)
    padded = np.concatenate([joints[:, -1:] - 1.0, joints, joints[:, :1] + 1.0], axis=1)
    number = np.zeros((size, size), dtype=int)
    for j in range(1, PER_COURSE + 1):
        number += x_bent >= padded[course, j]
    left, right = padded[course, number], padded[course, number + 1]
    stone = course * PER_COURSE + number % PER_COURSE
    half_w, half_h = (right - left) / 2, 0.5 / COURSES
    p_x = np.abs(x_bent - (left + right) / 2) - half_w
    p_y = np.abs(up / COURSES - half_h) - half_h
    corner = 0.012
    inside = -(
        np.hypot(np.maximum(p_x + corner, 0.0), np.maximum(p_y + corner, 0.0))
        + np.minimum(np.maximum(p_x, p_y) + corner, 0.0)
        - corner
    )
    # Chips: bites out of the edges where a noise is high.
    chip = 0.0042 * smoothstep(0.9, 2.2, spectral_noise(size, 1.3, 15, low_cut=12.0))
    inside = inside - JOINT - chip
    count = COURSES * PER_COURSE
    lean = rng.normal(0.0, 0.045, (count, 2))
    height = 0.0075 * (1.0 - np.exp(-np.clip(inside, 0.0, None) / 0.0055))
    face = smoothstep(0.0, 0.008, inside)
    height += face * (
        lean[stone, 0] * (x_bent - (left + right) / 2) * 0.5
        + lean[stone, 1] * (up / COURSES - half_h)
        + rng.uniform(-0.0012, 0.0012, count)[stone]
        + 0.00075 * rough
        + 0.0011 * soft
        - 0.0022 * smoothstep(1.5, 2.6, spectral_noise(size, 0.9, 16, low_cut=20.0))
    )
    height += 0.00028 * fine + (1.0 - face) * 0.0006 * rough
    shade = light_relief(height, size, 0.012, tile=True)

    mix = rng.dirichlet(np.full(len(STONES), 0.8), count) @ STONES
    mix *= rng.normal(1.0, 0.075, (count, 1))
    albedo = mix[stone] * (1.0 + 0.07 * soft + 0.05 * fine + 0.04 * rough)[..., None]
    pale = smoothstep(0.6, 2.2, spectral_noise(size, 1.4, 17, low_cut=6.0))[..., None]
    albedo = albedo * (1.0 - 0.25 * pale) + 0.25 * pale * np.array([0.40, 0.38, 0.32])
    cover = smoothstep(-0.0012, 0.0012, inside)[..., None]
    albedo = albedo * cover + (1.0 - cover) * MORTAR * (1.0 + 0.10 * fine + 0.06 * soft)[..., None]
    # Rain draws the dirt down: noise stretched along the columns, under the joints.
    streak = ndimage.gaussian_filter(
        spectral_noise(size, 0.9, 18, low_cut=8.0), (70.0, 3.0), mode="wrap"
    )
    streak = smoothstep(0.2, 2.4, streak / streak.std())[..., None]
    albedo = albedo * (1.0 - 0.30 * streak * np.array([0.8, 0.95, 1.0]))
    moss = smoothstep(1.1, 2.4, soft + 0.5 * rough)[..., None] * (1.0 - 0.7 * cover)
    albedo = albedo * (1.0 - 0.5 * moss) + 0.5 * moss * np.array([0.13, 0.15, 0.07])
    return finish(albedo * shade[..., None])


def box(x: np.ndarray, y: np.ndarray, half_w: float, half_h: float, round_by: float) -> np.ndarray:
    """Signed distance to a rounded box about the origin, negative inside."""
    q_x, q_y = np.abs(x) - half_w + round_by, np.abs(y) - half_h + round_by
    outside = np.hypot(np.maximum(q_x, 0.0), np.maximum(q_y, 0.0))
    return outside + np.minimum(np.maximum(q_x, q_y), 0.0) - round_by


def arch(x: np.ndarray, y: np.ndarray, grow: float) -> np.ndarray:
    """Signed distance to the pointed opening made ``grow`` larger, negative inside."""
    side = np.abs(x)
    arc = np.hypot(side + CENTRE, y - SPRING) - (OPENING + CENTRE)
    return np.where(y > SPRING, arc, side - OPENING) - grow


class Gate:
    """Layers of the gate, from the back to the front, on one height and colour field.

    x is measured from the axis, y from the ground, heights towards the viewer, in wall widths.
    """

    def __init__(self) -> None:
        self.texels = GATE_SIZE * 3  # fine enough for nails of a few texels
        rows, columns = int(0.4395 * self.texels) // 3 * 3, int(0.3047 * self.texels) // 6 * 6
        self.x = np.broadcast_to(
            (np.arange(columns) - columns / 2 + 0.5) / self.texels, (rows, columns)
        )
        self.y = np.broadcast_to(
            ((rows - np.arange(rows) - 0.5) / self.texels)[:, None], (rows, columns)
        )
        self.height = np.zeros((rows, columns))
        self.albedo = np.zeros((rows, columns, 3))
        self.gloss = np.zeros((rows, columns))
        self.shape = (rows, columns)

    def noise(self, exponent: float, seed: int, low_cut: float = 4.0) -> np.ndarray:
        """Return noise over the gate, mean 0 and deviation 1."""
        size = 2048
        return spectral_noise(size, exponent, seed, low_cut)[: self.shape[0], : self.shape[1]]

    def lay(
        self, distance: np.ndarray, height: np.ndarray, albedo: np.ndarray, gloss: float = 0.0
    ) -> None:
        """Put a layer where ``distance`` is negative, with an edge of one drawn texel."""
        cover = smoothstep(0.7, -0.7, distance * self.texels)
        self.height = self.height * (1.0 - cover) + height * cover
        self.gloss = self.gloss * (1.0 - cover) + gloss * cover
        self.albedo = self.albedo * (1.0 - cover[..., None]) + albedo * cover[..., None]


def lay_planks(gate: Gate) -> None:
    """Oak planks: stretched noise bent round knots, worn grey at the foot, a gap between leaves."""
    rng = np.random.default_rng(7)
    plank_w = 2 * OPENING / PLANKS
    number = np.clip(np.floor((gate.x + OPENING) / plank_w).astype(int), 0, PLANKS - 1)
    local = (gate.x + OPENING) / plank_w - number
    edge = np.minimum(local, 1.0 - local) * plank_w
    gap = np.where(np.abs(gate.x) < plank_w / 2, np.minimum(edge, np.abs(gate.x) - 0.0006), edge)
    shift = rng.uniform(0.0, 10.0, PLANKS)
    bend = 0.0035 * gate.noise(2.2, 21, 1.0)
    for x0, y0 in ((-0.071, 0.19), (-0.024, 0.07), (0.03, 0.27), (0.062, 0.105), (0.085, 0.22)):
        away = np.hypot((gate.x - x0) / 0.006, (gate.y - y0) / 0.02)
        bend = bend + 0.0045 * np.sign(gate.x - x0) * np.exp(-(away**2))
    across = (gate.x + bend) * 230.0 + shift[number] * 7.0
    ring = np.sin(across + 2.5 * gate.noise(1.8, 22, 2.0) + 6.0 * gate.y * (1 + shift[number] % 1))
    fibre = ndimage.gaussian_filter(gate.noise(0.5, 23), (26.0, 0.8), mode="wrap")
    split = ndimage.gaussian_filter(gate.noise(0.2, 25), (14.0, 0.5), mode="wrap")
    fibre = 0.8 * fibre / fibre.std() + 0.6 * split / split.std()
    tone = rng.normal(1.0, 0.13, PLANKS)[number]
    grain = 1.0 + 0.15 * ring + 0.13 * fibre - 0.30 * smoothstep(1.5, 2.6, -fibre)
    worn = smoothstep(0.075, 0.0, gate.y + 0.012 * gate.noise(1.5, 24))
    albedo = (WOOD * tone[..., None] * grain[..., None]) * (1.0 - 0.5 * worn[..., None])
    albedo = albedo + (0.5 * worn * np.clip(grain, 0.5, 1.4))[..., None] * [0.115, 0.100, 0.080]
    height = -0.020 + 0.0028 * (1.0 - np.exp(-np.clip(gap, 0.0, None) / 0.0012))
    height += 0.00016 * ring + 0.00022 * fibre
    albedo = albedo * smoothstep(0.0, 0.0013, gap)[..., None]
    gate.lay(arch(gate.x, gate.y, 0.004), height, albedo, 0.06)


def lay_iron(gate: Gate) -> None:
    """Straps with forked ends, nails and the two ring handles, hammered and slightly glossy."""
    hammer = 0.00025 * gate.noise(1.5, 31, 20.0)
    colour = IRON * (1.0 + 0.12 * gate.noise(1.2, 32))[..., None]
    rust = smoothstep(0.8, 2.4, gate.noise(1.4, 33, 8.0))[..., None]
    colour = colour * (1.0 - 0.6 * rust) + 0.6 * rust * np.array([0.105, 0.046, 0.020])

    def forge(distance: np.ndarray, base: float, thick: float) -> None:
        dome = thick * (1.0 - np.exp(np.minimum(distance, 0.0) / (0.6 * thick)))
        # A dark seam round each piece, where dirt gathers and no light comes.
        gate.albedo *= 1.0 - 0.5 * np.exp(-np.clip(distance, 0.0, None) / 0.0011)[..., None]
        gate.lay(distance, base + dome + hammer, colour, 0.5)

    side = np.abs(gate.x)
    deck = -0.0172
    for y0 in (0.048, 0.135, 0.222):
        strap = box(side - 0.0515, gate.y - y0, 0.0425, 0.0068, 0.001)
        tip = np.abs(side - 0.009) + np.abs(gate.y - y0) * 0.55 - 0.0062  # a lozenge at the end
        curls = np.minimum(
            np.abs(np.hypot(side - 0.021, gate.y - y0 - 0.0125) - 0.0062),
            np.abs(np.hypot(side - 0.021, gate.y - y0 + 0.0125) - 0.0062),
        )
        forge(np.minimum(np.minimum(strap, tip), curls - 0.0019), deck, 0.0032)
        for x0 in (0.024, 0.042, 0.060, 0.078):
            nail = np.hypot(side - x0, gate.y - y0) - 0.0043
            forge(nail, deck + 0.0026, 0.0052)
    for y0 in (0.0915, 0.1785, 0.262):
        for x0 in (0.012, 0.035, 0.0585, 0.082):
            forge(np.hypot(side - x0, gate.y - y0) - 0.0029, deck, 0.0028)
    forge(np.hypot(side - 0.0145, gate.y - 0.186) - 0.0078, deck, 0.0022)
    ring = np.abs(np.hypot(side - 0.0145, gate.y - 0.1735) - 0.0100) - 0.0021
    # The ring hangs before the planks and throws its shadow on them, down and to the right.
    shadow = np.roll(smoothstep(0.0020, -0.0010, ring), (10, 8), axis=(0, 1))
    gate.albedo *= 1.0 - 0.55 * shadow[..., None]
    forge(ring, deck + 0.003, 0.0040)
    forge(np.hypot(side - 0.0145, gate.y - 0.1845) - 0.0036, deck + 0.004, 0.0044)


def stone_face(
    gate: Gate, inside: np.ndarray, stone: np.ndarray, seed: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return height and albedo of dressed stones from the depth inside each and its number."""
    rng = np.random.default_rng(seed)
    rough = gate.noise(1.5, seed + 1, 14.0)
    soft = gate.noise(1.9, seed + 2, 4.0)
    fine = gate.noise(1.0, seed + 3, 40.0)
    inside = inside - 0.0022 * smoothstep(1.0, 2.3, gate.noise(1.3, seed + 4, 14.0))
    face = smoothstep(0.0, 0.0025, inside)
    height = 0.0052 * (1.0 - np.exp(-np.clip(inside, 0.0, None) / 0.0022))
    height += face * (0.00035 * rough + 0.0005 * soft) + 0.00012 * fine
    tones = rng.dirichlet(np.full(len(STONES), 0.8), 64) @ STONES * rng.normal(1.12, 0.07, (64, 1))
    albedo = tones[stone % 64] * (1.0 + 0.06 * soft + 0.05 * fine + 0.04 * rough)[..., None]
    cover = smoothstep(-0.0003, 0.0005, inside)[..., None]
    return height, albedo * cover + (1.0 - cover) * MORTAR * 0.8


def lay_stones(gate: Gate) -> np.ndarray:
    """Lay the jambs and the voussoirs; return the signed distance to their outline."""
    side = np.abs(gate.x)
    radius = np.hypot(side + CENTRE, gate.y - SPRING)
    apex = np.arccos(CENTRE / (OPENING + CENTRE + RING / 2))
    turn = np.arctan2(gate.y - SPRING, side + CENTRE) / apex * VOUSSOIRS
    above = gate.y > SPRING
    number = np.where(above, np.floor(turn), np.floor(gate.y / JAMB) + 20).astype(int)
    key = above & (turn > VOUSSOIRS - 0.5)
    number = np.where(key, 7, number)
    part = np.where(above, turn, gate.y / JAMB)
    part = part - np.floor(part)
    length = np.where(above, radius * apex / VOUSSOIRS, JAMB)
    along = np.minimum(part, np.where(key, 2.0, 1.0 - part)) * length
    # Long and short work: every other stone reaches further into the wall.
    reach = RING - 0.009 * (number % 2) + np.where(key, 0.006, 0.0)
    inner = arch(gate.x, gate.y, 0.0)
    outline = np.maximum(inner - reach, -inner)
    inside = np.minimum(along - 0.0011, np.minimum(inner + 0.001, reach - inner))
    stone = number + np.where(gate.x > 0, 30, 0) * np.where(key, 0, 1)
    height, albedo = stone_face(gate, inside, stone, 41)
    # The inner third is chamfered down towards the door.
    height = height - 0.9 * np.clip(0.013 - inner, 0.0, None)
    gate.lay(outline, height, albedo)
    return np.where(inner > 0, inner - reach, -1.0)


def castle_door() -> np.ndarray:
    """Return the gate on the transparent wall, (1024, 1024, 4) uint8."""
    gate = Gate()
    lay_planks(gate)
    lay_iron(gate)
    outline = lay_stones(gate)
    shade = light_relief(gate.height, gate.texels, 0.006, tile=False)
    # The arch stands before the door and casts its shadow to the lower right.
    blocked = np.roll(arch(gate.x, gate.y, 0.0), (40, 36), axis=(0, 1)) * gate.texels
    recessed = smoothstep(-0.012, -0.016, gate.height)
    shade = shade * (1.0 - 0.55 * recessed * smoothstep(-26.0, 14.0, blocked))
    rim = smoothstep(-0.010, 0.0, arch(gate.x, gate.y, 0.0)) * recessed
    shade = shade * (1.0 - 0.55 * rim)
    d_x, d_y = slopes(gate.height, gate.texels, "nearest")
    half = LIGHT / np.linalg.norm(LIGHT) + np.array([0.0, 0.0, 1.0])
    half /= np.linalg.norm(half)
    facing = (half[2] - d_x * half[0] - d_y * half[1]) / np.sqrt(1.0 + d_x**2 + d_y**2)
    glint = gate.gloss * np.clip(facing, 0.0, 1.0) ** 12 * shade
    linear = gate.albedo * shade[..., None] + 0.22 * glint[..., None]
    linear = np.clip(linear, 0.0, 1.0)
    alpha = smoothstep(0.7, -0.7, outline * gate.texels)
    # Round the stones a thin shadow beds them in the wall behind, deeper below and to the right.
    fall = np.roll(np.clip(outline, 0.0, None), (5, 5), axis=(0, 1))
    bed = 0.5 * np.exp(-np.minimum(fall, np.clip(outline, 0.0, None) * 1.6) / 0.0022)
    bed = bed * smoothstep(0.008, 0.003, outline) * (1.0 - alpha)
    linear = np.where((alpha > 0.0)[..., None], linear, 0.02)
    alpha = alpha + bed
    small = shrink(np.dstack([linear * alpha[..., None], alpha]), 3)
    cover = small[..., 3]
    rgb = to_srgb(small[..., :3] / np.maximum(cover, 1e-4)[..., None])
    picture = np.zeros((GATE_SIZE, GATE_SIZE, 4), dtype=np.uint8)
    rows, columns = cover.shape
    left = (GATE_SIZE - columns) // 2
    picture[GATE_SIZE - rows :, left : left + columns] = to_uint8(np.dstack([rgb, cover]))
    # What is hardly opaque has hardly a colour of its own: it takes its neighbour's first.
    picture[..., :3] = bleed(picture, 9)[..., :3]
    return bleed(picture)


def castle_light() -> np.ndarray:
    """Return the light of the torches over the gate wall, (256, 256, 3) uint8, a multiplier."""
    x, y = tile_axes(256)
    glow = np.zeros((256, 256))
    for x0, y0 in TORCHES:
        # Heat and smoke carry the light upwards: a halo a little higher than wide.
        rise = np.where(y > y0, 1.25, 0.95)
        away = np.hypot(x - x0, (y - y0) / rise) / 0.2
        glow = np.maximum(glow, 0) + np.exp(-1.9 * away**2) * smoothstep(1.7, 0.6, away)
    border = np.minimum(np.minimum(x, 1.0 - x), np.minimum(y, 1.0 - y))
    glow = np.clip(glow, 0.0, 1.0) * smoothstep(0.004, 0.06, border)
    return to_uint8(AMBIENT + (HALO - AMBIENT) * glow[..., None])


def torch_stone() -> np.ndarray:
    """Return the tile of the torches, (256, 256, 3) uint8: dark stone carved with a braid."""
    size = 256 * OVERSAMPLE
    x, y = tile_axes(size)
    rough = spectral_noise(size, 1.5, 51, low_cut=8.0)
    fine = spectral_noise(size, 0.9, 52, low_cut=30.0)
    soft = spectral_noise(size, 1.9, 53, low_cut=3.0)
    part = (y * 2.0) % 1.0  # two bands per tile
    middle = part - 0.5
    height = np.full((size, size), -0.012)
    turns = 3
    over = np.cos(2 * np.pi * turns * x)
    for sign in (1.0, -1.0):
        centre = sign * 0.21 * np.sin(2 * np.pi * turns * x)
        slope = sign * 0.21 * turns * 2 * np.pi * np.cos(2 * np.pi * turns * x) * 0.5
        away = np.abs(middle - centre) / np.sqrt(1.0 + slope**2) / 0.085
        strand = 0.020 * np.sqrt(np.clip(1.0 - away**2, 0.0, 1.0)) + 0.006 * sign * over
        strand = strand - 0.007 * np.exp(-((away / 0.22) ** 2))  # a groove along the strand
        height = np.where((away < 1.0) & (strand > height), strand, height)
    edge = 0.5 - np.abs(middle)
    roll = 0.016 * np.sqrt(np.clip(1.0 - ((edge - 0.035) / 0.055) ** 2, 0.0, 1.0))
    height = np.where(edge < 0.09, roll, height)
    height = ndimage.gaussian_filter(height, 1.2, mode="wrap")
    height = height + 0.0010 * rough + 0.0004 * fine + 0.0008 * soft
    shade = light_relief(height, size, 0.02, tile=True)
    albedo = np.array([0.118, 0.112, 0.106]) * (1.0 + 0.14 * soft + 0.10 * fine)[..., None]
    worn = smoothstep(0.004, 0.016, height)[..., None]
    albedo = albedo * (0.85 + 0.45 * worn)
    return finish(albedo * shade[..., None])


ASSETS: dict[str, Callable[[], np.ndarray]] = {
    "castle_brick.png": castle_brick,
    "castle_door.png": castle_door,
    "castle_light.png": castle_light,
    "torch_stone.png": torch_stone,
}
