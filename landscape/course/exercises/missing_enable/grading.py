"""The tests of the exercise missing_enable."""

from landscape.course.grader.grading import _, between, compare, hint, test, vertices

FRAMES = (0, 3)


@test(
    _("The depth test is on while the boxes are drawn"),
    _("Only then does OpenGL compare the depth of each pixel with what is there already."),
)
def enabled(work, solution):
    for number in FRAMES:
        if vertices(work.frame(number)) < vertices(solution.frame(number)):
            return hint(
                _(
                    "In frame {frame} a part of the boxes is not drawn: it is the depth test that "
                    "is to decide what is hidden."
                ),
                frame=number,
            )

    boxes = [draw for number in FRAMES for draw in work.frame(number).draws]
    without = [draw for draw in boxes if not draw.state["GL_DEPTH_TEST"]]
    if not without:
        return None
    calls = work.find("glEnable", "GL_DEPTH_TEST")
    if calls and work.find("glDisable", "GL_DEPTH_TEST"):
        off = work.find("glDisable", "GL_DEPTH_TEST")[-1]
        return hint(
            _("Line {off} turns the depth test off again, and what is drawn later is not tested."),
            off=off.line,
        )

    if calls:
        return hint(
            _(
                "Line {line} turns the depth test on too late: the first frame has been drawn by "
                "then. State that never changes is set once, before the loop."
            ),
            line=calls[0].line,
        )

    if found := work.find("glDepthFunc"):
        return hint(
            _(
                "glDepthFunc in line {line} says how depths are compared, but does not turn the "
                "comparison on."
            ),
            line=found[0].line,
        )

    if found := work.find("glDepthMask"):
        return hint(
            _(
                "glDepthMask in line {line} says whether depths are written. They are only "
                "written, and compared, once the depth test is on."
            ),
            line=found[0].line,
        )

    if found := work.find("glEnable", "GL_CULL_FACE"):
        return hint(
            _(
                "GL_CULL_FACE in line {line} leaves out the faces that look away from the eye. "
                "A box still does not hide what is behind it: something else must be turned on."
            ),
            line=found[0].line,
        )

    towers, wanted = (
        [tuple(draw.vertices[0]) for draw in each.frame(0).draws] for each in (work, solution)
    )
    if towers != wanted and sorted(towers) == sorted(wanted):
        return hint(
            _(
                "The boxes are drawn in another order than before. The board turns, and no order "
                "is right from all sides: leave the list as it was. The depth test makes the "
                "order indifferent."
            )
        )

    return hint(
        _(
            "The call that turns the depth test on is missing {place}. One function turns on "
            "whatever OpenGL can also do without, by its name; the lesson depth_buffer calls it."
        ),
        place=between(next(iter(work.find("glClearColor")), None), boxes[0]),
    )


@test(
    _("The depth buffer is emptied in each frame"),
    _("Otherwise the boxes are compared with those of the frame before."),
    needs=enabled,
)
def cleared(work, solution):
    clears = work.last.find("glClear")
    if any("GL_DEPTH_BUFFER_BIT" in str(call.args[0]) for call in clears):
        return None
    line = clears[-1].line if clears else 0
    return hint(
        _("glClear in line {line} no longer empties the depth buffer: GL_DEPTH_BUFFER_BIT."),
        line=line,
    )


@test(
    _("The picture is right"),
    _("At the beginning and some frames later, the towers hide each other as they stand."),
    needs=(enabled, cleared),
)
def picture(work, solution):
    comparison = work.last.draws[-1].state["GL_DEPTH_FUNC"]
    if comparison not in ("GL_LESS", "GL_LEQUAL"):
        return hint(
            _(
                "glDepthFunc({comparison}) in line {line} lets through what should be hidden. The "
                "default, GL_LESS, is what this picture needs."
            ),
            comparison=comparison,
            line=work.find("glDepthFunc")[-1].line,
        )
    return compare(work, solution)
