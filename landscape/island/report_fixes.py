"""The improvements that the report's discussion suggests, R1 to R19, as pairs of pictures."""

from landscape.frame import Pose
from landscape.island.fix import GROUND, Fix
from landscape.island.views import OUTDOORS, VIEWS

CASTLE_HILL = ("ground", "sky", "castle", "water", "reflection", "fog", "grass")
FAR_SKY = {"sky.follow_y": True, "sky.background": True}
LOW_PLANTS = ("ground", "plants", "grass", "sky", "water", "reflection", "fog")
WITHOUT_CASTLE = tuple(element for element in OUTDOORS if element != "castle")

REPORT_FIXES: tuple[Fix, ...] = (
    Fix(
        "R1",
        "Clouds that move",
        Pose(20.0, GROUND, 22.0, 120.0, 35.0),
        1500.0,
        {"sky.moving": False},
        {"sky.moving": True},
        "In fig14a and all other figures the sky is a painting that never changes.",
        "The streaks in the first picture are painted and do not move. The thin ones that are "
        "added drift slowly over the whole sky.",
        "A second, half-transparent layer of cloud is blended over the box. glTranslatef on the "
        "GL_TEXTURE matrix shifts its texture a little with each kt.",
        (
            "the sun in a blue sky over treetops, with a few still streaks of cloud",
            "the same sun and sky, with thin white streaks spread over the blue",
        ),
        common={**FAR_SKY, "sky.unfogged": True, "fog.density": 0.03},
        only=("ground", "water", "sky", "trees", "fog", "reflection"),
    ),
    Fix(
        "R2",
        "Flames that face the viewer",
        Pose(27.521, 2.567, 17.448, 254.2, -1.0),
        12.0,
        {"castle.flame_faces": False},
        {"castle.flame_faces": True},
        "The flame of fig25e is one flat rectangle, parallel to the wall.",
        "We stand beside the gate and look along its wall. Before, the rectangle is seen edge-on "
        "and the flame is a red thread; after, it is a whole flame.",
        "The rectangle turns about its vertical axis until it faces the eye: its corners are "
        "placed at right angles to the line from the eye. Texture and blending do not change.",
        (
            "a torch on the castle wall whose flame is a thin red line",
            "the same torch with a full yellow flame",
        ),
    ),
    Fix(
        "R3",
        "Crossing sprites in the right order",
        Pose(13.29, 1.03, 23.67, 260.0, -4.0),
        0.0,
        {"transparent.split": False},
        {"transparent.split": True},
        "The sort of fig17b gives each tree or plant a single depth, which is not enough where two "
        "of them intersect. No figure shows it.",
        "Look at the trunk of the big conifer. Before, the tree is painted over the fern at its "
        "foot; after, the half of the fern in front of the trunk is visible.",
        "Each half of a crossed quad gets its own depth in the sort, so that a half in front of a "
        "tree is blended after it. All sprites are still drawn by a single glDrawElements.",
        (
            "a conifer with a bare trunk between ferns",
            "the same conifer with half a fern in front of its trunk",
        ),
        common={"plants.count": 9000, "camera.fov": 30.0},
    ),
    Fix(
        "R4",
        "Trees that no longer lie on their backs",
        Pose(24.3, 2.5, 25.5, 0.0, -82.0),
        0.0,
        {"transparent.upright": False, "trees.crown": False},
        {"transparent.upright": True, "trees.crown": True},
        "Seen from above, the trees of fig36a and the deer of fig36b lie down to face us.",
        "We look straight down. Before, each tree shows its side, trunk and all; after, we see the "
        "tops of the trees.",
        "Billboards turn about the vertical axis only, so they stay upright. As the view gets "
        "steeper they fade out by vertex alpha, and a horizontal quad with a picture of the crown "
        "fades in.",
        (
            "a meadow from above with trees that seem to lie flat on it",
            "the same meadow with the round crowns of the trees",
        ),
    ),
    Fix(
        "R5",
        "Deer that stand on the slope",
        Pose(30.4, 1.42, 20.13, 0.0, 0.0),
        0.0,
        {"deer.follow_slope": False},
        {"deer.follow_slope": True},
        "Billboards such as the deer of fig35d are upright, whatever the ground does. On a steep "
        "slope one end of them hangs in the air and the other is inside the hill.",
        "Look at the feet. Before, the stag stands level and his hind legs hang in the air; after, "
        "all four feet are on the slope.",
        "The billboard is spanned by the ground's normal and by the camera's right vector, tilted "
        "into the slope.",
        (
            "a stag standing level on a steep slope, his hind feet in the air",
            "the same stag tilted, with all his feet on the slope",
        ),
    ),
    Fix(
        "R6a",
        "Plants without edge-on quads",
        "fig37a",
        0.0,
        {"plants.quads": 2, "plants.fade_edge_on": False, "plants.rosette": False},
        {"plants.quads": 3, "plants.fade_edge_on": True, "plants.rosette": True},
        "In fig37a one of the plant's two quads is seen edge-on.",
        "Before, the strip that stands up in the middle of the fern is a whole picture of the "
        "plant, squeezed into a line; after, there is no strip.",
        "Three quads at 60 degrees instead of two at 90, so that two are always visible; each "
        "fades out by vertex alpha as it turns edge-on.",
        (
            "a fern with a narrow strip standing up in its middle",
            "the same fern made of two crossing pictures, with no strip",
        ),
        common=VIEWS["fig37a"].settings,
        only=LOW_PLANTS,
    ),
    Fix(
        "R6b",
        "Plants that are not crosses from above",
        "fig37b",
        0.0,
        {"plants.quads": 2, "plants.fade_edge_on": False, "plants.rosette": False},
        {"plants.quads": 3, "plants.fade_edge_on": True, "plants.rosette": True},
        "In fig37b the plants seen from above are crosses.",
        "Before, two crosses lie on the ground; after, they are two ferns with their fronds spread "
        "in all directions.",
        "As the view gets steeper the upright quads fade out by vertex alpha, and a horizontal "
        "quad with a picture of the same fronds from above fades in.",
        ("two thin green crosses on the ground", "two round ferns seen from above"),
        common=VIEWS["fig37b"].settings,
        only=LOW_PLANTS,
    ),
    Fix(
        "R7",
        "Blades that turn partly to the viewer",
        "fig38a",
        0.0,
        {"grass.facing": 0.0},
        {"grass.facing": 0.6},
        "The blade of fig38a is flat, so there is almost nothing of it to see edge-on.",
        "It is the same blade in the same place: a thread before, a blade after.",
        "Before the vertices are sent, each blade is turned part of the way towards the viewer, so "
        "that at least three quarters of its width are visible from any side.",
        ("a blade of grass seen edge-on, as thin as a thread", "the same blade, broad and green"),
        common=VIEWS["fig38a"].settings,
        only=("ground", "grass", "sky", "fog"),
    ),
    Fix(
        "R8",
        "A sky that does not come nearer",
        "fig39a",
        0.0,
        {"sky.follow_y": False},
        FAR_SKY,
        "In fig39a the ceiling of the sky box hangs right over the summit.",
        "Before, the upper half of the picture is the flat lid of the sky box, and the clouds "
        "break off where it begins. After, the clouds are as far away as from the beach, and the "
        "sea extends to the horizon.",
        "The box follows the eye in height as well, and glDepthRange(1, 1) puts it behind "
        "everything else.",
        (
            "a summit under a low, flat blue lid that cuts the clouds off",
            "the same summit under a wide sky, with clouds and hills at the sea's horizon",
        ),
        common={**VIEWS["fig39a"].settings, "water.horizon": 400.0},
    ),
    Fix(
        "R9",
        "Sky walls that do not hide hills",
        "fig40a",
        0.0,
        {"sky.background": False},
        {"sky.background": True},
        "In fig40a the wall of the sky box, 8 units away, is in front of the castle and its hill.",
        "Look between the slope on the left and the cloud on the right. Before, there is only "
        "painted sky; after, the hill with the castle on it.",
        "glDepthRange(1, 1) gives the box the greatest depth there is, and depth writes are off: "
        "it is visible only where nothing else is drawn.",
        (
            "a meadow and an empty horizon with painted clouds",
            "the same meadow with a castle on a hill behind it",
        ),
        common=VIEWS["fig40a"].settings,
        only=CASTLE_HILL,
    ),
    Fix(
        "R10",
        "Corners as clear as walls",
        "fig41a",
        0.0,
        {"sky.unfogged": False},
        {"sky.unfogged": True},
        "In fig41a the corners of the sky box are paler than the middles of its walls: they are "
        "farther away, so they have more fog.",
        "Look at the cloud in the middle, where the corner is. Before, it is hardly visible; "
        "after, it is as white as those beside it.",
        "Fog is off (glDisable(GL_FOG)) while the box is drawn: the haze is painted on its walls, "
        "the same all around.",
        (
            "a pale sky over the sea, palest in the middle",
            "the same sky, deep blue with white clouds everywhere",
        ),
        common=VIEWS["fig41a"].settings,
        only=VIEWS["fig41a"].shown,
    ),
    Fix(
        "R11",
        "The gate wall in one fogged layer",
        "fig42a",
        0.0,
        {"castle.multitexture": False},
        {"castle.multitexture": True},
        "In fig42a the gate wall is darker than the towers, as it is drawn in three layers.",
        "Compare the wall with the two towers. Before, it is darker and bluer than they are; "
        "after, it has their colour, and the torches light it.",
        "Three texture units draw the wall in one pass: the first has the bricks, the second mixes "
        "in the door by its alpha (GL_INTERPOLATE), the third multiplies by the light "
        "(GL_MODULATE, doubled by GL_RGB_SCALE). So fog is applied once as well.",
        (
            "a castle in fog whose gate wall is darker than its towers",
            "the same castle with wall and towers of one colour",
        ),
        common=VIEWS["fig42a"].settings,
        only=CASTLE_HILL,
    ),
    Fix(
        "R12",
        "A rabbit whose texture is not pinched",
        "fig43a",
        0.0,
        {"rabbit.mapping": "cylindrical"},
        {"rabbit.mapping": "axis"},
        "In fig43a all stripes of the rabbit's texture meet in one point behind its ears.",
        "Compare the neck, behind the ears. Before, the stripes converge like the spokes of a "
        "wheel; after, they do not.",
        "Each face takes its texture coordinates from the side of a box that it faces most, "
        "instead of from the angle about the vertical axis. Vertices on the border of two such "
        "sides are duplicated.",
        (
            "the rabbit from above, with stripes that run to a point behind its ears",
            "the same rabbit with an even, cloudy texture",
        ),
        common=VIEWS["fig43a"].settings,
    ),
    Fix(
        "R13",
        "A mouse that turns the view without end",
        Pose(20.0, GROUND, 28.0, 180.0, 0.0),
        10.0,
        {"walk.mouse_relative": False},
        {"walk.mouse_relative": True},
        "In 2006 the position of the mouse pointer set the direction of view, so the turn ended at "
        "the border of the window. A figure cannot show it.",
        "Two views from the same place. The first looks due south, where the mouse of 2006 had to "
        "stop; the second looks 70 degrees farther round, where it could not go.",
        "Nothing changes in OpenGL: the mouse is captured, and reports how far it moved instead of "
        "where it is.",
        (
            "looking south over a meadow with conifers",
            "looking to the west from the same place, at a line of trees",
        ),
        only=WITHOUT_CASTLE,
        after_pose=Pose(20.0, GROUND, 28.0, 250.0, 0.0),
    ),
    Fix(
        "R14",
        "Smoother ground from the same 50 x 50 vertices",
        Pose(13.2, 2.6, 13.6, 350.0, 10.0),
        0.0,
        {"ground.smooth": "none"},
        {"ground.smooth": "catmull_rom", "ground.subdivide": 4},
        "The ground is made of large flat triangles, as fig2b shows.",
        "Follow the outline of the summit against the sky. Before, it has straight edges and "
        "corners; after, it is a curve.",
        "Each cell of the grid becomes 4 x 4 smaller ones on a curved patch (bicubic Catmull-Rom) "
        "through the same vertices. It is computed once and kept in the same display list.",
        ("a rocky summit with an angular outline", "the same summit with a rounded outline"),
        common={"fog.enabled": False},
        only=("ground", "sky", "fog"),
    ),
    Fix(
        "R15",
        "Standing on the triangles that are drawn",
        Pose(9.15, 1.95, 17.35, 25.0, -4.0),
        0.0,
        {"ground.exact_height": False},
        {"ground.exact_height": True},
        "In 2006 the rabbit and the walker stand on a smoothly curved surface, but the ground is "
        "drawn as the flat triangles of fig2b. Between the vertices the two differ. No figure "
        "shows it.",
        "Before, the rabbit floats 0.16 units above the ground; after, it sits on it.",
        "To find a height, the program now looks up which of a cell's two triangles the place is "
        "in, and interpolates on that triangle.",
        ("a rabbit in the air in front of a hill", "the same rabbit sitting on the ground"),
        common={"rabbit.x": 9.431, "rabbit.z": 16.811, "rabbit.yaw": -60},
        only=("ground", "rabbit", "sky", "fog"),
    ),
    Fix(
        "R16",
        "A reflection that ripples",
        Pose(9.2, 0.95, 30.6, 50.0, -4.0),
        40.0,
        {"reflection.rippled": False},
        {"reflection.rippled": True},
        "In fig29d the dragon's reflection is that of a perfect mirror, whatever the waves do.",
        "Look at the reflection below the dragon. Before, it is a clear copy upside down; after, "
        "the waves break it into streaks.",
        "The mirrored scene is rendered to a texture, which is laid on a grid of water. The "
        "texture matrix gives each vertex its place in the texture, shifted a little by the slope "
        "of the wave there.",
        (
            "a sea dragon over a reflection as sharp as itself",
            "the same dragon over a reflection broken into streaks",
        ),
        common={
            "water.fresnel": True,
            "fog.density": 0.05,
            "trees.count": 1800,
            "transparent.radius": 20.0,
            "ground.resolution": 160,
        },
        only=("ground", "water", "sky", "trees", "dragon", "reflection", "fog"),
    ),
    Fix(
        "R17",
        "Waves that lift the surface",
        Pose(12.6, 0.7, 31.5, 335.0, -1.0),
        40.0,
        {"water.relief": False},
        {"water.relief": True},
        "The water of fig11a is a flat plane: only its texture and its lighting move.",
        "The sun is low and the water has no texture. Before, the plane is one flat colour; after, "
        "a swell shows as bands of light and dark. It is low, a foot at most, so the horizon stays "
        "straight.",
        "The vertices rise and fall by a sum of waves, and their normals follow. They form a grid "
        "around the eye, finest near it, and the waves die down towards the beach.",
        (
            "the sea dragon in water of one flat blue",
            "the same dragon in water with bands of light and dark",
        ),
        common={
            "fog.enabled": False,
            "water.textured": False,
            "sun.azimuth": 285.0,
            "sun.elevation": 10.0,
            "sun.ambient": (0.4, 0.42, 0.46),
            "water.color": (0.5, 0.7, 0.85, 1.0),
            "camera.fov": 30.0,
        },
        only=("ground", "water", "dragon", "sky"),
    ),
    Fix(
        "R18",
        "Grass that is drawn by one call",
        "fig22b",
        0.0,
        {"grass.method": "loop"},
        {"grass.method": "cells"},
        "In 2006 every blade of fig22a and fig22b was sent on its own, in a loop.",
        "Do not look for a difference: the two pictures are the same. Only the time to draw them "
        "differs; [the page on performance](../docs/performance.md#against-2006) has the numbers.",
        "Before, glBegin, glVertex and glEnd for each blade. After, the blades are kept in arrays, "
        "by cells of the map; those of the cells in view are drawn by one glDrawElements.",
        ("tall grass in front of trees, blade by blade", "the same picture, drawn by one call"),
        common={"grass.count": 400_000, "grass.scale": (2.0, 4.2)},
        only=VIEWS["fig22b"].shown,
    ),
    Fix(
        "R19",
        "Textures no larger than needed",
        "fig4a",
        0.0,
        {"ground.texture_size": 4096, "ground.height_image": "height.png"},
        {"ground.texture_size": 1024, "ground.height_image": "height16.png"},
        "The images of fig1a and fig3a take more memory than they need.",
        "The two pictures should look alike, and that is the point: the ground texture takes a "
        "quarter of the memory.",
        "The large texture is halved in width and height before glTexImage2D. The heights come "
        "from an image with one channel of 16 bits instead of three of 8.",
        (
            "the beach, meadows and mountain, with the large textures",
            "the same view with the small textures, hardly different",
        ),
        common={"fog.enabled": False},
        only=("ground",),
    ),
)
