"""The hall's constants as settings, a group for each effect; see landscape.settings.declare.

A safeguard is a setting that is on: turned off, it shows the artefact that it prevents.
"""

from dataclasses import dataclass
from typing import ClassVar

from landscape.elements.settings import Camera, Clock, Fog, Sound, Sun, Walk
from landscape.elements.settings.units import UNITS
from landscape.hall import plan
from landscape.hall.exhibits.settings import Exhibits
from landscape.settings.declare import Value, setting


@dataclass(frozen=True)
class Room:
    """The room (room.py)."""

    NEEDS: ClassVar[tuple[str, ...]] = ("room",)

    vault: bool = setting(
        True, "chosen", "webs of stone close the vault; off, only its ribs are there, under the sky"
    )


@dataclass(frozen=True)
class Pool:
    """The pool's water (pool.py)."""

    NEEDS: ClassVar[tuple[str, ...]] = ("pool",)

    absorbs: bool = setting(True, "chosen", "let the water dim the light from the bed")
    clear: tuple[float, ...] = setting(
        (0.20, 0.50, 1.0),
        "chosen",
        "the way through water on which a third of the light is left; red, green, blue",
        0.001,
        1000,
        unit=UNITS,
        needs=("pool.absorbs",),
    )
    mirrors: float = setting(
        1.6, "chosen", "what the surface mirrors; 1 is as much as water does", 0, 10
    )


@dataclass(frozen=True)
class Caustics:
    """The light that the pool's surface focuses (caustics.py)."""

    NEEDS: ClassVar[tuple[str, ...]] = ("caustics", "caustics.enabled")

    enabled: bool = setting(True, "glSkel, caustics", "the pool's water focuses the sun's light")
    passes: str = setting(
        "two",
        "glSkel, caustics",
        "how the net multiplies the bed: by a second, blended pass, or by texture units in one",
        choices=("two", "one"),
    )
    doubled: bool = setting(
        True, "chosen", "multiply by twice the net; off, as printed, it can only darken"
    )
    sunlit: bool = setting(
        True,
        "chosen",
        "the net is the stronger the more sunlight there is; off, as printed, it is in shade, too",
    )
    planes: str = setting(
        "object",
        "glSkel, caustics",
        "how coordinates are generated: object-linear, eye-linear, or eye-linear with the planes "
        "given before the viewing transform",
        choices=("object", "eye", "eye_before_camera"),
    )
    own_t: bool = setting(
        True, "chosen", "give t a plane of its own; off, as printed, it has the plane of s"
    )
    pattern: str = setting(
        "net",
        "chosen",
        "the film: a net of refracted light, or a product of sines",
        choices=("net", "sines"),
    )
    smooth: bool = setting(True, "chosen", "mix two frames of the film; off, it jumps")
    scale: float = setting(
        6.5, "chosen", "how often the net is repeated", 0.001, 1000, unit="nets per unit"
    )
    period: float = setting(220.0, "chosen", "length of the film", 1, 100000, unit="kt")
    reflected: float = setting(
        1.0, "chosen", "how much light the pool throws on pillars, walls and vault", 0, 4
    )


GLSKEL_MIRROR = "glSkel, reflection"
IMAGE = ("mirror.enabled",)


@dataclass(frozen=True)
class Mirror:
    """The mirror image in the polished floor."""

    NEEDS: ClassVar[tuple[str, ...]] = ("mirror",)

    enabled: bool = setting(True, GLSKEL_MIRROR, "the floor mirrors the hall")
    strength: float = setting(
        0.36, GLSKEL_MIRROR, "fraction of the mirror image in the floor's colour", 0, 1, needs=IMAGE
    )
    fresnel: bool = setting(True, "chosen", "the floor mirrors more at grazing angles", needs=IMAGE)
    fades: bool = setting(
        True,
        "chosen",
        "the image of the room is dimmer the higher it is above the floor",
        needs=IMAGE,
    )
    stencil: bool = setting(
        True, GLSKEL_MIRROR, "the image shows only where the floor is visible", needs=IMAGE
    )
    winding: bool = setting(
        True, GLSKEL_MIRROR, "the front face is swapped under the mirror", needs=IMAGE
    )
    normals: bool = setting(
        True,
        GLSKEL_MIRROR,
        "normals that glScalef made longer are normalized, in the image of the statue",
        needs=("mirror.enabled", "statue"),
    )
    lights: bool = setting(
        True, GLSKEL_MIRROR, "the lights are placed again under the mirror", needs=IMAGE
    )
    clip: bool = setting(
        True, "chosen", "what lies under the floor is clipped from the image", needs=IMAGE
    )
    underside: bool = setting(
        True, GLSKEL_MIRROR, "from below, the floor shows a side of another colour"
    )


GLSKEL_SHADOW = "glSkel, cast shadows"


@dataclass(frozen=True)
class Shadow:
    """The statue's shadows on floor and north wall."""

    NEEDS: ClassVar[tuple[str, ...]] = ("shadow", "statue", "floor or room", "shadow.enabled")

    enabled: bool = setting(True, GLSKEL_SHADOW, "the statue casts shadows")
    casters: str = setting(
        "statue",
        GLSKEL_SHADOW,
        "what the torch throws shadows of: the statue, or pillars and torches as well",
        choices=("statue", "all"),
        needs=("shadow.light!=sun",),
    )
    light: str = setting(
        "both", "chosen", "what casts them: torch, sun or both", choices=("torch", "sun", "both")
    )
    sunlit: bool = setting(
        True,
        "chosen",
        "the sun shines on floor and plinth; off, torches alone light them, and their shadows show",
    )
    method: str = setting(
        "relight",
        "chosen",
        "they darken by blending black, or the surface is drawn again without the light",
        choices=("darken", "relight"),
        needs=("shadow.stencil",),
    )
    strength: float = setting(
        0.6,
        GLSKEL_SHADOW,
        "how much light darkening takes away",
        0,
        1,
        needs=("shadow.method=darken or not shadow.stencil",),
    )
    shine: float = setting(
        0.0,
        "chosen",
        "how much light the torch adds to the floor where no shadow lies, as it may be moved",
        0,
        1,
        needs=("shadow.method=darken", "shadow.stencil", "shadow.light!=sun"),
    )
    lamp: float = setting(
        0.0,
        "chosen",
        "radius of what the torch shines from; above 0, shadows that darken have soft edges",
        0,
        0.2,
        unit="units",
        needs=("shadow.method=darken", "shadow.stencil", "shadow.light!=sun"),
    )
    flicker: float = setting(
        0.004,
        "chosen",
        "how far the torch's flame wavers",
        0,
        0.1,
        unit="units",
        needs=("shadow.light!=sun",),
    )
    flame: tuple[float, ...] = setting(
        (plan.TORCH[0], plan.TORCH[1] + plan.TORCH_FLAME, plan.TORCH[2]),
        "chosen",
        "where the torch's flame is: x, y, z; the light in the light map stays where it was baked",
        0,
        plan.SIZE,
        unit="units",
        needs=("shadow.light!=sun",),
    )
    misprint: str = setting(
        "none",
        GLSKEL_SHADOW,
        "draw by the last cell of the matrix, or by the equation of the plane, as printed",
        choices=("none", "matrix", "plane"),
    )
    stencil: bool = setting(
        True, GLSKEL_SHADOW, "only the surface is darkened, and no pixel twice by one light"
    )
    offset: bool = setting(
        True, GLSKEL_SHADOW, "glPolygonOffset keeps surface and shadow from fighting"
    )
    behind: bool = setting(
        True, "chosen", "what is beyond the light, or lit from behind the plane, casts no shadow"
    )


@dataclass(frozen=True)
class Statue:
    """The statue's gilding, which mirrors the hall."""

    NEEDS: ClassVar[tuple[str, ...]] = ("statue",)

    figure: str = setting(
        "dragon",
        "chosen",
        "what stands on the plinth: the dragon, or a ball, which mirrors the hall in one piece",
        choices=("dragon", "ball"),
    )
    environment: str = setting(
        "sphere",
        "glSkel, environment mapping",
        "how the statue mirrors the hall: by a sphere map, a cube map, or not at all",
        choices=("sphere", "cube", "none"),
    )
    generated: bool = setting(
        True,
        "glSkel, environment mapping",
        "coordinates are generated for what it mirrors; off, as GL_GEN_S would leave them",
        needs=("statue.environment!=none",),
    )
    fresh: bool = setting(
        True,
        "chosen",
        "the sphere map is made anew for each line of sight; off, it turns with the viewer",
        needs=("statue.environment=sphere",),
    )
    gold: tuple[float, ...] = setting(
        (1.0, 0.78, 0.40),
        "chosen",
        "colour of the gilding, which multiplies what it mirrors",
        0,
        1,
        unit="RGB",
        needs=("statue.environment!=none",),
    )


@dataclass(frozen=True)
class Sky:
    """The moving sky outside the windows."""

    NEEDS: ClassVar[tuple[str, ...]] = ("sky",)

    layers: int = setting(2, "glSkel, Quake's sky", "layers of cloud", 0, 2, unit="layers")
    sorted: bool = setting(
        True,
        "glSkel, Quake's sky",
        "the low clouds are laid over the high ones; where few of them overlap, little differs",
        needs=("sky.layers>1",),
    )


@dataclass(frozen=True)
class Mist:
    """Mist over the floor, in transparent sheets."""

    NEEDS: ClassVar[tuple[str, ...]] = ("mist", "mist.enabled")

    enabled: bool = setting(False, "glSkel, transparent textures", "mist lies over the floor")
    sheets: int = setting(5, "chosen", "how many sheets it is made of", 1, 30, unit="sheets")
    density: float = setting(0.53, "chosen", "opacity of a sheet where it is densest", 0, 1)
    sorted: bool = setting(
        True, "glSkel, transparent textures", "the sheets are blended from far to near"
    )
    mask: bool = setting(
        True, "glSkel, transparent textures", "the sheets do not write their depth"
    )
    clear: bool = setting(
        True, "chosen", "the sheets thin out around pillars and plinth, and before the eye"
    )


@dataclass(frozen=True)
class Tone:
    """Brightness and contrast of the picture, or of a part of it."""

    brightness: float = setting(
        0.0, "glSkel, scale and bias", "what is added to each colour", -1, 1, unit="of white"
    )
    contrast: float = setting(
        1.0, "glSkel, scale and bias", "what each colour is multiplied by", 0, 4, unit="times"
    )
    area: str = setting(
        "picture",
        "glSkel, scale and bias",
        "what is changed",
        choices=("picture", "statue", "surroundings"),
    )
    method: str = setting(
        "blend",
        "glSkel, scale and bias",
        "by blending quads, or by copying pixels through glPixelTransfer",
        choices=("blend", "pixels"),
    )
    doubling: bool = setting(
        True,
        "chosen",
        "a contrast above 1 by passes that multiply by up to 2; off, blending stops at 1",
        needs=("tone.method=blend", "tone.contrast>1"),
    )

    texture: str = setting(
        "none",
        "glSkel, scale and bias",
        "the stone whose texture is changed, without being loaded again",
        choices=("none", "wall", "floor", "vault", "pool"),
        needs=("room",),
    )
    texture_contrast: float = setting(
        1.0,
        "glSkel, scale and bias",
        "what each colour of that texture is multiplied by",
        0,
        8,
        unit="times",
        needs=("tone.texture!=none",),
    )
    texture_brightness: float = setting(
        0.0,
        "glSkel, scale and bias",
        "what is then added to it",
        -4,
        4,
        unit="of white",
        needs=("tone.texture!=none",),
    )


@dataclass(frozen=True)
class Torches:
    """The torches' flames."""

    faces: bool = setting(True, "chosen", "flames turn to face the viewer")
    glow: float = setting(0.55, "chosen", "brightness of the glow around each flame", 0, 2)


@dataclass(frozen=True)
class Shafts:
    """The sun's light in the hall's air."""

    enabled: bool = setting(True, "chosen", "the sun's light is visible in the air")
    strength: float = setting(
        0.085, "chosen", "how much light each sheet adds", 0, 1, needs=("shafts.enabled",)
    )


@dataclass(frozen=True)
class Flight:
    """The camera's flight around the statue."""

    enabled: bool = setting(False, "glSkel, quaternions", "the camera flies along its keyframes")
    interpolation: str = setting(
        "squad",
        "glSkel, quaternions",
        "how it turns from key to key: quaternions by SQUAD, which is smooth at the keys, or by "
        "SLERP, or each Euler angle on its own",
        choices=("squad", "slerp", "euler"),
        needs=("flight.enabled or flight.path",),
    )
    short: bool = setting(
        True,
        "Shoemake 1985",
        "SLERP takes the shorter of two arcs; off, it may turn the long way around",
        needs=("flight.enabled or flight.path", "flight.interpolation=slerp"),
    )
    path: bool = setting(
        False, "chosen", "draw the camera's axes along its path", needs=("not flight.enabled",)
    )
    kt_per_key: float = setting(
        70.0,
        "chosen",
        "how long it flies from key to key",
        1,
        10000,
        unit="kt",
        needs=("flight.enabled",),
    )


@dataclass(frozen=True)
class Settings:
    """All groups, with the hall's own defaults of those it shares with the island."""

    camera: Camera = Camera(fov=66.0, far=40.0, cull=True)
    clock: Clock = Clock()
    walk: Walk = Walk(speed=0.35, mouse_relative=True, bob=0.003, solid=True, jump=True)
    sound: Sound = Sound()
    # Chosen: in the south-east, so that the windows' light falls across the nave.
    sun: Sun = Sun(azimuth=103.0, elevation=30.0, diffuse=(1.0, 0.92, 0.78), ambient=(0.3,) * 3)
    fog: Fog = Fog(enabled=False)
    room: Room = Room()
    statue: Statue = Statue()
    sky: Sky = Sky()
    mist: Mist = Mist()
    tone: Tone = Tone()
    flight: Flight = Flight()
    mirror: Mirror = Mirror()
    pool: Pool = Pool()
    caustics: Caustics = Caustics()
    exhibits: Exhibits = Exhibits()
    shadow: Shadow = Shadow()
    torches: Torches = Torches()
    shafts: Shafts = Shafts()


PRESETS: dict[str, dict[str, Value]] = {"best": {}}
