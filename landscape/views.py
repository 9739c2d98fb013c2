"""Named views: one for each render panel of the report's figures (figures.csv).

A pose's y of None means the walker's eye height above the ground there. Poses are chosen: the
report gives pictures, not places.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from landscape.frame import Pose

if TYPE_CHECKING:
    from landscape.elements.ground import HeightField

ALL = (
    "ground", "water", "sky", "trees", "deer", "plants", "grass", "castle", "rabbit", "dragon",
    "sword", "map", "fog", "reflection",
)  # fmt: skip
SCENE = tuple(e for e in ALL if e not in ("sword", "map"))


@dataclass(frozen=True)
class View:
    """A place and its switches. ``pose.y`` may be NaN: eye height above the ground."""

    name: str
    shows: str
    pose: Pose
    kt: float = 0.0
    preset: str = "2006"
    shown: tuple[str, ...] = ALL
    settings: Mapping[str, Any] = field(default_factory=dict)
    stroke: int = 0
    wireframe: bool = False

    @property
    def figure(self) -> str:
        """The report's figure and panel, as in "35 a"."""
        return f"{self.name[3:-1]} {self.name[-1]}" if self.name.startswith("fig") else ""

    def place(self, ground: "HeightField", eye: float) -> Pose:
        """Return the pose with its y: ``eye`` units above the ground where none is given."""
        pose = self.pose
        if pose.y == pose.y:
            return pose
        y = float(ground.height(pose.x, pose.z)) + eye
        return Pose(pose.x, y, pose.z, pose.yaw, pose.pitch)


def walking(x: float, z: float, yaw: float, pitch: float = 0.0) -> Pose:
    """Return a pose at eye height above the ground."""
    return Pose(x, float("nan"), z, yaw, pitch)


def _table(*views: View) -> dict[str, View]:
    return {view.name: view for view in views}


VIEWS = _table(
    View("fig35a", "wide view: vegetation and reflections", Pose(8.0, 1.0, 33.5, 25.0, -2.0), 40),
    View("fig35b", "dense grass, deer by the plants, sea beyond", walking(20.0, 30.0, 190.0), 20),
    View("fig35c", "the rabbit close, in vegetation", walking(20.0, 24.55, 40.0, -4.0), 10),
    View("fig35d", "a deer in a natural setting", walking(22.0, 22.0, 0.0), 30),
    View("fig35e", "many trees, castle in the haze", walking(21.0, 20.5, 62.0, 3.0), 50),
    View("fig35f", "arriving at the castle", walking(26.95, 18.6, 15.0, 12.0), 24),
    View("fig35g", "from the hill top: sea and islets", Pose(28.6, 2.7, 17.0, 95.0, -10.0), 60),
    View("fig35h", "an islet with a deer reflected", Pose(30.6, 0.75, 19.4, 96.0, 0.0), 70),
    View("fig35i", "approaching the dragon, sword in view", walking(13.4, 27.4, 235.0, 0.0), 15),
)


def placed_views() -> list[dict[str, Any]]:
    """Return every view as `landscape views --json` prints it, heights filled in."""
    from landscape.assets import Assets
    from landscape.elements.ground import height_field, read_heights
    from landscape.settings import preset

    entries = []
    for view in VIEWS.values():
        values = preset(view.preset)
        path = Assets().path(values.ground.height_image)
        ground = height_field(read_heights(path), values.ground, values.water.level)
        pose = view.place(ground, values.walk.eye)
        entries.append(
            {
                "name": view.name,
                "figure": view.figure,
                "pose": [round(v, 4) for v in (pose.x, pose.y, pose.z, pose.yaw, pose.pitch)],
                "kt": view.kt,
                "preset": view.preset,
            }
        )
    return entries
