"""The cabinet: which exhibits are in view, and the order in which they are drawn."""

import math
from collections.abc import Hashable

from landscape.elements.element import Element
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.culling import ball_in_view
from landscape.gl.features import possible
from landscape.hall import plan
from landscape.hall.exhibits.accumulation import Accumulation
from landscape.hall.exhibits.depth_of_field import DepthOfField
from landscape.hall.exhibits.exhibit import Exhibit
from landscape.hall.exhibits.hidden_lines import HiddenLines
from landscape.hall.exhibits.motion_blur import MotionBlur
from landscape.hall.exhibits.niche import (
    BLUR,
    FOCUS,
    LINES,
    MIDDLE,
    SOFT,
    SOLIDS,
    TOP,
    VOLUME,
    Stone,
)
from landscape.hall.exhibits.shadow_volume import ShadowVolume
from landscape.hall.exhibits.soft_shadow import SoftShadow
from landscape.hall.exhibits.solids import Solids
from landscape.hall.settings import Settings

RADIUS = 0.22  # units: a ball around the middle of an alcove that holds it
FAR = 0.9  # chosen: units beyond which an exhibit is shown without its effect
# Radii in units of upright cylinders around the middles of the pedestals that hold the models; of
# those that throw shadows around them, the whole alcove.
HOLDS = {SOLIDS: 0.075, LINES: 0.13, FOCUS: 0.10, BLUR: 0.08, SOFT: 0.17, VOLUME: 0.17}


class Cabinet(Element[Settings]):
    """The six alcoves of the west wall."""

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return what the constructor uses of the settings."""
        return settings.exhibits.soft_lamp

    def __init__(self, settings: Settings, assets: Assets, stencil: bool = True) -> None:
        """Build stone and exhibits; without a ``stencil`` buffer two of them lack their effect."""
        self.settings, self._stencil = settings, stencil
        self._stone = Stone(assets)
        self._accumulation: Accumulation | None = None
        if possible("exhibits.soft, exhibits.blur, exhibits.focus"):
            self._accumulation = Accumulation(settings.exhibits.deep)
        sums = self._accumulation
        self._solids = Solids(settings, assets)
        self._exhibits: dict[int, tuple[str, Exhibit]] = {
            LINES: ("lines", HiddenLines(settings, assets)),
            FOCUS: ("focus", DepthOfField(settings, assets, sums)),
            BLUR: ("blur", MotionBlur(settings, assets, sums)),
            SOFT: ("soft", SoftShadow(settings, assets, sums)),
            VOLUME: ("volume", ShadowVolume(settings, assets, self._stone)),
        }

    def take(self, settings: Settings) -> None:
        """Take other settings, for all of the exhibits."""
        self.settings = settings
        if self._accumulation is not None:
            self._accumulation.set_deep(settings.exhibits.deep)
        self._solids.take(settings)
        for _, exhibit in self._exhibits.values():
            exhibit.take(settings)

    def draw_first(self, frame: Frame) -> None:
        """Draw what needs an empty depth buffer; the rest of the hall comes after it."""
        shown = self._stencil and self.settings.exhibits.solids and in_view(frame, SOLIDS)
        if shown and self._shows(frame, SOLIDS):
            self._solids.draw(frame)

    def draw(self, frame: Frame) -> None:
        """Draw the alcoves in view; mirrored, or from afar, without effects."""
        seen = [number for number in range(len(plan.ALCOVES)) if in_view(frame, number)]
        if not seen:
            return
        shown = [
            number
            for number in seen
            if number in self._exhibits
            and getattr(self.settings.exhibits, self._exhibits[number][0])
            and self._shows(frame, number)
        ]
        effects = {each for each in shown if near(frame, each) and not frame.mirrored}
        if not self._stencil:
            effects.discard(VOLUME)

        # The shadow volume draws its alcove itself.
        faded = frame.mirrored and self.settings.mirror.fades
        plain = [each for each in seen if each != VOLUME or each not in effects]
        self._stone.draw(plain, "image" if faded else "both")
        self._stone.draw_plates()
        for number in shown:
            _, exhibit = self._exhibits[number]
            if number in effects:
                exhibit.draw(frame)
            else:
                exhibit.draw_plain(frame)

    @staticmethod
    def _shows(frame: Frame, number: int) -> bool:
        """Return whether the model in an alcove may show.

        The mirror image has no models that are far away: they show there as a few pixels.
        """
        if frame.mirrored and not near(frame, number):
            return False
        return through_opening(frame, number)

    def release(self) -> None:
        """Release all; may be called twice."""
        for _, exhibit in self._exhibits.values():
            exhibit.release()
        self._solids.release()
        if self._accumulation is not None:
            self._accumulation.release()
        self._stone.release()


def in_view(frame: Frame, number: int) -> bool:
    """Return whether an alcove, or its mirror image, may be in view."""
    y = plan.ALCOVE_TOP / 2
    middle = (MIDDLE, -y if frame.mirrored else y, plan.ALCOVES[number])
    return ball_in_view(frame, middle, RADIUS)


def near(frame: Frame, number: int) -> bool:
    """Return whether the eye is near enough to see an exhibit's effect."""
    x, y, z = (frame.eye - (MIDDLE, TOP, plan.ALCOVES[number])).tolist()
    return x * x + y * y + z * z < FAR * FAR


def through_opening(frame: Frame, number: int) -> bool:
    """Return whether the model in an alcove may be seen through the alcove's opening.

    From the hall one sees of the depth of the alcove what is between two upright planes, through
    the eye and the sides of the opening.
    """
    x = frame.pose.x - plan.INSIDE.west
    z = frame.pose.z
    middle = plan.ALCOVES[number]
    if x <= 0.0:
        return True  # within the alcoves
    for side in (-1.0, 1.0):
        # Across the line of sight past this side, towards the opening's middle.
        along = z - (middle + side * plan.ALCOVE_HALF)
        across = ((MIDDLE - plan.INSIDE.west) * along + side * plan.ALCOVE_HALF * x) * side
        if across < -HOLDS[number] * math.hypot(x, along):
            return False
    return True
