"""Clips without OpenGL, for films of which a part cannot be drawn."""

import os
import signal
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np

from landscape.film.stage import Stage


@dataclass(frozen=True)
class Failing:
    """Grey pictures that become lighter; of the whole second ``at`` there is none.

    ``how``: "raise" an error, "kill" the process, or "" to draw it after all. Each picture that is
    drawn is noted in the file ``log``, if one is named.
    """

    seconds: float
    at: int = -1
    how: str = ""
    log: str = ""
    needs_opengl: ClassVar[bool] = False

    def open(self, stage: Stage) -> Callable[[float], np.ndarray]:
        width, height = stage.size

        def picture(seconds: float) -> np.ndarray:
            if self.log:
                with Path(self.log).open("a") as file:
                    file.write(f"{seconds:g}\n")
            if int(seconds) == self.at and self.how == "raise":
                raise KeyError("a defect")
            if int(seconds) == self.at and self.how == "kill":
                os.kill(os.getpid(), signal.SIGKILL)
            return np.full((height, width, 3), round(10 * seconds) % 256, np.uint8)

        return picture
