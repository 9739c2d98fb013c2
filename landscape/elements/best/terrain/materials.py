"""Turf, sand and rock: where each is on the ground, and the four texture units that mix them.

Unit 0 is turf. Unit 1 interpolates to sand by the large texture's alpha, which it reads from unit 3
(crossbar). Unit 2 interpolates to rock by the vertices' alpha. Unit 3 multiplies by the large-scale
colour and scales by 2.
State used: texture units 0 to 3, GL_COMBINE (OpenGL 1.3), ARB_texture_env_crossbar (OpenGL 1.4).
"""

import numpy as np
from PIL import Image

from landscape.geometry.height_field import greenness
from landscape.gl.calls import gl
from landscape.gl.texture import Texture

MID = 0.8  # chosen: strength of the detail baked into the large texture


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


def mix_units(layers: list[Texture]) -> None:
    """Set four units to turf, sand, rock and the large colour: (((turf, sand), rock) x large x 2).

    ``a`` mixed with ``b`` by ``c`` is a c + b (1 - c), which is GL_INTERPOLATE.
    """
    env = gl.GL_TEXTURE_ENV
    turf_here = gl.GL_TEXTURE3  # the alpha of another unit's texture: crossbar
    mixes = [
        (gl.GL_REPLACE, (gl.GL_TEXTURE,)),
        (gl.GL_INTERPOLATE, (gl.GL_PREVIOUS, gl.GL_TEXTURE, turf_here)),
        (gl.GL_INTERPOLATE, (gl.GL_TEXTURE, gl.GL_PREVIOUS, gl.GL_PRIMARY_COLOR)),
        (gl.GL_MODULATE, (gl.GL_TEXTURE, gl.GL_PREVIOUS)),
    ]
    for unit, (layer, (mix, sources)) in enumerate(zip(layers, mixes, strict=True)):
        gl.glActiveTexture(getattr(gl, f"GL_TEXTURE{unit}"))
        layer.bind()
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glTexEnvi(env, gl.GL_TEXTURE_ENV_MODE, gl.GL_COMBINE)
        gl.glTexEnvi(env, gl.GL_COMBINE_RGB, mix)
        for k, source in enumerate(sources):
            gl.glTexEnvi(env, getattr(gl, f"GL_SOURCE{k}_RGB"), source)
        # The result is opaque: the details have no alpha, which reads as 1.
        gl.glTexEnvi(env, gl.GL_COMBINE_ALPHA, gl.GL_REPLACE)
        gl.glTexEnvi(env, gl.GL_SOURCE0_ALPHA, gl.GL_PREVIOUS if unit else gl.GL_TEXTURE)
    gl.glTexEnvf(env, gl.GL_RGB_SCALE, 2.0)
