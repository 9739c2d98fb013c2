"""The tests of the exercise blending_order."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test

FRAMES = (0, 2, 4)
EVENTS = [
    *({"frame": 2, "key": "LEFT"} for _press in range(7)),
    *({"frame": 4, "key": "LEFT"} for _press in range(3)),
]
ALPHA = 0.35
NEAR = 0.01  # chosen: by which a factor may be off


def is_glass(draw):
    return len(draw.colors) > 0 and draw.colors[:, 3].max() < 0.99


def glass(work, number):
    """Return the draws of the tubes of a frame, in their order."""
    return [draw for draw in work.frame(number).draws if is_glass(draw)]


def opaque(work, number):
    return [draw for draw in work.frame(number).draws if not is_glass(draw)]


def line(work, name, *first):
    """Return the line of the last call of a function; 0 without one."""
    found = work.find(name, *first)
    return found[-1].line if found else 0


@test(
    _("Each tube and each opaque thing is drawn once"),
    _("Two tubes of alpha 0.35, the floor, the pillar and the ball."),
)
def drawn(work, solution):
    for number in FRAMES:
        tubes = glass(work, number)
        if len(tubes) != 2:
            return hint(
                _("In frame {frame} {count} tubes are drawn, and not two."),
                frame=number,
                count=len(tubes),
            )
        if len(opaque(work, number)) != len(opaque(solution, number)):
            return hint(_("draw_opaque() must be called once in each frame."))
    return None


@test(
    _("Opaque things are drawn first"),
    _(
        "Glass is mixed with the colours that are there already. Anything drawn later "
        "cannot be seen through it."
    ),
    needs=drawn,
)
def opaque_first(work, solution):
    for number in FRAMES:
        kinds = [is_glass(draw) for draw in work.frame(number).draws]
        if kinds == sorted(kinds):
            continue
        if all(kinds[:2]):
            return hint(
                _(
                    "Both tubes are drawn before the floor and the ball, which are not there "
                    "yet: only the background shows through the glass."
                )
            )
        return hint(
            _(
                "In frame {frame} one tube is drawn before something opaque: first everything "
                "opaque, then all glass."
            ),
            frame=number,
        )

    return None


@test(
    _("The glass is blended"),
    _("Without GL_BLEND alpha has no effect."),
    needs=opaque_first,
)
def blended(work, solution):
    for number in FRAMES:
        for draw in glass(work, number):
            if draw.state["GL_BLEND"]:
                continue
            if at := line(work, "glEnable", "GL_BLEND"):
                return hint(
                    _(
                        "GL_BLEND is enabled in line {line}, but it is off while a tube is "
                        "drawn in "
                        "frame {frame}."
                    ),
                    line=at,
                    frame=number,
                )
            if at := line(work, "glBlendFunc"):
                return hint(
                    _("glBlendFunc in line {line} has no effect without glEnable(GL_BLEND)."),
                    line=at,
                )
            return hint(_("GL_BLEND is off while the tubes are drawn, so alpha has no effect."))

    return None


def factors(state):
    """Return the factors of the new colour and of the old one, for the tubes' alpha; or None."""
    constant = state["GL_BLEND_COLOR"][3]
    known = {
        "GL_ZERO": 0,
        "GL_ONE": 1,
        "GL_SRC_ALPHA": ALPHA,
        "GL_CONSTANT_ALPHA": constant,
        "GL_ONE_MINUS_SRC_ALPHA": 1 - ALPHA,
        "GL_ONE_MINUS_CONSTANT_ALPHA": 1 - constant,
    }
    return [known.get(state[f"GL_BLEND_{side}_RGB"]) for side in ("SRC", "DST")]


@test(
    _("0.35 of the glass and 0.65 of the colour behind it"),
    _(
        "The first argument of glBlendFunc is the factor of the new colour, the second the "
        "factor of the old one."
    ),
    needs=blended,
)
def function(work, solution):
    state = glass(work, 0)[0].state
    found = factors(state)
    if None not in found and np.allclose(found, (ALPHA, 1 - ALPHA), atol=NEAR):
        return None
    at = line(work, "glBlendFunc")
    if found == [1, 0]:
        return hint(
            _(
                "glBlendFunc is not called. Without it the factors are 1 for the glass and 0 for "
                "the colour behind it."
            )
        )

    if found[1] == 1:
        return hint(
            _("Line {line} adds the glass to the full colour behind it: that is light, not glass."),
            line=at,
        )

    if None not in found and np.allclose(found, (1 - ALPHA, ALPHA), atol=NEAR):
        return hint(_("In line {line} the two factors are swapped."), line=at)
    return hint(
        _(
            "With {new} and {old} in line {line}, the glass and the colour behind it do not have "
            "the factors 0.35 and 0.65."
        ),
        new=state["GL_BLEND_SRC_RGB"],
        old=state["GL_BLEND_DST_RGB"],
        line=at,
    )


@test(
    _("Nearer opaque things hide the glass"),
    _("The depth test stays on for glass: only writing depths is turned off."),
    needs=function,
)
def hidden(work, solution):
    if all(draw.state["GL_DEPTH_TEST"] for number in FRAMES for draw in glass(work, number)):
        return None
    return hint(
        _(
            "Line {line} turns the depth test off, so a tube shows in front of the ball that hides "
            "it. Writing depths is switched by another call."
        ),
        line=line(work, "glDisable", "GL_DEPTH_TEST"),
    )


@test(
    _("The farther tube is drawn first"),
    _("From every side: which tube is farther away depends on the eye."),
    needs=hidden,
)
def order(work, solution):
    wrong = []
    for number in FRAMES:
        first, second = (np.linalg.norm(draw.center) for draw in glass(work, number))
        if first < second:
            wrong.append(number)
    if not wrong:
        return None
    if len(wrong) == len(FRAMES):
        return hint(_("The nearer tube is drawn first from every side: the order is reversed."))
    return hint(
        _(
            "From some sides it is right, but in frame {frame} the nearer tube is drawn first: the "
            "order must be found anew in each frame, from the distance to the eye."
        ),
        frame=wrong[0],
    )


@test(
    _("The glass writes no depths"),
    _("Otherwise the near wall of a tube hides its far wall."),
    needs=order,
)
def no_depths(work, solution):
    writing = [d for n in FRAMES for d in glass(work, n) if d.state["GL_DEPTH_WRITEMASK"]]
    if not writing:
        return None
    if at := line(work, "glDepthMask", False) or line(work, "glDepthMask"):
        return hint(
            _(
                "glDepthMask is called in line {line}, but depths are still written while a "
                "tube is "
                "drawn."
            ),
            line=at,
        )
    return hint(
        _(
            "The glass writes its depths, so one wall of each tube hides the other: glDepthMask "
            "turns that off."
        )
    )


@test(
    _("All is as before after the last tube"),
    _("Whatever is left on or off stays so in the next frame, and for its glClear."),
    needs=no_depths,
)
def restored(work, solution):
    for number in FRAMES:
        clears = work.frame(number).find("glClear")
        bodies = [draw.state for draw in opaque(work, number)]
        if number and not clears[0].state["GL_DEPTH_WRITEMASK"]:
            return hint(
                _(
                    "After line {line} no depths are written any more, and glClear in line {clear} "
                    "does not clear them: the second frame is hidden by the first."
                ),
                line=line(work, "glDepthMask"),
                clear=clears[0].line,
            )
        if not all(state["GL_DEPTH_WRITEMASK"] for state in bodies):
            return hint(
                _(
                    "glDepthMask in line {line} applies to opaque things as well: then the floor "
                    "hides nothing."
                ),
                line=line(work, "glDepthMask"),
            )
        if any(state["GL_BLEND"] for state in bodies):
            return hint(
                _("GL_BLEND is still on when the opaque things are drawn in frame {frame}."),
                frame=number,
            )

    return None


@test(
    _("The picture is right"),
    _("From three sides."),
    needs=restored,
)
def picture(work, solution):
    return compare(work, solution)
