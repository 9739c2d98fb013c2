"""Settings at their limits, and eyes far away, draw a picture without a warning."""

import numpy as np
import pytest
from commands import Shell

from landscape.elements.best.castle.baked_light import light
from landscape.elements.best.terrain.materials import textured
from landscape.elements.settings import Sun


@pytest.fixture(scope="module")
def shell(the_shell: Shell, tmp_path_factory: pytest.TempPathFactory) -> Shell:
    """A shell whose processes show every warning on standard error."""
    the_shell.cwd = tmp_path_factory.mktemp("limits")
    return the_shell


@pytest.mark.seldom(14, first=8)
@pytest.mark.parametrize(
    ("only", "change"),
    [
        ("grass", "grass.radius=0"),
        ("trees", "transparent.min_pixels=1e-300"),
        ("trees", "transparent.fade=1e-300"),
        ("plants", "plants.crossed_within=1e-300"),
        ("ground", "ground.mid_repeat=1e-300"),
    ],
)
def test_a_setting_at_its_limit_gives_no_warning(only: str, change: str, shell: Shell) -> None:
    small = ("--size=64x48", "--samples=0", *shell.small)
    few = ("--set=ground.stones=500",) if only == "ground" else (f"--set={only}.count=2000",)
    done = shell("render", "fig35e", "--only", only, *small, *few, "--set", change, "--out=a.png")
    assert (done.status, done.err) == (0, ""), done.err


@pytest.mark.seldom(10, first=8)
@pytest.mark.parametrize("pose", ["1e5,1,20,0,0", "20,1e8,20,0,-90", "-9e8,ground,9e8,9e8,9e8"])
def test_an_eye_far_away_gives_no_warning(pose: str, shell: Shell) -> None:
    small = ("--size=64x48", "--samples=0", *shell.small)
    done = shell("render", f"--pose={pose}", "--only=water,sky", *small, "--out=a.png")
    assert (done.status, done.err) == (0, ""), done.err


def test_stones_without_any_light_are_black_and_give_no_warning() -> None:
    places, down = np.array([(0.0, 1.0, 0.0)]), np.array([(0.0, -1.0, 0.0)])
    with np.errstate(all="raise", under="ignore"):
        assert (light(places, down, Sun(ambient=(0.0, 0.0, 0.0)), 0.0) == 0).all()


def test_detail_larger_than_the_ground_is_enlarged_and_cut_off() -> None:
    flat, turf = np.full((64, 64, 3), 100, np.uint8), np.full((64, 64, 1), 255, np.uint8)
    ramp = np.repeat(np.arange(64, dtype=np.uint8)[None, :, None] * 4, 64, axis=0)
    ramp = np.repeat(ramp, 3, axis=2)
    half = textured(flat, ramp, 0.5, turf).astype(int)
    wanted = textured(flat, ramp, 1.0, turf).astype(int)[:, np.arange(64) // 2]
    assert np.abs(half - wanted).max() <= 4
    assert len(np.unique(textured(flat, ramp, 1e-300, turf))) == 1
