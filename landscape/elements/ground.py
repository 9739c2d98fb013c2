"""The ground: a height field from a grey image (Ground, section 2).

Techniques: vertex arrays drawn by one glDrawElements, compiled once into a display list; two
textures by multitexturing (unit 0 the large-scale colour, unit 1 a detail repeated many times); a
clip plane that cuts the ground at the water level.

With ``ground.materials`` turf, sand and rock each have a detail of their own, and the units mix
them: unit 0 is turf; unit 1 lets sand in where the large texture's alpha says so (GL_INTERPOLATE
by the alpha of another unit's texture, GL_ARB_texture_env_crossbar, in OpenGL 1.4); unit 2 rock by
the vertices' alpha; unit 3 multiplies by the large colour, twice. With ``ground.tiles`` above 1 the
mesh is cut into square lists, and those out of the camera's view are not called.
State used: texture units 0 to 3, the current colour, GL_CLIP_PLANE0.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from PIL import Image

from landscape.elements.sea.waves import cut_level
from landscape.files.assets import Assets
from landscape.files.cache import content, recall
from landscape.files.images import read_heights, read_image
from landscape.frame import Frame
from landscape.geometry.camera import boxes_in_view
from landscape.geometry.height_field import (
    HeightField,
    colour_by_height,
    greenness,
    ground_mesh,
    height_field,
    lookup,
)
from landscape.geometry.mesh import Mesh, grid_triangles
from landscape.gl.calls import drawing, drawn_now, gl
from landscape.gl.display_list import DisplayList, call_lists
from landscape.gl.draw import draw_mesh
from landscape.gl.state import attrib, front_faces
from landscape.gl.texture import Texture
from landscape.settings import Ground as GroundSettings
from landscape.settings import Settings

__all__ = [
    "Ground",
    "HeightField",
    "clipped",
    "colour_by_height",
    "ground_mesh",
    "height_field",
    "lookup",
    "read_heights",
]

ELEMENT = "ground"

MID = 0.8  # chosen: with ground.materials, strength of the detail laid into the large texture


@contextmanager
def clipped(level: float, enabled: bool = True) -> Iterator[None]:
    """Keep only what stands above the water: the plane y - level = 0 (section 2.1.2)."""
    if not enabled:
        yield
        return
    outside = drawn_now()
    with drawing("ground"), attrib(gl.GL_TRANSFORM_BIT | gl.GL_ENABLE_BIT):
        gl.glClipPlane(gl.GL_CLIP_PLANE0, np.array([0.0, 1.0, 0.0, -level], np.float64))
        gl.glEnable(gl.GL_CLIP_PLANE0)
        with drawing(*outside):
            yield


@dataclass(frozen=True)
class Tile:
    """A square part of the ground's mesh, and the box it fills: low and high corner (3,) each."""

    mesh: Mesh
    low: np.ndarray
    high: np.ndarray


def cut(mesh: Mesh, tiles: int) -> list[Tile]:
    """Cut a grid's mesh into ``tiles`` x ``tiles`` meshes; each triangle goes to one of them."""
    side = round(len(mesh.vertices) ** 0.5) - 1
    cell = np.arange(side) * tiles // side
    number = np.repeat(np.add.outer(cell * tiles, cell).ravel(), 2)  # two triangles a cell
    parts = []
    for k in range(tiles * tiles):
        triangles = mesh.triangles[number == k]
        if not len(triangles):
            continue
        used, own = np.unique(triangles, return_inverse=True)
        vertices = mesh.vertices[used]
        part = Mesh(
            vertices,
            mesh.normals[used],
            np.ascontiguousarray(own.reshape(-1, 3), np.uint32),
            tuple(np.ascontiguousarray(c[used]) for c in mesh.coordinates),
            None if mesh.colors is None else np.ascontiguousarray(mesh.colors[used]),
        )
        parts.append(Tile(part, vertices.min(axis=0), vertices.max(axis=0)))
    return parts


def boxes(tiles: list[Tile], level: float | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Return the middles and the half sides of the tiles' boxes, (n, 3) each.

    Mirrored at the height ``level``, if it is given.
    """
    low, high = (
        np.array([getattr(tile, end) for tile in tiles]).reshape(-1, 3) for end in ("low", "high")
    )
    middles = (low + high) / 2
    if level is not None:
        middles[:, 1] = 2.0 * level - middles[:, 1]
    return middles, (high - low) / 2


def every_second(mesh: Mesh) -> Mesh:
    """Return a grid's mesh without every second row and column of its vertices, borders kept."""
    side = round(len(mesh.vertices) ** 0.5)
    lines = np.unique([*range(0, side, 2), side - 1])
    kept = np.arange(side * side).reshape(side, side)[np.ix_(lines, lines)].ravel()
    coordinates = tuple(np.ascontiguousarray(c[kept]) for c in mesh.coordinates)
    colours = None if mesh.colors is None else np.ascontiguousarray(mesh.colors[kept])
    triangles = grid_triangles(len(lines), len(lines))
    return Mesh(mesh.vertices[kept], mesh.normals[kept], triangles, coordinates, colours)


def textured(
    colours: np.ndarray, detail: np.ndarray, repeat: float, turf: np.ndarray
) -> np.ndarray:
    """Return colours, uint8 (n, n, 3), times MID of twice a detail (m, m, 3), ``repeat`` times.

    ``turf``, uint8 (n, n, 1), says where; bare ground gets a third of it.

    What a texture unit of its own would do in each frame, done once: it serves what is a few units
    off, where the finest detail has gone grey, and is too coarse to be sharp at one's feet.
    """
    size = max(round(len(colours) / repeat), 1)
    tile = np.asarray(Image.fromarray(detail).resize((size, size), Image.Resampling.BOX))
    times = -(-len(colours) // size)
    contrast = MID * (tile.astype(np.float32) / np.float32(127.5) - 1)
    contrast = np.tile(contrast, (times, times, 1))[: len(colours), : colours.shape[1]]
    contrast *= (turf + np.float32(127.5)) / np.float32(382.5)
    return np.clip(colours * (1 + contrast), 0, 255).astype(np.uint8)


def rock_share(normals: np.ndarray, colour: np.ndarray) -> np.ndarray:
    """Return 0..1, how much rock shows where the ground has these normals and colours (n, 3).

    Steep is rock, and grey is; green is not. Chosen after the rules that painted the colours.
    """
    slope = np.hypot(normals[:, 0], normals[:, 2]) / np.maximum(normals[:, 1], 1e-6)
    steep = np.clip((slope - 0.3) / 0.3, 0.0, 1.0)
    vivid = 1.0 - colour.min(axis=1) / np.maximum(colour.max(axis=1), 1e-3)
    grey = np.clip((0.24 - vivid) / 0.08, 0.0, 1.0)
    return np.asarray(np.maximum(steep, grey) * (1.0 - 0.7 * greenness(colour)))


def lay_units(layers: list[Texture]) -> None:
    """Set unit 0 to the first layer, and each further unit to multiply by twice its own."""
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


def leave_units(layers: list[Texture]) -> None:
    """Undo :func:`lay_units`."""
    for unit in reversed(range(len(layers))):
        gl.glActiveTexture(getattr(gl, f"GL_TEXTURE{unit}"))
        if unit > 0:
            gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 1.0)
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
        gl.glDisable(gl.GL_TEXTURE_2D)


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
        # What is drawn is opaque: the details have no alpha, which reads as 1.
        gl.glTexEnvi(env, gl.GL_COMBINE_ALPHA, gl.GL_REPLACE)
        gl.glTexEnvi(env, gl.GL_SOURCE0_ALPHA, gl.GL_PREVIOUS if unit else gl.GL_TEXTURE)
    gl.glTexEnvf(env, gl.GL_RGB_SCALE, 2.0)


class Ground:
    """The terrain; ``field`` answers how high it is."""

    def __init__(self, settings: Settings, assets: Assets, sun: np.ndarray) -> None:
        """Read the height image and compile the display lists."""
        ground = settings.ground
        path = assets.path(ground.height_image, "ground.height_image")
        self.field = height_field(read_heights(path), ground, settings.water.level)
        self.large = self._large_texture(settings, assets, sun)
        self._settings, self._lists = settings, list[DisplayList]()
        self._around, self._mirrored = list[DisplayList](), list[DisplayList]()
        self._textures: list[Texture] = []

        def detail(key: str) -> Texture:
            name = getattr(ground, key)
            image = read_image(assets.path(name, f"ground.{key}"), largest=ground.texture_size)
            return self._own(image)

        mixed = ground.materials and ground.units == "both"
        if mixed:
            turf = (greenness(self.large.reshape(-1, 3) / np.float32(255.0)) * 255).astype(np.uint8)
            turf = turf.reshape(*self.large.shape[:2], 1)
            colours = self.large
            if ground.mid_repeat > 0:
                path = assets.path(ground.detail_texture)
                pattern = read_image(path, "RGB")
                large = colours
                colours = recall(
                    [content(path), large.tobytes(), repr(ground.mid_repeat)],
                    lambda: (textured(large, pattern, ground.mid_repeat, turf),),
                )[0]
            self._painted = np.concatenate([colours, turf], axis=2)
            splat = self._own(self._painted, repeat=False)
            self._layers = [detail("detail_texture"), detail("sand_texture")]
            self._layers += [detail("rock_texture"), splat]
            repeats = [ground.detail_repeat, ground.sand_repeat, ground.rock_repeat, 1.0]
        else:
            self._painted = self.large
            splat, fine = self._own(self._painted, repeat=False), detail("detail_texture")
            both = [(splat, 1.0), (fine, ground.detail_repeat)]
            if ground.mid_repeat > 0:
                both.append((fine, ground.mid_repeat))
            units = {"both": both, "large": both[:1], "detail": both[1:2], "none": []}
            self._layers = [layer for layer, _ in units[ground.units]]
            repeats = [repeat for _, repeat in units[ground.units]]
        self._splat = splat
        self._light: np.ndarray | None = None
        self.mesh = ground_mesh(self.field, tuple(repeats), ground.low_stretch)
        if mixed:
            colors = np.full((len(self.mesh.vertices), 4), 255, np.uint8)
            x, z = self.mesh.vertices[:, 0], self.mesh.vertices[:, 2]
            colors[:, 3] = rock_share(self.mesh.normals, self.colour(x, z)) * 255
            self.mesh = replace(self.mesh, colors=colors)
        self._compile(mixed)

    def shade(self, light: np.ndarray) -> None:
        """Multiply what is painted on the ground by a light map, uint8 (n, n, 3), 255 full light.

        ``n`` is the large texture's side. :meth:`colour` stays what the ground's own colour is.
        """
        self._light = light[..., 1]
        painted = self._painted.copy()
        # A shift is a division by 256, which is near enough.
        painted[..., :3] = painted[..., :3] * (light.astype(np.uint16) + 1) >> 8
        self._splat.bind()
        height, width, channels = painted.shape
        layout = gl.GL_RGBA if channels == 4 else gl.GL_RGB
        gl.glTexSubImage2D(
            gl.GL_TEXTURE_2D, 0, 0, 0, width, height, layout, gl.GL_UNSIGNED_BYTE, painted
        )
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def _own(self, image: np.ndarray, repeat: bool = True) -> Texture:
        self._textures.append(Texture(image, repeat))
        return self._textures[-1]

    def _large_texture(self, settings: Settings, assets: Assets, sun: np.ndarray) -> np.ndarray:
        """Read the colours; a user's own island gets colours by height unless he brings some."""
        ground, default = settings.ground, GroundSettings()
        own_island = ground.height_image not in (default.height_image, "height16.png")
        if own_island and ground.large_texture == default.large_texture:
            return colour_by_height(self.field, sun)
        path = assets.path(ground.large_texture, "ground.large_texture")
        return read_image(path, "RGB", ground.texture_size)

    def _compile(self, mixed: bool) -> None:
        """Compile one list of everything, or one a tile between two that set the units."""
        layers, count = self._layers, self._settings.ground.tiles
        begin, end = (mix_units, None) if mixed else (lay_units, leave_units)

        def before() -> None:
            if mixed:
                gl.glPushAttrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT)
            begin(layers)

        def after() -> None:
            if end is None:
                gl.glPopAttrib()
            else:
                end(layers)

        def whole() -> None:
            before()
            draw_mesh(self.mesh)
            after()

        self._tiles = cut(self.mesh, count) if count > 1 else []
        level = self.field.water_level
        self._boxes, self._mirrored_boxes = boxes(self._tiles), boxes(self._tiles, level)
        if not self._tiles:
            self._lists.append(DisplayList(whole))
            return
        self._lists += [DisplayList(partial(draw_mesh, tile.mesh)) for tile in self._tiles]
        self._around = [DisplayList(before), DisplayList(after)]
        if self._settings.reflection.lod_scale > 1:
            coarser = cut(every_second(self.mesh), count)
            self._mirrored = [DisplayList(partial(draw_mesh, tile.mesh)) for tile in coarser]
            self._mirrored_boxes = boxes(coarser, level)

    def tiles_in_view(self, frame: Frame) -> np.ndarray:
        """Return the numbers of the tiles that may show in the frame, mirrored or not.

        The nearest come first: what they hide is then rejected before its texels are looked up.
        """
        level = self.field.water_level
        if frame.mirrored:
            middles, halves = self._mirrored_boxes
            above = middles[:, 1] - halves[:, 1] <= level
        else:
            middles, halves = self._boxes
            cut = cut_level(self._settings) if self._settings.ground.clip else -np.inf
            above = middles[:, 1] + halves[:, 1] >= cut
        kept = np.flatnonzero(boxes_in_view(frame, middles, halves) & above)
        away = np.maximum(np.abs(middles[kept] - frame.eye) - halves[kept], 0.0)
        return kept[np.argsort((away * away).sum(axis=1), kind="stable")]

    def draw(self, frame: Frame | None = None) -> None:
        """Call the list, or the lists of the tiles that ``frame`` may show."""
        if not self._tiles:
            self._lists[0].call()
            return
        every = range(len(self._tiles))
        before, after = self._around
        before.call()
        kept = every if frame is None else self.tiles_in_view(frame).tolist()
        # Land seen from above turns its back behind a crest only, which hides it. The mirrored eye
        # is under the land, whose lower side hides what stands on it.
        mirrored = frame is not None and frame.mirrored
        with front_faces(self._settings.camera.cull and not mirrored):
            lists = self._mirrored if mirrored and self._mirrored else self._lists
            call_lists([lists[k] for k in kept])
        after.call()

    def colour(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return the large-scale colour at x, z in units, float (n, 3) in 0..1."""
        size = self.field.size
        return lookup(self.large, np.asarray(x) / size, np.asarray(z) / size) / 255.0

    def light(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return how much light the shadows leave at x, z in units, (n,) in 0..1."""
        if self._light is None:
            return np.ones(np.shape(x))
        size = self.field.size
        return lookup(self._light, np.asarray(x) / size, np.asarray(z) / size) / 255.0

    def release(self) -> None:
        """Delete the lists and the textures; may be called twice."""
        for compiled in (*self._lists, *self._around, *self._mirrored):
            compiled.release()
        for texture in self._textures:
            texture.release()
