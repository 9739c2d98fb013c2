"""The island: owns the elements and draws one frame; the order of drawing is the lesson."""

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from landscape.elements import fog, meadow, sprites, sun
from landscape.elements.castle import Castle
from landscape.elements.dragon import Dragon
from landscape.elements.grass import Grass
from landscape.elements.ground import Ground, clipped
from landscape.elements.map import Map
from landscape.elements.meadow.meadow import Meadow
from landscape.elements.rabbit import Rabbit
from landscape.elements.reflection import mirrored, reflected
from landscape.elements.sea.waves import cut_level
from landscape.elements.sky_box import SkyBox
from landscape.elements.sprites.refined_sprites import RefinedSprites
from landscape.elements.sword import Sword
from landscape.elements.terrain.shadows import ShadowMap
from landscape.elements.transparent_elements import TransparentElements
from landscape.elements.water_surface import WaterSurface
from landscape.files.assets import Assets
from landscape.files.cache import recall
from landscape.frame import Frame, Pose
from landscape.gl.calls import begin_pass, gl
from landscape.gl.state import attrib
from landscape.settings import Settings

ELEMENTS = (
    "ground", "water", "sky", "trees", "deer", "plants", "grass", "castle", "rabbit", "dragon",
    "sword", "map", "fog", "reflection",
)  # fmt: skip
SPRITES = {"trees", "deer", "plants"}
SEED = 2006  # chosen: the year of the report
Element = TypeVar("Element")


@dataclass(frozen=True)
class Moment:
    """What a frame shows: pose, size in pixels, kt, the walker's step and sword stroke (0 to 4)."""

    pose: Pose
    size: tuple[int, int]
    kt: float = 0.0
    step: float = 0.0
    stroke: int = 0
    wireframe: bool = False


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
        try:
            self._build(settings, assets, seed)
        except BaseException:
            self.release()
            raise

    def _build(self, settings: Settings, assets: Assets, seed: int) -> None:
        def own(element: Element) -> Element:
            self._owned.append(element)
            return element

        only = self.shown
        light = sun.direction(settings.sun)
        self.ground = own(Ground(settings, assets, light))
        field = self.ground.field
        self.water = own(WaterSurface(settings, assets, field)) if "water" in only else None
        self.sky = own(SkyBox(settings, assets)) if "sky" in only else None
        self.castle = own(Castle(settings, assets, field)) if "castle" in only else None
        self.rabbit = own(Rabbit(settings, assets, field)) if "rabbit" in only else None
        self.dragon = own(Dragon(settings, assets)) if "dragon" in only else None
        kinds = SPRITES & only
        self.sprites: Any = None
        if kinds:
            trees = RefinedSprites if sprites.wanted(settings) else TransparentElements
            self.sprites = own(trees(settings, assets, self.ground, seed, kinds))
        if settings.ground.shadows:
            self._lay_shadows(light, assets, seed)
        self.grass: Any = None
        if "grass" in only:
            blades = Meadow if meadow.wanted(settings) else Grass
            self.grass = own(blades(settings, assets, self.ground, seed))
        self.sword = own(Sword(settings, assets)) if "sword" in only else None
        self.map = own(Map(settings, assets)) if "map" in only else None

    def _lay_shadows(self, light: np.ndarray, assets: Assets, seed: int) -> None:
        """Darken the ground where sprites, castle and rabbit throw their shadows."""

        def shadows() -> tuple[np.ndarray]:
            shadow_map = ShadowMap(self.ground.field, light, len(self.ground.large))
            for thing in (self.sprites, self.castle, self.rabbit):
                if thing:
                    thing.cast(shadow_map)
            return (shadow_map.light(),)

        values = self.settings
        groups = [values.ground, values.water, values.sun, values.castle, values.rabbit]
        groups += [values.trees, values.deer, values.plants]
        what = repr((groups, seed, sorted(self.shown)))
        files = values.ground.height_image, values.rabbit.mesh
        self.ground.shade(*recall((what, *assets.contents(*files)), shadows))

    def apply(self, settings: Settings) -> None:
        """Take settings that differ in what is read at each frame: fog, reflection, sorting, map.

        What was built from the others (meshes, lists, places drawn by lot) stays as it is.
        """
        self.settings = settings
        for element in self._owned:
            if hasattr(element, "apply"):
                element.apply(settings)
            elif hasattr(element, "_settings"):
                element._settings = settings

    def draw(self, moment: Moment) -> None:
        """Draw one frame into the current framebuffer."""
        begin_pass("main")
        frame = self.begin(moment)
        settings, shown = self.settings, self._shown
        sprites, water = shown(self.sprites, *SPRITES), shown(self.water, "water")
        # Sorted once for both passes, and when it is first asked for.
        sort = functools.cache(lambda: sprites.prepare(frame) if sprites else None)
        with attrib(gl.GL_POLYGON_BIT):
            gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE if moment.wireframe else gl.GL_FILL)

            # The mirrored scene comes first: the water will be blended over it.
            ready = water is None or water.expected(frame)
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
            if water:
                water.ask(frame)
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
            water = water if water and water.shows() else None
            if water and not ready:
                self._draw_reflection(frame, sort)

            # Blended things come last, far to near: the castle with its flames, the water, sprites.
            if castle := shown(self.castle, "castle"):
                castle.draw(frame)
            if water:
                water.draw(frame)
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
        water = shown(self.water, "water")
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

    def begin(self, moment: Moment) -> Frame:
        """Clear, set the viewport, the camera, the sun and the fog; return what elements need."""
        camera, pose = self.settings.camera, moment.pose
        gl.glViewport(0, 0, *moment.size)
        gl.glClearColor(*self.settings.fog.color, 1.0)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glLoadIdentity()
        top = camera.near * math.tan(math.radians(camera.fov) / 2)
        right = top * moment.size[0] / moment.size[1]
        far = max(camera.far, 2 * camera.near, 1.5 * self.settings.water.horizon)
        gl.glFrustum(-right, right, -top, top, camera.near, far)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glLoadIdentity()
        gl.glRotatef(-pose.pitch, 1.0, 0.0, 0.0)
        gl.glRotatef(pose.yaw, 0.0, 1.0, 0.0)
        gl.glTranslatef(-pose.x, -pose.y, -pose.z)

        sun.shine(self.settings.sun)
        if "fog" in self.shown and self.settings.fog.enabled:
            fog.enable(self.settings.fog)
        else:
            gl.glDisable(gl.GL_FOG)
        modelview = np.array(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX), np.float64).ravel()
        return Frame(
            pose, moment.size, moment.kt, modelview, camera.fov, moment.step, moment.stroke
        )

    def _shown(self, element: Element | None, *names: str) -> Element | None:
        """Return the element if it was built and any of its names is shown now."""
        return None if self.shown.isdisjoint(names) else element

    def release(self) -> None:
        """Release the elements, last built first; may be called twice."""
        while self._owned:
            self._owned.pop().release()
