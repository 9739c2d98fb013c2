"""The island's constants as settings: key, value, unit, source; and its two presets.

The defaults are the preset ``2006``: the report's numbers where it gives them, "chosen" where it
does not. The preset ``best`` is a table of differences. See :mod:`landscape.keys`.
"""

from dataclasses import dataclass
from typing import ClassVar

from landscape import keys
from landscape.keys import Renamed, Value, setting


@dataclass(frozen=True)
class Camera:
    """The perspective of the walker's eye."""

    fov: float = setting(60.0, "chosen", "degrees, vertical", 1, 170)
    near: float = setting(0.02, "chosen", "units", 1e-4, 10)
    cull: bool = setting(False, "chosen", "skip what is outside the view frustum, and back faces")
    lod_pixels: float = setting(
        0.0,
        "chosen",
        "pixels of error allowed in a mesh simplified by vertex clustering; 0 is full detail",
        0,
        100,
    )
    far: float = setting(120.0, "chosen", "units", 1, 1e5)


@dataclass(frozen=True)
class Clock:
    """kt, the counter all animation reads; in 2006 it grew by one per displayed frame."""

    kt_per_second: float = setting(30.0, "chosen", "kt per second", 0, 1000)


@dataclass(frozen=True)
class Walk:
    """How the walker moves (Position in 2006)."""

    speed: float = setting(0.9, "chosen", "units per second", 0, 100)
    run: float = setting(3.0, "chosen", "times the walking speed", 1, 100)
    turn: float = setting(75.0, "chosen", "degrees per second, by the arrows", 0, 1000)
    mouse: float = setting(0.12, "chosen", "degrees per pixel", 0, 10)
    mouse_relative: bool = setting(
        False,
        "R13, section 11.2.6",
        "mouse motion turns the view; otherwise the pointer's position sets it",
    )
    eye: float = setting(0.1, "section 8.2", "units above the ground", 0.001, 10)
    bob: float = setting(0.006, "section 8.2", "units, amplitude of the head's bob", 0, 1)
    stroke_kt: float = setting(4.0, "chosen", "kt per frame of the sword's stroke", 0.01, 1000)
    steps_per_unit: float = setting(30.0, "chosen", "steps (k_step) per unit walked", 0, 1000)


@dataclass(frozen=True)
class Sun:
    """The one light, GL_LIGHT0, at infinity."""

    azimuth: float = setting(130.0, "chosen", "degrees, 0 north, 90 east", -360, 360)
    elevation: float = setting(38.0, "chosen", "degrees above the horizon", 0, 90)
    diffuse: tuple[float, ...] = setting((1.0, 0.95, 0.85), "chosen", "RGB", 0, 10)
    ambient: tuple[float, ...] = setting((0.50, 0.53, 0.60), "chosen", "RGB", 0, 10)
    fill: float = setting(
        0.0, "chosen", "times the ambient colour, a second light opposite the sun", 0, 10
    )


@dataclass(frozen=True)
class Ground:
    """The height field (section 2)."""

    height_image: str = setting("height.png", "figure 1", "image file; the red channel is height")
    resolution: int = setting(50, "section 2.1.1", "vertices per side", 2, 1024)
    size: float = setting(40.0, "section 9.2", "units per side", 1, 200)
    scale_y: float = setting(6.0, "chosen", "units, height of red = 256", 0.001, 1000)
    clip: bool = setting(True, "section 2.1.2", "clip at the water level with GL_CLIP_PLANE0")
    large_texture: str = setting("ground_large.png", "figure 3", "image file, texture unit 0")
    detail_texture: str = setting("ground_detail.png", "figure 3", "image file, texture unit 1")
    detail_repeat: float = setting(160.0, "chosen", "repeats over the map", 0.1, 10000)
    units: str = setting(
        "both", "figure 4", "texture units in use", choices=("both", "large", "detail", "none")
    )
    mid_repeat: float = setting(
        0.0,
        "chosen",
        "repeats over the map of the detail baked in with ground.materials; 0 is off",
        0,
        1000,
    )
    smooth: str = setting(
        "none",
        "R14, section 11.2.6",
        "spline of the bicubic patches between vertices",
        choices=("none", "catmull_rom", "b_spline"),
    )
    subdivide: int = setting(3, "R14", "subdivisions of a cell's side, for ground.smooth", 1, 8)
    exact_height: bool = setting(
        False, "R15, section 11.2.6", "heights on the drawn triangles, not on a bilinear surface"
    )
    materials: bool = setting(
        False, "chosen", "turf, sand and rock have their own detail textures, mixed in four units"
    )
    sand_texture: str = setting(
        "ground_sand.png", "chosen", "image file, detail texture of bare ground"
    )
    rock_texture: str = setting(
        "ground_rock.png", "chosen", "image file, detail texture of steep ground"
    )
    sand_repeat: float = setting(110.0, "chosen", "repeats over the map", 0.1, 10000)
    rock_repeat: float = setting(36.0, "chosen", "repeats over the map", 0.1, 10000)
    texture_size: int = setting(
        4096, "R19, introduction", "texels per side at most; larger images are reduced", 1, 16384
    )
    tiles: int = setting(
        1,
        "chosen",
        "tiles per side, a display list each; tiles outside the frustum are skipped",
        1,
        64,
    )
    low_stretch: bool = setting(
        False, "chosen", "low-stretch UVs: detail textures keep their scale on slopes"
    )
    shadows: bool = setting(False, "chosen", "bake shadows into the ground's large texture")


@dataclass(frozen=True)
class Reflection:
    """The scene drawn a second time, mirrored at the water plane (section 3)."""

    enabled: bool = setting(True, "section 3.1", "draw the mirrored scene")
    stencil: bool = setting(
        False, "glskel effects", "limit the reflection to the water by the stencil buffer"
    )
    castle: bool = setting(False, "chosen", "the castle is mirrored too")
    rippled: bool = setting(
        False, "R16, section 12", "render the mirror image to a texture and distort it by the waves"
    )
    lod_scale: float = setting(
        1.0, "chosen", "times camera.lod_pixels, for meshes in the mirror image", 1, 100
    )


@dataclass(frozen=True)
class Water:
    """The water surface (section 3)."""

    level: float = setting(0.6, "chosen", "units, WATER_LEVEL", 0, 1000)
    color: tuple[float, ...] = setting((0.2, 0.2, 0.4, 0.7), "section 3.2", "RGBA", 0, 1)
    patch: float = setting(10.0, "section 3.2", "units per side of a patch", 0.1, 1000)
    points: int = setting(40, "section 3.2", "vertices per side of a patch", 2, 400)
    repeat: float = setting(4.0, "chosen", "LAMBDA_WATER, textures per patch", 0, 1000)
    lod_bias: float = setting(
        0.0, "chosen", "mip levels added to OpenGL's choice; below 0 is sharper", -4, 4
    )
    trilinear: bool = setting(True, "chosen", "trilinear filtering; off, the nearest mip level")
    textured: bool = setting(True, "figure 9", "texture the surface")
    animated: bool = setting(True, "section 3.2", "move normals and texture coordinates")
    time_step: float = setting(0.02, "chosen", "t per kt", 0, 10)
    fresnel: bool = setting(
        False, "chosen", "opacity by the angle of view: the mirror image is strongest far away"
    )
    horizon: float = setting(0.0, "chosen", "units, reach of the sea beyond the patches", 0, 10000)
    glitter: float = setting(0.0, "chosen", "strength of the sun's glints on the waves", 0, 1)
    relief: bool = setting(False, "R17, section 3.2", "waves displace the vertices")
    shallow: bool = setting(False, "chosen", "shallow water is clear and turquoise")
    foam: bool = setting(False, "chosen", "breakers along the beaches")
    query: bool = setting(
        False, "chosen", "skip sea and mirror image while an occlusion query finds the sea hidden"
    )


@dataclass(frozen=True)
class Sky:
    """The sky box (section 4)."""

    set: str = setting("day", "chosen", "set of sky pictures", choices=("day", "sunset"))
    half_width: float = setting(8.0, "chosen", "units, D", 0.5, 10000)
    height: float = setting(5.0, "chosen", "units, H", 0.1, 10000)
    anchored: bool = setting(
        False, "figure 13", "stays at the centre of the map instead of following the viewer"
    )
    moving: bool = setting(False, "R1, section 4.1", "a cloud layer that drifts with kt")
    follow_y: bool = setting(False, "R8, section 11.2.3", "centred on the eye in y as well")
    background: bool = setting(
        False, "R9, section 11.2.3", "drawn at the greatest depth, so it hides no terrain"
    )
    unfogged: bool = setting(
        False, "R10, section 11.2.3", "drawn without fog; its pictures contain haze"
    )


@dataclass(frozen=True)
class Transparent:
    """What trees, deer and plants share (section 5.1)."""

    radius: float = setting(
        8.0,
        "chosen",
        "units, sprites farther away are not drawn (square root of PERIMETER_VISU_TRANSPARENT)",
        0,
        1000,
    )
    sorted: bool = setting(True, "section 5.1.2", "draw from far to near")
    textured: bool = setting(True, "figure 16", "texture the quads")
    upright: bool = setting(False, "R4, section 11.2.1", "billboards turn about the y axis only")
    split: bool = setting(False, "R3, section 5.1.2", "sort each half of a crossed quad separately")
    fade: float = setting(0.0, "chosen", "fraction of the radius over which sprites fade in", 0, 1)
    clear_near: bool = setting(False, "chosen", "sprites fade out close to the eye")
    rooted: bool = setting(False, "chosen", "feet are sunk slightly into slopes")
    trimmed: bool = setting(
        False,
        "chosen",
        "quads fit the opaque part of the picture; those outside the frustum are not sent",
    )
    min_pixels: float = setting(0.0, "chosen", "pixels; smaller sprites fade out", 0, 100)
    trilinear: bool = setting(True, "chosen", "trilinear filtering; off, the nearest mip level")


@dataclass(frozen=True)
class Trees:
    """Billboards (section 5.1)."""

    count: int = setting(900, "chosen", "trees", 0, 200_000)
    species: int = setting(2, "figure 15", "kinds of tree", 1, 4)
    size_min: float = setting(0.325, "section 5.1.2", "units, width and height", 0.001, 100)
    size_max: float = setting(0.65, "section 5.1.2", "units, width and height", 0.001, 100)
    grouped: bool = setting(
        False, "chosen", "woods and clearings instead of a uniform distribution"
    )
    crown: bool = setting(
        False, "R4, section 11.2.1", "a horizontal crown picture, visible from above"
    )


@dataclass(frozen=True)
class Deer:
    """Billboards (section 5.1)."""

    count: int = setting(70, "chosen", "deer", 0, 200_000)
    size_min: float = setting(0.10, "chosen", "units, width and height", 0.001, 100)
    size_max: float = setting(0.14, "chosen", "units, width and height", 0.001, 100)
    follow_slope: bool = setting(
        False, "R5, section 11.2.6", "stand perpendicular to the slope, feet on the ground"
    )


@dataclass(frozen=True)
class Plants:
    """Crossed quads (section 5.2)."""

    count: int = setting(1500, "chosen", "plants", 0, 200_000)
    size_min: float = setting(0.06, "chosen", "units, width and height", 0.001, 100)
    size_max: float = setting(0.14, "chosen", "units, width and height", 0.001, 100)
    sway: float = setting(1.0, "section 5.2.2", "times the report's sway", 0, 100)
    species: int = setting(
        1, "chosen", "kinds: the report's one, or fern, ox-eye, willow-herb, marram, heather", 1, 5
    )
    radius: float = setting(
        0.0, "chosen", "units, plants farther away are not drawn; 0 is transparent.radius", 0, 1000
    )
    shaded: bool = setting(False, "chosen", "plants are darker in the ground's shadows")
    quads: int = setting(
        2,
        "R6, section 11.2.2",
        "quads per plant: two at right angles, or three at 60 degrees",
        2,
        3,
    )
    fade_edge_on: bool = setting(False, "R6, section 11.2.2", "quads seen edge-on fade out")
    crossed_within: float = setting(
        0.0, "chosen", "units, plants farther away are single billboards; 0 is never", 0, 1000
    )
    rosette: bool = setting(False, "R6, section 11.2.2", "a horizontal rosette, visible from above")


@dataclass(frozen=True)
class Grass:
    """Blades (section 5.3)."""

    count: int = setting(200_000, "section 5.3.1", "blades on the map", 0, 40_000_000)
    scale: tuple[float, ...] = setting(
        (1.0, 1.0), "section 5.3.2", "factors (sx, sy) on a blade's size", 0.01, 100
    )
    arch: float = setting(1.0, "section 5.3.2", "factor on the tip's bend", 0, 20)
    radius: float = setting(4.0, "chosen", "units, blades farther away are not drawn", 0, 1000)
    tinted: bool = setting(False, "chosen", "blades take the colour of the ground below them")
    fade: bool = setting(
        False, "chosen", "blades shrink towards the radius instead of ending abruptly there"
    )
    facing: float = setting(
        0.0,
        "R7, section 11.2.2",
        "fraction by which blades turn to the viewer; above 0.5 none is edge-on",
        0,
        1,
    )
    method: str = setting(
        "cells",
        "R18, section 5.3",
        "submit blades in one call, or one by one as in 2006",
        choices=("cells", "loop"),
    )
    tufts: int = setting(0, "chosen", "blades per tuft, leaning apart; 0 is off", 0, 100)
    variety: float = setting(0.0, "chosen", "variation of tufts in height and colour", 0, 1)


@dataclass(frozen=True)
class Castle:
    """Walls, towers, gate and torches (section 6)."""

    x: float = setting(27.3, "chosen", "units, centre", -1e4, 1e4)
    z: float = setting(16.9, "chosen", "units, centre", -1e4, 1e4)
    yaw: float = setting(-160.0, "chosen", "degrees about y; 0 faces the gate north", -360, 360)
    brick_repeat: float = setting(4.0, "chosen", "textures per wall", 0.1, 100)
    flame_faces: bool = setting(False, "R2, section 6.1", "flames turn about y to face the viewer")
    multitexture: bool = setting(
        False, "R11, section 11.2.4", "bricks, door and light in one pass with three texture units"
    )
    ornate: bool = setting(False, "chosen", "a keep, roofs, bands, loopholes and pennants")


@dataclass(frozen=True)
class Rabbit:
    """A mesh on land, cylindrical mapping (section 7)."""

    mesh: str = setting("rabbit.ply", "figure 27", "mesh file: PLY, OBJ, STL, OFF, GLB")
    x: float = setting(20.5, "chosen", "units", -1e4, 1e4)
    z: float = setting(24.0, "chosen", "units", -1e4, 1e4)
    yaw: float = setting(-112.0, "chosen", "degrees about y", -360, 360)
    scale: float = setting(0.12, "chosen", "units, half the mesh's largest side", 0.001, 100)
    l1: float = setting(8.0, "chosen", "L1, repeats around the axis", 0, 1000)
    l2: float = setting(4.0, "chosen", "L2, repeats along the axis", 0, 1000)
    mapping: str = setting(
        "cylindrical",
        "R12, section 11.2.5",
        "cylindrical, or projected along the axis each face is most normal to",
        choices=("cylindrical", "axis"),
    )
    painted: bool = setting(False, "chosen", "vertex colours from the mesh file")


@dataclass(frozen=True)
class Dragon:
    """A mesh half in the water, mapped by (x, z) (section 7)."""

    mesh: str = setting("dragon.ply", "figure 27", "mesh file: PLY, OBJ, STL, OFF, GLB")
    x: float = setting(11.0, "chosen", "units", -1e4, 1e4)
    z: float = setting(29.0, "chosen", "units", -1e4, 1e4)
    yaw: float = setting(-30.0, "chosen", "degrees about y", -360, 360)
    scale: float = setting(0.9, "chosen", "units, half the mesh's largest side", 0.001, 100)
    mapping: str = setting(
        "planar",
        "R12, section 7.2",
        "by (x, z), or projected along the axis each face is most normal to",
        choices=("planar", "axis"),
    )
    repeat: float = setting(6.0, "chosen", "repeats, for dragon.mapping=axis", 0, 1000)
    painted: bool = setting(False, "chosen", "vertex colours from the mesh file")
    gloss: float = setting(0.0, "chosen", "strength of the specular highlight", 0, 1)
    sink: float = setting(-0.15, "chosen", "height of the water line on the mesh of -1..1", -2, 2)


@dataclass(frozen=True)
class Overlay:
    """The sword (section 8) and the map (section 9)."""

    sword: bool = setting(True, "section 8", "show the sword")
    map: bool = setting(True, "section 9", "show the map")
    map_alpha: float = setting(0.75, "chosen", "opacity of the map", 0, 1)


@dataclass(frozen=True)
class Fog:
    """GL_FOG (section 10)."""

    enabled: bool = setting(True, "section 10.2", "on or off")
    mode: str = setting("exp2", "section 10.2", "fog mode", choices=("exp2", "exp", "linear"))
    density: float = setting(0.12, "section 10.2", "per unit", 0, 1000)
    color: tuple[float, ...] = setting((0.4, 0.6, 0.7), "section 10.2", "RGB", 0, 1)
    start: float = setting(1.0, "chosen", "units, linear mode", 0, 1e5)
    end: float = setting(20.0, "chosen", "units, linear mode", 0, 1e5)


@dataclass(frozen=True)
class Settings:
    """All groups; ``Settings()`` is the preset 2006."""

    RENAMED: ClassVar[dict[str, Renamed]] = {
        "camera.detail": Renamed("camera.lod_pixels"),
        "overlay.stroke_kt": Renamed("walk.stroke_kt"),
        "ground.unstretched": Renamed("ground.low_stretch"),
        "reflection.coarse": Renamed("reflection.lod_scale"),
        "transparent.least": Renamed("transparent.min_pixels"),
        "water.cull": Renamed(),
        "water.rippled": Renamed(),
        "water.sharp": Renamed("water.lod_bias", negated=True),
    }

    camera: Camera = Camera()
    clock: Clock = Clock()
    walk: Walk = Walk()
    sun: Sun = Sun()
    ground: Ground = Ground()
    reflection: Reflection = Reflection()
    water: Water = Water()
    sky: Sky = Sky()
    transparent: Transparent = Transparent()
    trees: Trees = Trees()
    deer: Deer = Deer()
    plants: Plants = Plants()
    grass: Grass = Grass()
    castle: Castle = Castle()
    rabbit: Rabbit = Rabbit()
    dragon: Dragon = Dragon()
    overlay: Overlay = Overlay()
    fog: Fog = Fog()


BEST: dict[str, Value] = {
    "camera.cull": True,
    "camera.lod_pixels": 0.25,
    "walk.mouse_relative": True,
    "sun.fill": 0.45,
    "ground.resolution": 160,
    "ground.height_image": "height16.png",
    "ground.mid_repeat": 13.0,
    "ground.materials": True,
    "ground.exact_height": True,
    "ground.tiles": 8,
    "ground.shadows": True,
    "ground.low_stretch": True,
    "ground.texture_size": 2048,
    "reflection.castle": True,
    "reflection.rippled": True,
    "reflection.lod_scale": 8.0,
    "water.repeat": 7.0,
    "water.lod_bias": -0.7,
    "water.trilinear": False,
    "water.relief": True,
    "water.shallow": True,
    "water.foam": True,
    "water.query": True,
    "water.fresnel": True,
    "water.horizon": 400.0,
    "water.glitter": 0.35,
    "water.color": (0.16, 0.32, 0.38, 0.88),
    "sky.moving": True,
    "sky.follow_y": True,
    "sky.background": True,
    "sky.unfogged": True,
    "transparent.upright": True,
    "transparent.split": True,
    "transparent.fade": 0.15,
    "transparent.clear_near": True,
    "transparent.rooted": True,
    "transparent.trimmed": True,
    "transparent.min_pixels": 2.5,
    "transparent.trilinear": False,
    "transparent.radius": 26.0,
    "trees.species": 4,
    "trees.count": 2200,
    "trees.grouped": True,
    "trees.crown": True,
    "deer.follow_slope": True,
    "plants.quads": 3,
    "plants.fade_edge_on": True,
    "plants.rosette": True,
    "plants.crossed_within": 7.0,
    "castle.flame_faces": True,
    "castle.multitexture": True,
    "castle.ornate": True,
    "plants.sway": 0.35,
    "plants.species": 5,
    "plants.shaded": True,
    "plants.count": 7000,
    "plants.radius": 16.0,
    "plants.size_min": 0.035,
    "plants.size_max": 0.085,
    "grass.tinted": True,
    "grass.fade": True,
    "grass.count": 24_000_000,
    "grass.scale": (0.22, 1.1),
    "grass.facing": 0.6,
    "grass.tufts": 6,
    "grass.variety": 1.0,
    "rabbit.mapping": "axis",
    "rabbit.painted": True,
    "dragon.mapping": "axis",
    "dragon.painted": True,
    "dragon.gloss": 0.5,
    "grass.arch": 4.0,
    "grass.radius": 7.0,
    "fog.density": 0.042,
    "fog.color": (0.66, 0.76, 0.84),
}

PRESETS: dict[str, dict[str, Value]] = {"2006": {}, "best": BEST}


def preset(name: str) -> Settings:
    """Return the island's settings of a preset; InputError if there is none of that name."""
    return keys.preset(Settings(), PRESETS, name)
