"""A second look at a program whose pictures are right, under circumstances it cannot know before.

The frames and events of an exercise stand in its grading.py, where a student may read them. A trial
is made anew for each grader: every key of the exercise is pressed, so many times that whatever it
turns goes past half a turn; the window becomes higher than wide, and wide again; and the program
runs on to its last frame, by when a stack that grows by one place a frame is full. Only pictures
are looked at.
"""

import random
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from landscape.course.grader.evidence import Evidence
from landscape.course.grader.grading import MOST, Hint, Test, Text, _, differing, hint, test
from landscape.course.grader.troubles import SENTENCES

LAST = 40  # chosen: frames; OpenGL's stacks have 32 places or fewer
FEW = (1, 3)  # chosen: presses of a key, an odd number, so that it switches what it switches
SOME = (5, 6, 7)  # chosen: presses; three times as many are over half a turn, by 15 degrees each
HIGH = (280, 360), (400, 520)  # chosen: width and height of a window that is higher than wide
WIDE = (520, 700), (280, 360)
ENDS = ("ESCAPE",)  # keys that close the window
Step = tuple[str | tuple[int, int], tuple[int, ...]]
"""A key, and how often it may be pressed; or the bounds of the width and height of a window."""

KEY = re.compile(r"\bKEY_(\w+)")


@dataclass(frozen=True)
class Trial:
    """The frames whose pictures are looked at, the events, and the presses before each frame.

    ``presses``: how often each key was pressed, by the number of the frame.
    """

    frames: Sequence[int]
    events: Sequence[dict[str, object]]
    presses: Mapping[int, Mapping[str, int]]


def _presses(key: str, count: int, frame: int) -> list[dict[str, object]]:
    """Return the events of a key that is pressed so many times before a frame."""
    return [
        {"frame": frame, "key": key, "action": action}
        for _press in range(count)
        for action in ("press", "release")
    ]


def _steps(keys: list[str], chance: random.Random) -> list[Step]:
    """Return in which order keys are pressed, and the window gets another size."""
    chance.shuffle(keys)
    steps: list[Step] = [(key, count) for key in keys for count in (FEW, SOME, SOME, SOME)]
    steps.insert(chance.randint(0, len(steps) // 2), HIGH)
    steps.append(WIDE)
    return steps


def trial(code: str, chance: random.Random) -> Trial:
    """Return a trial of an exercise from its solution's code, which names the keys."""
    keys = sorted(set(KEY.findall(code)) - set(ENDS))
    steps = _steps(keys, chance)
    frame = chance.randint(1, 3)
    events: list[dict[str, object]] = []
    pressed = dict.fromkeys(keys, 0)
    presses: dict[int, Mapping[str, int]] = {}
    for what, bounds in steps:
        if isinstance(what, str):
            count = chance.choice(bounds)
            pressed[what] += count
            events += _presses(what, count, frame)
        else:
            events.append(
                {"frame": frame, "resize": [chance.randint(*what), chance.randint(*bounds)]}
            )
        # A program that asks for its size before it polls learns of a new one a frame later.
        presses[frame + 1] = dict(pressed)
        frame += chance.randint(2, 3)

    presses[max(frame, LAST)] = dict(pressed)
    return Trial(sorted(presses), events, presses)


def elsewhere(trial: Trial, most: float = MOST) -> Test:
    """Return the test of a trial, whose evidence is only pictures.

    ``most``: the fraction of the pixels that may differ.
    """

    @test(
        _("The picture is right elsewhere, too"),
        _("In windows of other sizes, after other keys, and after some time."),
        demanded=True,
    )
    def elsewhere(work: Evidence, solution: Evidence) -> Hint | None:
        for number in trial.frames:
            mine, wanted = work.frame(number), solution.frame(number)
            share = float(differing(mine, wanted).mean())
            if share > most:
                height, width = wanted.picture.shape[:2]
                presses = trial.presses[number]
                keys = ", ".join(f"{key} {count}" for key, count in presses.items() if count)
                return hint(
                    _(
                        "In the frames that the other tests look at the picture is right. But "
                        "{percent:.1f} % of the pixels are not as they should be in frame {frame}, "
                        "in a window of {width} x {height} pixels{pressed}."
                    ),
                    percent=100 * share,
                    frame=number,
                    width=width,
                    height=height,
                    pressed=hint(_(", after these keys: {keys}"), keys=keys) if keys else "",
                )
        return None

    return elsewhere


def broken_off(error: Mapping[str, object]) -> Hint:
    """Return the hint for a program that does not get to the last frame of a trial."""
    reason = hint(Text(SENTENCES[str(error["word"])]), **error)
    return hint(
        _(
            "In the frames that the other tests look at the picture is right. But in a longer run, "
            "with other keys and sizes of the window, this happens: {reason}"
        ),
        reason=reason,
    )
