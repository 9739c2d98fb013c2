"""The island: owns the elements and draws one frame; the order of drawing is the lesson."""

import functools
from collections.abc import Callable
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from landscape.elements import sun
from landscape.elements.animals.fine_dragon import dragon_class
from landscape.elements.animals.fine_rabbit import rabbit_class
from landscape.elements.grass import Grass
from landscape.elements.ground import clipped
from landscape.elements.map import Map
from landscape.elements.ornate.ornate_castle import castle_class
from landscape.elements.reflection import mirrored
from landscape.elements.sea.foam import Foam
from landscape.elements.sea.query import SeaQuery
from landscape.elements.sea.ring import HorizonRing
from landscape.elements.sea.sea import Sea, reflected, wanted
from landscape.elements.sea.shallows import cut_level
from landscape.elements.sky_box import SkyBox
from landscape.elements.sword import Sword
from landscape.elements.terrain.shadows import ShadowMap
from landscape.elements.terrain.terrain import Terrain, ground_class
from landscape.elements.transparent_elements import TransparentElements
from landscape.elements.water_surface import WaterSurface
from landscape.files.assets import Assets
from landscape.files.cache import recall
from landscape.files.images import read_heights
from landscape.fixes import FIXES
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField, height_field
from landscape.geometry.obstacles import Obstacle
from landscape.gl.calls import begin_pass, gl
from landscape.gl.state import attrib
from landscape.scene import SEED, Moment, Scene, begin_frame
from landscape.settings import PRESETS, Settings
from landscape.views import ALL, MAIN, VIEWS

ELEMENTS = ALL
SPRITES = {"trees", "deer", "plants"}
Element = TypeVar("Element")


class Island:
    """The scene. Needs a current OpenGL context; ``shown`` may be changed between frames."""

    def __init__(
        self,
        settings: Settings,
        assets: Assets,
        seed: int = SEED,
        only: tuple[str, ...] = ELEMENTS,
    ) -> None:
        """Build the elements in ``only``; InputError names a file that cannot be used."""
        self.settings = settings
        self.shown = set(only)
        self._owned: list[Any] = []
        self.water: WaterSurface | Sea | None = None
        self.ring: HorizonRing | None = None
        self.foam: Foam | None = None
        self.sea_query: SeaQuery | None = None
        try:
            self._build(settings, assets, seed)
        except BaseException:
            self.release()
            raise

    def _build(self, settings: Settings, assets: Assets, seed: int) -> None:
        own, only = self._own, self.shown
        light = sun.direction(settings.sun)
        self.ground = own(ground_class(settings)(settings, assets, light))
        field = self.ground.field
        if "water" in only:
            self._build_water(settings, assets, field)
        self.sky = own(SkyBox(settings, assets)) if "sky" in only else None
        self.castle = (
            own(castle_class(settings)(settings, assets, field)) if "castle" in only else None
        )
        self.rabbit = (
            own(rabbit_class(settings)(settings, assets, field)) if "rabbit" in only else None
        )
        self.dragon = own(dragon_class(settings)(settings, assets)) if "dragon" in only else None
        kinds = SPRITES & only
        self.sprites = (
            own(TransparentElements(settings, assets, self.ground, seed, kinds)) if kinds else None
        )
        if settings.ground.shadows and isinstance(self.ground, Terrain):
            self._lay_shadows(self.ground, light, assets, seed)
        self.grass = own(Grass(settings, assets, self.ground, seed)) if "grass" in only else None
        self.sword = own(Sword(settings, assets)) if "sword" in only else None
        self.map = own(Map(settings, assets)) if "map" in only else None

    def _own(self, element: Element) -> Element:
        self._owned.append(element)
        return element

    def _build_water(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """The patches of 2006 or the sea, and what is drawn with either."""
        own, water = self._own, settings.water
        if wanted(settings):
            self.water = own(Sea(settings, assets, field))
        else:
            self.water = own(WaterSurface(settings, assets))
            if water.horizon > 0:
                self.ring = own(HorizonRing(settings, assets))
        if water.foam:
            self.foam = own(Foam(field))
        # A mirror image in the framebuffer must be drawn before the land, so nothing can be asked.
        if water.query and settings.reflection.rippled:
            self.sea_query = own(SeaQuery(settings))

    def _lay_shadows(self, ground: Terrain, light: np.ndarray, assets: Assets, seed: int) -> None:
        """Darken the ground where sprites, castle and rabbit throw their shadows."""

        def shadows() -> tuple[np.ndarray]:
            shadow_map = ShadowMap(ground.field, light, len(ground.large))
            for thing in (self.sprites, self.castle, self.rabbit):
                if thing:
                    thing.cast(shadow_map)
            return (shadow_map.light(),)

        values = self.settings
        groups = [values.ground, values.water, values.sun, values.castle, values.rabbit]
        groups += [values.trees, values.deer, values.plants]
        what = repr((groups, seed, sorted(self.shown)))
        files = values.ground.height_image, values.rabbit.mesh
        ground.shade(*recall((what, *assets.contents(*files)), shadows))

    def apply(self, settings: Settings) -> bool:
        """Take settings that differ in what is read at each frame: fog, reflection, sorting, map.

        What was built from the others (meshes, lists, places drawn by lot) stays as it is.
        """
        self.settings = settings
        for element in self._owned:
            if hasattr(element, "apply"):
                element.apply(settings)
            elif hasattr(element, "_settings"):
                element._settings = settings
        return True

    def draw(self, moment: Moment) -> None:
        """Draw one frame into the current framebuffer."""
        begin_pass("main")
        frame = self._begin(moment)
        settings, shown = self.settings, self._shown
        sprites = shown(self.sprites, *SPRITES)
        water = self.water if "water" in self.shown else None
        # Sorted once for both passes, and when it is first asked for.
        sort = functools.cache(lambda: sprites.prepare(frame) if sprites else None)
        with attrib(gl.GL_POLYGON_BIT):
            gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE if moment.wireframe else gl.GL_FILL)

            # The mirrored scene comes first: the water will be blended over it.
            query = self.sea_query if water else None
            ready = query is None or query.expected(frame)
            if ready:
                self._draw_reflection(frame, sort)

            # Opaque things, in any order as far as the picture goes: the depth buffer sorts them.
            with clipped(cut_level(settings), settings.ground.clip):
                if ground := shown(self.ground, "ground"):
                    ground.draw(frame)
                if rabbit := shown(self.rabbit, "rabbit"):
                    rabbit.draw(frame)
                if dragon := shown(self.dragon, "dragon"):
                    dragon.draw(frame)
            if query:
                query.ask(frame)
            # OpenGL draws what it has while Python sorts, chooses and computes waves.
            gl.glFlush()
            sort()
            if grass := shown(self.grass, "grass"):
                grass.draw(frame)
            # The sky comes after them: the pixels they took need no sky.
            if sky := shown(self.sky, "sky"):
                sky.draw(frame)
            gl.glFlush()

            # Land may hide all of the sea; a mirror image that is a texture can come late.
            if query and not query.shows():
                water = None
            if water and not ready:
                self._draw_reflection(frame, sort)

            # Blended things come last, far to near: the castle with its flames, the water, sprites.
            if castle := shown(self.castle, "castle"):
                castle.draw(frame)
            if water:
                if self.ring:
                    self.ring.draw(frame)
                water.draw(frame)
                if self.foam:
                    self.foam.draw(frame)
            if sprites:
                sprites.draw(frame, sort())

        # What is stuck to the window comes over everything.
        begin_pass("overlay")
        if (sword := shown(self.sword, "sword")) and settings.overlay.sword:
            sword.draw(frame)
        if (map := shown(self.map, "map")) and settings.overlay.map:
            map.draw(frame)

    def _draw_reflection(self, frame: Frame, sort: Callable[[], Any]) -> None:
        """Draw what the water mirrors: ground, sky, sprites, dragon, and the castle if asked."""
        settings, shown = self.settings, self._shown
        if "reflection" not in self.shown or not settings.reflection.enabled:
            return
        begin_pass("reflection")
        frame = replace(frame, mirrored=True)
        water = self.water if "water" in self.shown else None
        with reflected(frame, settings, water) as frame, mirrored(settings):
            if ground := shown(self.ground, "ground"):
                ground.draw(frame)
            if dragon := shown(self.dragon, "dragon"):
                dragon.draw(frame)
            if sky := shown(self.sky, "sky"):
                sky.draw(frame)
            if (castle := shown(self.castle, "castle")) and settings.reflection.castle:
                castle.draw(frame)
            if sprites := shown(self.sprites, *SPRITES):
                gl.glFlush()
                sprites.draw(frame, sort())
        begin_pass("main")

    def _begin(self, moment: Moment) -> Frame:
        """Begin a frame with the island's own camera, sun and fog."""
        values = self.settings
        # The sea reaches farther than anything that stands on the island.
        far = 1.5 * values.water.horizon
        fogged = "fog" in self.shown
        return begin_frame(moment, values.camera, values.sun, values.fog, fogged, far)

    @property
    def size(self) -> float:
        """The side of the map in units."""
        return self.ground.field.size

    def height(self, x: float, z: float) -> float:
        """Return the height of what one stands on at x, z in units: the ground or the water."""
        return float(self.ground.field.height(x, z))

    @property
    def obstacles(self) -> tuple[Obstacle, ...]:
        """What the walker goes round: the castle's walls, the rabbit, the dragon."""
        standing = (self.castle, self.rabbit, self.dragon)
        return tuple(each for element in standing if element for each in element.obstacles())

    def _shown(self, element: Element | None, *names: str) -> Element | None:
        """Return the element if it was built and any of its names is shown now."""
        return None if self.shown.isdisjoint(names) else element

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
    start="fig35e",
    main=MAIN,
    open=Island,
    terrain=terrain,
    fixes=FIXES,
)
