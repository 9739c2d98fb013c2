"""The texts of the fly-over's page: its introduction, its pictures and its pairs."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from landscape.flyover.settings import BEST
from landscape.settings.declare import Value

QUALITY = 60  # chosen: of its pictures as WebP


@dataclass(frozen=True)
class Shot:
    """A picture of a flight: at which second, what is seen, what to look at, and how it is drawn.

    ``name`` is the stem of its file.
    """

    name: str
    environment: str
    at: float
    title: str
    seen: str
    look: str
    settings: Mapping[str, Value] = field(default_factory=dict)
    preset: str = BEST


@dataclass(frozen=True)
class Pair:
    """A technique in two pictures, the first one without it: ``key`` is its switch.

    ``seen`` describes both pictures. ``settings`` hold for both.
    """

    name: str
    environment: str
    at: float
    key: str
    title: str
    flaw: str
    seen: tuple[str, str]
    look: str
    how: str
    settings: Mapping[str, Value] = field(default_factory=dict)


# The title, then the paragraphs before the first picture.
INTRODUCTION = (
    "The software fly-over",
    "A terrain drawn without OpenGL: numpy computes every pixel, on the processor. A project for "
    "students asks for it, with a camera on a path drawn in Inkscape, triangles in wire "
    "frame, and as many frames per second as can be had. `landscape flyover` shows the flight in a "
    "window, where the digit keys turn each technique on and off.",
    "[docs/flyover.md](../../docs/flyover.md) explains the techniques in order, and how much time "
    "each saves. The command below a picture draws it, and needs neither a screen nor OpenGL.",
)

FILLED: dict[str, Value] = {"flyover.mode": "filled"}

# Each environment that comes with the program, in lines and filled, at the same moment.
VIEWS = (
    Shot(
        "flyover_canyon",
        "canyon",
        39,
        "the canyon in lines",
        "a canyon of fine coloured lines, with steep walls and a flat, dark blue river",
        "Blue lines are low and brown ones high. What is behind a wall is not drawn, and distant "
        "walls have no more lines than near ones.",
    ),
    Shot(
        "flyover_canyon_filled",
        "canyon",
        39,
        "the canyon, filled",
        "a river between layered cliffs, under a blue sky with small clouds",
        "The same moment, column by column instead of line by line. The river mirrors cliffs and "
        "sky; the cliffs cast shadows.",
        FILLED,
    ),
    Shot(
        "flyover_alps",
        "alps",
        13,
        "the alps in lines",
        "mountains of coloured lines around a green valley",
        "Follow the net of triangles from the meadow in front to the ridge: its squares are larger "
        "and larger on the ground, and about the same on the screen.",
    ),
    Shot(
        "flyover_alps_filled",
        "alps",
        13,
        "the alps, filled",
        "rocky mountains around a green valley, under clouds",
        "Grass grows where it is level, rock shows where it is steep, and the sun lights one side "
        "of each ridge.",
        FILLED,
    ),
    Shot(
        "flyover_island",
        "island",
        9,
        "the island in lines",
        "a mountain of coloured lines behind a bay",
        "The heights are those of the island that OpenGL draws, and the path goes around it.",
    ),
    Shot(
        "flyover_island_filled",
        "island",
        9,
        "the island, filled",
        "a mountain behind a bay of clear water that mirrors it",
        "Where the water is shallow one sees the sand below it; from farther away it is a mirror.",
        FILLED,
    ),
)

STEPS_HEADING = "From the document's picture to ours"
STEPS_TEXT = (
    "The first picture is what the project asks for, with its view volume and its colours. Each of "
    "the following ones changes something."
)
STEPS = (
    Shot(
        "flyover_step_document",
        "canyon",
        26,
        "what the document asks for",
        "a tangle of black lines on white",
        "Triangles in wire frame. One sees through all the walls. The view volume is as wide as it "
        "is high, which stretches the picture on a screen that is not square.",
        preset="document",
    ),
    Shot(
        "flyover_step_hidden",
        "canyon",
        26,
        "without hidden lines",
        "a canyon in black lines on white, stretched sideways",
        "A floating horizon removes what is behind something nearer: from front to back it keeps, "
        "for each column of the screen, how high the terrain has been so far.",
        {"flyover.hidden_lines": True},
        "document",
    ),
    Shot(
        "flyover_step_plain",
        "canyon",
        26,
        "in its proportions",
        "a canyon in black lines on white, with a steep rock in the middle",
        "The view volume is as wide as the screen, and the camera follows a smooth curve over the "
        "ground instead of each bump.",
        {"flyover.colours": "plain"},
    ),
    Shot(
        "flyover_step_distance",
        "canyon",
        26,
        "lines that fade with distance",
        "the same canyon, its distant walls pale",
        "Near and far are told apart by the lines alone.",
        {"flyover.colours": "distance"},
    ),
    Shot(
        "flyover_step_height",
        "canyon",
        26,
        "colours by height",
        "the same canyon with blue lines at the river and brown ones at the edge",
        "The colours of a map, which fade with distance, too. This is the default.",
        {"flyover.colours": "height"},
    ),
    Shot(
        "flyover_step_phosphor",
        "canyon",
        26,
        "a green screen",
        "the same canyon in green lines on black",
        "As a vector display would have shown it.",
        {"flyover.colours": "phosphor"},
    ),
    Shot(
        "flyover_step_filled",
        "canyon",
        26,
        "filled",
        "the same canyon as a landscape with layered rock and a river",
        "Voxel space, the technique of a game of 1992: each column of the screen is walked away "
        "from the eye over the height field.",
        FILLED,
    ),
)

PAIRS_HEADING = "Each technique, off and on"
PAIRS_TEXT = (
    "The left picture is drawn without the technique, the right one with it. Strips, bounding "
    "volumes and the quad-tree are not here: they make no other picture, only less work, and "
    "[docs/flyover.md](../../docs/flyover.md) says how much."
)
PAIRS = (
    Pair(
        "flyover_detail",
        "alps",
        13,
        "flyover.detail",
        "Fewer vertices far away",
        "Each pixel of the height image is a vertex, however far away it is. Distant slopes are "
        "almost solid with lines. The far plane is nearer here, as all of this takes time.",
        (
            "mountains whose distant slopes are solid with lines",
            "the same mountains in an even net of lines",
        ),
        "Look at the slopes in the distance.",
        "Tiles of terrain have half as many vertices a side at each level. Which level a tile has "
        "follows from its distance.",
        {"flyover.far_undetailed": 600.0},
    ),
    Pair(
        "flyover_morph",
        "alps",
        13,
        "flyover.morph",
        "Levels of detail that meet",
        "Where two levels meet, the finer one has vertices that the coarser one does not know. "
        "Their edges do not fit, and in flight a whole tile changes at once.",
        (
            "a slope on which small triangles border abruptly on large ones",
            "the same slope in larger triangles, some edges of which stop short",
        ),
        "Look at where small triangles meet large ones, on the slope in the middle.",
        "Before the level ends, its vertices glide to where the coarser level has its edges. At "
        "the border both are the same. Edges that the coarser level does not have get shorter "
        "until they are gone.",
        {"flyover.near": 6.0},
    ),
    Pair(
        "flyover_back_faces",
        "alps",
        13,
        "flyover.back_faces",
        "Slopes that face away",
        "The far side of every mountain is drawn, too.",
        (
            "a tangle of lines in front of and behind each ridge",
            "the same ridges with fewer lines",
        ),
        "Look at the ridges. What is still seen through them faces the camera: only the hidden "
        "lines' removal takes that away.",
        "An edge is dropped if both its triangles are turned away from the camera: it is below "
        "their planes, as the sign of a determinant tells.",
        {"flyover.hidden_lines": False},
    ),
    Pair(
        "flyover_hidden_lines",
        "canyon",
        39,
        "flyover.hidden_lines",
        "Hidden lines removed",
        "Lines have nothing between them to hide what is behind.",
        (
            "walls of a canyon through which one sees all the lines behind",
            "walls of a canyon that hide what is behind",
        ),
        "Look at the steep wall on the right.",
        "The floating horizon: lines are taken from front to back, and pixels below the highest so "
        "far in their column are left out.",
    ),
    Pair(
        "flyover_mirror",
        "island",
        22,
        "flyover.mirror",
        "Terrain without end",
        "The world ends at the edge of the image.",
        (
            "an island's slope, and nothing beyond it",
            "an island's slope, and the sea with other islands up to the horizon",
        ),
        "Look at the horizon.",
        "Each border of the image is a mirror. An index that has left it is reflected back, so "
        "that heights meet at every level of detail.",
    ),
    Pair(
        "flyover_smooth",
        "island",
        10,
        "filled.smooth",
        "Ground without steps",
        "Each pixel of the height image is a block with a flat top, and each texel a square, as "
        "in 1992.",
        (
            "an island of blocks, large ones in front",
            "the same island with smooth slopes",
        ),
        "Look at the ground in front.",
        "Heights are interpolated between four pixels, close by also the colours.",
        FILLED,
    ),
    Pair(
        "flyover_levels",
        "alps",
        16,
        "filled.levels",
        "Smaller copies for far ground",
        "Far away one pixel covers many texels of the ground and shows one of them by chance. In "
        "flight that glitters.",
        (
            "a valley whose distant slopes are grainy",
            "the same valley with calm distant slopes",
        ),
        "Look at the mountains in the distance.",
        "The picture of the ground has copies of half the size, a quarter, and so on, as mipmaps. "
        "Distance chooses one.",
        FILLED,
    ),
    Pair(
        "flyover_fog",
        "island",
        22,
        "filled.fog",
        "Haze",
        "Far islands are as clear as near ones, and one sees where the terrain ends.",
        (
            "a view over the sea with islands that are clear to the horizon",
            "the same view with islands that fade into the haze",
        ),
        "Look at the horizon.",
        "Colours turn to that of the sky behind them with distance, and the march ends where "
        "nothing else is seen.",
        FILLED,
    ),
    Pair(
        "flyover_shadows",
        "canyon",
        0,
        "filled.shadows",
        "The sun's shadows",
        "Slopes that face the sun are lit, even if a mountain stands before it.",
        (
            "cliffs of a canyon, all in the sun",
            "the same cliffs with the shadows of others on them",
        ),
        "Look at the walls on both sides.",
        "Once for the whole terrain: what the sun reaches is found, and its light "
        "is part of the ground's colours.",
        FILLED,
    ),
    Pair(
        "flyover_occlusion",
        "canyon",
        30,
        "filled.occlusion",
        "Darker hollows",
        "The sky lights the bottom of a canyon as much as a mountain top.",
        (
            "a canyon in even light",
            "a canyon with darker gullies",
        ),
        "Look at the gullies and at the foot of the walls.",
        "Once for the whole terrain: how much of the sky each texel sees dims the sky's light.",
        FILLED,
    ),
    Pair(
        "flyover_reflection",
        "canyon",
        26,
        "filled.reflection",
        "Water that mirrors",
        "Water is a plain colour.",
        (
            "a dull river between cliffs",
            "a river that mirrors cliffs and sky",
        ),
        "Look at the water below the cliffs.",
        "More of the sky's colour the flatter one looks, by Fresnel's term; the land behind the "
        "water is mirrored from what the march has found.",
        FILLED,
    ),
    Pair(
        "flyover_clouds",
        "alps",
        12,
        "filled.clouds",
        "Clouds",
        "The sky is a plain gradient.",
        (
            "mountains under a plain blue sky",
            "mountains under a sky with clouds",
        ),
        "Look at how the clouds get smaller towards the horizon.",
        "Once, noise is laid on a level far above the ground and kept in a panorama, in which each "
        "pixel looks up its direction.",
        FILLED,
    ),
)
