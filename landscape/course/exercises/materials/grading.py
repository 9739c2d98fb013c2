"""The tests of the exercise materials."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test
from landscape.course.grader.mistakes import balanced
from landscape.course.grader.triangles import covered

FRAMES = (0, 1, 2)
EVENTS = [
    {"frame": frame, "key": key, "action": action}
    for frame, keys in {1: ("RIGHT",) * 4, 2: ("LEFT",) * 13}.items()
    for key in keys
    for action in ("press", "release")
]
BALLS = (
    _("the ball of clay"),
    _("the ball of copper"),
    _("the ball of amber"),
    _("the ball of chalk"),
)
DEFAULT = {
    "GL_AMBIENT": (0.2, 0.2, 0.2),
    "GL_DIFFUSE": (0.8, 0.8, 0.8),
    "GL_SPECULAR": (0, 0, 0),
    "GL_EMISSION": (0, 0, 0),
}
NEAR = 0.01  # chosen: by which a value may be another one


def balls(work, number=0):
    """Return the draws of each of the four balls, by where they are."""
    found = [[], [], [], []]
    for draw in work.frame(number).draws:
        if len(draw.vertices):
            place = np.linalg.inv(CAMERA) @ (*(draw.eye.min(axis=0) + draw.eye.max(axis=0)) / 2, 1)
            found[int(np.clip(round((place[0] + 3.45) / 2.3), 0, 3))].append(draw)
    return found


def turned(degrees, axis):
    """Return the matrix of a rotation around x or y, (4, 4)."""
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    first, second = ((1, 2), (2, 0))[axis]
    matrix = np.identity(4)
    matrix[[first, first, second, second], [first, second, first, second]] = cos, -sin, sin, cos
    return matrix


CAMERA = turned(25, 0)


def values(work, name, face="GL_FRONT"):
    """Return a value of the material of each ball, (4, n); None where it cannot be seen.

    OpenGL's state is not known inside display lists.
    """
    found = []
    for draws in balls(work):
        if not draws or not draws[0].call.way:
            return None
        value = np.atleast_1d(draws[0].state[f"{face}.{name}"])
        found.append(value[:3])
    return np.array(found, float)


def same(one, other):
    return one is not None and other is not None and np.abs(one - other).max() < NEAR


def light(work, name, number=0):
    """Return a value of GL_LIGHT1; None if it cannot be seen."""
    draws = [draw for draw in work.frame(number).draws if draw.call.way]
    return np.array(draws[0].state[f"GL_LIGHT1.{name}"], float) if draws else None


def right(work, solution):
    return compare(work, solution) is None


def first_wrong(work, solution, name):
    """Return the first ball that has another value than the solution's, and this value."""
    got, wanted = values(work, name), values(solution, name)
    if got is None:
        return None
    for ball, one, other in zip(BALLS, got, wanted):
        if np.abs(one - other).max() > NEAR:
            return ball, one
    return None


def told(ball, value, text):
    """Return the hint for a value of a ball."""
    return hint(text, ball=ball, value=", ".join(f"{each:.2f}" for each in value))


@test(
    _("The balls have their colours"),
    _("The diffuse reflection is what the lamp lights; the ambient one is seen in the shade."),
)
def body(work, solution):
    if right(work, solution):
        return None
    diffuse, ambient = values(work, "GL_DIFFUSE"), values(work, "GL_AMBIENT")
    if diffuse is None:
        return None
    wanted, shade = (values(solution, name) for name in ("GL_DIFFUSE", "GL_AMBIENT"))
    plain = same(diffuse, DEFAULT["GL_DIFFUSE"]) and same(ambient, DEFAULT["GL_AMBIENT"])
    if plain and same(values(work, "GL_DIFFUSE", "GL_BACK"), wanted):
        return hint(
            _(
                "The balls have no colours of their own: the material of their back faces is set, "
                "and their front faces are seen."
            )
        )

    if plain and work.last.find("glColor"):
        return hint(
            _(
                "The balls have no colours of their own: with GL_LIGHTING on, the current colour "
                "has no effect. What reflects light is the material."
            )
        )

    if plain:
        return hint(
            _(
                "The balls have no colours of their own: their material is the one that OpenGL "
                "begins with."
            )
        )

    if same(diffuse, shade) and same(ambient, wanted):
        return hint(
            _(
                "The balls are dark in the light, and bright in the shade: ambient and diffuse "
                "reflection have changed places."
            )
        )

    if same(diffuse, wanted) and same(ambient, DEFAULT["GL_AMBIENT"]):
        return hint(
            _(
                "In the shade the balls have no colours of their own: their ambient reflection is "
                "still the one that OpenGL begins with."
            )
        )

    if same(ambient, shade) and same(diffuse, DEFAULT["GL_DIFFUSE"]):
        return hint(
            _(
                "In the light the balls have no colours of their own: their diffuse reflection is "
                "still the one that OpenGL begins with."
            )
        )

    if same(diffuse, wanted) and same(ambient, wanted):
        return hint(
            _(
                "The shade of the balls is too bright: their ambient reflection is the whole "
                "colour, and not 0.4 times the colour."
            )
        )

    if wrong := first_wrong(work, solution, "GL_DIFFUSE"):
        return told(*wrong, _("The diffuse reflection of {ball} is {value}, and not its colour."))
    if wrong := first_wrong(work, solution, "GL_AMBIENT"):
        return told(*wrong, _("The ambient reflection of {ball} is {value}."))
    return None


@test(
    _("The highlights are right"),
    _("The specular reflection is their colour; the greater the shininess, the smaller they are."),
    needs=body,
)
def highlights(work, solution):
    if right(work, solution):
        return None
    specular, shininess = values(work, "GL_SPECULAR"), values(work, "GL_SHININESS")
    if specular is None:
        return None
    wanted, hard = values(solution, "GL_SPECULAR"), values(solution, "GL_SHININESS")
    if not same(specular, wanted):
        if same(specular, DEFAULT["GL_SPECULAR"]):
            return hint(_("No ball has a highlight: their specular reflection is black."))
        if same(specular, values(solution, "GL_DIFFUSE")):
            return hint(
                _(
                    "The highlights have the colour of the balls, and chalk has one, too: the "
                    "specular reflection is a value of its own."
                )
            )
        if same(specular[:3], wanted[:3]) and same(specular[3], wanted[2]):
            return hint(
                _(
                    "The ball of chalk shines like the one before it: a material stays as it is "
                    "until it is set again, also to black."
                )
            )
        return told(
            *first_wrong(work, solution, "GL_SPECULAR"),
            _("The specular reflection of {ball} is {value}."),
        )

    if same(shininess, np.zeros((4, 1))):
        return hint(
            _("The highlights cover all that the lamp lights: the shininess is 0 for all balls.")
        )

    if same(shininess, hard / 128):
        return hint(
            _("The highlights are far too large: shininess is not counted up to 1, but up to 128.")
        )

    if wrong := first_wrong(work, solution, "GL_SHININESS"):
        return told(*wrong, _("The shininess of {ball} is {value}."))
    return None


@test(
    _("Only the ball of amber glows"),
    _("The emission is added to the light that is reflected."),
    needs=highlights,
)
def glows(work, solution):
    if right(work, solution):
        return None
    emission, wanted = values(work, "GL_EMISSION"), values(solution, "GL_EMISSION")
    if emission is None or same(emission, wanted):
        return None
    if same(emission, DEFAULT["GL_EMISSION"]):
        return hint(_("The ball of amber does not glow: no emission is set."))
    if same(emission, values(solution, "GL_DIFFUSE")):
        return hint(_("All balls glow, as their emission is their colour."))
    if same(emission[:3], wanted[:3]) and same(emission[3], wanted[2]):
        return hint(
            _(
                "The ball of chalk glows like the one before it: the emission, too, stays as it is "
                "until it is set again."
            )
        )

    return told(
        *first_wrong(work, solution, "GL_EMISSION"), _("The emission of {ball} is {value}.")
    )


@test(
    _("The sky lights the balls from above"),
    _("A light whose position ends with 0 is a direction, and the modelview matrix turns it."),
    needs=glows,
)
def sky(work, solution):
    if right(work, solution) or light(work, "GL_DIFFUSE") is None:
        return None
    draws = [draw for draw in work.frame(0).draws if draw.call.way]
    if not draws[0].state["GL_LIGHT1"]:
        return hint(_("The balls are not lit from above: GL_LIGHT1 is off while they are drawn."))
    diffuse, ambient, specular = (
        light(work, name)[:3] for name in ("GL_DIFFUSE", "GL_AMBIENT", "GL_SPECULAR")
    )
    if ambient.max() > NEAR:
        return hint(
            _(
                "The sky lights the balls from all sides, also from below: its light is ambient, "
                "{value}, and it should have none of that."
            ),
            value=", ".join(f"{each:.2f}" for each in ambient),
        )

    if specular.max() > NEAR:
        return hint(_("The balls have a second highlight, at the top: that of the sky's light."))
    if diffuse.max() < NEAR:
        return hint(
            _(
                "The sky is dark: GL_LIGHT1 is on, but all lights except GL_LIGHT0 begin with "
                "black for their diffuse light."
            )
        )

    places = [light(work, "GL_POSITION", number) for number in FRAMES]
    ways = [light(solution, "GL_POSITION", number) for number in FRAMES]
    if abs(places[0][3]) > NEAR:
        return hint(
            _(
                "The light of the sky comes from a place in the middle of the scene, and not from "
                "a direction: the fourth number of its position is {w:.0f}."
            ),
            w=places[0][3],
        )

    if all(same(place, (0, 0, 1, 0)) for place in places):
        return hint(
            _(
                "The light of the sky comes from the camera: that is the direction which OpenGL "
                "begins with."
            )
        )

    if all(same(place[:3], -way[:3]) for place, way in zip(places, ways)):
        return hint(_("The light of the sky comes from below."))
    if all(same(place, (0, 1, 0, 0)) for place in places):
        return hint(
            _(
                "The light comes from above in the picture, and not in the scene: its position is "
                "set before the camera is placed."
            )
        )

    if not same(diffuse, light(solution, "GL_DIFFUSE")[:3]):
        return hint(
            _("The diffuse light of the sky is {value}, and not SKY."),
            value=", ".join(f"{each:.2f}" for each in diffuse),
        )

    return None


def regions(solution, number):
    """Return the pixels of each ball."""
    height, width = solution.frame(number).picture.shape[:2]
    return {
        name: covered(draws, height, width) for name, draws in zip(BALLS, balls(solution, number))
    }


@test(
    _("The picture is right"),
    _("Also when the camera has been carried around."),
    needs=sky,
)
def picture(work, solution):
    return compare(
        work, solution, regions=lambda number: {} if number else regions(solution, number)
    )


stacks = balanced(needs=picture)
