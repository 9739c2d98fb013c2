"""The tests of the exercise window."""

import numpy as np

from landscape.course.grader.grading import _, between, compare, hint, test
from landscape.course.grader.mistakes import balanced, close, known

FRAMES = (0, 2, 4, 6, 8)
UP, DOWN = ("UP",), ("DOWN",)
PRESSED = {  # before these frames, and how often each key is repeated
    2: (("UP", 0),),
    4: (("UP", 6), ("DOWN", 0)),
    6: (("DOWN", 15), ("UP", 0)),
    8: (("UP", 4),),
}
EVENTS = [
    {"frame": frame, "key": key, "action": action}
    for frame, keys in PRESSED.items()
    for key, repeats in keys
    for action in ("press", *["repeat"] * repeats, "release")
] + [{"frame": 8, "resize": [240, 320]}]
SKY = np.array((1, 0.5, 0.35))
FREE = (4, -5)  # a pixel of the sky, which nothing ever hides
LOW = (0.58, -5)  # another one; its row is a part of the height


def up(light):
    return min(light + 0.1, 1)


def down(light):
    return max(light - 0.1, 0)


def lights(up=up, down=down, actions=("press", "repeat")):
    """Return light in each frame, if keys change it like this."""
    light, found = 0.5, {}
    for number in FRAMES:
        for event in EVENTS:
            if event["frame"] == number and event.get("action") in actions:
                light = (up if event["key"] == "UP" else down)(light)
        found[number] = light
    return found


def filled_with(made, color=SKY):
    """Return what gives the colour of the sky in a frame, by what light is in each."""
    return lambda number: np.round(255 * np.clip(made[number] * color, 0, 1))


RIGHT = lights()


def sky(work):
    """Return what gives the colour that the sky has in a frame."""
    return lambda number: work.frame(number).picture[FREE].astype(int)


def first_draw(work):
    """Return the first draw of the last frame that is not the sky."""
    return work.last.draws[0]


@test(
    _("The whole window is filled, before anything else is drawn"),
    _("A window keeps its old picture until it is filled."),
)
def filled(work, solution):
    if compare(work, solution) is None:
        return None
    number = FRAMES[-1]
    shown = work.frame(number).picture
    if (shown == shown[0, 0]).all():
        return hint(
            _(
                "The picture is nothing but sky: the moon and the street are drawn, and then the "
                "window is filled. Which must come first, filling or drawing?"
            )
        )

    bright = shown.min(axis=2) > 200
    if not bright[: shown.shape[0] // 3].any():
        return hint(
            _("The moon has gone: the sky is drawn after it. In which order does main call them?")
        )

    black = all((sky(work)(number) == 0).all() for number in FRAMES)
    if black:
        cleared = work.find("glClear")
        if cleared and "GL_COLOR_BUFFER_BIT" not in str(cleared[-1].args[0]):
            return hint(
                _(
                    "glClear in line {line} fills {buffer}. That is not the buffer of the colours, "
                    "so the sky stays black."
                ),
                line=cleared[-1].line,
                buffer=cleared[-1].args[0],
            )
        if colors := work.find("glClearColor"):
            return hint(
                _(
                    "Line {line} chooses the colour to fill the window with, but nothing fills "
                    "it yet: the sky is black."
                ),
                line=colors[-1].line,
            )
        return hint(
            _(
                "Nothing fills the window: the sky is black, and the moon leaves a trail. The "
                "first thing to be drawn in a picture is the sky, {place}."
            ),
            place=between(None, first_draw(work)),
        )

    early = FRAMES[:-1]
    same = {tuple(sky(work)(number)) for number in early}
    if len(same) == 1 and not any(
        work.frame(number).find("glClear")
        or len(work.frame(number).draws) > len(solution.frame(number).draws)
        for number in early[1:]
    ):
        return hint(
            _(
                "The window is filled only once, before the first picture: so the moon leaves a "
                "trail, and the keys will not change the sky."
            )
        )

    for number in FRAMES:
        picture = work.frame(number).picture.astype(int)
        above, below = picture[FREE], picture[int(LOW[0] * len(picture)), LOW[1]]
        if np.abs(above - below).max() <= 8:
            continue
        return hint(
            _(
                "The sky does not have one colour: only a part of the window is filled. In its "
                "own coordinates the window reaches from -1 to 1, both ways, whatever its size."
            )
        )

    return None


OF_COLOR = (
    (
        filled_with({0: 0, 2: 0.5, 4: 0.6, 6: 0.9, 8: 0.1}),
        _(
            "The sky has the colour of the picture before, and in the first picture it is black: "
            "the window is filled before the new colour is set."
        ),
    ),
    (
        filled_with(RIGHT, 255 * SKY),
        _(
            "All channels have their full brightness, so the sky is white: OpenGL counts them from "
            "0 to 1, and not to 255."
        ),
    ),
    (
        filled_with(RIGHT, SKY[::-1]),
        _("Red and blue have changed places: red comes first, then green, then blue."),
    ),
    (
        filled_with(dict.fromkeys(FRAMES, 1)),
        _("The sky is always as light as it can be: each channel must be multiplied by `light`."),
    ),
    (
        filled_with(RIGHT, np.ones(3)),
        _("The sky is grey: each of the three channels has a factor of its own."),
    ),
)
WITH_KEYS = (
    (
        filled_with(dict.fromkeys(FRAMES, 0.5)),
        _("Up and Down change nothing: the sky stays as it is at the beginning."),
    ),
    (
        filled_with(lights(down, up)),
        _("Up makes the sky darker, and Down makes it lighter: they have changed places."),
    ),
    (
        filled_with(lights(actions=("press", "repeat", "release"))),
        _(
            "When Up has been pressed and let go, the sky is two steps lighter: the function is "
            "called when a key is let go, too. `action` says what has happened."
        ),
    ),
    (
        filled_with(lights(actions=("press",))),
        _("Holding a key has no more effect than touching it: what is `action` then?"),
    ),
    (
        filled_with(lights(lambda light: 0.6, lambda light: 0.4)),
        _(
            "The sky knows only two more colours, one for Up and one for Down: add the step to "
            "the current value of `light`."
        ),
    ),
)
WITH_LIMITS = (
    (
        filled_with(lights(lambda light: light + 0.1, lambda light: light - 0.1)),
        _(
            "`light` leaves the range from 0 to 1 on both sides: the sky looks the same then, but "
            "the next keys seem to be dead, until it has come back."
        ),
    ),
    (
        filled_with(lights(lambda light: light + 0.1)),
        _(
            "`light` grows beyond 1: no sky is lighter, but a single Down then changes nothing "
            "that can be seen."
        ),
    ),
    (
        filled_with(lights(down=lambda light: light - 0.1)),
        _(
            "`light` falls below 0: no sky is darker, but a single Up then changes nothing that "
            "can be seen."
        ),
    ),
    (
        filled_with(
            lights(
                lambda light: light + 0.1 if light < 0.95 else 0,
                lambda light: light - 0.1 if light > 0.05 else 1,
            )
        ),
        _(
            "At its limit `light` jumps to the other one: a sky that is as light as possible turns "
            "black. It should stay where it is."
        ),
    ),
    (
        filled_with(
            lights(lambda light: light + 0.1 * (light < 1), lambda light: light - 0.1 * (light > 0))
        ),
        _(
            "`light` goes one step beyond the limit. For a computer ten times 0.1 is a little "
            "less than 1: so test the sum, not the value before it."
        ),
    ),
)


def differs(work, frames):
    """Return the first of some frames whose sky is not right."""
    right = filled_with(RIGHT)
    return next((n for n in frames if not close(3)(sky(work)(n), right(n))), None)


@test(
    _("The colour of the sky is right at the beginning"),
    _("Three channels, from 0 to 1, each multiplied by `light`."),
    needs=filled,
)
def color(work, solution):
    told = known(OF_COLOR, sky(work), FRAMES, close(3))
    if told or differs(work, (0,)) is None:
        return told
    red, green, blue = sky(work)(0)
    wanted = filled_with(RIGHT)(0).astype(int)
    return hint(
        _(
            "In the first picture the sky has the red {red}, green {green}, blue {blue} of 255, "
            "and not {right_red}, {right_green}, {right_blue}."
        ),
        red=int(red),
        green=int(green),
        blue=int(blue),
        right_red=int(wanted[0]),
        right_green=int(wanted[1]),
        right_blue=int(wanted[2]),
    )


@test(
    _("Up and Down change the light of the sky"),
    _("A step of 0.1 for each press and each repetition."),
    needs=color,
)
def keys(work, solution):
    told = known(WITH_KEYS, sky(work), FRAMES, close(3))
    if told or differs(work, (2,)) is None:
        return told
    return hint(_("When Up is pressed once, `light` should grow from 0.5 to 0.6."))


@test(
    _("The light stays between 0 and 1"),
    _("A value that runs on beyond its limit has to come all the way back."),
    needs=keys,
)
def limits(work, solution):
    told = known(WITH_LIMITS, sky(work), FRAMES, close(3))
    number = differs(work, FRAMES)
    if told or number is None:
        return told
    return hint(
        _("After some keys, in frame {frame}, `light` should be {light:.1f}."),
        frame=number,
        light=RIGHT[number],
    )


@test(
    _("The picture is right"),
    _("With several keys, and in a window that is taller than wide."),
    needs=limits,
)
def picture(work, solution):
    return compare(work, solution)


stacks = balanced(needs=picture)
