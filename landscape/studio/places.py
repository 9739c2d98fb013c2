"""Files of places for trees, deer and plants, which stand where a gardener would put them."""

import math
from collections.abc import Callable, Iterable

BEGIN, YAW = (21.4, 25.6), 338.0  # chosen: where the avenue begins, and where it leads to
HALF, STEP = 0.55, 0.62  # chosen: units aside and along it
ROWS = 9  # chosen: trees on each side
HEADER = "kind,x,z,width,height,mirrored"
# Chosen: two trees as far away as each other from where the view crossing_trees stands, so near to
# each other that their pictures cross in the middle, and a stag that crosses a third one.
CROSSING = (
    ("conifer", 20.83, 22.3, 0.62, 0.62, 0),
    ("broadleaf", 21.07, 22.3, 0.62, 0.62, 1),
    ("birch", 21.52, 22.62, 0.5, 0.6, 0),
    ("stag", 21.40, 22.60, 0.16, 0.16, 0),
)

Row = tuple[str, float, float, float, float, int]


def text(rows: Iterable[Row]) -> str:
    """Return the file of these sprites: kind, x, z, width, height, mirrored."""
    lines = (f"{k},{x:.3f},{z:.3f},{w:.3f},{h:.3f},{flipped}" for k, x, z, w, h, flipped in rows)
    return "\n".join([HEADER, *lines, ""])


def avenue() -> str:
    """Return an avenue of trees with ferns between them, and a stag at its end."""
    yaw = math.radians(YAW)

    def at(along: float, aside: float) -> tuple[float, float]:
        x = BEGIN[0] + along * math.sin(yaw) + aside * math.cos(yaw)
        return x, BEGIN[1] - along * math.cos(yaw) + aside * math.sin(yaw)

    rows: list[Row] = []
    for n in range(ROWS):
        for side in (-1, 1):
            kind = "conifer" if n % 2 else "broadleaf"
            flipped = int(side > 0)
            rows.append((kind, *at(n * STEP, side * HALF), 0.45, 0.6, flipped))
            rows.append(("plant", *at((n + 0.5) * STEP, side * HALF), 0.12, 0.12, flipped))
    rows.append(("stag", *at(2.2, 0.05), 0.15, 0.15, 0))
    return text(rows)


def crossing() -> str:
    """Return the few sprites of :data:`CROSSING`."""
    return text(CROSSING)


ASSETS: dict[str, Callable[[], str]] = {"avenue.csv": avenue, "crossing.csv": crossing}
