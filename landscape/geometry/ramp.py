"""From 0 to 1 between two values, as rules mix by heights and slopes."""

import numpy as np


def ramp(low: float, high: float, values: np.ndarray) -> np.ndarray:
    """Return 0 at ``low`` and 1 at ``high``, linear between; ``low`` may exceed ``high``."""
    return np.asarray(np.clip((values - low) / (high - low), 0.0, 1.0))
