"""The texts of each scene's page of the gallery: an introduction, two texts a picture."""

from collections.abc import Mapping
from dataclasses import dataclass, field

QUALITY = {"hall": 84, "voxel": 60}  # chosen: of a scene's pictures as WebP


@dataclass(frozen=True)
class Step:
    """A picture of a view drawn in another way: its title and captions, and how it is drawn.

    ``only`` names the elements that are drawn, all that stand there if it is empty.
    """

    name: str
    view: str
    title: str
    seen: str
    look: str
    settings: Mapping[str, object] = field(default_factory=dict)
    only: tuple[str, ...] = ()


# The title, then the paragraphs before the first picture.
INTRODUCTIONS: dict[str, tuple[str, ...]] = {
    "hall": (
        "The great hall",
        "The castle's door leads into a hall for the classic effects of fixed-function OpenGL: "
        "those of Mark Kilgard's examples and of the SIGGRAPH courses of 1995 to 1997, as the "
        "notes on glSkel describe them. `landscape walk hall` begins here; the digit keys turn "
        "each effect on and off. [docs/errata.md](../../docs/errata.md) shows what those notes "
        "print wrongly.",
        "Each effect needs safeguards. The second part of this page takes away one at a time, and "
        "shows what it prevents. Each is a setting, and its name is also that of a view: after "
        "`landscape walk mirror_stencil`, V turns it off and on.",
    ),
    "voxel": (
        "The island in voxels",
        "The island once more, as 500 x 500 columns of cubes. A student's project had five shaders "
        "for such a terrain; here it is drawn with fixed-function OpenGL, and "
        "[docs/voxels.md](../../docs/voxels.md) says what became of each shader. `landscape walk "
        "voxel` begins in the first view.",
        "After the views come the passes of one frame, one by one, and then what each pass and "
        "each technique adds, in pairs. Each is a setting, and its name is also that of a view: "
        "after `landscape walk voxel_refraction`, V turns it off and on.",
    ),
}

# By view: what is seen, for readers who cannot see it, and what to look at.
VIEW_TEXTS: dict[str, dict[str, tuple[str, str]]] = {
    "hall": {
        "hall": (
            "a vaulted hall with a pool, and a golden dragon before a round window",
            "Sunlight, skylight and torchlight are baked into a texture by tracing rays, and "
            "multiply the stone in a second texture unit. What moves or depends on where one "
            "stands is drawn live: mirror image, shadows, caustics, sky, flames.",
        ),
        "hall_mirror": (
            "the golden dragon on its plinth, upside down in the polished floor below it",
            "The hall is drawn twice. The stencil buffer limits the mirror image to the floor, and "
            "the floor is blended over it. At grazing angles it mirrors more; what is high up is "
            "mirrored dimly, as in polished stone.",
        ),
        "hall_shadow": (
            "a golden dragon, a torch, and the dragon's large shadow on a wall of stone",
            "The statue is drawn flat, by a matrix that projects it from the torch onto floor and "
            "wall. The shadow takes away the torch's light alone; the light of all other "
            "sources stays.",
        ),
        "hall_caustics": (
            "a net of light on the bed of a pool that mirrors a golden dragon",
            "A texture of refracted light, with coordinates that OpenGL generates from the "
            "position, multiplies the pool's bed and brightens the stone around it. What the water "
            "mirrors is a cube map of the hall.",
        ),
        "hall_one_floor": (
            "a golden dragon on its plinth, the shadow of neck and horns on the floor before it",
            "One lamp, which hangs behind the dragon, throws the shadows of dragon, pillars and "
            "torches onto the plinth and the floor that mirrors them. The lamp is no point: a "
            "shadow is the softer the farther away what casts it is. In a walk, drag with the "
            "right mouse button: the lamp goes around the dragon, up and down. Here no sun shines "
            "on plinth and floor.",
        ),
        "hall_ball": (
            "a ball of silver that mirrors a vaulted hall with windows, pillars and a door",
            "The same sphere map as on the dragon, larger. A ball mirrors the hall in one piece, "
            "so that one finds everything in it that is behind the viewer.",
        ),
        "hall_sky": (
            "a blue sky with thin white clouds, seen through the open ribs of a vault",
            "Quake's sky: two layers of cloud on a dome, laid by two texture units in one pass. "
            "The low one moves five times as fast.",
        ),
        "hall_texture": (
            "walls of stone with deep, dark joints beside smooth pillars and a golden dragon",
            "The texture of the walls has 2.4 times its contrast. Copied back from a framebuffer "
            "object through glPixelTransfer, it was not loaded again; all else is as before.",
        ),
        "hall_contrast": (
            "a bright golden dragon in a dim hall",
            "One quad over the whole picture changes each pixel by blending; the stencil buffer "
            "keeps the statue as it is. The flames are drawn after it.",
        ),
        "hall_sphere": (
            "a dragon of gold that mirrors windows and walls",
            "What the gilding mirrors is a picture of the hall, looked up by the reflection "
            "vector of each vertex. It is darker where little of the hall's light arrives.",
        ),
        "hall_mist": (
            "mist over the pool and the floor of the hall",
            "Five transparent sheets drift in different directions; they are blended from far to "
            "near, and densest over the water. Around pillars they thin out.",
        ),
        "hall_exhibits": (
            "a wall with a row of lit alcoves, in the first of them a torch and a bronze knot",
            "Six exhibits: shadow volume, soft shadow, motion blur, depth of field, hidden lines, "
            "solids. Each is drawn with its effect when one is near, and without it from afar.",
        ),
        "hall_exhibit_volume": (
            "a bronze knot beside a torch, and its dark shadow on the walls of an alcove",
            "From each edge of the knot's outline, as the flame sees it, a face leads away. These "
            "faces enclose what is in the shadow. The stencil buffer counts them for each pixel; "
            "where the count is 0, the torch's light is added.",
        ),
        "hall_exhibit_blur": (
            "a small windmill whose red and blue sails are blurred",
            "The sails are drawn many times while they turn, and the mean of all the pictures is "
            "shown.",
        ),
    },
    "voxel": {
        "voxel_bay": (
            "a green sea dragon of cubes at a beach of cubes, in calm blue water",
            "The dragon is made of the mesh that swims in the island's bay: a block wherever the "
            "mesh is. Water shows the ground near the beach, and mirrors dragon and sky farther "
            "away.",
        ),
        "voxel_castle": (
            "a castle of cubes with pointed towers and red banners on a green hill",
            "Corners between blocks are darker. Each face has one of a few tiles, and its vertex "
            "colours vary the tint over the land.",
        ),
        "voxel_cliff": (
            "a grey mountain of cubes with snow and a beacon on its top, trees at its foot",
            "The material of a column follows its height and its slope: rock where it is steep, "
            "then snow, grass, earth, sand.",
        ),
        "voxel_water": (
            "a rocky islet in calm, glittering water, and in front the ground below it",
            "In front one looks into the water, in the distance at its mirror image. The ground "
            "darkens with its depth. Ripples that mirror the sun glint.",
        ),
        "voxel_forest": (
            "a glade with flowers, trees of cubes around it, and a mountain behind them",
            "Trees grow block by block, no two alike. Grass and flowers are crossed quads with "
            "holes, by the alpha test.",
        ),
        "voxel_regions": (
            "a beach and a sea dragon under green boxes, red boxes behind them, and in a corner "
            "the map from outside",
            "Each region of 20 x 20 columns has a box. Those in the frustum and near enough are "
            "drawn, green; the others are culled, red: here all beyond 13 units. The inset shows "
            "the frustum from outside, and the regions it leaves.",
        ),
    },
}

# By scene: sections of further pictures, each with its heading and its introduction.
STEPS: dict[str, tuple[tuple[str, str, tuple[Step, ...]], ...]] = {
    "voxel": (
        (
            "The passes of a frame",
            "What OpenGL draws for the view voxel_bay: three textures, and the picture step by "
            "step.",
            (
                Step(
                    "voxel_pass_shadow",
                    "voxel_bay",
                    "the depths that the sun sees",
                    "a grey picture of the island from above, nearer parts darker",
                    "The land around the eye, drawn from the sun into a depth texture. "
                    "It is kept until the eye has moved far enough or a block changes.",
                    {"debug.picture": "shadow"},
                ),
                Step(
                    "voxel_pass_reflection",
                    "voxel_bay",
                    "what the water mirrors",
                    "dragon and trees upside down, and below them an upside-down sky",
                    "The land above the water, mirrored at its plane, and the sky, in a texture of "
                    "half the window's size.",
                    {"debug.picture": "reflection"},
                ),
                Step(
                    "voxel_pass_refraction",
                    "voxel_bay",
                    "what lies under the water",
                    "a beach that goes down into dark blue",
                    "The land under the water, flattened to 3/4 of its depth, and "
                    "darker with depth by the fog coordinate.",
                    {"debug.picture": "refraction"},
                ),
                Step(
                    "voxel_pass_land",
                    "voxel_bay",
                    "the land alone",
                    "the dragon on the dry ground of its bay, in even light",
                    "The tiles times the vertex colours, which hold light, tint and dark corners.",
                    {"shadow.enabled": False},
                    ("land",),
                ),
                Step(
                    "voxel_pass_shadows",
                    "voxel_bay",
                    "the land with shadows",
                    "the same with shadows below the dragon and behind the steps",
                    "The same, compared with the depths that the sun sees at each pixel.",
                    only=("land",),
                ),
                Step(
                    "voxel_pass_water",
                    "voxel_bay",
                    "land and water",
                    "the dragon in its bay, with haze instead of a sky",
                    "One grid of quads in four texture units mixes the two textures by Fresnel's "
                    "term.",
                    only=("land", "water"),
                ),
                Step(
                    "voxel_pass_sky",
                    "voxel_bay",
                    "the whole picture",
                    "the dragon in its bay under a sky with clouds",
                    "The sky, a cube map, is drawn where nothing else is.",
                ),
            ),
        ),
        (
            "To look at while walking",
            "The settings of `debug` show more than the picture. In the walk, L shows the regions "
            "and K the textures, as in the project that this follows.",
            (
                Step(
                    "voxel_debug_textures",
                    "voxel_bay",
                    "the four textures along the lower edge",
                    "the sea dragon in its bay, and four small pictures in a row below it",
                    "From the left: reflection, refraction, the depths that the sun sees, and "
                    "those that the eye sees.",
                    {"debug.textures": True},
                ),
                Step(
                    "voxel_debug_edges",
                    "voxel_cliff",
                    "the edges of all quads",
                    "a mountain of cubes with black lines around each quad",
                    "Equal faces are merged; dark corners keep faces apart, and far regions have "
                    "none.",
                    {"debug.edges": True},
                ),
            ),
        ),
    ),
}

PAIRS_TEXT = (
    "The left picture is drawn without the safeguard, the right one with it. Nothing else differs."
)
