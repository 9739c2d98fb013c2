"""The texture of the dragon of the preset `best`: skin, fins, bone and eyes in one (RGBA).

Technique: the texture has strips, one above the other. The strip for the body runs along it: s
repeats, and t goes from the back to the middle of the belly, the same on both sides. So scales can
have a direction: they overlap towards the tail, larger ones stand in rows on the flank, shields lie
across the belly; and since light comes from above, the side of a scale that faces the back is
painted lighter, and what lies under its edge darker. Alpha is how much the skin mirrors
(wet_sheen.py): scales do, furrows and algae do not. In the strip of the fins alpha is opacity.
The mesh file has the coordinates; its colours are multiplied by the texture. No OpenGL.
"""

from enum import IntEnum

import numpy as np

WIDTH, HEIGHT = 2048, 1024  # texels
BODY_TILE = 2.0  # circumferences of the body along which the texture lies once
FIN_RAYS = 16  # distances between two spines in a width of the texture
BONE = (0.08, 0.90)  # where bone lies along its strip
EYE, PLAIN = (0.020, 0.0105), (0.96, 0.005)  # middle of the eye and of what has no skin; half width
EDGE = 2.0  # texels that are left at the edges of a strip, for filtering
SEED = 2048

# All chosen.
COLUMNS, ROWS = 92, 34  # scales along a tile of the body and from the back to the belly
SHIELDS = 22  # shields of the belly, as the mesh has them
SHIELDED = 0.775  # share of the way from back to belly where the shields begin
HEAD_COLUMNS, HEAD_ROWS = 104, 28
ABOVE = 2.1  # how strongly light from above shows on the scales' relief
KEEL = 0.16  # how far a keel stands out from its scale
KEEN = 0.42  # brightness between the scales
BRIGHT = 0.74  # of a scale, so that its lit side is not cut off at white


class Strip(IntEnum):
    """The strips of the texture."""

    BODY = 0
    HEAD = 1
    FIN = 2
    BONE = 3
    EYE = 4
    PLAIN = 5


SPAN = {  # first row and last row
    Strip.BODY: (0, 480),
    Strip.HEAD: (480, 720),
    Strip.FIN: (720, 960),
    Strip.BONE: (960, 1024),
    Strip.EYE: (960, 1024),
    Strip.PLAIN: (960, 1024),
}


def laid(strips: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Return texture coordinates s and t (n, 2) of places in strips (n,).

    ``places`` (n, 2) are along the strip, in widths of the texture, and across it, 0..1; for the
    eye and what has no skin, -1..1 from the middle.
    """
    span = np.array([SPAN[strip] for strip in Strip], float)[strips]
    s, across = places.T
    round_eye = strips == Strip.EYE
    s = np.where(round_eye, EYE[0] + EYE[1] * np.clip(s, -1.0, 1.0), s)
    s = np.where(strips == Strip.PLAIN, PLAIN[0], s)
    across = np.where(round_eye, 0.5 - 0.5 * np.clip(across, -1.0, 1.0), across)
    t = span[:, 0] + EDGE + np.clip(across, 0.0, 1.0) * (span[:, 1] - span[:, 0] - 2 * EDGE)
    return np.stack([s, t / HEIGHT], axis=1)


def strip_of(coordinates: np.ndarray) -> np.ndarray:
    """Return the strip, int (n,), in which texture coordinates (n, 2) are."""
    rows = coordinates[:, 1] * HEIGHT
    found = np.full(len(coordinates), int(Strip.BONE))
    for strip in (Strip.BODY, Strip.HEAD, Strip.FIN):
        found[(rows >= SPAN[strip][0]) & (rows < SPAN[strip][1])] = strip
    odd = found == Strip.BONE
    found[odd & (coordinates[:, 0] < BONE[0])] = Strip.EYE
    found[odd & (coordinates[:, 0] > BONE[1])] = Strip.PLAIN
    return found


def waves(generator: np.random.Generator, height: int, width: int, count: int) -> np.ndarray:
    """Return smooth noise (height, width) of about -1..1 that repeats along the rows.

    ``count`` is about how many lumps there are along the width.
    """
    rows = max(3, round(count * height / width) + 2)
    lattice = generator.standard_normal((rows, count)).astype(np.float32)

    def weights(size: int, cells: int, ring: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        at = (np.arange(size, dtype=np.float32) + 0.5) * (cells if ring else cells - 1.001) / size
        low = at.astype(int)
        part = at - low
        high = (low + 1) % cells if ring else low + 1
        return low, high, (part * part * (3 - 2 * part)).astype(np.float32)

    low, high, part = weights(width, count, True)
    wide = lattice[:, low] * (1 - part) + lattice[:, high] * part
    low, high, part = weights(height, rows, False)
    return np.asarray(wide[low] * (1 - part[:, None]) + wide[high] * part[:, None])


def scattered(
    generator: np.random.Generator, height: int, width: int, columns: int, rows: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return the relief 0..1 of overlapping scales (height, width), and the number of each's scale.

    Scales are scattered in the bricks of a wall of ``columns`` by ``rows`` that is closed into a
    ring along the width. Each is a dome with a keel, which rises towards its end, that of small
    columns.
    """
    shape = (rows, columns)
    aside = generator.uniform(-0.20, 0.20, (2, *shape)).astype(np.float32)
    size = generator.uniform(0.86, 1.14, shape).astype(np.float32)
    x = ((np.arange(width, dtype=np.float32) + 0.5) * columns / width)[None, :]
    y = ((np.arange(height, dtype=np.float32) + 0.5) * rows / height)[:, None]
    best = np.zeros((height, width), np.float32)
    number = np.zeros((height, width), np.int32)
    for down in (-1, 0, 1):
        row = y.astype(int) + down
        kept = np.clip(row, 0, rows - 1)
        shift = 0.5 * (row % 2)
        brick = np.floor(x - shift).astype(int)
        for over in (-1, 0, 1):
            column = brick + over
            own = column % columns
            along = x - (column + 0.5 + shift + aside[0][kept, own])
            across = y - (row + 0.5 + aside[1][kept, own])
            large = size[kept, own]
            dome = 1.0 - (along / (0.78 * large)) ** 2 - (across / (0.66 * large)) ** 2
            keel = 1.0 + KEEL * np.exp(-np.abs(across) / 0.09)
            relief = np.sqrt(np.maximum(dome, 0.0)) * (0.70 - 0.38 * along) * keel
            higher = relief > best
            best = np.where(higher, relief, best)
            number = np.where(higher, kept * columns + own, number)
    return best, number


def painted(relief: np.ndarray, tone: np.ndarray, above: float) -> np.ndarray:
    """Return the brightness of a relief 0..1 (h, w) in light from above, which is row 0.

    ``tone`` (h, w) is each scale's own brightness.
    """
    slope = np.zeros_like(relief)
    slope[1:-1] = 0.5 * (relief[2:] - relief[:-2])
    end = np.roll(relief, -1, axis=1) - np.roll(relief, 1, axis=1)
    light = np.clip(1.0 + above * slope + 0.35 * above * end, 0.35, 1.5)
    furrow = np.clip(relief / 0.34, 0.0, 1.0) ** 0.6
    return np.asarray(BRIGHT * tone * light * (KEEN + (1.0 - KEEN) * furrow))


def _body(generator: np.random.Generator, height: int, width: int) -> np.ndarray:
    """Return the strip of the body, float32 (h, w, 4), 0..1."""
    relief, number = scattered(generator, height, width, COLUMNS, ROWS)
    fine, small = scattered(generator, height, width, 3 * COLUMNS // 2, 3 * ROWS // 2)
    down = ((np.arange(height, dtype=np.float32) + 0.5) / height)[:, None]

    # Small scales in the middle of the flank and along the back, larger ones between.
    patchy = 0.06 * waves(generator, height, width, 14)
    narrow = np.exp(-(((down + patchy - 0.60) / 0.13) ** 2)) + np.exp(
        -(((down + patchy) / 0.09) ** 2)
    )
    swap = narrow > 0.5
    relief, number = np.where(swap, fine, relief), np.where(swap, small + ROWS * COLUMNS, number)

    # Rows of keeled plates on back and flank, as a sturgeon has.
    x = np.arange(width, dtype=np.float32)[None, :] / width
    plate = np.zeros_like(relief)
    for middle, half, count, shift in ((0.20, 0.052, 20, 0.0), (0.47, 0.028, 26, 0.4)):
        f = (x * count + shift) % 1.0
        across = (down - middle - 0.004 * waves(generator, height, width, count)) / half
        reach = 1.0 - np.abs(across) ** 1.4 - np.abs((f - 0.5) / 0.52) ** 3.0
        keel = np.exp(-np.abs(across) / 0.22)
        # Ridges run from the middle of a plate to its edge; it is pitted between them.
        ridges = np.sin(26.0 * np.arctan2(across, 2.4 * (f - 0.5)))
        pits = waves(generator, height, width, 480)
        rough = 1.0 + (0.055 * ridges + 0.075 * pits) * np.clip(1.0 - keel, 0.0, 1.0)
        own = np.clip(reach, 0.0, 1.0) ** 0.5 * (0.75 + 0.35 * keel) * (1.15 - 0.5 * f) * rough
        plate = np.maximum(plate, own)
        number = np.where(own > 0.25, 9000 + (x * count + shift).astype(np.int32) % count, number)
    relief = np.where(plate > 0.12, plate, relief * np.clip(1.0 - 4.0 * plate, 0.0, 1.0))

    # Shields across the belly, with a few fine lines along each.
    at = (x * SHIELDS + 0.05 * waves(generator, height, width, 30)) % SHIELDS
    f = at % 1.0
    shield = np.clip(f / 0.12, 0.0, 1.0) * (1.12 - 0.35 * f)
    begin = np.clip((down + 0.25 * patchy - SHIELDED) / 0.02, 0.0, 1.0)
    relief = relief * (1.0 - begin) + shield * begin
    number = np.where(begin > 0.5, 12000 + at.astype(np.int32) % SHIELDS, number)

    own_tone = generator.uniform(0.80, 1.12, 13000).astype(np.float32)
    bright = painted(relief, own_tone[number], ABOVE)
    grain = generator.standard_normal((height, width)).astype(np.float32)
    bright *= 1.0 + 0.05 * grain + 0.07 * waves(generator, height, width, 40)
    bright *= 1.0 + 0.06 * waves(generator, height, width, 200)

    # Slime and algae in the furrows, brown and green; scars, and pale rings where lampreys bit.
    rgb = np.repeat(bright[..., None], 3, axis=2)
    film = np.clip(
        0.9 * waves(generator, height, width, 22) + 0.7 * waves(generator, height, width, 90), 0, 1
    )
    film = (film * np.clip(1.15 - relief, 0.0, 1.0) * (1.0 - 0.5 * begin))[..., None]
    rgb *= 1.0 - film * np.array([0.40, 0.30, 0.62], np.float32)
    scars = np.zeros_like(bright)
    y = np.arange(height, dtype=np.float32)[:, None]
    column = np.arange(width, dtype=np.float32)[None, :]
    for x0, y0, x1, y1 in ((180, 150, 330, 260), (200, 140, 345, 246), (1130, 300, 1310, 215)):
        dx, dy = x1 - x0, y1 - y0
        share = np.clip(((column - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy), 0, 1)
        away = np.hypot(column - x0 - share * dx, y - y0 - share * dy)
        scars = np.maximum(scars, np.exp(-((away / (3.2 - 2.2 * np.abs(share - 0.4))) ** 2)))
    for x0, y0, size in ((700, 225, 17), (760, 262, 14), (1640, 180, 15)):
        away = np.hypot(column - x0, y - y0)
        scars = np.maximum(scars, 0.8 * np.exp(-(((away - size) / 2.6) ** 2)))
    rgb += (0.55 * scars * (0.6 + 0.4 * np.clip(grain, -1, 1)))[..., None] * np.array(
        [1.0, 0.93, 0.86], np.float32
    )

    # Water that runs down leaves dark and glossy trails.
    trail = np.clip(1.3 * waves(generator, 40, width, 150)[5] - 0.55, 0.0, 1.0)[None, :]
    trail = trail * np.clip(1.2 * waves(generator, height, width, 18) + 0.5, 0.0, 1.0)
    rgb *= (1.0 - 0.30 * trail)[..., None]

    # Not all scales lie alike, so that some catch the sun and others do not.
    catches = generator.uniform(0.35, 1.0, 13000).astype(np.float32)[number]
    spot = np.clip((relief - 0.62) / 0.16, 0.0, 1.0) ** 2 * catches**2
    mirrors = 0.40 * np.clip((relief - 0.18) / 0.35, 0.0, 1.0) + 0.75 * spot
    mirrors *= np.clip(1.0 + 0.35 * waves(generator, height, width, 60), 0.3, 1.3)
    mirrors = np.maximum(mirrors, 0.6 * trail)
    mirrors *= 1.0 - 0.85 * np.clip(film[..., 0] * 2.0, 0.0, 1.0)
    return np.concatenate([rgb, (0.06 + 0.94 * mirrors)[..., None]], axis=2)


def _head(generator: np.random.Generator, height: int, width: int) -> np.ndarray:
    """Return the strip of the head: small scales, each a knob."""
    relief, number = scattered(generator, height, width, HEAD_COLUMNS, HEAD_ROWS)
    tone = generator.uniform(0.82, 1.10, HEAD_COLUMNS * HEAD_ROWS).astype(np.float32)
    bright = painted(relief, tone[number], 1.6)
    grain = generator.standard_normal((height, width)).astype(np.float32)
    bright *= 1.0 + 0.05 * grain + 0.08 * waves(generator, height, width, 60)
    film = np.clip(waves(generator, height, width, 40), 0, 1) * np.clip(1.1 - relief, 0.0, 1.0)
    rgb = bright[..., None] * (1.0 - film[..., None] * np.array([0.35, 0.28, 0.55], np.float32))
    catches = generator.uniform(0.35, 1.0, HEAD_COLUMNS * HEAD_ROWS).astype(np.float32)[number]
    spot = np.clip((relief - 0.62) / 0.16, 0.0, 1.0) ** 2 * catches**2
    mirrors = 0.40 * np.clip((relief - 0.18) / 0.35, 0.0, 1.0) + 0.75 * spot
    return np.concatenate([rgb, (0.06 + 0.94 * mirrors)[..., None]], axis=2)


def _fins(generator: np.random.Generator, height: int, width: int) -> np.ndarray:
    """Return the strip of the fins: dark at the root, thin towards a ragged edge."""
    out = ((np.arange(height, dtype=np.float32) + 0.5) / height)[:, None]
    x = (np.arange(width, dtype=np.float32) + 0.5)[None, :] / width * FIN_RAYS
    f = x % 1.0
    own = np.floor(x).astype(int)
    between = 4.0 * f * (1.0 - f)

    # The edge hangs in an arc between two spines, torn here and there.
    hang = generator.uniform(0.06, 0.20, FIN_RAYS).astype(np.float32)[own]
    end = 0.96 - hang * between
    end = (
        end
        - 0.035 * waves(generator, height, width, 90)
        - 0.02 * waves(generator, height, width, 330)
    )
    for _ in range(6):
        at, deep = generator.uniform(0, FIN_RAYS), generator.uniform(0.12, 0.36)
        aside = np.abs((x - at + FIN_RAYS / 2) % FIN_RAYS - FIN_RAYS / 2)
        wide = generator.uniform(0.04, 0.13)
        end = end - deep * np.clip(1.0 - aside / wide, 0.0, 1.0) ** 1.5
    covered = np.clip((end - out) / 0.012 + 0.5, 0.0, 1.0)
    for _ in range(9):  # holes
        at, up = generator.uniform(0, FIN_RAYS), generator.uniform(0.45, 0.75)
        aside = np.abs((x - at + FIN_RAYS / 2) % FIN_RAYS - FIN_RAYS / 2)
        size = generator.uniform(0.03, 0.08)
        away = np.hypot(aside / size, (out - up) / (0.9 * size))
        covered = covered * np.clip((away - 1.0) * 5.0, 0.0, 1.0)

    # Thin skin: light through it is brown and green; veins branch from the spines.
    thin = np.clip((out / np.maximum(end, 0.2)) ** 1.3, 0.0, 1.0)
    root, edge = np.array([0.085, 0.105, 0.098]), np.array([0.370, 0.385, 0.275])
    rgb = root + (edge - root) * (thin * (0.45 + 0.55 * between**0.6))[..., None]
    streak = waves(generator, 3, width, 420)[1][None, :] + 0.5 * waves(
        generator, height, width, 260
    )
    rgb = rgb * (1.0 + 0.07 * streak)[..., None]
    veins = np.abs(
        np.sin(
            np.pi * (6.0 * np.abs(f - 0.5) + 5.0 * out + 0.5 * waves(generator, height, width, 60))
        )
    )
    rgb *= (1.0 - 0.30 * np.exp(-((veins / 0.22) ** 2)) * np.clip(3.0 * out - 0.4, 0, 1))[..., None]
    spots = np.clip(1.6 * waves(generator, height, width, 54) - 0.75, 0.0, 1.0)
    rgb *= (1.0 - 0.55 * spots)[..., None]
    rgb *= (1.0 - 0.55 * np.exp(-((np.minimum(f, 1.0 - f) / 0.07) ** 2)))[..., None]
    rim = np.exp(-(((end - out) / 0.035) ** 2))
    rgb = rgb * (1.0 - 0.35 * rim)[..., None]
    opaque = covered * (1.0 - 0.45 * thin * between**0.5 * (1.0 - 0.6 * spots))
    return np.concatenate([rgb, opaque[..., None]], axis=2)


def _odds(generator: np.random.Generator, height: int, width: int) -> np.ndarray:
    """Return the strip of bone, with an eye at its beginning and plain white at its end."""
    along = (np.arange(width, dtype=np.float32) + 0.5)[None, :] / width
    down = ((np.arange(height, dtype=np.float32) + 0.5) / height)[:, None]
    ring = 0.5 + 0.5 * np.sin(
        2 * np.pi * (46.0 * along + 0.35 * waves(generator, height, width, 30))
    )
    grey = 0.80 + 0.20 * ring**2 - 0.16 * np.clip(waves(generator, height, width, 24), 0, 1)
    grey = grey * (1.0 + 0.10 * waves(generator, height, width, 300))
    grey = grey * (0.72 + 0.28 * np.clip(1.6 * down, 0, 1))
    share = np.clip((along - BONE[0]) / (BONE[1] - BONE[0]), 0.0, 1.0)
    worn = np.clip(share - 0.10 + 0.10 * waves(generator, height, width, 40), 0.0, 1.0)[..., None]
    tint = np.array([0.90, 0.88, 0.80]) * (1.0 - worn) + np.array([1.12, 1.08, 1.0]) * worn
    rgb = grey[..., None] * tint
    alpha = np.full((height, width), 0.30, np.float32)

    x = (along - EYE[0]) / EYE[1]
    y = 2.0 * down - 1.0
    inside = (np.abs(x) < 1.35) & (np.abs(y) < 2.0)
    away = np.hypot(x, y)
    slit = np.hypot(x / 0.14, y / 0.52) < 1.0
    spoke = 0.80 + 0.20 * np.sin(17.0 * np.arctan2(y, x) + 9.0 * away)
    iris = np.array([0.50, 0.40, 0.14]) * (spoke * np.clip(1.25 - 0.9 * away, 0.2, 1.2))[..., None]
    eye = np.where((away < 0.62)[..., None], iris, np.array([0.045, 0.045, 0.04]))
    eye = np.where(slit[..., None], 0.012, eye)
    rgb = np.where(inside[..., None], eye, rgb)
    alpha = np.where(inside, 1.0, alpha)

    plain = np.abs(along - PLAIN[0]) < 0.03
    rgb = np.where(plain[..., None], 1.0, rgb)
    alpha = np.where(plain, 0.55, alpha)
    alpha = np.broadcast_to(alpha, (height, width))
    return np.concatenate([np.broadcast_to(rgb, (height, width, 3)), alpha[..., None]], axis=2)


def serpent_skin() -> np.ndarray:
    """Return the texture, uint8 (HEIGHT, WIDTH, 4); row 0 is t = 0."""
    generator = np.random.default_rng(SEED)
    makers = {Strip.BODY: _body, Strip.HEAD: _head, Strip.FIN: _fins, Strip.BONE: _odds}
    parts = []
    for strip, make in makers.items():
        first, last = SPAN[strip]
        part = make(generator, last - first, WIDTH)
        parts.append(np.rint(255.0 * np.clip(part, 0.0, 1.0)).astype(np.uint8))
    return np.concatenate(parts)
