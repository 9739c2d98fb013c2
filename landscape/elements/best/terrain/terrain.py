"""The ground of the preset `best`: three materials, tiles, shadows, low-stretch detail.

With ``ground.materials`` turf, sand and rock each have their own detail texture, mixed in four
texture units (materials.py), and the shore has its colours where it is drawn (shore.py). With
``ground.wet`` it is darker where waves reach (wet.py); with ``ground.verdure`` turf has the colour
of the sward (verdure.py); with ``ground.tone`` all has a photograph's tones (tone.py); with
``ground.clouds`` clouds shade the land (cloud_shade.py). With
``ground.tiles`` above 1 the mesh is cut into square display lists (tiles.py); those outside the
view frustum are not called, and the mirror image uses coarser ones. With ``ground.low_stretch``
details keep their scale on slopes; ``ground.ledges`` gives steep rock a finer relief
(ledges.py, rock_faces.py); with ``ground.shadows`` the shadows of what stands on the ground
are baked into the large texture (shadows.py); ``water.caustics`` lays a net of light over the bed
of shallow water (bed_light.py). Not in the report.
State used: as the ground, with four texture units, seven under shallow water; GL_CULL_FACE; the
current colour.
"""

from collections.abc import Callable, Hashable
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import front_faces
from framelens.gl.texture import Texture, halves_evenly
from landscape.elements.best.sea.shallows import cut_level, submerged
from landscape.elements.best.terrain import ASKED_BY, bed_light
from landscape.elements.best.terrain.bed_light import BedLight, under_net
from landscape.elements.best.terrain.cloud_shade import cloud_cover, clouds_shade
from landscape.elements.best.terrain.ledges import LedgedField, relief
from landscape.elements.best.terrain.materials import (
    ROCK,
    SAND,
    TURF,
    look_up,
    mix_units,
    mixtures,
    rock_share,
    textured,
    turf_alpha,
    turf_range,
)
from landscape.elements.best.terrain.relief import relief_light
from landscape.elements.best.terrain.rock_faces import (
    CLOSER,
    RockFaces,
    blocks,
    grain,
    lit_rock,
    with_grain,
)
from landscape.elements.best.terrain.shadows import ShadowMap
from landscape.elements.best.terrain.shore import moved_shore
from landscape.elements.best.terrain.tiles import boxes, cut, every_second
from landscape.elements.best.terrain.tone import toned
from landscape.elements.best.terrain.verdure import grained, verdant
from landscape.elements.best.terrain.weathering import weathered
from landscape.elements.best.terrain.wet import dampened, wet_texels
from landscape.elements.ground import Ground, chosen, has_no_colours, lay_units, leave_units
from landscape.elements.settings import Ground as GroundSettings
from landscape.elements.settings import Settings
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.files.cache import content, recall
from landscape.files.images import read_heights, read_image
from landscape.frame import Frame
from landscape.geometry.culling import boxes_in_view
from landscape.geometry.height_field import HeightField, ground_mesh, laid_over, lookup
from landscape.geometry.low_stretch import low_stretch_uv
from landscape.geometry.mesh import Mesh
from landscape.gl.display_list import DisplayList, call_lists
from landscape.gl.draw import arrays_of, draw_triangles
from landscape.gl.features import possible

# A triangle's label: the materials that it has, and whether the net of light lies on it.
EVERY, UNDER_NET = TURF | SAND | ROCK, 8
# Chosen: units from the eye within which the mirror image has the ground as fine as it is. A
# coarser islet would be lower than the stones on it, and they would hang in the air.
MIRRORED_FINE = 1.5


def shaded(painted: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return colours, uint8 (n, n, 3 or 4), times a light map, uint8 (n, n, 3), 255 full light.

    That is colour * light / 255, here in integers: a shift right by 8 divides by 256.
    """
    out = painted.copy()
    out[..., :3] = painted[..., :3] * (light.astype(np.uint16) + 1) >> 8
    return out


class Terrain(Ground):
    """The ground with the techniques above, each by its own switch."""

    asked_by = ASKED_BY
    ignores = ("ground.passes", "ground.lit")

    def _build(self, ground: GroundSettings, assets: Assets) -> None:
        """Make the layers, build the mesh with their coordinates and compile its tiles."""
        self._light: np.ndarray | None = None
        self._faces: RockFaces | None = None
        self._tiles: dict[int, dict[int, DisplayList]] = {}  # by their labels and numbers
        self._looks, self._mirrored = list[DisplayList](), list[DisplayList]()
        self._mirrored_near = list[DisplayList]()
        self._ledged = self._with_ledges(ground)
        painted = ground.materials and ground.units == "both"
        self._mixed = painted and possible("ground.materials")
        self._drawn = self._with_shore(ground, assets) if painted else self.large
        self._painted = self._materials(ground, assets) if painted else self.large
        if ground.wet and painted:
            self._painted = self._dampened(self._painted)
        if self._ledged is not None and self._mixed:
            self._painted = self._lit_rock(self._ledged, self._painted)
        self._splat = self._texture(self._painted, repeat=False)
        detail = partial(self._detail, assets)
        if self._mixed:
            layers = [(detail("detail_texture"), ground.detail_repeat)]
            layers.append((detail("sand_texture"), ground.sand_repeat))
            layers.append((detail("rock_texture"), ground.rock_repeat))
            layers.append((self._splat, 1.0))
        else:
            both = [(self._splat, 1.0), (detail("detail_texture"), ground.detail_repeat)]
            layers = chosen(both, ground.units)

        detail_uv = self._low_stretch() if ground.low_stretch else None
        mesh = ground_mesh(self.field, tuple(repeat for _, repeat in layers), detail_uv)
        if self._mixed:
            x, z = mesh.vertices[:, 0], mesh.vertices[:, 2]
            colors = np.full((len(mesh.vertices), 4), 255, np.uint8)
            colors[:, 3] = rock_share(mesh.normals, self.drawn_colour(x, z)) * 255
            mesh = replace(mesh, colors=colors)

        self._bed = BedLight.made(self.settings, assets)
        self._compile(mesh, [texture for texture, _ in layers], ground.tiles)
        if self._ledged is not None and self._mixed and self._tiles:
            self._faces = self._rock_faces(self._ledged, mesh, assets)

    def _texture(self, image: np.ndarray, repeat: bool = True) -> Texture:
        """Make a texture that is released with the ground, as sharp as ``ground.lod_bias`` says."""
        ground = self.settings.ground
        bias = ground.lod_bias if self._mixed else 0.0
        levels: np.ndarray | list[np.ndarray] = image
        if repeat and self._mixed and ground.verdure and halves_evenly(image):
            levels = list(recall(["grained", image.tobytes()], lambda: tuple(grained(image))))
        # Between two levels of almost the same contrast no blending is needed.
        blended = levels is image
        self._textures.append(Texture(levels, repeat, blended, bias))
        return self._textures[-1]

    def _with_ledges(self, ground: GroundSettings) -> LedgedField | None:
        """Put a relief on the rock of the height field, if it is asked for, and return it."""
        wanted = ground.ledges and ground.exact_height and ground.tiles > 1
        if not wanted or not ground.materials or not possible("ground.ledges"):
            return None
        field, large = self.field, self.large
        strength = ground.ledges
        what = "ledges", str(strength), *field.made_from, large.tobytes()
        raised = recall(what, lambda: (relief(field, large, strength),))[0]
        finer = HeightField(raised, field.size, field.water_level, exact=True)
        self.field = LedgedField(
            field.heights, field.size, field.water_level, field.exact, finer, strength
        )
        return self.field

    def _rock_faces(self, field: LedgedField, mesh: Mesh, assets: Assets) -> RockFaces:
        """Return what draws the rock's relief, with the grain of its texture."""
        ground = self.settings.ground
        texture: Texture | None = None
        if possible("the grain of rock with ledges"):
            path = assets.path(ground.rock_texture, "ground.rock_texture")
            texture = Texture(grain(read_image(path, "RGB", ground.texture_size)))
            self._textures.append(texture)
        repeats = ground.detail_repeat, ground.sand_repeat, ground.rock_repeat
        rates = (
            *(each / field.size for each in repeats),
            0.0,
            CLOSER * ground.rock_repeat / field.size,
        )
        parts = blocks(field, with_grain(mesh), rates, self._labels(mesh))
        return RockFaces(parts, texture)

    def _lit_rock(self, field: LedgedField, painted: np.ndarray) -> np.ndarray:
        """Return the large colours with the light on the rock's relief, see rock_faces.py."""
        sun = direction(self.settings.sun)
        what = "lit rock", repr(sun.tolist()), *field.made_from, painted.tobytes()
        return recall(what, lambda: (lit_rock(painted, field, sun),))[0]

    def _low_stretch(self) -> np.ndarray:
        """Return the details' texture coordinates, (n*n, 2), that keep their scale on slopes."""
        what = "low stretch", *self.field.made_from
        return recall(what, lambda: (low_stretch_uv(self.field),))[0]

    def _with_shore(self, ground: GroundSettings, assets: Assets) -> np.ndarray:
        """Return the large colours with those of the shore where it is drawn, see shore.py."""
        if has_no_colours(ground):
            return self.large  # made from the heights as they are drawn
        # Stones lie by these colours: where they lie does not depend on the relief.
        field, files = self.field.broad, (ground.large_texture, ground.height_image)
        scales = ground.scale_x, ground.scale_y, ground.scale_z
        places = repr((ground.resolution, scales, self.large.shape))

        def make() -> tuple[np.ndarray, np.ndarray]:
            image = laid_over(read_heights(assets.path(ground.height_image)), ground)
            painted = image / 256.0 * ground.scale_y
            return moved_shore(self.large, painted, field, ground.resolution)

        what = "shore", places, *field.made_from
        texels, colours = recall((*what, *assets.contents(*files)), make)
        drawn = self.large.copy()
        drawn.reshape(-1, 3)[texels] = colours
        return drawn

    def _materials(self, ground: GroundSettings, assets: Assets) -> np.ndarray:
        """Return the large colours, and the fraction of turf as alpha, uint8 (n, n, 4)."""
        large = self._drawn
        repeat = ground.mid_repeat
        patterns = list[Path]()
        if repeat > 0 or ground.weathered:
            patterns.append(assets.path(ground.detail_texture, "ground.detail_texture"))
        if ground.weathered:
            patterns.append(assets.path(ground.rock_texture, "ground.rock_texture"))

        def make() -> tuple[np.ndarray, np.ndarray]:
            colours, turf = large, turf_alpha(large)
            if repeat > 0:
                colours = textured(colours, read_image(patterns[0], "RGB"), repeat, turf)
            if ground.weathered:
                rock = read_image(patterns[1], "RGB")
                colours, turf = weathered(colours, turf, self.field, rock)
            if ground.verdure:
                colours = verdant(colours, turf, ground.verdure)
            if ground.tone:
                colours = toned(colours, turf, ground.tone)
            found = turf_range(turf[..., 0], len(self.field.heights) - 1)
            return np.concatenate([colours, turf], axis=2), found

        field = self.field
        what = repr((repeat, ground.weathered, ground.verdure, ground.tone)), *field.made_from
        painted, self._turf = recall((*what, *map(content, patterns), large.tobytes()), make)
        return painted

    def _dampened(self, painted: np.ndarray) -> np.ndarray:
        """Return the colours, darker along the shore, see wet.py."""
        field, side = self.field, len(painted)
        what = "wet", str(side), *field.made_from
        found = recall(what, lambda: wet_texels(field, side))
        return dampened(painted, *found)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that textures and lists were made from."""
        ground, sun = settings.ground, settings.sun
        shaded = (sun.azimuth, sun.elevation) if has_no_colours(ground) else None
        coarser = settings.reflection.lod_scale > 1
        bed = settings.sun.elevation if bed_light.wanted(settings) else None
        return replace(ground, clip=True, stones=0), settings.water.level, coarser, shaded, bed

    def _compile(self, mesh: Mesh, textures: list[Texture], count: int) -> None:
        """Compile one list of everything, or one per tile and two to set and reset the units.

        A list keeps the vertices that it draws, so that the tiles can share the mesh's arrays.
        """
        before, after = self._units(textures)
        labels = self._labels(mesh)
        if count <= 1:
            (whole,) = cut(mesh, 1)

            def send() -> None:
                before()
                with arrays_of(mesh):
                    for label, triangles in whole.parts(labels).items():
                        if self._mixed:
                            look_up(label)
                        draw_triangles(triangles)
                after()

            self._lists.append(DisplayList(send))
            return

        def compiled(*sends: Callable[[], None]) -> list[DisplayList]:
            self._lists += (lists := [DisplayList(send) for send in sends])
            return lists

        level = self.field.water_level
        self._around = compiled(before, after)
        if self._mixed:
            looks = [partial(look_up, mixture) for mixture in range(EVERY + 1)]
            self._looks = compiled(*looks)
        if self._bed is not None:
            labels = labels + UNDER_NET * under_net(mesh, level)
        tiles = cut(mesh, count)
        self._boxes, self._mirrored_boxes = boxes(tiles), boxes(tiles, level)
        parts = [tile.parts(labels) for tile in tiles]
        # What costs most at each pixel comes last: some of it is hidden by then.
        with arrays_of(mesh):
            for label in sorted(set().union(*parts), key=int.bit_count):
                own = {k: each[label] for k, each in enumerate(parts) if label in each}
                lists = compiled(*(partial(draw_triangles, each) for each in own.values()))
                self._tiles[label] = dict(zip(own, lists, strict=True))
        if self.settings.reflection.lod_scale > 1:
            stands = self._with_relief(mesh)
            coarse = every_second(stands)
            coarse_tiles = cut(coarse, count)
            with arrays_of(coarse):
                sends = [partial(draw_triangles, tile.triangles) for tile in coarse_tiles]
                self._mirrored = compiled(*sends)
            self._mirrored_boxes = boxes(coarse_tiles, level)
            if stands is not mesh:
                with arrays_of(stands):
                    sends = [partial(draw_triangles, tile.triangles) for tile in tiles]
                    self._mirrored_near = compiled(*sends)

    def _with_relief(self, mesh: Mesh) -> Mesh:
        """Return the mesh as high as what stands on it, for the mirror image."""
        if self._ledged is None:
            return mesh
        raised = mesh.vertices.copy()
        raised[:, 1] = self._ledged.terrain_height(raised[:, 0], raised[:, 2])
        return replace(mesh, vertices=raised)

    def _labels(self, mesh: Mesh) -> np.ndarray:
        """Return a label for each triangle (m,): its materials, 0 if there are no materials."""
        if not self._mixed:
            return np.zeros(len(mesh.triangles), int)
        assert mesh.colors is not None
        return mixtures(self._turf, mesh.colors[mesh.triangles, 3])

    def _units(self, textures: list[Texture]) -> tuple[Callable[[], None], Callable[[], None]]:
        """Return a function that sets the texture units, and one that restores them."""
        if not self._mixed:
            return partial(lay_units, textures), partial(leave_units, textures)

        def before() -> None:
            gl.glPushAttrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT)
            mix_units(textures)

        return before, lambda: gl.glPopAttrib()

    def shadow_map(self, light: np.ndarray) -> ShadowMap:
        """Return an empty shadow map, as large as the large texture; ``light`` (3,) is the sun."""
        return ShadowMap(self.field, light, len(self.large))

    def open_light(self, side: int) -> np.ndarray:
        """Return the light's colour where nothing casts a shadow, (side, side, 3) or (3,)."""
        sun = self.settings.sun
        light = relief_light(self.field, sun, side)
        if not clouds_shade(self.settings):
            return light
        hidden = self.settings.ground.clouds * cloud_cover(self.field, side)[..., None]
        return light + hidden * (np.array(sun.shade, np.float32) - light)

    def shade(self, light: np.ndarray) -> None:
        """Multiply the large texture by a light map, uint8 (n, n, 3), 255 full light.

        ``n`` is the large texture's side. :meth:`colour` still returns the unshaded colour.
        """
        # By day, shadows change only the brightness of what grows in them.
        self._light = light if self.settings.sun.relit else light[..., [1, 1, 1]]
        self._splat.replace(shaded(self._painted, light))

    def drawn_colour(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return the large-scale colour as it is drawn at x, z in units, float (n, 3) in 0..1."""
        return lookup(self._drawn, np.asarray(x) / self.size, np.asarray(z) / self.size) / 255.0

    def light(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return the light at x, z in units, shadows included: a factor (n, 3) on colours."""
        if self._light is None:
            return super().light(x, z)
        return lookup(self._light, np.asarray(x) / self.size, np.asarray(z) / self.size) / 255.0

    def tiles_in_view(self, frame: Frame) -> np.ndarray:
        """Return the numbers of the tiles that the frame may show, mirrored or not.

        The nearest come first, so that the depth test rejects what they hide before its texels are
        looked up.
        """
        level = self.field.water_level
        if frame.mirrored:
            middles, halves = self._mirrored_boxes
            above = middles[:, 1] - halves[:, 1] <= level
        else:
            middles, halves = self._boxes
            whole = not self.settings.ground.clip or submerged(frame, self.settings)
            lowest = -np.inf if whole else cut_level(self.settings)
            above = middles[:, 1] + halves[:, 1] >= lowest
        kept = np.flatnonzero(boxes_in_view(frame, middles, halves) & above)
        away = np.maximum(np.abs(middles[kept] - frame.eye) - halves[kept], 0.0)
        return kept[np.argsort((away * away).sum(axis=1), kind="stable")]

    def draw(self, frame: Frame) -> None:
        """Call the list, or the lists of the tiles in view."""
        if not self._tiles:
            self._lists[0].call()
            return
        before, after = self._around
        before.call()
        if self._faces is not None and not frame.mirrored:
            with front_faces(self.settings.camera.cull):
                self._faces.draw(frame)
        kept = self.tiles_in_view(frame).tolist()
        # Seen from above, land faces away only behind a crest, which hides it. The mirrored eye is
        # below the land, whose underside must hide what stands on it.
        with front_faces(self.settings.camera.cull and not frame.mirrored):
            if frame.mirrored and self._mirrored:
                # Without details, which nobody sees in an image that ripples.
                call_lists([*self._looks[:1], *self._mirrored_lists(kept, frame)])
            else:
                self._draw_tiles(kept, frame)
        after.call()

    def _mirrored_lists(self, kept: list[int], frame: Frame) -> list[DisplayList]:
        """Return these tiles' lists for the mirror image: coarse ones, but for the nearest."""
        middles, halves = self._mirrored_boxes
        aside = np.abs(middles[kept] - frame.eye) - halves[kept]
        near = (aside[:, [0, 2]] < MIRRORED_FINE).all(axis=1)
        out = list[DisplayList]()
        for tile, fine in zip(kept, near.tolist(), strict=True):
            if fine and self._mirrored_near:
                out.append(self._mirrored_near[tile])
            elif fine:
                out += [lists[tile] for lists in self._tiles.values() if tile in lists]
            else:
                out.append(self._mirrored[tile])
        return out

    def send(self, frame: Frame) -> None:
        """Send the tiles in view, whatever the state; nothing where there are none."""
        kept = self.tiles_in_view(frame).tolist()
        with front_faces(self.settings.camera.cull):
            for lists in self._tiles.values():
                call_lists([lists[k] for k in kept if k in lists])

    def _draw_tiles(self, kept: list[int], frame: Frame) -> None:
        """Call the lists of these tiles, by their labels, the nearest of a label first."""
        dry, wet = list[DisplayList](), list[DisplayList]()
        for label, lists in self._tiles.items():
            here = [lists[k] for k in kept if k in lists]
            if here and self._looks:
                here.insert(0, self._looks[label & EVERY])
            (wet if label & UNDER_NET else dry).extend(here)
        call_lists(dry)
        if wet:
            if self._bed is not None and not frame.mirrored:
                self._bed.lay(frame)
            call_lists(wet)

    def release(self) -> None:
        """Delete the lists and the textures; may be called twice."""
        if self._bed is not None:
            self._bed.release()
        if self._faces is not None:
            self._faces.release()
        super().release()
