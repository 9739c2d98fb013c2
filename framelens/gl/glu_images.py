"""GLU's mipmaps and scaled images in Python, averaged over areas as GLU does it.

Images are given as for glTexImage2D: bytes or an array, rows from below, laid out as the pixel
store modes say. Types that pack a pixel into one number are not read: for them OpenGL makes the
mipmaps.
"""

from collections.abc import Mapping
from typing import Any, TypeVar

import numpy as np
import OpenGL.GL as GL

T = TypeVar("T")
COMPONENTS = {
    **dict.fromkeys(("COLOR_INDEX", "RED", "GREEN", "BLUE", "ALPHA", "LUMINANCE"), 1),
    **dict.fromkeys(("STENCIL_INDEX", "DEPTH_COMPONENT"), 1),
    **{"LUMINANCE_ALPHA": 2, "RGB": 3, "BGR": 3, "RGBA": 4, "BGRA": 4},
}
TYPES: dict[str, type[np.generic]] = {
    **{"UNSIGNED_BYTE": np.uint8, "BYTE": np.int8, "UNSIGNED_SHORT": np.uint16},
    **{"SHORT": np.int16, "UNSIGNED_INT": np.uint32, "INT": np.int32, "FLOAT": np.float32},
}
UNPACK = ("ALIGNMENT", "ROW_LENGTH", "SKIP_ROWS", "SKIP_PIXELS")


def gluBuild2DMipmaps(
    target: int, internal: int, width: int, height: int, format: int, type: int, data: object
) -> int:
    """Give a texture all its levels; its sides become powers of two. Returns 0."""
    if not _readable(format, type):
        GL.glTexParameteri(target, GL.GL_GENERATE_MIPMAP, GL.GL_TRUE)
        GL.glTexImage2D(target, 0, internal, width, height, 0, format, type, data)
        return 0

    image = _read(width, height, format, type, data)
    image = scaled(image, _fitting(width), _fitting(height))
    GL.glPushClientAttrib(GL.GL_CLIENT_PIXEL_STORE_BIT)
    _tightly("UNPACK")
    level = 0
    while True:
        rows, columns = image.shape[:2]
        GL.glTexImage2D(target, level, internal, columns, rows, 0, format, type, image)
        if rows == columns == 1:
            break
        image, level = halved(image), level + 1

    GL.glPopClientAttrib()
    return 0


def gluBuild1DMipmaps(
    target: int, internal: int, width: int, format: int, type: int, data: object
) -> int:
    """Give a one-dimensional texture all its levels; its width becomes a power of two."""
    if not _readable(format, type):
        GL.glTexParameteri(target, GL.GL_GENERATE_MIPMAP, GL.GL_TRUE)
        GL.glTexImage1D(target, 0, internal, width, 0, format, type, data)
        return 0

    image = scaled(_read(width, 1, format, type, data), _fitting(width), 1)
    GL.glPushClientAttrib(GL.GL_CLIENT_PIXEL_STORE_BIT)
    _tightly("UNPACK")
    level = 0
    while True:
        columns = image.shape[1]
        GL.glTexImage1D(target, level, internal, columns, 0, format, type, image[0])
        if columns == 1:
            break
        image, level = halved(image), level + 1

    GL.glPopClientAttrib()
    return 0


def gluScaleImage(
    format: int,
    width: int,
    height: int,
    type: int,
    data: object,
    new_width: int,
    new_height: int,
    new_type: int,
    into: Any,
) -> int:
    """Write an image in another size to ``into``, without gaps between its rows. Returns 0."""
    image = scaled(_read(width, height, format, type, data), new_width, new_height, True)
    image = np.ascontiguousarray(image.astype(_dtype(new_type)))
    if isinstance(into, np.ndarray):
        into.reshape(-1).view(np.uint8)[: image.nbytes] = image.reshape(-1).view(np.uint8)
    else:
        memoryview(into).cast("B")[: image.nbytes] = image.tobytes()
    return 0


def halved(image: np.ndarray) -> np.ndarray:
    """Return an image, (rows, columns, components), at half its size: means of 2 x 2 pixels."""
    steps = [2 if side > 1 else 1 for side in image.shape[:2]]
    parts = [image[y :: steps[0], x :: steps[1]] for y in range(steps[0]) for x in range(steps[1])]
    if image.dtype == np.float32:
        return np.asarray(np.mean(parts, axis=0, dtype=np.float32))
    total = np.sum(parts, axis=0, dtype=np.int64)
    half = 2 if len(parts) == 4 else 0  # GLU rounds the means of four, and cuts those of two
    return ((total + half) // len(parts)).astype(image.dtype)


def scaled(image: np.ndarray, width: int, height: int, smooth: bool = False) -> np.ndarray:
    """Return an image in another size; each pixel is the mean of the area that it covers.

    Where an image grows, ``smooth`` takes areas as large as an old pixel: gluScaleImage does, and
    the mipmaps do not.
    """
    rows, columns = image.shape[:2]
    if (columns, rows) == (width, height):
        return image
    by_rows, by_columns = _coverage(rows, height, smooth), _coverage(columns, width, smooth)
    result = np.einsum("yr,rck,xc->yxk", by_rows, image.astype(np.float64), by_columns)
    if image.dtype != np.float32:
        area = max(rows / height, 1.0) * max(columns / width, 1.0)
        kind = np.iinfo(image.dtype)
        result = np.clip(np.floor(result + 0.5 / area), kind.min, kind.max)
    return result.astype(image.dtype)


def _coverage(old: int, new: int, smooth: bool) -> np.ndarray:
    """Return the part that each of ``old`` pixels has in each of ``new`` ones: (new, old).

    Beyond the edge, the other side continues, as in a texture that repeats.
    """
    step = old / new
    side = max(step, 1.0) if smooth else step
    centres = (np.arange(new) + 0.5)[:, None] * step
    parts = np.zeros((new, old))
    for shift in (-old, 0, old):
        at = np.arange(old)[None] + shift
        shared = np.minimum(centres + side / 2, at + 1) - np.maximum(centres - side / 2, at)
        parts += np.clip(shared, 0.0, None)
    return parts / side


def _fitting(side: int) -> int:
    """Return the power of two that GLU takes for a side: the nearest, 3 being nearer to 4."""
    power = 1
    while side not in (1, 3):
        side, power = side // 2, power * 2
    return min(power * (4 if side == 3 else 1), int(GL.glGetIntegerv(GL.GL_MAX_TEXTURE_SIZE)))


def _names(table: Mapping[str, T]) -> dict[int, T]:
    return {int(getattr(GL, f"GL_{name}")): value for name, value in table.items()}


def _readable(format: int, type: int) -> bool:
    return format in _names(COMPONENTS) and type in _names(TYPES)


def _dtype(type: int) -> np.dtype:
    try:
        return np.dtype(_names(TYPES)[type])
    except KeyError:
        raise ValueError(f"gluScaleImage: pixels of type {type} cannot be read") from None


def _read(width: int, height: int, format: int, type: int, data: Any) -> np.ndarray:
    """Return the image that the pixel store modes describe: (height, width, components)."""
    dtype, components = _dtype(type), _names(COMPONENTS)[format]
    alignment, length, rows, pixels = (
        int(GL.glGetIntegerv(getattr(GL, f"GL_UNPACK_{name}"))) for name in UNPACK
    )
    if isinstance(data, (list, tuple)):
        data = np.array(data, dtype)
    given = np.frombuffer(np.ascontiguousarray(data) if hasattr(data, "shape") else data, np.uint8)
    stride = -(-(length or width) * components * dtype.itemsize // alignment) * alignment
    row = width * components * dtype.itemsize
    start = rows * stride + pixels * components * dtype.itemsize
    lines = [given[start + y * stride :][:row] for y in range(height)]
    if height and len(lines[-1]) < row:
        raise ValueError(f"{len(given)} bytes are too few for an image of {width} x {height}")
    return np.stack(lines).view(dtype).reshape(height, width, components)


def _tightly(way: str) -> None:
    """Let images have no gaps."""
    for name in UNPACK:
        GL.glPixelStorei(getattr(GL, f"GL_{way}_{name}"), 1 if name == "ALIGNMENT" else 0)
