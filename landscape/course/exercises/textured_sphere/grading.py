"""The tests of the exercise textured_sphere."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import balanced, silent
from landscape.course.grader.triangles import triangles

FRAMES = (0, 1, 2, 3, 4)
EVENTS = [
    {"frame": frame, "key": key, "action": action}
    for frame, keys in {1: "RRR", 2: "RRRU", 3: "RRRUU", 4: "DDDDD"}.items()
    for key in ({"R": "RIGHT", "U": "UP", "D": "DOWN"}[letter] for letter in keys)
    for action in ("press", "release")
]
COLUMNS, ROWS = 24, 16
COS, SIN = np.cos(np.radians(20)), np.sin(np.radians(20))
CAMERA = np.array(((1, 0, 0, 0), (0, COS, -SIN, 0), (0, SIN, COS, 0), (0, 0, 0, 1)))
NEAR = 0.004  # chosen: by which a coordinate may be another one


def vertices(work):
    """Return x, y, z of the vertices of a frame, and their s, t: (n, 3) and (n, 2)."""
    places, coordinates = [], []
    for draw in work.frame(0).draws:
        matrix = np.array(draw.state["GL_TEXTURE0.GL_TEXTURE_MATRIX"]).reshape(4, 4).T
        turned = np.linalg.inv(CAMERA) @ draw.modelview
        places.append((draw.vertices @ turned.T)[:, :3])
        coordinates.append((draw.texture @ matrix.T)[:, :2])
    return np.concatenate(places), np.concatenate(coordinates)


def along(places):
    """Return s and t of points of the ball as they should be; s is from 0 to 1, without 1."""
    x, y, z = places.T
    s = np.round(np.arctan2(-z, x) / (2 * np.pi) * COLUMNS) % COLUMNS / COLUMNS
    return s, np.arccos(np.clip(y, -1, 1)) / np.pi


def off_poles(places):
    return np.abs(places[:, 1]) < 0.999


def turns(values, wanted, whole=1.0):
    """Return whether values are the wanted ones, but for whole turns."""
    return bool(np.abs((values - wanted + whole / 2) % whole - whole / 2).max() < NEAR)


def near(one, other):
    return bool(np.abs(one - other).max() < NEAR)


def last_strip(work):
    """Return whether a face lies between the last column of vertices and the first one."""
    for draw in work.frame(0).draws:
        places = (draw.vertices @ (np.linalg.inv(CAMERA) @ draw.modelview).T)[:, :3]
        columns = np.round(along(places)[0] * COLUMNS).astype(int)
        kept = off_poles(places)
        for each in triangles(draw):
            if {0, COLUMNS - 1} <= set(columns[each][kept[each]]):
                return True
    return False


def after_vertex(work):
    """Return whether each texture coordinate is given after its vertex."""
    names = [
        call.base
        for call in work.frame(0).calls
        if call.base in ("glTexCoord", "glVertex", "glBegin")
    ]
    return names[1:3] == ["glVertex", "glTexCoord"] if len(names) > 2 else False


@test(
    _("The north of the map is in the north"),
    _("t is the part of the way from the north pole to the south pole, as an angle."),
)
def north(work, solution):
    if silent(work, solution):
        return None
    places, coordinates = vertices(work)
    wanted_s, wanted = along(places)
    s, t = coordinates.T
    if near(coordinates, coordinates[0]):
        return hint(
            _(
                "The planet has the colour of a single texel: all its vertices have the same "
                "texture coordinates, ({s:.2f}, {t:.2f})."
            ),
            s=s[0],
            t=t[0],
        )

    if after_vertex(work):
        return hint(
            _(
                "Each vertex has the texture coordinates of the one before it: glTexCoord must "
                "come before glVertex."
            )
        )

    if near(s, wanted) and turns(t[off_poles(places)], wanted_s[off_poles(places)]):
        return hint(
            _(
                "The map lies on its side: its rows go from pole to pole. s belongs to the "
                "longitude and t to the way from the north to the south."
            )
        )

    if near(t, 1 - wanted):
        return hint(
            _(
                "The map is upside down: t is 0 at the south pole, and the first row of MAP is the "
                "north."
            )
        )

    if near(t, (1 - places[:, 1]) / 2):
        return hint(
            _(
                "The map is stretched at the poles, and the rows are too narrow at the equator: t "
                "grows with the height, and should grow with the angle."
            )
        )

    if near(t, wanted * np.pi):
        return hint(
            _(
                "The whole map is squeezed around the north pole, and all the rest is its last "
                "row: t goes up to {t:.2f}, as it is the angle itself."
            ),
            t=t.max(),
        )

    if near(t, places[:, 1]):
        return hint(
            _(
                "The southern half of the planet has a single row of the map: t goes down to -1, "
                "as y does."
            )
        )

    if near(t, wanted / 2):
        return hint(
            _("The planet has only the northern half of the map, twice as high: t ends at 0.5.")
        )

    if not near(t, wanted):
        first = int(np.argmax(np.abs(t - wanted)))
        x, y, z = places[first]
        return hint(
            _("The vertex ({x:.2f}, {y:.2f}, {z:.2f}) has t = {t:.2f}, and not {wanted:.2f}."),
            x=x,
            y=y,
            z=z,
            t=t[first],
            wanted=wanted[first],
        )

    return None


@test(
    _("The map goes east"),
    _("s is the part of a whole turn around the axis, from longitude 0 on."),
    needs=north,
)
def east(work, solution):
    if silent(work, solution):
        return None
    places, coordinates = vertices(work)
    kept = off_poles(places)
    s, wanted = coordinates[kept, 0], along(places[kept])[0]
    if turns(s, 360 * wanted, 360) and s.max() > 100:
        return hint(_("The map goes around the planet hundreds of times: s is in degrees."))
    if near(s, s[0]) or near(s % 1, 0 * s):
        return hint(
            _(
                "Along each parallel the planet has one colour: s is a whole number everywhere. "
                "What does the division of two whole numbers give?"
            )
        )

    if turns(s, -wanted):
        return hint(_("The map is mirrored, and goes west: s must grow with the longitude."))
    if turns(s, wanted * 2 * np.pi, 2 * np.pi):
        return hint(
            _(
                "The map goes around the planet more than six times: s is the angle itself, and "
                "not its part of a whole turn."
            )
        )

    if turns(s, 2 * wanted, 2) and s.max() > 1.5:
        return hint(_("The map goes around the planet twice: a whole turn is two pi, and not pi."))
    if near(s, (places[kept, 0] + 1) / 2):
        return hint(
            _(
                "The map is seen from both sides, mirrored on one of them: s follows x, and goes "
                "back behind the planet. It should follow the longitude."
            )
        )

    shift = (s - wanted)[0] % 1
    if turns(s, wanted + shift) and shift > NEAR:
        return hint(
            _("The map is turned by {part:.2f} of a whole turn: s must be 0 in column 0."),
            part=min(shift, 1 - shift),
        )

    return None


@test(
    _("The map has no seam and no gap"),
    _("The last strip ends with vertices of its own, in the places of the first ones, with s = 1."),
    needs=east,
)
def closed(work, solution):
    if silent(work, solution):
        return None
    places, coordinates = vertices(work)
    kept = off_poles(places)
    s, wanted = coordinates[kept, 0], along(places[kept])[0]
    first = np.abs(wanted) < NEAR
    if near(s, wanted):
        if last_strip(work):
            return hint(
                _(
                    "In the last strip the whole map is squeezed together, mirrored: there s goes "
                    "back from {s:.2f} to 0. The same place needs a second vertex, with another s."
                ),
                s=s.max(),
            )
        return hint(
            _(
                "Between the last column and the first one there is a gap: {count} columns of "
                "vertices make one strip less."
            ),
            count=COLUMNS,
        )

    for factor, text in (
        (
            COLUMNS / (COLUMNS + 1),
            _(
                "The map is not closed: it ends with s = {s:.2f}, so that a "
                "part of it is missing where it should meet its beginning."
            ),
        ),
        (
            COLUMNS / (COLUMNS - 1),
            _("The map ends too early, and begins again: s goes up to {s:.2f} in one turn."),
        ),
    ):
        if near(s[~first], wanted[~first] * factor):
            return hint(text, s=s.max())

    return None


@test(
    _("The picture is right"),
    _("From all sides, and from both poles."),
    needs=closed,
)
def picture(work, solution):
    return compare(work, solution)


stacks = balanced(needs=picture)
