"""What is asked of a frame in a process of its own: for draws that are seen, and for mistakes."""

import random
from pathlib import Path
from typing import Any

import numpy as np

from framelens.base.errors import InputError
from framelens.program.program_frame import ProgramFrame
from framelens.tape.tape import Tape
from framelens.why.diagnosis import diagnose
from framelens.why.trial import Item, Trial, changed
from landscape.commands.target import ViewFrame

EACH = 2  # draws of a program or view that are asked about; chosen
SECONDS = 15.0  # for a search
SEEN = 30  # pixels from which on a draw counts as seen; chosen
DIFFERENT = 400  # pixels that a mistake must change; chosen
SIZE = 400, 300  # of a view's picture: what is asked does not depend on it

Answer = tuple[str, list[tuple[str, str]]]
"""Where it was asked, or the verdict, and the causes with their lines."""


def seen(path: str, frame: int, seed: str) -> list[Answer]:
    """Ask at a pixel of some draws that are seen, in a program, or in the view of that name."""
    dice = random.Random(seed)
    target: Any = ViewFrame(path, size=SIZE)
    if path.endswith(".py"):
        target = ProgramFrame(path, frame=frame)
    answers: list[Answer] = target.look(lambda tape: _asked(tape, dice), past=True)
    return answers


def _asked(tape: Tape, dice: random.Random) -> list[Answer]:
    owner, draws = _owners(tape)
    visible = [k for k in range(len(draws)) if (owner == k).sum() >= SEEN]
    answers = []
    for index in dice.sample(visible, min(EACH, len(visible))):
        rows, columns = np.nonzero(owner == index)
        at = dice.randrange(len(rows))
        pixel = int(columns[at]), int(rows[at])
        found = diagnose(tape, pixel, SECONDS)
        causes = [(cause.cause, cause.source) for cause in found.causes]
        answers.append((f"{pixel[0]},{pixel[1]} {draws[index].call.source}", causes))
    return answers


def _owners(tape: Tape) -> tuple[np.ndarray, list[Item]]:
    """Return for each pixel which draw has coloured it last, -1 for none, and the draws."""
    trial = Trial(tape)
    owner = np.full(tape.size[::-1], -1)
    draws: list[Item] = []
    state: dict[str, Any] = {}

    def make(item: Item, draw: Any) -> None:
        before = state.get("picture")
        if before is None:
            before = trial.read()
        draw()
        state["picture"] = after = trial.read()
        if before is not None and after is not None and not item.call.name.startswith("glClear"):
            owner[changed(before, after, 1)] = len(draws)
        draws.append(item)

    try:
        trial.run(draw=make)
    finally:
        trial.release()
    return owner, draws


def picture(path: str, frame: int) -> np.ndarray | None:
    """Return what a program draws in a frame."""

    def look(tape: Tape) -> np.ndarray | None:
        trial = Trial(tape)
        try:
            return trial.picture()
        finally:
            trial.release()

    try:
        return ProgramFrame(path, frame=frame).look(look, past=True)
    except InputError:
        return None


def mistaken(whole: str, broken: str, frame: int, everywhere: bool) -> Answer | None:
    """Ask about a mistake at a pixel that it changes, or ``everywhere`` of the whole picture.

    None if it changes too little, or the program does not come to the frame.
    """
    pixel = None
    if not everywhere:
        pixel = _differing(picture(whole, frame), picture(broken, frame))
        if pixel is None:
            return None
    try:
        found = ProgramFrame(broken, frame=frame).look(
            lambda tape: diagnose(tape, pixel, SECONDS), past=True
        )
    except InputError:
        return None
    causes = [(cause.cause, cause.source) for cause in found.causes]
    return (f"{Path(broken).stem} {pixel or ''} {found.verdict}", causes)


def _differing(before: np.ndarray | None, after: np.ndarray | None) -> tuple[int, int] | None:
    """Return a pixel in which two pictures differ, None where they are too much alike."""
    if before is None or after is None or before.shape != after.shape:
        return None
    rows, columns = np.nonzero(changed(before, after, 30))
    if len(rows) < DIFFERENT:
        return None
    middle = len(rows) // 2
    return int(columns[middle]), int(rows[middle])
