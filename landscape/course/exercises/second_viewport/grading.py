"""The tests of the exercise second_viewport."""

import numpy as np

from landscape.course.grader.grading import _, compare, hint, test

FRAMES = (0, 2)
EVENTS = [{"frame": 2, "resize": [760, 360]}]
MARGIN = 16
PAPER = (0.95, 0.9, 0.8)
BACKGROUND = (0.13, 0.16, 0.21)
NEAR = 0.02  # chosen: by which a colour, or the place of a point, from -1 to 1, may be off


def size(work, number):
    """Return width and height of a frame."""
    height, width = work.frame(number).picture.shape[:2]
    return width, height


def boxes(work, number):
    """Return the draws of the maze's walls, of both pictures."""
    found = work.frame(number).draws
    return [draw for draw in found if draw.mode == "GL_QUADS" and len(draw.vertices) == 24]


def of_the_map(work, number):
    """Return those of the map: they come second."""
    found = boxes(work, number)
    return found[len(found) // 2 :]


def frame_around(work, number):
    """Return the draw of the frame around the window."""
    return [draw for draw in work.frame(number).draws if draw.mode == "GL_TRIANGLE_STRIP"][-1]


def line(work, name, *first):
    """Return the line of the last call of a function in draw_map or after it; 0 without one."""
    found = work.last.find(name, *first)
    return found[-1].line if found else 0


def square(work, number):
    """Return where the map is to be: x, y, width, height."""
    side = size(work, number)[1] // 3
    return [MARGIN, MARGIN, side, side]


def close(found, wanted):
    return max(abs(a - b) for a, b in zip(found, wanted, strict=True)) <= 1


def same(color, wanted):
    return np.abs(np.array(color[:3]) - wanted).max() < NEAR


@test(
    _("The maze is drawn twice"),
    _("Once as seen from the entrance, and once as a map."),
)
def twice(work, solution):
    for number in FRAMES:
        ours, found = len(boxes(solution, number)), len(boxes(work, number))
        if found * 2 == ours:
            return hint(_("draw_map does not draw the maze yet: draw_maze does that."))
        if found != ours:
            return hint(
                _("In frame {frame} {count} walls are drawn, and not {wanted}: each twice."),
                frame=number,
                count=found,
                wanted=ours,
            )
    return None


@test(
    _("The map is in its square"),
    _("glViewport takes the lower left corner, the width and the height, in pixels."),
    needs=twice,
)
def viewport(work, solution):
    for number in FRAMES:
        found, wanted = of_the_map(work, number)[0].state["GL_VIEWPORT"], square(work, number)
        width, height = size(work, number)
        if close(found, wanted):
            continue
        if close(found, [0, 0, width, height]):
            return hint(
                _(
                    "The viewport is still the whole window while the map is drawn: glViewport "
                    "must "
                    "be called in draw_map, before draw_maze."
                )
            )
        values = {"line": line_of_viewport(work), "found": found, "wanted": wanted}
        if number and close(found, square(work, 0)):
            return hint(
                _(
                    "The square of line {line} is right for the first window only: its side is a "
                    "third of the height that draw_map is given."
                ),
                **values,
            )
        if close(found, [MARGIN, height - MARGIN - wanted[3], *wanted[2:]]):
            return hint(
                _("The map is at the top: in line {line} y counts from the lower edge upwards."),
                **values,
            )
        if close(found, [*wanted[:2], MARGIN + wanted[2], MARGIN + wanted[3]]):
            return hint(
                _(
                    "The last two arguments of line {line} are a width and a height, and not the "
                    "other corner."
                ),
                **values,
            )
        return hint(
            _("Line {line} sets the viewport {found}, and not {wanted}."),
            **values,
        )

    return None


def line_of_viewport(work):
    """Return the line of the last glViewport outside main."""
    found = [c for c in work.last.find("glViewport") if c.function != "main"]
    return found[0].line if found else 0


@test(
    _("The map shows the maze from straight above"),
    _("The square shows x and z from -6 to 6, without perspective."),
    needs=viewport,
)
def projection(work, solution):
    for number in FRAMES:
        draw = of_the_map(work, number)[0]
        matrix = draw.projection @ draw.modelview
        ortho = line(work, "glOrtho")
        if np.abs(matrix[3, :3]).max() > 1e-4:
            if ortho:
                return hint(
                    _(
                        "glOrtho in line {line} multiplies the perspective of the large picture: "
                        "GL_PROJECTION must be the identity before."
                    ),
                    line=ortho,
                )
            return hint(
                _(
                    "The map still has the perspective of the large picture: it needs a projection "
                    "of its own, which glOrtho makes."
                )
            )
        matrix = matrix / matrix[3, 3]
        if np.abs(matrix[:2, 1]).max() > NEAR:
            return hint(
                _(
                    "The map does not look straight down: the sides of walls are visible. A "
                    "rotation by 90 degrees about the x axis looks down, if no other is left in "
                    "the modelview matrix."
                )
            )
        across = matrix[:2, [0, 2]] * 6
        if abs(across[0, 1]) > NEAR or abs(across[1, 0]) > NEAR:
            return hint(
                _(
                    "The map turns with the eye: the modelview matrix of the large picture still "
                    "holds for it."
                )
            )
        if across[1, 1] > 0:
            return hint(
                _(
                    "The map is upside down: z = -6 must be at its upper edge. From which side "
                    "does "
                    "it look at the maze?"
                )
            )
        if across[0, 0] < 0:
            return hint(_("The map is mirrored: x must grow to the right."))
        if np.abs(np.abs(across.diagonal()) - 1).max() > NEAR:
            return hint(
                _("The map is {x:.1f} units wide and {z:.1f} units high, and not 12 and 12."),
                x=12 / abs(across[0, 0]),
                z=12 / abs(across[1, 1]),
            )
        if np.abs(matrix[:2, 3]).max() > NEAR:
            return hint(_("The middle of the maze is not in the middle of the map."))
        if matrix[2, 1] > 0:
            return hint(_("The map is seen from below: lower things hide higher ones."))
        heights = matrix[2, 1] * np.array((0, 1)) + matrix[2, 3]
        if np.abs(heights).max() > 1 + 1e-4:
            return hint(
                _(
                    "A part of the walls is not between the near and the far plane of the map: the "
                    "last two arguments of glOrtho are distances in the direction in which it "
                    "looks."
                )
            )

    return None


@test(
    _("The square is cleared, and nothing but the square"),
    _("glClear does not heed the viewport: only the scissor box limits it."),
    needs=projection,
)
def cleared(work, solution):
    for number in FRAMES:
        clears = work.frame(number).find("glClear")[1:]
        if not clears:
            return hint(
                _("The large picture shows through the map: its square is not cleared before.")
            )
        values = {"line": clears[0].line}
        state = clears[0].state
        if not state["GL_SCISSOR_TEST"]:
            if box := line(work, "glScissor"):
                return hint(
                    _(
                        "The scissor box of line {box} has no effect on glClear in line {line}: "
                        "GL_SCISSOR_TEST is not enabled then."
                    ),
                    box=box,
                    **values,
                )
            return hint(
                _(
                    "glClear in line {line} clears the whole window, and the large picture is "
                    "gone: "
                    "it does not heed the viewport, but the scissor box."
                ),
                **values,
            )
        if not close(state["GL_SCISSOR_BOX"], square(work, number)):
            return hint(
                _("glClear in line {line} clears the box {found}, and not {wanted}."),
                found=state["GL_SCISSOR_BOX"],
                wanted=square(work, number),
                **values,
            )
        bits = " ".join(str(call.args[0]) for call in clears)
        if "COLOR" not in bits:
            return hint(_("glClear in line {line} does not clear the colours."), **values)
        if "DEPTH" not in bits:
            return hint(
                _(
                    "glClear in line {line} does not clear the depths: the large picture's "
                    "depths can hide a part of the map."
                ),
                **values,
            )
        if not same(state["GL_COLOR_CLEAR_VALUE"], PAPER):
            return hint(
                _("The background of the map is not PAPER when glClear is called in line {line}."),
                **values,
            )

    return None


@test(
    _("After the map all is as before"),
    _(
        "Whatever the map has changed still holds for the frame around the window and for "
        "the next picture."
    ),
    needs=cleared,
)
def restored(work, solution):
    for number in FRAMES:
        state = frame_around(work, number).state
        if not close(state["GL_VIEWPORT"], [0, 0, *size(work, number)]):
            return hint(
                _(
                    "The frame around the window is drawn into the square of line {line}: the "
                    "viewport must be the whole window again."
                ),
                line=line_of_viewport(work),
            )
        if state["GL_SCISSOR_TEST"]:
            return hint(
                _(
                    "GL_SCISSOR_TEST is still on after the map, since line {line}: then only the "
                    "square is drawn, and cleared in the next picture."
                ),
                line=line(work, "glEnable", "GL_SCISSOR_TEST"),
            )
        first = work.frame(number).find("glClear")[0]
        if not same(first.state["GL_COLOR_CLEAR_VALUE"], BACKGROUND):
            return hint(
                _(
                    "From the second picture on, the large one has the colour of PAPER behind it: "
                    "line {line} still holds for glClear in line {clear}."
                ),
                line=line(work, "glClearColor"),
                clear=first.line,
            )

    return None


def regions(solution, number):
    """Return the parts of a frame's picture."""
    width, height = size(solution, number)
    x, y, side, _side = square(solution, number)
    inside = np.zeros((height, width), bool)
    inside[height - y - side : height - y, x : x + side] = True
    return {_("the map"): inside, _("the large picture"): ~inside}


@test(
    _("The picture is right"),
    _("In two sizes of the window."),
    needs=restored,
)
def picture(work, solution):
    return compare(work, solution, regions=lambda number: regions(solution, number))
