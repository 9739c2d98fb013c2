"""Named views: one for each render panel of the report's figures (figures.csv).

Poses are chosen: the report gives pictures, not places. Views of whole places use the scene's
default preset; views that show one technique, or one flaw, use the preset 2006, which shows it.
"""

from dataclasses import replace

from landscape.frame import Pose
from landscape.island.close_views import CLOSE_VIEWS
from landscape.island.setting_views import SETTING_VIEWS
from landscape.scene.scene import View
from landscape.settings.declare import Value

ALL = (
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
    "sword",
    "map",
    "fog",
    "reflection",
    "mist",
)
OUTDOORS = tuple(e for e in ALL if e not in ("sword", "map"))
MAIN = tuple(f"fig35{panel}" for panel in "abcdefghi")  # figure 35: the report's own choice
WHOLE = ("25", "29", "32", "33", "35")  # figures that show a place, not one technique or flaw


def walking(x: float, z: float, yaw: float, pitch: float = 0.0) -> Pose:
    """Return a pose at eye height above the ground; angles in degrees."""
    return Pose(x, None, z, yaw, pitch)


def shows_place(view: View) -> bool:
    """Return whether a figure shows a whole place, not one technique or flaw.

    Of the castle's, fig25b is there for the deer and trees that face an eye in the air.
    """
    return view.figure.split()[0] in WHOLE and view.name != "fig25b"


def _table(*views: View) -> dict[str, View]:
    """Return views by name, with the preset 2006 if they show one technique or flaw."""
    return {
        view.name: view if shows_place(view) else replace(view, preset="2006") for view in views
    }


NO_FOG = {"fog.enabled": False}
LAND = ("ground",)
SHORE = ("ground", "water", "reflection", "fog")
ABOVE = Pose(20.0, 29.5, 43.5, 0.0, -51.0)
BAY_SIDE = Pose(13.4, 1.75, 27.6, 345.0, -14.0)
OVER_BAY = Pose(8.0, 1.05, 35.0, 18.0, -4.0)
GROVE = Pose(24.0, 1.5, 27.5, 0.0, -3.0)
FOREST = Pose(19.5, 1.45, 26.0, 320.0, -3.0)
WOODS = ("ground", "trees", "sky", "fog", "water", "reflection")
GATE_BEFORE = walking(27.92, 18.6, 340.0, 9.0)
BARE = ("ground", "sky", "castle", "water", "reflection", "fog", "grass")
LONE_PLANT = {"plants.count": 3000}
PLANT_BEFORE = Pose(19.933, 1.128, 25.415, 20.0, -16.0)
LONE_BLADE: dict[str, Value] = {"grass.count": 2000, "grass.scale": (4.0, 3.5)}
BLADE_BEFORE = Pose(19.948, 1.063, 26.011, 40.0, -9.0)
LAWN_BEFORE = walking(21.25, 23.75, 340.0, -7.0)
GROVE_AND_SKY = ("ground", "trees", "deer", "plants", "sky", "fog")
AVENUE = {"transparent.places": "avenue.csv"}
CROSSING = {"transparent.places": "crossing.csv", "transparent.faces": "place"}
FACING: dict[str, Value] = {**AVENUE, "transparent.surround": "white", "camera.fov": 70.0}
AVENUE_BEFORE = walking(21.3, 25.2, 338.0, -6.0)
AVENUE_LEFT = walking(21.3, 25.2, 320.0, -6.0)
AVENUE_RIGHT = walking(21.3, 25.2, 356.0, -6.0)
CROSSING_BEFORE = walking(20.95, 23.3, 0.0, 8.0)
HILL_BEFORE = walking(21.5, 9.4, 141.0, 0.0)
HAZE = {"fog.density": 0.12}  # section 10.2: that of 2006, with either preset
CLEARER = {"fog.density": 0.05}  # chosen: less than half of 2006, for views of something far away

VIEWS = (
    _table(
        View(
            "fig2a",
            "terrain in wireframe from above, cut at sea level",
            ABOVE,
            shown=LAND,
            settings=NO_FOG | {"ground.units": "none"},
            wireframe=True,
        ),
        View(
            "fig2b",
            "terrain in wireframe from the ground",
            walking(17.0, 21.0, 330.0, 9.0),
            shown=LAND,
            settings=NO_FOG | {"ground.units": "none"},
            wireframe=True,
        ),
        View(
            "fig4a",
            "terrain with the large-scale texture",
            BAY_SIDE,
            shown=LAND,
            settings=NO_FOG | {"ground.units": "large"},
        ),
        View(
            "fig4b",
            "terrain with the detail texture",
            BAY_SIDE,
            shown=LAND,
            settings=NO_FOG | {"ground.units": "detail", "ground.detail_repeat": 40.0},
        ),
        View(
            "fig4c",
            "terrain with both textures",
            BAY_SIDE,
            shown=LAND,
            settings=NO_FOG | {"ground.detail_repeat": 40.0},
        ),
        View(
            "fig5a",
            "whole textured terrain",
            Pose(8.0, 11.0, 44.0, 20.0, -24.0),
            shown=LAND,
            settings=NO_FOG,
        ),
        View(
            "fig6a",
            "terrain and its mirror image",
            OVER_BAY,
            shown=("ground", "reflection"),
            settings=NO_FOG,
        ),
        View(
            "fig8a",
            "plain transparent water over the mirror image",
            OVER_BAY,
            shown=("ground", "reflection", "water"),
            settings=NO_FOG | {"water.textured": False, "water.animated": False},
        ),
        View(
            "fig9a",
            "water with its texture",
            OVER_BAY,
            shown=("ground", "reflection", "water"),
            settings=NO_FOG | {"water.animated": False},
        ),
        View(
            "fig10a",
            "terrain and water in wireframe",
            Pose(12.0, 2.2, 32.5, 20.0, -28.0),
            shown=("ground", "water"),
            settings=NO_FOG | {"ground.units": "none"},
            wireframe=True,
        ),
        View(
            "fig11a",
            "animated water at one time",
            Pose(12.0, 1.1, 35.0, 10.0, -12.0),
            10,
            shown=SHORE,
        ),
        View(
            "fig11b",
            "animated water at another time",
            Pose(12.0, 1.1, 35.0, 10.0, -12.0),
            60,
            shown=SHORE,
        ),
        View(
            "fig13a",
            "the sky box from far outside",
            Pose(33.0, 9.0, 41.0, 328.0, -17.0),
            shown=("sky",),
            settings=NO_FOG | {"sky.anchored": True},
        ),
        View(
            "fig14a",
            "sky and horizon in the water",
            Pose(9.6, 1.0, 33.2, 330.0, -5.0),
            20,
            shown=("ground", "water", "sky", "reflection"),
            settings=NO_FOG,
        ),
        View(
            "fig16a",
            "bare billboard quads facing the camera",
            GROVE,
            0,
            shown=WOODS,
            settings={"transparent.textured": False, "trees.count": 500},
        ),
        View(
            "fig17a", "a few scattered trees", GROVE, 0, shown=WOODS, settings={"trees.count": 300}
        ),
        View(
            "fig17b", "many trees, sorted", FOREST, 0, shown=WOODS, settings={"trees.count": 4000}
        ),
        View(
            "fig17c",
            "the same trees unsorted",
            FOREST,
            0,
            shown=WOODS,
            settings={"trees.count": 4000, "transparent.sorted": False},
        ),
        View(
            "fig18a",
            "trees and deer and their reflections",
            Pose(3.9, 0.71, 12.9, 119.0, 1.0),
            20,
            shown=("ground", "water", "sky", "trees", "deer", "reflection", "fog"),
            settings={"trees.count": 1600, "deer.count": 300},
        ),
        View(
            "fig18b",
            "the same, a second view",
            Pose(33.4, 0.72, 20.9, 65.0, 0.0),
            60,
            shown=("ground", "water", "sky", "trees", "deer", "reflection", "fog"),
            settings={"trees.count": 1600, "deer.count": 300},
        ),
        View(
            "fig19a",
            "crossed quads in wireframe",
            PLANT_BEFORE,
            7,
            shown=("plants",),
            settings=NO_FOG | LONE_PLANT | {"transparent.textured": False},
            wireframe=True,
        ),
        View(
            "fig19b",
            "the same plants textured",
            PLANT_BEFORE,
            7,
            shown=("plants", "ground", "sky", "fog"),
            settings=LONE_PLANT,
        ),
        View(
            "fig21a",
            "a blade in wireframe",
            BLADE_BEFORE,
            0,
            shown=("grass",),
            settings=NO_FOG | LONE_BLADE,
            wireframe=True,
        ),
        View(
            "fig21b",
            "the same blade textured",
            BLADE_BEFORE,
            0,
            shown=("grass", "ground"),
            settings=NO_FOG | LONE_BLADE,
        ),
        View(
            "fig22a",
            "1,500,000 short blades: lawn",
            Pose(21.25, 1.55, 23.75, 340.0, -3.0),
            3,
            shown=OUTDOORS,
            settings={
                "grass.count": 1_500_000,
                "grass.scale": (2.4, 1.0),
                "grass.radius": 8.0,
                "camera.fov": 42.0,
            },
        ),
        View(
            "fig22b",
            "3,000,000 tall, thin blades: tall grass",
            LAWN_BEFORE,
            3,
            shown=OUTDOORS,
            settings={"grass.count": 3_000_000, "grass.scale": (1.0, 5.0), "grass.radius": 5.0},
        ),
        View(
            "fig25a",
            "castle, general structure",
            Pose(24.9, 3.9, 19.4, 46.0, -20.0),
            10,
            shown=OUTDOORS,
        ),
        View(
            "fig25b",
            "castle from the air",
            Pose(26.3, 4.4, 19.2, 22.0, -38.0),
            10,
            shown=OUTDOORS,
            settings={"deer.count": 600},
        ),
        View(
            "fig25c",
            "castle from a distance",
            walking(28.25, 20.25, 344.0, 8.0),
            10,
            shown=OUTDOORS,
        ),
        View("fig25d", "arriving at the gate wall", GATE_BEFORE, 10, shown=OUTDOORS),
        View(
            "fig25e",
            "one flame close up",
            Pose(27.85, 2.56, 17.66, 336.0, -1.0),
            12,
            shown=OUTDOORS,
        ),
        View(
            "fig25f", "the door close up", Pose(27.64, 2.5, 17.84, 340.0, 1.0), 12, shown=OUTDOORS
        ),
        View(
            "fig27a",
            "rabbit in wireframe",
            walking(20.25, 24.2, 50.0, 8.0),
            shown=("rabbit",),
            settings=NO_FOG | {"camera.cull": True, "camera.fov": 34.0},
            wireframe=True,
        ),
        View(
            "fig27b",
            "dragon in wireframe",
            Pose(11.5, 0.9, 31.2, 358.5, 6.0),
            shown=("dragon",),
            settings=NO_FOG | {"ground.clip": False, "camera.cull": True, "camera.fov": 13.0},
            wireframe=True,
        ),
        View(
            "fig28a",
            "rabbit with cylindrical mapping",
            walking(20.25, 24.2, 50.0, -4.0),
            0,
            shown=("rabbit", "ground", "sky"),
            settings=NO_FOG,
        ),
        View(
            "fig28b",
            "dragon mapped by (x, z)",
            Pose(11.5, 0.9, 31.2, 356.0, 2.0),
            0,
            shown=("dragon",),
            settings=NO_FOG | {"ground.clip": False, "camera.fov": 20.0},
        ),
        View(
            "fig29a", "rabbit close up", Pose(20.63, 1.22, 23.84, 218.0, -20.0), 0, shown=OUTDOORS
        ),
        View(
            "fig29b",
            "rabbit among the plants",
            walking(20.2, 24.6, 30.0, -2.0),
            0,
            shown=OUTDOORS,
            settings={"plants.count": 6000},
        ),
        View(
            "fig29c", "rabbit from farther away", walking(19.6, 25.6, 30.0, 0.0), 0, shown=OUTDOORS
        ),
        View(
            "fig29d",
            "sea dragon half under water",
            Pose(11.9, 0.85, 31.0, 335.0, 1.0),
            20,
            shown=OUTDOORS,
        ),
        View(
            "fig29e",
            "sea dragon, second angle",
            Pose(9.2, 0.95, 30.6, 50.0, -1.0),
            20,
            shown=OUTDOORS,
        ),
        View("fig32a", "sword stroke, first frame", walking(21.0, 23.0, 30.0), 5, stroke=1),
        View("fig32b", "sword stroke, second frame", walking(21.0, 23.0, 30.0), 9, stroke=2),
        View("fig32c", "sword stroke, third frame", walking(21.0, 23.0, 30.0), 13, stroke=3),
        View("fig32d", "sword stroke, fourth frame", walking(21.0, 23.0, 30.0), 17, stroke=4),
        View("fig33a", "map in the upper left, with our position", walking(15.6, 26.6, 215.0), 10),
        View(
            "fig34a", "fog over an open view", walking(23.4, 20.2, 285.0, 2.0), 10, shown=OUTDOORS
        ),
        View(
            "fig35a",
            "wide view: vegetation and reflections",
            Pose(8.0, 1.0, 33.0, 28.0, -1.0),
            40,
            shown=OUTDOORS,
        ),
        View(
            "fig35b",
            "on the ground: grass, deer by the plants, sea beyond",
            walking(20.0, 28.4, 168.0, -2.0),
            20,
            shown=OUTDOORS,
        ),
        View(
            "fig35c",
            "the rabbit close, in vegetation",
            walking(20.1, 24.42, 42.0, -3.0),
            10,
            shown=OUTDOORS,
        ),
        View(
            "fig35d",
            "a deer in a natural setting",
            walking(22.35, 21.6, 310.0, 0.0),
            30,
            shown=OUTDOORS,
        ),
        View(
            "fig35e",
            "many trees, castle in the haze on its hill",
            HILL_BEFORE,
            50,
            shown=OUTDOORS,
            settings=HAZE,
        ),
        View(
            "fig35f",
            "arriving at the castle",
            walking(28.25, 19.1, 334.0, 8.0),
            24,
            shown=(*OUTDOORS, "map"),
        ),
        View(
            "fig35g",
            "from the hill top: sea and islets",
            walking(29.5, 16.6, 92.0, -7.0),
            60,
            shown=OUTDOORS,
        ),
        View(
            "fig35h",
            "an islet with a deer reflected",
            Pose(34.53, 0.67, 21.05, 344.0, -4.0),
            150,
            shown=OUTDOORS,
            settings={"camera.fov": 40.0},
        ),
        View(
            "fig35i", "approaching the dragon, sword in view", walking(13.2, 27.0, 226.0, 0.0), 15
        ),
        View(
            "fig36a",
            "flaw: seen from above, a tree faces us",
            Pose(22.0, 2.6, 23.2, 0.0, -80.0),
            shown=OUTDOORS,
            settings={"trees.count": 2500},
        ),
        View(
            "fig36b",
            "flaw: seen from above, a deer faces us",
            Pose(20.27, 1.4, 28.93, 0.0, -84.0),
            shown=OUTDOORS,
        ),
        View(
            "fig37a",
            "flaw: crossed quads seen along an axis",
            Pose(20.025, 1.078, 25.421, 0.0, -8.0),
            0,
            shown=OUTDOORS,
            settings=LONE_PLANT | {"camera.fov": 40.0},
        ),
        View(
            "fig37b",
            "flaw: crossed quads from above",
            Pose(17.105, 2.0, 26.54, 0.0, -89.0),
            0,
            shown=OUTDOORS,
            settings=LONE_PLANT | {"camera.fov": 13.0},
        ),
        View(
            "fig38a",
            "flaw: a blade edge-on is flat",
            Pose(19.919, 1.067, 25.843, 130.0, -8.0),
            0,
            shown=OUTDOORS,
            settings=LONE_BLADE,
        ),
        View(
            "fig39a",
            "flaw: at the sky box's ceiling",
            walking(13.0, 10.6, 25.0, 8.0),
            0,
            shown=OUTDOORS,
            settings=CLEARER | {"camera.fov": 80.0},
        ),
        View(
            "fig40a",
            "flaw: a hill beyond the wall is missing",
            walking(13.0, 20.0, 82.0, 5.0),
            0,
            shown=BARE,
            settings=CLEARER,
        ),
        View(
            "fig40b",
            "flaw: farther on it appears",
            walking(19.3, 18.6, 82.0, 5.0),
            0,
            shown=BARE,
            settings=CLEARER,
        ),
        View(
            "fig41a",
            "flaw: corners more fogged",
            Pose(3.0, 0.9, 3.0, 315.0, 8.0),
            0,
            shown=("sky", "water", "reflection", "fog"),
            settings={"camera.fov": 75.0},
        ),
        View(
            "fig42a",
            "flaw: the door wall darker under fog",
            walking(28.45, 20.1, 340.0, 9.0),
            0,
            shown=BARE,
            settings={"fog.density": 0.2, "camera.fov": 34.0},
        ),
        View(
            "fig43a",
            "flaw: the mapping pinched at the axis",
            Pose(20.46, 1.42, 24.02, 30.0, -78.0),
            0,
            shown=OUTDOORS,
            settings={"camera.fov": 40.0},
        ),
    )
    | {
        view.name: view
        for view in (
            View(
                "hill",
                "many trees, castle on its hill, in clear air: where a walk begins",
                HILL_BEFORE,
                50,
                shown=OUTDOORS,
            ),
            View(
                "dusk_bay",
                "the sun sets behind the dragon's bay",
                walking(13.2, 27.0, 245.0, -2.0),
                40,
                shown=OUTDOORS,
                settings={"time": "sunset"},
            ),
            View(
                "dusk_gate",
                "torches at the castle's gate, after its last sun",
                walking(27.75, 18.85, 336.0, 14.0),
                24,
                shown=OUTDOORS,
                settings={"time": "sunset"},
            ),
            View(
                "under_water",
                "the net of light over the sea dragon and its bay's bed",
                Pose(11.25, 0.2, 30.0, 340.0, 14.0),
                40,
                shown=OUTDOORS,
            ),
            View(
                "mist_bay",
                "mist over the bay, the serpent's head above it",
                Pose(9.0, 1.12, 32.6, 24.0, 0.0),
                40,
                shown=OUTDOORS,
                settings={"mist.enabled": True},
            ),
        )
    }
    | {
        # Pairs of what the report says without a figure of its own, in its own preset.
        view.name: replace(view, preset="2006")
        for view in (
            View(
                "two_passes",
                "terrain whose detail is a second pass, blended over the first",
                BAY_SIDE,
                shown=LAND,
                settings=NO_FOG | {"ground.detail_repeat": 40.0, "ground.passes": "two"},
            ),
            View(
                "lit_ground",
                "terrain without textures, lit by its normals",
                BAY_SIDE,
                shown=LAND,
                settings=NO_FOG
                | {
                    "ground.units": "none",
                    "ground.lit": True,
                    "sun.ambient": (0.12, 0.13, 0.18),
                    "sun.elevation": 25.0,
                    "sun.diffuse": (0.85, 0.78, 0.65),
                },
            ),
            View(
                "squeezed",
                "the island half as long as wide",
                Pose(9.0, 8.0, 29.0, 28.0, -26.0),
                shown=("ground", "water"),
                settings=NO_FOG | {"ground.scale_z": 0.5},
            ),
            View(
                "unfolded_sky",
                "a sky box cut out of one picture, in which it is unfolded",
                Pose(33.0, 9.0, 41.0, 328.0, -17.0),
                shown=("sky",),
                settings=NO_FOG | {"sky.anchored": True, "sky.unfolded": "sky_unfolded.jpg"},
            ),
            View(
                "sky_lifted",
                "flaw: a box that follows the eye upwards is pulled out of the sea",
                Pose(14.0, 4.2, 33.0, 322.0, -12.0),
                shown=("ground", "water", "sky"),
                settings=NO_FOG | {"sky.follow_y": True, "sky.sunk": 1.2},
            ),
            View(
                "sky_far",
                "flaw: fog covers all clouds of a box that is far away",
                Pose(12.0, 1.1, 35.0, 10.0, 12.0),
                shown=("ground", "water", "sky", "fog"),
                settings={"sky.half_width": 60.0, "sky.height": 37.5},
            ),
            View(
                "lit_waves",
                "the waves' moving normals, seen by the light alone: no texture",
                Pose(12.0, 7.0, 42.0, 20.0, -22.0),
                10,
                shown=("ground", "water"),
                settings=NO_FOG
                | {
                    "water.textured": False,
                    "sun.ambient": (0.0, 0.0, 0.0),
                    "sun.diffuse": (1.5, 1.5, 1.5),
                    "sun.azimuth": 190.0,
                    "sun.elevation": 12.0,
                    "water.color": (0.3, 0.4, 0.6, 1.0),
                },
            ),
            View(
                "avenue",
                "trees, ferns and a stag where a file says that they stand",
                walking(21.5, 26.1, 338.0, -3.0),
                20,
                shown=GROVE_AND_SKY,
                settings=AVENUE,
            ),
            View(
                "faces_plane",
                "flaw: quads are parallel to the picture",
                AVENUE_LEFT,
                shown=GROVE_AND_SKY,
                settings=FACING,
            ),
            View(
                "faces_plane_turned",
                "the same, the eye turned on the spot: each quad has turned with it",
                AVENUE_RIGHT,
                shown=GROVE_AND_SKY,
                settings=FACING,
            ),
            View(
                "faces_place",
                "quads that face the place of the eye",
                AVENUE_LEFT,
                shown=GROVE_AND_SKY,
                settings=FACING | {"transparent.faces": "place"},
            ),
            View(
                "faces_place_turned",
                "the same, the eye turned on the spot: the quads have stayed as they were",
                AVENUE_RIGHT,
                shown=GROVE_AND_SKY,
                settings=FACING | {"transparent.faces": "place"},
            ),
            View(
                "cross_whole",
                "flaw: of two trees that cross one is drawn over all of the other",
                CROSSING_BEFORE,
                shown=GROVE_AND_SKY,
                settings=CROSSING,
            ),
            View(
                "cross_cut",
                "the same trees, cut where they cross: each is in front on its side",
                CROSSING_BEFORE,
                shown=GROVE_AND_SKY,
                settings=CROSSING | {"transparent.split": True},
            ),
            View(
                "white_boards",
                "pictures of trees before their white was made transparent",
                CROSSING_BEFORE,
                shown=GROVE_AND_SKY,
                settings=CROSSING | {"transparent.surround": "white"},
            ),
            View(
                "white_keyed",
                "flaw: their white replaced by transparency; a pale edge remains",
                CROSSING_BEFORE,
                shown=GROVE_AND_SKY,
                settings=CROSSING | {"transparent.surround": "keyed"},
            ),
            View(
                "on_slope",
                "trees and ferns perpendicular to a steep slope",
                Pose(30.4, 1.42, 20.13, 0.0, 0.0),
                shown=OUTDOORS,
                settings={
                    "transparent.follow_slope": True,
                    "trees.count": 1500,
                    "plants.count": 6000,
                },
            ),
        )
    }
    | {view.name: view for view in CLOSE_VIEWS}
    | {view.name: replace(view, shown=OUTDOORS) for view in SETTING_VIEWS}
)
