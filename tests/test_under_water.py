"""Under water: Snell's window, the net of light over bed and dragon, and how one gets there."""

from collections.abc import Iterator

import numpy as np
import pytest
from stage import SIZE, SMALL_BEST, Stage

from landscape.elements.best.sea.under_water import (
    INDEX,
    WATER,
    looked_out,
    mirrored_lines,
    refracted,
)
from landscape.elements.settings import PRESETS, Settings
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.island.island import Island, terrain
from landscape.scene.scene import Moment, find_view
from landscape.settings.declare import with_settings
from landscape.walk.walker import Intent, advance, start

UNDER = find_view("under_water")[1].pose
SHOWN = ("ground", "water", "dragon", "fog")
BEST = with_settings(Settings(), {**PRESETS["best"], **SMALL_BEST})
UP = np.array([[0.0, 1.0, 0.0]])


def line(degrees: float) -> np.ndarray:
    """Return a line of sight (1, 3) that leaves the zenith by an angle."""
    return np.array([[np.sin(np.radians(degrees)), np.cos(np.radians(degrees)), 0.0]])


@pytest.fixture(scope="module")
def islands(the_stage: Stage) -> Iterator[dict[bool, Island]]:
    """The islands opened so far, by ``water.caustics``."""
    kept: dict[bool, Island] = {}
    yield kept
    the_stage.enter()
    for island in kept.values():
        island.release()


def picture(
    stage: Stage,
    islands: dict[bool, Island],
    net: bool = True,
    pose: Pose = UNDER,
    shown: tuple[str, ...] = SHOWN,
) -> np.ndarray:
    """Return the picture, int64 (h, w, 3), with the net of light or without."""
    with stage.borrowed():
        if net not in islands:
            settings = with_settings(BEST, {"water.caustics": net})
            islands[net] = Island(settings, Assets(), only=SHOWN)
        islands[net].shown = set(shown)
        islands[net].draw(Moment(pose, SIZE, 40.0))
        return stage.read()


def test_light_comes_through_a_window_of_48_degrees_and_from_nowhere_else() -> None:
    edge = np.degrees(np.arcsin(1.0 / INDEX))
    assert edge == pytest.approx(48.6, abs=0.1)
    through = [
        looked_out(line(angle), UP, UP[0])[1][0] for angle in (0, 30, edge - 0.5, edge + 0.5)
    ]
    assert through[0] == pytest.approx(0.98, abs=0.001)
    assert 0.9 < through[1] < through[0] and 0.0 < through[2] < 0.7 and through[3] == 0.0


def test_the_sun_under_water_is_bent_towards_the_zenith_by_snell_s_law() -> None:
    sun = np.array([np.cos(np.radians(30.0)), np.sin(np.radians(30.0)), 0.0])
    below = refracted(sun)
    assert np.linalg.norm(below) == pytest.approx(1.0)
    assert sun[0] == pytest.approx(INDEX * below[0]) and below[1] > sun[1]


@pytest.mark.seldom(13, first=6)
def test_the_net_of_light_lies_on_bed_and_dragon_and_keeps_their_mean(
    stage: Stage, islands: dict[bool, Island]
) -> None:
    plain, with_net = (picture(stage, islands, net) for net in (False, True))
    change = np.abs(with_net - plain).max(axis=2)
    alone = picture(stage, islands, False, shown=("ground", "water", "fog"))
    dragon = (alone != plain).any(axis=2)
    assert (change[dragon] > 8).mean() > 0.1, "on the dragon"
    bed = ~dragon & (np.arange(SIZE[1])[:, None] > 0.75 * SIZE[1])
    assert (change[bed] > 8).mean() > 0.3, "on the bed"
    assert with_net[bed].mean() == pytest.approx(plain[bed].mean(), rel=0.25)


def test_level_water_mirrors_a_line_of_sight_and_a_tilted_facet_turns_it_by_twice_its_angle() -> (
    None
):
    assert mirrored_lines(line(60.0), UP) == pytest.approx(line(60.0) * (1.0, -1.0, 1.0))
    tilted = mirrored_lines(line(60.0), line(5.0))
    assert np.degrees(np.arccos(tilted[0, 1])) == pytest.approx(180.0 - 60.0 + 2 * 5.0)


@pytest.mark.seldom(3, first=1)
def test_the_far_bed_is_lost_in_the_water_and_the_surface_is_not(
    stage: Stage, islands: dict[bool, Island]
) -> None:
    seen = picture(stage, islands, shown=("ground", "water", "fog"))
    away = np.abs(seen - np.rint(255 * np.array(WATER))).max(axis=2).mean(axis=1)
    rows = away.reshape(12, -1).mean(axis=1)  # twelve bands, from the surface above to the bed
    assert rows[6:9].max() < 10 < rows[-1]
    assert rows[1] > 2 * rows[7], "waves"


@pytest.mark.seldom(3)
def test_waves_break_the_mirror_image_of_the_dragon(
    stage: Stage, islands: dict[bool, Island], monkeypatch: pytest.MonkeyPatch
) -> None:
    broken = picture(stage, islands)
    monkeypatch.setattr("landscape.elements.best.sea.under_water.BROKEN", 0.0)
    level = picture(stage, islands)
    half = SIZE[1] // 2
    changed = (np.abs(broken - level).max(axis=2) > 8).mean(axis=1)
    assert changed[:half].mean() > 0.1 and changed[half:].mean() < 0.02


def test_above_the_surface_nothing_of_it_is_drawn(
    stage: Stage, islands: dict[bool, Island]
) -> None:
    above = Pose(UNDER.x, 0.75, UNDER.z, UNDER.yaw, UNDER.pitch)
    seen, below = picture(stage, islands, pose=above), picture(stage, islands)
    assert (np.abs(below - seen).max(axis=2) > 20).mean() > 0.5
    again = picture(stage, islands, pose=above)
    assert (again == seen).all(), "the clip plane of the water above is as it was"


def test_one_dives_by_flying_down_to_the_bed_and_no_farther() -> None:
    class Bay:
        """As much of the island as a walker asks for."""

        field = terrain(BEST, Assets())
        size = field.size
        dives = True

        def height(self, x: float, z: float) -> float:
            return float(self.field.height(x, z))

        def bed(self, x: float, z: float) -> float:
            return float(self.field.terrain_height(x, z)) if self.dives else self.height(x, z)

    bay = Bay()
    who = start(UNDER, bay, BEST)
    assert who.flying and (who.x, who.y, who.z) == (UNDER.x, UNDER.y, UNDER.z)
    for _ in range(100):
        who = advance(who, Intent(up=-1.0), 0.05, bay, (), BEST)
    assert bay.bed(who.x, who.z) < who.y < bay.bed(who.x, who.z) + 0.06 < BEST.water.level
    bay.dives = False
    assert start(UNDER, bay, BEST).y > BEST.water.level
