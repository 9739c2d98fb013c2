"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant


def filtered(kind, value):
    """Return the line that sets a filter."""
    return f"    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_{kind}_FILTER, GL_{value})\n"


SMALL, LARGE = filtered("MIN", "LINEAR"), filtered("MAG", "LINEAR")
SIGN = "    load(np.array(texels, np.uint8))\n" + SMALL + filtered("MAG", "NEAREST")
WINDOW = "(top, bottom), np.uint8))\n" + SMALL + LARGE
BEST = filtered("MIN", "LINEAR_MIPMAP_LINEAR")
MIPMAPS = "    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE)\n"
FLOOR = BEST + LARGE + MIPMAPS
LOAD = "    load(image)\n"


def sign(*lines):
    return [(SIGN, "    load(np.array(texels, np.uint8))\n" + "".join(lines))]


def window(*lines):
    return [(WINDOW, "(top, bottom), np.uint8))\n" + "".join(lines))]


MUTANTS = {
    "only_larger": Mutant("sets only the larger filter", "sign", sign(filtered("MAG", "NEAREST"))),
    "sign_mipmaps": Mutant(
        "asks for mipmaps that are not there",
        "sign",
        sign(filtered("MIN", "NEAREST_MIPMAP_NEAREST"), filtered("MAG", "NEAREST")),
    ),
    "sign_smooth": Mutant("mixes the texels of the sign", "sign", sign(SMALL, LARGE)),
    "only_smaller": Mutant(
        "sets only the smaller filter", "sign", sign(filtered("MIN", "NEAREST"))
    ),
    "before_binding": Mutant(
        "sets the filters before it binds the texture",
        "sign",
        [
            *sign(),
            (
                "    glBindTexture(GL_TEXTURE_2D, SIGN)\n",
                SMALL + filtered("MAG", "NEAREST") + "    glBindTexture(GL_TEXTURE_2D, SIGN)\n",
            ),
        ],
    ),
    "window_squares": Mutant(
        "does not mix the texels of the window", "sky", window(SMALL, filtered("MAG", "NEAREST"))
    ),
    "window_white": Mutant(
        "asks for mipmaps of the window",
        "sky",
        window(filtered("MIN", "LINEAR_MIPMAP_LINEAR"), LARGE),
    ),
    "window_default": Mutant("sets no filter of the window", "sky", window(LARGE)),
    "floor_nearest": Mutant(
        "takes one texel", "floor", [(FLOOR, filtered("MIN", "NEAREST") + LARGE)]
    ),
    "floor_linear": Mutant("mixes four texels", "floor", [(FLOOR, SMALL + LARGE)]),
    "no_mipmaps": Mutant("asks for mipmaps and makes none", "floor", [(FLOOR, BEST + LARGE)]),
    "too_late": Mutant(
        "asks for mipmaps after the image", "floor", [(FLOOR + LOAD, BEST + LARGE + LOAD + MIPMAPS)]
    ),
    "one_level": Mutant(
        "makes one more level",
        "floor",
        [
            (
                FLOOR + LOAD,
                BEST + LARGE + LOAD + "    smaller = np.ascontiguousarray(image[::2, ::2])\n"
                "    glTexImage2D(GL_TEXTURE_2D, 1, GL_RGB, 16, 16, 0, GL_RGB, GL_UNSIGNED_BYTE, "
                "smaller)\n",
            )
        ],
    ),
    "one_texel": Mutant(
        "takes one texel of a mipmap", "floor", [(BEST, filtered("MIN", "NEAREST_MIPMAP_NEAREST"))]
    ),
    "near_squares": Mutant(
        "does not mix the texels of the floor",
        "floor",
        [(FLOOR, BEST + filtered("MAG", "NEAREST") + MIPMAPS)],
    ),
    "other_texture": Mutant(
        "binds the window's texture for the floor",
        "sky",
        [
            (
                "    glBindTexture(GL_TEXTURE_2D, FLOOR)\n",
                "    glBindTexture(GL_TEXTURE_2D, FLOOR)\n"
                "    glBindTexture(GL_TEXTURE_2D, WINDOW)\n",
            )
        ],
    ),
}
