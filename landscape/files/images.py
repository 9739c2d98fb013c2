"""Image files as arrays: pictures, heights, and the mip levels of sprites. No OpenGL."""

import warnings
from pathlib import Path
from typing import BinaryIO

import numpy as np
from PIL import Image

from framelens.base.errors import InputError, reason
from framelens.base.input import check_plain
from landscape.files.cache import content, recall

# Those whose pictures are drawn from nothing but their own bytes, by decoders in wide use.
FORMATS = ("PNG", "JPEG", "TIFF", "BMP", "GIF", "WEBP", "PPM", "TGA")
MOST_PIXELS = 100_000_000  # chosen: 400 MB while it is decoded
MOST_BYTES = 1 << 30  # chosen: more than MOST_PIXELS take uncompressed, at 16 bits a channel
MAX_SIZE = 4096  # chosen: more texels than the largest window has pixels are of no use


def read_image(path: Path, mode: str = "RGBA", largest: int = MAX_SIZE) -> np.ndarray:
    """Read an image file as uint8, (h, w, 3 or 4) by mode "RGB" or "RGBA", (h, w) by "L".

    16-bit, grey and palette images are converted; an image with a side of more than ``largest``
    texels is reduced. InputError names a file that is missing, truncated, or not an image.
    """
    return recall((content(path), f"{mode} {largest}"), lambda: (_decoded(path, mode, largest),))[0]


def _decoded(path: Path, mode: str, largest: int) -> np.ndarray:
    image = open_image(path)
    if image.width > largest or image.height > largest:
        image.thumbnail((largest, largest), Image.Resampling.BOX)
    if image.mode.startswith(("I", "F")):
        image = Image.fromarray(_grey8(np.asarray(image)))
    return np.ascontiguousarray(image.convert(mode))


def has_alpha(path: Path) -> bool:
    """Return whether an image file says what is transparent; InputError as :func:`read_image`."""
    found = recall((content(path), "alpha"), lambda: (np.array(_says_alpha(open_image(path))),))
    return bool(found[0])


def _says_alpha(image: Image.Image) -> bool:
    return "A" in image.getbands() or "transparency" in image.info


def open_image(path: Path) -> Image.Image:
    """Open and decode an image; InputError where that fails."""
    try:
        check_plain(path, MOST_BYTES)
        with path.open("rb") as file:
            return decoded_image(file, str(path))
    except FileNotFoundError:
        raise InputError("{path}: no such image file", path=path) from None
    except IsADirectoryError:
        raise InputError("{path}: expected an image file, found a folder", path=path) from None
    except PermissionError as error:
        raise InputError(
            "{path}: cannot be read ({reason})", path=path, reason=reason(error)
        ) from None
    except OSError as error:
        raise InputError(
            "{path}: expected an image such as PNG ({error})", path=path, error=error
        ) from None


def decoded_image(file: BinaryIO, name: str) -> Image.Image:
    """Decode an image from an open file; InputError, beginning with ``name``, where that fails."""
    try:
        with warnings.catch_warnings():
            # Pillow warns about large images, which are allowed, and about damage that it could
            # repair.
            warnings.simplefilter("ignore")
            image: Image.Image = Image.open(file, formats=FORMATS)
            if image.width * image.height > MOST_PIXELS:
                raise Image.DecompressionBombError
            image.load()
            if image.mode == "P":
                image = image.convert("RGBA" if "transparency" in image.info else "RGB")
    except Image.DecompressionBombError:
        most = f"{MOST_PIXELS // 10**6} megapixels"
        raise InputError(
            "{name}: the image is too large; expected at most {most}", name=name, most=most
        ) from None
    except Exception as error:
        # A decoder may raise any kind of exception: all of them mean a damaged file.
        reason = str(error).split(" <_io")[0].split(f" {name!r}")[0] or type(error).__name__
        raise InputError(
            "{name}: expected an image such as PNG ({reason})", name=name, reason=reason
        ) from None

    return image


def _grey8(values: np.ndarray) -> np.ndarray:
    """Scale the 16 bits (or floats in 0..1) of a grey image to bytes."""
    brightest = 1.0 if values.dtype.kind == "f" else 65535.0
    bounded = np.clip(np.nan_to_num(values), 0, brightest)
    return (bounded * (255.0 / brightest) + 0.5).astype(np.uint8)


def read_heights(path: Path) -> np.ndarray:
    """Read the red channel of a height image as float32 (h, w) in 0..255.

    16-bit images keep their precision; palette and alpha images are accepted, very large ones
    reduced. InputError names a file that cannot be read.
    """
    image = open_image(path)
    if max(image.size) > MAX_SIZE:
        image.thumbnail((MAX_SIZE, MAX_SIZE))
    return red_values(image)


def red_values(image: Image.Image) -> np.ndarray:
    """Return the red channel of a decoded image as float32 (h, w) in 0..255.

    16 bits keep their precision; floats are taken as 0..1.
    """
    if image.mode.startswith("I"):
        return np.clip(np.asarray(image, np.float32), 0.0, 65535.0) / np.float32(257.0)
    if image.mode == "F":
        values = np.nan_to_num(np.asarray(image, np.float32))
        return np.clip(values, 0.0, 1.0) * np.float32(255.0)
    return np.asarray(image.convert("RGB"), np.float32)[..., 0]


def half_size(level: np.ndarray) -> np.ndarray:
    """Return a picture (h, w, ...) of even sides at half its size: means of 2 x 2 texels."""
    return np.asarray(
        (level[::2, ::2] + level[1::2, ::2] + level[::2, 1::2] + level[1::2, 1::2]) / 4
    )


def mip_chain(rgba: np.ndarray, levels: int) -> list[np.ndarray]:
    """Return up to ``levels`` mip levels of a sprite, (h, w, 4) uint8 first, alpha coverage kept.

    Colours are averaged weighted by alpha, so that the colour of transparent texels does not leak
    in. Then each level's alpha is scaled until the fraction above one half is that of level 0:
    otherwise distant trees thin out and vanish. Sides must be even down to the last level but one.
    """
    chain = [rgba]
    level = rgba.astype(np.float32) / 255.0
    level[..., :3] *= level[..., 3:]
    covered = float((level[..., 3] > 0.5).mean())
    while len(chain) < levels and min(level.shape[:2]) > 1:
        level = half_size(level)
        alpha = level[..., 3:]
        scale = _coverage_scale(alpha, covered)
        colour = level[..., :3] / np.maximum(alpha, 1e-4)
        fallback = chain[-1][::2, ::2, :3] / np.float32(255.0)
        colour = np.where(alpha > 1e-3, colour, fallback)
        out = np.concatenate([colour, np.clip(alpha * scale, 0, 1)], axis=2)
        chain.append((np.clip(out, 0, 1) * 255 + 0.5).astype(np.uint8))

    return chain


def bled(rgba: np.ndarray, steps: int = 2) -> np.ndarray:
    """Return a sprite, uint8 (h, w, 4), whose colours reach ``steps`` texels beyond its outline.

    There alpha is 0. Where texels are filtered, the colour of transparent ones is mixed in: it
    would be a dark seam around every leaf.
    """
    out = rgba.copy()
    known = np.pad(out[..., 3] > 0, 1)
    colour = np.pad(out[..., :3], ((1, 1), (1, 1), (0, 0))).astype(np.uint16)
    colour *= known[..., None]
    sides = [(slice(0, -2), slice(1, -1)), (slice(2, None), slice(1, -1))]
    sides += [(across, down) for down, across in sides]
    for _ in range(steps):
        count = np.stack([known[side] for side in sides]).sum(axis=0)
        row, column = np.nonzero((count > 0) & ~known[1:-1, 1:-1])
        total = np.stack([colour[side][row, column] for side in sides]).sum(axis=0)
        found = total // count[row, column, None]
        out[row, column, :3] = found
        colour[row + 1, column + 1], known[row + 1, column + 1] = found, True

    return out


def _coverage_scale(alpha: np.ndarray, covered: float) -> float:
    """Return the factor on ``alpha`` that makes the fraction above one half equal ``covered``."""
    # A sprite with hard edges may keep its coverage without scaling, and must stay opaque.
    if abs(float((alpha > 0.5).mean()) - covered) < 1e-3:
        return 1.0
    threshold = float(np.quantile(alpha, 1.0 - covered))
    return float(np.clip(0.5 / max(threshold, 1e-3), 0.75, 2.5))
