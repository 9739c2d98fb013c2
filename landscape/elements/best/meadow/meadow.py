"""The meadow of `best`: grass in tufts, tinted, turned to the viewer, thinned out far away.

Techniques, on the blades of ``elements/grass.py``, still sent by one glDrawElements:

- ``grass.facing`` (R7): each frame turns the wide side of every blade partly to the viewer.
- ``grass.tinted``: a blade takes the colour of the ground it stands on, by a colour array; the
  texture unit doubles texture times colour, so that a tint can make a blade lighter.
- ``grass.fade``: with distance fewer and wider blades are drawn, and each sinks into the ground
  towards the end of its range, so that none appears all at once.
- ``grass.tufts``, ``grass.variety``, ``grass.arch``: blades that share a root, lean apart, and
  differ in height and colour from tuft to tuft; see :mod:`growth`.
- ``grass.sward``, ``grass.flowers``: cards with several fine blades, seed heads, straw and flowers
  instead of single blades; see :mod:`sward`. The alpha test leaves out what is transparent.
- ``grass.gusts``: waves of wind that travel over the meadow; see :mod:`gusts`.

State used: GL_TEXTURE_2D; tinted, the combiner of unit 0 with GL_RGB_SCALE (OpenGL 1.3); for the
sward, GL_ALPHA_TEST, and GL_SAMPLE_ALPHA_TO_COVERAGE (1.3) where a pixel has several samples.
"""

import math
from collections.abc import Hashable, Iterator
from contextlib import contextmanager, nullcontext
from typing import Self

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, multiply
from framelens.gl.texture import Texture
from landscape.elements.best.meadow.facing import facing
from landscape.elements.best.meadow.growth import Growth
from landscape.elements.best.meadow.gusts import gusts
from landscape.elements.best.meadow.refined_blades import (
    Patch,
    count_at,
    nearest_first,
    shortened,
    showing,
    widened,
    wider_by,
)
from landscape.elements.best.meadow.sward import (
    CARD_HEIGHT,
    CARD_SIDES,
    WIDE_FROM,
    WIDENED,
    WIDENING,
    card_scale,
    mean_colours,
    most_widened,
    raised,
    slimmed,
    sward_levels,
    texture_coordinates,
)
from landscape.elements.best.terrain.shadows import cast_from
from landscape.elements.element import Element, Site
from landscape.elements.fog import visibility
from landscape.elements.grass import COORDINATES, TALLEST, WIND, Grass, blade_wind, strip_indices
from landscape.elements.grass_cells import (
    CELL,
    HALF_DIAGONAL,
    cell_centres,
    cells_around,
    visible_cells,
)
from landscape.elements.ground import Ground
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.files.cache import content, recall
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.culling import REUSE_ANGLE, REUSE_DISTANCE, is_near
from landscape.gl.cut_out import cut_out
from landscape.gl.features import possible

RARELY = 1.5  # chosen: times the margin that is kept where blades are left out
CLEAR = 0.98  # chosen: of a blade's colour, what fog must leave in order to be left out
LEAST_PIXELS = 4.0  # chosen: blades of a coarser frame are drawn as far as they are as tall


def blade_ends(image: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the mean colours (3,) of a blade's texture, at its upper part and its foot, 0..1."""
    half, last = max(len(image) // 2, 1), len(image) * 7 // 8
    upper, foot = (part.mean(axis=(0, 1)) / 255.0 for part in (image[:half], image[last:]))
    return upper, foot


@contextmanager
def sharper(coarser: float) -> Iterator[None]:
    """Choose the mip levels of a frame whose pixels are not ``coarser`` times as large.

    In those of the larger pixels the blades of a card have grown together: it would be a blob.
    """
    if coarser <= 1.0 or not possible("sharper textures"):
        yield
        return

    def bias(value: float) -> None:
        gl.glTexEnvf(gl.GL_TEXTURE_FILTER_CONTROL, gl.GL_TEXTURE_LOD_BIAS, value)

    bias(-math.log2(coarser))
    try:
        yield
    finally:
        bias(0.0)


class Meadow(Element[Settings]):
    """All blades, cell by cell."""

    asked_by = (
        "grass.tinted",
        "grass.fade",
        "grass.facing",
        "grass.tufts",
        "grass.variety",
        "grass.sward",
        "grass.gusts",
        "grass.arch",
    )
    ignores = ("grass.method",)  # all blades are always drawn in one call

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Sow it on the ground, by the seed."""
        return cls(site.settings, site.assets, site.elements[Ground], site.seed)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the settings that the blades' number, places, shapes and tints depend on."""
        grass, ground = settings.grass, settings.ground
        used = [*Grass.built_from(settings), grass.tufts, grass.arch, grass.variety, grass.fade]
        used += [grass.tinted, grass.radius if grass.fade else None, grass.sward]
        used += [grass.flowers if grass.sward else None]
        if grass.tinted:
            used += [ground.large_texture, ground.texture_size, settings.sun.tint]
            used += [ground.tone if grass.sward else None]
            used += cast_from(settings)
        return tuple(used)

    def __init__(self, settings: Settings, assets: Assets, ground: Ground, seed: int) -> None:
        """Distribute the blades over the cells at random, by ``seed``; they are made when seen."""
        self.settings, self._field = settings, ground.field
        if settings.grass.sward:
            path = assets.path("sward.png")
            levels = list(recall(("sward", content(path)), lambda: tuple(sward_levels(path))))
            ends, trilinear = (mean_colours(levels[0]),) * 2, False
            self._corners, self._height = texture_coordinates(), CARD_HEIGHT
        else:
            levels = [read_image(assets.path("blade.png"), "RGB")]
            ends, trilinear = blade_ends(levels[0]), True
            self._corners, self._height = COORDINATES[None], TALLEST

        self._growth = Growth(settings, ground, seed, ends)
        self._widening = 1.0, 0.0
        if settings.grass.sward and settings.grass.fade:
            self._widening = most_widened(self._growth.near * WIDE_FROM)
        self._texture = Texture(levels, repeat=False, trilinear=trilinear)
        self._in_view = 0
        self._chosen: np.ndarray | None = None
        self._chosen_for: Frame | None = None
        self._indices = np.empty(0, np.uint32)

    def reach(self, frame: Frame) -> float:
        """Return how many units away blades are drawn: the radius, or less in a coarser frame.

        There, a blade that covers hardly a pixel is not worth its vertices; the ground has its
        colour. They sink towards the end of the reach as at the end of the radius.
        """
        grass, coarser = self.settings.grass, frame.detail.coarser
        if coarser <= 1.0 or not grass.fade:
            return grass.radius
        pixels = frame.size[1] / 2.0 / math.tan(math.radians(frame.fov / 2.0))
        tall = self._height * grass.scale[1] * pixels
        return min(grass.radius, tall / (LEAST_PIXELS * coarser))

    def select(self, frame: Frame) -> Patch:
        """Return the blades that show in a frame, the nearest first: the plain form.

        A walk chooses tufts for several frames, see :meth:`choice`.
        """
        return self.seen(frame, self.choose(frame))

    def choose(self, frame: Frame, margin: float = 0.0, angle: float = 0.0) -> np.ndarray:
        """Return the rows (t,) of the tufts that may show, see :class:`growth.Growth`.

        With ``margin`` units and ``angle`` radians, of all that may until the eye has moved and
        turned that far. With ``grass.fade`` far cells are thinned out.
        """
        growth, grass = self._growth, self.settings.grass
        self._chosen = None  # rows change
        growth.forget(self._in_view)
        radius = self.reach(frame)
        cells = cells_around(frame.pose.x, frame.pose.z, radius + margin, growth.across)
        centres = cell_centres(cells, self._field)
        numbers = cells[:, 1] * growth.across + cells[:, 0]
        seen = visible_cells(frame, centres, radius, margin, angle) & (growth.counts[numbers] > 0)
        nearest = np.hypot(centres[:, 0] - frame.pose.x, centres[:, 2] - frame.pose.z)
        nearest -= CELL * HALF_DIAGONAL + growth.tuft_radius + margin
        numbers, nearest = numbers[seen], nearest[seen]
        counts = growth.counts[numbers]
        if grass.fade:
            counts = count_at(
                growth.shared[numbers], growth.near, nearest, frame.detail.grass, growth.thinning
            )
        tufts = growth.sown(numbers.tolist(), counts.tolist())
        if grass.fade:
            tufts = self._showing(frame, tufts, margin, angle)
        blades = int(growth.tufts.take("blades", tufts).sum())
        self._in_view = round(blades / frame.detail.grass)
        return tufts

    def _showing(
        self, frame: Frame, tufts: np.ndarray, margin: float = 0.0, angle: float = 0.0
    ) -> np.ndarray:
        """Return those of some tufts, given by their rows, of which a blade may show."""
        rows, apart = self._growth.tufts, self._growth.tuft_radius
        places, ranges, sizes = (rows.take(name, tufts) for name in ("places", "ranges", "sizes"))
        # Blades stand beside the root, and on a slope above or below it.
        margin += apart
        sizes += apart
        return tufts[self._found(frame, places, ranges, sizes, margin, angle)]

    def _found(
        self,
        frame: Frame,
        places: np.ndarray,
        ranges: np.ndarray,
        sizes: np.ndarray,
        margin: float = 0.0,
        angle: float = 0.0,
    ) -> np.ndarray:
        """Return what :func:`showing` does of places (n, 3), with ranges and sizes as drawn."""
        fraction = frame.detail.grass
        if fraction < 1.0:
            sizes = sizes * wider_by(fraction)
        ranges, across = self._shortened(frame, ranges), np.ascontiguousarray(places.T)
        return showing(frame, across, ranges, sizes, self._widening, margin, angle)

    def choice(self, frame: Frame) -> np.ndarray:
        """Return the tufts of a frame: the last choice, while the eye stays near.

        It was made with a margin, so it has some tufts too many: they are outside the window, or
        have sunk into the ground. Without ``grass.fade`` no blade sinks at the end of its range, so
        each position of the eye needs its own choice.
        """
        fade = self.settings.grass.fade
        margin, angle = (REUSE_DISTANCE, REUSE_ANGLE) if fade else (0.0, 0.0)
        if frame.detail.grass < 1.0 or frame.detail.coarser > 1.0:
            # Tufts too many cost less than choosing again, the more so in other frames than
            # those in which the sprites are chosen.
            margin, angle = RARELY * margin, RARELY * angle
        if self._chosen is None or not self._still_serves(frame, margin, angle):
            self._chosen, self._chosen_for = self.choose(frame, margin, angle), frame
        return self._chosen

    def _still_serves(self, frame: Frame, margin: float, angle: float) -> bool:
        """Return whether the last choice was made for an eye near this one."""
        assert self._chosen_for is not None
        then, now = self._chosen_for.detail, frame.detail
        same = then.grass == now.grass and then.coarser == now.coarser
        return same and is_near(self._chosen_for, frame, margin, angle)

    def seen(self, frame: Frame, tufts: np.ndarray) -> Patch:
        """Return the blades of some tufts that show in a frame, the nearest first.

        Those of tufts that were never seen take shape. Without ``grass.fade`` all are returned.
        """
        growth = self._growth
        if not self.settings.grass.fade:
            return growth.blades(tufts)
        rows = growth.rows(self._showing(frame, tufts))
        places, ranges, sizes = (growth.of(name, rows) for name in ("positions", "ranges", "sizes"))
        kept = self._found(frame, places, ranges, sizes)
        order = nearest_first(frame, places.take(kept, axis=0).T)
        patch = growth.patch(rows[kept[order]])
        fraction = frame.detail.grass
        return widened(patch, fraction) if fraction < 1.0 else patch

    def _shortened(self, frame: Frame, ranges: np.ndarray) -> np.ndarray:
        """Return how far away blades of ``ranges`` (n,) are drawn in a frame, float32 in units."""
        return shortened(ranges, self.reach(frame), frame.detail.grass, self._growth.thinning)

    def bend(self, frame: Frame, patch: Patch) -> np.ndarray:
        """Return a patch's vertices, float32 (n, 5, 3), in the wind, turned, and sunk far away.

        Without facing and fade they are those of the plain :func:`grass.bent`.
        """
        grass, places = self.settings.grass, patch.places
        columns = np.array(patch.columns)
        across = card_scale(grass.scale)[0] if grass.sward else grass.scale[0]
        wind = blade_wind(frame.kt, places.T, across).T
        if grass.gusts:
            wind = wind + gusts(frame.kt, places[0], places[2], grass.gusts)
        for vertex, fraction in WIND:
            columns[vertex, ::2] += fraction * wind
        away = places[::2] - np.array([[frame.pose.x], [frame.pose.z]], np.float32)
        far = np.sqrt(away[0] * away[0] + away[1] * away[1])
        if grass.sward:
            wider = self._wider(far, patch) if grass.fade else 1.0
            wider = wider * slimmed(far, patch.kinds)
            facing(columns, away, grass.facing, CARD_SIDES, wider)
        elif grass.facing > 0:
            facing(columns, away, grass.facing)

        if grass.fade:
            left = np.clip(4.0 * (1.0 - far / self._shortened(frame, patch.ranges)), 0.0, 1.0)
            if grass.sward:
                left *= raised(far)
            columns[2:, 1] = places[1] + (columns[2:, 1] - places[1]) * left
            gone = np.flatnonzero(left <= 0.0)
            columns[..., gone] = places[:, gone]

        return np.ascontiguousarray(columns.transpose(2, 0, 1))

    def _wider(self, far: np.ndarray, patch: Patch) -> np.ndarray:
        """Return how many times as wide as close by cards ``far`` (n,) units away are drawn.

        Far away there are fewer of them, and they have to cover the same ground.
        """
        near = np.float32(self._growth.near * WIDE_FROM)
        times = np.maximum(far / near, 1.0) ** np.float32(WIDENING)
        return 1.0 + (times - 1.0) * WIDENED[patch.kinds]

    def _clear_of_fog(self, frame: Frame) -> bool:
        """Return whether fog would change nothing that one sees of the blades."""
        fog, reach = self.settings.fog, np.array(self.reach(frame))
        return fog.mode == "exp2" and bool(visibility(reach, fog.density) > CLEAR)

    def draw(self, frame: Frame) -> None:
        """Choose, bend and send the visible blades."""
        patch = self.seen(frame, self.choice(frame))
        count = len(patch.positions)
        if not count:
            return
        vertices = self.bend(frame, patch).reshape(-1, 3)
        coordinates = self._corners.take(patch.kinds, axis=0).reshape(-1, 2)
        if len(self._indices) < 9 * count:
            self._indices = strip_indices(2 * count)
        tinted = patch.colours().reshape(-1, 4) if self.settings.grass.tinted else None
        cut = cut_out() if self.settings.grass.sward else nullcontext()
        sharp = sharper(frame.detail.coarser)
        with attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT), cut, sharp:
            gl.glEnable(gl.GL_TEXTURE_2D)
            if frame.detail.coarser > 1.0 and self._clear_of_fog(frame):
                gl.glDisable(gl.GL_FOG)
            self._texture.bind()
            if tinted is None:
                gl.glColor3f(*self.settings.sun.tint)
            else:
                # Twice texture times tint: a tint can make a blade lighter than its texture.
                multiply(2.0)

            with client_arrays(vertices, None, tinted, [coordinates]):
                gl.glDrawElements(gl.GL_TRIANGLES, 9 * count, gl.GL_UNSIGNED_INT, self._indices)
            if tinted is not None:
                multiply()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def take(self, settings: Settings) -> None:
        """Take other settings, by which other blades may be in view."""
        self.settings, self._chosen = settings, None

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._texture.release()
