"""The gallery's captions for the named views of the report's figures.

A caption says first what to see, then the technique. Names of panels and fixes in it, such as
fig17b or R4, become links.
"""

# Panel name: (what is in the picture, what to look at).
VIEW_PANELS: dict[str, tuple[str, str]] = {
    "fig2a": (
        "white wireframe of the island and its islets from above, on plain blue",
        "The height image (fig1a) as triangles. The mesh continues below the sea, but a clip plane "
        "at sea level cuts it off at the coast.",
    ),
    "fig2b": (
        "white wireframe of hills, seen from the ground",
        "The same mesh at eye level. The triangles close by are very large, as the map has only "
        "50 x 50 vertices.",
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
        "Both textures multiplied, each on its own texture unit (multitexturing): colour in the "
        "distance, grain close up.",
    ),
    "fig5a": (
        "the whole island from above in colour",
        "The ground and nothing else. It is compiled into a display list, and drawn by a single "
        "glCallList.",
    ),
    "fig6a": (
        "a shore with a mountain, and the same upside down below it",
        "There is no water yet. Below the shore the land is drawn a second time, upside down, by a "
        "matrix that mirrors y about sea level.",
    ),
    "fig8a": (
        "the same shore over a plain blue sea, the mountain faintly mirrored in it",
        "With a plain, half-transparent blue plane between the land and its mirror image, the "
        "lower half becomes a sea with a reflection.",
    ),
    "fig9a": (
        "the same shore over a blue sea with ripples",
        "The plane with the water texture (fig7a): it has ripples now, but they do not move yet.",
    ),
    "fig10a": (
        "dark wireframe of the sea in front, white wireframe of the land behind",
        "Compare the meshes: the dark squares of the water are a third as wide as the white ones "
        "of the land. They must be that small because the lighting and the texture coordinates of "
        "the water vary from vertex to vertex.",
    ),
    "fig11a": (
        "blue water with ripples in front of a hazy beach",
        "Compare the ripples with those of fig11b. The vertices of the water do not move; their "
        "normals and texture coordinates do.",
    ),
    "fig11b": (
        "the same water with its ripples elsewhere",
        "The same view 50 kt (less than two seconds) later: the ripples have moved on.",
    ),
    "fig13a": (
        "a small box with clouds on its walls, in an empty blue space",
        "From far outside the sky is a box: four walls and a ceiling with the textures of fig12a. "
        "In the walk it moves with the walker, so its outside is never seen.",
    ),
    "fig14a": (
        "clouds and distant hills over the sea, and their reflections",
        "Find the white clouds in the water, upside down and dimmer: the sky box is drawn a second "
        "time under the mirror matrix, like the ground.",
    ),
    "fig16a": (
        "white rectangles standing on a meadow",
        "Trees without their textures: each is a billboard, a rectangle that turns with the camera "
        "and so stays parallel to the screen.",
    ),
    "fig17a": (
        "a few trees on a meadow",
        "The same kind of rectangle with the textures of fig15a and fig15b. Their alpha hides "
        "everything around a tree.",
    ),
    "fig17b": (
        "a wood of broadleaf trees and conifers",
        "Near trees cover far ones, as they should: all are sorted, then blended from far to near.",
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
        "Another shore: here the deer stands so close to the water that it is reflected as well.",
    ),
    "fig19a": (
        "white wireframe of one plant in front and many behind",
        "Look at the plant in front: two upright rectangles that cross. Each is cut into four "
        "triangles that meet in the middle of its top edge, at a vertex that the wind has moved "
        "aside.",
    ),
    "fig19b": (
        "the same plant as a fern on a meadow",
        "The same plants with their texture. Only the middle of the top edge moves, so the fronds "
        "sway while the foot stands still.",
    ),
    "fig21a": (
        "wireframe of one blade of grass, with some others far behind",
        "One blade in front: two triangles form its lower part, a third its bent tip.",
    ),
    "fig21b": (
        "the same blade, green, standing on the ground",
        "The same blade with the texture of fig20a. It is opaque, so it needs neither "
        "blending nor sorting.",
    ),
    "fig22a": (
        "a lawn with ferns, trees and a deer on it",
        "1,500,000 short blades on the map make a lawn. Trees, deer and ferns are the other two "
        "techniques: billboards and crossed quads.",
    ),
    "fig22b": (
        "the same meadow with dense, thin grass nearly as high as the walker's eyes",
        "From the same place: 3,000,000 blades, five times as high, hide the ground a few steps "
        "away. The report has 400,000 on its map; on ours they would stand apart.",
    ),
    "fig25a": (
        "a grey castle with four towers on a hill, seen from the air",
        "The castle is four walls and four round towers. One tower mesh is built, and drawn four "
        "times.",
    ),
    "fig25b": (
        "the castle from higher up, with deer on the hill in front of it",
        "Look at the deer on the slope and at the trees: although we look down on them, they still "
        "show us their sides. There are more deer here than in the walk.",
    ),
    "fig25c": (
        "a castle behind a grassy rise",
        "The castle from a distance, at the walker's eye level.",
    ),
    "fig25d": (
        "the castle's gate wall with a door and two torches",
        "The door, the light and the flames are separate layers, blended over the bricks one after "
        "the other.",
    ),
    "fig25e": (
        "a torch with a flame beside the castle's door",
        "The stone holder is a solid mesh; the flame is one flat rectangle that shows the frames "
        "of fig24b in turn. The light on the wall around it is fig23c.",
    ),
    "fig25f": (
        "the castle's door between two torches",
        "The door (fig23b) and the bricks (fig23a) close up: the textures are fine enough to walk "
        "up to.",
    ),
    "fig27a": (
        "wireframe of a rabbit's head and chest",
        "The rabbit is a mesh of 8,171 vertices. This is its head, from so close that you can tell "
        "its triangles apart; those that face away are culled.",
    ),
    "fig27b": (
        "wireframe of a dragon's head",
        "The dragon has 22,998 vertices, nearly three times as many. Only its head is shown, or "
        "you could not tell the triangles apart.",
    ),
    "fig28a": (
        "a grey rabbit with vertical stripes on a meadow",
        "Follow the stripes of fig26a down the rabbit's flank. Horizontally, the texture "
        "coordinate is the angle about the vertical axis; vertically, it is the height.",
    ),
    "fig28b": (
        "head and neck of a grey dragon with faint vertical streaks",
        "Look for the vertical streaks on neck and jaw. The texture coordinates are (x, z), a "
        "projection from above, so on upright sides a single line of the texture is stretched from "
        "top to bottom.",
    ),
    "fig29a": (
        "the rabbit's back close up, its stripes running up to the neck",
        "On its back the stripes converge towards the neck, where the vertical axis of the mapping "
        "comes out (see fig43a).",
    ),
    "fig29b": (
        "the rabbit on a meadow between ferns and trees",
        "Ferns and trees are blended and sorted; the rabbit is opaque, and the depth buffer is "
        "enough for it. In 2006 nothing casts a shadow, so it seems to hover a little.",
    ),
    "fig29c": (
        "the rabbit small between conifers",
        "The rabbit from farther away, where the fog begins to make everything paler.",
    ),
    "fig29d": (
        "a sea dragon half under water, with its reflection",
        "The clip plane cuts the dragon off at the water, and its mirror image continues below.",
    ),
    "fig29e": (
        "the sea dragon farther away, from its other side",
        "From another side: the coils rise out of the water one by one, and each has its "
        "reflection.",
    ),
    "fig32a": (
        "a wood with a map at the upper left and the sword raised at the right",
        "The sword key plays the four frames fig31a to fig31d. This is the first, in the walk.",
    ),
    "fig32b": (
        "the same wood with the sword beginning its swing",
        "The second frame. The scene behind does not move: the sword is a textured quad fixed to "
        "the window.",
    ),
    "fig32c": (
        "the same wood with a blurred sword across it",
        "The third frame. The blur is in the texture; OpenGL only blends it over the scene.",
    ),
    "fig32d": (
        "the same wood with the sword low on the left",
        "The fourth frame. After it the sword is at rest again.",
    ),
    "fig33a": (
        "a beach with trees, the sword, and a small map of the island at the upper left",
        "Look at the upper left: a map in a second viewport, a quarter of the window wide and "
        "high. The white point on it is the walker, here near the south-western bay.",
    ),
    "fig34a": (
        "a hillside with trees that become paler with distance",
        "Compare the trees: green in front, paler in the wood behind; the hills beyond are almost "
        "the colour of the sky. GL_EXP2 fog is thin close by and then thickens quickly.",
    ),
    "fig35a": (
        "a wide bay with the sea dragon, a wooded beach and distant hills",
        "The dragon, the trees and the painted hills on the horizon are all mirrored in the bay.",
    ),
    "fig35b": (
        "a meadow with a large conifer, a deer and a strip of sea",
        "At eye level: a deer among plants right of the conifer, and a strip of sea behind it. The "
        "report's grass is dense here; ours, 200,000 blades on the whole island, is sparse.",
    ),
    "fig35c": (
        "the rabbit on a meadow beside a conifer",
        "The rabbit, far larger than life, on a meadow of very short grass.",
    ),
    "fig35d": (
        "a stag on a slope in front of trees",
        "The stag, the trees and the ferns are flat textures. Only the slope is real geometry, yet "
        "together they pass for a landscape.",
    ),
    "fig35e": (
        "trees on a hillside, with a castle in haze on top",
        "The castle is a pale outline on its hill: the farther away something is, the more fog is "
        "in front of it.",
    ),
    "fig35f": (
        "the castle's gate, with the map at the upper left",
        "Bricks, door, light and flames together. The point on the map shows that we are at the "
        "castle, in the east.",
    ),
    "fig35g": (
        "two wooded islets in the sea, seen from a hill",
        "From the edge of the castle hill: islets with their trees, and the trees' reflections.",
    ),
    "fig35h": (
        "a wooded islet with a deer, mirrored in the sea",
        "Find the deer on the rock, and the same deer upside down in the water below.",
    ),
    "fig35i": (
        "the sea dragon behind the walker's sword, with the map at the upper left",
        "Everything at once: the scene and its reflection, then the sword and the map, which are "
        "drawn last.",
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
        "crossed quads, seen almost edge-on. Fix: R6a.",
    ),
    "fig37b": (
        "two thin green crosses on the ground",
        "Two ferns from straight above. Their upright quads, seen edge-on, form crosses. Fix: R6b.",
    ),
    "fig38a": (
        "a blade of grass as thin as a thread",
        "The thread in the middle is the blade of fig21b seen edge-on. It is flat, so there is "
        "nothing else to see. Fix: R7.",
    ),
    "fig39a": (
        "a summit under a flat blue lid that cuts off the clouds",
        "On the summit the ceiling of the sky box is close overhead. It is the flat, dark upper "
        "half; clouds and sea bend where the walls meet it. (Wide lens, thin fog.) Fix: R8.",
    ),
    "fig40a": (
        "a meadow and an empty horizon with painted clouds",
        "The castle on its hill should be straight ahead. But both are farther away than the wall "
        "of the sky box, which hides them. (The fog is thinner than in the walk.) Fix: R9.",
    ),
    "fig40b": (
        "a hill with a castle on it",
        "Farther on in the same direction, the hill and the castle have come out of the wall. Fix: "
        "R9.",
    ),
    "fig41a": (
        "hazy sky over the sea, palest in the middle",
        "Clouds and hills are clear at the left and right, and fade in the middle. There the "
        "corner of the sky box is farther away than its walls, and has more fog. Fix: R10.",
    ),
    "fig42a": (
        "a castle in fog whose gate wall is darker than its towers",
        "The gate wall is darker and bluer than the towers. It is drawn in three layers, one "
        "over the other, and each gets its own fog. (The fog is thicker than in the walk.) Fix: "
        "R11.",
    ),
    "fig43a": (
        "the rabbit from above, with stripes that run to a point behind its ears",
        "All stripes meet in one point behind the ears, where the vertical axis comes out and the "
        "angle about it is undefined. Fix: R12.",
    ),
}
