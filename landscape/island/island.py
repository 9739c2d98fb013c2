"""The island of 2006: its elements, and the order in which a frame draws them, which is the lesson.

A blended element must come after what shows through it, and the mirrored scene before the water
that covers it. The rest of the order is for speed.
"""

import functools
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from framelens.base.texts import Texts
from framelens.gl.seam import begin_pass, drawing, gl
from framelens.gl.state import attrib
from landscape.elements import sun
from landscape.elements.best import meadow, sprites, stones
from landscape.elements.best.animals.fine_dragon import dragon_class
from landscape.elements.best.animals.fine_rabbit import FineRabbit, rabbit_class
from landscape.elements.best.castle.ornate_castle import OrnateCastle
from landscape.elements.best.castle.weathered_castle import castle_class
from landscape.elements.best.meadow.meadow import Meadow
from landscape.elements.best.mist.bay_mist import BayMist
from landscape.elements.best.sea import sea
from landscape.elements.best.sea.occlusion_query import SeaQuery
from landscape.elements.best.sea.ring import HorizonRing
from landscape.elements.best.sea.sea import Sea, kept, reflected, softened
from landscape.elements.best.sea.shallows import cut_level, submerged
from landscape.elements.best.sea.under_water import UnderWater
from landscape.elements.best.sprites.refined_sprites import RefinedSprites
from landscape.elements.best.stones.stones import Stones
from landscape.elements.best.sword.steel_blade import sword_class
from landscape.elements.best.terrain.shadows import cast_from, light_is_baked
from landscape.elements.best.terrain.terrain import Terrain, ground_class
from landscape.elements.grass import Grass
from landscape.elements.ground import clipped
from landscape.elements.map import Map
from landscape.elements.planting import trunks
from landscape.elements.reflection import mirrored
from landscape.elements.settings import PRESETS, Settings
from landscape.elements.sky_box import SkyBox
from landscape.elements.support import supported
from landscape.elements.transparent_elements import TransparentElements
from landscape.elements.water_surface import WaterSurface
from landscape.files.assets import Assets
from landscape.files.cache import recall
from landscape.files.images import read_heights
from landscape.frame import Frame
from landscape.geometry.doors import Door
from landscape.geometry.height_field import HeightField, height_field
from landscape.geometry.obstacle_grid import Obstacles
from landscape.geometry.pockets import passable
from landscape.island.fixes import FIXES
from landscape.island.views import ALL, MAIN, VIEWS
from landscape.scene.scene import SEED, Moment, Scene, begin_frame, draw_all_parts

ELEMENTS = ALL
SIGNS: Texts = {"castle": "the door leads into the great hall"}
SOLID = ("castle", "rabbit", "dragon", "sprites", "stones")  # the parts that may stop the walker
SPRITES = ("trees", "deer", "plants")  # one element: all of them must be sorted together


def classes(settings: Settings) -> dict[str, type | None]:
    """Return the class that draws each element: the one of 2006, or one that `best` adds."""
    water = settings.water
    plain_water = not sea.wanted(settings)

    # A mirror image in the framebuffer is drawn before the land: there is nothing to query yet.
    queried = water.query and settings.reflection.rippled
    return {
        "ground": ground_class(settings),
        "stones": Stones if stones.wanted(settings) else None,
        "water": WaterSurface if plain_water else Sea,
        "ring": HorizonRing if plain_water and water.horizon > 0 else None,
        "query": SeaQuery if queried else None,
        "under": UnderWater if water.under else None,
        "castle": castle_class(settings),
        "rabbit": rabbit_class(settings),
        "dragon": dragon_class(settings),
        "sprites": RefinedSprites if sprites.wanted(settings) else TransparentElements,
        "grass": Meadow if meadow.wanted(settings) else Grass,
        "mist": BayMist if settings.mist.enabled else None,
        "sword": sword_class(settings),
    }


class Part(NamedTuple):
    """How an element is built: its attribute of the island, the names it is shown by, and so on.

    ``kind`` is its class, None if it is not wanted, and ``given`` are the arguments of that.
    """

    attribute: str
    names: tuple[str, ...]
    kind: Callable[..., Any] | None
    given: tuple[Any, ...]


class Island:
    """The scene. Needs a current OpenGL context; ``shown`` may be changed between frames."""

    # The elements; None where one is not wanted.
    stones: Any
    water: Any
    ring: Any
    query: Any
    under: Any
    sky: Any
    castle: Any
    rabbit: Any
    dragon: Any
    sprites: Any
    grass: Any
    mist: Any
    sword: Any
    map: Any

    def __init__(
        self,
        settings: Settings,
        assets: Assets,
        seed: int = SEED,
        only: tuple[str, ...] = ELEMENTS,
    ) -> None:
        """Build the elements in ``only``; InputError names a file that cannot be used."""
        self.settings, self.shown = supported(settings), set(only)
        self._only = frozenset(only)
        self._assets = assets
        self._seed = seed
        self._kinds = tuple(name for name in SPRITES if name in only)
        self._owned: list[Any] = []
        try:
            self._build(self.settings)
        except BaseException:
            self.release()
            raise

    def _build(self, settings: Settings) -> None:
        begin_pass("setup")
        light = sun.direction(settings.sun)
        # The ground is always built: everything stands on it.
        with drawing("ground"):
            self.ground = ground_class(settings)(settings, self._assets, light)
            self._owned.append(self.ground)
        for part in self._parts(settings):
            element = self._make(part)
            setattr(self, part.attribute, element)
            if element is not None:
                self._owned.append(element)
            # Shadows are cast by what has been built so far, and darken the grass as well.
            if part.attribute == "sprites" and light_is_baked(settings):
                self._bake_light(self.ground, light)
        self.obstacles = self._obstacles()
        self._stand_in_light()

    def _stand_in_light(self) -> None:
        """Let the rabbit and the stones take the light of the ground they stand on."""
        for element in (self.rabbit, self.stones):
            if isinstance(element, (FineRabbit, Stones)):
                element.stand_in(self.ground)

    def _parts(self, settings: Settings) -> list[Part]:
        """Return all elements but the ground, in the order in which they are built."""
        kind = classes(settings)
        own = (settings, self._assets)
        field = self.ground.field
        depths = [field, "dragon" in self._only] if kind["water"] is Sea else []
        place = *own, self.ground, self._seed
        return [
            Part("stones", ("ground",), kind["stones"], place),
            Part("water", ("water",), kind["water"], (*own, *depths)),
            Part("ring", ("water",), kind["ring"], own),
            Part("query", ("water",), kind["query"], (settings,)),
            Part("under", ("water",), kind["under"], (*own, field)),
            Part("sky", ("sky",), SkyBox, own),
            Part("castle", ("castle",), kind["castle"], (*own, field)),
            Part("rabbit", ("rabbit",), kind["rabbit"], (*own, field)),
            Part("dragon", ("dragon",), kind["dragon"], own),
            Part("sprites", self._kinds, kind["sprites"], (*place, set(self._kinds))),
            Part("grass", ("grass",), kind["grass"], place),
            Part("mist", ("mist",), kind["mist"], (*own, field)),
            Part("sword", ("sword",), kind["sword"], own),
            Part("map", ("map",), Map, (*own, field)),
        ]

    def _make(self, part: Part) -> Any:
        """Build an element if any of its names may be shown; otherwise return None."""
        if part.kind is None or self._only.isdisjoint(part.names):
            return None
        with drawing(*part.names):
            return part.kind(*part.given)

    def _obstacles(self) -> Obstacles:
        """Return what the walker goes around: rabbit, dragon, castle; perhaps trees and stones."""
        standing = (self.rabbit, self.dragon, self.castle)
        few = tuple(each for element in standing if element for each in element.obstacles())
        solid = self.settings.walk.solid
        many = [trunks(self.sprites.sprites)] if solid and self.sprites else []
        many += [self.stones.towers()] if solid and self.stones else []
        return passable(few, many, self.size)

    @drawing("ground")
    def _bake_light(self, ground: Any, light: np.ndarray) -> None:
        """Multiply the ground's texture by the sunlight and the shadows of what stands on it."""
        if not isinstance(ground, Terrain):
            return
        values = self.settings

        def shadows() -> tuple[np.ndarray]:
            shadow_map = ground.shadow_map(light)
            for element in (self.sprites, self.castle, self.rabbit, self.stones):
                if element and values.ground.shadows:
                    element.cast(shadow_map)
            left = np.array(values.sun.shade, np.float32)
            return (shadow_map.light(ground.open_light(shadow_map.side), left),)

        what = repr((cast_from(values), self._seed, sorted(self._only)))
        files = values.ground.height_image, values.rabbit.mesh, stones.FILE
        ground.shade(*recall((what, *self._assets.contents(*files)), shadows))

    def apply(self, settings: Settings) -> bool:
        """Apply settings, building again only the elements that cannot take them.

        Return False, changing nothing, if the ground must be built again, on which all of them
        stand. InputError as when the island is opened.
        """
        settings = supported(settings)
        same_ground = ground_class(settings) is type(self.ground)
        other_light = cast_from(settings) != cast_from(self.settings)
        if not same_ground or other_light or not self.ground.apply(settings):
            return False
        taken, built = [self.ground], {}
        begin_pass("setup")
        try:
            for part in self._parts(settings):
                element = getattr(self, part.attribute)
                if type(element) is part.kind and element.apply(settings):
                    taken.append(element)
                else:
                    built[part.attribute] = self._make(part)
        except BaseException:
            for element in built.values():
                if element is not None:
                    element.release()
            for element in taken:
                element.apply(self.settings)
            raise

        for attribute, element in built.items():
            former = getattr(self, attribute)
            setattr(self, attribute, element)
            if former is not None:
                self._owned.remove(former)
                former.release()
            if element is not None:
                self._owned.append(element)

        solid = settings.walk.solid != self.settings.walk.solid
        self.settings = settings
        if solid or not built.keys().isdisjoint(SOLID):
            self.obstacles = self._obstacles()
        self._stand_in_light()
        return True

    def draw(self, moment: Moment) -> None:
        """Draw one frame into the current framebuffer."""
        draw_all_parts(self, moment)

    def parts(self, moment: Moment) -> Iterator[Frame]:
        """Draw one frame but for sword and map, and yield it after each part."""
        frame = self._begin(moment)
        below = self.under is not None and "water" in self.shown and submerged(frame, self.settings)
        with attrib(gl.GL_POLYGON_BIT):
            gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE if moment.wireframe else gl.GL_FILL)
            if below:
                self._draw_under_water(frame)
            else:
                for _ in self._draw_outdoors(frame):
                    yield frame
        yield frame

    def draw_overlay(self, frame: Frame) -> None:
        """Draw sword and map, which cover everything."""
        begin_pass("overlay")
        values = self.settings
        if values.overlay.sword:
            self._draw("sword", self.sword, frame)
        if values.overlay.map:
            self._draw("map", self.map, frame)

    def _draw_under_water(self, frame: Frame) -> None:
        """Draw what an eye below the surface sees: bed, dragon, net of light, the surface."""
        under = self.under
        with under.around(frame):
            with under.mirroring(frame) as smaller:
                self._draw_swimming(smaller)
            self._draw_swimming(frame)
            self._draw("water", under, frame)

    def _draw_swimming(self, frame: Frame) -> None:
        """Draw bed and dragon, and the net of light over them."""
        draw, under = self._draw, self.under
        draw("ground", self.stones, frame)
        draw("ground", self.ground, frame)
        draw("dragon", self.dragon, frame)
        if isinstance(self.ground, Terrain):
            with drawing("water"):
                under.lay_net(frame, lambda: draw("ground", self.ground, frame, "send"))
        if self.dragon is not None:
            with drawing("water"):
                under.lay_net(frame, lambda: draw("dragon", self.dragon, frame, "send"))

    def _draw_outdoors(self, frame: Frame) -> Iterator[None]:
        """Draw what an eye above the water sees, in parts that take about as long."""
        draw, values = self._draw, self.settings
        # Sorted once for both passes, when first needed.
        sort = functools.cache(lambda: self.sprites.prepare(frame))
        query = self.query if "water" in self.shown else None

        # The mirrored scene comes first: the water will be blended over it.
        early = query is None or query.expected(frame)
        if early:
            self._draw_reflection(frame, sort)
            yield

        # Opaque elements: the depth buffer sorts them, so their order does not matter.
        if in_parts := isinstance(self.castle, OrnateCastle):
            draw("castle", self.castle, frame, "draw_solid")
        with clipped(cut_level(values), values.ground.clip):
            draw("ground", self.stones, frame)  # first: cheaper than the ground behind
            draw("ground", self.ground, frame)
            draw("rabbit", self.rabbit, frame)
            draw("dragon", self.dragon, frame)
        if query:
            with drawing("water"):
                query.ask(frame)
        # OpenGL executes the calls so far while Python sorts, selects blades, computes waves.
        gl.glFlush()
        yield
        if self._sprites_shown:
            sort()
        draw("grass", self.grass, frame)
        # The sky comes last of the opaque elements: it is not drawn where they cover it.
        draw("sky", self.sky, frame)
        gl.glFlush()
        yield

        # Land may hide all of the sea; a mirror image that is a texture can be drawn this late.
        water = query is None or query.shows()
        if water and not early:
            self._draw_reflection(frame, sort)

        # Blended elements: the castle with its flames, the water over the mirrored scene, the
        # mist on it, and the sprites from far to near.
        draw("castle", self.castle, frame, "draw_rest" if in_parts else "draw")
        if water:
            draw("water", self.ring, frame)
            draw("water", self.water, frame)
        draw("mist", self.mist, frame)
        yield
        self._draw_sprites(frame, sort)

    def _draw_reflection(self, frame: Frame, sort: Callable[[], Any]) -> None:
        """Draw what the water mirrors: ground, dragon, sky, sprites, and the castle if wanted."""
        draw, values = self._draw, self.settings
        if "reflection" not in self.shown or not values.reflection.enabled:
            return
        water = self.water if "water" in self.shown else None
        if kept(frame, values, water):
            return
        begin_pass("reflection")
        frame = replace(frame, mirrored=True)
        with reflected(frame, values, water) as frame, mirrored(values):
            draw("ground", self.stones, frame)
            draw("ground", self.ground, frame)
            draw("dragon", self.dragon, frame)
            with softened(values):
                draw("sky", self.sky, frame)
            if values.reflection.castle:
                draw("castle", self.castle, frame)
            if self._sprites_shown:
                gl.glFlush()
            self._draw_sprites(frame, sort)

        begin_pass("main")

    def _begin(self, moment: Moment) -> Frame:
        """Begin a frame with the island's own camera, sun and fog."""
        values = self.settings
        # The sea reaches farther than anything that stands on the island.
        far = 1.5 * values.water.horizon
        return begin_frame(moment, values.camera, values.sun, values.fog, "fog" in self.shown, far)

    def _draw(self, name: str, element: Any, frame: Frame, how: str = "draw") -> None:
        """Draw an element, or the part of it that ``how`` draws, if it was built and is shown."""
        if element is not None and name in self.shown:
            with drawing(name):
                getattr(element, how)(frame)

    @property
    def _sprites_shown(self) -> bool:
        return self.sprites is not None and not self.shown.isdisjoint(SPRITES)

    def _draw_sprites(self, frame: Frame, sort: Callable[[], Any]) -> None:
        if self._sprites_shown:
            with drawing(*self._kinds):
                self.sprites.draw(frame, sort())

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
        while self._owned:
            self._owned.pop().release()


def terrain(settings: Settings, assets: Assets) -> HeightField:
    """Return the island's heights, without OpenGL."""
    path = assets.path(settings.ground.height_image, "ground.height_image")
    return height_field(read_heights(path), settings.ground, settings.water.level)


SCENE = Scene(
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
)
