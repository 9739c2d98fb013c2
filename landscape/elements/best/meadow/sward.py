"""The sward: cards with several fine blades, seed heads or a flower each (``grass.sward``).

A card takes the place of a blade, with five vertices like it, and its picture is a cell of one
texture; what is transparent there fails the alpha test. Sheaves of green blades take the ground's
colour; straw and flowers keep their own, ``grass.flowers`` of them in drifts. No OpenGL here.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image

from landscape.files.images import mip_chain, read_image

COLUMNS, ROWS = 8, 2  # of cells in the texture, see studio/plants/sward.py
SIDE = 256  # texels a cell is high; it is half as wide
LEVELS = 6  # chosen: at the last mip level a cell is 4 texels wide
GREEN_KINDS = 5  # kinds 0 to 4 are tinted: three sheaves, broad blades, and the floor of the sward
FLOOR = 4  # the kind that fills the ground between the others, in the ground's own colour
STANDING = 8  # kinds below this are grass, the others flowers
SPREAD = 2.60  # chosen: a card's shoulders are so many times as wide as its foot
WIDEST = 0.25  # chosen: of cards, their width by their height
SHOULDER = 0.62  # chosen: how high they are, as a fraction of the height of a sheaf
NEARER = 0.50  # chosen: a card shows several blades, so all are drawn only up to NEARER * NEAR
THINNING = 1.6  # chosen: near by cards hide each other, far away they must not become too few
WIDE_FROM = 1.4  # chosen: times that distance; beyond, cards are widened
# Chosen, for each kind: half its greatest width and its height, in units of the report's blade
# before scaling, and how many of a thousand cards are of it where nothing is said of the place.
LOOKS = np.array(
    [
        (0.0245, 0.0255, 250),
        (0.0255, 0.0240, 200),
        (0.0245, 0.0265, 260),
        (0.0230, 0.0230, 80),
        (0.0480, 0.0118, 280),
        (0.0170, 0.0300, 14),
        (0.0180, 0.0285, 32),
        (0.0190, 0.0240, 28),
        (0.0340, 0.0265, 0),
        (0.0340, 0.0250, 0),
        (0.0310, 0.0240, 0),
        (0.0290, 0.0215, 0),
        (0.0350, 0.0275, 0),
        (0.0340, 0.0280, 0),
        (0.0330, 0.0275, 0),
        (0.0290, 0.0230, 0),
    ]
)
# Chosen: how large the drifts of a kind of flower are, as a wave number, and how common it is.
DRIFTS = (
    (1.7, 0.8),
    (1.7, 0.8),
    (1.3, 1.0),
    (2.1, 0.8),
    (2.9, 0.45),
    (2.3, 0.5),
    (2.6, 0.4),
    (1.5, 0.6),
)
CARD_HEIGHT = float(LOOKS[:GREEN_KINDS, 1].max())  # of the sheaves, in the same units
HUES = np.array(
    [(0.97, 1.02, 0.90), (1.09, 1.05, 0.74), (0.91, 1.00, 0.98), (0.93, 1.06, 0.76)], np.float32
)
# Chosen: what is mixed with the colour of the ground for green cards, and for those like straw.
GREENER, STRAW = np.array([[(0.86,), (1.12,), (0.50,)], [(1.24,), (1.12,), (0.76,)]], np.float32)
DRY, BARE = 0.6, 0.35  # chosen: exponent on how green the ground is, and where it looks bare
BOLD = 0.35  # chosen: exponent; the fewer cards are drawn, the more of them are flowers
TUFT = 0.036  # chosen: units, how far apart the roots of a tuft's cards are
WIDENING = 0.62  # chosen: cards k times as far away as all are drawn are k**WIDENING times as wide
TRAIL = 0.030  # chosen: units, half the width of a deer's trail through the meadow


# Chosen: how much of the widening by distance a kind takes part in; a flower must stay round.
WIDENED = np.where(np.arange(len(LOOKS)) < GREEN_KINDS, 1.0, 0.25).astype(np.float32)
# Chosen: units. A card of grass that is nearer than CLOSE is narrowed, down to NARROWEST, by as
# much as its kind is SLIMMED: broad blades most, as one of them would be a ribbon before the eye,
# and the floor not, which has to cover the ground. What is nearer than LOW is lower, and at FLAT it
# lies flat: the near plane would cut its tip off.
CLOSE, NARROWEST = 0.12, 0.4
SLIMMED = np.array([0.35, 0.35, 0.35, 0.9, 0.0, 0.6, 0.6, 0.6] + 8 * [0.0], np.float32)
LOW, FLAT = 0.055, 0.024
LOWER = 1.2  # chosen: how much more of the sward is low where little stands
ROOTS = 0.30  # chosen: how much lighter than its picture the foot is of cards seen from far away
SHADED = 0.4  # chosen: how much darker the feet of near ones are with ground.tone
CARD_SIDES = np.array([-1.0, 1.0, -SPREAD, SPREAD], np.float32)  # of feet and shoulders
BEND = 0.004  # section 5.3.2: how far a tip bends, in units of the report's blade before scaling
# Of each kind half its width and its height, and of its shoulders, how high they are by the card's
# height, and how far they bend by how far its tip does.
SHOULDERS = np.where(np.arange(len(LOOKS)) < GREEN_KINDS, SHOULDER, 1.0)
CARDS = np.stack([*LOOKS[:, :2].T, SHOULDERS, SHOULDERS**1.6])


def most_widened(near: float) -> tuple[float, float]:
    """Return a, b: cards d units away are drawn at most a + b d times as wide as close by.

    Beyond ``near`` units they are widened by a power of the distance; this is its tangent 1 unit
    away, which is nowhere below it.
    """
    there = max(1.0 / near, 1.0) ** WIDENING
    slope = WIDENING * there
    return max(there - slope, 1.0), slope


def slimmed(far: np.ndarray, kinds: np.ndarray) -> np.ndarray:
    """Return factors (n,) on the width of cards of ``kinds`` (n,) ``far`` (n,) units away."""
    narrow = np.clip(far / np.float32(CLOSE), np.float32(NARROWEST), np.float32(1.0))
    return np.asarray(1.0 + SLIMMED[kinds] * (narrow - 1.0))


def raised(far: np.ndarray) -> np.ndarray:
    """Return factors (n,) on the height of cards ``far`` (n,) units away: 0 in front of the eye."""
    return np.clip((far - np.float32(FLAT)) / np.float32(LOW - FLAT), 0.0, 1.0)


def texture_coordinates() -> np.ndarray:
    """Return the texture coordinates of each kind, float32 (kinds, 5, 2).

    They are in proportion to the card's shape, so that the picture is not bent at its diagonals.
    """
    # The wind opens a gap between a rectangle's tip and its shoulders: nothing may show in it.
    foot, top = 0.5 / SPREAD, 0.03
    sheaf = [(0.5 - foot, 1), (0.5 + foot, 1), (0, 1 - SHOULDER), (1, 1 - SHOULDER), (0.5, 0)]
    whole = [*sheaf[:2], (0, top), (1, top), (0.5, top)]
    kinds = np.arange(len(LOOKS))
    cells = np.where((kinds < GREEN_KINDS)[:, None, None], sheaf, whole)
    cells = 0.004 + 0.992 * cells
    corner = np.stack([kinds % COLUMNS, kinds // COLUMNS], axis=1)
    return ((corner[:, None] + cells) / (COLUMNS, ROWS)).astype(np.float32)


def cells_of(image: np.ndarray) -> np.ndarray:
    """Return the cells (kinds, h, w, channels) of the texture."""
    h, w = image.shape[0] // ROWS, image.shape[1] // COLUMNS
    grid = image.reshape(ROWS, h, COLUMNS, w, image.shape[2]).transpose(0, 2, 1, 3, 4)
    return np.ascontiguousarray(grid.reshape(ROWS * COLUMNS, h, w, image.shape[2]))


def sward_levels(path: Path) -> list[np.ndarray]:
    """Return the texture's mip levels, each cell downsampled separately and no thinner far away.

    An image of another size than (256 ROWS, 128 COLUMNS) texels is resized.
    """
    image = read_image(path)
    if image.shape[:2] != (SIDE * ROWS, SIDE * COLUMNS // 2):
        size = SIDE * COLUMNS // 2, SIDE * ROWS
        image = np.asarray(Image.fromarray(image).resize(size, Image.Resampling.LANCZOS))
    chains = [mip_chain(cell, LEVELS) for cell in cells_of(image)]
    levels = []
    for level in zip(*chains, strict=True):
        h, w, channels = level[0].shape
        grid = np.array(level).reshape(ROWS, COLUMNS, h, w, channels).transpose(0, 2, 1, 3, 4)
        levels.append(np.ascontiguousarray(grid.reshape(ROWS * h, COLUMNS * w, channels)))
    return levels


def mean_colours(image: np.ndarray) -> np.ndarray:
    """Return the mean colour (kinds, 3) of the upper three quarters of each picture, in 0..1."""
    cells = cells_of(image).astype(float)
    upper = cells[:, : cells.shape[1] * 3 // 4]
    weight = upper[..., 3:]
    total = np.maximum(weight.sum(axis=(1, 2)), 1.0)
    return np.maximum((upper[..., :3] * weight).sum(axis=(1, 2)) / total / 255.0, 0.05)


def card_corners(angles: np.ndarray, kinds: np.ndarray, lean: np.ndarray) -> np.ndarray:
    """Return cards (5, 3, n) at the origin, unscaled: two feet, two shoulders, a tip.

    ``angles`` (n,) turn their wide side from x towards z; their tops move ``lean`` (n,) times a
    tip's bend of section 5.3.2 at right angles to it. A card that is a whole rectangle has its
    shoulders at its top.
    """
    half, height, low, bent = CARDS.take(kinds, axis=1)
    c, s = np.cos(angles), np.sin(angles)
    bend = BEND * lean
    out = np.zeros((5, 3, len(angles)))
    for axis, side, aside in ((0, c * half, -s * bend), (2, s * half, c * bend)):
        foot, middle = side / SPREAD, bent * aside
        out[0, axis] = -foot
        out[1, axis] = foot
        out[2, axis] = middle - side
        out[3, axis] = middle + side
        out[4, axis] = aside
    out[2:4, 1] = low * height
    out[4, 1] = height
    return out


def card_scale(scale: tuple[float, ...]) -> tuple[float, float]:
    """Return the scale (sx, sy) of cards for that of blades: sx is WIDEST times sy at most.

    A card is a picture of many blades. As wide as a single blade may be, it would be a streak.
    """
    across, up = scale
    return min(across, WIDEST * up), up


def patterns(*rows: tuple[float, int]) -> np.ndarray:
    """Return the numbers of which :func:`waves` makes patterns, (numbers, m, 1).

    Each of m ``rows`` is a wave number, and which of all patterns it is.
    """
    k, number = np.array(rows).T
    a = 2.399963 * number
    terms = [np.cos(a), np.sin(a), 1.7 * number, k, 0.57 * k, 1.31 * k, 0.83 * k, 2.3 * k, 1.7 * k]
    return np.array(terms)[..., None]


# What the patterns decide: where trails are, and clumps; where seed heads are ripe, where straw
# stands, and where flowers of each kind do, by a wide and by a narrow pattern; where the sward is
# tall, by two; and where it is light.
TRAIL_WAVE = 1.15
TRAILS = patterns((TRAIL_WAVE, 21))
CLUMPS = patterns((22.0, 22), (61.0, 23))
KINDS = patterns(
    *((2.7, 26), (3.9, 27)),
    *((k, 30 + number // 2 * 2) for number, (k, _) in enumerate(DRIFTS)),
    *((7.0, 40 + number) for number in range(len(DRIFTS))),
)
LOOK = patterns((1.9, 24), (9.0, 25), (1.3, 28))


def waves(x: np.ndarray, z: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    """Return smooth patterns (m, n) of about -1..1 at x, z (n,), of :func:`patterns`."""
    c, s, b, k, k_warp, k_warp_v, k_v, k_u2, k_v2 = chosen.astype(x.dtype)
    u, v = x * c + z * s, z * c - x * s
    warp = 0.9 * np.sin(k_warp * u + b) + 0.5 * np.sin(k_warp_v * v - b)
    return np.asarray(
        0.62 * np.sin(k * u + warp + b) * np.sin(k_v * v - warp)
        + 0.38 * np.sin(k_u2 * u + k_v2 * v + 2.0 * warp)
    )


def off_trail(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return 0 on the trails that deer have trodden, 1 beside them."""
    pattern = waves(x, z, TRAILS)[0]
    return np.asarray(np.clip(np.abs(pattern) / (TRAIL_WAVE * TRAIL) - 0.5, 0.0, 1.0))


def standing(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return 0..1: how densely cards stand at x, z: clumps with gaps between them, and trails."""
    small, smaller = waves(x, z, CLUMPS)
    clumps = 0.72 + 0.28 * small + 0.22 * smaller
    return np.asarray(np.clip(clumps, 0.40, 1.0) * (0.55 + 0.45 * off_trail(x, z)))


def covered(green: np.ndarray) -> np.ndarray:
    """Return 0..1 (n,), how much of the sward grows on ground that is ``green`` (n,), 0..1.

    It is fuller than single blades on dry ground, and leaves bare ground and paths free.
    """
    return np.asarray(green**DRY * np.clip(green / BARE, 0.0, 1.0))


TALLEST = 1.52  # the greatest factor on the height of cards that a place has, see places_at


class Places(NamedTuple):
    """What grows at each of t places: all that depends on the place alone.

    ``weights`` (kinds, t) say how many of a thousand cards are of a kind, of flowers how strong
    their drift is; ``tall`` (t,) are factors on the height of cards, at three scales, low on the
    trails; ``tone`` (t,) factors on their colour.
    """

    weights: np.ndarray
    tall: np.ndarray
    tone: np.ndarray


def places_at(x: np.ndarray, z: np.ndarray) -> Places:
    """Return what grows at x, z (t,)."""
    wide, narrow, light = waves(x, z, LOOK)
    tall = (1.0 + 0.30 * wide + 0.22 * narrow) * (0.45 + 0.55 * off_trail(x, z))
    x, z = x.astype(np.float32), z.astype(np.float32)
    ripe, dry, *drifts = waves(x, z, KINDS)
    weights = np.empty((len(LOOKS), len(x)), np.float32)
    weights[:] = LOOKS[:, 2:]
    ripe = np.clip(1.0 + 1.6 * ripe, 0.1, 2.6)
    weights[FLOOR] *= 1.0 + LOWER * (1.0 - standing(x, z))
    weights[5] *= ripe
    weights[6] *= np.clip(2.0 - ripe, 0.1, 2.0)
    weights[7] *= np.clip(0.8 + 1.4 * dry, 0.1, 2.2)
    where, how = np.split(np.array(drifts), 2)
    strong = np.clip(1.9 * where - 0.55, 0.0, 1.0) * np.clip(0.9 + 1.2 * how, 0.0, 1.0)
    weights[STANDING:] = strong
    return Places(weights, tall, 1.0 + 0.10 * light)


def kinds_at(
    weights: np.ndarray, tuft: np.ndarray, draw: np.ndarray, bold: np.ndarray, flowers: float
) -> np.ndarray:
    """Return a kind, uint8 (n,), for cards of tufts whose places have ``weights`` (kinds, t).

    ``tuft`` (n,) is the tuft of each. Random numbers ``draw`` (n,) in 0..1 choose it. ``flowers``
    is the fraction that flowers in the middle of a drift where all cards are drawn; ``bold`` (n,)
    says by how much more of those are that are seen from far away.
    """
    steps = weights.take(tuft, axis=1)
    common = np.array([[common] for _, common in DRIFTS], np.float32)
    drifts = np.minimum(steps[STANDING:] * bold.astype(np.float32), 2.0)
    steps[STANDING:] = np.float32(1000.0 * flowers) * common * drifts
    np.cumsum(steps, axis=0, out=steps)
    return np.asarray((steps <= draw * steps[-1]).sum(axis=0, dtype=np.uint8))


def hues(draw: np.ndarray, tone: np.ndarray, colour: np.ndarray) -> np.ndarray:
    """Return the colours (3, n) of green cards on ground of ``colour`` (3, n).

    They are a little greener than it, some yellower, some bluer, one in ten pale like straw, and
    three in ten on dry ground, by ``draw`` (n,) in 0..1; ``tone`` (n,) multiplies them.
    """
    red, green, blue = colour
    light = 0.30 * red + 0.59 * green + 0.11 * blue
    lush = np.clip((green / np.maximum(red, 1e-3) - 0.94) / 0.22, 0.0, 1.0)
    mixed = 0.10 + 0.26 * lush
    greener = (1.0 - mixed) * colour + mixed * light * GREENER
    kind = (draw * 97.0).astype(int) % len(HUES)
    straw = 0.5 * colour + 0.5 * light * STRAW
    dead = draw < (0.30 - 0.20 * lush)
    hue = 1.0 + (HUES.T - np.float32(1.0)).take(kind, axis=1) * (0.4 + 0.6 * lush)
    return np.asarray(np.where(dead, straw, greener * hue) * tone)
