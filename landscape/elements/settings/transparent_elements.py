"""The settings of trees, deer and plants: of all together, and of each kind."""

from dataclasses import dataclass
from typing import ClassVar

from landscape.elements.settings.units import UNITS
from landscape.settings.declare import setting


@dataclass(frozen=True)
class Transparent:
    """Settings shared by trees, deer and plants (section 5.1)."""

    NEEDS: ClassVar[tuple[str, ...]] = ("trees or deer or plants",)

    radius: float = setting(
        8.0,
        "chosen",
        "sprites farther away are not drawn (square root of PERIMETER_VISU_TRANSPARENT)",
        0,
        1000,
        unit=UNITS,
    )
    sorted: bool = setting(
        True, "section 5.1.2", "draw from far to near", needs=("transparent.textured",)
    )
    textured: bool = setting(True, "figure 16", "texture the quads")
    places: str = setting(
        "random",
        "section 5.1.2",
        "where they stand: random, or as a file says that `landscape places` wrote",
        unit="random, or CSV file",
    )
    surround: str = setting(
        "alpha",
        "section 5.1.1",
        "what is around their pictures: transparency, as their alpha says; white; or white "
        "that was replaced by transparency",
        choices=("alpha", "white", "keyed"),
        needs=("transparent.textured",),
    )
    faces: str = setting(
        "plane",
        "section 11.2.1",
        "billboards are parallel to the picture's plane and turn with the camera, or they face the "
        "eye's place",
        choices=("plane", "place"),
    )
    upright: bool = setting(False, "R4, section 11.2.1", "billboards turn about the y axis only")
    follow_slope: bool = setting(
        False, "section 11.2.6", "trees and plants, too, stand perpendicular to the slope"
    )
    split: bool = setting(
        False,
        "R3, section 5.1.1",
        "cut sprites where they cross, and sort the parts separately: halves of crossed quads, and "
        "parts of trees and deer",
        needs=("transparent.sorted", "transparent.textured"),
    )
    fade: float = setting(
        0.0,
        "chosen",
        "how far from the edge of the radius sprites fade in",
        0,
        1,
        unit="of the radius",
        needs=("transparent.textured",),
    )
    clear_near: bool = setting(False, "chosen", "sprites fade out close to the eye")
    rooted: bool = setting(
        False, "chosen", "feet are sunk slightly into slopes", needs=("trees or plants",)
    )
    trimmed: bool = setting(
        False,
        "chosen",
        "quads fit the opaque part of the picture; those outside the frustum are not sent",
    )
    sunward: float = setting(
        0.0,
        "chosen",
        "how much darker by day the side is that faces away from the sun",
        0,
        1,
        unit="of 1",
        needs=("transparent.textured",),
    )
    contact: float = setting(
        0.0,
        "chosen",
        "how dark the soft shadow is at the feet of trees and deer",
        0,
        1,
        unit="of 1",
        needs=("transparent.textured", "trees or deer", "trees.variety or deer.variety"),
    )
    min_pixels: float = setting(
        0.0, "chosen", "sprites lower than this fade out", 0, 100, unit="pixels"
    )
    trilinear: bool = setting(
        True,
        "chosen",
        "trilinear filtering; off, the nearest mip level",
        needs=("transparent.textured",),
    )


@dataclass(frozen=True)
class Trees:
    """Billboards (section 5.1)."""

    NEEDS: ClassVar[tuple[str, ...]] = ("trees", "trees.count")

    count: int = setting(900, "chosen", "how many trees there are", 0, 200_000, unit="trees")
    species: int = setting(2, "figure 15", "how many kinds of tree there are", 1, 4, unit="kinds")
    size_min: float = setting(
        0.325, "section 5.1.2", "least width and height", 0.001, 100, unit=UNITS
    )
    size_max: float = setting(
        0.65, "section 5.1.2", "greatest width and height", 0.001, 100, unit=UNITS
    )
    grouped: bool = setting(
        False, "chosen", "woods and clearings instead of a uniform distribution"
    )
    crown: bool = setting(
        False, "R4, section 11.2.1", "a horizontal crown picture, visible from above"
    )
    variety: bool = setting(
        False,
        "chosen",
        "several individuals of each species, in groups with saplings and bushes",
        needs=("trees.grouped",),
    )


@dataclass(frozen=True)
class Deer:
    """Billboards (section 5.1)."""

    NEEDS: ClassVar[tuple[str, ...]] = ("deer", "deer.count")

    count: int = setting(70, "chosen", "how many deer there are", 0, 200_000, unit="deer")
    species: int = setting(
        1,
        "figure 15",
        "how many pictures there are: the stag's, or the doe's as well",
        1,
        2,
        unit="kinds",
    )
    size_min: float = setting(0.10, "chosen", "least width and height", 0.001, 100, unit=UNITS)
    size_max: float = setting(0.14, "chosen", "greatest width and height", 0.001, 100, unit=UNITS)
    follow_slope: bool = setting(
        False, "R5, section 11.2.6", "stand perpendicular to the slope, feet on the ground"
    )
    variety: bool = setting(
        False, "chosen", "stags and does of several poses, on grass rather than rock"
    )
    back: bool = setting(
        False,
        "section 11.2.1",
        "a horizontal picture of the back, visible from above",
        needs=("deer.variety or plants.species>1",),
    )


@dataclass(frozen=True)
class Plants:
    """Crossed quads (section 5.2)."""

    NEEDS: ClassVar[tuple[str, ...]] = ("plants", "plants.count")

    count: int = setting(1500, "chosen", "how many plants there are", 0, 200_000, unit="plants")
    size_min: float = setting(0.06, "chosen", "least width and height", 0.001, 100, unit=UNITS)
    size_max: float = setting(0.14, "chosen", "greatest width and height", 0.001, 100, unit=UNITS)
    sway: float = setting(
        1.0, "section 5.2.2", "how far the wind moves them", 0, 100, unit="times the report's sway"
    )
    sway_by_size: bool = setting(
        False, "chosen", "a small plant sways less; off, all sway as far, as in 2006"
    )
    species: int = setting(
        1,
        "chosen",
        "the report's one kind, or fern, ox-eye, willow-herb, marram and heather, in this order",
        1,
        5,
        unit="kinds",
    )
    radius: float = setting(
        0.0,
        "chosen",
        "plants farther away are not drawn; 0 is transparent.radius",
        0,
        1000,
        unit=UNITS,
    )
    shaded: bool = setting(
        False,
        "chosen",
        "plants are darker in the ground's shadows",
        needs=("ground.shadows", "transparent.textured"),
    )
    quads: int = setting(
        2,
        "R6, section 11.2.2",
        "quads per plant: two at right angles, or three at 60 degrees",
        2,
        3,
        unit="quads",
    )
    fade_edge_on: bool = setting(
        False, "R6, section 11.2.2", "quads seen edge-on fade out", needs=("transparent.textured",)
    )
    crossed_within: float = setting(
        0.0, "chosen", "plants farther away are single billboards; 0 is never", 0, 1000, unit=UNITS
    )
    rosette: bool = setting(False, "R6, section 11.2.2", "a horizontal rosette, visible from above")
