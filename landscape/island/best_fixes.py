"""Techniques beyond the report, as pairs of pictures, before and after."""

from landscape.frame import Pose
from landscape.island.fix import GROUND, Fix
from landscape.settings.declare import Value

SEA_OF_BEST: dict[str, Value] = {
    "water.fresnel": True,
    "reflection.rippled": True,
    "ground.resolution": 160,
    "water.color": (0.095, 0.195, 0.225, 0.93),
    "fog.density": 0.05,
}

BEST_FIXES: tuple[Fix, ...] = (
    Fix(
        "best1",
        "Clear shallows",
        Pose(8.0, 2.0, 30.0, -20.0, -35.0),
        20.0,
        {"water.shallow": False},
        {"water.shallow": True},
        "In fig9a the sea is equally dark everywhere, and meets the beach in a hard edge.",
        "Follow the edge of the sand. Before, it is a sharp, angular line; after, the sea floor "
        "shows through where the water is shallow, and the sea turns from green to blue.",
        "A texture of the water's depth, on a second texture unit, sets the colour of the water "
        "and its alpha (for glBlendFunc). The ground is now drawn a little below the water as "
        "well.",
        (
            "a wooded spit of sand in dark water, with an angular edge",
            "the same spit fading softly into green water",
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
        "After, a wash of foam surrounds the sand; in the walk it comes and goes with the swell.",
        "A texture over the map holds a wave of the distance from the shore, as its cosine and "
        "sine; the vertices send those of the time. GL_DOT3_RGBA makes them a crest that runs "
        "ashore. A second texture, full of holes, frays it.",
        (
            "a spit of sand in clear water",
            "the same spit with white foam around it",
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
        "In fig14a and all other figures no sunlight glints on the sea.",
        "The sun is low, straight ahead. After, its light lies on the water as a broken, "
        "glittering path.",
        "The water is drawn once more with additive blending (GL_SRC_ALPHA, GL_ONE). The better "
        "the slope at a vertex mirrors the sun to the eye, the brighter the vertex; two moving "
        "textures of sparkles break the light up.",
        (
            "a calm sea at sunset without any glint",
            "the same sea with a narrow path of light under the sun",
        ),
        common={
            "sky.set": "sunset",
            "sky.refined": True,
            "sun.azimuth": 250.0,  # where the sun is in the sunset textures
            "sun.elevation": 4.0,
            "sun.diffuse": (1.0, 0.8, 0.55),
            "fog.color": (0.86, 0.62, 0.5),
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
        "In fig4c the same grain lies on grass, sand and rock.",
        "Before, the whole slope has one fine grain; after, the steep parts are cracked rock, the "
        "flat ones turf.",
        "Four texture units mix three detail textures: sand where the alpha of the large texture "
        "says so, rock where the slope is steep (by vertex alpha), turf elsewhere. The colours of "
        "the large texture multiply the result.",
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
        "In fig22b all blades are alike and evenly spread.",
        "Both pictures have the same number of blades. Before, they are evenly spread, all of one "
        "height and colour; after, the meadow has tufts that are taller or shorter, greener or "
        "browner.",
        "Seven blades share a root and lean apart; each tuft has its own height and its own "
        "colour, set per vertex.",
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
    Fix(
        "best6",
        "Fog by distance",
        Pose(19.6, 2.2, 23.2, 5.0, 2.0),
        0.0,
        {"fog.radial": False},
        {"fog.radial": True},
        "In fig34a fog is measured by the depth. In a wide view what stands at the side is hardly "
        "fogged, and as one turns, the fog on it comes and goes.",
        "The view is 110 degrees wide. Compare the castle at the right and the mountain at the "
        "left: before, they stand out as if they were near; after, they are as hazy as what is as "
        "far away in the middle.",
        "GL_NV_fog_distance: glFogi(GL_FOG_DISTANCE_MODE_NV, GL_EYE_RADIAL_NV) instead of "
        "GL_EYE_PLANE.",
        (
            "a wide view of meadows, a castle at its right side in clear, dark stone",
            "the same view, the castle pale in the haze",
        ),
        common={
            "camera.fov": 94.0,
            "fog.density": 0.11,
            "fog.color": (0.66, 0.76, 0.84),
            "sky.background": True,
            "sky.unfogged": True,
            "sky.follow_y": True,
            "transparent.radius": 26.0,
        },
        only=("ground", "trees", "castle", "sky", "fog"),
    ),
    Fix(
        "best7",
        "Wet scales",
        Pose(11.9, 0.85, 31.0, 341.0, 2.0),
        20.0,
        {"dragon.sheen": 0.0},
        {"dragon.sheen": 0.8},
        "In fig29d the serpent comes out of the sea as dry as stone.",
        "Look at the edges of neck and coils, and at the humps of the scales: after, they mirror "
        "the sky, or the sea below.",
        "Two cube maps on texture units of their own. GL_REFLECTION_MAP generates coordinates in a "
        "map of the sky and the sea, which the texture matrix turns to the world's axes; "
        "GL_NORMAL_MAP looks up how much is mirrored, most at grazing angles. GL_INTERPOLATE "
        "mixes them.",
        (
            "the serpent's head and coils in matt colours",
            "the same serpent, its scales and edges shining wet",
        ),
        common={
            **SEA_OF_BEST,
            **{"camera.fov": 24.0, "sun.fill": 0.45, "sky.background": True},
            **{"dragon.mapping": "axis", "dragon.painted": True, "dragon.gloss": 0.5},
            **{"sky.follow_y": True, "sky.unfogged": True, "water.horizon": 400.0},
        },
        only=("ground", "water", "sky", "trees", "dragon", "reflection", "fog"),
    ),
    Fix(
        "best8",
        "Light on the blade",
        Pose(13.2, 0.9, 27.0, 308.0, 0.0),
        15.0,
        {"overlay.sheen": 0.0},
        {"overlay.sheen": 0.5},
        "In fig35i the sword is the same picture wherever its bearer looks.",
        "The sun is behind the viewer. After, its light lies on the blade; in the walk it runs "
        "along the steel as one turns.",
        "A strip of quads over the blade is blended by addition. It is flat, but its normals are "
        "bent; GL_REFLECTION_MAP looks up the sky and the sun in a cube map. A texture of where "
        "the picture shows steel masks it.",
        ("a dull sword over a beach", "the same sword, its blade bright"),
        common={
            **SEA_OF_BEST,
            **{"sky.background": True, "sky.unfogged": True, "water.horizon": 400.0},
        },
        only=("ground", "water", "sky", "sword", "reflection", "fog"),
    ),
    Fix(
        "best9",
        "Light on the sea bed",
        Pose(13.6, 1.0, 28.0, 160.0, -24.0),
        20.0,
        {"water.caustics": False},
        {"water.caustics": True},
        "In fig9a and best1 the bed of the sea is evenly lit, whatever the waves do.",
        "After, a net of bright lines lies on the sand under shallow water; in the walk it moves.",
        "Three more texture units on the triangles under shallow water: two frames of a film of "
        "caustics, mixed by GL_INTERPOLATE, and a texture that fades them with the depth.",
        (
            "plain sand under clear shallow water",
            "the same sand with a bright net of light on it",
        ),
        common={
            **SEA_OF_BEST,
            **{"water.shallow": True, "ground.materials": True, "ground.mid_repeat": 13.0},
            **{"ground.tiles": 8, "water.repeat": 7.0, "ground.height_image": "height16.png"},
        },
        only=("ground", "water", "sky", "reflection", "fog"),
    ),
    Fix(
        "best10",
        "Calm water near land",
        "fig35h",
        150.0,
        {"water.sheltered": False},
        {"water.sheltered": True},
        "In R16 the waves are as high in a cove as on the open sea, and break up every mirror "
        "image.",
        "After, the islet is mirrored from the shore to its top; further out the waves are as "
        "they were.",
        "A map made once says how far the sea is open around each of its points: lines run out "
        "in 24 directions until they meet land. Their mean length scales the waves at the "
        "vertices, and with them how far each moves the mirror image.",
        (
            "a rocky islet, and below it a mirror image torn by waves",
            "the same islet, clearly mirrored in calm water",
        ),
        common={
            **SEA_OF_BEST,
            **{"water.shallow": True, "water.ripples": 0.6, "water.repeat": 7.0},
            **{"water.relief": True, "water.horizon": 400.0, "sky.background": True},
            **{"sky.unfogged": True, "camera.fov": 40.0},
        },
        only=("ground", "water", "sky", "trees", "reflection", "fog"),
    ),
    Fix(
        "best11",
        "Ledges in rock",
        Pose(16.0, GROUND, 9.0, 250.0, 10.0),
        20.0,
        {"ground.ledges": 0.0},
        {"ground.ledges": 0.7},
        "In best4 a cliff has the texture of rock, but its shape is that of a few large triangles.",
        "Follow the skyline. Before, it is a straight line; after, beds of rock end in ledges, "
        "gullies run down between them, and the rock has a grain at arm's length.",
        "Cells of steep ground are drawn again as 8 x 8 finer ones, before the ground, so that the "
        "depth test rejects what is beneath. The heights are made once; the walker stands on them. "
        "The light on the ledges is in the large texture. Beside the eye one more texture unit "
        "multiplies by a fine grain, and far away a cell has two triangles.",
        (
            "a mountain slope of smooth rock with a straight skyline",
            "the same slope broken into ledges and gullies, with a jagged skyline",
        ),
        common={
            **{"ground.height_image": "height16.png", "ground.resolution": 160},
            **{"ground.materials": True, "ground.mid_repeat": 13.0, "ground.weathered": True},
            **{"ground.tiles": 8, "ground.exact_height": True, "ground.low_stretch": True},
        },
        only=("ground", "sky", "fog", "water"),
    ),
    Fix(
        "best12",
        "Waves run up the beach",
        Pose(14.0, 0.9, 30.0, 165.0, -22.0),
        80.0,
        {"water.run_up": False},
        {"water.run_up": True},
        "In R16 the sea ends in a white line that never leaves its place.",
        "Look at the sand along the water. Before, foam swells and fades at the edge of the water; "
        "after, a wave has climbed the sand and drains, and leaves lace and a dark, wet mirror.",
        "What a swell does at one place of a beach, distance across and time down, is a texture. A "
        "strip of fine cells along all beaches looks it up; the texture matrix moves it with the "
        "time, so that no vertex changes.",
        (
            "a beach whose dry sand meets the water in a soft edge",
            "the same beach with lace of foam on wet sand",
        ),
        common={
            **SEA_OF_BEST,
            **{"water.shallow": True, "water.caustics": True, "water.foam": True},
            **{"ground.materials": True, "ground.mid_repeat": 13.0, "ground.weathered": True},
            **{"ground.tiles": 8, "water.repeat": 7.0, "ground.height_image": "height16.png"},
        },
        only=("ground", "water", "sky", "reflection", "fog"),
    ),
    Fix(
        "best13",
        "Scales",
        Pose(11.3, 0.75, 29.6, 330.0, 5.0),
        40.0,
        {"dragon.scaly": False, "dragon.mesh": "dragon.ply"},
        {"dragon.scaly": True, "dragon.mesh": "serpent.ply"},
        "The dragon has the texture of 2006, which the rabbit has, too. At arm's length it is a "
        "smear.",
        "Look at the curve of the body. Before, it is as smooth as plastic, and its crest is as "
        "thick as a wall; after, scales overlap towards the tail, larger ones stand in rows, and "
        "light comes through the membranes between the spines.",
        "The mesh has texture coordinates along its body, the same on both sides: scales have a "
        "direction, and are painted as light from above shows them. The texture is made when the "
        "scene opens, and multiplied by the vertices' colours. Its alpha is how much each texel "
        "mirrors of sky and sun. The flesh is smooth, as relief of the size of its triangles would "
        "break up what it mirrors. Membranes are sheets, blended after the sea.",
        (
            "the dragon's body leaving the sea, its skin smooth",
            "the body covered with scales, ragged membranes between its spines",
        ),
        common={
            **SEA_OF_BEST,
            **{"dragon.mapping": "axis", "dragon.painted": True},
            **{"dragon.sheen": 0.8, "dragon.wet": 1.0, "water.repeat": 7.0},
        },
        only=("water", "sky", "dragon", "ground", "fog"),
    ),
    Fix(
        "stencil",
        "A reflection that ends with the water",
        Pose(20.0, 1.7, 35.5, 170.0, -14.0),
        20.0,
        {"reflection.rippled": False, "reflection.stencil": False},
        {"reflection.rippled": False, "reflection.stencil": True},
        "The mirrored scene is drawn over the whole framebuffer. In fig6a nothing covers it where "
        "there is no water.",
        "Look beyond the straight edge of the last water patch. Before, clouds and hills are "
        "mirrored in a sea that is not there; after, only the water mirrors. What is left beyond "
        "it is empty: the flat colour of glClearColor.",
        "The water surface is first drawn into the stencil buffer only (glStencilOp, with "
        "glColorMask off). The mirrored scene then passes the stencil test only where the water "
        "is. The preset `best` renders its mirror image to a texture and needs no stencil.",
        (
            "the edge of the sea, with mirrored clouds and hills in the void beyond it",
            "the same edge of the sea, with only the fog's colour beyond it",
        ),
        common={"fog.enabled": False, "sky.background": True, "sky.follow_y": True},
        only=("ground", "water", "sky", "reflection", "trees"),
    ),
)
