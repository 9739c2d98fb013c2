"""The tests of the exercise fog."""

import math

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test, vertices

FRAMES = (0, 1)
FOG = (0.82, 0.78, 0.72)
HALF = 25
DENSITY = math.sqrt(math.log(2)) / HALF
CLOSE = 0.02  # chosen: the relative error of the density
NEAR = 0.02  # chosen: by which a channel of a colour may be off


def line(work, name, *first):
    """Return the line of the last call of a function; 0 without one."""
    calls = work.find(name, *first)
    return calls[-1].line if calls else 0


def same(color, other):
    return np.abs(np.array(color[:3]) - other[:3]).max() < NEAR


def rounded(color):
    red, green, blue = color[:3]
    return hint(_("{red:.2f}, {green:.2f}, {blue:.2f}"), red=red, green=green, blue=blue)


@test(
    _("The fog is on while the bay is drawn"),
    _("GL_FOG concerns each thing that is drawn while it is enabled."),
)
def fogged(work, solution):
    for number in FRAMES:
        if vertices(work.frame(number)) < vertices(solution.frame(number)):
            return hint(
                _(
                    "In frame {frame} a part of the bay is not drawn. Leave nothing out: the fog "
                    "hides it."
                ),
                frame=number,
            )
        draws = work.frame(number).draws
        clear = [draw for draw in draws if not draw.state["GL_FOG"]]
        if not clear:
            continue
        if not work.find("glEnable", "GL_FOG") and not work.find("glFog"):
            return hint(
                _(
                    "There is no fog yet: glEnable turns it on, and glFog sets its mode, density "
                    "and colour."
                )
            )
        if not work.find("glEnable", "GL_FOG"):
            return hint(
                _("glEnable(GL_FOG) is missing: without it the other calls have no effect.")
            )
        if len(clear) < len(draws):
            return hint(
                _(
                    "Of {all} things that are drawn, {count} are drawn without fog: GL_FOG is on "
                    "for a part of them only."
                ),
                all=len(draws),
                count=len(clear),
            )
        return hint(
            _(
                "GL_FOG is enabled in line {line}, but not yet, or no longer, when the bay is "
                "drawn in frame {frame}."
            ),
            line=line(work, "glEnable", "GL_FOG"),
            frame=number,
        )

    return None


@test(
    _("The mode is GL_EXP2"),
    _("GL_FOG_MODE says by which formula the fog grows with the distance."),
    needs=fogged,
)
def mode(work, solution):
    found = work.last.draws[0].state["GL_FOG_MODE"]
    if found == "GL_EXP2":
        return None
    if at := line(work, "glFog", "GL_FOG_MODE"):
        return hint(
            _("Line {line} sets the mode {mode}, whose formula is another one."),
            line=at,
            mode=found,
        )
    return hint(
        _("GL_FOG_MODE is not set. Without that it is {mode}, which has another formula."),
        mode=found,
    )


@test(
    _("At the distance HALF one half remains"),
    _("exp(-(density * HALF) ** 2) must be 0.5."),
    needs=mode,
)
def density(work, solution):
    found = work.last.draws[0].state["GL_FOG_DENSITY"]
    if abs(found / DENSITY - 1) < CLOSE:
        return None

    at = line(work, "glFog", "GL_FOG_DENSITY")
    if not at:
        return hint(_("GL_FOG_DENSITY is not set. Without that it is 1, and all is fog at once."))

    wrong = {
        math.log(2) / HALF: _(
            "The density of line {line} solves exp(-density * HALF) = 0.5. That is GL_EXP: in "
            "GL_EXP2 the product is squared."
        ),
        math.log(2): _("The density of line {line} does not depend on HALF."),
        math.log(2) / HALF**2: _(
            "The density of line {line} is squared still: solve (density * HALF) ** 2 = log(2)."
        ),
        0.5 / HALF: _(
            "In line {line} one half is taken for density * HALF. It is f that is one half: solve "
            "f = 0.5 for the density, with a logarithm."
        ),
        math.sqrt(0.5) / HALF: _(
            "In line {line} one half is taken for (density * HALF) ** 2. It is f that is one half: "
            "the exponent is its logarithm."
        ),
        math.sqrt(math.log10(2)) / HALF: _(
            "Line {line} takes the logarithm to base 10. exp is undone by math.log."
        ),
        1 / HALF: _("With the density of line {line}, 1 / e remains at HALF, and not 1 / 2."),
    }

    for value, text in wrong.items():
        if abs(found / value - 1) < CLOSE / 4:
            return hint(text, line=at)
    return hint(
        _("With the density of line {line}, {percent:.1f} % of a colour remain at HALF, not 50 %."),
        line=at,
        percent=100 * math.exp(-min((found * HALF) ** 2, 700)),
    )


@test(
    _("The fog has the colour FOG"),
    _("Where f is 0, only GL_FOG_COLOR remains."),
    needs=density,
)
def color(work, solution):
    found = work.last.draws[0].state["GL_FOG_COLOR"]
    if same(found, FOG):
        return None
    if at := line(work, "glFog", "GL_FOG_COLOR"):
        return hint(
            _("Line {line} sets the fog's colour to {color}, not to FOG."),
            line=at,
            color=rounded(found),
        )
    return hint(_("GL_FOG_COLOR is not set. Without that the fog is black."))


@test(
    _("The sky has the fog's colour"),
    _("Otherwise far things stand out against the sky, as if cut out of paper."),
    needs=color,
)
def sky(work, solution):
    for number in FRAMES:
        clears = work.frame(number).find("glClear")
        if same(clears[0].state["GL_COLOR_CLEAR_VALUE"], FOG):
            continue
        last = work.last.find("glClear")[0].state["GL_COLOR_CLEAR_VALUE"]
        if number == 0 and same(last, FOG):
            return hint(
                _(
                    "In the first frame the sky is not right yet: glClearColor in line {line} is "
                    "called after glClear, which has cleared already."
                ),
                line=line(work, "glClearColor"),
            )
        if at := line(work, "glClearColor"):
            return hint(
                _(
                    "The sky is not fogged: line {line} sets the colour that glClear leaves, "
                    "{color}."
                ),
                line=at,
                color=rounded(last),
            )
        return hint(_("The sky is not fogged: without glClearColor, glClear leaves black."))

    return None


def regions(solution, number):
    """Return the parts of the picture, from top to bottom."""
    return {
        _("the sky"): (0, 0, 1, 0.3),
        _("what is far, around the horizon"): (0, 0.3, 1, 0.5),
        _("what is near"): (0, 0.5, 1, 1),
    }


@test(
    _("The picture is right"),
    _("The jetty ends in the fog, and the water's edge cannot be told from the sky."),
    needs=sky,
)
def picture(work, solution):
    return compare(work, solution, regions=lambda number: regions(solution, number))
