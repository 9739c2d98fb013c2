"""Shallow water: a texture of the sea's depth, and a floor below deep water (``water.shallow``).

Technique: a texture over the whole map holds, for the depth there, a tint for the water's colour
and, in alpha, how much of the bottom the water hides. The ground is then cut not at the water but
SEEN below it. Where it is cut, a plane closes the sea; otherwise the background would show at steep
coasts. With ``water.ripples`` the texture holds the sea's own colour instead of a tint: sand that
shows through, green, dark blue (drawn in ripples.py).
State used: texture unit 1 with GL_COMBINE (OpenGL 1.3).
"""

import numpy as np

from framelens.gl.named import texture_unit
from framelens.gl.seam import gl
from framelens.gl.state import attrib, combine
from framelens.gl.texture import Texture
from landscape.elements.settings import Settings, Sun
from landscape.elements.sun import direction, painted
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField
from landscape.gl.draw import level_square

SEEN = 0.45  # chosen: units of depth below which no bottom shows through the water
# Chosen: the sea by depth in units: how much of the bottom it hides, and its colour as factors of
# the colour of the deep sea: sand shows through at first, then it is green, then dark blue.
DEPTHS = (0.0, 0.015, 0.05, 0.12, 0.25, 0.43)
HIDING = (0.0, 0.18, 0.44, 0.74, 0.95, 1.0)
COLOURS = np.array(
    [
        (4.6, 3.0, 2.2),
        (4.2, 2.9, 2.2),
        (3.0, 2.4, 1.95),
        (1.4, 1.5, 1.38),
        (1.05, 1.16, 1.14),
        (0.85, 0.97, 1.0),
    ]
)
CLEAR = 0.085  # chosen: units of depth that hide two thirds of the bottom
GREENER = np.array([1.35, 1.6, 1.35])  # chosen: times the water's colour where it is shallow
FLOOR = (0.26, 0.30, 0.25)  # chosen: RGB of the sea floor; the ground has it where it is cut
TEXELS = 512  # chosen: depths per side of the map


def cut_level(settings: Settings) -> float:
    """Return the height below which no ground is drawn: the water's, or the lowest visible one.

    A mirror image in the framebuffer needs the ground cut at the water; one in a texture does not.
    """
    straight = settings.reflection.enabled and not settings.reflection.rippled
    return settings.water.level - (SEEN if settings.water.shallow and not straight else 0.0)


def submerged(frame: Frame, settings: Settings) -> bool:
    """Return whether a frame is seen from below the water, and is to show that (under_water.py)."""
    return settings.water.under and frame.eye_y < settings.water.level


def sea_depths(field: HeightField) -> np.ndarray:
    """Return the depth of the sea over the map, (TEXELS, TEXELS) in units, row along z."""
    at = (np.arange(TEXELS) + 0.5) / TEXELS * field.size
    return field.water_level - field.terrain_height(at[None, :], at[:, None])


def depth_picture(depths: np.ndarray) -> np.ndarray:
    """Return depths (n, n) in units as a texture, uint8 (n, n, 4).

    Alpha is how much of the bottom the water hides. The colour is half of the factor that
    multiplies the water's own: GREENER at the edge, 1 in the deep. The border is opaque: it is
    clamped, and beyond it is the open sea.
    """
    depth = np.maximum(depths, 0.0)
    hidden = 1.0 - np.exp(-depth / CLEAR)
    hidden[[0, -1], :] = hidden[:, [0, -1]] = 1.0
    tint = 1.0 + (GREENER - 1.0) * np.exp(-depth / (3 * CLEAR))[..., None]
    picture = np.concatenate([np.clip(tint / 2, 0, 1), hidden[..., None]], axis=2)
    return np.ascontiguousarray(picture * 255 + 0.5, np.uint8)


def hidden_bottom(depths: np.ndarray) -> np.ndarray:
    """Return how much of the bottom the water hides at depths (n, n) in units, 0..1.

    The border is opaque, as in :func:`depth_picture`.
    """
    hidden = np.interp(np.maximum(depths, 0.0), DEPTHS, HIDING)
    hidden[[0, -1], :] = hidden[:, [0, -1]] = 1.0
    return hidden


def body_picture(depths: np.ndarray, colour: np.ndarray) -> np.ndarray:
    """Return the sea's own colour by depths (n, n) in units as a texture, uint8 (n, n, 4).

    ``colour`` (3,) is that of the deep sea in the light. Alpha is how much of the bottom the water
    hides.
    """
    depth = np.maximum(depths, 0.0)
    tint = np.stack([np.interp(depth, DEPTHS, COLOURS[:, k]) for k in range(3)], axis=2)
    picture = np.concatenate([tint * colour, hidden_bottom(depths)[..., None]], axis=2)
    return np.ascontiguousarray(np.clip(picture, 0.0, 1.0) * 255 + 0.5, np.uint8)


def lit_colour(settings: Settings) -> np.ndarray:
    """Return the colour of the level sea in the light, RGB (3,), as OpenGL would light it."""
    colour = np.array(settings.water.color[:3])
    if not settings.shading.lighting:
        return colour
    sun = settings.sun
    light = np.array(sun.ambient) + direction(sun)[1] * np.array(sun.diffuse)
    return np.asarray(np.minimum(colour * light, 1.0))


def draw_floor(level: float, size: float, sun: Sun) -> None:
    """Draw the plane that closes the sea at ``level``, where the ground is cut.

    It is as large as the map, ``size`` units. Without fog: that is computed at the vertices, and
    the square's corners are far away.
    """
    groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_COLOR_BUFFER_BIT
    with attrib(groups):
        for cap in (gl.GL_BLEND, gl.GL_LIGHTING, gl.GL_TEXTURE_2D, gl.GL_FOG):
            gl.glDisable(cap)
        gl.glColor3f(*(painted(sun, direction(sun)[1]) * FLOOR))
        level_square(0.0, size, level)


class Shallows:
    """Owner of the texture of depths, for the sea without ripples."""

    def __init__(self, depths: np.ndarray, size: float) -> None:
        """Upload ``depths`` (n, n) of a map of ``size`` units per side."""
        self._size = size
        self._texture = Texture(depth_picture(depths), repeat=False)

    def coordinates(self, places: np.ndarray) -> np.ndarray:
        """Return texture coordinates (n, 2) of places x, z (n, 2) in units."""
        return places / np.float32(self._size)

    def set_unit(self, unit: int) -> None:
        """Let a unit multiply by twice the tint; its alpha is for the next, the mirror image's."""
        gl.glActiveTexture(texture_unit(unit))
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._texture.bind()
        combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE"})
        combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"})
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 2.0)

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()
