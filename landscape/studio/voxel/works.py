"""The tiles of what is built: brick, slate, planks, the hide of animals, and a lamp."""

import numpy as np

from landscape.studio.images import smoothstep
from landscape.studio.voxel.paint import (
    OVER,
    SIDE,
    Canvas,
    axes,
    levelled,
    noise,
    ramp,
    smeared,
    stepped,
)

# All chosen: ramps of colour, dark to light.
LIMESTONE = ((104, 92, 90), (150, 134, 120), (190, 172, 146), (218, 202, 172), (242, 230, 204))
MORTAR = (132, 118, 108)
SLATE = ((44, 50, 66), (74, 84, 104), (106, 118, 138), (144, 154, 168), (190, 196, 202))
PLANK = ((88, 58, 44), (134, 92, 60), (174, 126, 80), (204, 158, 106), (230, 192, 142))
HIDE = ((150, 150, 160), (200, 200, 204), (228, 227, 226), (246, 245, 240), (255, 255, 252))
IRON = ((34, 30, 38), (62, 56, 62), (98, 88, 84), (150, 134, 116))
GLOW = ((214, 108, 34), (246, 164, 54), (255, 208, 104), (255, 238, 172), (255, 252, 228))
COURSES = 4  # of stones, slates and planks, so that walls of blocks have no seams


def brick() -> np.ndarray:
    """Return castle stone: four courses, of three and two stones in turn."""
    rng = np.random.default_rng(211)
    x, y = axes()
    x = x + 0.30 * noise(1.6, 212)
    y = y + 0.25 * noise(1.6, 213)
    high = SIDE / COURSES
    course = np.floor(y / high).astype(int) % COURSES
    joints = ((4.0, 26.0, 44.0), (15.0, 37.0, 58.0), (7.0, 30.0, 50.0), (19.0, 41.0, 62.0))
    left = np.zeros(x.shape)
    right, number = left.copy(), np.zeros(x.shape, int)
    for k, places in enumerate(joints):
        ends = np.array([*places, places[0] + SIDE])
        own = (x - ends[0]) % SIDE + ends[0]
        stone = np.clip(np.searchsorted(ends, own, "right") - 1, 0, 2)
        here = course == k
        left = np.where(here, own - ends[stone], left)
        right = np.where(here, ends[stone + 1] - own, right)
        number = np.where(here, 3 * k + stone, number)

    top = y % high

    # The distance inside a box with rounded corners.
    away = np.stack([left, right, top, high - top]) - 0.75
    inside = -0.7 * np.log(np.exp(-away / 0.7).sum(axis=0))
    edges = np.clip(1.0 - away / 2.6, 0.0, 1.0)
    light = 0.6 * (edges[0] - edges[1]) + 0.9 * (edges[2] - edges[3])
    tone = rng.permutation(np.linspace(-0.075, 0.075, 12)) + 0.02 * rng.normal(size=12)
    hewn = stepped(noise(1.7, 214, 4.0) * 0.035, 26, 0.3)
    value = 0.60 + tone[number] + hewn + 0.15 * light
    pits = smoothstep(1.75, 2.1, noise(1.5, 215, 7.0)) * smoothstep(1.0, 2.0, inside)
    tint = rng.normal(0, 1.0, 12)[number][..., None] * np.array([0.012, 0.0, -0.02])
    stone_colour = ramp(LIMESTONE, stepped(value, 18, 0.3) - 0.16 * pits) + tint

    # The shadow of a stone's lower edge falls on the joint below it.
    joint = np.array(MORTAR) / 255.0 * (1.0 - 0.22 * smoothstep(0.0, 1.2, high - top))[..., None]
    cover = smoothstep(-0.15, 0.35, inside)[..., None]
    return levelled(stone_colour * cover + joint * (1.0 - cover), 1.5, 0.3)


def slate() -> np.ndarray:
    """Return slates in four rows, each over the next and half a slate aside."""
    rng = np.random.default_rng(221)
    x, y = axes()
    x = (x + 5.0) % SIDE  # no joint on the tile's edge
    high, wide = SIDE / COURSES, SIDE / 4
    row = np.floor(y / high).astype(int)
    drop = rng.uniform(0.3, 2.6, (COURSES, 4))
    aside = rng.uniform(-1.0, 1.0, (COURSES, 4))

    def slates(r: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the number of the slate at each sample if it is in row ``r``, and x in it."""
        across = x - wide / 2 * (r % 2)
        number = np.floor(across / wide).astype(int) % 4
        across = across % wide
        return number, across

    above = (row - 1) % COURSES
    n_above, x_above = slates(above)
    # Corners of the slates are cut off a little.
    corner = 1.6 * smoothstep(2.6, 0.2, np.minimum(x_above, wide - x_above))
    under = y - row * high - (drop[above, n_above] - corner) < 0
    r = np.where(under, above, row)
    number, across = slates(r)
    down = np.where(under, y - (row - 1) * high, y - row * high)
    end = high + drop[r, number] - 1.6 * smoothstep(2.6, 0.2, np.minimum(across, wide - across))
    to_end = end - down
    across = across + 0.4 * aside[r, number]
    edge = np.minimum(across, wide - across)
    tone = rng.permutation(np.linspace(-0.11, 0.11, 16)).reshape(COURSES, 4)[r, number]
    value = 0.50 + tone + 0.012 * (down - high / 2)
    value = stepped(value + 0.03 * smeared(noise(1.2, 222, 5.0), 41, 0), 20, 0.3)
    value = value + 0.16 * smoothstep(1.7, 0.9, to_end) + 0.07 * smoothstep(2.2, 1.0, across)
    covered = y - row * high - (drop[above, n_above] - corner)  # below the edge of the row above
    value = value - 0.30 * smoothstep(3.6, 0.0, covered) * ~under
    value = value - 0.30 * smoothstep(0.75, 0.3, edge)
    tint = rng.normal(0, 1, (COURSES, 4))[r, number][..., None] * np.array([0.016, 0.004, -0.006])
    return levelled(ramp(SLATE, value) + tint, 1.5, 0.2)


def planks() -> np.ndarray:
    """Return four planks with grain, a joint in each, and nails beside it."""
    rng = np.random.default_rng(231)
    x, y = axes()
    high = SIDE / COURSES
    plank = np.floor(y / high).astype(int)
    own = y % high
    joints = np.array([13.0, 45.0, 27.0, 59.0])
    from_joint = (x - joints[plank] + SIDE / 2) % SIDE - SIDE / 2
    flow = smeared(noise(2.2, 232, 1.0), 49, 1)
    lines = np.cos(2 * np.pi * (own / 4.2 + 0.32 * flow) + 1.7 * plank)
    tone = np.array([-0.05, 0.05, 0.01, -0.01])[plank]
    value = stepped(0.56 + tone - 0.10 * np.clip(lines, 0.2, 1.0) ** 2, 18, 0.35)
    value = value + 0.12 * smoothstep(2.2, 0.9, own) - 0.14 * smoothstep(2.4, 0.9, high - own)
    joint = np.minimum(np.abs(from_joint) * 1.4, np.minimum(own, high - own))
    value = value + 0.08 * smoothstep(2.0, 1.0, from_joint) * (from_joint > 0)
    value = value - 0.50 * smoothstep(0.85, 0.35, joint)
    canvas = Canvas(ramp(PLANK, value))
    for k in range(COURSES):
        for aside in (-3.4, 3.4):
            for up in (4.2, 11.8):
                place = np.array([joints[k] + aside, k * high + up])
                canvas.blob(place + 0.4, (1.2, 1.2), 0.0, PLANK, 0.12, 0.0)
                canvas.blob(place, (0.95, 0.95), 0.0, IRON, 0.62, 0.5)

    for k, across in ((0, 44.0), (2, 55.0)):
        place = np.array([across, k * high + rng.uniform(6, 9)])
        for size, dark in ((3.2, 0.42), (2.2, 0.30), (1.2, 0.16)):
            canvas.blob(place, (1.35 * size, 0.8 * size), 0.0, PLANK, dark, 0.0)

    return levelled(canvas.colour, 1.5, 0.3)


def hide() -> np.ndarray:
    """Return pale tufts that overlap softly downwards: fur, scales or cloth by their tint."""
    rng = np.random.default_rng(241)
    rows = 8
    pitch = SIDE / rows
    tones = 0.62 + rng.normal(0, 0.05, (rows, rows))
    moved = rng.normal(0, 0.3, (rows, rows))
    # Each row lies over the next: of two tiles, the second is whole at both ends.
    canvas = Canvas(ramp(HIDE, np.full((2 * SIDE * OVER, SIDE * OVER), 0.2)), wrap_y=False)
    for row in range(2 * rows, -2, -1):
        for k in range(rows):
            across = (k + 0.5 * (row % 2) + 0.5) * pitch + moved[row % rows, k]
            place = np.array([across, row * pitch + 2.0])
            canvas.blob(place + [0.3, 1.4], (4.6, 6.5), 0.0, HIDE, 0.20, 0.0, 0.03)
            canvas.blob(place, (4.3, 6.2), 0.0, HIDE, tones[row % rows, k], 0.22, 0.03)
    first = SIDE * OVER // 2
    return levelled(canvas.colour[first : first + SIDE * OVER])


def lamp() -> np.ndarray:
    """Return a lantern: four glowing panes in a frame of iron."""
    x, y = axes()
    u, v = x - SIDE / 2, y - SIDE / 2
    far = np.maximum(np.abs(u), np.abs(v))
    warm = 1.0 - np.hypot(u, 0.9 * (v - 3.0)) / 38.0
    glow = ramp(GLOW, stepped(0.25 + 0.85 * warm + 0.02 * noise(1.8, 251), 9, 0.4))

    # A thicker frame outside, thin bars between the panes.
    inside = np.minimum(26.0 - far, np.minimum(np.abs(u), np.abs(v)) - 1.7)
    frame = np.clip(0.5 - inside * 2.0, 0.0, 1.0)[..., None]
    outer = far > 26.0
    across = np.where(np.abs(u) > np.abs(v), np.sign(u), 0.0)
    down = np.where(np.abs(v) >= np.abs(u), np.sign(v), 0.0)
    from_edge = 32.0 - far
    bevel = np.where(from_edge < 2.0, -1.0, np.where(from_edge > 4.2, 0.9, 0.0))
    tone = 0.36 + 0.22 * outer * bevel * (0.6 * across + 0.8 * down) + 0.22 * ~outer
    canvas = Canvas(glow * (1.0 - frame) + ramp(IRON, tone) * frame)
    halo = smoothstep(2.8, 0.0, inside)[..., None] * (1.0 - frame)
    canvas.colour *= 1.0 - 0.18 * halo * np.array([0.3, 0.8, 1.0])
    for sx in (-1, 1):
        for sy in (-1, 1):
            place = np.array([SIDE / 2 + 29 * sx, SIDE / 2 + 29 * sy])
            canvas.blob(place, (1.5, 1.5), 0.0, IRON, 0.68, 0.4)

    return canvas.colour
