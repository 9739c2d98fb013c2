"""The remedies of the report's discussion, R1 to R19, each a pair of pictures, before and after.

Behind them come pairs of what the preset `best` adds of its own.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from landscape.frame import Pose
from landscape.views import SCENE, VIEWS

GROUND = float("nan")  # a pose's y: eye height above the ground


@dataclass(frozen=True)
class Fix:
    """A remedy: where to look at it, what is set before and after, and what the gallery says.

    ``fault`` says what is wrong, and which figure shows it; ``look`` what to compare in the pair;
    ``how`` what changed in OpenGL; ``seen`` describes the two pictures. ``common`` are settings of
    both; ``only`` the elements to show; ``after_pose`` stands in for the pose in the second.
    """

    name: str
    title: str
    view: str | Pose
    kt: float
    off: Mapping[str, Any]
    on: Mapping[str, Any]
    fault: str
    look: str
    how: str
    seen: tuple[str, str]
    common: Mapping[str, Any] = field(default_factory=dict)
    only: tuple[str, ...] = SCENE
    after_pose: Pose | None = None

    def settings(self, after: bool) -> dict[str, Any]:
        """Return the settings of one picture, on top of the preset 2006."""
        return {**self.common, **(self.on if after else self.off)}

    def place(self, after: bool) -> Pose:
        """Return one picture's pose; y is NaN where it follows the ground."""
        if after and self.after_pose is not None:
            return self.after_pose
        return VIEWS[self.view].pose if isinstance(self.view, str) else self.view


SEA_OF_BEST: dict[str, Any] = {
    "water.fresnel": True,
    "reflection.rippled": True,
    "ground.resolution": 160,
    "water.color": (0.16, 0.32, 0.38, 0.88),
    "fog.density": 0.05,
}
CASTLE_HILL = ("ground", "sky", "castle", "water", "reflection", "fog", "grass")

FIXES: tuple[Fix, ...] = (
    Fix(
        "R1",
        "Clouds that move",
        Pose(20.0, GROUND, 22.0, 120.0, 35.0),
        1500.0,
        {"sky.moving": False},
        {"sky.moving": True},
        "In fig14a and all other figures the sky is a painting that never changes.",
        "The streaks round the sun are painted and stay; the flakes of cloud that came in drift "
        "over them, slowly, as time goes on.",
        "A second, half-transparent layer of cloud is blended over the box. glTranslatef on the "
        "GL_TEXTURE matrix shifts its picture a little with each kt.",
        (
            "the sun in a blue sky over treetops, with a few still streaks of cloud",
            "the same sun and sky, with ragged white clouds spread over the blue",
        ),
        common={
            "fog.density": 0.03,
            "sky.follow_y": True,
            "sky.background": True,
            "sky.unfogged": True,
        },
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
        "We stand beside the gate and look along its wall. Before, the flame is a red thread, as "
        "its rectangle is seen from its edge; after, it is a whole flame.",
        "The rectangle turns about its vertical axis until it faces the eye: its corners are set "
        "off at right angles to the line from the eye. Texture and blending stay.",
        (
            "a torch on the castle wall whose flame is a thin red line",
            "the same torch with a full yellow flame",
        ),
        common={"overlay.map": False, "overlay.sword": False},
    ),
    Fix(
        "R3",
        "Crossing sprites that sort right",
        Pose(13.29, 1.03, 23.67, 260.0, -4.0),
        0.0,
        {"transparent.split": False},
        {"transparent.split": True},
        "Sorting as in fig17b gives each tree or plant one single depth, and that fails where "
        "two of them stand into one another; no figure shows it.",
        "Look at the trunk of the big conifer. Before, the fern at its foot is painted over by the "
        "tree; after, the half of the fern that stands in front of the trunk is there.",
        "Each half of a crossed quad gets its own depth in the sort, so that a half in front of a "
        "tree is blended after it. All of them are still sent by a single glDrawElements.",
        (
            "a conifer with a bare trunk between ferns",
            "the same conifer with half a fern in front of its trunk",
        ),
        common={
            "plants.count": 9000,
            "overlay.map": False,
            "overlay.sword": False,
            "camera.fov": 30.0,
        },
    ),
    Fix(
        "R4",
        "Trees that no longer lie on their backs",
        Pose(24.3, 2.5, 25.5, 0.0, -82.0),
        0.0,
        {"transparent.upright": False, "trees.crown": False},
        {"transparent.upright": True, "trees.crown": True},
        "Seen from above, the trees of fig36a and the deer of fig36b lie down to face us.",
        "We look straight down. Before, each tree shows its side, trunk and all; after, one looks "
        "on the tops of the trees.",
        "Billboards turn about the vertical axis only, so they stay upright. As the view gets "
        "steeper they fade away by vertex alpha, and a level rectangle with a picture of the crown "
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
        "A billboard is upright, as the deer of fig35d, whatever the ground does; on a steep slope "
        "one end of it hangs in the air and the other is in the hill.",
        "Look at the feet. Before, the doe stands level and her hind legs hang in the air; after, "
        "all four feet are on the slope.",
        "The billboard is spanned by the ground's normal and by the camera's right vector, tilted "
        "into the slope.",
        (
            "a doe standing level before a steep slope, her hind feet in the air",
            "the same doe tilted, with all her feet on the slope",
        ),
        common={"overlay.map": False, "overlay.sword": False},
    ),
    Fix(
        "R6a",
        "Plants that are no lines when seen along a quad",
        "fig37a",
        0.0,
        {"plants.quads": 2, "plants.fade_edge_on": False, "plants.rosette": False},
        {"plants.quads": 3, "plants.fade_edge_on": True, "plants.rosette": True},
        "In fig37a one of the plant's two pictures is seen from its edge.",
        "Before, the strip that stands up in the middle of the fern is a whole picture of the "
        "plant, squeezed to a line; after, there is no strip.",
        "Three quads at 60 degrees instead of two at 90, so that two always show; and each fades "
        "away by vertex alpha as it is seen from its edge.",
        (
            "a fern with a narrow strip standing up in its middle",
            "the same fern made of two crossing pictures, with no strip",
        ),
        common=VIEWS["fig37a"].settings,
        only=("ground", "plants", "grass", "sky", "water", "reflection", "fog"),
    ),
    Fix(
        "R6b",
        "Plants that are no crosses when seen from above",
        "fig37b",
        0.0,
        {"plants.quads": 2, "plants.fade_edge_on": False, "plants.rosette": False},
        {"plants.quads": 3, "plants.fade_edge_on": True, "plants.rosette": True},
        "In fig37b the plants seen from above are crosses.",
        "Before, two crosses lie on the ground; after, they are two ferns with their fronds spread "
        "all round.",
        "As the view gets steeper the upright quads fade away by vertex alpha, and a level quad "
        "with a picture of the same fronds from above fades in.",
        (
            "two thin green crosses on the ground",
            "two round ferns seen from above",
        ),
        common=VIEWS["fig37b"].settings,
        only=("ground", "plants", "grass", "sky", "water", "reflection", "fog"),
    ),
    Fix(
        "R7",
        "Blades that turn partly to the viewer",
        "fig38a",
        0.0,
        {"grass.facing": 0.0},
        {"grass.facing": 0.6},
        "The blade of fig38a is flat, and from its edge there is nothing to see.",
        "It is the same blade in the same place: a thread before, a blade after.",
        "Before the vertices are sent, the width of each blade is turned part of the way towards "
        "the viewer, so that at least three quarters of it show from anywhere.",
        (
            "a blade of grass seen from its edge, as thin as a thread",
            "the same blade, broad and green",
        ),
        common=VIEWS["fig38a"].settings,
        only=("ground", "grass", "sky", "fog"),
    ),
    Fix(
        "R8",
        "A sky that does not come nearer",
        "fig39a",
        0.0,
        {"sky.follow_y": False},
        {"sky.follow_y": True, "sky.background": True},
        "In fig39a the sky's ceiling hangs right over the summit.",
        "Before, the upper half of the picture is the flat lid of the sky box, and the clouds "
        "break off where it begins; after, the clouds are as far away as from the beach, and the "
        "sea runs out to the horizon.",
        "The box moves with the eye upwards as well, and glDepthRange(1, 1) puts it behind "
        "everything else.",
        (
            "a summit under a low, flat blue lid that cuts the clouds off",
            "the same summit under a wide sky, with clouds and hills at the sea's horizon",
        ),
        common={**VIEWS["fig39a"].settings, "water.horizon": 400.0},
    ),
    Fix(
        "R9",
        "Walls that hide no hill",
        "fig40a",
        0.0,
        {"sky.background": False},
        {"sky.background": True},
        "In fig40a the sky's wall, 8 units away, stands before the castle and its hill.",
        "Look between the slope on the left and the cloud on the right. Before, only painted sky; "
        "after, the hill with the castle on it.",
        "glDepthRange(1, 1) gives the box the greatest depth there is, and it writes none: it "
        "shows only where nothing else was drawn.",
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
        "In fig41a the corners of the sky box are paler than the middles of its walls, being "
        "farther off in the fog.",
        "Look at the cloud in the middle, where the corner is. Before, it is a ghost; after, it is "
        "as white as those beside it.",
        "The fog is off (glDisable(GL_FOG)) while the box is drawn: the haze is painted on its "
        "walls, the same all round.",
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
        "In fig42a the gate wall is darker than the towers, being drawn in three layers.",
        "Compare the wall with the two towers. Before, it is darker and bluer than they are; "
        "after, it has their colour, and the torches light it.",
        "Three texture units draw the wall once: the first has the bricks, the second mixes the "
        "door in by its alpha (GL_INTERPOLATE), the third multiplies by the light (GL_MODULATE, "
        "doubled by GL_RGB_SCALE). So fog is added once as well.",
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
        "Compare the neck, behind the ears. Before, the stripes run together like the "
        "spokes of a wheel; after, they do not.",
        "Each face takes its texture coordinates from whichever side of a box it faces most, "
        "instead of from the angle about the vertical axis. Vertices on the border of two such "
        "sides are doubled.",
        (
            "the rabbit from above, with stripes that run to a point behind its ears",
            "the same rabbit with an even, cloudy texture",
        ),
        common=VIEWS["fig43a"].settings,
    ),
    Fix(
        "R13",
        "A mouse that turns without end",
        Pose(20.0, GROUND, 28.0, 180.0, 0.0),
        10.0,
        {"walk.mouse_relative": False},
        {"walk.mouse_relative": True},
        "In 2006 the place of the mouse's pointer set the direction of the view, so at the border "
        "of the window the turn was over. It is about the mouse: no figure can show it.",
        "Two views from the same place. The first is due south, where the mouse of 2006 had to "
        "stop; the second is 70 degrees farther round, where it could not go.",
        "Nothing changes in OpenGL: the mouse is captured and reports how far it moved, not where "
        "it is.",
        (
            "looking south over a meadow with conifers",
            "looking to the west from the same place, at a line of trees",
        ),
        only=tuple(element for element in SCENE if element != "castle"),
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
        (
            "a rocky summit with an angular outline",
            "the same summit with a rounded outline",
        ),
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
        "In 2006 rabbit and walker stand on a smoothly bent surface, but what is drawn is the flat "
        "triangles of fig2b: between the vertices the two differ. No figure shows it.",
        "Before, the rabbit floats over the ground, 0.16 units high; after, it sits on it.",
        "To find the height, the program now looks up which of a cell's two triangles a place is "
        "in, and takes the height on that triangle.",
        (
            "a rabbit floating in the air before a hill",
            "the same rabbit sitting on the ground",
        ),
        common={"rabbit.x": 9.431, "rabbit.z": 16.811, "rabbit.yaw": -60},
        only=("ground", "rabbit", "sky", "fog"),
    ),
    Fix(
        "R16",
        "A mirror image that ripples",
        Pose(9.2, 0.95, 30.6, 50.0, -4.0),
        40.0,
        {"reflection.rippled": False},
        {"reflection.rippled": True},
        "In fig29d the dragon's reflection is that of a perfect mirror, whatever the waves do.",
        "Look at the dragon's image under it. Before, it is a clear copy upside down; after, the "
        "waves break it into streaks.",
        "The mirrored scene is drawn into a texture and laid on a grid of water. Each vertex "
        "finds its place in the picture by the texture matrix, moved a little by the slope of the "
        "wave there.",
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
        "The water of fig11a is a flat plane: only its texture and its light move.",
        "With the sun low and the water's texture left out, the plane before is one flat colour; "
        "after, a swell shows as bands of light and dark. It is low, a foot at most, so the "
        "horizon stays straight.",
        "The vertices rise and fall by a sum of waves, and their normals follow. They form a grid "
        "about the eye, finest near it, and the waves die down towards the beach.",
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
        "Grass that is sent all at once",
        "fig22b",
        0.0,
        {"grass.method": "loop"},
        {"grass.method": "cells"},
        "In 2006 every blade of fig22a and fig22b was sent by itself, in a loop.",
        "Do not look for a difference: the two pictures are the same. Only the time to draw them "
        "differs; [the page on performance](../docs/performance.md#against-2006) has the figures.",
        "Before, glBegin, glVertex and glEnd for each blade. After, the blades are kept in arrays, "
        "by cells of the map; those of the cells in view are sent by one glDrawElements.",
        (
            "tall grass before trees, drawn blade by blade",
            "the same picture, drawn by one call",
        ),
        common=VIEWS["fig22b"].settings,
        only=VIEWS["fig22b"].shown,
    ),
    Fix(
        "R19",
        "Textures no larger than their use",
        "fig4a",
        0.0,
        {"ground.texture_size": 4096, "ground.height_image": "height.png"},
        {"ground.texture_size": 1024, "ground.height_image": "height16.png"},
        "The pictures of fig1a and fig3a take more memory than they need.",
        "The two pictures should look alike, and that is the point: of the memory of the ground's "
        "texture, a quarter is left.",
        "The large texture is halved in width and height before glTexImage2D. The heights come "
        "from an image with one channel of 16 bits instead of three of 8.",
        (
            "the beach, meadows and mountain, with the large textures",
            "the same view with the small textures, hardly different",
        ),
        common={"fog.enabled": False},
        only=("ground",),
    ),
    Fix(
        "best1",
        "Clear shallows",
        Pose(8.0, 2.0, 30.0, -20.0, -35.0),
        20.0,
        {"water.shallow": False},
        {"water.shallow": True},
        "In fig9a the sea is equally dark everywhere, and meets the beach in a hard edge.",
        "Follow the edge of the sand. Before, it is a sharp, angular line; after, the bottom shows "
        "through where the water is shallow, and the sea turns from turquoise to blue.",
        "A texture of the sea's depth, on a second texture unit, sets the water's colour and how "
        "transparent it is (its alpha, for glBlendFunc). The ground is now drawn a little below "
        "the water as well.",
        (
            "a wooded spit of sand in dark water, with an angular edge",
            "the same spit fading softly into turquoise water",
        ),
        common=SEA_OF_BEST,
        only=("ground", "water", "sky", "trees", "reflection", "fog"),
    ),
    Fix(
        "best2",
        "Foam along the beach",
        Pose(8.0, 1.6, 30.2, -20.0, -35.0),
        20.0,
        {"water.foam": False},
        {"water.foam": True},
        "In fig11a the water just ends where the beach begins.",
        "After, white lines of foam run round the sand; in the walk they move towards it.",
        "A strip of triangles along the coast has a texture of breakers. Across the strip the "
        "texture coordinate is the depth of the water, and the texture matrix moves it with time. "
        "A second texture of holes frays the lines.",
        (
            "a spit of sand in clear water",
            "the same spit with white foam round it",
        ),
        common={**SEA_OF_BEST, "water.shallow": True},
        only=("ground", "water", "sky", "reflection", "fog"),
    ),
    Fix(
        "best3",
        "The sun on the water",
        Pose(4.0, 0.9, 38.0, 250.0, -6.0),
        40.0,
        {"water.glitter": 0.0},
        {"water.glitter": 0.35},
        "In fig14a and the others no sunlight glints on the sea.",
        "The sun is low, straight ahead. After, its light lies on the water as a broken, "
        "glittering path under it.",
        "The water is drawn once more with additive blending (GL_SRC_ALPHA, GL_ONE). A vertex is "
        "the brighter the better its slope mirrors the sun to the eye, and two moving textures of "
        "sparks break the light up.",
        (
            "a calm sea at sunset without any glint",
            "the same sea with a narrow path of light under the sun",
        ),
        common={
            "sky.set": "sunset",
            "sun.azimuth": 250.0,  # where the pictures of the sunset have it
            "sun.elevation": 5.0,
            "sun.diffuse": (1.0, 0.8, 0.55),
            "fog.color": (0.86, 0.72, 0.6),
            "water.fresnel": True,
            "water.horizon": 400.0,
            "fog.density": 0.03,
            "reflection.rippled": True,
            "sky.background": True,
        },
        only=("water", "sky", "reflection", "fog"),
    ),
    Fix(
        "best4",
        "Turf, sand and rock",
        Pose(31.6, 0.9, 20.5, 300.0, 3.0),
        0.0,
        {"ground.materials": False, "ground.mid_repeat": 0.0},
        {"ground.materials": True, "ground.mid_repeat": 13.0},
        "In fig4c one and the same grain lies on grass, sand and rock.",
        "Before, the whole slope has one fine grain; after, the steep parts are cracked rock, the "
        "flat ones turf.",
        "Four texture units mix three detail textures: sand where the alpha of the large texture "
        "says so, rock where the slope is steep (by vertex alpha), turf elsewhere. The large "
        "colours multiply the result.",
        (
            "a hillside above the sea with the same fine grain everywhere",
            "the same hillside with cracked rock below and turf above",
        ),
        common={"ground.height_image": "height16.png", "ground.resolution": 160},
        only=("ground", "sky", "fog", "water", "reflection"),
    ),
    Fix(
        "best5",
        "Grass in tufts",
        "fig35d",
        0.0,
        {"grass.tufts": 0, "grass.variety": 0.0},
        {"grass.tufts": 7, "grass.variety": 1.0},
        "In fig22b all blades are alike and spread evenly.",
        "Both pictures have the same number of blades. Before, they stand evenly, of one height "
        "and colour; after, a meadow of higher and lower, greener and browner tufts.",
        "Seven blades share a root and lean apart; a tuft has its own height and its own colour, "
        "set per vertex.",
        (
            "a stag in even, dull green grass",
            "the same stag in uneven grass with brown and green tufts",
        ),
        common={
            "grass.tinted": True,
            "grass.fade": True,
            "grass.facing": 0.6,
            "grass.count": 8000000,
            "grass.scale": (0.4, 1.1),
            "grass.arch": 4.0,
            "grass.radius": 7.0,
        },
    ),
)
