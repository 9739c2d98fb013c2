"""Golden pictures: each element alone and whole scenes, with fixed poses, times and settings.

To accept new pictures, run pytest tests/test_goldens.py --update-golden and look at each one that
changed. The settings below belong to these tests: changing a preset or a named view does not affect
the pictures, changing an asset or an element does.
"""

import platform
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pictures
import pytest
from commands import TESTS, environment, python
from PIL import Image
from seam import Replaced
from stage import Stage
from test_hall_goldens import VIEWS

from framelens.gl.framebuffer import Framebuffer
from framelens.gl.seam import edited, gl
from landscape.course.ladder import lessons
from landscape.elements.settings import TIMES, Settings
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.gallery.compare import AMPLIFICATION, agree
from landscape.geometry.height_field import HeightField
from landscape.island.island import Island
from landscape.scene.scene import Moment
from landscape.settings.declare import with_settings
from landscape.voxel.voxel import SCENE as VOXEL

pytestmark = pytest.mark.golden

SEED = 7
SIZE, LARGE = (160, 120), (320, 240)

CHOSEN: dict[str, Any] = {
    **{"camera.fov": 60.0, "camera.near": 0.02, "camera.far": 120.0},
    **{"sun.azimuth": 130.0, "sun.elevation": 40.0},
    **{"sun.diffuse": (0.8, 0.75, 0.7), "sun.ambient": (0.5, 0.5, 0.55)},
    **{"ground.resolution": 60, "ground.scale_y": 6.0, "ground.detail_repeat": 160.0},
    **{"water.level": 0.6, "water.repeat": 4.0, "water.time_step": 0.02},
    **{"sky.half_width": 8.0, "sky.height": 5.0, "transparent.radius": 9.0},
    **{"trees.count": 800, "trees.species": 2, "trees.size_min": 0.325, "trees.size_max": 0.65},
    **{"castle.sides": 24, "castle.battlements": True},
    **{"deer.species": 2, "plants.sway_by_size": True},
    **{"deer.count": 60, "deer.size_min": 0.1, "deer.size_max": 0.14},
    **{"plants.count": 1500, "plants.size_min": 0.06, "plants.size_max": 0.14},
    **{"grass.count": 150_000, "grass.radius": 4.0},
    **{"castle.x": 27.3, "castle.z": 16.9, "castle.yaw": -160.0, "castle.brick_repeat": 4.0},
    **{"rabbit.x": 20.5, "rabbit.z": 24.0, "rabbit.yaw": 35.0, "rabbit.scale": 0.12},
    **{"rabbit.l1": 8.0, "rabbit.l2": 4.0},
    **{"dragon.x": 11.0, "dragon.z": 29.0, "dragon.yaw": 30.0, "dragon.scale": 0.9},
    **{"dragon.sink": -0.15, "overlay.map_alpha": 0.75},
}
"""Values for what the report does not give."""

BETTER: dict[str, Any] = {
    **{"water.ripples": 0.6, "water.horizon_contrast": 0.3},
    **{"ground.resolution": 100, "ground.height_image": "height16.png", "ground.mid_repeat": 13.0},
    "ground.materials": True,
    **{"reflection.stencil": True, "reflection.castle": True, "water.fresnel": True},
    **{"water.horizon": 300.0, "water.glitter": 0.7, "water.color": (0.1, 0.2, 0.3, 0.85)},
    **{
        "sky.refined": True,
        "sky.moving": True,
        "sky.follow_y": True,
        "sky.background": True,
        "sky.unfogged": True,
        "transparent.upright": True,
        "transparent.radius": 20.0,
    },
    **{"trees.species": 4, "trees.grouped": True, "grass.tinted": True, "grass.fade": True},
    **{"grass.count": 1_000_000, "grass.scale": (0.9, 1.3), "grass.radius": 5.0},
    **{"fog.density": 0.04, "fog.color": (0.66, 0.76, 0.84)},
}
"""Techniques beyond the report, as the preset `best` turns them on."""

EYE = 0.1  # units above the ground


def stand(field: HeightField, x: float, z: float, yaw: float, pitch: float = 0.0) -> Pose:
    return Pose(x, float(field.height(x, z)) + EYE, z, yaw, pitch)


COAST = Pose(9.0, 1.0, 33.0, 25.0, -6.0)
ELEMENTS: dict[str, tuple[Any, float, tuple[str, ...]]] = {
    "ground": (Pose(8.0, 8.0, 42.0, 25.0, -20.0), 0, ("ground",)),
    "water": (COAST, 30, ("ground", "water")),
    "reflection": (COAST, 30, ("ground", "water", "sky", "reflection")),
    "sky": (Pose(20.0, 1.0, 20.0, 40.0, 20.0), 0, ("sky",)),
    "sprites": ((22.5, 24.6, 300.0), 20, ("ground", "trees", "deer", "plants")),
    "deer": ((22.35, 21.6, 310.0), 20, ("ground", "trees", "deer", "plants")),
    "grass": ((21.2, 22.6, 340.0, -8.0), 12, ("ground", "grass")),
    "castle": ((27.0, 18.05, 20.0, 6.0), 14, ("ground", "castle")),
    "castle_air": (Pose(25.6, 4.6, 19.8, 32.0, -32.0), 3, ("ground", "castle")),
    "rabbit": ((20.25, 24.3, 40.0, -4.0), 0, ("ground", "rabbit")),
    "dragon": (Pose(12.4, 1.0, 31.6, 330.0, -2.0), 10, ("dragon", "water", "reflection")),
    "sword": (Pose(20.0, 5.0, 20.0), 0, ("sword",)),
    "map": (Pose(12.0, 5.0, 30.0), 0, ("map",)),
    "fog": (Pose(8.0, 3.0, 36.0, 35.0, -8.0), 0, ("ground", "fog")),
}
ALL = (
    *("ground", "water", "sky", "trees", "deer", "plants", "grass", "castle", "rabbit", "dragon"),
    *("sword", "map", "fog", "reflection"),
)
SCENES: dict[str, Any] = {
    "coast": (Pose(8.0, 1.0, 33.0, 28.0, -1.0), 40),
    "arrival": ((26.7, 19.0, 19.0, 9.0), 24),
    "meadow": ((20.1, 24.6, 42.0, -3.0), 10),
}


@pytest.fixture(scope="module")
def islands(the_stage: Stage) -> Iterator[dict[str, Island]]:
    """The island of 2006 and the improved one, both with the settings above."""
    the_stage.enter()
    old = with_settings(Settings(), CHOSEN)
    made = {
        "2006": Island(old, Assets(), SEED),
        "best": Island(with_settings(old, BETTER), Assets(), SEED),
    }
    yield made
    the_stage.enter()
    for island in made.values():
        island.release()


@pytest.fixture(scope="module")
def target(the_stage: Stage) -> Iterator[Framebuffer]:
    """A larger target, for whole scenes."""
    the_stage.enter()
    made = Framebuffer(LARGE)
    the_stage.target.bind()
    yield made
    the_stage.enter()
    made.release()


def draw(
    stage: Stage,
    island: Island,
    place: Any,
    kt: float,
    shown: tuple[str, ...],
    target: Framebuffer | None = None,
    stroke: int = 0,
) -> np.ndarray:
    """Draw some elements of an island from a pose, or standing at (x, z, yaw[, pitch])."""
    pose = place if isinstance(place, Pose) else stand(island.ground.field, *place)
    island.shown = set(shown)
    frame = target or stage.target
    frame.bind()
    with stage.borrowed():
        island.draw(Moment(pose, frame.size, kt, 6.0, stroke))
    picture = frame.read()
    stage.target.bind()
    return picture


@pytest.mark.parametrize("name", ELEMENTS)
def test_an_element_matches_its_golden_picture(
    stage: Stage, islands: dict[str, Island], request: pytest.FixtureRequest, name: str
) -> None:
    picture = draw(stage, islands["2006"], *ELEMENTS[name])
    assert picture.std() > 5, "an empty golden picture proves nothing"
    pictures.check(name, picture, request.config.getoption("--update-golden"))


@pytest.mark.parametrize("stroke", [1, 2, 3, 4])
def test_a_sword_stroke_matches_its_golden_picture(
    stage: Stage, islands: dict[str, Island], request: pytest.FixtureRequest, stroke: int
) -> None:
    place = Pose(20.0, 5.0, 20.0)
    picture = draw(stage, islands["2006"], place, 0, ("sword",), stroke=stroke)
    pictures.check(f"sword_{stroke}", picture, request.config.getoption("--update-golden"))


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("preset", ["2006", "best"])
@pytest.mark.sweep(2)
def test_a_whole_scene_matches_its_golden_picture(
    stage: Stage,
    islands: dict[str, Island],
    target: Framebuffer,
    request: pytest.FixtureRequest,
    preset: str,
    scene: str,
) -> None:
    place, kt = SCENES[scene]
    picture = draw(stage, islands[preset], place, kt, ALL, target)
    name = f"{scene}_{preset}"
    pictures.check(name, picture, request.config.getoption("--update-golden"))


@pytest.mark.parametrize("preset", ["2006", "best"])
@pytest.mark.sweep(2)
def test_a_sunset_matches_its_golden_picture(
    stage: Stage, request: pytest.FixtureRequest, preset: str
) -> None:
    # Strong glints would show how a renderer samples their texture, amplified four times.
    chosen = CHOSEN if preset == "2006" else {**CHOSEN, **BETTER, "water.glitter": 0.2}
    island = Island(with_settings(Settings(), {**chosen, **TIMES["sunset"]}), Assets(), SEED)
    picture = draw(stage, island, (13.2, 27.0, 245.0, -2.0), 40, ALL)
    island.release()
    name = f"dusk_{preset}"
    pictures.check(name, picture, request.config.getoption("--update-golden"))


@pytest.fixture
def coast(stage: Stage, islands: dict[str, Island]) -> np.ndarray:
    """A picture to compare with wrong ones."""
    return draw(stage, islands["2006"], COAST, 30, ALL)


@pytest.mark.parametrize("same", [True, False])
def test_the_comparison_fails_on_a_picture_shifted_by_one_pixel(coast, same: bool) -> None:
    assert agree(coast, coast, same)
    assert not agree(coast, np.roll(coast, 1, axis=1), same)
    assert not agree(coast, np.roll(coast, 1, axis=0), same)


@pytest.mark.seldom(7, first=6)
@pytest.mark.parametrize("same", [True, False])
@pytest.mark.parametrize("missing", ["sky", "fog", "reflection", "water", "trees", "map"])
def test_the_comparison_fails_when_one_element_is_missing(
    stage: Stage, islands: dict[str, Island], coast, missing: str, same: bool
) -> None:
    gone = {missing} if missing != "trees" else {"trees", "deer", "plants"}
    without = draw(stage, islands["2006"], COAST, 30, tuple(e for e in ALL if e not in gone))
    assert not agree(coast, without, same)


def wrong_blend() -> Replaced:
    """Return an edit of every glBlendFunc."""
    return Replaced("glBlendFunc", (gl.GL_ONE, gl.GL_ONE))


def test_the_comparison_fails_on_one_wrong_blend_function(
    stage: Stage, islands: dict[str, Island]
) -> None:
    expected = draw(stage, islands["2006"], *ELEMENTS["castle"])
    with edited(wrong_blend()):
        spoilt = draw(stage, islands["2006"], *ELEMENTS["castle"])
    assert not agree(expected, spoilt, same_renderer=False)


DRAWN_OTHERWISE = """
import sys

sys.path.insert(0, sys.argv[1])
import numpy as np
import pictures
from seam import Replaced
from stage import Stage
from test_goldens import CHOSEN, ELEMENTS, SEED, draw, wrong_blend

from landscape.files.assets import Assets
from framelens.gl.seam import edited
from framelens.gl.context import open_context
from landscape.island.island import Island
from landscape.settings.declare import with_settings
from landscape.elements.settings import Settings

stage = Stage(open_context("auto"))
island = Island(with_settings(Settings(), CHOSEN), Assets(), SEED)
found = {name: draw(stage, island, *ELEMENTS[name]) for name in sys.argv[3:]}
place, kt, _ = ELEMENTS["castle"]
found["no castle"] = draw(stage, island, place, kt, ("ground",))
with edited(wrong_blend()):
    found["wrong blend"] = draw(stage, island, *ELEMENTS["castle"])
np.savez(sys.argv[2], **found)
print(pictures.renderer(), end="")
"""


@pytest.mark.seldom(7, first=6)
def test_a_renderer_that_samples_textures_otherwise_agrees_and_faults_on_it_do_not(
    stage: Stage, tmp_path: Path
) -> None:
    """llvmpipe can sample textures with 8 bits or in floating point; Mesa 26 always does that."""
    if "llvmpipe" not in pictures.renderer():
        pytest.skip("only llvmpipe has two ways to sample textures")
    names = ("castle", "castle_air", "ground", "water", "reflection", "grass")
    env = environment(GALLIVM_PERF="no_aos_sampling")
    done = python(DRAWN_OTHERWISE, str(TESTS), str(tmp_path / "a.npz"), *names, env=env)
    assert done.status == 0, done.err
    drawn = np.load(tmp_path / "a.npz")
    assert done.out != pictures.renderer(), "it is another renderer"
    for name in names:
        assert agree(pictures.golden(name), drawn[name], same_renderer=False), name
    for fault in ("no castle", "wrong blend"):
        assert not agree(pictures.golden("castle"), drawn[fault], same_renderer=False), fault


def test_the_renderer_is_known_by_what_decides_about_its_pixels(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("GALLIVM_PERF", raising=False)
    lines = pictures.renderer().splitlines()
    assert len(lines) == 3 and lines[0] == gl.glGetString(gl.GL_RENDERER).decode()
    assert lines[2].split()[0] == platform.machine()
    monkeypatch.setenv("GALLIVM_PERF", "no_aos_sampling")
    assert pictures.renderer().splitlines() == [*lines, "GALLIVM_PERF=no_aos_sampling"]


def test_levels_are_compared_as_signed_numbers_and_few_pixels_may_differ_by_more() -> None:
    black = np.zeros((100, 100, 3), np.uint8)
    one, four, five = (np.full_like(black, level) for level in (1, 4, 5))
    roundings = black.copy()
    roundings[0] = 1  # 1 % of the pixels
    assert agree(black, roundings, True) and agree(roundings, black, True)
    roundings[1, 0] = 1
    assert not agree(black, roundings, True)
    assert not agree(black, one, True), "one level in the whole picture is a fault"
    assert agree(four, black, False) and not agree(black, five, False)
    specks = black.copy()
    specks[0] = 12
    assert agree(black, specks, False) and not agree(black, specks, True)
    specks[0] = 0
    specks[0, :10] = 255  # 0.1 % of the pixels
    assert agree(black, specks, False) and not agree(black, specks, True)
    specks[0, 10] = 255
    assert not agree(black, specks, False)
    assert not agree(black, black[:50], False)


def test_a_missing_golden_fails_and_a_difference_leaves_three_pictures(
    stage: Stage, monkeypatch: pytest.MonkeyPatch, tmp_path, coast: np.ndarray
) -> None:
    monkeypatch.setattr(pictures, "GOLDEN", tmp_path / "golden")
    monkeypatch.setattr(pictures, "RENDERER", tmp_path / "golden" / "renderer.txt")
    monkeypatch.setattr(pictures, "FAILURES", tmp_path / "failures")
    with pytest.raises(AssertionError, match=r"missing.*--update-golden"):
        pictures.check("coast", coast, update=False)
    pictures.check("coast", coast, update=True)
    pictures.check("coast", coast, update=False)
    spoilt = coast.copy()
    spoilt[40:60, 40:60] += 9
    with pytest.raises(AssertionError, match=r"coast: \d+ pixels differ.*difference"):
        pictures.check("coast", spoilt, update=False)
    names = sorted(path.name for path in (tmp_path / "failures").iterdir())
    assert names == ["coast-actual.png", "coast-difference.png", "coast-expected.png"]
    shown = np.asarray(Image.open(tmp_path / "failures" / "coast-difference.png"))
    assert shown[50, 50].min() == 9 * AMPLIFICATION and shown[0, 0].max() == 0


def test_every_golden_picture_belongs_to_a_test() -> None:
    wanted = {*ELEMENTS, *(f"sword_{k}" for k in range(1, 5))}
    wanted |= {f"{scene}_{preset}" for scene in (*SCENES, "dusk") for preset in ("2006", "best")}
    wanted |= {f"lesson_{lesson.name}" for lesson in lessons()} | {*VIEWS, *VOXEL.main}
    assert {path.stem for path in pictures.GOLDEN.glob("*.png")} == wanted
    assert pictures.RENDERER.exists()
