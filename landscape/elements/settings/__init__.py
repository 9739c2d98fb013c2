"""The island's constants as settings: key, value, what it does, unit, source; presets and times.

The defaults are the preset ``2006``: the report's numbers where it gives them, "chosen" where it
does not. The preset ``best`` is a table of differences. A time of day is another, laid over either
preset; noon is the preset as it is. See :mod:`landscape.settings.declare`, and
:mod:`landscape.settings.notices` for ``needs`` and ``NEEDS``.
"""

from dataclasses import dataclass
from typing import ClassVar

from landscape.settings import declare
from landscape.settings.declare import Renamed, Value, setting, word

WALKING = ("walk",)

MESH_FILE = "PLY, OBJ, STL, OFF or GLB file"
DEGREES = "degrees"
UNITS = "units"
PER_SECOND = "units per second"
REPEATS = "repeats over the map"
# What reads the colours of the ground's large texture, apart from the ground itself.
COLOURS_READ = "grass.tinted or trees.grouped or plants.species>1"
# What depends on where the sun is.
SUNLIT = (
    "water or castle or rabbit or dragon or ground.lit or ground.shadows"
    " or ground.height_image!=height.png or sun.relit",
)


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


@dataclass(frozen=True)
class Clock:
    """kt, the counter all animation reads; in 2006 it grew by one per displayed frame."""

    NEEDS: ClassVar[tuple[str, ...]] = WALKING

    kt_per_second: float = setting(
        30.0, "chosen", "how fast animation runs", 0, 1000, unit="kt per second"
    )


@dataclass(frozen=True)
class Walk:
    """How the walker moves (Position in 2006)."""

    speed: float = setting(0.9, "chosen", "walking speed", 0, 100, unit=PER_SECOND, needs=WALKING)
    run: float = setting(
        3.0, "chosen", "running speed", 1, 100, unit="times the walking speed", needs=WALKING
    )
    turn: float = setting(
        75.0,
        "chosen",
        "how fast the arrow keys turn the view",
        0,
        1000,
        unit="degrees per second",
        needs=WALKING,
    )
    mouse: float = setting(
        0.12,
        "chosen",
        "how far the mouse turns the view",
        0,
        10,
        unit="degrees per pixel",
        needs=WALKING,
    )
    mouse_relative: bool = setting(
        False,
        "R13, section 11.2.6",
        "mouse motion turns the view; otherwise the pointer's position sets it",
        needs=WALKING,
    )
    eye: float = setting(
        0.1, "section 8.2", "height of the eye above the ground", 0.001, 10, unit=UNITS
    )
    bob: float = setting(
        0.006,
        "section 8.2",
        "amplitude of the head's bob at each step",
        0,
        1,
        unit=UNITS,
        needs=WALKING,
    )
    stroke_kt: float = setting(
        4.0,
        "chosen",
        "how long each picture of the sword's stroke is shown",
        0.01,
        1000,
        unit="kt",
        needs=(*WALKING, "sword"),
    )
    steps_per_unit: float = setting(
        30.0,
        "chosen",
        "how fast the steps (k_step) follow each other, for the bob of head and sword",
        0,
        1000,
        unit="steps per unit walked",
        needs=WALKING,
    )
    swim: bool = setting(
        False,
        "section 2.1.2",
        "the walker wades and swims; otherwise he walks on the water's surface, as in 2006",
        needs=WALKING,
    )
    solid: bool = setting(
        False,
        "chosen",
        "trees, deer, boulders and the castle's keep stop the walker, as walls and animals do",
        needs=WALKING,
    )


@dataclass(frozen=True)
class Sun:
    """The one light, GL_LIGHT0, at infinity."""

    azimuth: float = setting(
        130.0,
        "chosen",
        "direction of the sun: 0 north, 90 east",
        -360,
        360,
        unit=DEGREES,
        needs=SUNLIT,
    )
    elevation: float = setting(
        38.0, "chosen", "height of the sun above the horizon", 0, 90, unit=DEGREES, needs=SUNLIT
    )
    diffuse: tuple[float, ...] = setting(
        (1.0, 0.95, 0.85),
        "chosen",
        "colour of the light on water, castle, rabbit and dragon",
        0,
        10,
        unit="RGB",
        needs=("water or castle or rabbit or dragon or ground.lit",),
    )
    ambient: tuple[float, ...] = setting(
        (0.50, 0.53, 0.60),
        "chosen",
        "colour of the ambient light on water, castle, rabbit and dragon",
        0,
        10,
        unit="RGB",
        needs=("water or castle or rabbit or dragon or ground.lit",),
    )
    fill: float = setting(
        0.0,
        "chosen",
        "strength of a second light, opposite the sun",
        0,
        10,
        unit="times the ambient colour",
        needs=("water or castle or rabbit or dragon or ground.lit",),
    )
    tint: tuple[float, ...] = setting(
        (1.0, 1.0, 1.0),
        "chosen",
        "factor on what has its light painted in: ground, sprites, grass, foam, clouds, sword",
        0,
        1,
        unit="RGB",
    )
    shade: tuple[float, ...] = setting(
        (0.50, 0.53, 0.58),
        "chosen",
        "the same factor where the sun does not reach",
        0,
        1,
        unit="RGB",
        needs=("ground.shadows or sun.relit",),
    )
    relit: bool = setting(
        False,
        "chosen",
        "sun.tint on the sunny side alone, sun.shade on the other; not in 2006's elements",
    )


@dataclass(frozen=True)
class Shading:
    """How OpenGL shades what the sun lights: to show what lighting does, and what it is made of."""

    NEEDS: ClassVar[tuple[str, ...]] = ("water or castle or rabbit or dragon or ground.lit",)

    lighting: bool = setting(
        True, "chosen", "light water, castle, rabbit and dragon; off, they have their plain colour"
    )
    smooth: bool = setting(
        True, "chosen", "blend the light of the vertices over a triangle; off, flat shading"
    )


@dataclass(frozen=True)
class Ground:
    """The height field (section 2)."""

    height_image: str = setting(
        "height.png", "figure 1", "the heights: the image's red channel", unit="image file"
    )
    resolution: int = setting(
        50, "section 2.1.1", "vertices per side of the height field", 2, 1024, unit="vertices"
    )
    size: float = setting(40.0, "section 9.2", "side of the map", 1, 200, unit=UNITS)
    scale_y: float = setting(6.0, "chosen", "height where red is 256", 0.001, 1000, unit=UNITS)
    scale_x: float = setting(
        1.0,
        "section 2.1.2",
        "how much of the map the images cover from west to east; the rest is sea",
        0.05,
        1,
        unit="of ground.size",
    )
    scale_z: float = setting(
        1.0,
        "section 2.1.2",
        "how much of the map the images cover from north to south; the rest is sea",
        0.05,
        1,
        unit="of ground.size",
    )
    clip: bool = setting(
        True,
        "section 2.1.2",
        "clip ground, rabbit and dragon at the water level with GL_CLIP_PLANE0",
        # The plane that closes shallow water hides all that is below it.
        needs=(
            "not water or not water.shallow or reflection.enabled",
            "not water or not water.shallow or not reflection.rippled",
        ),
    )
    large_texture: str = setting(
        "ground_large.png",
        "figure 3",
        "the colours of the whole map, in texture unit 0",
        unit="image file",
        needs=(f"ground.units=both or ground.units=large or {COLOURS_READ}",),
    )
    detail_texture: str = setting(
        "ground_detail.png",
        "figure 3",
        "the detail that is repeated over the map, in texture unit 1",
        unit="image file",
        needs=("ground.units=both or ground.units=detail",),
    )
    detail_repeat: float = setting(
        160.0,
        "chosen",
        "how often the detail texture is repeated",
        0.1,
        10000,
        unit=REPEATS,
        needs=("ground.units=both or ground.units=detail",),
    )
    units: str = setting(
        "both", "figure 4", "texture units in use", choices=("both", "large", "detail", "none")
    )
    passes: str = setting(
        "one",
        "section 2.2.2",
        "both textures in one pass by two texture units, or a second pass blended over the first",
        choices=("one", "two"),
        needs=("ground", "ground.units=both"),
    )
    lit: bool = setting(
        False,
        "section 2.2.2",
        "light the ground by its normals, too; its colours have their light painted in",
        needs=("ground",),
    )
    mid_repeat: float = setting(
        0.0,
        "chosen",
        "how often the detail baked in with ground.materials is repeated; 0 is off",
        0,
        1000,
        unit=REPEATS,
        needs=("ground.materials", "ground.units=both"),
    )
    smooth: str = setting(
        "none",
        "R14, section 11.2.6",
        "spline of the bicubic patches between vertices",
        choices=("none", "catmull_rom", "b_spline"),
    )
    subdivide: int = setting(
        3,
        "R14",
        "subdivisions of a cell's side on a smooth ground",
        1,
        8,
        unit="subdivisions",
        needs=("ground.smooth!=none",),
    )
    exact_height: bool = setting(
        False, "R15, section 11.2.6", "heights on the drawn triangles, not on a bilinear surface"
    )
    materials: bool = setting(
        False,
        "chosen",
        "turf, sand and rock have their own detail textures, mixed in four units",
        needs=("ground.units=both",),
    )
    sand_texture: str = setting(
        "ground_sand.png",
        "chosen",
        "detail texture of bare ground",
        unit="image file",
        needs=("ground.materials", "ground.units=both"),
    )
    rock_texture: str = setting(
        "ground_rock.png",
        "chosen",
        "detail texture of steep ground",
        unit="image file",
        needs=("ground.materials", "ground.units=both"),
    )
    sand_repeat: float = setting(
        110.0,
        "chosen",
        "how often the sand is repeated",
        0.1,
        10000,
        unit=REPEATS,
        needs=("ground.materials", "ground.units=both"),
    )
    rock_repeat: float = setting(
        36.0,
        "chosen",
        "how often the rock is repeated",
        0.1,
        10000,
        unit=REPEATS,
        needs=("ground.materials", "ground.units=both"),
    )
    texture_size: int = setting(
        4096,
        "R19, introduction",
        "the largest side of a texture; larger images are reduced",
        1,
        4096,
        unit="texels",
        needs=(f"ground.units!=none or {COLOURS_READ}",),
    )
    tiles: int = setting(
        1,
        "chosen",
        "tiles per side, a display list each; tiles outside the frustum are skipped",
        1,
        64,
        unit="tiles",
    )
    low_stretch: bool = setting(
        False,
        "chosen",
        "low-stretch UVs: detail textures keep their scale on slopes",
        needs=("ground.units=both or ground.units=detail",),
    )
    shadows: bool = setting(
        False,
        "chosen",
        "bake shadows into the ground's large texture",
        needs=("ground.units=both or ground.units=large or plants.shaded or grass.tinted",),
    )
    weathered: bool = setting(
        False,
        "chosen",
        "paint ledges into rock, a tideline onto beaches, and ragged edges of turf",
        needs=("ground", "ground.materials", "ground.units=both"),
    )
    lod_bias: float = setting(
        0.0,
        "chosen",
        "added to the mip level that OpenGL chooses; below 0 the ground is sharper",
        -4,
        4,
        unit="mip levels",
        needs=("ground", "ground.materials", "ground.units=both"),
    )
    verdure: float = setting(
        0.0,
        "chosen",
        "how far turf has the colour of the sward on it, and its grain far away",
        0,
        1,
        unit="of 1",
        needs=("ground", "ground.materials", "ground.units=both"),
    )
    clouds: float = setting(
        0.0,
        "chosen",
        "how dark the shadows of clouds on the land are by day",
        0,
        1,
        unit="of 1",
        needs=("ground.shadows", "not sun.relit"),
    )
    stones: int = setting(
        0,
        "chosen",
        "how many crags, boulders, stones and pieces of driftwood lie on bare ground",
        0,
        40_000,
        unit="stones",
        needs=("ground", "ground.materials", "ground.units=both"),
    )
    wet: bool = setting(
        False,
        "chosen",
        "sand and rock are darker where waves have wetted them",
        needs=("ground.materials", "ground.units=both"),
    )


@dataclass(frozen=True)
class Reflection:
    """The scene drawn a second time, mirrored at the water plane (section 3)."""

    enabled: bool = setting(True, "section 3.1", "draw the mirrored scene", needs=("reflection",))
    stencil: bool = setting(
        False,
        "glskel effects",
        "limit the reflection to the water by the stencil buffer",
        needs=("reflection", "water", "reflection.enabled", "not reflection.rippled"),
    )
    castle: bool = setting(
        False,
        "chosen",
        "the castle is mirrored too",
        needs=("reflection", "castle", "reflection.enabled"),
    )
    rippled: bool = setting(
        False,
        "R16, section 12",
        "render the mirror image to a texture and distort it by the waves",
        # Without a mirror image it only chooses a sea without patches, as each of these does.
        needs=(
            *("water", "reflection.enabled or not water.relief"),
            *("reflection.enabled or not water.shallow", "reflection.enabled or not water.fresnel"),
            *("reflection.enabled or not water.glitter", "reflection.enabled or not water.foam"),
            "reflection.enabled or not water.ripples",
            "reflection.enabled or not water.horizon_contrast",
        ),
    )
    lod_scale: float = setting(
        1.0,
        "chosen",
        "meshes in the mirror image may err by more pixels, and the ground's tiles are coarser",
        1,
        100,
        unit="times camera.lod_pixels",
        needs=("reflection", "reflection.enabled", "camera.lod_pixels or ground.tiles>1"),
    )


@dataclass(frozen=True)
class Water:
    """The water surface (section 3)."""

    level: float = setting(0.6, "chosen", "height of the water, WATER_LEVEL", 0, 1000, unit=UNITS)
    color: tuple[float, ...] = setting(
        (0.2, 0.2, 0.4, 0.7),
        "section 3.2",
        "colour of the water; alpha is its opacity",
        0,
        1,
        unit="RGBA",
        needs=("water",),
    )
    patch: float = setting(
        10.0, "section 3.2", "side of a patch", 0.1, 1000, unit=UNITS, needs=("water",)
    )
    points: int = setting(
        40,
        "section 3.2",
        "vertices per side of a patch",
        2,
        400,
        unit="vertices",
        needs=("water",),
    )
    repeat: float = setting(
        4.0,
        "chosen",
        "how often the texture is repeated, LAMBDA_WATER",
        0,
        1000,
        unit="textures per patch",
        needs=("water", "water.textured"),
    )
    lod_bias: float = setting(
        0.0,
        "chosen",
        "added to the mip level that OpenGL chooses; below 0 is sharper",
        -4,
        4,
        unit="mip levels",
        needs=("water", "water.textured"),
    )
    trilinear: bool = setting(
        True,
        "chosen",
        "trilinear filtering; off, the nearest mip level",
        needs=("water", "water.textured"),
    )
    textured: bool = setting(True, "figure 9", "texture the surface", needs=("water",))
    animated: bool = setting(
        True, "section 3.2", "move normals and texture coordinates", needs=("water",)
    )
    time_step: float = setting(
        0.02,
        "chosen",
        "how fast the waves move",
        0,
        10,
        unit="t per kt",
        needs=("water", "water.animated"),
    )
    fresnel: bool = setting(
        False,
        "chosen",
        "opacity by the angle of view: the mirror image is strongest far away",
        needs=("water",),
    )
    ripples: float = setting(
        0.0,
        "chosen",
        "how much each pixel's ripple changes what the water mirrors; finer ripples near the eye",
        0,
        1,
        unit="of 1",
        needs=("water", "water.textured"),
    )
    horizon: float = setting(
        0.0,
        "chosen",
        "how far the sea reaches beyond the patches",
        0,
        10000,
        unit=UNITS,
        needs=("water",),
    )
    horizon_contrast: float = setting(
        0.0,
        "chosen",
        "how much of the sea's colour the fog leaves at the horizon at least",
        0,
        0.99,
        unit="of 1",
        needs=("water", "fog", "fog.enabled", "fog.density", "fog.mode!=linear"),
    )
    glitter: float = setting(
        0.0,
        "chosen",
        "strength of the sun's glints on the waves",
        0,
        1,
        unit="of 1",
        needs=("water",),
    )
    roughness: float = setting(
        0.15,
        "chosen",
        "slope of ripples too small to draw: how wide the path of glints is",
        0.01,
        1,
        unit="standard deviation",
        needs=("water", "water.glitter"),
    )
    under: bool = setting(
        False,
        "glskel effects",
        "an eye below the surface sees water: fog, the surface from below, a net of light",
        needs=("water",),
    )
    relief: bool = setting(
        False, "R17, section 3.2", "waves displace the vertices", needs=("water",)
    )
    shallow: bool = setting(
        False, "chosen", "shallow water is clear and turquoise", needs=("water",)
    )
    caustics: bool = setting(
        False,
        "chosen",
        "light on the bed of shallow water, focused by its waves",
        needs=(
            *("ground", "water", "water.shallow", "reflection.rippled or not reflection.enabled"),
            *("ground.materials", "ground.units=both", "ground.tiles>1"),
        ),
    )
    foam: bool = setting(False, "chosen", "a wash of foam along the shore", needs=("water",))
    query: bool = setting(
        False,
        "chosen",
        "skip sea and mirror image while an occlusion query finds the sea hidden",
        needs=("water", "reflection.rippled"),
    )


@dataclass(frozen=True)
class Sky:
    """The sky box (section 4)."""

    NEEDS: ClassVar[tuple[str, ...]] = ("sky",)

    set: str = setting("day", "chosen", "set of sky pictures", choices=("day", "sunset"))
    refined: bool = setting(
        False, "chosen", "pictures with wide, flat clouds and fibrous cirrus; off, the former ones"
    )
    unfolded: str = setting(
        "none",
        "figure 12",
        "one picture of all five faces, the box unfolded, instead of the five files of the set",
        unit="none, or image file",
    )
    half_width: float = setting(
        8.0, "chosen", "distance of the walls from the centre, D", 0.5, 10000, unit=UNITS
    )
    height: float = setting(5.0, "chosen", "height of the box, H", 0.1, 10000, unit=UNITS)
    sunk: float = setting(
        0.0,
        "section 11.2.3",
        "how far the walls reach below the sea, or below the eye if the box follows it in y",
        0,
        10000,
        unit=UNITS,
    )
    anchored: bool = setting(
        False, "figure 13", "stays at the centre of the map instead of following the viewer"
    )
    moving: bool = setting(False, "R1, section 4.1", "a cloud layer that drifts with kt")
    follow_y: bool = setting(False, "R8, section 11.2.3", "centred on the eye in y as well")
    background: bool = setting(
        False, "R9, section 11.2.3", "drawn at the greatest depth, so it hides no terrain"
    )
    unfogged: bool = setting(
        False,
        "R10, section 11.2.3",
        "drawn without fog; its pictures contain haze",
        needs=("fog.enabled", "fog"),
    )


@dataclass(frozen=True)
class Transparent:
    """What trees, deer and plants share (section 5.1)."""

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


@dataclass(frozen=True)
class Grass:
    """Blades (section 5.3)."""

    NEEDS: ClassVar[tuple[str, ...]] = ("grass", "grass.count")

    count: int = setting(
        200_000, "section 5.3.1", "how many blades the map has", 0, 40_000_000, unit="blades"
    )
    scale: tuple[float, ...] = setting(
        (1.0, 1.0),
        "section 5.3.2",
        "width and height of a blade (sx, sy)",
        0.01,
        100,
        unit="times the report's blade",
    )
    arch: float = setting(
        1.0, "section 5.3.2", "how far the tip bends", 0, 20, unit="times the report's bend"
    )
    radius: float = setting(4.0, "chosen", "blades farther away are not drawn", 0, 1000, unit=UNITS)
    tinted: bool = setting(False, "chosen", "blades take the colour of the ground below them")
    fade: bool = setting(
        False, "chosen", "blades shrink towards the radius instead of ending abruptly there"
    )
    facing: float = setting(
        0.0,
        "R7, section 11.2.2",
        "how far blades turn to the viewer; above 0.5 none is edge-on",
        0,
        1,
        unit="of 1",
    )
    method: str = setting(
        "cells",
        "R18, section 5.3",
        "submit blades in one call, or one by one as in 2006",
        choices=("cells", "loop"),
    )
    tufts: int = setting(
        0, "chosen", "blades per tuft, leaning apart; 0 is off", 0, 100, unit="blades"
    )
    variety: float = setting(
        0.0,
        "chosen",
        "variation of tufts in height and colour",
        0,
        1,
        unit="of 1",
        needs=("grass.fade or grass.tinted or grass.sward",),
    )
    sward: bool = setting(
        False, "chosen", "sheaves of fine blades, seed heads and straw instead of single blades"
    )
    flowers: float = setting(
        0.0,
        "chosen",
        "cards of the sward that are flowers, in the middle of a drift",
        0,
        1,
        unit="of 1",
        needs=("grass.sward",),
    )
    gusts: float = setting(
        0.0,
        "chosen",
        "how far gusts bend the blades as they travel over the meadow",
        0,
        10,
        unit="times a normal gust",
    )


@dataclass(frozen=True)
class Castle:
    """Walls, towers, gate and torches (section 6)."""

    x: float = setting(27.3, "chosen", "place of the centre, eastwards", -1e4, 1e4, unit=UNITS)
    z: float = setting(16.9, "chosen", "place of the centre, southwards", -1e4, 1e4, unit=UNITS)
    yaw: float = setting(
        -160.0,
        "chosen",
        "turn about y; at 0 the gate faces north",
        -360,
        360,
        unit=DEGREES,
        needs=("castle",),
    )
    brick_repeat: float = setting(
        4.0,
        "chosen",
        "how often the bricks are repeated",
        0.1,
        100,
        unit="textures per wall",
        needs=("castle",),
    )
    sides: int = setting(
        8,
        "section 6",
        "how many sides a tower has: few, so that it looks angular",
        3,
        64,
        unit="sides",
        needs=("castle",),
    )
    battlements: bool = setting(
        False,
        "chosen",
        "merlons on the walls, and parapets around the towers' tops",
        needs=("castle",),
    )
    flame_faces: bool = setting(
        False, "R2, section 6.1", "flames turn about y to face the viewer", needs=("castle",)
    )
    multitexture: bool = setting(
        False,
        "R11, section 11.2.4",
        "bricks, door and light in one pass with three texture units",
        needs=("castle",),
    )
    ornate: bool = setting(
        False, "chosen", "a keep, roofs, bands, loopholes and pennants", needs=("castle",)
    )
    open: bool = setting(
        False,
        "chosen",
        "the door is open, and leads into the great hall",
        needs=("castle", "castle.ornate"),
    )
    torches: float = setting(
        0.0,
        "chosen",
        "how much the torches light the walls: at 0 as by day, at 1 as in the dark",
        0,
        1,
        unit="fraction",
        needs=("castle", "castle.ornate"),
    )
    depth: bool = setting(
        False,
        "chosen",
        "the open door shows a hall behind it, not a wall painted dark",
        needs=("castle", "castle.ornate", "castle.open"),
    )
    glow: float = setting(
        0.0,
        "chosen",
        "how strongly the flames glow and light the ground; above 0 they are larger, too",
        0,
        1,
        unit="of 1",
        needs=("castle", "castle.ornate"),
    )
    weathered: bool = setting(
        False,
        "chosen",
        "uneven stones with stains and moss, framed windows, slates, rubble and ivy",
        needs=("castle", "castle.ornate"),
    )


@dataclass(frozen=True)
class Rabbit:
    """A mesh on land, cylindrical mapping (section 7)."""

    mesh: str = setting(
        "rabbit.ply", "figure 27", "the rabbit's mesh", unit=MESH_FILE, needs=("rabbit",)
    )
    x: float = setting(20.5, "chosen", "place, eastwards", -1e4, 1e4, unit=UNITS)
    z: float = setting(24.0, "chosen", "place, southwards", -1e4, 1e4, unit=UNITS)
    yaw: float = setting(
        -112.0, "chosen", "turn about y", -360, 360, unit=DEGREES, needs=("rabbit",)
    )
    scale: float = setting(0.12, "chosen", "half the mesh's largest side", 0.001, 100, unit=UNITS)
    l1: float = setting(
        8.0,
        "chosen",
        "how often the texture is repeated around the axis, L1",
        0,
        1000,
        unit="repeats",
        needs=("rabbit", "rabbit.mapping=cylindrical"),
    )
    l2: float = setting(
        4.0,
        "chosen",
        "how often the texture is repeated along the axis, L2",
        0,
        1000,
        unit="repeats",
        needs=("rabbit",),
    )
    mapping: str = setting(
        "cylindrical",
        "R12, section 11.2.5",
        "cylindrical, or projected along the axis each face is most normal to",
        choices=("cylindrical", "axis"),
        needs=("rabbit",),
    )
    painted: bool = setting(
        False, "chosen", "vertex colours from the mesh file, if it has any", needs=("rabbit",)
    )
    fur: int = setting(
        0,
        "chosen",
        "layers of fur around the rabbit, and a glint in its eyes; 0 is neither",
        0,
        32,
        unit="layers",
        needs=("rabbit",),
    )


@dataclass(frozen=True)
class Dragon:
    """A mesh half in the water, mapped by (x, z) (section 7)."""

    NEEDS: ClassVar[tuple[str, ...]] = ("dragon",)

    mesh: str = setting("dragon.ply", "figure 27", "the dragon's mesh", unit=MESH_FILE)
    x: float = setting(11.0, "chosen", "place, eastwards", -1e4, 1e4, unit=UNITS)
    z: float = setting(29.0, "chosen", "place, southwards", -1e4, 1e4, unit=UNITS)
    yaw: float = setting(-30.0, "chosen", "turn about y", -360, 360, unit=DEGREES)
    scale: float = setting(0.9, "chosen", "half the mesh's largest side", 0.001, 100, unit=UNITS)
    mapping: str = setting(
        "planar",
        "R12, section 7.2",
        "by (x, z), or projected along the axis each face is most normal to",
        choices=("planar", "axis"),
    )
    repeat: float = setting(
        6.0,
        "chosen",
        "how often the texture is repeated along an axis",
        0,
        1000,
        unit="repeats",
        needs=("dragon.mapping=axis",),
    )
    painted: bool = setting(False, "chosen", "vertex colours from the mesh file, if it has any")
    gloss: float = setting(0.0, "chosen", "strength of the specular highlight", 0, 1, unit="of 1")
    sheen: float = setting(
        0.0,
        "chosen",
        "how strongly its wet scales mirror the sky and the sea around it",
        0,
        1,
        unit="of 1",
    )
    wet: float = setting(
        0.0,
        "chosen",
        "how wet it is: the sun mirrored in its scales, and a dark band above the water",
        0,
        1,
        unit="of 1",
        needs=("dragon", "dragon.sheen>0"),
    )
    sink: float = setting(
        -0.15, "chosen", "height of the water line on the mesh", -2, 2, unit="of the mesh's -1 to 1"
    )


@dataclass(frozen=True)
class Overlay:
    """The sword (section 8) and the map (section 9)."""

    sword: bool = setting(True, "section 8", "show the sword", needs=("sword",))
    sheen: float = setting(
        0.0,
        "chosen",
        "how strongly the sword's steel mirrors the light around",
        0,
        1,
        unit="of 1",
        needs=("sword", "overlay.sword"),
    )
    blade: bool = setting(
        False,
        "chosen",
        "the blade at rest is geometry with smooth edges, whose steel is a mirror",
        needs=("sword", "overlay.sword"),
    )
    map: bool = setting(True, "section 9", "show the map", needs=("map",))
    map_alpha: float = setting(
        0.75, "chosen", "opacity of the map", 0, 1, unit="of 1", needs=("map", "overlay.map")
    )


@dataclass(frozen=True)
class Fog:
    """GL_FOG (section 10)."""

    # The sun's glints and the sprites that fade out read it even where nothing is drawn in fog.
    READ: ClassVar[str] = "fog or water.glitter or transparent.fade"

    enabled: bool = setting(True, "section 10.2", "fog on or off", needs=(READ,))
    mode: str = setting(
        "exp2",
        "section 10.2",
        "how it thickens with distance",
        choices=("exp2", "exp", "linear"),
        needs=(READ, "fog.enabled"),
    )
    density: float = setting(
        0.12,
        "section 10.2",
        "how dense it is in the modes exp2 and exp",
        0,
        1000,
        unit="per unit",
        needs=(READ, "fog.enabled", "fog.mode!=linear"),
    )
    color: tuple[float, ...] = setting(
        (0.4, 0.6, 0.7), "section 10.2", "colour of the fog and of the background", 0, 1, unit="RGB"
    )
    radial: bool = setting(
        False,
        "chosen",
        "it thickens with the distance from the eye; off, with the depth, less towards the sides",
        needs=("fog", "fog.enabled"),
    )
    start: float = setting(
        1.0,
        "chosen",
        "where it begins in the mode linear",
        0,
        1e5,
        unit=UNITS,
        needs=("fog", "fog.enabled", "fog.mode=linear"),
    )
    end: float = setting(
        20.0,
        "chosen",
        "where it hides everything in the mode linear",
        0,
        1e5,
        unit=UNITS,
        needs=("fog", "fog.enabled", "fog.mode=linear"),
    )


@dataclass(frozen=True)
class Mist:
    """Morning mist over the bay, in transparent sheets; in neither preset."""

    NEEDS: ClassVar[tuple[str, ...]] = ("mist", "mist.enabled")

    enabled: bool = setting(False, "glskel effects", "mist lies over the bay")
    sheets: int = setting(9, "chosen", "how many sheets it is made of", 1, 30, unit="sheets")
    density: float = setting(
        0.55, "chosen", "opacity of a sheet where it is densest", 0, 1, unit="of 1"
    )


# Times of day: what differs from a preset, which shows noon. All values are chosen.
TIMES: dict[str, dict[str, Value]] = {
    "noon": {},
    "sunset": {
        "sky.set": "sunset",
        "sun.azimuth": 250.0,  # where the sun is in the sunset's pictures (studio/sky/air.py)
        "sun.elevation": 4.0,
        "sun.diffuse": (0.95, 0.62, 0.36),
        "sun.ambient": (0.40, 0.38, 0.48),
        "sun.tint": (1.0, 0.78, 0.52),
        "sun.shade": (0.46, 0.44, 0.55),
        "sun.relit": True,
        "water.roughness": 0.33,
        "castle.torches": 1.0,
        "fog.color": (0.86, 0.62, 0.50),  # the pictures' horizon
    },
}


@dataclass(frozen=True)
class Settings:
    """All groups, and the time of day; ``Settings()`` is the preset 2006 at noon."""

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

    time: str = word("noon", TIMES, "chosen", "time of day: sun, sky, fog and torches at once")
    camera: Camera = Camera()
    clock: Clock = Clock()
    walk: Walk = Walk()
    sun: Sun = Sun()
    shading: Shading = Shading()
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
    mist: Mist = Mist()


BEST: dict[str, Value] = {
    "camera.cull": True,
    "camera.lod_pixels": 0.25,
    "walk.mouse_relative": True,
    "walk.swim": True,
    "walk.solid": True,
    "sun.fill": 0.45,
    "sun.shade": (0.35, 0.40, 0.49),
    "ground.resolution": 160,
    "ground.height_image": "height16.png",
    "ground.mid_repeat": 13.0,
    "ground.materials": True,
    "ground.exact_height": True,
    "ground.tiles": 8,
    "ground.shadows": True,
    "ground.weathered": True,
    "ground.lod_bias": -1.2,
    "ground.verdure": 0.8,
    "ground.clouds": 0.5,
    "ground.stones": 10_000,
    "ground.wet": True,
    "ground.low_stretch": True,
    "ground.texture_size": 2048,
    "reflection.castle": True,
    "reflection.rippled": True,
    "reflection.lod_scale": 8.0,
    "water.repeat": 7.0,
    "water.lod_bias": -0.7,
    "water.trilinear": False,
    "water.relief": True,
    "water.ripples": 0.6,
    "water.horizon_contrast": 0.3,
    "water.shallow": True,
    "water.caustics": True,
    "water.under": True,
    "water.foam": True,
    "water.query": True,
    "water.fresnel": True,
    "water.horizon": 400.0,
    "water.glitter": 0.35,
    "water.color": (0.16, 0.32, 0.38, 0.88),
    "sky.refined": True,
    "sky.moving": True,
    "sky.follow_y": True,
    "sky.background": True,
    "sky.unfogged": True,
    "transparent.faces": "place",
    "transparent.upright": True,
    "transparent.split": True,
    "transparent.fade": 0.15,
    "transparent.clear_near": True,
    "transparent.rooted": True,
    "transparent.trimmed": True,
    "transparent.sunward": 0.75,
    "transparent.contact": 0.8,
    "transparent.min_pixels": 2.5,
    "transparent.trilinear": False,
    "transparent.radius": 26.0,
    "trees.species": 4,
    "trees.count": 2200,
    "trees.grouped": True,
    "trees.crown": True,
    "trees.variety": True,
    "deer.follow_slope": True,
    "deer.species": 2,
    "deer.variety": True,
    "deer.back": True,
    "plants.quads": 3,
    "plants.fade_edge_on": True,
    "plants.rosette": True,
    "plants.crossed_within": 7.0,
    "castle.sides": 24,
    "castle.battlements": True,
    "castle.flame_faces": True,
    "castle.multitexture": True,
    "castle.ornate": True,
    "castle.open": True,
    "castle.depth": True,
    "castle.glow": 0.8,
    "castle.weathered": True,
    "plants.sway": 0.35,
    "plants.sway_by_size": True,
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
    "grass.sward": True,
    "grass.flowers": 0.05,
    "grass.gusts": 1.0,
    "rabbit.mapping": "axis",
    "rabbit.painted": True,
    "dragon.mapping": "axis",
    "dragon.painted": True,
    "dragon.gloss": 0.5,
    "dragon.sheen": 0.8,
    "dragon.wet": 1.0,
    "overlay.sheen": 0.5,
    "overlay.blade": True,
    "grass.arch": 4.0,
    "grass.radius": 7.0,
    "fog.density": 0.042,
    "fog.radial": True,
    "fog.color": (0.66, 0.76, 0.84),
}

PRESETS: dict[str, dict[str, Value]] = {"2006": {}, "best": BEST}


def preset(name: str) -> Settings:
    """Return the island's settings of a preset; InputError if there is none of that name."""
    return declare.preset(Settings(), PRESETS, name)
