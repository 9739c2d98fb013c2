"""The great hall: its elements, and the order in which a frame draws them, which is the lesson."""

from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from functools import partial

from framelens.gl.extensions import has_stencil
from framelens.gl.seam import begin_pass, drawing, gl
from framelens.gl.state import attrib
from landscape.elements import sun
from landscape.elements.element import Elements, OfElements, Site, Slot
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
from landscape.hall.planar_shadow import PlanarShadow, on_floor, on_north, on_plinth
from landscape.hall.pool import Pool
from landscape.hall.room import Room
from landscape.hall.safeguards import SAFEGUARDS
from landscape.hall.settings import PRESETS, Settings
from landscape.hall.shafts import Shafts
from landscape.hall.sounds import hall_sounds
from landscape.hall.statue import Statue
from landscape.hall.tone import Tone
from landscape.hall.torches import Torches
from landscape.hall.views import ELEMENTS, HELD, MAIN, STANDING, VIEWS
from landscape.scene.scene import Moment, SceneOf, begin_frame

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


class Hall(Ground, OfElements[Settings]):
    """The scene. Needs a current OpenGL context; ``shown`` may be changed between frames."""

    def __init__(
        self, settings: Settings, assets: Assets, seed: int, only: tuple[str, ...] = STANDING
    ) -> None:
        """Build the elements in ``only``; InputError names a file that cannot be used."""
        self.settings = settings
        self.elements = Elements(settings, assets, seed, only)
        self.casters: Casters | None = None
        with self.elements.building():
            self.elements.build(
                Slot("room", (Room,), built_for=("room", "floor", "caustics"), base=True),
                Slot("caustics", (Caustics,)),
                Slot("pool", (Pool,)),
            )
            stencil = has_stencil(IN_STENCIL)
            if stencil:
                self.elements.build(Slot("mirror", (Mirror,)))
            self.elements.build(Slot("door", (Entrance,)), Slot("statue", (Statue,), base=True))
            if stencil:
                self.elements.build(
                    Slot("shadow", (PlanarShadow,), beside=("statue",), build=self._shadow)
                )
            if stencil and self.elements.get(Statue) is not None:
                self.casters = Casters()
            self.elements.build(
                Slot("sky", (MovingSky,)),
                Slot("exhibits", (Cabinet,), build=partial(self._with_stencil, Cabinet, stencil)),
                Slot("torches", (Torches,)),
                Slot("shafts", (Shafts,)),
                Slot("mist", (Mist,)),
                Slot("tone", (Tone,), build=partial(self._with_stencil, Tone, stencil)),
                Slot("flight", (Flight,)),
                Slot("sword", (Sword,)),
            )
            self._mirror_surroundings()

        self.obstacles, self.doors = obstacles(), (door(),)

    def _shadow(self, site: Site[Settings]) -> PlanarShadow:
        return PlanarShadow(site.settings, self._cast, site.elements[Statue].box)

    @staticmethod
    def _with_stencil(
        kind: type[Cabinet] | type[Tone], stencil: bool, site: Site[Settings]
    ) -> Cabinet | Tone:
        return kind(site.settings, site.assets, stencil)

    def _mirror_surroundings(self) -> None:
        """Let the statue and the pool's water mirror the hall, which is built."""
        statue, pool = self.elements.get(Statue), self.elements.get(Pool)
        if self.elements.get(Room) is None:
            return
        if statue:
            with drawing("statue"):
                statue.gild(self._draw_surroundings)
        if pool:
            with drawing("pool"):
                pool.reflect(self._draw_over_pool)

    def apply(self, settings: Settings) -> bool:
        """Apply settings; return False, changing nothing, if the hall must be opened again."""
        if self.elements.apply(settings) is None:
            return False
        self.settings = settings
        return True

    @property
    def room(self) -> Room:
        """The room's stone; LookupError if neither room nor floor may be shown."""
        return self.elements[Room]

    def eye(self, walker: Pose, kt: float) -> Pose:
        """Return from where the hall is seen: the flying camera's pose, or the walker's."""
        flying = self.settings.flight.enabled and "flight" in self.shown
        return self.elements[Flight].pose(kt) if flying else walker

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
            self.elements.draw("caustics", frame)
            gl.glFlush()
            self.elements.draw("pool", frame)  # blended over its bed

            # Blended: each after all that is opaque behind it.
            if not dimmed:
                self.elements.draw("torches", frame)
            self.elements.draw("shafts", frame)
            self.elements.draw("mist", frame)

        # What has been drawn so far is the picture that these change.
        begin_pass("picture")
        self.elements.draw("tone", frame)
        if dimmed:
            self.elements.draw("torches", frame)  # flames shine as before

        begin_pass("overlay")
        if not values.flight.enabled:
            self.elements.draw("sword", frame)

    def _draw_hall(self, frame: Frame) -> None:
        """Draw what stands in the hall: in the frame itself, and mirrored in the floor."""
        exhibits = self.elements.get(Cabinet)
        if exhibits:
            # The first part of them needs an empty depth buffer.
            self.elements.draw("exhibits", frame, exhibits.draw_first)
        self.elements.draw("room", frame)

        # OpenGL executes the calls so far while Python goes on; so below.
        gl.glFlush()
        if frame.mirrored and not self.settings.mirror.clip:
            self._draw_basin(frame)
        self.elements.draw("door", frame)
        self.elements.draw("exhibits", frame)
        with self._marking(frame):
            self.elements.draw("statue", frame)
        self._shade_wall(frame)
        self._shade_plinth(frame)
        self.elements.draw("sky", frame)
        if frame.mirrored:
            self.elements.draw("torches", frame)
        values = self.settings
        if values.flight.path and not values.flight.enabled:
            self.elements.draw("flight", frame)

    def _marking(self, frame: Frame) -> AbstractContextManager[None]:
        """Let what is drawn be marked for the change of tone, if that needs it."""
        tone = self.elements.get(Tone)
        if tone is None or "tone" not in self.shown or frame.mirrored:
            return nullcontext()
        return tone.marking()

    def _draw_basin(self, frame: Frame) -> None:
        """Draw the pool's bed and sides, with the caustics on them if that takes one pass."""
        if "room" not in self.shown:
            return
        shine = self.elements.get(Caustics) if "caustics" in self.shown else None
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
        self.elements.draw("room", frame)
        self.elements.draw("door", frame)
        self.room.draw_pool()
        self.room.draw_floor()
        self.elements.draw("sky", frame)

    def _draw_over_pool(self, frame: Frame) -> None:
        """Draw what the pool's water mirrors."""
        self._draw_surroundings(frame)
        self.elements.draw("statue", frame)
        self.elements.draw("torches", frame)

    def _draw_image(self, frame: Frame) -> None:
        """Draw the mirror image where the floor is visible, before the floor covers it."""
        mirror = self._polish
        if mirror is None or not mirror.shows(frame):
            return
        begin_pass("reflection")
        with mirror.image(self.room.send_floor):
            self._draw_hall(replace(frame, mirrored=True))
        begin_pass("main")

    def _draw_floor(self, frame: Frame) -> None:
        """Draw the floor: over its mirror image, plain without one, or its underside."""
        if "floor" not in self.shown:
            return
        shadow, mirror = self._shading("floor"), self._polish
        with drawing("floor"):
            if mirror and frame.eye_y <= 0.0:
                mirror.draw_underside(self.room.send_foundation)
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
        mirror = self._polish
        if mirror and mirror.shows(frame):
            mirror.draw_floor(frame, lambda: self.room.draw_floor(*without))
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

    def _shade_plinth(self, frame: Frame) -> None:
        """Draw on the plinth's top the shadows of a torch that was moved."""
        if frame.mirrored:
            return  # from under the floor the top is not seen
        shadow, values = self._shading("room"), self.settings.shadow
        if shadow and not shadow.relights and values.casters == "all":
            shadow.darken(frame, on_plinth(self.room.send_plinth_top))

    def _shading(self, where: str) -> PlanarShadow | None:
        """Return the statue's shadows if they show there, on the floor or on the room's wall."""
        shown = {"shadow", "statue", where} <= self.shown and self.settings.shadow.enabled
        return self.elements.get(PlanarShadow) if shown else None

    def _cast(self, frame: Frame, light: str, receiver: str) -> None:
        """Send what casts a light's shadows: statue and plinth, perhaps pillars and torches."""
        self.elements[Statue].send_shadowing(frame)
        if receiver != "plinth":
            self.room.send_plinth()
        if self.casters and light == "torch" and self.settings.shadow.casters == "all":
            self.casters.send()

    @property
    def _polish(self) -> Mirror | None:
        """The mirror in the floor, if the floor is shown as one."""
        return self.elements.get(Mirror) if {"floor", "mirror"} <= self.shown else None

    def release(self) -> None:
        """Release the elements, last built first; may be called twice."""
        if self.casters:
            self.casters.release()
        self.elements.release()


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


SCENE = SceneOf(
    name="hall",
    elements=ELEMENTS,
    views=VIEWS,
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
        *("room", "sun", "fog", "sky", "statue", "torches", "shadow.flame", "shadow.sunlit"),
        *("tone.texture", "tone.texture_contrast", "tone.texture_brightness"),
    ),
    # All of it is drawn, finely; its walls are always solid, and its pool is too small to swim in.
    unread=("camera.cull", "camera.lod_pixels", "walk.solid", "walk.swim"),
    sounds=hall_sounds,
)
