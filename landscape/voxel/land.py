"""The land of cubes: which regions are drawn, and their faces.

Technique: one shared vertex buffer, one texture with all tiles, and one glMultiDrawArrays that
sends the faces of all visible regions, nearest first, so that what they hide fails the depth test
early. Where some are nearby, it has the alpha test, since leaves have holes. Plants, which also
have two sides, are a second one.
State used: GL_TEXTURE_2D, GL_CULL_FACE, GL_ALPHA_TEST; the modelview matrix scales blocks to units.
What is wrong without: switches ``voxel.cull``, ``voxel.facing``, ``voxel.merge``, ``voxel.crisp``,
``voxel.holes``.
"""

import math
from collections.abc import Hashable, Mapping, Sequence
from typing import NamedTuple, Self

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, matrix
from framelens.gl.texture import Texture, mip_levels
from landscape.elements.element import Element, Site
from landscape.files.assets import Assets
from landscape.gl.display_list import DisplayList
from landscape.settings.declare import get
from landscape.voxel.blocks import TILES
from landscape.voxel.build import (
    BUILT,
    Meshes,
    all_meshes,
    built,
    face_light,
    image_heights,
    meshed,
    seen_from_afar,
    shows_buildings,
    slope_light,
)
from landscape.voxel.distant import distant_mesh
from landscape.voxel.horizon import CLEAR, Horizon, solid_heights
from landscape.voxel.memory import give_back
from landscape.voxel.mesh import BAND, BANDS, SETS, UP, RegionMesh
from landscape.voxel.packed_mesh import PackedMesh
from landscape.voxel.patch import patched, regions_around
from landscape.voxel.region_buffer import ABOVE, ALL, UNDER, Light, Part, RegionBuffer
from landscape.voxel.region_buffers import RegionBuffers
from landscape.voxel.settings import Settings
from landscape.voxel.tile_column import column
from landscape.voxel.tiles import SIDE, plants, tiles
from landscape.voxel.visibility import TESTS, distances, facing, visible_in_world
from landscape.voxel.world import Cell, Changes

FAR, DISTANT = 1, 2  # which of a region's meshes, after that for near
LEVELS = 3
MOST_ALONE = 16  # regions, chosen: more are meshed all together
LEAST_ALPHA = 0.5  # chosen: texels of plants and of leaves nearby with less are not drawn


class Choice(NamedTuple):
    """Regions to draw, nearest first, and in which directions their faces may be seen (n, 6).

    ``shares`` are those of the buffer that hold their meshes. ``part`` says whether what lies under
    water or above it need not be sent, and ``last`` (n,) is the last set of each that hills do not
    hide, -1 for none.
    """

    regions: np.ndarray
    shares: np.ndarray
    facing: np.ndarray
    part: Part = ALL
    last: np.ndarray | None = None

    def only(self, wanted: np.ndarray) -> "Choice":
        """Return the same of some of the regions, those ``wanted`` (n,)."""
        last = None if self.last is None else self.last[wanted]
        return Choice(
            self.regions[wanted], self.shares[wanted], self.facing[wanted], self.part, last
        )


class Around(NamedTuple):
    """How far all regions are from the eye in units (n,), and in which order, nearest first."""

    away: np.ndarray
    order: np.ndarray


def light_from(settings: Settings) -> tuple[object, ...]:
    """Return the settings that the colours of the faces depend on."""
    return settings.sun, settings.shadow.color, settings.voxel.slope


def boxes(meshes: Meshes, block: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the least and the greatest corners (regions, 3) of all regions in units.

    In memory all x come first, then all y, then all z: numpy is faster so, and each frame asks for
    them often.
    """
    found = np.array([mesh.box for mesh in meshes]).reshape(LEVELS, -1, 2, 3) * block
    low, high = found[:, :, 0].min(axis=0), found[:, :, 1].max(axis=0)
    return np.asfortranarray(low), np.asfortranarray(high)


def tile_levels(assets: Assets) -> list[np.ndarray]:
    """Return the mip levels of the column of tiles, the largest first.

    They go down to the level in which a tile is one texel. Where OpenGL allows no texture as large
    as the column, its tiles are coarser.
    """
    pictures = tiles(assets)
    levels = mip_levels(column([pictures[name] for name in TILES]))[: SIDE.bit_length()]
    largest = int(gl.glGetIntegerv(gl.GL_MAX_TEXTURE_SIZE))
    return [level for level in levels if len(level) <= largest]


class Land(Element[Settings]):
    """The land. ``low`` and ``high`` (regions, 3) are the regions' bounding boxes in units.

    ``version`` grows whenever the meshes for far change, which shadows are drawn with; ``touched``
    are boxes, in units, of the blocks that have done so since it was last emptied.
    """

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return what the world, its meshes and its textures are made of, but for their light."""
        names = (*BUILT, "mipmaps", "crisp", "buffers", "vertex_arrays")
        return *(get(settings, f"voxel.{name}") for name in names), settings.shadow.enabled

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build it by the seed."""
        return cls(site.settings, site.assets, site.seed)

    def __init__(self, settings: Settings, assets: Assets, seed: int) -> None:
        """Build the world or recall it, upload its meshes and the tiles."""
        self.settings, self.version = settings, 0
        self._stale: set[int] = set()  # regions whose mesh for where they are distant is old
        self.touched: list[tuple[np.ndarray, np.ndarray]] = []
        # Boxes [x, z, y] of changed blocks of which the meshes for far still know nothing.
        self._late: list[tuple[list[int], list[int]]] = []
        self._due: list[tuple[list[int], list[int]]] = []
        self.world, self.colours, found = built(settings, assets, seed)
        self._source = image_heights(settings.voxel, assets)
        self.low, self.high = boxes(found, self.world.block)
        self.buffer = self._buffer(found)
        del found  # those of a large world take much memory
        give_back()
        self._horizon: Horizon | None = None  # once what hills hide is asked for
        mipmaps, crisp = settings.voxel.mipmaps, settings.voxel.crisp
        levels = tile_levels(assets)
        self._tiles = Texture(levels if mipmaps else levels[:1], mipmaps=mipmaps, crisp=crisp)
        self._plants = Texture(plants(assets), repeat=False, mipmaps=mipmaps, crisp=crisp)

        # A list, since each pass of a frame needs all of it.
        self._state = DisplayList(self._set_state)

    def _buffer(self, meshes: Sequence[RegionMesh | PackedMesh]) -> RegionBuffer:
        """Return one vertex buffer with these meshes, or one for each of them."""
        kind = RegionBuffers if self.settings.voxel.buffers == "regions" else RegionBuffer
        return kind(meshes, self.settings.voxel.vertex_arrays)

    def _set_state(self) -> None:
        """Scale blocks to units, and draw faces of one side with the tiles."""
        gl.glScalef(self.scale, self.scale, self.scale)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnable(gl.GL_CULL_FACE)
        self._tiles.bind()

    @property
    def meshes(self) -> list[RegionMesh]:
        """Copies of the meshes of all regions for near, then for far, then where distant."""
        return [self.buffer.mesh(share) for share in range(len(self.buffer.start))]

    @property
    def scale(self) -> float:
        """The side of a block in units."""
        return self.world.block

    def around(self, eye: np.ndarray) -> Around:
        """Return how far the regions are from an eye (3,), in units."""
        away = distances(self.low, self.high, eye)
        return Around(away, np.argsort(away, kind="stable"))

    def _in_view(self, clip: np.ndarray, around: Around, part: Part, reach: float) -> np.ndarray:
        """Return which regions may be visible, bool (regions,)."""
        values = self.settings.voxel
        seen = TESTS[values.visibility](self.low, self.high, clip)
        seen &= around.away < min(values.distance, reach)
        if part == ABOVE:
            seen &= self.high[:, 1] > self.world.water * self.scale
        elif part == UNDER:
            seen &= self.low[:, 1] < (self.world.water + 1) * self.scale
        return seen

    def choose(
        self,
        clip: np.ndarray,
        eye: np.ndarray,
        around: Around,
        near: float,
        far: float,
        part: Part = ALL,
        reach: float = math.inf,
    ) -> Choice:
        """Return what to draw: with ``clip`` (4, 4), projection times modelview, from ``eye``.

        ``around`` is what :meth:`around` returns. Regions within ``near`` units are drawn with the
        meshes for near, beyond ``far`` units with those for where they are distant. ``part`` of the
        land will be visible, and nothing beyond ``reach`` units.
        """
        values, regions = self.settings.voxel, around.order
        if values.cull:
            seen = self._in_view(clip, around, part, reach)
            regions = regions[seen[regions]]

        level = np.searchsorted((near, max(near, far)), around.away[regions], "right")
        if self._stale:
            for region in regions[level == DISTANT]:
                self._refresh(int(region))
        ways = facing(self.low[regions], self.high[regions], eye)
        if not values.facing:
            ways[:] = True
        return Choice(regions, regions + level * len(self.low), ways, part)

    def without_hidden(self, choice: Choice, eye: np.ndarray) -> Choice:
        """Return a choice of which is not drawn what the eye (3,), in units, cannot see for hills.

        That is known only for an eye in the air above the water.
        """
        world = self.world
        x, y, z = (eye / self.scale).tolist()
        if (
            not self.settings.voxel.horizon
            or y < world.water + CLEAR
            or not world.is_air(x, z, y, CLEAR)
        ):
            return choice

        if self._horizon is None:
            self._horizon = Horizon(solid_heights(world.blocks), world.region_size)
        hidden = self._horizon.hidden(x, z, y)[choice.regions]
        bands = (hidden - self.colours.shore[1]) // BAND
        last = SETS - 1 - np.minimum(np.maximum(bands, 0), BANDS - 1).astype(np.intp)
        last[hidden * self.scale >= self.high[choice.regions, 1]] = -1
        return choice._replace(last=last)

    def _refresh(self, region: int) -> None:
        """Mesh a region for where it is distant again, if its blocks have changed."""
        if region in self._stale:
            self._stale.remove(region)
            blocks, origin = self.world.with_edge(region)
            colours = seen_from_afar(self.colours)
            mesh = self.buffer.mesh(region + FAR * len(self.low))
            if not shows_buildings(mesh):
                mesh = distant_mesh(blocks, origin, colours, self.settings.voxel.merge)
            self._replace(region + DISTANT * len(self.low), mesh)
            low, high = (self.scale * end for end in mesh.box)
            self.low[region] = np.minimum(self.low[region], low)
            self.high[region] = np.maximum(self.high[region], high)

    def seen_by_sun(
        self, clip: np.ndarray, towards: np.ndarray, share: tuple[int, int] = (0, 1)
    ) -> Choice:
        """Return what the sun sees, which is infinitely far away in the direction ``towards``.

        ``share`` k, n: only every n-th of the land's regions, from k on.
        """
        regions = np.arange(share[0], len(self.low), share[1])
        regions = regions[visible_in_world(self.low[regions], self.high[regions], clip)]
        away = 1e6 * towards
        ways = facing(self.low[regions], self.high[regions], away)
        return Choice(regions, regions + FAR * len(self.low), ways)

    def draw(  # type: ignore[override]  # what of it the scene has chosen
        self, choice: Choice, fog_by_height: bool = False
    ) -> None:
        """Draw the regions of a choice, textured, in the current state of fog and shadows."""
        groups = gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT
        with attrib(groups), matrix(), self.buffer.bound(fog_by_height):
            self._state.call()
            nearby = bool((choice.shares < len(self.low)).any())
            holed = self.settings.voxel.holes and nearby and choice.part != UNDER
            if holed:
                self._leave_holes()
            self.buffer.draw(choice.shares, choice.facing, choice.part, choice.last)
            found = self.buffer.plants(choice.shares, choice.part, choice.last)
            if not len(found[0]):
                return
            self._plants.bind()
            gl.glDisable(gl.GL_CULL_FACE)
            if not holed:
                self._leave_holes()
            self.buffer.draw_plants(found)

    def _leave_holes(self) -> None:
        """Draw from now on only where a texture is not transparent."""
        gl.glEnable(gl.GL_ALPHA_TEST)
        gl.glAlphaFunc(gl.GL_GREATER, LEAST_ALPHA)

    def draw_shapes(self, choice: Choice) -> None:
        """Draw all faces but those of plants, without textures, as a shadow map needs them."""
        with attrib(gl.GL_ENABLE_BIT), matrix(), self.buffer.bound():
            gl.glScalef(self.scale, self.scale, self.scale)
            gl.glEnable(gl.GL_CULL_FACE)
            self.buffer.draw(choice.shares, choice.facing)

    def change(self, blocks: Mapping[Cell, int]) -> None:
        """Change blocks that lie close together, and at once what can be seen of them."""
        for cell, kind in blocks.items():
            self.world.put(cell, kind)
        if self._horizon is not None:
            for x, z in {cell[:2] for cell in blocks}:
                self._horizon.change(x, z, self.world.blocks[x, z])
        self._rebuild(np.array(list(blocks)))

    def _rebuild(self, cells: np.ndarray) -> None:
        """Build again what can be seen of the regions around changed blocks (n, 3)."""
        low, high = cells.min(axis=0).tolist(), (cells.max(axis=0) + 1).tolist()
        least, most = (np.array(end)[[0, 2, 1]] for end in (low, high))
        for region in regions_around(self.world, low, high):
            change = self.world, region, low, high, self.colours, self.settings.voxel.occlusion
            self._replace(region, patched(self.buffer.mesh(region), *change))
            # Faces of the blocks next to these may be new.
            self.low[region] = np.minimum(self.low[region], (least - 1) * self.scale)
            self.high[region] = np.maximum(self.high[region], (most + 1) * self.scale)
        self._late.append((low, high))

    def catch_up(self) -> None:
        """Change the meshes for far, which shadows are drawn with, too; call it once a frame.

        They follow a frame later, so that neither frame takes too long.
        """
        colours = seen_from_afar(self.colours) if self._due else self.colours
        for low, high in self._due:
            for region in regions_around(self.world, low, high):
                share = region + FAR * len(self.low)
                change = self.world, region, low, high, colours
                self._replace(share, patched(self.buffer.mesh(share), *change, False, plants=False))
                self._stale.add(region)
            self.version += 1
            ends = (np.array(end)[[0, 2, 1]] * self.scale for end in (low, high))
            self.touched.append((next(ends), next(ends)))
        self._due, self._late = self._late, []

    def restore(self, changes: Changes) -> None:
        """Change these blocks and no others, anywhere, and mesh their regions again."""
        world = self.world
        places = world.restore(changes)
        x, z, _ = world.cells(places)
        if self._horizon is not None:
            for i, k in np.unique(np.stack([x, z], axis=1), axis=0).tolist():
                self._horizon.change(i, k, world.blocks[i, k])

        # A block has a part in the meshes of the regions that it touches, too.
        xs, zs = (np.clip([at - 1, at + 1], 0, world.side - 1) for at in (x, z))
        regions = np.unique([world.region_of(i, k) for i in xs for k in zs]).tolist()
        if len(regions) > MOST_ALONE:
            self._rebuild_all()
            return
        for region in regions:
            self.rebuild(region)

    def _rebuild_all(self) -> None:
        """Mesh all regions again, many at once: sooner than one after the other."""
        self.version += 1
        found = all_meshes(self.world, self.colours, self.settings.voxel)
        self.low, self.high = boxes(found, self.world.block)
        self._renew(found)
        self._stale.clear()

    def rebuild(self, region: int) -> None:
        """Mesh a region again, whose blocks have changed."""
        self.version += 1
        found = [mesh for (mesh,) in meshed(self.world, region, self.colours, self.settings.voxel)]
        low, high = zip(*(mesh.box for mesh in found), strict=True)
        self.low[region] = self.scale * np.min(low, axis=0)
        self.high[region] = self.scale * np.max(high, axis=0)
        for level, mesh in enumerate(found):
            self._replace(region + level * len(self.low), mesh)
        self._stale.discard(region)

    def _replace(self, share: int, mesh: RegionMesh) -> None:
        """Upload one of a region's meshes."""
        if not self.buffer.replace(share, mesh):
            every = self.buffer.meshes()
            every[share] = mesh
            self._renew(every)

    def _renew(self, every: Meshes) -> None:
        """Make the buffer anew, with these meshes."""
        self.buffer.release()
        self.buffer = self._buffer(every)
        if self._lit_otherwise():
            self.buffer.relight(self._light())

    def take(self, settings: Settings) -> None:
        """Take other settings: another light needs no other meshes, only other colours."""
        former, self.settings = self.settings, settings
        if light_from(former) != light_from(settings):
            self.buffer.relight(self._light())

    def _lit_otherwise(self) -> bool:
        """Return whether the light is not that in which the meshes are made."""
        light = face_light(self.settings.sun, self.settings.shadow)
        return bool(
            (self.colours.light != light).any() or (self._slope() != self.colours.slope).any()
        )

    def _slope(self) -> np.ndarray:
        """Return how much lighter level faces are for the land's slope, now."""
        return slope_light(self._source, self.settings.sun, self.settings.voxel.slope)

    def _light(self) -> Light:
        """Return how the light differs from that in which the meshes are made."""
        light = face_light(self.settings.sun, self.settings.shadow)
        times = light[:, :3] / self.colours.light[:, :3]
        alpha = np.rint(255 * light[:, 3])
        # Plants are lit from above, and in the shade only where they are in shadow.
        return Light(
            np.concatenate([times, times[UP : UP + 1]]).astype(np.float32),
            np.append(alpha, 255).astype(np.uint8),
            self._slope() / self.colours.slope,
        )

    def release(self) -> None:
        """Delete the buffer, the list and the textures; may be called twice."""
        self._state.release()
        self.buffer.release()
        self._tiles.release()
        self._plants.release()
