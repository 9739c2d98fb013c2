"""What a scene's page of the gallery says: its introduction, and two texts for each view."""

# The title, then the paragraphs before the first picture.
INTRODUCTIONS: dict[str, tuple[str, ...]] = {
    "hall": (
        "The great hall",
        "The castle's door leads into a hall for the classic effects of fixed-function OpenGL: "
        "those of Mark Kilgard's examples and of the SIGGRAPH courses of 1996 and 1997, as the "
        "notes on glSkel describe them. `landscape walk hall` begins here; the digit keys turn "
        "each effect on and off.",
        "Each effect needs safeguards. The second part of this page takes away one at a time, and "
        "shows what it prevents. Each is a setting, and its name is also that of a view: after "
        "`landscape walk mirror_stencil`, V turns it off and on.",
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
            "Seven transparent sheets drift in different directions; they are blended from far to "
            "near, and densest over the water.",
        ),
        "hall_exhibits": (
            "a wall with a row of lit alcoves, in the first of them a torch and a bronze knot",
            "Six exhibits: shadow volume, soft shadow, motion blur, depth of field, hidden lines, "
            "solids. Each is drawn with its effect when one is near, and without it from afar.",
        ),
        "hall_exhibit_volume": (
            "a bronze knot beside a torch, and its black shadow on the walls of an alcove",
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
}

PAIRS_TEXT = (
    "The left picture is drawn without the safeguard, the right one with it. Nothing else differs."
)
