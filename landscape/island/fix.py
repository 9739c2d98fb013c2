"""A fix for a flaw in the pictures of 2006, shown by one picture before and one after."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from landscape.frame import Pose
from landscape.island.views import OUTDOORS, VIEWS
from landscape.scene.safeguard import Comparison
from landscape.scene.scene import View
from landscape.settings.declare import Value

GROUND = None  # as a pose's y: eye height above the ground


@dataclass(frozen=True)
class Fix(Comparison):
    """One fix: a picture before it, and one after; ``flaw`` says which figure shows the flaw.

    ``after_pose`` replaces the pose in the second picture. ``common`` are settings of both
    pictures; ``only`` names the elements to show.
    """

    common: Mapping[str, Value] = field(default_factory=dict)
    only: tuple[str, ...] = OUTDOORS
    after_pose: Pose | None = None

    def settings(self, after: bool) -> dict[str, Value]:
        """Return the settings of one picture, on top of the preset 2006."""
        return {**self.common, **(self.on if after else self.off)}

    def pose(self, after: bool) -> Pose:
        """Return the pose of one picture; its y may be GROUND."""
        if after and self.after_pose is not None:
            return self.after_pose
        return VIEWS[self.view].pose if isinstance(self.view, str) else self.view

    def as_view(self) -> View:
        """Return the view that the picture after the fix shows, under the fix's name."""
        return View(
            self.name,
            self.title,
            self.pose(True),
            self.kt,
            preset="2006",
            shown=self.only,
            settings=self.settings(True),
        )
