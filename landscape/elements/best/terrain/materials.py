"""Turf, sand and rock: where each is on the ground, and the four texture units that mix them.

Unit 0 is turf. Unit 1 interpolates to sand by the large texture's alpha, which it reads from unit 3
(crossbar). Unit 2 interpolates to rock by the vertices' alpha. Unit 3 multiplies by the large-scale
colour and scales by 2.
A triangle that is all turf would look up sand and rock in vain. So triangles are told apart by the
materials that they have, and the units of the others are disabled while they are drawn.
State used: texture units 0 to 3, GL_COMBINE (OpenGL 1.3), ARB_texture_env_crossbar (OpenGL 1.4).
"""

from functools import reduce

import numpy as np
from PIL import Image

from framelens.gl.named import texture_unit
from framelens.gl.seam import gl
from framelens.gl.state import combine
from framelens.gl.texture import Texture
from landscape.geometry.height_field import greenness

MID = 0.8  # chosen: strength of the detail baked into the large texture
TURF, SAND, ROCK = MATERIALS = 1, 2, 4  # bits of a mixture; each material has the unit of its bit
TRACE = 8  # chosen: of 255; less of a material is not looked up
MARGIN = 2  # chosen: texels beside a triangle that filtering may mix in
# What a unit interpolates: sand by the alpha of another unit's texture (crossbar), rock by that of
# the vertices. Turf is never mixed in: it comes first.
SOURCES: dict[int, tuple[str, ...]] = {
    TURF: (),
    SAND: ("PREVIOUS", "TEXTURE", "TEXTURE3"),
    ROCK: ("TEXTURE", "PREVIOUS", "PRIMARY_COLOR"),
}


def turf_alpha(large: np.ndarray) -> np.ndarray:
    """Return where turf grows, uint8 (n, n, 1), by the large-scale colours (n, n, 3)."""
    turf = (greenness(large.reshape(-1, 3) / np.float32(255.0)) * 255).astype(np.uint8)
    return turf.reshape(*large.shape[:2], 1)


def textured(
    colours: np.ndarray, detail: np.ndarray, repeat: float, turf: np.ndarray
) -> np.ndarray:
    """Return colours, uint8 (n, n, 3), modulated by a detail (m, m, 3), ``repeat`` times.

    ``turf``, uint8 (n, n, 1), says where grass grows; bare ground gets a third of the contrast.
    This does once what another texture unit would do in each frame. It is for the ground a few
    units away, where the fine detail has averaged to grey; near the eye it is too coarse.
    """
    # Of a detail larger than the ground only the part that is seen is enlarged.
    part = min(repeat, 1.0)
    box = (0.0, 0.0, max(part * detail.shape[1], 1.0), max(part * detail.shape[0], 1.0))
    size = max(round(len(colours) / max(repeat, 1.0)), 1)
    tile = np.asarray(Image.fromarray(detail).resize((size, size), Image.Resampling.BOX, box))
    times = -(-len(colours) // size)
    contrast = MID * (tile.astype(np.float32) / np.float32(127.5) - 1)
    contrast = np.tile(contrast, (times, times, 1))[: len(colours), : colours.shape[1]]
    contrast *= (turf + np.float32(127.5)) / np.float32(382.5)
    return np.clip(colours * (1 + contrast), 0, 255).astype(np.uint8)


def rock_share(normals: np.ndarray, colour: np.ndarray) -> np.ndarray:
    """Return 0..1, how much rock shows on ground with these normals and colours (n, 3).

    Steep ground is rock, and so is grey ground; green is not. The limits are chosen to match the
    rules that painted the colours.
    """
    slope = np.hypot(normals[:, 0], normals[:, 2]) / np.maximum(normals[:, 1], 1e-6)
    steep = np.clip((slope - 0.3) / 0.3, 0.0, 1.0)
    vivid = 1.0 - colour.min(axis=1) / np.maximum(colour.max(axis=1), 1e-3)
    grey = np.clip((0.24 - vivid) / 0.08, 0.0, 1.0)
    return np.asarray(np.maximum(steep, grey) * (1.0 - 0.7 * greenness(colour)))


def turf_range(turf: np.ndarray, side: int) -> np.ndarray:
    """Return the least and the most turf, uint8 (2, side, side), in each of side x side cells.

    ``turf``, uint8 (n, n), is that of the texels; both have z along the rows.
    """
    n = len(turf)
    starts = np.arange(side) * n // side
    found = []
    for bound in (np.minimum, np.maximum):
        cells = turf
        for axis in (0, 1):
            wide = np.pad(
                cells, [(MARGIN, MARGIN) if k == axis else (0, 0) for k in (0, 1)], "edge"
            )
            shifts = (wide.take(np.arange(k, k + n), axis) for k in range(2 * MARGIN + 1))
            cells = bound.reduceat(reduce(bound, shifts), starts, axis)
        found.append(cells)
    return np.stack(found)


def mixtures(turf: np.ndarray, rock: np.ndarray) -> np.ndarray:
    """Return which materials each triangle (2 m,) of a grid of m cells has, as bits.

    ``turf`` (2, ...) is the least and the most turf in each cell, ``rock`` (2 m, 3) the share of
    rock at the corners of each triangle, all in 0..255.
    """
    least, most = np.repeat(turf.reshape(2, -1), 2, axis=1)
    bare = rock.min(axis=1) >= 255 - TRACE
    has_turf, has_sand = (most > TRACE) & ~bare, (least < 255 - TRACE) & ~bare
    return np.asarray(TURF * has_turf + SAND * has_sand + ROCK * (rock.max(axis=1) > TRACE))


def mix_units(layers: list[Texture]) -> None:
    """Set four units to turf, sand, rock and the large colour: (((turf, sand), rock) x large x 2).

    ``a`` mixed with ``b`` by ``c`` is a c + b (1 - c), which is GL_INTERPOLATE.
    """
    for unit, layer in enumerate(layers):
        gl.glActiveTexture(texture_unit(unit))
        layer.bind()
        # The result is opaque.
        combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "CONSTANT"})
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, np.ones(4, np.float32))
        gl.glEnable(gl.GL_TEXTURE_2D)
    look_up(TURF | SAND | ROCK)


def look_up(mixture: int) -> None:
    """Let the units of :func:`mix_units` look up these materials only; 0 is a mid grey.

    The first unit that is enabled starts the mix, and each other one adds to it.
    """
    before = False
    for unit, (bit, sources) in enumerate(SOURCES.items()):
        gl.glActiveTexture(texture_unit(unit))
        if not mixture & bit:
            gl.glDisable(gl.GL_TEXTURE_2D)
            continue
        gl.glEnable(gl.GL_TEXTURE_2D)
        mixed = {f"SRC{k}_RGB": source for k, source in enumerate(sources)}
        first = {"COMBINE_RGB": "REPLACE", "SRC0_RGB": "TEXTURE"}
        combine({"COMBINE_RGB": "INTERPOLATE"} | mixed if before else first)
        before = True

    gl.glActiveTexture(texture_unit(len(SOURCES)))

    # Twice a mid grey leaves the large colour as it is.
    combine({"COMBINE_RGB": "MODULATE" if mixture else "REPLACE", "SRC0_RGB": "TEXTURE"})
    gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 2.0 if mixture else 1.0)
