"""The cost of the grass: by number of blades, and in four ways from 2006 on (grass.py)."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from statistics import median
from typing import Any, Protocol

import numpy as np

from framelens.gl.texture import Texture
from landscape.bench.grass import WAYS, sow
from landscape.bench.timing import in_turns
from landscape.elements import sun
from landscape.elements.best.meadow.meadow import Meadow
from landscape.elements.grass import Grass
from landscape.elements.ground import Ground
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Pose
from landscape.gl.display_list import DisplayList
from landscape.scene.scene import Moment, begin_frame, placed

POSE, KT = Pose(20.0, None, 28.4, 168.0, -2.0), 20.0  # fig35b: dense grass
BLADES = 200_000  # section 5.3.1: blades on the island
COUNTS = (BLADES, 1_500_000, 10_000_000)
MOST_ON_ISLAND = 1_500_000  # section 5.3.1; more blades stand on proportionally larger land


class Owner(Protocol):
    """What holds something of OpenGL's."""

    def release(self) -> None:
        """Delete it."""


def _widened(values: Settings, count: int, wider: float) -> Settings:
    """Return settings of an island so many times as wide, with ``count`` blades."""
    return replace(
        values,
        grass=replace(values.grass, count=count),
        ground=replace(values.ground, size=values.ground.size * wider),
        castle=replace(values.castle, x=values.castle.x * wider, z=values.castle.z * wider),
    )


def measure_grass(
    values: Settings, count: int, size: tuple[int, int], assets: Assets, seed: int, rounds: int
) -> dict[str, float]:
    """Measure ``count`` blades where the grass is dense.

    ``select_ms``: only selecting the blades to draw; ``draw_ms``: all of Grass.draw, that is,
    bending in the wind, sending and drawing a selection that is kept for several frames;
    ``static_ms``: a display list of the same blades, so draw_ms / static_ms compares moving grass
    with motionless grass; ``visible``: blades drawn. Above 1,500,000 blades the land grows with
    their number, so that they stand as densely as 200,000 on the island.
    """
    wider = 1.0 if count <= MOST_ON_ISLAND else float(np.sqrt(count / BLADES))
    values = _widened(values, count, wider)
    owned: list[Owner] = []
    try:
        owned.append(ground := Ground(values, assets, sun.direction(values.sun)))
        blades = Meadow if Meadow.serves(values) else Grass
        owned.append(grass := blades(values, assets, ground, seed))
        place = replace(POSE, x=POSE.x * wider, z=POSE.z * wider)
        pose = placed(place, ground, values.walk.eye)
        frame = begin_frame(Moment(pose, size, KT), values.camera, values.sun, values.fog)
        grass.draw(frame)
        drawn = len(grass.select(frame).positions)
        owned.append(static := DisplayList(lambda: grass.draw(frame)))
        select, draw = partial(grass.select, frame), partial(grass.draw, frame)
        times = in_turns({"select": select, "draw": draw, "static": static.call}, rounds)
    finally:
        for owner in reversed(owned):
            owner.release()

    return {
        "count": count,
        "select_ms": median(times["select"]),
        "visible": drawn,
        "draw_ms": median(times["draw"]),
        "static_ms": median(times["static"]),
    }


def measure_ways(
    values: Settings,
    blade_count: int,
    size: tuple[int, int],
    assets: Assets,
    seed: int,
    rounds: int,
) -> list[dict[str, Any]]:
    """Draw the same blades in four ways, the report's first (see grass.py).

    Returns for each its ``name``, the blades on the land (``count``), and the ``ms`` of a frame.
    """
    owned: list[Owner] = []
    try:
        owned.append(ground := Ground(values, assets, sun.direction(values.sun)))
        path = assets.path("blade.png")
        owned.append(texture := Texture(read_image(path, "RGB"), repeat=False))
        blades = sow(ground.field, blade_count, seed, values.grass.radius, values.grass.scale)
        pose = placed(POSE, ground, values.walk.eye)
        frame = begin_frame(Moment(pose, size, KT), values.camera, values.sun, values.fog)
        ways = [way(blades, texture) for way in WAYS]
        owned += ways
        actions = {way.name: (lambda way=way: way.draw(frame)) for way in ways}
        times = in_turns(actions, rounds)
    finally:
        for owner in reversed(owned):
            owner.release()

    count = len(blades.positions)
    return [{"name": name, "count": count, "ms": median(spent)} for name, spent in times.items()]


def report(result: Mapping[str, Any]) -> list[str]:
    """Return the lines of the two tables."""
    lines: list[str] = []
    if result["grass"]:
        lines += ["", "blades      select ms   visible  draw ms  static ms  draw / static"]
    for row in result["grass"]:
        ratio = row["draw_ms"] / row["static_ms"]
        lines.append(
            f"{row['count']:10,d} {row['select_ms']:10.2f} {row['visible']:9,d}"
            f" {row['draw_ms']:8.2f} {row['static_ms']:10.2f} {ratio:14.2f}"
        )
    if result["ways"]:
        first = result["ways"][0]
        lines += ["", f"{first['count']:,} blades, four ways            ms   times as fast"]
    for row in result["ways"]:
        lines.append(f"{row['name']:30} {row['ms']:10.2f} {first['ms'] / row['ms']:15.1f}")
    return lines
