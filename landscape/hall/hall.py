"""The great hall: its elements, and the order in which a frame draws them, which is the lesson."""

from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from typing import Any

from framelens.gl.extensions import has_stencil
from framelens.gl.seam import begin_pass, drawing, gl
from framelens.gl.state import attrib
from landscape.elements import sun
from landscape.elements.sword import Sword
from landscape.files.assets import Assets
from landscape.frame import Frame, Pose
from landscape.geometry.obstacles import Obstacle, Tower, Wall
from landscape.hall import plan
from landscape.hall.casters import Casters
from landscape.hall.caustics import Caustics
from landscape.hall.digits import KEYS, carried
from landscape.hall.entrance import Entrance, door
from landscape.hall.exhibits.cabinet import Cabinet
from landscape.hall.flight import Flight
from landscape.hall.mirror import Mirror
from landscape.hall.mist import Mist
from landscape.hall.moving_sky import MovingSky
from landscape.hall.planar_shadow import PlanarShadow, on_floor, on_north
from landscape.hall.pool import Pool
from landscape.hall.room import Room
from landscape.hall.safeguards import SAFEGUARDS
from landscape.hall.settings import PRESETS, Settings
from landscape.hall.shafts import Shafts
from landscape.hall.statue import Statue
from landscape.hall.tone import Tone
from landscape.hall.torches import Torches
from landscape.hall.views import ELEMENTS, HELD, MAIN, STANDING, VIEWS
from landscape.scene.scene import Moment, Scene, View, begin_frame

IN_STENCIL = "mirror, shadow, exhibits.solids, exhibits.volume, tone.area"
NOTHING = -10.0  # units, chosen: so that a view may look at the hall from below
FAR_FROM_WALL = 1.5  # chosen: z from which the floor mirrors too little of the north wall
TALL = 10.0  # units: these obstacles cannot be flown over
OVER_POOL = 0.15  # units, chosen: height from which one flies over the pool; higher than the eye


class Ground:
    """What a walker stands on: the floor; needs no OpenGL."""

    size = plan.SIZE

    def height(self, x: float, z: float) -> float:
        """Return the floor's height in units; beyond the square there is nothing to stand on."""
        return 0.0 if 0.0 <= x <= self.size and 0.0 <= z <= self.size else NOTHING


class Hall(Ground):
    """The scene. Needs a current OpenGL context; ``shown`` may be changed between frames."""

    def __init__(
        self, settings: Settings, assets: Assets, seed: int, only: tuple[str, ...] = STANDING
    ) -> None:
        """Build the elements in ``only``; InputError names a file that cannot be used."""
        self.settings, self.shown = settings, set(only)
        self._owned: list[Any] = []
        self.shadow: PlanarShadow | None = None
        self.casters: Casters | None = None
        try:
            begin_pass("setup")
            self.room = self._built(("room", "floor", "caustics"), Room, settings, assets)
            self.caustics = self._built(("caustics",), Caustics, settings, assets, self.room)
            self.pool = self._built(("pool",), Pool, settings, assets)
            stencil = has_stencil(IN_STENCIL)
            self.mirror: Any = None
            if stencil:
                self.mirror = self._built(("mirror",), Mirror, settings)
            self.entrance = self._built(("door",), Entrance, settings, assets)
            self.statue = self._built(("statue",), Statue, settings, assets)
            if self.statue and stencil:
                shadowing = settings, self._cast, self.statue.box
                self.shadow = self._built(("shadow",), PlanarShadow, *shadowing)
                self.casters = Casters()
            self.sky = self._built(("sky",), MovingSky, settings, assets)
            self.exhibits = self._built(("exhibits",), Cabinet, settings, assets, stencil)
            self.torches = self._built(("torches",), Torches, settings, assets)
            self.shafts = self._built(("shafts",), Shafts, settings)
            self.mist = self._built(("mist",), Mist, settings, assets)
            self.tone = self._built(("tone",), Tone, settings, assets, stencil)
            self.flight = self._built(("flight",), Flight, settings, assets)
            self.sword = self._built(("sword",), Sword, settings, assets)
            if self.statue and self.room:
                with drawing("statue"):
                    self.statue.gild(self._draw_surroundings)
            if self.pool and self.room:
                with drawing("pool"):
                    self.pool.reflect(self._draw_over_pool)
        except BaseException:
            self.release()
            raise

        self.obstacles, self.doors = obstacles(), (door(),)

    def _built(self, names: tuple[str, ...], kind: type, *given: Any) -> Any:
        """Build an element if any of its names may be shown; otherwise return None."""
        if self.shown.isdisjoint(names):
            return None
        with drawing(*names):
            element = kind(*given)
        self._owned.append(element)
        return element

    def apply(self, settings: Settings) -> bool:
        """Apply settings; return False, changing nothing, if an element must be built again."""
        taken: list[Any] = []
        for element in self._owned:
            if not element.apply(settings):
                for each in taken:
                    each.apply(self.settings)
                return False
            taken.append(element)
        self.settings = settings
        return True

    def eye(self, walker: Pose, kt: float) -> Pose:
        """Return from where the hall is seen: the flying camera's pose, or the walker's."""
        flying = self.settings.flight.enabled and "flight" in self.shown
        return self.flight.pose(kt) if flying else walker

    def draw(self, moment: Moment) -> None:
        """Draw one frame into the current framebuffer."""
        values = self.settings
        moment = replace(moment, pose=self.eye(moment.pose, moment.kt))
        frame = begin_frame(moment, values.camera, values.sun, values.fog)
        dimmed = "tone" in self.shown and values.tone.area == "surroundings"
        with attrib(gl.GL_POLYGON_BIT):
            gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE if moment.wireframe else gl.GL_FILL)
            self._draw_hall(frame)
            gl.glFlush()
            self._draw_image(frame)
            gl.glFlush()
            self._draw_floor(frame)
            self._draw_basin(frame)  # after the image, which would have to be drawn through it
            # The net of light is blended over the stone.
            self._draw("caustics", self.caustics, frame)
            gl.glFlush()
            self._draw("pool", self.pool, frame)  # blended over its bed

            # Blended: each after all that is opaque behind it.
            if not dimmed:
                self._draw("torches", self.torches, frame)
            self._draw("shafts", self.shafts, frame)
            self._draw("mist", self.mist, frame)

        # What has been drawn so far is the picture that these change.
        begin_pass("picture")
        self._draw("tone", self.tone, frame)
        if dimmed:
            self._draw("torches", self.torches, frame)  # flames shine as before

        begin_pass("overlay")
        if not values.flight.enabled:
            self._draw("sword", self.sword, frame)

    def _draw_hall(self, frame: Frame) -> None:
        """Draw what stands in the hall: in the frame itself, and mirrored in the floor."""
        if self.exhibits is not None and "exhibits" in self.shown:
            with drawing("exhibits"):
                self.exhibits.draw_first(frame)  # needs an empty depth buffer
        self._draw("room", self.room, frame)

        # OpenGL executes the calls so far while Python goes on; so below.
        gl.glFlush()
        if frame.mirrored and not self.settings.mirror.clip:
            self._draw_basin(frame)
        self._draw("door", self.entrance, frame)
        self._draw("exhibits", self.exhibits, frame)
        with self._marking(frame):
            self._draw("statue", self.statue, frame)
        self._shade_wall(frame)
        self._draw("sky", self.sky, frame)
        if frame.mirrored:
            self._draw("torches", self.torches, frame)
        values = self.settings
        if values.flight.path and not values.flight.enabled:
            self._draw("flight", self.flight, frame)

    def _marking(self, frame: Frame) -> AbstractContextManager[None]:
        """Let what is drawn be marked for the change of tone, if that needs it."""
        if self.tone is None or "tone" not in self.shown or frame.mirrored:
            return nullcontext()
        return self.tone.marking()  # type: ignore[no-any-return]

    def _draw_basin(self, frame: Frame) -> None:
        """Draw the pool's bed and sides, with the caustics on them if that takes one pass."""
        if "room" not in self.shown:
            return
        shine = self.caustics if "caustics" in self.shown else None
        with drawing("room"):
            if shine and shine.in_one_pass:
                with shine.while_drawn(frame):
                    self.room.draw_pool(self.settings.caustics.sunlit)
            else:
                self.room.draw_pool()

    def _draw_surroundings(self, frame: Frame) -> None:
        """Draw what the gilded statue mirrors."""
        gl.glClearColor(*self.settings.fog.color, 1.0)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        sun.shine(self.settings.sun)
        self._draw("room", self.room, frame)
        self._draw("door", self.entrance, frame)
        self.room.draw_pool()
        self.room.draw_floor()
        self._draw("sky", self.sky, frame)

    def _draw_over_pool(self, frame: Frame) -> None:
        """Draw what the pool's water mirrors."""
        self._draw_surroundings(frame)
        self._draw("statue", self.statue, frame)
        self._draw("torches", self.torches, frame)

    def _draw_image(self, frame: Frame) -> None:
        """Draw the mirror image where the floor is visible, before the floor covers it."""
        if not self._polished or not self.mirror.shows(frame):
            return
        begin_pass("reflection")
        with self.mirror.image(self.room.send_floor):
            self._draw_hall(replace(frame, mirrored=True))
        begin_pass("main")

    def _draw_floor(self, frame: Frame) -> None:
        """Draw the floor: over its mirror image, plain without one, or its underside."""
        if "floor" not in self.shown:
            return
        shadow = self._shading("floor")
        with drawing("floor"):
            if self._polished and frame.eye_y <= 0.0:
                self.mirror.draw_underside(self.room.send_foundation)
            elif shadow and shadow.relights:
                for without in shadow.parts(frame, on_floor(self.room.send_floor)):
                    self._lay_floor(frame, *without)
            else:
                self._lay_floor(frame)
                if shadow:
                    shadow.darken(frame, on_floor(self.room.send_floor))

    def _lay_floor(self, frame: Frame, *without: str) -> None:
        """Draw the floor without the light of "sun", "torch" or both."""
        without = self._unlit(*without)
        if self._polished and self.mirror.shows(frame):
            self.mirror.draw_floor(frame, lambda: self.room.draw_floor(*without))
        else:
            self.room.draw_floor(*without)

    def _unlit(self, *without: str) -> tuple[str, ...]:
        """Return the lights that are left out, with the sun if it is not to shine on the floor."""
        missing = {*without, *(() if self.settings.shadow.sunlit else ("sun",))}
        return tuple(name for name in ("sun", "torch") if name in missing)

    def _shade_wall(self, frame: Frame) -> None:
        """Draw the statue's shadows on the north wall; in the floor's image only from nearby."""
        if frame.mirrored and frame.pose.z > FAR_FROM_WALL:
            return
        shadow = self._shading("room")
        if shadow and shadow.relights:
            for without in shadow.parts(frame, on_north(self.room.send_north)):
                if without:
                    with drawing("shadow"):
                        self.room.draw_north(*self._unlit(*without))
        elif shadow:
            shadow.darken(frame, on_north(self.room.send_north))

    def _shading(self, where: str) -> PlanarShadow | None:
        """Return the statue's shadows if they show there, on the floor or on the room's wall."""
        shown = {"shadow", "statue", where} <= self.shown and self.settings.shadow.enabled
        return self.shadow if shown else None

    def _cast(self, frame: Frame, light: str) -> None:
        """Send what casts a light's shadows: statue and plinth, perhaps pillars and torches."""
        self.statue.send_shadowing(frame)
        self.room.send_plinth()
        if self.casters and light == "torch" and self.settings.shadow.casters == "all":
            self.casters.send()

    @property
    def _polished(self) -> bool:
        """Whether the floor is shown as a mirror."""
        return self.mirror is not None and {"floor", "mirror"} <= self.shown

    def _draw(self, name: str, element: Any, frame: Frame) -> None:
        """Draw an element if it was built and is shown now."""
        if element is not None and name in self.shown:
            with drawing(name):
                element.draw(frame)

    def release(self) -> None:
        """Release the elements, last built first; may be called twice."""
        if self.casters:
            self.casters.release()
        while self._owned:
            self._owned.pop().release()


def obstacles() -> tuple[Obstacle, ...]:
    """Return what the walker cannot pass: walls, pillars, plinth and pool."""
    inside, half = plan.INSIDE, plan.WALL / 2
    found: list[Obstacle] = [
        Tower(x, z, plan.PILLAR + 0.01, TALL) for x in plan.ROWS for z in plan.BAYS[1:-1]
    ]
    found.append(Wall(*plan.STATUE, plan.PLINTH[0], plan.PLINTH[0], 0.0, TALL))
    x, z, long, wide = extent(inside)
    for side in (inside.west - half, inside.east + half):
        found.append(Wall(side, z, half, long + half, 0.0, TALL))
    for side in (inside.north - half, inside.south + half):
        found.append(Wall(x, side, wide + half, half, 0.0, TALL))
    # A block, not a fence: who arrives in a view from over the water stands beside it.
    x, z, long, wide = extent(plan.POOL)
    found.append(Wall(x, z, wide, long, 0.0, OVER_POOL))
    return tuple(found)


def extent(area: plan.Rectangle) -> tuple[float, float, float, float]:
    """Return the middle of an area, x and z, and half its length along z and along x, in units."""
    x, z = (area.west + area.east) / 2, (area.north + area.south) / 2
    return x, z, (area.south - area.north) / 2, (area.east - area.west) / 2


def with_nothing_held(view: View) -> View:
    """Return a view that shows what it names, or everything but what a walker holds."""
    return replace(view, shown=view.shown or STANDING)


SCENE = Scene(
    name="hall",
    elements=ELEMENTS,
    views={name: with_nothing_held(view) for name, view in VIEWS.items()},
    settings=Settings(),
    presets=PRESETS,
    preset="best",
    start="hall",
    main=MAIN,
    open=Hall,
    terrain=lambda settings, assets: Ground(),
    fixes=SAFEGUARDS,
    digits=KEYS,
    carried=carried,
    overlay=HELD,
    title="the great hall",
    # Statue and pool mirror the hall as it was drawn when it was opened.
    baked=(
        *("room", "sun", "fog", "sky", "statue", "torches", "shadow.flame", "tone.texture"),
        *("tone.texture_contrast", "tone.texture_brightness"),
    ),
)
