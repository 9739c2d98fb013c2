"""What the gallery says of each panel: what is in the picture, and what to look at.

A caption tells a reader who cannot know what was meant: first what to see, then the technique.
Names of panels and fixes in it, as fig17b or R4, become links.
"""

from dataclasses import dataclass

CODE = "../landscape"

INTRODUCTION = (
    "# The figures of 2006, and their fixes",
    "",
    "[landscape](../README.md) is a Python program that draws an island with classic OpenGL,"
    " without shaders, and lets you walk on it ([how to get"
    " it](../README.md#two-commands)). It follows a student's report of December 2006, Damien"
    " Rohmer's *TP OpenGL: Rendu de paysage naturel* (CPE Lyon), which explains its techniques"
    " one by one in 43 figures.",
    "",
    "Here are these figures, drawn again: 87 pictures, with our own images and meshes instead"
    " of the borrowed ones of 2006. Then come the fixes: for each remedy that the report"
    " proposes, and for some things beyond it, a picture before and one after.",
    "",
    "**Words.**",
    "",
    "- *Preset*: all settings of the program at once. `2006` has the report's numbers and its"
    " faults; `best` has nearly all fixes turned on, and many more trees and blades"
    f" ([settings.py]({CODE}/settings.py) lists both). The pictures here are drawn with `2006`;"
    " what a picture needs besides, as a wider lens or thinner fog, is set in its view"
    f" ([views.py]({CODE}/views.py)) or in its command.",
    f"- *R1* to *R19*: the remedies of the report's discussion, in our count"
    f" ([fixes.py]({CODE}/fixes.py)). *best1* to *best5*: what the preset `best` adds of its"
    " own.",
    "- *fig17b*: figure 17, panel b; also the name of the view, as in `landscape render fig17b`.",
    "- *Billboard*: a picture on a rectangle that turns to the viewer. *Crossed quads*: two"
    " such rectangles that stand still and cross. *Alpha*: how opaque a point of a texture or"
    " a vertex is. *Texture unit*: one of the places that hold a texture; with several, one"
    " pass mixes several textures. *kt*: the counter of time, 30 a second. *Unit*: of length,"
    " about 17 m; the walker's eyes are 0.1 units high.",
    "",
    "The command under a picture makes it, with no screen needed. `landscape figures --check`"
    " compares all of them with what the program draws today; `landscape figures --update`"
    " renews them, and this page.",
    "",
    "**Contents.**",
    "",
)


@dataclass(frozen=True)
class Part:
    """A part of the page: its heading, its figures, first and last, and what is said of them."""

    heading: str
    first: int
    last: int
    text: str


PARTS = (
    Part(
        "The ground",
        1,
        5,
        "A height image becomes triangles with two textures "
        f"([ground.py]({CODE}/elements/ground.py)).",
    ),
    Part(
        "The water",
        6,
        11,
        f"The land upside down ([reflection.py]({CODE}/elements/reflection.py)) under a blended, "
        f"moving plane ([water_surface.py]({CODE}/elements/water_surface.py)).",
    ),
    Part(
        "The sky",
        12,
        14,
        f"Five pictures on the inside of a box ([sky_box.py]({CODE}/elements/sky_box.py)).",
    ),
    Part(
        "Trees and deer",
        15,
        18,
        "Flat pictures that face the viewer, sorted from far to near "
        f"([transparent_elements.py]({CODE}/elements/transparent_elements.py)).",
    ),
    Part(
        "Plants and grass",
        19,
        22,
        "Two pictures that cross for each plant "
        f"([transparent_elements.py]({CODE}/elements/transparent_elements.py)), three triangles "
        f"for each blade ([grass.py]({CODE}/elements/grass.py)).",
    ),
    Part(
        "The castle",
        23,
        25,
        f"Walls in blended layers, and animated fire ([castle.py]({CODE}/elements/castle.py)).",
    ),
    Part(
        "Rabbit and dragon",
        26,
        29,
        "Meshes from files, and two ways to lay a texture on them "
        f"([rabbit.py]({CODE}/elements/rabbit.py), [dragon.py]({CODE}/elements/dragon.py)).",
    ),
    Part(
        "Sword, map and fog",
        30,
        34,
        f"What lies over the whole picture ([sword.py]({CODE}/elements/sword.py), "
        f"[map.py]({CODE}/elements/map.py), [fog.py]({CODE}/elements/fog.py)).",
    ),
    Part("All together", 35, 35, f"Nine views of the whole ([island.py]({CODE}/island.py))."),
    Part(
        "What is wrong",
        36,
        43,
        "The report ends with faults of its own pictures. These panels are meant to look wrong; "
        "each names its fix.",
    ),
)
FIXED = "What the report proposes"
ADDED = "What best adds"
FIXES_TEXT = {
    FIXED: "On the left the remedy is off, on the right it is on; all else is the preset `2006` "
    "and what the commands set in both. In the walk, N chooses a remedy and V turns it on or "
    "off.",
    ADDED: "These the report does not mention; they show what else its techniques can do. Again "
    "left and right differ in that alone.",
}

# Panel name: (files, title, what is in the picture, what to look at).
ASSET_PANELS: dict[str, tuple[tuple[str, ...], str, str, str]] = {
    "fig1a": (
        ("height.png",),
        "the height image",
        "a grey relief map of an island, black where the sea is",
        "The lighter, the higher: a mountain in the north-west, the flat hill of the castle in the "
        "east, a bay in the south-west, islets round about. The file has 512 x 512 pixels (smaller "
        "here); it is grey, so its red channel alone gives the heights.",
    ),
    "fig3a": (
        ("ground_large.png",),
        "large-scale ground texture",
        "the island from above in colour: beaches, meadows, a rocky massif",
        "One picture covers the whole map: green where the land is low, brown and grey where it is "
        "high. Light and shade of the slopes are painted in.",
    ),
    "fig3b": (
        ("ground_detail.png",),
        "detail texture of the ground, tileable",
        "fine grey grain",
        "The grain of the soil, repeated many times over the map. It is mid grey on average: "
        "multiplying the colours by twice its value roughens them but does not darken them.",
    ),
    "fig7a": (
        ("water.png",),
        "water texture, tileable",
        "pale green ripples",
        "The left border continues the right one, and the lower the upper: so it can be repeated "
        "over the sea without a seam.",
    ),
    "fig12a": (
        ("sky_north.png", "sky_east.png", "sky_south.png", "sky_west.png", "sky_top.png"),
        "sky box texture, its five faces unfolded",
        "a cross of five pictures: blue sky in the middle, clouds and hills at the four ends",
        "A paper box without a bottom, unfolded and seen from inside: the ceiling in the middle, a "
        "wall on each side, with distant hills along its foot. The clouds run on over all edges.",
    ),
    "fig15a": (
        ("tree_broadleaf.png",),
        "tree billboard, first species",
        "a broadleaf tree on plain grey",
        "The grey stands for transparent: a rectangle with this picture looks like a tree.",
    ),
    "fig15b": (
        ("tree_conifer.png",),
        "tree billboard, second species",
        "a conifer on plain grey",
        "The grey again stands for transparent. Half of the trees, at random, are mirrored.",
    ),
    "fig15c": (
        ("deer_stag.png",),
        "deer billboard",
        "a stag from its side on plain grey",
        "There is only this one picture, so wherever one stands, one sees the stag from its side.",
    ),
    "fig20a": (
        ("blade.png",),
        "texture of one blade of grass",
        "a small green square with stripes from top to bottom",
        "Dark at the foot, light at the tip. The square need not be transparent anywhere, as the "
        "blade's shape is cut out by its triangles (fig21a). The grey round it is just margin.",
    ),
    "fig23a": (
        ("castle_brick.png",),
        "castle brick texture, tileable",
        "grey-brown bricks",
        "Four repeats of it cover a castle wall 17 metres wide.",
    ),
    "fig23b": (
        ("castle_door.png",),
        "castle door texture, transparent around the door",
        "a wooden door in a stone arch at the foot of a large empty square",
        "It is as large as the whole wall and laid over the bricks. What is grey here is "
        "transparent and lets them through.",
    ),
    "fig23c": (
        ("castle_light.png",),
        "light texture: two yellowish halos",
        "two soft yellowish spots on pale blue-grey",
        "The wall's colours are multiplied by it. The spots, where the torches are, keep them as "
        "they are; the pale blue-grey, which is part of the texture, dims them only a little.",
    ),
    "fig24a": (
        ("torch_stone.png",),
        "stone of the torch holders",
        "dark stone with two bands of carved rings",
        "It is wrapped round the cone that holds a torch (fig25e).",
    ),
    "fig24b": (
        ("fire.png",),
        "fire sprite sheet, 4 x 4 frames",
        "sixteen small flames in four rows",
        "Read it like a page, left to right and down: shown one after the other the frames are a "
        "flickering flame, and the last leads back into the first.",
    ),
    "fig26a": (
        ("animal.png",),
        "texture of the 3D animals",
        "pale overlapping scales with darker vertical stripes",
        "Look at the broad darker stripes: on the animals (fig28a, fig28b) they show in which "
        "direction the picture was laid on the body, and where it is squeezed.",
    ),
    "fig30a": (
        ("sword_rest.png",),
        "sword at rest",
        "a gloved hand holding a sword, on plain grey",
        "The picture is as large as the whole window and transparent (grey) round the sword.",
    ),
    "fig31a": (
        ("sword_1.png",),
        "sword stroke, first frame",
        "the sword raised at the right border",
        "The first of four pictures that make a stroke: the sword is raised to the right.",
    ),
    "fig31b": (
        ("sword_2.png",),
        "sword stroke, second frame",
        "the sword at the beginning of its swing",
        "The second picture: the swing begins.",
    ),
    "fig31c": (
        ("sword_3.png",),
        "sword stroke, third frame",
        "the sword across the middle, blurred",
        "The third: the sword crosses the middle. Its blur is painted.",
    ),
    "fig31d": (
        ("sword_4.png",),
        "sword stroke, fourth frame",
        "the sword low on the left",
        "The fourth: the stroke ends low on the left.",
    ),
}

# Panel name: (what is in the picture, what to look at).
SEEN: dict[str, tuple[str, str]] = {
    "fig2a": (
        "white wireframe of the island and its islets from above, on plain blue",
        "The height image (fig1a) as triangles. They go on under the sea, but a clip plane at the "
        "sea level cuts them off at the coast.",
    ),
    "fig2b": (
        "white wireframe of hills, seen from the ground",
        "The same triangles to someone who walks there: those close by are very large, as the map "
        "has only 50 x 50 vertices.",
    ),
    "fig4a": (
        "a beach, meadows and a mountain; the sand in front is blurred",
        "The large-scale texture (fig3a) alone: the mountain looks right, but the sand at our feet "
        "is blurred.",
    ),
    "fig4b": (
        "the same land in grey grain",
        "The detail texture (fig3b) alone, repeated: there is grain at our feet, but no colour.",
    ),
    "fig4c": (
        "the same land with its colours and a grain on the sand",
        "Both multiplied, each on its own texture unit (multitexturing): colour from afar, grain "
        "from near.",
    ),
    "fig5a": (
        "the whole island from above in colour",
        "The ground and nothing else. It is kept in a display list, and drawn by a single "
        "glCallList.",
    ),
    "fig6a": (
        "a shore with a mountain, and the same upside down below it",
        "There is no water yet: below the shore the land is drawn a second time, upside down, by a "
        "matrix that turns y into -y at the height of the sea.",
    ),
    "fig8a": (
        "the same shore over a plain blue sea, the mountain faintly mirrored in it",
        "A plain, half-transparent blue plane lies between the land and its mirror image, and it "
        "becomes a sea with a reflection.",
    ),
    "fig9a": (
        "the same shore over a blue sea with ripples",
        "The plane with the water texture (fig7a): it has ripples now, but they do not move yet.",
    ),
    "fig10a": (
        "dark wireframe of the sea in front, white wireframe of the land behind",
        "Compare the meshes: the dark squares of the water are a third as wide as the white ones "
        "of the land. The sea needs them to bend its light and its texture.",
    ),
    "fig11a": (
        "blue water with ripples before a hazy beach",
        "Compare the ripples with those of fig11b. The vertices of the water stay in their place; "
        "their normals and texture coordinates move.",
    ),
    "fig11b": (
        "the same water with its ripples elsewhere",
        "The same view 50 kt, less than two seconds, later: the ripples have moved on.",
    ),
    "fig13a": (
        "a small box with clouds on its walls, in an empty blue room",
        "From far outside the sky is a box: four walls and a ceiling with the pictures of fig12a. "
        "In the walk it stays round the walker, so its outside is never seen.",
    ),
    "fig14a": (
        "clouds and distant hills over the sea, and their reflections",
        "Find the white clouds, upside down and dimmer, in the water: the sky box is drawn a "
        "second time under the mirror matrix, like the ground.",
    ),
    "fig16a": (
        "white rectangles standing on a meadow",
        "Trees without their pictures: each is a billboard, a rectangle that turns with the camera "
        "and so is always parallel to the picture.",
    ),
    "fig17a": (
        "a few trees on a meadow",
        "The same kind of rectangles with the pictures of fig15a and fig15b. Their alpha leaves "
        "out everything round a tree.",
    ),
    "fig17b": (
        "a wood of broadleaf trees and conifers",
        "Near trees cover far ones, as they should: before blending, all are sorted and drawn from "
        "far to near.",
    ),
    "fig17c": (
        "the same wood with far conifers painted over near trees",
        "The same trees unsorted. Look at the small tree in the middle and at the conifer on the "
        "right: trees behind them are painted over their crowns.",
    ),
    "fig18a": (
        "trees and a deer on a beach, the trees mirrored in the water in front",
        "Trees of both species are upside down in the water; the deer stands on the sand, right of "
        "the middle. The reflections are the same billboards, drawn under the mirror matrix.",
    ),
    "fig18b": (
        "a wooded islet with a deer on its shore, mirrored in the sea",
        "Another shore: here the deer stands so near to the water that it is mirrored as well.",
    ),
    "fig19a": (
        "white wireframe of one plant in front and many behind",
        "Look at the plant in front: two upright rectangles that cross. Each is cut in four "
        "triangles that meet in the middle of its top edge, which the wind has moved aside.",
    ),
    "fig19b": (
        "the same plant as a fern on a meadow",
        "The same plants with their picture. As only the middle of the top moves, the fronds sway "
        "while the foot stands still.",
    ),
    "fig21a": (
        "wireframe of one blade of grass, with some others far behind",
        "One blade in front: two triangles make its lower part, a third its bent tip.",
    ),
    "fig21b": (
        "the same blade, green, standing on the ground",
        "The same blade with the texture of fig20a. It is opaque: no blending, so no sorting.",
    ),
    "fig22a": (
        "a meadow with short grass, trees behind",
        "1,500,000 short blades on the map make a lawn, but a thin one: from near one sees the "
        "ground between the blades, and its green texture does much of the work.",
    ),
    "fig22b": (
        "the same meadow with grass as tall as the walker's view",
        "From the same place: 400,000 blades, a fourth as many but five times as high, read as "
        "tall grass.",
    ),
    "fig25a": (
        "a grey castle with four towers on a hill, seen from the air",
        "The castle is four walls and four round towers. One tower mesh is built, and drawn four "
        "times.",
    ),
    "fig25b": (
        "the castle from higher up, with deer on the hill before it",
        "Look at the deer on the slope and at the trees: though we look down on them, they still "
        "show us their sides. There are more deer here than in the walk.",
    ),
    "fig25c": (
        "a castle behind a grassy rise",
        "The castle from some way off, at the height of a walker's eyes.",
    ),
    "fig25d": (
        "the castle's gate wall with a door and two torches",
        "Door, light and flames are separate layers, blended over the bricks one after the other.",
    ),
    "fig25e": (
        "a torch with a flame beside the castle's door",
        "The stone holder is a real solid; the flame is one flat rectangle that shows the frames "
        "of fig24b in turn. The light on the wall round it is fig23c.",
    ),
    "fig25f": (
        "the castle's door between two torches",
        "Door (fig23b) and bricks (fig23a) from near: the textures are fine enough to walk up to.",
    ),
    "fig27a": (
        "wireframe of a rabbit's head and chest",
        "The rabbit is a mesh of 8,171 vertices. This is its head, from so near that its triangles "
        "can be told apart; those that face away are left out.",
    ),
    "fig27b": (
        "wireframe of a dragon's head",
        "The dragon has 22,998 vertices, nearly three times as many, so we must look at its head "
        "alone to tell the triangles apart.",
    ),
    "fig28a": (
        "a grey rabbit with vertical stripes on a meadow",
        "Follow the stripes of fig26a down the rabbit's flank: across, the texture goes by the "
        "angle about the vertical axis; upwards, by the height.",
    ),
    "fig28b": (
        "head and neck of a grey dragon with faint vertical streaks",
        "Look for the vertical streaks on neck and jaw: the texture coordinates are (x, z), seen "
        "from above, so on upright sides one line of the texture is drawn out from top to bottom.",
    ),
    "fig29a": (
        "the rabbit's back from near, its stripes running up to the neck",
        "On its back the stripes run together towards the neck, where the vertical axis of the "
        "mapping comes out (see fig43a).",
    ),
    "fig29b": (
        "the rabbit on a meadow between ferns and trees",
        "Ferns and trees are blended and sorted; the rabbit is opaque and left to the depth "
        "buffer. In 2006 nothing casts a shadow, so it seems to hover a little.",
    ),
    "fig29c": (
        "the rabbit small between conifers",
        "The rabbit from farther off, where the fog begins to make everything paler.",
    ),
    "fig29d": (
        "a sea dragon half under water, with its reflection",
        "The clip plane cuts the dragon at the water, and its mirror image goes on below.",
    ),
    "fig29e": (
        "the sea dragon farther off, from its other side",
        "From another side: its coils come out of the water one by one, and each has its "
        "reflection.",
    ),
    "fig32a": (
        "a wood with a map at the upper left and the sword raised at the right",
        "The sword's key plays the four pictures fig31a to fig31d. This is the first, in the walk.",
    ),
    "fig32b": (
        "the same wood with the sword beginning its swing",
        "The second. The scene behind does not move: the sword is a picture stuck to the window.",
    ),
    "fig32c": (
        "the same wood with a blurred sword across it",
        "The third. The blur is in the picture; OpenGL only blends it over the scene.",
    ),
    "fig32d": (
        "the same wood with the sword low on the left",
        "The fourth. Then the sword is at rest again.",
    ),
    "fig33a": (
        "a beach with trees, the sword, and a small map of the island at the upper left",
        "Look at the upper left: a map in a second viewport, a quarter of the window wide and "
        "high. The white point on it is the walker, here near the south-western bay.",
    ),
    "fig34a": (
        "a hillside with trees that become paler with distance",
        "Compare the trees: green in front, paler in the wood behind, and the hills beyond are "
        "almost the colour of the sky. GL_EXP2 fog is thin near by and then thickens fast.",
    ),
    "fig35a": (
        "a wide bay with the sea dragon, a wooded beach and distant hills",
        "Dragon, trees and the painted hills on the horizon are all mirrored in the bay.",
    ),
    "fig35b": (
        "a meadow with a large conifer, a deer and a strip of sea",
        "At eye height: a deer among plants right of the conifer, and a strip of sea behind it. "
        "The report's grass is dense here; ours, 200,000 blades on the whole island, is sparse.",
    ),
    "fig35c": (
        "the rabbit on a meadow beside a conifer",
        "The rabbit, far larger than life, on a meadow of very short grass.",
    ),
    "fig35d": (
        "a stag on a slope before trees",
        "Stag, trees and ferns are flat pictures, and only the slope is not; together they pass "
        "for a landscape.",
    ),
    "fig35e": (
        "trees on a hillside, with a castle in haze on top",
        "The castle is a pale outline on its hill: the farther something is, the more fog is "
        "before it.",
    ),
    "fig35f": (
        "the castle's gate, with the map at the upper left",
        "Bricks, door, light and fire together. The point on the map shows that we are at the "
        "castle, in the east.",
    ),
    "fig35g": (
        "two wooded islets in the sea, seen from a hill",
        "From the edge of the castle's hill: islets with their trees, and the trees' reflections.",
    ),
    "fig35h": (
        "a wooded islet with a deer, mirrored in the sea",
        "Find the deer on the rock, and the deer upside down in the water under it.",
    ),
    "fig35i": (
        "the sea dragon before the walker's sword, with the map at the upper left",
        "Everything at once: scene, reflection, then map and sword, which are drawn last.",
    ),
    "fig36a": (
        "trees seen from above that seem to lie flat on the grass",
        "We look down, yet each tree shows its side, as if it lay on its back. A billboard "
        "faces the camera, even if that is overhead. Fix: R4.",
    ),
    "fig36b": (
        "a stag seen from above that seems to lie on the grass",
        "The stag, too, lies on its side to face us. Fix: R4.",
    ),
    "fig37a": (
        "a fern with a narrow strip standing up in its middle",
        "Look at the narrow strip in the middle of the fern. It is the second of its two "
        "crossed pictures, seen almost from its edge. Fix: R6a.",
    ),
    "fig37b": (
        "two thin green crosses on the ground",
        "Two ferns from straight above. Their upright rectangles, seen from the edge, are "
        "crosses. Fix: R6b.",
    ),
    "fig38a": (
        "a blade of grass as thin as a thread",
        "The thread in the middle is the blade of fig21b from its edge. It is flat, so there "
        "is nothing else to see. Fix: R7.",
    ),
    "fig39a": (
        "a summit under a flat blue lid that cuts off the clouds",
        "On the summit the sky's ceiling is close overhead. It is the flat, dark upper half; "
        "clouds and sea bend where walls and ceiling meet. (Wide angle, thin fog.) Fix: R8.",
    ),
    "fig40a": (
        "a meadow and an empty horizon with painted clouds",
        "Straight ahead there should be the castle on its hill. But they are farther off "
        "than the sky's wall, which hides them. (The fog is thinner than in the walk.) Fix: R9.",
    ),
    "fig40b": (
        "a hill with a castle on it",
        "After some way in the same direction, hill and castle have come out of the wall. Fix: R9.",
    ),
    "fig41a": (
        "hazy sky over the sea, palest in the middle",
        "Clouds and hills are clear at the left and right, and fade in the middle. There the "
        "corner of the sky box is farther off than its walls, and has more fog. Fix: R10.",
    ),
    "fig42a": (
        "a castle in fog whose gate wall is darker than its towers",
        "The gate wall is darker and bluer than the towers. It is drawn in three layers, one "
        "over the other, and each gets its own fog. (The fog is thicker than in the walk.) Fix: "
        "R11.",
    ),
    "fig43a": (
        "the rabbit from above, with stripes that run to a point behind its ears",
        "All stripes meet in one point behind the ears, where the vertical axis comes out "
        "and the angle about it has no meaning. Fix: R12.",
    ),
}
