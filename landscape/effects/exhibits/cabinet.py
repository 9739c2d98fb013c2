"""The cabinet: which exhibits are in view, and the order in which they are drawn."""

from typing import Any

from landscape.effects import plan
from landscape.effects.exhibits.accumulation import NEEDS, Accumulation
from landscape.effects.exhibits.depth_of_field import DepthOfField
from landscape.effects.exhibits.hidden_lines import HiddenLines
from landscape.effects.exhibits.motion_blur import MotionBlur
from landscape.effects.exhibits.niche import (
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
from landscape.effects.exhibits.shadow_volume import ShadowVolume
from landscape.effects.exhibits.soft_shadow import SoftShadow
from landscape.effects.exhibits.solids import Solids
from landscape.effects.settings import Settings
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.culling import ball_in_view
from landscape.gl.extensions import first_missing, tell_off

RADIUS = 0.22  # units: a ball around the middle of an alcove that holds it
FAR = 0.9  # chosen: units beyond which an exhibit is shown without its effect


class Cabinet:
    """The six alcoves of the west wall."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Build stone and exhibits."""
        self._settings = settings
        self._stone = Stone(assets)
        self._accumulation: Accumulation | None = None
        if need := first_missing(NEEDS):
            tell_off("exhibits.soft, exhibits.blur, exhibits.focus", need)
        else:
            self._accumulation = Accumulation(settings.exhibits.deep)
        sums = self._accumulation
        self._solids = Solids(settings, assets)
        self._exhibits: dict[int, tuple[str, Any]] = {
            LINES: ("lines", HiddenLines(settings, assets)),
            FOCUS: ("focus", DepthOfField(settings, assets, sums)),
            BLUR: ("blur", MotionBlur(settings, assets, sums)),
            SOFT: ("soft", SoftShadow(settings, assets, sums)),
            VOLUME: ("volume", ShadowVolume(settings, assets, self._stone)),
        }

    def apply(self, settings: Settings) -> bool:
        """Apply new settings; return False, changing nothing, if a lamp has another size."""
        if settings.exhibits.soft_lamp != self._settings.exhibits.soft_lamp:
            return False
        self._settings = settings
        if self._accumulation is not None:
            self._accumulation.set_deep(settings.exhibits.deep)
        self._solids.apply(settings)
        for _, exhibit in self._exhibits.values():
            exhibit.apply(settings)
        return True

    def draw_first(self, frame: Frame) -> None:
        """Draw what needs an empty depth buffer; the rest of the hall comes after it."""
        shown = self._settings.exhibits.solids and in_view(frame, SOLIDS)
        if shown and (near(frame, SOLIDS) or not frame.mirrored):
            self._solids.draw(frame)

    def draw(self, frame: Frame) -> None:
        """Draw the alcoves in view; mirrored, or from afar, without effects.

        The mirror image has no models that are far away: they show there as a few pixels.
        """
        seen = [number for number in range(len(plan.ALCOVES)) if in_view(frame, number)]
        for number in seen:
            name, exhibit = self._exhibits.get(number, ("", None))
            shown = exhibit is not None and getattr(self._settings.exhibits, name)
            close = near(frame, number)
            effect = shown and close and not frame.mirrored
            if not (effect and name == "volume"):
                self._stone.draw(number)
            if effect:
                exhibit.draw(frame)
            elif shown and (close or not frame.mirrored):
                exhibit.draw_plain(frame)
        if seen:
            self._stone.draw_plates()

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
