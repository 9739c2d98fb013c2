"""The tests of the exercise texture_filters."""

from dataclasses import dataclass, field

import numpy as np

from landscape.course.grader.grading import _, compare, differing, hint, test
from landscape.course.grader.mistakes import balanced
from landscape.course.grader.triangles import covered

FRAMES = (0, 1, 2)
EVENTS = [
    {"frame": frame, "key": key, "action": action}
    for frame, keys in {1: ("UP",) * 9, 2: ("DOWN",) * 14}.items()
    for key in keys
    for action in ("press", "release")
]
FILTERS = {
    0x2600: "GL_NEAREST",
    0x2601: "GL_LINEAR",
    0x2700: "GL_NEAREST_MIPMAP_NEAREST",
    0x2701: "GL_LINEAR_MIPMAP_NEAREST",
    0x2702: "GL_NEAREST_MIPMAP_LINEAR",
    0x2703: "GL_LINEAR_MIPMAP_LINEAR",
}
MIN = "GL_TEXTURE_MIN_FILTER"
MAG = "GL_TEXTURE_MAG_FILTER"
GENERATE = "GL_GENERATE_MIPMAP"
BOUND = "GL_TEXTURE0.GL_TEXTURE_BINDING_2D"
THINGS = ("floor", "sign", "window")
MOST = 0.004  # chosen: the fraction of a thing's pixels that may differ


@dataclass
class Texture:
    """What was asked for a texture, and the levels that it has; all of them if ``complete``."""

    filters: dict = field(default_factory=dict)
    levels: list = field(default_factory=list)
    complete: bool = False
    generates: bool = False
    too_late: int = 0

    @property
    def smaller(self):
        return self.filters.get(MIN, ("GL_NEAREST_MIPMAP_LINEAR", 0))

    @property
    def larger(self):
        return self.filters.get(MAG, ("GL_LINEAR", 0))

    @property
    def white(self):
        """Whether it is not used, as it lacks mipmaps."""
        return "MIPMAP" in self.smaller[0] and not self.complete


def textures(work):
    """Return the textures by their names, as the calls have left them."""
    found, bound = {0: Texture()}, 0
    later = [call for frame in work.frames.values() for call in frame.calls]
    for call in (*work.last.setup, *later):
        now = found.setdefault(bound, Texture())
        if call.is_("glBindTexture"):
            bound = call.args[1]
        elif call.base == "glTexParameter":
            name, value = call.args[1], call.args[2]
            value = value[0] if isinstance(value, list) else value
            if name in (MIN, MAG):
                value = value if isinstance(value, str) else FILTERS.get(int(value), str(value))
                now.filters[name] = value, call.line
            if name == GENERATE:
                now.generates = value not in (0, "GL_FALSE")
                now.too_late = call.line if now.levels else 0
        elif call.name == "glTexImage2D":
            level = call.args[1]
            now.levels.append(level)
            now.complete = now.generates or len({*now.levels}) > 5
        elif call.name.startswith(("glGenerateMipmap", "gluBuild2DMipmaps")):
            now.complete = True

    return found


def things(work, number=0):
    """Return the draws of the floor, the sign and the window, by where they are."""
    found = {}
    for draw in work.frame(number).draws:
        if not len(draw.vertices):
            continue
        x, y, _z = draw.vertices[:, :3].mean(axis=0)
        found["floor" if y < -0.9 else "sign" if x < 0 else "window"] = draw
    return found


def texture_of(work, thing):
    """Return the texture of a thing; None where it is not known, or where two things share one."""
    draw = things(work).get(thing)
    names = [each.state[BOUND] for each in things(work).values()]
    if draw is None or not draw.call.way or len(set(names)) < len(THINGS):
        return None
    return textures(work).get(draw.state[BOUND], Texture())


def place(solution, thing, number):
    """Return the pixels that show a thing in a frame of the solution."""
    height, width = solution.frame(number).picture.shape[:2]
    draws = things(solution, number)
    if thing == "floor":
        others = covered([draws["sign"], draws["window"]], height, width)
        below = np.zeros((height, width), bool)
        below[height // 2 + 4 :] = True
        return below & ~others
    return covered([draws[thing]], height, width)


def right(work, solution, thing):
    """Return whether the pixels of a thing are right in all frames."""
    for number in FRAMES:
        wrong = differing(work.frame(number), solution.frame(number))
        area = place(solution, thing, number)
        if (wrong & area).sum() > MOST * area.sum():
            return False
    return True


@test(
    _("The sign has sharp texels"),
    _("Near the camera each of its texels covers many pixels."),
)
def sign(work, solution):
    if right(work, solution, "sign"):
        return None
    texture = texture_of(work, "sign")
    if texture is None:
        return None
    if texture.white:
        unbound = textures(work)[0]
        if unbound.filters and not texture.filters:
            return hint(
                _(
                    "The sign is white: line {line} sets a filter before the texture is bound, so "
                    "it is set for another one."
                ),
                line=[*unbound.filters.values()][-1][1],
            )
        if MIN in texture.filters:
            return hint(
                _("The sign is white: {value} in line {line} needs mipmaps, and it has none."),
                value=texture.smaller[0],
                line=texture.smaller[1],
            )
        if MAG in texture.filters:
            return hint(
                _(
                    "The sign is white, though it is made larger here: GL_TEXTURE_MIN_FILTER asks "
                    "for mipmaps from the beginning, and a texture without them is never used."
                )
            )
        return hint(
            _(
                "The sign is white: no filter is set for its texture, and the one that OpenGL "
                "begins with needs mipmaps."
            )
        )

    if texture.larger[0] == "GL_LINEAR":
        if MAG in texture.filters:
            return hint(
                _(
                    "The arrow is blurred: line {line} lets the sign's texels be mixed where they "
                    "are made larger."
                ),
                line=texture.larger[1],
            )
        return hint(
            _(
                "The arrow is blurred: only the filter for shrinking is set, and the other one "
                "starts as GL_LINEAR."
            )
        )

    return None


@test(
    _("The window is smooth"),
    _("Between its four texels, all colours are mixed."),
    needs=sign,
)
def sky(work, solution):
    if right(work, solution, "window"):
        return None
    texture = texture_of(work, "window")
    if texture is None:
        return None
    if texture.levels.count(0) > 1:
        return hint(
            _(
                "The window shows the wrong image: two images have been loaded into its texture. "
                "Which one is bound in make_floor?"
            )
        )

    if texture.white:
        if MIN in texture.filters:
            return hint(
                _("The window is white: its filter {value}, of line {line}, needs mipmaps."),
                value=texture.smaller[0],
                line=texture.smaller[1],
            )
        return hint(
            _(
                "The window is white: GL_TEXTURE_MIN_FILTER is not set for its texture. Each "
                "texture has filters of its own."
            )
        )

    if texture.larger[0] == "GL_NEAREST":
        return hint(
            _("The window consists of squares: line {line} takes the nearest texel for it."),
            line=texture.larger[1],
        )

    return None


@test(
    _("The floor fades in the distance"),
    _("A mipmap already holds the mean of the texels that a pixel covers."),
    needs=sky,
)
def floor(work, solution):
    if right(work, solution, "floor"):
        return None
    texture = texture_of(work, "floor")
    if texture is None:
        return None
    if texture.white:
        if texture.too_late:
            return hint(
                _(
                    "The floor is white: GL_GENERATE_MIPMAP is set in line {line}, when its image "
                    "is loaded already. Mipmaps are made when an image is loaded."
                ),
                line=texture.too_late,
            )
        count = len({*texture.levels})
        if count > 1:
            return hint(
                _(
                    "The floor is white: it has {count} levels, and they must go on to one of a "
                    "single texel."
                ),
                count=count,
            )
        if MIN in texture.filters:
            return hint(
                _(
                    "The floor is white: its filter needs mipmaps, and none are made. OpenGL makes "
                    "them if it is asked to before the image is loaded."
                )
            )
        return hint(_("The floor is white: no filter is set for its texture."))

    if "MIPMAP" not in texture.smaller[0]:
        if texture.smaller[0] == "GL_LINEAR":
            return hint(
                _(
                    "The floor is restless in the distance: line {line} mixes four texels for a "
                    "pixel, and a pixel covers many more there."
                ),
                line=texture.smaller[1],
            )
        return hint(
            _(
                "The floor is noise in the distance: line {line} takes one of the many texels that "
                "a pixel covers."
            ),
            line=texture.smaller[1],
        )

    if texture.larger[0] == "GL_NEAREST":
        return hint(
            _(
                "Near the camera the borders of the floor's tiles are jagged: line {line} takes "
                "the nearest texel there."
            ),
            line=texture.larger[1],
        )

    if texture.smaller[0].startswith("GL_NEAREST"):
        return hint(
            _(
                "The tiles of the floor are jagged: the filter of line {line} takes one texel of a "
                "mipmap, and does not mix four."
            ),
            line=texture.smaller[1],
        )

    return None


@test(
    _("The picture is right"),
    _("From near and from far."),
    needs=floor,
)
def picture(work, solution):
    return compare(
        work,
        solution,
        regions=lambda number: {
            _("the floor"): place(solution, "floor", number),
            _("the sign"): place(solution, "sign", number),
            _("the window"): place(solution, "window", number),
        },
    )


stacks = balanced(needs=picture)
