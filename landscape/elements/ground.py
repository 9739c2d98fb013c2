"""The ground: a height field from a grey image (Ground, section 2).

Techniques: the image is resampled to a grid of vertices; vertex arrays are drawn by one
glDrawElements, compiled once into a display list; two textures by multitexturing, unit 0 the
large-scale colour, unit 1 a detail repeated many times; a clip plane cuts the ground at the water
level. Height queries are bilinear over the same grid (geometry/height_field.py).
``ground.passes`` shows the alternative of section 2.2.2: a second pass blended over the first one,
which sends the geometry twice. ``ground.lit`` shows what the normals are for.
State used: texture units 0 and 1, GL_COMBINE in unit 1 (OpenGL 1.3), GL_CLIP_PLANE0; with the
switches GL_BLEND, the depth test, the fog's colour, GL_LIGHTING.
What is wrong with it: edges between coarse triangles (switch ``ground.smooth``, R14); the walker
stands a little above or below them (``ground.exact_height``, R15); one detail texture on grass,
sand and rock (``ground.materials``). The ground of the preset ``best`` is best/terrain/terrain.py.
"""

from collections.abc import Hashable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from typing import Self

import numpy as np
from PIL import Image

from framelens.gl.seam import drawing, drawn_now, gl
from framelens.gl.state import attrib, use_unit
from framelens.gl.texture import Texture
from landscape.elements.element import Element, Site
from landscape.elements.settings import Ground as GroundSettings
from landscape.elements.settings import Settings
from landscape.elements.sun import direction, lit
from landscape.files.assets import Assets
from landscape.files.images import read_heights, read_image
from landscape.frame import Frame
from landscape.geometry.height_colours import colour_by_height
from landscape.geometry.height_field import (
    HeightField,
    ground_mesh,
    height_field,
    laid_over,
    lookup,
)
from landscape.geometry.mesh import Mesh
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.features import possible

HEIGHTS = (
    *("height_image", "resolution", "size", "scale_x", "scale_y", "scale_z"),
    *("smooth", "subdivide", "exact_height"),
)
Layer = tuple[Texture, float]
"""A texture, and how often it is repeated over the map."""
TEXTURES = ("large_texture", "detail_texture", "detail_repeat", "units", "texture_size", "passes")


@contextmanager
def clipped(level: float, enabled: bool = True) -> Iterator[None]:
    """Keep only what is above the water: the plane y - level = 0 (section 2.1.2)."""
    if not enabled:
        yield
        return
    outside = drawn_now()
    with drawing("ground"), attrib(gl.GL_TRANSFORM_BIT | gl.GL_ENABLE_BIT):
        gl.glClipPlane(gl.GL_CLIP_PLANE0, np.array([0.0, 1.0, 0.0, -level], np.float64))
        gl.glEnable(gl.GL_CLIP_PLANE0)
        with drawing(*outside):
            yield


SHIPPED_HEIGHTS = (GroundSettings().height_image, "height16.png")  # the same island, 8 and 16 bits


def has_no_colours(ground: GroundSettings) -> bool:
    """Return whether the height image is a user's own and comes without a large texture."""
    own_island = ground.height_image not in SHIPPED_HEIGHTS
    return own_island and ground.large_texture == GroundSettings().large_texture


def large_texture(
    settings: Settings, assets: Assets, field: HeightField, sun: np.ndarray
) -> np.ndarray:
    """Return the large-scale colours, uint8 (n, n, 3): the file's, or colours by height."""
    if has_no_colours(settings.ground):
        return colour_by_height(field, sun)
    path = assets.path(settings.ground.large_texture, "ground.large_texture")
    whole = read_image(path, "RGB", settings.ground.texture_size)
    image = laid_over(whole, settings.ground)
    if image is not whole:
        image = np.array(Image.fromarray(image).resize(whole.shape[1::-1], Image.Resampling.BOX))
    # It is stretched over the whole map, which is square, as the maps made from it are.
    height, width = image.shape[:2]
    if height == width:
        return image
    side = (max(height, width),) * 2
    return np.array(Image.fromarray(image).resize(side, Image.Resampling.BILINEAR))


def chosen(both: list[Layer], units: str, passes: str = "one") -> list[Layer]:
    """Return those of the large and the detail texture that ``ground.units`` asks for.

    With a single texture unit, or without GL_COMBINE, the detail is left out, unless it has a pass
    of its own.
    """
    if units == "both" and passes == "one" and not possible("ground.detail_texture"):
        units = "large"
    return {"both": both, "large": both[:1], "detail": both[1:], "none": []}[units]


def lay_units(layers: list[Texture]) -> None:
    """Set unit 0 to the first layer, and each further unit to multiply by twice its layer.

    Twice, so that mid grey in the detail leaves the large-scale colour as it is.
    """
    for unit, layer in enumerate(layers):
        use_unit(unit)
        layer.bind()
        gl.glEnable(gl.GL_TEXTURE_2D)
        if unit == 0:
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
        else:
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_COMBINE)
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_COMBINE_RGB, gl.GL_MODULATE)
            gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 2.0)


def leave_units(layers: list[Texture]) -> None:
    """Undo :func:`lay_units`."""
    for unit in reversed(range(len(layers))):
        use_unit(unit)
        if unit > 0:
            gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 1.0)
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
        gl.glDisable(gl.GL_TEXTURE_2D)


@contextmanager
def blended_over() -> Iterator[None]:
    """Multiply what is drawn inside, a second time, by twice the colours of the first time.

    GL_DST_COLOR, GL_SRC_COLOR adds source times destination and destination times source: the same
    product as that of :func:`lay_units`. Only where the depth is equal: what is in front of the
    ground stays as it is. Fog leaves mid grey, which changes nothing.
    """
    groups = gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_ENABLE_BIT
    with attrib(groups | gl.GL_FOG_BIT | gl.GL_CURRENT_BIT):
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_DST_COLOR, gl.GL_SRC_COLOR)
        gl.glDepthFunc(gl.GL_EQUAL)
        gl.glDepthMask(gl.GL_FALSE)
        gl.glDisable(gl.GL_LIGHTING)
        gl.glFogfv(gl.GL_FOG_COLOR, np.array([0.5, 0.5, 0.5, 1.0], np.float32))
        gl.glColor3f(1.0, 1.0, 1.0)
        yield


class Ground(Element[Settings]):
    """The ground, and queries for its height and colour."""

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build it in the light of the sun."""
        return cls(site.settings, site.assets, direction(site.settings.sun))

    def __init__(self, settings: Settings, assets: Assets, sun: np.ndarray) -> None:
        """Read heights and colours and compile the display list; ``sun`` (3,) points to it."""
        ground = settings.ground
        path = assets.path(ground.height_image, "ground.height_image")
        self.field = height_field(read_heights(path), ground, settings.water.level)
        self.large = large_texture(settings, assets, self.field, sun)
        self.settings = settings
        self._textures: list[Texture] = []
        self._lists: list[DisplayList] = []
        self._build(ground, assets)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that heights, textures and list were made from."""
        ground, sun = settings.ground, settings.sun
        shaded = (sun.azimuth, sun.elevation) if has_no_colours(ground) else None
        used = (getattr(ground, name) for name in (*HEIGHTS, *TEXTURES))
        return *used, settings.water.level, shaded

    def _build(self, ground: GroundSettings, assets: Assets) -> None:
        """Compile the mesh and its two texture units."""
        both = [(self._texture(self.large, repeat=False), 1.0)]
        both.append((self._detail(assets, "detail_texture"), ground.detail_repeat))
        layers = chosen(both, ground.units, ground.passes)
        mesh = ground_mesh(self.field, tuple(repeat for _, repeat in layers))
        textures = [texture for texture, _ in layers]

        def send(textures: list[Texture], mesh: Mesh) -> None:
            lay_units(textures)
            draw_mesh(mesh)
            leave_units(textures)

        def send_twice() -> None:
            large, detail = (replace(mesh, coordinates=(each,)) for each in mesh.coordinates)
            send(textures[:1], large)
            with blended_over():
                send(textures[1:], detail)

        two = ground.passes == "two" and len(layers) == 2
        self._lists.append(DisplayList(send_twice if two else partial(send, textures, mesh)))

    def _texture(self, image: np.ndarray, repeat: bool = True) -> Texture:
        """Make a texture that is released with the ground."""
        self._textures.append(Texture(image, repeat))
        return self._textures[-1]

    def _detail(self, assets: Assets, key: str) -> Texture:
        """Read the texture that the setting ``ground.<key>`` names."""
        ground = self.settings.ground
        path = assets.path(getattr(ground, key), f"ground.{key}")
        return self._texture(read_image(path, largest=ground.texture_size))

    def draw(self, frame: Frame) -> None:
        """Call the list, in the colour of the light, or lit by it."""
        settings = self.settings
        with attrib(gl.GL_CURRENT_BIT | gl.GL_ENABLE_BIT | gl.GL_LIGHTING_BIT):
            gl.glColor3f(*settings.sun.tint)
            if settings.ground.lit:
                lit(settings.shading)
            self._lists[0].call()

    @property
    def size(self) -> float:
        """The side of the map in units."""
        return self.field.size

    def height(self, x: np.ndarray | float, z: np.ndarray | float) -> np.ndarray:
        """Return the height to stand on at x, z in units, never below the water."""
        return self.field.height(x, z)

    def terrain_height(self, x: np.ndarray | float, z: np.ndarray | float) -> np.ndarray:
        """Return the terrain's height at x, z in units, the sea floor included."""
        return self.field.terrain_height(x, z)

    def colour(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return the large-scale colour at x, z in units, float (n, 3) in 0..1."""
        return lookup(self.large, np.asarray(x) / self.size, np.asarray(z) / self.size) / 255.0

    def drawn_colour(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return the colour that is seen at x, z in units; of this ground the same, (n, 3)."""
        return self.colour(x, z)

    def light(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return the light that reaches x, z in units, a factor (n, 3) on colours."""
        return np.ones((*np.shape(x), 3)) * self.settings.sun.tint

    def release(self) -> None:
        """Delete the lists and the textures; may be called twice."""
        for compiled in self._lists:
            compiled.release()
        for texture in self._textures:
            texture.release()
