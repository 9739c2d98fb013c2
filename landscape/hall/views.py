"""The hall's named views. Poses are chosen."""

from dataclasses import replace

from landscape.frame import Pose
from landscape.scene.scene import View
from landscape.settings.declare import Value

ELEMENTS = (
    *("room", "floor", "mirror", "door", "statue", "shadow", "sky", "caustics", "pool"),
    *("exhibits", "torches", "shafts", "mist", "tone", "flight", "sword"),
)
HELD = ("sword",)  # only a walker has it: no view shows it
STANDING = tuple(name for name in ELEMENTS if name not in HELD)

# One light that can be moved, and a floor that only it shines on.
ONE_LAMP: dict[str, Value] = {
    "shadow.flame": (1.33, 0.72, 0.72),
    "shadow.lamp": 0.014,
    "shadow.light": "torch",
    "shadow.casters": "all",
    "shadow.method": "darken",
    "shadow.strength": 0.75,
    "shadow.shine": 1.0,
    "shadow.sunlit": False,
    "mirror.strength": 0.4,
    "torches.glow": 0.9,
    "camera.fov": 54.0,
}

VIEWS = {
    view.name: replace(view, shown=STANDING)
    for view in (
        View("hall", "the great hall from its door", Pose(1.665, 0.12, 2.72, 353.5, 5.0), 20.0),
        View(
            "hall_sphere",
            "the gilded statue mirrors the hall",
            Pose(1.815, 0.20, 1.53, 326.0, 4.0),
            20.0,
        ),
        View(
            "hall_mist",
            "mist over the pool and the floor",
            Pose(1.70, 0.18, 2.52, 342.0, -2.0),
            20.0,
            settings={"mist.enabled": True},
        ),
        View(
            "hall_mirror",
            "the statue and its image in the polished floor",
            Pose(1.62, 0.13, 1.95, 356.0, -9.0),
            20.0,
        ),
        View(
            "hall_shadow",
            "the torch throws the dragon's shadow on the north wall",
            Pose(1.80, 0.44, 2.74, 343.0, -3.0),
            20.0,
            settings={"camera.fov": 36.0},
        ),
        View(
            "hall_one_floor",
            "dragon, shadow and mirror image on one floor, by a lamp to carry",
            Pose(1.55, 0.53, 2.14, 352.0, -34.0),
            20.0,
            settings=ONE_LAMP,
        ),
        View(
            "hall_ball",
            "a ball of silver mirrors the whole hall",
            Pose(1.75, 0.22, 1.62, 340.0, 0.0),
            20.0,
            settings={"statue.figure": "ball", "statue.gold": (0.95, 0.96, 1.0)},
        ),
        View(
            "hall_sky",
            "two layers of cloud over the hall's open ribs",
            Pose(1.6, 0.1, 1.75, 0.0, 42.0),
            540.0,
            settings={"room.vault": False},
        ),
        View(
            "hall_texture",
            "more contrast in the texture of the walls, and nowhere else",
            Pose(1.7, 0.2, 1.9, 320.0, 8.0),
            20.0,
            settings={
                "tone.texture": "wall",
                "tone.texture_contrast": 2.4,
                "tone.texture_brightness": -0.75,
            },
        ),
        View(
            "hall_contrast",
            "the statue in full contrast, all else dimmed",
            Pose(1.78, None, 1.62, 337.0, 6.0),
            20.0,
            settings={"tone.area": "surroundings", "tone.contrast": 0.48, "torches.glow": 0.9},
        ),
        View(
            "hall_caustics",
            "light in the pool, and thrown on the stone around it",
            Pose(1.74, 0.19, 2.56, 336.0, -16.0),
            20.0,
        ),
        View(
            "hall_exhibits",
            "six exhibits in the alcoves of the west wall",
            Pose(1.26, 0.14, 2.66, 312.0, -1.0),
            20.0,
        ),
        View(
            "hall_exhibit_volume",
            "a knot's shadow, counted in the stencil buffer",
            Pose(1.15, 0.16, 2.58, 276.0, -8.0),
            20.0,
        ),
        View(
            "hall_exhibit_soft",
            "the soft shadow of a lamp that is not a point",
            Pose(1.20, 0.15, 2.16, 278.0, -1.0),
            20.0,
        ),
        View(
            "hall_exhibit_blur",
            "sails that turn while the shutter is open",
            Pose(1.12, 0.15, 1.78, 276.0, -4.0),
            20.0,
        ),
        View(
            "hall_exhibit_focus",
            "three rabbits, of which a lens shows one sharp",
            Pose(1.10, 0.14, 1.40, 270.0, -8.0),
            20.0,
        ),
        View(
            "hall_exhibit_lines",
            "the dragon engraved, without hidden lines",
            Pose(1.09, 0.15, 1.0, 270.0, -7.0),
            20.0,
        ),
        View(
            "hall_exhibit_solids",
            "a sphere from which a beam is cut, by the stencil buffer",
            Pose(1.09, 0.16, 0.60, 270.0, -14.0),
            20.0,
        ),
    )
}
# The exhibits one by one are not measured, nor are views of one effect in another way.
MAIN = (
    *("hall", "hall_sphere", "hall_mist", "hall_mirror", "hall_shadow", "hall_contrast"),
    *("hall_caustics", "hall_exhibits"),
)
