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
class Cure:
    """A remedy: where to look at it, what is set before and after, and what changed in OpenGL.

    ``common`` are settings of both pictures; ``only`` the elements to show; ``after_pose`` stands
    in for the pose in the second picture.
    """

    name: str
    title: str
    view: str | Pose
    kt: float
    off: Mapping[str, Any]
    on: Mapping[str, Any]
    sentence: str
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


CURES: tuple[Cure, ...] = (
    Cure(
        "R1",
        "Clouds that move",
        Pose(20.0, GROUND, 22.0, 120.0, 35.0),
        1500.0,
        {"sky.moving": False},
        {"sky.moving": True},
        "A second, blended layer of cloud lies under the box's ceiling; glTranslatef on the "
        "GL_TEXTURE matrix moves it a little with each kt.",
        common={
            "fog.density": 0.03,
            "sky.follow_y": True,
            "sky.background": True,
            "sky.unfogged": True,
        },
        only=("ground", "water", "sky", "trees", "fog", "reflection"),
    ),
    Cure(
        "R2",
        "Flames that face the viewer",
        Pose(27.521, 2.567, 17.448, 254.2, -1.0),
        12.0,
        {"castle.flame_faces": False},
        {"castle.flame_faces": True},
        "The corners of each flame's quad are set off along the horizontal perpendicular of "
        "the line from the eye, so the quad turns about the y axis and is never seen edge-on; "
        "its texture and blending are as before.",
        common={"overlay.map": False, "overlay.sword": False},
    ),
    Cure(
        "R3",
        "Crossing sprites that sort right",
        Pose(13.29, 1.03, 23.67, 260.0, -4.0),
        0.0,
        {"transparent.split": False},
        {"transparent.split": True},
        "Each half of a crossed quad has its own eye-space depth in the sort, so the half "
        "that stands before a tree is blended after it, in the same single glDrawElements.",
        common={"plants.count": 9000, "overlay.map": False, "overlay.sword": False},
    ),
    Cure(
        "R4",
        "Billboards that stay upright",
        "fig36a",
        0.0,
        {"transparent.upright": False, "trees.crown": False},
        {"transparent.upright": True, "trees.crown": True},
        "The quads are spanned by the camera's right, made level, and the y axis instead of "
        "both axes of the modelview matrix; from above they clear away by vertex alpha and a "
        "level quad with a crown comes in.",
    ),
    Cure(
        "R5",
        "Deer that stand on the slope",
        Pose(33.48, 0.7, 22.44, 211.87, -4.0),
        0.0,
        {"deer.follow_slope": False},
        {"deer.follow_slope": True},
        "The deer's quad is spanned by the ground's normal and the camera's right tilted into "
        "the slope, so both ends of its feet stand on the ground and its head stays out of "
        "it.",
        common={"overlay.map": False, "overlay.sword": False},
    ),
    Cure(
        "R6a",
        "Plants that are no lines: seen along a quad",
        Pose(24.22, 1.814, 21.793, 0.0, -6.0),
        0.0,
        {"plants.quads": 2, "plants.fade_edge_on": False, "plants.rosette": False},
        {"plants.quads": 3, "plants.fade_edge_on": True, "plants.rosette": True},
        "Three quads at 60 degrees, each with a vertex alpha that goes to 0 as it is seen edge-on.",
        common={"plants.count": 9000},
        only=("ground", "plants", "grass", "sky", "water", "reflection", "fog"),
    ),
    Cure(
        "R6b",
        "Plants that are no crosses: seen from above",
        Pose(24.242, 2.233, 21.543, 0.0, -85.0),
        0.0,
        {"plants.quads": 2, "plants.fade_edge_on": False, "plants.rosette": False},
        {"plants.quads": 3, "plants.fade_edge_on": True, "plants.rosette": True},
        "A level quad with a rosette of the same fronds, from a spare cell of the atlas, "
        "comes in by vertex alpha as the view gets steeper, while the upright quads go.",
        common={"plants.count": 9000},
        only=("ground", "plants", "grass", "sky", "water", "reflection", "fog"),
    ),
    Cure(
        "R7",
        "Blades that turn partly to the viewer",
        "fig38a",
        0.0,
        {"grass.facing": 0.0},
        {"grass.facing": 0.6},
        "Before the array is sent, each blade's width is blended with the direction at right "
        "angles to the line of sight, so that at least three quarters of it show from "
        "anywhere: no blade is a line.",
        only=("ground", "grass", "sky", "fog"),
    ),
    Cure(
        "R8",
        "A sky that does not come nearer",
        "fig39a",
        0.0,
        {"sky.follow_y": False},
        {"sky.follow_y": True, "sky.background": True},
        "The box is translated with the eye in y as well, and drawn at the greatest depth by "
        "glDepthRange(1, 1): however high one climbs, the clouds stay as far.",
        common={"water.horizon": 400.0},
    ),
    Cure(
        "R9",
        "Walls that hide no hill",
        "fig40a",
        0.0,
        {"sky.background": False},
        {"sky.background": True},
        "glDepthRange(1, 1) gives the box the greatest depth of all, without depth writes: it "
        "shows only where nothing else is drawn, so the hill behind its wall is seen.",
        only=("ground", "sky", "castle", "water", "reflection", "fog", "grass"),
    ),
    Cure(
        "R10",
        "Corners as clear as walls",
        "fig41a",
        0.0,
        {"sky.unfogged": False},
        {"sky.unfogged": True},
        "glDisable(GL_FOG) while the box is drawn: the haze is painted on its walls, and no "
        "longer depends on how far a corner of the box is.",
    ),
    Cure(
        "R11",
        "The gate wall in one fogged layer",
        "fig42a",
        0.0,
        {"castle.multitexture": False},
        {"castle.multitexture": True},
        "Three texture units draw the gate wall once, GL_INTERPOLATE mixing door and bricks "
        "by the door's alpha and GL_MODULATE with GL_RGB_SCALE 2 laying the halo over it, so "
        "that it is lit and fogged once like the towers.",
        common={"fog.density": 0.2},
        only=("ground", "sky", "castle", "water", "reflection", "fog", "grass"),
    ),
    Cure(
        "R12",
        "The rabbit mapped by charts",
        "fig43a",
        0.0,
        {"rabbit.mapping": "cylindrical"},
        {"rabbit.mapping": "axis"},
        "Each face takes its texture coordinates from the two axes it looks at most, and "
        "vertices between two such charts are doubled: the texture is not pinched along the "
        "vertical axis any more.",
    ),
    Cure(
        "R13",
        "A mouse that turns without end",
        Pose(21.0, GROUND, 23.0, 180.0, 0.0),
        10.0,
        {"walk.mouse_relative": False},
        {"walk.mouse_relative": True},
        "Nothing in OpenGL: in 2006 the cursor's place set the rotation, and at the window's "
        "border the turn was over, as here at due south. The captured mouse reports how far "
        "it went, so one turns on: this is 70 degrees further.",
        only=(
            "ground",
            "water",
            "sky",
            "trees",
            "deer",
            "plants",
            "grass",
            "castle",
            "rabbit",
            "dragon",
            "fog",
            "reflection",
        ),
        after_pose=Pose(21.0, GROUND, 23.0, 250.0, 0.0),
    ),
    Cure(
        "R14",
        "Smoother ground from the same 50 x 50 vertices",
        Pose(13.2, 2.6, 13.6, 350.0, 10.0),
        0.0,
        {"ground.smooth": "none"},
        {"ground.smooth": "catmull_rom", "ground.subdivide": 4},
        "Each cell's two flat triangles become 4 x 4 cells of a bicubic Catmull-Rom patch "
        "through the same vertices, computed once on the CPU and sent in the same display "
        "list: the hills' outlines are curves, no corners.",
        common={"fog.enabled": False},
        only=("ground", "sky", "fog"),
    ),
    Cure(
        "R15",
        "Standing on the triangles that are drawn",
        Pose(9.15, 1.95, 17.35, 25.0, -4.0),
        0.0,
        {"ground.exact_height": False},
        {"ground.exact_height": True},
        "The height query follows the diagonal by which each cell is cut into two triangles "
        "instead of a bilinear surface that is never drawn: the rabbit, and the walker, no "
        "longer float 0.16 units over the ground.",
        common={"rabbit.x": 9.431, "rabbit.z": 16.811, "rabbit.yaw": -60},
        only=("ground", "rabbit", "sky", "fog"),
    ),
    Cure(
        "R16",
        "A mirror image that ripples",
        Pose(9.2, 0.95, 30.6, 50.0, -4.0),
        40.0,
        {"reflection.rippled": False},
        {"reflection.rippled": True},
        "The mirrored scene is drawn into a texture (a framebuffer object instead of "
        "glCopyTexSubImage2D) and laid on a grid before the eye: the texture matrix holds "
        "bias x projection x camera, so that each vertex's own place is its texture "
        "coordinate, and the waves' slopes move that place by the angle by which they tilt "
        "the mirror; GL_COMBINE with GL_INTERPOLATE mixes it in by the vertex alpha "
        "(Fresnel).",
        common={
            "water.fresnel": True,
            "fog.density": 0.05,
            "trees.count": 1800,
            "transparent.radius": 20.0,
            "ground.resolution": 160,
        },
        only=("ground", "water", "sky", "trees", "dragon", "reflection", "fog"),
    ),
    Cure(
        "R17",
        "Waves that lift the surface",
        Pose(11.8, 0.72, 33.0, 20.0, -3.0),
        40.0,
        {"water.relief": False},
        {"water.relief": True},
        "The vertices' heights follow the sum of waves whose derivatives are the normals, on "
        "a grid of equal angles about the eye that is sent far to near in one glDrawElements; "
        "the waves die down towards the beach.",
        common={
            "fog.enabled": False,
            "water.textured": False,
            "sun.azimuth": 285.0,
            "sun.elevation": 10.0,
            "sun.ambient": (0.4, 0.42, 0.46),
            "water.color": (0.5, 0.7, 0.85, 1.0),
        },
        only=("ground", "water"),
    ),
    Cure(
        "R18",
        "The loop over every blade",
        "fig22b",
        0.0,
        {"grass.method": "loop"},
        {"grass.method": "cells"},
        "The same picture: glBegin, glVertex and glEnd for each blade against one "
        "glDrawElements of arrays chosen cell by cell; only the time differs (landscape "
        "bench).",
    ),
    Cure(
        "R19",
        "Textures no larger than their use",
        "fig5a",
        0.0,
        {"ground.texture_size": 4096, "ground.height_image": "height.png"},
        {"ground.texture_size": 1024, "ground.height_image": "height16.png"},
        "The large texture is halved before glTexImage2D, a quarter of the memory, and the "
        "heights come from an image of one 16-bit channel instead of three of 8 bits: hardly "
        "a pixel tells.",
        common={"fog.enabled": False},
        only=("ground",),
    ),
    Cure(
        "best1",
        "Clear shallows",
        Pose(8.0, 2.0, 30.0, -20.0, -35.0),
        20.0,
        {"water.shallow": False},
        {"water.shallow": True},
        "A 512 x 512 texture of the sea's depth on a second unit tints the water and, crossed "
        "over to the last unit's alpha (ARB_texture_env_crossbar), lets the bottom show "
        "through by glBlendFunc; the clip plane of the ground sinks to where nothing shows "
        "any more.",
        common={
            "water.fresnel": True,
            "reflection.rippled": True,
            "ground.resolution": 160,
            "water.color": (0.16, 0.32, 0.38, 0.88),
            "fog.density": 0.05,
        },
        only=("ground", "water", "sky", "trees", "reflection", "fog"),
    ),
    Cure(
        "best2",
        "Foam along the beach",
        Pose(8.0, 1.6, 30.2, -20.0, -35.0),
        20.0,
        {"water.foam": False},
        {"water.foam": True},
        "The coast's triangles, once in a display list, carry the depth as texture coordinate "
        "into a texture of breakers that the texture matrix moves with kt; a second unit adds "
        "lace by GL_ADD_SIGNED and GL_ALPHA_SCALE 4 stretches the sum, so that the line "
        "frays.",
        common={
            "water.fresnel": True,
            "reflection.rippled": True,
            "water.shallow": True,
            "ground.resolution": 160,
            "water.color": (0.16, 0.32, 0.38, 0.88),
            "fog.density": 0.05,
        },
        only=("ground", "water", "sky", "reflection", "fog"),
    ),
    Cure(
        "best3",
        "The sun on the water",
        Pose(30.0, 0.9, 34.0, 60.0, -8.0),
        40.0,
        {"reflection.rippled": False},
        {"reflection.rippled": True},
        "GL_LIGHT0's specular light per vertex, which makes milky spots, gives way to an "
        "additive pass (GL_SRC_ALPHA, GL_ONE): alpha says how near the slope comes to "
        "mirroring the sun, and two moving units of sparks are added to it and cut by "
        "GL_ADD_SIGNED and GL_ALPHA_SCALE 4.",
        common={
            "sky.set": "sunset",
            "sun.azimuth": 60.0,
            "sun.elevation": 12.0,
            "sun.diffuse": (1.0, 0.8, 0.55),
            "fog.color": (0.86, 0.72, 0.6),
            "water.fresnel": True,
            "water.horizon": 400.0,
            "water.rippled": True,
            "fog.density": 0.03,
            "water.glitter": 0.35,
            "sky.background": True,
        },
        only=("water", "sky", "reflection", "fog"),
    ),
    Cure(
        "best4",
        "Turf, sand and rock",
        Pose(17.8, 0.98, 30.3, 100.0, -16.0),
        0.0,
        {"ground.materials": False, "ground.mid_repeat": 0.0},
        {"ground.materials": True, "ground.mid_repeat": 13.0},
        "Four texture units mix three details by GL_INTERPOLATE, sand by the alpha of the "
        "large texture (crossbar, OpenGL 1.4), rock by the vertices' alpha, before the large "
        "colour multiplies them.",
        common={"ground.height_image": "height16.png", "ground.resolution": 160},
        only=("ground", "sky", "fog", "water", "reflection"),
    ),
    Cure(
        "best5",
        "A meadow",
        "fig35d",
        0.0,
        {"grass.facing": 0.0, "grass.tufts": 0, "grass.variety": 0.0},
        {"grass.facing": 0.6, "grass.tufts": 7, "grass.variety": 1.0},
        "The same number of blades, in tufts that lean apart and differ in height and colour; "
        "the vertices' colours, doubled by GL_RGB_SCALE, match the ground's at the foot.",
        common={
            "grass.tinted": True,
            "grass.fade": True,
            "grass.count": 8000000,
            "grass.scale": (0.4, 1.1),
            "grass.arch": 4.0,
            "grass.radius": 7.0,
        },
    ),
)
