"""The fly-over's constants and switches as settings; see :mod:`landscape.settings.declare`.

Each technique has a switch. With one off, the picture is made in the simple way: it takes longer,
or it shows the flaw that the technique avoids.
"""

from dataclasses import dataclass
from typing import ClassVar

from framelens.base.errors import InputError
from landscape.elements.settings.units import PER_SECOND, UNITS
from landscape.settings.declare import Value, setting

DOCUMENT = (
    "fly-over, section 2.1"  # the document of the student project, "Transformation 3D vers 2D"
)
ENVIRONMENT = "fly-over, section 2.3"  # the same, "Format du fichier d'environnement"
SUMMARY = "fly-over, section 3"  # its list of techniques
FARTHEST = 1e5  # units, chosen
# Of a tile's side. Its diagonal is 1.4 of them, and a tile may begin at one end of a level's reach:
# from 2.8 up, the levels on both sides of a border differ by one.
LEAST_DENSITY = 3.0
# Chosen: each process has its own share of the work that cannot be divided.
MOST_PROCESSES = 4
LINES = ("flyover.mode=lines",)


@dataclass(frozen=True)
class Flyover:
    """The view volume, the terrain, and the techniques that make drawing it fast."""

    left: float = setting(-1.0, DOCUMENT, "left edge of the near rectangle", -100, 100, unit=UNITS)
    right: float = setting(1.0, DOCUMENT, "right edge of the near rectangle", -100, 100, unit=UNITS)
    top: float = setting(1.0, DOCUMENT, "top edge of the near rectangle", -100, 100, unit=UNITS)
    bottom: float = setting(-1.0, DOCUMENT, "bottom edge of it", -100, 100, unit=UNITS)
    near: float = setting(1.5, DOCUMENT, "distance of the near plane", 1e-3, 1000, unit=UNITS)
    far: float = setting(4096.0, DOCUMENT, "distance of the far plane", 1, FARTHEST, unit=UNITS)
    widen: bool = setting(
        True,
        "chosen",
        "left and right move apart by width over height of the picture; off, it is stretched",
    )
    unit: float = setting(
        1.0, ENVIRONMENT, "distance between two pixels of the height image", 1e-3, 1000, unit=UNITS
    )
    resolution: int = setting(
        0,
        ENVIRONMENT,
        "pixels on the longer side of the height image, which is then sampled again; 0: its own",
        0,
        4096,
        unit="pixels",
    )
    relief: float = setting(
        64.0, "chosen", "height of black above white in the height image", 0, 1e4, unit=UNITS
    )
    black_high: bool = setting(True, ENVIRONMENT, "black is high; off, white is")
    mirror: bool = setting(
        True, ENVIRONMENT, "the terrain is continued by mirror images of itself, without end"
    )
    height: float = setting(
        2.0,
        ENVIRONMENT,
        "distance of the camera above the ground on its path",
        0.01,
        1e4,
        unit=UNITS,
    )
    speed: float = setting(
        20.0, "chosen", "how fast the camera goes along its path", 0.1, 1e4, unit=PER_SECOND
    )
    turn: float = setting(
        60.0,
        "chosen",
        "how fast it turns to the nearest point to look at",
        0.1,
        1e4,
        unit="degrees per second",
    )
    ahead: bool = setting(
        True,
        "chosen",
        "only points ahead of it count, and without one it looks along its path; off, the nearest "
        "of all, as in section 2.3",
    )
    ease: float = setting(
        0.5,
        "chosen",
        "time in which it starts and stops turning; 0 is at once",
        0,
        10,
        unit="seconds",
    )
    smooth: float = setting(
        4.0,
        "chosen",
        "how far around it the highest ground counts; 0 is a fixed distance, as in section 2.3",
        0,
        100,
        unit=UNITS,
    )
    bounding_volumes: bool = setting(
        True, ENVIRONMENT, "tiles of terrain whose box is off the screen are dropped as a whole"
    )
    quad_tree: bool = setting(
        True,
        SUMMARY,
        "boxes are tested from large to small: four tiles at once, or sixteen, and so on",
        needs=("flyover.bounding_volumes",),
    )
    back_faces: bool = setting(
        True, SUMMARY, "edges whose two triangles are turned away from the camera are dropped"
    )
    strips: bool = setting(
        True, ENVIRONMENT, "an edge that two triangles share is drawn once, not twice"
    )
    patch: str = setting(
        "8", "chosen", "quads on a side of a tile", choices=("4", "8", "16"), unit="quads"
    )
    detail: bool = setting(
        True, ENVIRONMENT, "distant terrain has fewer vertices; off, each pixel of the image is one"
    )
    density: float = setting(
        40.0,
        "chosen",
        "how far each level of detail reaches; higher draws more lines",
        12,
        400,
        unit="quads",
        needs=("flyover.detail",),
    )
    morph: bool = setting(
        True,
        "chosen",
        "vertices glide to where the next level has them; off, there are cracks, and edges pop up",
        needs=("flyover.detail",),
    )
    morph_part: float = setting(
        0.4,
        "chosen",
        "part of a level's reach in which they glide, less where tiles are too large for it",
        0.01,
        0.5,
        unit="of the reach",
        needs=("flyover.detail", "flyover.morph"),
    )
    fade: bool = setting(
        True,
        "chosen",
        "edges that the next level does not have get shorter before it; off, they are double",
        needs=("flyover.detail", "flyover.morph", "flyover.strips"),
    )
    far_undetailed: float = setting(
        256.0,
        "chosen",
        "the far plane while detail is off, if it is nearer: each pixel is then a vertex",
        1,
        2048,
        unit=UNITS,
        needs=("not flyover.detail",),
    )
    mode: str = setting(
        "lines",
        "fly-over, section 2.1",
        "what is drawn: the triangles' edges, or the ground with its colours",
        choices=("lines", "filled"),
    )
    hidden_lines: bool = setting(
        True,
        "chosen",
        "lines behind the terrain are removed; off, one sees through it",
        needs=LINES,
    )
    colours: str = setting(
        "plain",
        "fly-over, section 2.2.2",
        "colours of the lines: black on white, fading with distance, by height, or a green screen",
        choices=("plain", "distance", "height", "phosphor"),
        needs=LINES,
    )
    visible: float = setting(
        1400.0, "chosen", "how far one sees through the haze", 1, FARTHEST, unit=UNITS
    )


@dataclass(frozen=True)
class Filled:
    """The ground with its colours, light, water and sky."""

    NEEDS: ClassVar[tuple[str, ...]] = ("flyover.mode=filled",)

    smooth: bool = setting(
        True, "chosen", "the ground is a surface; off, it is blocks as in 1992, and texels squares"
    )
    levels: bool = setting(True, "chosen", "far ground comes from smaller copies; off, it glitters")
    step: float = setting(
        0.02,
        "chosen",
        "distance from one look at the ground to the next",
        0.002,
        0.5,
        unit="times the distance",
    )
    fog: bool = setting(True, "chosen", "far ground fades into the haze")
    shadows: bool = setting(True, "chosen", "the sun's shadows")
    occlusion: bool = setting(True, "chosen", "hollows, which see less of the sky, are darker")
    reflection: bool = setting(True, "chosen", "water mirrors the sky")
    clouds: bool = setting(True, "chosen", "there are clouds")
    edges: bool = setting(True, "chosen", "ridges are blended with what is behind them")
    sea: float = setting(
        0.1,
        "chosen",
        "height of the water; 0 is none",
        0,
        1,
        unit="times the relief",
    )
    sun_azimuth: float = setting(
        215.0, "chosen", "where the sun is, from +x towards +y", -360, 360, unit="degrees"
    )
    sun_elevation: float = setting(
        32.0, "chosen", "height of the sun above the horizon", 1, 90, unit="degrees"
    )
    texels: int = setting(
        2048,
        "chosen",
        "side of the picture of the ground and its mirror images; a power of two below it is taken",
        16,
        8192,
        unit="texels",
    )
    image: str = setting(
        "none",
        "chosen",
        "picture of the ground, instead of colours by height; none is without",
        unit="image file",
    )


@dataclass(frozen=True)
class Settings:
    """All groups."""

    flyover: Flyover = Flyover()
    filled: Filled = Filled()


BEST = "best"
# "document" is the project as the document asks for it, "best" is what one should see first.
PRESETS: dict[str, dict[str, Value]] = {
    "document": {
        "flyover.widen": False,
        "flyover.smooth": 0.0,
        "flyover.ahead": False,
        "flyover.ease": 0.0,
        "flyover.hidden_lines": False,
    },
    BEST: {"flyover.colours": "height"},
}


def check(settings: Settings) -> None:
    """Raise InputError where the values of two settings contradict each other."""
    ours = settings.flyover
    pairs = (
        ("left", ours.left, "right", ours.right),
        ("bottom", ours.bottom, "top", ours.top),
        ("near", ours.near, "far", ours.far),
    )
    for low, least, high, most in pairs:
        if least >= most:
            raise InputError(
                "setting flyover.{low}: expected less than flyover.{high} ({most:g}), "
                "not {value:g}",
                low=low,
                high=high,
                most=most,
                value=least,
            )

    if ours.resolution == 1 or ours.resolution & (ours.resolution - 1):
        raise InputError(
            "setting flyover.resolution: expected 0 or a power of two from 2, not {resolution}",
            resolution=ours.resolution,
        )

    least = LEAST_DENSITY * int(ours.patch)
    if ours.detail and ours.density < least:
        raise InputError(
            "setting flyover.density: expected at least {least:g}, three times "
            "flyover.patch, not {density:g}",
            least=least,
            density=ours.density,
        )
