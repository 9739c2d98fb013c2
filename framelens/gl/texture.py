"""Textures: a texture object and its mip levels (Texture in 2006)."""

import numpy as np
from PIL import Image

from framelens.gl.features import possible
from framelens.gl.seam import gl


def mean(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the mean of two arrays of bytes, rounded up."""
    return (one | other) - ((one ^ other) >> 1)


def mean_of_texels(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the mean of two arrays of texels of four bytes, uint32, each byte rounded up."""
    halves = one ^ other
    halves >>= np.uint32(1)
    halves &= np.uint32(0x7F7F7F7F)  # what has come from the next byte is no part of this one
    both = one | other
    both -= halves
    return both


def mip_levels(image: np.ndarray) -> list[np.ndarray]:
    """Return an image, uint8 (h, w, c) with powers of two for sides, and its levels down to 1 x 1.

    A texel is the mean of two rows of two texels. Each mean is rounded up, which makes the levels
    the same, byte for byte, as those that llvmpipe makes (GL_GENERATE_MIPMAP, OpenGL 1.4).
    """
    if image.shape[2] == 4:
        return _levels_of_texels(image)
    levels = [image]
    while max(image.shape[:2]) > 1:
        height, width, channels = image.shape
        if width > 1:
            half = np.empty((height, width // 2, channels), np.uint8)
            for k in range(channels):  # numpy is slow at inner loops of three
                half[..., k] = mean(image[:, ::2, k], image[:, 1::2, k])
            image = half
        if height > 1:
            image = mean(image[::2], image[1::2])
        levels.append(image)
    return levels


def _levels_of_texels(image: np.ndarray) -> list[np.ndarray]:
    """Return the same as :func:`mip_levels`, of an image of four channels: the four at once."""
    levels = [image]
    texels = np.ascontiguousarray(image).view(np.uint32)[..., 0]
    while max(texels.shape) > 1:
        if texels.shape[1] > 1:
            texels = mean_of_texels(texels[:, ::2], texels[:, 1::2])
        if texels.shape[0] > 1:
            texels = mean_of_texels(texels[::2], texels[1::2])
        levels.append(texels[..., None].view(np.uint8))
    return levels


def halves_evenly(image: np.ndarray) -> bool:
    """Return whether both sides of an image are powers of two."""
    return all(side & (side - 1) == 0 for side in image.shape[:2])


def at_most(side: int) -> int:
    """Return the greatest power of two that is at most ``side``."""
    return 1 << (side.bit_length() - 1)


def possible_size(image: np.ndarray) -> np.ndarray:
    """Return an image, uint8 (h, w, c), smaller if OpenGL wants powers of two for its sides."""
    if halves_evenly(image) or possible("textures of any size"):
        return image
    size = at_most(image.shape[1]), at_most(image.shape[0])
    channels = (Image.fromarray(channel).resize(size) for channel in np.moveaxis(image, 2, 0))
    return np.stack([np.asarray(channel) for channel in channels], axis=2)


def levels_to_load(image: np.ndarray) -> list[np.ndarray]:
    """Return an image and its mip levels, or the image alone if the driver must make its levels.

    The driver can make them of any image, but in software it compiles a program for that in each
    context, which takes longer than opening the rest of a small scene.
    """
    return mip_levels(image) if halves_evenly(image) else [image]


def edge() -> int:
    """Return how coordinates beyond a texture's border are clamped.

    GL_CLAMP mixes the border's own colour in: a seam, but no texel of the other side.
    """
    return int(gl.GL_CLAMP_TO_EDGE if possible("edges of textures") else gl.GL_CLAMP)


def filter_within_edges() -> None:
    """Let the 2D texture that is bound be filtered linearly, without what is beyond its edges."""
    for name in (gl.GL_TEXTURE_WRAP_S, gl.GL_TEXTURE_WRAP_T):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, name, edge())
    for name in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, name, gl.GL_LINEAR)


def _format(channels: int) -> int:
    """Return the format of an image of 1, 3 or 4 channels."""
    formats = {1: gl.GL_LUMINANCE, 3: gl.GL_RGB, 4: gl.GL_RGBA}
    return int(formats[channels])


class Texture:
    """Owner of one 2D texture object (Texture in 2006)."""

    def __init__(
        self,
        levels: np.ndarray | list[np.ndarray],
        repeat: bool = True,
        trilinear: bool = True,
        lod_bias: float = 0.0,
        mipmaps: bool = True,
        crisp: bool = False,
    ) -> None:
        """Upload an image, uint8 (h, w, 1, 3 or 4), or a list of its mip levels.

        One channel is both colour and alpha (GL_INTENSITY).
        Row 0 of the image is t = 0. ``repeat`` chooses GL_REPEAT or GL_CLAMP_TO_EDGE.
        Without ``trilinear`` only the nearer of two mip levels is sampled, which is a third
        cheaper. Without ``mipmaps`` there are none: in the mip levels of an atlas, neighbouring
        pictures would bleed into each other.
        A ``crisp`` texture is not smoothed within a level: texels are seen one by one, and it is
        cheaper.
        ``lod_bias`` is added to the mip level that OpenGL chooses; below 0 the texture is sharper
        (GL_TEXTURE_LOD_BIAS, OpenGL 1.4).
        """
        images = levels if isinstance(levels, list) else [possible_size(levels)]
        if mipmaps and len(images) == 1:
            images = levels_to_load(images[0])
        if len(images) > 1 and not possible("a number of mip levels"):
            images = [*images[:-1], *mip_levels(images[-1])]  # down to a single texel
        self.name = int(gl.glGenTextures(1))
        wrap = gl.GL_REPEAT if repeat else edge()
        previous = int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D))
        gl.glBindTexture(gl.GL_TEXTURE_2D, self.name)
        minified = gl.GL_LINEAR_MIPMAP_LINEAR if trilinear else gl.GL_LINEAR_MIPMAP_NEAREST
        if crisp:
            minified = gl.GL_NEAREST_MIPMAP_LINEAR
        if not mipmaps:
            minified = gl.GL_NEAREST if crisp else gl.GL_LINEAR
        parameters = {
            gl.GL_TEXTURE_WRAP_S: wrap,
            gl.GL_TEXTURE_WRAP_T: wrap,
            gl.GL_TEXTURE_MAG_FILTER: gl.GL_NEAREST if crisp else gl.GL_LINEAR,
            gl.GL_TEXTURE_MIN_FILTER: minified,
        }
        for name, value in parameters.items():
            gl.glTexParameteri(gl.GL_TEXTURE_2D, name, value)
        if lod_bias and possible("sharper textures"):
            gl.glTexParameterf(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_LOD_BIAS, lod_bias)
        if len(images) > 1 and possible("a number of mip levels"):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAX_LEVEL, len(images) - 1)
        elif len(images) == 1 and mipmaps:
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_GENERATE_MIPMAP, gl.GL_TRUE)

        # By default every row must begin at a multiple of 4 bytes; rows of RGB images may not.
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        for level, image in enumerate(images):
            height, width, channels = image.shape
            form = _format(channels)
            kept = gl.GL_INTENSITY if channels == 1 else form
            gl.glTexImage2D(
                gl.GL_TEXTURE_2D, level, kept, width, height, 0, form, gl.GL_UNSIGNED_BYTE, image
            )

        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 4)
        gl.glBindTexture(gl.GL_TEXTURE_2D, previous)

    def replace(self, image: np.ndarray) -> None:
        """Replace the image of a texture with mip levels by another, of the same shape."""
        previous = int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D))
        self.bind()
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        for level, part in enumerate(levels_to_load(possible_size(image))):
            height, width, channels = part.shape
            kind = _format(channels), gl.GL_UNSIGNED_BYTE
            gl.glTexSubImage2D(gl.GL_TEXTURE_2D, level, 0, 0, width, height, *kind, part)
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 4)
        gl.glBindTexture(gl.GL_TEXTURE_2D, previous)

    def bind(self) -> None:
        """Make this the 2D texture of the active unit."""
        gl.glBindTexture(gl.GL_TEXTURE_2D, self.name)

    def release(self) -> None:
        """Delete the texture object; may be called twice."""
        if self.name:
            gl.glDeleteTextures(np.array([self.name], np.uint32))
            self.name = 0
