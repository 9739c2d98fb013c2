"""The island in voxels: its passes, and the order in which a frame draws them."""

import math
from collections.abc import Iterator
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from framelens.base.errors import InputError
from framelens.gl.seam import begin_pass, drawing, gl
from framelens.gl.state import attrib
from landscape.elements import sun
from landscape.elements.element import Elements, OfElements, Slot
from landscape.elements.settings import Fog
from landscape.elements.sword import Sword
from landscape.files.assets import Assets
from landscape.frame import LARGEST, SEED, Frame, Pose
from landscape.geometry.height_field import mirrored_height
from landscape.geometry.obstacles import Obstacle
from landscape.scene.scene import Moment, SceneOf, begin_frame
from landscape.settings.declare import Toggle
from landscape.voxel import build
from landscape.voxel.edges_view import draw_edges
from landscape.voxel.far_shadows import FarShadowMap
from landscape.voxel.heights import Heights
from landscape.voxel.highlights import Highlights
from landscape.voxel.land import Choice, Land
from landscape.voxel.map import Map
from landscape.voxel.memory import give_back
from landscape.voxel.outside_view import OutsideView
from landscape.voxel.played import Played
from landscape.voxel.region_buffer import ABOVE, ALL, UNDER, Part
from landscape.voxel.regions_view import draw_boxes
from landscape.voxel.safeguards import SAFEGUARDS
from landscape.voxel.settings import PRESETS, Settings
from landscape.voxel.shadow_map import ShadowMap
from landscape.voxel.sky import Sky
from landscape.voxel.sounds import voxel_sounds
from landscape.voxel.support import supported
from landscape.voxel.textures_view import TexturesView
from landscape.voxel.under_water import murk, sight
from landscape.voxel.views import ELEMENTS, HELD, MAIN, STANDING, VIEWS
from landscape.voxel.water import Water
from landscape.voxel.water_images import clipped

# Chosen: pixels of a unit, one unit away, from which on more of them show no finer land, and fewer
# no coarser: those of windows 900 and 600 pixels high, with a field of view of 66 degrees.
MOST_PIXELS, LEAST_PIXELS = 693.0, 462.0


# Units above the water, chosen: up to the first, far land is seen in front of the sky, and from the
# second on in front of the sea.
SKY_BEHIND, SEA_BEHIND = 4.0, 10.0


class Ground:
    """The land that a walker stands on; needs no OpenGL."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the heights; InputError for an image that cannot be used."""
        self.settings = settings
        self.heights: Heights = build.source(settings.voxel, assets)
        self.size = len(self.heights.field) * settings.voxel.block

    def height(self, x: float, z: float) -> float:
        """Return the height in units of the ground's blocks at x, z, or of the water over them."""
        values = self.settings.voxel
        return max(self._top(x, z), values.sea) * values.block

    def bed(self, x: float, z: float) -> float:
        """Return the height in units of the ground's blocks at x, z, under water as well.

        It is the water's where nothing is to be seen from below.
        """
        below = self.settings.water.below
        return self._top(x, z) * self.settings.voxel.block if below else self.height(x, z)

    def _top(self, x: float, z: float) -> int:
        """Return the number of blocks in the column at x, z."""
        block, last = self.settings.voxel.block, len(self.heights.field) - 1
        i, k = (int(min(max(each / block, 0), last)) for each in (x, z))
        return self.heights.top(i, k)


# Everything stands on the land. Two pictures of the sun's are of the land, too.
SLOTS = (
    Slot("land", (Land,), always=True, base=True),
    Slot("shadow", (ShadowMap,), shown_by=("land",)),
    Slot("far shadow", (FarShadowMap,), shown_by=("land",)),
    Slot("highlights", (Highlights,), shown_by=("land",)),
    Slot("water", (Water,)),
    Slot("sword", (Sword,)),
    Slot("map", (Map,)),
)


class Shore(NamedTuple):
    """The water in view: its height in units, and points of it (n, 3)."""

    level: float
    points: np.ndarray


class Voxel(Played, Ground, OfElements[Settings]):
    """The scene. Needs a current OpenGL context; ``shown`` may be changed between frames."""

    obstacles: tuple[Obstacle, ...] = ()

    def __init__(
        self, settings: Settings, assets: Assets, seed: int = SEED, only: tuple[str, ...] = STANDING
    ) -> None:
        """Build the elements in ``only``; InputError names a file that cannot be used."""
        settings = supported(settings)
        Ground.__init__(self, settings, assets)
        Played.__init__(self, assets, seed)
        self.elements = Elements(settings, assets, seed, only)
        self._under = False  # whether the eye is under water
        self.textures, self.outside = TexturesView(), OutsideView(assets)
        with self.elements.building():
            # First, since it takes much memory for a moment, and the land from then on.
            self.elements.build(Slot("sky", (Sky,)))
            give_back()
            self.elements.build(*SLOTS)
            give_back()
        self.land = self.elements[Land]

    def roof(self, x: float, z: float) -> float:
        """Return the height in units of the highest block at x, z, or of the water."""
        block, blocks = self.settings.voxel.block, self.land.world.blocks
        i, k = (int(min(max(each / block, 0), len(blocks) - 1)) for each in (x, z))
        top = int(np.flatnonzero(blocks[i, k]).max(initial=-1)) + 1
        return max(top * block, self.height(x, z))

    def apply(self, settings: Settings) -> bool:
        """Apply settings; return False, changing nothing, if the land must be built again.

        InputError, changing nothing either, for a file that cannot be used.
        """
        settings = supported(settings)
        if self.elements.apply(settings) is None:
            return False
        self.settings = settings
        return True

    @property
    def water(self) -> Water | None:
        """The water, if it was built."""
        return self.elements.get(Water)

    @property
    def _water_shown(self) -> Water | None:
        return self.water if "water" in self.shown else None

    @property
    def _shows_textures(self) -> bool:
        """Whether textures of the passes are shown by themselves."""
        debug = self.settings.debug
        return debug.textures or debug.picture != "none"

    @property
    def shadow(self) -> ShadowMap | None:
        """The sun's picture of the land around the eye, if the sun casts shadows."""
        return self.elements.get(ShadowMap)

    def draw(self, moment: Moment) -> None:
        """Draw one frame into the current framebuffer."""
        values = self.settings
        self._under = self._is_under(moment.pose)
        haze = murk(values) if self._under else self._haze(moment.pose)
        frame = begin_frame(moment, values.camera, values.sun, haze)
        clip = clip_matrix()
        self.land.catch_up()
        self._around = self.land.around(frame.eye)
        self._draw_shadows(frame, moment.walking)
        begin_pass("main")
        shore = self._shore(frame)

        # Without pictures the ground under water is seen through it.
        water = self._water_shown
        opaque = water is not None and shore is not None and water.images is not None
        part = UNDER if self._under else ABOVE if opaque else ALL
        with self._side_of_eye(part), attrib(gl.GL_POLYGON_BIT):
            gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE if moment.wireframe else gl.GL_FILL)
            self._draw_land(frame, clip, part, behind_hills=moment.wireframe or self._under)
        if not self._under:  # or the surface is in front of all of it
            self.elements.draw("sky", frame)
        visible = water is not None and shore is not None and self._visible(frame, water)
        if water and shore and visible:
            self._draw_images(frame, clip, water)
            begin_pass("water")
            with drawing("water"):
                depth = self.depth(shore)
                fades_into = haze.color if self._under else ()
                water.draw(frame, clip, shore.points, depth, fades_into)

        begin_pass("overlay")
        self.draw_aim(frame)
        self._draw_debug(frame, clip, visible)
        if not values.debug.textures:  # it would cover the last of them
            self.elements.draw("sword", frame)
        self.elements.draw("map", frame)

    @property
    def refracts(self) -> bool:
        """Whether one sees through the water what lies under it, and flatter than it is."""
        water = self._water_shown
        return water is not None and water.images is not None and self.settings.water.refraction

    def _is_under(self, pose: Pose) -> bool:
        """Return whether the eye is under water, and sees the surface from beneath."""
        water = self._water_shown
        if water is None or not self.settings.water.below:
            return False
        assert pose.y is not None
        return water.images is not None and pose.y < water.level

    def _side_of_eye(self, part: Part) -> AbstractContextManager[None]:
        """Return the clip plane that leaves of the land what is on the eye's side of the water."""
        if part == ALL:
            return nullcontext()
        return clipped(self.elements[Water].level, above=part == ABOVE)

    def _haze(self, pose: Pose) -> Fog:
        """Return the fog of the land: from high above it has the colour of the sea's haze.

        Otherwise far land would be paler than the sea before and behind it.
        """
        values = self.settings
        if not values.voxel.sea_haze:
            return values.fog
        assert pose.y is not None
        height = pose.y - values.voxel.sea * values.voxel.block
        above = min(max((height - SKY_BEHIND) / (SEA_BEHIND - SKY_BEHIND), 0.0), 1.0)
        pairs = zip(values.fog.color, values.water.horizon, strict=True)
        return replace(values.fog, color=tuple(sky + above * (sea - sky) for sky, sea in pairs))

    def depth(self, shore: Shore) -> np.ndarray:
        """Return how deep the water is at its points, float32 (n,), in units; negative on land."""
        block = self.settings.voxel.block
        x, _, z = shore.points.T / block
        return np.asarray(shore.level - block * self.heights.height(x, z), np.float32)

    def _draw_land(
        self,
        frame: Frame,
        clip: np.ndarray,
        part: Part,
        below: bool = False,
        behind_hills: bool = True,
    ) -> None:
        """Draw the land that can be seen through the current matrices, whose product is ``clip``.

        ``part`` says which of it can be visible; ``below`` fogs it by its depth. What lies
        ``behind_hills`` is sent only if asked for.
        """
        if "land" not in self.shown:
            return
        with drawing("land"):
            eye = frame.eye
            near, far = self._detail(frame)
            if frame.mirrored:
                eye = np.array(
                    [eye[0], mirrored_height(eye[1], self.elements[Water].level), eye[2]]
                )
            reach = sight(self.settings) if part == UNDER and self._under else math.inf
            choice = self.land.choose(clip, eye, self._around, near, far, part, reach)
            if not behind_hills:
                choice = self.land.without_hidden(choice, eye)
            for shadow, some in self._by_shadow(choice):
                with shadow.applied() if shadow else nullcontext():
                    self.land.draw(some, fog_by_height=below)
                highlights = self.elements.get(Highlights)
                if highlights and not (frame.mirrored or below):
                    highlights.draw(frame, self.land, some, shadow)

    def _detail(self, frame: Frame) -> tuple[float, float]:
        """Return how far land is drawn with the meshes for near, and then for far, in units.

        Where a frame has fewer pixels, blocks are as small on the screen less far away.
        """
        finer = min(max(frame.pixels, LEAST_PIXELS) / MOST_PIXELS, 1.0)
        if frame.mirrored:
            return 0.0, finer * self.settings.water.far
        return finer * self.settings.voxel.near, finer * self.settings.voxel.far

    def _by_shadow(self, choice: Choice) -> Iterator[tuple[ShadowMap | None, Choice]]:
        """Yield the regions that each of the sun's pictures shades; None where there is none."""
        shadow, far_shadow = self.shadow, self.elements.get(FarShadowMap)
        if shadow is None:
            yield None, choice
            return
        low, high = (ends[choice.regions] for ends in (self.land.low, self.land.high))
        near = shadow.covers(low, high)
        if far_shadow is None or near.all():
            yield shadow, choice
            return
        if near.any():
            yield shadow, choice.only(near)
        yield far_shadow, choice.only(~near)

    def _draw_debug(self, frame: Frame, clip: np.ndarray, water_drawn: bool) -> None:
        """Draw what one may look at besides the picture: regions and textures.

        Without ``water_drawn`` the water's pictures are those of an earlier frame, and not shown.
        """
        values, land = self.settings.debug, self.land
        textures = self._shows_textures
        if not values.regions:
            self.outside.release()
        if "land" not in self.shown or not (values.regions or values.edges or textures):
            return
        if frame.tile is not None and frame.tile.cuts(frame.size) and (values.regions or textures):
            # What is laid over the picture would be drawn anew in each block of it.
            raise InputError(
                "--poster: expected at most {most} pixels a side with {names}",
                most=LARGEST,
                names="debug.regions, debug.textures or debug.picture",
            )
        choice = land.choose(clip, frame.eye, self._around, *self._detail(frame))

        with drawing("land"):
            if values.regions:
                draw_boxes(land, choice, clip)
                self.outside.draw(land, choice, frame, clip)
            if values.edges:
                draw_edges(land, choice)
            if textures:
                images = self.elements[Water].images if water_drawn else None
                pictures = {
                    "reflection": images.reflection if images else None,
                    "refraction": images.refraction if images else None,
                    "shadow": self.shadow.target if self.shadow else None,
                }
                draw = partial(land.draw_shapes, choice)
                self.textures.draw(frame, pictures, draw, values.picture)

    def _draw_shadows(self, frame: Frame, walking: bool) -> None:
        """Draw the sun's picture of depths, if it must be drawn again; a part of it in a walk."""
        if "land" not in self.shown or not self.settings.shadow.enabled:
            self.land.touched.clear()
            return
        towards = sun.direction(self.settings.sun)
        begin_pass("shadow")
        with drawing("land"):
            for shadow in filter(None, (self.shadow, self.elements.get(FarShadowMap))):
                shadow.update(
                    frame.eye,
                    self.land.version,
                    self.land.touched,
                    lambda clip, share: self.land.draw_shapes(
                        self.land.seen_by_sun(clip, towards, share)
                    ),
                    walking,
                )
        self.land.touched.clear()

    def _shore(self, frame: Frame) -> Shore | None:
        """Return where water would be in view if nothing hid it; None if nowhere."""
        water = self._water_shown
        points = water.grid(frame) if water else None
        return None if water is None or points is None else Shore(water.level, points)

    def _visible(self, frame: Frame, water: Water) -> bool:
        """Return whether any water shows beside the land, which has been drawn."""
        query = water.query
        if query is None or self._under:
            return True
        with drawing("water"):
            query.expected(frame)
            query.ask(frame)
            # Whether the water's pictures are shown must not depend on what was seen before.
            return bool(query.shows(wait=self._shows_textures))

    def _draw_images(self, frame: Frame, clip: np.ndarray, water: Water) -> None:
        """Draw the pictures of what the water mirrors, and of what lies under it.

        ``clip`` is the camera's projection times modelview.
        """
        images = water.images
        if images is None:
            return
        level = water.level
        block = self.settings.voxel.block
        begin_pass("reflection")
        with drawing("water"):
            images.draw_reflection(
                frame.viewport,
                level,
                block,
                lambda mirror: self._draw_mirrored(frame, clip @ mirror),
                not self._under,
            )

        begin_pass("refraction")
        with drawing("water"):
            if self._under:
                images.draw_window(
                    frame.viewport,
                    level,
                    block,
                    self.settings.fog,
                    lambda high: self._drawhead(frame, clip @ high),
                )
                return
            images.draw_refraction(
                frame.viewport,
                level,
                block,
                lambda flat: self._draw_under(frame, clip @ flat, images.darkens),
            )

    def _draw_mirrored(self, frame: Frame, clip: np.ndarray) -> None:
        """Draw what is mirrored: the land, unless that is off, and the sky behind it."""
        frame = replace(frame, mirrored=True)
        if self.settings.water.reflection:
            self._draw_land(frame, clip, UNDER if self._under else ABOVE)
        if self._under:
            return
        # The box of the sky is drawn around the eye: here around the camera under the water.
        below = replace(frame.pose, y=mirrored_height(frame.eye_y, self.elements[Water].level))
        self.elements.draw("sky", replace(frame, pose=below))

    def _draw_under(self, frame: Frame, clip: np.ndarray, darkens: bool) -> None:
        """Draw what lies under the water, unless that is off: then its colour is all one sees.

        ``darkens`` says that it is fogged by its depth.
        """
        if self.settings.water.refraction:
            self._draw_land(frame, clip, UNDER, below=darkens)
            self.draw_aimed_at(frame, beyond_water=True)

    def _drawhead(self, frame: Frame, clip: np.ndarray) -> None:
        """Draw what is above the water, for an eye under it, unless that is off: then only sky."""
        if self.settings.water.refraction:
            self._draw_land(frame, clip, ABOVE)
            self.draw_aimed_at(frame, beyond_water=True)
        self.elements.draw("sky", frame)

    def release(self) -> None:
        """Release the elements, last built first; may be called twice."""
        self.textures.release()
        self.outside.release()
        self.elements.release()


def clip_matrix() -> np.ndarray:
    """Return the current projection times modelview (4, 4), which transforms column vectors."""
    names = gl.GL_PROJECTION_MATRIX, gl.GL_MODELVIEW_MATRIX
    projection, modelview = (np.array(gl.glGetFloatv(name), np.float64) for name in names)
    # OpenGL stores columns, so the arrays are the transposed matrices.
    return np.asarray((modelview.reshape(4, 4) @ projection.reshape(4, 4)).T)


# The keys of the TP.
KEYS = {
    "L": Toggle("debug.regions", "boxes of the regions"),
    "K": Toggle("debug.textures", "textures of the passes"),
}


SCENE = SceneOf(
    name="voxel",
    elements=ELEMENTS,
    views=VIEWS,
    settings=Settings(),
    presets=PRESETS,
    preset="best",
    start="voxel_bay",
    main=MAIN,
    open=Voxel,
    terrain=Ground,
    fixes=SAFEGUARDS,
    overlay=HELD,
    letters=KEYS,
    title="the island in voxels",
    blocks=True,
    # The light of each face is in its colours, which are rounded.
    baked=("time", "sun", "shadow.color", "voxel.slope"),
    # Regions have a switch of their own, ``voxel.cull``; OpenGL lights nothing, and the sky's light
    # has constants of its own (build.py); blocks are always solid, and one jumps.
    unread=(
        *("camera.cull", "camera.lod_pixels", "sun.ambient", "sun.fill"),
        *("walk.solid", "walk.jump"),
    ),
    sounds=voxel_sounds,
)
