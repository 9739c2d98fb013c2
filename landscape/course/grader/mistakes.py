"""Tests shared by several exercises: mistakes recognized by their pictures, and full stacks.

A test that compares what a program draws with what a mistake would draw cannot name a symptom that
the picture does not have. Such a mistake is a pair: a function that returns what it draws in a
frame, and its hint.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np

from landscape.course.grader.evidence import Evidence, Frame
from landscape.course.grader.grading import Hint, Test, Text, _, compare, hint, test

STACKS = ("GL_MODELVIEW_STACK_DEPTH", "GL_PROJECTION_STACK_DEPTH", "GL_ATTRIB_STACK_DEPTH")
NO_SHAPES = ("glDrawBuffer", "glDrawPixels")
Mistake = tuple[Callable[[int], object], Text | Hint]
"""What is drawn in a frame if the mistake is made, and the hint."""


def known(
    mistakes: Iterable[Mistake],
    found: Callable[[int], object],
    frames: Sequence[int],
    same: Callable[[Any, Any], bool] = np.array_equal,
) -> Hint | None:
    """Return the hint of the first mistake that draws what is ``found`` in all frames, or None."""
    seen = {number: found(number) for number in frames}
    for made, told in mistakes:
        if all(same(seen[number], made(number)) for number in frames):
            return told if isinstance(told, Hint) else hint(told)
    return None


def explained(
    choices: Sequence[Sequence[tuple[object, Text | None]]],
    made: Callable[..., object],
    found: Callable[[int], object],
    frames: Sequence[int],
    same: Callable[[object, object], bool],
) -> tuple[Text | None, ...] | None:
    """Return which choices draw what is found in all frames: the text of each, None if right.

    Each choice is one of several forms of a part of the program, with the hint for those that are
    wrong; ``made`` gets a frame's number and a form of each part. Of several explanations the one
    with the fewest mistakes is returned, and None if there is none.
    """
    seen = {number: found(number) for number in frames}
    combinations = sorted(
        product(*choices), key=lambda forms: sum(text is not None for _form, text in forms)
    )
    for forms in combinations:
        parts = [form for form, _text in forms]
        if all(same(seen[number], made(number, *parts)) for number in frames):
            return tuple(text for _form, text in forms)

    return None


def close(near: float) -> Callable[[object, object], bool]:
    """Return what says whether two arrays have one shape, and differ by less than ``near``."""

    def same(one: object, other: object) -> bool:
        first, second = np.asarray(one, float), np.asarray(other, float)
        return first.shape == second.shape and bool((np.abs(first - second) < near).all())

    return same


def blocks(frame: Frame, width: int, height: int) -> np.ndarray:
    """Return a picture of width x height blocks, (height, width, 3), int, the top row first.

    Each block of the window's pixels gives the one in its middle.
    """
    shown = frame.picture
    high, wide = max(shown.shape[0] // height, 1), max(shown.shape[1] // width, 1)
    found = shown[high // 2 :: high, wide // 2 :: wide]
    return np.asarray(found[:height, :width], int)


def colors(frame: Frame, width: int, height: int, table: Sequence[object]) -> np.ndarray:
    """Return which colour of a table each block shows, (height, width); -1 for none of them."""
    apart = np.abs(blocks(frame, width, height)[:, :, None] - np.array(table)).max(axis=-1)
    return np.where(apart.min(axis=-1) < 8, apart.argmin(axis=-1), -1)


def silent(work: Evidence, solution: Evidence) -> bool:
    """Return whether a test that looks at vertices must say nothing.

    That is where the pictures are right, or where not all vertices are known.
    """
    return compare(work, solution) is None or not followed(work)


def followed(work: Evidence) -> bool:
    """Return whether the vertices of all that is drawn are known.

    They are not where they come from buffer objects, or by glInterleavedArrays, glArrayElement or
    glMultiDrawElements.
    """
    return all(map(_followed, work.frames.values()))


def _followed(frame: Frame) -> bool:
    drawn = {id(draw.call) for draw in frame.draws if len(draw.vertices)}
    return "glArrayElement" not in frame.names and all(
        id(call) in drawn
        for call in frame.calls
        if call.name.startswith(("glDraw", "glMultiDraw")) and call.base not in NO_SHAPES
    )


def _depths(frame: Frame) -> Mapping[str, int]:
    """Return how deep the stacks are where they are least deep in a frame."""
    states = [call.state for call in frame.calls if call.state]
    return {stack: min((int(state[stack]) for state in states), default=0) for stack in STACKS}


def balanced(needs: Test) -> Test:
    """Return the test that the stacks are as deep in the last frame as in the first one."""

    @test(
        _("What is pushed is popped"),
        _("OpenGL's stacks have few places: a program that fills them ends with an error."),
        needs=needs,
    )
    def stacks(work: Evidence, solution: Evidence) -> Hint | None:
        ends = min(work.frames), max(work.frames)
        first, last = (_depths(work.frame(number)) for number in ends)
        for stack in STACKS:
            if last[stack] > first[stack]:
                return hint(
                    _(
                        "The picture is right, but {stack} grows from frame to frame: something "
                        "is pushed that is not popped. After some seconds the program will end "
                        "with an error."
                    ),
                    stack=stack,
                )
        return None

    return stacks
