"""The island of 2006: its elements, and the order in which a frame draws them, which is the lesson.

A blended element must come after what shows through it, and the mirrored scene before the water
that covers it. The rest of the order is for speed.
"""

import functools
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from framelens.base.texts import Texts
from framelens.gl.seam import begin_pass, drawing, gl
from framelens.gl.state import attrib
from landscape.elements import sun
from landscape.elements.best import stones
from landscape.elements.best.animals.fine_dragon import FineDragon
from landscape.elements.best.animals.fine_rabbit import FineRabbit
from landscape.elements.best.castle.ornate_castle import OrnateCastle
from landscape.elements.best.sea.occlusion_query import SeaQuery
from landscape.elements.best.sea.sea import Sea, kept, reflected, softened
from landscape.elements.best.sea.shallows import cut_level, submerged
from landscape.elements.best.sea.under_water import UnderWater
from landscape.elements.best.sprites.refined_sprites import RefinedSprites
from landscape.elements.best.stones.stones import Stones
from landscape.elements.best.terrain.casts import cast_animal, cast_castle
from landscape.elements.best.terrain.shadows import ShadowMap, cast_from, light_is_baked
from landscape.elements.best.terrain.terrain import Terrain
from landscape.elements.castle import Castle
from landscape.elements.dragon import Dragon
from landscape.elements.element import Elements, OfElements
from landscape.elements.ground import Ground, clipped
from landscape.elements.planting import trunks
from landscape.elements.rabbit import Rabbit
from landscape.elements.reflection import mirrored
from landscape.elements.settings import PRESETS, Settings
from landscape.elements.support import supported
from landscape.elements.transparent_elements import SPRITES, TransparentElements
from landscape.elements.water_surface import WaterSurface
from landscape.files.assets import Assets
from landscape.files.cache import recall
from landscape.files.images import read_heights
from landscape.frame import SEED, Frame
from landscape.geometry.doors import Door
from landscape.geometry.height_field import HeightField, height_field
from landscape.geometry.obstacle_grid import Obstacles
from landscape.geometry.pockets import passable
from landscape.island.fixes import FIXES
from landscape.island.slots import CASTING, OTHERS, PLANTED, SLOTS
from landscape.island.sounds import island_sounds
from landscape.island.views import ALL, MAIN, VIEWS
from landscape.scene.scene import Moment, SceneOf, begin_frame

Sort = Callable[[], tuple[np.ndarray, ...] | None]  # what sorts the sprites, once a frame
ELEMENTS = ALL
SIGNS: Texts = {"castle": "the door leads into the great hall"}
SOLID = ("castle", "rabbit", "dragon", "sprites", "stones")  # the parts that may stop the walker


class Island(OfElements[Settings]):
    """The scene. Needs a current OpenGL context; ``shown`` may be changed between frames."""

    def __init__(
        self,
        settings: Settings,
        assets: Assets,
        seed: int = SEED,
        only: tuple[str, ...] = ELEMENTS,
    ) -> None:
        """Build the elements in ``only``; InputError names a file that cannot be used."""
        self.settings = supported(settings)
        self._assets, self._seed = assets, seed
        self._only = frozenset(only)
        self.elements = Elements(self.settings, assets, seed, only)
        sprites = tuple(name for name in SPRITES if name in only)
        with self.elements.building():
            for slot in CASTING:
                self.elements.build(replace(slot, shown_by=sprites) if slot is PLANTED else slot)
            if light_is_baked(self.settings):
                self._bake_light()
            self.elements.build(*OTHERS)
            self.obstacles = self._obstacles()
            self._stand_in_light()

    @property
    def ground(self) -> Ground:
        """The ground, on which everything stands."""
        return self.elements[Ground]

    @property
    def castle(self) -> Castle | None:
        """The castle, if it was built."""
        return self.elements.get(Castle)

    @property
    def stones(self) -> Stones | None:
        """The stones, if they were built."""
        return self.elements.get(Stones)

    @property
    def sprites(self) -> RefinedSprites | TransparentElements | None:
        """Trees, deer and plants, if any of them was built."""
        return self.elements.get(RefinedSprites) or self.elements.get(TransparentElements)

    @property
    def _water(self) -> Sea | WaterSurface | None:
        """The water, if it was built and is shown."""
        if "water" not in self.shown:
            return None
        return self.elements.get(Sea) or self.elements.get(WaterSurface)

    def _stand_in_light(self) -> None:
        """Let the rabbit and the stones take the light of the ground they stand on."""
        for element in (self.elements.get(FineRabbit), self.stones):
            if element is not None:
                element.stand_in(self.ground)

    def _obstacles(self) -> Obstacles:
        """Return what the walker goes around: rabbit, dragon, castle; perhaps trees and stones."""
        standing = self._rabbit, self._dragon, self.castle
        few = tuple(each for element in standing if element for each in element.obstacles())
        solid = self.settings.walk.solid
        many = [trunks(self.sprites.sprites)] if solid and self.sprites else []
        many += [self.stones.towers()] if solid and self.stones else []
        return passable(few, many, self.size)

    @drawing("ground")
    def _bake_light(self) -> None:
        """Multiply the ground's texture by the sunlight and the shadows of what stands on it."""
        ground = self.elements.get(Terrain)
        if ground is None:
            return
        values = self.settings
        light = sun.direction(values.sun)

        def light_map() -> tuple[np.ndarray]:
            shadow_map = ground.shadow_map(light)
            if values.ground.shadows:
                self._cast_shadows(shadow_map)
            left = np.array(values.sun.shade, np.float32)
            return (shadow_map.light(ground.open_light(shadow_map.side), left),)

        what = repr((cast_from(values), self._seed, sorted(self._only)))
        files = values.ground.height_image, values.rabbit.mesh, stones.FILE
        ground.shade(*recall((what, *self._assets.contents(*files)), light_map))

    def _cast_shadows(self, shadows: ShadowMap) -> None:
        """Cast the shadows of what stands on the ground."""
        sprites = self.elements.get(RefinedSprites)
        if sprites is not None:
            sprites.cast(shadows)
        if self.castle is not None:
            cast_castle(self.castle, shadows)
        if self._rabbit is not None:
            cast_animal(self._rabbit, shadows)
        if self.stones is not None:
            self.stones.cast(shadows)

    def apply(self, settings: Settings) -> bool:
        """Apply settings, building again only the elements that cannot take them.

        Return False, changing nothing, if the ground must be built again, on which all of them
        stand. InputError as when the island is opened.
        """
        settings = supported(settings)
        if cast_from(settings) != cast_from(self.settings):
            return False
        filled = self.elements.apply(settings)
        if filled is None:
            return False
        solid = settings.walk.solid != self.settings.walk.solid
        self.settings = settings
        if solid or any(name in filled for name in SOLID):
            self.obstacles = self._obstacles()
        self._stand_in_light()
        return True

    def draw(self, moment: Moment) -> None:
        """Draw one frame into the current framebuffer."""
        frame = self._begin(moment)
        values = self.settings
        under = self.elements.get(UnderWater) if "water" in self.shown else None
        with attrib(gl.GL_POLYGON_BIT):
            gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE if moment.wireframe else gl.GL_FILL)
            if under and submerged(frame, values):
                self._draw_under_water(frame, under)
            else:
                self._draw_outdoors(frame)

        # The overlay covers everything.
        begin_pass("overlay")
        if values.overlay.sword:
            self.elements.draw("sword", frame)
        if values.overlay.map:
            self.elements.draw("map", frame)

    def _draw_under_water(self, frame: Frame, under: UnderWater) -> None:
        """Draw what an eye below the surface sees: bed, dragon, net of light, the surface."""
        with under.around(frame):
            with under.mirroring(frame) as smaller:
                self._draw_swimming(smaller, under)
            self._draw_swimming(frame, under)
            self.elements.draw("under", frame)

    def _draw_swimming(self, frame: Frame, under: UnderWater) -> None:
        """Draw bed and dragon, and the net of light over them."""
        draw = self.elements.draw
        terrain = self.elements.get(Terrain)
        dragon = self._dragon
        draw("stones", frame)
        draw("ground", frame)
        draw("dragon", frame)
        self._draw_membranes(frame)
        if terrain is not None:
            with drawing("water"):
                under.lay_net(frame, lambda: draw("ground", frame, terrain.send))
        if dragon is not None:
            with drawing("water"):
                under.lay_net(frame, lambda: draw("dragon", frame, dragon.send))

    def _draw_outdoors(self, frame: Frame) -> None:
        """Draw what an eye above the water sees."""
        draw, values = self.elements.draw, self.settings
        # Sorted once for both passes, when first needed.
        sort = functools.cache(lambda: self._prepared(frame))
        query = self.elements.get(SeaQuery) if "water" in self.shown else None

        # The mirrored scene comes first: the water will be blended over it.
        early = query is None or query.expected(frame)
        if early:
            self._draw_reflection(frame, sort)

        # Opaque elements: the depth buffer sorts them, so their order does not matter.
        ornate = self.elements.get(OrnateCastle)
        if ornate:
            draw("castle", frame, ornate.draw_solid)
        with clipped(cut_level(values), values.ground.clip):
            draw("stones", frame)  # first: cheaper than the ground behind
            draw("ground", frame)
            draw("rabbit", frame)
            draw("dragon", frame)
        if query:
            with drawing("water"):
                query.ask(frame)
        # OpenGL executes the calls so far while Python sorts, selects blades, computes waves.
        gl.glFlush()
        if self._sprites_shown:
            sort()
        draw("grass", frame)
        # The sky comes last of the opaque elements: it is not drawn where they cover it.
        draw("sky", frame)
        gl.glFlush()

        # Land may hide all of the sea; a mirror image that is a texture can be drawn this late.
        water = query is None or query.shows()
        if water and not early:
            self._draw_reflection(frame, sort)

        # Blended elements: the castle with its flames, the water over the mirrored scene, the
        # mist on it, and the sprites from far to near.
        draw("castle", frame, ornate.draw_rest if ornate else None)
        if water:
            draw("ring", frame)
            draw("water", frame)
        self._draw_membranes(frame)
        draw("mist", frame)
        self._draw_sprites(frame, sort)

    def _draw_reflection(self, frame: Frame, sort: Sort) -> None:
        """Draw what the water mirrors: ground, dragon, sky, sprites, and the castle if wanted."""
        draw, values = self.elements.draw, self.settings
        if "reflection" not in self.shown or not values.reflection.enabled:
            return
        water = self._water
        if kept(frame, values, water):
            return
        begin_pass("reflection")
        frame = replace(frame, mirrored=True)
        with reflected(frame, values, water) as frame, mirrored(values):
            draw("stones", frame)
            draw("ground", frame)
            draw("dragon", frame)
            with softened(values):
                draw("sky", frame)
            self._draw_membranes(frame)
            if values.reflection.castle:
                draw("castle", frame)
            if self._sprites_shown:
                gl.glFlush()
            self._draw_sprites(frame, sort)

        begin_pass("main")

    def _draw_membranes(self, frame: Frame) -> None:
        """Blend the dragon's membranes, where it has them, over what is behind."""
        dragon = self.elements.get(FineDragon)
        if dragon is not None:
            self.elements.draw("dragon", frame, dragon.draw_membranes)

    def _begin(self, moment: Moment) -> Frame:
        """Begin a frame with the island's own camera, sun and fog."""
        values = self.settings
        # The sea reaches farther than anything that stands on the island.
        far = 1.5 * values.water.horizon
        return begin_frame(moment, values.camera, values.sun, values.fog, "fog" in self.shown, far)

    @property
    def _rabbit(self) -> Rabbit | FineRabbit | None:
        return self.elements.get(Rabbit) or self.elements.get(FineRabbit)

    @property
    def _dragon(self) -> Dragon | FineDragon | None:
        return self.elements.get(Dragon) or self.elements.get(FineDragon)

    @property
    def _sprites_shown(self) -> bool:
        return self.sprites is not None and not self.shown.isdisjoint(SPRITES)

    def _prepared(self, frame: Frame) -> tuple[np.ndarray, ...] | None:
        """Return the sprites in view from far to near, if there are any sprites."""
        return self.sprites.prepare(frame) if self.sprites else None

    def _draw_sprites(self, frame: Frame, sort: Sort) -> None:
        sprites = self.sprites
        if sprites is not None:
            self.elements.draw("sprites", frame, lambda frame: sprites.draw(frame, sort()))

    @property
    def doors(self) -> tuple[Door, ...]:
        """The castle's door."""
        leads = "hall", "door", SIGNS["castle"]
        return (self.castle.door(*leads),) if self.castle is not None else ()

    @property
    def size(self) -> float:
        """The side of the map in units."""
        return self.ground.size

    def height(self, x: float, z: float) -> float:
        """Return the height of what one stands on at x, z in units: the ground or the water."""
        return float(self.ground.height(x, z))

    def bed(self, x: float, z: float) -> float:
        """Return the height of the sea's bed at x, z in units; of the water where none can dive."""
        dives = self.settings.water.under
        return float(self.ground.terrain_height(x, z)) if dives else self.height(x, z)

    def depth(self, x: float, z: float) -> float:
        """Return the water's depth at x, z in units, 0 on land."""
        return float(self.ground.field.depth(x, z))

    def release(self) -> None:
        """Release the elements, last built first; may be called twice."""
        self.elements.release()


def terrain(settings: Settings, assets: Assets) -> HeightField:
    """Return the island's heights, without OpenGL."""
    path = assets.path(settings.ground.height_image, "ground.height_image")
    return height_field(read_heights(path), settings.ground, settings.water.level)


SCENE = SceneOf(
    name="island",
    elements=ELEMENTS,
    views=VIEWS,
    settings=Settings(),
    presets=PRESETS,
    preset="best",
    start="hill",
    main=MAIN,
    open=Island,
    terrain=terrain,
    fixes=FIXES,
    overlay=("sword", "map"),
    title="the island",
    slots=SLOTS,
    sounds=island_sounds,
)
