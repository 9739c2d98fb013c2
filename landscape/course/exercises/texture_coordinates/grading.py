"""The tests of the exercise texture_coordinates."""

from dataclasses import dataclass

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.triangles import triangles

FRAMES = (0, 2)
NEAR = 0.02  # chosen: by which a coordinate may be off


@dataclass
class Patch:
    """A quad of the wall, or a draw of another mode: its corners x, y, z and their s and t."""

    draw: object
    places: np.ndarray
    st: np.ndarray

    def at(self, axis, extreme):
        """Return s and t of the corners on one side, (n, 2): axis 0 and np.min for the left."""
        along = self.places[:, axis]
        return self.st[np.abs(along - extreme(along)) < NEAR]

    @property
    def sides(self):
        """The mean s and t at the left, right, bottom and top, (4, 2)."""
        sides = ((0, np.min), (0, np.max), (1, np.min), (1, np.max))
        return np.array([self.at(*side).mean(axis=0) for side in sides])


def patches(work, number=0):
    """Return the textured parts of the wall."""
    found = []
    for draw in work.frame(number).draws:
        if not draw.state["GL_TEXTURE0.GL_TEXTURE_2D"] or not len(triangles(draw)):
            continue
        matrix = np.array(draw.state["GL_TEXTURE0.GL_TEXTURE_MATRIX"]).reshape(4, 4).T
        st, size = (draw.texture @ matrix.T)[:, :2], len(draw.vertices)
        step = 4 if draw.mode == "GL_QUADS" else size
        for first in range(0, size - step + 1, step):
            some = slice(first, first + step)
            found.append(Patch(draw, draw.vertices[some, :3], st[some]))
    return found


def quads(work):
    """Return s and t at the left, right, bottom and top of each part, (n, 4, 2)."""
    return np.array([patch.sides for patch in patches(work)])


def right(work, solution):
    """Return whether the picture is right: then it does not matter how it came about."""
    return compare(work, solution) is None


def wraps(work, axis):
    """Return the calls that set GL_TEXTURE_WRAP_S or _T of the wall's texture, and of others."""
    used = patches(work)[0].draw.state["GL_TEXTURE0.GL_TEXTURE_BINDING_2D"]
    bound = 0
    own = []
    others = []
    later = [call for frame in work.frames.values() for call in frame.calls]
    for call in (*work.last.setup, *later):
        if call.is_("glBindTexture", "GL_TEXTURE_2D"):
            bound = call.args[1]
        if call.is_("glTexParameter", "GL_TEXTURE_2D", f"GL_TEXTURE_WRAP_{axis}"):
            (own if bound == used else others).append(call)
    return own, others


def wrap(work, axis):
    """Return how the texture goes on beyond 1; ``axis`` is S or T."""
    own = wraps(work, axis)[0]
    return own[-1].args[2] if own else "GL_REPEAT"


def after_its_vertex(work):
    """Return the first glTexCoord, if it comes after the glVertex to which it should belong."""
    calls = work.frame(0).calls
    begun = calls.index(patches(work)[0].draw.call)
    first = [call for call in calls[begun:] if call.base in ("glTexCoord", "glVertex")]
    if first and first[0].base == "glVertex":
        return next((call for call in first if call.base == "glTexCoord"), None)
    return None


@test(
    _("The wall has a texture"),
    _("GL_TEXTURE_2D is on while the wall is drawn, and each corner has a texture coordinate."),
)
def textured(work, solution):
    found = patches(work)
    if not found:
        return hint(_("The wall is drawn without GL_TEXTURE_2D."))
    ours = patches(solution)
    for each in (np.min, np.max):
        edges = [
            each(
                [each(patch.places @ patch.draw.modelview[:3, :3].T, axis=0) for patch in some],
                axis=0,
            )
            for some in (found, ours)
        ]
        if np.abs(edges[0] - edges[1]).max() > NEAR:
            return hint(
                _("The wall is no longer where it was: its corners and the view were right.")
            )

    if all(np.ptp(patch.st, axis=0).max() < NEAR for patch in found):
        return hint(
            _(
                "All corners have the same texture coordinate: glTexCoord must be called "
                "before each "
                "glVertex."
            )
        )

    return None


@test(
    _("The boats are upright"),
    _("The first row of the image, t = 0, is the top of the picture."),
    needs=textured,
)
def upright(work, solution):
    if right(work, solution):
        return None
    if late := after_its_vertex(work):
        return hint(
            _(
                "glTexCoord in line {line} comes after its glVertex, which has already taken the "
                "current coordinates: those of the previous corner."
            ),
            line=late.line,
        )

    bottom, top = quads(work).sum(axis=0)[2:]
    if abs(top[1] - bottom[1]) < NEAR:
        if abs(top[0] - bottom[0]) > NEAR:
            return hint(
                _(
                    "The picture lies on its side: along the wall t changes, and upwards s. Are s "
                    "and t swapped, or do COORDINATES begin at another corner than CORNERS?"
                )
            )
        return hint(_("t is the same above and below: it must go from 0 above to 1 below."))

    if top[1] > bottom[1]:
        return hint(
            _(
                "The boats are upside down: t grows from the lower edge to the upper one, but the "
                "first row of the image is the top."
            )
        )

    for patch in patches(work):
        for extreme, name in ((np.min, _("lower")), (np.max, _("upper"))):
            t = patch.at(1, extreme)[:, 1]
            if np.ptp(t) > NEAR:
                return hint(
                    _(
                        "The picture is slanted: along the {edge} edge t goes from {first:.2f} to "
                        "{last:.2f}, and must be the same at both corners."
                    ),
                    edge=name,
                    first=t[0],
                    last=t[1],
                )

    return None


@test(
    _("The boats sail to the left"),
    _("As in IMAGE, s must grow from the left to the right."),
    needs=upright,
)
def direction(work, solution):
    if right(work, solution):
        return None
    left, right_ = quads(work)[:, 0, 0], quads(work)[:, 1, 0]
    if np.all(right_ > left):
        return None
    return hint(_("The picture is mirrored: s must grow from the left corner to the right one."))


@test(
    _("There are three boats in a row"),
    _("Along the wall s runs over three pictures, and t over one."),
    needs=direction,
)
def three(work, solution):
    if right(work, solution):
        return None
    found = quads(work)
    lefts = [patch.places[:, 0].min() for patch in patches(work)]
    if len(found) > 1 and np.ptp(lefts) < NEAR:
        return hint(
            _(
                "The wall is drawn {count} times in the same place: each shows the same as the "
                "one before it."
            ),
            count=len(found),
        )

    along = (found[:, 1, 0] - found[:, 0, 0]).sum()
    up = np.abs(found[:, 3, 1] - found[:, 2, 1]).max()
    if up > 8:
        return hint(
            _(
                "From the lower to the upper edge t changes by {up:.0f}. Texture coordinates "
                "do not "
                "count pixels: the whole image goes from 0 to 1."
            ),
            up=up,
        )

    if abs(up - 3) < NEAR:
        return hint(_("The picture is repeated upwards, too: t goes from 0 to 1 only."))
    if abs(up - 1) > NEAR:
        return hint(
            _("From the lower to the upper edge t changes by {up:.2f}, and not by 1."), up=up
        )

    if abs(along - 1 / 3) < NEAR:
        return hint(
            _(
                "Only a third of the picture is visible: to repeat it three times, s must go to "
                "3, not to 1/3."
            )
        )

    if abs(along - 3) > NEAR:
        return hint(
            _(
                "Along the wall s changes by {along:.2f}, so the picture is there {along:.2f} "
                "times, "
                "and not three times."
            ),
            along=along,
        )

    return None


@test(
    _("The texture is repeated"),
    _("Beyond 1, GL_TEXTURE_WRAP_S decides."),
    needs=three,
)
def repeated(work, solution):
    if right(work, solution):
        return None
    found = quads(work)
    for axis, index, place in (("S", 0, slice(0, 2)), ("T", 1, slice(2, 4))):
        part, way = found[:, place, index], wrap(work, axis)
        inside = part.min() > -NEAR and part.max() < 1 + NEAR
        if inside or way == "GL_REPEAT":
            continue
        own, others = wraps(work, axis)
        if axis == "T":
            return hint(
                _(
                    "t goes from {least:.0f} to {most:.0f}. Outside 0 to 1 the edge of the picture "
                    "is drawn out: GL_TEXTURE_WRAP_T is {way}."
                ),
                least=part.min(),
                most=part.max(),
                way=way,
            )
        if way == "GL_MIRRORED_REPEAT":
            return hint(_("GL_MIRRORED_REPEAT mirrors every second boat: use GL_REPEAT."))
        if early := [call for call in own if call.args[2] == "GL_REPEAT"]:
            return hint(
                _("Line {line} repeats the texture, and line {later} sets GL_TEXTURE_WRAP_S anew."),
                line=early[-1].line,
                later=own[-1].line,
            )
        if other := [call for call in others if call.args[2] == "GL_REPEAT"]:
            return hint(
                _(
                    "Line {line} concerns the texture that is bound then, and the wall's is bound "
                    "later."
                ),
                line=other[-1].line,
            )
        if wrap(work, "T") == "GL_REPEAT":
            return hint(
                _(
                    "GL_TEXTURE_WRAP_T is GL_REPEAT now, which concerns t; but it is s that goes "
                    "beyond 1, and GL_TEXTURE_WRAP_S still is {way}."
                ),
                way=way,
            )
        return hint(
            _(
                "Beyond the first boat the edge of the picture is drawn out: GL_TEXTURE_WRAP_S is "
                "{way}."
            ),
            way=way,
        )

    return None


@test(
    _("The picture is right"),
    _("Each boat begins where the one before it ends."),
    needs=repeated,
)
def picture(work, solution):
    if right(work, solution):
        return None
    for patch in patches(work):
        start = patch.sides[0, 0]
        if abs(start - round(start)) > NEAR:
            return hint(
                _("The frieze begins in the middle of a boat: at the left edge s is {start:.2f}."),
                start=start,
            )

    for number in FRAMES:
        for patch in patches(work, number):
            color = patch.draw.colors.min(axis=0)
            if color[:3].min() < 1 - NEAR:
                return hint(
                    _(
                        "In frame {frame} the texture is multiplied by another colour than white, "
                        "{color}: that is the current one when the wall is drawn."
                    ),
                    frame=number,
                    color=", ".join(f"{channel:.2f}" for channel in color[:3]),
                )

    if compare(work, solution, box=WALL):
        return hint(
            _(
                "The coordinates are right, but the image is not: load it as before, with the "
                "same rows and filters."
            )
        )

    return compare(work, solution)


WALL = (0.2, 0.35, 0.8, 0.65)  # the middle of the wall: left, top, right, bottom
