# Tests that students do not see: this file stays with you. It is like grading.py, and has frames
# and events of its own. Delete it if the exercise needs none.

import numpy as np

from landscape.course.grader.grading import _, hint, test

FRAMES = (0, 3)
EVENTS = [{"frame": 2, "key": "LEFT"} for _press in range(40)]  # more than three turns back


@test(
    _("The hand turns back beyond a whole turn"),
    _("Forty times Left: three turns and a third."),
)
def back(work, solution):
    tips = [
        draw.eye[-1, :2]
        for each in (work, solution)
        for draw in each.frame(3).draws
        if len(draw.vertices) == 3
    ]
    if len(tips) == 2 and np.abs(tips[0] - tips[1]).max() < 0.02:
        return None
    return hint(_("After forty times Left the hand is not where it should be."))
