"""The gain of each pass and technique, as pairs of pictures: without it, and with it.

Their names are views (`landscape render voxel_clip`), and keys switch them in the walk. First the
land, then the shadows, then the water.
"""

from landscape.frame import Pose
from landscape.voxel.safeguard import Safeguard, pair

GLADE = Pose(18.0, None, 18.0, 88.0, 4.0)
BEACH = Pose(8.0, 1.0, 30.0, 20.0, -14.0)
COILS = Pose(13.0, 0.92, 30.2, 330.0, -5.0)
FROM_ABOVE = Pose(21.0, 4.5, 29.0, 10.0, -12.0)
OVER_HILL = Pose(27.2, 7.5, 23.5, 0.0, -38.0)
BARE = {
    "voxel.trees": False,
    "voxel.buildings": False,
    "shadow.enabled": False,
    "sun.azimuth": 100.0,
    "sun.elevation": 18.0,
}
FROM_HIGH = Pose(20.0, 8.0, 36.0, 0.0, -20.0)

LAND: tuple[Safeguard, ...] = (
    Safeguard(
        "voxel_merge",
        "Equal faces side by side are one quad",
        "voxel_castle",
        20.0,
        {"debug.edges": True, "voxel.merge": "none"},
        {"debug.edges": True, "voxel.merge": "rectangles"},
        flaw="Each exposed face of each block is a quad of its own, be they all alike.",
        look="Black lines are the edges of the quads. Where corners are dark, faces differ and "
        "stay apart.",
        how="Runs of equal faces become one quad, and equal runs side by side one rectangle. Its "
        "texture coordinates count blocks, and GL_REPEAT repeats the tile.",
        seen=(
            "a castle of cubes and a meadow, with the edges of every block drawn",
            "a castle of cubes and a meadow, with few, large rectangles drawn",
        ),
    ),
    Safeguard(
        "voxel_occlusion",
        "Corners between blocks are darker",
        "voxel_cliff",
        20.0,
        **pair("voxel.occlusion"),
        flaw="Faces that look the same way have the same light, so that steps hardly show where "
        "one looks at them from above.",
        look="Look at the foot of each step and into the corners.",
        how="Each corner of a face counts the blocks that stand around it, 0 to 3, and its vertex "
        "colour is darker for each. OpenGL interpolates the rest.",
        seen=(
            "steps of grass without any shading in their corners",
            "steps of grass with soft dark edges at their feet",
        ),
    ),
    Safeguard(
        "voxel_slope",
        "The light follows the land's slope",
        OVER_HILL,
        20.0,
        BARE | {"voxel.slope": 0.0},
        BARE | {"voxel.slope": 1.0},
        flaw="The upper faces of all cubes look straight up and have the same light, so that hills "
        "look as flat as meadows.",
        look="Look at the hillside at the left, which is turned away from the low sun in the east. "
        "Trees, buildings and other shadows are left out here.",
        how="The height image knows the land's normal everywhere. How much it faces the sun is "
        "multiplied into the vertex colours when the meshes are made.",
        seen=(
            "a green hill of terraces, all of them equally bright",
            "the same hill, dark on the side that is turned away from the sun",
        ),
    ),
    Safeguard(
        "voxel_highlights",
        "Highlights of the sun, by material",
        Pose(14.3, 1.3, 30.5, 128.0, -42.0),
        20.0,
        {"voxel.highlights": 0.0},
        {"voxel.highlights": 1.0},
        flaw="The blocks have diffuse light alone, as if all of them were chalk.",
        look="Look at the sand where the sun is mirrored.",
        how="The land nearby is drawn once more and added, one direction at a time: "
        "GL_REFLECTION_MAP looks a blurred sun up in a cube map, and a second column of tiles says "
        "how glossy each material is.",
        seen=("a beach in even light", "a beach that shines where the sun is mirrored"),
    ),
    Safeguard(
        "voxel_near",
        "Plants and dark corners near the eye",
        GLADE,
        20.0,
        {"voxel.near": 0.0},
        {"voxel.near": 6.5},
        flaw="The simple meshes for far regions are drawn here, too: without plants, and without "
        "dark corners.",
        look="Look at the ground near the eye.",
        how="Each region has several meshes in the vertex buffer. The distance of its box "
        "chooses one.",
        seen=("a forest on a bare lawn", "a forest with grass and flowers on its ground"),
    ),
    Safeguard(
        "voxel_mipmaps",
        "Tiles in smaller and smaller sizes",
        FROM_ABOVE,
        20.0,
        **pair("voxel.mipmaps", camera={"fov": 40.0}),
        flaw="Far away, one pixel covers many texels of a tile, and shows one of them: noise that "
        "flickers as one walks.",
        look="Compare the hills and the woods in the distance.",
        how="All tiles are one texture with mip levels. Around each there is more of the same "
        "tile, so that none bleeds into another.",
        seen=("far hills with a grainy pattern", "far hills in calm colours"),
    ),
    Safeguard(
        "voxel_cull",
        "Regions out of view are not sent",
        "voxel_castle",
        20.0,
        **pair("voxel.cull", debug={"regions": True}),
        flaw="The whole map is sent in each frame, also what lies behind the eye.",
        look="The inset shows what is sent, seen from outside, with the view frustum in yellow. "
        "Boxes of culled regions are red.",
        how="The corner of a region's box that lies farthest along a plane's normal is compared "
        "with that plane: six comparisons a region, in numpy for all at once.",
        seen=(
            "a castle, and in the inset the whole island",
            "a castle, and in the inset only the part of the island within the frustum",
        ),
    ),
    Safeguard(
        "voxel_fog",
        "Fog hides where the land ends",
        FROM_ABOVE,
        20.0,
        **pair("fog.enabled", voxel={"distance": 13.0}),
        flaw="Regions farther away than voxel.distance are not drawn, and without fog the land is "
        "cut off there.",
        look="Look at the horizon.",
        how="GL_FOG with an exponential of the distance, in the colour of the sky at the horizon.",
        seen=("a land cut off in front of the sky", "a land that fades into haze"),
    ),
)
SHADOWS: tuple[Safeguard, ...] = (
    Safeguard(
        "voxel_shadow",
        "Shadows of the sun",
        GLADE,
        20.0,
        **pair("shadow.enabled"),
        flaw="Every face that looks towards the sun is lit, also under trees and behind walls.",
        look="Look at the ground under the trees.",
        how="The land's depths as the sun sees them are a texture, laid over the land by "
        "GL_EYE_LINEAR; GL_COMPARE_R_TO_TEXTURE compares with them at each pixel.",
        seen=("a forest in even light", "a forest with patches of sun on shaded ground"),
    ),
    Safeguard(
        "voxel_shadow_offset",
        "Faces that do not shade themselves",
        "voxel_castle",
        20.0,
        **pair("shadow.offset"),
        flaw="The sun's picture has one depth for each texel, the land a different one for each "
        "pixel. Half of a sloping face is therefore farther away than its own depth, and shades "
        "itself in stripes.",
        look="Look at the walls and at the grass.",
        how="glPolygonOffset moves the faces away from the sun while its picture is drawn.",
        seen=("castle and meadow covered with dark stripes", "castle and meadow in the sun"),
    ),
    Safeguard(
        "voxel_shadow_far",
        "Shadows far from the eye",
        FROM_HIGH,
        20.0,
        {"shadow.far": False, "time": "sunset"},
        {"shadow.far": True, "time": "sunset"},
        flaw="The sun's picture covers a square around the eye; beyond it nothing is in shadow, "
        "not even the back of a mountain.",
        look="Look at the mountain, and at the meadows before it.",
        how="Regions that do not lie wholly in the square are drawn with a second, coarser "
        "picture, which covers all of the land and is drawn once.",
        seen=(
            "an island at sunset whose far half is without shadows",
            "an island at sunset with long shadows everywhere",
        ),
    ),
    Safeguard(
        "voxel_sea_haze",
        "From high above, far land fades into the sea",
        FROM_HIGH,
        20.0,
        **pair("voxel.sea_haze"),
        flaw="Land fades into the colour of the sky at the horizon. Seen from high above it lies "
        "in front of the sea, and looks like a ghost.",
        look="Look at the mountain and the castle.",
        how="The colour of GL_FOG goes from the sky's to the sea's as the eye rises.",
        seen=("a pale island in a blue sea", "an island that fades into the sea behind it"),
    ),
    Safeguard(
        "voxel_shadow_sky",
        "The light of the sky in shadow",
        GLADE,
        20.0,
        {"shadow.color": (0.0, 0.0, 0.0)},
        {"shadow.color": (0.50, 0.56, 0.70)},
        flaw="Multiplied by the answer of the comparison, 0 or 1, shadows are black.",
        look="Look into the shadows.",
        how="GL_INTERPOLATE in the first texture unit mixes the sky's colour and full light by the "
        "second unit's answer (ARB_texture_env_crossbar), before the tile is multiplied in.",
        seen=("a forest with black shadows", "a forest with bluish shadows"),
    ),
)
WATER: tuple[Safeguard, ...] = (
    Safeguard(
        "voxel_reflection",
        "Land in the water's mirror",
        BEACH,
        20.0,
        **pair("water.reflection"),
        flaw="The water mirrors only the sky, as if there were no land.",
        look="Look at the water below the sea dragon and the far shore.",
        how="The land is drawn once more, from below: glMultMatrix mirrors it at the water, into a "
        "texture, which the texture matrix projects onto the water.",
        seen=("a bay that mirrors only the sky", "a bay that mirrors dragon and shore"),
    ),
    Safeguard(
        "voxel_refraction",
        "The ground under the water",
        BEACH,
        20.0,
        **pair("water.refraction"),
        flaw="Under its mirror image the water has one plain colour.",
        look="Look at the shallow water in front.",
        how="What lies under the water is drawn into a second texture, nearer to the surface by "
        "3/4, as it looks from above.",
        seen=("opaque, dark water at a beach", "clear water over sand and pebbles"),
    ),
    Safeguard(
        "voxel_depth",
        "Darker with depth",
        BEACH,
        20.0,
        {"water.clear": 1000.0},
        {"water.clear": 9.0},
        flaw="The ground in deep water is as bright as that in shallow water.",
        look="Follow the ground from the beach into the bay.",
        how="The fog coordinate of a vertex is its height (GL_FOG_COORD): linear fog in the colour "
        "of deep water begins at the surface.",
        seen=("a bay whose ground is bright down to its bottom", "a bay that is dark where deep"),
    ),
    Safeguard(
        "voxel_fresnel",
        "Clear from above, a mirror from aside",
        BEACH,
        20.0,
        **pair("water.by_angle"),
        flaw="Water that mirrors as much everywhere: too much in front, where one looks down into "
        "it, and too little in the distance.",
        look="Compare the water in front and that in the distance.",
        how="Fresnel's term is the alpha of a cube map, looked up with the direction from the eye "
        "to the water; GL_INTERPOLATE mixes by it.",
        seen=(
            "water that is milky with the sky in front, and lets one see the ground afar",
            "water that is clear in front and a mirror afar",
        ),
    ),
    Safeguard(
        "voxel_ripples",
        "Ripples",
        COILS,
        20.0,
        {"water.ripples": 0.0},
        {"water.ripples": 3.0},
        flaw="The water is a sheet of glass.",
        look="Look at the edges of what is mirrored.",
        how="The coordinates by which both textures are looked up are moved at the vertices of a "
        "grid that is even on the screen.",
        seen=("a bay as smooth as glass", "a bay whose mirror images waver"),
    ),
    Safeguard(
        "voxel_bending",
        "Refraction within the picture",
        Pose(8.0, 1.0, 30.0, 20.0, -14.0),
        20.0,
        {"water.bending": "walter"},
        {"water.bending": "flat"},
        flaw="Walter's model bends each line of sight by Snell's law. Near the eye it then leads "
        "to a bed that lies below the picture's edge and was never drawn.",
        look="Look at the lower edge, where the last row of the picture is smeared.",
        how="All that lies under water is drawn at 3/4 of its depth, as it looks from straight "
        "above, and looked up where it is seen.",
        seen=(
            "a clear bay whose bed ends in vertical stripes",
            "a clear bay whose bed goes on to the lower edge",
        ),
    ),
    Safeguard(
        "voxel_below",
        "The surface from beneath",
        Pose(13.0, 0.6, 34.0, 345.0, 15.0),
        20.0,
        **pair("water.below"),
        flaw="An eye under water sees the surface as from above, and no bed.",
        look="Look at the bed, at its mirror image, and at the round window through which the sky "
        "is seen.",
        how="The two pictures change places: the surface mirrors the bed, and through it one sees "
        "what is above. Fresnel's cube map is 1 beyond the critical angle. Linear fog bounds the "
        "sight.",
        seen=(
            "an evenly blue picture with a dark disc",
            "steps of the sea bed, mirrored by the surface, and the sky in a round window",
        ),
    ),
    Safeguard(
        "voxel_sparkle",
        "The sun glitters",
        Pose(14.0, 1.2, 32.5, 128.0, -4.0),
        20.0,
        {"sun.elevation": 20.0, "water.sparkle": 0.0},
        {"sun.elevation": 20.0, "water.sparkle": 2.0},
        flaw="The water mirrors sky and land, but not the sun, which is in no picture.",
        look="Look below the sun.",
        how="GL_DOT3_RGBA of a map of normals and of the half vector between sun and eye, which is "
        "the vertex colour; a threshold and a steep line leave the glints.",
        seen=("a sea without glints", "a sea with a path of glints towards the sun"),
    ),
)
SAFEGUARDS = (*LAND, *SHADOWS, *WATER)
