"""A step as a picture: text or a file in its area, and what stands for a live one on paper."""

from dataclasses import replace

import numpy as np

from framelens.base.errors import InputError
from framelens.base.isolated import Ended, isolated
from framelens.base.texts import speaking
from framelens.gl.glfw_library import glfw
from framelens.gl.named import glfw_constant
from framelens.program.program_events import presses
from landscape.course.grader.picture import pictures
from landscape.course.ladder import lesson
from landscape.course.lecture import texts
from landscape.course.lecture.image import still_image, text_image
from landscape.course.lecture.plan import LESSON, PICTURE, TEXT, VIEW, Step
from landscape.course.lecture.view import planned
from landscape.files.assets import Assets
from landscape.files.images import open_image, read_image
from landscape.offscreen import Offscreen
from landscape.walk.app import Walk

LATER = 10  # chosen: the frame of a program that names none
SECONDS = 120.0  # chosen: after which a program of the lecturer is given up
SETTLED = 3  # chosen: seconds of a walk after keys, in which its messages go


def still(step: Step, size: tuple[int, int], height: int) -> np.ndarray:
    """Return the area of a step that stands still, uint8 (h, w, 4); InputError for a bad file."""
    if step.kind == PICTURE and step.file is not None:
        return still_image(size, height, read_image(step.file))
    return text_image(size, height, texts.paragraphs(step))


def drawn(step: Step, size: tuple[int, int], language: str) -> np.ndarray | None:
    """Return what a step shows, uint8 (h, w, 3); None for one of text.

    ``size`` is that of views; a program has that of its window. InputError where a program or a
    picture fails, NoOpenGLError.
    """
    with speaking(language):
        if step.kind == TEXT:
            return None
        if step.kind == VIEW:
            return _walked(step, size, language) if step.keys else _rendered(step, size)
        assert step.file is not None
        if step.kind == PICTURE:
            return np.asarray(open_image(step.file).convert("RGB"))
        return _frame(step)


def _rendered(step: Step, size: tuple[int, int]) -> np.ndarray:
    with Offscreen(size) as offscreen:
        offscreen.look(step.name)
        return offscreen.draw()


def _walked(step: Step, size: tuple[int, int], language: str) -> np.ndarray:
    """Return a view after keys were pressed: a walk knows them."""
    with Walk(planned(step.name, size, language), Assets(), "headless") as walk:
        for key in step.keys:
            code = glfw_constant(glfw, f"KEY_{key}")
            walk.hands.key(code, glfw.PRESS)
            walk.hands.key(code, glfw.RELEASE)
        for _second in range(SETTLED):
            tick = walk.listen()
            assert tick is not None
            walk.advance(replace(tick, seconds=1.0))
        walk.draw()
        return walk.pixels()


def _frame(step: Step) -> np.ndarray:
    keys = step.keys
    frame = step.frame
    if step.kind == LESSON:
        found = lesson(step.name)
        keys = keys or found.pressed
        frame = found.frame if frame is None else frame

    frame = LATER if frame is None else frame
    frames = [max(frame, int(bool(keys)))]
    assert step.file is not None

    if step.kind == LESSON:
        return pictures(step.file, frames, presses(keys))[0]
    try:
        return isolated(pictures, step.file, frames, presses(keys), seconds=SECONDS)[0]
    except Ended as ended:
        raise InputError(
            "{name}: its process ended with status {status}: {message}",
            name=step.name,
            status=ended.status,
            message=ended.message,
        ) from None
