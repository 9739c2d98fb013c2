"""Ripples at each pixel: they choose between the mirror image and the water (``water.ripples``).

The sea's grid is too coarse for waves of less than a few cells. Real ripples are little mirrors:
one that leans towards the eye lets it look into the water, and mirrors what is higher; one that
leans away mirrors what is lower. Technique: a texture of slopes, multiplied by a vector in the
vertex colour with GL_DOT3 (OpenGL 1.3), as for bump mapping. The vector is the line of sight, times
how much a slope changes the opacity at this angle of view; its third component adds the opacity of
the level sea. Nearby, two layers of incommensurate sizes are multiplied with each other. Far away,
where the mirror image is strong, the long one is multiplied with itself instead, and the same slope
mixes the mirror image at two places, one higher than the other: so ripples break it up. No pixel
needs both the fine layer and the higher place, so these take turns on one unit. Gusts of
wind scale the vector: there are slicks and rough patches.
The water's own colour comes from a texture of depths, which also shows the bottom where the water
is shallow (shallows.py).
Without a mirror image the water is blended over the framebuffer, which takes the first two units.
State used: four texture units with GL_COMBINE and crossbar (OpenGL 1.4), and the vertex colours.
"""

import numpy as np

from framelens.gl.named import texture_unit
from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, combine
from framelens.gl.texture import Texture, mip_levels
from landscape.elements.best.sea.eye_grid import EyeGrid
from landscape.elements.best.sea.mirror_image import Taken, projected
from landscape.elements.best.sea.ripple_slopes import RANGE, gusts, slope_picture, slopes
from landscape.elements.best.sea.shallows import body_picture, lit_colour
from landscape.elements.best.sea.waves import change_of_opacity, facing, mirror_places, opacity
from landscape.elements.settings import Settings
from landscape.files.cache import recall
from landscape.gl.display_list import DisplayList
from landscape.gl.features import possible

STEEP = 0.25  # chosen: standard deviation of the slopes where water.ripples is 1
MUTED = 0.3  # chosen: by how much a slope of 1 changes the opacity at least
TILES = (0.32, 2.8)  # chosen: tiles of each layer per tile of water.repeat: a long and a fine one
TURNS = np.radians([11.0, 48.0])  # chosen: by which each layer is turned on the map
DRIFTS = ((0.19, 0.10), (0.05, 0.06))  # chosen: units per t along x and z
FINE_LEVELS = (1.0, 0.97, 0.85, 0.6, 0.3, 0.0)  # chosen: the fine layer's contrast by mip level
# Chosen: standard deviations that a texel of each layer holds. The fine one is clipped, which gives
# its waves faces with edges.
HELD = (RANGE, 1.6)
# Chosen: cycles per tile of each layer's longest waves, and how unevenly waves are spread over it.
# The long one is so large that near the eye any single patch of it would be a swirl in the sea.
LONGEST, PATCHES = (6.0, 4.0), (0.05, 0.2)
FINE_CELLS = 0.13  # chosen: units, in larger cells of the grid the fine layer is flat
LEAST = 0.45  # chosen: share of the higher place of the mirror image at a grazing angle
APART = 0.02  # chosen: slope between the mirror image's two places, and the level sea
STIRRED = 0.33  # chosen: contrast of the ripples in the calmest cove
CLOSER = 0.1  # chosen: fraction of that on calm water, which shows no image twice
SLICK, GUST = 0.7, 1.3  # chosen: contrast of the ripples in a slick and in a gust
FAR_SLICK = 0.2  # chosen: and in a slick far away, where the sea would look even
OPEN_SEA = 9.0  # units of depth where the bottom is not to be seen
LONG, FINE = range(2)  # layers
# Texture units: the long layer, the water's own colour, the higher place of the mirror image or the
# fine layer, the lower place of the mirror image.
FIRST, BODY, SHARED, LAST = range(4)

Waves = tuple[np.ndarray, ...]
"""Slopes along x and z of the grid's waves, and those that move the mirror image."""


def turned(layer: int) -> np.ndarray:
    """Return the matrix (2, 2) from directions x, z on the map to those of a layer: rows @ it."""
    east, south = np.cos(TURNS[layer]), np.sin(TURNS[layer])
    return np.array([(east, -south), (south, east)], np.float32)


def picture(layer: int) -> np.ndarray:
    """Return a layer's slopes along x and z of the map, uint8 (n, n, 3), or those in the cache."""

    def make() -> tuple[np.ndarray]:
        tile = slopes(layer + 1, longest=LONGEST[layer], patches=PATCHES[layer])
        return (slope_picture(tile @ turned(layer).T, HELD[layer]),)

    return recall(["ripples", str(layer)], make)[0]


def fading(image: np.ndarray) -> list[np.ndarray]:
    """Return the mip levels of a layer, uint8 (n, n, 3), that is flat where it is not drawn."""
    levels = mip_levels(image)
    for k, level in enumerate(levels):
        contrast = FINE_LEVELS[min(k, len(FINE_LEVELS) - 1)]
        level[..., :2] = np.rint(127.5 + contrast * (level[..., :2] - 127.5))
    return levels


def coordinates(places: np.ndarray, t: float, layer: int, repeat: float) -> np.ndarray:
    """Return a layer's texture coordinates, float32 (n, 2), of places x, z (n, 2) in units.

    ``repeat`` is that of the water's plain texture, in tiles per unit.
    """
    tiles = TILES[layer] * repeat
    # Reduced to one tile: float32 has too few digits for a large t.
    drift = tiles * (np.array(DRIFTS[layer]) @ turned(layer)) * t % 1.0
    return np.ascontiguousarray(
        places @ (np.float32(tiles) * turned(layer)) - drift.astype(np.float32)
    )


def near_rows(grid: EyeGrid) -> int:
    """Return how many of the grid's strips, from the far end, do without the fine layer."""
    return min(int((grid.cell > FINE_CELLS).sum()), len(grid.ring) - 1)


def sights(
    grid: EyeGrid, level: np.ndarray, change: np.ndarray, blended: bool = False
) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertex colours, float32 (n, 4) each, for one layer and for two.

    ``level`` (rows, columns) is the opacity of the sea without ripples, ``change`` by how much the
    steepest slope in the texture changes it. The sea's opacity is a product of two: of the layer
    by itself, or of both layers; and of alpha, which makes up for the least that a layer may be.
    If the sea is ``blended`` over the framebuffer, it is that of one layer and alpha.
    """
    root = np.maximum(np.sqrt(level), np.float32(LEAST))
    share = level / (root if blended else np.square(root))
    gain = 0.5 * change / (share if blended else root * share)
    out = np.empty((2, *level.shape, 4), np.float32)
    for colours, part in zip(out, (1.0 if blended else 0.5, 1.0), strict=True):
        limited = np.minimum(part * gain, 0.5)
        colours[..., 0] = 0.5 + limited * grid.east
        colours[..., 1] = 0.5 + limited * grid.south

    out[..., 2] = 0.5 + 0.5 * root
    out[..., 3] = share
    one, two = out.reshape(2, -1, 4)
    return one, two


def built_from(settings: Settings) -> tuple[object, ...]:
    """Return the values that the constructor uses."""
    water = settings.water
    return water.trilinear, water.lod_bias, water.shallow, *lit_colour(settings)


class Ripples:
    """The rippled surface; Sea draws it with its own grid."""

    def __init__(self, settings: Settings, depths: np.ndarray, size: float) -> None:
        """Upload the layers, and the colours at ``depths`` (n, n) of a map of ``size`` units."""
        water = settings.water
        filters = True, water.trilinear, water.lod_bias
        self._size = size
        self._layers = [
            Texture(levels, *filters) for levels in (picture(LONG), fading(picture(FINE)))
        ]
        seen = depths if water.shallow else np.full((2, 2), OPEN_SEA)
        self._body = Texture(body_picture(seen, lit_colour(settings)), repeat=False)
        sets = [self._set_layers, self._set_blended]
        if possible("water.ripples in one pass"):
            sets += [self._set_mirror, self._set_near]
        self._lists = [DisplayList(each) for each in sets]

    def draw(
        self,
        settings: Settings,
        grid: EyeGrid,
        vertices: np.ndarray,
        slopes: Waves,
        sheltered: np.ndarray,
        t: float,
        mirror: Taken | None,
    ) -> None:
        """Draw the grid with these vertices (n, 3) and waves, mixed with the mirror image.

        ``sheltered`` (rows, columns) is what shelter leaves of the ripples; in the waves it is
        contained. Without a mirror image the sea is blended over the framebuffer.
        """
        water, shape = settings.water, grid.x.shape
        slope_x, slope_z, move_x, move_z = slopes
        places = np.ascontiguousarray(vertices[:, ::2])
        # Where the fine layer begins there is only one mirror image left.
        begun = np.clip(2.0 * (grid.cell / FINE_CELLS - 1.0), 0.0, 1.0).astype(np.float32)
        slick = (SLICK + (FAR_SLICK - SLICK) * begun)[:, None]
        gusty = slick + (GUST - slick) * gusts(grid.x, grid.z, t)
        rough = gusty * np.maximum(sheltered, np.float32(STIRRED))
        level, change = np.full(shape, water.color[3], np.float32), np.zeros(shape, np.float32)
        if water.fresnel:
            cosine = facing(grid, slope_x, slope_z, rough)
            level = opacity(cosine, water.color[3])
            change = change_of_opacity(grid, cosine, water.color[3])

        change = (change + np.float32(MUTED)) * rough * np.float32(STEEP * RANGE * water.ripples)
        one, two = sights(grid, level, change, mirror is None)
        repeat = water.repeat / water.patch
        long, fine = (coordinates(places, t, layer, repeat) for layer in (LONG, FINE))
        layers = [long, places / np.float32(self._size)]
        far = near_rows(grid) * 2 * (shape[1] - 1)
        if mirror is not None:
            apart = (CLOSER + (1.0 - CLOSER) * rough) * (APART * begun)[:, None]
            y = vertices[:, 1].reshape(shape)
            layers += [
                mirror_places(grid, y, move_x * gusty, move_z * gusty, tilt.astype(np.float32))
                for tilt in (apart, -apart)
            ]

        with (
            attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_LIGHTING_BIT),
            client_arrays(vertices, None, one, layers),
        ):
            if not settings.shading.smooth:
                gl.glShadeModel(gl.GL_FLAT)
            self._lists[0].call()
            if mirror is None:
                self._lists[1].call()
                self._send(grid.triangles)
                return
            with projected(mirror, LAST):
                with projected(mirror, SHARED):
                    self._lists[-2].call()
                    self._send(grid.triangles[:far])
                self._lists[-1].call()
                gl.glClientActiveTexture(texture_unit(SHARED))
                gl.glTexCoordPointer(2, gl.GL_FLOAT, 0, fine)
                gl.glColorPointer(4, gl.GL_FLOAT, 0, two)
                self._send(grid.triangles[far:])

    @staticmethod
    def _send(triangles: np.ndarray) -> None:
        gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)

    def _set_layers(self) -> None:
        """Bind the first two textures; let the long layer's product be colour and alpha."""
        for unit, texture in ((BODY, self._body), (FIRST, self._layers[LONG])):
            gl.glActiveTexture(texture_unit(unit))
            texture.bind()
            gl.glEnable(gl.GL_TEXTURE_2D)
        combine({"COMBINE_RGB": "DOT3_RGBA", "SRC0_RGB": "PRIMARY_COLOR", "SRC1_RGB": "TEXTURE"})

    @staticmethod
    def _set_mirror() -> None:
        """Mix far water: its own colour and the image, by colour; then with the other, by alpha."""
        mix = {"COMBINE_RGB": "INTERPOLATE", "SRC1_RGB": "TEXTURE", "SRC2_RGB": "PREVIOUS"}
        alpha = {"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"}
        gl.glActiveTexture(texture_unit(BODY))
        combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "PRIMARY_COLOR"})
        combine({"OPERAND1_RGB": "SRC_ALPHA", **alpha})
        gl.glActiveTexture(texture_unit(SHARED))
        combine({**mix, "SRC0_RGB": f"TEXTURE{BODY}", "OPERAND2_RGB": "SRC_COLOR", **alpha})
        gl.glActiveTexture(texture_unit(LAST))
        combine({**mix, "SRC0_RGB": "PREVIOUS", "OPERAND2_RGB": "SRC_ALPHA"})
        combine({"COMBINE_ALPHA": "INTERPOLATE", "SRC0_ALPHA": f"TEXTURE{BODY}"})
        combine({"SRC1_ALPHA": "CONSTANT", "SRC2_ALPHA": "PREVIOUS"})
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, np.ones(4, np.float32))

    def _set_near(self) -> None:
        """Multiply near water's layers, and mix its own colour with one mirror image alone."""
        gl.glActiveTexture(texture_unit(BODY))
        combine({"COMBINE_RGB": "DOT3_RGB", "SRC0_RGB": "PRIMARY_COLOR"})
        combine({"SRC1_RGB": f"TEXTURE{SHARED}", "OPERAND1_RGB": "SRC_COLOR"})
        gl.glActiveTexture(texture_unit(SHARED))
        self._layers[FINE].bind()
        combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "PREVIOUS"})
        combine({"OPERAND1_RGB": "SRC_ALPHA"})
        combine({"COMBINE_ALPHA": "MODULATE", "SRC0_ALPHA": "PREVIOUS", "SRC1_ALPHA": "PREVIOUS"})
        gl.glActiveTexture(texture_unit(LAST))
        combine({"SRC0_RGB": f"TEXTURE{BODY}", "OPERAND2_RGB": "SRC_COLOR"})

    @staticmethod
    def _set_blended() -> None:
        """Let the colour be the water's own, and alpha the opacity."""
        gl.glActiveTexture(texture_unit(BODY))
        combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "TEXTURE"})
        combine({"COMBINE_ALPHA": "MODULATE", "SRC0_ALPHA": "PREVIOUS"})
        combine({"SRC1_ALPHA": "PRIMARY_COLOR"})

    def release(self) -> None:
        """Delete lists and textures; may be called twice."""
        for owned in self._lists:
            owned.release()
        for texture in (*self._layers, self._body):
            texture.release()
