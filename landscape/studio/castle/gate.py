"""The castle gate: an oak door with iron fittings in a pointed stone arch.

The gate is built in layers on one height field with a colour per plank, iron or stone. It is then
shaded (see :mod:`landscape.studio.castle.masonry`) and downsampled. Lengths are in wall widths (1 =
17 m). Rounded boxes and arches are signed distances.
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from landscape.studio.castle.masonry import LIGHT, MORTAR, STONES, light_relief, slopes
from landscape.studio.images import bleed, shrink, smoothstep, spectral_noise, to_srgb, to_uint8

# The gate fits between the torches: x from 0.36 to 0.64 and y up to 0.42 of the wall.
SPRING = 0.238  # chosen: height of the springing line, where the arch begins
OPENING = 0.094  # chosen: half width of the opening
CENTRE = 0.038  # chosen: distance of the two arch centres from the axis; 0 is a round arch
RING = 0.042  # chosen: thickness of the ring of voussoirs
VOUSSOIRS = 6.5  # chosen: per side; the last half is one half of the keystone
JAMB = 0.0476  # chosen: height of a jamb stone, a fifth of SPRING
PLANKS = 8  # chosen: over both leaves of the door
WOOD = np.array([0.150, 0.088, 0.046])  # chosen: linear albedo of oiled oak
IRON = np.array([0.040, 0.041, 0.046])  # chosen: linear albedo of blackened wrought iron
GATE_SIZE = 1024  # texels for the whole wall


def box(x: np.ndarray, y: np.ndarray, half_w: float, half_h: float, round_by: float) -> np.ndarray:
    """Return the signed distance to a rounded box about the origin, negative inside."""
    q_x, q_y = np.abs(x) - half_w + round_by, np.abs(y) - half_h + round_by
    outside = np.hypot(np.maximum(q_x, 0.0), np.maximum(q_y, 0.0))
    return outside + np.minimum(np.maximum(q_x, q_y), 0.0) - round_by


def arch(x: np.ndarray, y: np.ndarray, grow: float) -> np.ndarray:
    """Return the signed distance to the pointed opening, grown by ``grow``; negative inside."""
    side = np.abs(x)
    arc = np.hypot(side + CENTRE, y - SPRING) - (OPENING + CENTRE)
    return np.where(y > SPRING, arc, side - OPENING) - grow


class Gate:
    """A height, albedo and gloss field on which the gate is built from back to front.

    x is measured from the axis, y from the ground, and heights towards the viewer, in wall widths.
    """

    def __init__(self) -> None:
        self.texels = GATE_SIZE * 3  # supersampled, because the nails are a few texels wide
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
        """Return noise over the gate, mean 0 and standard deviation 1."""
        size = 2048
        return spectral_noise(size, exponent, seed, low_cut)[: self.shape[0], : self.shape[1]]

    def add_layer(
        self, distance: np.ndarray, height: np.ndarray, albedo: np.ndarray, gloss: float = 0.0
    ) -> None:
        """Overlay a layer where ``distance`` is negative, with an antialiased edge."""
        cover = smoothstep(0.7, -0.7, distance * self.texels)
        self.height = self.height * (1.0 - cover) + height * cover
        self.gloss = self.gloss * (1.0 - cover) + gloss * cover
        self.albedo = self.albedo * (1.0 - cover[..., None]) + albedo * cover[..., None]


def add_planks(gate: Gate) -> None:
    """Add the oak planks: wood grain around knots, worn grey at the foot, a gap between leaves."""
    rng = np.random.default_rng(7)
    plank_w = 2 * OPENING / PLANKS
    number = np.clip(np.floor((gate.x + OPENING) / plank_w).astype(int), 0, PLANKS - 1)
    local = (gate.x + OPENING) / plank_w - number
    edge = np.minimum(local, 1.0 - local) * plank_w
    gap = np.where(np.abs(gate.x) < plank_w / 2, np.minimum(edge, np.abs(gate.x) - 0.0006), edge)
    shift = rng.uniform(0.0, 10.0, PLANKS)

    # The grain bends around the knots.
    bend = 0.0035 * gate.noise(2.2, 21, 1.0)
    for x0, y0 in ((-0.071, 0.19), (-0.024, 0.07), (0.03, 0.27), (0.062, 0.105), (0.085, 0.22)):
        knot_distance = np.hypot((gate.x - x0) / 0.006, (gate.y - y0) / 0.02)
        bend = bend + 0.0045 * np.sign(gate.x - x0) * np.exp(-(knot_distance**2))

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
    gate.add_layer(arch(gate.x, gate.y, 0.004), height, albedo, 0.06)


def add_iron(gate: Gate) -> None:
    """Add straps with forked ends, nails and two ring handles, hammered and slightly glossy."""
    hammer = 0.00025 * gate.noise(1.5, 31, 20.0)
    colour = IRON * (1.0 + 0.12 * gate.noise(1.2, 32))[..., None]
    rust = smoothstep(0.8, 2.4, gate.noise(1.4, 33, 8.0))[..., None]
    colour = colour * (1.0 - 0.6 * rust) + 0.6 * rust * np.array([0.105, 0.046, 0.020])

    def forge(distance: np.ndarray, base: float, thick: float) -> None:
        dome = thick * (1.0 - np.exp(np.minimum(distance, 0.0) / (0.6 * thick)))
        # A dark seam around each piece, from dirt and occlusion.
        gate.albedo *= 1.0 - 0.5 * np.exp(-np.clip(distance, 0.0, None) / 0.0011)[..., None]
        gate.add_layer(distance, base + dome + hammer, colour, 0.5)

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
    # The ring hangs in front of the planks and casts a shadow on them, down and to the right.
    shadow = np.roll(smoothstep(0.0020, -0.0010, ring), (10, 8), axis=(0, 1))
    gate.albedo *= 1.0 - 0.55 * shadow[..., None]
    forge(ring, deck + 0.003, 0.0040)
    forge(np.hypot(side - 0.0145, gate.y - 0.1845) - 0.0036, deck + 0.004, 0.0044)


def stone_face(
    gate: Gate, inside: np.ndarray, stone: np.ndarray, seed: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return height and albedo of dressed stones.

    ``inside`` is the distance to the edge of the stone, positive inside; ``stone`` its number.
    """
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


def add_stones(gate: Gate) -> np.ndarray:
    """Add the jambs and the voussoirs; return the signed distance to their outline."""
    side = np.abs(gate.x)
    radius = np.hypot(side + CENTRE, gate.y - SPRING)
    apex = np.arccos(CENTRE / (OPENING + CENTRE + RING / 2))
    turn = np.arctan2(gate.y - SPRING, side + CENTRE) / apex * VOUSSOIRS
    above = gate.y > SPRING
    number = np.where(above, np.floor(turn), np.floor(gate.y / JAMB) + 20).astype(int)
    key = above & (turn > VOUSSOIRS - 0.5)
    number = np.where(key, 7, number)
    fraction = np.where(above, turn, gate.y / JAMB)
    fraction = fraction - np.floor(fraction)
    length = np.where(above, radius * apex / VOUSSOIRS, JAMB)
    along = np.minimum(fraction, np.where(key, 2.0, 1.0 - fraction)) * length

    # Long-and-short work: every other stone reaches further into the wall.
    reach = RING - 0.009 * (number % 2) + np.where(key, 0.006, 0.0)
    inner = arch(gate.x, gate.y, 0.0)
    outline = np.maximum(inner - reach, -inner)
    inside = np.minimum(along - 0.0011, np.minimum(inner + 0.001, reach - inner))
    stone = number + np.where(gate.x > 0, 30, 0) * np.where(key, 0, 1)
    height, albedo = stone_face(gate, inside, stone, 41)

    # The inner third is chamfered towards the door.
    height = height - 0.9 * np.clip(0.013 - inner, 0.0, None)
    gate.add_layer(outline, height, albedo)
    return np.where(inner > 0, inner - reach, -1.0)


def castle_door() -> np.ndarray:
    """Return the gate on a transparent wall, uint8 (1024, 1024, 4)."""
    gate = Gate()
    add_planks(gate)
    add_iron(gate)
    outline = add_stones(gate)
    shade = light_relief(gate.height, gate.texels, 0.006, tile=False)

    # The arch stands in front of the door and casts a shadow to the lower right.
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

    # A thin contact shadow on the wall around the stones, wider below and to the right.
    fall = np.roll(np.clip(outline, 0.0, None), (5, 5), axis=(0, 1))
    contact = 0.5 * np.exp(-np.minimum(fall, np.clip(outline, 0.0, None) * 1.6) / 0.0022)
    contact = contact * smoothstep(0.008, 0.003, outline) * (1.0 - alpha)
    linear = np.where((alpha > 0.0)[..., None], linear, 0.02)
    alpha = alpha + contact
    small = shrink(np.dstack([linear * alpha[..., None], alpha]), 3)
    cover = small[..., 3]
    rgb = to_srgb(small[..., :3] / np.maximum(cover, 1e-4)[..., None])
    picture = np.zeros((GATE_SIZE, GATE_SIZE, 4), dtype=np.uint8)
    rows, columns = cover.shape
    left = (GATE_SIZE - columns) // 2
    picture[GATE_SIZE - rows :, left : left + columns] = to_uint8(np.dstack([rgb, cover]))

    # Texels of very low alpha have unreliable colours: replace them before bleeding.
    picture[..., :3] = bleed(picture, 9)[..., :3]
    return bleed(picture)


ASSETS: dict[str, Callable[[], np.ndarray]] = {"castle_door.png": castle_door}
