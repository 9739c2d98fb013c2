"""The settings of the camera."""

from dataclasses import dataclass

from landscape.elements.settings.units import DEGREES, UNITS
from landscape.settings.declare import setting


@dataclass(frozen=True)
class Camera:
    """The perspective of the walker's eye."""

    fov: float = setting(60.0, "chosen", "vertical field of view", 1, 170, unit=DEGREES)
    near: float = setting(0.02, "chosen", "distance of the near plane", 1e-4, 10, unit=UNITS)
    cull: bool = setting(False, "chosen", "skip what is outside the view frustum, and back faces")
    lod_pixels: float = setting(
        0.0,
        "chosen",
        "error allowed in a mesh simplified by vertex clustering; 0 is full detail",
        0,
        100,
        unit="pixels",
        needs=("rabbit or dragon",),
    )
    far: float = setting(120.0, "chosen", "distance of the far plane", 1, 1e5, unit=UNITS)
    lens: float = setting(
        0.0,
        "chosen",
        "radius of the lens, which blurs what is out of focus in stills, films and posters",
        0,
        1,
        unit=UNITS,
        needs=("not walk",),
    )
    focus: float = setting(
        0.5, "chosen", "distance of what is sharp", 0.01, 1e4, unit=UNITS, needs=("camera.lens",)
    )
    lens_points: int = setting(
        48,
        "chosen",
        "points of the lens that are used at most; each draws the scene once",
        1,
        256,
        unit="points",
        needs=("camera.lens",),
    )
