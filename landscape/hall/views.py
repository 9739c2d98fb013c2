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

IN_NAVE = Pose(1.665, 0.12, 2.72, 353.5, 5.0)
ALONG_POOL = Pose(1.74, 0.19, 2.56, 336.0, -16.0)
BEFORE_MIRROR = Pose(1.62, 0.13, 1.95, 356.0, -9.0)
ALCOVES = Pose(1.26, 0.14, 2.66, 312.0, -1.0)
BEFORE_VOLUME = Pose(1.15, 0.16, 2.58, 276.0, -8.0)
BEFORE_SOFT = Pose(1.20, 0.15, 2.16, 278.0, -1.0)
BEFORE_BLUR = Pose(1.12, 0.15, 1.78, 276.0, -4.0)
BEFORE_FOCUS = Pose(1.10, 0.14, 1.40, 270.0, -8.0)
BEFORE_SOLIDS = Pose(1.09, 0.16, 0.60, 270.0, -14.0)
IN_MIST = Pose(1.70, 0.18, 2.52, 342.0, -2.0)
UNDER_SKY = Pose(1.6, 0.1, 1.75, 0.0, 42.0)

# Each shows what settings do that no other view changes.
VARIANTS = (
    View(
        "hall_fog",
        "fog of even density from the statue on, in the hall's own colour",
        IN_NAVE,
        20.0,
        settings={
            "fog.enabled": True,
            "fog.mode": "linear",
            "fog.start": 0.6,
            "fog.end": 3.6,
            "fog.color": (0.50, 0.44, 0.36),
            "fog.radial": True,
        },
    ),
    View(
        "hall_mist_thick",
        "thick mist of twelve sheets",
        IN_MIST,
        20.0,
        settings={"mist.enabled": True, "mist.sheets": 12, "mist.density": 0.8},
    ),
    View(
        "hall_air",
        "the sun's light in dusty air",
        IN_NAVE,
        20.0,
        settings={"shafts.strength": 0.25},
    ),
    View(
        "hall_bare",
        "no sunlight in the air, and flames that do not turn to the viewer",
        Pose(1.5, 0.14, 2.2, 40.0, 6.0),
        20.0,
        settings={"shafts.enabled": False, "torches.faces": False},
    ),
    View(
        "hall_mirror_even",
        "a floor that mirrors as much at all angles, high and low alike",
        BEFORE_MIRROR,
        20.0,
        settings={"mirror.fresnel": False, "mirror.fades": False},
    ),
    View(
        "hall_pool_plain",
        "the pool without its optics: no colour, no mirror image, no light thrown on the stone",
        ALONG_POOL,
        20.0,
        settings={"pool.absorbs": False, "pool.mirrors": 0.0, "caustics.reflected": 0.0},
    ),
    View(
        "hall_net",
        "a coarse net of light that changes slowly and in jumps, in murky water",
        ALONG_POOL,
        100.0,
        settings={
            "caustics.scale": 2.5,
            "caustics.period": 900.0,
            "caustics.smooth": False,
            "pool.clear": (0.05, 0.12, 0.10),
        },
    ),
    View(
        "hall_clouds",
        "high clouds laid over the low ones",
        UNDER_SKY,
        540.0,
        settings={"room.vault": False, "sky.sorted": False},
    ),
    View(
        "hall_flight_far",
        "the flying camera turns the long way around",
        IN_NAVE,
        330.0,
        settings={
            "flight.enabled": True,
            "flight.interpolation": "slerp",
            "flight.short": False,
            "flight.kt_per_key": 90.0,
        },
    ),
    View(
        "hall_alcoves",
        "the alcoves of the west wall, empty",
        ALCOVES,
        20.0,
        settings={
            f"exhibits.{effect}": False
            for effect in ("volume", "soft", "blur", "focus", "lines", "solids")
        },
    ),
    View(
        "hall_volume",
        "the volume of the knot's shadow",
        BEFORE_VOLUME,
        20.0,
        settings={"exhibits.volume_shown": True},
    ),
    View(
        "hall_lamp",
        "the soft shadow of a larger lamp",
        BEFORE_SOFT,
        20.0,
        settings={"exhibits.soft_lamp": 0.04},
    ),
    View(
        "hall_shutter",
        "sails at four instants of a long exposure",
        BEFORE_BLUR,
        20.0,
        settings={"exhibits.blur_samples": 4, "exhibits.blur_shutter": 40.0},
    ),
    View(
        "hall_lens",
        "a lens so wide that only one rabbit is more than a blur",
        BEFORE_FOCUS,
        20.0,
        settings={"exhibits.focus_lens": 0.05},
    ),
    View(
        "hall_solids",
        "what sphere and beam have in common",
        BEFORE_SOLIDS,
        20.0,
        settings={"exhibits.solids_operation": "intersection"},
    ),
)

VIEWS = {
    view.name: replace(view, shown=STANDING)
    for view in (
        View("hall", "the great hall from its door", IN_NAVE, 20.0),
        View(
            "hall_sphere",
            "the gilded statue mirrors the hall",
            Pose(1.815, 0.20, 1.53, 326.0, 4.0),
            20.0,
        ),
        View(
            "hall_mist",
            "mist over the pool and the floor",
            IN_MIST,
            20.0,
            settings={"mist.enabled": True},
        ),
        View(
            "hall_mirror",
            "the statue and its image in the polished floor",
            BEFORE_MIRROR,
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
            UNDER_SKY,
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
            ALONG_POOL,
            20.0,
        ),
        View(
            "hall_exhibits",
            "six exhibits in the alcoves of the west wall",
            ALCOVES,
            20.0,
        ),
        View(
            "hall_exhibit_volume",
            "a knot's shadow, counted in the stencil buffer",
            BEFORE_VOLUME,
            20.0,
        ),
        View(
            "hall_exhibit_soft",
            "the soft shadow of a lamp that is not a point",
            BEFORE_SOFT,
            20.0,
        ),
        View(
            "hall_exhibit_blur",
            "sails that turn while the shutter is open",
            BEFORE_BLUR,
            20.0,
        ),
        View(
            "hall_exhibit_focus",
            "three rabbits, of which a lens shows one sharp",
            BEFORE_FOCUS,
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
            BEFORE_SOLIDS,
            20.0,
        ),
        *VARIANTS,
    )
}
# The exhibits one by one are not measured, nor are views of one effect in another way.
MAIN = (
    *("hall", "hall_sphere", "hall_mist", "hall_mirror", "hall_shadow", "hall_contrast"),
    *("hall_caustics", "hall_exhibits"),
)
