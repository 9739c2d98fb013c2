"""Whole steps of a mouse wheel, whose turns a trackpad reports in fractions of a notch."""

import math

ROUNDING = 1e-6  # ten reports of 0.1 are a whole notch, though their sum as floats is below 1


class Wheel:
    """Adds up turns that go one way; those of the other way begin anew."""

    def __init__(self) -> None:
        self._rest = 0.0

    def steps(self, turned: float) -> int:
        """Return how many whole steps are complete with this turn, negative where it goes back."""
        if turned * self._rest < 0:
            self._rest = 0.0
        self._rest += turned
        whole = math.trunc(self._rest + math.copysign(ROUNDING, self._rest))
        self._rest -= whole
        return whole
