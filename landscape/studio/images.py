"""Image tools of the studio: colour encoding, noise, downsampling, colour bleeding."""

import numpy as np
from scipy import ndimage


def to_srgb(linear: np.ndarray) -> np.ndarray:
    """Encode linear light in 0..1 (any shape) with the sRGB curve."""
    linear = np.clip(linear, 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def to_linear(srgb: np.ndarray) -> np.ndarray:
    """Decode sRGB values in 0..1 (any shape) to linear light."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def to_uint8(values: np.ndarray) -> np.ndarray:
    """Round values in 0..1 to bytes."""
    return (np.clip(values, 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8)


def spectral_noise(size: int, exponent: float, seed: int, low_cut: float = 0.0) -> np.ndarray:
    """Return noise (size, size), mean 0, standard deviation 1, with amplitude ~ k**-exponent.

    It is made in the Fourier domain, so it tiles. Wave numbers below ``low_cut`` (cycles per tile)
    are left out; in a repeated tile they would show as a pattern of light and dark patches.
    """
    rng = np.random.default_rng(seed)
    kx = np.fft.fftfreq(size)[None, :] * size
    ky = np.fft.fftfreq(size)[:, None] * size
    k = np.hypot(kx, ky)
    amplitude = np.where(k > max(low_cut, 0.5), np.maximum(k, 1.0) ** -exponent, 0.0)
    spectrum = np.fft.fft2(rng.standard_normal((size, size))) * amplitude
    noise = np.fft.ifft2(spectrum).real
    return (noise - noise.mean()) / noise.std()


def ridged(size: int, seed: int, octaves: int, low_cut: float) -> np.ndarray:
    """Return ridged noise (size, size) in 0..1: sharp crests, each octave finer on the crests."""
    total, weight = np.zeros((size, size)), np.ones((size, size))
    for octave in range(octaves):
        noise = spectral_noise(size, 3.0, seed + octave, low_cut * 2**octave)
        sharp = (1.0 - np.minimum(np.abs(noise) / 2.4, 1.0)) ** 1.5
        total += sharp * weight * 0.5**octave
        weight = np.clip(sharp * 1.6, 0.0, 1.0)
    total -= total.min()
    return total / total.max()


def smoothstep(low: float, high: float, x: np.ndarray) -> np.ndarray:
    """Return the cubic step from 0 at ``low`` to 1 at ``high``."""
    t = np.clip((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def shrink(image: np.ndarray, factor: int) -> np.ndarray:
    """Downsample (h, w, c) by a box filter of ``factor``; RGBA must be premultiplied floats."""
    h, w, c = image.shape
    return image.reshape(h // factor, factor, w // factor, factor, c).mean(axis=(1, 3))


def cut_out(shrunk: np.ndarray) -> np.ndarray:
    """Return the picture of a leaf or the like, RGBA uint8, of premultiplied linear light.

    Its border is transparent. Five bits per colour are enough, and make the file smaller.
    """
    linear = shrunk[..., :3] / np.maximum(shrunk[..., 3:], 1e-4)
    rgba = to_uint8(np.dstack([to_srgb(linear), shrunk[..., 3]]))
    rgba[[0, -1], :, 3] = 0
    rgba[:, [0, -1], 3] = 0
    rgba[..., :3] = (rgba[..., :3] >> 3) * 8 + 4
    return rgba


def bleed(rgba: np.ndarray, threshold: int = 1) -> np.ndarray:
    """Give every texel with alpha under ``threshold`` the colour of the nearest other texel.

    uint8 (h, w, 4) in and out. Without this, filtering mixes the colour of transparent texels into
    the edges and leaves a white or black halo.
    """
    empty = rgba[..., 3] < threshold
    if empty.all() or not empty.any():
        return rgba
    rows, columns = ndimage.distance_transform_edt(
        empty, return_distances=False, return_indices=True
    )
    out = rgba.copy()
    out[..., :3] = rgba[rows, columns, :3]
    return out
