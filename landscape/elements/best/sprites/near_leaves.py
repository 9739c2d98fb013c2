"""Sprays of leaves before the pictures of oaks that the eye is close to (``trees.variety``).

Within a few steps a tree's picture has fewer texels than the screen has pixels: leaves are blurred
patches. Technique: small quads with a spray of leaves each, at random places where the picture
shows leaves, in its colour there, so that they are lit as it is. They turn with the billboard, but
stand at different depths: as one passes, near ones move before far ones. Whoever stands under the
tree sees leaves against the light: those let it through, and are yellower and brighter. The nearer
the tree, the more sprays: none appears all at once. Cost: up to TREES times SPRAYS quads with an
alpha test, only this near. No OpenGL here but in :class:`NearLeaves`.
"""

from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageFilter

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays
from framelens.gl.texture import Texture
from landscape.elements.atlas import GUTTER
from landscape.elements.best.sprites.choice import Choice
from landscape.elements.best.sprites.individuals import OAK, OAK_LEANING, OAK_TALL, OAK_YOUNG
from landscape.frame import Frame

LEAFY = (OAK, OAK_LEANING, OAK_TALL, OAK_YOUNG)  # pictures that get sprays
TREES, SPRAYS = 3, 5000  # chosen: the nearest trees, and the sprays of each
REACH, WHOLE = 0.55, 0.25  # chosen: units away at which the first sprays stand, and all of them
SIDE = 0.010  # chosen: side of a spray of mean size, times the tree's width
DEEP = 0.01  # chosen: how far sprays stand before and behind the picture, times the tree's width
BESIDE = 5  # chosen: texels beside a bough, and inside the outline, that sprays leave free
BLENDED = 4  # chosen: texels around a spray of whose colours its own is the mean
CELL = 128  # texels per side of a spray's picture; there are two times two
LEAVES = 11  # chosen: leaves of a spray
SHOWN = 0.40  # chosen: alpha from which a texel is drawn
BRIGHTER = 1.14  # as the leaves' picture is not white
THROUGH = np.array([8.5, 9.5, 0.5])  # chosen: light that leaves let through, of 255
GLOWING = 0.11  # chosen: by how much of their own colour such leaves are brighter


@dataclass(frozen=True)
class Sprays:
    """Sprays of one tree: places s, t in its picture and colours, each (SPRAYS, 2 or 3).

    ``depth`` is where they stand before the picture, -1..1; ``axes`` (SPRAYS, 2, 3) are the halves
    of their sides as right, up and forward, times their size; ``through`` is how much light each
    lets through, 0..1, ``cell`` which picture it has.
    """

    places: np.ndarray
    colours: np.ndarray
    depth: np.ndarray
    axes: np.ndarray
    through: np.ndarray
    cell: np.ndarray


def leafy(picture: np.ndarray) -> np.ndarray:
    """Return where a picture (h, w, 4) shows leaves, with no bough or sky beside: bool (h, w)."""
    red, green, blue, alpha = (picture[..., k].astype(int) for k in range(4))
    leaf = (alpha > 150) & (green > red + 6) & (green > blue + 14)
    bark = Image.fromarray(((alpha > 150) & (red > green - 4) & (red > 22)).astype(np.uint8) * 255)
    boughs = np.asarray(bark.filter(ImageFilter.BoxBlur(BESIDE))) > 127
    tree = Image.fromarray((alpha > 150).astype(np.uint8) * 255)
    inside = np.asarray(tree.filter(ImageFilter.BoxBlur(BESIDE))) > 250
    return np.asarray(leaf & ~boughs & inside)


def sprays_of(picture: np.ndarray, seed: int) -> Sprays:
    """Return the sprays of a tree with this picture, uint8 (h, w, 4)."""
    rng = np.random.default_rng([2006, 41, seed])
    rows, columns = np.nonzero(leafy(picture))
    picked = rng.integers(len(rows), size=SPRAYS) if len(rows) else np.zeros(0, int)
    rows, columns = rows[picked], columns[picked]
    height, width = picture.shape[:2]
    places = np.stack([(columns + 0.5) / width, (rows + 0.5) / height], axis=1)
    count = len(picked)
    turn = rng.uniform(0.0, 2 * np.pi, count)
    pitch, yaw = rng.normal(0.0, 0.55, count), rng.normal(0.0, 0.55, count)
    size = np.exp(rng.normal(0.0, 0.28, count))[:, None]
    across = np.stack([np.cos(turn) * np.cos(yaw), np.sin(turn), np.cos(turn) * np.sin(yaw)], 1)
    along = np.stack([-np.sin(turn), np.cos(turn) * np.cos(pitch), np.sin(pitch)], 1)
    # A spray in the colour of one texel would be a speck of light or shade beside its neighbours.
    opaque = Image.fromarray(np.ascontiguousarray(picture[..., :3]))
    around = np.asarray(opaque.filter(ImageFilter.BoxBlur(BLENDED)))
    colours = around[rows, columns] * rng.normal(1.08, 0.09, (count, 1))
    return Sprays(
        places,
        colours,
        np.clip(rng.normal(-0.2, 0.5, count), -1.0, 1.0),
        np.stack([across * size, along * size], axis=1),
        rng.random(count) ** 3,
        rng.integers(4, size=count),
    )


def oak_leaf(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return how far inside an oak leaf from (0, 0) to (1, 0) places are, and their shade."""
    along = np.clip(x, 0.0, 1.0)
    lobes = 0.80 + 0.20 * np.cos(2 * np.pi * (4.2 * along - 0.1))
    half = 0.27 * np.sin(np.pi * along**0.75) * lobes + 0.012
    inside = np.where((x > 0) & (x < 1), half - np.abs(y), -1.0)
    vein = np.exp(-np.square(y / 0.022))
    side = np.exp(-np.square(((4.2 * (along - 0.8 * np.abs(y)) + 0.5) % 1.0 - 0.5) / 0.10))
    return inside, 0.86 + 0.08 * np.sign(y) + 0.20 * vein + 0.07 * side


def spray_picture(seed: int) -> np.ndarray:
    """Return a spray of oak leaves around a twig, nearly white, uint8 (CELL, CELL, 4)."""
    rng = np.random.default_rng([2006, 42, seed])
    scale = 2
    size = CELL * scale
    axis = (np.arange(size) + 0.5) / size
    x, y = np.meshgrid(axis, axis[::-1])
    shade, alpha = np.zeros((2, size, size))
    for k in range(LEAVES):
        up = k / (LEAVES - 1)
        foot = np.array([0.5 + 0.05 * np.sin(5 * up + seed), 0.14 + 0.50 * up])
        turn = np.pi / 2 + (1.25 - 0.75 * up) * (-1) ** k + rng.normal(0.0, 0.25)
        length = rng.uniform(0.24, 0.36) * (1.0 - 0.15 * abs(up - 0.5))
        c, s = np.cos(turn) / length, np.sin(turn) / length
        u, v = (x - foot[0]) * c + (y - foot[1]) * s, (y - foot[1]) * c - (x - foot[0]) * s
        inside, light = oak_leaf(u, v)
        cover = np.clip(0.5 + inside * length * size, 0.0, 1.0)
        tone = rng.uniform(0.72, 1.0) * light * (0.8 + 0.2 * np.clip(inside / 0.1, 0.0, 1.0))
        # A leaf shades those just behind it.
        shade = shade * (1.0 - 0.25 * np.roll(cover, (4, 2), (0, 1)) * (1.0 - cover))
        shade = shade * (1.0 - cover) + tone * cover
        alpha = np.maximum(alpha, cover)
    small = (each.reshape(CELL, scale, CELL, scale).mean(axis=(1, 3)) for each in (shade, alpha))
    tone, cover = small
    out = np.empty((CELL, CELL, 4))
    out[..., :3] = np.where(cover > 0.02, tone / np.maximum(cover, 0.02), 0.75)[..., None]
    out[..., 3] = cover
    out[[0, -1], :, 3] = out[:, [0, -1], 3] = 0.0
    return np.asarray(np.rint(np.clip(out, 0.0, 1.0) * 255), np.uint8)


def spray_sheet() -> np.ndarray:
    """Return four sprays as one picture, uint8 (2 CELL, 2 CELL, 4)."""
    parts = [spray_picture(k) for k in range(4)]
    return np.vstack([np.hstack(parts[:2]), np.hstack(parts[2:])])


def standing(distance: np.ndarray) -> np.ndarray:
    """Return how many sprays trees have at distances (n,) in units, of SPRAYS."""
    part = np.clip((REACH - distance) / (REACH - WHOLE), 0.0, 1.0)
    return np.asarray(np.rint(SPRAYS * part), int)


def corners_of(
    sprays: Sprays,
    count: int,
    foot: np.ndarray,
    size: np.ndarray,
    right: np.ndarray,
    flipped: bool,
) -> np.ndarray:
    """Return the corners (count, 4, 3) of a tree's first sprays.

    ``foot`` (3,) is the tree's place, ``size`` (2,) its width and height, ``right`` (3,) its
    billboard's axis; with ``flipped`` its picture is mirrored.
    """
    up = np.array([0.0, 1.0, 0.0])
    forward = np.cross(right, up)
    s, t = sprays.places[:count].T
    aside = (0.5 - s if flipped else s - 0.5) * size[0]
    middles = foot + aside[:, None] * right + ((1.0 - t) * size[1])[:, None] * up
    middles = middles + (DEEP * size[0] * sprays.depth[:count])[:, None] * forward
    axes = 0.5 * SIDE * size[0] * sprays.axes[:count] @ np.stack([right, up, forward])
    across, along = axes[:, 0], axes[:, 1]
    return np.stack(
        [
            middles - across - along,
            middles + across - along,
            middles + across + along,
            middles - across + along,
        ],
        axis=1,
    )


def spray_colours(sprays: Sprays, count: int, tint: np.ndarray, against: float) -> np.ndarray:
    """Return the colours of a tree's first sprays, uint8 (count, 4).

    ``tint`` (count, 3) multiplies them, 0..1; ``against`` is how much the eye looks against the
    light from above, 0..1.
    """
    through = against * sprays.through[:count, None]
    colours = np.full((count, 4), 255, np.uint8)
    found = BRIGHTER * sprays.colours[:count] * tint * (1.0 + GLOWING * through) + through * THROUGH
    colours[:, :3] = np.clip(found, 0.0, 255.0)
    return colours


def coordinates_of(cells: np.ndarray) -> np.ndarray:
    """Return texture coordinates (n, 4, 2) of pictures 0 to 3 (n,) of the sheet."""
    s = np.array([0.0, 1.0, 1.0, 0.0]) / 2
    t = np.array([1.0, 1.0, 0.0, 0.0]) / 2
    u, v = (cells % 2 / 2)[:, None] + s, (cells // 2 / 2)[:, None] + t
    return np.stack([u, v], axis=2)


class NearLeaves:
    """The sheet of sprays, and where they are in each picture."""

    def __init__(self, sheet: np.ndarray, *pictures: np.ndarray) -> None:
        """Place sprays of the ``sheet`` in ``pictures``, the atlas's cells (h, w, 4) of LEAFY."""
        self._sprays = dict(
            zip(
                LEAFY, (sprays_of(cell[GUTTER:], k) for k, cell in enumerate(pictures)), strict=True
            )
        )
        self._texture = Texture(sheet, repeat=False)

    def draw(
        self,
        frame: Frame,
        trees: Choice,
        rights: np.ndarray,
        flipped: np.ndarray,
        light: np.ndarray,
    ) -> None:
        """Draw the sprays of the nearest of a choice's ``trees``.

        ``rights`` (n, 3) are their billboards' axes, ``flipped`` (n,) whether pictures are
        mirrored, ``light`` (n, 3) what multiplies their colours.
        """
        away = np.hypot(*(trees.positions[:, ::2] - frame.eye[[0, 2]]).T)
        counts = np.where(np.isin(trees.pictures, LEAFY), standing(away), 0)
        near = np.flatnonzero(counts)
        near = near[np.argsort(away[near])][:TREES]
        if not len(near):
            return
        corners, colours, places = [], [], []
        for k in near.tolist():
            sprays = self._sprays[int(trees.pictures[k])]
            count = min(int(counts[k]), len(sprays.depth))
            foot, size = trees.positions[k].astype(float), trees.sizes[k].astype(float)
            corners.append(corners_of(sprays, count, foot, size, rights[k], bool(flipped[k])))
            above = foot[1] + 0.6 * size[1] - frame.eye_y
            against = float(np.clip(1.3 * above / np.hypot(above, away[k]), 0.0, 1.0))
            tint = trees.colours[k, 0, :3] / 255.0 * light[k]
            found = spray_colours(sprays, count, tint[None], against)
            colours.append(np.repeat(found, 4, axis=0))
            places.append(coordinates_of(sprays.cell[:count]))

        vertices = np.ascontiguousarray(np.concatenate(corners).reshape(-1, 3), np.float32)
        looked_up = np.ascontiguousarray(np.concatenate(places).reshape(-1, 2), np.float32)
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT
        with attrib(groups | gl.GL_TEXTURE_BIT | gl.GL_DEPTH_BUFFER_BIT):
            gl.glDisable(gl.GL_BLEND)
            gl.glEnable(gl.GL_ALPHA_TEST)
            gl.glAlphaFunc(gl.GL_GREATER, SHOWN)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._texture.bind()
            with client_arrays(vertices, None, np.concatenate(colours), [looked_up]):
                gl.glDrawArrays(gl.GL_QUADS, 0, len(vertices))

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()
