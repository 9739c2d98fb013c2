"""The ground: a height field from a grey image (Ground, section 2).

Techniques: vertex arrays drawn by one glDrawElements, compiled once into a display list; two
textures by multitexturing (unit 0 the large-scale colour, unit 1 a detail repeated many times); a
clip plane that cuts the ground at the water level.
State used: texture units 0 to 2, GL_CLIP_PLANE0.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from landscape.assets import Assets
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.mesh_tool import Mesh, grid_triangles, vertex_normals
from landscape.gl.state import attrib
from landscape.gl.texture import MAX_SIZE, Texture, open_image, read_image
from landscape.settings import Ground as GroundSettings
from landscape.settings import Settings

ELEMENT = "ground"


def read_heights(path: Path) -> np.ndarray:
    """Read a height image's red channel as float32 (h, w) in 0..255; 16-bit images keep their bits.

    Palette, alpha and 16-bit images are taken; very large ones are reduced. InputError names a
    file that cannot be read.
    """
    image = open_image(path)
    if max(image.size) > MAX_SIZE:
        image.thumbnail((MAX_SIZE, MAX_SIZE))
    if image.mode.startswith("I"):
        return np.clip(np.asarray(image, np.float32), 0.0, 65535.0) / np.float32(257.0)
    if image.mode == "F":
        values = np.nan_to_num(np.asarray(image, np.float32))
        return np.clip(values, 0.0, 1.0) * np.float32(255.0)
    return np.asarray(image.convert("RGB"), np.float32)[..., 0]


def lookup(image: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Interpolate ``image`` (h, w[, c]) linearly at u, v in 0..1, clamped at the borders."""
    h, w = image.shape[:2]
    x = np.clip(np.asarray(u, np.float64) * w, 0, w - 1)
    y = np.clip(np.asarray(v, np.float64) * h, 0, h - 1)
    x0, y0 = x.astype(int), y.astype(int)
    x1, y1 = np.minimum(x0 + 1, w - 1), np.minimum(y0 + 1, h - 1)
    fx, fy = x - x0, y - y0
    if image.ndim == 3:
        fx, fy = fx[..., None], fy[..., None]
    top = image[y0, x0] * (1 - fx) + image[y0, x1] * fx
    bottom = image[y1, x0] * (1 - fx) + image[y1, x1] * fx
    return top * (1 - fy) + bottom * fy


@dataclass(frozen=True)
class HeightField:
    """Heights, float32 (n, n), row along z and column along x, over ``size`` x ``size`` units."""

    heights: np.ndarray
    size: float
    water_level: float

    def bed(self, x: np.ndarray | float, z: np.ndarray | float) -> np.ndarray:
        """Return the ground's height at x, z in units, the sea floor included; clamped outside."""
        n = len(self.heights)
        u = np.clip(np.asarray(x, np.float64) * (n - 1) / self.size, 0, n - 1)
        v = np.clip(np.asarray(z, np.float64) * (n - 1) / self.size, 0, n - 1)
        k, r = np.minimum(u.astype(int), n - 2), np.minimum(v.astype(int), n - 2)
        tx, tz = u - k, v - r
        h = self.heights
        near = h[r, k] * (1 - tx) + h[r, k + 1] * tx
        far = h[r + 1, k] * (1 - tx) + h[r + 1, k + 1] * tx
        return np.asarray(near * (1 - tz) + far * tz)

    def height(self, x: np.ndarray | float, z: np.ndarray | float) -> np.ndarray:
        """Return what one stands on: bilinear, never below the water (get_height in 2006)."""
        return np.maximum(self.bed(x, z), self.water_level)

    def slope(self, x: np.ndarray | float, z: np.ndarray | float) -> np.ndarray:
        """Return the steepness, rise over run, by central differences over half a cell."""
        d = self.size / (len(self.heights) - 1) / 2
        dx = self.bed(np.add(x, d), z) - self.bed(np.subtract(x, d), z)
        dz = self.bed(x, np.add(z, d)) - self.bed(x, np.subtract(z, d))
        return np.hypot(dx, dz) / (2 * d)


def height_field(image: np.ndarray, settings: GroundSettings, water_level: float) -> HeightField:
    """Resample an image (h, w) of values 0..255 to the vertices' heights.

    Vertex k of N takes the image at k/N though it stands at k/(N-1): so in the report.
    """
    n = settings.resolution
    at = np.arange(n) / n
    heights = lookup(image, at[None, :], at[:, None]) / 256.0 * settings.scale_y
    return HeightField(heights.astype(np.float32), settings.size, water_level)


def ground_mesh(field: HeightField, repeats: tuple[float, ...]) -> Mesh:
    """Return the height field as a mesh, with texture coordinates repeated ``repeats`` times."""
    n = len(field.heights)
    along = np.arange(n) / (n - 1)
    u, v = np.meshgrid(along, along)
    vertices = np.stack([u * field.size, field.heights, v * field.size], axis=2).reshape(-1, 3)
    vertices = np.ascontiguousarray(vertices, np.float32)
    triangles = grid_triangles(n, n)
    uv = np.stack([u, v], axis=2).reshape(-1, 2)
    coordinates = tuple(np.ascontiguousarray(uv * r, np.float32) for r in repeats)
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles, coordinates)


def colour_by_height(field: HeightField, sun: np.ndarray, size: int = 512) -> np.ndarray:
    """Return a large-scale texture, uint8 (size, size, 3), for a height image that has none.

    Sand at the shore, green low, brown and grey high (figure 3), shaded by the sun (3,).
    """
    at = (np.arange(size) + 0.5) / size * field.size
    x, z = np.meshgrid(at, at)
    h = field.bed(x, z)
    above = np.clip((h - field.water_level) / max(float(h.max()) - field.water_level, 1e-6), 0, 1)
    stops = [0.0, 0.03, 0.10, 0.40, 0.65, 1.0]
    colours = np.array(
        [
            (196, 180, 140),
            (186, 172, 128),
            (104, 122, 62),
            (116, 112, 68),
            (124, 110, 92),
            (150, 148, 144),
        ]
    )
    rgb = np.stack([np.interp(above, stops, colours[:, c]) for c in range(3)], axis=2)
    step = field.size / size
    gz, gx = np.gradient(h, step)
    light = (sun[1] - gx * sun[0] - gz * sun[2]) / np.sqrt(1 + gx**2 + gz**2)
    shade = 0.55 + 0.6 * np.clip(light, 0, 1)
    return np.ascontiguousarray(np.clip(rgb * shade[..., None], 0, 255), np.uint8)


@contextmanager
def clipped(level: float, enabled: bool = True) -> Iterator[None]:
    """Keep only what stands above the water: the plane y - level = 0 (section 2.1.2)."""
    if not enabled:
        yield
        return
    with attrib(gl.GL_TRANSFORM_BIT | gl.GL_ENABLE_BIT):
        gl.glClipPlane(gl.GL_CLIP_PLANE0, np.array([0.0, 1.0, 0.0, -level], np.float64))
        gl.glEnable(gl.GL_CLIP_PLANE0)
        yield


class Ground:
    """The terrain; ``field`` answers how high it is."""

    def __init__(self, settings: Settings, assets: Assets, sun: np.ndarray) -> None:
        """Read the height image and compile the display list."""
        ground = settings.ground
        path = assets.path(ground.height_image, "ground.height_image")
        self.field = height_field(read_heights(path), ground, settings.water.level)
        self.large = self._large_texture(settings, assets, sun)
        large = Texture(self.large, repeat=False)
        detail = Texture(read_image(assets.path(ground.detail_texture, "ground.detail_texture")))
        self._textures = [large, detail]
        units = {"both": [large, detail], "large": [large], "detail": [detail], "none": []}
        layers = units[ground.units]
        repeats = {large: 1.0, detail: ground.detail_repeat}
        if ground.units == "both" and ground.mid_repeat > 0:
            layers = [*layers, detail]
        every = tuple(
            ground.mid_repeat if unit == 2 else repeats[layer] for unit, layer in enumerate(layers)
        )
        self.mesh = ground_mesh(self.field, every)
        self._list = DisplayList(lambda: self._send(layers))

    def _large_texture(self, settings: Settings, assets: Assets, sun: np.ndarray) -> np.ndarray:
        """Read the colours; a user's own island gets colours by height unless he brings some."""
        ground, default = settings.ground, GroundSettings()
        own_island = ground.height_image not in (default.height_image, "height16.png")
        if own_island and ground.large_texture == default.large_texture:
            return colour_by_height(self.field, sun)
        return read_image(assets.path(ground.large_texture, "ground.large_texture"), "RGB")

    def _send(self, layers: list[Texture]) -> None:
        """What the display list holds: textures to units, arrays, one glDrawElements."""
        for unit, layer in enumerate(layers):
            gl.glActiveTexture(getattr(gl, f"GL_TEXTURE{unit}"))
            layer.bind()
            gl.glEnable(gl.GL_TEXTURE_2D)
            if unit == 0:
                gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
            else:
                # Modulate by twice the detail: mid grey then leaves the large colour as it is.
                gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_COMBINE)
                gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_COMBINE_RGB, gl.GL_MODULATE)
                gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 2.0)
        self.mesh.draw()
        for unit in reversed(range(len(layers))):
            gl.glActiveTexture(getattr(gl, f"GL_TEXTURE{unit}"))
            if unit > 0:
                gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 1.0)
                gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
            gl.glDisable(gl.GL_TEXTURE_2D)

    def draw(self) -> None:
        """Call the list."""
        self._list.call()

    def colour(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return the large-scale colour at x, z in units, float (n, 3) in 0..1."""
        size = self.field.size
        return lookup(self.large, np.asarray(x) / size, np.asarray(z) / size) / 255.0

    def release(self) -> None:
        """Delete the list and the textures; may be called twice."""
        self._list.release()
        for texture in self._textures:
            texture.release()
