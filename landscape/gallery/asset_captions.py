"""The gallery's captions for the assets of the report's figures.

A caption says first what to see, then the technique. Names of panels and fixes in it, such as
fig17b or R4, become links.
"""

# Panel name: (files, title, what is in the picture, what to look at).
ASSET_PANELS: dict[str, tuple[tuple[str, ...], str, str, str]] = {
    "fig1a": (
        ("height.png",),
        "the height image",
        "a grey relief map of an island, black where the sea is",
        "The lighter, the higher: a mountain in the north-west, the flat castle hill in the east, "
        "a bay in the south-west, islets all around. The file is 512 x 512 pixels (shown smaller "
        "here). It is grey, so its red channel alone gives the heights.",
    ),
    "fig3a": (
        ("ground_large.png",),
        "large-scale ground texture",
        "the island from above in colour: beaches, meadows, a rocky massif",
        "One texture covers the whole map: green where the land is low, brown and grey where it is "
        "high. The light and shade of the slopes are baked in.",
    ),
    "fig3b": (
        ("ground_detail.png",),
        "detail texture of the ground, tileable",
        "fine grey grain",
        "The grain of the soil, repeated many times over the map. Its mean is mid grey: the ground "
        "is multiplied by twice its value, so it becomes rougher but not darker.",
    ),
    "fig7a": (
        ("water.png",),
        "water texture, tileable",
        "pale green ripples",
        "The left edge continues the right one, and the bottom edge the top one, so that the "
        "texture tiles over the sea without a seam.",
    ),
    "fig12a": (
        ("sky_north.png", "sky_east.png", "sky_south.png", "sky_west.png", "sky_top.png"),
        "sky box texture, its five faces unfolded",
        "a cross of five pictures: blue sky in the middle, clouds and hills at the four ends",
        "The box unfolded and seen from inside: the ceiling in the middle, a wall on each side, "
        "with distant hills along its foot. There is no floor. The clouds continue across every "
        "edge.",
    ),
    "fig15a": (
        ("tree_broadleaf.png",),
        "tree billboard, first species",
        "a broadleaf tree on plain grey",
        "Grey stands for transparent here: a rectangle with this texture looks like a tree.",
    ),
    "fig15b": (
        ("tree_conifer.png",),
        "tree billboard, second species",
        "a conifer on plain grey",
        "Again, grey stands for transparent. Half of the trees, chosen at random, are mirrored.",
    ),
    "fig15c": (
        ("deer_stag.png",),
        "deer billboard",
        "a stag from its side on plain grey",
        "This is the only texture of the stag, so it shows its side wherever you stand.",
    ),
    "fig20a": (
        ("blade.png",),
        "texture of one blade of grass",
        "a small green square with stripes from top to bottom",
        "Dark at the foot, light at the tip. The texture needs no transparency, as the triangles "
        "of the blade cut out its shape (fig21a). The grey around it is only the background of "
        "this panel.",
    ),
    "fig23a": (
        ("castle_brick.png",),
        "castle brick texture, tileable",
        "grey-brown bricks",
        "Four repeats cover a castle wall, which is 17 metres wide.",
    ),
    "fig23b": (
        ("castle_door.png",),
        "castle door texture, transparent around the door",
        "a wooden door in a stone arch at the foot of a large empty square",
        "It is as large as the whole wall and is laid over the bricks. Where it is transparent "
        "(grey here), the bricks show through.",
    ),
    "fig23c": (
        ("castle_light.png",),
        "light texture: two yellowish halos",
        "two soft yellowish spots on pale blue-grey",
        "The colours of the wall are multiplied by it. They do not change in the two spots, where "
        "the torches are; the pale blue-grey, which is part of the texture, dims them only a "
        "little.",
    ),
    "fig24a": (
        ("torch_stone.png",),
        "stone of the torch holders",
        "dark stone with two bands of carved rings",
        "It is wrapped around the cone that holds a torch (fig25e).",
    ),
    "fig24b": (
        ("fire.png",),
        "fire sprite sheet, 4 x 4 frames",
        "sixteen small flames in four rows",
        "Read it like a page, row by row: played in this order, the frames are a flickering flame, "
        "and the last leads back to the first.",
    ),
    "fig26a": (
        ("animal.png",),
        "texture of the 3D animals",
        "pale overlapping scales with darker vertical stripes",
        "Look at the broad darker stripes: on the animals (fig28a, fig28b) they show which way the "
        "texture runs over the body, and where it is squeezed.",
    ),
    "fig30a": (
        ("sword_rest.png",),
        "sword at rest",
        "a gloved hand holding a sword, on plain grey",
        "The texture covers the whole window and is transparent (grey here) around the sword.",
    ),
    "fig31a": (
        ("sword_1.png",),
        "sword stroke, first frame",
        "the sword raised at the right border",
        "The first of the four frames of a stroke: the sword is raised to the right.",
    ),
    "fig31b": (
        ("sword_2.png",),
        "sword stroke, second frame",
        "the sword at the beginning of its swing",
        "The second frame: the swing begins.",
    ),
    "fig31c": (
        ("sword_3.png",),
        "sword stroke, third frame",
        "the sword across the middle, blurred",
        "The third frame: the sword crosses the middle. Its blur is painted.",
    ),
    "fig31d": (
        ("sword_4.png",),
        "sword stroke, fourth frame",
        "the sword low on the left",
        "The fourth frame: the stroke ends low on the left.",
    ),
}
