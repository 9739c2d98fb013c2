"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

COLOR = "    glClearColor(light, 0.5 * light, 0.35 * light, 1)\n"
CLEAR = "    glClear(GL_COLOR_BUFFER_BIT)\n"
RGB = "(light, 0.5 * light, 0.35 * light, 1)"
PRESSED = "if action in (glfw.PRESS, glfw.REPEAT):"
UP, DOWN = "light = min(light + 0.1, 1)", "light = max(light - 0.1, 0)"
LOOP = "    while not glfw"
STREET = "        draw_street()\n"

MUTANTS = {
    "only_set": Mutant("sets the colour and fills nothing", "filled", [(CLEAR, "")]),
    "only_depth": Mutant("clears the depths", "filled", [(CLEAR, CLEAR.replace("COLOR", "DEPTH"))]),
    "after_all": Mutant(
        "clears after the street",
        "filled",
        [("        draw_sky()\n", ""), (STREET, STREET + "        draw_sky()\n")],
    ),
    "moon_first": Mutant(
        "draws the moon before the sky",
        "filled",
        [("        draw_sky()\n", ""), (STREET, "        draw_sky()\n" + STREET)],
    ),
    "once": Mutant(
        "clears before the loop",
        "filled",
        [("        draw_sky()\n", ""), (LOOP, "    draw_sky()\n" + LOOP)],
    ),
    "only_above": Mutant(
        "fills the upper half",
        "filled",
        [
            (
                CLEAR,
                "    glColor3f(light, 0.5 * light, 0.35 * light)\n    glRectf(-1, 0, 1, 1)\n",
            )
        ],
    ),
    "too_late": Mutant(
        "sets the color after it is used", "color", [(COLOR + CLEAR, CLEAR + COLOR)]
    ),
    "bytes": Mutant(
        "counts to 255",
        "color",
        [(RGB, "(255 * light, 255 * 0.5 * light, 255 * 0.35 * light, 1)")],
    ),
    "blue_first": Mutant(
        "gives blue first", "color", [(RGB, "(0.35 * light, 0.5 * light, light, 1)")]
    ),
    "without_light": Mutant("leaves light out", "color", [(RGB, "(1, 0.5, 0.35, 1)")]),
    "grey": Mutant("gives light to all channels", "color", [(RGB, "(light, light, light, 1)")]),
    "no_keys": Mutant("does not change light", "keys", [(UP, "pass"), (DOWN, "pass")]),
    "other_way": Mutant(
        "swaps Up and Down",
        "keys",
        [(UP, "light = max(light - 0.10, 0)"), (DOWN, "light = min(light + 0.1, 1)")],
    ),
    "released": Mutant("takes each action", "keys", [(PRESSED, "if True:")]),
    "not_repeated": Mutant("takes only the press", "keys", [(PRESSED, "if action == glfw.PRESS:")]),
    "assigned": Mutant(
        "assigns instead of adding", "keys", [(UP, "light = 0.6"), (DOWN, "light = 0.4")]
    ),
    "no_limits": Mutant("has no limits", "limits", [(UP, "light += 0.1"), (DOWN, "light -= 0.1")]),
    "no_upper": Mutant("has no upper limit", "limits", [(UP, "light += 0.1")]),
    "no_lower": Mutant("has no lower limit", "limits", [(DOWN, "light -= 0.1")]),
    "around": Mutant(
        "begins again at the other end",
        "limits",
        [
            (UP, "light = light + 0.1 if light < 0.95 else 0"),
            (DOWN, "light = light - 0.1 if light > 0.05 else 1"),
        ],
    ),
    "tested_before": Mutant(
        "tests whether light has come to the limit",
        "limits",
        [(UP, "light += 0.1 if light < 1 else 0"), (DOWN, "light -= 0.1 if light > 0 else 0")],
    ),
}
