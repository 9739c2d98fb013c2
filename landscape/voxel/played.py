"""The walker's actions in the island in voxels: move among its blocks, dig and build."""

import math
from collections.abc import Callable, Hashable

import numpy as np

from framelens.base.errors import InputError
from framelens.base.texts import Phrases
from framelens.gl.seam import drawing
from landscape.files.assets import Assets
from landscape.files.cache import content
from landscape.frame import Frame, Pose
from landscape.geometry.bodies import Body, Wish
from landscape.geometry.obstacles import MARGIN
from landscape.voxel import body as bodies
from landscape.voxel.bar import Icons, bar_image
from landscape.voxel.blocks import AIR, BLOCKS, SOLID, block
from landscape.voxel.highlight import draw_crosshair, draw_highlight
from landscape.voxel.land import Land
from landscape.voxel.picking import Hit, picked, picked_through_water
from landscape.voxel.settings import Settings
from landscape.voxel.textures_view import covered
from landscape.voxel.water_images import FLATTER
from landscape.voxel.world import Cell
from landscape.voxel.world_file import decoded, encoded, merged

REACH = 6.0  # blocks, chosen: to the ground down a slope, too
# The kinds of blocks that a walker begins with. Chosen.
SLOTS = ("grass", "earth", "rock", "sand", "planks", "brick", "oak log", "oak leaves", "lamp")
WHY_NOT: Phrases = (
    "the edge of the map",
    "the bottom of the world",
    "nothing can be built higher",
    "a plant needs something to stand on",
    "too far",
)
EDGE, BOTTOM, TOP, ROOT, FAR = WHY_NOT
# Settings of voxel. Into which regions the columns are divided does not matter.
MADE_FROM = ("levels", "sea", "trees", "buildings")


class Played:
    """The part of the scene that a walker plays with."""

    settings: Settings
    land: Land
    shown: set[str]

    def __init__(self, assets: Assets, seed: int) -> None:
        """Nothing has been changed yet."""
        self._assets, self._seed = assets, seed
        self._icons: Icons | None = None
        self.changes = 0
        self.slot = 0
        self.slots = [block(name) for name in SLOTS]

    def moved(self, body: Body, wish: Wish, seconds: float) -> Body:
        """Return a walker's body ``seconds`` later, in units."""
        world, block = self.land.world, self.land.scale
        swims = self.settings.walk.swim
        place = bodies.Place(
            world.blocks,
            water=world.water if swims else -math.inf,
            margin=MARGIN / block,
            floor=-math.inf if swims else world.water,
        )
        inside = body.scaled(1 / block), wish.scaled(1 / block)
        return bodies.moved(place, *inside, seconds).scaled(block)

    def aimed_at(self, pose: Pose) -> Hit | None:
        """Return the block under the cross-hair, None if none is within reach."""
        assert pose.y is not None
        block = self.land.scale
        eye = pose.x / block, pose.z / block, pose.y / block
        east, up, south = pose.forward
        way = east, south, up
        blocks = self.land.world.blocks
        if not self.refracts:
            return picked(blocks, eye, way, REACH)
        return picked_through_water(blocks, eye, way, REACH, self.land.world.water, FLATTER)

    @property
    def refracts(self) -> bool:
        """Whether one sees through the water what lies under it, and flatter than it is."""
        return False

    def choose(self, slot: int) -> None:
        """Choose the kind of block in a slot; after the last comes the first."""
        self.slot = slot % len(self.slots)

    def use(self, tool: str, pose: Pose, body: Body | None) -> str:
        """Dig, place or pick; return why that is impossible, or ""."""
        hit = self.aimed_at(pose)
        if hit is None:
            return FAR
        if tool == "pick":
            self._pick(int(self.land.world.blocks[hit.block]))
            return ""
        changed: dict[Cell, int] | str
        changed = self._dug(hit.block) if tool == "dig" else self._placed(hit, pose, body)
        if isinstance(changed, str):
            return changed
        if changed:
            self.land.change(changed)
            self.changes += len(changed)
        return ""

    def _pick(self, kind: int) -> None:
        if kind in self.slots:
            self.slot = self.slots.index(kind)
        else:
            self.slots[self.slot] = kind

    def _refused(self, cell: Cell) -> str:
        """Return why a block cannot be changed, or ""."""
        x, z, y = cell
        blocks = self.land.world.blocks
        last = self.land.world.side - 1
        if not (0 < x < last and 0 < z < last):
            return EDGE
        if y < 1:
            return BOTTOM
        return TOP if y >= blocks.shape[2] - 1 else ""

    def _dug(self, cell: Cell) -> dict[Cell, int] | str:
        """Return what digging a block changes, or why it cannot be dug."""
        if refused := self._refused(cell):
            return refused
        x, z, y = cell
        changed = {cell: AIR}
        if BLOCKS[self.land.world.blocks[x, z, y + 1]].plant:
            changed[x, z, y + 1] = AIR
        return changed

    def _placed(self, hit: Hit, pose: Pose, body: Body | None) -> dict[Cell, int] | str:
        """Return what placing a block changes, or why it cannot be placed."""
        blocks, kind = self.land.world.blocks, self.slots[self.slot]
        # A plant gives way to what is built in its place.
        x, z, y = cell = hit.block if BLOCKS[blocks[hit.block]].plant else hit.before
        if refused := self._refused(cell):
            return refused
        if SOLID[blocks[cell]] or (SOLID[kind] and self._is_in(cell, pose, body)):
            return {}
        if BLOCKS[kind].plant and not SOLID[blocks[x, z, y - 1]]:
            return ROOT
        return {cell: kind}

    def _is_in(self, cell: Cell, pose: Pose, body: Body | None) -> bool:
        """Return whether a walker's body has a part in a cell."""
        assert pose.y is not None
        eye, scale = self.settings.walk.eye, 1 / self.land.scale
        body = body or Body(pose.x, pose.y - eye, pose.z)
        box = bodies.box_of(body.scaled(scale), eye * scale)
        return all(box.low[a] < cell[a] + 1 and box.high[a] > cell[a] for a in range(3))

    def bar(self, height: int, language: str) -> tuple[Hashable, Callable[[], np.ndarray]]:
        """Return what the picture of the bar depends on, and how to make it."""
        self._icons = self._icons or Icons(self._assets)
        shows = self._icons, tuple(self.slots), self.slot, height, language
        return shows, lambda: bar_image(*shows)

    def covered(self, size: tuple[int, int]) -> int:
        """Return how many rows of a window the textures of the passes cover from its lower edge."""
        return covered(size) if self.settings.debug.textures else 0

    @property
    def is_changed(self) -> bool:
        """Whether any block is not as it was at the beginning."""
        return bool(self.land.world.former)

    def _made_from(self) -> dict[str, object]:
        """Return all that the land without changes depends on."""
        values = self.settings.voxel
        made: dict[str, object] = {name: getattr(values, name) for name in MADE_FROM}
        made["seed"] = self._seed
        made["size"] = list(self.land.world.blocks.shape)
        made["height_image"] = content(self._assets.path(values.height_image)).hex()
        return made

    def saved(self) -> bytes:
        """Return the changed blocks, and on what land, as the content of a file."""
        return encoded(self.land.world.changes, self._made_from())

    def restore(self, data: bytes, name: str) -> None:
        """Change blocks as a file's content says, and no others; InputError."""
        self.land.restore(decoded(data, name, self.land.world, self._made_from()))

    def merged(self, base: bytes, theirs: bytes, name: str) -> bytes:
        """Return what :meth:`saved` does with what another walk has changed since ``base``.

        That is ``theirs``, the content of a file named ``name``. InputError if it is not of this
        land, or both have changed the same blocks.
        """
        world, land = self.land.world, self._made_from()
        found, conflicts = merged(
            decoded(base, name, world, land), world.changes, decoded(theirs, name, world, land)
        )
        if conflicts:
            raise InputError(
                "{name}: another walk has changed {conflicts} of the same blocks",
                name=name,
                conflicts=conflicts,
            )
        return encoded(found, land)

    def draw_aim(self, frame: Frame) -> None:
        """Draw the edges of the block under the cross-hair, and the cross-hair."""
        self.draw_aimed_at(frame)
        if "crosshair" in self.shown:
            with drawing("crosshair"):
                draw_crosshair(frame)

    def draw_aimed_at(self, frame: Frame, beyond_water: bool = False) -> None:
        """Draw the edges of the block under the cross-hair, on the eye's side of the surface.

        Those ``beyond_water`` belong into the picture of what is seen through the surface, whose
        matrices are then current.
        """
        hit = self.aimed_at(frame.pose) if "highlight" in self.shown else None
        if hit is None or (beyond_water and not self.refracts):
            return
        level = self.land.world.water
        under = hit.block[2] + 1 <= level
        eye_under = frame.eye_y / self.land.scale < level
        if self.refracts and beyond_water != (under != eye_under):
            return
        plant = BLOCKS[self.land.world.blocks[hit.block]].plant
        with drawing("highlight"):
            draw_highlight(frame, hit.block, self.land.scale, plant)
