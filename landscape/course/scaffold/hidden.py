# Tests that students do not see: this file stays with you. It is like grading.py, and has frames
# and events of its own. Delete it if the exercise needs none.

import numpy as np

from landscape.course.grader.grading import _, hint, test

FRAMES = (0, 3)
EVENTS = [{"frame": 2, "key": "LEFT"} for _press in range(13)]  # more than a whole turn, backwards


@test(
    _("The hand turns back beyond a whole turn"),
    _("Thirteen times Left: it stands where once Left would have brought it."),
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
    return hint(_("After thirteen times Left the hand is not where it should be."))
